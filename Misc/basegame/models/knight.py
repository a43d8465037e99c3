"""The knights: empty armour that a light has moved into. The knight is verdigris plate with a lantern for a helm; the
hell knight is black iron under a crown of candles."""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.conventions import lengths
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import merge
from models.kit.paint import Painter, band, both_of, canvas, copper, glow, iron, layers, leather, magma, plain, rib, rivets, steel, wax, where
from models.kit.shapes import Patch, both, box, ellipsoid, flat_section, lathe, moved, torus, tube
from models.kit.skeleton import Skeleton
from models.soldier import severed

BODY = humanoid.Build(shoulder=(-0.3, 7.4, 7.0), upper=8.2, lower=8.2)
TALL = humanoid.grown(humanoid.Build(shoulder=(-0.3, 8.0, 7.2), upper=8.4, lower=8.4), 1.17)
PLATE = copper(0.86, 4.0, 21)
READY = {"hand_r": (0.42, 0.04, -0.6), "hand_l": (0.25, 0.25, -0.75), "hold": 0, "grip": (-40, 14, 0), "elbow_r": 25, "elbow_l": 20}
TWO = {"hand_r": (0.48, 0.2, -0.52), "hand_l": (0.4, 0.1, -0.6), "hold": 1, "grip": (-52, 18, 0), "elbow_r": 25, "elbow_l": 25}


def lantern_helm(at, bone: str = "head", size: float = 1.0) -> list[Patch]:
    """A barrel helm whose slits show the flame within, with a lantern's cap and ring."""
    x, y, z = at
    k = size
    slit = lambda s: (np.abs(((s.u * 12.0) % 1.0) - 0.5) < 0.2) & (s.z > z - 1.6 * k) & (s.z < z + 1.7 * k) & (s.x > x + 0.5 * k)
    barrel = lathe([(h * k, r * k) for h, r in ((-4.4, 3.6), (-4.0, 4.2), (-2.2, 4.1), (2.2, 3.9), (2.6, 4.5), (3.2, 4.4))],
                   layers(PLATE, (band("v", 0.0, 0.14), copper(0.1)), (band("v", 0.84, 1.1), copper(0.1)), (slit, glow("fire", 0.85, 0.25, 1.5))), bone, at, sides=12, caps=(0, None))
    cap = lathe([(h * k, r * k) for h, r in ((3.2, 4.4), (4.6, 2.6), (5.4, 1.6), (6.0, 1.7), (6.6, 0.9))], layers(PLATE, (rivets(12, 6, 0.2), copper(0.0))), bone, at, sides=10, caps=(None, 0.2))
    ring = torus((x, y, z + 7.6 * k), (1, 0, 0), 1.1 * k, 0.3 * k, copper(0.1), bone, 8, 4, detail=0.5)
    return [barrel, cap, ring]


def sword(at, bone: str, length: float = 22.0, width: float = 1.7, edge: Painter | None = None) -> list[Patch]:
    at = np.asarray(at, float)
    grip = lathe([(-3.4, 0.9), (-2.6, 1.0), (-2.2, 0.55), (1.6, 0.6)], where(band("v", 0.0, 0.34), copper(0.1), layers(leather(0.3), (rib("x", 0.9, 0.3), leather(0.5)))), bone, at, (1, 0, 0), 6, caps=(0.3, None), detail=0.7)
    guard = tube([at + [2.0, 0, -3.6], at + [1.6, 0, -1.6], at + [1.6, 0, 1.6], at + [2.0, 0, 3.6]], [0.4, 0.6, 0.6, 0.4], copper(0.3), bone, 5, up=(1, 0, 0), caps=(0.3, 0.3), detail=0.6)
    paint = edge or layers(steel(0.66), (lambda s: np.abs(s.z - at[2]) < width * 0.2, iron(0.4, 0.0)))
    blade = tube([at + [1.8, 0, 0], at + [length * 0.5, 0, 0], at + [length - 2.6, 0, 0]], [(width, 0.4), (width * 0.86, 0.34), (width * 0.7, 0.26)], paint, bone, up=(0, 0, 1),
                 section=np.array([(0, 1), (-1, 0), (0, -1), (1, 0), (0, 1.0)]), caps=(None, 2.8), detail=0.9)
    return [grip, guard, blade]


