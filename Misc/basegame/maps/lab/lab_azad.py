"""A hall of candles by night: eighty-seven flames of unlike worth among pillars, sparks in the air, and a great window whose
border glows behind a ledge, so that its light comes by way of the reveal alone."""

import math
import random

from kit import Group, Map, fit
from scene_parts import candle, furnish, lathe, stand

LENGTH, HALF, HIGH = 960, 272, 352
PILLAR = [(0, 30), (12, 30), (18, 22), (30, 20), (200, 18), (214, 26), (226, 30), (240, 30)]


def build() -> Map:
    world = Map("The hall of candles")
    chance = random.Random(8)
    pillars, lights = Group(), Group()
    world.room((-HALF, 0, 0), (HALF, LENGTH, HIGH), {"side": "stone_a", "bottom": "tile_check", "top": "stone_b"})
    for y in range(160, LENGTH, 192):
        for x in (-144, 144):
            pillars.add(lathe(PILLAR, "marble_white", 12), (x, y, 0))
            world.detail.box((x - 28, y - 28, 240), (x + 28, y + 28, 256), "stone_trim")
        world.detail.arch((-116, y - 12, 256), (116, y + 12, HIGH), "stone_b", axis="y", pointed=True, segments=10)
        world.detail.box((-HALF, y - 12, 296), (-116, y + 12, HIGH), "stone_b")
        world.detail.box((116, y - 12, 296), (HALF, y + 12, HIGH), "stone_b")
    # The window: strips behind a ledge light its reveal.
    world.box((-112, LENGTH, 64), (112, LENGTH + 16, 304), "stone_a")
    world.cut((-96, LENGTH, 72), (96, LENGTH + 16, 296))
    world.room((-96, LENGTH + 16, 72), (96, LENGTH + 64, 296), {"side": "plaster", "top": "plaster", "bottom": "plaster",
                                                               "south": "stone_a", "north": "glass_teal"}, wall=16)
    world.cut((-80, LENGTH, 88), (80, LENGTH + 32, 280))
    for x0, x1 in ((-94, -90), (90, 94)):
        world.detail.box((x0, LENGTH + 17, 76), (x1, LENGTH + 20, 292), "lab_light_dim")
    for x in (-28, 24):
        world.detail.box((x, LENGTH + 48, 72), (x + 4, LENGTH + 56, 296), "metal_trim")
    for z in (140, 212):
        world.detail.box((-96, LENGTH + 48, z), (96, LENGTH + 56, z + 4), "metal_trim")
    # The altar before it, and the carpet.
    world.detail.stairs((-128, LENGTH - 160, 0), (128, LENGTH - 112, 24), "stone_trim", "+y", steps=3)
    world.detail.box((-128, LENGTH - 112, 0), (128, LENGTH, 24), "stone_floor")
    world.detail.box((-64, LENGTH - 72, 24), (64, LENGTH - 40, 64), {"all": "marble_black", "top": "marble_white"})
    world.detail.box((-48, 64, 0), (48, LENGTH - 160, 1), fit("carpet_red", (1, 8)))
    for k in range(7):
        lights.add(candle(8 + 6 * (3 - abs(k - 3)), 2.5), (-48 + 16 * k, LENGTH - 56, 64))
    # Stands of candles at the pillars, some on the floor.
    for y in range(160, LENGTH, 192):
        for x in (-144, 144):
            inward = -x // 144
            for k in range(8):
                angle = math.radians(180 * (k + chance.uniform(0.1, 0.9)) / 8 - 90) + (math.pi if inward < 0 else 0)
                r = chance.uniform(36, 62)
                at = (round(x + r * math.cos(angle)), round(y + r * math.sin(angle)), 0)
                lights.add(candle(round(chance.uniform(6, 34)), chance.choice((1.5, 2.0, 3.0))), at)
    for _ in range(60):  # sparks
        x, y, z = (round(chance.uniform(*r)) for r in ((-200, 200), (120, LENGTH - 120), (60, 220)))
        lights.detail.box((x, y, z), (x + 1, y + 1, z + 1), "lab_light_warm")
    furnish(world, pillars)
    furnish(world, lights, solid=False)
    stand(world, -60, 72, 0, 82)
    return world
