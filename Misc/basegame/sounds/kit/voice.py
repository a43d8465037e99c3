"""Voices: a source of pulses and breath through the resonances of a throat (Fant's source and filter).

Every creature is a Throat, which says how long it is (its formants fall by that), how hoarse, how wet; and a cry is a
course of pitch, vowels and loudness through it. Roughness is drawn for each pulse anew, as vocal folds that do not close
alike; growling is the slower flutter of what lies above them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sounds.kit.filters import drive, moving
from sounds.kit.waves import RATE, Points, curve, drift, lay, phase_of, samples, smooth, white

# The first three formants in Hz of a man's vowels (Peterson and Barney 1952); q: the neutral one, m: closed lips.
VOWELS = {
    "a": (730.0, 1090.0, 2440.0),
    "o": (570.0, 840.0, 2410.0),
    "u": (300.0, 870.0, 2240.0),
    "e": (530.0, 1840.0, 2480.0),
    "i": (270.0, 2290.0, 3010.0),
    "E": (660.0, 1720.0, 2410.0),
    "q": (500.0, 1500.0, 2500.0),
    "r": (490.0, 1350.0, 1690.0),
    "m": (250.0, 1050.0, 2200.0),
}
OPEN, CLOSING = 0.42, 0.16  # parts of a cycle in which the folds open, and close


@dataclass(frozen=True)
class Throat:
    """A voice's character. Shares are 0..1 unless said otherwise."""

    size: float = 1.0  # length, a man's being 1
    rough: float = 0.15  # how far pulses differ in strength
    jitter: float = 0.015  # how far the pitch trembles, relative
    growl: float = 0.0  # depth of the flutter
    growl_hz: float = 28.0
    breath: float = 0.08  # noise beside the pulses
    sub: float = 0.0  # how much weaker every second pulse is: an octave below
    drive: float = 0.5
    width: float = 1.0  # of formants: more is duller and more fleshy
    edge: float = 5.0  # dB an octave that shouting adds from 600 Hz to 4.5 kHz: folds that slam shut; 0 is a mumble


def source(g: np.random.Generator, pitch: np.ndarray, throat: Throat) -> np.ndarray:
    """(n,) what the folds give for a pitch (n,) in Hz: the flow's change, and breath while they are open."""
    n = len(pitch)
    wander = 0.6 * drift(g, n, 9.0) + 0.8 * drift(g, n, 45.0)
    phase = phase_of(pitch * (1.0 + throat.jitter * wander), n)
    cycle = phase.astype(int)
    p = phase - cycle
    opening = 0.5 - 0.5 * np.cos(np.pi * np.minimum(p, OPEN) / OPEN)
    closing = np.cos(0.5 * np.pi * np.clip((p - OPEN) / CLOSING, 0.0, 1.0))
    flow = np.where(p < OPEN, opening, closing)
    strength = 1.0 - throat.rough * g.random(cycle[-1] + 1)
    strength[1::2] *= 1.0 - throat.sub
    voiced = np.diff(flow * strength[cycle], prepend=0.0) * (0.25 * RATE / np.mean(pitch)) * (pitch / np.mean(pitch)) ** -0.5
    breath = throat.breath * white(g, n) * (0.25 + flow * strength[cycle])
    flutter = 0.5 + 0.5 * np.sin(2.0 * np.pi * phase_of(throat.growl_hz * (1.0 + 0.35 * drift(g, n, 6.0)), n))
    return (voiced + breath) * (1.0 - throat.growl * flutter**2)


