"""The heavy weapons' shapes: super nailgun, grenade and rocket launcher, thunderbolt.

As in `arsenal`, the grip is the origin.
"""

from __future__ import annotations

import numpy as np

from models.arsenal import BRASS, GRIP, OLD, STOCK, UP, X, pipe
from models.kit.paint import band, bone, copper, glow, iron, layers, plain, rib, rivets, steel, where
from models.kit.shapes import Patch, box, ellipsoid, lathe, torus, tube


def super_nailgun() -> list[Patch]:
    out = []
    for k in range(6):
        a = np.radians(60 * k + 30)
        out.append(
            pipe(
                (4.0, 1.55 * np.cos(a), 0.8 + 1.55 * np.sin(a)), 14.0, 0.55, iron(0.52, 0.05), "barrels", 5, detail=0.5
            )
        )
    for x in (8.0, 15.6):
        out.append(
            lathe(
                [(0, 1.4), (0.0, 2.45), (0.8, 2.45), (0.8, 1.4)],
                BRASS,
                "barrels",
                (x, 0, 0.8),
                X,
                10,
                caps=(0, 0),
                detail=0.7,
            )
        )
    body = lathe(
        [(-5.4, 1.9), (-4.6, 2.9), (2.6, 2.9), (3.4, 3.3), (5.0, 3.3), (5.4, 2.7)],
        layers(
            OLD,
            (rivets(10, 6, 0.16), BRASS),
            (band("v", 0.62, 0.9), layers(iron(0.42, 0.2), (rivets(10, 8, 0.2), steel(0.7)))),
        ),
        "gun",
        (0, 0, 0.8),
        X,
        10,
        caps=(0.4, -0.3),
        detail=1.1,
    )
    drum = lathe(
        [(-2.6, 2.0), (-2.2, 2.8), (2.2, 2.8), (2.6, 2.0)],
        layers(iron(0.42, 0.3), (rib("x", 1.3, 0.3), BRASS)),
        "gun",
        (0.4, 3.6, -1.0),
        X,
        9,
        caps=(0.1, 0.1),
        detail=0.9,
    )
    window = lathe(
        [(0, 0.85), (0.5, 0.85), (0.55, 0.5)],
        where(band("v", 0.7, 1.1), glow("fire", 0.55, 0.2), BRASS),
        "gun",
        (-2.2, 0, 3.4),
        UP,
        8,
        detail=0.9,
    )
    handle = torus((0.8, 0, 4.4), (0, 1, 0), 1.9, (0.4, 0.45), GRIP, "gun", 9, 5, squash=0.6, detail=0.5)
    grip = tube([(-3.4, 0, -1.4), (-4.8, 0, -4.6)], [(1.3, 1.0), (1.4, 1.0)], GRIP, "gun", 7, up=X, detail=0.5)
    return out + [body, drum, window, handle, grip]


def grenade_launcher() -> list[Patch]:
    tube_ = lathe(
        [(2.0, 2.0), (9.0, 2.0), (9.3, 2.4), (12.6, 2.5), (13.0, 2.2), (13.0, 1.7), (8.0, 1.6)],
        where(band("v", 0.7, 1.2), plain("grey", 0.1, 0.03), layers(OLD, (rivets(8, 12, 0.16), BRASS))),
        "gun",
        (0, 0, 0.8),
        X,
        11,
        caps=(None, 0),
    )
    drum = lathe(
        [(-2.4, 2.6), (-2.1, 3.3), (2.1, 3.3), (2.4, 2.6)],
        layers(
            iron(0.44, 0.2),
            (lambda s: ((s.u * 6.0) % 1.0 - 0.5) ** 2 * 4 + (s.v - 0.5) ** 2 * 9 < 0.42, iron(0.24, 0)),
            (band("v", 0.16, 0.22), BRASS),
            (band("v", 0.78, 0.84), BRASS),
        ),
        "drum",
        (0.2, 0, 0.2),
        X,
        12,
        caps=(0, 0),
        detail=1.1,
    )
    back = box((-4.0, 0, 0.4), (4.0, 3.0, 3.6), layers(BRASS, (rivets(4, 2, 0.2), iron(0.4, 0))), "gun", X, UP, 0.35)
    stock = tube(
        [(-5.6, 0, 0.2), (-8.0, 0, -0.8), (-12.0, 0, -2.2)],
        [(1.5, 1.1), (1.3, 1.0), (2.2, 1.1)],
        STOCK,
        "gun",
        8,
        up=UP,
        detail=0.6,
    )
    under = tube([(3.4, 0, -2.2), (9.6, 0, -2.0)], [(0.9, 1.2), (0.8, 1.1)], STOCK, "gun", 7, up=UP, detail=0.7)
    sight = torus((11.0, 0, 4.0), X, 0.9, 0.18, iron(0.4, 0), "gun", 9, 4, detail=0.4)
    return [tube_, drum, back, stock, under, sight]


