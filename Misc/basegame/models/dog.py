"""The hound: raw coral muscle in an iron harness, a beartrap for a jaw."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from formats.mdl import Mdl
from models.conventions import frame_names, lengths
from models.kit.beast import add_chain, add_leg, reach
from models.kit.bodies import spike
from models.kit.cast import sequence_clips
from models.kit.figure import build
from models.kit.motion import Clip, cycle, joined, keyed, merge
from models.kit.paint import bone, copper, flesh, glow, iron, layers, leather, plain, rivets, steel
from models.kit.shapes import Patch, both, box, mirrored, torus, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.steps import foot
from models.kit.turn import apply, euler
from models.paces import PACES
from models.soldier import severed

UPPER, LOWER = 9.5, 9.0
LEG = UPPER + LOWER
GROUND, PAW = -24.0, 2.0
HIP = GROUND + PAW + 0.93 * LEG
LEGS = {"fl": (10.0, 4.6), "fr": (10.0, -4.6), "bl": (-12.0, 4.6), "br": (-12.0, -4.6)}
REST = {
    "body": (0, 0, 0),
    "tilt": (0, 0, 0),
    "bend": (0, 0),
    "neck": (0, 0),
    "head": (0, 0, 0),
    "jaw": (0,),
    "tail": (0, 0),
    "loose": (0,),
    **{leg: (0, 0, 0) for leg in LEGS},
}
HIDE = flesh(0.5, "coral", 121, 0.35)


def skeleton() -> Skeleton:
    s = Skeleton(
        {
            "root": ("", (0, 0, 0)),
            "body": ("root", (-6, 0, HIP)),
            "hips": ("body", (-8, 0, HIP + 1)),
            "chest": ("body", (-2, 0, HIP + 1.5)),
            "neck": ("chest", (11, 0, HIP + 3.5)),
            "head": ("neck", (17, 0, HIP + 8)),
            "jaw": ("head", (18, 0, HIP + 6.5)),
        }
    )
    add_chain(s, "tail", "hips", [(-16, 0, HIP + 3), (-21, 0, HIP + 4), (-26, 0, HIP + 6)])
    for leg, (x, y) in LEGS.items():
        add_leg(s, leg, "chest" if leg[0] == "f" else "hips", (x, y, GROUND + PAW + LEG), UPPER, LOWER)
    return s


def pose(s: Skeleton, c: Clip) -> Posing:
    p = Posing(s, len(c["body"]))
    p.place("body", euler(c["tilt"]), s.rest["body"] + c["body"] * LEG)
    zero = np.zeros((p.frames, 1))
    p.turn("hips", np.concatenate([-c["bend"][:, :1], c["bend"][:, 1:], zero], axis=1))
    p.turn("chest", np.concatenate([c["bend"][:, :1], -c["bend"][:, 1:], zero], axis=1))
    p.turn("neck", np.concatenate([c["neck"], zero], axis=1))
    p.turn("head", c["head"])
    p.turn("jaw", np.concatenate([c["jaw"], zero, zero], axis=1))
    for bone_name in ("tail0", "tail1", "tail2"):
        p.turn(bone_name, np.concatenate([c["tail"][:, :1], c["tail"][:, 1:], zero], axis=1))
    loose = c["loose"][:, 0]
    for leg, (x, y) in LEGS.items():
        parent = "chest" if leg[0] == "f" else "hips"
        turn, at = p.of(parent)
        foot = s.rest[f"{leg}_foot"] + c[leg] * LEG
        own = at + apply(turn, foot - s.rest[parent])
        target = foot + (own - foot) * loose[:, None]
        lift = np.clip(c[leg][:, 2], 0, 1) * 90.0
        reach(p, leg, parent, target, (-1.0, 0, 0) if leg[0] == "f" else (1.0, 0, 0.0), UPPER, LOWER, lift, loose)
    return p


def head(at, bone_name: str = "head", jaw_bone: str = "jaw") -> list[Patch]:
    x, y, z = at
    eyes = lambda s: s.near((x + 2.2, y + 2.5, z + 1.8), 0.85) | s.near((x + 2.2, y - 2.5, z + 1.8), 0.85)
    skull = tube(
        [(x - 3.4, y, z), (x - 0.8, y, z + 0.5), (x + 2.6, y, z + 0.4), (x + 5.4, y, z - 0.6), (x + 9.0, y, z - 1.0)],
        [(2.6, 2.6), (3.3, 3.3), (2.7, 2.9), (1.7, 1.9), (1.2, 1.5)],
        layers(
            HIDE, (eyes, glow("fire", 0.8, 0.25)), (lambda s: (s.z < z - 1.2) & (s.x > x + 2), plain("red", 0.4, 0.1, gloss=0.68))
        ),
        bone_name,
        8,
        up=(0, 0, 1),
        caps=(0.4, 0.5),
    )
    jaw = tube(
        [(x + 0.4, y, z - 2.2), (x + 4.0, y, z - 3.0), (x + 8.2, y, z - 3.0)],
        [(1.1, 2.5), (1.0, 2.0), (0.8, 1.3)],
        layers(iron(0.46, 0.4, 3.0), (rivets(6, 4, 0.2), copper(0.1))),
        jaw_bone,
        7,
        up=(0, 0, 1),
        caps=(0.3, 0.5),
    )
    ears = spike((x - 1.4, y + 2.2, z + 2.4), (x - 4.4, y + 3.6, z + 5.8), 1.1, HIDE, bone_name, 5, (0, 0.6, 0.4))
    fangs = [
        spike((x + dx, y + dy, z - 1.4), (x + dx + 0.3, y + dy, z - 3.2), 0.42, bone(0.86), bone_name, 4, detail=0.4)
        for dx, dy in ((8.0, 1.0), (5.6, 1.4))
    ]
    trap = [
        spike(
            (x + dx, y + dy, z - 2.8), (x + dx + 0.2, y + dy * 1.1, z - 0.8), 0.4, steel(0.8), jaw_bone, 4, detail=0.4
        )
        for dx, dy in ((6.4, 1.4),)
    ]
    return [skull, jaw] + both(ears, *fangs, *trap)


def _body(s: Skeleton) -> list[Patch]:
    ribs = lambda t: (t.x > -7) & (t.x < 8) & (t.z < HIP + 4.5) & (t.z > HIP - 3.5) & ((t.x % 2.9) < 1.1)
    trunk = tube(
        [
            (-18, 0, HIP + 1.4),
            (-14, 0, HIP + 1.6),
            (-8.5, 0, HIP + 1.4),
            (-2, 0, HIP + 1.2),
            (5, 0, HIP + 0.8),
            (10.5, 0, HIP + 1.6),
            (14, 0, HIP + 4.0),
        ],
        [(3.0, 2.8), (4.6, 4.4), (3.9, 3.9), (4.8, 4.5), (6.2, 5.4), (5.6, 5.0), (3.6, 3.4)],
        layers(HIDE, (ribs, flesh(0.74, "coral", 122, 0.1))),
        [
            {"hips": 1},
            {"hips": 1},
            {"hips": 0.6, "chest": 0.4},
            {"hips": 0.2, "chest": 0.8},
            "chest",
            {"chest": 0.9, "neck": 0.1},
            {"chest": 0.5, "neck": 0.5},
        ],
        9,
        up=(0, 0, 1),
    )
    neck = tube(
        [(9.5, 0, HIP + 2.4), (13.5, 0, HIP + 5.4), (17.5, 0, HIP + 8)],
        [(4.2, 3.8), (3.3, 3.0), (2.7, 2.6)],
        HIDE,
        ["chest", "neck", {"neck": 0.5, "head": 0.5}],
        8,
        up=(0, 0, 1),
        caps=(None, None),
    )
    collar = torus((13.6, 0, HIP + 5.4), (0.75, 0, 0.62), 3.7, (0.7, 1.1), copper(0.3, 2.0), "neck", 10, 5)
    studs = [
        spike(
            (13.6 + 0.0, np.cos(a) * 4.0, HIP + 5.4 + np.sin(a) * 4.0),
            (13.2, np.cos(a) * 6.6, HIP + 5.4 + np.sin(a) * 6.6),
            0.7,
            steel(0.75),
            "neck",
            4,
            detail=0.4,
        )
        for a in np.radians([20, 90, 160, 215, 325])
    ]
    plate = box(
        (2.5, 0, HIP + 6.0),
        (11.0, 5.0, 1.8),
        layers(iron(0.42, 0.4), (rivets(5, 3, 0.2), copper(0.1))),
        "chest",
        bevel=0.4,
    )
    strap = torus(
        (2.0, 0, HIP + 1.2),
        (1, 0, 0.05),
        6.2,
        (0.4, 0.8),
        leather(0.34, "ochre"),
        "chest",
        11,
        3,
        squash=0.9,
        detail=0.7,
    )
    spine = [
        spike((x, 0, HIP + 5.2), (x - 2.0, 0, HIP + 8.6), 0.8, bone(0.82), "hips", 4, detail=0.4)
        for x in (-15.0, -11.0, -7.0)
    ]
    tail = tube(
        [s.rest["tail0"], s.rest["tail1"], s.rest["tail2"], s.rest["tail2"] + [-5, 0, 3]],
        [1.3, 1.0, 0.7, 0.25],
        HIDE,
        ["tail0", {"tail0": 0.5, "tail1": 0.5}, "tail2", "tail2"],
        6,
        up=(0, 1, 0),
        detail=0.7,
    )
    legs = []
    for leg, radii in (("fl", (3.4, 3.3, 2.2, 1.7, 1.5, 1.3)), ("bl", (4.2, 4.2, 2.6, 1.9, 1.5, 1.3))):
        a, b, c = (s.rest[f"{leg}_{part}"] for part in ("upper", "lower", "foot"))
        up, low = f"{leg}_upper", f"{leg}_lower"
        root = "chest" if leg[0] == "f" else "hips"
        legs.append(
            tube(
                [a + [0, 0, 1.5], a * 0.65 + b * 0.35, a * 0.1 + b * 0.9, b * 0.85 + c * 0.15, b * 0.4 + c * 0.6, c],
                list(radii),
                HIDE,
                [{root: 0.5, up: 0.5}, up, {up: 0.7, low: 0.3}, {up: 0.25, low: 0.75}, low, low],
                6,
                caps=(1.0, None),
            )
        )
        legs.append(
            tube(
                [c + [-1.4, 0, -0.6], c + [0.6, 0, -0.8], c + [3.2, 0, -1.2]],
                [(1.1, 1.3), (1.3, 1.8), (0.8, 1.6)],
                HIDE,
                f"{leg}_foot",
                6,
                up=(0, 0, 1),
                caps=(0.3, 0.5),
                detail=0.8,
            )
        )
        legs += [
            spike(c + [3.0, y, -1.2], c + [5.0, y * 1.2, -1.9], 0.5, iron(0.3, 0), f"{leg}_foot", 4, detail=0.4)
            for y in (0.0,)
        ]
    right = [_right(p) for p in legs]
    return [trunk, neck, collar, plate, strap, tail, *studs, *spine, *legs, *right]


def _right(patch: Patch) -> Patch:
    """The right side's leg: `fl_` becomes `fr_`, `bl_` becomes `br_`."""
    out = mirrored(patch)
    out.bones = [
        {name.replace("fl_", "fr_").replace("bl_", "br_"): share for name, share in ring.items()} for ring in out.bones
    ]
    return out


