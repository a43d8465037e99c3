"""Wood: planks, beams, doors, crates, barrels, shelves of books."""

from __future__ import annotations

import numpy as np

from art.canvas import Canvas
from art.noise import hash01, smoothstep
from art.palette import hex_to_srgb
from art.surface import Surface
from art.tex_metal import IRON, SOOT, grid, rivets, rust

OAK = "5c3a22 7a5030 96683e b08350 c9a06c"
BOG = "5a4332 7e604a 9c7b60 b89a7e d2b89c"
PINE = "8a6236 a67c48 bf965c d4b076 e6ca98"


def grain(c: Canvas, ramp: str, board: np.ndarray, seed: int, upright: bool = True) -> np.ndarray:
    """Grain along boards (numbered by `board`): rings cut at a slant, and pores. Lays colour; gives the relief."""
    shift = 40.0 * hash01(board, seed)
    long_, short = (48.0, 4.5)
    wavelength = (short, long_) if upright else (long_, short)
    wide = (14.0, 70.0) if upright else (70.0, 14.0)
    across = c.x if upright else c.y
    along = c.y if upright else c.x
    bend = 5.0 * c.noise(wide, 2, seed=seed + 1, warp=shift)
    rings = np.sin((across + bend + shift) * 1.9 + 0.6 * np.sin(along * 2 * np.pi / 64.0 + shift))
    fibre = c.noise(wavelength, 4, 0.65, seed=seed + 2, warp=shift)
    tone = 0.52 + 0.4 * (hash01(board, seed + 3) - 0.5) + 0.09 * rings + 0.14 * fibre
    c.color = c.ramp(ramp, tone)
    c.gloss = 0.28 + 0.08 * rings + 0.1 * (hash01(board, seed + 4) - 0.5)
    return 0.1 * rings + 0.2 * fibre


def _boards(c: Canvas, ramp: str, wide: float, seed: int, upright: bool = True, gap: float = 0.8) -> np.ndarray:
    """Boards side by side; gives the distance to a board's edge."""
    across = c.x if upright else c.y
    number = np.floor(across / wide).astype(int)
    edge = 0.5 * wide - np.abs(across - (number + 0.5) * wide) - 0.5 * gap
    relief = grain(c, ramp, number + 17 * seed, seed, upright)
    c.height = c.bevel(edge + 0.4 * c.noise((6, 20) if upright else (20, 6), 2, seed=seed + 9), 1.6, 1.1) + relief
    c.height += 0.6 * (hash01(number, seed + 5) - 0.5) * (edge > 0)
    c.paint("2a1c12", 0.85 * smoothstep(0.4, -0.3, edge))
    return edge


def _nails(c: Canvas, spots: list[tuple[float, float]]) -> None:
    rivets(c, spots, 1.0, 0.4, "4a4846")


def wood_plank(width: int, height: int) -> Surface:
    """Upright planks of 16 texels, butted at different heights, nailed."""
    c = Canvas(width, height, 51)
    edge = _boards(c, OAK, 16.0, 1)
    number = np.floor(c.x / 16).astype(int)
    butt_at = np.where(number % 2 == 0, 30.0, 92.0) + 12.0 * (number % 3)
    butt = np.abs((c.y - butt_at + 64) % 128 - 64)
    c.tint(1.0 - 0.13 * ((c.y - butt_at) % 128 > 64))
    c.height -= 1.0 * smoothstep(0.8, 0.3, butt)
    c.paint("2a1c12", 0.85 * smoothstep(0.8, 0.4, butt))
    nails = [
        (i * 16 + dx, (30.0 if i % 2 == 0 else 92.0) + 12.0 * (i % 3) + dy)
        for i in range(8)
        for dx in (4, 12)
        for dy in (-4, 4)
    ]
    _nails(c, [(x, y % 128) for x, y in nails])
    c.grime("33241a", 0.35, 2.0)
    c.wear("c9a678", 0.25, 2.0, 0.2)
    c.tint(1.0 - 0.2 * smoothstep(0.2, 0.9, c.noise(40, 4, seed=30)) * (edge > 0))
    return c.surface()


def wood_beam(width: int, height: int) -> Surface:
    """A squared beam, adzed, with shakes along it."""
    c = Canvas(width, height, 52)
    relief = grain(c, BOG, np.zeros(c.x.shape, int), 1, upright=False)
    adze = c.cells((10, 7), 5, 0.9)
    edge = np.minimum(c.y, height - c.y)
    c.height = relief + c.bevel(edge, 2.5, 1.4) + 0.5 * adze.nearest
    shake = smoothstep(0.05, 0.0, np.abs(c.noise((70, 12), 3, 0.55, seed=6))) * smoothstep(
        0.1, 0.5, c.noise((50, 16), 2, seed=7)
    )
    c.height -= 0.9 * shake
    c.paint("271a12", 0.75 * shake)
    c.wear("b99a74", 0.35, 2.0, 0.2)
    return c.surface()


