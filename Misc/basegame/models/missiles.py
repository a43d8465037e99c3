"""What flies: rockets, nails, thorns, lumps of lava and of flesh. The front is +x."""

from __future__ import annotations

import functools

import numpy as np

from formats.mdl import GIB, GRENADE, ROCKET, TRACER, TRACER2, TRACER3, ZOMGIB, Frame, Mdl
from models.conventions import frame_names
from models.kit.figure import build
from models.kit.noise import fbm
from models.kit.paint import band, bone, copper, flesh, glow, iron, layers, magma, plain, rib, steel, where
from models.kit.shapes import Patch, ellipsoid, flat_section, lathe, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

X = (1.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)


def _one(patches: list[Patch], flags: int = 0, skin=(96, 64)) -> Mdl:
    return build(patches, None, ["frame1"], skin=skin, flags=flags)


def rough(patch: Patch, amount: float, size: float, seed: int) -> Patch:
    """The patch with its vertices pushed about by up to `amount` units; what coincides stays together."""
    push = np.stack([fbm(patch.grid + 30.0, size, 2, seed + k) for k in range(3)], axis=-1) - 0.5
    patch.grid = patch.grid + push * 2.0 * amount
    return patch


def missile() -> Mdl:
    body = lathe(
        [(-9, 1.2), (-8.6, 1.8), (2.0, 2.0), (5.0, 1.7), (7.4, 0.8)],
        layers(iron(0.5, 0.15), (band("x", 1.6, 2.6), copper(0.1)), (band("x", 2.6, 9.0), plain("coral", 0.6, 0.06, gloss=0.6))),
        at=(0, 0, 0),
        axis=X,
        sides=9,
        caps=(0, 0.6),
    )
    fins = [
        tube(
            [(-9.6, 0, 0), (-4.0, 0, 0)],
            [(0.18, 3.6), (0.15, 1.9)],
            copper(0.4, 2.0),
            up=(0, np.cos(a), np.sin(a)),
            section=flat_section(),
        )
        for a in np.radians([0, 90])
    ]
    fire = lathe([(-13.0, 0.25), (-11.0, 0.8), (-9.0, 1.2)], glow("fire", 0.9, 0.2), axis=X, sides=6, caps=(0.8, 0))
    return _one([body, *fins, fire], ROCKET)


def grenade() -> Mdl:
    shell = lathe(
        [(-4.4, 1.6), (-3.8, 2.8), (-1.6, 3.2), (1.6, 3.2), (3.8, 2.6), (4.4, 1.8)],
        layers(
            copper(0.4, 3.0), (rib("x", 2.0, 0.35), iron(0.3, 0.2)), (lambda s: (s.u * 8) % 1.0 < 0.1, iron(0.3, 0.2))
        ),
        axis=X,
        sides=10,
        caps=(0.3, 0.2),
    )
    fuse = lathe(
        [(4.4, 1.0), (6.0, 0.9), (6.2, 0.5), (7.0, 0.5)],
        where(band("x", 6.1, 9.0), glow("fire", 0.8, 0.2), copper(0.0)),
        axis=X,
        sides=6,
        caps=(0, 0.5),
    )
    lever = tube([(4.6, 0, 1.2), (3.0, 0, 3.4), (-2.6, 0, 3.9)], [(0.3, 0.6)] * 3, steel(0.7), sides=5, up=UP)
    return _one([shell, fuse, lever], GRENADE)


def nail(length: float = 10.0, big: float = 1.0) -> Mdl:
    shaft = lathe(
        [(0, 1.0 * big), (0.7 * big, 1.0 * big), (0.9 * big, 0.5 * big), (length * 0.75, 0.5 * big)],
        where(band("v", 0.0, 0.25), copper(0.2), steel(0.72)),
        axis=X,
        sides=6,
        caps=(0, length * 0.25),
    )
    return _one([shaft], skin=(48, 32))


def k_spike() -> Mdl:
    """A hell knight's blade of fire."""
    blade = tube(
        [(0, 0, 0), (6, 0, 0), (16, 0, 0), (24, 0, 0)],
        [(0.4, 1.4), (0.7, 2.8), (0.5, 1.9), (0.2, 0.6)],
        glow("fire", 0.7, 0.5, 4.0),
        section=flat_section(),
        up=UP,
        caps=(1.0, 4.0),
    )
    rib_ = tube([(-1, 0, 0), (12, 0, 0), (25, 0, 0)], [0.8, 1.0, 0.3], glow("fire", 0.98, 0.1), sides=5, up=UP)
    return _one([blade, rib_], TRACER2)


def w_spike() -> Mdl:
    """The wizard's spit: drops of venom that wobble."""
    drop = lathe(
        [(0, 0.5), (3, 1.3), (7, 1.9), (10, 1.2)], glow("gold_glow", 0.75, 0.3), axis=X, sides=8, caps=(0.8, 1.2)
    )
    rim = lathe(
        [(1.5, 1.2), (4, 2.1), (7, 2.7), (9.5, 2.3)],
        plain("verdigris", 0.8, 0.2, 1.5),
        axis=X,
        sides=6,
        caps=(None, None),
    )
    posing = Posing(Skeleton({"root": ("", (0, 0, 0))}), 4)
    size = np.array([[1, 1, 1], [1.1, 0.86, 1.1], [1, 1.05, 0.92], [0.92, 1.1, 1.0]])
    posing.place(
        "root",
        euler(np.stack([np.zeros(4), np.zeros(4), np.arange(4) * 30.0], axis=1)) * size[:, None, :],
        np.zeros((4, 3)),
    )
    return build([drop, rim], posing, frame_names("w_spike"), skin=(96, 64), flags=TRACER)


