"""The player: a diver of the drowned foundry in a copper helmet.

Shirt and trousers are rows 1 and 6 of the palette, which the game recolours, and nothing else on the body uses them.
"""

from __future__ import annotations

import numpy as np

from formats.mdl import Mdl
from models.kit import bodies, humanoid, moves
from models.kit.cast import humanoid_model
from models.kit.motion import keyed, merge
from models.kit.paint import band, both_of, canvas, copper, iron, layers, leather, plain, rivets, steel, where
from models.kit.shapes import Patch, both, box, disc, ellipsoid, flat_section, lathe, tube
from models.kit.skeleton import Skeleton
from models.paces import PLAYER
from models.soldier import severed

BODY = humanoid.Build()
GUN = {
    "hand_r": (0.42, 0.10, -0.62),
    "hand_l": (0.75, -0.1, -0.5),
    "hold": 1,
    "grip": (2, 8, 0),
    "elbow_r": 30,
    "elbow_l": 10,
    "fade": 1,
    "extra": 0,
}
AXE = {
    "hand_r": (0.5, 0.02, -0.55),
    "hand_l": (0.4, 0.18, -0.62),
    "hold": 0,
    "grip": (-62, 12, 0),
    "elbow_r": 25,
    "fade": 0,
    "extra": 1,
}
BRASS = copper(0.28, 4.0)


def helmet(
    at, size: float = 1.0, bone: str = "head", metal=BRASS, glass=None, side_windows: bool = True
) -> list[Patch]:
    """A diving bell around the head at `at`: dome, front window with a grille, side windows, collar."""
    x, y, z = at
    s = size
    glass = glass or plain("blue", 0.62, 0.1, 1.5, gloss=0.9)
    shell = lathe(
        [(h * s, r * s) for h, r in ((-4.6, 4.3), (-4.0, 5.2), (-1.8, 5.6), (0.8, 5.5), (3.0, 4.4), (4.4, 2.6))],
        layers(
            metal,
            (band("z", z - 4.3 * s, z - 3.5 * s), copper(0.7, 3.0)),
            (rivets(14, 7, 0.2), plain("ochre", 0.86, 0.05, gloss=0.7)),
        ),
        bone,
        at,
        sides=10,
        caps=(0.0, 0.7 * s),
    )
    window = lathe(
        [(0.0, 3.1 * s), (1.5 * s, 3.0 * s), (1.7 * s, 2.4 * s), (1.5 * s, 2.2 * s)],
        where(
            band("v", 0.6, 1.1),
            where(lambda t: (np.abs(t.y - y) < 0.3 * s) | (np.abs(t.z - z + 0.3 * s) < 0.3 * s), copper(0.1), glass),
            copper(0.12, 3.0),
        ),
        bone,
        (x + 4.5 * s, y, z - 0.4 * s),
        (1, 0, 0.06),
        8,
        caps=(None, 0.25 * s),
    )
    out = [shell, disc(window)]
    if side_windows:
        pane = lathe(
            [(0.0, 1.9 * s), (0.8 * s, 1.9 * s), (0.9 * s, 1.35 * s)],
            where(band("v", 0.62, 1.1), glass, copper(0.12, 3.0)),
            bone,
            (x - 0.2 * s, y + 4.9 * s, z + 0.2 * s),
            (0.1, 1, 0.1),
            6,
            caps=(None, -0.1 * s),
        )
        out += both(pane)
    return out


def _suit(skeleton: Skeleton) -> list[Patch]:
    hip = skeleton.rest["hips"][2]
    shirt = layers(
        canvas(0.62, "brown"),
        (band("z", hip + 0.2, hip + 2.0), leather(0.32)),
        (both_of(band("z", hip + 0.2, hip + 2.0), lambda s: (np.abs(s.y) < 1.2) & (s.x > 0)), steel(0.7)),
        (both_of(band("z", hip + 2.0, hip + 30), lambda s: (np.abs(np.abs(s.y) - 3.2) < 0.7)), leather(0.36)),
    )
    trousers = layers(canvas(0.4, "ember"), (band("z", -14.8, -11.2), leather(0.34)))
    trunk = bodies.trunk(
        skeleton,
        [
            (-3.0, 0, 3.0, 3.2),
            (-1.2, 0, 4.2, 5.6),
            (1.0, 0, 4.3, 5.6),
            (3.6, 0.1, 4.2, 5.3),
            (8.0, 0.3, 5.0, 6.2),
            (12.5, 0.2, 5.4, 7.0),
            (16.2, -0.2, 4.4, 6.4),
            (18.4, -0.2, 3.4, 4.0),
        ],
        where(band("z", -30.0, hip + 0.2), canvas(0.4, "ember"), shirt),
        10,
        caps=(0.5, None),
    )
    arm = bodies.arm(
        skeleton,
        [2.7, 3.0, 2.5, 2.4, 2.4, 2.3, 2.0],
        layers(canvas(0.62, "brown"), (band("v", 0.86, 1.1), leather(0.32))),
    )
    leg = bodies.leg(skeleton, [3.5, 3.8, 3.1, 2.8, 2.8, 2.9, 2.5], trousers)
    shoulder = ellipsoid(
        skeleton.rest["upper_l"] + [0, 0.3, 0.6],
        (3.3, 2.7, 2.6),
        copper(0.35, 3.0),
        {"upper_l": 0.6, "chest": 0.4},
        3,
        6,
        detail=0.9,
    )
    boots = bodies.boot(skeleton, layers(iron(0.4, 0.3), (band("z", -24.2, -22.9), steel(0.5))), 8.6, 2.6, 4.6, sides=6)
    gaiter = lathe(
        [(0.0, 2.8), (0.6, 3.2), (1.9, 2.7)],
        copper(0.3, 3.0),
        "shin_l",
        skeleton.rest["foot_l"] + [0, 0, 1.0],
        sides=6,
        caps=(None, None),
        detail=0.7,
    )
    return [trunk] + both(arm, leg, shoulder, boots, gaiter, *bodies.mitt(skeleton, leather(0.42, "ochre"), 1.0))


