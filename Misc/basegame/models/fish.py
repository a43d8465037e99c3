"""The rotfish: an angler of the flooded shafts, with a lamp over its teeth."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.beast import add_chain, turn_about, wave
from models.kit.bodies import spike
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, keyed
from models.kit.paint import band, bone, copper, flesh, glow, layers, plain
from models.kit.shapes import Patch, both, ellipsoid, flat_section, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

REST = {"body": (0, 0, 0), "tilt": (0, 0, 0), "swim": (0,), "beat": (9,), "curl": (0,), "jaw": (6,), "fins": (0,)}
SCALES = layers(
    flesh(0.5, "verdigris", 141, 0.25), (lambda s: s.z < -3.0 - 2.0 * s.noise(4.0, 142), flesh(0.78, "sand", 143, 0.1))
)
SPINE = [6.0, -2.0, -9.0, -16.0, -22.0]


def _skeleton() -> Skeleton:
    s = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "body": ("root", (6, 0, 0)),
            "jaw": ("body", (10, 0, -3.0)),
            "fin_l": ("body", (6, 7.0, -3)),
            "fin_r": ("body", (6, -7.0, -3)),
            "lamp": ("body", (10, 0, 8)),
        }
    )
    add_chain(s, "spine", "body", [(x, 0, 0) for x in SPINE])
    return s


def _patches(s: Skeleton) -> list[Patch]:
    bones = [
        "body",
        "body",
        "body",
        "spine0",
        {"spine0": 0.5, "spine1": 0.5},
        {"spine1": 0.5, "spine2": 0.5},
        "spine3",
        "spine4",
    ]
    eyes = lambda t: t.near((14.0, 6.0, 4.2), 1.7) | t.near((14.0, -6.0, 4.2), 1.7)
    ring = lambda t: t.near((14.0, 6.0, 4.2), 2.5) | t.near((14.0, -6.0, 4.2), 2.5)
    body = tube(
        [
            (21, 0, 1.0),
            (17, 0, 1.4),
            (11, 0, 1.6),
            (4, 0, 1.0),
            (-4, 0, 0.6),
            (-12, 0, 0.4),
            (-19, 0, 0.4),
            (-24, 0, 0.4),
        ],
        [(2.4, 4.0), (5.2, 6.4), (8.0, 7.6), (9.4, 7.4), (8.0, 5.8), (5.4, 3.8), (3.2, 2.0), (2.0, 0.9)],
        layers(
            SCALES,
            (lambda t: (t.x > 13) & (t.z < 0.6), plain("red", 0.4, 0.12, gloss=0.68)),
            (ring, plain("verdigris", 0.3, 0.05, gloss=0.6)),
            (eyes, glow("gold_glow", 0.6, 0.3)),
        ),
        bones,
        10,
        up=(0, 0, 1),
        caps=(0.6, 0.5),
    )
    jaw = tube(
        [(8.5, 0, -4.6), (13, 0, -6.2), (18, 0, -5.6), (21.5, 0, -4.0)],
        [(3.4, 5.6), (2.8, 6.0), (1.9, 4.8), (1.0, 2.6)],
        layers(SCALES, (lambda t: t.z > -4.6, plain("red", 0.42, 0.12, gloss=0.68))),
        "jaw",
        9,
        up=(0, 0, 1),
    )
    teeth = [
        spike((x, y, -1.2), (x + 0.6, y, -5.0), 0.7, bone(0.86), "body", 4, detail=0.4)
        for x, y in ((20.0, 2.2), (17.6, 4.4), (14.6, 5.8))
    ]
    fangs = [
        spike((x, y, -4.6), (x + 0.8, y * 1.03, 0.6), 0.75, bone(0.86), "jaw", 4, detail=0.4)
        for x, y in ((20.6, 1.4), (18.8, 3.8), (16.0, 5.2))
    ]
    tail = tube(
        [(-22, 0, 0.4), (-27, 0, 0.6), (-33, 0, 1.0)],
        [(2.0, 0.7), (6.0, 0.45), (11.0, 0.15)],
        plain("coral", 0.6, 0.2, 3.0, gloss=0.6),
        ["spine3", "spine4", "spine4"],
        section=flat_section(),
        up=(0, 0, 1),
    )
    dorsal = tube(
        [(6, 0, 8.4), (0, 0, 11.0), (-7, 0, 9.6), (-12, 0, 5.6)],
        [(1.4, 0.7), (4.6, 0.5), (4.2, 0.4), (1.0, 0.2)],
        layers(plain("coral", 0.56, 0.2, 3.0, gloss=0.6), (lambda t: (t.x % 3.0) < 0.7, bone(0.7))),
        ["body", "spine0", "spine1", "spine2"],
        section=flat_section(),
        up=(0, 0, 1),
    )
    fin = tube(
        [(7, 6.4, -2.6), (4.5, 11.0, -4.6), (0.5, 15.5, -6.8)],
        [(2.2, 0.6), (3.4, 0.4), (2.6, 0.15)],
        plain("coral", 0.6, 0.2, 3.0, gloss=0.6),
        "fin_l",
        section=flat_section(),
        up=(1, 0, 0),
    )
    rod = tube(
        [(8, 0, 8.6), (11, 0, 13.5), (17, 0, 16.0), (22, 0, 13.6)],
        [0.9, 0.7, 0.5, 0.4],
        SCALES,
        ["body", "lamp", "lamp", "lamp"],
        5,
        up=(0, 1, 0),
        detail=0.6,
    )
    bulb = ellipsoid(
        (22.4, 0, 12.0),
        (1.9, 1.9, 2.2),
        layers(glow("white_glow", 0.3, 0.3), (band("z", 13.2, 16), copper(0.3))),
        "lamp",
        4,
        7,
    )
    return [body, jaw, tail, dorsal, rod, bulb] + both(fin, *teeth, *fangs)


def _pose(s: Skeleton, c: Clip) -> Posing:
    p = Posing(s, len(c["body"]))
    p.place("body", euler(c["tilt"]), s.rest["body"] + c["body"])
    phase, beat = c["swim"][:, 0], c["beat"][:, 0]
    turn_about(p, "body", "z", -0.7 * beat * np.sin(2 * np.pi * phase))
    wave(p, [f"spine{i}" for i in range(len(SPINE))], "z", phase + 0.1, beat, 0.14, c["curl"][:, 0], 0.3)
    p.turn("jaw", np.concatenate([c["jaw"], np.zeros((p.frames, 2))], axis=1))
    p.turn(
        "lamp",
        np.stack(
            [6.0 * np.sin(2 * np.pi * phase), 8.0 * np.sin(2 * np.pi * (phase - 0.2)), np.zeros(p.frames)], axis=1
        ),
    )
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        flap = 18.0 * np.sin(2 * np.pi * (phase + 0.25 * sign)) + c["fins"][:, 0]
        p.turn("fin" + side, np.stack([np.zeros(p.frames), -sign * 0.3 * flap, sign * flap], axis=1))
    return p


def _clips() -> dict[str, Clip]:
    n = lengths("fish")
    swim = lambda count, turns: {"swim": (cycle(count) * turns)[:, None]}
    a, d, h = n["attack"], n["death"], n["pain"]
    bite = keyed(
        a,
        {
            0: REST,
            a * 0.25: {"tilt": (-8, 0, 0), "jaw": 44, "body": (-4, 0, 1), "beat": 12},
            a * 0.38: {"tilt": (6, 0, 10), "jaw": 50, "body": (9, 0, 0)},
            a * 0.46: {"jaw": -6, "tilt": (10, 0, -14), "body": (8, 0, 0)},
            a * 0.6: {"jaw": 40, "tilt": (-6, 0, 0), "body": (2, 0, 0)},
            a * 0.74: {"jaw": -6, "tilt": (6, 0, 12), "body": (7, 0, 0)},
            a - 1: REST,
        },
    ) | swim(a, 2)
    death = keyed(
        d,
        {
            0: REST,
            d * 0.15: {"tilt": (-14, 20, 20), "curl": 14, "jaw": 40},
            d * 0.4: {"tilt": (-8, 10, 100), "curl": -8, "beat": 14, "body": (0, 0, 2)},
            d * 0.7: {"tilt": (-4, 0, 168), "curl": 6, "beat": 4, "jaw": 30},
            d - 1: {"tilt": (0, 0, 178), "curl": 4, "beat": 0, "jaw": 34, "fins": -20, "body": (0, 0, 3)},
        },
    ) | swim(d, 1.5)
    pain = keyed(
        h,
        {
            0: {"tilt": (-12, 18, 12), "curl": 12, "jaw": 36},
            h * 0.35: {"tilt": (6, -20, -14), "curl": -12, "jaw": 20},
            h - 1: REST,
        },
    ) | swim(h, 1)
    return {"attack": bite, "death": death, "swim": swim(n["swim"], 1), "pain": pain, "base": {}}


def fish() -> Mdl:
    s = _skeleton()
    return build(
        _patches(s), _pose(s, joined(REST, sequence_clips("fish", _clips()))), frame_names("fish"), skin=(256, 160)
    )


MODELS = {"fish": fish}
