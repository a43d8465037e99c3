"""Filters by the Fourier transform: still ones with a biquad's response, and ones that move while the sound goes on.

numpy has no recursive filter, and a loop over samples in Python is a thousand times too slow. A response multiplied to the
whole spectrum does the same; where the sound loops, the transform's own periodicity keeps the seam closed.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sounds.kit.waves import RATE, Points, curve, samples, white

TAIL = samples(0.15)  # room for a filter's ringing, so that it does not come round to the beginning


def fast_length(n: int) -> int:
    """The next length that the transform is fast at."""
    best = 1 << (n - 1).bit_length()
    for factor in (9, 15, 25, 27, 45, 75, 81, 125):
        candidate = factor << max(0, (-(-n // factor) - 1).bit_length())
        if n <= candidate < best:
            best = candidate
    return best


def respond(x: np.ndarray, response: Callable[[np.ndarray], np.ndarray], loop: bool = False) -> np.ndarray:
    """x through response(frequency in Hz) -> complex gain; as long as x."""
    n = len(x) if loop else fast_length(len(x) + TAIL)
    spectrum = np.fft.rfft(x, n)
    spectrum *= response(np.fft.rfftfreq(n, 1.0 / RATE))
    return np.fft.irfft(spectrum, n)[: len(x)]


def lowpass(x: np.ndarray, cutoff: float, q: float = 0.707, order: int = 1, loop: bool = False) -> np.ndarray:
    """12 dB an octave and order."""
    return respond(x, lambda f: (1.0 / _denominator(f / cutoff, q)) ** order, loop)


def highpass(x: np.ndarray, cutoff: float, q: float = 0.707, order: int = 1, loop: bool = False) -> np.ndarray:
    return respond(x, lambda f: (-((f / cutoff) ** 2) / _denominator(f / cutoff, q)) ** order, loop)


def bandpass(x: np.ndarray, centre: float, q: float = 1.0, order: int = 1, loop: bool = False) -> np.ndarray:
    return respond(x, lambda f: (1j * f / centre / q / _denominator(f / centre, q)) ** order, loop)


def peaks(x: np.ndarray, resonances: list[tuple[float, float, float]], dry: float = 1.0, loop: bool = False) -> np.ndarray:
    """x with resonances (Hz, q, gain) added to a dry share of it."""

    def response(f: np.ndarray) -> np.ndarray:
        total = np.full(len(f), dry, complex)
        for centre, q, gain in resonances:
            total += gain * (1j * f / centre / q) / _denominator(f / centre, q)
        return total

    return respond(x, response, loop)


def comb(x: np.ndarray, delay: float, feedback: float, damping: float = 4000.0, loop: bool = False) -> np.ndarray:
    """A tube or a box of delay seconds: echoes of echoes that lose what lies above damping Hz."""

    def response(f: np.ndarray) -> np.ndarray:
        return 1.0 / (1.0 - feedback * np.exp(-2j * np.pi * f * delay) / (1.0 + 1j * f / damping))

    return respond(x, response, loop)


def _denominator(ratio: np.ndarray, q: float) -> np.ndarray:
    return 1.0 - ratio * ratio + 1j * ratio / q


def moving(
    x: np.ndarray, gains: Callable[[np.ndarray, np.ndarray], np.ndarray], frame: int = 512, loop: bool = False
) -> np.ndarray:
    """x through a filter that changes: gains(Hz (bins,), place 0..1 (frames, 1)) -> (frames, bins).

    Overlapping windows of frame samples are weighted by the gains without shifting phases. A loop's length must be a
    multiple of frame / 4.
    """
    hop, n = frame // 4, len(x)
    window = np.sin(np.pi * (np.arange(frame) + 0.5) / frame)
    if loop:
        padded = np.concatenate([x, x[: frame - hop]])
        first = 0
    else:
        padded = np.concatenate([np.zeros(frame - hop), x, np.zeros(frame + (-n) % hop)])
        first = hop - frame
    frames = np.lib.stride_tricks.sliding_window_view(padded, frame)[::hop]
    place = np.clip((first + hop * np.arange(len(frames)) + frame / 2) / n, 0.0, 1.0)
    spectrum = np.fft.rfft(frames * window, axis=1)
    spectrum *= gains(np.fft.rfftfreq(frame, 1.0 / RATE), place[:, None])
    pieces = np.fft.irfft(spectrum, frame, axis=1) * (0.5 * window)
    out = np.zeros((len(frames) + 3, hop))
    for k in range(4):
        out[k : k + len(frames)] += pieces[:, k * hop : (k + 1) * hop]
    if loop:
        out[:3] += out[-3:]
        return out[:-3].ravel()
    return out.ravel()[frame - hop : frame - hop + n]


def sweep(x: np.ndarray, centre: Points, q: float = 1.0, kind: str = "band", loop: bool = False) -> np.ndarray:
    """x through a lowpass or bandpass whose frequency goes through points (place 0..1, Hz), even in pitch."""
    at, values = np.array(centre, float).T

    def gains(f: np.ndarray, place: np.ndarray) -> np.ndarray:
        middle = np.exp(np.interp(place, at, np.log(values)))
        ratio = f / middle
        magnitude = np.abs(1.0 / _denominator(ratio, q))
        return magnitude if kind == "low" else magnitude * ratio / q

    return moving(x, gains, loop=loop)


def rush(g: np.random.Generator, seconds: float, centre: Points, level: Points, q: float = 1.5) -> np.ndarray:
    """Air that rushes: noise in a band that moves through centre (place, Hz), as loud as level (place, gain) says."""
    n = samples(seconds)
    return sweep(white(g, n), centre, q) * curve(n, level)


def drive(x: np.ndarray, amount: float) -> np.ndarray:
    """x, its peak at 1, pushed into saturation: 0 leaves it, 5 flattens it."""
    if amount <= 0.0:
        return x
    peak = np.max(np.abs(x)) or 1.0
    return np.tanh(amount * x / peak) / np.tanh(amount)