def tract(x: np.ndarray, vowels: list[tuple[float, str]], throat: Throat) -> np.ndarray:
    """x through the throat's resonances as it forms vowels at places 0..1."""
    at = np.array([place for place, _ in vowels])
    table = np.log(np.array([VOWELS[v] for _, v in vowels]))

    def resonance(f: np.ndarray, hz: np.ndarray | float, k: int) -> np.ndarray:
        """The k-th formant, as it rings: with its phase, so that each pulse is followed by its decay and not preceded."""
        bandwidth = throat.width * (60.0 + 35.0 * k + 0.02 * hz)
        ratio = f / hz
        return 1.0 - ratio * ratio + 1j * (ratio * bandwidth / hz)

    def gains(f: np.ndarray, place: np.ndarray) -> np.ndarray:
        still = np.ones(len(f), complex)
        for k, hz in enumerate(range(3400, int(11000 * throat.size), 1050), 3):
            still *= resonance(f, hz / throat.size, k)
        total = np.broadcast_to(still, (len(place), len(f))).copy()
        for k in range(3):
            total *= resonance(f, np.exp(np.interp(place, at, table[:, k])) / throat.size, k)
        radiation = np.minimum(1.0, f / 150.0)
        pressed = np.clip(f / 600.0, 1.0, 7.5) ** (throat.edge / 6.02)
        return radiation * pressed / total

    return moving(x, gains)


def cry(
    g: np.random.Generator,
    throat: Throat,
    seconds: float,
    pitch: Points,
    vowels: str,
    level: Points | None = None,
    vibrato: tuple[float, float] = (0.0, 5.0),
) -> np.ndarray:
    """One cry: pitch (place, Hz), vowels spread evenly over it, level (place, gain), vibrato (relative depth, Hz)."""
    n = samples(seconds)
    frequency = np.exp(smooth(n, [(place, np.log(hz)) for place, hz in pitch]))
    frequency *= 1.0 + vibrato[0] * np.sin(2.0 * np.pi * vibrato[1] * np.arange(n) / RATE)
    spots = np.linspace(0.0, 1.0, len(vowels)) if len(vowels) > 1 else [0.0]
    loudness = curve(n, level or [(0.0, 0.0), (0.08, 1.0), (0.6, 0.8), (1.0, 0.0)])
    out = tract(source(g, frequency, throat) * loudness, list(zip(spots, vowels)), throat)
    return drive(out, throat.drive) * loudness**0.3


def syllables(
    g: np.random.Generator, throat: Throat, text: str, pitch: float, pace: float = 0.16, fall: float = 0.75
) -> np.ndarray:
    """Something like speech: vowels as in VOWELS, 'k' and 't' bursts, 's' a hiss, ' ' a pause; pitch falls to the end."""
    out = np.zeros(samples(pace * (len(text) + 2)))
    at, k = 0.0, 0
    while k < len(text):
        c = text[k]
        run = 1
        while c in VOWELS and k + run < len(text) and text[k + run] in VOWELS:
            run += 1
        hz = pitch * (fall ** (at / (pace * len(text)))) * g.uniform(0.94, 1.08)
        if c in VOWELS:
            long = pace * (0.9 + 0.55 * (run - 1))
            level = [(0.0, 0.0), (0.12, 1.0), (0.7, 0.8), (1.0, 0.0)]
            word = text[k : k + run]
            lay(out, cry(g, throat, long, [(0.0, 1.05 * hz), (0.3, 1.12 * hz), (1.0, 0.9 * hz)], word, level), at)
            at += 0.85 * long
        elif c in "kts":
            m = samples(0.03 if c != "s" else 0.09)
            noise = white(g, m) * np.sin(np.pi * np.linspace(0.05, 1.0, m)) ** (0.5 if c == "s" else 2.0)
            hiss = {"k": 1600.0, "t": 3400.0, "s": 5200.0}[c] / throat.size
            lay(out, moving(noise, lambda f, p: np.exp(-(((f - hiss) / (0.45 * hiss)) ** 2)) + 0.0 * p, 256), at, 0.35)
            at += m / RATE
        else:
            at += 0.6 * pace
        k += run
    return out[: samples(at + 0.05)]


def throng(g, throat: Throat, parts: int, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    """Several takes of one cry, each a little off: a crowd, or one creature with more than one throat."""
    out = np.zeros(samples(seconds))
    for _ in range(parts):
        off = g.uniform(0.93, 1.07)
        take = cry(g, throat, seconds * g.uniform(0.92, 1.0), [(p, hz * off) for p, hz in pitch], vowels, level)
        out[: len(take)] += take / parts**0.5
    return out
