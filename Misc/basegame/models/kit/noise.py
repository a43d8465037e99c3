"""Value noise in three dimensions: the grain of everything painted here. Pure functions of position and seed."""

from __future__ import annotations

import numpy as np


def _mixed(h: np.ndarray) -> np.ndarray:
    """Lattice numbers (uint32) to 0..1, scattered."""
    h = (h ^ (h >> np.uint32(13))) * np.uint32(1274126177)
    h = (h ^ (h >> np.uint32(16))) * np.uint32(2246822519)
    return (h >> np.uint32(8)).astype(np.float32) / np.float32(1 << 24)


def value_noise(points: np.ndarray, seed: int = 0) -> np.ndarray:
    """Smooth noise 0..1 at `points` (..., 3), one lattice cell a unit."""
    cell = np.floor(points)
    f = points - cell
    f = f * f * (3.0 - 2.0 * f)
    lattice = cell.astype(np.int64).astype(np.uint32) * np.array([374761393, 668265263, 2147483647], np.uint32)
    step = np.array([374761393, 668265263, 2147483647], np.uint32)
    start = np.uint32(seed * 974634777 & 0xFFFFFFFF)
    along_z = []
    for dz in (0, 1):
        along_y = []
        for dy in (0, 1):
            base = lattice[..., 1] + np.uint32(dy) * step[1] + lattice[..., 2] + np.uint32(dz) * step[2] + start
            near, far = _mixed(lattice[..., 0] + base), _mixed(lattice[..., 0] + step[0] + base)
            along_y.append(near + (far - near) * f[..., 0])
        along_z.append(along_y[0] + (along_y[1] - along_y[0]) * f[..., 1])
    return along_z[0] + (along_z[1] - along_z[0]) * f[..., 2]


def fbm(points: np.ndarray, size: float, octaves: int = 3, seed: int = 0) -> np.ndarray:
    """Noise 0..1, mean 0.5, whose largest features span `size` units."""
    total, weight, sum_ = 0.0, 1.0, 0.0
    for octave in range(octaves):
        total = total + weight * value_noise(points / size * 2.0**octave + 17.3 * octave, seed + 31 * octave)
        sum_ += weight
        weight *= 0.55
    return total / sum_
