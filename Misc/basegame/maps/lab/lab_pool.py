"""Under water: a bath seen from below its surface. The light is above, the surface swings and holds back a part of it, and what
is seen through it is seen twice: by the eye and by the light."""

from kit import Group, Map, fit
from scene_parts import furnish, lathe, stand


def build() -> Map:
    world = Map("The bath", _wateralpha=0.45)
    things = Group()
    world.room((-352, -256, -192), (352, 256, 224), {"side": "tile_teal", "bottom": "tile_white", "top": "plaster"})
    # Walks along the long sides, with steps down.
    for y0, y1 in ((-256, -176), (176, 256)):
        world.detail.box((-352, y0, -192), (352, y1, 16), {"all": "tile_teal", "top": "tile_check"})
    world.detail.stairs((222, -176, -192), (352, 176, 16), {"all": "tile_white", "top": "tile_white"}, "+x", steps=13)
    world.box((-352, -256, -192), (352, 256, 0), "*water_a")
    for x in (-288, -96, 96, 288):
        for y in (-192, 192):
            things.add(lathe([(0, 22), (10, 22), (16, 14), (168, 13), (180, 24), (208, 26)], "marble_white", 10), (x, y, 16))
    # Lanterns in the ceiling, long and bright.
    for x in (-240, 0, 208):
        world.detail.box((x - 12, -132, 216), (x + 44, 132, 224), {"all": "copper_trim", "bottom": "lab_light"})
    # On the ground: a plinth with a vessel, spheres, a fallen column.
    world.detail.box((-84, -28, -192), (-28, 28, -152), "marble_black")
    things.add(lathe([(0, 10), (4, 11), (12, 5), (24, 16), (44, 21), (60, 13), (66, 9), (74, 14)], "copper_plate", 16),
              (-56, 0, -152))
    things.add(lathe([(0, 0), (5, 14), (16, 24), (32, 28), (48, 24), (59, 14), (64, 0)], "lab_yellow", 16), (84, 84, -192))
    things.add(lathe([(0, 0), (4, 9), (12, 16), (24, 16), (32, 9), (36, 0)], "lab_red", 12), (128, -56, -192))
    world.detail.cylinder((-176, 84), 16, -260 + 68, -172, "marble_white", sides=10)
    world.detail.cylinder((100, -176), 16, -150, 60, "marble_white", sides=10, axis="x")
    world.detail.box((-300, 40, -192), (-252, 88, -144), fit("crate_b"))
    furnish(world, things)
    stand(world, -300, -40, -160, 12)
    return world
