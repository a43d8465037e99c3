"""Textures with light of their own: lamps, stained windows, runes, crystals, buttons, plates, signs.

What glows has in the paletted texture one of the indices 224-254; the `_luma` picture beside it may have any colour.
What is to look hot has a black body's hue (`palette.heat`). `shine` with `light` below 1 deepens a colour as a glass would,
so that such parts are named some 1500 K hotter than their light is.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from art import shapes
from art.canvas import Canvas
from art.letters import Pen, text_distance, text_width
from art.noise import smoothstep
from art.palette import LAMP, heat, hex_to_srgb
from art.surface import Surface
from art.tex_doors import GOLD, STONE_INDICES, engrave, inlay, rune_sign
from art.tex_metal import COPPER, IRON, frame_spots, rivets, rust, sheet, verdigris


def shine(c: Canvas, mask: np.ndarray, color: str | np.ndarray, light: float = 1.0) -> None:
    """Makes texels lights of a colour, of `light` times a lamp's brightness."""
    c.shine = light
    lit = mask > 0.5
    rgb = hex_to_srgb(color) if isinstance(color, str) else color
    c.color = np.where(lit[..., None], rgb, c.color)
    c.glow = lit if c.glow is None else c.glow | lit
    c.gloss = np.where(lit, 0.7, c.gloss)


def _housing(seed: int, width: int, height: int, metal: str, border: float) -> tuple[Canvas, np.ndarray]:
    """A lamp's frame; gives the distance inwards from its opening."""
    c = Canvas(width, height, seed)
    sheet(c, metal, 0.5, 1, gloss=0.6)
    edge = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    c.height += 2.0 * smoothstep(border, border - 1.2, edge) * smoothstep(0.0, 1.4, edge)
    c.tint(1.0 - 0.4 * smoothstep(1.0, 0.2, edge))
    return c, edge - border


def light_white(width: int, height: int) -> Surface:
    """Four panes behind an iron cross."""
    c, inside = _housing(111, width, height, IRON, 6.0)
    bar = np.minimum(np.abs(c.x - 32), np.abs(c.y - 32)) - 2.0
    c.height = np.where(inside > 0, 1.6 * smoothstep(0.5, -0.8, bar), c.height)
    shine(c, c.mask(-np.minimum(inside, bar)), "ffffff")
    rivets(c, frame_spots(3.2, 3.2, 60.8, 60.8, 14.4), 1.3, 0.9)
    return c.surface()


def light_warm(width: int, height: int) -> Surface:
    """Nine panes of horn in a copper frame."""
    c, inside = _housing(112, width, height, COPPER, 7.0)
    verdigris(c, 0.3, 30, 0.0)
    cell = 50.0 / 3.0
    bar = np.minimum(np.abs((c.x - 7) % cell - cell / 2), np.abs((c.y - 7) % cell - cell / 2))
    bar = cell / 2 - np.maximum(np.abs((c.x - 7) % cell - cell / 2), np.abs((c.y - 7) % cell - cell / 2)) - 1.1
    c.height = np.where(inside > 0, 1.5 * smoothstep(0.5, -0.6, bar), c.height)
    lx, ly = (c.x - 7) % cell - cell / 2, (c.y - 7) % cell - cell / 2
    pale = np.exp(-(lx**2 + ly**2) / 30.0)
    shine(c, c.mask(-np.minimum(inside, bar)), c.ramp(f"{heat(2400)} {heat(LAMP)} {heat(3400)}", pale))
    rivets(c, [(3.6, 3.6), (60.4, 3.6), (3.6, 60.4), (60.4, 60.4)], 1.7, 1.2)
    return c.surface()


def light_cool(width: int, height: int) -> Surface:
    """A ribbed glass, blue-white, in steel."""
    c, inside = _housing(113, width, height, IRON, 5.0)
    rib = np.abs((c.y - 5) % 9.0 - 4.5) - 3.9
    c.height = np.where(inside > 0, 0.6 * np.cos((c.y - 5) / 9.0 * 2 * np.pi), c.height)
    panes = np.maximum(-inside, rib)
    c.color = np.where((inside > 0)[..., None], hex_to_srgb("5a86b0"), c.color)
    shine(c, c.mask(panes), c.ramp("9fdcff dff8ff", smoothstep(-1.0, -3.5, rib)))
    return c.surface()


