"""The boss: the works' first founder, slag and iron to the waist in his own melt. He has no legs; lava hides it."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import Clip, keyed, merge, sway
from models.kit.paint import band, both_of, copper, glow, iron, layers, magma, rivets
from models.kit.shapes import Patch, both, disc, ellipsoid, lathe, tube
from models.kit.skeleton import Skeleton

BODY = humanoid.Build(
    thigh=30,
    shin=30,
    ankle=0,
    hip_width=10,
    crouch=0.99,
    belly=22,
    chest=62,
    shoulder=(-2.0, 62.0, 46.0),
    neck=62,
    neck_forward=16,
    upper=72,
    lower=72,
)
ARMS = {"hand_r": (0.45, -0.25, -0.62), "hand_l": (0.45, 0.25, -0.62), "hold": 0, "elbow_r": 50, "elbow_l": 50}
CRUST = magma(0.3, 34.0, 171, "slate", 0.3)
HOT = magma(0.7, 26.0, 172, "slate", 0.26)


def _head(at) -> list[Patch]:
    x, y, z = at
    eyes = lambda s: (np.abs(s.z - z - 6 + 0.25 * np.abs(s.y)) < 3.4) & (np.abs(np.abs(s.y) - 10) < 5.6) & (s.x > x + 6)
    skull = lathe(
        [(-24, 18), (-14, 24), (2, 25), (16, 24), (24, 27), (28, 26)],
        layers(
            CRUST,
            (eyes, glow("fire", 0.9, 0.15, 8.0)),
            (band("v", 0.8, 1.1), layers(iron(0.36, 0.4, 16.0), (rivets(16, 16, 0.22), copper(0.2, 10.0)))),
        ),
        "head",
        at,
        sides=13,
        caps=(2, None),
        squash=0.92,
    )
    melt = lathe(
        [(-2, 24.5), (0.5, 20), (1.0, 8)],
        glow("fire", 0.75, 0.4, 12.0),
        "head",
        (x, y, z + 26),
        sides=12,
        caps=(None, 0),
        squash=0.92,
    )
    jaw = tube(
        [(x - 2, y, z - 20), (x + 14, y, z - 25), (x + 28, y, z - 24)],
        [(9, 20), (9, 19), (6, 12)],
        layers(CRUST, (lambda s: s.z > z - 17, glow("fire", 0.6, 0.4, 8.0))),
        "jaw",
        9,
        up=(0, 0, 1),
        caps=(2, 3),
    )
    teeth = [
        bodies.spike((x + dx, y + dy, z - 19), (x + dx + 1, y + dy, z - 4), 3.0, iron(0.3, 0.4, 8.0), "jaw", 5)
        for dx, dy in ((27, 5), (22, 14))
    ]
    horn = bodies.spike(
        (x - 4, y + 22, z + 20),
        (x - 14, y + 44, z + 54),
        8.0,
        layers(iron(0.34, 0.5, 12.0), (band("v", 0.86, 1.1), glow("fire", 0.4, 0.3, 6.0))),
        "head",
        7,
        (4, 12, -6),
        0.8,
    )
    return [skull, disc(melt), jaw] + both(horn, *teeth)


def _body(s: Skeleton) -> list[Patch]:
    hip = s.rest["hips"][2]
    furnace = (
        lambda t: (t.x > 10)
        & (np.abs(t.y) < 26)
        & (t.z > hip + 48)
        & (t.z < hip + 96)
        & (np.abs((t.y + 100) % 11 - 5.5) < 3.2)
    )
    frame = lambda t: (t.x > 10) & (np.abs(t.y) < 33) & (t.z > hip + 41) & (t.z < hip + 103)
    trunk = bodies.trunk(
        s,
        [
            (-76, 0, 58, 74),
            (-36, 0, 52, 68),
            (-2, 0, 40, 50),
            (26, 2, 36, 46),
            (60, 6, 46, 62),
            (92, 4, 46, 70),
            (112, 0, 34, 58),
            (122, 10, 22, 30),
        ],
        layers(
            CRUST,
            (lambda t: t.z + 26 * t.noise(22.0, 173) < hip + 12, HOT),
            (frame, layers(iron(0.38, 0.4, 16.0), (rivets(16, 18, 0.2), copper(0.1, 8.0)))),
            (furnace, glow("fire", 0.6, 0.5, 14.0)),
        ),
        14,
    )
    arm = bodies.arm(
        s,
        [24, 26, 18, 18, 22, 22, 16],
        layers(
            CRUST,
            (band("v", 0.8, 0.92), layers(iron(0.38, 0.4, 14.0), (rivets(10, 20, 0.2), copper(0.1, 6.0)))),
            (band("v", 0.92, 1.1), HOT),
        ),
        9,
    )
    pad = lathe(
        [(-14, 30), (-8, 31), (8, 24), (18, 12)],
        layers(
            iron(0.38, 0.4, 16.0),
            (band("v", 0, 0.24), copper(0.4, 10.0)),
            (both_of(rivets(12, 5, 0.24), band("v", 0, 0.24)), iron(0.6, 0)),
        ),
        {"upper_l": 0.5, "chest": 0.5},
        s.rest["upper_l"] + [0, 4, 6],
        (0, 0.4, 1),
        10,
        caps=(None, 2),
    )
    stack = lathe(
        [(0, 9), (22, 8), (24, 10), (30, 10), (30, 7), (24, 6)],
        layers(iron(0.36, 0.5, 12.0), (band("v", 0.76, 1.2), glow("fire", 0.5, 0.4, 6.0))),
        "chest",
        s.rest["upper_l"] + [-20, -14, 16],
        (-0.2, 0.15, 1),
        8,
        caps=(None, 0),
    )
    wrist = s.rest["hand_l"]
    palm = ellipsoid(wrist + [2, 0, -12], (14, 12, 20), HOT, "hand_l", 4, 8)
    fingers = [
        bodies.spike(
            wrist + [8, y, -24],
            wrist + [22, y * 1.5, -52],
            6.0,
            layers(CRUST, (band("v", 0.7, 1.1), iron(0.3, 0.4, 8.0))),
            "hand_l",
            6,
            (8, 0, 0),
            0.8,
        )
        for y in (-9, 0, 9)
    ]
    thumb = bodies.spike(wrist + [-2, -11, -8], wrist + [10, -24, -28], 5.5, CRUST, "hand_l", 6, (2, -4, 0), 0.8)
    return [trunk] + both(arm, pad, stack, palm, thumb, *fingers)


def _throw(side: float) -> tuple[dict, dict]:
    hand, other = ("hand_l", "hand_r") if side > 0 else ("hand_r", "hand_l")
    back = {
        hand: (-0.15, 0.45 * side, 0.75),
        other: (0.6, -0.35 * side, -0.3),
        "chest": (-10, 26 * side, 0),
        "belly": (-6, 8 * side, 0),
        "head": (6, -24 * side, 0),
        "jaw": 20,
    }
    out = {
        hand: (0.95, 0.0, 0.0),
        other: (0.1, -0.55 * side, -0.55),
        "chest": (20, -28 * side, 0),
        "belly": (10, -8 * side, 0),
        "head": (-12, 26 * side, 0),
        "jaw": 30,
    }
    return back, out


def _clips() -> dict[str, Clip]:
    n = lengths("boss")
    idle = {**ARMS, "root": (0, 0, 0), "chest": (4, 0, 0), "belly": (2, 0, 0), "head": (-4, 0, 0), "jaw": 4}
    r, w = n["rise"], n["walk"]
    rise = keyed(
        r,
        {
            0: {
                **idle,
                "root": (0, 0, -5.2),
                "hand_l": (0.1, 0.3, 0.9),
                "hand_r": (0.1, -0.3, 0.9),
                "chest": (10, 0, 0),
                "head": (10, 0, 0),
            },
            r * 0.35: {"root": (0, 0, -2.4), "hand_l": (0.3, 0.5, 0.75), "hand_r": (0.3, -0.5, 0.75)},
            r
            * 0.6: {
                "root": (0, 0, -0.2),
                "hand_l": (0.2, 0.85, 0.3),
                "hand_r": (0.2, -0.85, 0.3),
                "chest": (-16, 0, 0),
                "head": (-18, 0, 0),
                "jaw": 36,
            },
            r * 0.78: {"root": (0, 0, 0.1), "jaw": 40, "head": (-14, 0, 0)},
            r - 1: idle,
        },
    )
    walk = merge(
        moves.held(idle, w),
        {
            "chest": np.concatenate([sway(w, 4, 4, 0.2), sway(w, 0, 12), sway(w, 0, 4, 0.25)], axis=1),
            "belly": np.concatenate([sway(w, 2, 3), sway(w, 0, 6, 0.1), sway(w, 0, 4)], axis=1),
            "head": np.concatenate([sway(w, -4, 4, 0.3), sway(w, 0, 14, 0.85), sway(w, 0, 3)], axis=1),
            "hand_l": np.array(ARMS["hand_l"]) + sway(w, 0, 0.1, 0.1) * [1, 0.5, 1.2],
            "hand_r": np.array(ARMS["hand_r"]) + sway(w, 0, 0.1, 0.6) * [1, 0.5, 1.2],
            "jaw": sway(w, 8, 6),
            "root": np.concatenate([sway(w, 0, 0.08), sway(w, 0, 0.12, 0.2), sway(w, 0, 0.05, 0.1)], axis=1),
        },
    )
    d, a = n["death"], n["attack"]
    death = keyed(
        d,
        {
            0: idle,
            d
            * 0.3: {
                "chest": (-20, 10, 6),
                "head": (-26, 0, 10),
                "hand_l": (0.2, 0.6, 0.7),
                "hand_r": (0.2, -0.6, 0.7),
                "jaw": 44,
            },
            d * 0.6: {"root": (0, 0, -1.6), "chest": (-6, -10, -10)},
            d
            - 1: {"root": (0, 0, -5.2), "hand_l": (0.05, 0.2, 0.95), "hand_r": (0.05, -0.3, 0.9), "head": (-30, 0, 0)},
        },
    )
    (lb, lo), (rb, ro) = _throw(1.0), _throw(-1.0)
    attack = keyed(
        a,
        {
            0: idle,
            a * 0.2: lb,
            a * 0.32: lb,
            a * 0.4: lo,
            a * 0.5: {**idle},
            a * 0.66: rb,
            a * 0.78: rb,
            a * 0.86: ro,
            a: idle,
        },
    )
    rigid = {
        "hand_l": (0.3, 0.8, 0.35),
        "hand_r": (0.3, -0.8, 0.35),
        "chest": (-18, 0, 0),
        "head": (-22, 0, 0),
        "jaw": 40,
    }

    def shock(count: int, first: dict, last: dict) -> Clip:
        clip = keyed(count, {0: first, count * 0.2: rigid, count * 0.8: rigid, count - 1: last}, start=idle)
        shake = (
            np.where(np.arange(count) % 2, 1.0, -1.0)[:, None]
            * np.clip(np.sin(np.linspace(0.2, 2.9, count)), 0, 1)[:, None]
        )
        return clip | {
            "belly": np.concatenate([2 + 3 * shake, 5 * shake, 5 * shake], axis=1),
            "chest": clip["chest"] + shake * [3, 4, -5],
        }

    return {
        "rise": rise,
        "walk": walk,
        "death": death,
        "attack": attack,
        "shocka": shock(n["shocka"], idle, idle),
        "shockb": shock(n["shockb"], {**rigid}, {**rigid}),
        "shockc": shock(n["shockc"], idle, idle),
    }


def boss() -> Mdl:
    s = humanoid.bones(BODY)
    patches = _body(s) + _head(s.rest["head"] + np.array([6, 0, 18.0]))
    return humanoid_model("boss", BODY, s, patches, _clips(), ARMS, skin=(296, 256), floor=-400.0)


MODELS = {"boss": boss}
