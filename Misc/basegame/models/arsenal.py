"""The weapons' shapes, shared by what the player holds and what lies on the ground.

The grip is at the origin, the muzzle at +x.

Moving parts hang on bones of their own, which a pickup leaves at rest.
"""

from __future__ import annotations

import numpy as np

from models.kit.paint import (
    Painter,
    band,
    both_of,
    copper,
    glow,
    iron,
    layers,
    leather,
    plain,
    rib,
    rivets,
    steel,
    where,
    wood,
)
from models.kit.shapes import Patch, box, ellipsoid, lathe, torus, tube

X = (1.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)
BRASS = copper(0.16, 3.0)
OLD = copper(0.5, 3.0)
GRIP = leather(0.45, "ochre")
STOCK = wood(0.52, "brown", grain=(4.0, 0.7, 0.7))


def pipe(
    start,
    length: float,
    radius: float,
    paint: Painter,
    bone_name: str,
    sides: int = 8,
    bore: float = 0.72,
    lip: float = 0.12,
    detail: float = 1.0,
) -> Patch:
    """A barrel with a lip and a bore that goes in."""
    r = radius
    profile = [
        (0.0, r),
        (length - 1.6, r),
        (length - 1.4, r + lip),
        (length, r + lip),
        (length, r * bore),
        (length - 3.0, r * bore * 0.9),
    ]
    return lathe(
        profile,
        where(band("v", 0.74, 1.2), plain("grey", 0.12, 0.03), paint),
        bone_name,
        start,
        X,
        sides,
        caps=(None, 0.0),
        detail=detail,
    )


def flash(at, size: float, bone_name: str = "flash", ramp: str = "fire", sides: int = 6) -> list[Patch]:
    """A muzzle's fire: a star with a tongue; its bone shows or hides it. Deep in colour and small: it fills the view of
    who fires, and what lights the room is the game's own flash."""
    at = np.asarray(at, float)
    tongue = lathe(
        [(-0.6, 0.3), (0.8, 0.9), (2.4, 0.5)],
        glow(ramp, 0.62, 0.2),
        bone_name,
        at,
        X,
        sides,
        caps=(0.2, 1.6),
        detail=0.4,
    )
    tongue.grid = at + (tongue.grid - at) * size
    out = [tongue]
    for angle in np.radians([90, 210, 330]):
        tip = np.array([0.5, np.cos(angle), np.sin(angle)])
        out.append(
            tube(
                [at, at + tip * 1.1 * size, at + tip * 2.3 * size],
                [0.5 * size, 0.42 * size, 0.08 * size],
                glow(ramp, 0.42, 0.2),
                bone_name,
                4,
                up=X,
                detail=0.3,
            )
        )
    return out


def axe() -> list[Patch]:
    haft = lathe(
        [(-11, 0.55), (-10.2, 0.95), (-9.4, 0.6), (0.0, 0.62), (9.0, 0.66), (16.0, 0.6)],
        layers(
            wood(0.5, "brown", grain=(4.0, 0.6, 0.6)),
            (band("x", -4.0, 3.0), layers(leather(0.4, "sand"), (rib("x", 1.0, 0.28), leather(0.62, "sand")))),
            (band("x", 11.0, 20.0), iron(0.45, 0.2)),
        ),
        "gun",
        axis=X,
        sides=7,
        detail=0.9,
    )
    cheek = box((13.2, 0, 0), (2.0, 4.0, 4.2), layers(OLD, (rivets(4, 2, 0.2), steel(0.8))), "gun", X, (0, 1, 0), 0.3)
    edge = layers(iron(0.5, 0.15), (band("v", 0.62, 1.1), steel(0.8)), (both_of(band("v", 0.28, 0.34)), BRASS))
    rows = [(1.5, 0.8, 1.7), (3.2, 0.6, 1.5), (5.2, 0.42, 2.4), (7.2, 0.26, 4.6), (7.9, 0.05, 5.4)]
    blade = tube(
        [(13.2 + 0.12 * (d - 1.5) * (1 if d > 5 else 0), 0, d) for d, _, _ in rows],
        [(t, w) for _, t, w in rows],
        edge,
        "gun",
        up=(0, 1, 0),
        section=np.array([(0, 1.0), (-1, 0.72), (-1, -0.72), (0, -1.0), (1, -0.72), (1, 0.72), (0, 1.0)]),
        detail=1.2,
    )
    beard = tube(
        [(13.2, 0, -1.6), (13.4, 0, -3.6), (12.2, 0, -6.4)],
        [(0.7, 1.3), (0.5, 0.9), (0.06, 0.15)],
        iron(0.5, 0.1),
        "gun",
        4,
        up=(0, 1, 0),
        detail=0.8,
    )
    ring = torus((16.2, 0, 0), X, 0.75, 0.28, BRASS, "gun", 8, 4, detail=0.6)
    return [haft, cheek, blade, beard, ring]


