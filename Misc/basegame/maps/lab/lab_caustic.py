"""A bath whose water stands still. A small lamp burns low above it in a chamber of its own; the wall between ends a hand above
the water, so that all light that leaves strikes the water first, and what the room has is the water's reflection of it."""

from kit import Group, Map
from scene_parts import furnish, lathe, stand

WATER, GROUND = -12, -96  # the pool's surface and its ground; the walk is at 0
BACK = 96  # how far the chamber reaches behind the south wall
GAP = 16  # from the water to the lower edge of the chamber's wall; the lamp is above that
SOUTH, NORTH, WEST, EAST = -224, 96, -224, 176
EDGE = -112  # of the walk along the west wall
SPRING, CROWN = 128, 208  # of the vault
SHAFT = [(0, 16), (8, 16), (14, 11), (104, 9), (114, 15), (120, 18), (128, 18)]
URN = [(0, 13), (4, 14), (10, 7), (26, 20), (44, 24), (60, 15), (66, 10), (72, 14)]


def chamber(world: Map) -> None:
    """Behind the south wall: the lamp hangs at its back, and nothing of it is above the gap's shadow."""
    room = Group()
    room.room((-64, SOUTH - BACK, GROUND), (128, SOUTH - 16, 48), {"all": "lab_black"})
    room.cut((-32, SOUTH - 16, GROUND), (96, SOUTH, WATER + GAP))
    world.add(room)
    world.detail.box((-16, SOUTH - BACK + 4, WATER + GAP + 4), (80, SOUTH - BACK + 12, WATER + GAP + 32), "lab_light_warm")
    world.detail.box((-20, SOUTH - BACK, WATER + GAP + 4), (84, SOUTH - BACK + 4, WATER + GAP + 32), "metal_trim")


def build() -> Map:
    world = Map("The still bath", _wateralpha=0.7)
    things = Group()
    hall = Group()
    hall.room((WEST, SOUTH, GROUND), (EAST, NORTH, CROWN), {"side": "plaster", "bottom": "marble_black", "top": "plaster"})
    hall.cut((-32, SOUTH - 16, GROUND), (96, SOUTH, WATER + GAP))
    world.add(hall)
    chamber(world)
    world.detail.arch((WEST, SOUTH, SPRING), (EAST, NORTH, CROWN), "plaster", axis="y", segments=12)
    world.box((WEST, SOUTH, GROUND), (EDGE, NORTH, -6), "tile_white")
    world.detail.box((WEST, SOUTH, -6), (EDGE + 6, NORTH, 0), "marble_white")
    for lo, hi in (((EDGE, NORTH - 20, GROUND), (EAST, NORTH, 0)), ((EAST - 32, SOUTH, GROUND), (EAST, NORTH - 20, 0))):
        world.detail.box(lo, hi, {"all": "marble_black", "top": "marble_white"})
    world.box((EDGE, SOUTH - BACK, GROUND), (EAST, NORTH, WATER), "*water_still")
    for x in (EDGE - 14, EAST - 14):
        things.add(lathe(SHAFT, "marble_white", 12), (x, NORTH - 40, 0))
    things.add(lathe([(GROUND, 34), (6, 34), (6, 28), (14, 28)], "stone_trim", 8), (32, 20, 0))
    things.add(lathe(URN, "copper_plate", 16), (32, 20, 14))
    furnish(world, things)
    stand(world, -176, -176, 0, 58)
    return world
