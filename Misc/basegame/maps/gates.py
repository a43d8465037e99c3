"""The four gates: the undercroft of the hub. Each gate leads to a level and closes when its rune is won; a crystal is lit for it
beside the lid in the middle. Four runes open the lid: below it waits the Old One, and the game's end."""

from __future__ import annotations

import random

from kit import Group, Map, Tex, fit
from passages import gate, passage_home, word
from people import item, monster, trigger
from pieces import brazier, candle_stand, candles, hanging_lamp, pillar, slipgate

X, SOUTH, NORTH, TOP = 384, -448, 384, 272
PIT = 64  # half of the shaft's width
CAVE_X, CAVE_SOUTH, CAVE_NORTH, CAVE_TOP, FLOOR = 512, -480, 704, -352, -704
POOL = (-128, 128, -160, 128, -864)  # x from, to, y from, to, bed
SHORE, LAVA = 224, -728  # where the ground ends in the north
OLD_ONE = (0, 448)
# The rune's bit, the level, its name, which wall, y, what lights the gate.
GATES = ((1, "fb1", "The Sunken Works", -1, -160, "crystal_red"), (2, "fb2", "The Sunlit Baths", -1, 160, "crystal_blue"),
         (4, "fb3", "The House of Glass", 1, 160, "light_green"), (8, "fb4", "The Engine", 1, -160, "crystal_gold"))


def rooms(world: Map) -> None:
    walls = Group()
    walls.room((-X, SOUTH, 0), (X, NORTH, TOP), {"side": "stone_b", "bottom": "stone_floor", "top": "brick_dark"}, wall=32)
    walls.room((-64, SOUTH - 128, 0), (64, SOUTH - 32, 160), {"side": "marble_black", "bottom": "tile_check", "top": "stone_a"})
    for _, _, _, side, y, _ in GATES:
        a, b = sorted((side * (X + 32), side * (X + 112)))
        walls.room((a, y - 48, 0), (b, y + 48, 144), {"side": "marble_black", "bottom": "tile_check", "top": "marble_black"})
    walls.room((-PIT, -PIT, CAVE_TOP + 32), (PIT, PIT, -32), "rock_b", wall=32)
    walls.room((-CAVE_X, CAVE_SOUTH, FLOOR), (CAVE_X, CAVE_NORTH, CAVE_TOP), {"side": "rock_b", "bottom": "rock_a", "top": "rock_a"},
               wall=32)
    walls.room((-CAVE_X, SHORE, FLOOR - 96), (CAVE_X, CAVE_NORTH, FLOOR - 32), "rock_b", wall=32)
    x0, x1, y0, y1, bed = POOL
    walls.room((x0, y0, bed), (x1, y1, FLOOR - 32), {"side": "tile_teal", "bottom": "tile_teal", "top": "rock_a"}, wall=32)
    walls.cut((-PIT, -PIT, CAVE_TOP), (PIT, PIT, 0))
    walls.cut((x0, y0, FLOOR - 32), (x1, y1, FLOOR))
    walls.cut((-CAVE_X, SHORE, FLOOR - 32), (CAVE_X, CAVE_NORTH, FLOOR))
    walls.cut((-64, SOUTH - 32, 0), (64, SOUTH, 160))
    for _, _, _, side, y, _ in GATES:
        a, b = sorted((side * X, side * (X + 32)))
        walls.cut((a, y - 48, 0), (b, y + 48, 144))
    world.add(walls)
    world.box((-CAVE_X, SHORE, FLOOR - 96), (CAVE_X, CAVE_NORTH, LAVA), "*lava_a")
    world.box((x0, y0, bed), (x1, y1, FLOOR - 12), "*water_a")