def _caged(seed: int, glass: str, core: str, luma: str) -> Callable[[int, int], Surface]:
    """A round bulkhead lamp of coloured glass behind a cage."""

    def paint(width: int, height: int) -> Surface:
        c, _ = _housing(seed, width, height, IRON, 3.0)
        radius = np.hypot(c.x - 32, c.y - 32)
        c.height += 2.4 * c.bevel(4.0 - np.abs(radius - 25.5), 3.0, 1.0)
        c.tint(1.0 - 0.4 * np.exp(-(((radius - 30.5) / 1.0) ** 2)))
        cage = np.minimum(np.minimum(np.abs(c.x - 32), np.abs(c.y - 32)), np.abs(radius - 10.0)) - 1.5
        glow = np.minimum(cage, 21.0 - radius)
        c.height = np.where(radius < 21.5, 2.2 + 1.6 * smoothstep(0.5, -0.8, cage), c.height)
        c.color = np.where((glow > 0)[..., None], c.ramp(glass, 1.0 - radius / 22.0), c.color)
        rivets(c, [(7, 7), (57, 7), (7, 57), (57, 57)], 2.2, 1.4)
        lit = c.mask(-glow) > 0.5
        c.glow = lit & (radius < 9.0) if luma else lit
        c.color = np.where(c.glow[..., None], hex_to_srgb(core), c.color)
        c.gloss = np.where(glow > 0, 0.8, c.gloss)
        surface = c.surface()
        if luma:
            surface.luma = np.where(lit[..., None], hex_to_srgb(luma), 0.0)
        return surface

    return paint


light_red = _caged(114, "8c0a14 e8262a ff4a40", "ff4a40", "")
light_green = _caged(115, "0f5a2c 2aa050 8fe6a4", "dff8ff", "3cff6e")


def light_strip(width: int, height: int) -> Surface:
    """A glass tube between two caps."""
    c = Canvas(width, height, 116)
    sheet(c, IRON, 0.5, 1)
    tube = np.abs(c.y - 8) - 4.2
    cap = 7.0 - np.minimum(c.x, width - c.x)
    c.height += 1.4 * smoothstep(6.0, 7.4, np.abs(c.y - 8)) + 2.4 * smoothstep(-0.6, 0.6, cap)
    band = np.abs(c.x - 32) - 1.6
    glass = np.maximum(np.maximum(tube, cap), -band)
    shine(c, c.mask(glass), heat(5000))
    c.height = np.where(glass < 0, 2.0 * np.sqrt(np.clip(1 - ((c.y - 8) / 5.0) ** 2, 0, 1)), c.height)
    rivets(c, [(3.5, 8.0), (60.5, 8.0)], 1.4, 1.0)
    return c.surface()


def lamp_round(width: int, height: int) -> Surface:
    """A round lamp of the monks: a copper ring with points, glass in petals."""
    c = Canvas(width, height, 117)
    sheet(c, COPPER, 0.52, 1, gloss=0.65)
    mx, my = c.x - 32, c.y - 32
    radius, angle = np.hypot(mx, my), np.arctan2(my, mx)
    c.height += 2.6 * np.sqrt(np.clip(1 - ((radius - 26.0) / 4.5) ** 2, 0, 1))
    points = shapes.star(c.x, c.y, 32, 32, 8, 32.0, 26.0, np.pi / 8)
    c.height += c.bevel(-np.maximum(points, 29.0 - radius), 1.5, 1.0)
    verdigris(c, 0.42, 30, 0.5 * smoothstep(28.0, 32.0, radius) - 0.4)
    petal = np.abs((angle / (np.pi / 4)) % 1.0 - 0.5) * (np.pi / 4) * radius
    lead = np.minimum(np.pi / 8 * radius - petal - 0.7, np.abs(radius - 8.0) - 0.8)
    glass = np.where(radius < 7.2, -1.0, np.maximum(-lead, radius - 21.0))
    c.color = np.where((radius < 21.5)[..., None], hex_to_srgb("5a4634"), c.color)
    c.height = np.where(radius < 21.5, 0.8 * (glass > 0) + 1.4 * np.sqrt(np.clip(1 - (radius / 24.0) ** 2, 0, 1)), c.height)
    shine(c, c.mask(glass), c.ramp(f"{heat(3600)} {heat(3000)} {heat(2400)}", radius / 22.0))
    return c.surface()


