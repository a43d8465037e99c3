"""The zombie: a drowned bell-ringer turned to wax. A candle grows from his skull, and his ribs show."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import Clip, merge
from models.kit.paint import band, canvas, flesh, glow, iron, layers, leather, plain, wax
from models.kit.shapes import Patch, both, box, ellipsoid, lathe, torus, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.Build(
    hip_width=3.3, shoulder=(-0.2, 6.2, 6.2), neck=8.2, neck_forward=1.0, upper=8.4, lower=8.8, crouch=0.95, toe=4.8, heel=2.0
)
ARMS = {"hand_r": (0.42, -0.14, -0.74), "hand_l": (0.56, 0.1, -0.6), "hold": 0, "elbow_r": 10, "elbow_l": 10}
WAX = wax(0.78, 81)


def head(at, bone_name: str = "head") -> list[Patch]:
    x, y, z = at
    sockets = lambda s: s.near((x + 3.6, y + 1.5, z + 0.8), 1.25) | s.near((x + 3.6, y - 1.5, z + 0.8), 1.25)
    eyes = lambda s: s.near((x + 3.5, y + 1.5, z + 0.7), 0.55) | s.near((x + 3.5, y - 1.5, z + 0.7), 0.55)
    mouth = lambda s: (np.abs(s.z - z + 2.2) < 0.8) & (s.x > x + 1.4) & (np.abs(s.y - y) < 1.9)
    skull = lathe(
        [(-3.8, 2.0), (-2.8, 2.9), (-0.8, 3.5), (1.4, 3.9), (3.0, 3.3), (4.0, 2.0)],
        layers(
            WAX,
            (sockets, plain("sand", 0.24, 0.05)),
            (eyes, glow("gold_glow", 0.6, 0.3)),
            (mouth, plain("red", 0.26, 0.1, gloss=0.68)),
        ),
        bone_name,
        at,
        sides=9,
        caps=(0.2, 0.4),
        squash=0.92,
    )
    jaw = box(
        (x + 1.5, y, z - 3.4), (3.6, 3.8, 1.6), WAX, "jaw" if bone_name == "head" else bone_name, bevel=0.5, detail=0.8
    )
    candle = lathe(
        [(-0.6, 2.2), (0.4, 1.5), (1.2, 1.15), (4.4, 1.0)],
        wax(0.9, 5),
        bone_name,
        (x - 0.6, y + 0.4, z + 3.6),
        (-0.12, 0.1, 1),
        7,
        caps=(None, 0.1),
    )
    flame = lathe(
        [(0, 0.2), (0.7, 0.6), (1.6, 0.3)],
        glow("fire", 0.92, 0.15),
        bone_name,
        (x - 1.2, y + 0.9, z + 8.0),
        sides=5,
        caps=(0.1, 1.0),
        detail=0.5,
    )
    drip = [
        tube(
            [
                (x + dx, y + dy, z + 3.2),
                (x + dx * 1.35, y + dy * 1.35, z + 1.0),
                (x + dx * 1.4, y + dy * 1.4, z - 1.0 - abs(dy)),
            ],
            [0.7, 0.75, 0.35],
            wax(0.88, 6),
            bone_name,
            5,
            caps=(0, 0.3),
            detail=0.6,
        )
        for dx, dy in ((-1.2, 2.6), (0.6, -2.6))
    ]
    return [skull, jaw, candle, flame, *drip]


def _body(s: Skeleton) -> list[Patch]:
    hip = s.rest["hips"][2]
    open_ribs = (
        lambda t: (t.x > 0.6)
        & (t.z > hip + 4.6)
        & (t.z < hip + 13.6)
        & (np.abs(t.y) < 5.2 - 0.25 * np.abs(t.z - hip - 9))
        & (np.abs(t.y) > 0.7)
        & ((t.z + 0.3 * np.abs(t.y)) % 1.9 > 0.85)
    )
    rags = lambda t: (t.z < hip + 1.6) | ((t.y + t.z * 0.5 > hip * 0.5 + 7.0) & (t.z > hip + 5))
    trunk = bodies.trunk(
        s,
        [
            (-2.4, 0, 2.7, 3.2),
            (0.0, 0, 3.5, 4.6),
            (3.4, 0.4, 2.8, 3.8),
            (7.0, 0.4, 3.8, 5.0),
            (11.0, 0.3, 4.4, 5.8),
            (14.6, 0.2, 3.6, 5.4),
            (16.6, 0.7, 2.0, 2.4),
        ],
        layers(
            WAX,
            (open_ribs, flesh(0.4, seed=83)),
            (rags, canvas(0.46, "slate", 84)),
            (band("z", hip + 0.6, hip + 1.6), leather(0.3)),
        ),
        10,
        caps=(0.3, None),
        detail=1.1,
    )
    arm = bodies.arm(
        s, [2.0, 2.1, 1.6, 1.7, 1.6, 1.5, 1.2], layers(WAX, (lambda t: t.noise(4.0, 85) > 0.66, flesh(0.45, seed=86)))
    )
    leg = bodies.leg(
        s,
        [2.8, 2.7, 2.1, 2.1, 2.0, 1.9, 1.5],
        layers(WAX, (lambda t: t.z + 2.4 * t.noise(2.0, 87) > -14.4, canvas(0.46, "slate", 84))),
    )
    foot = bodies.boot(s, WAX, 7.2, 1.7, 3.0, 2.0, sides=6)
    shackle = torus(s.rest["hand_l"] + [0, 0, 1.2], (0, 0, 1), 1.6, 0.5, iron(0.38, 0.6), "lower_l", 8, 4, detail=0.6)
    fingers = [
        tube(
            [
                s.rest["hand_l"] + [0.2, y, -1.8],
                s.rest["hand_l"] + [0.7, y * 1.5, -3.4],
                s.rest["hand_l"] + [1.6, y * 1.5, -4.8],
            ],
            [0.5, 0.42, 0.2],
            WAX,
            "hand_l",
            4,
            caps=(None, 0.2),
            detail=0.5,
        )
        for y in (-0.9, 0.0, 0.9)
    ]
    palm = ellipsoid(s.rest["hand_l"] + [0.1, 0, -0.6], (0.9, 1.4, 1.9), WAX, "hand_l", 3, 6, detail=0.7)
    return [trunk] + both(arm, leg, foot, shackle, palm, *fingers)


def _throw(count: int, left: bool) -> Clip:
    """Tears a piece off and throws it."""
    hand = "hand_l" if left else "hand_r"
    s = 1.0 if left else -1.0
    tear = {hand: (0.4, -0.25 * s, -0.3), "chest": (16, 14 * s, 0), "head": (18, 0, 0)}
    back = {hand: (-0.3, 0.6 * s, 0.62), "chest": (-16, 30 * s, 0), "head": (-8, -20 * s, 0), "root": (-0.08, 0, -0.05)}
    out = {
        hand: (0.92, -0.1 * s, 0.05),
        "chest": (24, -26 * s, 0),
        "head": (-8, 18 * s, 0),
        "root": (0.1, 0, -0.12),
        "foot_l" if left else "foot_r": (0.24, 0.08 * s, 0),
    }
    return moves.acted(count, ARMS, {0.25: tear, 0.5: back, 0.68: out, 0.82: out})


def _fall_and_rise(count: int) -> Clip:
    """Knocked flat, lies, and gets up again."""
    down, up = moves.fall_back(BODY, 11, ARMS, 3.6), moves.fall_back(BODY, count - 11 - 6, ARMS, 3.6)
    return {
        name: np.concatenate([values, np.repeat(values[-1:], 6, axis=0), up[name][::-1]])
        for name, values in down.items()
    }


def _clips() -> dict:
    n = lengths("zombie")
    reach = {**ARMS, "hand_r": (0.78, -0.12, -0.2), "hand_l": (0.82, 0.1, -0.1)}
    crucified = {
        **ARMS,
        "hand_l": (-0.05, 0.97, 0.16),
        "hand_r": (-0.05, -0.97, 0.16),
        "foot_l": (0, -0.12, 0.0),
        "foot_r": (0.04, 0.12, 0.0),
        "toe_l": (40, 0),
        "toe_r": (40, 0),
    }
    sag = {"chest": (8, 2, 3), "head": (32, 14, 6)}
    walk = dict(lift=0.05, stance=0.64, drop=0.1, bob=0.02, lean=12, twist=12, sway_side=0.08)
    return {
        "stand": moves.stand(n["stand"], ARMS, 0.06, 1.6, 12),
        "walk": moves.gait(BODY, PACES["zombie"]["walk"], ARMS, **walk),
        "run": moves.gait(BODY, PACES["zombie"]["run"], reach, cycles=2, **{**walk, "lean": 20}),
        "atta": _throw(n["atta"], False),
        "attb": _throw(n["attb"], True),
        "attc": _throw(n["attc"], False),
        "paina": moves.hit(n["paina"], ARMS, (-24, 30, 8), (-26, 20, 10), 0.1, 0.12),
        "painb": merge(
            moves.hit(
                n["painb"],
                ARMS,
                (30, -20, 0),
                (26, 0, 0),
                -0.04,
                0.36,
                {"hand_l": (0.5, 0.1, -0.8), "hand_r": (0.5, -0.1, -0.8)},
            )
        ),
        "painc": moves.hit(n["painc"], ARMS, (-20, -44, -10), (-20, -30, 0), 0.14, 0.16),
        "paind": moves.hit(
            n["paind"],
            ARMS,
            (-30, 10, 0),
            (-30, 0, 0),
            0.16,
            0.14,
            {"hand_l": (0.4, 0.8, 0.3), "hand_r": (0.4, -0.8, 0.3)},
        ),
        "paine": _fall_and_rise(n["paine"]),
        "cruc_": moves.acted(
            n["cruc_"],
            crucified,
            {0.0: {**crucified, **sag}, 0.5: {"head": (26, -10, -4), "chest": (5, -3, -3)}, 1.0: {**crucified, **sag}},
            0.0,
        ),
    }


def zombie() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + head(s.rest["head"] + np.array([1.2, 0, 3.6]))
    return humanoid_model(
        "zombie",
        BODY,
        s,
        patches,
        _clips(),
        ARMS,
        posture={"chest": (12, 0, 0), "belly": (5, 0, 0), "head": (-12, 0, 4)},
        skin=(256, 216),
    )


MODELS = {"zombie": zombie, "h_zombie": lambda: severed(head((0, 0, 4.0), "root"), 2.2)}
