"""Rooms: reverberation as a noise that dies away, sooner at high frequencies, folded with the sound."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from sounds.kit.filters import fast_length
from sounds.kit.waves import RATE, generator, samples

BANDS = (120.0, 400.0, 1200.0, 3600.0, 8000.0)  # Hz, middles of the bands that die at their own rates


@lru_cache(maxsize=32)
def impulse_response(t60: float, damping: float, side: int = 0) -> np.ndarray:
    """(n,) of a room that is silent after t60 seconds at 400 Hz. damping: how much sooner high tones are (0..1)."""
    g = generator(f"room {t60} {damping} {side}")
    n = samples(1.1 * t60)
    t = np.arange(n) / RATE
    spectrum = np.fft.rfft(g.standard_normal(n))
    octave = np.log2(np.maximum(np.fft.rfftfreq(n, 1.0 / RATE), 20.0) / 400.0)
    out = np.zeros(n)
    for centre in BANDS:
        o = np.log2(centre / 400.0)
        band = np.exp(-0.5 * ((octave - o) / 0.9) ** 2)
        out += np.fft.irfft(spectrum * band, n) * np.exp(-6.91 * t / (t60 * 2.0 ** (-damping * max(0.0, o))))
    out *= np.minimum(1.0, t / 0.012)
    for k in range(7):  # first echoes of near walls
        at = samples(0.007 + 0.006 * k + 0.004 * g.random())
        if at < n:
            out[at] += g.choice([-1.0, 1.0]) * 2.5 * 0.75**k
    return out / np.sqrt(np.sum(out * out))


def room(
    x: np.ndarray, t60: float = 0.8, mix: float = 0.2, damping: float = 0.4, tail: bool = True, side: int = 0
) -> np.ndarray:
    """x with the room's answer, mix of its strength; longer by the tail unless told not to."""
    response = impulse_response(t60, damping, side)
    n = len(x) + (len(response) if tail else 0)
    size = fast_length(len(x) + len(response))
    wet = np.fft.irfft(np.fft.rfft(x, size) * np.fft.rfft(response, size), size)[:n]
    wet *= mix
    wet[: len(x)] += x
    return wet


def fold_long(x: np.ndarray, response: np.ndarray, size: int = 1 << 18) -> np.ndarray:
    """x folded with a response, as long as x: by blocks that fit a cache, for signals of minutes."""
    step = size - len(response) + 1
    spectrum = np.fft.rfft(response, size)
    out = np.zeros(len(x) + size)
    for at in range(0, len(x), step):
        block = x[at : at + step]
        if np.any(block):
            out[at : at + size] += np.fft.irfft(np.fft.rfft(block, size) * spectrum, size)
    return out[: len(x)]


def room_loop(x: np.ndarray, t60: float = 0.8, mix: float = 0.2, damping: float = 0.4, side: int = 0) -> np.ndarray:
    """The same for a loop: the answer to its end is heard at its beginning."""
    response = impulse_response(t60, damping, side)
    folded = np.zeros(len(x))
    for k in range(0, len(response), len(x)):
        part = response[k : k + len(x)]
        folded[: len(part)] += part
    return x + mix * np.fft.irfft(np.fft.rfft(x) * np.fft.rfft(folded), len(x))
