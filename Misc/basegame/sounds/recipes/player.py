"""The player: a man of the works, short of breath more often than of words."""

from __future__ import annotations

from sounds.catalogue import sound
from sounds.kit.filters import highpass, lowpass, rush, sweep
from sounds.kit.liquid import bubbles, crackle, splash, squelch
from sounds.kit.modal import SLATE, strike, thud
from sounds.kit.space import room
from sounds.kit.voice import Throat, cry
from sounds.kit.waves import curve, decay, drift, layers, samples, sequence, unit, white

MAN = Throat(size=1.0, rough=0.3, jitter=0.03, breath=0.15, drive=1.4, edge=7.0)
HURT = Throat(size=1.0, rough=0.55, jitter=0.06, breath=0.25, growl=0.35, growl_hz=42.0, drive=2.2, edge=8.5)
DYING = Throat(size=1.03, rough=0.6, jitter=0.07, breath=0.35, growl=0.4, growl_hz=24.0, drive=1.8, width=1.2, edge=7.0)
SHORT = [(0.0, 0.0), (0.06, 1.0), (0.45, 0.75), (1.0, 0.0)]


def breath(g, seconds: float, centre: float, inwards: bool, voice: float = 0.0) -> object:
    """A breath: noise through an open throat; inwards it rises."""
    throat = Throat(size=1.0, rough=0.5, breath=1.6, drive=0.4, width=1.6)
    pitch = [(0.0, 150.0), (1.0, 230.0)] if inwards else [(0.0, 170.0), (1.0, 110.0)]
    level = (
        [(0.0, 0.0), (0.35, 0.7), (0.8, 1.0), (1.0, 0.0)] if inwards else [(0.0, 0.0), (0.12, 1.0), (0.5, 0.5), (1.0, 0.0)]
    )
    voiced = unit(cry(g, throat, seconds, pitch, "Eq" if inwards else "aq", level))
    air = rush(g, seconds, [(0.0, 0.7 * centre), (1.0, 1.3 * centre if inwards else 0.6 * centre)], level, 1.0)
    return unit(air) + (0.4 + voice) * voiced


@sound("player/plyrjmp8")
def jumps(g):
    return cry(g, MAN, 0.24, [(0, 118), (0.35, 165), (1, 122)], "uq", SHORT)


@sound("player/land2")
def lands_hard(g):
    ground = layers(1.2 * thud(g, 0.2, 130.0, 60.0, 0.9), 0.6 * strike(g, SLATE, 330.0, 0.08, 2400.0, 0.7))
    groan = cry(g, HURT, 0.34, [(0, 175), (0.2, 150), (1, 92)], "oq", SHORT)
    return sequence((0.0, ground), (0.03, 0.8 * groan))


def groan(g, seconds: float, high: float, low: float, vowels: str) -> object:
    return cry(g, HURT, seconds, [(0, 0.9 * high), (0.12, high), (0.5, 0.85 * high), (1, low)], vowels, SHORT)


@sound("player/pain1")
def pain_1(g):
    return groan(g, 0.36, 190, 118, "ao")


@sound("player/pain2")
def pain_2(g):
    return groan(g, 0.42, 172, 96, "Ea")


@sound("player/pain3")
def pain_3(g):
    return groan(g, 0.48, 236, 128, "aq")


@sound("player/pain4")
def pain_4(g):
    return groan(g, 0.5, 205, 104, "oa")


@sound("player/pain5")
def pain_5(g):
    return groan(g, 0.6, 265, 122, "Eao")


@sound("player/pain6")
def pain_6(g):
    return groan(g, 0.64, 300, 112, "aEo")


def dying(g, seconds: float, pitch, vowels: str) -> object:
    level = [(0.0, 0.0), (0.05, 1.0), (0.35, 0.85), (0.7, 0.4), (1.0, 0.0)]
    return cry(g, DYING, seconds, pitch, vowels, level, (0.02, 6.0))


@sound("player/death1")
def death_1(g):
    return dying(g, 1.1, [(0, 210), (0.15, 260), (0.6, 150), (1, 70)], "aEou")


@sound("player/death2")
def death_2(g):
    return dying(g, 0.95, [(0, 170), (0.2, 185), (1, 62)], "oaqu")


@sound("player/death3")
def death_3(g):
    return sequence(
        (0.0, dying(g, 0.45, [(0, 240), (1, 140)], "Ea")),
        (0.42, 0.7 * dying(g, 0.8, [(0, 150), (0.4, 105), (1, 60)], "oqm")),
    )


@sound("player/death4")
def death_4(g):
    cut = dying(g, 1.0, [(0, 300), (0.2, 330), (0.7, 190), (1, 80)], "aaEo")
    return layers(cut, sequence((0.35, 0.3 * unit(squelch(g, 0.5, 0.7, 60.0)))))


@sound("player/death5")
def death_5(g):
    return sequence((0.0, dying(g, 0.7, [(0, 150), (0.3, 205), (1, 95)], "oau")), (0.68, 0.45 * breath(g, 0.6, 900.0, False)))


