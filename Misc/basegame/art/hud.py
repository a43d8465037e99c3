"""The status bar's pictures, `gfx.wad`: numbers, icons, weapons, bars. Faces are in faces.py, the letter in font.py."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.faces import faces
from art.font import conchars
from art.letters import Pen, text_width
from art.palette import gradient, hex_to_srgb
from art.picture import Picture
from art.tex_box import cell_figure, nail_figure, rocket_figure, shell_figure
from formats.lmp import write_lmp
from formats.wad import TYPE_CONCHARS, TYPE_PICTURE, Lump, write_wad

Field = np.ndarray
SILVER = "5c6672 8a96a2 c2cad0 f6f6f4"
RED = "741518 bf1420 e8433a ffb09a"
COPPER = "4a2414 7a3c22 b06a40 d89a68 f2c89c"
IRON = "1c1e22 34383e 50565e 727982 9aa2aa"
GOLD = "5a3a10 a8782c dcb04c ffe68c"
DARK = "0c0e12"


def numbers() -> dict[str, np.ndarray]:
    """num_* and, for what is low, anum_*."""
    out = {}
    signs = [(str(i), str(i)) for i in range(10)] + [("minus", "-"), ("colon", ":"), ("slash", "/")]
    for prefix, ramp in (("num", "8a6a3a c89a58 f0d098 fff8e0"), ("anum", "8c0a14 c8202a ff5a48 ffc8b0")):
        for name, sign in signs:
            picture = Picture(24, 24)
            high = 19.0
            left = 0.5 * (24 - text_width(sign, high))
            picture.text(sign, left, 2.5, high, ramp, Pen(0.13, 0.065, 30.0), width=1.3)
            out[f"{prefix}_{name}"] = picture.indices()
    return out


def _slot(picture: Picture) -> None:
    """A sunk square behind an icon of 24."""
    frame = shapes.box(picture.x, picture.y, 0, 0, picture.width, picture.high, 2.0)
    picture.lay(np.ones(picture.x.shape), "22262b")
    picture.fill(frame + 0.4, "101216 2a2f35 454c54", 1.6, 0.5, -0.45, None)


def ammo() -> dict[str, np.ndarray]:
    """Icons of the four kinds, 24x24."""
    out = {}
    for name, figure in {"shells": shell_figure, "nails": nail_figure, "rocket": rocket_figure, "cells": cell_figure}.items():
        picture = Picture(24, 24)
        _slot(picture)
        for distance, color in figure((picture.x - 12) / 0.72, (picture.y - 12) / 0.72):
            base = hex_to_srgb(color)
            ramp = " ".join(
                "%02x%02x%02x" % tuple(np.round(np.clip(base * f, 0, 1) * 255).astype(int)) for f in (0.45, 1.0, 1.35)
            )
            picture.fill(distance * 0.72, ramp, 2.2, 0.5, 0.5)
        out[f"sb_{name}"] = picture.indices()
    for name in ("sb_ammobase", "sb_armorbase"):
        picture = Picture(24, 24)
        _slot(picture)
        out[name] = picture.indices()
    return out


def armour() -> dict[str, np.ndarray]:
    """Breastplates: green, yellow, red."""
    out = {}
    for i, ramp in enumerate(("1c3a1c 3f7a34 78b058 c8e8a0", "5a3a08 b07a1c e6b53c ffec9c", "50080c a92726 e05a48 ffc0a8"), 1):
        picture = Picture(24, 24)
        _slot(picture)
        x, y = np.abs(picture.x - 12), picture.y
        plate = shapes.polygon(
            x,
            y,
            [
                (0, 4.6),
                (2.6, 4.6),
                (5.0, 2.6),
                (8.6, 4.0),
                (9.2, 8.4),
                (7.0, 10.5),
                (6.6, 16.0),
                (4.2, 20.4),
                (0, 21.6),
                (-5, 21.6),
                (-5, 4.6),
            ],
        )
        picture.fill(plate, ramp, 3.0, 0.45, 0.45)
        picture.lay(picture.mask(np.maximum(x - 0.4, np.maximum(7 - y, y - 20))) * 0.7, ramp.split()[0])
        for level in (12.5, 16.0):
            picture.lay(picture.mask(np.maximum(np.abs(y - level - 0.12 * x) - 0.35, plate + 1.0)) * 0.7, ramp.split()[0])
        picture.lay(picture.mask(shapes.star(picture.x, y, 12, 9.2, 8, 2.8, 1.6)), ramp.split()[3])
        out[f"sb_armor{i}"] = picture.indices()
    return out


def _weapon(name: str, x: Field, y: Field) -> list[tuple[Field, str]]:
    """A weapon's side as parts with their ramps; muzzle to the right, coordinates 24x16 (48 wide for the lightning gun)."""
    b, p, r = shapes.box, shapes.polygon, shapes.union
    wood, steel, brass, coral = "2a160c 6b432a a87650", IRON, GOLD, "3c090b a92726 f07a60"
    if name == "shotgun":
        return [
            (p(x, y, [(1, 12.6), (1, 8.6), (7, 6.0), (10, 6.0), (10, 9.0), (6, 9.6)]), wood),
            (b(x, y, 8, 5.6, 23, 7.8, 0.6), steel),
            (b(x, y, 12, 7.6, 18, 10.0, 0.8), wood),
            (b(x, y, 8, 5.2, 12, 9.4, 0.8), brass),
        ]
    if name == "sshotgun":
        return [
            (p(x, y, [(1, 13), (1, 9), (7, 5.6), (10, 5.6), (10, 9.6), (6, 10)]), wood),
            (b(x, y, 8, 3.8, 23, 6.2, 0.6), steel),
            (b(x, y, 8, 6.6, 23, 9.0, 0.6), steel),
            (b(x, y, 12, 8.8, 18, 11.0, 0.8), wood),
            (b(x, y, 7.6, 4.0, 11.6, 10, 0.8), brass),
        ]
    if name in ("nailgun", "snailgun"):
        barrels = [4.4, 8.2] if name == "nailgun" else [3.0, 5.8, 8.6, 11.4]
        parts = [(b(x, y, 12, at - 1.0, 23, at + 1.0, 0.5), steel) for at in barrels]
        top, low = barrels[0] - 1.6, barrels[-1] + 1.6
        return parts + [
            (b(x, y, 3, top, 14, low, 1.5), "1a2226 3f5a60 7a9ca0"),
            (b(x, y, 15.5, top + 0.2, 17.6, low - 0.2, 0.4), brass),
            (b(x, y, 5, low - 0.6, 8, 14.6, 0.6), wood),
        ]
    if name == "rlaunch":  # throws grenades
        return [
            (p(x, y, [(1, 11), (1, 7.4), (7, 6), (8, 9.4)]), wood),
            (b(x, y, 7, 4.6, 22.6, 9.8, 2.0), "1c2a14 4a6a2c 86a850"),
            (shapes.circle(x, y, 11.5, 10.0, 3.2), steel),
            (b(x, y, 20.6, 3.8, 23, 10.6, 0.6), brass),
        ]
    if name == "srlaunch":  # fires rockets
        return [
            (b(x, y, 1, 3.6, 23, 8.8, 1.2), "2a1208 8c3a1c d08048"),
            (p(x, y, [(0.6, 3.0), (4, 4.4), (4, 8.4), (0.6, 9.6)]), steel),
            (b(x, y, 20.4, 2.8, 23.2, 9.6, 0.6), steel),
            (p(x, y, [(9, 8), (13, 8), (12, 14), (9.6, 14)]), wood),
            (b(x, y, 14.6, 1.8, 17.4, 4.2, 0.4), brass),
        ]
    coils = [b(x, y, 20 + 5 * i, 3.4, 22.6 + 5 * i, 11.0, 0.9) for i in range(4)]
    return [
        (b(x, y, 4, 4.4, 18, 10.6, 2.0), "10203a 2a4a78 6a94c0"),
        (b(x, y, 16, 5.8, 42, 8.8, 1.0), steel),
        (r(*coils), brass),
        (p(x, y, [(41, 3), (46.6, 5.6), (43.4, 7.2), (46.6, 9.0), (41, 11.6), (42.6, 7.3)]), "3a86e0 9fdcff f6f6f4"),
        (b(x, y, 8, 10, 11.4, 15, 0.6), wood),
        (shapes.circle(x, y, 11, 7.5, 2.0), coral),
    ]


