"""A letter of our own for signs, titles and menus: strokes of a broad pen held at a slant, capitals after the uncials.

A letter is strokes in a box as high as 1 (y down, 0 its top, 1 the line it stands on). The pen's tip is an ellipse; the
distance to its track is that to the strokes after a linear map that makes the tip a circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from art.shapes import segment

Point = tuple[float, float]
Stroke = list[Point]


def _arc(cx: float, cy: float, rx: float, ry: float, start: float, end: float) -> Stroke:
    """Points of an ellipse's arc; degrees, 0 to the right, 90 down."""
    count = max(3, int(abs(end - start) / 20.0))
    angles = np.deg2rad(np.linspace(start, end, count + 1))
    return [(cx + rx * float(np.cos(a)), cy + ry * float(np.sin(a))) for a in angles]


@cache
def _letters() -> dict[str, tuple[float, list[Stroke]]]:
    """Each letter's width and strokes."""
    round_ = _arc(0.42, 0.5, 0.36, 0.5, -48, -312)
    return {
        "A": (0.80, [[(0.03, 1), (0.40, 0), (0.77, 1)], [(0.19, 0.64), (0.61, 0.64)]]),
        "B": (
            0.66,
            [
                [(0.10, 0), (0.10, 1)],
                [(0.10, 0), *_arc(0.28, 0.24, 0.24, 0.24, -90, 90), (0.10, 0.48)],
                [(0.10, 0.48), *_arc(0.30, 0.74, 0.28, 0.26, -90, 90), (0.10, 1)],
            ],
        ),
        "C": (0.74, [round_]),
        "D": (0.78, [[(0.10, 0), (0.10, 1)], [(0.10, 0), *_arc(0.28, 0.5, 0.42, 0.5, -90, 90), (0.10, 1)]]),
        "E": (0.70, [round_, [(0.08, 0.5), (0.62, 0.5)]]),
        "F": (0.62, [[(0.10, 0), (0.10, 1)], [(0.10, 0.02), (0.60, 0.02)], [(0.10, 0.48), (0.48, 0.48)]]),
        "G": (0.80, [round_, [(0.72, 0.98), (0.72, 0.56), (0.48, 0.56)]]),
        "H": (0.76, [[(0.10, 0), (0.10, 1)], [(0.66, 0), (0.66, 1)], [(0.10, 0.5), (0.66, 0.5)]]),
        "I": (0.24, [[(0.12, 0), (0.12, 1)]]),
        "J": (0.46, [[(0.34, 0), (0.34, 0.75), *_arc(0.16, 0.76, 0.18, 0.24, 20, 150)]]),
        "K": (0.70, [[(0.10, 0), (0.10, 1)], [(0.62, 0), (0.12, 0.54)], [(0.26, 0.42), (0.66, 1)]]),
        "L": (0.58, [[(0.10, 0), (0.10, 1), (0.56, 0.98)]]),
        "M": (0.98, [[(0.06, 1), (0.16, 0), (0.49, 0.82), (0.82, 0), (0.92, 1)]]),
        "N": (0.78, [[(0.10, 1), (0.10, 0), (0.68, 1), (0.68, 0)]]),
        "O": (0.84, [_arc(0.42, 0.5, 0.36, 0.5, 0, 360)]),
        "P": (0.64, [[(0.10, 0), (0.10, 1)], [(0.10, 0), *_arc(0.28, 0.28, 0.28, 0.28, -90, 90), (0.10, 0.56)]]),
        "Q": (0.86, [_arc(0.42, 0.5, 0.36, 0.5, 0, 360), [(0.50, 0.72), (0.82, 1.08)]]),
        "R": (
            0.70,
            [
                [(0.10, 0), (0.10, 1)],
                [(0.10, 0), *_arc(0.28, 0.26, 0.26, 0.26, -90, 90), (0.10, 0.52)],
                [(0.28, 0.52), (0.66, 1)],
            ],
        ),
        "S": (0.62, [[*_arc(0.32, 0.25, 0.24, 0.25, -30, -270), *_arc(0.32, 0.75, 0.24, 0.25, -90, 150)]]),
        "T": (0.68, [[(0.34, 0), (0.34, 1)], [(0.03, 0.02), (0.65, 0.02)]]),
        "U": (0.76, [[(0.10, 0), (0.10, 0.6), *_arc(0.38, 0.62, 0.28, 0.38, 170, 10), (0.66, 0.6), (0.66, 0)]]),
        "V": (0.74, [[(0.03, 0), (0.37, 1), (0.71, 0)]]),
        "W": (1.04, [[(0.03, 0), (0.27, 1), (0.52, 0.2), (0.77, 1), (1.01, 0)]]),
        "X": (0.72, [[(0.06, 0), (0.66, 1)], [(0.66, 0), (0.06, 1)]]),
        "Y": (0.70, [[(0.04, 0), (0.35, 0.5), (0.66, 0)], [(0.35, 0.5), (0.35, 1)]]),
        "Z": (0.68, [[(0.08, 0.02), (0.62, 0.02), (0.06, 0.98), (0.64, 0.98)]]),
        "0": (0.66, [_arc(0.33, 0.5, 0.25, 0.5, 0, 360)]),
        "1": (0.44, [[(0.08, 0.2), (0.26, 0), (0.26, 1)], [(0.08, 0.99), (0.42, 0.99)]]),
        "2": (0.62, [[*_arc(0.31, 0.27, 0.23, 0.27, -170, 30), (0.07, 0.98), (0.58, 0.98)]]),
        "3": (0.60, [[*_arc(0.28, 0.25, 0.23, 0.25, -150, 90)], [*_arc(0.28, 0.75, 0.25, 0.25, -90, 150)]]),
        "4": (0.66, [[(0.46, 1), (0.46, 0), (0.05, 0.68), (0.63, 0.68)]]),
        "5": (0.62, [[(0.54, 0.02), (0.14, 0.02), (0.11, 0.45), *_arc(0.29, 0.69, 0.26, 0.31, -110, 145)]]),
        "6": (0.64, [[(0.50, 0.02), (0.20, 0.35), *_arc(0.32, 0.70, 0.25, 0.30, -160, 200)]]),
        "7": (0.60, [[(0.06, 0.02), (0.56, 0.02), (0.22, 1)]]),
        "8": (0.62, [_arc(0.31, 0.24, 0.20, 0.24, 90, 450), _arc(0.31, 0.74, 0.25, 0.26, -90, 270)]),
        "9": (0.64, [[*_arc(0.32, 0.30, 0.25, 0.30, 20, 380), (0.56, 0.42), (0.26, 1)]]),
        "-": (0.50, [[(0.08, 0.54), (0.42, 0.54)]]),
        "+": (0.60, [[(0.08, 0.54), (0.52, 0.54)], [(0.30, 0.30), (0.30, 0.78)]]),
        ":": (0.26, [[(0.13, 0.36), (0.13, 0.37)], [(0.13, 0.86), (0.13, 0.87)]]),
        "/": (0.50, [[(0.46, -0.04), (0.04, 1.04)]]),
        ".": (0.24, [[(0.12, 0.96), (0.12, 0.97)]]),
        ",": (0.24, [[(0.14, 0.94), (0.08, 1.12)]]),
        "!": (0.24, [[(0.12, 0), (0.12, 0.66)], [(0.12, 0.96), (0.12, 0.97)]]),
        "'": (0.20, [[(0.12, 0), (0.08, 0.2)]]),
        "(": (0.34, [_arc(0.40, 0.5, 0.28, 0.62, -120, -240)]),
        ")": (0.34, [_arc(-0.06, 0.5, 0.28, 0.62, -60, 60)]),
        " ": (0.40, []),
    }


