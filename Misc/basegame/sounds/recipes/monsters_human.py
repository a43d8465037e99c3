"""The order's servants: soldiers in diving helmets, enforcers who speak through brass, knights in plate, ogres."""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import bandpass, comb, drive, highpass, lowpass, peaks
from sounds.kit.liquid import bubbles, crackle
from sounds.kit.modal import CHAIN, IRON, STEEL, strike, thud, train
from sounds.kit.space import room
from sounds.kit.voice import Throat, cry, syllables
from sounds.kit.waves import coloured, curve, drift, layers, pulse, samples, saw, sequence, sine, unit, white

SOLDIER = Throat(size=0.98, rough=0.35, jitter=0.03, breath=0.12, growl=0.2, growl_hz=38.0, drive=1.8, edge=7.5)
ENFORCER = Throat(size=1.06, rough=0.2, jitter=0.01, breath=0.1, drive=2.0, edge=8.5)
KNIGHT = Throat(size=1.1, rough=0.4, jitter=0.03, breath=0.15, growl=0.3, growl_hz=33.0, drive=1.6, edge=6.5)
DEATH_KNIGHT = Throat(size=1.3, rough=0.5, jitter=0.03, breath=0.3, growl=0.5, growl_hz=26.0, sub=0.5, drive=2.2)
OGRE = Throat(
    size=1.38, edge=7.0, rough=0.55, jitter=0.04, breath=0.18, growl=0.6, growl_hz=24.0, sub=0.35, drive=2.6, width=1.2
)
BARK = [(0.0, 0.0), (0.05, 1.0), (0.55, 0.8), (1.0, 0.0)]
FALL = [(0.0, 0.0), (0.05, 1.0), (0.4, 0.8), (0.75, 0.35), (1.0, 0.0)]


def helmet(x):
    """Through the copper of a diving helmet: a short box with resonances of its own."""
    return peaks(comb(x, 0.0031, 0.35, 4000.0), [(620.0, 4.0, 0.4), (1750.0, 5.0, 1.3), (3100.0, 5.0, 1.2)], 0.7)


def speaker(g, x):
    """Through a brass speaking tube and its failing amplifier."""
    narrow = highpass(lowpass(x, 3000.0, order=2), 420.0, order=2)
    n = len(x)
    ringing = narrow * (0.6 + 0.4 * sine(63.0, n))
    return drive(unit(comb(ringing, 0.0017, 0.3)), 3.0) + 0.02 * bandpass(white(g, n), 1800.0, 1.0)


def plates(g, seconds: float, rate: float) -> np.ndarray:
    """Armour that moves."""
    return train(g, samples(seconds), rate, strike(g, CHAIN, 900.0, 0.2, 6500.0, 0.4, 0.8), 0.9, loop=False, uneven=0.8)


# -- soldiers


@sound("soldier/sight1")
def soldier_sees(g):
    return room(helmet(syllables(g, SOLDIER, "kEo tai", 175.0, 0.15, 0.8)), 0.5, 0.12)


@sound("soldier/idle")
def soldier_waits(g):
    breath = Throat(size=1.0, breath=1.5, rough=0.6, drive=0.3, width=1.5)
    inward = cry(g, breath, 0.5, [(0, 120), (1, 150)], "Eq", [(0, 0), (0.7, 0.8), (1, 0)])
    murmur = syllables(g, SOLDIER, "moq mu", 105.0, 0.15)
    air = bubbles(g, samples(0.5), 30.0, (0.002, 0.006))
    return helmet(sequence((0.0, 0.5 * unit(inward)), (0.5, unit(murmur)), (0.75, 0.25 * unit(air))))


@sound("soldier/pain1", "soldier/pain2")
def soldier_hurts(g):
    high = g.uniform(210, 260)
    return helmet(
        cry(
            g,
            SOLDIER,
            g.uniform(0.38, 0.5),
            [(0, high), (0.2, 1.1 * high), (1, 0.55 * high)],
            g.choice(["ao", "Ea", "aq"]),
            BARK,
        )
    )


@sound("soldier/death1")
def soldier_dies(g):
    scream = cry(g, SOLDIER, 0.85, [(0, 240), (0.15, 290), (0.6, 180), (1, 75)], "aEou", FALL, (0.02, 6.0))
    air = bubbles(g, samples(0.8), 55.0, (0.003, 0.012), 0.2, 1.5)
    return sequence(
        (0.0, helmet(scream)), (0.5, 0.35 * unit(air)), (0.75, 0.4 * strike(g, IRON, 430.0, 0.3, 3000.0, 0.5, 0.6))
    )


