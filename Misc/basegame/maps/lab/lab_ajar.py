"""The door that stands ajar, after Veach's: all light of this room comes from the next one, through a gap a hand wide, and there
from a small lamp in a trough, off the ceiling above it and then off the walls. It falls on things that shine."""

from kit import Group, Map, Tex, fit
from scene_parts import furnish, lathe, stand

CLEAR = 208  # height of the rooms


def door() -> Group:
    """Its hinge is at 0 0; it is closed along +x."""
    group = Group()
    group.detail.box((0, -3, 0), (88, 3, 136), {"all": "wood_beam", "north": fit("wood_door"), "south": fit("wood_door")})
    group.detail.add(lathe([(-3, 2), (3, 2)], "copper_plate", 8), (78, -6, 64))
    return group


def table() -> Group:
    group = Group()
    group.detail.box((-72, -34, 44), (72, 34, 50), "wood_plank")
    group.detail.box((-66, -28, 38), (66, 28, 44), "wood_beam")
    for x in (-62, 54):
        for y in (-26, 18):
            group.detail.box((x, y, 0), (x + 8, y + 8, 38), "wood_beam")
    return group


def lamp(world: Map) -> None:
    """A trough on the east wall of the other room: it shines on the ceiling alone, where the gap shows none."""
    x, y0, y1, z = 320, 224, 416, 144
    world.detail.box((x - 64, y0, z), (x, y1, z + 4), "copper_trim")
    world.detail.box((x - 64, y0, z + 4), (x - 60, y1, z + 20), "copper_trim")
    for y in (y0, y1 - 4):
        world.detail.box((x - 60, y, z + 4), (x, y + 4, z + 20), "copper_trim")
    world.detail.box((x - 52, y0 + 16, z + 4), (x - 8, y1 - 16, z + 8), "lab_light_warm")


URN = [(0, 8), (2, 9), (6, 5), (14, 13), (22, 15), (30, 9), (34, 6), (38, 8)]
BOWL = [(0, 7), (3, 4), (5, 5), (10, 15), (16, 19)]
JUG = [(0, 10), (10, 12), (24, 7), (40, 4), (44, 6)]


def build() -> Map:
    world = Map("A door ajar")
    things = Group()
    here = {"side": "plaster", "bottom": "tile_check", "top": "wood_plank"}
    world.room((-224, -224, 0), (224, 176, CLEAR), here)
    world.room((-48, 192, 0), (320, 448, CLEAR), {"side": "plaster", "bottom": "wood_plank", "top": "plaster"})
    world.cut((24, 176, 0), (112, 192, 136))
    # Wainscot, beams, the frame of the door.
    for lo, hi in (((-224, -224, 0), (-220, 176, 60)), ((220, -224, 0), (224, 176, 60)),
                   ((-224, 172, 0), (16, 176, 60)), ((120, 172, 0), (224, 176, 60))):
        world.detail.box(lo, hi, "wood_plank")
        world.detail.box((lo[0] - (2 if lo[0] > 0 and hi[0] - lo[0] < 8 else 0), lo[1] - (2 if hi[1] - lo[1] < 8 else 0), 60),
                         (hi[0] + (2 if hi[0] < 0 and hi[0] - lo[0] < 8 else 0), hi[1], 65), "wood_beam")
    for y in (-160, -48, 64):
        world.detail.box((-224, y, CLEAR - 14), (224, y + 16, CLEAR), "wood_beam")
    world.detail.box((16, 170, 0), (24, 194, 144), Tex("wood_beam", turn=1))
    world.detail.box((112, 170, 0), (120, 194, 144), Tex("wood_beam", turn=1))
    world.detail.box((24, 170, 136), (112, 194, 144), "wood_beam")
    things.add(door(), (24, 178, 0), turn=44)
    lamp(world)
    things.add(table(), (-40, 20, 0), turn=8)
    for profile, texture, at in ((URN, "copper_plate", (-84, 14)), (BOWL, "lab_chrome", (-34, 22)),
                                 (JUG, "tile_teal", (10, 30))):
        things.add(lathe(profile, texture, 20), (*at, 50))
    world.detail.box((-180, 140, 90), (-100, 172, 94), "wood_beam")
    for k, height in enumerate((20, 26, 17, 23)):
        world.detail.box((-172 + 14 * k, 148, 94), (-162 + 14 * k, 168, 94 + height), ("lab_red", "lab_blue", "lab_yellow",
                                                                                       "lab_grey")[k])
    world.detail.box((-60, -120, 0), (140, 0, 1), fit("carpet_red", (2, 1)))
    furnish(world, things)
    stand(world, 60, -190, 0, 105)
    return world
