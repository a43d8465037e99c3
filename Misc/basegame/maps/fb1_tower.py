"""The bell tower behind the gold door: a last fight under the great bell, the rune, and the gate."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import bell, brazier, candles, lancet, pillar, slipgate

EAST, WEST, SOUTH, NORTH, FLOOR, TOP = -576, -1088, 592, 1104, 192, 608
GATE_Y = NORTH + 80


def rooms(walls: Group) -> None:
    walls.room((EAST + 32, 624, FLOOR), (-480, 736, FLOOR + 144), {"side": "stone_b", "bottom": "stone_floor", "top": "wood_plank"},
               wall=32)
    walls.room((WEST, SOUTH, FLOOR), (EAST, NORTH, TOP), {"side": "stone_b", "bottom": "stone_floor", "top": "wood_plank"}, wall=32)
    walls.room((-880, NORTH + 32, FLOOR), (-784, NORTH + 160, FLOOR + 160),
               {"side": "copper_plate", "bottom": "metal_floor", "top": "metal_plate"}, wall=32)
    walls.room((-960, 720, TOP + 16), (-704, 976, TOP + 96), {"side": "stone_b", "bottom": "wood_plank", "top": "sky_dusk"}, wall=16)


def openings(walls: Group) -> None:
    walls.cut((EAST, 632, FLOOR), (-448, 728, FLOOR + 128))
    walls.cut((-880, NORTH, FLOOR), (-784, NORTH + 32, FLOOR + 160))
    walls.cut((-960, 720, TOP), (-704, 976, TOP + 32))
    for y in (720, 976):
        walls.cut((WEST - 24, y - 40, FLOOR + 96), (WEST, y + 40, FLOOR + 288))
    for x in (-992, -672):
        walls.cut((x - 40, NORTH, FLOOR + 96), (x + 40, NORTH + 24, FLOOR + 288))


def furnish(world: Map) -> None:
    part = world.detail
    part.arch((EAST, 632, FLOOR + 88), (-448, 728, FLOOR + 128), "stone_trim", axis="x", segments=8, pointed=True)
    # An octagon: the corners are walls; that beside the door leaves it free.
    for x, sx in ((WEST, 1), (EAST, -1)):
        for y, sy in ((SOUTH, 1), (NORTH, -1)):
            side = 32 if (x, y) == (EAST, SOUTH) else 96
            part.prism([(x, y), (x + sx * side, y), (x, y + sy * side)], FLOOR, TOP, "stone_b")
    for y in (720, 976):
        world.add(lancet(80, 192, "window_a", 24), (WEST, y, FLOOR + 96), turn=90)
    for x in (-992, -672):
        world.add(lancet(80, 192, "window_b", 24), (x, NORTH, FLOOR + 96))
    # The great bell under its frame.
    cx, cy = (WEST + EAST) / 2, (SOUTH + NORTH) / 2
    world.add(bell(88, 80), (cx, cy, FLOOR + 184))
    for dy in (-20, 8):
        part.box((WEST, cy + dy, TOP - 72), (EAST, cy + dy + 12, TOP - 40), "wood_beam")
    part.ring((cx, cy), 84, 108, FLOOR, FLOOR + 6, "copper_trim", sides=16)
    part.cylinder((cx, cy), 84, FLOOR, FLOOR + 3, "tile_check", sides=16)
    for dx in (-176, 176):
        for dy in (-176, 176):
            world.add(pillar(TOP - FLOOR - 40, 20, "marble_black"), (cx + dx, cy + dy, FLOOR))
    part.box((WEST, cy - 190, TOP - 40), (EAST, cy - 162, TOP), "wood_beam")
    part.box((WEST, cy + 162, TOP - 40), (EAST, cy + 190, TOP), "wood_beam")
    for dx in (-110, 110):
        world.add(brazier(), (cx + dx, NORTH - 60, FLOOR))
    # The gate to the four gates.
    world.add(slipgate(80, 136), (-832, GATE_Y, FLOOR))
    part.arch((-880, NORTH, FLOOR + 104), (-784, NORTH + 32, FLOOR + 160), "copper_plate", axis="y", segments=8)
    world.part("func_illusionary").box((-872, GATE_Y - 2, FLOOR), (-792, GATE_Y + 2, FLOOR + 136), "*teleport")
    trigger(world, "changelevel", (-872, GATE_Y - 6, FLOOR), (-792, GATE_Y + 6, FLOOR + 130), map="gates")
    part.cylinder((-832, FLOOR + 186), 14, NORTH - 8, NORTH, fit("crystal_gold"), sides=8, axis="y")
    part.box((-896, NORTH - 14, FLOOR), (-880, NORTH, FLOOR + 164), {"all": "copper_plate", "south": fit("rune_b", (1, 5))})
    part.box((-784, NORTH - 14, FLOOR), (-768, NORTH, FLOOR + 164), {"all": "copper_plate", "south": fit("rune_b", (1, 5))})


def people(world: Map) -> None:
    world.entity("info_player_deathmatch", (-1000, 848, FLOOR + 28), angle=0)
    world.entity("info_intermission", (-640, 640, FLOOR + 260), mangle=(20, 130, 0))
    monster(world, "demon1", -940, 960, FLOOR, 290)
    monster(world, "demon1", -1000, 760, FLOOR, 330, skill=1)
    monster(world, "shambler", -832, 1010, FLOOR, 270, skill=2)
    monster(world, "ogre", -640, 870, FLOOR, 240)
    monster(world, "hell_knight", -700, 940, FLOOR, 300, skill=1)
    item(world, "rockets", -640, 700, FLOOR)
    item(world, "health", -950, 730, FLOOR)
    item(world, "health", -640, 960, FLOOR, flags=1)
    item(world, "rockets", -1010, 850, FLOOR)
    item(world, "armor2", -832, 848, FLOOR + 3)
    world.entity("item_sigil", (-832, NORTH + 18, FLOOR + 28), spawnflags=1)
