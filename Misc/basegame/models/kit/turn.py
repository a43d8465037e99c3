"""Rotations and two-bone limbs, for all frames of a model at once: arrays whose first axis is the frame."""

from __future__ import annotations

import numpy as np


def euler(angles: np.ndarray) -> np.ndarray:
    """(..., 3) degrees of pitch (nose down), yaw (to the left), roll (right side down) to matrices (..., 3, 3)."""
    pitch, yaw, roll = np.moveaxis(np.radians(np.asarray(angles, float)), -1, 0)
    return about("z", yaw) @ about("y", pitch) @ about("x", roll)


def about(axis: str, angle: np.ndarray) -> np.ndarray:
    """Right-handed rotation about a coordinate axis by radians (...)."""
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    rows = {
        "x": [[one, zero, zero], [zero, c, -s], [zero, s, c]],
        "y": [[c, zero, s], [zero, one, zero], [-s, zero, c]],
        "z": [[c, -s, zero], [s, c, zero], [zero, zero, one]],
    }[axis]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def units(v: np.ndarray) -> np.ndarray:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-9)


def apply(matrices: np.ndarray, v) -> np.ndarray:
    """(F, 3, 3) on (3) or (F, 3)."""
    return np.einsum("fij,fj->fi", matrices, np.broadcast_to(np.asarray(v, float), (len(matrices), 3)))


def blend(a: np.ndarray, b: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Rotations between `a` (share 0) and `b` (share 1), made orthonormal."""
    mixed = a + (b - a) * share[:, None, None]
    x = units(mixed[..., 0])
    y = units(mixed[..., 1] - x * np.sum(x * mixed[..., 1], axis=-1, keepdims=True))
    return np.stack([x, y, np.cross(x, y)], axis=-1)


def _basis(along: np.ndarray, pole: np.ndarray) -> np.ndarray:
    """Columns: along, hinge, and their product, for a limb that bends towards `pole`."""
    hinge = units(np.cross(pole, along))
    return np.stack([along, hinge, np.cross(along, hinge)], axis=-1)


def limb(
    start: np.ndarray, target: np.ndarray, pole: np.ndarray, upper: float, lower: float, rest_pole
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Two bones that at rest hang down and now reach from `start` (F, 3) towards `target`, bending towards `pole`.

    Returns the upper and lower bones' rotations (F, 3, 3), the joint's and the end's places (F, 3). What is out of
    reach is reached towards.
    """
    away = target - start
    distance = np.clip(np.linalg.norm(away, axis=1), abs(upper - lower) + 0.05 * lower, (upper + lower) * 0.998)
    along = units(away)
    pole = units(pole - along * np.sum(along * pole, axis=1, keepdims=True))
    cosine = np.clip((distance**2 + upper**2 - lower**2) / (2.0 * distance * upper), -1.0, 1.0)
    joint = start + along * (upper * cosine)[:, None] + pole * (upper * np.sqrt(1.0 - cosine**2))[:, None]
    end = start + along * distance[:, None]
    rest = _basis(np.array([[0.0, 0.0, -1.0]]), np.asarray(rest_pole, float)[None])
    inverse = np.swapaxes(rest, -1, -2)
    return (_basis(units(joint - start), pole) @ inverse, _basis(units(end - joint), pole) @ inverse, joint, end)