def wood_door(width: int, height: int) -> Surface:
    """Planks under three iron bands, a ring to pull."""
    c = Canvas(width, height, 53)
    edge = _boards(c, OAK, 16.0, 3)
    outer = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    for middle in (20.0, 108.0):
        band = 6.0 - np.abs(c.y - middle)
        iron_band(c, band, 40 + int(middle))
        rivets(c, grid(8.0, middle, width - 8.0, middle, 8, 1), 2.2, 1.3)
    strap = 4.5 - outer
    iron_band(c, strap, 45)
    mx, my = c.x - 100.0, c.y - 66.0
    plate = np.hypot(mx, my + 3) - 7.0
    iron_band(c, -plate, 46)
    ring = np.abs(np.hypot(mx, my - 4.0) - 6.0) - 1.3
    c.height += c.bevel(-ring, 1.3, 2.0)
    c.paint(c.ramp("8a5a34 b87e50 dcaa7c", 0.6 + 0.3 * c.noise(10, 2, seed=47)), c.mask(ring))
    c.gloss = np.where(ring < 0, 0.65, c.gloss)
    c.grime("2a1d14", 0.35, 2.5)
    c.tint(np.where(edge > 0, 1.0, 0.9))
    return c.surface()


def iron_band(c: Canvas, inside: np.ndarray, seed: int, high: float = 1.6) -> None:
    """Iron laid over what is there wherever `inside` (texels from its edge) is positive."""
    on = c.mask(-inside)
    c.height = c.height * (1 - on) + on * (high + 0.8 + 0.15 * c.noise(12, 3, seed=seed)) * smoothstep(-0.2, 1.0, inside)
    c.paint(c.ramp(IRON, 0.5 + 0.25 * c.noise(20, 4, seed=seed + 1)), on)
    c.paint(SOOT, 0.5 * np.exp(-((inside + 0.5) ** 2)))
    c.gloss = c.gloss * (1 - on) + on * (0.48 + 0.15 * c.noise(16, 3, seed=seed + 2))


def _crate(c: Canvas, ramp: str, seed: int) -> None:
    """A box's side of 64: boards behind a frame."""
    _boards(c, ramp, 64 / 5, seed, upright=False)
    outer = np.minimum(np.minimum(c.x, 64 - c.x), np.minimum(c.y, 64 - c.y))
    _overlay_board(c, 9.0 - outer, ramp, seed + 1, np.abs(c.x - 32) > np.abs(c.y - 32))


def _overlay_board(c: Canvas, inside: np.ndarray, ramp: str, seed: int, upright: np.ndarray | None = None) -> None:
    """Boards laid over what is there where `inside` is positive; their grain upright where asked."""
    over, flat = Canvas(c.width, c.height_texels, c.seed + 1), Canvas(c.width, c.height_texels, c.seed + 2)
    relief_up = grain(over, ramp, np.full(c.x.shape, seed), seed, True)
    relief = grain(flat, ramp, np.full(c.x.shape, seed + 1), seed, False)
    stand = np.zeros(c.x.shape, bool) if upright is None else upright
    on = c.mask(-inside)
    rgb = np.where(stand[..., None], over.color, flat.color)
    c.paint(rgb, on)
    c.height = c.height * (1 - on) + on * (2.6 * smoothstep(-0.2, 1.2, inside) + np.where(stand, relief_up, relief))
    c.tint(1.0 - 0.4 * np.exp(-(((inside + 0.7) / 0.8) ** 2)))


def crate_a(width: int, height: int) -> Surface:
    """A pine crate with a diagonal brace."""
    c = Canvas(width, height, 54)
    _crate(c, PINE, 5)
    outer = np.minimum(np.minimum(c.x, 64 - c.x), np.minimum(c.y, 64 - c.y))
    brace = np.minimum(5.0 - np.abs(c.x - (64 - c.y)) * 0.7071, outer - 8.8)
    _overlay_board(c, brace, PINE, 9)
    joint = np.abs(np.abs(c.x - 32) - np.abs(c.y - 32))
    c.height -= 0.8 * smoothstep(0.7, 0.2, joint) * (outer < 9)
    _nails(
        c,
        [(x, y) for x in (4.5, 59.5) for y in (4.5, 59.5)]
        + [(x, y) for x in (4.5, 59.5) for y in (20, 32, 44)]
        + [(x, y) for y in (4.5, 59.5) for x in (20, 32, 44)],
    )
    c.grime("4a321c", 0.45, 2.0)
    c.wear("f0dcb0", 0.3, 2.0, 0.25)
    return c.surface()


