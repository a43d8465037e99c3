"""The shambler: a mountain of white wax with no eyes, a mouth of tusks, and lightning in its claws."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import merge
from models.kit.paint import band, bone, glow, layers, plain, wax
from models.kit.shapes import Patch, both, ellipsoid, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.Build(
    thigh=15.5,
    shin=15.5,
    ankle=4.5,
    hip_width=8.6,
    crouch=0.9,
    belly=8.0,
    chest=20.0,
    shoulder=(0.5, 14.6, 9.0),
    neck=12.0,
    neck_forward=6.0,
    upper=20.0,
    lower=20.0,
    toe=13.5,
    heel=5.8,
)
ARMS = {"hand_r": (0.34, -0.2, -0.74), "hand_l": (0.34, 0.2, -0.74), "hold": 0, "elbow_r": 40, "elbow_l": 40}
POSTURE = {"hips": (10, 0, 0), "belly": (10, 0, 0), "chest": (8, 0, 0), "head": (-20, 0, 0)}
HIDE = layers(wax(0.9, 111), (lambda s: (s.noise(3.0, 112, 2) > 0.62) & ((s.z * 0.5) % 1.0 < 0.5), wax(0.82, 113)))
CLAW = plain("slate", 0.3, 0.1, 2.0, gloss=0.6)


def head(at, bone_name: str = "head") -> list[Patch]:
    x, y, z = at
    jaw_bone = "jaw" if bone_name == "head" else bone_name
    maw = plain("red", 0.42, 0.14, 2.0, gloss=0.68)
    dome = tube(
        [
            (x - 6.0, y, z + 2.2),
            (x - 2.5, y, z + 3.0),
            (x + 2.5, y, z + 2.6),
            (x + 6.5, y, z + 1.2),
            (x + 8.8, y, z + 0.2),
        ],
        [(3.6, 4.6), (5.6, 7.0), (5.2, 7.2), (3.4, 5.8), (1.7, 3.6)],
        layers(
            HIDE,
            (lambda s: (s.z < z - 0.6) & (s.x > x - 1), maw),
            (lambda s: (np.abs(s.y) < 0.45) & (s.z > z + 2), wax(0.62, 114)),
        ),
        bone_name,
        10,
        up=(0, 0, 1),
        caps=(1.0, 0.5),
    )
    jaw = tube(
        [(x - 3.0, y, z - 3.6), (x + 2.0, y, z - 5.4), (x + 6.4, y, z - 5.6), (x + 8.4, y, z - 5.0)],
        [(3.0, 5.6), (2.6, 6.4), (1.9, 5.4), (1.0, 3.0)],
        layers(
            HIDE,
            (lambda s: s.z > z - 4.4, maw),
            (lambda s: s.near((x + 2.0, y, z - 3.4), 2.6), glow("blue_glow", 0.35, 0.5)),
        ),
        jaw_bone,
        9,
        up=(0, 0, 1),
        caps=(0.6, 0.5),
    )
    upper = [
        bodies.spike(
            (x + dx, y + dy, z - 0.3),
            (x + dx + 0.5, y + dy * 0.98, z - 4.0),
            0.85,
            bone(0.86),
            bone_name,
            4,
            detail=0.4,
        )
        for dx, dy in ((8.0, 1.5), (6.2, 4.2), (3.2, 6.0))
    ]
    lower = [
        bodies.spike(
            (x + dx, y + dy, z - 4.6),
            (x + dx + 0.9, y + dy * 1.06, z - 0.6 + tall),
            1.05,
            bone(0.84),
            jaw_bone,
            5,
            detail=0.4,
        )
        for dx, dy, tall in ((7.6, 2.6, 1.2), (5.0, 5.2, 0.0))
    ]
    return [dome, jaw] + both(*upper, *lower)


def _body(s: Skeleton) -> list[Patch]:
    hip = s.rest["hips"][2]
    blood = lambda t: (t.x > 3) & (t.noise(6.0, 115, 3) > 0.6) & (t.z > hip + 12)
    trunk = bodies.trunk(
        s,
        [
            (-5.0, 0, 5.0, 6.6),
            (1.0, 0.2, 8.4, 11.4),
            (8.0, 0.4, 8.8, 11.0),
            (16.0, 0.6, 10.6, 14.0),
            (24.0, 0.8, 11.4, 17.2),
            (30.0, 1.6, 9.0, 15.4),
            (34.0, 4.0, 5.4, 8.4),
        ],
        layers(HIDE, (blood, wax(0.6, 116))),
        12,
    )
    arm = bodies.arm(
        s, [6.6, 7.0, 4.8, 4.5, 5.4, 5.2, 4.0], layers(HIDE, (band("v", 0.9, 1.1), plain("red", 0.42, 0.14, gloss=0.68))), 7
    )
    leg = bodies.leg(s, [8.2, 8.6, 6.4, 5.8, 5.6, 6.0, 5.0], HIDE, 7)
    tail = tube(
        [(-7.0, 0, hip + 1.0), (-13.0, 0, hip - 8.0), (-19.0, 0, hip - 15.0), (-25.0, 0, hip - 17.0)],
        [4.4, 3.2, 2.0, 0.6],
        HIDE,
        "hips",
        7,
        up=(0, 1, 0),
        caps=(0, 1.0),
        detail=0.8,
    )
    wrist = s.rest["hand_l"]
    palm = ellipsoid(
        wrist + [0.5, 0, -3.0],
        (3.8, 3.2, 5.0),
        layers(HIDE, (lambda t: t.z < wrist[2] - 2.0, plain("red", 0.4, 0.12, gloss=0.68))),
        "hand_l",
        4,
        8,
    )
    claws = [
        bodies.spike(wrist + [2.0, y, -6.0], wrist + [6.4, y * 1.7, -15.5], 1.5, CLAW, "hand_l", 4, (2.2, 0, 0.0), 0.6)
        for y in (-2.4, 0.0, 2.4)
    ] + [
        bodies.spike(wrist + [-0.5, -3.0, -3.0], wrist + [2.6, -6.2, -9.0], 1.3, CLAW, "hand_l", 4, (0.6, -1.0, 0), 0.6)
    ]
    foot = bodies.boot(s, HIDE, 17.0, 5.6, 8.0, 6.0, sides=7)
    toes = [
        bodies.spike(
            s.rest["foot_l"] + [9.4, y, -2.6],
            s.rest["foot_l"] + [14.5, y * 1.2, -4.4],
            1.5,
            CLAW,
            "foot_l",
            4,
            (0.5, 0, 0.9),
            0.5,
        )
        for y in (-3.0, 0.6, 4.0)
    ]
    return [trunk, tail] + both(arm, leg, palm, *claws, foot, *toes)


def _clips() -> dict:
    n = lengths("shambler")
    both_up = {
        "hand_l": (0.3, 0.25, 0.8),
        "hand_r": (0.3, -0.25, 0.8),
        "chest": (-16, 0, 0),
        "head": (-6, 0, 0),
        "root": (-0.05, 0, 0.03),
        "jaw": 30,
    }
    both_down = {
        "hand_l": (0.75, 0.05, -0.55),
        "hand_r": (0.75, -0.05, -0.55),
        "chest": (30, 0, 0),
        "head": (-14, 0, 0),
        "root": (0.12, 0, -0.2),
        "jaw": 6,
    }
    swing = lambda s: (
        {
            "hand_l" if s > 0 else "hand_r": (0.1, 0.8 * s, 0.5),
            "chest": (-6, 40 * s, 0),
            "head": (0, -26 * s, 0),
            "jaw": 24,
        },
        {
            "hand_l" if s > 0 else "hand_r": (0.72, -0.55 * s, -0.35),
            "chest": (16, -40 * s, 0),
            "head": (-6, 24 * s, 0),
            "root": (0.12, 0, -0.12),
            "jaw": 8,
        },
    )
    gather = {
        "hand_l": (0.5, 0.05, 0.55),
        "hand_r": (0.5, -0.05, 0.55),
        "elbow_l": 70,
        "elbow_r": 70,
        "chest": (-14, 0, 0),
        "head": (-12, 0, 0),
        "root": (-0.04, 0, -0.05),
        "jaw": 34,
    }
    tremble = {**gather, "hand_l": (0.46, 0.2, 0.6), "hand_r": (0.46, -0.2, 0.6), "chest": (-17, 4, 0)}
    cast = {
        "hand_l": (0.92, 0.12, -0.02),
        "hand_r": (0.92, -0.12, -0.02),
        "chest": (20, 0, 0),
        "head": (-16, 0, 0),
        "root": (0.12, 0, -0.12),
        "jaw": 36,
    }
    right, left = swing(-1.0), swing(1.0)
    return {
        "stand": moves.stand(n["stand"], ARMS, 0.02, 2.2, 14),
        "walk": moves.gait(
            BODY, PACES["shambler"]["walk"], ARMS, lift=0.14, stance=0.42, drop=0.1, sway_side=0.08, swing=0.14, lean=5, twist=10
        ),
        "run": moves.gait(
            BODY, PACES["shambler"]["run"], ARMS, lift=0.22, stance=0.255, offset=-1.5 / 6, drop=0.1, sway_side=0.06, swing=0.3, lean=14, twist=12
        ),
        "smash": moves.acted(n["smash"], ARMS, {0.25: both_up, 0.46: both_up, 0.58: both_down, 0.76: both_down}, 0.02),
        "swingr": moves.acted(n["swingr"], ARMS, {0.3: right[0], 0.42: right[0], 0.6: right[1], 0.75: right[1]}, 0.02),
        "swingl": moves.acted(n["swingl"], ARMS, {0.3: left[0], 0.42: left[0], 0.6: left[1], 0.75: left[1]}, 0.02),
        "magic": moves.acted(
            n["magic"], ARMS, {0.22: gather, 0.3: tremble, 0.38: gather, 0.46: tremble, 0.58: cast, 0.84: cast}, 0.02
        ),
        "pain": moves.hit(n["pain"], ARMS, (-18, 24, 6), (-14, 16, 0)),
        "death": merge(
            moves.fall_front(BODY, n["death"], ARMS, 12.0), {"jaw": np.linspace(30, 6, n["death"])[:, None]}
        ),
    }


def shambler() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + head(s.rest["head"] + np.array([3.0, 0, 1.0]))
    return humanoid_model("shambler", BODY, s, patches, _clips(), ARMS, posture=POSTURE, skin=(256, 256))


MODELS = {"shambler": shambler, "h_shams": lambda: severed(head((-2, 0, 8.0), "root"), 5.0)}
