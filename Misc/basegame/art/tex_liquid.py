"""Liquids (64x64, they swing in the renderer) and skies (256x128: near layer with holes, then far layer)."""

from __future__ import annotations

import numpy as np

from art.canvas import Canvas
from art.noise import blur, smoothstep
from art.palette import RAMPS, heat, hex_to_srgb
from art.surface import Surface

# Slag is no flame: it stays below what a lamp has.
LAVA = " ".join(["3a0a02", "7d1c03", "c43c05", heat(1600), heat(2000), heat(2500), heat(3000)])


def _web(c: Canvas, size: float, seed: int, warp: float) -> np.ndarray:
    """Bright lines like light under water: 1 on cells' borders."""
    net = c.cells(size, seed, 0.9, warp=warp)
    return smoothstep(0.16, 0.0, net.edge())


def _water(seed: int, ramp: str, row: str) -> Surface:
    c = Canvas(64, 64, seed, scale=1)
    deep = c.noise(32, 3, 0.5, seed=1)
    web = 0.65 * _web(c, 16, 2, 6.0) + 0.35 * _web(c, 9, 3, 3.5)
    c.color = c.ramp(ramp, 0.36 + 0.18 * deep + 0.5 * blur(web, 0.8))
    return Surface(c.color, palette=RAMPS[row], dither=0.015)


def water_a(width: int, height: int) -> Surface:
    """The drowned works' water: deep teal."""
    return _water(131, "05120f 10332f 265d52 4a8f7c 82c0a9", "verdigris")


def water_b(width: int, height: int) -> Surface:
    """Open water: bluer."""
    return _water(132, "081a34 103668 1a56a8 3a86e0 7cc4ff", "blue")


def water_still(width: int, height: int) -> Surface:
    """A pool's that nothing moves, for measurements: clear, so that it has next to no colour of its own, and smooth as a mirror."""
    color = np.broadcast_to(hex_to_srgb("0d1413"), (height, width, 3)).copy()
    return Surface(color, gloss=np.ones((height, width)), dither=0.0)


def slime_a(width: int, height: int) -> Surface:
    """Alchemists' slime: yellow-green, with bubbles."""
    c = Canvas(64, 64, 133, scale=1)
    flow = c.noise(26, 3, 0.5, seed=1, warp=6.0 * c.noise(30, 2, seed=2))
    bubbles = c.cells(9, 3, 1.0)
    radius = 0.14 + 0.24 * bubbles.random(4)
    ring = smoothstep(0.07, 0.0, np.abs(bubbles.nearest - radius)) * (bubbles.random(5) < 0.45)
    c.color = c.ramp("1b1f0a 2b2f10 525a20 7f883a b6bb6c", 0.45 + 0.36 * flow + 0.4 * ring)
    return Surface(c.color, palette=sorted(RAMPS["olive"] + RAMPS["yellow"]), dither=0.015)


def lava_a(width: int, height: int) -> Surface:
    """Slag from the furnaces: dark crust afloat on fire."""
    c = Canvas(64, 64, 134, scale=1)
    crust = c.cells(16, 1, 0.95, warp=6.0)
    hot = 1.0 - smoothstep(0.0, 0.24, crust.edge() + 0.07 * c.noise(9, 3, seed=2))
    hotness = np.clip(0.1 + 0.78 * hot + 0.16 * c.noise(16, 3, seed=3), 0.0, 1.0)
    c.color = c.ramp(f"1c0402 {LAVA}", hotness)
    return Surface(c.color, glow=hotness > 0.22, dither=0.01)


def teleport(width: int, height: int) -> Surface:
    """A door of the monks' making: violet night with stars drawn into threads."""
    c = Canvas(64, 64, 135, scale=1)
    swirl = c.noise(24, 3, 0.5, seed=1, warp=9.0 * c.noise(32, 2, seed=2))
    threads = smoothstep(0.16, 0.0, np.abs(c.noise(28, 3, 0.5, seed=3, warp=9.0 * c.noise(32, 2, seed=4))))
    c.color = c.ramp("120817 33193f 643f7b 9f7bb0 d9bfe0", 0.3 + 0.3 * swirl + 0.5 * threads)
    stars = c.cells(8, 5, 1.0)
    size = 0.1 + 0.12 * stars.random(6)
    star = (stars.nearest < size) & (stars.random(7) < 0.5)
    c.color = np.where(star[..., None], np.array([0.87, 0.97, 1.0]), c.color)
    return Surface(c.color, glow=star, palette=sorted(RAMPS["mauve"] + RAMPS["blue"]), dither=0.015)