def star(radius: float, spikes: int, ramp: str, flags: int, crust: str = "mauve") -> Mdl:
    """A ball of thorns around a glowing core."""
    core = ellipsoid(
        (0, 0, 0),
        (radius * 0.62,) * 3,
        layers(
            plain(crust, 0.35, 0.2, radius * 0.3), (lambda s: s.noise(radius * 0.4, 5, 2) > 0.55, glow(ramp, 0.7, 0.4))
        ),
        rings=5,
        sides=9,
    )
    out = [core]
    for i in range(spikes):
        # Points spread evenly over the sphere (Fibonacci).
        z = 1 - (2 * i + 1) / spikes
        a = i * np.pi * (3 - 5**0.5)
        d = np.array([np.cos(a) * np.sqrt(1 - z * z), np.sin(a) * np.sqrt(1 - z * z), z])
        out.append(
            tube(
                [d * radius * 0.5, d * radius],
                [radius * 0.17, radius * 0.03],
                layers(plain(crust, 0.5, 0.1), (band("v", 0.55, 1.1), glow(ramp, 0.8, 0.2))),
                sides=5,
                up=np.cross(d, (0.3, 0.5, 0.8)),
                caps=(None, radius * 0.05),
                detail=0.6,
            )
        )
    return _one(out, flags, (128, 64))


def lavaball() -> Mdl:
    lump = rough(ellipsoid((0, 0, 0), (6.2, 6.2, 6.2), magma(0.8, 5.0), rings=7, sides=11), 1.4, 4.0, 7)
    return _one([lump], ROCKET, (96, 64))


def laser() -> Mdl:
    beam = lathe(
        [(-9, 0.35), (-4, 0.9), (7, 0.9), (10, 0.4)], glow("red_glow", 0.85, 0.2), axis=X, sides=6, caps=(1.5, 1.5)
    )
    posing = Posing(Skeleton({"root": ("", (0, 0, 0))}), 5)
    size = np.array([1.0, 1.12, 0.94, 1.08, 0.9])
    posing.place(
        "root",
        euler(np.stack([np.zeros(5), np.zeros(5), np.arange(5) * 24.0], axis=1))
        * np.stack([np.ones(5), size, size], axis=1)[:, None, :],
        np.zeros((5, 3)),
    )
    return build([beam], posing, [Frame("frame1", list(range(5)))], skin=(48, 32))


def gib(kind: int) -> Mdl:
    """A lump of coral flesh, a limb with its bone, or ribs."""
    if kind == 1:
        lump = rough(ellipsoid((0, 0, 3), (3.6, 5.4, 3.0), flesh(0.55), rings=5, sides=8), 1.2, 3.0, 3)
        return _one([lump, tube([(0, 3, 3), (1, 7, 4.5)], [0.9, 0.7], bone(0.85), sides=6)], GIB)
    if kind == 2:
        limb = rough(
            tube(
                [(-9, -4, 0), (-4, 0, 1.5), (2, 1, 1.5), (7, 0, 0)],
                [3.0, 3.6, 2.8, 2.4],
                flesh(0.56, seed=17),
                sides=8,
                up=UP,
            ),
            0.5,
            3.0,
            4,
        )
        return _one(
            [
                limb,
                tube([(7, 0, 0), (13, -1.5, 0)], [1.0, 0.9], bone(), sides=6, up=UP, caps=(0, 0.4)),
                tube([(-12, -6, 0), (-9, -4, 0)], [0.8, 1.0], bone(), sides=6, up=UP),
            ],
            GIB,
        )
    spine = tube(
        [(-12, 0, 0), (-4, 0, 2), (4, 0, 2), (12, 0, 0)],
        [1.6, 2.0, 2.0, 1.5],
        layers(flesh(0.5), (rib("x", 3.0, 1.4), bone())),
        sides=7,
        up=UP,
    )
    ribs = [
        tube([(x, 0, 2), (x + 1, side * 6, 3.5), (x + 1.5, side * 9, -1.5)], [0.9, 0.8, 0.35], bone(), sides=5, up=X)
        for x in (-7, -2, 3, 8)
        for side in (1, -1)
    ]
    return _one([spine, *ribs], GIB)


def zom_gib() -> Mdl:
    return _one(
        [rough(ellipsoid((0, 0, 0), (3.0, 2.2, 2.4), flesh(0.5, seed=23), rings=4, sides=7), 0.8, 2.0, 9)],
        ZOMGIB,
        (48, 32),
    )


def eyes() -> Mdl:
    """What remains to see of one who cannot be seen."""
    out = [
        ellipsoid(
            (1.0, y, 25.5),
            (1.3, 1.3, 1.3),
            layers(
                glow("white_glow", 0.5, 0.1), (lambda s, y=y: s.near((2.2, y, 25.5), 0.75), plain("blue", 0.4, 0.0, gloss=0.9))
            ),
            rings=5,
            sides=9,
        )
        for y in (2.0, -2.0)
    ]
    return build(out, None, ["frame1"], skin=(64, 48))


MODELS = {
    "missile": missile,
    "grenade": grenade,
    "spike": nail,
    "s_spike": functools.partial(nail, 11.0, 1.25),
    "k_spike": k_spike,
    "w_spike": w_spike,
    "v_spike": functools.partial(star, 6.0, 16, "red_glow", TRACER3),
    "teleport": functools.partial(star, 30.0, 24, "fire", 0, "slate"),
    "lavaball": lavaball,
    "laser": laser,
    "gib1": functools.partial(gib, 1),
    "gib2": functools.partial(gib, 2),
    "gib3": functools.partial(gib, 3),
    "zom_gib": zom_gib,
    "eyes": eyes,
}
