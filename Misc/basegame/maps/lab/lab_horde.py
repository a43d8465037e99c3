"""An arena full of monsters: more moving models, shots and blood in one view than a level would have. What the renderer must
bear is that most of what it learnt of last frame has moved."""

import math

from kit import Group, Map
from scene_parts import furnish, lathe, stand

# Rows from the player's steps to the far wall: y, how far apart (units), what stands there.
ROWS = (
    (-340, 58, "dog knight zombie army knight dog"),
    (-288, 62, "knight army dog knight zombie knight army"),
    (-226, 76, "demon1 knight ogre army ogre demon1"),
    (-156, 64, "army enforcer knight hell_knight army enforcer army"),
    (-84, 84, "ogre hell_knight shambler demon1 ogre"),
    (0, 84, "ogre enforcer hell_knight enforcer hell_knight ogre"),
    (110, 110, "shambler demon1 demon1 shambler"),
)
FLYING = ((-170, -190, 90), (-80, -80, 130), (60, -130, 104), (150, -210, 120), (210, 10, 150), (-20, 60, 170))


def arena(world: Map) -> Group:
    """Ground, sky and wall; the wall's pillars carry fire."""
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
    return wall


def build() -> Map:
    world = Map("The horde", _sunlight=420, _sun_mangle=(58, -36, 0), _sunlight_color="1 0.72 0.46", _sunlight_penumbra=9,
                _sunlight2=60)
    furnish(world, arena(world))
    for x, y in ((-310, 0), (310, 0)):  # two basins of lava
        world.box((x - 48, y - 96, -31), (x + 48, y + 96, -20), "*lava_a")
        for lo, hi in (((x - 64, y - 112), (x - 48, y + 112)), ((x + 48, y - 112), (x + 64, y + 112)),
                       ((x - 48, y - 112), (x + 48, y - 96)), ((x - 48, y + 96), (x + 48, y + 112))):
            world.detail.box((*lo, -32), (*hi, -8), "stone_trim")
    world.detail.stairs((-96, -416, -32), (96, -368, 0), "stone_trim", "-y", steps=4)
    world.detail.box((-96, -548, -32), (96, -416, 0), "stone_trim")
    for row, (y, apart, text) in enumerate(ROWS):
        bodies = text.split()
        for k, body in enumerate(bodies):
            x = round((k - (len(bodies) - 1) / 2) * apart + 10 * math.sin(7 * row + 3 * k))
            world.entity(f"monster_{body}", (x, y + round(10 * math.cos(5 * row + 2 * k)), 1), angle=270)
    for place in FLYING:
        world.entity("monster_wizard", place, angle=270)
    world.entity("weapon_rocketlauncher", (0, -500, 8))
    world.entity("item_rockets", (32, -500, 8), spawnflags=1)
    stand(world, 0, -470, 0, 90)
    return world