def _armour(s: Skeleton, b: humanoid.Build, plate: Painter, under: Painter, trim: Painter, cloth: Painter) -> list[Patch]:
    k = b.leg / 21.0
    hip = s.rest["hips"][2]
    waist = band("z", hip - 0.6 * k, hip + 1.4 * k)
    chest_ridge = lambda t: (np.abs(t.y) < 0.45 * k) & (t.x > 0)
    rings = [(0.0, 0, 4.1, 5.2), (2.6, 0.1, 3.8, 4.6), (6.0, 0.4, 5.0, 5.8), (11.0, 0.6, 6.0, 7.2), (14.8, 0.0, 5.0, 6.8), (17.6, -0.2, 3.4, 4.0)]
    trunk = bodies.trunk(s, [tuple(v * k for v in ring) for ring in rings], layers(plate, (band("z", hip + 1.4 * k, hip + 4.6 * k), under), (waist, leather(0.34, "ochre")), (chest_ridge, trim)), 10, caps=(None, None))
    skirt = bodies.skirt(s, [tuple(v * k for v in ring) for ring in ((0.4, 0, 4.2, 5.3), (-3.4, 0, 5.0, 6.3), (-7.2, 0, 5.4, 6.9))], layers(cloth, (band("v", 0.88, 1.1), trim)), 10)
    arm = bodies.arm(s, [r * k for r in (2.3, 2.5, 2.2, 2.3, 2.5, 2.6, 2.0)], layers(under, (band("v", 0.56, 0.96), plate), (band("v", 0.92, 1.0), trim)))
    leg = bodies.leg(s, [r * k for r in (3.2, 3.2, 2.8, 3.0, 2.8, 2.9, 2.3)], layers(under, (band("v", 0.42, 0.56), trim), (band("v", 0.56, 1.1), plate)))
    pad = lathe([(h * k, r * k) for h, r in ((-1.8, 3.4), (-1.2, 3.5), (0.6, 2.9), (1.8, 1.5))], layers(plate, (band("v", 0.0, 0.22), trim)), {"upper_l": 0.55, "chest": 0.45}, s.rest["upper_l"] + np.array([0, 0.9, 0.4]) * k,
                (0, 0.45, 1), 8, caps=(None, 0.3))
    foot = bodies.boot(s, layers(plate, (lambda t: t.x > s.rest["foot_l"][0] + 3.2 * k, trim)), 8.4 * k, 2.3 * k, 4.4 * k, 2.6 * k, sides=6)
    return [trunk, skirt] + both(arm, leg, pad, foot, *bodies.mitt(s, under, 0.95 * k))


def _blow(up, down, tilt, end, yaw=(-30, 34), lunge: float = 0.14) -> tuple[dict, dict]:
    return ({"chest": (-12, yaw[0], 0), "hand_r": up, "grip": tilt, "root": (-0.06, 0, -0.05), "head": (0, -yaw[0] * 0.6, 0)},
            {"chest": (20, yaw[1], 0), "hand_r": down, "grip": end, "root": (lunge, 0, -0.14), "head": (-10, -yaw[1] * 0.5, 0), "foot_r": (0.2, -0.1, 0)})


OVER = _blow((0.25, -0.05, 0.7), (0.86, 0.3, -0.35), (-135, 0, 0), (38, 6, 0), (-14, 14))
ACROSS = _blow((0.1, -0.8, 0.2), (0.75, 0.6, -0.15), (-40, -80, -60), (6, 70, 70))


def _knight_clips() -> dict:
    n = lengths("knight")
    run = dict(stride=0.5, lift=0.26, stance=0.44, drop=0.1, bob=0.04, lean=14)
    kneel = {"root": (0, 0, -0.42), "foot_l": (0.28, 0.08, 0), "foot_r": (-0.42, -0.08, 0.08), "toe_r": (60, 0), "chest": (16, 0, 0), "head": (26, 0, 0), "grip": (70, 0, 0), "hand_r": (0.65, 0.3, -0.5), "hand_l": (0.6, -0.3, -0.45)}
    return {
        "stand": moves.stand(n["stand"], READY), "runb": moves.gait(n["runb"], READY, **run),
        "runattack": moves.charge(n["runattack"], READY, {share: {k: v for k, v in key.items() if k not in ("root", "foot_r")} for share, key in {0.25: OVER[0], 0.42: OVER[0], 0.6: OVER[1], 0.76: OVER[1], 1.0: {**READY, "chest": (4, 0, 0), "head": (-4, 0, 0)}}.items()}, cycles=1, **run),
        "pain": moves.hit(n["pain"], READY), "painb": moves.hit(n["painb"], READY, (-20, 40, 0), (-16, 20, 8), 0.12, 0.16, {"hand_r": (0.2, -0.8, 0.1), "hand_l": (0.5, 0.1, 0.1)}),
        "attackb": moves.acted(n["attackb"], READY, {0.25: ACROSS[0], 0.4: ACROSS[0], 0.58: ACROSS[1], 0.72: ACROSS[1]}),
        "walk": moves.gait(n["walk"], READY, stride=0.32, lift=0.12), "kneel": moves.acted(n["kneel"], READY, {1.0: kneel}), "standing": moves.acted(n["standing"], READY, {0.0: kneel}),
        "death": moves.fall_back(BODY, n["death"], READY), "deathb": moves.fall_front(BODY, n["deathb"], READY),
    }


