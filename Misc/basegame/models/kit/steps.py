"""Feet that keep to the ground: where a foot is while the rules move the body by uneven steps.

A foot that bears weight goes back under the body exactly as fast as the body goes forward, and rolls from heel to toe
about what touches the ground; then it swings to where the next stance begins.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from models.kit.motion import cycle


@dataclasses.dataclass
class Foot:
    """One foot in each of n frames."""

    down: np.ndarray  # (n) bool: it bears weight
    part: np.ndarray  # (n) 0..1 of the stance, or of the swing
    x: np.ndarray  # (n) units before the middle of its stances


def travelled(pace: Sequence[float], time: np.ndarray) -> np.ndarray:
    """How far (units) a body has gone since frame 0 at `time` (frames, any number): in the frame before n, pace[n]."""
    gone = np.concatenate([[0.0], np.cumsum(list(pace[1:]) + [pace[0]])])
    laps, rest = np.divmod(time, len(pace))
    return laps * gone[-1] + np.interp(rest, np.arange(len(gone)), gone)


def foot(pace: Sequence[float], stance: float, offset: float = 0.0, cycles: int = 1) -> Foot:
    """A foot that lands `cycles` times in the frames of `pace`, each time bearing weight for the share `stance`.
    `offset` is the share of a cycle that is over in frame 0."""
    count = len(pace)
    period = count / cycles
    phase = (cycle(count) * cycles + offset) % 1.0
    now = np.arange(count)
    landed = now - phase * period
    span = lambda start: travelled(pace, start + stance * period) - travelled(pace, start)
    b = np.clip((phase - stance) / (1.0 - stance), 0.0, 1.0)
    ease = b - np.sin(2 * np.pi * b) / (2 * np.pi) * 0.6
    left, landing = -span(landed) / 2.0, span(landed + period) / 2.0
    x = np.where(
        phase < stance,
        span(landed) / 2.0 - (travelled(pace, now) - travelled(pace, landed)),
        left + (landing - left) * ease,
    )
    return Foot(phase < stance, np.where(phase < stance, phase / stance, b), x)


def roll(
    f: Foot, ankle: float, toe: float, heel: float, rises: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """How a foot rolls: its pitch (n, degrees, toe down) and what that adds to the ankle's x and z (n, units).

    `ankle` is its height above the sole, `toe` and `heel` how far the sole's ends are before and behind it, `rises` how
    much the heel does (1: a boot's). The foot turns about the toe or, as it lands, about the heel.
    """
    rise = np.clip((f.part - 0.65) / 0.35, 0.0, 1.0)
    land = -14.0 * np.clip(1.0 - f.part * 4.0, 0.0, 1.0)
    swing = rises * (35.0 * (1.0 - f.part) + 80.0 * f.part * (1.0 - f.part) ** 2) - 14.0 * f.part
    pitch = np.where(f.down, 35.0 * rises * rise + land, swing)
    angle = np.radians(pitch)
    touch = np.where(pitch > 0, toe, -heel)
    x = touch - (touch * np.cos(angle) - ankle * np.sin(angle))
    z = touch * np.sin(angle) + ankle * np.cos(angle) - ankle
    return pitch, x, z
