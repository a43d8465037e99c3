"""Boxes of ammunition and health: a case whose paint and picture say what is in it. The laboratory's and tools' textures."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from art import shapes
from art.canvas import Canvas
from art.letters import Pen, text_distance, text_width
from art.noise import smoothstep
from art.palette import hex_to_srgb
from art.surface import Surface
from art.tex_doors import inlay
from art.tex_glow import shine
from art.tex_metal import COPPER, IRON, frame_spots, rivets, rust, sheet

Field = np.ndarray
Figure = list[tuple[Field, str]]  # distances and paints, later ones on top


def shell_figure(x: Field, y: Field) -> Figure:
    """Three cartridges upright; coordinates from the middle, about 13 to each side."""
    out: Figure = []
    for cx in (-9.0, 0.0, 9.0):
        out.append((shapes.box(x, y, cx - 3.6, -12, cx + 3.6, 7, 1.6), "a93228"))
        out.append((shapes.box(x, y, cx - 3.6, 6, cx + 3.6, 12, 0.8), "d8ac50"))
    return out


def nail_figure(x: Field, y: Field) -> Figure:
    """Three nails, points down."""
    out: Figure = []
    for cx in (-9.0, 0.0, 9.0):
        out.append((shapes.polygon(x, y, [(cx - 1.7, -10), (cx + 1.7, -10), (cx + 1.4, 7), (cx, 13), (cx - 1.4, 7)]), "c9d0d4"))
        out.append((shapes.box(x, y, cx - 3.8, -13, cx + 3.8, -9.6, 1.2), "98a2aa"))
    return out


def rocket_figure(x: Field, y: Field) -> Figure:
    """A finned rocket, pointing up and right."""
    a, b = (x + y) * 0.7071, (y - x) * 0.7071  # b runs down its length
    body = shapes.box(a, b, -4.0, -6.0, 4.0, 11.0, 1.0)
    nose = np.where(b < -5.5, shapes.ellipse(a, b, 0, -5.5, 4.0, 9.5), 9.0)
    fins = shapes.polygon(a, b, [(-4, 3), (-9, 12), (-4, 10), (4, 10), (9, 12), (4, 3)])
    return [(fins, "8c3a26"), (body, "b8bcb8"), (nose, "c8402c"), (np.maximum(body, np.abs(b + 1.0) - 1.6), "d8ac50")]


def cell_figure(x: Field, y: Field) -> Figure:
    """A bolt of lightning; the last colour glows."""
    bolt = [(3, -14), (-8, 2), (-1, 2), (-4, 14), (8, -3), (1, -3)]
    return [(shapes.polygon(x, y, bolt), "5fb8ff")]


def health_figure(x: Field, y: Field) -> Figure:
    """A heart."""
    ax = np.abs(x)
    heart = shapes.union(
        shapes.circle(ax, y, 5.0, -4.5, 6.2), shapes.polygon(ax, y, [(0, -5), (10.6, -1.6), (0, 12.5), (-4, 2)])
    )
    return [(heart, "c8382e")]


def mega_figure(x: Field, y: Field) -> Figure:
    """A heart in rays."""
    heart = health_figure(x * 1.25, (y + 0.5) * 1.25)[0][0]
    rays = shapes.cut(shapes.star(x, y, 0, 0, 12, 15.5, 11.5), shapes.circle(x, y, 0, 0, 11.0))
    return [(rays, "e6b53c"), (heart, "ff4a40")]


def _case(
    seed: int, paint_ramp: str, metal: str, figure: Callable[[Field, Field], Figure], glows: bool, top: bool
) -> Callable[[int, int], Surface]:
    """The side or the lid of a case."""

    def paint(width: int, height: int) -> Surface:
        c = Canvas(width, height, seed + top)
        edge = np.minimum(np.minimum(c.x, 64 - c.x), np.minimum(c.y, 64 - c.y))
        sheet(c, metal, 0.5, 1, gloss=0.55)
        panel = shapes.box(c.x, c.y, 7.0, 7.0, 57.0, 57.0, 3.0)
        worn = smoothstep(0.35, 0.6, c.noise(9, 4, seed=20) - 0.12 * np.minimum(-panel, 4.0))
        enamel = c.ramp(paint_ramp, 0.5 + 0.25 * c.noise(24, 4, seed=21))
        c.paint(enamel, c.mask(panel) * (1 - 0.8 * worn))
        c.height += 1.8 * smoothstep(-1.0, 0.4, panel) * smoothstep(0.0, 1.2, edge)
        c.tint(1.0 - 0.4 * np.exp(-(((panel + 0.8) / 0.7) ** 2)))
        rivets(c, frame_spots(3.5, 3.5, 60.5, 60.5, 19.0), 1.5, 1.0)
        size = 0.82 if top else 1.25
        x, y = (c.x - 32) / size, (c.y - (30 if top else 32)) / size
        layers = figure(x, y)
        ground = shapes.circle(c.x, c.y, 32, 30 if top else 32, 17.0 if top else 21.5)
        if not top:
            c.paint("f0e6cc", 0.85 * c.mask(np.abs(ground) - 0.8) * (1 - 0.7 * worn))
        for i, (distance, color) in enumerate(layers):
            d = distance * size
            c.paint("1e1a18", 0.75 * c.mask(d - 1.0))
            if glows and i == len(layers) - 1:
                shine(c, c.mask(d), color, 0.35)
            else:
                c.paint(color, c.mask(d) * (1 - 0.35 * worn))
            c.height += 0.5 * c.mask(d, 1.5)
        if top:
            handle = np.maximum(np.abs(c.y - 52.0) - 2.0, np.abs(c.x - 32.0) - 14.0)
            inlay(c, handle, COPPER, 2.2, 50)
        rust(c, 0.04, 80, 0.25 * smoothstep(2.5, 0.0, np.abs(panel)) - 0.3 * c.mask(ground))
        return c.surface(tiles=False)

    return paint


_CASES: dict[str, tuple[int, str, str, Callable[[Field, Field], Figure], bool]] = {
    "box_shell": (151, "6a7a4c 84945e 9cac74", IRON, shell_figure, False),
    "box_nail": (153, "3c5c70 507488 6c90a2", IRON, nail_figure, False),
    "box_rocket": (155, "a8822e c49c40 dab65c", IRON, rocket_figure, False),
    "box_cell": (157, "3c3a58 52507a 6c6a98", COPPER, cell_figure, True),
    "box_health": (159, "cfc6ac e0d8c2 eee8d6", COPPER, health_figure, False),
    "box_mega": (161, "1f5a55 2f7a70 46998a", COPPER, mega_figure, True),
}
BOXES = {name + suffix: _case(*row, top) for name, row in _CASES.items() for suffix, top in (("", False), ("_top", True))}


def lab_check(width: int, height: int) -> Surface:
    """Squares of 8 texels, reflectance 0.2 and 0.7."""
    y, x = np.mgrid[0:height, 0:width]
    return Surface(
        np.where((((x // 8) + (y // 8)) % 2 == 0)[..., None], hex_to_srgb("7b7c80"), hex_to_srgb("d9d9d8")), dither=0.0
    )


def lab_light_dim(width: int, height: int) -> Surface:
    """A lamp a fifth as bright as lab_light, white."""
    shape = (height, width)
    return Surface(np.ones((*shape, 3)), glow=np.full(shape, True), luma=np.full((*shape, 3), 0.485), dither=0.0)


def tool(color: str, word: str) -> Callable[[int, int], Surface]:
    """A texture that players never see: its name on stripes."""

    def paint(width: int, height: int) -> Surface:
        c = Canvas(width, height, 1, scale=1)
        stripe = ((c.x + c.y) // 8) % 2 == 0
        c.color = np.where(stripe[..., None], hex_to_srgb(color), hex_to_srgb(color) * 0.6)
        high = 13.0 if len(word) < 5 else 9.0
        left = 0.5 * (width - text_width(word, high))
        letters = text_distance(c.x, c.y, word, left, 0.5 * (height - high), high, Pen(0.1, 0.08))
        c.paint("16181c", c.mask(letters - 1.6))
        c.paint("f6f6f4", c.mask(letters))
        return Surface(c.color)

    return paint
