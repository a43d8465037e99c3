"""The soldier: a warden of the flooded works in an oilskin, behind a respirator with glowing goggles."""

from __future__ import annotations

import numpy as np

from formats.mdl import GIB, Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.figure import build
from models.kit.paint import band, both_of, canvas, copper, flesh, glow, iron, layers, leather, rib, rivets, where, wood
from models.kit.shapes import Patch, both, box, ellipsoid, lathe, moved, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES

BODY = humanoid.Build(shoulder=(-0.4, 6.6, 6.6), neck=8.8)
CARRY = {
    "hand_r": (0.36, 0.16, -0.66),
    "hand_l": (0.7, 0.1, -0.5),
    "hold": 1,
    "grip": (14, 26, 0),
    "elbow_r": 30,
    "elbow_l": 15,
}
AIM = {"hand_r": (0.42, 0.2, -0.06), "hold": 1, "grip": (0, 4, 0), "elbow_r": 70, "head": (6, -6, -8)}


def head(at, bone: str = "head") -> list[Patch]:
    """A hooded rubber mask: two glowing goggles and a filter."""
    x, y, z = at
    hood = lathe(
        [(-4.2, 3.6), (-2.4, 4.0), (0.2, 4.3), (2.4, 3.8), (4.0, 2.0)],
        layers(
            canvas(0.56, "verdigris"),
            (both_of(lambda s: s.x > x + 1.6, band("z", z - 3.4, z + 2.4)), leather(0.3, "slate")),
        ),
        bone,
        at,
        sides=9,
        caps=(0, 0.5),
        squash=0.94,
    )
    goggle = lathe(
        [(0, 1.5), (1.0, 1.55), (1.2, 1.05)],
        where(band("v", 0.66, 1.1), glow("gold_glow", 0.75, 0.3), copper(0.1)),
        bone,
        (x + 3.2, y + 1.65, z + 0.7),
        (1, 0.32, 0),
        7,
        caps=(None, 0.15),
        detail=1.2,
    )
    filter_ = lathe(
        [(0, 1.6), (2.0, 1.5), (2.3, 1.0)],
        layers(iron(0.45, 0.1), (band("v", 0.75, 1.1), layers(copper(0.2), (rivets(6, 4, 0.3), iron(0.2, 0))))),
        bone,
        (x + 3.0, y, z - 1.9),
        (1, 0, -0.45),
        7,
        caps=(None, 0),
    )
    helm = lathe(
        [(0.6, 4.9), (1.2, 4.7), (3.2, 4.0), (4.6, 2.2)],
        layers(copper(0.55, 3.0), (band("v", 0.0, 0.18), iron(0.35, 0.1))),
        bone,
        (x - 0.2, y, z + 0.4),
        sides=10,
        caps=(None, 0.4),
    )
    return [hood, helm, filter_] + both(goggle)


def _body(s: Skeleton) -> list[Patch]:
    hip = s.rest["hips"][2]
    coat = layers(
        canvas(0.5, "verdigris"),
        (both_of(lambda t: (t.x > 0) & (np.abs(t.y) < 0.5)), leather(0.28)),
        (band("z", hip - 0.4, hip + 1.6), leather(0.34, "ochre")),
        (both_of(band("z", hip - 0.4, hip + 1.6), lambda t: (np.abs(t.y) < 1.3) & (t.x > 0)), copper(0.1)),
        (lambda t: (np.abs(t.y + t.z * 0.75 - hip * 0.75 - 6.0) < 0.8) & (t.z > hip), leather(0.34, "ochre")),
    )
    trunk = bodies.trunk(
        s,
        [
            (0.0, 0, 4.0, 5.2),
            (3.4, 0.2, 3.9, 4.8),
            (8.0, 0.3, 4.7, 5.8),
            (12.5, 0.1, 4.9, 6.6),
            (16.0, -0.2, 4.0, 6.0),
            (18.0, -0.2, 3.0, 3.4),
        ],
        coat,
        9,
        caps=(None, None),
    )
    tails = bodies.skirt(
        s,
        [(0.6, 0, 4.1, 5.3), (-4.0, 0, 4.9, 6.2), (-9.5, -0.2, 5.8, 7.2)],
        layers(canvas(0.48, "verdigris"), (band("v", 0.9, 1.1), leather(0.25))),
        10,
    )
    arm = bodies.arm(
        s,
        [2.4, 2.7, 2.3, 2.2, 2.2, 2.3, 2.1],
        layers(canvas(0.5, "verdigris"), (band("v", 0.84, 1.1), leather(0.34, "ochre"))),
    )
    leg = bodies.leg(
        s,
        [3.2, 3.3, 2.7, 2.6, 2.7, 2.7, 2.3],
        layers(canvas(0.42, "slate"), (lambda t: t.z < -15.0, leather(0.34, "sand"))),
    )
    pad = ellipsoid(
        s.rest["upper_l"] + [0, 0.8, 0.8],
        (2.9, 2.4, 1.9),
        copper(0.45, 3.0),
        {"upper_l": 0.6, "chest": 0.4},
        3,
        6,
        detail=0.8,
    )
    boot = bodies.boot(s, leather(0.32, "sand"), 8.2, 2.3, 4.2, sides=6)
    pack = box(
        s.rest["chest"] + [-6.0, 0, 2.0],
        (3.4, 6.0, 7.0),
        layers(canvas(0.5, "ochre"), (rib("y", 3.2, 0.6, 0.3), leather(0.3))),
        "chest",
        bevel=0.35,
        detail=0.7,
    )
    lamp = lathe(
        [(-1.6, 0.9), (-1.3, 1.2), (-1.2, 0.95), (0.9, 0.95), (1.0, 1.25), (1.7, 0.4)],
        where(band("v", 0.34, 0.64), glow("fire", 0.9, 0.15), copper(0.3)),
        "hips",
        (1.5, -5.9, hip - 2.4),
        sides=6,
        caps=(0.1, 0.2),
    )
    return [trunk, tails, pack, lamp] + both(arm, leg, pad, boot, *bodies.mitt(s, leather(0.4, "ochre"), 0.95))


