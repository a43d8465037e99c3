"""Doors with their keys' colours, grates and chains."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.canvas import Canvas
from art.noise import smoothstep
from art.palette import RAMPS, hex_to_srgb
from art.surface import Surface
from art.tex_grown import bleed
from art.tex_metal import IRON, SOOT, frame_spots, grid, rivets, rust, sheet

GOLD = "7a5418 a87a24 d2a23c ecc868 f8e4a4"
SILVER = "6c7a88 93a1ae b6c1ca d4dce0 eef2f2"


def _leaf(seed: int, width: int, height: int, tone: float = 0.45) -> tuple[Canvas, np.ndarray]:
    """An iron leaf with a raised frame; gives the distance from its border."""
    c = Canvas(width, height, seed)
    sheet(c, IRON, tone, 1)
    border = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    frame = smoothstep(11.5, 10.0, border)
    c.height += 2.4 * frame
    c.tint(1.0 - 0.4 * np.exp(-(((border - 11.6) / 0.8) ** 2)))
    rivets(c, frame_spots(5.5, 5.5, width - 5.5, height - 5.5, 13.0), 2.2, 1.4)
    gap = smoothstep(1.1, 0.3, border)
    c.height -= 1.5 * gap
    c.paint(SOOT, 0.8 * gap)
    return c, border


def inlay(c: Canvas, distance: np.ndarray, ramp: str, high: float = 1.5, seed: int = 60, gloss: float = 0.7) -> None:
    """A figure in another metal, raised on the ground."""
    c.height += c.bevel(-distance, 1.6, high)
    c.tint(1.0 - 0.45 * np.exp(-(((distance - 0.5) / 0.8) ** 2)))
    c.paint(c.ramp(ramp, 0.58 + 0.2 * c.noise(14, 3, seed=seed)), c.mask(distance))
    c.gloss = np.where(distance < 0, gloss + 0.08 * c.noise(9, 3, seed=seed + 1), c.gloss)


def _sun(x: np.ndarray, y: np.ndarray, cx: float, cy: float) -> np.ndarray:
    """A disc in rays: the gold key's sign."""
    disc = shapes.circle(x, y, cx, cy, 10.0)
    rays = shapes.cut(shapes.star(x, y, cx, cy, 12, 25.0, 13.0), shapes.circle(x, y, cx, cy, 12.0))
    return shapes.union(disc, rays)


def _moon(x: np.ndarray, y: np.ndarray, cx: float, cy: float) -> np.ndarray:
    """A crescent and a star: the silver key's sign."""
    crescent = shapes.cut(shapes.circle(x, y, cx, cy, 23.0), shapes.circle(x, y, cx + 10.0, cy - 5.0, 19.0))
    return shapes.union(crescent, shapes.star(x, y, cx + 10.0, cy - 5.0, 4, 10.0, 3.4))


def _keyhole(c: Canvas, cx: float, cy: float, ramp: str) -> None:
    plate = shapes.box(c.x, c.y, cx - 7, cy - 10, cx + 7, cy + 10, 6.0)
    inlay(c, plate, ramp, 1.2, 70)
    hole = shapes.union(
        shapes.circle(c.x, c.y, cx, cy - 2.5, 2.8),
        shapes.polygon(c.x, c.y, [(cx, cy - 2), (cx + 2.6, cy + 7), (cx - 2.6, cy + 7)]),
    )
    c.height -= 2.0 * c.mask(hole, 1.0)
    c.paint("0c0c0e", c.mask(hole))


def _sign_door(seed: int, width: int, height: int, ramp: str, sign: str) -> Surface:
    c, border = _leaf(seed, width, height)
    mx, my = 0.5 * width, 50.0
    shield = shapes.circle(c.x, c.y, mx, my, 33.0)
    c.height += 1.0 * c.mask(shield, 2.0)
    inlay(c, shapes.ring(shield, 3.6), ramp, 1.6, 50)
    inlay(c, _sun(c.x, c.y, mx, my) if sign == "sun" else _moon(c.x, c.y, mx, my), ramp, 2.0, 52)
    for y in (92.0, 110.0):
        inlay(c, shapes.box(c.x, c.y, 16, y - 3.5, width - 16, y + 3.5, 3.0), ramp, 1.4, 54)
    _keyhole(c, mx, 101.0, ramp)
    rust(c, 0.04, 80, -0.3 * smoothstep(0.55, 0.7, c.gloss))
    c.grime("28241e", 0.35, 2.5, 1.2)
    return c.surface()


