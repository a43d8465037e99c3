"""The flooded crypt under the chapel's well, and the cistern: rows of columns in deep water, an island with the gold key, a
ledge with the button of the hall's door. Secret: a niche at the bottom."""

from __future__ import annotations

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import hanging_lamp, pillar

WEST, EAST, SOUTH, NORTH, TOP, BED, WATER = 544, 1248, 128, 896, 176, -352, -40
WELL = (160, 256, 1296, 1392)
TUNNEL_TOP, TUNNEL_BED = -192, -320
ISLAND = (832, 976, 480, 624)
COLUMNS_X, COLUMNS_Y = (720, 896, 1072), (240, 416, 592, 768)


def rooms(walls: Group) -> None:
    x0, x1, y0, y1 = WELL
    tunnel = {"side": "rock_a", "bottom": "rock_b", "top": "rock_a"}
    walls.room((x0, y0, TUNNEL_BED), (x1, y1, -32), {"side": "brick_dark", "bottom": "rock_b", "top": "stone_a"}, wall=32)
    walls.room((x1 + 32, y0, TUNNEL_BED), (704, y1, TUNNEL_TOP), tunnel, wall=32)
    walls.room((608, NORTH + 32, TUNNEL_BED), (704, y0 - 32, TUNNEL_TOP), tunnel, wall=32)
    walls.room((WEST, SOUTH, BED), (EAST, NORTH, TOP), {"side": "tile_teal", "bottom": "tile_teal", "top": "brick_dark"},
               wall=32)
    walls.room((EAST + 32, 160, BED), (EAST + 128, 256, BED + 96), "rock_a")


def openings(walls: Group) -> None:
    x0, x1, y0, y1 = WELL
    walls.cut((x1, y0, TUNNEL_BED), (x1 + 32, y1, TUNNEL_TOP))
    walls.cut((608, y0 - 32, TUNNEL_BED), (704, y0, TUNNEL_TOP))
    walls.cut((608, NORTH, TUNNEL_BED), (704, NORTH + 32, TUNNEL_TOP))
    walls.cut((448, 192, 0), (WEST, 288, 128))
    walls.cut((EAST, 176, BED), (EAST + 32, 240, BED + 80))


def furnish(world: Map) -> None:
    x0, x1, y0, y1 = WELL
    world.box((x0, y0, TUNNEL_BED), (x1, y1, -60), "*water_a")
    world.box((x1, y0, TUNNEL_BED), (704, y1, TUNNEL_TOP), "*water_a")
    world.box((608, NORTH, TUNNEL_BED), (704, y0, TUNNEL_TOP), "*water_a")
    world.box((WEST, SOUTH, BED), (EAST, NORTH, WATER), "*water_a")
    world.box((EAST, 160, BED), (EAST + 128, 256, BED + 96), "*water_a")
    part = world.detail
    # The passage to the hall.
    world.box((480, 160, -16), (WEST - 32, 192, 144), "stone_b")
    world.box((480, 288, -16), (WEST - 32, 320, 144), "stone_b")
    world.box((480, 192, 128), (WEST - 32, 288, 144), "stone_b")
    world.box((480, 192, -16), (WEST - 32, 288, 0), "stone_floor")
    # The ledge in the west with stairs down into the water.
    part.box((WEST, 144, -32), (640, 560, 0), {"all": "stone_trim", "top": "stone_floor"})
    for y in (176, 336, 512):
        part.box((WEST, y, BED), (584, y + 32, -32), "stone_a")
    part.stairs((WEST, 560, -96), (640, 656, 0), {"all": "stone_trim", "top": "stone_floor"}, "-y", steps=12)
    island(world)
    columns(world)
    button = world.part("func_button", angle=180, target="cistern_door", speed=40, wait=-1, lip=2,
                        message="The iron door to the sluice hall is open")
    button.box((WEST, 304, 40), (WEST + 8, 336, 72), {"all": "metal_trim", "east": fit("+0button")})
    part.box((WEST, 296, 28), (WEST + 5, 344, 40), "copper_trim")
    part.box((WEST, 296, 72), (WEST + 5, 344, 84), "copper_trim")
    for x, y, z in ((300, y0 + 20, TUNNEL_BED), (520, y1 - 20, TUNNEL_BED), (618, 1100, TUNNEL_BED), (694, 940, TUNNEL_BED),
                    (230, y0 + 24, TUNNEL_BED)):
        part.cylinder((x, y), 9, z, z + 30, "crystal_blue", sides=6, top_radius=3)
    for x, y in ((620, 820), (1180, 200), (1190, 820), (800, 330), (1000, 700), (640, 240)):
        part.cylinder((x, y), 16, BED, BED + 64, "crystal_blue", sides=6, top_radius=8)
        part.cylinder((x, y), 8, BED + 64, BED + 80, "crystal_blue", sides=6, top_radius=0)
    secret(world, (EAST + 32, 160, BED), (EAST + 120, 256, BED + 80))


