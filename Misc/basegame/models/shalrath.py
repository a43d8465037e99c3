"""The vore: a diving bell that something with three legs has put on. Its maw glows where the window was."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.beast import add_leg, reach
from models.kit.bodies import spike
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, keyed
from models.kit.paint import band, bone, copper, flesh, glow, iron, layers, plain, rivets
from models.kit.shapes import Patch, both, disc, ellipsoid, lathe, new_sheet, torus, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.steps import foot
from models.kit.turn import apply, euler, limb
from models.paces import PACES
from models.soldier import severed

UPPER, LOWER = 24.0, 31.0
HEIGHT = 12.0  # of the hips
LEGS = {"leg_a": 38.0, "leg_b": -38.0, "leg_c": 180.0}  # name -> direction in degrees
REACH = 26.0  # of the feet from the middle
ARM = 15.0  # upper and lower arm
REST = {
    "body": (0, 0, 0),
    "tilt": (0, 0, 0),
    "jaw": (0,),
    "hand_l": (16, 9, -4),
    "hand_r": (16, -9, -4),
    "loose": (0,),
    "orb": (0,),
    **{leg: (0, 0, 0) for leg in LEGS},
}
FLESH = flesh(0.6, "coral", 161, 0.5)
BELL = copper(0.7, 6.0, 162)


def _out(leg: str) -> np.ndarray:
    a = np.radians(LEGS[leg])
    return np.array([np.cos(a), np.sin(a), 0.0])


def _skeleton() -> Skeleton:
    s = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "body": ("root", (0, 0, HEIGHT)),
            "head": ("body", (2, 0, HEIGHT + 22)),
            "jaw": ("head", (6, 0, HEIGHT + 20)),
            "orb": ("body", (0, 0, HEIGHT + 30)),
        }
    )
    for leg in LEGS:
        add_leg(s, leg, "body", _out(leg) * 7.0 + [0, 0, HEIGHT], UPPER, LOWER)
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        at = np.array([1.0, sign * 9.5, HEIGHT + 17])
        s.add("upper" + side, "body", at)
        s.add("lower" + side, "upper" + side, at - [0, 0, ARM])
        s.add("hand" + side, "lower" + side, at - [0, 0, 2 * ARM])
    return s


def _pose(s: Skeleton, c: Clip) -> Posing:
    p = Posing(s, len(c["body"]))
    p.place("body", euler(c["tilt"]), s.rest["body"] + c["body"])
    p.turn("head", c["tilt"] * [-0.6, -0.4, -0.5])
    p.turn("jaw", np.concatenate([c["jaw"], np.zeros((p.frames, 2))], axis=1))
    loose = c["loose"][:, 0]
    turn, at = p.of("body")
    for leg in LEGS:
        foot = _out(leg) * REACH + [0, 0, -24.0 + 1.0] + c[leg]
        own = at + apply(turn, foot - s.rest["body"])
        pole = _out(leg) + [0, 0, 1.6]
        reach(p, leg, "body", foot + (own - foot) * loose[:, None], pole, UPPER, LOWER, np.zeros(p.frames), loose)
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        start = at + apply(turn, s.rest["upper" + side] - s.rest["body"])
        target = start + apply(turn, c["hand" + side])
        upper, lower, elbow, hand = limb(start, target, apply(turn, (-0.3, sign * 1.0, -0.6)), ARM, ARM, (-1, 0, 0))
        p.place("upper" + side, upper, start)
        p.place("lower" + side, lower, elbow)
        p.place("hand" + side, lower, hand)
    left, right = p.of("hand_l")[1], p.of("hand_r")[1]
    p.place("orb", np.eye(3) * np.clip(c["orb"], 0.02, 2.0)[:, :, None], (left + right) / 2 + [0, 0, 4.0])
    return p


def head(at, bone_name: str = "head", jaw: str = "jaw") -> list[Patch]:
    x, y, z = at
    dome = lathe(
        [(-5, 7.0), (-4, 8.2), (0, 8.6), (4.5, 7.6), (8.0, 4.6)],
        layers(BELL, (band("v", 0.0, 0.12), copper(0.1)), (rivets(14, 7, 0.18), copper(0.05))),
        bone_name,
        at,
        sides=11,
        caps=(0, 1.2),
    )
    rim = torus((x + 7.0, y, z - 0.4), (1, 0, 0.1), 4.6, (0.9, 1.2), copper(0.15), bone_name, 12, 5)
    maw = lathe(
        [(-0.8, 4.6), (0.2, 3.3), (0.4, 1.4)],
        layers(plain("red", 0.4, 0.12, 2.0, gloss=0.68), (band("v", 0.42, 1.1), glow("fire", 0.6, 0.4))),
        bone_name,
        (x + 8.3, y, z - 0.4),
        (1, 0, 0.1),
        10,
        caps=(None, 0.1),
    )
    eyes = [
        ellipsoid((x + 4.2, y + dy, z + 6.0), (1.2, 1.2, 1.2), glow("gold_glow", 0.8, 0.3), bone_name, 3, 6, detail=0.6)
        for dy in (-3.6, 0.0, 3.6)
    ]
    feelers = [
        tube(
            [(x + 7.2, y + dy, z - 5.0), (x + 9.6, y + dy * 1.2, z - 8.0), (x + 8.2, y + dy * 1.4, z - 13.0)],
            [1.4, 1.1, 0.3],
            FLESH,
            jaw,
            5,
            caps=(0, 0.4),
            detail=0.7,
        )
        for dy in (-3.4, -1.1, 1.1, 3.4)
    ]
    teeth = [
        spike(
            (x + 8.2, y + np.cos(a) * 4.2, z - 0.4 + np.sin(a) * 4.2),
            (x + 9.4, y + np.cos(a) * 1.6, z - 0.4 + np.sin(a) * 1.6),
            0.6,
            bone(0.86),
            bone_name,
            4,
            detail=0.4,
        )
        for a in np.radians([18, 90, 162, 234, 306])
    ]
    return [dome, rim, disc(maw), *eyes, *feelers, *teeth]


def _body(s: Skeleton) -> list[Patch]:
    z = HEIGHT
    trunk = tube(
        [(0, 0, z - 8), (0, 0, z - 3), (0, 0, z + 4), (0.5, 0, z + 11), (1.5, 0, z + 17), (2, 0, z + 20)],
        [(5.0, 5.0), (9.0, 9.6), (9.4, 10.0), (6.6, 7.2), (7.6, 9.0), (5.6, 6.4)],
        layers(
            FLESH,
            (lambda t: (t.z < z + 11) & (t.x > 2) & ((t.z % 3.0) < 1.3), flesh(0.78, "coral", 163, 0.1)),
            (band("z", z + 12.5, z + 15.0), layers(iron(0.4, 0.4), (rivets(12, 10, 0.25), copper(0.1)))),
        ),
        ["body"] * 5 + [{"body": 0.5, "head": 0.5}],
        11,
    )
    out, sheet = [trunk], new_sheet()
    for leg in LEGS:
        a, b, c = (s.rest[f"{leg}_{part}"] for part in ("upper", "lower", "foot"))
        up, low = f"{leg}_upper", f"{leg}_lower"
        patch = tube(
            [a + [0, 0, 2], a * 0.6 + b * 0.4, a * 0.08 + b * 0.92, b * 0.9 + c * 0.1, b * 0.5 + c * 0.5, c],
            [5.2, 4.4, 3.2, 3.4, 2.2, 0.7],
            layers(
                FLESH,
                (
                    band("v", 0.44, 1.1),
                    layers(iron(0.42, 0.3), (band("v", 0.44, 0.5), copper(0.2)), (band("v", 0.93, 1.1), bone(0.8))),
                ),
            ),
            [{"body": 0.5, up: 0.5}, up, {up: 0.7, low: 0.3}, {up: 0.3, low: 0.7}, low, low],
            8,
            up=_out(leg),
            caps=(2.0, 0.8),
        )
        patch.sheet = sheet
        thorn = spike(b + _out(leg) * 2.0, b + _out(leg) * 7.0 + [0, 0, 3.0], 1.5, bone(0.82), low, 5)
        out += [patch, thorn]
    arm = tube(
        [
            s.rest["upper_l"] + [0, -1.5, 1],
            s.rest["upper_l"] * 0.5 + s.rest["lower_l"] * 0.5,
            s.rest["lower_l"],
            s.rest["lower_l"] * 0.4 + s.rest["hand_l"] * 0.6,
            s.rest["hand_l"],
        ],
        [3.0, 2.5, 2.2, 2.0, 1.5],
        FLESH,
        [{"body": 0.5, "upper_l": 0.5}, "upper_l", {"upper_l": 0.5, "lower_l": 0.5}, "lower_l", "hand_l"],
        7,
        caps=(1.0, None),
    )
    hand = s.rest["hand_l"]
    claws = [
        spike(hand + [0.4, y, 0.5], hand + [2.2, y * 2.6, -6.5], 0.9, bone(0.82), "hand_l", 4, (1.0, y * 0.5, 0))
        for y in (-1.0, 0.0, 1.0)
    ]
    orb = ellipsoid(
        s.rest["orb"],
        (4.5, 4.5, 4.5),
        layers(glow("red_glow", 0.5, 0.5, 3.0), (lambda t: t.noise(3.0, 164, 2) > 0.62, plain("mauve", 0.25))),
        "orb",
        5,
        8,
    )
    return out + both(arm, *claws) + [orb]


def _clips() -> dict[str, Clip]:
    n = lengths("shalrath")
    up = {"hand_l": (10, 2, 24), "hand_r": (10, -2, 24), "tilt": (-14, 0, 0), "body": (-3, 0, 3), "jaw": -20}
    a = n["attack"]
    attack = keyed(
        a,
        {
            0: REST,
            a * 0.25: {**up, "orb": 0.4},
            a * 0.5: {**up, "orb": 0.9, "tilt": (-18, 0, 0)},
            a * 0.72: {**up, "orb": 1.0, "tilt": (-20, 0, 0), "body": (-5, 0, 4)},
            a
            * 0.82: {
                "hand_l": (27, 2, 2),
                "hand_r": (27, -2, 2),
                "tilt": (20, 0, 0),
                "body": (6, 0, -2),
                "orb": 1.0,
                "jaw": 10,
            },
            a - 1: {"orb": 0.0, "hand_l": (24, 5, -2), "hand_r": (24, -5, -2), "tilt": (12, 0, 0)},
        },
    )
    k, d, w = n["pain"], n["death"], n["walk"]
    pain = keyed(
        k,
        {
            0: {"tilt": (-14, 14, 10), "body": (-4, 0, -2), "hand_l": (6, 22, 8)},
            1: {"tilt": (-24, 22, 16), "body": (-7, 0, -4), "hand_l": (2, 24, 12), "hand_r": (4, -22, 10), "jaw": -24},
            k - 1: REST,
        },
    )
    death = keyed(
        d,
        {
            0: {"tilt": (-12, 0, 8), "body": (0, 0, 2), "hand_l": (4, 20, 14), "hand_r": (4, -20, 14)},
            d * 0.35: {"tilt": (-26, 10, -10), "body": (-4, 0, -6), "leg_a": (10, 6, 0), "leg_b": (10, -6, 0)},
            d
            * 0.7: {
                "tilt": (20, 20, 24),
                "body": (2, 4, -22),
                "leg_a": (18, 12, 0),
                "leg_b": (16, -14, 2),
                "leg_c": (-16, 0, 0),
                "hand_l": (10, 24, -8),
                "hand_r": (16, -20, -10),
            },
            d
            - 1: {
                "tilt": (52, 24, 40),
                "body": (4, 6, -27),
                "leg_a": (20, 14, 0),
                "leg_b": (18, -16, 6),
                "leg_c": (-18, 4, 3),
                "hand_l": (16, 22, -10),
                "hand_r": (20, -16, -14),
                "jaw": 20,
            },
        },
    )
    phase = cycle(w)
    walk: Clip = {}
    for leg, offset in zip(LEGS, (0.0, 1 / 3, 2 / 3)):
        f = foot(PACES["shalrath"]["walk"], 0.66, offset)
        walk[leg] = np.stack([f.x, np.zeros(w), np.where(f.down, 0.0, 10 * np.sin(np.pi * f.part))], axis=1)
    wave = lambda m, o=0.0: np.sin(2 * np.pi * (m * phase + o))
    walk["body"] = np.stack([np.zeros(w), 2.0 * wave(1), 1.6 * wave(3)], axis=1)
    walk["tilt"] = np.stack([3 + 2 * wave(3, 0.2), 3 * wave(1, 0.2), 4 * wave(1)], axis=1)
    walk["hand_l"] = np.array([16.0, 9, -4]) + np.stack([3 * wave(1), 0 * phase, 3 * wave(1, 0.3)], axis=1)
    walk["hand_r"] = np.array([16.0, -9, -4]) + np.stack([3 * wave(1, 0.5), 0 * phase, 3 * wave(1, 0.8)], axis=1)
    return {"attack": attack, "pain": pain, "death": death, "walk": walk}


def shalrath() -> Mdl:
    s = _skeleton()
    patches = _body(s) + head((3.0, 0, HEIGHT + 27))
    return build(
        patches,
        _pose(s, joined(REST, sequence_clips("shalrath", _clips()))),
        frame_names("shalrath"),
        skin=(256, 216),
        floor=-23.9,
    )


MODELS = {"shalrath": shalrath, "h_shal": lambda: severed(head((0, 0, 13.0), "root", "root"), 5.0, at=(0, 0, 6.0))}
