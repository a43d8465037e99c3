"""Signed distances of plane figures (negative inside), after the usual formulas (Quilez 2020); (h, w) arrays, any unit."""

from __future__ import annotations

import numpy as np

Field = np.ndarray


def circle(x: Field, y: Field, cx: float, cy: float, radius: float) -> Field:
    return np.hypot(x - cx, y - cy) - radius


def ellipse(x: Field, y: Field, cx: float, cy: float, rx: float, ry: float) -> Field:
    """Near the outline a distance, elsewhere only of the right sign."""
    k = np.hypot((x - cx) / rx, (y - cy) / ry)
    slope = np.hypot((x - cx) / rx**2, (y - cy) / ry**2)
    return k * (k - 1.0) / np.maximum(slope, 1e-6)


def box(x: Field, y: Field, x0: float, y0: float, x1: float, y1: float, round_: float = 0.0) -> Field:
    """From (x0, y0) to (x1, y1), with corners rounded by a radius."""
    dx = np.abs(x - 0.5 * (x0 + x1)) - 0.5 * (x1 - x0) + round_
    dy = np.abs(y - 0.5 * (y0 + y1)) - 0.5 * (y1 - y0) + round_
    return np.hypot(np.maximum(dx, 0), np.maximum(dy, 0)) + np.minimum(np.maximum(dx, dy), 0) - round_


def segment(x: Field, y: Field, x0: float, y0: float, x1: float, y1: float, radius: float = 0.0) -> Field:
    """A line with round ends, `radius` to each side."""
    px, py, bx, by = x - x0, y - y0, x1 - x0, y1 - y0
    t = np.clip((px * bx + py * by) / max(bx * bx + by * by, 1e-9), 0.0, 1.0)
    return np.hypot(px - bx * t, py - by * t) - radius


def strokes(x: Field, y: Field, points: list[tuple[float, float]], radius: float) -> Field:
    """A line through points."""
    out = np.full(np.shape(x), 1e9)
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        out = np.minimum(out, segment(x, y, x0, y0, x1, y1, radius))
    return out


def polygon(x: Field, y: Field, points: list[tuple[float, float]]) -> Field:
    """A polygon without holes, its points in either order."""
    distance, inside = np.full(np.shape(x), 1e18), np.zeros(np.shape(x), bool)
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]):
        distance = np.minimum(distance, segment(x, y, x0, y0, x1, y1))
        crosses = (y0 > y) != (y1 > y)
        if y0 != y1:
            inside ^= crosses & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return np.where(inside, -distance, distance)


def ring(distance: Field, width: float) -> Field:
    """The outline of a figure, `width` wide."""
    return np.abs(distance) - 0.5 * width


def union(*fields: Field) -> Field:
    out = fields[0]
    for f in fields[1:]:
        out = np.minimum(out, f)
    return out


def cut(a: Field, b: Field) -> Field:
    """`a` without `b`."""
    return np.maximum(a, -b)


def star(x: Field, y: Field, cx: float, cy: float, points: int, outer: float, inner: float, turn: float = 0.0) -> Field:
    """A star, its first point up where `turn` (radians) is 0."""
    corners = []
    for i in range(2 * points):
        angle = turn + np.pi * i / points
        radius = outer if i % 2 == 0 else inner
        corners.append((cx + radius * np.sin(angle), cy - radius * np.cos(angle)))
    return polygon(x, y, corners)
