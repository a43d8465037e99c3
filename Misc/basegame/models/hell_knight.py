"""The hell knight: black iron under a crown of candles, and a blade whose runes burn."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.paint import band, canvas, copper, glow, iron, layers, plain, rib, steel, wax
from models.kit.shapes import Patch, lathe, tube
from models.knight import ACROSS, OVER, armour, sword
from models.paces import PACES
from models.soldier import severed

TALL = humanoid.grown(humanoid.Build(shoulder=(-0.3, 8.0, 7.2), upper=8.4, lower=8.4), 1.17)
TWO = {
    "hand_r": (0.48, 0.2, -0.52),
    "hand_l": (0.4, 0.1, -0.6),
    "hold": 1,
    "grip": (-52, 18, 0),
    "elbow_r": 25,
    "elbow_l": 25,
}
BLACK = iron(0.32, 0.12, 5.0, 31, "slate")


def candle_helm(at, bone: str = "head", k: float = 1.1) -> list[Patch]:
    """A black bell with a burning visor; candles stand around its rim and drip."""
    x, y, z = at
    visor = (
        lambda s: (np.abs(s.z - z - 0.5 * k + np.abs(s.y - y) * 0.25) < 0.62 * k)
        & (s.x > x)
        & (np.abs(s.y - y) < 3.2 * k)
    )
    mouth = (
        lambda s: (np.abs(((s.y - y) / k * 0.9) % 1.0 - 0.5) < 0.2)
        & (s.z < z - 1.2 * k)
        & (s.z > z - 3.2 * k)
        & (s.x > x + 1.5 * k)
    )
    bell = lathe(
        [
            (h * k, r * k)
            for h, r in ((-4.8, 3.4), (-4.2, 4.2), (-1.0, 4.2), (2.2, 4.0), (2.8, 4.8), (3.4, 4.7), (4.6, 3.2))
        ],
        layers(
            BLACK,
            (band("z", z + 2.4 * k, z + 3.5 * k), copper(0.2)),
            (visor, glow("fire", 0.7, 0.3)),
            (mouth, glow("fire", 0.45, 0.3)),
        ),
        bone,
        at,
        sides=11,
        caps=(0, 0.6 * k),
    )
    out = [bell]
    for i, angle in enumerate(np.radians([0, 62, 125, 180, 235, 298])):
        c, s_ = np.cos(angle) * 4.1 * k, np.sin(angle) * 4.1 * k
        tall = (2.6, 1.8, 2.2, 3.0, 2.0, 1.5)[i] * k
        out.append(
            lathe(
                [(0, 0.85 * k), (0.5 * k, 0.7 * k), (tall, 0.6 * k)],
                wax(0.82),
                bone,
                (x + c, y + s_, z + 3.2 * k),
                sides=5,
                caps=(None, 0),
                detail=0.6,
            )
        )
        out.append(
            lathe(
                [(0, 0.15 * k), (0.5 * k, 0.42 * k), (1.1 * k, 0.25 * k)],
                glow("fire", 0.95, 0.1),
                bone,
                (x + c, y + s_, z + 3.2 * k + tall),
                sides=4,
                caps=(0.05, 0.7 * k),
                detail=0.4,
            )
        )
    return out


def _hell_clips() -> dict:
    n = lengths("hknight")
    run = dict(lift=0.24, stance=0.19, offset=-1.55 / 8, drop=0.15, bob=0.035, lean=15)
    cast = {
        "hold": 0,
        "hand_l": (0.2, 0.75, 0.55),
        "hand_r": (0.35, -0.3, -0.6),
        "chest": (-10, 24, 0),
        "head": (-4, -14, 0),
        "root": (-0.05, 0, -0.06),
    }
    throw = {
        "hold": 0,
        "hand_l": (0.95, -0.1, 0.05),
        "chest": (14, -26, 0),
        "head": (-8, 16, 0),
        "root": (0.1, 0, -0.12),
        "foot_l": (0.2, 0.08, 0),
    }
    point = {"hold": 1, "hand_r": (0.8, 0.3, 0.0), "grip": (-6, 0, 0), "chest": (6, 0, 0), "root": (0.06, 0, -0.1)}
    raised = {"hold": 1, "hand_r": (0.25, 0.2, 0.75), "grip": (-95, 0, 0), "chest": (-14, 0, 0), "head": (-10, 0, 0)}
    upper = lambda keys: {
        share: {k: v for k, v in key.items() if k not in ("root", "foot_r", "foot_l")} for share, key in keys.items()
    }
    back = {**TWO, "chest": (4, 0, 0), "head": (-4, 0, 0)}
    flow = {
        0.1: ACROSS[0],
        0.22: ACROSS[1],
        0.36: OVER[0],
        0.48: OVER[1],
        0.62: ACROSS[0],
        0.74: ACROSS[1],
        0.84: OVER[0],
        0.92: OVER[1],
    }
    return {
        "stand": moves.stand(n["stand"], TWO),
        "walk": moves.gait(TALL, PACES["hknight"]["walk"], TWO, lift=0.12, cycles=2),
        "run": moves.gait(TALL, PACES["hknight"]["run"], TWO, **run),
        "pain": moves.hit(n["pain"], TWO),
        "death": moves.fall_back(TALL, n["death"], TWO, 5.0),
        "deathb": moves.fall_front(TALL, n["deathb"], TWO, 4.8),
        "char_a": moves.charge(
            TALL,
            PACES["hknight"]["run"] * 2,
            TWO,
            upper({0.3: raised, 0.5: raised, 0.66: OVER[1], 0.8: OVER[1], 1.0: back}),
            cycles=2,
            **run,
        ),
        "magica": moves.acted(n["magica"], TWO, {0.35: cast, 0.5: cast, 0.66: throw, 0.8: throw}),
        "magicb": moves.acted(n["magicb"], TWO, {0.35: raised, 0.5: raised, 0.66: point, 0.82: point}),
        "char_b": moves.charge(TALL, [19.0] * n["char_b"], TWO, upper({0.0: raised, 0.5: point, 1.0: raised}), **run),
        "slice": moves.acted(n["slice"], TWO, {0.25: ACROSS[0], 0.4: ACROSS[0], 0.58: ACROSS[1], 0.75: ACROSS[1]}),
        "smash": moves.acted(n["smash"], TWO, {0.3: raised, 0.45: raised, 0.62: OVER[1], 0.78: OVER[1]}),
        "w_attack": moves.acted(n["w_attack"], TWO, flow),
        "magicc": moves.acted(n["magicc"], TWO, {0.3: cast, 0.46: cast, 0.6: throw, 0.8: throw}),
    }


def hknight() -> Mdl:
    s = humanoid.bones(TALL)
    at = s.rest["weapon"]
    rune = layers(
        iron(0.3, 0.0),
        (lambda t: np.abs(t.z - at[2]) > 1.3, steel(0.7)),
        (
            lambda t: (np.abs(t.z - at[2]) < 0.6) & ((t.x - at[0]) % 3.2 < 1.9) & (t.x < at[0] + 24),
            glow("fire", 0.6, 0.3),
        ),
    )
    cloak = tube(
        [
            (-5.6, 0, s.rest["upper_l"][2] + 1.0),
            (-7.6, 0, s.rest["chest"][2]),
            (-8.6, 0, s.rest["hips"][2] - 4.0),
            (-10.4, 0, s.rest["hips"][2] - 15.0),
        ],
        [(0.5, 7.4), (0.6, 8.4), (0.6, 9.4), (0.5, 10.6)],
        layers(
            canvas(0.5, "red"), (band("v", 0.93, 1.1), copper(0.2)), (lambda t: np.abs(t.y) < 0.6, plain("red", 0.3))
        ),
        [
            "chest",
            {"chest": 0.6, "hips": 0.4},
            {"hips": 0.8, "thigh_l": 0.1, "thigh_r": 0.1},
            {"hips": 0.6, "thigh_l": 0.2, "thigh_r": 0.2},
        ],
        6,
        detail=0.6,
    )
    patches = armour(
        s,
        TALL,
        BLACK,
        layers(iron(0.44, 0.1), (rib("z", 1.0, 0.4), iron(0.26, 0.1))),
        copper(0.15),
        canvas(0.45, "red"),
    )
    patches += candle_helm(s.rest["head"] + np.array([0.4, 0, 4.6])) + sword(at, "weapon", 30.0, 2.3, rune) + [cloak]
    return humanoid_model("hknight", TALL, s, patches, _hell_clips(), TWO, (-2.6, 0, 0), skin=(296, 216))


MODELS = {"hknight": hknight, "h_hellkn": lambda: severed(candle_helm((0, 0, 5.0), "root"), 3.2)}
