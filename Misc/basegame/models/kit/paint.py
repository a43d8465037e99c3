"""Materials of the drowned foundry-monastery as painters: a function of a `Surface` that gives palette indices.

Nothing here paints light or shadow; the renderer lights the models. What glows says so in its name. Metal, glass and
what is moist have gloss, cloth and stone none; relief is a height in units (`kit/skin.py`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from models.kit.noise import fbm
from models.kit.skin import HEIGHT, Surface, choose

Painter = Callable[[Surface], np.ndarray]


def plain(ramp: str, value: float = 0.6, grain: float = 0.12, size: float = 4.0, seed: int = 0, gloss: float = 0.0) -> Painter:
    """One ramp with soft grain: cloth, stone; with `gloss` paint, enamel, glass."""
    return lambda s: s.ramp(ramp, value + grain * (s.noise(size, seed) - 0.5) * 2.0, gloss)


def copper(patina: float = 0.4, size: float = 5.0, seed: int = 1, metal: str = "ochre") -> Painter:
    """Waxed brass or copper (`metal` is its ramp) that verdigris has covered by about the share `patina`."""

    def paint(s: Surface) -> np.ndarray:
        grown = s.noise(size, seed, 4)
        wear, bloom = s.noise(size * 0.4, seed + 1) - 0.5, s.noise(size * 0.35, seed + 2) - 0.5
        bare = s.ramp(metal, 0.72 + 0.2 * wear, 0.74 + 0.3 * wear)
        green = s.ramp("verdigris", 0.62 + 0.45 * bloom, 0.46 - 0.5 * bloom, 0.05 + 0.1 * bloom)
        edge = s.ramp("verdigris", 0.42, 0.5, 0.02)
        limit = 1.0 - (0.2 + 0.6 * patina)
        return choose(grown > limit + 0.03, green, choose(grown > limit, edge, bare))

    return paint


def iron(value: float = 0.42, rust: float = 0.25, size: float = 5.0, seed: int = 3, ramp: str = "slate") -> Painter:
    """Soot-dark iron with patches of rust."""

    def paint(s: Surface) -> np.ndarray:
        hammered, grain = s.noise(size * 0.5, seed) - 0.5, s.noise(size * 0.3, seed + 1) - 0.5
        metal = s.ramp(ramp, value + 0.16 * hammered, 0.64 + 0.3 * hammered)
        red = s.ramp("sand", 0.34 + 0.3 * grain, 0.12, 0.04 + 0.12 * grain)
        return choose(s.noise(size, seed + 2, 4) > 0.9 - 0.6 * rust, red, metal)

    return paint


def steel(value: float = 0.68, seed: int = 4) -> Painter:
    """Scratched bright metal."""

    def paint(s: Surface) -> np.ndarray:
        cloud, scratch = s.noise(3.0, seed, 4) - 0.5, s.noise(0.8, seed + 1, 1) - 0.5
        return s.ramp("slate", value + 0.14 * cloud + 0.10 * scratch, 0.76 + 0.3 * cloud)

    return paint


def leather(value: float = 0.45, ramp: str = "sand", seed: int = 5) -> Painter:
    """Waxed hide: it shines where it is worn pale."""

    def paint(s: Surface) -> np.ndarray:
        worn = s.noise(2.5, seed, 4) - 0.5
        return s.ramp(ramp, value + 0.22 * worn, 0.38 + 0.5 * worn, 0.12 * worn)

    return paint


def canvas(value: float = 0.62, ramp: str = "sand", seed: int = 6) -> Painter:
    """Woven cloth: two crossed threads and stains."""

    def paint(s: Surface) -> np.ndarray:
        weave = np.sign(np.sin(s.z * 5.0)) * np.sign(np.sin((s.x + s.y) * 5.0))
        return s.ramp(ramp, value + 0.02 * weave + 0.26 * (s.noise(6.0, seed, 3) - 0.5), 0.0, 0.02 * weave)

    return paint


def flesh(value: float = 0.62, ramp: str = "coral", seed: int = 7, pores: float = 0.5, size: float = 1.0) -> Painter:
    """Coral-coloured flesh, moist: pale polyps in darker meat, `size` times as coarse as on a man."""

    def paint(s: Surface) -> np.ndarray:
        lumps, polyps = s.noise(5.0 * size, seed, 4) - 0.45, s.noise(1.5 * size, seed + 1, 1)
        meat, limit = value - 0.3 * lumps, 1.0 - 0.45 * pores
        pale = s.ramp(ramp, meat + 0.2, 0.34, 0.5 * size * (polyps - limit))
        return choose(polyps > limit, pale, s.ramp(ramp, meat, 0.45 + 0.4 * lumps))

    return paint


def wax(value: float = 0.8, seed: int = 8) -> Painter:
    """Candle wax, yellowed where it ran."""

    def paint(s: Surface) -> np.ndarray:
        runs = s.noise(3.0, seed, 3)
        ran = s.ramp("tan", value + 0.16 - 0.3 * (runs - 0.5), 0.7, 0.3 * (runs - 0.56))
        return choose(runs > 0.56, ran, s.ramp("sand", value + 0.2 * (runs - 0.5), 0.62))

    return paint


def bone(value: float = 0.82, seed: int = 9) -> Painter:
    return lambda s: s.ramp("sand", value + 0.25 * (s.noise(2.0, seed, 4) - 0.5), 0.45)


def wood(value: float = 0.52, ramp: str = "brown", seed: int = 10, grain=(0.5, 0.5, 3.0)) -> Painter:
    """Oiled planks whose grain runs along the axis with the greatest `grain` (units)."""

    def paint(s: Surface) -> np.ndarray:
        fibre = fbm(s.position / np.array(grain) + 40.0, 1.0, 3, seed) - 0.5
        return s.ramp(ramp, value + 0.4 * fibre, 0.42 + 0.3 * fibre, 0.1 * fibre)

    return paint


def glow(ramp: str = "fire", value: float = 0.85, grain: float = 0.3, size: float = 2.0, seed: int = 11) -> Painter:
    """Light itself, behind glass: a glowing ramp (`fire`, `gold_glow`, `blue_glow`, `red_glow`, `white_glow`)."""
    return lambda s: s.ramp(ramp, value + grain * (s.noise(size, seed) - 0.5), 0.85)


def magma(heat: float = 0.35, size: float = 7.0, seed: int = 12, crust: str = "slate", value: float = 0.22) -> Painter:
    """Dark crust with glowing cracks."""

    def paint(s: Surface) -> np.ndarray:
        ridge = np.abs(s.noise(size, seed, 3) - 0.5) * 2.0
        hot, rough = 1.0 - ridge / (heat * 0.3), s.noise(size * 0.4, seed + 5) - 0.5
        stone = s.ramp(crust, value + 0.3 * rough, 0.2, size * (0.02 + 0.05 * rough))
        return choose(hot > 0, s.ramp("fire", 0.2 + 0.7 * hot), stone)

    return paint


# Ways to combine painters.


def where(test: Callable[[Surface], np.ndarray], inside: Painter, outside: Painter, raised: float = 0.0) -> Painter:
    """One painter where `test` holds, `raised` by so many units, another elsewhere."""

    def paint(s: Surface) -> np.ndarray:
        mask = test(s)
        if not mask.any():
            return outside(s)
        on = inside(s)
        if s.fine and raised:
            on[..., HEIGHT] += raised
        return choose(mask, on, outside(s))

    return paint


LAYER = 0.06  # units that what is laid on a surface stands out


def layers(base: Painter, *over: tuple[Callable[[Surface], np.ndarray], Painter]) -> Painter:
    """Painters on top of a base, each with the test that says where: straps, bands, rivets."""
    for test, painter in over:
        base = where(test, painter, base, LAYER)
    return base


def band(axis: str, low: float, high: float) -> Callable[[Surface], np.ndarray]:
    """Texels whose x, y, z, u or v lies between two values."""
    return lambda s: (getattr(s, axis) > low) & (getattr(s, axis) < high)


def spot(point, radius: float) -> Callable[[Surface], np.ndarray]:
    return lambda s: s.near(point, radius)


def rivets(across: int, along: int, size: float = 0.25) -> Callable[[Surface], np.ndarray]:
    """Dots in rows: so many around and along the patch, `size` a share of their spacing."""

    def test(s: Surface) -> np.ndarray:
        a = (s.u * across) % 1.0 - 0.5
        b = (s.v * along) % 1.0 - 0.5
        return a * a + b * b < size * size

    return test


def rib(axis: str, spacing: float, width: float, offset: float = 0.0) -> Callable[[Surface], np.ndarray]:
    """Stripes of `width` units every `spacing` units of an axis."""
    return lambda s: (getattr(s, axis) + offset) % spacing < width


def both_of(*tests: Callable[[Surface], np.ndarray]) -> Callable[[Surface], np.ndarray]:
    return lambda s: np.logical_and.reduce([t(s) for t in tests])