def weapons() -> dict[str, np.ndarray]:
    """inv_*: owned; inv2_*: in hand; inva1_ to inva5_*: just found, flashing."""
    out = {}
    for name in ("shotgun", "sshotgun", "nailgun", "snailgun", "rlaunch", "srlaunch", "lightng"):
        wide = 48 if name == "lightng" else 24
        for state in ("inv", "inv2", "inva1", "inva2", "inva3", "inva4", "inva5"):
            picture = Picture(wide, 16)
            chosen, flash = state == "inv2", int(state[4]) if len(state) > 4 else 0
            back = "6a4a1c" if chosen else gradient("2a2f35 b8862c", flash * 0.2, linear=True)
            picture.lay(np.ones(picture.x.shape), back if isinstance(back, str) else np.broadcast_to(back, picture.color.shape))
            rim = shapes.box(picture.x, picture.y, 0.0, 0.0, wide, 16.0, 1.5)
            picture.lay(picture.mask(np.abs(rim + 0.5) - 0.5), "e6b53c" if chosen else "14171b")
            for distance, ramp in _weapon(name, picture.x, picture.y):
                picture.fill(distance, ramp, 1.8, 0.62 if chosen or flash else 0.42, 0.45, DARK, 0.8)
            out[f"{state}_{name}"] = picture.indices()
    return out


