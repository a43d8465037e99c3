"""Motion as numbers over time: a clip gives each control an array (frames, k). Ten frames are a second.

Keys are interpolated by monotone cubics (Fritsch and Carlson 1980), which never overshoot a key: what stands still
between two equal keys stays still.
"""

from __future__ import annotations

import numpy as np

Clip = dict[str, np.ndarray]


def _slopes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    step = np.diff(x)
    secant = np.diff(y, axis=0) / step[:, None]
    slope = np.zeros_like(y)
    if len(x) == 2:
        slope[:] = secant[0]
        return slope
    same = secant[:-1] * secant[1:] > 0
    w1, w2 = (2 * step[1:] + step[:-1])[:, None], (step[1:] + 2 * step[:-1])[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = (w1 + w2) / (w1 / secant[:-1] + w2 / secant[1:])
    slope[1:-1] = np.where(same, inner, 0.0)
    slope[0], slope[-1] = secant[0], secant[-1]
    return slope


def spline(times: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values (n, k) of `times` (n) at `at` (m), (m, k); constant outside."""
    if len(times) == 1:
        return np.repeat(values, len(at), axis=0)
    at = np.clip(at, times[0], times[-1])
    i = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    width = times[i + 1] - times[i]
    f = ((at - times[i]) / width)[:, None]
    slope = _slopes(times, values)
    a, b, m, n = values[i], values[i + 1], slope[i] * width[:, None], slope[i + 1] * width[:, None]
    return a * (1 + 2 * f) * (1 - f) ** 2 + m * f * (1 - f) ** 2 + b * f * f * (3 - 2 * f) + n * f * f * (f - 1)


def keyed(count: int, keys: dict[float, dict], loop: bool = False, start: dict | None = None) -> Clip:
    """`count` frames through `keys`: frame -> control -> numbers. `start` is a key at frame 0 for what has none there.

    A looping clip comes back to its first key at frame `count`.
    """
    tracks: dict[str, dict[float, np.ndarray]] = {}
    for frame in sorted(keys):
        for control, value in keys[frame].items():
            tracks.setdefault(control, {})[float(frame)] = np.atleast_1d(np.asarray(value, float))
    for control, value in (start or {}).items():
        tracks.setdefault(control, {}).setdefault(0.0, np.atleast_1d(np.asarray(value, float)))
    clip = {}
    for control, track in tracks.items():
        times = sorted(track)
        values = [track[t] for t in times]
        if loop:
            period = [t + k * count for k in (-1, 0, 1) for t in times]
            clip[control] = spline(np.array(period), np.array(values * 3), np.arange(count, dtype=float))
        else:
            clip[control] = spline(np.array(times), np.array(values), np.arange(count, dtype=float))
    return clip


def cycle(count: int, offset: float = 0.0) -> np.ndarray:
    """Phases 0..1 of a loop's frames (count)."""
    return (np.arange(count) / count + offset) % 1.0


def sway(count: int, center, amount, offset: float = 0.0, times: int = 1) -> np.ndarray:
    """A looping sine about `center` by `amount` (k numbers each), `times` a loop: (count, k)."""
    wave = np.sin(2.0 * np.pi * (cycle(count) * times + offset))[:, None]
    return np.atleast_1d(center) + wave * np.atleast_1d(amount)


def merge(*clips: Clip) -> Clip:
    """Later clips' controls replace earlier ones'."""
    out: Clip = {}
    for clip in clips:
        out.update(clip)
    return out


def joined(base: dict, clips: list[tuple[Clip, int]]) -> Clip:
    """Clips one after the other (each with its length); a control that a clip lacks keeps its value in `base`."""
    total = sum(count for _, count in clips)
    out = {name: np.repeat(np.atleast_2d(np.asarray(value, float)), total, axis=0) for name, value in base.items()}
    at = 0
    for clip, count in clips:
        for name, values in clip.items():
            if name not in out:
                raise KeyError(f"a clip moves {name!r}, which the body does not have")
            out[name][at : at + count] = values
        at += count
    return out
