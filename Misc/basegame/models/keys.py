"""Keys of three kinds, each of silver or gold, and the four sigils."""

from __future__ import annotations

import functools

import numpy as np

from formats.mdl import Mdl
from models.items import X, item
from models.kit.paint import Painter, copper, glow, iron, layers, plain, rivets, steel
from models.kit.shapes import box, ellipsoid, lathe, mirrored, round_section, torus, tube


def _metal(gold: bool) -> Painter:
    return copper(0.04, 3.0, 51) if gold else steel(0.76)


def _stone(gold: bool) -> str:
    return "fire" if gold else "blue_glow"


def medieval_key(gold: bool) -> Mdl:
    """An old church key: a trefoil bow with a gem, a fluted shank, a bit of four wards."""
    metal = _metal(gold)
    shank = lathe(
        [(0, 1.3), (0.8, 1.5), (1.4, 0.9), (10, 0.9), (10.6, 1.4), (11.6, 1.4), (12.2, 1.0)],
        metal,
        at=(0, 0, 2.0),
        sides=8,
        caps=(0.3, 0),
    )
    bows = [
        torus((0, y, z), X, 2.5, 0.75, metal, around=12, sides=6) for y, z in ((0, 20.4), (3.3, 16.4), (-3.3, 16.4))
    ]
    gem = ellipsoid((0, 0, 17.8), (1.5, 1.7, 1.9), glow(_stone(gold), 0.6, 0.3), rings=3, sides=7, detail=0.8)
    wards = [box((0, 2.6, 3.0 + 2.0 * i), (1.3, 4.0 - 1.1 * (i % 2), 1.2), metal, detail=0.8) for i in range(4)]
    wards.append(box((0, 1.2, 6.0), (1.0, 1.4, 8.0), metal, detail=0.8))
    return item([shank, *bows, gem, *wards], (160, 96))


def rune_key(gold: bool) -> Mdl:
    """A slab of slate bound in metal; the rune cut into it glows."""
    metal = _metal(gold)
    rune = (
        lambda s: (np.abs(s.x) > 1.2)
        & (
            (np.abs(s.y) < 0.55)
            | (np.abs(np.abs(s.y) - (s.z - 12.0) * 0.55) < 0.55) & (s.z > 12)
            | (np.abs(s.z - 7.5 - np.abs(s.y) * 0.6) < 0.6) & (np.abs(s.y) < 4)
        )
        & (s.z > 4.5)
        & (s.z < 20.5)
    )
    slab = tube(
        [(0, 0, 1.0), (0, 0, 2.4), (0, 0, 12), (0, 0, 21), (0, 0, 24)],
        [(1.4, 3.4), (2.0, 5.0), (2.2, 5.8), (2.0, 5.0), (1.2, 2.6)],
        layers(plain("slate", 0.5, 0.16, 3.0, gloss=0.4), (rune, glow(_stone(gold), 0.7, 0.25))),
        section=round_section(10),
        caps=(0.4, 0.6),
        detail=1.4,
    )
    bands = [
        tube(
            [(0, 0, z - 0.9), (0, 0, z + 0.9)],
            [(2.6, 5.9), (2.6, 5.9)],
            layers(metal, (rivets(10, 1, 0.25), iron(0.4, 0.2))),
            section=round_section(10),
            caps=(0.0, 0.0),
        )
        for z in (3.4, 22.0)
    ]
    ring = torus((0, 0, 26.0), X, 2.2, 0.6, metal, around=10, sides=5)
    return item([slab, *bands, ring], (160, 96))


def base_key(gold: bool) -> Mdl:
    """A punched brass plate for the works' locks, with a glowing stripe."""
    metal = _metal(gold)
    holes = (
        lambda s: (((s.y * 0.55) % 1.0 - 0.5) ** 2 + ((s.z * 0.55) % 1.0 - 0.5) ** 2 < 0.07)
        & (np.abs(s.x) > 0.4)
        & (s.z > 4.0)
        & (s.z < 15.0)
        & (np.abs(s.y) < 4.6)
    )
    stripe = lambda s: (np.abs(s.z - 17.4) < 0.9) & (np.abs(s.y) < 4.8) & (np.abs(s.x) > 0.4)
    card = box(
        (0, 0, 10.6),
        (1.5, 12.0, 18.0),
        layers(metal, (holes, iron(0.2, 0.0)), (stripe, glow(_stone(gold), 0.75, 0.15))),
        bevel=0.3,
        detail=1.3,
    )
    clip = torus((0, 0, 20.8), X, 1.7, 0.5, iron(0.45, 0.1), around=9, sides=5)
    tooth = box((0, 3.4, 1.4), (1.1, 2.0, 2.4), metal, detail=0.8)
    return item([card, clip, tooth, mirrored(tooth)], (160, 96))


def sigil(kind: int) -> Mdl:
    """One of four runes of glowing iron in the round: earth, black, hell, elder."""
    ramp = ("fire", "blue_glow", "red_glow", "white_glow")[kind]
    core = layers(iron(0.36, 0.1), (lambda s: np.abs(s.x) > 1.15, glow(ramp, 0.6, 0.35)))
    bar = lambda a, b, r=1.2: tube(
        [a, (np.add(a, b) / 2), b], [(1.5, r), (1.7, r * 1.15), (1.5, r)], core, up=X, sides=6, caps=(0.3, 0.3)
    )
    shapes = [
        [
            bar((0, 0, 1), (0, 0, 23)),
            bar((0, -6, 8), (0, 0, 16)),
            bar((0, 6, 8), (0, 0, 16)),
            bar((0, -5, 3), (0, 5, 3)),
        ],
        [
            torus((0, 0, 12), X, 7.0, (1.3, 1.6), core, around=16, sides=6),
            bar((0, 0, 1), (0, 0, 23)),
            bar((0, -4, 12), (0, 4, 12)),
        ],
        [
            bar((0, -7, 2), (0, 0, 22)),
            bar((0, 7, 2), (0, 0, 22)),
            bar((0, -4, 9), (0, 4, 9)),
            bar((0, 0, 9), (0, 0, 1)),
        ],
        [
            bar((0, -6, 1), (0, 6, 12)),
            bar((0, 6, 12), (0, -6, 23)),
            bar((0, 6, 1), (0, -6, 12)),
            bar((0, -6, 12), (0, 6, 23)),
        ],
    ][kind]
    return item(shapes, (160, 96))


MODELS = {}
for _letter, _key in (("m", medieval_key), ("w", rune_key), ("b", base_key)):
    MODELS[f"{_letter}_s_key"] = functools.partial(_key, False)
    MODELS[f"{_letter}_g_key"] = functools.partial(_key, True)
for _kind in range(4):
    MODELS[f"end{_kind + 1}"] = functools.partial(sigil, _kind)
