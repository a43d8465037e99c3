"""Beasts and things without a language: dogs, fiends, shamblers, scrags, the dead, vores, fish, slime, and two gods."""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import bandpass, comb, drive, lowpass, rush, sweep
from sounds.kit.liquid import bubbles, crackle, splash, squelch
from sounds.kit.modal import OAK, strike, thud, train
from sounds.kit.space import room
from sounds.kit.voice import Throat, cry, throng
from sounds.kit.waves import coloured, curve, drift, fm, layers, samples, sequence, sine, unit

DOG = Throat(size=0.8, rough=0.5, jitter=0.04, breath=0.3, growl=0.25, growl_hz=60.0, drive=2.4)
SNARL = Throat(size=0.85, rough=0.8, jitter=0.08, breath=0.45, growl=0.8, growl_hz=38.0, sub=0.3, drive=2.5)
FIEND = Throat(size=1.25, edge=7.0, rough=0.8, jitter=0.1, breath=0.55, growl=0.55, growl_hz=46.0, sub=0.4, drive=3.0)
SHAMBLER = Throat(
    size=1.7, rough=0.6, jitter=0.05, breath=0.4, edge=8.0, growl=0.6, growl_hz=19.0, sub=0.5, drive=2.8, width=1.1
)
SCRAG = Throat(size=0.75, rough=0.5, jitter=0.06, breath=0.9, growl=0.45, growl_hz=54.0, drive=1.5, width=0.8)
DEAD = Throat(
    size=1.12, rough=0.7, jitter=0.05, breath=0.5, growl=0.5, growl_hz=17.0, sub=0.5, drive=1.2, width=1.3, edge=2.5
)
VORE = Throat(size=1.15, rough=0.3, jitter=0.03, breath=0.2, growl=0.5, growl_hz=31.0, drive=1.6, width=0.7)
GOD = Throat(size=2.0, rough=0.5, jitter=0.04, breath=0.5, edge=8.0, growl=0.5, growl_hz=13.0, sub=0.6, drive=2.5)
MOTHER = Throat(
    size=1.5, rough=0.4, jitter=0.05, breath=0.45, edge=7.0, growl=0.4, growl_hz=11.0, sub=0.3, drive=1.8, width=1.2
)
BARK = [(0.0, 0.0), (0.08, 1.0), (0.4, 0.8), (1.0, 0.0)]
LONG = [(0.0, 0.0), (0.12, 0.9), (0.5, 1.0), (1.0, 0.0)]
FALL = [(0.0, 0.0), (0.05, 1.0), (0.4, 0.8), (0.75, 0.35), (1.0, 0.0)]

# -- dogs


def bark(g, high: float) -> np.ndarray:
    return cry(g, DOG, 0.17, [(0, 0.55 * high), (0.3, high), (1, 0.5 * high)], "uaq", BARK)


@sound("dog/dsight")
def dog_sees(g):
    return room(sequence((0.0, bark(g, 430)), (0.27, bark(g, 470)), (0.5, 0.8 * bark(g, 400))), 0.4, 0.12)


@sound("dog/dattack1")
def dog_bites(g):
    snarl = cry(g, SNARL, 0.5, [(0, 120), (0.5, 190), (1, 140)], "rEa", LONG)
    snap = 0.5 * strike(g, OAK, 900.0, 0.06, 5000.0, 1.2, 0.5)
    return sequence((0.0, snarl), (0.3, snap), (0.33, 0.8 * bark(g, 500)))


@sound("dog/dpain1")
def dog_hurts(g):
    yelp = Throat(size=0.72, rough=0.15, jitter=0.02, breath=0.1, drive=1.0)
    cries = [
        cry(g, yelp, 0.2, [(0, 620), (0.25, 1080), (1, 560)], "Ei", BARK),
        cry(g, yelp, 0.26, [(0, 700), (0.2, 930), (1, 430)], "Eq", BARK),
    ]
    return sequence((0.0, cries[0]), (0.22, 0.7 * cries[1]))


