"""The ogre: a stoker grown around his furnace.

The fire door is in his belly, the chimney on his back, one hand is a saw.
"""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.paint import (
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
    rib,
    rivets,
    steel,
    where,
)
from models.kit.shapes import Patch, both, box, disc, ellipsoid, lathe, torus, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.grown(
    humanoid.Build(
        thigh=8.6,
        shin=8.6,
        hip_width=4.6,
        belly=3.5,
        chest=9.5,
        shoulder=(0.0, 8.6, 6.0),
        neck=7.0,
        neck_forward=1.6,
        upper=8.2,
        lower=8.4,
        crouch=0.94,
        toe=5.9,
        heel=2.9,
    ),
    1.42,
)
ARMS = {
    "hand_r": (0.42, -0.12, -0.68),
    "hand_l": (0.24, 0.34, -0.78),
    "hold": 0,
    "grip": (6, 6, 0),
    "grip_l": (20, 0, 0),
    "elbow_r": 40,
    "elbow_l": 40,
}
SKIN = flesh(0.66, "tan", 71, 0.35)


def head(at, bone: str = "head") -> list[Patch]:
    """A jaw like a coal shovel under a riveted pot; two embers look out."""
    x, y, z = at
    eye = lambda s: s.near((x + 4.6, y + 2.0, z + 0.4), 1.15) | s.near((x + 4.6, y - 2.0, z + 0.4), 1.15)
    skull = lathe(
        [(-4.6, 3.2), (-3.0, 4.8), (-0.6, 5.2), (2.0, 5.0), (3.4, 4.4)],
        layers(
            SKIN,
            (both_of(band("z", z - 1.0, z + 2.0), lambda s: s.x > x + 2.5), plain("sand", 0.22, 0.05)),
            (eye, glow("fire", 0.8, 0.2)),
        ),
        bone,
        at,
        sides=9,
        caps=(0.3, 0),
    )
    pot = lathe(
        [(2.2, 6.2), (2.8, 6.1), (3.1, 5.6), (5.4, 4.9), (7.2, 2.8)],
        layers(
            iron(0.42, 0.5, 4.0),
            (band("v", 0.0, 0.2), copper(0.2)),
            (both_of(rivets(10, 5, 0.22), band("v", 0.2, 0.42)), steel(0.7)),
        ),
        bone,
        at,
        sides=8,
        caps=(-0.2, 0.5),
    )
    jaw = box(
        (x + 2.8, y, z - 3.3),
        (6.4, 8.6, 3.6),
        layers(SKIN, (lambda s: (s.x > x + 4.4) & (np.abs(s.z - z + 2.0) < 0.5), plain("red", 0.3, 0.1, gloss=0.68))),
        bone,
        bevel=0.5,
        detail=0.9,
    )
    tusk = bodies.spike((x + 5.6, y + 2.6, z - 2.4), (x + 7.0, y + 3.4, z + 1.4), 0.9, plain("sand", 0.86, 0.06, gloss=0.5), bone)
    return [skull, pot, jaw] + both(tusk)


