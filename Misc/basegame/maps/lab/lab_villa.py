"""A villa under the evening sky: a court in the sun's last light, rooms behind arches that only the sky and the court's walls
light. From bright outdoors into dark rooms in one view."""

from kit import Group, Map, fit
from scene_parts import candle, furnish, lantern, lathe, stand


def build() -> Map:
    world = Map("The villa", _sunlight=260, _sun_mangle=(64, -38, 0), _sunlight_color="1 0.72 0.45", _sunlight_penumbra=8,
                _sunlight2=70)
    things = Group()
    # Ground and sky round everything.
    world.room((-640, -576, -16), (640, 640, 640), {"side": "sky_dusk", "top": "sky_dusk", "bottom": "dirt"})
    world.detail.box((-448, -320, -16), (448, 416, 0), "stone_floor")
    world.detail.box((-224, -224, 0), (224, 96, 1), "tile_check")
    # Two wings and the house, each a hollow block with arches towards the court.
    for side in (-1, 1):
        x0, x1 = sorted((side * 240, side * 432))
        near = side * 240
        house = Group().box((x0, -304, 0), (x1, 400, 176), {"all": "plaster", "bottom": "tile_teal"})
        house.cut((x0 + 16, -288, 0), (x1 - 16, 384, 160))
        for y in (-208, -48, 112):
            house.cut((min(near, near + side * 16), y - 48, 0), (max(near, near + side * 16), y + 48, 144))
        world.detail.brush(*house.brushes)
        for y in (-208, -48, 112):
            world.detail.arch((min(near, near + side * 16), y - 48, 96), (max(near, near + side * 16), y + 48, 144), "plaster",
                              axis="x")
            things.add(lathe([(0, 13), (5, 13), (9, 8), (84, 7), (92, 11), (96, 13)], "marble_white", 10),
                       (near - side * 10, y + 80, 0))
        world.detail.wedge((min(x0, x1) - 16, -320, 176), (max(x0, x1) + 16, 416, 240), "brick_red", "+x" if side > 0 else "-x")
    house = Group().box((-240, 224, 0), (240, 400, 240), "plaster")
    house.cut((-224, 240, 0), (224, 384, 128)).cut((-224, 240, 140), (224, 384, 228))
    for x in (-136, 0, 136):
        house.cut((x - 40, 224, 0), (x + 40, 240, 112)).cut((x - 24, 224, 156), (x + 24, 240, 212))
    world.detail.brush(*house.brushes)
    for x in (-136, 0, 136):
        world.detail.arch((x - 40, 224, 72), (x + 40, 240, 112), "plaster", axis="y")
        world.detail.box((x - 30, 218, 150), (x + 30, 224, 156), "stone_trim")
        things.add(lantern("lab_light_warm", 6), (x + 68, 214, 104))
    world.detail.box((-256, 208, 240), (256, 416, 252), "brick_red")
    world.detail.box((-240, 216, 128), (240, 224, 136), "stone_trim")
    # The fountain, cypresses in pots, a bench and a table.
    things.add(lathe([(0, 72), (20, 72), (20, 64)], "stone_trim", 16), (0, -40, 0))
    things.add(lathe([(20, 12), (48, 8), (56, 28), (60, 32), (62, 28)], "marble_white", 14), (0, -40, 0))
    for x, y in ((-180, -190), (180, -190), (-180, 180), (180, 180)):
        things.add(lathe([(0, 14), (26, 20), (30, 22), (32, 18)], "brick_red", 10), (x, y, 0))
        things.add(lathe([(32, 10), (50, 20), (110, 15), (160, 0)], "moss_stone", 9), (x, y, 0))
    world.detail.box((-330, -60, 30), (-290, 20, 34), "wood_plank")
    for y in (-56, 12):
        world.detail.box((-326, y, 0), (-294, y + 4, 30), "wood_beam")
    things.add(candle(12, 2.5), (-310, -20, 34))
    world.detail.box((-420, -100, 0), (-414, 60, 120), fit("bookshelf", (2, 1)))
    furnish(world, things)
    stand(world, -372, -150, 0, 34)
    return world
