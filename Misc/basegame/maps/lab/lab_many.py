"""Hundreds of lamps of one size and brightness in a pillared cistern: no few directions hold them, and none is worth more than
another. Shared states that each know one light are too few. Shallow water doubles them."""

import math

from kit import Group, Map
from scene_parts import furnish, lathe, stand

LAMP = "lab_light_warm"


def build() -> Map:
    world = Map("Four hundred lamps")
    world.room((-512, -512, -16), (512, 512, 288), {"side": "brick_dark", "bottom": "marble_black", "top": "stone_b"})
    world.box((-512, -512, -16), (512, 512, -4), "*water_a")  # mirrors them
    pillars, lamps = Group(), Group()
    for x in range(-384, 385, 256):
        for y in range(-384, 385, 256):
            pillars.add(lathe([(0, 34), (10, 34), (18, 24), (220, 20), (240, 34), (256, 44), (272, 60)], "marble_white", 10),
                      (x, y, -16))
    count = 0
    for i in range(20):  # a dome of strings: the lamps lie on a wave
        for j in range(20):
            x, y = -475 + 50 * i, -475 + 50 * j
            z = 128 + 44 * math.sin(x / 120.0) * math.cos(y / 140.0) + 22 * math.sin(0.9 * i * j)
            x, y, z = x + 8 * (j % 3) - 8, y + 8 * (i % 3) - 8, round(z)
            lamps.detail.box((x, y, z), (x + 4, y + 4, z + 5), LAMP)
            count += 1
    assert count == 400
    furnish(world, lamps, solid=False)
    pillars.add(lathe([(0, 96), (8, 96), (8, 88), (16, 88)], "stone_trim", 16), (0, 0, -16))
    pillars.add(lathe([(0, 20), (40, 12), (48, 30), (60, 34), (62, 30)], "copper_plate", 16), (0, 0, 0))
    furnish(world, pillars)
    stand(world, -36, -430, -16, 86)
    return world