def _item(name: str, x: Field, y: Field) -> list[tuple[Field, str]]:
    """Keys and powers, 16x16."""
    b, c = shapes.box, shapes.circle
    if name.startswith("key"):
        ramp = "3c4854 8a98a6 e8eef2" if name == "key1" else GOLD
        return [
            (
                shapes.union(
                    shapes.ring(c(x, y, 4.8, 4.8, 2.9), 2.0),
                    shapes.segment(x, y, 6.8, 6.8, 13, 13, 0.9),
                    shapes.segment(x, y, 11.4, 11.4, 13.2, 9.6, 0.8),
                    shapes.segment(x, y, 9.0, 9.0, 10.8, 7.2, 0.8),
                ),
                ramp,
            )
        ]
    if name == "invis":
        eye = shapes.cut(np.maximum(c(x, y, 8, 13.0, 8.6), c(x, y, 8, 3.0, 8.6)), c(x, y, 8, 8, 2.6))
        return [(eye, "3a2a5a 7a5aa8 d9bfe0"), (c(x, y, 8, 8, 1.4), "c03020 ff6a50 ffc0a0")]
    if name.startswith("invul"):
        return [
            (shapes.polygon(x, y, [(8, 1), (14.4, 3.4), (13.6, 9.4), (8, 15), (2.4, 9.4), (1.6, 3.4)]), "5c1010 bf2a20 ff9a78"),
            (shapes.star(x, y, 8, 7.4, 5, 4.2, 1.8), GOLD),
        ]
    if name == "suit":
        return [
            (b(x, y, 2.0, 1.4, 14, 13.0, 5.5), COPPER),
            (c(x, y, 8, 7, 4.3), "10332f 4a8f7c c4ead8"),
            (b(x, y, 3.6, 12, 12.4, 15, 1.0), GOLD),
        ]
    ring = shapes.ring(c(x, y, 8, 8, 5.0), 2.0)
    return [(ring, "103668 3a86e0 9fdcff"), (shapes.star(x, y, 8, 8, 4, 7.4, 2.2), "1a56a8 7cc4ff f6f6f4")]