def _body(s: Skeleton) -> list[Patch]:
    k = 1.42
    hip, chest = s.rest["hips"][2], s.rest["chest"]
    door = hip + 5.2 * k
    trunk = bodies.trunk(
        s,
        [
            tuple(v * k for v in ring)
            for ring in (
                (-2.6, 0, 3.2, 4.2),
                (0.4, 0.6, 5.6, 6.8),
                (4.6, 1.2, 6.8, 7.8),
                (8.6, 0.9, 6.2, 7.6),
                (12.4, 0.3, 5.6, 8.2),
                (15.6, 0.2, 4.4, 7.2),
                (17.2, 0.6, 2.8, 4.0),
            )
        ],
        layers(
            SKIN,
            (band("z", hip - 30, hip + 1.0), leather(0.34, "sand")),
            (band("z", hip - 0.2, hip + 2.2), layers(leather(0.28, "ochre"), (rivets(12, 14, 0.2), steel(0.6)))),
        ),
        11,
        caps=(0.4, None),
    )
    collar = lathe(
        [(-1.0, 5.2), (1.6, 5.8), (2.2, 5.2), (2.0, 4.4)],
        layers(
            iron(0.4, 0.35),
            (lambda t: (t.u * 10) % 1.0 < 0.16, copper(0.1)),
            (
                band("v", 0.66, 1.2),
                where(lambda t: np.abs(((t.y + 50) * 0.5) % 1.0 - 0.5) < 0.3, glow("fire", 0.7, 0.4), iron(0.2, 0)),
            ),
        ),
        "belly",
        (10.4, 0, door),
        (1, 0, 0.08),
        9,
        caps=(None, -0.3),
        detail=1.3,
    )
    strap = torus(
        (1.0, 0, chest[2] + 3.4 * k),
        (0.25, 0.5, 1),
        9.8,
        (0.5, 1.2),
        leather(0.32, "ochre"),
        "chest",
        12,
        3,
        squash=1.28,
        detail=0.6,
    )
    pipe = tube(
        [(-7.0, -2.6, chest[2] + 2), (-9.4, -3.2, chest[2] + 8), (-9.2, -3.4, chest[2] + 20)],
        [2.4, 2.3, 2.2],
        layers(
            iron(0.36, 0.5, 5.0),
            (lambda t: t.z > chest[2] + 18.6, copper(0.1)),
            (band("v", 0.94, 1.2), glow("fire", 0.3, 0.2)),
        ),
        "chest",
        8,
        caps=(0.2, -1.6),
    )
    cap = lathe(
        [(0, 3.4), (0.6, 3.4), (2.4, 0.8)],
        iron(0.4, 0.4),
        "chest",
        (-9.2, -3.4, chest[2] + 21.6),
        sides=8,
        caps=(0, 0.2),
    )
    arm = bodies.arm(
        s,
        [r * k for r in (3.2, 3.5, 2.7, 2.5, 2.9, 2.9, 2.0)],
        layers(SKIN, (band("v", 0.86, 0.97), leather(0.3, "ochre"))),
        6,
    )
    leg = bodies.leg(
        s,
        [r * k for r in (3.9, 4.0, 3.2, 3.0, 2.9, 3.0, 2.4)],
        layers(canvas(0.4, "slate"), (band("v", 0.62, 0.74), leather(0.3))),
        6,
    )
    apron = bodies.skirt(
        s,
        [tuple(v * k for v in ring) for ring in ((0.8, 0.6, 5.7, 6.9), (-4.0, 0.4, 5.8, 7.2), (-8.0, 0.0, 6.0, 7.6))],
        layers(leather(0.38, "sand"), (band("v", 0.9, 1.1), leather(0.24))),
        10,
    )
    boot = bodies.boot(s, iron(0.4, 0.5), 9.4 * k, 2.8 * k, 4.6 * k, 3.0 * k, sides=6)
    pad = ellipsoid(
        s.rest["upper_l"] + np.array([0, 1.2, 1.6]) * k,
        (4.2 * k, 3.0 * k, 2.4 * k),
        layers(iron(0.42, 0.4), (rivets(8, 4, 0.22), copper(0.1))),
        {"upper_l": 0.6, "chest": 0.4},
        3,
        7,
    )
    return [trunk, disc(collar), strap, pipe, cap, apron, pad] + both(arm, leg, boot, *bodies.mitt(s, SKIN, 1.35))


def _saw(s: Skeleton) -> list[Patch]:
    at = s.rest["weapon"]
    motor = box(
        at + [1.6, 0, 0.6],
        (7.0, 4.6, 8.0),
        layers(
            copper(0.35, 4.0),
            (rivets(6, 4, 0.18), iron(0.4, 0)),
            (lambda t: (np.abs(t.z - at[2] - 0.6) < 1.2), layers(iron(0.3, 0.2), (rib("x", 1.4, 0.5), iron(0.5, 0.2)))),
        ),
        "weapon",
        (1, 0, 0),
        (0, 0, 1),
        0.3,
    )
    teeth = lambda t: ((t.x * 0.62 + np.sign(t.z - at[2]) * 0.25) % 1.0) < 0.5
    bar = tube(
        [at + [5.2, 0, 0.4], at + [8.0, 0, 0.4], at + [22.0, 0, 0.4], at + [25.0, 0, 0.4]],
        [(2.8, 0.8), (3.5, 0.7), (3.4, 0.7), (2.2, 0.6)],
        layers(steel(0.6), (lambda t: np.abs(t.z - at[2] - 0.4) > 2.2, where(teeth, steel(0.85), iron(0.24, 0.3)))),
        "weapon",
        up=(0, 0, 1),
        section=np.array([(-1, 0), (-0.8, -1), (0.8, -1), (1, 0), (0.8, 1), (-0.8, 1), (-1, 0)], float),
        caps=(0, 0.6),
    )
    saw_teeth = [
        tube(
            [at + [x, 0, 0.4 + sgn * 3.2], at + [x + 0.6, 0, 0.4 + sgn * 4.6]],
            [0.9, 0.2],
            steel(0.8),
            "weapon",
            4,
            up=(0, 1, 0),
            detail=0.4,
        )
        for x in (11.0, 18.0)
        for sgn in (1, -1)
    ]
    launcher_at = s.rest["weapon_l"]
    launcher = lathe(
        [(-6.0, 2.4), (-5.4, 3.0), (5.0, 2.8), (6.0, 3.4), (8.0, 3.4), (8.0, 2.4), (5.0, 2.2)],
        layers(iron(0.42, 0.4), (band("v", 0.2, 0.26), copper(0.1)), (band("v", 0.78, 1.2), plain("grey", 0.1, 0.03))),
        "weapon_l",
        launcher_at + [0, 0.0, 0.0],
        (1, 0, 0),
        8,
        caps=(0.3, 0),
    )
    return [motor, bar, *saw_teeth, launcher]


