"""The textures' names, sizes and painters. A painter takes (width, height) in texels and gives a Surface."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from art.palette import hex_to_srgb
from art.surface import Surface

Painter = Callable[[int, int], Surface]


def flat(color: str, glow: bool = False) -> Painter:
    """One colour all over, `rrggbb`; a light if it glows."""

    def paint(width: int, height: int) -> Surface:
        rgb = np.broadcast_to(hex_to_srgb(color), (height, width, 3)).copy()
        return Surface(rgb, glow=np.full((height, width), True) if glow else None, dither=0.0)

    return paint


# name: (width, height, painter)
TEXTURES: dict[str, tuple[int, int, Painter]] = {}


def add(names: str, size: tuple[int, int], painter: Painter) -> None:
    """Registers a painter under one or several names."""
    for name in names.split():
        TEXTURES[name] = (*size, painter)


add("stone_a stone_b stone_floor cobble rock_a rock_b", (128, 128), flat("8d98a8"))
add("dirt", (128, 128), flat("6b4a30"))
add("moss_stone", (128, 128), flat("7f8a60"))
add("stone_trim", (128, 32), flat("a7b1bd"))
add("brick_red", (128, 128), flat("a5604e"))
add("brick_dark", (128, 128), flat("656d80"))
add("plaster plaster_crack", (128, 128), flat("d8caa8"))
add("metal_plate metal_rivet metal_floor steel_wall", (128, 128), flat("70737a"))
add("metal_rust", (128, 128), flat("8c5a38"))
add("metal_trim", (128, 32), flat("585c66"))
add("copper_plate copper_floor", (128, 128), flat("6fae98"))
add("copper_trim", (128, 32), flat("b07a50"))
add("steel_door", (128, 128), flat("8c929c"))
add("wood_plank wood_door", (128, 128), flat("9a6c48"))
add("wood_beam", (128, 32), flat("7a5030"))
add("tile_teal", (128, 128), flat("5fa090"))
add("tile_white", (128, 128), flat("e0dccc"))
add("tile_check", (128, 128), flat("9aa0a0"))
add("marble_white", (128, 128), flat("e2ddd2"))
add("marble_black", (128, 128), flat("3a3d44"))
add("flesh_a flesh_b", (128, 128), flat("c8675c"))
add("glass_teal", (64, 64), flat("70b8a8"))
add("window_a window_b", (64, 128), flat("ffc64e", glow=True))
add("light_white", (64, 64), flat("ffffff", glow=True))
add("light_warm", (64, 64), flat("ffc64e", glow=True))
add("light_cool", (64, 64), flat("9fdcff", glow=True))
add("light_red", (64, 64), flat("e8262a", glow=True))
add("light_green", (64, 64), flat("8cffa0", glow=True))
add("light_strip", (64, 16), flat("fff8d4", glow=True))
add("lamp_round", (64, 64), flat("ffe894", glow=True))
add("rune_a rune_b", (64, 64), flat("738299"))
add("crystal_blue", (64, 64), flat("5fb8ff", glow=True))
add("crystal_red", (64, 64), flat("e8262a", glow=True))
add("crystal_gold", (64, 64), flat("e6bf44", glow=True))
add("candle_wax", (64, 64), flat("f0e0b8"))
add("door_iron door_gold door_silver door_rune", (128, 128), flat("6a6058"))
add("+0button +1button", (64, 64), flat("8a6a48"))
add("+abutton", (64, 64), flat("bf1420", glow=True))
add("+0plate +1plate +2plate +3plate", (64, 64), flat("546070"))
add("sign_exit sign_arrow", (64, 32), flat("6a5a40"))
add("skull_trim", (128, 32), flat("b0a080"))
add("bones", (128, 128), flat("cfbf9a"))
add("crate_a crate_b", (64, 64), flat("9a6c48"))
add("barrel_side barrel_top", (64, 64), flat("5a6a72"))
add("bookshelf", (128, 128), flat("6b432a"))
add("carpet_red", (128, 128), flat("a02830"))
add("{grate", (64, 64), flat("585c66"))
add("{vine", (64, 64), flat("5a7a30"))
add("{chain", (32, 64), flat("585c66"))
add("*water_a *water_b", (64, 64), flat("2f7070"))
add("*slime_a", (64, 64), flat("7f9a30"))
add("*lava_a", (64, 64), flat("f26a0c", glow=True))
add("*teleport", (64, 64), flat("643f7b"))
add("sky_night", (256, 128), flat("182440"))
add("sky_dusk", (256, 128), flat("8a5068"))
add("sky_storm", (256, 128), flat("5a7080"))
add("skip clip trigger origin hint", (64, 64), flat("c850c8"))
add("box_shell box_nail box_rocket box_cell box_health box_mega", (64, 64), flat("8a7a60"))
add("box_shell_top box_nail_top box_rocket_top box_cell_top box_health_top box_mega_top", (64, 64), flat("9a8a70"))
add("lab_white", (64, 64), flat("d8d8d8"))
add("lab_grey", (64, 64), flat("888888"))
add("lab_black", (64, 64), flat("1d1d1f"))
add("lab_red", (64, 64), flat("a92726"))
add("lab_green", (64, 64), flat("525a20"))
add("lab_blue", (64, 64), flat("1a56a8"))
add("lab_yellow", (64, 64), flat("e6b53c"))
add("lab_check lab_chrome lab_steel lab_marble", (64, 64), flat("9a9a9a"))
add("lab_light", (64, 64), flat("ffffff", glow=True))
add("lab_light_warm", (64, 64), flat("ffc64e", glow=True))
add("lab_light_dim", (64, 64), flat("9fdcff", glow=True))
