"""A gate that shines without being a light, and is not lit by one either. Behind the gate's wall a niche on each side hides a
strip in a channel; the strips light the niches' walls, those the back of the recess, and that the hall. Nothing that is seen
through the gate sees a strip, so that no path of one reflection brings light."""

from kit import Group, Map
from scene_parts import furnish, lathe, stand

GATE = 320  # where the hall ends
LOW, HIGH = 24, 264  # of the recess
HALF, DEEP = 216, 120  # its half-width, and how far it reaches behind the gate's wall
FIN = 132  # where the walls begin that part the niches from the recess
CHANNEL = 28  # depth of a strip's channel


def pylon() -> Group:
    group = Group()
    group.detail.frustum((-40, -28, 0), (40, 28, 24), (-34, -22), (34, 22), "stone_trim")
    group.detail.frustum((-30, -18, 24), (30, 18, 232), (-22, -12), (22, 12), "steel_wall")
    group.detail.box((-26, -16, 232), (26, 16, 248), "copper_trim")
    return group


def niche() -> Group:
    """The eastern one, its south end at y = 0: a wall towards the recess, on whose back a channel that opens to the east."""
    group = Group()
    group.detail.box((FIN, 0, LOW), (FIN + 4, 68, HIGH), "plaster")
    east = FIN + 4 + CHANNEL
    for lo, hi in (((0, LOW + 8), (4, HIGH - 8)), ((60, LOW + 8), (68, HIGH - 8)), ((4, LOW + 8), (60, LOW + 16)),
                   ((4, HIGH - 16), (60, HIGH - 8))):
        group.detail.box((FIN + 4, lo[0], lo[1]), (east, hi[0], hi[1]), "metal_trim")
    group.detail.box((FIN + 4, 16, LOW + 28), (FIN + 8, 48, HIGH - 28), "lab_light")
    return group


def recess(world: Map) -> None:
    y = GATE + 16
    world.room((-HALF, y, LOW), (HALF, y + DEEP, HIGH), {"all": "plaster", "bottom": "marble_white", "north": "tile_teal"})
    for end in (y, y + 1):
        world.cut((-104, GATE, LOW), (104, end, HIGH - 24))
    world.add(niche(), (0, y, 0))
    world.add(niche(), (0, y, 0), mirror=True)


def build() -> Map:
    world = Map("The gate")
    things = Group()
    world.room((-352, -320, 0), (352, GATE, 320), {"side": "stone_a", "bottom": "tile_check", "top": "stone_b"})
    recess(world)
    for x in (-122, 122):
        things.add(pylon(), (x, GATE - 24, 0))
    world.detail.box((-136, GATE - 32, 248), (136, GATE, 280), "copper_trim")
    world.detail.stairs((-96, GATE - 88, 0), (96, GATE - 40, 24), "stone_trim", "+y", steps=3)
    world.detail.box((-96, GATE - 40, 0), (96, GATE, 24), "stone_trim")
    for x in (-264, 264):
        for y in (-96, 96):
            things.add(lathe([(0, 26), (10, 26), (16, 18), (280, 18), (296, 28), (320, 28)], "stone_b", 8), (x, y, 0))
    world.detail.box((120, 20, 0), (168, 68, 48), "crate_b")
    things.add(lathe([(0, 15), (8, 17), (32, 18), (56, 17), (62, 15)], "barrel_side", 12), (-140, 90, 0))
    furnish(world, things)
    stand(world, -190, -250, 0, 68)
    return world
