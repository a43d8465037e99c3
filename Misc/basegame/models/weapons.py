"""Weapons as the player sees them (the eye is the origin) and as they lie on the ground, turning."""

from __future__ import annotations

import numpy as np

from formats.mdl import ROTATE, Mdl
from models import arsenal, arsenal_heavy
from models.conventions import frame_names
from models.kit.figure import build
from models.kit.motion import keyed
from models.kit.paint import band, canvas, copper, layers, leather
from models.kit.shapes import Patch, ellipsoid, moved, tube
from models.kit.skeleton import Posing, Skeleton
from models.kit.turn import euler

HOLD = (14.5, -4.8, -9.4)  # of the grip from the eye
SIZE = 0.8  # of a weapon in the hand against the one in `arsenal`
AIM = (-3.0, 6.0, 0.0)  # the weapon's turn: its muzzle towards the middle


def _view(
    name: str,
    patches: list[Patch],
    bones: dict[str, tuple[float, float, float]],
    kick: np.ndarray,
    moves: dict | None = None,
    hold=HOLD,
    aim=AIM,
    flashes: dict[str, np.ndarray] | None = None,
) -> Mdl:
    """A weapon's model: `patches` on the bone `gun` and on `bones` (name -> place) that hang on it.

    `kick` (frames, 2): units back and degrees up. `moves`: bone -> (shift (F, 3), turn (F, 3));
    `flashes`: bone -> size (F).
    """
    names = frame_names(name)
    skeleton = Skeleton({"root": ("", (0, 0, 0)), "gun": ("root", (0, 0, 0))})
    for bone, at in bones.items():
        skeleton.add(bone, "gun", at)
    posing = Posing(skeleton, len(names))
    shift = np.stack([-kick[:, 0], np.zeros(len(names)), kick[:, 0] * 0.15], axis=1) + np.asarray(hold)
    turn = euler(np.asarray(aim) + np.stack([-kick[:, 1], np.zeros(len(names)), np.zeros(len(names))], axis=1))
    posing.place("gun", turn * SIZE, shift)
    for bone, (slide, angles) in (moves or {}).items():
        posing.turn(bone, angles, shift=slide)
    for bone, size in (flashes or {}).items():
        posing.turn(bone, matrix=np.eye(3) * np.clip(size, 0.02, 2.0)[:, None, None])
    return build(patches, posing, names, skin=(320, 200))


def _track(count: int, keys: dict[float, float | tuple]) -> np.ndarray:
    return keyed(count, {at: {"a": value} for at, value in keys.items()})["a"]


def _flash(count: int, **at: float) -> np.ndarray:
    out = np.zeros(count)
    for frame, size in at.items():
        out[int(frame[1:])] = size
    return out


def glove(at, out=(-8.0, -5.0, -6.0), size: float = 1.0, bone: str = "gun") -> list[Patch]:
    """A gloved hand around a handle at `at`, its arm going off in the direction `out` (units)."""
    at, away = np.asarray(at, float), np.asarray(out, float)
    hide = leather(0.46, "ochre")
    fist = ellipsoid(at, (2.0 * size, 1.7 * size, 2.1 * size), hide, bone, 4, 8)
    knuckles = [
        ellipsoid(
            at + np.array([1.1, -0.2 + 0.0 * k, 1.3 - 0.9 * k]) * size,
            (0.95 * size, 1.75 * size, 0.6 * size),
            hide,
            bone,
            3,
            6,
            detail=0.7,
        )
        for k in range(4)
    ]
    wrist = at + away * 0.18
    arm = tube(
        [at + away * 0.05, wrist, at + away * 0.3, at + away],
        [1.5 * size, 1.7 * size, 2.4 * size, 2.8 * size],
        layers(canvas(0.6, "sand"), (band("v", 0.0, 0.2), hide), (band("v", 0.2, 0.32), copper(0.3, 2.0))),
        bone,
        8,
        up=(0, 0, 1),
        caps=(None, None),
        detail=0.7,
    )
    return [fist, *knuckles, arm]


