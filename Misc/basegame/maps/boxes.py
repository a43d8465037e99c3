"""Item boxes: ammunition, health and barrels, which Quake keeps as maps of their own. Their lowest corner is at 0 0 0, as
items expect, and their sizes are those that other maps leave room for."""

from __future__ import annotations

from kit import Group, Map, fit

# name: (size along x, y, z; texture of the sides, and with _top of the lid)
CASES = {
    "b_shell0": ((24, 24, 24), "box_shell"), "b_shell1": ((32, 32, 24), "box_shell"),
    "b_nail0": ((24, 24, 24), "box_nail"), "b_nail1": ((32, 32, 24), "box_nail"),
    "b_rock0": ((16, 16, 32), "box_rocket"), "b_rock1": ((32, 16, 32), "box_rocket"),
    "b_batt0": ((24, 24, 28), "box_cell"), "b_batt1": ((32, 32, 28), "box_cell"),
    "b_bh10": ((32, 32, 10), "box_health"), "b_bh25": ((32, 32, 16), "box_health"),
    "b_bh100": ((32, 32, 32), "box_mega"),
}
BARRELS = {"b_explob": 64, "b_exbox2": 32}  # height
RIM = 2  # units that plinth, posts and lid stand out


def case(name: str, size: tuple[int, int, int], texture: str) -> Map:
    """A body in a frame of four posts, a plinth and a lid."""
    x, y, z = size
    world = Map(name, light=90)
    body = {"all": fit(texture), "top": fit(texture + "_top"), "bottom": fit(texture + "_top")}
    world.box((1, 1, RIM), (x - 1, y - 1, z - 1), body)
    lid = {"all": "metal_trim", "top": fit(texture + "_top")}
    world.box((0, 0, 0), (x, y, RIM), "metal_trim")
    world.box((RIM, RIM, z - 1), (x - RIM, y - RIM, z), lid)
    for px in (0, x - RIM):
        for py in (0, y - RIM):
            world.box((px, py, RIM), (px + RIM, py + RIM, z), "metal_trim")
    return world


def barrel(name: str, height: int) -> Map:
    """Eight staves between two rims."""
    world = Map(name, light=90)
    staves = Group()
    rim = 3
    top = fit("barrel_top")
    staves.cylinder((16, 16), 17.32, 0, rim, {"all": "metal_trim", "top": top}, sides=8)
    staves.cylinder((16, 16), 16.24, rim, height - rim, "barrel_side", sides=8)
    staves.cylinder((16, 16), 17.32, height - rim, height, {"all": "metal_trim", "top": top}, sides=8)
    return world.add(staves)


def build() -> dict[str, Map]:
    cases = {name: case(name, size, texture) for name, (size, texture) in CASES.items()}
    return cases | {name: barrel(name, height) for name, height in BARRELS.items()}
