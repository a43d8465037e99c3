"""Clips that humanoid bodies share: standing, walking, being hit, falling. Ten frames are a second.

`arms` are the controls of hands and grips that a clip keeps, as the body's weapon asks.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from models.kit.humanoid import GROUND, Build
from models.kit.motion import Clip, cycle, keyed, merge, sway
from models.kit.steps import foot, roll


_UPRIGHT = {name: (0.0, 0.0, 0.0) for name in ("root", "hips", "belly", "chest", "head")}


def held(arms: dict, count: int) -> Clip:
    """Controls that stay as they are."""
    return {name: np.repeat(np.atleast_2d(np.asarray(value, float)), count, axis=0) for name, value in arms.items()}


def stand(
    count: int, arms: dict, low: float = 0.03, breath: float = 1.0, look: float = 6.0, spread: float = 0.08
) -> Clip:
    """Breathing, the weight from one leg to the other, a look around."""
    root = np.concatenate(
        [sway(count, 0.02, 0.012), sway(count, 0.0, 0.015, 0.3), sway(count, -low, 0.012 * breath, 0.25)], axis=1
    )
    chest = np.concatenate([sway(count, 2.0, 2.0 * breath), sway(count, 0.0, 1.5, 0.4), sway(count, 0.0, 0.6)], axis=1)
    head = np.concatenate([sway(count, -1.0, 1.5, 0.2), sway(count, 0.0, look, 0.1), sway(count, 0.0, 1.0)], axis=1)
    feet = {"foot_l": (0.07, spread, 0.0), "foot_r": (-0.07, -spread, 0.0), "toe_l": (0, 16), "toe_r": (0, -16)}
    out = merge(held(arms, count), held(feet, count), {"root": root, "chest": chest, "head": head})
    for hand, shift in (("hand_l", 0.1), ("hand_r", 0.0)):
        if hand in arms:
            out[hand] = out[hand] + sway(count, 0.0, 0.014 * breath, shift) * [0.4, 0.0, 1.0]
    return out


def _step(b: Build, pace: Sequence[float], lift: float, stance: float, heel: float, offset: float, cycles: int):
    """An ankle's place (n, 3) in leg lengths and the foot's pitch (n)."""
    f = foot(pace, stance, offset, cycles)
    pitch, x, z = roll(f, b.ankle, b.toe, b.heel, heel)
    swing = np.where(f.down, 0.0, lift * np.sin(np.pi * f.part))
    return np.stack([(f.x + x) / b.leg, np.zeros(len(pace)), z / b.leg + swing], axis=1), pitch


def gait(
    b: Build,
    pace: Sequence[float],
    arms: dict,
    lift: float = 0.14,
    stance: float = 0.6,
    drop: float = 0.06,
    bob: float = 0.025,
    lean: float = 5.0,
    twist: float = 8.0,
    swing: float = 0.0,
    heel: float = 1.0,
    spread: float = 0.0,
    sway_side: float = 0.03,
    offset: float = 0.0,
    cycles: int = 1,
) -> Clip:
    """Walking or running in place, `cycles` times two steps in as many frames as `pace` has numbers: units that the
    rules move the body in each. `swing` lets empty hands swing by so many arm lengths."""
    count = len(pace)
    phase = (cycle(count) * cycles + offset) % 1.0
    left, pitch_l = _step(b, pace, lift, stance, heel, offset, cycles)
    right, pitch_r = _step(b, pace, lift, stance, heel, offset + 0.5, cycles)
    wave = np.cos(2 * np.pi * (phase - stance * 0.5))  # the left leg bears: 1
    double = np.cos(4 * np.pi * (phase - stance * 0.5))
    turn = np.cos(2 * np.pi * phase)  # the left foot is in front: 1
    zero = np.zeros(count)
    out = held(arms, count)
    out["root"] = np.stack([zero, sway_side * wave, -drop + bob * double], axis=1)
    out["hips"] = np.stack([lean * 0.5 + zero, -twist * turn, -2.0 * wave], axis=1)
    out["belly"] = np.stack([lean * 0.3 + zero, twist * 0.5 * turn, 1.5 * wave], axis=1)
    out["chest"] = np.stack([lean * 0.5 + 1.5 * double, twist * 1.1 * turn, 1.0 * wave], axis=1)
    out["head"] = np.stack([-lean * 0.8 - 1.5 * double, -twist * 0.6 * turn, zero], axis=1)
    out["foot_l"], out["foot_r"] = left + [0, spread, 0], right - [0, spread, 0]
    out["toe_l"] = np.stack([pitch_l, zero + 6.0], axis=1)
    out["toe_r"] = np.stack([pitch_r, zero - 6.0], axis=1)
    for hand, sign in (("hand_l", -1.0), ("hand_r", 1.0)):
        if swing:
            out[hand] = out[hand] + np.stack([swing * sign * turn, zero, 0.35 * swing * np.abs(turn)], axis=1)
        else:
            out[hand] = out[hand] + np.stack([0.02 * turn, zero, 0.015 * double], axis=1)
    return out


def scaled(count: int, keys: dict[float, dict], start: dict) -> Clip:
    """Keys at shares 0..1 of a clip; it begins as `start`."""
    return keyed(count, {share * (count - 1): controls for share, controls in keys.items()}, start=start)


def hit(
    count: int,
    arms: dict,
    chest=(-14, 20, 0),
    head=(-10, 10, 0),
    back: float = 0.06,
    drop: float = 0.08,
    hands: dict | None = None,
) -> Clip:
    """A blow: the body gives way at once and recovers."""
    feet = {"foot_l": (0.07, 0.08, 0), "foot_r": (-0.07, -0.08, 0), "toe_l": (0, 16), "toe_r": (0, -16)}
    start = {
        **arms,
        **feet,
        "root": (0, 0, -0.03),
        "chest": (0, 0, 0),
        "head": (0, 0, 0),
        "hips": (0, 0, 0),
        "belly": (0, 0, 0),
    }
    half = tuple(v * 0.5 for v in chest)
    struck = {
        "root": (-back, 0, -drop),
        "chest": chest,
        "head": head,
        "hips": tuple(v * 0.3 for v in chest),
        "belly": half,
        **(hands or {}),
    }
    return scaled(
        count,
        {
            0.0: {**start, "chest": half, "head": head},
            0.3: struck,
            0.55: {k: v for k, v in struck.items() if k != "chest"},
            1.0: start,
        },
        start,
    )


def _lying(b: Build, thick: float) -> float:
    """`root`'s height for hips `thick` units above the ground."""
    return (GROUND + thick - b.hip) / b.leg