def _gait(
    pace: Sequence[float],
    phases: dict[str, float],
    lift: float,
    stance: float,
    bob: float,
    bend: float,
    drop: float = 0.03,
    lope: float = 0.0,
    cycles: int = 1,
) -> Clip:
    count = len(pace)
    phase = cycle(count) * cycles
    out: Clip = {}
    for leg, offset in phases.items():
        f = foot(pace, stance, offset, cycles)
        out[leg] = np.stack([f.x / LEG, np.zeros(count), np.where(f.down, 0.0, lift * np.sin(np.pi * f.part))], axis=1)
    w = lambda k, o=0.0: np.sin(2 * np.pi * (k * phase + o))
    zero = np.zeros(count)
    out["body"] = np.stack([zero, 0.02 * w(1), -drop + bob * w(2 if not lope else 1, 0.1)], axis=1)
    out["tilt"] = np.stack([lope * w(1, 0.3), zero, 2.0 * w(1, 0.2)], axis=1)
    out["bend"] = np.stack([bend * w(1, 0.05) if lope else 1.5 * w(2), 3.0 * w(1)], axis=1)
    out["neck"] = np.stack([-0.6 * lope * w(1, 0.3) + 2.0 * w(2, 0.2), zero], axis=1)
    out["tail"] = np.stack([10.0 * w(1, 0.3), 14.0 * w(1)], axis=1)
    return out