def _rune(seed: int, color: str, which: int) -> Callable[[int, int], Surface]:
    def paint(width: int, height: int) -> Surface:
        c = Canvas(width, height, seed)
        c.color = c.ramp("3f4b57 5b6a78 768894 96a6ae", 0.45 + 0.22 * c.noise(30, 4, seed=1))
        edge = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y)) - 0.6
        c.height = c.bevel(edge + 0.5 * c.noise(9, 3, seed=2), 3.0, 1.5) + 0.22 * c.noise(16, 5, 0.55, seed=3)
        c.gloss = 0.35 + 0.12 * c.noise(24, 3, seed=4)
        ring = np.abs(np.hypot(c.x - 32, c.y - 32) - 23.5)
        c.height -= 0.9 * smoothstep(1.4, 0.4, ring)
        c.paint("2b3033", 0.6 * np.maximum(smoothstep(1.2, 0.4, ring), smoothstep(0.4, -0.2, edge)))
        c.grain(0.1, 0.12)
        c.pits(5.0, 0.4, 0.2)
        engrave(c, rune_sign(c.x - 32, c.y - 32, which, 15.0), color)
        return c.surface(palette=STONE_INDICES)

    return paint


rune_a = _rune(118, heat(3800), 8)
rune_b = _rune(119, "5fb8ff", 5)


def _crystal(seed: int, glow_ramp: str, dark: str) -> Callable[[int, int], Surface]:
    """Facets that grow upwards; those that catch the light within glow."""

    def paint(width: int, height: int) -> Surface:
        c = Canvas(width, height, seed)
        facets = c.cells((11, 22), 1, 0.95)
        edge = facets.edge()
        tone = facets.random(2)
        slope = (facets.random(3) - 0.5) * facets.dx * 11 + (facets.random(4) - 0.5) * facets.dy * 22
        c.height = 0.9 * slope + 1.2 * smoothstep(0.0, 0.08, edge)
        inner = tone + 0.35 * (facets.dy + 0.3 * facets.dx)
        c.color = c.ramp(dark, 0.3 + 0.6 * inner)
        lit = (inner > 0.42) & (edge > 0.035)
        shine(c, lit.astype(float), c.ramp(glow_ramp, smoothstep(0.42, 1.0, inner)), 0.3)
        c.gloss = np.where(edge > 0.02, 0.85, 0.5)
        return c.surface()

    return paint


crystal_blue = _crystal(120, "5fb8ff 7cc8ff 9fdcff dff8ff", "103668 1a56a8 3a86e0")
crystal_red = _crystal(121, "8c0a14 bf1420 e8262a ff4a40", "3c090b 741518 a92726")
crystal_gold = _crystal(122, "b0701e eaa83a ffd468", "5a3a10 8c5e1c c48c34")


_GLASS_WARM = ["ffc258", "ff9a24", "e8262a", heat(4200), "c43c05", heat(5400), "9fdcff"]
_GLASS_COOL = ["5fb8ff", "9fdcff", "dff8ff", "f2b64a", "5fb8ff", "bf1420", "9fdcff"]


