"""A furnace: every texel of a closed hall glows with the same radiance e and reflects the same share a of light, so that
whatever one looks at has radiance e (1 + a + a^2 + ...), one term a reflection. A hall's shape must not be seen."""

from kit import Group, Map
from scene_parts import furnish, lathe, stand, torus

GLOW = "lab_light_warm"  # colour a; e is a times what fullbright texels emit


def build() -> Map:
    world = Map("Furnace")
    things = Group()
    world.room((-256, -256, 0), (256, 256, 256), GLOW)
    for x in (-160, 160):
        for y in (-160, 160):
            things.add(lathe([(0, 32), (24, 24), (200, 20), (256, 36)], GLOW, 12), (x, y, 0))
    world.detail.stairs((-64, 64, 0), (64, 192, 64), GLOW, "+y")
    things.add(torus(40, 14, GLOW), (0, 0, 96))
    furnish(world, things)
    stand(world, 0, -200, 0, 90)
    return world
