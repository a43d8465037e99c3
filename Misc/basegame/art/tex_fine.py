"""What the monks laid with care: tiles, marble, glass, carpet."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.canvas import Blocks, Canvas
from art.noise import smoothstep
from art.surface import Surface

TEAL = "1f5a55 2f7a70 46998a 68b5a2 94cfbb"
IVORY = "c8bda0 d8cfb6 e4ddc8 eee9d8"
GROUT = "57574f 6a6a60 7d7c70"


def _tiles(c: Canvas, columns: int, rows: int, joint: float = 1.1) -> tuple[Blocks, np.ndarray]:
    """Square tiles: height and gloss; gives the layout and where tile is (0..1)."""
    blocks = c.blocks(columns, rows, 0.0)
    edge = blocks.edge - 0.5 * joint
    on = smoothstep(-0.25, 0.5, edge)
    size = c.width / columns
    lean = ((blocks.random(1) - 0.5) * blocks.u + (blocks.random(2) - 0.5) * blocks.v) / size
    c.height = c.bevel(edge, 1.2, 0.8) + on * (0.5 * lean + 0.08 * c.noise(12, 2, seed=3))
    c.color = c.ramp(GROUT, 0.5 + 0.4 * c.noise(8, 3, seed=4))
    c.gloss = 0.15 + on * (0.62 + 0.1 * c.noise(40, 3, seed=5))
    return blocks, on


def _craze(c: Canvas, on: np.ndarray, seed: int, share: np.ndarray) -> None:
    """Hair cracks in a glaze."""
    net = c.cells(9, seed, 1.0, warp=2.0)
    line = smoothstep(0.03, 0.0, net.edge()) * on * share
    c.paint("3c4a44", 0.35 * line)
    c.gloss -= 0.2 * line


def tile_teal(width: int, height: int) -> Surface:
    """Glazed tiles of 16, each fired to its own depth."""
    c = Canvas(width, height, 71)
    blocks, on = _tiles(c, 8, 8)
    pool = 1.0 - smoothstep(0.0, 7.0, blocks.edge)
    tone = 0.2 + 0.6 * blocks.random(10) + 0.1 * c.noise(10, 3, seed=11) - 0.16 * pool
    c.paint(c.ramp(TEAL, tone), on)
    c.paint(c.ramp("2a4a70 3a6490 5a86b0", tone), on * 0.9 * (blocks.random(12) < 0.1))
    _craze(c, on, 13, (blocks.random(14) < 0.3))
    c.paint("b9c4b4", 0.25 * smoothstep(0.3, 0.8, c.noise(36, 4, seed=15)))
    return c.surface()


def tile_white(width: int, height: int) -> Surface:
    """Ivory tiles of 16 with a teal quatrefoil on every fourth."""
    c = Canvas(width, height, 72)
    blocks, on = _tiles(c, 8, 8)
    c.paint(c.ramp(IVORY, 0.3 + 0.6 * blocks.random(10) + 0.12 * c.noise(12, 3, seed=11)), on)
    column, row = np.floor(c.x / 16).astype(int), np.floor(c.y / 16).astype(int)
    chosen = (column % 2 == 0) & (row % 2 == 0)
    u, v = np.abs(blocks.u), np.abs(blocks.v)
    petals = np.minimum(np.hypot(u - 3.2, v), np.hypot(u, v - 3.2)) - 2.7
    motif = np.maximum(petals, -(np.hypot(u, v) - 1.3))
    c.paint(c.ramp(TEAL, 0.35 + 0.3 * blocks.random(12)), 0.95 * c.mask(motif) * chosen)
    corner = np.abs(u + v - 11.5) - 0.6
    c.paint(c.ramp("7a3c2c a85a40", blocks.random(13)), 0.9 * c.mask(corner) * chosen * on)
    _craze(c, on, 14, (blocks.random(15) < 0.35))
    c.paint("8f8a70", 0.3 * smoothstep(0.2, 0.9, c.noise(40, 4, seed=16)))
    return c.surface()


def tile_check(width: int, height: int) -> Surface:
    """A floor of 32-texel slabs, slate and ivory, worn where people walk."""
    c = Canvas(width, height, 73)
    blocks, on = _tiles(c, 4, 4, 0.9)
    column, row = np.floor(c.x / 32).astype(int), np.floor(c.y / 32).astype(int)
    dark = (column + row) % 2 == 0
    vein = np.abs(c.noise(40, 4, 0.55, seed=10, warp=40.0 * blocks.random(11)))
    c.paint(c.ramp("343c42 465058 5a656c 74808a", 0.35 + 0.3 * blocks.random(12) + 0.2 * c.noise(26, 4, seed=13)), on * dark)
    c.paint(c.ramp(IVORY, 0.3 + 0.5 * blocks.random(14) + 0.2 * c.noise(26, 4, seed=15)), on * ~dark)
    c.paint("b8b09c", 0.5 * smoothstep(0.06, 0.0, vein) * on)
    chip = smoothstep(0.55, 0.75, c.noise(12, 3, seed=16) + 0.5 * smoothstep(3.0, 0.0, blocks.edge))
    c.height -= 0.6 * chip
    c.paint("84806f", 0.7 * chip)
    c.gloss -= 0.45 * chip + 0.18 * smoothstep(-0.2, 0.8, c.noise(50, 3, seed=17))
    return c.surface()


def _marble(c: Canvas, ramp: str, vein: str, fine: str) -> None:
    """Polished slabs of 64 with veins in two sizes."""
    blocks = c.blocks(2, 2, 0.0)
    shift = 60.0 * blocks.random(1)
    bend = shift + 12.0 * c.noise(50, 3, seed=2, warp=shift)
    c.color = c.ramp(ramp, 0.55 + 0.3 * c.noise(56, 4, 0.55, seed=3, warp=bend))
    broad = np.abs(c.noise((70, 40), 4, 0.5, seed=4, warp=bend))
    thin = np.abs(c.noise((36, 24), 4, 0.55, seed=5, warp=bend))
    c.paint(vein, 0.75 * smoothstep(0.1, 0.0, broad))
    c.paint(vein, 0.35 * smoothstep(0.35, 0.0, broad))
    c.paint(fine, 0.6 * smoothstep(0.035, 0.0, thin) * smoothstep(-0.3, 0.4, c.noise(40, 2, seed=6)))
    edge = blocks.edge - 0.4
    c.height = c.bevel(edge, 1.0, 0.5) + 0.02 * c.noise(30, 2, seed=7)
    c.paint("4c4a46", 0.6 * smoothstep(0.2, -0.2, edge))
    c.gloss = 0.8 + 0.06 * c.noise(40, 4, seed=8) - 0.25 * smoothstep(0.4, 1.0, c.noise(30, 4, seed=9))


def marble_white(width: int, height: int) -> Surface:
    """White marble, grey and gold veins."""
    c = Canvas(width, height, 74)
    _marble(c, "bebab0 d2cec4 e1ddd5 ece9e3", "8a8d92", "b89a5c")
    return c.surface()


def marble_black(width: int, height: int) -> Surface:
    """Black-green marble, pale veins."""
    c = Canvas(width, height, 75)
    _marble(c, "2c3436 3c474a 4d5a5c 647274", "c9ccc4", "d8b878")
    return c.surface()


def glass_teal(width: int, height: int) -> Surface:
    """Bull's-eye panes in lead."""
    c = Canvas(width, height, 76)
    lx, ly = (c.x % 16) - 8, (c.y % 16) - 8
    radius = np.hypot(lx, ly)
    number = (np.floor(c.x / 16) + 7 * np.floor(c.y / 16)).astype(int)
    from_corner = np.hypot(8 - np.abs(lx), 8 - np.abs(ly))
    tone = Blocks(number, radius, lx, ly).random(1)
    c.color = c.ramp(
        "2d7a72 4aa092 72c0ae a6dcc8", 0.2 + 0.5 * tone + 0.18 * np.cos(radius * 1.6) + 0.1 * c.noise(8, 2, seed=2)
    )
    c.height = 0.22 * np.cos(radius * 1.6) + 0.6 * np.exp(-((radius / 1.6) ** 2))
    lead = np.minimum(np.abs(radius - 7.0) - 0.8, from_corner - 2.4)
    c.height += 1.2 * c.mask(lead, 1.2)
    c.paint("4a4e52", c.mask(lead))
    c.gloss = np.where(lead < 0, 0.45, 0.88)
    return c.surface()


