"""A hall under one great lamp, that goes out: who steps on the plate removes it, and six small lamps with a hundredth of its
area are left. What was learnt of the great one is wrong from then on."""

from kit import Group, Map, fit
from scene_parts import furnish, lantern, lathe, stand


def build() -> Map:
    world = Map("Lights out")
    world.room((-320, -320, 0), (320, 320, 256), {"side": "stone_a", "bottom": "marble_white", "top": "stone_b"})
    things = Group()
    for x in (-208, 208):
        for y in (-208, 0, 208):
            things.add(lathe([(0, 30), (12, 30), (20, 20), (216, 18), (232, 28), (256, 34)], "marble_black", 12), (x, y, 0))
            things.add(lantern("lab_light_warm", 5), (x - 24 if x > 0 else x + 24, y, 112))
    # The body of the lamp stays; what glows is an entity that the plate kills.
    world.detail.cylinder((0, 0), 104, 232, 256, "copper_plate", sides=16)
    lamp = world.part("func_wall", targetname="lamp")
    lamp.cylinder((0, 0), 92, 226, 231, "lab_light", sides=16)
    for x, y in ((-88, 0), (84, 0), (0, -88), (0, 84)):
        world.detail.box((x, y, 222), (x + 4, y + 4, 232), "copper_trim")
    plate = world.part("trigger_once", killtarget="lamp")
    plate.box((-48, -160, 0), (48, -112, 32), "trigger")
    world.detail.box((-48, -160, 0), (48, -112, 2), {"all": "metal_trim", "top": fit("rune_b", (2, 1))})
    things.add(lathe([(0, 40), (8, 40), (16, 28), (40, 22), (48, 34), (56, 34)], "stone_trim", 16), (0, 60, 0))
    things.add(lathe([(0, 0), (6, 14), (20, 22), (36, 22), (50, 14), (56, 0)], "copper_plate", 16), (0, 60, 56))
    world.detail.box((-130, 190, 0), (-82, 238, 48), fit("crate_a"))
    world.detail.box((96, 120, 0), (144, 168, 48), fit("crate_b"))
    furnish(world, things)
    stand(world, -40, -272, 0, 84)
    return world