def shotgun() -> list[Patch]:
    barrel = pipe(
        (1.5, 0, 1.2),
        21.0,
        0.95,
        layers(iron(0.48, 0.08), (band("x", 12.0, 12.9), BRASS), (band("x", 3.0, 3.5), BRASS)),
        "gun",
        9,
    )
    tubing = lathe(
        [(0, 0.7), (13.2, 0.7), (13.8, 0.45)],
        layers(iron(0.4, 0.15), (band("v", 0.88, 1.1), BRASS)),
        "gun",
        (2.0, 0, -0.75),
        X,
        7,
        caps=(None, 0.1),
    )
    body = box(
        (0.0, 0, 0.2),
        (3.6, 2.3, 8.0),
        layers(
            BRASS, (rivets(4, 4, 0.16), steel(0.75)), (both_of(band("z", 0.2, 1.3), band("x", -1.0, 2.6)), iron(0.3, 0))
        ),
        "gun",
        X,
        UP,
        0.3,
        1.2,
    )
    slide = lathe(
        [(-2.6, 1.0), (-2.3, 1.3), (2.3, 1.3), (2.6, 1.0)],
        layers(STOCK, (rib("x", 0.8, 0.2), leather(0.24, "brown"))),
        "pump",
        (9.2, 0, -0.75),
        X,
        8,
        caps=(0.0, 0.0),
    )
    stock = tube(
        [(-3.5, 0, 0.1), (-6.5, 0, -0.9), (-11.5, 0, -2.6)],
        [(1.4, 0.95), (1.3, 0.9), (2.2, 1.05)],
        STOCK,
        "gun",
        8,
        up=UP,
        detail=0.6,
    )
    gauge = lathe(
        [(0, 0.9), (0.5, 0.9), (0.6, 0.65)],
        where(
            band("v", 0.7, 1.1),
            where(lambda s: (s.x - s.z * 0.6 > 0.3), plain("sand", 0.9, 0.02, gloss=0.85), plain("coral", 0.6, 0.02, gloss=0.85)),
            BRASS,
        ),
        "gun",
        (-1.2, 0.4, 1.8),
        (-0.35, 0.2, 1),
        8,
        detail=1.2,
    )
    bead = ellipsoid((21.6, 0, 2.4), (0.28, 0.28, 0.4), BRASS, "gun", 2, 5, detail=0.5)
    guard = torus((0.4, 0, -2.2), (0, 1, 0), 1.2, (0.2, 0.3), iron(0.4, 0.1), "gun", 8, 4, detail=0.5)
    return [barrel, tubing, body, slide, stock, gauge, bead, guard]