def knight() -> Mdl:
    s = humanoid.bones(BODY)
    mail = layers(iron(0.5, 0.1), (rib("z", 1.0, 0.4), iron(0.34, 0.1)))
    patches = _armour(s, BODY, PLATE, mail, copper(0.08), canvas(0.45, "coral")) + lantern_helm(s.rest["head"] + np.array([0.4, 0, 4.0])) + sword(s.rest["weapon"], "weapon")
    return humanoid_model("knight", BODY, s, patches, _knight_clips(), READY, skin=(256, 200))


BLACK = iron(0.32, 0.12, 5.0, 31, "slate")


def candle_helm(at, bone: str = "head", k: float = 1.1) -> list[Patch]:
    """A black bell with a burning visor; candles stand around its rim and drip."""
    x, y, z = at
    visor = lambda s: (np.abs(s.z - z - 0.5 * k + np.abs(s.y - y) * 0.25) < 0.62 * k) & (s.x > x) & (np.abs(s.y - y) < 3.2 * k)
    mouth = lambda s: (np.abs(((s.y - y) / k * 0.9) % 1.0 - 0.5) < 0.2) & (s.z < z - 1.2 * k) & (s.z > z - 3.2 * k) & (s.x > x + 1.5 * k)
    bell = lathe([(h * k, r * k) for h, r in ((-4.8, 3.4), (-4.2, 4.2), (-1.0, 4.2), (2.2, 4.0), (2.8, 4.8), (3.4, 4.7), (4.6, 3.2))],
                 layers(BLACK, (band("z", z + 2.4 * k, z + 3.5 * k), copper(0.2)), (visor, glow("fire", 0.7, 0.3)), (mouth, glow("fire", 0.45, 0.3))), bone, at, sides=11, caps=(0, 0.6 * k))
    out = [bell]
    for i, angle in enumerate(np.radians([0, 62, 125, 180, 235, 298])):
        c, s_ = np.cos(angle) * 4.1 * k, np.sin(angle) * 4.1 * k
        tall = (2.6, 1.8, 2.2, 3.0, 2.0, 1.5)[i] * k
        out.append(lathe([(0, 0.85 * k), (0.5 * k, 0.7 * k), (tall, 0.6 * k)], wax(0.82), bone, (x + c, y + s_, z + 3.2 * k), sides=5, caps=(None, 0), detail=0.6))
        out.append(lathe([(0, 0.15 * k), (0.5 * k, 0.42 * k), (1.1 * k, 0.25 * k)], glow("fire", 0.95, 0.1), bone, (x + c, y + s_, z + 3.2 * k + tall), sides=4, caps=(0.05, 0.7 * k), detail=0.4))
    return out


