"""The chapel behind the silver door: a nave over a pit of slime, shelves of the drowned library, an altar, and the well.
Secret: a bookshelf gives way; behind it a gate that leads back to the court."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import candle_stand, candles, hanging_lamp, lancet, pew, pillar, rose, sconce, slipgate

X, SOUTH, NORTH, TOP = 288, 864, 1440, 320
PIT = (1056, 1184, -128, -56)  # south, north, bed, slime
WELL = (160, 256, 1296, 1392)  # x from, to, y from, to


def rooms(walls: Group) -> None:
    walls.room((-56, 800, 0), (56, 832, 128), {"side": "marble_black", "bottom": "tile_check", "top": "wood_plank"}, wall=32)
    walls.room((-X, SOUTH, 0), (X, NORTH, TOP), {"side": "plaster", "bottom": "tile_check", "top": "plaster"}, wall=32)
    south, north, bed, _ = PIT
    walls.room((-X, south, bed), (X, north, -32), {"side": "rock_b", "bottom": "rock_b", "top": "rock_b"}, wall=32)
    walls.room((-X - 224, 1248, 0), (-X - 64, 1392, 128), {"side": "brick_dark", "bottom": "wood_plank", "top": "wood_plank"},
               wall=32)


def openings(walls: Group) -> None:
    walls.cut((-56, 768, 0), (56, SOUTH, 128))
    south, north, _, _ = PIT
    walls.cut((-X, south, -32), (X, north, 0))
    walls.cut((-X - 64, 1288, 0), (-X, 1352, 112))
    x0, x1, y0, y1 = WELL
    walls.cut((x0, y0, -32), (x1, y1, 0))
    for side in (-1, 1):
        for y in (960, 1120) if side < 0 else (960, 1120, 1280):
            a, b = sorted((side * X, side * (X + 24)))
            walls.cut((a, y - 36, 112), (b, y + 36, 256))
    walls.cut((-80, NORTH, 128), (80, NORTH + 24, 288))


def furnish(world: Map) -> None:
    south, north, bed, slime = PIT
    world.box((-X, south, bed), (X, north, slime), "*slime_a")
    part = world.detail
    # Stones across the slime, and the ribs of what was the floor.
    for x, y, w in ((-24, south + 16, 40), (10, south + 72, 44)):
        part.box((x, y, bed), (x + w, y + w, -4), {"all": "stone_a", "top": "tile_check"})
    part.box((-X, south - 10, 0), (-48, south, 10), "marble_black")
    part.box((48, south - 10, 0), (X, south, 10), "marble_black")
    nave(world)
    altar(world)
    well(world)
    library(world)


def nave(world: Map) -> None:
    part = world.detail
    part.arch((-X, SOUTH, 208), (X, NORTH, TOP), Tex("plaster", align="face"), axis="y", segments=10, pointed=True)
    for y in (SOUTH + 20, 1040, 1200, 1376):
        part.arch((-X + 12, y - 10, 188), (X - 12, y + 10, TOP - 12), "stone_trim", axis="y", segments=10, pointed=True)
        for side in (-1, 1):
            part.cylinder((side * (X - 10), y), 13, 0, 196, "marble_black", sides=8)
            a, b = sorted((side * X, side * (X - 28)))
            part.box((a, y - 18, 0), (b, y + 18, 16), "stone_trim")
            part.box((a, y - 16, 188), (b, y + 16, 204), "copper_trim")
    for side in (-1, 1):
        for y in (960, 1120) if side < 0 else (960, 1120, 1280):
            world.add(lancet(72, 144, "window_b", 24), (side * X, y, 112), turn=-90 if side > 0 else 90)
        for y in (920, 990):
            world.add(pew(160), (side * 150, y, 0))
        world.add(candle_stand(70 + side), (side * 70, 1210, 0))
    for y in (960, 1280):
        world.add(hanging_lamp(90), (0, y, TOP))
    part.box((-40, SOUTH, 0), (40, 1056, 1), "carpet_red")
    # Slime drips of light on the pit's walls are left to the slime itself.
    part.arch((-56, 832, 88), (56, SOUTH, 128), "stone_trim", axis="y")


def altar(world: Map) -> None:
    part = world.detail
    part.stairs((-112, 1296, 0), (112, 1344, 24), {"all": "marble_white"}, "+y", steps=3)
    part.box((-112, 1344, 0), (112, NORTH, 24), {"all": "marble_white", "top": "tile_white"})
    part.box((-56, 1376, 24), (56, 1416, 60), {"all": "marble_black", "south": fit("skull_trim", (1, 1))})
    part.box((-62, 1370, 60), (62, 1422, 68), "marble_white")
    world.add(rose(80, "window_a"), (0, NORTH, 208))
    world.add(candles(6, 12, 80), (-36, 1396, 68))
    world.add(candles(6, 12, 81), (36, 1396, 68))
    part.cylinder((0, 1396), 8, 68, 96, "crystal_gold", sides=6, top_radius=3)


def well(world: Map) -> None:
    """A shaft down to the flooded crypt; its rim is low enough to climb over."""
    x0, x1, y0, y1 = WELL
    part = world.detail
    for lo, hi in (((x0 - 12, y0 - 12), (x1 + 12, y0)), ((x0 - 12, y1), (x1 + 12, y1 + 12)), ((x0 - 12, y0), (x0, y1)),
                   ((x1, y0), (x1 + 12, y1))):
        part.box((*lo, 0), (*hi, 14), "stone_trim")
    # Crystals from below on its corners: what shines down there is worth a look.
    for x in (x0 - 6, x1 + 6):
        for y in (y0 - 6, y1 + 6):
            part.cylinder((x, y), 5, 14, 34, "crystal_blue", sides=6, top_radius=2)


def library(world: Map) -> None:
    part = world.detail
    for y0, y1 in ((1216, 1288), (1352, 1430)):
        part.box((-X, y0, 0), (-X + 20, y1, 120), {"all": "wood_beam", "east": fit("bookshelf", (1, 1))})
    shelf = world.part("func_door", angle=-2, lip=-1, speed=50, sounds=1, wait=-1, targetname="shelf")
    shelf.box((-X - 24, 1288, 0), (-X - 4, 1352, 112), fit("bookshelf"))
    trigger(world, "once", (-X, 1292, 0), (-X + 40, 1348, 80), target="shelf")
    world.add(candles(5, 10, 83), (-X - 100, 1270, 0))
    world.add(slipgate(64, 104, "copper_plate", "rune_a"), (-X - 196, 1320, 0), turn=90)
    world.part("func_illusionary").box((-X - 198, 1288, 0), (-X - 194, 1352, 104), "*teleport")
    trigger(world, "teleport", (-X - 204, 1288, 0), (-X - 194, 1352, 100), target="court")
    world.entity("info_teleport_destination", (0, -560, 28), angle=90, targetname="court")
    secret(world, (-X - 150, 1256, 0), (-X - 70, 1384, 80))


def people(world: Map) -> None:
    world.entity("info_player_deathmatch", (-240, 1240, 28), angle=300)
    world.entity("info_player_deathmatch", (-X - 110, 1360, 28), angle=0)
    world.entity("info_intermission", (250, 890, 250), mangle=(22, 118, 0))
    monster(world, "knight", 80, 1240, 0, 270)
    monster(world, "zombie", -160, 1240, 0, 300)
    monster(world, "zombie", 200, 1021, 0, 200)
    monster(world, "zombie", -200, 1021, 0, 20, skill=1)
    monster(world, "hell_knight", -60, 1245, 0, 270)
    monster(world, "shalrath", 0, 1300, 24, 270, skill=2)
    monster(world, "tarbaby", -52, 950, 0, 90, skill=2)
    item(world, "weapon_grenadelauncher", -120, 1260, 0)
    item(world, "rockets", -80, 1230, 0)
    item(world, "health", 250, 900, 0)
    item(world, "shells", -250, 900, 0)
    item(world, "armor2", -X - 110, 1320, 0)
    item(world, "weapon_lightning", -X - 140, 1370, 0)
    item(world, "cells", -X - 90, 1275, 0)