def double_shotgun() -> list[Patch]:
    out = []
    for y in (1.05, -1.05):
        out.append(
            pipe(
                (1.0, y, 1.0),
                17.0,
                1.0,
                layers(iron(0.5, 0.06), (band("x", 9.0, 9.8), BRASS), (band("x", 1.8, 3.4), OLD)),
                "barrels",
                8,
            )
        )
    rib_ = box((9.2, 0, 1.9), (0.4, 0.7, 16.0), BRASS, "barrels", X, UP, 0.2, 0.5)
    body = box(
        (-0.8, 0, 0.4),
        (3.8, 4.0, 6.4),
        layers(OLD, (rivets(4, 3, 0.18), BRASS), (band("x", 1.6, 4.0), iron(0.4, 0.1))),
        "gun",
        X,
        UP,
        0.35,
        1.2,
    )
    forend = tube(
        [(3.4, 0, -0.4), (7.0, 0, -0.5), (11.4, 0, 0.1)],
        [(1.3, 1.9), (1.3, 1.8), (0.6, 1.2)],
        STOCK,
        "barrels",
        8,
        up=UP,
    )
    stock = tube(
        [(-3.6, 0, 0.2), (-6.5, 0, -0.9), (-11.5, 0, -2.4)],
        [(1.6, 1.2), (1.4, 1.0), (2.3, 1.15)],
        STOCK,
        "gun",
        8,
        up=UP,
        detail=0.6,
    )
    hammers = [
        tube(
            [(-2.6, y, 2.0), (-3.4, y, 3.2), (-2.7, y, 3.9)],
            [0.5, 0.4, 0.25],
            iron(0.5, 0.1),
            "gun",
            5,
            up=(0, 1, 0),
            detail=0.6,
        )
        for y in (1.0, -1.0)
    ]
    lever = tube([(-1.8, 0, 2.4), (-4.2, 0.4, 2.7)], [0.35, 0.5], BRASS, "gun", 5, detail=0.5)
    return out + [rib_, body, forend, stock, lever, *hammers]


def nailgun() -> list[Patch]:
    body = box(
        (0.5, 0, 0.2),
        (4.2, 3.6, 10.0),
        layers(
            OLD, (rivets(8, 5, 0.16), BRASS), (both_of(band("z", -0.6, 1.0), band("x", -2.0, 3.4)), iron(0.32, 0.1))
        ),
        "gun",
        X,
        UP,
        0.35,
        1.1,
    )
    out = [body]
    for y, name in ((1.15, "left"), (-1.15, "right")):
        out.append(pipe((5.0, y, 0.7), 13.0, 0.72, iron(0.5, 0.05), name, 7))
        out.append(
            lathe(
                [(0, 1.0), (0.4, 1.2), (1.0, 1.2), (1.4, 1.0)],
                BRASS,
                name,
                (11.0, y, 0.7),
                X,
                7,
                caps=(None, None),
                detail=0.6,
            )
        )
    shroud = box((8.0, 0, -0.9), (1.2, 3.0, 6.4), iron(0.4, 0.25), "gun", X, UP, 0.3, 0.8)
    hopper = box(
        (1.2, 0, 3.6),
        (6.0, 2.6, 3.4),
        layers(iron(0.44, 0.3), (rib("x", 1.1, 0.3), iron(0.25, 0))),
        "gun",
        (0, 0, 1),
        X,
        0.25,
        0.9,
        taper=1.25,
    )
    nails = [
        lathe(
            [(0, 0.28), (1.1, 0.28), (1.15, 0.5)],
            steel(0.75),
            "gun",
            (x, 0.4 * (-1) ** i, 4.9),
            UP,
            5,
            caps=(None, 0.1),
            detail=0.4,
        )
        for i, x in enumerate((-0.6, 0.7, 2.0, 3.2))
    ]
    handle = tube([(-2.0, 0, -1.5), (-3.4, 0, -4.4)], [(1.2, 0.9), (1.3, 1.0)], GRIP, "gun", 7, up=X, detail=0.5)
    bottle = lathe(
        [(-3.0, 0.8), (-2.2, 1.5), (2.2, 1.5), (3.0, 0.8)],
        copper(0.25, 2.5, 5),
        "gun",
        (-6.4, 0, 0.4),
        X,
        8,
        caps=(0.2, 0.3),
    )
    return out + [shroud, hopper, *nails, handle, bottle]