@sound("dog/ddeath")
def dog_dies(g):
    yelp = Throat(size=0.75, rough=0.4, jitter=0.04, breath=0.25, drive=1.5)
    return sequence(
        (0.0, cry(g, yelp, 0.35, [(0, 600), (0.2, 980), (1, 420)], "Ea", BARK)),
        (0.33, 0.6 * cry(g, SNARL, 0.6, [(0, 260), (1, 80)], "aou", FALL)),
    )


@sound("dog/idle")
def dog_waits(g):
    pant = [
        (0.24 * k, (0.55 + 0.1 * (k % 2)) * unit(rush(g, 0.2, [(0, 1500), (1, 1000 + 500 * (k % 2))], LONG, 1.0)))
        for k in range(4)
    ]
    return sequence(*pant, (0.9, 0.8 * unit(cry(g, SNARL, 0.7, [(0, 75), (0.6, 92), (1, 70)], "rEq", LONG))))


# -- fiends


def shriek(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    """Torn between a scream and a hiss."""
    voice = cry(g, FIEND, seconds, pitch, vowels, level)
    n = len(voice)
    tear = fm(curve(n, [(p, 5.1 * hz) for p, hz in pitch]), 0.731, 3.0 + 2.0 * drift(g, n, 40.0), n) * curve(n, level)
    return room(layers(voice, 0.22 * bandpass(tear, 2600.0, 1.0)), 0.5, 0.12)


@sound("demon/sight2")
def fiend_sees(g):
    return shriek(g, 1.15, [(0, 150), (0.25, 330), (0.6, 290), (1, 130)], "oaEa", LONG)


@sound("demon/idle1")
def fiend_waits(g):
    return cry(
        g, FIEND, 1.3, [(0, 62), (0.4, 85), (0.7, 70), (1, 58)], "rqor", [(0, 0), (0.3, 0.9), (0.5, 0.5), (0.7, 1), (1, 0)]
    )


@sound("demon/djump")
def fiend_leaps(g):
    return shriek(g, 0.75, [(0, 190), (0.35, 420), (1, 260)], "aEE", BARK)


@sound("demon/dpain1")
def fiend_hurts(g):
    return shriek(g, 0.6, [(0, 380), (0.2, 460), (1, 170)], "Eao", BARK)


@sound("demon/ddeath")
def fiend_dies(g):
    return sequence(
        (0.0, shriek(g, 1.4, [(0, 420), (0.15, 500), (0.6, 210), (1, 55)], "Eaou", FALL)),
        (1.0, 0.4 * unit(squelch(g, 0.5, 1.2))),
    )


# -- shamblers


def roar(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    voice = throng(g, SHAMBLER, 2, seconds, pitch, vowels, level)
    chest = lowpass(coloured(g, len(voice), -4.0), 180.0) * curve(len(voice), level)
    return room(drive(layers(voice, 0.4 * unit(chest)), 1.2), 1.0, 0.18, 0.6)


@sound("shambler/ssight")
def shambler_sees(g):
    return roar(g, 1.5, [(0, 55), (0.3, 98), (0.65, 88), (1, 45)], "uoaao", LONG)


@sound("shambler/sidle")
def shambler_waits(g):
    return roar(g, 1.4, [(0, 42), (0.5, 50), (1, 38)], "muoq", [(0, 0), (0.3, 0.9), (0.5, 0.6), (0.7, 1), (1, 0)])


@sound("shambler/shurt2")
def shambler_hurts(g):
    return roar(g, 0.8, [(0, 105), (0.2, 125), (1, 60)], "aEo", BARK)


@sound("shambler/sdeath")
def shambler_dies(g):
    return sequence(
        (0.0, roar(g, 1.6, [(0, 115), (0.12, 130), (0.5, 75), (1, 32)], "aEouu", FALL)),
        (1.15, 0.7 * thud(g, 0.5, 90.0, 34.0, 0.7)),
    )


# -- scrags


def hiss(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    """A wet whistle through gills."""
    voice = cry(g, SCRAG, seconds, pitch, vowels, level, (0.05, 11.0))
    n = len(voice)
    gills = bubbles(g, n, 45.0, (0.0012, 0.004), 0.2, 1.5)
    return room(comb(voice, 0.0024, 0.35) + 0.25 * unit(gills) * curve(n, level), 0.7, 0.2)


@sound("wizard/wsight")
def scrag_sees(g):
    return hiss(g, 0.8, [(0, 260), (0.3, 520), (0.7, 470), (1, 280)], "iEai", LONG)


@sound("wizard/wattack")
def scrag_spits(g):
    draw = hiss(g, 0.5, [(0, 200), (1, 420)], "uE", [(0, 0), (0.8, 0.7), (1, 0)])
    spit = layers(unit(rush(g, 0.3, [(0, 3600), (1, 1100)], BARK, 1.0)), 0.7 * unit(squelch(g, 0.25, 0.6)))
    return sequence((0.0, 0.6 * unit(draw)), (0.45, spit))


@sound("wizard/wpain")
def scrag_hurts(g):
    return hiss(g, 0.42, [(0, 560), (0.2, 690), (1, 320)], "Ei", BARK)


@sound("wizard/wdeath")
def scrag_dies(g):
    return hiss(g, 1.05, [(0, 640), (0.15, 720), (0.6, 330), (1, 110)], "iEau", FALL)


@sound("wizard/widle1")
def scrag_waits(g):
    return hiss(
        g, 1.6, [(0, 150), (0.3, 210), (0.6, 170), (1, 120)], "uiEu", [(0, 0), (0.2, 0.8), (0.45, 0.3), (0.7, 1), (1, 0)]
    )


@sound("wizard/widle2")
def scrag_whispers(g):
    return hiss(g, 1.1, [(0, 330), (0.5, 240), (1, 300)], "qiEi", [(0, 0), (0.3, 1), (0.5, 0.4), (0.75, 0.8), (1, 0)])


# -- the dead


def moan(g, seconds: float, pitch, vowels: str, level=None) -> np.ndarray:
    voice = cry(g, DEAD, seconds, pitch, vowels, level or LONG, (0.03, 3.5))
    rattle = train(g, len(voice), 24.0, strike(g, OAK, 480.0, 0.05, 2500.0, 0.8, 0.5), 0.8, loop=False, uneven=0.8)
    return layers(voice, 0.14 * unit(rattle) * curve(len(voice), level or LONG))


@sound("zombie/z_idle")
def zombie_waits(g):
    return moan(g, 1.4, [(0, 82), (0.4, 96), (1, 68)], "uoqu")


@sound("zombie/z_idle1")
def zombie_waits_on(g):
    return moan(g, 1.9, [(0, 74), (0.25, 88), (0.6, 104), (1, 62)], "moaou", [(0, 0), (0.2, 0.6), (0.6, 1), (1, 0)])


@sound("zombie/idle_w2")
def zombie_on_the_wall(g):
    return moan(
        g, 1.6, [(0, 110), (0.3, 135), (0.7, 100), (1, 72)], "aoEo", [(0, 0), (0.15, 0.9), (0.4, 0.5), (0.65, 0.9), (1, 0)]
    )


@sound("zombie/z_pain")
def zombie_hurts(g):
    return moan(g, 0.6, [(0, 120), (0.3, 140), (1, 85)], "Eo", BARK)


@sound("zombie/z_pain1")
def zombie_hurts_more(g):
    return moan(g, 0.85, [(0, 150), (0.2, 165), (1, 70)], "aou", BARK)


# -- vores


def chitter(g, n: int, rate: float) -> np.ndarray:
    return train(g, n, rate, strike(g, OAK, 1500.0, 0.03, 7000.0, 1.0, 0.35), 0.5, loop=False, uneven=0.6)


def wail(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    voice = throng(g, VORE, 3, seconds, pitch, vowels, level)
    return room(layers(voice, 0.3 * unit(chitter(g, len(voice), 26.0)) * curve(len(voice), level)), 0.8, 0.2)


@sound("shalrath/sight")
def vore_sees(g):
    return wail(g, 1.15, [(0, 170), (0.3, 300), (0.6, 260), (1, 150)], "uEaE", LONG)


@sound("shalrath/idle")
def vore_waits(g):
    n = samples(1.2)
    legs = chitter(g, n, 15.0) * curve(n, [(0, 0.2), (0.2, 1), (0.5, 0.3), (0.75, 0.9), (1, 0)])
    return layers(0.6 * unit(legs), wail(g, 1.0, [(0, 95), (0.5, 120), (1, 90)], "muru", LONG))


@sound("shalrath/pain")
def vore_hurts(g):
    return wail(g, 0.7, [(0, 330), (0.2, 400), (1, 180)], "Eia", BARK)


@sound("shalrath/death")
def vore_dies(g):
    return sequence(
        (0.0, wail(g, 1.3, [(0, 380), (0.2, 430), (0.6, 200), (1, 70)], "iEaou", FALL)),
        (0.95, 0.4 * unit(chitter(g, samples(0.5), 40.0))),
    )


@sound("shalrath/attack")
def vore_gathers(g):
    n = samples(1.0)
    glow = fm(curve(n, [(0, 110), (1, 440)], exponential=True), 2.76, curve(n, [(0, 0.5), (1, 3)]), n) * curve(
        n, [(0, 0), (0.8, 1), (1, 0)]
    )
    return layers(0.5 * glow, wail(g, 0.95, [(0, 120), (0.8, 240), (1, 220)], "moE", [(0, 0), (0.8, 1), (1, 0)]))


@sound("shalrath/attack2")
def vore_throws(g):
    n = samples(0.6)
    whirl = fm(curve(n, [(0, 620), (1, 190)], exponential=True), 2.76, 2.5, n) * curve(
        n, [(0, 0), (0.03, 1), (0.4, 0.4), (1, 0)]
    )
    air = rush(g, 0.6, [(0, 2200), (1, 500)], BARK, 1.0)
    return drive(
        room(layers(0.8 * whirl * (1.0 + 0.5 * sine(19.0, n)), 0.8 * unit(air), 0.5 * thud(g, 0.2, 200.0, 80.0)), 0.8, 0.2),
        1.3,
    )


# -- fish, slime


@sound("fish/idle")
def fish_swims(g):
    n = samples(0.9)
    air = bubbles(g, n, 26.0, (0.003, 0.011), 0.15, density=curve(n, [(0, 0.1), (0.3, 1), (0.6, 0.2), (0.8, 0.8), (1, 0.02)]))
    tail = lowpass(rush(g, 0.9, [(0, 180), (0.4, 420), (1, 200)], LONG, 1.0), 900.0)
    return layers(0.8 * unit(air), 0.6 * unit(tail))


@sound("fish/death")
def fish_dies(g):
    groan = Throat(size=0.95, rough=0.7, jitter=0.06, breath=0.4, growl=0.7, growl_hz=32.0, drive=2.0)
    voice = lowpass(cry(g, groan, 0.7, [(0, 260), (0.2, 310), (1, 90)], "Eou", FALL), 1500.0)
    return sequence((0.0, voice), (0.1, 0.8 * unit(splash(g, 0.8, 1.0))))


def blob(g, seconds: float, deep: float) -> np.ndarray:
    """Slime that speaks: bubbles as large as fists, and a formant that wanders."""
    n = samples(seconds)
    glop = bubbles(g, n, 24.0, (0.008, 0.02), 0.6, 2.2, density=curve(n, [(0, 0.4), (0.3, 1), (1, 0.05)]))
    gargle = Throat(size=1.3, rough=0.9, jitter=0.12, breath=0.6, growl=0.9, growl_hz=15.0, drive=1.5, width=1.8)
    voice = cry(g, gargle, seconds, [(0, deep), (0.4, 1.6 * deep), (1, 0.8 * deep)], "uomou", LONG)
    return layers(unit(glop), 0.8 * unit(voice), 0.4 * unit(squelch(g, seconds, 1.6, 40.0)))


@sound("blob/sight1")
def blob_sees(g):
    return blob(g, 1.2, 75.0)


@sound("blob/death1")
def blob_dies(g):
    return layers(blob(g, 1.2, 58.0), 0.9 * unit(squelch(g, 0.9, 1.8, 120.0)), 0.7 * thud(g, 0.3, 140.0, 45.0))


# -- gods


def out_of_fire(g, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    """The god in the lava: a throat like a furnace."""
    voice = throng(g, GOD, 2, seconds, pitch, vowels, level)
    n = len(voice)
    furnace = sweep(coloured(g, n, -2.5), [(0, 300), (0.4, 900), (1, 250)], 0.7, "low") * (1.0 + 0.5 * drift(g, n, 14.0))
    fire = layers(0.35 * unit(furnace * curve(n, level)), 0.2 * crackle(g, n, 50.0) * curve(n, level))
    return room(drive(layers(voice, fire), 1.4), 1.6, 0.25, 0.6)


@sound("boss1/out1")
def god_of_fire_rises(g):
    n = samples(1.6)
    lava = bubbles(g, n, 30.0, (0.014, 0.032), 0.5, 2.5, density=curve(n, [(0, 0.3), (0.4, 1), (1, 0.1)]))
    quake = lowpass(coloured(g, n, -4.0), 130.0) * curve(n, [(0, 0), (0.3, 1), (1, 0)])
    steam = unit(rush(g, 1.6, [(0, 800), (0.4, 4200), (1, 1800)], [(0, 0), (0.35, 1), (1, 0)], 0.7))
    return drive(room(layers(unit(lava), 1.1 * unit(quake), 0.5 * steam), 1.2, 0.2), 1.5)


@sound("boss1/sight1")
def god_of_fire_sees(g):
    return out_of_fire(g, 2.4, [(0, 38), (0.25, 72), (0.6, 64), (1, 34)], "uoaEao", LONG)


@sound("boss1/pain")
def god_of_fire_hurts(g):
    return out_of_fire(g, 1.0, [(0, 80), (0.2, 100), (1, 45)], "aEo", BARK)


@sound("boss1/death")
def god_of_fire_dies(g):
    return out_of_fire(g, 2.3, [(0, 95), (0.15, 110), (0.5, 60), (1, 24)], "aEaouu", FALL)


@sound("boss1/throw")
def god_of_fire_throws(g):
    n = samples(0.8)
    flame = sweep(coloured(g, n, -1.5), [(0, 500), (0.3, 2400), (1, 500)], 0.7, "low") * (1.0 + 0.5 * drift(g, n, 26.0))
    flame *= curve(n, [(0, 0), (0.15, 0.9), (0.35, 1), (1, 0)])
    return drive(
        layers(flame, 0.5 * crackle(g, n, 90.0), 0.7 * unit(rush(g, 0.8, [(0, 120), (0.35, 360), (1, 130)], LONG))), 1.6
    )


def from_below(g, parts: int, seconds: float, pitch, vowels: str, level) -> np.ndarray:
    """The mother of all: many throats under water."""
    voices = throng(g, MOTHER, parts, seconds, pitch, vowels, level)
    n = len(voices)
    wet = bubbles(g, n, 40.0, (0.005, 0.02), 0.3, 1.5) * curve(n, level)
    return room(layers(voices, 0.4 * unit(wet), 0.25 * unit(squelch(g, seconds, 1.6, 30.0)[:n])), 1.8, 0.3, 0.5)


@sound("boss2/sight")
def mother_sees(g):
    return from_below(g, 5, 2.0, [(0, 70), (0.35, 150), (0.7, 135), (1, 60)], "uoEau", LONG)


@sound("boss2/idle")
def mother_waits(g):
    return from_below(g, 4, 2.0, [(0, 48), (0.5, 66), (1, 44)], "muomu", [(0, 0), (0.3, 0.9), (0.5, 0.5), (0.75, 1), (1, 0)])


@sound("boss2/death")
def mother_dies(g):
    scream = from_below(g, 6, 3.0, [(0, 170), (0.15, 230), (0.5, 120), (1, 30)], "aEiaouu", FALL)
    return layers(scream, sequence((1.6, 0.6 * unit(squelch(g, 1.2, 2.0, 100.0)))))
