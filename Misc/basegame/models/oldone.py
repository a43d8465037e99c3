"""The old one: the reef beneath the monastery, awake.

A mound of coral with a maw, eyes that open anywhere, and arms.
"""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.beast import add_chain, chain_rings, wave
from models.kit.bodies import spike
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, sway
from models.kit.noise import fbm
from models.kit.paint import band, bone, flesh, glow, layers, plain
from models.kit.shapes import Patch, disc, ellipsoid, lathe, new_sheet, torus, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

REST = {"time": (0,), "shake": (0,), "jaw": (0,)}
CORAL = layers(
    flesh(0.55, "coral", 181, 0.4, size=9.0),
    (lambda s: s.noise(60.0, 182, 3) > 0.6, flesh(0.6, "verdigris", 183, 0.4, size=9.0)),
)
ARMS = [
    (40, 95, 30),
    (-40, 95, 30),
    (100, 100, 20),
    (-100, 100, 20),
    (155, 90, 50),
    (-155, 90, 50),
]  # direction, distance, height
LINKS, LINK = 5, 46.0


def _skeleton() -> Skeleton:
    s = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "low": ("root", (0, 0, -20)),
            "high": ("low", (0, 0, 90)),
            "top": ("high", (10, 0, 150)),
            "jaw": ("high", (70, 0, 70)),
        }
    )
    for i, (direction, distance, height) in enumerate(ARMS):
        a = np.radians(direction)
        out = np.array([np.cos(a), np.sin(a), 0.0])
        add_chain(
            s, f"arm{i}_", "low", [out * (distance + 18 * k) + [0, 0, height + LINK * 0.92 * k] for k in range(LINKS)]
        )
    return s


def _mound() -> Patch:
    rings = [
        (-24, 140, 150),
        (0, 132, 142),
        (40, 112, 120),
        (80, 96, 104),
        (120, 82, 86),
        (160, 62, 62),
        (190, 38, 38),
        (205, 16, 16),
    ]
    bones = [
        {"low": 1.0},
        {"low": 1.0},
        {"low": 0.8, "high": 0.2},
        {"low": 0.4, "high": 0.6},
        {"high": 1.0},
        {"high": 0.5, "top": 0.5},
        {"top": 1.0},
        {"top": 1.0},
    ]
    patch = tube(
        [(0.02 * z, 0, z) for z, _, _ in rings], [(x, y) for _, x, y in rings], CORAL, bones, 15, caps=(None, 6)
    )
    out = patch.grid * [1, 1, 0]
    length = np.maximum(np.linalg.norm(out, axis=-1, keepdims=True), 1e-6)
    lobes = np.sin(np.arctan2(patch.grid[..., 1], patch.grid[..., 0]) * 7)[..., None] * 6.0
    patch.grid = patch.grid + out / length * (
        (fbm(patch.grid + 900.0, 50.0, 2, 184) - 0.5)[..., None] * 30.0 + lobes
    ) * (length > 1.0)
    return patch


