"""Things that are struck: sums of decaying tones, as far apart and as short as the material makes them.

Ratios are those of bars, bells and plates in the books (Fletcher and Rossing, The Physics of Musical Instruments); the
higher a tone, the sooner it is gone, by an exponent that tells metal (low) from wood and stone (high).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sounds.kit.filters import lowpass
from sounds.kit.waves import RATE, decay, samples, white

BAR = (1.0, 2.756, 5.404, 8.933, 13.34, 18.64)
BELL = (0.5, 1.0, 1.2, 1.5, 2.0, 2.5, 2.66, 3.0, 4.0, 5.33, 6.3)
WOOD = (1.0, 2.3, 3.1, 3.9, 5.1, 6.7)
GLASS = (1.0, 2.32, 4.25, 6.63, 9.38)


@dataclass(frozen=True)
class Body:
    """What is struck. t60: seconds until its lowest tone has lost 60 dB; loss: how much sooner higher ones do."""

    ratios: tuple[float, ...] = ()  # of its tones; none: a plate's dense ones, drawn at random
    t60: float = 0.5
    loss: float = 0.6
    spread: float = 0.02  # relative disorder of the tones
    count: int = 24  # of a plate's tones
    density: float = 0.35  # distance of a plate's tones, in parts of the lowest


IRON = Body(t60=0.5, loss=0.55)
STEEL = Body(BAR, t60=0.9, loss=0.45)
CHAIN = Body(t60=0.18, loss=0.45, count=18, density=0.6)
COPPER = Body(t60=1.2, loss=0.65, density=0.5)
BRONZE = Body(BELL, t60=3.0, loss=0.75, spread=0.004)
OAK = Body(WOOD, t60=0.16, loss=0.9, spread=0.06)
SLATE = Body(t60=0.09, loss=0.8, count=30, density=0.45, spread=0.2)
CRYSTAL = Body(GLASS, t60=0.9, loss=0.5, spread=0.01)


def ring(
    g: np.random.Generator, body: Body, base: float, seconds: float, hardness: float = 4000.0, stretch: float = 1.0
) -> np.ndarray:
    """One stroke on a body whose lowest tone is base Hz, by something that rouses tones up to about hardness Hz, and so
    touches it for 2 / hardness seconds, in which they rise. Tones that begin at their full strength are a step: a click."""
    n = samples(seconds)
    ratios = np.array(body.ratios) if body.ratios else 1.0 + np.cumsum(g.uniform(0.3, 1.7, body.count)) * body.density
    frequencies = base * ratios * (1.0 + body.spread * g.uniform(-1.0, 1.0, len(ratios)))
    out = np.zeros(n)
    for frequency in frequencies:
        weight = g.uniform(0.4, 1.0) / (1.0 + (frequency / hardness) ** 2)
        turn = g.random()
        if frequency > 0.45 * RATE:
            continue
        t60 = stretch * body.t60 * (base / frequency) ** body.loss
        m = min(n, samples(1.2 * t60) + 8)
        t = np.arange(m) / RATE
        fade = np.minimum(1.0, (m - np.arange(m)) / (0.2 * m))
        out[:m] += weight * fade * np.exp(-6.91 * t / t60) * np.sin(2.0 * np.pi * (frequency * t + turn))
    rise = samples(2.0 / hardness)
    out[:rise] *= (0.5 - 0.5 * np.cos(np.pi * np.arange(rise) / rise))[: len(out)]
    return out / np.sqrt(len(frequencies))


def click(g: np.random.Generator, t60: float, brightness: float) -> np.ndarray:
    """The noise of contact itself."""
    n = samples(1.5 * t60)
    return lowpass(white(g, n) * decay(n, t60, 0.0004), brightness)


def strike(
    g: np.random.Generator,
    body: Body,
    base: float,
    seconds: float,
    hardness: float = 4000.0,
    contact: float = 0.5,
    stretch: float = 1.0,
) -> np.ndarray:
    """A stroke with the noise of its contact."""
    out = ring(g, body, base, seconds, hardness, stretch)
    noise = contact * click(g, min(seconds, 0.03), 2.0 * hardness)
    m = min(len(out), len(noise))
    out[:m] += noise[:m]
    return out


def thud(g: np.random.Generator, seconds: float, high: float = 110.0, low: float = 45.0, noise: float = 0.4) -> np.ndarray:
    """Something heavy that lands: a tone that falls from high to low Hz, and dull noise."""
    n = samples(seconds)
    t = np.arange(n) / RATE
    frequency = low + (high - low) * np.exp(-t / 0.03)
    body = np.sin(2.0 * np.pi * np.cumsum(frequency) / RATE) * decay(n, 0.8 * seconds, 0.003)
    return body + noise * lowpass(white(g, n), 5.0 * high) * decay(n, 0.35 * seconds, 0.001) * 3.0


def train(
    g: np.random.Generator,
    n: int,
    rate: float,
    grain: np.ndarray,
    jitter: float = 0.2,
    loop: bool = True,
    uneven: float = 0.4,
) -> np.ndarray:
    """(n,) a grain repeated about rate times a second at disordered times and strengths: links, ratchets, creaks."""
    count = max(1, int(round(n / RATE * rate)))
    at = (np.arange(count) + jitter * g.uniform(-0.5, 0.5, count)) / count
    impulses = np.zeros(n)
    np.add.at(impulses, (at * n).astype(int) % n, 1.0 - uneven * g.random(count))
    if loop:
        folded = np.zeros(n)
        for k in range(0, len(grain), n):
            part = grain[k : k + n]
            folded[: len(part)] += part
        return np.fft.irfft(np.fft.rfft(impulses) * np.fft.rfft(folded), n)
    size = n + len(grain)
    return np.fft.irfft(np.fft.rfft(impulses, size) * np.fft.rfft(grain, size), size)[:n]