def door_gold(width: int, height: int) -> Surface:
    """Opens to the gold key: a sun of brass on iron."""
    return _sign_door(101, width, height, GOLD, "sun")


def door_silver(width: int, height: int) -> Surface:
    """Opens to the silver key: a moon of silver on iron."""
    return _sign_door(102, width, height, SILVER, "moon")


def door_iron(width: int, height: int) -> Surface:
    """A plain door: four sunk panels, three hinged bands."""
    c, border = _leaf(103, width, height, 0.5)
    px, py = (c.x - 11) % 53 - 26.5, (c.y - 11) % 35.33 - 17.67
    panel = np.minimum(26.5 - np.abs(px), 17.67 - np.abs(py))
    inside = (border > 11) * 1.0
    c.height -= inside * 1.6 * smoothstep(3.4, 5.4, panel)
    c.tint(1.0 - 0.22 * inside * np.exp(-(((panel - 4.6) / 1.2) ** 2)))
    rivets(c, grid(37.5, 28.7, 90.5, 99.3, 2, 3), 2.6, 1.6)
    rust(c, 0.16, 80, 0.3 * smoothstep(6.0, 3.0, panel) * inside)
    c.wear("b6b8b4", 0.5, 2.0, 0.25, gloss=0.15)
    c.paint(SOOT, 0.3 * c.streaks(5, share=0.3))
    return c.surface()


def door_rune(width: int, height: int) -> Surface:
    """A stone leaf with a ring of glowing signs."""
    c = Canvas(width, height, 104)
    c.color = c.ramp("3f4b57 5b6a78 768894 96a6ae", 0.5 + 0.22 * c.noise(44, 4, seed=1))
    c.height = 0.25 * c.noise(20, 5, 0.55, seed=2)
    c.gloss = 0.35 + 0.1 * c.noise(24, 3, seed=3)
    border = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    c.height += 2.0 * smoothstep(9.5, 8.0, border)
    split = np.abs(c.x - 64.0)
    c.height -= 1.6 * smoothstep(1.3, 0.3, split)
    c.paint("23272b", 0.8 * np.maximum(smoothstep(1.2, 0.4, split), smoothstep(1.1, 0.4, border)))
    mx, my = c.x - 64.0, c.y - 64.0
    radius = np.hypot(mx, my)
    rim = np.minimum(np.abs(radius - 47.0), np.abs(radius - 27.0)) - 1.6
    c.height += 1.6 * c.mask(rim, 1.6)
    c.grain(0.1, 0.12)
    c.grime("2f3a36", 0.4, 2.5)
    lit = np.full(c.x.shape, 1e9)
    for i in range(8):
        a = 2 * np.pi * (i + 0.5) / 8
        lx, ly = mx - 37.0 * np.cos(a), my - 37.0 * np.sin(a)
        lit = np.minimum(lit, rune_sign(lx * -np.sin(a) + ly * np.cos(a), lx * np.cos(a) + ly * np.sin(a), i, 6.0))
    lit = np.minimum(lit, rune_sign(mx, my, 8, 17.0))
    engrave(c, np.maximum(lit, 1.6 - split), "5fb8ff")
    return c.surface(palette=STONE_INDICES)


STONE_INDICES = sorted(RAMPS["grey"] + RAMPS["slate"] + RAMPS["verdigris"])


def engrave(c: Canvas, distance: np.ndarray, color: str) -> None:
    """A groove with light at its bottom."""
    c.height -= 1.5 * c.mask(distance - 0.5, 1.5)
    c.shine = 0.45
    lit = c.mask(distance) > 0.5
    c.color = np.where(lit[..., None], hex_to_srgb(color), c.color)
    c.glow = lit if c.glow is None else c.glow | lit