def fall_back(b: Build, count: int, arms: dict, thick: float = 4.5, turn: float = 0.0, step: float = 0.25) -> Clip:
    """Struck from the front: a step back, knees give way, flat on the back with arms thrown out."""
    z = _lying(b, thick)
    start = {**arms, "foot_l": (0.07, 0.08, 0), "foot_r": (-0.07, -0.08, 0), "aim": 1, "loose": 0, **_UPRIGHT}
    flat = {
        "root": (-0.55, 0, z),
        "hips": (-90, turn, 0),
        "belly": (2, 0, 0),
        "chest": (4, 0, 0),
        "head": (-6, 28, 0),
        "loose": 1,
        "foot_l": (0.06, 0.22, 0.02),
        "foot_r": (0.12, -0.16, 0.1),
        "toe_l": (35, 25),
        "toe_r": (35, -25),
        "hand_l": (-0.08, 0.88, 0.3),
        "hand_r": (-0.1, -0.9, 0.15),
        "hold": 0,
        "aim": 0,
        "grip": (0, 0, 0),
        "elbow_l": 20,
        "elbow_r": 20,
    }
    return scaled(
        count,
        {
            0.14: {
                "root": (-0.08, 0, -0.06),
                "hips": (-10, 6, 0),
                "chest": (-24, -12, 0),
                "head": (20, 0, 0),
                "hand_l": (0.5, 0.5, 0.1),
                "hold": 0,
            },
            0.34: {
                "root": (-0.2, 0, -0.22),
                "hips": (-26, 4, 0),
                "chest": (-14, 6, 0),
                "head": (24, 0, 0),
                "foot_r": (-step, -0.1, 0),
                "loose": 0,
                "hand_l": (0.45, 0.75, 0.35),
                "hand_r": (0.4, -0.75, 0.2),
                "toe_l": (-10, 10),
            },
            0.56: {
                "root": (-0.42, 0, -0.66),
                "hips": (-58, turn * 0.5, 0),
                "chest": (4, 0, 0),
                "head": (26, 0, 0),
                "loose": 0.5,
                "foot_l": (0.22, 0.14, 0.05),
                "foot_r": (0.0, -0.14, 0),
                "hand_l": (0.3, 0.85, 0.5),
                "hand_r": (0.2, -0.9, 0.4),
            },
            0.74: {
                **flat,
                "root": (-0.55, 0, z + 0.05),
                "head": (8, 10, 0),
                "foot_l": (0.22, 0.2, 0.1),
                "hand_l": (0.25, 0.8, 0.55),
            },
            0.86: {**flat, "root": (-0.55, 0, z + 0.02)},
            1.0: flat,
        },
        start,
    )


