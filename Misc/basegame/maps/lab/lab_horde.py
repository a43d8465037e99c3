"""An arena full of monsters: more moving models, shots and blood in one view than a level would have. What the renderer must
bear is that most of what it learnt of last frame has moved."""

import math

from kit import Group, Map
from scene_parts import furnish, lathe, stand

RING = ("monster_army", "monster_dog", "monster_knight", "monster_ogre", "monster_army", "monster_demon1", "monster_knight",
        "monster_zombie")


def build() -> Map:
    world = Map("The horde", _sunlight2=60)
    sides, inner = 12, 560
    world.room((-720, -720, -32), (720, 720, 512), {"side": "sky_dusk", "top": "sky_dusk", "bottom": "cobble"})
    wall = Group()
    wall.detail.ring((0, 0), inner, inner + 64, -32, 176, {"all": "stone_a", "top": "stone_trim"}, sides=sides)
    wall.detail.ring((0, 0), inner - 12, inner, -32, -8, "stone_trim", sides=sides)
    for k in range(sides):
        angle = 2 * math.pi * k / sides
        at = (round((inner - 10) * math.cos(angle)), round((inner - 10) * math.sin(angle)), -32)
        wall.add(lathe([(0, 28), (16, 28), (24, 20), (208, 18), (220, 30), (232, 30)], "stone_b", 8), at)
        wall.add(lathe([(232, 8), (244, 22), (252, 24)], "copper_plate", 8), at)
        wall.add(lathe([(248, 16), (268, 12), (288, 0)], "light_warm", 6), at)
    furnish(world, wall)
    for x, y in ((-260, 0), (260, 0)):  # two basins of lava
        world.box((x - 48, y - 96, -31), (x + 48, y + 96, -20), "*lava_a")
        for lo, hi in (((x - 64, y - 112), (x - 48, y + 112)), ((x + 48, y - 112), (x + 64, y + 112)),
                       ((x - 48, y - 112), (x + 48, y - 96)), ((x - 48, y + 96), (x + 48, y + 112))):
            world.detail.box((*lo, -32), (*hi, -8), "stone_trim")
    world.detail.stairs((-96, -416, -32), (96, -320, 0), "stone_trim", "-y", steps=4)
    world.detail.box((-96, -548, -32), (96, -416, 0), "stone_trim")
    for ring, (radius, count) in enumerate(((200, 8), (330, 14), (440, 18))):
        for k in range(count):
            angle = 2 * math.pi * (k + 0.5 * (ring % 2)) / count
            x, y = round(radius * math.cos(angle)), round(radius * math.sin(angle))
            if (abs(abs(x) - 260) < 100 and abs(y) < 150) or (abs(x) < 150 and y < -270):
                continue
            world.entity(RING[(k + 3 * ring) % len(RING)], (x, y, 1), angle=round(math.degrees(angle) + 90) % 360)
    world.entity("weapon_rocketlauncher", (0, -500, 8))
    world.entity("item_rockets", (32, -500, 8), spawnflags=1)
    stand(world, 0, -480, 0, 90)
    return world