def v_axe() -> Mdl:
    n = 9
    patches = arsenal.axe() + glove((0.0, 0, 0), (-9.0, -3.0, -7.0))
    shift = _track(
        n,
        {
            0: (0, 0, 0),
            1: (-2, -1.0, 4.5),
            2: (7, 4.5, 2.5),
            3: (6, 8, -4),
            4: (2, 2, -3),
            5: (-1, 5, 3),
            6: (7, 1, 2),
            7: (6, -6, -4),
            8: (2, -2, -3),
        },
    )
    turns = _track(
        n,
        {
            0: (-58, 18, -12),
            1: (-100, 6, -30),
            2: (-22, 34, -64),
            3: (16, 58, -82),
            4: (-30, 30, -40),
            5: (-84, 44, 40),
            6: (-18, 4, 60),
            7: (14, -34, 76),
            8: (-32, 4, 30),
        },
    )
    return _swing(patches, shift, turns)


def _swing(patches: list[Patch], shift: np.ndarray, turns: np.ndarray) -> Mdl:
    posing = Posing(Skeleton({"gun": ("", (0, 0, 0))}), len(shift))
    posing.place("gun", euler(turns) * 0.9, np.array([14.0, -6.5, -9.5]) + shift)
    return build(patches, posing, frame_names("v_axe"), skin=(320, 200))


def v_shot() -> Mdl:
    n = 8
    kick = _track(n, {0: (0, 0), 1: (3.4, 8), 2: (2.0, 5), 3: (0.6, 1), 4: (0.3, 2), 5: (0.3, 1), 6: (0, 0), 7: (0, 0)})
    pump = _track(n, {0: (0, 0, 0), 2: (0, 0, 0), 3: (-2.4, 0, 0), 4: (-3.6, 0, 0), 5: (-0.5, 0, 0), 6: (0, 0, 0)})
    patches = (
        arsenal.shotgun()
        + arsenal.flash((23.4, 0, 1.2), 1.0)
        + glove((9.2, 0.2, -2.4), (-9.0, 9.0, -9.0), 0.85, "pump")
    )
    return _view(
        "v_shot",
        patches,
        {"pump": (9.2, 0, -0.75), "flash": (22.6, 0, 1.2)},
        kick,
        {"pump": (pump, (0, 0, 0))},
        flashes={"flash": _flash(n, f1=1.0, f2=0.4)},
    )


def v_shot2() -> Mdl:
    n = 8
    kick = _track(
        n, {0: (0, 0), 1: (4.4, 12), 2: (2.6, 7), 3: (0.8, 1), 4: (0.6, -2), 5: (0.4, 0), 6: (0, 0), 7: (0, 0)}
    )
    hinge = _track(n, {0: (0, 0, 0), 2: (0, 0, 0), 3: (14, 0, 0), 4: (22, 0, 0), 5: (8, 0, 0), 6: (0, 0, 0)})
    patches = (
        arsenal.double_shotgun()
        + arsenal.flash((18.8, 0, 1.0), 1.1)
        + glove((6.6, 0.2, -2.0), (-8.0, 9.0, -9.0), 0.85, "barrels")
    )
    return _view(
        "v_shot2",
        patches,
        {"barrels": (0.6, 0, -0.2), "flash": (18.0, 0, 1.0)},
        kick,
        {"barrels": (np.zeros((n, 3)), hinge)},
        flashes={"flash": _flash(n, f1=1.0, f2=0.4)},
    )


def v_nail() -> Mdl:
    left = np.array([0, 1, 0, 1, 0, 1, 0, 1, 0.0])
    right = np.array([0, 0, 1, 0, 1, 0, 1, 0, 1.0])
    back = lambda fired: np.stack([-1.7 * fired, 0 * fired, 0 * fired], axis=1)
    kick = np.stack([0.5 * (left + right), 0.6 * (left - right) + 0.8 * (left + right)], axis=1)
    patches = (
        arsenal.nailgun()
        + arsenal.flash((18.4, 1.15, 0.7), 0.6, "flash_l")
        + arsenal.flash((18.4, -1.15, 0.7), 0.6, "flash_r")
    )
    return _view(
        "v_nail",
        patches,
        {"left": (5, 1.15, 0.7), "right": (5, -1.15, 0.7), "flash_l": (18, 1.15, 0.7), "flash_r": (18, -1.15, 0.7)},
        kick,
        {"left": (back(left), (0, 0, 0)), "right": (back(right), (0, 0, 0))},
        flashes={"flash_l": left, "flash_r": right},
    )


