"""Raw material: oscillators, noise, curves, and laying one sound over another.

Signals are (n,) float64 at RATE samples a second. Everything random takes a numpy Generator, which a sound gets seeded
by its own name, so that each file is the same bytes however many others are made.
"""

from __future__ import annotations

import zlib

import numpy as np

RATE = 22050
# Lengths of loops are multiples of this, so that moving filters (filters.py) and half the sampling rate divide them.
LOOP_GRAIN = 512

Points = list[tuple[float, float]]


def generator(name: str) -> np.random.Generator:
    return np.random.Generator(np.random.PCG64(zlib.crc32(name.encode())))


def samples(seconds: float) -> int:
    return int(round(seconds * RATE))


def loop_samples(seconds: float) -> int:
    return max(1, round(seconds * RATE / LOOP_GRAIN)) * LOOP_GRAIN


def times(n: int) -> np.ndarray:
    """(n,) seconds."""
    return np.arange(n) / RATE


def curve(n: int, points: Points, exponential: bool = False) -> np.ndarray:
    """(n,) values through points (place 0..1, value), straight lines between them, or straight in the logarithm."""
    at, values = np.array(points, float).T
    u = np.linspace(0.0, 1.0, n)
    return np.exp(np.interp(u, at, np.log(values))) if exponential else np.interp(u, at, values)


def smooth(n: int, points: Points) -> np.ndarray:
    """(n,) values through points (place 0..1, value) without corners at them."""
    at, values = np.array(points, float).T
    u = np.linspace(0.0, 1.0, n)
    k = np.clip(np.searchsorted(at, u, side="right") - 1, 0, len(at) - 2)
    x = np.clip((u - at[k]) / (at[k + 1] - at[k]), 0.0, 1.0)
    return values[k] + (values[k + 1] - values[k]) * x * x * (3.0 - 2.0 * x)


def decay(n: int, t60: float, attack: float = 0.001) -> np.ndarray:
    """(n,) an envelope that rises within attack seconds and falls by 60 dB in t60 seconds."""
    t = times(n)
    return np.minimum(1.0, t / attack) * np.exp(-6.91 * np.maximum(t - attack, 0.0) / t60)


def phase_of(frequency: float | np.ndarray, n: int) -> np.ndarray:
    """(n,) turns since the start, of a frequency in Hz that may change."""
    if np.ndim(frequency) == 0:
        return times(n) * float(frequency)
    return np.concatenate([[0.0], np.cumsum(frequency[: n - 1])]) / RATE


def sine(frequency: float | np.ndarray, n: int, turn: float = 0.0) -> np.ndarray:
    return np.sin(2.0 * np.pi * (phase_of(frequency, n) + turn))


def saw(frequency: float | np.ndarray, n: int, turn: float = 0.0) -> np.ndarray:
    """A falling saw whose step is rounded over one sample on either side (polyBLEP), which keeps aliases low."""
    step = np.broadcast_to(np.asarray(frequency, float) / RATE, (n,))
    p = (phase_of(frequency, n) + turn) % 1.0
    out = 1.0 - 2.0 * p
    low, high = p < step, p > 1.0 - step
    x = p[low] / step[low]
    out[low] -= (1.0 - x) ** 2
    x = (p[high] - 1.0) / step[high]
    out[high] += (1.0 + x) ** 2
    return out


def pulse(frequency: float | np.ndarray, n: int, width: float = 0.5) -> np.ndarray:
    """A rectangle: the difference of two saws, so without a mean."""
    return 0.5 * (saw(frequency, n) - saw(frequency, n, 1.0 - width))


def fm(carrier: float | np.ndarray, ratio: float, index: float | np.ndarray, n: int) -> np.ndarray:
    """Frequency modulation: a sine whose phase another of ratio times its frequency shifts by index radians."""
    p = 2.0 * np.pi * phase_of(carrier, n)
    return np.sin(p + index * np.sin(ratio * p))


def white(g: np.random.Generator, n: int) -> np.ndarray:
    return g.standard_normal(n)


def coloured(g: np.random.Generator, n: int, slope: float = -3.0) -> np.ndarray:
    """(n,) noise that falls by slope dB an octave (-3: pink, -6: brown) above 20 Hz, of variance 1, periodic in n."""
    spectrum = np.fft.rfft(g.standard_normal(n))
    f = np.maximum(np.fft.rfftfreq(n, 1.0 / RATE), 20.0)
    spectrum *= f ** (slope / 6.0206)
    spectrum[0] = 0.0
    out = np.fft.irfft(spectrum, n)
    return out / np.std(out)


def drift(g: np.random.Generator, n: int, rate: float, loop: bool = False) -> np.ndarray:
    """(n,) a slow random wander in -1..1, about rate turns a second; periodic in n where it loops."""
    count = max(2, int(round(n / RATE * rate)) + 1)
    knots = g.uniform(-1.0, 1.0, count + 1)
    if loop:
        knots[-1] = knots[0]
    x = np.arange(n) * (count / n)
    k = x.astype(int)
    u = x - k
    u = u * u * (3.0 - 2.0 * u)
    return knots[k] * (1.0 - u) + knots[k + 1] * u


def lay(onto: np.ndarray, x: np.ndarray, at: float, gain: float = 1.0, wrap: bool = False) -> None:
    """Adds x to onto from at seconds on: cut off at the end, or going on from the beginning where it wraps."""
    start, n = samples(at), len(onto)
    if not wrap:
        x = x[: max(0, n - start)]
        onto[start : start + len(x)] += gain * x
        return
    start %= n
    while len(x):
        part = x[: n - start]
        onto[start : start + len(part)] += gain * part
        x, start = x[len(part) :], 0


def layers(*parts: np.ndarray) -> np.ndarray:
    """The sum of sounds that begin together, as long as the longest."""
    out = np.zeros(max(len(p) for p in parts))
    for part in parts:
        out[: len(part)] += part
    return out


def sequence(*parts: tuple[float, np.ndarray]) -> np.ndarray:
    """The sum of sounds that begin at given seconds."""
    out = np.zeros(max(samples(at) + len(x) for at, x in parts))
    for at, x in parts:
        lay(out, x, at)
    return out


def unit(x: np.ndarray) -> np.ndarray:
    """x with its highest peak at 1."""
    peak = np.max(np.abs(x)) if len(x) else 0.0
    return x / peak if peak > 0.0 else x
