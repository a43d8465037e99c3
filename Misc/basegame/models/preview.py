#!/usr/bin/env python3
"""Draws frames of a model from several sides into a PNG, to judge shapes, skins and motion without the game.

preview.py MODEL.mdl OUT.png [--frames 0,5,9] [--yaw 35,-70] [--size 300] [--skin 0] [--view]

A row for each yaw (degrees, 0 faces the model), a column for each frame. `--view` looks along +x from the origin with
a field of view of 90 degrees, as at a weapon in the hand. Plain light, glowing colours at full strength.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from art.palette import GLOW_FIRST, PALETTE, linear_from_srgb, srgb_from_linear  # noqa: E402
from formats.mdl import Mdl, read_mdl  # noqa: E402
from formats.png import write_png  # noqa: E402

LINEAR = linear_from_srgb(PALETTE / 255.0)
LIGHT = np.array([0.45, 0.35, 0.82]) / np.linalg.norm([0.45, 0.35, 0.82])
BACK = np.array([0.027, 0.032, 0.042])  # linear, behind the model
PITCH = np.radians(10.0)


def _seen_from(yaw: float) -> np.ndarray:
    """Rows: right, up and towards the eye, for an eye at this yaw (degrees) a little above."""
    a = np.radians(yaw)
    toward = np.array([np.cos(a) * np.cos(PITCH), np.sin(a) * np.cos(PITCH), np.sin(PITCH)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return np.array([right, np.cross(toward, right), toward])


def _around(points: np.ndarray, yaw: float, centre: np.ndarray, scale: float, size: int) -> np.ndarray:
    """Picture x, y (down) and depth (greater is nearer) of points (V, 3)."""
    local = (points - centre) @ _seen_from(yaw).T
    return np.stack([size / 2 + local[:, 0] * scale, size / 2 - local[:, 1] * scale, local[:, 2]], axis=1)


def _through_the_eye(points: np.ndarray, size: int) -> np.ndarray:
    depth = np.where(points[:, 0] > 0.5, points[:, 0], np.nan)  # what is behind the eye is left out
    return np.stack([size / 2 * (1 - points[:, 1] / depth), size / 2 * (1 - points[:, 2] / depth), -depth], axis=1)


def _triangle(picture: np.ndarray, nearest: np.ndarray, corner: np.ndarray, shade) -> None:
    """Fills one triangle of corners (3, 3) where it is nearest; `shade` gives linear colours for weights (n, 3)."""
    size = len(picture)
    low = np.clip(np.floor(corner[:, :2].min(axis=0)).astype(int), 0, size)
    high = np.clip(np.ceil(corner[:, :2].max(axis=0)).astype(int) + 1, 0, size)
    (x0, y0), (x1, y1), (x2, y2) = corner[:, :2]
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if area >= 0 or (low >= high).any():
        return
    x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    a = ((x1 - x) * (y2 - y) - (x2 - x) * (y1 - y)) / area
    b = ((x2 - x) * (y0 - y) - (x0 - x) * (y2 - y)) / area
    weights = np.stack([a, b, 1 - a - b], axis=-1)
    depth = weights @ corner[:, 2]
    part = (slice(low[1], high[1]), slice(low[0], high[0]))
    shown = (weights >= 0).all(axis=-1) & (depth > nearest[part])
    picture[part][shown] = shade(weights[shown])
    nearest[part][shown] = depth[shown]


def draw(model: Mdl, pose: int, corners: np.ndarray, size: int, skin: int) -> np.ndarray:
    """One picture (size, size, 3), linear; `corners` are the vertices' places in it."""
    picture, nearest = np.tile(BACK, (size, size, 1)), np.full((size, size), -np.inf)
    image = model.skins[skin]
    limit = np.array(image.shape[::-1]) - 1
    for triangle in model.triangles:
        if np.isnan(corners[triangle]).any():
            continue

        def shade(weights: np.ndarray, triangle=triangle) -> np.ndarray:
            s, t = np.clip(np.round(weights @ model.texels[triangle]), 0, limit).astype(int).T
            index = image[t, s]
            normal = weights @ model.normals[pose][triangle]
            lit = 0.25 + np.clip(normal @ LIGHT, 0, 1) + 0.15 * normal[:, 2]
            return LINEAR[index] * np.where(index >= GLOW_FIRST, 1.6, lit)[:, None]

        _triangle(picture, nearest, corners[triangle], shade)
    return picture


def sheet(model: Mdl, frames: list[int], yaws: list[float], size: int, skin: int, view: bool) -> np.ndarray:
    """All pictures side by side (rows * size, columns * size, 3), sRGB bytes."""
    poses = [model.frames[frame].poses[0] for frame in frames]
    points = model.positions[poses].reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = 0.94 * size / max(np.hypot(*(high - low)[:2]) * 0.9, (high - low)[2])
    place = lambda pose, yaw: (
        _through_the_eye(model.positions[pose], size)
        if view
        else _around(model.positions[pose], yaw, (low + high) / 2, scale, size)
    )
    rows = [np.concatenate([draw(model, p, place(p, yaw), size, skin) for p in poses], axis=1) for yaw in yaws]
    return np.round(srgb_from_linear(np.concatenate(rows, axis=0)) * 255).astype(np.uint8)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--frames", default="0")
    parser.add_argument("--yaw", default="35")
    parser.add_argument("--size", type=int, default=300)
    parser.add_argument("--skin", type=int, default=0)
    parser.add_argument("--view", action="store_true")
    options = parser.parse_args()
    model = read_mdl(options.model.read_bytes())
    frames = [int(f) for f in options.frames.split(",")]
    if max(frames) >= len(model.frames) or options.skin >= len(model.skins):
        parser.error(f"{options.model} has {len(model.frames)} frames and {len(model.skins)} skins")
    yaws = [0.0] if options.view else [float(y) for y in options.yaw.split(",")]
    options.out.write_bytes(write_png(sheet(model, frames, yaws, options.size, options.skin, options.view)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
