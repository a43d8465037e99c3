"""The textures' names, sizes and painters. A painter takes (width, height) in texels and gives a Surface."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from art import tex_doors, tex_fine, tex_grown, tex_metal, tex_stone, tex_wood
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


for _painter in (tex_stone.stone_a, tex_stone.stone_b, tex_stone.stone_floor, tex_stone.cobble, tex_stone.rock_a,
                 tex_stone.rock_b, tex_stone.dirt, tex_stone.moss_stone, tex_stone.brick_red, tex_stone.brick_dark,
                 tex_stone.plaster, tex_stone.plaster_crack):
    add(_painter.__name__, (128, 128), _painter)
add("stone_trim", (128, 32), tex_stone.stone_trim)
for _painter in (tex_metal.metal_plate, tex_metal.metal_rivet, tex_metal.metal_floor, tex_metal.metal_rust,
                 tex_metal.copper_plate, tex_metal.copper_floor, tex_metal.steel_wall, tex_metal.steel_door):
    add(_painter.__name__, (128, 128), _painter)
add("metal_trim", (128, 32), tex_metal.metal_trim)
add("copper_trim", (128, 32), tex_metal.copper_trim)
for _painter in (tex_wood.wood_plank, tex_wood.wood_door, tex_wood.bookshelf, tex_fine.tile_teal, tex_fine.tile_white,
                 tex_fine.tile_check, tex_fine.marble_white, tex_fine.marble_black, tex_fine.carpet_red):
    add(_painter.__name__, (128, 128), _painter)
for _painter in (tex_wood.crate_a, tex_wood.crate_b, tex_wood.barrel_side, tex_wood.barrel_top, tex_fine.glass_teal):
    add(_painter.__name__, (64, 64), _painter)
add("wood_beam", (128, 32), tex_wood.wood_beam)
for _painter in (tex_grown.flesh_a, tex_grown.flesh_b, tex_grown.bones, tex_doors.door_iron, tex_doors.door_gold,
                 tex_doors.door_silver, tex_doors.door_rune):
    add(_painter.__name__, (128, 128), _painter)
add("skull_trim", (128, 32), tex_grown.skull_trim)
add("candle_wax", (64, 64), tex_grown.candle_wax)
add("{vine", (64, 64), tex_grown.vine)
add("{grate", (64, 64), tex_doors.grate)
add("{chain", (32, 64), tex_doors.chain)
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
add("+0button +1button", (64, 64), flat("8a6a48"))
add("+abutton", (64, 64), flat("bf1420", glow=True))
add("+0plate +1plate +2plate +3plate", (64, 64), flat("546070"))
add("sign_exit sign_arrow", (64, 32), flat("6a5a40"))
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
