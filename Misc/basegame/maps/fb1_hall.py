"""The sluice hall: the level's middle. A canal with a water wheel and a bridge, a gallery in the north that the lift goes up
to, below it the silver door, in the gallery's west the gold door, west the furnace, east the door from the cistern."""

from __future__ import annotations

import math

from kit import Group, Map, Tex, fit
from people import item, monster, secret, trigger
from pieces import balustrade, candle_stand, crates, hanging_lamp, lancet, pillar, pipe_run, sconce

X, NORTH, TOP, GALLERY = 448, 768, 448, 192
CANAL = (320, 448, -192, -40)  # south, north, bed, water
LIFT = (344, 440, 472, 568)  # x from, to, y from, to


def rooms(walls: Group) -> None:
    walls.room((-X, 0, 0), (X, NORTH, TOP), {"side": "brick_red", "bottom": "stone_floor", "top": "wood_plank"}, wall=32)
    south, north, bed, _ = CANAL
    walls.room((-X - 96, south, bed), (X + 32, north, -32), {"side": "stone_a", "bottom": "dirt", "top": "stone_a"}, wall=32)


def openings(walls: Group) -> None:
    south, north, _, _ = CANAL
    walls.cut((-X, south, -32), (X, north, 0))
    x0, x1, y0, y1 = LIFT
    walls.cut((x0, y0, -16), (x1, y1, 0))
    for x in (-256, 256):
        walls.cut((x - 56, -24, 208), (x + 56, 0, 400))
    for y in (96, 672):
        walls.cut((X, y - 40, 256), (X + 24, y + 40, 400))


def furnish(world: Map) -> None:
    south, north, bed, water = CANAL
    world.box((-X - 96, south, bed), (X + 32, north, water), "*water_a")
    canal(world)
    gallery(world)
    wheel(world, -288, 160)
    windows_and_roof(world)
    lift(world)
    doors(world)


def canal(world: Map) -> None:
    south, north, bed, water = CANAL
    part = world.detail
    for y in (south, north - 8):
        for a, b in ((-X, -64), (64, X)):
            part.box((a, y - (16 if y == south else 0), 0), (b, y + (0 if y == south else 24), 8), "stone_trim")
    # The bridge on an arch.
    world.box((-64, south, -24), (64, north, 0), {"all": "stone_trim", "top": "stone_floor", "bottom": "stone_a"})
    part.arch((-64, south, -56), (64, north, -24), "stone_trim", axis="x", segments=8)
    for side in (-1, 1):
        a, b = sorted((side * 64, side * 52))
        part.box((a, south - 16, 0), (b, north + 16, 28), "stone_trim")
    # Stairs out of the water, and lights in the depth.
    part.stairs((160, north - 56, -104), (288, north, -8), "stone_a", "+x", steps=8)
    part.box((160, north - 56, bed), (288, north, -104), "stone_a")
    for x in (-400, -60, 120, 400):
        part.cylinder((x, south + 24), 10, bed, bed + 40, "crystal_blue", sides=6, top_radius=4)
    part.box((X, south, bed), (X + 4, north, -32), "{grate")


def gallery(world: Map) -> None:
    """The gallery's floor on an arcade; its rail; the lift comes up at its east end."""
    part = world.detail
    world.box((-X, 576, GALLERY - 16), (X, NORTH, GALLERY), {"all": "stone_trim", "top": "tile_check", "bottom": "wood_plank"})
    for x in (-432, -256, -96, 96, 256, 432):
        world.add(pillar(GALLERY - 16, 14, "stone_b"), (x, 600, 0))
    for a, b in ((-432, -256), (-256, -96), (-96, 96), (96, 256), (256, 432)):
        part.arch((a + 12, 588, GALLERY - 80), (b - 12, 612, GALLERY - 16), "brick_red", axis="y", segments=8)
    world.add(balustrade(792), (-448, 582, GALLERY))
    for x in (-368, -176, 0, 176, 368):
        world.add(hanging_lamp(24, radius=9), (x, 690, GALLERY - 16))


def wheel(world: Map, x: float, radius: float) -> None:
    """An undershot wheel that stands in the canal; its axle lies on two blocks."""
    south, north, _, water = CANAL
    part = world.detail
    y, z = (south + north) / 2, water + radius - 40
    for a in (y - 40, y + 32):
        part.ring((x, z), radius - 14, radius, a, a + 8, "wood_beam", sides=16, axis="y")
        for k in range(4):
            angle = math.radians(11.25 + 45 * k)
            c, s = math.cos(angle), math.sin(angle)
            r, w = radius - 8, 5
            spoke = [(x + r * c - w * s, z + r * s + w * c), (x - r * c - w * s, z - r * s + w * c),
                     (x - r * c + w * s, z - r * s - w * c), (x + r * c + w * s, z + r * s - w * c)]
            part.prism(spoke, a + 1, a + 7, "wood_beam", axis="y")
    for k in range(16):
        angle = math.radians(22.5 * k)
        c, s = math.cos(angle), math.sin(angle)
        inner, outer, w = radius - 34, radius - 2, 2
        board = [(x + inner * c - w * s, z + inner * s + w * c), (x + outer * c - w * s, z + outer * s + w * c),
                 (x + outer * c + w * s, z + outer * s - w * c), (x + inner * c + w * s, z + inner * s - w * c)]
        part.prism(board, y - 32, y + 32, "wood_plank", axis="y")
    part.cylinder((x, z), 14, south - 40, north + 40, "metal_rust", sides=8, axis="y")
    for a in (south - 48, north + 16):
        part.box((x - 24, a, 0), (x + 24, a + 32, z + 18), "stone_b")
        part.box((x - 20, a - 2, z - 20), (x + 20, a + 34, z + 24), "metal_rivet")