def _hell_clips() -> dict:
    n = lengths("hknight")
    run = dict(stride=0.5, lift=0.24, stance=0.46, drop=0.1, bob=0.035, lean=15)
    cast = {"hold": 0, "hand_l": (0.2, 0.75, 0.55), "hand_r": (0.35, -0.3, -0.6), "chest": (-10, 24, 0), "head": (-4, -14, 0), "root": (-0.05, 0, -0.06)}
    throw = {"hold": 0, "hand_l": (0.95, -0.1, 0.05), "chest": (14, -26, 0), "head": (-8, 16, 0), "root": (0.1, 0, -0.12), "foot_l": (0.2, 0.08, 0)}
    point = {"hold": 1, "hand_r": (0.8, 0.3, 0.0), "grip": (-6, 0, 0), "chest": (6, 0, 0), "root": (0.06, 0, -0.1)}
    raised = {"hold": 1, "hand_r": (0.25, 0.2, 0.75), "grip": (-95, 0, 0), "chest": (-14, 0, 0), "head": (-10, 0, 0)}
    upper = lambda keys: {share: {k: v for k, v in key.items() if k not in ("root", "foot_r", "foot_l")} for share, key in keys.items()}
    back = {**TWO, "chest": (4, 0, 0), "head": (-4, 0, 0)}
    flow = {0.1: ACROSS[0], 0.22: ACROSS[1], 0.36: OVER[0], 0.48: OVER[1], 0.62: ACROSS[0], 0.74: ACROSS[1], 0.84: OVER[0], 0.92: OVER[1]}
    return {
        "stand": moves.stand(n["stand"], TWO), "walk": moves.gait(n["walk"], TWO, stride=0.34, lift=0.12, cycles=1), "run": moves.gait(n["run"], TWO, **run), "pain": moves.hit(n["pain"], TWO),
        "death": moves.fall_back(TALL, n["death"], TWO, 5.0), "deathb": moves.fall_front(TALL, n["deathb"], TWO, 4.8),
        "char_a": moves.charge(n["char_a"], TWO, upper({0.3: raised, 0.5: raised, 0.66: OVER[1], 0.8: OVER[1], 1.0: back}), cycles=2, **run),
        "magica": moves.acted(n["magica"], TWO, {0.35: cast, 0.5: cast, 0.66: throw, 0.8: throw}), "magicb": moves.acted(n["magicb"], TWO, {0.35: raised, 0.5: raised, 0.66: point, 0.82: point}),
        "char_b": moves.charge(n["char_b"], TWO, upper({0.0: raised, 0.5: point, 1.0: raised}), cycles=1, **run), "slice": moves.acted(n["slice"], TWO, {0.25: ACROSS[0], 0.4: ACROSS[0], 0.58: ACROSS[1], 0.75: ACROSS[1]}),
        "smash": moves.acted(n["smash"], TWO, {0.3: raised, 0.45: raised, 0.62: OVER[1], 0.78: OVER[1]}), "w_attack": moves.acted(n["w_attack"], TWO, flow),
        "magicc": moves.acted(n["magicc"], TWO, {0.3: cast, 0.46: cast, 0.6: throw, 0.8: throw}),
    }


def hknight() -> Mdl:
    s = humanoid.bones(TALL)
    at = s.rest["weapon"]
    rune = layers(iron(0.3, 0.0), (lambda t: np.abs(t.z - at[2]) > 1.3, steel(0.7)), (lambda t: (np.abs(t.z - at[2]) < 0.6) & ((t.x - at[0]) % 3.2 < 1.9) & (t.x < at[0] + 24), glow("fire", 0.6, 0.3)))
    cloak = tube([(-5.6, 0, s.rest["upper_l"][2] + 1.0), (-7.6, 0, s.rest["chest"][2]), (-8.6, 0, s.rest["hips"][2] - 4.0), (-10.4, 0, s.rest["hips"][2] - 15.0)], [(0.5, 7.4), (0.6, 8.4), (0.6, 9.4), (0.5, 10.6)],
                 layers(canvas(0.5, "red"), (band("v", 0.93, 1.1), copper(0.2)), (lambda t: np.abs(t.y) < 0.6, plain("red", 0.3))), ["chest", {"chest": 0.6, "hips": 0.4}, {"hips": 0.8, "thigh_l": 0.1, "thigh_r": 0.1}, {"hips": 0.6, "thigh_l": 0.2, "thigh_r": 0.2}], 6, detail=0.6)
    patches = _armour(s, TALL, BLACK, layers(iron(0.44, 0.1), (rib("z", 1.0, 0.4), iron(0.26, 0.1))), copper(0.15), canvas(0.45, "red"))
    patches += candle_helm(s.rest["head"] + np.array([0.4, 0, 4.6])) + sword(at, "weapon", 30.0, 2.3, rune) + [cloak]
    return humanoid_model("hknight", TALL, s, patches, _hell_clips(), TWO, (-2.6, 0, 0), skin=(296, 216))


MODELS = {"knight": knight, "hknight": hknight, "h_knight": lambda: severed(lantern_helm((0, 0, 4.4), "root"), 3.0), "h_hellkn": lambda: severed(candle_helm((0, 0, 5.0), "root"), 3.2)}
