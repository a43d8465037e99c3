"""The textures' names, sizes and painters. A painter takes (width, height) in texels and gives a Surface."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from art import tex_box, tex_doors, tex_fine, tex_glow, tex_grown, tex_liquid, tex_metal, tex_stone, tex_wood
from art.palette import LAMP, heat, hex_to_srgb
from art.surface import Surface

Painter = Callable[[int, int], Surface]


def flat(color: str, glow: bool = False, exact: bool = False) -> Painter:
    """One colour all over, `rrggbb`; a light if it glows. Exact ones keep it in a PNG, others have the palette's nearest."""

    def paint(width: int, height: int) -> Surface:
        rgb = np.broadcast_to(hex_to_srgb(color), (height, width, 3)).copy()
        return Surface(rgb, glow=np.full((height, width), True) if glow else None, exact=exact, dither=0.0)

    return paint


# name: (width, height, painter)
TEXTURES: dict[str, tuple[int, int, Painter]] = {}


def add(names: str, size: tuple[int, int], painter: Painter) -> None:
    """Registers a painter under one or several names."""
    for name in names.split():
        TEXTURES[name] = (*size, painter)


for _painter in (
    tex_stone.stone_a,
    tex_stone.stone_b,
    tex_stone.stone_floor,
    tex_stone.cobble,
    tex_stone.rock_a,
    tex_stone.rock_b,
    tex_stone.dirt,
    tex_stone.moss_stone,
    tex_stone.brick_red,
    tex_stone.brick_dark,
    tex_stone.plaster,
    tex_stone.plaster_crack,
):
    add(_painter.__name__, (128, 128), _painter)
add("stone_trim", (128, 32), tex_stone.stone_trim)
for _painter in (
    tex_metal.metal_plate,
    tex_metal.metal_rivet,
    tex_metal.metal_floor,
    tex_metal.metal_rust,
    tex_metal.copper_plate,
    tex_metal.copper_floor,
    tex_metal.steel_wall,
    tex_metal.steel_door,
):
    add(_painter.__name__, (128, 128), _painter)
add("metal_trim", (128, 32), tex_metal.metal_trim)
add("copper_trim", (128, 32), tex_metal.copper_trim)
for _painter in (
    tex_wood.wood_plank,
    tex_wood.wood_door,
    tex_wood.bookshelf,
    tex_fine.tile_teal,
    tex_fine.tile_white,
    tex_fine.tile_check,
    tex_fine.marble_white,
    tex_fine.marble_black,
    tex_fine.carpet_red,
):
    add(_painter.__name__, (128, 128), _painter)
for _painter in (tex_wood.crate_a, tex_wood.crate_b, tex_wood.barrel_side, tex_wood.barrel_top, tex_fine.glass_teal):
    add(_painter.__name__, (64, 64), _painter)
add("wood_beam", (128, 32), tex_wood.wood_beam)
for _painter in (
    tex_grown.flesh_a,
    tex_grown.flesh_b,
    tex_grown.bones,
    tex_doors.door_iron,
    tex_doors.door_gold,
    tex_doors.door_silver,
    tex_doors.door_rune,
):
    add(_painter.__name__, (128, 128), _painter)
add("skull_trim", (128, 32), tex_grown.skull_trim)
add("candle_wax", (64, 64), tex_grown.candle_wax)
add("{vine", (64, 64), tex_grown.vine)
add("{grate", (64, 64), tex_doors.grate)
add("{chain", (32, 64), tex_doors.chain)
for _name in (
    "light_white light_warm light_cool light_red light_green lamp_round rune_a rune_b crystal_blue crystal_red " "crystal_gold"
).split():
    add(_name, (64, 64), getattr(tex_glow, _name))
add("light_strip", (64, 16), tex_glow.light_strip)
add("window_a", (64, 128), tex_glow.window_a)
add("window_b", (64, 128), tex_glow.window_b)
add("+0button", (64, 64), tex_glow.button_0)
add("+1button", (64, 64), tex_glow.button_1)
add("+abutton", (64, 64), tex_glow.button_a)
for _frame, _painter in enumerate(tex_glow.plates):
    add(f"+{_frame}plate", (64, 64), _painter)
add("sign_exit", (64, 32), tex_glow.sign_exit)
add("sign_arrow", (64, 32), tex_glow.sign_arrow)
for _name in "water_a water_b water_still slime_a lava_a teleport".split():
    add(f"*{_name}", (64, 64), getattr(tex_liquid, _name))
for _name in "sky_night sky_dusk sky_storm".split():
    add(_name, (256, 128), getattr(tex_liquid, _name))
for _name, _painter in tex_box.BOXES.items():
    add(_name, (64, 64), _painter)
for _name, _color in {"skip": "b04a9c", "clip": "a8782c", "trigger": "7a4ab0", "origin": "3a86a0", "hint": "5a8a3a"}.items():
    add(_name, (64, 64), tex_box.tool(_color, _name))
add("lab_white", (64, 64), flat("d8d8d8"))
add("lab_grey", (64, 64), flat("888888"))
add("lab_black", (64, 64), flat("1d1d1f"))
add("lab_red", (64, 64), flat("d23f3f", exact=True))  # the Cornell box's walls as they are mostly drawn: 0.65 0.05 0.05
add("lab_green", (64, 64), flat("61b36c", exact=True))  # and 0.12 0.45 0.15
add("lab_blue", (64, 64), flat("1a56a8"))
add("lab_yellow", (64, 64), flat("e6b53c"))
add("lab_light", (64, 64), flat("ffffff", glow=True))
add("lab_light_warm", (64, 64), flat(heat(LAMP), glow=True))
add("lab_chrome", (64, 64), flat("d9d9d8"))
add("lab_steel", (64, 64), flat("9a9b9f"))
add("lab_marble", (64, 64), flat("c8c8c8"))
add("lab_check", (64, 64), tex_box.lab_check)
add("lab_light_dim", (64, 64), tex_box.lab_light_dim)

# Pictures that stand in for a texture in one map, textures/MAP/NAME.png: where everybody knows how a place is lit.
OF_MAPS: dict[str, tuple[int, int, Painter]] = {
    "lab_cbox/lab_light_warm": (64, 64, flat(heat(3600), glow=True, exact=True)),
}