def v_nail2() -> Mdl:
    n = 9
    fired = np.array([0, 1, 0.7, 1, 0.7, 1, 0.7, 1, 0.7])
    # Six barrels look the same after 60 degrees: at 22.5 a frame the eight frames of the loop pass three of them.
    spin = np.stack([np.zeros(n), np.zeros(n), np.arange(n) * 22.5 - 22.5], axis=1)
    spin[0] = 0
    kick = np.stack([0.7 * fired, 0.9 * fired], axis=1)
    patches = arsenal_heavy.super_nailgun() + arsenal.flash((18.8, 0, 0.8), 1.1)
    return _view(
        "v_nail2",
        patches,
        {"barrels": (4.0, 0, 0.8), "flash": (18.0, 0, 0.8)},
        kick,
        {"barrels": (np.zeros((n, 3)), spin)},
        flashes={"flash": fired * np.array([0, 1, 0.6, 1, 0.6, 1, 0.6, 1, 0.6])},
    )


def v_rock() -> Mdl:
    n = 8
    kick = _track(n, {0: (0, 0), 1: (4.0, 9), 2: (2.6, 6), 3: (1.0, 2), 4: (0.4, 1), 6: (0, 0), 7: (0, 0)})
    drum = _track(n, {0: (0, 0, 0), 2: (0, 0, 0), 5: (0, 0, 60), 7: (0, 0, 60)})
    patches = arsenal_heavy.grenade_launcher() + arsenal.flash((13.6, 0, 0.8), 1.5)
    return _view(
        "v_rock",
        patches,
        {"drum": (0.2, 0, 0.2), "flash": (13.4, 0, 0.8)},
        kick,
        {"drum": (np.zeros((n, 3)), drum)},
        flashes={"flash": _flash(n, f1=1.0)},
    )


def v_rock2() -> Mdl:
    n = 7
    kick = _track(n, {0: (0, 0), 1: (5.0, 7), 2: (3.4, 5), 3: (1.6, 2), 4: (0.6, 1), 5: (0.2, 0), 6: (0, 0)})
    patches = arsenal_heavy.rocket_launcher() + arsenal.flash((14.2, 0, 1.2), 1.7)
    return _view(
        "v_rock2",
        patches,
        {"flash": (13.6, 0, 1.2)},
        kick,
        hold=(16.5, -6.6, -11.6),
        flashes={"flash": _flash(n, f1=1.0, f2=0.3)},
    )


def v_light() -> Mdl:
    n = 5
    fired = np.array([0, 1, 0.5, 1, 0.6])
    jar = np.stack([np.zeros(n), np.zeros(n), np.array([0, 40, 110, 200, 290.0])], axis=1)
    patches = arsenal_heavy.thunderbolt() + arsenal.flash((17.0, 0, 0.6), 0.9, "flash", "blue_glow")
    return _view(
        "v_light",
        patches,
        {"jar": (6, 0, 0.6), "flash": (16.0, 0, 0.6)},
        np.stack([fired * 0.6, fired * 0.5], axis=1),
        {"jar": (np.zeros((n, 3)), jar)},
        flashes={"flash": fired},
    )


def _ground(make) -> Mdl:
    """A weapon on the ground: half as large again, muzzle up a little, its middle over the origin."""
    tilt = euler(np.array([-24.0, 0.0, 0.0]))
    patches = [moved(p, turn=tilt, scale=1.3) for p in make()]
    for patch in patches:
        patch.bones = [{"root": 1.0}] * len(patch.bones)
    points = np.concatenate([p.grid.reshape(-1, 3) for p in patches])
    low, high = points.min(axis=0), points.max(axis=0)
    shift = -np.array([(low[0] + high[0]) / 2, 0.0, low[2] - 2.0])
    return build([moved(p, shift) for p in patches], None, ["frame1"], skin=(256, 200), flags=ROTATE)


MODELS = {
    "v_axe": v_axe,
    "v_shot": v_shot,
    "v_shot2": v_shot2,
    "v_nail": v_nail,
    "v_nail2": v_nail2,
    "v_rock": v_rock,
    "v_rock2": v_rock2,
    "v_light": v_light,
}
for _name, _make in (
    ("g_shot", arsenal.double_shotgun),
    ("g_shot1", arsenal.shotgun),
    ("g_nail", arsenal.nailgun),
    ("g_nail2", arsenal_heavy.super_nailgun),
    ("g_rock", arsenal_heavy.grenade_launcher),
    ("g_rock2", arsenal_heavy.rocket_launcher),
    ("g_light", arsenal_heavy.thunderbolt),
):
    MODELS[_name] = lambda make=_make: _ground(make)
