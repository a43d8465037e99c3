"""A plain room under a wide ceiling lamp: every direction that a surface would try by itself finds light. Clever methods can
win nothing here, and must not lose."""

from kit import Group, Map, fit
from scene_parts import furnish, lathe, stand


def build() -> Map:
    world = Map("A plain room")
    world.room((-192, -192, 0), (192, 192, 160), {"side": "plaster", "bottom": "wood_plank", "top": "plaster"})
    things = Group()
    for x in (-128, 0):
        for y in (-128, 0):
            world.detail.box((x + 8, y + 8, 154), (x + 120, y + 120, 160), {"all": "metal_trim", "bottom": "lab_light"})
    for lo, hi in (((-192, 188, 0), (192, 192, 12)), ((-192, -192, 0), (-188, 188, 12)), ((188, -192, 0), (192, 188, 12))):
        world.detail.box(lo, hi, "wood_beam")
    world.detail.box((-100, 120, 0), (-36, 184, 64), fit("crate_a"))
    world.detail.box((-28, 136, 0), (20, 184, 48), fit("crate_b"))
    world.detail.box((-92, 128, 64), (-52, 168, 104), fit("crate_b"))
    things.add(lathe([(0, 18), (8, 20), (36, 21), (64, 20), (72, 18)], "barrel_side", 14), (110, 120, 0))
    things.add(lathe([(0, 9), (2, 11), (8, 6), (18, 15), (32, 17), (44, 9), (50, 11)], "tile_teal", 16), (-12, 158, 48))
    world.detail.box((60, -20, 26), (140, 30, 30), "wood_plank")
    for x, y in ((62, -18), (134, -18), (62, 24), (134, 24)):
        world.detail.box((x, y, 0), (x + 4, y + 4, 26), "wood_beam")
    things.add(lathe([(0, 0), (3, 8), (9, 12), (15, 8), (18, 0)], "lab_red", 14), (92, 6, 30))
    things.add(lathe([(0, 5), (10, 5), (12, 3)], "lab_blue", 12), (118, 4, 30))
    world.detail.box((-70, -70, 0), (50, 70, 1), fit("carpet_red", (1, 1)))
    world.detail.box((-60, 190, 84), (60, 192, 140), {"all": "wood_beam", "south": fit("marble_black")})
    furnish(world, things)
    stand(world, -70, -160, 0, 70)
    return world
