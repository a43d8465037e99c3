"""The knight: empty verdigris armour that a light has moved into, with a lantern for a helm."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.paint import Painter, band, canvas, copper, glow, iron, layers, leather, rib, rivets, steel, where
from models.kit.shapes import Patch, both, lathe, torus, tube
from models.kit.skeleton import Skeleton
from models.paces import PACES
from models.soldier import severed

BODY = humanoid.Build(shoulder=(-0.3, 7.4, 7.0), upper=8.2, lower=8.2)
PLATE = copper(0.86, 4.0, 21)
READY = {
    "hand_r": (0.42, 0.04, -0.6),
    "hand_l": (0.25, 0.25, -0.75),
    "hold": 0,
    "grip": (-40, 14, 0),
    "elbow_r": 25,
    "elbow_l": 20,
}


def lantern_helm(at, bone: str = "head", size: float = 1.0) -> list[Patch]:
    """A barrel helm whose slits show the flame within, with a lantern's cap and ring."""
    x, y, z = at
    k = size
    slit = (
        lambda s: (np.abs(((s.u * 12.0) % 1.0) - 0.5) < 0.2)
        & (s.z > z - 1.6 * k)
        & (s.z < z + 1.7 * k)
        & (s.x > x + 0.5 * k)
    )
    barrel = lathe(
        [(h * k, r * k) for h, r in ((-4.4, 3.6), (-4.0, 4.2), (-2.2, 4.1), (2.2, 3.9), (2.6, 4.5), (3.2, 4.4))],
        layers(
            PLATE,
            (band("v", 0.0, 0.14), copper(0.1)),
            (band("v", 0.84, 1.1), copper(0.1)),
            (slit, glow("fire", 0.85, 0.25, 1.5)),
        ),
        bone,
        at,
        sides=12,
        caps=(0, None),
    )
    cap = lathe(
        [(h * k, r * k) for h, r in ((3.2, 4.4), (4.6, 2.6), (5.4, 1.6), (6.0, 1.7), (6.6, 0.9))],
        layers(PLATE, (rivets(12, 6, 0.2), copper(0.0))),
        bone,
        at,
        sides=10,
        caps=(None, 0.2),
    )
    ring = torus((x, y, z + 7.6 * k), (1, 0, 0), 1.1 * k, 0.3 * k, copper(0.1), bone, 8, 4, detail=0.5)
    return [barrel, cap, ring]


def sword(at, bone: str, length: float = 22.0, width: float = 1.7, edge: Painter | None = None) -> list[Patch]:
    at = np.asarray(at, float)
    grip = lathe(
        [(-3.4, 0.9), (-2.6, 1.0), (-2.2, 0.55), (1.6, 0.6)],
        where(band("v", 0.0, 0.34), copper(0.1), layers(leather(0.3), (rib("x", 0.9, 0.3), leather(0.5)))),
        bone,
        at,
        (1, 0, 0),
        6,
        caps=(0.3, None),
        detail=0.7,
    )
    guard = tube(
        [at + [2.0, 0, -3.6], at + [1.6, 0, -1.6], at + [1.6, 0, 1.6], at + [2.0, 0, 3.6]],
        [0.4, 0.6, 0.6, 0.4],
        copper(0.3),
        bone,
        5,
        up=(1, 0, 0),
        caps=(0.3, 0.3),
        detail=0.6,
    )
    paint = edge or layers(steel(0.66), (lambda s: np.abs(s.z - at[2]) < width * 0.2, iron(0.4, 0.0)))
    blade = tube(
        [at + [1.8, 0, 0], at + [length * 0.5, 0, 0], at + [length - 2.6, 0, 0]],
        [(width, 0.4), (width * 0.86, 0.34), (width * 0.7, 0.26)],
        paint,
        bone,
        up=(0, 0, 1),
        section=np.array([(0, 1), (-1, 0), (0, -1), (1, 0), (0, 1.0)]),
        caps=(None, 2.8),
        detail=0.9,
    )
    return [grip, guard, blade]


