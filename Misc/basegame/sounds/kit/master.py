"""The last step: from a recipe's signal to what stands in the file.

Inaudible lows and any mean go, silence at the end goes, both ends come to rest, and the loudest fifth of a second is
brought to the loudness of the sound's category. What peaks then stand out are rounded off rather than cut; a sound of a
single short click stays quieter than its category, because it would have to be rounded too far.

Loudness here is the level of the signal after a filter that hears as we do (deaf below 60 Hz, keener above 1.5 kHz, as
ITU-R BS.1770), in the loudest window of 200 ms, in dB below full scale.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from formats.wav import Wav
from sounds.kit.filters import fast_length, highpass
from sounds.kit.waves import RATE, samples

PEAK = 0.89  # -1 dB: room for the interpolation of mixers
KNEE = 0.6  # where rounding begins
MOST_ROUNDING = 1.6  # a peak may stand that far above PEAK before it is rounded
FLOOR = 10 ** (-58 / 20)  # of the peak: what counts as silence
FADE_IN, FADE_OUT = 0.0008, 0.02  # seconds


@dataclass
class Loop:
    """A sound that repeats. body: one turn, periodic; lead: laid over its first turn, before the loop begins.

    With a lead the file is the body's end, faded in over rise seconds, with the lead over it, and then the body.
    """

    body: np.ndarray
    lead: np.ndarray | None = None
    rise: float = 0.05


def hearing(f: np.ndarray) -> np.ndarray:
    """Gain of the ear at frequencies in Hz: the two filters of BS.1770 as magnitudes."""
    low = f**2 / (f**2 + 60.0**2)
    shelf = 1.0 + (10 ** (4.0 / 20) - 1.0) * f**2 / (f**2 + 1500.0**2)
    return low * shelf


def loudness(x: np.ndarray, rate: int = RATE) -> float:
    """dB below full scale of the loudest 200 ms (or of the whole, if that is shorter)."""
    n = fast_length(len(x) + int(0.1 * rate))
    heard = np.fft.irfft(np.fft.rfft(x, n) * hearing(np.fft.rfftfreq(n, 1.0 / rate)), n)
    window = min(int(0.2 * rate), len(x))
    energy = np.concatenate([[0.0], np.cumsum(heard * heard)])
    loudest = np.max(energy[window:] - energy[:-window]) / int(0.2 * rate)
    return 10.0 * np.log10(max(loudest, 1e-12))


def rounded(x: np.ndarray) -> np.ndarray:
    """x with what is above KNEE bent so that nothing passes PEAK."""
    over = np.abs(x) > KNEE
    room = PEAK - KNEE
    out = x.copy()
    out[over] = np.sign(x[over]) * (KNEE + room * np.tanh((np.abs(x[over]) - KNEE) / room))
    return out


def at_rest(x: np.ndarray) -> np.ndarray:
    """A sound that ends: without a mean, without silence before and behind, from zero to zero."""
    x = highpass(np.concatenate([np.zeros(samples(0.002)), x, np.zeros(samples(0.03))]), 28.0)
    loud = np.nonzero(np.abs(x) > FLOOR * np.max(np.abs(x)))[0]
    if len(loud):
        x = x[max(0, loud[0] - samples(FADE_IN)) : loud[-1] + samples(FADE_OUT)]
    rise, fall = min(samples(FADE_IN), len(x)), min(samples(FADE_OUT), len(x))
    x[:rise] *= np.linspace(0.0, 1.0, rise)
    x[len(x) - fall :] *= np.linspace(1.0, 0.0, fall) ** 2
    return x


def without_mean(x: np.ndarray) -> np.ndarray:
    """A sound that ends, its mean taken from where it is loud, so that its ends stay at zero."""
    weight = np.abs(x)
    total = np.sum(weight)
    return x - weight * (np.sum(x) / total) if total > 0.0 else x


def looped(loop: Loop) -> tuple[np.ndarray, int]:
    """The samples of a loop and where it begins."""
    body = highpass(loop.body, 28.0, loop=True)
    body = body - np.mean(body)
    if loop.lead is None:
        return body, 0
    lead = at_rest(loop.lead)
    intro = np.resize(body[::-1], len(lead))[::-1].copy()
    rise = min(samples(loop.rise), len(intro))
    intro[:rise] *= np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, rise)) ** 2
    return np.concatenate([intro + lead, body]), len(lead)


def half_rate(x: np.ndarray) -> np.ndarray:
    """x at half the rate, as if it went on for ever."""
    spectrum = np.fft.rfft(x)
    return np.fft.irfft(spectrum[: len(x) // 4 + 1], len(x) // 2) * 0.5


def level(x: np.ndarray, target: float, rate: int = RATE) -> np.ndarray:
    """x brought to target dB, as far as its peaks allow, and its peaks rounded."""
    gain = 10.0 ** ((target - loudness(x, rate)) / 20.0)
    gain = min(gain, MOST_ROUNDING * PEAK / max(np.max(np.abs(x)), 1e-9))
    out = rounded(gain * x)
    again = 10.0 ** ((target - loudness(out, rate)) / 20.0)  # rounding took some; give it back where there is room
    return rounded(out * min(again, 1.25))


def master(x: np.ndarray | Loop, target: float, half: bool = False) -> Wav:
    """The file of a recipe's signal. half: at half the rate, for loops of low tones that are long."""
    if isinstance(x, Loop):
        out, start = looped(x)
        rate = RATE // 2 if half else RATE
        if half:
            out, start = half_rate(out), start // 2
        out = level(out, target, rate)
        return Wav(rate, without_mean(out), start)
    if not np.any(x):
        return Wav(RATE, x)
    return Wav(RATE, without_mean(level(at_rest(x), target)))