@dataclass(frozen=True)
class Pen:
    """The tip: half its breadth and half its thickness as shares of the letters' height, and its slant in degrees."""

    broad: float = 0.10
    thin: float = 0.045
    slant: float = 32.0


def text_width(text: str, high: float, spacing: float = 0.14) -> float:
    """How far a line of text reaches, in the unit of `high`, without space after it."""
    return high * (sum(_letters()[letter][0] + spacing for letter in text.upper()) - spacing)


def text_distance(
    x: np.ndarray,
    y: np.ndarray,
    text: str,
    left: float,
    top: float,
    high: float,
    pen: Pen = Pen(),
    spacing: float = 0.14,
    reach: float = 0.3,
) -> np.ndarray:
    """Signed distance (about) to a line of text; x and y are a grid's coordinates (h, w), y down.

    Farther than `reach` times the letters' height from a letter's box it is only known to be large.
    """
    out = np.full(x.shape, 1e9)
    angle = np.deg2rad(pen.slant)
    stretch = pen.broad / pen.thin
    at = left
    for letter in text.upper():
        wide, strokes = _letters()[letter]
        margin = high * reach
        columns = np.flatnonzero((x[0] > at - margin) & (x[0] < at + wide * high + margin))
        if columns.size and strokes:
            window = slice(columns[0], columns[-1] + 1)
            lx, ly = (x[:, window] - at) / high, (y[:, window] - top) / high
            # Along and across the tip; across counts for more, so that the tip becomes a circle of radius `broad`.
            a, b = lx * np.cos(angle) - ly * np.sin(angle), (lx * np.sin(angle) + ly * np.cos(angle)) * stretch
            near = np.full(lx.shape, 1e9)
            for stroke in strokes:
                turned = [
                    (px * np.cos(angle) - py * np.sin(angle), (px * np.sin(angle) + py * np.cos(angle)) * stretch)
                    for px, py in stroke
                ]
                for (x0, y0), (x1, y1) in zip(turned, turned[1:]):
                    near = np.minimum(near, segment(a, b, x0, y0, x1, y1))
            out[:, window] = np.minimum(out[:, window], (near - pen.broad) * high / (0.5 + 0.5 * stretch))
        at += high * (wide + spacing)
    return out