def _window(
    seed: int, colors: list[str], figure: Callable[[np.ndarray, np.ndarray], list[tuple[np.ndarray, str]]]
) -> Callable[[int, int], Surface]:
    """A lancet of stained glass in a stone frame: `figure` gives panes by distance and colour, laid over a ground."""

    def paint(width: int, height: int) -> Surface:
        c = Canvas(width, height, seed)
        c.color = c.ramp("5b6a78 768894 96a6ae b9c5c8", 0.5 + 0.2 * c.noise(30, 4, seed=1))
        c.gloss = np.full(c.x.shape, 0.35)
        # Two arcs meet in the point.
        arch = np.maximum(np.hypot(c.x - 56, c.y - 50) - 50.0, np.hypot(c.x - 8, c.y - 50) - 50.0)
        sides = np.maximum(np.abs(c.x - 32) - 26.0, c.y - 121.0)
        opening = np.where(c.y < 50, np.maximum(arch, sides), sides)
        c.height = 2.6 * smoothstep(0.0, 4.5, opening) + 0.2 * c.noise(12, 4, seed=2)
        mould = np.exp(-(((opening - 2.4) / 0.9) ** 2))
        c.height += 0.9 * mould
        c.grime("37504c", 0.4, 2.5)
        panes = c.cells(9, 3, 0.85)
        color = np.zeros_like(c.color)
        pick = (panes.random(4) * len(colors)).astype(int)
        for i, name in enumerate(colors):
            color[pick == i] = hex_to_srgb(name) * 0.9
        lead = panes.edge() * 9.0 - 0.55
        for distance, name in figure(c.x, c.y):
            inside = distance < 0
            color = np.where(inside[..., None], hex_to_srgb(name), color)
            lead = np.where(inside, -distance, np.minimum(lead, distance)) - 0.0
            lead = np.where(np.abs(distance) < 0.75, -1.0, lead)
        color = color * (0.86 + 0.14 * c.noise(7, 3, seed=5))[..., None]
        glass = np.minimum(lead, -opening - 1.0)
        inside = opening < 0
        c.color = np.where(inside[..., None], hex_to_srgb("2c3034"), c.color)
        c.height = np.where(inside, 0.7 * smoothstep(0.6, -0.4, glass) + 0.1 * c.noise(6, 2, seed=6), c.height)
        shine(c, c.mask(-glass), np.clip(color, 0, 1), 0.4)
        c.gloss = np.where(glass > 0, 0.85, c.gloss)
        return c.surface(tiles=False)

    return paint


def _sun_over_waves(x: np.ndarray, y: np.ndarray) -> list[tuple[np.ndarray, str]]:
    panes = [(shapes.star(x, y, 32, 46, 12, 23.0, 14.0), "ffc258"), (shapes.circle(x, y, 32, 46, 11.0), heat(5400))]
    for i in range(4):
        top = 82.0 + 10.0 * i + 2.6 * np.sin((x + 5.0 * i) * 2 * np.pi / 18.0)
        panes.append((np.maximum(top - y, y - top - 9.2), ["dff8ff", "9fdcff", "5fb8ff", "9fdcff"][i]))
    return panes


def _chalice(x: np.ndarray, y: np.ndarray) -> list[tuple[np.ndarray, str]]:
    bowl = np.maximum(shapes.ellipse(x, y, 32, 58, 14, 20), 56 - y)
    stem = shapes.union(shapes.box(x, y, 29.5, 74, 34.5, 96), shapes.ellipse(x, y, 32, 98, 12, 5))
    flame = shapes.union(shapes.circle(x, y, 32, 46, 7.5), shapes.polygon(x, y, [(32, 24), (38.5, 43), (25.5, 43)]))
    halo = shapes.circle(x, y, 32, 42, 19.0)
    return [
        (halo, "5fb8ff"),
        (bowl, "f2b64a"),
        (stem, "d08c2c"),
        (flame, heat(4600)),
        (shapes.circle(x, y, 32, 47, 3.4), "ff9a24"),
    ]


window_a = _window(123, _GLASS_WARM, _sun_over_waves)
window_b = _window(124, _GLASS_COOL, _chalice)


