"""Noise that tiles: gradient noise (Perlin 2002), its sums, and cells (Worley 1996), from hashed lattice points.

All functions take pixel coordinates as fractions of the picture, so a texture looks alike at any resolution. The hash is
our own choice of constants' source: "lowbias32" (Wellons 2018), so that pictures do not depend on numpy's generators.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


def hash01(*keys: np.ndarray | int) -> np.ndarray:
    """Numbers 0..1 from integer keys of one shape (or scalars)."""
    value = np.zeros(np.broadcast_shapes(*(np.shape(key) for key in keys)), np.uint32)
    with np.errstate(over="ignore"):
        for key in keys:
            value = value * np.uint32(0x9E3779B1) + np.asarray(key).astype(np.int64).astype(np.uint32) + np.uint32(0x68E31DA4)
            value ^= value >> np.uint32(16)
            value *= np.uint32(0x7FEB352D)
            value ^= value >> np.uint32(15)
            value *= np.uint32(0x846CA68B)
            value ^= value >> np.uint32(16)
    return value / np.float32(2**32)


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    """0 below `low`, 1 above `high` (or the other way round), smooth between."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _fade(t: np.ndarray) -> np.ndarray:
    return t * t * t * (t * (t * 6 - 15) + 10)


def _lattice(columns: int, rows: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Slopes across and down at the lattice's points, (rows, columns) each."""
    angle = hash01(np.arange(columns)[None, :], np.arange(rows)[:, None], seed) * np.float32(2.0 * np.pi)
    return np.cos(angle), np.sin(angle)


def _split(t: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Each place's lattice points before and after it, and how far it is between them."""
    scaled = (t * count).astype(np.float32)
    whole = np.floor(scaled)
    before = whole.astype(np.int32) % count
    return before, (before + 1) % count, scaled - whole


def gradient_noise(u: np.ndarray, v: np.ndarray, columns: int, rows: int, seed: int) -> np.ndarray:
    """Noise of about -1..1 on a lattice of columns x rows cells that repeats after u or v of 1.

    u and v are places (h, w) each; or a grid's columns (w,) and rows (h,), which is several times as fast.
    """
    columns, rows = max(1, int(columns)), max(1, int(rows))
    across, down = _lattice(columns, rows, seed)
    i0, i1, fx = _split(u, columns)
    j0, j1, fy = _split(v, rows)
    sx, sy = _fade(fx), _fade(fy)
    if u.ndim == 1:
        # Mixed along the lattice's rows first; a pixel then needs two of those.
        flat = across[:, i0] * (fx * (1 - sx)) + across[:, i1] * ((fx - 1) * sx)
        slope = down[:, i0] * (1 - sx) + down[:, i1] * sx
        fy, sy = fy[:, None], sy[:, None]
        top = flat[j0] + slope[j0] * fy
        return (top + (flat[j1] + slope[j1] * (fy - 1) - top) * sy) * np.float32(1.5)

    def corner(i: np.ndarray, j: np.ndarray, dx: np.ndarray, dy: np.ndarray) -> np.ndarray:
        at = j * columns + i
        return np.take(across, at) * dx + np.take(down, at) * dy

    top = corner(i0, j0, fx, fy)
    top += (corner(i1, j0, fx - 1, fy) - top) * sx
    low = corner(i0, j1, fx, fy - 1)
    low += (corner(i1, j1, fx - 1, fy - 1) - low) * sx
    return (top + (low - top) * sy) * np.float32(1.5)


def fractal_noise(
    u: np.ndarray, v: np.ndarray, columns: float, rows: float, seed: int, octaves: int = 4, gain: float = 0.5
) -> np.ndarray:
    """Octaves of gradient noise, each twice as fine and `gain` times as high; about -1..1. Places as for gradient_noise."""
    total, weight, height = np.float32(0.0), 0.0, 1.0
    for octave in range(octaves):
        total = total + np.float32(height) * gradient_noise(
            u, v, round(columns) << octave, round(rows) << octave, seed + 101 * octave
        )
        weight += height**2
        height *= gain
    return total / np.float32(weight**0.5)


@dataclass
class Cells:
    """Per pixel: the nearest and second nearest point's distance (in cells), the nearest's number, and where it lies."""

    nearest: np.ndarray
    second: np.ndarray
    number: np.ndarray
    dx: np.ndarray
    dy: np.ndarray

    def edge(self) -> np.ndarray:
        """Distance to the border between cells, in cells; 0 on it."""
        return 0.5 * (self.second - self.nearest)

    def random(self, seed: int) -> np.ndarray:
        """A number 0..1 for each cell."""
        return hash01(self.number, seed)


def cells(u: np.ndarray, v: np.ndarray, columns: int, rows: int, seed: int, jitter: float = 0.9) -> Cells:
    """One point in each of columns x rows cells, `jitter` of a cell off its middle; repeats after u or v of 1."""
    columns, rows = max(1, int(columns)), max(1, int(rows))
    x, y = u * columns, v * rows
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    out = Cells(*(np.full(x.shape, value) for value in (9.0, 9.0, 0, 0.0, 0.0)))
    for di in (-1, 0, 1):
        for dj in (-1, 0, 1):
            a, b = (i + di) % columns, (j + dj) % rows
            dx = x - (i + di + 0.5 + jitter * (hash01(a, b, seed) - 0.5))
            dy = y - (j + dj + 0.5 + jitter * (hash01(a, b, seed + 1) - 0.5))
            distance = np.hypot(dx, dy)
            closer = distance < out.nearest
            out.second = np.where(closer, out.nearest, np.minimum(out.second, distance))
            out.nearest = np.where(closer, distance, out.nearest)
            out.number = np.where(closer, a + columns * b, out.number)
            out.dx, out.dy = np.where(closer, dx, out.dx), np.where(closer, dy, out.dy)
    return out


def blur(image: np.ndarray, sigma: float) -> np.ndarray:
    """A Gaussian blur of `sigma` pixels over a picture (h, w) that tiles."""
    height, width = image.shape
    fy, fx = np.fft.fftfreq(height)[:, None], np.fft.rfftfreq(width)[None, :]
    return np.fft.irfft2(np.fft.rfft2(image) * np.exp(-2.0 * (np.pi * sigma) ** 2 * (fx**2 + fy**2)), s=image.shape)
