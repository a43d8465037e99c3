"""The enforcer: the works' police in white enamel and brass, a red lens for a face, a lamp that cuts for an arm."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.paint import band, both_of, canvas, copper, glow, iron, layers, leather, plain, rib, rivets, where
from models.kit.shapes import Patch, both, box, lathe, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.grown(humanoid.Build(shoulder=(-0.3, 8.2, 6.6), hip_width=4.2, toe=5.5), 1.07)
ARMS = {
    "hand_r": (0.42, 0.02, -0.62),
    "hand_l": (0.72, -0.22, -0.5),
    "hold": 1,
    "grip": (6, 8, 0),
    "elbow_r": 45,
    "elbow_l": 20,
}
ENAMEL = layers(plain("sand", 0.86, 0.05, 6.0, 91, gloss=0.74), (lambda s: s.noise(4.0, 92, 4) > 0.68, iron(0.45, 0.5)))


def head(at, bone: str = "head") -> list[Patch]:
    x, y, z = at
    lens = where(band("v", 0.62, 1.2), glow("red_glow", 0.8, 0.25, 1.2), copper(0.1))
    shell = box(
        (x - 0.2, y, z),
        (9.0, 8.6, 8.6),
        layers(
            ENAMEL,
            (both_of(rivets(8, 6, 0.18), lambda s: s.v < 0.3), copper(0.1)),
            (band("z", z - 4.5, z - 3.0), copper(0.2)),
        ),
        bone,
        bevel=0.62,
        taper=0.82,
    )
    eye = lathe(
        [(0, 2.5), (1.6, 2.5), (1.9, 1.8), (1.4, 1.6)],
        lens,
        bone,
        (x + 3.6, y + 0.0, z + 0.6),
        (1, 0, 0),
        10,
        caps=(None, 0.5),
        detail=1.3,
    )
    horn = tube(
        [(x - 1, y + 3.6, z + 2.0), (x - 1, y + 5.2, z + 3.4), (x - 1, y + 5.4, z + 7.6)],
        [0.9, 0.8, 0.5],
        copper(0.3),
        bone,
        6,
        up=(1, 0, 0),
        caps=(0, 0.3),
    )
    vent = box(
        (x + 3.8, y, z - 2.7),
        (1.8, 4.6, 1.8),
        layers(iron(0.4, 0.1), (rib("y", 1.0, 0.45), iron(0.16, 0))),
        bone,
        detail=0.9,
    )
    return [shell, eye, horn, vent]


def _body(s: Skeleton) -> list[Patch]:
    k = 1.07
    hip = s.rest["hips"][2]
    under = layers(canvas(0.42, "slate"), (rib("z", 1.3, 0.4), canvas(0.32, "slate")))
    mark = lambda t: (np.abs(t.z - hip - 11.5) < 1.2) & (t.x > 0) & (((t.y + t.z) % 2.6) < 1.3)
    trunk = bodies.trunk(
        s,
        [
            tuple(v * k for v in ring)
            for ring in (
                (-2.6, 0, 3.2, 3.8),
                (0.2, 0, 4.6, 5.8),
                (3.0, 0.1, 4.0, 5.2),
                (6.4, 0.5, 5.6, 6.8),
                (12.0, 0.6, 6.4, 8.2),
                (15.6, 0.0, 5.2, 7.8),
                (17.6, -0.2, 3.6, 4.6),
            )
        ],
        layers(
            ENAMEL,
            (band("z", hip - 9, hip + 5.4), under),
            (band("z", hip - 0.4, hip + 1.8), leather(0.3, "ochre")),
            (mark, plain("yellow", 0.72, 0.05, gloss=0.74)),
            (lambda t: (np.abs(t.y) < 0.4) & (t.x > 0) & (t.z > hip + 5), copper(0.1)),
        ),
        10,
        caps=(0.3, None),
    )
    tank = lathe(
        [(-5.0, 1.6), (-4.2, 2.8), (4.2, 2.8), (5.0, 1.6)],
        layers(copper(0.3), (band("v", 0.44, 0.56), glow("red_glow", 0.45, 0.3))),
        "chest",
        s.rest["chest"] + [-7.4, 0, 3.0],
        sides=8,
        caps=(0.2, 0.3),
    )
    arm = bodies.arm(
        s,
        [r * k for r in (2.6, 2.7, 2.3, 2.5, 2.8, 2.9, 2.3)],
        layers(under, (band("v", 0.55, 1.1), ENAMEL), (band("v", 0.93, 1.1), copper(0.1))),
    )
    leg = bodies.leg(
        s,
        [r * k for r in (3.4, 3.5, 2.9, 3.1, 3.0, 3.2, 2.8)],
        layers(
            under, (band("v", 0.16, 0.4), ENAMEL), (band("v", 0.46, 0.56), copper(0.15)), (band("v", 0.56, 1.1), ENAMEL)
        ),
    )
    pad = lathe(
        [(-2.6, 4.0), (-1.8, 4.2), (0.6, 3.6), (2.2, 1.8)],
        layers(ENAMEL, (band("v", 0.0, 0.24), plain("yellow", 0.7, 0.06, gloss=0.74))),
        {"upper_l": 0.5, "chest": 0.5},
        s.rest["upper_l"] + [0, 1.2, 0.8],
        (0, 0.5, 1),
        8,
        caps=(None, 0.3),
    )
    boot = bodies.boot(
        s, layers(ENAMEL, (lambda t: t.x > s.rest["foot_l"][0] + 3.4, iron(0.4, 0.2))), 9.2, 2.7, 5.0, 2.8, sides=6
    )
    return [trunk, tank] + both(arm, leg, pad, boot, *bodies.mitt(s, leather(0.36, "slate"), 1.05))


def _gun(s: Skeleton) -> list[Patch]:
    at = s.rest["weapon"]
    body = box(
        at + [1.0, 0, 0.4],
        (3.4, 3.0, 9.0),
        layers(ENAMEL, (rivets(4, 3, 0.2), copper(0.1)), (band("z", at[2] - 0.2, at[2] + 0.6), iron(0.3, 0))),
        "weapon",
        (1, 0, 0),
        (0, 0, 1),
        0.3,
    )
    coil = lathe(
        [(0, 1.0), (0.2, 1.3), (7.5, 1.1), (7.8, 1.7), (9.4, 1.5), (9.4, 0.9)],
        layers(iron(0.45, 0.1), (rib("x", 1.5, 0.5), copper(0.0)), (band("v", 0.9, 1.2), glow("red_glow", 0.8, 0.2))),
        "weapon",
        at + [5.2, 0, 0.6],
        (1, 0, 0),
        8,
        caps=(None, -0.3),
    )
    cell = lathe(
        [(-1.6, 1.0), (-1.3, 1.5), (1.3, 1.5), (1.6, 1.0)],
        where(band("v", 0.3, 0.7), glow("red_glow", 0.5, 0.3), copper(0.1)),
        "weapon",
        at + [0.6, 0, -2.2],
        (0, 0, 1),
        7,
        caps=(0, 0),
    )
    stock = box(
        at + [-5.0, 0, 0.0], (2.6, 1.8, 4.6), leather(0.36, "slate"), "weapon", (1, 0, 0.2), (0, 0, 1), detail=0.7
    )
    return [body, coil, cell, stock]


def _clips() -> dict:
    n = lengths("enforcer")
    aim = {"hand_r": (0.5, 0.1, -0.22), "grip": (0, 4, 0), "chest": (4, -10, 0), "root": (0, 0, -0.08), "elbow_r": 60}
    kick = {**aim, "hand_r": (0.38, 0.1, -0.18), "grip": (-7, 4, 0), "chest": (-5, -6, 0), "root": (-0.04, 0, -0.09)}
    return {
        "stand": moves.stand(n["stand"], ARMS),
        "walk": moves.gait(BODY, PACES["enforcer"]["walk"], ARMS, lift=0.12, stance=0.54),
        "run": moves.gait(BODY, PACES["enforcer"]["run"], ARMS, lift=0.24, stance=0.265, offset=-0.95 / 8, drop=0.12, lean=12),
        "attack": moves.acted(n["attack"], ARMS, {0.25: aim, 0.4: aim, 0.5: kick, 0.62: aim, 0.72: kick, 0.85: aim}),
        "death": moves.fall_back(BODY, n["death"], ARMS, 5.5),
        "fdeath": moves.fall_front(BODY, n["fdeath"], ARMS, 5.5),
        "paina": moves.hit(n["paina"], ARMS),
        "painb": moves.hit(n["painb"], ARMS, (-10, -26, 0)),
        "painc": moves.hit(n["painc"], ARMS, (-20, 24, 6)),
        "paind": moves.hit(
            n["paind"], ARMS, (28, 30, 4), (16, 0, 0), 0.04, 0.24, {"hold": 0, "hand_l": (0.45, -0.2, -0.3)}
        ),
    }


def enforcer() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + head(s.rest["head"] + np.array([0.6, 0, 4.6])) + _gun(s)
    return humanoid_model("enforcer", BODY, s, patches, _clips(), ARMS, (6.5, 0.4, -0.6), skin=(256, 216))


MODELS = {"enforcer": enforcer, "h_mega": lambda: severed(head((0, 0, 4.4), "root"), 3.2)}