def windows_and_roof(world: Map) -> None:
    part = world.detail
    for x in (-256, 256):
        world.add(lancet(112, 192, "window_b", 24), (x, 0, 208), turn=180)
    for y in (96, 672):
        world.add(lancet(80, 144, "window_a", 24), (X, y, 256), turn=-90)
    for y in (64, 256, 448, 640):
        part.box((-X, y - 16, TOP - 40), (X, y + 16, TOP), "wood_beam")
        for side in (-1, 1):
            part.prism([(side * X, TOP - 140), (side * (X - 100), TOP - 40), (side * X, TOP - 40)], y - 10, y + 10,
                       "wood_beam", axis="y")
    for x, y in ((-224, 160), (224, 160), (0, 256), (224, 480), (-224, 520)):
        world.add(hanging_lamp(120), (x, y, TOP - 40))
    for z in (300, 332):
        world.add(pipe_run(560, 9), (-X + 14, 10, z), turn=90)
    world.add(crates(8), (-380, 60, 0))
    world.add(crates(9), (404, 116, 0), turn=90)
    world.add(candle_stand(61), (-90, 730, 0))
    world.add(candle_stand(62), (90, 730, 0))
    for side in (-1, 1):
        world.add(sconce(), (side * 120, 0, 120), turn=180)


def lift(world: Map) -> None:
    """Comes down when someone steps on it, goes up with them."""
    x0, x1, y0, y1 = LIFT
    plat = world.part("func_plat", height=GALLERY, speed=120, sounds=2)
    plat.box((x0, y0, GALLERY - 16), (x1, y1, GALLERY), {"all": "metal_trim", "top": fit("metal_floor")})
    part = world.detail
    for x in (x0 - 12, x1):
        for y in (y0 - 12, y1):
            if y == y1:
                continue
            part.box((x, y, 0), (x + (12 if x < x0 else 8), y + 12, GALLERY + 96), "metal_rivet")
    part.box((x0 - 12, y0 - 12, GALLERY + 80), (X, y0, GALLERY + 96), "metal_trim")
    part.box((x0 - 4, y0 - 4, GALLERY + 96), (X, y1 + 8, GALLERY + 104), "copper_plate")


def doors(world: Map) -> None:
    part = world.detail
    # The silver door, two leaves under the gallery.
    for side in (-1, 1):
        a, b = sorted((0, side * 56))
        leaf = world.part("func_door", angle=180 if side < 0 else 0, spawnflags=16, speed=80, lip=4, sounds=1, wait=-1)
        leaf.box((a, NORTH + 8, 0), (b, NORTH + 24, 128), fit("door_silver"))
        part.box((side * 56 - (16 if side < 0 else 0), NORTH - 12, 0), (side * 56 + (16 if side > 0 else 0), NORTH, 144),
                 "marble_white")
    part.box((-76, NORTH - 14, 144), (76, NORTH, 160), "marble_white")
    # The gold door in the gallery's west.
    gold = world.part("func_door", angle=-1, spawnflags=8, speed=100, lip=8, sounds=1, wait=-1)
    gold.box((-X - 24, 632, GALLERY), (-X - 8, 728, GALLERY + 128), fit("door_gold"))
    for y in (616, 728):
        part.box((-X, y, GALLERY), (-X + 12, y + 16, GALLERY + 144), "marble_black")
    part.box((-X, 612, GALLERY + 144), (-X + 14, 748, GALLERY + 160), "marble_black")
    # The cistern's door opens from within.
    iron = world.part("func_door", angle=-1, targetname="cistern_door", speed=90, lip=8, sounds=2, wait=-1,
                      message="It opens from the other side")
    iron.box((X + 8, 192, 0), (X + 24, 288, 128), fit("door_iron"))
    for y in (180, 288):
        part.box((X - 10, y, 0), (X, y + 12, 140), "metal_rivet")
    part.box((X - 12, 176, 140), (X, 304, 152), "metal_trim")


def people(world: Map) -> None:
    for x, y, angle in ((-400, 240, 0), (400, 60, 135), (-400, 720, 315)):
        world.entity("info_player_deathmatch", (x, y, 28), angle=angle)
    world.entity("info_player_deathmatch", (0, 700, GALLERY + 28), angle=270)
    world.entity("info_intermission", (400, 40, 330), mangle=(24, 128, 0))
    monster(world, "knight", -120, 260, 0, 270)
    monster(world, "knight", 160, 500, 0, 270)
    monster(world, "army", 300, 660, GALLERY, 250)
    monster(world, "army", -300, 660, GALLERY, 300, skill=1)
    monster(world, "wizard", 0, 520, 220, 270, skill=1)
    monster(world, "wizard", -200, 160, 240, 90, skill=2)
    monster(world, "ogre", 0, 640, GALLERY, 270, skill=2)
    item(world, "health", -380, 160, 0)
    item(world, "shells", 340, 60, 0)
    item(world, "shells", -340, 560, 0)
    item(world, "armor1", 0, 700, 0)
    item(world, "spikes", 180, 700, GALLERY)
    item(world, "health", -100, 700, GALLERY, flags=1)
    item(world, "weapon_rocketlauncher", 0, 700, GALLERY)