def fall_front(b: Build, count: int, arms: dict, thick: float = 4.0, turn: float = 0.0) -> Clip:
    """Down on the knees, then on the face."""
    z = _lying(b, thick)
    start = {**arms, "foot_l": (0.07, 0.08, 0), "foot_r": (-0.07, -0.08, 0), "aim": 1, "loose": 0, **_UPRIGHT}
    knees = -(b.thigh + b.shin * 0.0) / b.leg + 0.28
    flat = {
        "root": (0.3, 0, z),
        "hips": (90, turn, 0),
        "belly": (-4, 0, 0),
        "chest": (-4, 0, 0),
        "head": (-16, 38, 0),
        "loose": 1,
        "foot_l": (-0.04, 0.12, 0.02),
        "foot_r": (-0.1, -0.1, 0.14),
        "toe_l": (50, 20),
        "toe_r": (50, -20),
        "hand_l": (0.14, 0.55, 0.62),
        "hand_r": (0.14, -0.72, 0.3),
        "hold": 0,
        "aim": 0,
        "grip": (0, 0, 0),
        "elbow_l": 60,
        "elbow_r": 60,
    }
    return scaled(
        count,
        {
            0.15: {
                "root": (0.02, 0, -0.12),
                "hips": (4, 0, 0),
                "chest": (26, 8, 0),
                "head": (18, 0, 0),
                "hand_l": (0.42, 0.05, -0.35),
                "hold": 0,
            },
            0.4: {
                "root": (0.1, 0, knees),
                "hips": (-8, 0, 0),
                "chest": (16, 0, 6),
                "head": (26, 0, 8),
                "foot_l": (-0.42, 0.08, 0.05),
                "foot_r": (-0.5, -0.08, 0.05),
                "toe_l": (75, 8),
                "toe_r": (75, -8),
                "loose": 0,
                "hand_l": (0.4, 0.05, -0.5),
                "hand_r": (0.25, -0.3, -0.8),
            },
            0.58: {
                "root": (0.12, 0, knees - 0.02),
                "hips": (14, 0, 0),
                "chest": (24, 0, 4),
                "head": (24, 0, 0),
                "loose": 0.1,
            },
            0.78: {
                **flat,
                "root": (0.3, 0, z + 0.06),
                "hips": (84, turn, 0),
                "foot_l": (-0.1, 0.12, 0.2),
                "head": (-26, 10, 0),
            },
            1.0: flat,
        },
        start,
    )


def fall_side(b: Build, count: int, arms: dict, thick: float = 5.5, side: float = 1.0) -> Clip:
    """Spun round by the blow, crumples on one side (`side` 1: the left)."""
    z = _lying(b, thick)
    start = {**arms, "foot_l": (0.07, 0.08, 0), "foot_r": (-0.07, -0.08, 0), "aim": 1, "loose": 0, **_UPRIGHT}
    flat = {
        "root": (-0.1, 0.35 * side, z),
        "hips": (0, 50 * side, -88 * side),
        "belly": (12, 0, 0),
        "chest": (14, 0, 0),
        "head": (16, 0, -14 * side),
        "loose": 1,
        "foot_l": (0.34, 0.0, 0.2),
        "foot_r": (0.18, 0.04, 0.34),
        "toe_l": (30, 0),
        "toe_r": (30, 0),
        "hand_l": (0.62, 0.3 * side, 0.2),
        "hand_r": (0.6, 0.2 * side, -0.4),
        "hold": 0,
        "aim": 0,
        "grip": (0, 0, 0),
    }
    return scaled(
        count,
        {
            0.16: {
                "root": (-0.03, 0, -0.1),
                "hips": (0, 24 * side, 0),
                "chest": (-8, 36 * side, 0),
                "head": (0, 30 * side, 0),
                "hold": 0,
            },
            0.4: {
                "root": (-0.08, 0.1 * side, -0.34),
                "hips": (8, 44 * side, -24 * side),
                "chest": (16, 20 * side, -8 * side),
                "head": (14, 0, 0),
                "loose": 0,
                "hand_l": (0.5, 0.3, -0.4),
                "hand_r": (0.5, -0.3, -0.4),
                "foot_l": (0.05, 0.02, 0),
            },
            0.66: {
                "root": (-0.1, 0.28 * side, z * 0.86),
                "hips": (4, 50 * side, -66 * side),
                "loose": 0.7,
                "foot_l": (0.25, 0, 0.1),
                "foot_r": (0.1, 0, 0.1),
            },
            0.8: {**flat, "head": (4, 0, 16 * side)},
            1.0: flat,
        },
        start,
    )


def acted(count: int, arms: dict, keys: dict[float, dict], low: float = 0.05, loop: bool = False) -> Clip:
    """Keys at shares 0..1 of a clip on a body that stands."""
    start = {
        **arms,
        **_UPRIGHT,
        "root": (0, 0, -low),
        "foot_l": (0.07, 0.08, 0),
        "foot_r": (-0.07, -0.08, 0),
        "toe_l": (0, 16),
        "toe_r": (0, -16),
    }
    moving = scaled(count, {1.0: start, **keys} if not loop else keys, start)
    return merge(held({k: v for k, v in start.items()}, count), moving)


def charge(b: Build, pace: Sequence[float], arms: dict, keys: dict[float, dict], **gait_options) -> Clip:
    """Keys for the upper body on legs that run."""
    start = {**arms, "chest": (4, 0, 0), "head": (-4, 0, 0)}
    return merge(gait(b, pace, arms, **gait_options), scaled(len(pace), keys, start))
