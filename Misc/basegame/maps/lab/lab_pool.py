"""Under water: a drowned bath seen from its ground. The sun comes through round holes in the vault and then through the surface,
which swings and holds back a part of it; what is above is seen through the same surface, between fish and weeds."""

from kit import Group, Map, Tex
from kit.brush import polyhedron
from scene_parts import furnish, lathe, stand

GROUND, VAULT = -256, 128  # the surface is at 0
OCULUS = (150, 0)
COLUMN = [(0, 30), (14, 30), (22, 21), (340, 18), (356, 28), (384, 34)]


def boat() -> Group:
    """Its water line is at 0, its bow east."""
    rim = [(-58, 0), (-40, 21), (24, 21), (66, 0), (24, -21), (-40, -21)]

    def outline(part: float, z: float) -> list[tuple[float, float, float]]:
        return [(x * part, y * part, z) for x, y in rim]

    group = Group()
    for low, high, texture in ((outline(0.5, -22), outline(1.0, 8), "wood_plank"), (outline(1.04, 8), outline(1.04, 12), "wood_beam")):
        sides = [[low[k], low[(k + 1) % 6], high[(k + 1) % 6], high[k]] for k in range(6)]
        group.detail.brush(polyhedron([low, high] + sides, texture))
    for side in (-1, 1):  # oars
        ends = [[(0.0, side * 18.0 + d, 12.0 + u) for d, u in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
                [(-26.0, side * 58.0 + d, -24.0 + u) for d, u in ((-1, -1), (1, -1), (1, 1), (-1, 1))]]
        sides = [[ends[0][k], ends[0][(k + 1) % 4], ends[1][(k + 1) % 4], ends[1][k]] for k in range(4)]
        group.detail.brush(polyhedron(ends + sides, "wood_beam"))
    return group


def weed(height: float) -> Group:
    """Two sheets of leaves, one through the other."""
    leaves = Tex("{vine", turn=2)
    group = Group()
    group.detail.box((-16, -1, 0), (16, 1, height), leaves)
    group.detail.box((-1, -16, 0), (1, 16, height - 10), leaves)
    return group


def bath(world: Map) -> None:
    """Walls, the vault's holes with the sky behind them, steps out of the water, the water."""
    world.room((-448, -288, GROUND), (448, 288, VAULT), {"side": "tile_teal", "bottom": "tile_white", "top": "stone_b"})
    x0, y0 = OCULUS
    holes = [(x0, y0, 100)] + [(x, y, 22) for x in (-300, -140, 20) for y in (-170, 0, 170)] + [(x0, y, 22) for y in (-200, 200)]
    for x, y, half in holes:
        world.cut((x - half, y - half, VAULT), (x + half, y + half, VAULT + 16))
    world.box((-464, -304, VAULT + 16), (464, 304, VAULT + 32), "sky_night")
    world.detail.ring(OCULUS, 94, 146, VAULT - 8, VAULT, "copper_trim", sides=16)
    world.detail.stairs((256, -128, GROUND), (448, 128, 24), "marble_white", "+x", steps=16)
    for y in (-148, 128):
        world.detail.box((250, y, GROUND), (448, y + 20, 44), {"all": "tile_teal", "top": "stone_trim"})
    for y0, y1 in ((-288, -284), (284, 288)):  # where the water stands
        world.detail.box((-448, y0, -6), (448, y1, 8), "stone_trim")
    world.box((-448, -288, GROUND), (448, 288, 0), "*water_a")


def build() -> Map:
    world = Map("The bath", _wateralpha=0.5, _sunlight=1400, _sun_mangle=(172, -62, 0), _sunlight_color="0.3 0.85 0.95",
                _sunlight_penumbra=9, _sunlight2=150)
    bath(world)
    things = Group()
    for x in (-210, -20, 170):
        for y in (-190, 190):
            if (x, y) != (-20, -190):
                things.add(lathe(COLUMN, "marble_white", 10), (x, y, GROUND))
    # One has fallen.
    things.add(lathe(COLUMN[:3] + [(90, 20), (96, 0)], "marble_white", 10), (-20, -190, GROUND))
    world.detail.cylinder((-120, GROUND + 18), 19, 10, 150, "marble_white", sides=10, axis="x")
    for x, y, wide in ((-160, 60, 110), (60, -120, 130), (120, 120, 90), (-330, 150, 100)):
        things.add(lathe([(0, wide), (10, wide * 0.6), (18, 0)], "dirt", 10), (x, y, GROUND))
    for x, y, wide in ((-170, 96, 34), (-136, 120, 22), (40, -150, 30), (150, 140, 40), (-90, -236, 36)):
        things.add(lathe([(0, wide), (round(wide * 0.8), wide * 0.8), (round(wide * 1.3), 0)], "moss_stone", 6),
                   (x, y, GROUND))
    things.add(lathe([(0, 10), (4, 11), (12, 5), (24, 16), (44, 21), (60, 13), (66, 9), (74, 14)], "copper_plate", 14),
               (90, -20, GROUND))
    things.add(boat(), (-30, 24, 0), turn=28)
    furnish(world, things)
    weeds = Group()
    for k, (x, y, height) in enumerate(((-196, 130, 150), (-150, 66, 120), (-120, 150, 180), (-110, 90, 84), (20, -124, 140), (66, -170, 190),
                                        (90, -96, 90), (112, 150, 160), (170, 120, 110), (-262, -190, 120), (-280, 176, 200))):
        weeds.add(weed(height), (x, y, GROUND + 2), turn=37 * k)
    weeds.detail.box((-20, 23, GROUND), (-4, 24, -20), "{chain")
    furnish(world, weeds, solid=False)
    fish(world)
    stand(world, -410, -70, GROUND + 30, 6)
    return world


def fish(world: Map) -> None:
    """A shoal that swims in a ring, and four that stand; air from cracks in the ground."""
    ring = ((100, 90, -120), (-40, 140, -120), (-100, 20, -120), (-20, -110, -120), (110, -60, -120))
    for k, place in enumerate(ring):
        world.entity("path_corner", place, targetname=f"way{k}", target=f"way{(k + 1) % len(ring)}")
    # They look away from who begins, lest they hunt him.
    for place, angle, corner in (((-70, -96, -120), 10, 4), ((-20, -112, -120), 0, 4), ((40, -90, -120), 20, 4), ((112, 0, -120), 90, 0)):
        world.entity("monster_fish", place, angle=angle, target=f"way{corner}")
    for place, angle in (((-50, -52, -132), 285), ((-70, 34, -186), 75), ((-150, -40, -84), 290), ((70, 40, -56), 80)):
        world.entity("monster_fish", place, angle=angle)
    for x, y, heights in ((-190, 10, (-240, -170)), (-60, -120, (-240, -140)), (30, 110, (-240, -150))):
        for z in heights:
            world.entity("air_bubbles", (x, y, z))