def items() -> dict[str, np.ndarray]:
    """Keys and powers, at rest and flashing, and the four sigils."""
    out = {}
    names = {"key1": "key1", "key2": "key2", "invis": "invis", "invuln": "invul", "suit": "suit", "quad": "quad"}
    for name, short in names.items():
        for frame in range(6):
            picture = Picture(16, 16)
            if frame:
                glow = gradient("3a2c10 ffd870", frame * 0.17, linear=True)
                halo = picture.mask(shapes.circle(picture.x, picture.y, 8, 8, 7.8))
                picture.lay(halo, np.broadcast_to(glow, picture.color.shape))
            for distance, ramp in _item(name, picture.x, picture.y):
                picture.fill(distance, ramp, 1.6, 0.5, 0.5, DARK, 0.8)
            out[f"sb_{name}" if frame == 0 else f"sba{frame}_{short}"] = picture.indices()
    ramps = ("0c2a28 2f8a7a a8f0d8", "3a1a0a c0602c ffd08c", "1a1040 6a50b8 d0c0ff", "3a0a10 c02838 ffb0a0")
    for i, ramp in enumerate(ramps, 1):
        picture = Picture(8, 16)
        stone = shapes.polygon(picture.x, picture.y, [(4, 0.6), (7.4, 4), (7.4, 12), (4, 15.4), (0.6, 12), (0.6, 4)])
        picture.fill(stone, ramp, 2.0, 0.42, 0.5, None)
        marks = [
            [(4, 4), (4, 12)],
            [(2.5, 5), (4, 8), (5.5, 5), (4, 8), (4, 12)],
            [(4, 4), (2.4, 8), (4, 12), (5.6, 8), (4, 4)],
            [(2.4, 5), (5.6, 8), (2.4, 11), (5.6, 11)],
        ]
        picture.lay(picture.mask(shapes.strokes(picture.x, picture.y, marks[i - 1], 0.55)), "fff8d4")
        out[f"sb_sigil{i}"] = picture.indices()
    return out


def _strip(seed: int) -> Picture:
    """A plate of iron 320x24 with a copper edge above."""
    picture = Picture(320, 24, seed)
    tone = 0.34 + 0.1 * picture.noise((40, 6), 1) + 0.05 * picture.noise((60, 2), 2) - 0.006 * (picture.y - 12)
    picture.lay(np.ones(picture.x.shape), gradient(IRON, tone, linear=True))
    picture.fill(np.abs(picture.y - 1.1) - 0.9, COPPER, 0.9, 0.5, 0.35, None)
    picture.lay(picture.mask(np.abs(picture.y - 2.4) - 0.4) * 0.8, DARK)
    for x in range(4, 320, 52):
        picture.fill(shapes.circle(picture.x, picture.y, x, 21.0, 1.4), IRON, 1.4, 0.6, 0.5, DARK, 0.5)
    return picture


def _sink(picture: Picture, x0: float, y0: float, x1: float, y1: float) -> None:
    """A pocket in the plate."""
    picture.fill(shapes.box(picture.x, picture.y, x0, y0, x1, y1, 1.6), "07080a 15181c 3a4048", 1.4, 0.4, -0.4, None)


def bars() -> dict[str, np.ndarray]:
    """The three strips, the tile behind them, and the disc's, memory's and network's signs."""
    sbar = _strip(1)
    for x0, x1 in ((1, 24), (24, 97), (111, 137), (137, 209), (223, 248), (248, 319)):
        _sink(sbar, x0 + 0.6, 3.2, x1 - 0.6, 23.4)
    ibar = _strip(2)
    for i in range(4):
        _sink(ibar, 48 * i + 5.5, 0.4, 48 * i + 34.5, 7.8)
        color = ["c8402c", "c9d0d4", "e6b53c", "9fdcff"][i]
        ibar.lay(ibar.mask(shapes.box(ibar.x, ibar.y, 48 * i + 37, 2, 48 * i + 41, 6, 1.2)), color)
    _sink(ibar, 0.4, 8.2, 191.6, 23.8)
    for i in range(6):
        _sink(ibar, 192.4 + 16 * i, 8.2, 207.6 + 16 * i, 23.8)
    for i in range(4):
        _sink(ibar, 288.3 + 8 * i, 8.2, 295.7 + 8 * i, 23.8)
    score = _strip(3)
    _sink(score, 3, 3.2, 317, 12.4)
    _sink(score, 3, 12.8, 317, 23.4)
    tile = Picture(64, 64, 4)
    lx, ly = tile.x % 32 - 16, tile.y % 32 - 16
    tile.lay(np.ones(tile.x.shape), gradient(IRON, 0.22 + 0.08 * tile.noise(32, 1), linear=True))
    tile.fill(np.maximum(np.abs(lx), np.abs(ly)) - 15.0, IRON, 2.0, 0.32, 0.25, DARK)
    tile.fill(np.hypot(lx, ly) - 2.2, COPPER, 2.0, 0.4, 0.4, DARK)
    return {"sbar": sbar.indices(), "ibar": ibar.indices(), "scorebar": score.indices(), "backtile": tile.indices()} | _signs()


