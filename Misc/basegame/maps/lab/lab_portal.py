"""A gate that shines without being a light: strips behind its ledge light its recess, and the recess the hall. No path of one
reflection from the hall reaches a strip."""

from kit import Group, Map, fit
from scene_parts import furnish, lathe, stand


def pylon() -> Group:
    group = Group()
    group.detail.frustum((-40, -28, 0), (40, 28, 24), (-34, -22), (34, 22), "stone_trim")
    group.detail.frustum((-30, -18, 24), (30, 18, 232), (-22, -12), (22, 12), "steel_wall")
    group.detail.box((-26, -16, 232), (26, 16, 248), "copper_trim")
    return group


def build() -> Map:
    world = Map("The gate")
    things = Group()
    world.room((-352, -320, 0), (352, 320, 320), {"side": "stone_a", "bottom": "tile_check", "top": "stone_b"})
    # Ledge (16 deep), then the recess, larger by `lip` on every side; the strips stand on the ledge's back.
    half, low, high, lip, y = 128, 24, 264, 24, 320
    world.room((-half, y + 16, low), (half, y + 80, high), {"all": "plaster", "bottom": "marble_white", "north": "tile_teal"})
    world.cut((-half + lip, y, low), (half - lip, y + 16, high - lip))
    world.cut((-half + lip, y, low), (half - lip, y + 17, high - lip))
    for x0, x1 in ((-half + 1, -half + 6), (half - 6, half - 1)):
        world.detail.box((x0, y + 16, low + 8), (x1, y + 19, high - 4), "lab_light")
    world.detail.box((-half + 8, y + 16, high - 6), (half - 8, y + 19, high - 1), "lab_light")
    for x in (-half + lip - 18, half - lip + 18):
        things.add(pylon(), (x, y - 24, 0))
    world.detail.box((-half - 8, y - 32, 248), (half + 8, y, 280), {"all": "copper_trim", "south": fit("rune_a", (6, 1))})
    world.detail.stairs((-96, y - 88, 0), (96, y - 40, 24), "stone_trim", "+y", steps=3)
    world.detail.box((-96, y - 40, 0), (96, y, 24), "stone_trim")
    for x, z in ((-264, 96), (264, 96)):
        for yy in (-96, 96):
            things.add(lathe([(0, 26), (10, 26), (16, 18), (280, 18), (296, 28), (320, 28)], "stone_b", 8), (x, yy, 0))
    world.detail.box((120, 20, 0), (168, 68, 48), fit("crate_b"))
    things.add(lathe([(0, 15), (8, 17), (32, 18), (56, 17), (62, 15)], "barrel_side", 12), (-140, 90, 0))
    furnish(world, things)
    stand(world, -190, -250, 0, 68)
    return world
