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


def gradient_noise(u: np.ndarray, v: np.ndarray, columns: int, rows: int, seed: int) -> np.ndarray:
    """Noise of about -1..1 on a lattice of columns x rows cells that repeats after u or v of 1; (h, w) each."""
    columns, rows = max(1, int(columns)), max(1, int(rows))
    x, y = (u * columns).astype(np.float32), (v * rows).astype(np.float32)
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = x - i, y - j
    angle = hash01(np.arange(columns)[None, :], np.arange(rows)[:, None], seed) * np.float32(2.0 * np.pi)
    lattice = np.stack([np.cos(angle), np.sin(angle)])
    i0, j0 = i % columns, j % rows
    i1, j1 = (i0 + 1) % columns, (j0 + 1) % rows

    def corner(a: np.ndarray, b: np.ndarray, dx: np.ndarray, dy: np.ndarray) -> np.ndarray:
        return lattice[0, b, a] * dx + lattice[1, b, a] * dy

    sx, sy = fx * fx * fx * (fx * (fx * 6 - 15) + 10), fy * fy * fy * (fy * (fy * 6 - 15) + 10)
    top = corner(i0, j0, fx, fy) * (1 - sx) + corner(i1, j0, fx - 1, fy) * sx
    low = corner(i0, j1, fx, fy - 1) * (1 - sx) + corner(i1, j1, fx - 1, fy - 1) * sx
    return (top * (1 - sy) + low * sy) * 1.5


def fractal_noise(u: np.ndarray, v: np.ndarray, columns: float, rows: float, seed: int, octaves: int = 4,
                  gain: float = 0.5) -> np.ndarray:
    """Octaves of gradient noise, each twice as fine and `gain` times as high; about -1..1."""
    total, weight, height = np.zeros(u.shape, np.float32), 0.0, 1.0
    for octave in range(octaves):
        total += height * gradient_noise(u, v, round(columns) << octave, round(rows) << octave, seed + 101 * octave)
        weight += height**2
        height *= gain
    return total / weight**0.5


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