def _gun(s: Skeleton) -> list[Patch]:
    at = s.rest["weapon"]
    barrel = lathe(
        [(0.0, 1.0), (11.0, 0.85), (12.5, 1.5), (12.8, 1.4), (12.0, 0.7)],
        layers(iron(0.46, 0.2), (band("v", 0.3, 0.36), copper(0.1)), (band("v", 0.7, 0.95), copper(0.35, 2.0))),
        "weapon",
        at + [2.0, 0, 0.9],
        (1, 0, 0),
        7,
        caps=(None, 0),
    )
    body = box(
        at + [0.0, 0, 0.6],
        (2.6, 1.8, 6.0),
        layers(copper(0.4, 2.0), (rivets(4, 3, 0.2), iron(0.4, 0))),
        "weapon",
        (1, 0, 0),
        (0, 0, 1),
        detail=0.8,
    )
    stock = tube(
        [at + [-2.4, 0, 0.2], at + [-5.0, 0, -0.4], at + [-9.0, 0, -1.6]],
        [(1.1, 0.8), (1.0, 0.7), (1.9, 0.8)],
        wood(0.45, grain=(3, 0.6, 0.6)),
        "weapon",
        6,
        up=(0, 0, 1),
        detail=0.6,
    )
    return [barrel, body, stock]


def _clips() -> dict:
    n = lengths("soldier")
    kick = {"hand_r": (0.3, 0.2, -0.02), "grip": (-8, 4, 0), "chest": (-10, -6, 0), "root": (-0.04, 0, -0.09)}
    aim = {**AIM, "chest": (2, -14, 0), "root": (0, 0, -0.08)}
    return {
        "stand": moves.stand(n["stand"], CARRY),
        "death": moves.fall_back(BODY, n["death"], CARRY),
        "deathc": moves.fall_front(BODY, n["deathc"], CARRY),
        "load": moves.acted(
            n["load"],
            CARRY,
            {
                0.2: {"grip": (-40, 40, 0), "hand_r": (0.4, 0.2, -0.5), "hold": 1, "head": (20, 14, 0)},
                0.4: {"hold": 0, "hand_l": (0.45, -0.25, -0.75), "head": (22, 10, 0)},
                0.6: {"hold": 0, "hand_l": (0.55, -0.2, -0.5), "grip": (-40, 40, 0)},
                0.75: {"hold": 1, "grip": (-30, 30, 0), "head": (14, 0, 0)},
            },
        ),
        "pain": moves.hit(n["pain"], CARRY),
        "painb": moves.hit(
            n["painb"], CARRY, (20, 34, 6), (18, 10, 0), 0.1, 0.2, {"hold": 0, "hand_l": (0.4, -0.2, -0.3)}
        ),
        "painc": moves.hit(
            n["painc"], CARRY, (-22, -34, -6), (-24, -10, 0), 0.14, 0.16, {"hold": 0, "hand_l": (0.3, 0.7, 0.2)}
        ),
        "run": moves.gait(BODY, PACES["soldier"]["run"], CARRY, lift=0.26, stance=0.265, offset=-0.95 / 8, drop=0.12, bob=0.035, lean=12),
        "shoot": moves.acted(n["shoot"], CARRY, {0.25: aim, 0.42: aim, 0.5: {**aim, **kick}, 0.75: aim}),
        "prowl_": moves.gait(BODY, PACES["soldier"]["prowl_"], CARRY, cycles=2, lift=0.1),
    }


def soldier() -> Mdl:
    skeleton = humanoid.bones(BODY)
    patches = _body(skeleton) + head(skeleton.rest["head"] + np.array([0.4, 0, 4.0])) + _gun(skeleton)
    return humanoid_model("soldier", BODY, skeleton, patches, _clips(), CARRY, (8.0, 0.4, 0.0), skin=(296, 194))


def h_guard() -> Mdl:
    return severed(head((0, 0, 4.2), "root"), 3.2)


def severed(patches: list[Patch], neck: float, tilt=(0.0, 0.0, 0.0), skin=(128, 128), at=(0.0, 0.0, 0.0)) -> Mdl:
    """A head alone, with a stump of `neck` units radius, that leaves a trail where it flies."""
    from models.kit.turn import euler

    stump = lathe(
        [(-1.2, neck * 0.5), (-0.8, neck * 0.86), (0.6, neck)],
        flesh(0.5),
        "root",
        at,
        sides=7,
        caps=(0.2, None),
        detail=0.6,
    )
    turn = euler(np.array(tilt))
    parts = [moved(p, turn=turn) for p in [*patches, stump]]
    for part in parts:
        part.bones = [{"root": 1.0}] * len(part.bones)
    low = min(p.grid[..., 2].min() for p in parts)
    return build([moved(p, (0, 0, -low)) for p in parts], None, ["frame1"], skin=skin, flags=GIB)


MODELS = {"soldier": soldier, "h_guard": h_guard}
