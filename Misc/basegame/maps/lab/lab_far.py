"""A small temple 29,000 units from the origin, where neighbouring floats are 1/512 of a unit apart: whatever adds a small
offset to a place in the world shows it here. Demos of it need protocol 999."""

from kit import Group, Map, fit
from scene_parts import candle, furnish, lathe, stand

FAR = (29000, -29000, 28000)


def temple() -> tuple[Group, Group]:
    hall, things = Group(), Group()
    hall.room((-224, -288, 0), (224, 288, 224), {"side": "stone_b", "bottom": "tile_teal", "top": "stone_a"})
    for y in (-192, -64, 64, 192):
        for x in (-128, 128):
            things.add(lathe([(0, 24), (8, 24), (14, 16), (160, 15), (172, 22), (184, 26)], "copper_plate", 12), (x, y, 0))
        hall.detail.box((-224, y - 12, 184), (224, y + 12, 224), "stone_trim")
    hall.detail.stairs((-96, 128, 0), (96, 176, 24), "marble_white", "+y", steps=3)
    hall.detail.box((-96, 176, 0), (96, 288, 24), "marble_white")
    things.add(lathe([(0, 30), (6, 30), (12, 18), (48, 14), (56, 26), (64, 30), (66, 24)], "marble_black", 16), (0, 224, 24))
    things.add(lathe([(70, 0), (84, 12), (104, 14), (128, 0)], "crystal_blue", 6), (0, 224, 24))
    for x in (-40, 36):
        hall.detail.box((x, -120, 220), (x + 4, 120, 224), "lab_light")
    for k in range(6):
        things.add(candle(10 + 4 * (k % 3), 2), (-75 + 30 * k, 152 if k in (2, 3) else 190, 16 if k in (2, 3) else 24))
    hall.detail.box((-40, -240, 0), (40, 128, 1), fit("carpet_red", (1, 4)))
    return hall, things


def build() -> Map:
    world = Map("Far out", limit=32000)
    hall, things = temple()
    world.add(hall, FAR)
    furnish(world, Group().add(things, FAR))
    stand(world, FAR[0] - 60, FAR[1] - 250, FAR[2], 76)
    return world
