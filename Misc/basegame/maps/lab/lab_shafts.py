"""Shafts of light: the sun enters a chapel through slits high above, and fog shows the way. The sun is a disc of two degrees, behind
slits, that lights a few spots."""

from kit import Group, Map, Tex
from scene_parts import candle, furnish, lathe, stand


def build() -> Map:
    world = Map("Shafts of light", fog="0.03 0.75 0.8 0.85", _sunlight=420, _sun_mangle=(152, -40, 0),
                _sunlight_color="1 0.86 0.62", _sunlight_penumbra=9, _sunlight2=30)
    things = Group()
    world.room((-224, -416, 0), (224, 416, 352), {"side": "stone_b", "bottom": "stone_floor", "top": "wood_plank"})
    # Sky beyond the sunny wall and above.
    world.room((240, -512, -16), (416, 512, 640), {"all": "sky_dusk", "side": "sky_dusk"}, wall=16)
    for y in (-320, -192, -64, 64, 192, 320):
        world.cut((224, y - 20, 176), (256, y + 20, 304))
        world.detail.arch((224, y - 20, 272), (240, y + 20, 304), "stone_b", axis="x", pointed=True)
        world.detail.box((230, y - 2, 176), (234, y + 2, 304), "metal_trim")
        for side in (-1, 1):
            world.detail.box((216 if side > 0 else -224, y + 52, 0), (224 if side > 0 else -216, y + 76, 352), "stone_trim")
    for y in (-256, -128, 0, 128, 256):
        world.detail.arch((-216, y - 10, 240), (216, y + 10, 352), "wood_beam", axis="y", segments=10)
    # Pews, an altar, a broken pillar.
    for y in range(-260, 120, 84):
        for x0, x1 in ((-176, -40), (40, 176)):
            world.detail.box((x0, y, 20), (x1, y + 22, 24), "wood_plank")
            world.detail.box((x0, y - 4, 0), (x1, y, 48), "wood_plank")
            for x in (x0 + 4, x1 - 8):
                world.detail.box((x, y, 0), (x + 4, y + 20, 20), "wood_beam")
    world.detail.stairs((-160, 224, 0), (160, 272, 24), "stone_trim", "+y", steps=3)
    world.detail.box((-160, 272, 0), (160, 416, 24), "stone_floor")
    world.detail.box((-72, 320, 24), (72, 356, 64), {"all": "marble_white", "top": "marble_black"})
    for x in (-56, 52):
        things.add(candle(18, 2.5), (x, 338, 64))
    world.detail.box((-28, 408, 96), (28, 416, 208), Tex("window_a", align="fit"))
    things.add(lathe([(0, 26), (8, 26), (12, 18), (60, 17)], "marble_white", 12), (-120, 190, 0))
    furnish(world, things)
    stand(world, -6, -376, 0, 86)
    return world