def island(world: Map) -> None:
    x0, x1, y0, y1 = ISLAND
    part = world.detail
    part.box((x0, y0, BED), (x1, y1, -28), {"all": "stone_a", "top": "tile_check"})
    for lo, hi in (((x0 - 24, y0 - 24), (x1 + 24, y0)), ((x0 - 24, y1), (x1 + 24, y1 + 24)), ((x0 - 24, y0), (x0, y1)),
                   ((x1, y0), (x1 + 24, y1))):
        part.box((*lo, BED), (*hi, -44), {"all": "stone_a", "top": "stone_trim"})
    part.box((888, 536, -28), (920, 568, -14), {"all": "copper_plate", "top": fit("rune_b")})
    for x in (x0 + 12, x1 - 12):
        for y in (y0 + 12, y1 - 12):
            part.cylinder((x, y), 5, -28, 60, "marble_black", sides=6)
            part.cylinder((x, y), 8, 60, 72, "crystal_gold", sides=6, top_radius=2)


def columns(world: Map) -> None:
    """Columns from the bed to the vault, with arches between them."""
    part = world.detail
    for x in COLUMNS_X:
        for y in COLUMNS_Y:
            if ISLAND[0] < x < ISLAND[1] and ISLAND[2] < y < ISLAND[3]:
                continue
            part.cylinder((x, y), 18, BED, 88, "marble_white", sides=8)
            part.box((x - 26, y - 26, BED), (x + 26, y + 26, BED + 24), "stone_trim")
            part.cylinder((x, y), 18, 88, 108, "stone_trim", sides=8, top_radius=28)
            part.box((x - 28, y - 28, 108), (x + 28, y + 28, 116), "stone_trim")
    xs, ys = (WEST,) + COLUMNS_X + (EAST,), (SOUTH,) + COLUMNS_Y + (NORTH,)
    for y in COLUMNS_Y:
        for a, b in zip(xs, xs[1:]):
            part.arch((a, y - 12, 116), (b, y + 12, TOP), "brick_dark", axis="y", segments=6)
    for x in COLUMNS_X:
        for a, b in zip(ys, ys[1:]):
            part.arch((x - 12, a, 116), (x + 12, b, TOP), "brick_dark", axis="x", segments=6)
    for x, y in ((632, 328), (808, 680), (984, 328), (1160, 504), (808, 328), (984, 680)):
        world.add(hanging_lamp(56, "light_cool" if x > 900 else "lamp_round", 8), (x, y, TOP))


def people(world: Map) -> None:
    world.entity("info_player_deathmatch", (592, 460, 28), angle=0)
    world.entity("info_player_deathmatch", (950, 510, 0), angle=135)
    world.entity("info_intermission", (1220, 160, 100), mangle=(14, 132, 0))
    monster(world, "fish", 1000, 300, -200, 90)
    monster(world, "fish", 760, 760, -160, 0)
    monster(world, "fish", 1120, 640, -240, 180, skill=1)
    monster(world, "fish", 660, 1200, -290, 90, skill=2)
    monster(world, "wizard", 1100, 600, 30, 180, skill=1)
    monster(world, "enforcer", 618, 480, 0, 200)
    item(world, "key2", 904, 552, -14)
    item(world, "weapon_supernailgun", 592, 170, 0)
    item(world, "spikes", 620, 400, 0)
    item(world, "health", 600, 520, 0)
    item(world, "artifact_envirosuit", 208, 1240, 0)
    item(world, "health", EAST + 84, 210, BED, flags=2)
