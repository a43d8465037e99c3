"""A dark corridor with a bend, lit by small lamps far apart. A rocket flies through it: a small light at a thousand units a
second, with smoke behind it. The weapon lies at the start."""

from kit import Group, Map, Tex
from scene_parts import furnish, lantern, stand

HALF, HIGH = 80, 144


def rib(width: float) -> Group:
    """A frame round a corridor that runs along y."""
    group = Group()
    for x in (-width, width - 12):
        group.detail.box((x, -8, 0), (x + 12, 8, HIGH), Tex("metal_trim", turn=1))
    group.detail.box((-width, -8, HIGH - 12), (width, 8, HIGH), "metal_trim")
    group.detail.box((-width, -6, 0), (width, 6, 2), "metal_trim")
    return group


def build() -> Map:
    world = Map("The corridor")
    walls = {"side": "brick_red", "bottom": "metal_floor", "top": "metal_plate"}
    world.room((-HALF, -256, 0), (HALF, 768, HIGH), walls)
    world.room((HALF + 16, 608, 0), (832, 768, HIGH), walls)
    world.cut((HALF, 608, 0), (HALF + 16, 768, HIGH))
    for y in range(-192, 600, 128):
        world.add(rib(HALF), (0, y, 0))
    for x in range(192, 800, 128):
        world.add(rib(HALF), (x, 688, 0), turn=90)
    things = Group()
    for x in (-HALF, HALF - 10):  # pipes along the walls
        world.detail.box((x, -256, 88), (x + 10, 600, 98), "copper_plate")
        world.detail.box((x + (0 if x < 0 else 4), -256, 104), (x + (6 if x < 0 else 10), 600, 110), "metal_rust")
    for at, glow in (((-HALF + 6, 0, 120), "lab_light_dim"), ((HALF - 6, 448, 120), "lab_light_dim"),
                     ((560, 768 - 6, 120), "light_red")):
        things.add(lantern(glow, 5), at)
    world.detail.box((30, 330, 0), (78, 378, 48), "crate_a")
    world.detail.box((-78, 470, 0), (-30, 518, 48), "crate_b")
    world.detail.box((-78, 474, 48), (-38, 514, 88), "crate_a")
    furnish(world, things)
    world.entity("weapon_rocketlauncher", (0, -100, 8))
    world.entity("item_rockets", (24, -100, 8), spawnflags=1)
    stand(world, 0, -132, 0, 90)
    return world