# Strokes of the script's signs in a square of -1..1; every sign stands on a stem or a bowl.
_SIGNS: list[list[list[tuple[float, float]]]] = [
    [[(0, -1), (0, 1)], [(-0.7, -0.4), (0, -1), (0.7, -0.4)]],
    [[(-0.6, -1), (-0.6, 1)], [(-0.6, -0.2), (0.6, -1), (0.6, 0.3), (-0.6, 1)]],
    [[(-0.7, 1), (0, -0.2), (0.7, 1)], [(0, -1), (0, -0.2)], [(-0.5, -0.7), (0.5, -0.7)]],
    [[(0, -1), (0, 1)], [(-0.7, 0), (0.7, 0)], [(-0.4, 0.7), (0.4, 0.7)]],
    [[(-0.7, -1), (0.7, -0.3), (-0.7, 0.3), (0.7, 1)]],
    [[(-0.6, -1), (-0.6, 0.2), (0, 1), (0.6, 0.2), (0.6, -1)], [(0, -0.6), (0, 0.2)]],
    [[(-0.7, -0.7), (0.7, 0.7)], [(0.7, -0.7), (-0.7, 0.7)], [(0, -1), (0, -0.4)]],
    [[(0, -1), (0.7, 0), (0, 1), (-0.7, 0), (0, -1)], [(0, -0.3), (0, 0.3)]],
    [[(0, -1), (0, 1)], [(-0.8, -0.8), (0, -0.1), (0.8, -0.8)], [(-0.8, 0.5), (0, 1), (0.8, 0.5)], [(-0.4, 0.15), (0.4, 0.15)]],
]


def rune_sign(x: np.ndarray, y: np.ndarray, which: int, size: float) -> np.ndarray:
    """Distance to a sign's strokes, for coordinates from its middle; `size` is half its height."""
    out = np.full(np.shape(x), 1e9)
    for stroke in _SIGNS[which % len(_SIGNS)]:
        out = np.minimum(out, shapes.strokes(x, y, [(px * size, py * size) for px, py in stroke], max(0.8, 0.1 * size)))
    return out


def _soot_edges(c: Canvas) -> None:
    """Soot where bars turn away, so that they look round without a normal map too."""
    c.tint(0.55 + 0.45 * smoothstep(0.0, 0.7, c.height / c.height.max()))


def grate(width: int, height: int) -> Surface:
    """Crossed bars every 16 texels; the rest is holes."""
    c = Canvas(width, height, 105)
    sheet(c, IRON, 0.45, 1)
    across = np.abs((c.x % 16) - 8) - 2.2
    along = np.abs((c.y % 16) - 8) - 2.2
    c.height = np.maximum(1.9 * np.sqrt(np.clip(-across / 2.2, 0, 1)), 1.9 * np.sqrt(np.clip(-along / 2.2, 0, 1)) - 0.6)
    rust(c, 0.06, 20)
    joint = np.hypot((c.x % 16) - 8, (c.y % 16) - 8) - 3.4
    c.height = np.maximum(c.height, 2.6 * np.sqrt(np.clip(-joint / 3.4, 0, 1)))
    _soot_edges(c)
    c.holes = np.minimum(np.minimum(across, along), joint) > 0
    return c.surface()


def chain(width: int, height: int) -> Surface:
    """Links, flat and edge on by turns; the rest is holes."""
    c = Canvas(width, height, 106)
    sheet(c, IRON, 0.5, 1)
    mx = c.x - 0.5 * width
    ly = (c.y % 32) - 16
    link = shapes.ring(shapes.box(mx, ly, -6.5, -11.5, 6.5, 11.5, 6.5), 4.2)
    ey = np.abs((c.y + 16) % 32 - 16)
    edge_on = np.maximum(np.abs(mx) - 2.2, ey - 8.5)
    c.height = np.maximum(2.2 * np.sqrt(np.clip(-link / 2.1, 0, 1)), 3.0 * np.sqrt(np.clip(-edge_on / 2.2, 0, 1)))
    rust(c, 0.12, 20)
    _soot_edges(c)
    c.holes = np.minimum(link, edge_on) > 0
    bleed(c)
    return c.surface()
