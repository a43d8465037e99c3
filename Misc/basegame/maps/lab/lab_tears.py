"""A cavern that one light rules: a tear of glowing stone over a well. Most of the rock is in the shadow of other rock, and
crystals a hundredth as strong are lost beside it."""

import math
import random

from kit import Group, Map
from scene_parts import furnish, lathe, stand


def spike(chance: random.Random, height: float, radius: float, texture: str) -> Group:
    """A stalagmite: a stack of stumps, thinner upwards."""
    z, r, profile = 0.0, radius, [(0.0, radius)]
    while z < height * 0.75:
        z, r = z + height * chance.uniform(0.2, 0.34), r * chance.uniform(0.55, 0.8)
        profile.append((round(z), round(r, 1)))
    return lathe(profile + [(round(z + height * 0.22), 0)], texture, 7)


def hanging(group: Group) -> Group:
    """The same upside down, from 0 0 0 downwards."""
    from kit.brush import polyhedron

    result = Group()
    for part in group.parts:
        for brush in part.brushes:
            faces = [[(x, -y, -z) for x, y, z in face.points] for face in brush.faces]
            result.detail.brush(polyhedron(faces, brush.faces[0].tex))
    return result


def build() -> Map:
    world = Map("The tear")
    chance = random.Random(17)
    world.room((-640, -640, -96), (640, 640, 640), {"side": "rock_b", "top": "rock_a", "bottom": "rock_a"}, wall=16)
    ground, air = Group(), Group()  # rock that nobody comes near
    # Walls of leaning slabs, so that nothing is square.
    for k in range(26):
        angle = 2 * math.pi * (k + chance.uniform(-0.2, 0.2)) / 26
        r = chance.uniform(600, 690)
        at = (round(r * math.cos(angle)), round(r * math.sin(angle)), -96)
        air.add(spike(chance, chance.uniform(420, 900), chance.uniform(70, 130), chance.choice(("rock_a", "rock_b"))), at)
    for k in range(22):
        angle, r = chance.uniform(0, 2 * math.pi), 170 + 430 * math.sqrt(chance.random())
        if abs(math.degrees(angle) - 270) < 20:
            continue  # the view
        at = (round(r * math.cos(angle)), round(r * math.sin(angle)))
        ground.add(spike(chance, chance.uniform(40, 190), chance.uniform(18, 46), "rock_a"), (*at, -96))
        air.add(hanging(spike(chance, chance.uniform(60, 260), chance.uniform(20, 56), "rock_a")), (*at[::-1], 640))
    tear = Group()
    # The well, its rim, and the tear above.
    world.detail.ring((0, 0), 112, 144, -96, -72, "stone_trim", sides=24)
    world.box((-80, -80, -95), (80, 80, -80), "*water_a")
    tear.add(lathe([(40, 0), (76, 38), (116, 58), (150, 54), (200, 30), (250, 10), (300, 0)], "lab_light_warm", 12))
    for k in range(3):
        angle = math.radians(90 + 120 * k)
        x, y = round(176 * math.cos(angle)), round(176 * math.sin(angle))
        ground.add(lathe([(-96, 22), (-84, 22), (-80, 15), (40, 12), (48, 18), (56, 18)], "marble_black", 8), (x, y, 0))
        tear.add(lathe([(56, 6), (72, 4), (92, 0)], "crystal_blue", 5), (x, y, 0))
    for k in range(9):
        angle, r = chance.uniform(0, 2 * math.pi), chance.uniform(300, 480)
        at = (round(r * math.cos(angle)), round(r * math.sin(angle)), -96)
        tear.add(lathe([(0, 5), (14, 6), (26, 0)], "crystal_blue", 5), at)
    furnish(world, air, solid=False)
    furnish(world, ground)
    furnish(world, tear, solid=False)
    world.detail.stairs((-72, -512, -96), (72, -384, -32), "stone_b", "-y")
    world.detail.box((-72, -660, -96), (72, -512, -32), "stone_b")
    stand(world, 40, -470, -32, 95)
    return world
