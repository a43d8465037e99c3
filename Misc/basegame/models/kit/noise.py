"""Value noise in three dimensions: the grain of everything painted here. Pure functions of position and seed."""

from __future__ import annotations

import numpy as np


def _hash(x: np.ndarray, y: np.ndarray, z: np.ndarray, seed: int) -> np.ndarray:
    """Lattice points (ints) to 0..1."""
    h = (x * 374761393 + y * 668265263 + z * 2147483647 + seed * 974634777).astype(np.uint64) & 0xFFFFFFFF
    h = ((h ^ (h >> np.uint64(13))) * np.uint64(1274126177)) & np.uint64(0xFFFFFFFF)
    h = ((h ^ (h >> np.uint64(16))) * np.uint64(2246822519)) & np.uint64(0xFFFFFFFF)
    return ((h ^ (h >> np.uint64(15))) & np.uint64(0xFFFF)).astype(float) / 65535.0


def value_noise(points: np.ndarray, seed: int = 0) -> np.ndarray:
    """Smooth noise 0..1 at `points` (..., 3), one lattice cell a unit."""
    cell = np.floor(points).astype(np.int64)
    f = points - cell
    f = f * f * (3.0 - 2.0 * f)
    total = np.zeros(points.shape[:-1])
    for corner in range(8):
        dx, dy, dz = corner & 1, corner >> 1 & 1, corner >> 2
        weight = np.ones(points.shape[:-1])
        for axis, d in enumerate((dx, dy, dz)):
            weight = weight * (f[..., axis] if d else 1.0 - f[..., axis])
        total += weight * _hash(cell[..., 0] + dx, cell[..., 1] + dy, cell[..., 2] + dz, seed)
    return total


def fbm(points: np.ndarray, size: float, octaves: int = 3, seed: int = 0) -> np.ndarray:
    """Noise 0..1, mean 0.5, whose largest features span `size` units."""
    total, weight, sum_ = 0.0, 1.0, 0.0
    for octave in range(octaves):
        total = total + weight * value_noise(points / size * 2.0**octave + 17.3 * octave, seed + 31 * octave)
        sum_ += weight
        weight *= 0.55
    return total / sum_
