"""The music's players: choir, bells, horn, drone, the pulse of the works, hammers, water; and the hall they play in.

Every player returns a mono signal (n,) at kit.waves.RATE; Hall sets it somewhere between the ears and sends a share of it
into the reverberation, which is computed once for the whole piece.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from sounds.kit.filters import highpass, lowpass, peaks, sweep
from sounds.kit.liquid import bubble
from sounds.kit.modal import BRONZE, IRON, STEEL, click, ring, strike, thud
from sounds.kit.space import fold_long, impulse_response
from sounds.kit.voice import VOWELS
from sounds.kit.waves import (
    RATE,
    coloured,
    curve,
    decay,
    drift,
    generator,
    lay,
    layers,
    loop_samples,
    samples,
    saw,
    smooth,
    unit,
    white,
)

NAMES = {"c": 0, "d": 2, "e": 4, "f": 5, "g": 7, "a": 9, "b": 11}
TABLE = 4096


def hertz(note: str) -> float:
    """The frequency of a note like d3, eb4, f#2 (a4 = 440 Hz)."""
    semitone = NAMES[note[0]] + note.count("#") - note[1:].count("b") + 12 * (int(note[-1]) + 1)
    return 440.0 * 2.0 ** ((semitone - 69) / 12)


class Hall:
    """A stereo mix of given seconds. pan: -1 left .. 1 right; send: share that the hall answers."""

    def __init__(self, seconds: float) -> None:
        self.n = samples(seconds)
        self.dry = np.zeros((2, self.n))
        self.sent = np.zeros((2, self.n))

    def add(self, x: np.ndarray, at: float, gain: float = 1.0, pan: float = 0.0, send: float = 0.3) -> None:
        angle = 0.25 * np.pi * (1.0 + pan)
        for side, weight in enumerate((np.cos(angle), np.sin(angle))):
            lay(self.dry[side], x, at, gain * weight)
            lay(self.sent[side], x, at, gain * weight * send)

    def result(self, t60: float, damping: float) -> np.ndarray:
        """(2, n) the mix with the hall's answer, each ear's of its own."""
        out = self.dry
        for side in range(2):
            out[side] += fold_long(self.sent[side], impulse_response(t60, damping, side + 1))
        return out