def crate_b(width: int, height: int) -> Surface:
    """A dark crate with iron corners and a stencilled wave."""
    c = Canvas(width, height, 55)
    _crate(c, BOG, 6)
    outer = np.minimum(np.minimum(c.x, 64 - c.x), np.minimum(c.y, 64 - c.y))
    wave = np.abs(c.y - 32 - 4.0 * np.sin((c.x - 32) * 2 * np.pi / 16.0)) - 1.6
    second = np.abs(c.y - 41 - 4.0 * np.sin((c.x - 32) * 2 * np.pi / 16.0)) - 1.6
    stencil = np.maximum(np.minimum(wave, second), np.abs(c.x - 32) - 16.5)
    c.paint("e4ead8", 0.8 * c.mask(stencil) * smoothstep(-0.6, 0.0, c.noise(6, 3, seed=20) + 0.3))
    corner = 16.0 - (np.minimum(c.x, 64 - c.x) + np.minimum(c.y, 64 - c.y))
    iron_band(c, np.minimum(corner, outer - 0.4), 30)
    rivets(c, [(x, y) for x in (5, 59) for y in (5, 59)], 2.0, 1.2)
    c.grime("241a14", 0.45, 2.0)
    return c.surface()


def barrel_side(width: int, height: int) -> Surface:
    """Staves with iron hoops."""
    c = Canvas(width, height, 56)
    _boards(c, BOG, 8.0, 7)
    for middle in (6.0, 20.0, 44.0, 58.0):
        hoop = 2.8 - np.abs(c.y - middle)
        iron_band(c, hoop, 60 + int(middle), 1.0)
        rivets(c, [(12.0, middle)], 1.3, 0.8)
    rust(c, 0.08, 80, 0.0)
    c.wear("b8a080", 0.25, 2.0, 0.2)
    return c.surface()


def barrel_top(width: int, height: int) -> Surface:
    """The barrel's lid: boards in a hoop, a bung."""
    c = Canvas(width, height, 57)
    _boards(c, BOG, 64 / 6, 8)
    radius = np.hypot(c.x - 32, c.y - 32)
    iron_band(c, radius - 26.0, 30)
    c.height -= 0.8 * (radius < 26)
    bung = np.hypot(c.x - 32, c.y - 44) - 4.0
    c.height += 1.6 * c.mask(bung, 1.0)
    c.paint("8c6a44", 0.8 * c.mask(bung))
    c.tint(1.0 - 0.4 * np.exp(-(((bung - 0.4) / 0.7) ** 2)))
    return c.surface(tiles=False)


_BINDINGS = ["963c34", "3c8478", "a88042", "56688c", "865078", "b89c6a", "487450", "c06848", "787068"]


def bookshelf(width: int, height: int) -> Surface:
    """Four shelves of books, some leaning, some gone."""
    c = Canvas(width, height, 58)
    shelf_high = 32.0
    down = c.y % shelf_high
    c.color = np.broadcast_to(np.array([0.34, 0.27, 0.21]), c.color.shape).copy()
    c.height -= 3.0
    for level in range(4):
        x, book = 3.0, 0
        while x < width - 5.0:
            key = level * 40 + book
            wide, tall = 4.0 + 4.5 * hash01(key, 1), 19.0 + 7.0 * hash01(key, 2)
            wide = min(float(wide), width - 4.0 - x)
            book += 1
            if hash01(key, 3) > 0.09:
                _book(c, level * shelf_high, x, float(wide), float(tall), key)
            x += wide
    c.tint(1.0 + 0.16 * c.noise((4, 14), 3, seed=300))
    board = np.abs(down - 30.0) - 2.0
    post = np.minimum(np.minimum(c.x, width - c.x) - 3.0, board)
    _overlay_board(c, -post, OAK, 12, np.minimum(c.x, width - c.x) < 3.0)
    c.gloss = np.clip(c.gloss, 0.1, 0.6)
    return c.surface()


def _book(c: Canvas, top: float, x: float, wide: float, tall: float, key: int) -> None:
    """One book's back on the shelf that begins at `top`, with bands and a title."""
    rows = slice(int(top * c.scale), int((top + 28.0) * c.scale))
    columns = slice(max(0, int((x - 3.0) * c.scale)), int((x + wide + 3.0) * c.scale))
    px, down = c.x[rows, columns], c.y[rows, columns] - top
    lean = 0.16 * (hash01(key, 4) - 0.5) if hash01(key, 5) > 0.7 else 0.0
    lx = px - x - 0.5 * wide - lean * (28.0 - down)
    inside = np.minimum(0.5 * wide - 0.35 - np.abs(lx), np.minimum(down - (28.0 - tall), 28.0 - down))
    on = c.mask(-inside)
    color = hex_to_srgb(_BINDINGS[int(hash01(key, 6) * len(_BINDINGS))])
    gilt = hex_to_srgb("d8b468" if hash01(key, 8) > 0.4 else "c9bfa8")
    bands = c.mask(np.minimum(np.abs(down - (28.0 - tall) - 4.0), np.abs(down - 23.5)) - 0.7)
    back = color + (gilt - color) * 0.8 * bands[..., None]
    c.color[rows, columns] += (back - c.color[rows, columns]) * on[..., None]
    round_ = np.sqrt(np.clip(1.0 - (lx / (0.5 * wide)) ** 2, 0.0, 1.0))
    c.height[rows, columns] = np.where(on > 0.5, 2.2 * round_ + 0.5 * hash01(key, 7) + 0.4 * bands, c.height[rows, columns])
    c.gloss[rows, columns] = np.where(on > 0.5, 0.35, c.gloss[rows, columns])
