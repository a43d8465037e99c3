"""The scrag: a monk's cowl that a jellyfish wears. It floats; its arms trail, its eyes burn under the hood."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.beast import add_chain, wave
from models.kit.bodies import spike
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, keyed, sway
from models.kit.paint import band, canvas, copper, flesh, glow, layers, plain, wax, where
from models.kit.shapes import Patch, both, ellipsoid, lathe, torus, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler
from models.soldier import severed

REST = {"body": (0, 0, 0), "tilt": (0, 0, 0), "swim": (0,), "beat": (14,), "arms": (0, 0), "jaw": (0,), "limp": (0,)}
ROBE = layers(canvas(0.5, "slate", 131), (lambda s: s.noise(5.0, 132, 3) > 0.6, canvas(0.48, "verdigris", 133)))
FLESH = flesh(0.74, "coral", 134, 0.6)
STRANDS = [(3.0, 4.0), (3.0, -4.0), (-3.5, 3.6), (-3.5, -3.6), (-5.0, 0.0)]


def _skeleton() -> Skeleton:
    s = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "body": ("root", (0, 0, 10)),
            "head": ("body", (3.0, 0, 20)),
            "jaw": ("head", (5.0, 0, 17)),
        }
    )
    for i, (x, y) in enumerate(STRANDS):
        add_chain(s, f"strand{i}_", "body", [(x, y, 4 - 6.5 * k) for k in range(4)])
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        s.add(f"upper{side}", "body", (1.0, 6.4 * sign, 14.0))
        s.add(f"lower{side}", f"upper{side}", (3.0, 13.5 * sign, 10.5))
        s.add(f"claw{side}", f"lower{side}", (9.0, 17.5 * sign, 8.0))
    return s


def head(at, bone: str = "head", jaw: str = "jaw") -> list[Patch]:
    x, y, z = at
    inside = plain("mauve", 0.2, 0.08, 2.0)
    eyes = lambda s: s.near((x + 4.6, y + 1.7, z + 0.4), 1.0) | s.near((x + 4.6, y - 1.7, z + 0.4), 1.0)
    face = ellipsoid(
        (x + 1.6, y, z - 0.2),
        (3.2, 3.2, 4.2),
        layers(
            FLESH,
            (
                lambda s: s.near((x + 4.4, y + 1.7, z + 0.4), 1.6) | s.near((x + 4.4, y - 1.7, z + 0.4), 1.6),
                plain("coral", 0.25, 0.1),
            ),
            (eyes, glow("gold_glow", 0.85, 0.3)),
        ),
        bone,
        5,
        9,
        detail=1.2,
    )
    hood = tube(
        [
            (x + 4.6, y, z + 0.4),
            (x + 2.6, y, z + 0.8),
            (x - 1.0, y, z + 1.2),
            (x - 4.6, y, z + 0.8),
            (x - 8.0, y, z - 1.4),
        ],
        [(5.0, 4.4), (5.7, 5.0), (5.4, 5.0), (3.6, 3.6), (1.2, 1.2)],
        ROBE,
        bone,
        10,
        up=(0, 0, 1),
        caps=(-2.0, 1.4),
    )
    hood.paint = where(lambda s: s.v < 0.16, inside, ROBE)
    beard = [
        tube(
            [(x + 4.0, y + dy, z - 3.2), (x + 5.2, y + dy * 1.3, z - 5.4), (x + 4.6, y + dy * 1.6, z - 8.4)],
            [0.7, 0.55, 0.2],
            FLESH,
            jaw,
            5,
            caps=(0, 0.3),
            detail=0.6,
        )
        for dy in (-1.8, -0.6, 0.6, 1.8)
    ]
    return [hood, face, *beard]


def _body(s: Skeleton) -> list[Patch]:
    hem = lambda t: t.v > 0.9
    bell = tube(
        [(1.5, 0, 21), (0.8, 0, 17), (0, 0, 11), (-0.5, 0, 5), (-0.6, 0, 0), (-0.6, 0, -3)],
        [(3.4, 4.0), (5.2, 6.8), (5.6, 6.6), (6.8, 7.4), (8.4, 9.2), (9.0, 10.0)],
        layers(ROBE, (lambda t: (t.u * 10) % 1.0 < 0.1, canvas(0.34, "slate", 135)), (hem, copper(0.4, 2.0))),
        [{"body": 0.6, "head": 0.4}, "body", "body", "body", "body", "body"],
        11,
        caps=(0.3, 4.0),
    )
    cord = torus((0.0, 0, 8.6), (0, 0, 1), 6.4, (0.6, 0.6), wax(0.8), "body", 11, 4, squash=1.06, detail=0.6)
    lamp = lathe(
        [(-1.5, 0.8), (-1.1, 1.2), (-1.0, 0.9), (0.9, 0.9), (1.0, 1.25), (1.7, 0.3)],
        where(band("v", 0.34, 0.66), glow("fire", 0.85, 0.2), copper(0.3)),
        "body",
        (7.2, 2.6, 5.6),
        sides=6,
        caps=(0, 0.2),
    )
    strands = []
    for i, (x, y) in enumerate(STRANDS):
        chain = [f"strand{i}_{k}" for k in range(4)]
        strands.append(
            tube(
                [(x, y, 5 - 6.2 * k) for k in range(5)],
                [2.3, 1.9, 1.5, 1.0, 0.35],
                layers(FLESH, (lambda t: (t.z % 2.4) < 0.5, flesh(0.55, seed=136))),
                [chain[0], chain[0], chain[1], chain[2], chain[3]],
                6,
                caps=(0.5, 0.8),
                detail=0.8,
            )
        )
    up, low, claw = (s.rest[f"{n}_l"] for n in ("upper", "lower", "claw"))
    sleeve = tube(
        [up - [0, 2, 0], up * 0.5 + low * 0.5, low, low * 0.3 + claw * 0.7],
        [(2.6, 2.6), (2.5, 2.6), (3.0, 3.0), (3.8, 3.6)],
        layers(ROBE, (band("v", 0.92, 1.1), copper(0.4, 2.0))),
        [{"body": 0.5, "upper_l": 0.5}, "upper_l", {"upper_l": 0.5, "lower_l": 0.5}, "lower_l"],
        7,
        up=(0, 0, 1),
        caps=(0, -2.5),
    )
    hand = tube(
        [low * 0.35 + claw * 0.65, claw, claw + [2.0, 0.4, -0.6]],
        [(1.0, 1.0), (1.3, 1.5), (0.9, 1.2)],
        FLESH,
        ["lower_l", "claw_l", "claw_l"],
        6,
        up=(0, 0, 1),
    )
    fingers = [
        spike(claw + [1.6, dy, -0.4], claw + [6.6, dy * 2.4 - 1.0, -3.0], 0.6, FLESH, "claw_l", 4, (0.4, 0, 1.4), 0.5)
        for dy in (-1.2, 0.0, 1.2)
    ]
    return [bell, cord, lamp, *strands] + both(sleeve, hand, *fingers)


def _pose(s: Skeleton, c: Clip) -> Posing:
    p = Posing(s, len(c["body"]))
    p.place("body", euler(c["tilt"]), s.rest["body"] + c["body"])
    p.turn("head", c["tilt"] * [-0.6, 0.0, -0.3])
    p.turn("jaw", np.concatenate([c["jaw"], np.zeros((p.frames, 2))], axis=1))
    phase, beat, limp = c["swim"][:, 0], c["beat"][:, 0], c["limp"][:, 0]
    for i, (x, y) in enumerate(STRANDS):
        chain = [f"strand{i}_{k}" for k in range(4)]
        wave(
            p,
            chain,
            "y",
            phase + 0.17 * i,
            beat * (1 - 0.8 * limp),
            0.13,
            3.0 + 0.32 * c["tilt"][:, 0] - limp * (4.0 if x > 0 else -6.0),
            0.12,
        )
        wave(p, chain, "x", phase + 0.23 * i, 0.5 * beat * (1 - limp), 0.16, np.sign(y) * (2.0 + 7.0 * limp), 0.1)
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        reach, lift = c["arms"][:, 0], c["arms"][:, 1]
        flap = np.sin(2 * np.pi * phase) * 0.4 * beat
        p.turn(f"upper{side}", np.stack([-0.4 * reach, -sign * 0.7 * reach, sign * (flap + lift)], axis=1))
        p.turn(f"lower{side}", np.stack([0.1 * reach, -sign * 0.3 * reach, sign * (0.6 * flap + 0.4 * lift)], axis=1))
        p.turn(
            f"claw{side}",
            np.stack([np.sin(2 * np.pi * (phase - 0.2)) * 12.0, np.zeros(p.frames), np.zeros(p.frames)], axis=1),
        )
    return p


def _clips() -> dict[str, Clip]:
    n = lengths("wizard")
    drift = lambda count, turns, amount: {
        "swim": (cycle(count) * turns)[:, None],
        "body": np.concatenate(
            [sway(count, 0.0, 1.0), sway(count, 0.0, 1.4, 0.3), sway(count, 0.0, amount, 0.1)], axis=1
        ),
    }
    hover = drift(n["hover"], 1, 2.2) | {
        "tilt": np.concatenate(
            [sway(n["hover"], 4.0, 3.0), sway(n["hover"], 0.0, 3.0, 0.2), sway(n["hover"], 0.0, 3.0, 0.4)], axis=1
        )
    }
    fly = drift(n["fly"], 1, 2.6) | {
        "tilt": np.concatenate(
            [sway(n["fly"], 26.0, 4.0), sway(n["fly"], 0.0, 2.0), sway(n["fly"], 0.0, 4.0, 0.3)], axis=1
        ),
        "beat": np.full((n["fly"], 1), 20.0),
        "arms": np.repeat([[-30.0, -6.0]], n["fly"], axis=0),
    }
    m = n["magatt"]
    cast = keyed(
        m,
        {
            0: REST,
            m * 0.3: {"tilt": (-18, 0, 0), "arms": (-30, 48), "jaw": -10, "body": (-3, 0, 4)},
            m * 0.42: {"tilt": (-20, 0, 0), "arms": (-34, 54)},
            m * 0.55: {"tilt": (24, 0, 0), "arms": (70, 4), "jaw": 24, "body": (5, 0, -1)},
            m * 0.72: {"tilt": (18, 0, 0), "arms": (62, 4), "body": (3, 0, 0)},
            m - 1: REST,
        },
    ) | {"swim": (cycle(m))[:, None], "beat": np.full((m, 1), 16.0)}
    k = n["pain"]
    pain = keyed(
        k,
        {
            0: {"tilt": (-16, 12, 10), "body": (-3, 0, 1), "arms": (-20, 30)},
            1: {"tilt": (-28, 24, 16), "body": (-5, 0, 2), "arms": (-30, 44)},
            k - 1: REST,
        },
    ) | {"swim": (cycle(k) * 0.3)[:, None], "beat": np.full((k, 1), 26.0)}
    d = n["death"]
    death = keyed(
        d,
        {
            0: {"tilt": (-20, 10, 8), "body": (-3, 0, 2), "arms": (-20, 40), "limp": 0.0},
            d * 0.4: {"tilt": (-50, 24, 10), "body": (-8, 0, -8), "limp": 0.3, "arms": (-30, 30)},
            d * 0.75: {"tilt": (-82, 30, 6), "body": (-10, 0, -26), "limp": 0.8, "arms": (-10, -10)},
            d - 1: {"tilt": (-88, 30, 4), "body": (-10, 0, -27.5), "limp": 1.0, "arms": (-10, -20)},
        },
    ) | {"swim": (cycle(d) * 0.6)[:, None]}
    return {"hover": hover, "fly": fly, "magatt": cast, "pain": pain, "death": death}


def wizard() -> Mdl:
    s = _skeleton()
    patches = _body(s) + head((3.6, 0, 23.0))
    return build(
        patches,
        _pose(s, joined(REST, sequence_clips("wizard", _clips()))),
        frame_names("wizard"),
        skin=(256, 200),
        floor=-23.9,
    )


MODELS = {"wizard": wizard, "h_wizard": lambda: severed(head((0, 0, 5.0), "root", "root"), 3.0)}