# -- enforcers


def order(g, text: str, pitch: float) -> np.ndarray:
    chirp = pulse(curve(samples(0.05), [(0, 900), (1, 1300)]), samples(0.05), 0.3) * curve(
        samples(0.05), [(0, 0), (0.2, 0.5), (1, 0)]
    )
    return sequence((0.0, 0.5 * chirp), (0.07, speaker(g, syllables(g, ENFORCER, text, pitch, 0.17, 0.82))))


@sound("enforcer/sight1")
def enforcer_sees_1(g):
    return order(g, "tao kEt", 128.0)


@sound("enforcer/sight2")
def enforcer_sees_2(g):
    return order(g, "sai to kar", 118.0)


@sound("enforcer/sight3")
def enforcer_sees_3(g):
    return order(g, "kae so tuk", 138.0)


@sound("enforcer/sight4")
def enforcer_sees_4(g):
    return order(g, "to sia", 122.0)


@sound("enforcer/idle1")
def enforcer_waits(g):
    n = samples(0.5)
    static = (
        bandpass(white(g, n), 1700.0, 1.2) * (np.clip(drift(g, n, 22.0), 0.0, 1.0)) * curve(n, [(0, 0), (0.1, 1), (1, 0)])
    )
    return sequence((0.0, 0.5 * unit(static)), (0.45, 0.8 * order(g, "mu koq sam oq", 96.0)), (1.55, 0.3 * unit(static)))


@sound("enforcer/pain1", "enforcer/pain2")
def enforcer_hurts(g):
    high = g.uniform(165, 205)
    return speaker(
        g,
        cry(
            g, ENFORCER, g.uniform(0.38, 0.48), [(0, high), (0.2, 1.15 * high), (1, 0.6 * high)], g.choice(["ao", "Eo"]), BARK
        ),
    )


@sound("enforcer/death1")
def enforcer_dies(g):
    scream = speaker(g, cry(g, ENFORCER, 0.9, [(0, 190), (0.2, 225), (1, 60)], "aEou", FALL))
    n = samples(0.9)
    failing = (
        pulse(curve(n, [(0, 620), (1, 45)], exponential=True), n, 0.4)
        * (drift(g, n, 30.0) > -0.2)
        * curve(n, [(0, 0.6), (1, 0)])
    )
    return sequence((0.0, scream), (0.55, 0.3 * lowpass(failing, 3000.0)), (0.6, 0.5 * crackle(g, n, 80.0)))


# -- knights


@sound("knight/ksight")
def knight_sees(g):
    return sequence(
        (0.0, helmet(cry(g, KNIGHT, 0.75, [(0, 120), (0.3, 165), (1, 105)], "oaE", BARK))),
        (0.1, 0.22 * unit(plates(g, 0.7, 9.0))),
    )


@sound("knight/idle")
def knight_waits(g):
    return sequence(
        (0.0, unit(plates(g, 0.7, 6.0)) * 0.5), (0.3, helmet(cry(g, KNIGHT, 0.6, [(0, 92), (0.5, 104), (1, 84)], "moq")))
    )


@sound("knight/khurt")
def knight_hurts(g):
    return sequence(
        (0.0, 0.5 * strike(g, STEEL, 620.0, 0.3, 5000.0, 0.7, 0.35)),
        (0.02, helmet(cry(g, KNIGHT, 0.4, [(0, 190), (1, 105)], "ao", BARK))),
    )


@sound("knight/kdeath")
def knight_dies(g):
    fall = layers(0.6 * thud(g, 0.25, 130.0, 55.0), 0.8 * unit(plates(g, 0.45, 22.0)))
    return sequence((0.0, helmet(cry(g, KNIGHT, 0.7, [(0, 185), (0.2, 205), (1, 68)], "aou", FALL))), (0.5, 0.7 * fall))


def two_voices(g, seconds: float, pitch, vowels: str, level, echo: float = 0.2) -> np.ndarray:
    """A death knight: a voice, and the same an octave below, in a crypt."""
    below = [(place, 0.5 * hz) for place, hz in pitch]
    both = layers(
        cry(g, DEATH_KNIGHT, seconds, pitch, vowels, level), 0.8 * cry(g, DEATH_KNIGHT, seconds, below, vowels, level)
    )
    return room(both, 4.5 * echo, echo)