def carpet_red(width: int, height: int) -> Surface:
    """A runner: ground of red wool, lozenges in ochre and teal, a border along its sides."""
    c = Canvas(width, height, 77)
    weave = np.sin(c.x * np.pi) * np.sin(c.y * np.pi)
    pile = c.noise(3, 2, 0.7, seed=1)
    c.color = c.ramp("782022 9a2a2c b63a38 c84c46", 0.5 + 0.16 * c.noise(40, 4, seed=2) + 0.1 * pile)
    lx, ly = (c.x % 64) - 32, (c.y % 64) - 32
    lozenge = np.abs(lx) + np.abs(ly)
    star = shapes.star(np.abs(lx), np.abs(ly), 0.0, 0.0, 8, 12.0, 7.0)
    small = np.abs(np.abs(lx) - 32) + np.abs(np.abs(ly) - 32)
    c.paint("c9964a", 0.9 * c.mask(np.abs(lozenge - 27.0) - 1.2))
    c.paint("2f6f68", 0.9 * c.mask(np.abs(lozenge - 23.5) - 1.0))
    c.paint("c9964a", 0.9 * c.mask(star))
    c.paint("7a1e22", 0.95 * c.mask(star + 3.0))
    c.paint("d8c8a0", 0.9 * c.mask(np.hypot(lx, ly) - 2.0))
    c.paint("c9964a", 0.9 * c.mask(np.abs(small - 7.0) - 1.0))
    c.paint("2f6f68", 0.9 * c.mask(small - 4.0))
    c.tint(1.0 + 0.16 * weave + 0.12 * pile)
    c.height = 0.18 * weave + 0.2 * pile
    c.gloss = np.full(c.x.shape, 0.05)
    c.paint("54423a", 0.3 * smoothstep(0.2, 0.9, c.noise(50, 4, seed=3)))
    return c.surface()