@sound("player/drown1", "player/drown2")
def drowns(g):
    choke = cry(
        g,
        HURT,
        0.55,
        [(0, g.uniform(150, 190)), (0.3, 200), (1, 100)],
        "uqu",
        [(0, 0), (0.1, 1), (0.5, 0.3), (0.6, 0.8), (1, 0)],
    )
    n = samples(0.85)
    air = bubbles(g, n, 75.0, (0.002, 0.011), 0.15, density=curve(n, [(0, 0.3), (0.25, 1), (1, 0.05)]))
    return layers(0.9 * lowpass(choke, 750.0, order=2), 0.9 * unit(air))


@sound("player/h2odeath")
def drowns_at_last(g):
    moan = cry(g, DYING, 1.2, [(0, 175), (0.2, 205), (1, 70)], "uoqu", [(0, 0), (0.1, 1), (0.5, 0.5), (1, 0)])
    n = samples(1.8)
    air = bubbles(g, n, 85.0, (0.002, 0.014), 0.15, density=curve(n, [(0, 0.2), (0.2, 1), (0.6, 0.5), (1, 0.03)]))
    return layers(lowpass(moan, 650.0, order=2), 1.1 * unit(air))


@sound("player/gasp1")
def breathes_again(g):
    return breath(g, 0.62, 1500.0, True, 0.1)


@sound("player/gasp2")
def breathes_at_last(g):
    return sequence((0.0, breath(g, 0.75, 1750.0, True, 0.7)), (0.8, 0.35 * breath(g, 0.4, 1000.0, False)))


@sound("player/inh2o")
def into_water(g):
    return lowpass(splash(g, 0.95, 1.3), 7000.0)


@sound("player/h2ojump")
def out_of_water_by_jump(g):
    return sequence((0.0, splash(g, 0.7, 0.85)), (0.12, 0.25 * splash(g, 0.5, 0.6)))


@sound("misc/outwater")
def out_of_water(g):
    n = samples(0.9)
    pour = sweep(white(g, n), [(0, 900), (0.3, 2600), (1, 3800)], 0.8) * curve(n, [(0, 0), (0.15, 1), (0.4, 0.4), (1, 0)])
    drops = bubbles(g, n, 70.0, (0.0009, 0.004), 0.1, density=curve(n, [(0, 0.1), (0.3, 1), (1, 0.25)]))
    return layers(0.5 * pour, 1.0 * unit(drops))


@sound("misc/h2ohit1")
def something_into_water(g):
    return splash(g, 0.8, 0.9)


@sound("misc/water1", "misc/water2")
def swims(g):
    n = samples(0.75)
    pull = sweep(white(g, n), [(0, 400), (0.4, g.uniform(900, 1300)), (1, 450)], 1.0) * curve(n, [(0, 0), (0.35, 1), (1, 0)])
    drawn = bubbles(g, n, 60.0, (0.002, 0.009), 0.12, density=curve(n, [(0, 0.1), (0.45, 1), (0.9, 0.1), (1, 0)]))
    return layers(0.8 * unit(pull), 0.8 * unit(drawn))


@sound("player/slimbrn2", "player/slmbrn2")  # Quake's code names the first, LibreQuake's files the second
def burnt_by_slime(g):
    n = samples(0.85)
    fizz = highpass(white(g, n), 2600.0) * (0.5 + 0.5 * drift(g, n, 45.0)) * curve(n, [(0, 0), (0.06, 1), (0.5, 0.4), (1, 0)])
    boil = bubbles(g, n, 90.0, (0.002, 0.01), 0.35, 2.5)
    return layers(0.5 * fizz, 0.9 * unit(boil) * curve(n, [(0, 0.4), (0.2, 1), (1, 0)]), 0.5 * unit(squelch(g, 0.4, 1.2)))


@sound("player/inlava")
def into_lava(g):
    n = samples(1.2)
    steam = sweep(white(g, n), [(0, 1500), (0.15, 5200), (1, 2800)], 0.7) * curve(n, [(0, 0), (0.05, 1), (0.35, 0.4), (1, 0)])
    glop = bubbles(g, n, 26.0, (0.012, 0.03), 0.5, 3.0, density=curve(n, [(0, 1), (0.6, 0.5), (1, 0.02)]))
    return layers(0.7 * unit(steam), 0.9 * unit(glop), 0.6 * thud(g, 0.3, 120.0, 45.0, 0.8), 0.5 * crackle(g, n, 60.0))


@sound("player/lburn1", "player/lburn2")
def burnt_by_lava(g):
    n = samples(g.uniform(0.7, 0.9))
    hiss = highpass(white(g, n), 3000.0) * decay(n, n / 22050, 0.01) * (0.55 + 0.45 * drift(g, n, 35.0))
    fat = crackle(g, n, 190.0, density=curve(n, [(0, 1), (1, 0.1)]))
    return room(layers(0.8 * unit(hiss), 1.0 * unit(fat), 0.3 * thud(g, 0.2, 140.0, 70.0)), 0.3, 0.1)
