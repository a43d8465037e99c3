"""Water, slime, blood: drops, bubbles and splashes made of single bubbles, and fire made of single cracks.

A bubble of radius r metres rings at about 3 / r Hz and dies by 0.13 / r + 0.0072 / r^1.5 a second; one that rises to the
surface rises in pitch (van den Doel 2005, Physically based models for liquid sounds). A slime's bubbles are larger,
slower and die sooner.
"""

from __future__ import annotations

import numpy as np

from sounds.kit.filters import bandpass, highpass, lowpass, sweep
from sounds.kit.modal import thud
from sounds.kit.waves import RATE, curve, decay, lay, samples, white


def bubble(radius: float, rise: float = 0.1, damping: float = 1.0) -> np.ndarray:
    """One bubble of radius metres; rise: how fast its pitch goes up, in parts of its damping."""
    loss = damping * (0.13 / radius + 0.0072 * radius**-1.5)
    n = min(samples(7.0 / loss), samples(0.5))
    t = np.arange(n) / RATE
    turns = 3.0 / radius * (t + 0.5 * rise * loss * t * t)
    out = np.sin(2.0 * np.pi * turns) * np.exp(-loss * t) * np.minimum(1.0, t / 0.0008)
    return out * np.minimum(1.0, (n - np.arange(n)) / (0.1 * n))


def bubbles(
    g: np.random.Generator,
    n: int,
    rate: float,
    radii: tuple[float, float],
    rise: float = 0.1,
    damping: float = 1.0,
    loop: bool = False,
    density: np.ndarray | None = None,
) -> np.ndarray:
    """(n,) rate bubbles a second with radii between two bounds in metres, few large ones and many small ones.

    density: (n,) how likely they begin when; even where it is None.
    """
    out = np.zeros(n)
    count = int(rate * n / RATE)
    if density is None:
        at = g.random(count)
    else:
        share = np.cumsum(density)
        at = np.searchsorted(share / share[-1], g.random(count)) / n
    sizes = np.exp(np.log(radii[0]) + np.log(radii[1] / radii[0]) * g.random(count) ** 1.5)
    for when, radius in zip(at, sizes):
        sound = bubble(radius, rise * g.uniform(0.3, 1.7), damping)
        lay(out, sound, when * n / RATE, g.uniform(0.3, 1.0) * (radius / radii[1]) ** 0.5, wrap=loop)
    return out if loop else out * ending(n)


def ending(n: int, share: float = 0.15) -> np.ndarray:
    """(n,) that falls to nothing over the last share, for what would be cut off."""
    return np.minimum(1.0, (n - np.arange(n)) / (share * n)) ** 2


def splash(g: np.random.Generator, seconds: float, weight: float = 1.0) -> np.ndarray:
    """Something that falls into water: the slap, spray that dies away, and the bubbles it drew down."""
    n = samples(seconds)
    slap = thud(g, min(seconds, 0.3), 160.0 / weight, 70.0 / weight, 0.6)
    spray = sweep(white(g, n), [(0.0, 1200.0), (0.08, 3200.0), (1.0, 1500.0)], 0.8)
    spray *= curve(n, [(0.0, 0.0), (0.01, 1.0), (0.12, 0.45), (0.4, 0.12), (1.0, 0.0)])
    down = curve(n, [(0.0, 0.0), (0.12, 1.0), (0.5, 0.35), (0.8, 0.0), (1.0, 0.0)])
    drawn = bubbles(g, n, 130.0, (0.0012, 0.007 * weight), 0.12, 1.0, density=down)
    out = 0.9 * drawn + 0.5 * spray
    out[: len(slap)] += 0.5 * slap
    return out


def squelch(g: np.random.Generator, seconds: float, weight: float = 1.0, rate: float = 90.0) -> np.ndarray:
    """Flesh or slime that gives way: short wet bursts and large, dull bubbles."""
    n = samples(seconds)
    fade = curve(n, [(0.0, 1.0), (0.25, 0.7), (1.0, 0.0)])
    out = 0.8 * bubbles(g, n, rate, (0.003, 0.012 * weight), 0.35, 5.0, density=fade**2 + 1e-6)
    for _ in range(int(14 * seconds) + 4):
        m = samples(g.uniform(0.015, 0.07))
        centre = g.uniform(350.0, 1500.0) / weight
        grain = sweep(white(g, m), [(0.0, centre), (1.0, centre * g.uniform(1.3, 2.6))], 2.5)
        grain *= np.sin(np.pi * np.linspace(0.0, 1.0, m)) ** 2
        when = seconds * 0.8 * g.random() ** 1.6
        lay(out, grain, when, 0.9 * (1.0 - when / seconds))
    return lowpass(out * ending(n), 5500.0)


def crackle(g: np.random.Generator, n: int, rate: float, loop: bool = False, density: np.ndarray | None = None) -> np.ndarray:
    """(n,) rate small cracks a second: burning wood, falling rubble, sparks."""
    out = np.zeros(n)
    count = int(rate * n / RATE)
    if density is None:
        at = g.random(count)
    else:
        share = np.cumsum(density)
        at = np.searchsorted(share / share[-1], g.random(count)) / n
    for when in at:
        m = samples(g.uniform(0.002, 0.018))
        grain = white(g, m) * decay(m, m / RATE, 0.0002)
        lay(out, bandpass(grain, np.exp(g.uniform(6.6, 8.6)), 1.2), when * n / RATE, g.random() ** 3, wrap=loop)
    return highpass(out, 200.0, loop=loop)