def _gear(skeleton: Skeleton) -> list[Patch]:
    chest, head = skeleton.rest["chest"], skeleton.rest["head"]
    collar = lathe(
        [(-2.2, 6.0), (-1.4, 6.6), (0.0, 5.8), (1.0, 5.0)],
        layers(BRASS, (rivets(8, 2, 0.3), steel(0.72))),
        "chest",
        head + [-0.2, 0, -0.6],
        sides=8,
        caps=(None, None),
        squash=1.18,
    )
    tank = lathe(
        [(-5.4, 1.2), (-4.7, 2.1), (3.6, 2.2), (5.0, 1.2)],
        layers(copper(0.5, 4.0), (band("v", 0.2, 0.3), leather(0.3)), (band("v", 0.62, 0.72), leather(0.3))),
        "chest",
        chest + [-6.4, 2.35, 2.6],
        sides=6,
        caps=(0.1, 0.3),
    )
    hose = tube(
        [head + [-5.6, 1.6, -1.2], head + [-7.6, 2.4, -1.2], chest + [-7.4, 2.6, 7.2]],
        [0.8, 0.8, 0.8],
        iron(0.3, 0.0),
        [{"head": 1}, {"head": 0.4, "chest": 0.6}, "chest"],
        5,
        up=(0, 1, 0),
        caps=(None, None),
        detail=0.6,
    )
    plate = box(
        chest + [5.3, 0, 3.4],
        (1.2, 5.0, 4.6),
        layers(iron(0.5, 0.1), (rivets(4, 3, 0.2), steel(0.75))),
        "chest",
        bevel=0.3,
        detail=0.8,
    )
    return helmet(head + np.array([0.3, 0, 4.6])) + [collar, plate, hose] + both(tank)


def _gun(skeleton: Skeleton) -> list[Patch]:
    at = skeleton.rest["weapon"]
    barrel = lathe(
        [(-3.0, 1.0), (-2.6, 1.6), (5.0, 1.6), (5.4, 1.15), (15.0, 1.05), (15.2, 1.5), (16.8, 1.5), (17.0, 0.7)],
        layers(iron(0.46, 0.12), (band("v", 0.05, 0.4), copper(0.2, 3.0))),
        "weapon",
        at + [0, 0, 1.2],
        (1, 0, 0),
        6,
        caps=(0.1, -0.8),
    )
    stock = box(
        at + [-4.6, 0, -0.2], (2.8, 1.5, 6.4), leather(0.42, "ochre"), "weapon", (1, 0, 0.25), (0, 0, 1), detail=0.7
    )
    drum = lathe(
        [(-1.5, 1.6), (-1.2, 2.1), (1.2, 2.1), (1.5, 1.6)],
        copper(0.4, 2.0),
        "weapon",
        at + [4.0, 0, -0.8],
        (0, 1, 0),
        5,
        detail=0.8,
    )
    return [barrel, stock, drum]


def _axe(skeleton: Skeleton) -> list[Patch]:
    at = skeleton.rest["weapon"]
    shaft = tube(
        [at + [-5.0, 0, 0], at + [2.0, 0, 0], at + [12.5, 0, 0]],
        [0.65, 0.65, 0.75],
        leather(0.4, "ochre"),
        "axe",
        6,
        up=(0, 0, 1),
        detail=0.6,
    )
    blade = tube(
        [at + [10.0, 0, -0.6], at + [10.2, 0, -2.4], at + [10.2, 0, -5.6]],
        [(0.8, 1.6), (0.55, 1.9), (0.12, 4.2)],
        layers(iron(0.44, 0.2), (band("z", at[2] - 6.0, at[2] - 4.4), steel(0.78))),
        "axe",
        up=(0, 1, 0),
        section=flat_section(),
        detail=0.8,
    )
    spike = tube([at + [10.2, 0, 0.5], at + [10.2, 0, 3.8]], [0.8, 0.15], iron(0.46, 0.1), "axe", 5, detail=0.6)
    return [shaft, blade, spike]


