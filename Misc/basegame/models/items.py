"""What lies about to be taken: armour, powers, the suit, a pack. All of it turns on the spot."""

from __future__ import annotations

import numpy as np

from formats.mdl import ROTATE, Mdl
from models.kit.figure import build
from models.kit.paint import (
    Painter,
    band,
    both_of,
    canvas,
    copper,
    flesh,
    glow,
    iron,
    layers,
    leather,
    plain,
    rivets,
    spot,
    steel,
    where,
)
from models.kit.shapes import Patch, both, box, ellipsoid, lathe, torus, tube
from models.player import helmet

UP = (0.0, 0.0, 1.0)
Y = (0.0, 1.0, 0.0)
X = (1.0, 0.0, 0.0)


def item(patches: list[Patch], skin=(200, 128), skins: int = 1) -> Mdl:
    return build(patches, None, ["frame1"], skin=skin, skins=skins, flags=ROTATE)


def _by_skin(*painters: Painter) -> Painter:
    return lambda s: painters[s.skin](s)


def armor() -> Mdl:
    """A cuirass in verdigris, brass or red enamel, on nobody."""
    plate = _by_skin(copper(0.9, 5.0, 41), copper(0.1, 4.0, 42), plain("red", 0.78, 0.08, 3.0, 43, gloss=0.82))
    trim = _by_skin(copper(0.1), copper(0.95, 3.0), copper(0.0))
    gem = _by_skin(glow("white_glow", 0.2, 0.2), glow("gold_glow", 0.8, 0.2), glow("red_glow", 0.8, 0.2))
    ridge = lambda s: (np.abs(s.y) < 0.7) & (s.x > 0)
    shell = tube(
        [(0, 0, 3), (0, 0, 8), (0.4, 0, 14), (0.6, 0, 20), (0, 0, 25), (-0.4, 0, 28)],
        [(6.0, 8.2), (5.4, 7.2), (6.6, 8.4), (7.4, 9.6), (6.0, 8.6), (4.2, 5.4)],
        layers(
            plate,
            (ridge, trim),
            (band("z", 2.9, 4.6), trim),
            (band("z", 26.6, 29), trim),
            (both_of(rivets(16, 9, 0.16), lambda s: s.v < 0.3), steel(0.8)),
            (spot((8.0, 0, 19.0), 1.7), gem),
        ),
        sides=14,
        caps=(-1.6, -3.0),
    )
    collar = torus((-0.4, 0, 28.0), UP, 4.8, 0.8, trim, around=12, sides=5, squash=1.25)
    pad = lathe(
        [(-3.4, 5.0), (-2.6, 5.2), (0.4, 4.2), (2.2, 2.2)],
        layers(plate, (band("v", 0.0, 0.24), trim), (both_of(rivets(10, 5, 0.2), band("v", 0.0, 0.24)), steel(0.8))),
        at=(-0.2, 11.2, 24.6),
        axis=(0, 0.5, 1),
        sides=9,
        caps=(0.0, 0.4),
    )
    tassets = box((1.0, 4.4, 0.9), (7.0, 6.0, 5.4), layers(plate, (band("v", 0.0, 0.3), trim)), bevel=0.35, taper=0.86)
    return item([shell, collar] + both(pad, tassets), (256, 160), 3)