@lru_cache(maxsize=128)
def vowel_table(hz: float, vowel: str) -> np.ndarray:
    """(TABLE,) one turn of a sung vowel at a pitch: its harmonics as strong as the throat's formants let them be."""
    harmonics = np.arange(1, int(0.42 * RATE / hz))
    f = harmonics * hz
    weight = harmonics**-1.35
    formants = np.zeros(len(f))
    for k, (centre, gain) in enumerate(zip((*VOWELS[vowel], 3300.0), (1.0, 0.6, 0.35, 0.3))):
        width = 160.0 + 60.0 * k
        formants += gain / (1.0 + ((f - centre) / width) ** 2)
    spectrum = np.zeros(TABLE // 2 + 1, complex)
    turns = generator(f"choir {hz:.2f}").random(len(f))
    spectrum[harmonics] = weight * (formants + 0.012) * np.exp(2j * np.pi * turns)
    table = np.fft.irfft(spectrum, TABLE)
    return table / np.sqrt(np.mean(table * table))


def singer(g: np.random.Generator, hz: float, vowels: str, swell: np.ndarray) -> np.ndarray:
    """(n,) one of the choir on one note, moving through vowels, as loud as swell (n,) says."""
    n = len(swell)
    t = np.arange(n) / RATE
    rate, depth = g.uniform(4.4, 5.6), g.uniform(0.002, 0.006)
    offset = 1.0 + g.normal(0.0, 0.0035)
    wobble = depth * hz / (2.0 * np.pi * rate) * np.sin(2.0 * np.pi * (rate * t + g.random())) * np.minimum(1.0, t / 1.5)
    wander = 0.001 * hz * drift(g, n, 0.8)
    index = ((hz * offset * t + wobble + wander + g.random()) * TABLE).astype(np.int64) & (TABLE - 1)
    spots = np.linspace(0.0, 1.0, len(vowels))
    out = np.zeros(n)
    for k, vowel in enumerate(vowels):
        first, last = (int(n * spots[max(0, k - 1)]), int(n * spots[min(len(vowels) - 1, k + 1)]))
        share = np.interp(np.arange(first, last) / n, spots, np.arange(len(vowels)) == k)
        out[first:last] += share * vowel_table(hz, vowel)[index[first:last]]
    return out * swell


def choir(
    hall: Hall, g: np.random.Generator, notes: str, at: float, seconds: float, vowels: str, gain: float, singers: int = 2
) -> None:
    """A chord of notes (lowest first, left to right) that swells and fades; it overlaps the next by half."""
    n = samples(1.5 * seconds)
    swell = smooth(n, [(0.0, 0.0), (0.33, 1.0), (0.6, 0.95), (1.0, 0.0)])
    air = highpass(lowpass(coloured(g, n, -2.0), 2600.0), 500.0) * swell
    hall.add(air, at, 0.08 * gain, 0.0, 0.6)
    for k, note in enumerate(notes.split()):
        for s in range(singers):
            pan = (k / 3.0 - 0.5) * 0.9 + (s / max(1, singers - 1) - 0.5) * 0.7
            weight = gain / (1.0 + 0.18 * k)
            hall.add(
                singer(g, hertz(note), vowels, swell), at + g.uniform(0.0, 0.15), weight, float(np.clip(pan, -1, 1)), 0.55
            )


@lru_cache(maxsize=32)
def bell(note: str, seconds: float = 7.0) -> np.ndarray:
    """A cast bell, its strike tone on the note."""
    g = generator(f"bell {note}")
    hz = hertz(note)
    out = ring(g, BRONZE, hz, seconds, 4200.0, 2.0)
    tremor = 1.0 + 0.12 * np.sin(2.0 * np.pi * 0.9 * np.arange(len(out)) / RATE)  # two of its tones are never quite one
    stroke = 0.25 * click(g, 0.02, 3500.0)
    return layers(out * tremor * curve(len(out), [(0, 1), (0.8, 1), (1, 0)]), stroke)


@lru_cache(maxsize=8)
def hammer(deep: bool) -> np.ndarray:
    """A hammer on an anvil, far away."""
    g = generator(f"hammer {deep}")
    hit = strike(g, IRON if deep else STEEL, 190.0 if deep else 520.0, 1.6, 2600.0 if deep else 5200.0, 0.6, 1.6)
    return lowpass(layers(hit, 0.6 * thud(g, 0.3, 140.0, 55.0)), 3200.0)


@lru_cache(maxsize=2)
def beat() -> np.ndarray:
    """The great pump's pulse."""
    g = generator("beat")
    n = samples(0.9)
    valve = lowpass(white(g, n), 420.0) * decay(n, 0.35, 0.01)
    return layers(thud(g, 0.9, 74.0, 41.0, 0.15), 1.1 * valve)


def drone(seconds: float, roots: tuple[float, ...], dark: float) -> np.ndarray:
    """Low saws, detuned, under a filter that breathes; a circle of 19.2 s gone round as often as it takes."""
    g = generator(f"drone {roots}")
    n = loop_samples(19.2)
    out = np.zeros(n)
    for hz in roots:
        for off in (-0.12, 0.0, 0.17):
            out += saw(round((hz + off) * n / RATE) * RATE / n, n, g.random()) / hz**0.3
    points = [(k / 8, float(dark * g.uniform(0.7, 1.8))) for k in range(8)]
    out = unit(sweep(out, points + [(1.0, points[0][1])], 1.3, "low", loop=True))
    return np.resize(out, samples(seconds))


def horn(hz: float, seconds: float, g: np.random.Generator) -> np.ndarray:
    """A foghorn under water."""
    n = samples(seconds)
    tone = saw(hz * (1.0 + 0.002 * drift(g, n, 2.0)), n) + saw(1.004 * hz, n, 0.3)
    swell = smooth(n, [(0.0, 0.0), (0.25, 1.0), (0.6, 0.8), (1.0, 0.0)])
    return unit(sweep(tone, [(0.0, 140.0), (0.3, 520.0), (1.0, 160.0)], 1.2, "low")) * swell


def groan(g: np.random.Generator, seconds: float, base: float) -> np.ndarray:
    """A hull that gives: iron that slips as slowly as a low tone."""
    n = samples(seconds)
    speed = smooth(n, [(0.0, 9.0), (0.4, 34.0), (0.7, 22.0), (1.0, 6.0)]) * (1.0 + 0.2 * drift(g, n, 5.0))
    slips = np.diff(np.floor(np.cumsum(speed) / RATE), prepend=0.0) * g.uniform(0.4, 1.0, n)
    ringing = peaks(
        slips, [(base, 20.0, 4.0), (1.47 * base, 24.0, 3.0), (2.31 * base, 24.0, 2.0), (3.6 * base, 24.0, 1.0)], 0.05
    )
    return unit(lowpass(ringing, 1500.0)) * smooth(n, [(0, 0), (0.3, 1), (0.7, 0.8), (1, 0)])


def drops(hall: Hall, g: np.random.Generator, rate: float, gain: float) -> None:
    """Water that drips into the hall, rate drops a second."""
    at = 0.5
    while at < hall.n / RATE - 1.0:
        hall.add(bubble(g.uniform(0.0014, 0.0034), 0.25, 0.8), at, gain * g.uniform(0.3, 1.0), g.uniform(-0.9, 0.9), 1.2)
        at += g.exponential(1.0 / rate) + 0.2


def tide(seconds: float, g: np.random.Generator) -> np.ndarray:
    """Water that comes and goes, over and over."""
    n = loop_samples(14.0)
    wash = sweep(white(g, n), [(0, 260), (0.35, 620), (0.6, 380), (1, 260)], 0.8, loop=True)
    swell = 0.25 + 0.75 * (0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / n)) ** 1.5
    return np.resize(unit(wash * swell), samples(seconds))