def hall(world: Map) -> None:
    part = world.detail
    part.arch((-X, SOUTH, 176), (X, NORTH, TOP), Tex("brick_dark", align="face"), axis="y", segments=10)
    for y in (SOUTH + 24, -288, 0, 288):
        part.arch((-X + 8, y - 12, 160), (X - 8, y + 12, TOP - 8), "stone_trim", axis="y", segments=10)
        for side in (-1, 1):
            part.cylinder((side * (X - 12), y), 14, 0, 176, "marble_white", sides=8)
            a, b = sorted((side * X, side * (X - 30)))
            part.box((a, y - 18, 0), (b, y + 18, 16), "stone_trim")
            part.box((a, y - 18, 164), (b, y + 18, 180), "copper_trim")
    for x, y in ((-180, -288), (180, -288), (-180, 288), (180, 288)):
        world.add(hanging_lamp(44, "lamp_round", 10), (x, y, TOP - 24))
    part.box((-40, SOUTH, 0), (40, -120, 1), "carpet_red")
    # The north end: a niche with the works' skull and candles.
    part.stairs((-160, NORTH - 96, 0), (160, NORTH - 48, 24), {"all": "stone_trim", "top": "stone_a"}, "+y", steps=3)
    part.box((-160, NORTH - 48, 0), (160, NORTH, 24), {"all": "stone_trim", "top": "tile_check"})
    part.box((-64, NORTH - 24, 24), (64, NORTH, 56), {"all": "marble_black", "south": fit("skull_trim")})
    for k, x in enumerate((-44, 0, 44)):
        world.add(candles(5, 9, 100 + k), (x, NORTH - 12, 56))
    for x in (-120, 120):
        world.add(brazier(), (x, NORTH - 28, 24))
    part.box((-48, NORTH - 4, 88), (48, NORTH, 152), {"all": "copper_plate", "south": fit("rune_a", (2, 1))})
    for side in (-1, 1):
        world.add(candle_stand(110 + side), (side * 300, NORTH - 50, 0))
        world.add(pillar(150, 14, "marble_black"), (side * 110, SOUTH + 60, 0))
        world.add(candles(5, 10, 120 + side), (side * 110, SOUTH + 60, 150))
    for number, level, title, side, y, tex in GATES:
        level_gate(world, number, level, title, side, y, tex)
    lid(world)
    world.add(passage_home("start", 80, 128), (0, SOUTH - 96, 0), turn=180)
    word(world, (-64, SOUTH - 32, 0), (64, SOUTH, 96), "Back to the nave")
    word(world, (-128, -128, 0), (128, 128, 64), "Four runes unseal what is below")


def level_gate(world: Map, number: int, level: str, title: str, side: int, y: float, tex: str) -> None:
    """A gate in its niche, framed by its light; the shutter is there when its rune is won."""
    part = world.detail
    world.add(gate(level, 64, 112), (side * (X + 80), y, 0), turn=-90 * side)
    a, b = sorted((side * (X - 8), side * X))
    for edge in (-64, 48):
        part.box((a, y + edge, 0), (b, y + edge + 16, 160), {"all": "copper_plate", "west": fit(tex, (0.5, 5)),
                                                           "east": fit(tex, (0.5, 5))})
    part.box((a, y - 68, 160), (b, y + 68, 176), "copper_trim")
    shut = world.part("func_episodegate", spawnflags=number)
    a, b = sorted((side * (X + 20), side * (X + 28)))
    shut.box((a, y - 48, 0), (b, y + 48, 144), fit("door_rune"))
    a, b = sorted((side * (X - 72), side * X))
    word(world, (a, y - 48, 0), (b, y + 48, 96), title)


def lid(world: Map) -> None:
    part = world.detail
    cover = world.part("func_bossgate")
    cover.box((-PIT, -PIT, -12), (PIT, PIT, 0), {"all": "metal_rust", "top": fit("door_rune"), "bottom": fit("door_rune")})
    r = PIT + 20
    for lo, hi in (((-r, -r), (r, -PIT)), ((-r, PIT), (r, r)), ((-r, -PIT), (-PIT, PIT)), ((PIT, -PIT), (r, PIT))):
        part.box((*lo, 0), (*hi, 8), "copper_trim")
    for number, _, _, side, y, tex in GATES:
        x, y = side * 100, 100 if y > 0 else -100
        part.cylinder((x, y), 16, 0, 28, "marble_black", sides=8)
        part.cylinder((x, y), 18, 28, 34, "copper_trim", sides=8)
        lit = world.part("func_episodegate", spawnflags=number)
        lit.cylinder((x, y), 9, 34, 62, tex, sides=6, top_radius=6)
        lit.cylinder((x, y), 6, 62, 76, tex, sides=6, top_radius=0)