@sound("hknight/sight1")
def death_knight_sees(g):
    return two_voices(g, 1.25, [(0, 120), (0.3, 160), (0.7, 150), (1, 80)], "oaEo", [(0, 0), (0.2, 0.8), (0.5, 1), (1, 0)])


@sound("hknight/idle")
def death_knight_waits(g):
    return sequence(
        (0.0, 0.4 * unit(plates(g, 0.6, 6.0))), (0.3, two_voices(g, 0.9, [(0, 85), (0.4, 98), (1, 70)], "moqu", BARK))
    )


@sound("hknight/grunt")
def death_knight_grunts(g):
    return two_voices(g, 0.36, [(0, 115), (0.3, 130), (1, 90)], "oq", BARK, 0.1)


@sound("hknight/pain1")
def death_knight_hurts(g):
    return sequence(
        (0.0, 0.4 * strike(g, STEEL, 480.0, 0.3, 5000.0, 0.7, 0.35)),
        (0.01, two_voices(g, 0.5, [(0, 190), (0.2, 210), (1, 95)], "aE", BARK)),
    )


@sound("hknight/death1")
def death_knight_dies(g):
    scream = two_voices(g, 1.2, [(0, 200), (0.15, 230), (0.6, 130), (1, 50)], "aEou", FALL)
    return sequence((0.0, scream), (0.85, 0.45 * unit(plates(g, 0.5, 20.0))), (0.9, 0.5 * thud(g, 0.3)))


# -- ogres


def ogre(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    return room(cry(g, OGRE, seconds, pitch, vowels, level), 0.5, 0.1)


@sound("ogre/ogwake")
def ogre_wakes(g):
    return ogre(g, 1.05, [(0, 72), (0.3, 118), (0.7, 105), (1, 62)], "uoaE", [(0, 0), (0.15, 0.6), (0.45, 1), (1, 0)])


@sound("ogre/ogidle")
def ogre_waits(g):
    return ogre(g, 1.0, [(0, 58), (0.4, 70), (1, 52)], "muoq", [(0, 0), (0.2, 0.8), (0.5, 0.5), (0.7, 0.9), (1, 0)])


@sound("ogre/ogidle2")
def ogre_snorts(g):
    snort = Throat(size=1.4, rough=0.6, breath=1.3, growl=0.7, growl_hz=30.0, drive=1.5, width=1.5)
    level = [(0, 0), (0.1, 1), (0.5, 0.5), (1, 0)]
    return sequence(
        (0.0, cry(g, snort, 0.5, [(0, 70), (1, 50)], "rq", level)),
        (0.6, 0.7 * cry(g, snort, 0.6, [(0, 60), (1, 44)], "qu", level)),
    )


@sound("ogre/ogpain1")
def ogre_hurts(g):
    return ogre(g, 0.7, [(0, 120), (0.15, 150), (0.6, 110), (1, 65)], "aEo", BARK)


@sound("ogre/ogdth")
def ogre_dies(g):
    scream = ogre(g, 1.35, [(0, 135), (0.12, 155), (0.5, 95), (1, 38)], "aEoou", FALL)
    return sequence((0.0, scream), (1.0, 0.6 * thud(g, 0.4, 100.0, 40.0, 0.6)))


@sound("ogre/ogsawatk")
def ogre_saws(g):
    n = samples(0.85)
    speed = curve(n, [(0, 52), (0.15, 88), (0.75, 96), (1, 60)]) * (1.0 + 0.05 * drift(g, n, 18.0))
    motor = pulse(speed, n, 0.18) + 0.7 * saw(2.0 * speed, n) + 0.35 * coloured(g, n, -2.0)
    teeth = highpass(white(g, n), 2200.0) * (0.4 + 0.6 * np.clip(sine(4.0 * speed, n), 0.0, 1.0))
    body = peaks(motor, [(310.0, 3.0, 1.2), (860.0, 4.0, 1.0), (2100.0, 4.0, 0.7)], 0.5) + 0.45 * teeth
    return drive(body * curve(n, [(0, 0), (0.06, 0.8), (0.3, 1), (0.8, 0.85), (1, 0)]), 1.8)