def _attack(count: int, arms: dict, kick: float, pitch: float) -> dict:
    base = moves.stand(count, arms, 0.06, 0.0, 0.0)
    return merge(
        base,
        keyed(
            count,
            {
                0: {
                    "chest": (-kick * 6, 0, 0),
                    "root": (-0.05 * kick, 0, -0.07),
                    "hand_r": np.add(arms["hand_r"], (-0.14 * kick, 0, 0.05)),
                    "grip": (2 - pitch, 8, 0),
                },
                count
                * 0.35: {"chest": (0, 0, 0), "root": (-0.01, 0, -0.06), "hand_r": arms["hand_r"], "grip": arms["grip"]},
            },
        ),
    )


def _chop(count: int, kind: int) -> dict:
    """A blow of the axe, one of four: overhead, from the right, from the left, a low cut."""
    raised = [(0.25, -0.15, 0.75), (0.05, -0.75, 0.35), (0.45, 0.55, 0.3), (0.1, -0.6, -0.3)][kind]
    landed = [(0.85, 0.2, -0.3), (0.8, 0.45, -0.2), (0.75, -0.6, -0.25), (0.85, 0.3, 0.15)][kind]
    tilt = [(-130, 0, 0), (-60, -70, 0), (-50, 80, 0), (0, -80, 0)][kind]
    ends = [(35, 10, 0), (5, 60, 60), (10, -55, -60), (-40, 40, 30)][kind]
    yaw = [(8, -8), (-32, 34), (30, -34), (-26, 26)][kind]
    back, hit = {"chest": (-12, yaw[0], 0), "hand_r": raised, "grip": tilt, "root": (-0.05, 0, -0.04)}, {
        "chest": (20, yaw[1], 0),
        "hand_r": landed,
        "grip": ends,
        "root": (0.12, 0, -0.1),
    }
    return merge(
        moves.stand(count, AXE, 0.06, 0.0, 0.0),
        keyed(
            count,
            {
                0: back,
                1: back,
                2.4: hit,
                3.4: hit,
                count + 0.5: {"chest": (0, 0, 0), "hand_r": AXE["hand_r"], "grip": AXE["grip"], "root": (0, 0, -0.05)},
            },
        ),
    )


def _clips() -> dict:
    run = dict(lift=0.3, stance=0.16, drop=0.1, bob=0.04, lean=14, twist=10)
    return {
        "axrun": moves.gait(BODY, PLAYER, AXE, **run),
        "rockrun": moves.gait(BODY, PLAYER, GUN, **run),
        "stand": moves.stand(5, GUN),
        "axstnd": moves.stand(12, AXE),
        "axpain": moves.hit(6, AXE),
        "pain": moves.hit(6, GUN, (-16, -22, 4), (-12, -8, 0)),
        "axdeth": moves.fall_back(BODY, 9, AXE, turn=14),
        "deatha": moves.fall_back(BODY, 11, GUN),
        "deathb": moves.fall_front(BODY, 9, GUN),
        "deathc": moves.fall_side(BODY, 15, GUN),
        "deathd": moves.fall_back(BODY, 9, GUN, turn=-24, step=0.1),
        "deathe": moves.fall_side(BODY, 9, GUN, side=-1.0),
        "nailatt": _attack(2, GUN, 0.35, 2),
        "light": _attack(2, GUN, 0.25, 1),
        "rockatt": _attack(6, GUN, 1.2, 12),
        "shotatt": _attack(6, GUN, 0.9, 9),
        "axatt": _chop(6, 0),
        "axattb": _chop(6, 1),
        "axattc": _chop(6, 2),
        "axattd": _chop(6, 3),
    }


def player() -> Mdl:
    skeleton = humanoid.bones(BODY)
    skeleton.add("axe", "weapon", skeleton.rest["weapon"])
    patches = _suit(skeleton) + _gear(skeleton) + _gun(skeleton) + _axe(skeleton)
    return humanoid_model(
        "player",
        BODY,
        skeleton,
        patches,
        _clips(),
        {**GUN},
        (7.0, 0.6, 0.4),
        shrink={"axe": "extra", "weapon": "fade"},
        skin=(296, 200),
    )


def h_player() -> Mdl:
    return severed(
        [
            *helmet((0.3, 0, 4.6), bone="root"),
            lathe([(-0.6, 5.0), (0.4, 5.6), (1.4, 4.8)], BRASS, sides=10, caps=(None, None)),
        ],
        3.4,
    )


MODELS = {"player": player, "h_player": h_player}