def _clips() -> dict[str, Clip]:
    n = lengths("dog")
    key = lambda name, keys, loop=False: keyed(
        n[name],
        {share * (n[name] - (0 if loop else 1)): value for share, value in keys.items()},
        loop,
        {k: v for k, v in REST.items()},
    )
    fallen = {
        "body": (0, 0.3, -0.6),
        "tilt": (0, 10, -86),
        "loose": 1,
        "head": (0, 0, -10),
        "neck": (20, 10),
        "fl": (0.3, 0, 0.2),
        "fr": (0.1, 0, 0.1),
        "bl": (-0.25, 0, 0.15),
        "br": (-0.05, 0, 0.05),
        "jaw": 26,
        "tail": (-10, 0),
    }
    flipped = {**fallen, "body": (-0.3, -0.2, -0.62), "tilt": (0, -30, 84), "fl": (0.1, 0, 0.3), "br": (0.2, 0, 0.2)}
    hurt = {
        "body": (-0.1, 0, -0.14),
        "tilt": (-6, 12, 8),
        "neck": (-24, 20),
        "head": (-14, 10, 0),
        "jaw": 30,
        "tail": (20, 0),
    }
    bite = {
        "body": (0.16, 0, 0.02),
        "tilt": (-12, 0, 0),
        "neck": (-16, 0),
        "head": (-8, 0, 0),
        "jaw": 44,
        "fl": (0.3, 0, 0.34),
        "fr": (0.2, 0, 0.22),
    }
    snap = {
        "body": (0.3, 0, -0.06),
        "tilt": (6, 0, 0),
        "neck": (26, 0),
        "head": (6, 8, 14),
        "jaw": 2,
        "fl": (0.3, 0, 0),
        "fr": (0.2, 0, 0),
    }
    crouch = {"body": (-0.12, 0, -0.3), "tilt": (-4, 0, 0), "neck": (20, 0), "head": (-18, 0, 0), "jaw": 8}
    spring = {
        "body": (0.2, 0, 0.3),
        "tilt": (-24, 0, 0),
        "loose": 1,
        "fl": (0.5, 0, 0.3),
        "fr": (0.4, 0, 0.34),
        "bl": (-0.4, 0, 0.1),
        "br": (-0.5, 0, 0.06),
        "jaw": 40,
        "neck": (4, 0),
        "tail": (-20, 0),
    }
    fly = {**spring, "tilt": (2, 0, 0), "fl": (0.55, 0, 0.2), "bl": (-0.5, 0, 0.3), "br": (-0.55, 0, 0.24)}
    wag = keyed(
        n["stand"],
        {
            0: {"body": (0, 0, -0.01), "neck": (0, -10), "head": (4, -6, 0), "tail": (4, -16), "jaw": 6},
            n["stand"] * 0.33: {"body": (0, 0, -0.03), "neck": (6, 8), "tail": (8, 14), "jaw": 14},
            n["stand"] * 0.66: {"body": (0, 0, 0.0), "neck": (-4, 14), "head": (-4, 8, 6), "tail": (0, -8), "jaw": 4},
        },
        True,
    )
    return {
        "attack": key(
            "attack", {0.0: {}, 0.28: bite, 0.4: bite, 0.6: snap, 0.76: {**snap, "head": (6, -8, -14)}, 1.0: REST}
        ),
        "death": key(
            "death",
            {
                0.0: {},
                0.25: hurt,
                0.55: {**fallen, "body": (0, 0.2, -0.3), "tilt": (0, 6, -50), "loose": 0.5},
                0.8: fallen,
                1.0: {**fallen, "jaw": 16},
            },
        ),
        "deathb": key(
            "deathb",
            {
                0.0: {},
                0.22: {**hurt, "body": (-0.2, 0, 0.3), "tilt": (-30, -10, 30), "loose": 1},
                0.5: {**flipped, "body": (-0.3, -0.1, -0.1), "tilt": (-10, -24, 64)},
                0.75: flipped,
                1.0: {**flipped, "jaw": 10},
            },
        ),
        "pain": key("pain", {0.0: {}, 0.3: hurt, 1.0: REST}),
        "painb": key(
            "painb",
            {
                0.0: {},
                0.15: hurt,
                0.35: {**hurt, "tilt": (10, -20, -14), "body": (-0.1, 0, -0.34), "neck": (30, -20)},
                0.65: {"body": (0, 0, -0.3), "tilt": (8, 0, 0), "neck": (24, 10), "jaw": 10},
                1.0: REST,
            },
        ),
        "run": merge(
            _gait(PACES["dog"]["run"], {"fl": 0.175, "fr": 0.195, "bl": 0.675, "br": 0.695}, 0.42, 0.21, 0.1, 16.0, 0.06, 8.0, 2),
            {"jaw": np.full((n["run"], 1), 14.0)},
        ),
        "leap": key(
            "leap",
            {0.0: {}, 0.2: crouch, 0.36: spring, 0.6: fly, 0.8: {**crouch, "tilt": (10, 0, 0), "loose": 0}, 1.0: REST},
        ),
        "stand": wag,
        "walk": _gait(PACES["dog"]["walk"], {"fl": 0.0, "br": 0.08, "fr": 0.5, "bl": 0.58}, 0.2, 0.52, 0.015, 0.0, cycles=2),
    }


def dog() -> Mdl:
    s = skeleton()
    patches = _body(s) + head(s.rest["head"] + np.array([1.6, 0, 0.6]))
    return build(
        patches,
        pose(s, joined(REST, sequence_clips("dog", _clips()))),
        frame_names("dog"),
        skin=(256, 200),
        floor=-23.9,
    )


MODELS = {"dog": dog, "h_dog": lambda: severed(head((0, 0, 3.0), "root", "root"), 2.4, at=(-2.0, 0, -2.0))}