def armour(
    s: Skeleton, b: humanoid.Build, plate: Painter, under: Painter, trim: Painter, cloth: Painter
) -> list[Patch]:
    k = b.leg / 21.0
    hip = s.rest["hips"][2]
    waist = band("z", hip - 0.6 * k, hip + 1.4 * k)
    chest_ridge = lambda t: (np.abs(t.y) < 0.45 * k) & (t.x > 0)
    rings = [
        (0.0, 0, 4.1, 5.2),
        (2.6, 0.1, 3.8, 4.6),
        (6.0, 0.4, 5.0, 5.8),
        (11.0, 0.6, 6.0, 7.2),
        (14.8, 0.0, 5.0, 6.8),
        (17.6, -0.2, 3.4, 4.0),
    ]
    trunk = bodies.trunk(
        s,
        [tuple(v * k for v in ring) for ring in rings],
        layers(
            plate,
            (band("z", hip + 1.4 * k, hip + 4.6 * k), under),
            (waist, leather(0.34, "ochre")),
            (chest_ridge, trim),
        ),
        10,
        caps=(None, None),
    )
    skirt = bodies.skirt(
        s,
        [tuple(v * k for v in ring) for ring in ((0.4, 0, 4.2, 5.3), (-3.4, 0, 5.0, 6.3), (-7.2, 0, 5.4, 6.9))],
        layers(cloth, (band("v", 0.88, 1.1), trim)),
        10,
    )
    arm = bodies.arm(
        s,
        [r * k for r in (2.3, 2.5, 2.2, 2.3, 2.5, 2.6, 2.0)],
        layers(under, (band("v", 0.56, 0.96), plate), (band("v", 0.92, 1.0), trim)),
    )
    leg = bodies.leg(
        s,
        [r * k for r in (3.2, 3.2, 2.8, 3.0, 2.8, 2.9, 2.3)],
        layers(under, (band("v", 0.42, 0.56), trim), (band("v", 0.56, 1.1), plate)),
    )
    pad = lathe(
        [(h * k, r * k) for h, r in ((-1.8, 3.4), (-1.2, 3.5), (0.6, 2.9), (1.8, 1.5))],
        layers(plate, (band("v", 0.0, 0.22), trim)),
        {"upper_l": 0.55, "chest": 0.45},
        s.rest["upper_l"] + np.array([0, 0.9, 0.4]) * k,
        (0, 0.45, 1),
        8,
        caps=(None, 0.3),
    )
    foot = bodies.boot(
        s,
        layers(plate, (lambda t: t.x > s.rest["foot_l"][0] + 3.2 * k, trim)),
        8.4 * k,
        2.3 * k,
        4.4 * k,
        2.6 * k,
        sides=6,
    )
    return [trunk, skirt] + both(arm, leg, pad, foot, *bodies.mitt(s, under, 0.95 * k))


def blow(up, down, tilt, end, yaw=(-30, 34), lunge: float = 0.14) -> tuple[dict, dict]:
    return (
        {
            "chest": (-12, yaw[0], 0),
            "hand_r": up,
            "grip": tilt,
            "root": (-0.06, 0, -0.05),
            "head": (0, -yaw[0] * 0.6, 0),
        },
        {
            "chest": (20, yaw[1], 0),
            "hand_r": down,
            "grip": end,
            "root": (lunge, 0, -0.14),
            "head": (-10, -yaw[1] * 0.5, 0),
            "foot_r": (0.2, -0.1, 0),
        },
    )


OVER = blow((0.25, -0.05, 0.7), (0.86, 0.3, -0.35), (-135, 0, 0), (38, 6, 0), (-14, 14))
ACROSS = blow((0.1, -0.8, 0.2), (0.75, 0.6, -0.15), (-40, -80, -60), (6, 70, 70))


def _knight_clips() -> dict:
    n = lengths("knight")
    run = dict(lift=0.26, stance=0.265, offset=-0.95 / 8, drop=0.13, bob=0.04, lean=14)
    kneel = {
        "root": (0, 0, -0.42),
        "foot_l": (0.28, 0.08, 0),
        "foot_r": (-0.42, -0.08, 0.08),
        "toe_r": (60, 0),
        "chest": (16, 0, 0),
        "head": (26, 0, 0),
        "grip": (70, 0, 0),
        "hand_r": (0.65, 0.3, -0.5),
        "hand_l": (0.6, -0.3, -0.45),
    }
    return {
        "stand": moves.stand(n["stand"], READY),
        "runb": moves.gait(BODY, PACES["knight"]["runb"], READY, **run),
        "runattack": moves.charge(
            BODY,
            [20.0] * n["runattack"],
            READY,
            {
                share: {k: v for k, v in key.items() if k not in ("root", "foot_r")}
                for share, key in {
                    0.25: OVER[0],
                    0.42: OVER[0],
                    0.6: OVER[1],
                    0.76: OVER[1],
                    1.0: {**READY, "chest": (4, 0, 0), "head": (-4, 0, 0)},
                }.items()
            },
            **run,
        ),
        "pain": moves.hit(n["pain"], READY),
        "painb": moves.hit(
            n["painb"],
            READY,
            (-20, 40, 0),
            (-16, 20, 8),
            0.12,
            0.16,
            {"hand_r": (0.2, -0.8, 0.1), "hand_l": (0.5, 0.1, 0.1)},
        ),
        "attackb": moves.acted(
            n["attackb"], READY, {0.25: ACROSS[0], 0.4: ACROSS[0], 0.58: ACROSS[1], 0.72: ACROSS[1]}
        ),
        "walk": moves.gait(BODY, PACES["knight"]["walk"], READY, lift=0.12, stance=0.54, drop=0.09),
        "kneel": moves.acted(n["kneel"], READY, {1.0: kneel}),
        "standing": moves.acted(n["standing"], READY, {0.0: kneel}),
        "death": moves.fall_back(BODY, n["death"], READY),
        "deathb": moves.fall_front(BODY, n["deathb"], READY),
    }


def knight() -> Mdl:
    s = humanoid.bones(BODY)
    mail = layers(iron(0.5, 0.1), (rib("z", 1.0, 0.4), iron(0.34, 0.1)))
    patches = (
        armour(s, BODY, PLATE, mail, copper(0.08), canvas(0.45, "coral"))
        + lantern_helm(s.rest["head"] + np.array([0.4, 0, 4.0]))
        + sword(s.rest["weapon"], "weapon")
    )
    return humanoid_model("knight", BODY, s, patches, _knight_clips(), READY, skin=(256, 200))


MODELS = {"knight": knight, "h_knight": lambda: severed(lantern_helm((0, 0, 4.4), "root"), 3.0)}