def cave(world: Map) -> None:
    """The ground between the pool and the lava; the island of the Old One; the gate into what circles round it."""
    part = world.detail
    x0, x1, y0, _, bed = POOL
    part.stairs((x0, y0, FLOOR - 96), (x1, -PIT, FLOOR), "stone_a", "-y", steps=12)
    part.box((x0, y0, bed), (x1, -PIT, FLOOR - 96), "stone_a")
    x, y = OLD_ONE
    part.prism([(x - 208, y - 96), (x - 112, y - 168), (x + 112, y - 168), (x + 208, y - 96), (x + 208, y + 96), (x + 112, y + 168),
                (x - 112, y + 168), (x - 208, y + 96)], FLOOR - 96, FLOOR, {"all": "rock_b", "top": "flesh_b"})
    chance = random.Random(5)
    for k in range(22):
        side = -1 if k % 2 else 1
        px, py = side * chance.randint(400, 490), CAVE_SOUTH + 30 + 52 * k
        r, high = chance.randint(26, 60), chance.randint(60, 240)
        part.cylinder((px, py), r, FLOOR - 96, FLOOR + high, "rock_a", sides=7, top_radius=r * 0.3)
        part.cylinder((side * chance.randint(180, 480), py), r * 0.25, CAVE_TOP - chance.randint(60, 150), CAVE_TOP, "rock_b", sides=6,
                      top_radius=r)
    # The lights of the four levels, at their corners.
    for px, py, tex in ((-330, -380, "crystal_red"), (-330, 130, "crystal_blue"), (330, 130, "light_green"), (330, -380, "crystal_gold")):
        for dx, dy, r, high in ((0, 0, 22, 88), (34, 14, 13, 52), (-26, 26, 11, 40)):
            part.cylinder((px + dx, py + dy), r, FLOOR, FLOOR + high, tex, sides=6, top_radius=r * 0.6)
            part.cylinder((px + dx, py + dy), r * 0.6, FLOOR + high, FLOOR + high + r, tex, sides=6, top_radius=0)
    world.add(slipgate(72, 120, "flesh_a", "rune_b"), (0, CAVE_SOUTH + 48, FLOOR), turn=180)
    y = CAVE_SOUTH + 48
    world.part("func_illusionary").box((-36, y - 2, FLOOR), (36, y + 2, FLOOR + 120), "*teleport")
    trigger(world, "teleport", (-36, y - 6, FLOOR), (36, y + 6, FLOOR + 112), target="ball", spawnflags=1)
    word(world, (-96, y, FLOOR), (96, y + 80, FLOOR + 96), "It leads into what circles, wherever that is")
    # What circles: past both shores and through the Old One, where it stays for a while.
    world.entity("misc_teleporttrain", (-300, 96, FLOOR + 90), targetname="ball", target="ball_west", speed=140)
    ways = (("ball_west", (-300, 96), 1), ("ball_in", OLD_ONE, 5), ("ball_east", (300, 96), 1), ("ball_back", OLD_ONE, 5))
    for k, (name, (px, py), wait) in enumerate(ways):
        world.entity("path_corner", (px, py, FLOOR + 84), targetname=name, target=ways[(k + 1) % 4][0], wait=wait)
    trigger(world, "once", (-CAVE_X, CAVE_SOUTH, FLOOR), (CAVE_X, y0 - 8, FLOOR + 160), target="ball", message="It wakes")


def people(world: Map) -> None:
    world.entity("info_player_start", (0, SOUTH + 24, 28), angle=90)
    for k, x in enumerate((-40, 40)):
        world.entity("info_player_coop", (x, SOUTH + 40, 28), angle=90)
        world.entity("info_player_coop", (x, SOUTH + 100, 28), angle=90)
        world.entity("info_player_deathmatch", (x * 7, 60, 28), angle=180 * k)
        world.entity("info_player_deathmatch", (x * 7, -60, 28), angle=180 * k)
    world.entity("info_intermission", (-250, 130, FLOOR + 190), mangle=(14, 52, 0))
    world.entity("monster_oldone", (*OLD_ONE, FLOOR + 24), angle=270, spawnflags=2048)
    monster(world, "shambler", 270, -100, FLOOR, 200, skill=1)
    monster(world, "shalrath", -250, -20, FLOOR, 340)
    monster(world, "demon1", -340, -260, FLOOR, 20)
    monster(world, "demon1", 300, -260, FLOOR, 160, skill=2)
    item(world, "health", -200, -400, FLOOR)
    item(world, "health", 200, -400, FLOOR)
    item(world, "health", 300, 330, 0)
    item(world, "shells", -300, 330, 0)
    item(world, "rockets", 150, -330, FLOOR)
    item(world, "cells", -150, -330, FLOOR)
    item(world, "armor2", 0, -300, FLOOR)
    for x in (-1, 1):
        item(world, "rockets", x * 250, 60, FLOOR)


def build() -> Map:
    world = Map("The Four Gates", sounds=2, worldtype=0, _wateralpha=0.6, _minlight=22, fog="0.03 0.4 0.36 0.34")
    for part in (rooms, hall, cave, people):
        part(world)
    return world