def invisibl() -> Mdl:
    """The ring of shadows: a brass ring with coral thorns and one pale eye."""
    ring = torus(
        (0, 0, 10),
        X,
        7.2,
        (1.2, 1.6),
        layers(copper(0.5, 2.0), (lambda s: (s.u * 40) % 1.0 < 0.2, copper(0.0))),
        around=20,
        sides=6,
    )
    seat = lathe([(0, 2.6), (1.6, 3.0), (2.4, 2.6)], copper(0.1, 2.0), at=(0, 0, 17.6), sides=9, caps=(0.4, 0))
    eye = ellipsoid(
        (0, 0, 20.6),
        (2.4, 2.4, 2.0),
        layers(glow("white_glow", 0.3, 0.2), (lambda s: np.abs(s.y) < 0.55, plain("grey", 0.05, 0.0, gloss=0.9))),
        rings=4,
        sides=8,
    )
    thorns = [
        tube(
            [(0, np.cos(a) * 8.0, 10 + np.sin(a) * 8.0), (0, np.cos(a) * 11.0, 10 + np.sin(a) * 11.0)],
            [0.9, 0.1],
            flesh(0.6),
            sides=5,
        )
        for a in np.radians([0, 45, 135, 180, 225, 270, 315])
    ]
    return item([ring, seat, eye, *thorns], (160, 112))


def invulner() -> Mdl:
    """The pentagram: five bars of red glass in an iron ring that hovers."""
    z0, r = 24.0, 13.0
    corner = [np.array([0, np.sin(a) * r, z0 + np.cos(a) * r]) for a in np.radians(np.arange(5) * 144.0)]
    bars = [
        tube([corner[i], corner[(i + 1) % 5]], [0.9, 0.9], glow("red_glow", 0.65, 0.3, 3.0), sides=5, up=X, detail=0.6)
        for i in range(5)
    ]
    ring = torus(
        (0, 0, z0),
        X,
        r + 0.6,
        (1.0, 1.5),
        layers(iron(0.42, 0.2), (lambda s: (s.u * 20) % 1.0 < 0.12, copper(0.1))),
        around=25,
        sides=6,
    )
    knobs = [ellipsoid(c, (1.8, 1.8, 1.8), copper(0.2, 2.0), rings=3, sides=6) for c in corner]
    return item([ring, *bars, *knobs], (200, 128))


def quaddama() -> Mdl:
    """Four blades of blue crystal turned about a golden hub: a Q from every side."""
    z0 = 24.0
    hoop = torus(
        (0, 0, z0),
        X,
        9.0,
        (1.8, 2.2),
        layers(glow("blue_glow", 0.35, 0.5, 3.0), (lambda s: (s.u * 12) % 1.0 < 0.16, copper(0.0))),
        around=20,
        sides=6,
    )
    tail = tube(
        [(0, -3.0, z0 - 4), (0, -7.0, z0 - 9), (0, -11.5, z0 - 13.0)],
        [1.6, 1.9, 0.5],
        glow("blue_glow", 0.5, 0.4),
        up=X,
        sides=6,
        caps=(0.3, 0.8),
    )
    hub = ellipsoid((0, 0, z0), (2.4, 2.4, 2.4), copper(0.0), rings=4, sides=8)
    spokes = [
        tube([(0, 0, z0), (0, np.cos(a) * 9, z0 + np.sin(a) * 9)], [0.6, 0.5], copper(0.1), sides=5, up=X)
        for a in np.radians([45, 135, 225, 315])
    ]
    flames = [
        tube(
            [
                (0, np.cos(a) * 9.6, z0 + np.sin(a) * 9.6),
                (0, np.cos(a + 0.15) * 12, z0 + np.sin(a + 0.15) * 12),
                (0, np.cos(a + 0.4) * 14.0, z0 + np.sin(a + 0.4) * 14.0),
            ],
            [1.3, 1.0, 0.2],
            glow("blue_glow", 0.7, 0.3),
            up=X,
            sides=5,
        )
        for a in np.radians(np.arange(8) * 45.0)
    ]
    return item([hoop, tail, hub, *spokes, *flames], (200, 128))