def _clips() -> dict:
    n = lengths("ogre")
    back = {
        "hand_r": (0.2, -0.75, 0.1),
        "grip": (-10, -70, -40),
        "chest": (-4, -36, 0),
        "head": (0, 26, 0),
        "root": (-0.04, 0, -0.06),
    }
    across = {
        "hand_r": (0.72, 0.5, -0.2),
        "grip": (0, 64, 30),
        "chest": (12, 36, 0),
        "head": (-6, -26, 0),
        "root": (0.12, 0, -0.14),
        "foot_r": (0.22, -0.1, 0),
    }
    up = {
        "hand_r": (0.3, 0.0, 0.72),
        "hand_l": (0.3, 0.0, 0.62),
        "grip": (-100, 0, 0),
        "chest": (-16, 0, 0),
        "head": (-6, 0, 0),
        "root": (-0.04, 0, 0),
    }
    down = {
        "hand_r": (0.82, 0.15, -0.45),
        "hand_l": (0.7, -0.1, -0.5),
        "grip": (40, 0, 0),
        "chest": (28, 0, 0),
        "head": (-18, 0, 0),
        "root": (0.1, 0, -0.24),
        "foot_l": (0.2, 0.08, 0),
    }
    point = {"hand_l": (0.86, 0.05, 0.05), "grip_l": (-2, 0, 0), "chest": (2, -12, 0), "root": (0, 0, -0.08)}
    kick = {**point, "hand_l": (0.6, 0.1, 0.12), "grip_l": (-24, 0, 0), "chest": (-12, -4, 0), "root": (-0.08, 0, -0.1)}
    cord = {"hand_l": (0.5, -0.45, -0.5), "chest": (14, -22, 0), "head": (10, -10, 0)}
    pull = {"hand_l": (0.2, 0.5, 0.1), "chest": (-6, 24, 0), "head": (0, 10, 0)}
    return {
        "stand": moves.stand(n["stand"], ARMS),
        "walk": moves.gait(BODY, PACES["ogre"]["walk"], ARMS, lift=0.13, stance=0.56, sway_side=0.07, lean=7, swing=0.06),
        "run": moves.gait(
            BODY, PACES["ogre"]["run"], ARMS, lift=0.22, stance=0.265, offset=0.05 / 8, drop=0.12, sway_side=0.07, lean=15, swing=0.1
        ),
        "swing": moves.acted(
            n["swing"], ARMS, {0.22: back, 0.36: back, 0.5: across, 0.64: {**across, "grip": (0, 80, 60)}, 0.8: back}
        ),
        "smash": moves.acted(n["smash"], ARMS, {0.25: up, 0.42: up, 0.56: down, 0.75: down}),
        "shoot": moves.acted(n["shoot"], ARMS, {0.2: point, 0.36: point, 0.5: kick, 0.75: point}),
        "pain": moves.hit(n["pain"], ARMS),
        "painb": moves.hit(n["painb"], ARMS, (-10, -24, 0)),
        "painc": moves.hit(n["painc"], ARMS, (-20, 26, 6)),
        "paind": moves.hit(n["paind"], ARMS, (30, 20, 0), (20, 0, 0), -0.05, 0.22, {"hand_l": (0.5, -0.2, -0.2)}),
        "paine": moves.hit(
            n["paine"],
            ARMS,
            (-26, -30, -8),
            (-20, 0, 10),
            0.14,
            0.2,
            {"hand_l": (0.1, 0.85, 0.2), "hand_r": (0.1, -0.85, -0.1)},
        ),
        "death": moves.fall_back(BODY, n["death"], ARMS, 9.0),
        "bdeath": moves.fall_front(BODY, n["bdeath"], ARMS, 9.5),
        "pull": moves.acted(n["pull"], ARMS, {0.2: cord, 0.34: pull, 0.5: cord, 0.64: pull, 0.8: pull}),
    }


def ogre() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + head(s.rest["head"] + np.array([1.0, 0, 4.0])) + _saw(s)
    return humanoid_model(
        "ogre",
        BODY,
        s,
        patches,
        _clips(),
        ARMS,
        posture={"belly": (4, 0, 0), "chest": (8, 0, 0), "head": (-10, 0, 0)},
        skin=(296, 216),
    )


MODELS = {"ogre": ogre, "h_ogre": lambda: severed(head((0, 0, 5.0), "root"), 3.6)}