def _signs() -> dict[str, np.ndarray]:
    disc = Picture(24, 24)
    radius = np.hypot(disc.x - 12, disc.y - 12)
    disc.fill(radius - 10.5, COPPER, 2.0, 0.5, 0.4)
    disc.fill(radius - 3.4, IRON, 1.4, 0.3, -0.4, None)
    disc.lay(disc.mask(np.abs(radius - 7.0) - 0.4) * 0.7, "4a2414")
    ram = Picture(32, 32)
    ram.fill(shapes.box(ram.x, ram.y, 3, 9, 29, 23, 2), "0c2a20 1f5a48 4a9a80", 2.0, 0.5, 0.4)
    for i in range(3):
        ram.fill(shapes.box(ram.x, ram.y, 6 + 7.4 * i, 12, 11.4 + 7.4 * i, 20, 0.8), IRON, 1.2, 0.3, 0.4)
    for i in range(8):
        ram.fill(shapes.box(ram.x, ram.y, 4.6 + 3.0 * i, 23, 6.2 + 3.0 * i, 27), GOLD, 0.8, 0.5, 0.3, None)
    net = Picture(32, 32)
    net.fill(
        shapes.strokes(net.x, net.y, [(6, 22), (12, 12), (16, 18), (20, 8), (26, 22)], 1.4),
        "103668 3a86e0 9fdcff",
        1.4,
        0.6,
        0.4,
    )
    net.fill(shapes.strokes(net.x, net.y, [(5, 5), (27, 27)], 2.0), RED, 1.6, 0.5, 0.4)
    turtle = Picture(32, 32)
    x, y = turtle.x, turtle.y
    turtle.fill(
        shapes.union(
            shapes.ellipse(x, y, 26, 16.5, 4, 3.2), shapes.ellipse(x, y, 8, 23, 3, 3), shapes.ellipse(x, y, 20, 23, 3, 3)
        ),
        "2b2f10 7f883a d4dc84",
        2.0,
        0.5,
        0.4,
    )
    turtle.fill(np.maximum(shapes.ellipse(x, y, 14, 21, 12, 13), y - 21.5), "10332f 4a8f7c c4ead8", 4.0, 0.5, 0.5)
    for cx, cy in ((8.5, 17.5), (14, 13.5), (19.5, 17.5), (14, 19)):
        turtle.lay(turtle.mask(np.abs(np.hypot(x - cx, y - cy) - 2.4) - 0.4) * 0.8, "0c2a28")
    turtle.lay(turtle.mask(shapes.circle(x, y, 27.4, 15.6, 0.7)), DARK)
    return {"disc": disc.indices(), "ram": ram.indices(), "net": net.indices(), "turtle": turtle.indices()}


def hud_lumps() -> dict[str, np.ndarray]:
    """Every picture of the archive, by its lump's name."""
    return numbers() | ammo() | armour() | weapons() | items() | bars() | faces()


def hud_files(pattern: str) -> dict[str, bytes]:
    """`gfx.wad`."""
    lumps = [Lump("CONCHARS", TYPE_CONCHARS, conchars().tobytes())]
    lumps += [Lump(name.upper(), TYPE_PICTURE, write_lmp(picture)) for name, picture in sorted(hud_lumps().items())]
    return {"gfx.wad": write_wad(lumps)}