def rocket_launcher() -> list[Patch]:
    tube_ = lathe(
        [
            (-9.0, 1.6),
            (-8.4, 2.6),
            (-7.4, 2.2),
            (9.0, 2.2),
            (10.0, 2.5),
            (13.0, 3.6),
            (13.5, 3.5),
            (13.2, 2.9),
            (9.0, 1.8),
        ],
        where(
            band("v", 0.8, 1.2),
            plain("grey", 0.1, 0.03),
            layers(
                iron(0.46, 0.15),
                (band("x", 8.6, 14.0), OLD),
                (band("x", -0.6, 0.4), BRASS),
                (band("x", -6.4, -5.6), BRASS),
            ),
        ),
        "gun",
        (0, 0, 1.2),
        X,
        12,
        caps=(0.0, 0),
    )
    boiler = lathe(
        [(-3.0, 1.0), (-2.4, 1.7), (2.2, 1.7), (3.0, 1.0)],
        layers(OLD, (rivets(7, 6, 0.18), BRASS)),
        "gun",
        (-3.4, 0, 4.3),
        X,
        9,
        caps=(0.2, 0.2),
        detail=1.5,
    )
    pipe = tube(
        [(-0.6, 0, 4.4), (2.2, 0, 4.4), (3.6, 0, 3.6), (3.8, 0, 2.6)],
        [0.45] * 4,
        BRASS,
        "gun",
        6,
        up=(0, 1, 0),
        detail=0.6,
    )
    teeth = [
        tube(
            [(12.6, 3.3 * np.cos(a), 1.2 + 3.3 * np.sin(a)), (15.0, 2.9 * np.cos(a), 1.2 + 2.9 * np.sin(a))],
            [0.6, 0.1],
            bone(0.84),
            "gun",
            5,
            up=UP,
            detail=0.4,
        )
        for a in np.radians([30, 90, 150, 210, 270, 330])
    ]
    eye = lathe(
        [(0, 0.9), (0.6, 0.9), (0.7, 0.6)],
        where(band("v", 0.66, 1.1), glow("red_glow", 0.7, 0.2), BRASS),
        "gun",
        (8.0, 1.7, 2.6),
        (0, 1, 0.7),
        7,
        detail=0.8,
    )
    handle = tube([(0.4, 0, -0.8), (-0.6, 0, -4.4)], [(1.2, 0.9), (1.3, 1.0)], GRIP, "gun", 7, up=X, detail=0.5)
    fore = tube([(6.0, 0, -0.8), (5.8, 0, -3.6)], [(1.0, 0.8), (1.1, 0.9)], GRIP, "gun", 7, up=X, detail=0.5)
    gauge = lathe(
        [(0, 1.0), (0.4, 1.0), (0.5, 0.75)],
        where(
            band("v", 0.72, 1.1),
            where(lambda s: s.y > 0.2, plain("sand", 0.88, 0.02, gloss=0.85), plain("verdigris", 0.75, 0.02, gloss=0.85)),
            BRASS,
        ),
        "gun",
        (-5.4, 0, 4.0),
        (-0.6, 0, 1),
        8,
    )
    return [tube_, boiler, pipe, eye, handle, fore, gauge, *teeth]


def thunderbolt() -> list[Patch]:
    core = lathe(
        [(-6.4, 1.2), (-5.6, 2.2), (1.6, 2.2), (2.2, 2.7), (3.6, 2.7), (4.0, 2.0)],
        layers(OLD, (rivets(9, 6, 0.17), BRASS)),
        "gun",
        (0, 0, 0.6),
        X,
        10,
        caps=(0.3, 0),
    )
    jar = lathe(
        [(4.0, 1.5), (4.4, 1.75), (8.6, 1.75), (9.2, 1.4)],
        layers(glow("blue_glow", 0.25, 0.9, 1.6), (rib("x", 1.1, 0.26), BRASS)),
        "jar",
        (0, 0, 0.6),
        X,
        9,
        caps=(None, None),
    )
    head = lathe([(9.0, 1.3), (9.2, 2.0), (10.6, 2.0), (11.4, 1.3)], BRASS, "gun", (0, 0, 0.6), X, 9, caps=(None, -0.2))
    out = [core, jar, head]
    for k in range(3):
        a = np.radians(90 + 120 * k)
        c = np.array([0, np.cos(a), np.sin(a)])
        base = np.array([10.0, 0, 0.6]) + c * 1.7
        out.append(
            tube(
                [base, base + [3.0, 0, 0] + c * 1.3, base + [6.6, 0, 0] + c * 0.9, base + [9.4, 0, 0] - c * 0.9],
                [0.62, 0.5, 0.42, 0.12],
                OLD,
                "gun",
                6,
                up=c,
                detail=0.6,
            )
        )
        out.append(
            ellipsoid(
                base + [9.2, 0, 0] - c * 0.8, (0.5, 0.5, 0.55), glow("blue_glow", 0.9, 0.2), "gun", 2, 5, detail=0.4
            )
        )
    for x in (-4.0, -2.0, 0.0):
        out.append(torus((x, 0, 0.6), X, 2.45, 0.5, copper(0.0, 2.0, metal="brown"), "gun", 10, 5, detail=0.5))
    handle = tube([(-3.6, 0, -1.4), (-4.8, 0, -4.4)], [(1.2, 0.9), (1.3, 1.0)], GRIP, "gun", 7, up=X, detail=0.5)
    cable = tube(
        [(-5.8, 0, 2.2), (-7.4, 0.6, 3.2), (-9.6, 1.2, 1.4), (-11.5, 1.4, -2.0)],
        [0.55] * 4,
        iron(0.3, 0),
        "gun",
        5,
        up=(0, 1, 0),
        detail=0.5,
    )
    return out + [handle, cable]