def _patches(s: Skeleton) -> list[Patch]:
    maw_at, facing = np.array([86.0, 0, 78.0]), (1.0, 0, 0.12)
    lips = torus(
        maw_at, facing, 40, (13, 15), layers(flesh(0.7, "coral", 185, 0.3, size=9.0)), "high", 14, 5, squash=1.2
    )
    throat = lathe(
        [(-8, 40), (4, 29), (7, 12)],
        layers(plain("red", 0.4, 0.14, 12.0, gloss=0.68), (band("v", 0.5, 1.1), glow("fire", 0.5, 0.5, 12.0))),
        "high",
        maw_at + [14, 0, 0],
        facing,
        12,
        caps=(None, 0),
        squash=1.2,
    )
    teeth = [
        spike(
            maw_at + [8, np.cos(a) * 44, np.sin(a) * 37],
            maw_at + [16, np.cos(a) * 20, np.sin(a) * 15],
            6.0,
            bone(0.85),
            "jaw" if np.sin(a) < 0 else "high",
            4,
        )
        for a in np.radians(np.arange(8) * 45.0 + 22.5)
    ]
    eyes = []
    for x, y, z, r in (
        (74, 40, 142, 11),
        (70, -46, 134, 9),
        (50, 4, 176, 14),
        (44, 82, 104, 8),
        (48, -86, 96, 10),
        (-66, -20, 140, 11),
    ):
        c = np.array([x, y, z], float)
        outward = c - [0, 0, z - 20]
        look = lambda t, c=c, r=r, o=outward / np.linalg.norm(outward): ((t.position - c) @ o > 0.55 * r)
        slit = lambda t, c=c, r=r, o=outward / np.linalg.norm(outward): ((t.position - c) @ o > 0.6 * r) & (
            np.abs((t.position - c) @ np.cross(o, (0, 0, 1.0))) < 0.16 * r
        )
        eyes.append(
            ellipsoid(
                c,
                (r, r, r),
                layers(
                    flesh(0.74, "coral", 186, 0.1, size=9.0),
                    (look, glow("gold_glow", 0.6, 0.4, 4.0)),
                    (slit, plain("grey", 0.06, 0.0)),
                ),
                "high" if z < 150 else "top",
                4,
                7,
                axis=outward,
                detail=1.3,
            )
        )
    arms, sheet = [], new_sheet()
    for i, (direction, distance, height) in enumerate(ARMS):
        chain = [f"arm{i}_{k}" for k in range(LINKS)]
        a = np.radians(direction)
        out = np.array([np.cos(a), np.sin(a), 0.0])
        path = [out * (distance + 18 * k) + [0, 0, height + LINK * 0.92 * k] for k in np.linspace(-0.6, LINKS - 0.1, 7)]
        bones = [{"low": 1.0}] + chain_rings(chain, 6)
        suckers = lambda t, o=out: ((t.v * 16) % 1.0 < 0.45) & (np.abs(t.u - 0.5) > 0.4)
        arms.append(
            tube(
                path,
                [26, 23, 19, 15, 11, 7, 2.5],
                layers(flesh(0.52, "coral", 187, 0.3, size=9.0), (suckers, flesh(0.8, "coral", 188, 0.1, size=9.0))),
                bones,
                7,
                up=out,
                caps=(0, 4),
                detail=0.7,
            )
        )
        arms[-1].sheet = sheet
    fans = [
        tube(
            [(x, y, z), (x * 1.12, y * 1.12, z + 26), (x * 1.2, y * 1.2, z + 52)],
            [(4, 8), (3, 26), (1.5, 34)],
            plain("coral", 0.66, 0.2, 10.0, gloss=0.55),
            "low",
            4,
            up=(x, y, 0),
            detail=0.7,
        )
        for x, y, z in ((-110, 60, 30), (-120, -50, 24), (20, 122, 20), (30, -124, 16))
    ]
    return [_mound(), lips, disc(throat), *teeth, *eyes, *arms, *fans]


def _pose(s: Skeleton, c: Clip) -> Posing:
    p = Posing(s, len(c["time"]))
    t, shake = c["time"][:, 0], c["shake"][:, 0]
    beat = np.sin(2 * np.pi * t)
    swell = np.stack([1 + 0.03 * beat, 1 + 0.03 * beat, 1 - 0.035 * beat], axis=1)
    zero = np.zeros(p.frames)
    p.place(
        "low",
        euler(np.stack([zero, zero, 2.0 * shake * np.where(np.arange(p.frames) % 2, 1, -1)], axis=1)),
        np.broadcast_to(s.rest["low"], (p.frames, 3))
        + np.stack([zero, 3 * shake * np.cos(np.arange(p.frames) * 2.2), zero], axis=1),
    )
    p.turn(
        "high",
        matrix=euler(
            np.stack(
                [
                    3 * np.sin(2 * np.pi * (t + 0.2)) - 10 * shake,
                    5 * np.sin(2 * np.pi * t),
                    4 * np.sin(2 * np.pi * (t + 0.4)) + 6 * shake * np.cos(np.arange(p.frames) * 1.7),
                ],
                axis=1,
            )
        )
        * swell[:, None, :],
    )
    p.turn(
        "top",
        np.stack([6 * np.sin(2 * np.pi * (t + 0.5)) - 12 * shake, 8 * np.sin(2 * np.pi * (t + 0.3)), zero], axis=1),
    )
    p.turn("jaw", np.stack([c["jaw"][:, 0], zero, zero], axis=1))
    for i, (direction, _, _) in enumerate(ARMS):
        chain = [f"arm{i}_{k}" for k in range(LINKS)]
        away = np.sign(np.cos(np.radians(direction)))
        side = np.sign(np.sin(np.radians(direction)))
        wave(p, chain, "y", t + 0.15 * i, 13.0 + 8 * shake, 0.13, away * (6.0 - 12.0 * shake), 0.06)
        wave(p, chain, "x", 2 * t + 0.21 * i, 9.0 + 10 * shake, 0.11, -side * 7.0, 0.05)
    return p


def oldone() -> Mdl:
    n = lengths("oldone")
    old, shake = n["old"], n["shake"]
    clips = {
        "old": {"time": cycle(old)[:, None], "jaw": sway(old, 4, 8)},
        "shake": {
            "time": (cycle(shake) * 3)[:, None],
            "shake": np.clip(np.linspace(0.3, 1.4, shake), 0, 1)[:, None],
            "jaw": sway(shake, 16, 12, 0, 4),
        },
    }
    s = _skeleton()
    return build(
        _patches(s), _pose(s, joined(REST, sequence_clips("oldone", clips))), frame_names("oldone"), skin=(320, 256)
    )


MODELS = {"oldone": oldone}