def suit() -> Mdl:
    """A diving suit hung up to dry: helmet, canvas, boots."""
    cloth = layers(
        canvas(0.62, "sand"), (band("z", 17.0, 18.8), leather(0.34)), (lambda s: np.abs(s.y) < 0.4, leather(0.4))
    )
    trunk = tube(
        [(0, 0, 14), (0, 0, 18), (0.2, 0, 24), (0.2, 0, 30), (0, 0, 33.6)],
        [(3.6, 5.0), (3.8, 5.2), (4.4, 6.0), (4.8, 7.0), (3.2, 4.4)],
        cloth,
        sides=10,
    )
    leg = tube([(0, 2.8, 16), (0, 3.2, 9), (0.2, 3.2, 3)], [3.2, 2.9, 2.6], canvas(0.58, "sand"), sides=7, caps=(0, 0))
    boot = tube(
        [(-2.4, 3.3, 1.9), (0, 3.3, 2.2), (3.0, 3.4, 1.5), (5.4, 3.4, 1.1)],
        [(1.6, 1.9), (2.1, 2.3), (1.5, 2.3), (1.0, 1.8)],
        iron(0.42, 0.3),
        sides=7,
        up=UP,
        caps=(0.3, 0.5),
    )
    arm = tube([(0, 6.4, 31), (0.2, 9.0, 25), (0.8, 9.8, 19)], [2.4, 2.3, 2.1], canvas(0.62, "sand"), sides=7)
    glove = ellipsoid((1.0, 9.9, 16.6), (1.8, 1.5, 2.4), leather(0.42, "ochre"), rings=3, sides=6)
    collar = lathe(
        [(-1.6, 5.6), (-0.8, 6.2), (0.6, 5.4), (1.4, 4.6)],
        layers(copper(0.3), (rivets(10, 2, 0.3), steel(0.75))),
        at=(0, 0, 33.6),
        sides=10,
        caps=(0, 0),
        squash=1.1,
    )
    return item([trunk, collar] + helmet((0.3, 0, 39.4), bone="root") + both(leg, boot, arm, glove), (256, 160))


def backpack() -> Mdl:
    """What the dead leave: a canvas pack with straps and a lantern hung on it."""
    body = box(
        (0, 0, 9.6),
        (10.0, 14.0, 16.0),
        layers(
            canvas(0.56, "olive"),
            (lambda s: np.abs(np.abs(s.y) - 3.8) < 0.9, leather(0.36, "ochre")),
            (lambda s: (np.abs(np.abs(s.y) - 3.8) < 0.7) & (np.abs(s.z - 8.0) < 1.1), steel(0.75)),
        ),
        bevel=0.4,
    )
    flap = box(
        (0.6, 0, 18.2),
        (11.6, 15.0, 3.4),
        layers(leather(0.42, "sand"), (lambda s: np.abs(np.abs(s.y) - 3.8) < 0.9, leather(0.3, "ochre"))),
        bevel=0.5,
    )
    roll = lathe(
        [(-8.6, 1.4), (-8.2, 2.5), (8.2, 2.5), (8.6, 1.4)],
        layers(canvas(0.6, "verdigris"), (lambda s: np.abs(np.abs(s.y) - 5.0) < 0.6, leather(0.34, "ochre"))),
        at=(-0.4, 0, 22.0),
        axis=Y,
        sides=9,
    )
    lamp = lathe(
        [(-2.4, 1.2), (-2.0, 1.7), (-1.8, 1.3), (1.4, 1.3), (1.6, 1.8), (2.6, 0.5)],
        where(band("v", 0.36, 0.66), glow("fire", 0.88, 0.15), copper(0.3)),
        at=(6.4, 0, 6.4),
        sides=7,
        caps=(0, 0.3),
    )
    pocket = box(
        (1.2, 8.0, 6.6), (5.6, 3.0, 8.0), layers(canvas(0.5, "olive"), (band("z", 8.0, 9.0), leather(0.36))), bevel=0.4
    )
    return item([body, flap, roll, lamp] + both(pocket), (200, 128))


MODELS = {
    "armor": armor,
    "invisibl": invisibl,
    "invulner": invulner,
    "quaddama": quaddama,
    "suit": suit,
    "backpack": backpack,
}