def _button(seed: int, rim: str, core: str, pressed: bool) -> Callable[[int, int], Surface]:
    """A brass boss in an iron plate, with a jewel that says what it does."""

    def paint(width: int, height: int) -> Surface:
        c, _ = _housing(seed, width, height, IRON, 4.0)
        radius = np.hypot(c.x - 32, c.y - 32)
        inlay(c, shapes.ring(radius - 21.0, 6.0), GOLD, 1.8, 50)
        high = 0.3 if pressed else 2.6
        jewel = radius - 14.5
        c.height = np.where(radius < 17.5, high * np.sqrt(np.clip(1 - (radius / 17.0) ** 2, 0, 1)), c.height)
        c.color = np.where((jewel < 2.5)[..., None], hex_to_srgb("2a2624"), c.color)
        wave = np.abs(c.y - 32 - 3.2 * np.sin((c.x - 32) * 2 * np.pi / 14.0)) - 1.5
        shine(c, c.mask(jewel), np.where((wave < 0)[..., None], hex_to_srgb(core), hex_to_srgb(rim)), 0.4)
        rivets(c, [(8, 8), (56, 8), (8, 56), (56, 56)], 2.2, 1.4)
        rust(c, 0.05, 80, -0.2)
        return c.surface()

    return paint


button_0 = _button(125, "8c0a14", "e8262a", False)
button_1 = _button(125, "bf1420", "ff4a40", False)
button_a = _button(125, "d9952e", heat(4400), True)


def _plate(frame: int) -> Callable[[int, int], Surface]:
    """A dial of four lamps round a wheel; the light runs round."""

    def paint(width: int, height: int) -> Surface:
        c, _ = _housing(126, width, height, IRON, 4.0)
        mx, my = c.x - 32, c.y - 32
        inlay(c, np.abs(np.abs(mx) + np.abs(my) - 25.0) - 1.6, COPPER, 1.2, 50)
        inlay(c, shapes.star(c.x, c.y, 32, 32, 8, 9.0, 5.5), COPPER, 1.6, 52)
        for i, (dx, dy) in enumerate([(0, -17), (17, 0), (0, 17), (-17, 0)]):
            radius = np.hypot(mx - dx, my - dy)
            c.height += 1.5 * np.exp(-(((radius - 5.8) / 1.0) ** 2))
            c.tint(1.0 - 0.3 * np.exp(-(((radius - 7.2) / 0.8) ** 2)))
            behind = (frame - i) % 4
            if behind == 0:
                shine(c, c.mask(radius - 5.0), c.ramp(f"{heat(5400)} {heat(4400)} {heat(3200, 0.8)}", radius / 5.0), 0.5)
            elif behind == 1:
                shine(c, c.mask(radius - 5.0), c.ramp(f"{heat(3400, 0.58)} {heat(3000, 0.43)}", radius / 5.0), 0.5)
            else:
                c.paint("3c2c1c", c.mask(radius - 5.0))
                c.gloss = np.where(radius < 5.0, 0.8, c.gloss)
        rivets(c, [(8, 8), (56, 8), (8, 56), (56, 56)], 1.8, 1.2)
        return c.surface()

    return paint


plates = [_plate(frame) for frame in range(4)]


def _sign(seed: int, width: int, height: int) -> Canvas:
    c, inside = _housing(seed, width, height, COPPER, 3.5)
    verdigris(c, 0.35, 30, 0.0)
    c.color = np.where((inside > 0)[..., None], c.ramp("3a5c58 54807a", 0.5 + 0.3 * c.noise(16, 3, seed=40)), c.color)
    c.height = np.where(inside > 0, 0.0, c.height)
    c.gloss = np.where(inside > 0, 0.75, c.gloss)
    return c


def sign_exit(width: int, height: int) -> Surface:
    """The way out, in lit letters."""
    c = _sign(127, width, height)
    left = 0.5 * (width - text_width("EXIT", 17.0, 0.22))
    letters = text_distance(c.x, c.y, "EXIT", left, 7.5, 17.0, Pen(0.11, 0.07, 30.0), 0.22)
    shine(c, c.mask(letters), heat(4400), 0.5)
    return c.surface()


def sign_arrow(width: int, height: int) -> Surface:
    """A lit arrow to the right."""
    c = _sign(128, width, height)
    arrow = shapes.union(
        shapes.polygon(c.x, c.y, [(36, 6), (57, 16), (36, 26), (40, 16)]),
        shapes.strokes(c.x, c.y, [(8, 16), (17, 16)], 2.4),
        shapes.strokes(c.x, c.y, [(23, 16), (39, 16)], 2.4),
    )
    shine(c, c.mask(arrow), heat(4400), 0.5)
    return c.surface()
