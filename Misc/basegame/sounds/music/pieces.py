"""The pieces. A world under water: a foundry that was an abbey, its pumps still going, its choir still singing.

D is the ground, and the second step above it is flat (Phrygian), so that every way out of the first chord is a small one.
A beat is 1.2 s, a bar four of them; the pump beats on the first and just before the third.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sounds.kit.waves import curve, generator, samples, smooth
from sounds.music import instruments as play
from sounds.music.instruments import Hall, choir

BEAT = 1.2
BAR = 4 * BEAT

# Two bars each, low to high, chosen so that each voice moves by a step at most.
CHORDS = {
    "dm": "d2 d3 a3 d4 f4",
    "bb": "d2 d3 bb3 d4 f4",
    "gm": "g2 d3 bb3 d4 g4",
    "eb": "eb2 eb3 bb3 eb4 g4",
    "cm": "c2 c3 g3 eb4 g4",
    "am": "a2 c3 a3 e4 a4",
    "f": "f2 c3 a3 f4 a4",
    "open": "d2 d3 a3 d4 a4",
}
# The bells' call, and its answer: (beat, note).
CALL = ((0, "d5"), (1.5, "eb5"), (3, "d5"), (4, "a4"), (6, "bb4"))
ANSWER = ((0, "f5"), (1.5, "eb5"), (3, "d5"), (4, "c5"), (6, "d5"))
TOLL = ((0, "d3"),)


def bells(hall: Hall, phrase, bar: float, gain: float, pan: float, send: float = 0.5) -> None:
    for beat, note in phrase:
        hall.add(play.bell(note), bar * BAR + beat * BEAT, gain, pan, send)


def pump(hall: Hall, first: int, last: int, gain: float) -> None:
    """The pulse from one bar to another; its strength grows over the first four bars."""
    for bar in range(first, last):
        strength = gain * min(1.0, 0.4 + 0.2 * (bar - first))
        hall.add(play.beat(), bar * BAR, strength, 0.0, 0.12)
        hall.add(play.beat(), bar * BAR + 1.72 * BEAT, 0.55 * strength, 0.0, 0.12)


def works(hall: Hall, g: np.random.Generator, first: int, last: int, gain: float) -> None:
    """Hammers far off, the deep one on the third beat, the light one where it likes."""
    for bar in range(first, last):
        hall.add(play.hammer(True), bar * BAR + 2 * BEAT, gain, -0.4, 1.0)
        if bar % 2:
            for beat in (3.0, 3.5):
                hall.add(play.hammer(False), bar * BAR + beat * BEAT, 0.45 * gain * g.uniform(0.6, 1.0), 0.55, 1.2)


def drowned_choir() -> np.ndarray:
    """Track 2: the abbey is heard from afar, its works begin, its choir rises, sinks, and rises once more."""
    g = generator("track02")
    length = 33 * BAR
    hall = Hall(length)
    hall.add(
        play.drone(length, (36.71, 55.0, 73.42), 170.0) * swell_of(length, (0.5, 0.75, 0.6, 1.0, 0.5)), 0.0, 0.30, 0.0, 0.1
    )
    hall.add(play.tide(length, g), 0.0, 0.07, -0.5, 0.3)
    hall.add(play.tide(length, g), 0.0, 0.07, 0.5, 0.3)
    play.drops(hall, g, 0.55, 0.2)
    for bar in (0.5, 4, 8, 12, 20, 24, 28, 31):
        bells(hall, TOLL, bar, 0.20, -0.15, 0.6)
    pump(hall, 4, 20, 0.42)
    pump(hall, 24, 31, 0.5)
    works(hall, g, 10, 20, 0.24)
    works(hall, g, 25, 30, 0.3)
    rise = (
        ("dm", "uou"),
        ("bb", "uou"),
        ("gm", "uou"),
        ("eb", "uoou"),
        ("dm", "uoau"),
        ("cm", "uoau"),
        ("eb", "oaao"),
        ("dm", "oaou"),
    )
    for k, (chord, vowels) in enumerate(rise):
        choir(hall, g, CHORDS[chord], (4 + 2 * k) * BAR, 2 * BAR, vowels, 0.040 + 0.004 * k)
    last = (("dm", "oaao"), ("gm", "oaao"), ("eb", "oaaa"), ("open", "aaou"))
    for k, (chord, vowels) in enumerate(last):
        choir(hall, g, CHORDS[chord], (24 + 2 * k) * BAR, 2 * BAR, vowels, 0.070)
    for bar, phrase in ((8, CALL), (12, CALL), (14, ANSWER), (16, CALL), (18, ANSWER), (26, CALL), (28, ANSWER)):
        bells(hall, phrase, bar, 0.10, 0.35)
    lament(hall, g, 20 * BAR)
    for bar, hz in ((2, 73.42), (12, 73.42), (16, 65.41), (18, 77.78), (24, 73.42), (26, 98.0), (28, 77.78), (30, 73.42)):
        hall.add(play.horn(hz, 1.8 * BAR, g), bar * BAR, 0.12, -0.1, 0.4)
    for bar, base, pan in ((1.5, 190.0, 0.7), (7, 150.0, -0.7), (20.5, 170.0, 0.6), (22.5, 130.0, -0.6), (31, 160.0, 0.5)):
        hall.add(play.groan(g, 4.0, base), bar * BAR, 0.10, pan, 0.9)
    return finished(hall, 4.2, 0.35, 3.0, 7.0)


def lament(hall: Hall, g: np.random.Generator, at: float) -> None:
    """One voice alone over the water, four bars."""
    for beat, beats, note in (
        (0, 3, "d4"),
        (3, 1.5, "eb4"),
        (4.5, 2.5, "d4"),
        (8, 2, "f4"),
        (10, 1.5, "eb4"),
        (11.5, 3.5, "c4"),
        (14.8, 2.5, "d4"),
    ):
        n = samples(1.25 * beats * BEAT)
        swell = smooth(n, [(0.0, 0.0), (0.2, 1.0), (0.6, 0.8), (1.0, 0.0)])
        for _ in range(2):
            hall.add(play.singer(g, play.hertz(note), "uou", swell), at + beat * BEAT, 0.055, 0.1, 0.8)


def vigil() -> np.ndarray:
    """Track 3: rest between two levels, the choir alone with the bells, towards light and not quite there; then, for who
    stays, the way down into the works: the pump once a bar, hammers, a horn, the same light farther off."""
    g = generator("track03")
    length = 23 * BAR
    hall = Hall(length)
    hall.add(play.drone(length, (36.71, 73.42), 130.0) * swell_of(length, (0.6, 0.9, 1.0, 1.0, 0.6)), 0.0, 0.20, 0.0, 0.1)
    hall.add(play.tide(length, g), 0.0, 0.06, 0.3, 0.3)
    play.drops(hall, g, 0.4, 0.18)
    light = (("dm", "uou"), ("bb", "uou"), ("f", "uoau"), ("am", "oao"), ("open", "aoou"))
    for k, (chord, vowels) in enumerate(light):
        choir(hall, g, CHORDS[chord], 2 * k * BAR, 2 * BAR, vowels, 0.07)
    down = (("gm", "uou"), ("am", "uou"), ("f", "uoou"), ("eb", "uoau"), ("dm", "oou"))
    for k, (chord, vowels) in enumerate(down):
        choir(hall, g, CHORDS[chord], (12 + 2 * k) * BAR, 2 * BAR, vowels, 0.05)
    for bar, phrase in (
        (0.5, TOLL),
        (2, ANSWER),
        (4, CALL),
        (6, ANSWER),
        (8, TOLL),
        (11, TOLL),
        (14, CALL),
        (18, ANSWER),
        (21, TOLL),
    ):
        bells(hall, phrase, bar, 0.2 if phrase is TOLL else 0.1, 0.3)
    for bar in range(10, 21):
        hall.add(play.beat(), bar * BAR, 0.4, 0.0, 0.15)
    works(hall, g, 13, 20, 0.2)
    for bar, hz in ((10, 73.42), (12, 49.0), (16, 43.65), (18, 77.78)):
        hall.add(play.horn(hz, 1.8 * BAR, g), bar * BAR, 0.14, 0.1, 0.4)
    for bar, base, pan in ((11.5, 180.0, -0.6), (17.5, 140.0, 0.7), (20.5, 165.0, -0.5)):
        hall.add(play.groan(g, 4.0, base), bar * BAR, 0.10, pan, 0.9)
    return finished(hall, 4.6, 0.3, 1.5, 6.0)


def swell_of(seconds: float, levels: tuple[float, ...]) -> np.ndarray:
    return smooth(samples(seconds), [(k / (len(levels) - 1), level) for k, level in enumerate(levels)])


def finished(hall: Hall, t60: float, damping: float, fade_in: float, fade_out: float) -> np.ndarray:
    """(2, n) in -1..1: the mix in its hall, at rest at both ends, so that it may begin anew."""
    out = hall.result(t60, damping)
    out -= np.mean(out, axis=1, keepdims=True)
    n = out.shape[1]
    seconds = n / samples(1.0)
    out *= curve(n, [(0.0, 0.0), (fade_in / seconds, 1.0), (1.0 - fade_out / seconds, 1.0), (1.0, 0.0)])
    power = np.sqrt(np.mean(out[:, n // 4 :] ** 2))
    out *= LOUDNESS / power
    return np.where(np.abs(out) > 0.6, np.sign(out) * (0.6 + 0.29 * np.tanh((np.abs(out) - 0.6) / 0.29)), out)


LOUDNESS = 10.0 ** (-20.0 / 20.0)  # RMS of a piece: below the weapons, above the ambience

PIECES: dict[str, Callable[[], np.ndarray]] = {"track02": drowned_choir, "track03": vigil}
