"""The fiend: a beast of living coral, running on its toes, scythes of bone where its hands would be."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import merge
from models.kit.paint import band, bone, flesh, glow, layers, plain
from models.kit.shapes import Patch, both, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.Build(
    thigh=13.0,
    shin=13.0,
    ankle=8.0,
    hip_width=6.0,
    crouch=0.72,
    belly=5.0,
    chest=12.0,
    shoulder=(1.0, 11.0, 8.0),
    neck=10.0,
    neck_forward=4.0,
    upper=13.0,
    lower=13.0,
    feet=-4.0,
    toe=10.0,
    heel=-6.0,
)
ARMS = {"hand_r": (0.42, -0.3, -0.52), "hand_l": (0.42, 0.3, -0.52), "hold": 0, "elbow_r": 50, "elbow_l": 50}
POSTURE = {"hips": (16, 0, 0), "belly": (14, 0, 0), "chest": (14, 0, 0), "head": (-38, 0, 0)}
HIDE = flesh(0.56, "coral", 101, 0.5)
BONE = bone(0.84, 102)


def head(at, bone_name: str = "head") -> list[Patch]:
    x, y, z = at
    jaw_bone = "jaw" if bone_name == "head" else bone_name
    eyes = lambda s: s.near((x + 4.6, y + 3.1, z + 1.9), 1.2) | s.near((x + 4.6, y - 3.1, z + 1.9), 1.2)
    skull = tube(
        [
            (x - 4.5, y, z + 1.0),
            (x - 1.0, y, z + 1.0),
            (x + 3.6, y, z + 0.6),
            (x + 8.0, y, z - 0.6),
            (x + 11.0, y, z - 1.2),
        ],
        [(2.6, 3.0), (3.9, 4.8), (3.5, 4.4), (2.3, 3.1), (1.5, 2.2)],
        layers(
            HIDE, (eyes, glow("fire", 0.75, 0.3)), (lambda s: (s.z < z - 1.0) & (s.x > x + 3), plain("red", 0.4, 0.1, gloss=0.68))
        ),
        bone_name,
        9,
        up=(0, 0, 1),
        caps=(0.6, 0.5),
    )
    jaw = tube(
        [(x + 0.5, y, z - 2.6), (x + 5.0, y, z - 4.4), (x + 9.4, y, z - 4.6)],
        [(1.6, 3.4), (1.3, 3.0), (0.9, 1.8)],
        layers(HIDE, (lambda s: s.z > z - 3.8, plain("red", 0.45, 0.1, gloss=0.68))),
        jaw_bone,
        7,
        up=(0, 0, 1),
        caps=(0.3, 0.6),
    )
    horns = bodies.spike(
        (x - 1.5, y + 3.4, z + 3.2),
        (x - 2.0, y + 8.4, z + 9.5),
        1.5,
        layers(BONE, (band("v", 0.0, 0.2), HIDE)),
        bone_name,
        6,
        (1.0, 2.2, -1.6),
    )
    teeth = [
        bodies.spike((x + dx, y + dy, z - 1.8), (x + dx + 0.6, y + dy, z - 4.6), 0.55, BONE, bone_name, 4, detail=0.4)
        for dx, dy in ((9.8, 1.3), (7.2, 2.3), (4.6, 2.9))
    ]
    lower = bodies.spike((x + 8.6, y + 1.2, z - 4.2), (x + 9.6, y + 1.4, z - 1.4), 0.5, BONE, jaw_bone, 4, detail=0.4)
    return [skull, jaw] + both(horns, lower, *teeth)


def _body(s: Skeleton) -> list[Patch]:
    hip = s.rest["hips"][2]
    belly = lambda t: (t.x > 1.5) & (t.z < hip + 14) & (np.abs(t.y) < 4.5)
    trunk = bodies.trunk(
        s,
        [
            (-3.4, -0.6, 3.6, 4.4),
            (0.6, -0.2, 5.6, 7.2),
            (5.0, 0.4, 5.0, 6.0),
            (10.0, 0.8, 7.2, 8.4),
            (16.0, 1.2, 8.4, 10.8),
            (20.0, 1.8, 6.6, 9.4),
            (23.0, 3.6, 4.0, 5.0),
        ],
        layers(HIDE, (belly, flesh(0.74, "coral", 103, 0.2))),
        11,
    )
    ridge = [
        bodies.spike(
            (-6.4 + 0.12 * h, 0, hip + h),
            (-11.0 - 0.1 * h, 0, hip + h + 4.0),
            1.6,
            layers(BONE, (band("v", 0, 0.3), HIDE)),
            "chest" if h > 9 else "belly",
            5,
            (0, 0, -0.8),
        )
        for h in (5.0, 10.5, 15.5, 20.0)
    ]
    arm = bodies.arm(s, [3.9, 4.3, 3.0, 2.9, 3.2, 2.7, 2.2], HIDE, 7)
    leg = bodies.leg(s, [5.2, 5.6, 4.0, 3.5, 3.4, 2.9, 2.2], HIDE, 7)
    wrist = s.rest["hand_l"]
    scythe = tube(
        [
            wrist + [0, 0, 4.0],
            wrist + [0.6, 0.4, -1.0],
            wrist + [3.6, 0.8, -7.0],
            wrist + [9.0, 0.6, -12.5],
            wrist + [14.5, -0.4, -14.5],
        ],
        [(1.6, 1.6), (2.4, 1.5), (2.4, 1.0), (1.7, 0.6), (0.4, 0.2)],
        layers(BONE, (band("v", 0, 0.2), HIDE), (band("v", 0.86, 1.1), plain("red", 0.4, 0.1, gloss=0.68))),
        "hand_l",
        6,
        up=(0.8, 0, -0.6),
        caps=(0, 0.8),
    )
    claw = bodies.spike(wrist + [-0.6, -0.6, -1.0], wrist + [1.5, -2.2, -6.0], 1.0, BONE, "hand_l", 5, (1.0, -0.6, 0))
    ankle = s.rest["foot_l"]
    paw = tube(
        [ankle + [-1.2, 0, 1.0], ankle + [0.8, 0, -2.6], ankle + [3.8, 0.2, -6.0], ankle + [7.2, 0.3, -6.8]],
        [(1.7, 2.0), (1.9, 2.1), (1.8, 2.8), (1.1, 2.6)],
        HIDE,
        "foot_l",
        7,
        up=(0.7, 0, 0.7),
        caps=(0.3, 0.4),
    )
    toes = [
        bodies.spike(ankle + [6.6, y, -6.6], ankle + [10.4, y * 1.5, -7.8], 0.95, BONE, "foot_l", 5, (0.6, 0, 0.7), 0.4)
        for y in (-1.5, 0.4, 2.2)
    ]
    return [trunk, *ridge] + both(arm, leg, scythe, claw, paw, *toes)


def _clips() -> dict:
    n = lengths("demon")
    left_up = {
        "hand_l": (0.25, 0.55, 0.6),
        "chest": (-10, 30, 0),
        "hand_r": (0.4, -0.3, -0.5),
        "root": (-0.05, 0, 0.02),
        "jaw": 24,
    }
    left_down = {
        "hand_l": (0.85, -0.4, -0.3),
        "chest": (16, -30, 0),
        "root": (0.14, 0, -0.08),
        "hand_r": (0.2, -0.5, -0.1),
        "jaw": 4,
    }
    right_up = {
        "hand_r": (0.25, -0.55, 0.6),
        "chest": (-10, -30, 0),
        "hand_l": (0.4, 0.3, -0.5),
        "root": (-0.05, 0, 0.02),
        "jaw": 24,
    }
    right_down = {
        "hand_r": (0.85, 0.4, -0.3),
        "chest": (16, 30, 0),
        "root": (0.14, 0, -0.08),
        "hand_l": (0.2, 0.5, -0.1),
        "jaw": 4,
    }
    crouch = {
        "root": (-0.06, 0, -0.22),
        "hips": (18, 0, 0),
        "hand_l": (0.1, 0.5, -0.35),
        "hand_r": (0.1, -0.5, -0.35),
        "head": (-14, 0, 0),
        "jaw": 8,
    }
    spring = {
        "root": (0.2, 0, 0.16),
        "hips": (24, 0, 0),
        "chest": (-20, 0, 0),
        "foot_l": (-0.6, 0.1, 0.3),
        "foot_r": (-0.7, -0.1, 0.24),
        "toe_l": (60, 0),
        "toe_r": (60, 0),
        "hand_l": (0.5, 0.55, 0.55),
        "hand_r": (0.5, -0.55, 0.55),
        "jaw": 34,
    }
    fly = {
        **spring,
        "foot_l": (-0.3, 0.1, 0.4),
        "foot_r": (-0.45, -0.1, 0.36),
        "hand_l": (0.85, 0.3, 0.25),
        "hand_r": (0.85, -0.3, 0.25),
    }
    land = {
        "root": (0.05, 0, -0.26),
        "hips": (10, 0, 0),
        "hand_l": (0.75, 0.1, -0.4),
        "hand_r": (0.75, -0.1, -0.4),
        "foot_l": (0.15, 0.14, 0),
        "foot_r": (0.05, -0.14, 0),
        "jaw": 10,
    }
    run = dict(lift=0.34, stance=0.27, offset=0.55 / 6, drop=-0.02, bob=0.07, lean=16, twist=9, heel=0.5, swing=0.3)
    return {
        "stand": moves.stand(n["stand"], ARMS, 0.0, 2.0, 10),
        "walk": moves.gait(BODY, PACES["demon"]["walk"], ARMS, lift=0.2, drop=0.02, heel=0.5, swing=0.12, lean=4),
        "run": merge(moves.gait(BODY, PACES["demon"]["run"], ARMS, **run), {"jaw": np.full((n["run"], 1), 16.0)}),
        "leap": moves.acted(
            n["leap"], ARMS, {0.2: crouch, 0.34: crouch, 0.46: spring, 0.6: fly, 0.76: fly, 0.9: land}, 0.0
        ),
        "pain": moves.hit(n["pain"], ARMS, (-20, 26, 6), (-16, 20, 0)),
        "death": merge(moves.fall_side(BODY, n["death"], ARMS, 8.0), {"jaw": np.linspace(0, 26, n["death"])[:, None]}),
        "attacka": moves.acted(
            n["attacka"],
            ARMS,
            {
                0.18: left_up,
                0.28: left_up,
                0.4: left_down,
                0.5: left_down,
                0.66: right_up,
                0.72: right_up,
                0.84: right_down,
            },
            0.0,
        ),
    }


def demon() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + head(s.rest["head"] + np.array([2.0, 0, 1.5]))
    return humanoid_model("demon", BODY, s, patches, _clips(), ARMS, posture=POSTURE, skin=(256, 216))


MODELS = {"demon": demon, "h_demon": lambda: severed(head((-2, 0, 5.0), "root"), 3.4)}