def _sky(far: np.ndarray, near: np.ndarray, cover: np.ndarray, rows: str) -> Surface:
    """The two layers side by side, in colours of a few rows; index 0 is where the near one is open, and nowhere else."""
    color = np.concatenate([near, far], axis=1)
    holes = np.concatenate([cover <= 0.0, np.zeros(cover.shape, bool)], axis=1)
    palette = [i for row in rows.split() for i in RAMPS[row] if i != 0]
    return Surface(color, open_sky=holes, palette=palette, dither=0.026)


def _layer(seed: int) -> Canvas:
    return Canvas(128, 128, seed, scale=1)


def _clouds(c: Canvas, size: float, seed: int) -> np.ndarray:
    """Heaped clouds, about -1..1."""
    bend = 0.22 * size * c.noise(size, 3, seed=seed + 1)
    billow = 1.0 - 2.0 * np.abs(c.noise(size * 0.6, 4, 0.5, seed=seed + 2, warp=bend))
    return 0.75 * c.noise(size, 4, 0.5, seed=seed, warp=bend) + 0.3 * billow


def sky_night(width: int, height: int) -> Surface:
    """Blue night: stars, a pale river of them, thin clouds."""
    c = _layer(141)
    river = smoothstep(0.1, 1.1, c.noise(90, 4, 0.55, seed=1))
    far = c.ramp("081a34 0c284e 103668 16468a 1a56a8", 0.22 + 0.16 * c.noise(60, 3, seed=2) + 0.38 * river)
    for size, share, seed in ((5, 0.18, 3), (11, 0.45, 4)):
        stars = c.cells(size, seed, 1.0)
        bright = np.clip(1.0 - stars.nearest * size / (0.5 + 0.7 * stars.random(5)), 0, 1) * (stars.random(6) < share)
        far = far + bright[..., None] * (np.array([0.86, 0.92, 1.0]) - far) * (0.5 + 0.5 * stars.random(7))[..., None]
    d = _layer(142)
    cloud = _clouds(d, 64, 1) - 0.2
    near = d.ramp("0c2a50 103668 154684 1a56a8", 0.9 * cloud)
    return _sky(far, near, cloud, "blue")


def sky_dusk(width: int, height: int) -> Surface:
    """A low sun behind haze: apricot and cream in long streaks, a few thin clouds, cream at the rim and slate at heart."""
    c = _layer(144)
    streaks = c.noise((128, 32), 4, 0.5, seed=1, warp=8.0 * c.noise(64, 2, seed=2))
    # The palette's steps between these hues are wide: mixing them by a pattern hides their borders.
    far = c.ramp("f8b673 ffc993 f3d9bd", 0.68 + 0.4 * streaks + 0.1 * c.noise(64, 3, seed=3) + 0.3 * c.pattern())
    d = _layer(145)
    drift = d.noise((64, 32), 5, 0.5, seed=9, warp=9.0 * d.noise(32, 3, seed=6)) + 0.35 * d.noise(128, 2, seed=7)
    cloud = drift - 0.15 + 0.1 * d.pattern()
    near = d.ramp("f3d9bd dccbbe bdbcbc a3abb8 8e9cb0", 0.95 * cloud + 0.12 * d.pattern())
    return _sky(far, near, cloud, "tan ember grey slate")


def sky_storm(width: int, height: int) -> Surface:
    """Rain to come: slate on slate."""
    c = _layer(147)
    far = c.ramp("546a84 738299 96a5b8 b9c7d8", 0.5 + 0.42 * _clouds(c, 80, 1))
    d = _layer(148)
    cloud = _clouds(d, 64, 5) + 0.1
    near = d.ramp("7a8aa0 5c6c82 46546a 343f50", 1.2 * cloud)
    return _sky(far, near, cloud, "slate")
