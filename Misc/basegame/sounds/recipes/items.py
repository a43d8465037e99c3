"""Things that are taken, powers that come and go, messages, keys, teleports, the menu.

Bright and short for what is good and small; a chord for what is great. Powers keep an interval of their own from the
moment they are taken until they run out: damage a tritone, protection a fifth, the ring a whole tone, the suit air.
"""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import drive, highpass, lowpass, rush, sweep
from sounds.kit.liquid import bubble, bubbles
from sounds.kit.modal import BRONZE, CHAIN, COPPER, CRYSTAL, IRON, OAK, STEEL, click, ring, strike, thud, train
from sounds.kit.space import room
from sounds.kit.voice import Throat, syllables, throng
from sounds.kit.waves import coloured, curve, decay, drift, fm, layers, pulse, samples, saw, sequence, sine, unit

CHOIR = Throat(size=1.0, rough=0.1, jitter=0.01, breath=0.1, drive=0.2, edge=2.0)


def chime(g, hz: float, seconds: float = 0.6) -> np.ndarray:
    return ring(g, CRYSTAL, hz, seconds, 6000.0, 0.8) + 0.5 * sine(hz, samples(seconds)) * decay(
        samples(seconds), 0.8 * seconds, 0.003
    )


def pad(g, notes, seconds: float, level, bright: float = 1800.0) -> np.ndarray:
    """A chord of detuned saws, dulled."""
    n = samples(seconds)
    out = np.zeros(n)
    for hz in notes:
        for off in (0.994, 1.0, 1.007):
            out += saw(hz * off, n, g.random())
    return lowpass(out, bright) * curve(n, level)


# -- small things


@sound("items/health1")
def health(g):
    return room(sequence((0.0, chime(g, 659.0, 0.35)), (0.08, chime(g, 988.0, 0.45))), 0.4, 0.1)


@sound("items/r_item1")
def little_health(g):
    gulp = sequence((0.0, bubble(0.009, 0.3, 3.0)), (0.06, 0.7 * bubble(0.006, 0.3, 2.0)))
    return room(layers(0.6 * chime(g, 494.0, 0.4), 0.7 * unit(gulp)), 0.4, 0.1)


@sound("items/r_item2")
def great_health(g):
    notes = [(0.07 * k, 0.8 * chime(g, hz, 0.7)) for k, hz in enumerate((392.0, 494.0, 587.0, 784.0, 988.0))]
    return room(layers(sequence(*notes), 0.12 * pad(g, (98.0, 147.0, 196.0), 0.9, [(0, 0), (0.1, 1), (1, 0)])), 0.6, 0.15)


@sound("items/armor1")
def armour(g):
    plates = train(g, samples(0.4), 15.0, strike(g, CHAIN, 760.0, 0.25, 5200.0, 0.6), 0.7, loop=False, uneven=0.5)
    buckle = strike(g, STEEL, 1180.0, 0.25, 8000.0, 0.5, 0.22)
    return room(sequence((0.0, layers(unit(plates), 0.5 * thud(g, 0.15, 150.0, 80.0))), (0.34, 0.8 * buckle)), 0.4, 0.12)


@sound("weapons/lock4")
def ammunition(g):
    rattle = train(g, samples(0.14), 60.0, strike(g, COPPER, 2300.0, 0.08, 8000.0, 0.4, 0.1), 0.9, loop=False, uneven=0.7)
    return layers(
        strike(g, IRON, 720.0, 0.2, 4500.0, 0.9, 0.25),
        sequence((0.04, 0.6 * unit(rattle))),
        sequence((0.12, 0.7 * strike(g, IRON, 900.0, 0.14, 5200.0, 0.8, 0.2))),
    )


@sound("weapons/pkup")
def weapon(g):
    low = strike(g, IRON, 340.0, 0.25, 3400.0, 1.0, 0.35)
    high = strike(g, IRON, 560.0, 0.3, 4800.0, 1.0, 0.35)
    return room(sequence((0.0, low), (0.13, layers(high, 0.5 * thud(g, 0.15, 170.0, 85.0)))), 0.4, 0.14)


@sound("items/itembk2")
def item_returns(g):
    n = samples(0.35)
    backwards = chime(g, 784.0, 0.35)[::-1] * curve(n, [(0, 0), (1, 1)])
    return room(sequence((0.0, 0.8 * backwards), (0.33, chime(g, 1175.0, 0.4))), 0.6, 0.2)


# -- powers


@sound("items/damage")
def damage_taken(g):
    swell = drive(unit(pad(g, (55.0, 77.8, 110.0), 1.6, [(0, 0), (0.25, 1), (0.5, 0.7), (1, 0)], 1400.0)), 2.5)
    bolt = sequence((0.3, layers(0.9 * click(g, 0.03, 8000.0), thud(g, 0.6, 150.0, 40.0))))
    return room(layers(swell, bolt), 1.2, 0.25)


@sound("items/damage2")
def damage_ends(g):
    n = samples(2.0)
    fall = curve(n, [(0, 1.0), (1, 0.6)])
    out = (saw(110.0 * fall, n) + saw(155.6 * fall, n)) * (0.55 + 0.45 * sine(curve(n, [(0, 10), (1, 3.5)]), n))
    return room(drive(lowpass(out, 1300.0), 1.0) * curve(n, [(0, 0), (0.05, 1), (0.7, 0.6), (1, 0)]), 0.9, 0.2)


@sound("items/damage3")
def damage_dealt(g):
    n = samples(0.75)
    whip = fm(curve(n, [(0, 330), (0.2, 110), (1, 55)], True), 1.414, curve(n, [(0, 5), (1, 0.5)]), n) * decay(n, 0.7, 0.003)
    return drive(room(layers(whip, thud(g, 0.5, 160.0, 42.0, 0.5)), 0.8, 0.2), 2.0)


@sound("items/protect")
def protection_taken(g):
    choir = throng(g, CHOIR, 4, 1.5, [(0, 147), (1, 147)], "uoa", [(0, 0), (0.3, 1), (0.6, 0.8), (1, 0)])
    fifth = throng(g, CHOIR, 3, 1.5, [(0, 220), (1, 220)], "uoa", [(0, 0), (0.35, 1), (0.6, 0.8), (1, 0)])
    bell = 0.9 * ring(g, BRONZE, 294.0, 1.6, 4200.0, 0.5)
    return room(layers(0.7 * unit(choir), 0.6 * unit(fifth), bell), 1.4, 0.3)


@sound("items/protect2")
def protection_ends(g):
    n = samples(1.9)
    tremble = (0.5 + 0.5 * sine(curve(n, [(0, 11), (1, 4)]), n)) * curve(n, [(0, 0), (0.05, 1), (0.75, 0.6), (1, 0)])
    fifth = sum(sine(hz * curve(n, [(0, 1), (1, 0.9)]), n) for hz in (147.0, 220.0, 441.0))
    cracks = train(g, n, 7.0, ring(g, CRYSTAL, 1650.0, 0.2, 7000.0, 0.25), 0.9, loop=False, uneven=0.7)
    return room(layers(0.5 * fifth * tremble, 0.5 * unit(cracks)), 1.0, 0.25)


@sound("items/protect3")
def protection_holds(g):
    bell = layers(ring(g, BRONZE, 220.0, 0.9, 3800.0, 0.35), 0.7 * ring(g, BRONZE, 330.0, 0.9, 3800.0, 0.3))
    return room(layers(bell, 0.7 * click(g, 0.02, 6000.0), 0.4 * thud(g, 0.15, 180.0, 90.0)), 0.8, 0.2)


def whispers(g, seconds: float, pitch: float = 170.0) -> np.ndarray:
    whisper = Throat(size=0.95, rough=1.0, breath=2.5, drive=0.3, width=0.9)
    layers_of = [
        (g.uniform(0.0, 0.35 * seconds), syllables(g, whisper, text, pitch, 0.13))
        for text in ("sai to si", "tis kas o", "iso ta se".replace("e", "E"))
    ]
    out = highpass(sequence(*layers_of), 700.0)[: samples(seconds)]
    return out * curve(len(out), [(0, 0), (0.15, 1), (0.8, 0.8), (1, 0)])


@sound("items/inv1")
def ring_taken(g):
    n = samples(1.7)
    vanish = sum(sine(hz * curve(n, [(0, 1), (1, 1.12)]), n) for hz in (330.0, 370.0, 742.0)) * curve(
        n, [(0, 0), (0.2, 1), (1, 0)]
    )
    return room(layers(0.25 * vanish * (0.7 + 0.3 * sine(6.0, n)), unit(whispers(g, 1.6))), 1.6, 0.35, 0.2)


@sound("items/inv2")
def ring_ends(g):
    n = samples(1.9)
    flutter = (0.5 + 0.5 * sine(curve(n, [(0, 13), (1, 5)]), n)) * curve(n, [(0, 0), (0.05, 1), (0.8, 0.6), (1, 0)])
    tone = sum(sine(hz * curve(n, [(0, 1.12), (1, 0.95)]), n) for hz in (330.0, 370.0))
    return room(layers(0.4 * tone * flutter, 0.6 * unit(whispers(g, 1.6))), 1.2, 0.3, 0.2)


@sound("items/inv3")
def ring_haunts(g):
    return room(unit(whispers(g, 1.7, 150.0)), 2.0, 0.5, 0.2)


@sound("items/suit")
def suit_taken(g):
    inward = rush(g, 0.8, [(0, 700), (1, 2300)], [(0, 0), (0.6, 1), (0.9, 0.6), (1, 0)], 0.9)
    seal = layers(strike(g, COPPER, 420.0, 0.4, 3600.0, 0.8, 0.3), 0.6 * thud(g, 0.2, 140.0, 70.0))
    outward = rush(g, 0.7, [(0, 1500), (1, 600)], [(0, 0), (0.15, 1), (1, 0)], 0.9)
    air = bubbles(g, samples(0.5), 34.0, (0.003, 0.008), 0.15)
    return room(
        sequence((0.0, 0.8 * unit(inward)), (0.8, seal), (1.0, 0.6 * unit(outward)), (1.15, 0.4 * unit(air))), 0.5, 0.12
    )


@sound("items/suit2")
def suit_ends(g):
    leak = rush(g, 2.1, [(0, 4200), (1, 2600)], [(0, 0), (0.1, 1), (0.8, 0.6), (1, 0)], 1.0) * (
        0.7 + 0.3 * drift(g, samples(2.1), 9.0)
    )
    air = bubbles(g, samples(2.0), 30.0, (0.002, 0.007), 0.15, density=curve(samples(2.0), [(0, 0.3), (0.7, 1), (1, 0.05)]))
    taps = sequence(*[(0.45 * k, 0.7 * strike(g, COPPER, 880.0, 0.3, 5200.0, 0.5, 0.15)) for k in range(4)])
    return layers(0.35 * unit(leak), 0.5 * unit(air), taps)


# -- keys


@sound("misc/medkey")
def iron_key(g):
    jingle = train(g, samples(0.5), 13.0, ring(g, STEEL, 1900.0, 0.3, 9000.0, 0.3), 0.9, loop=False, uneven=0.6)
    return room(layers(0.7 * unit(jingle), sequence((0.12, 0.8 * ring(g, BRONZE, 440.0, 0.9, 4500.0, 0.3)))), 0.8, 0.2)


@sound("misc/runekey")
def rune_key(g):
    n = samples(1.0)
    hum = fm(220.0, 1.498, curve(n, [(0, 0), (0.3, 2.5), (1, 0.3)]), n) * curve(n, [(0, 0), (0.25, 1), (1, 0)])
    return room(layers(0.5 * hum, sequence((0.0, 0.7 * chime(g, 587.0, 0.9)), (0.12, 0.7 * chime(g, 880.0, 0.8)))), 1.0, 0.25)


@sound("misc/basekey")
def electric_key(g):
    beeps = [
        (0.1 * k, pulse(hz, samples(0.08), 0.4) * curve(samples(0.08), [(0, 0), (0.1, 1), (0.7, 0.7), (1, 0)]))
        for k, hz in enumerate((659.0, 880.0, 1319.0))
    ]
    return room(layers(0.6 * lowpass(sequence(*beeps), 3800.0), strike(g, STEEL, 1300.0, 0.2, 7000.0, 0.6, 0.2)), 0.4, 0.12)


# -- messages


@sound("misc/secret")
def secret(g):
    notes = [(0.13 * k, ring(g, BRONZE, hz, 1.2, 4500.0, 0.32)) for k, hz in enumerate((294.0, 349.0, 440.0, 622.0))]
    breath = rush(g, 1.2, [(0, 400), (0.5, 1600), (1, 700)], [(0, 0), (0.4, 1), (1, 0)], 1.0)
    return room(layers(sequence(*notes), 0.25 * unit(breath)), 1.3, 0.3)


@sound("misc/trigger1")
def something_happens(g):
    works = train(g, samples(0.45), 15.0, strike(g, IRON, 620.0, 0.12, 4200.0, 0.8, 0.3), 0.3, loop=False, uneven=0.4)
    return room(
        sequence(
            (0.0, 0.4 * unit(works)),
            (0.42, ring(g, BRONZE, 196.0, 1.0, 2600.0, 0.35)),
            (0.42, 0.7 * thud(g, 0.3, 120.0, 55.0)),
        ),
        1.0,
        0.22,
    )


@sound("misc/talk")
def talk(g):
    return sequence((0.0, ring(g, CRYSTAL, 784.0, 0.16, 5000.0, 0.25)), (0.08, ring(g, CRYSTAL, 1047.0, 0.2, 5000.0, 0.25)))


@sound("misc/menu1")
def menu_moves(g):
    return layers(strike(g, OAK, 620.0, 0.1, 4200.0, 0.6, 0.8), 0.3 * ring(g, STEEL, 1500.0, 0.12, 7000.0, 0.12))


@sound("misc/menu2")
def menu_enters(g):
    return room(
        layers(strike(g, IRON, 440.0, 0.25, 3800.0, 0.8, 0.35), 0.5 * ring(g, BRONZE, 330.0, 0.4, 3500.0, 0.15)), 0.4, 0.15
    )


@sound("misc/menu3")
def menu_changes(g):
    return layers(strike(g, STEEL, 1250.0, 0.08, 8000.0, 0.5, 0.09), 0.4 * strike(g, OAK, 820.0, 0.06, 4200.0, 0.6, 0.6))


@sound("misc/null")
def nothing(g):
    return np.zeros(samples(0.05))


# -- teleports


def teleport(g, low: float, high: float, turn: float, ratio: float, glass: float) -> np.ndarray:
    """Down to low Hz, torn through at turn (place 0..1), and up again; glass: Hz of the shards."""
    n = samples(1.05)
    there = curve(n, [(0, high), (turn, low), (turn + 0.25, 1.6 * low), (1, 0.4 * high)], exponential=True)
    warp = fm(there, ratio, curve(n, [(0, 1), (turn, 6), (1, 0.5)]), n) * curve(n, [(0, 0), (0.05, 0.8), (turn, 1), (1, 0)])
    air = sweep(coloured(g, n, -1.0), [(0, 4800), (turn, 500), (1, 3600)], 1.2)
    air *= curve(n, [(0, 0), (0.08, 0.7), (turn, 1), (turn + 0.25, 0.4), (1, 0)])
    shards = train(g, n, 26.0, ring(g, CRYSTAL, glass, 0.25, 8000.0, 0.25), 1.0, loop=False, uneven=0.9)
    shards = unit(shards) * curve(n, [(0, 0), (turn, 0.2), (turn + 0.05, 1), (1, 0)])
    snap = sequence((turn * 1.05, layers(0.8 * click(g, 0.02, 8000.0), 0.9 * thud(g, 0.35, 170.0, 45.0))))
    return room(layers(0.6 * warp, 0.7 * unit(air), 0.4 * shards, snap), 1.2, 0.3, 0.3)


@sound("misc/r_tele1")
def teleport_1(g):
    return teleport(g, 90.0, 1300.0, 0.35, 1.414, 1500.0)


@sound("misc/r_tele2")
def teleport_2(g):
    return teleport(g, 130.0, 900.0, 0.22, 2.01, 1900.0)


@sound("misc/r_tele3")
def teleport_3(g):
    return teleport(g, 70.0, 1800.0, 0.5, 1.5, 1250.0)


@sound("misc/r_tele4")
def teleport_4(g):
    return teleport(g, 160.0, 2400.0, 0.3, 0.503, 2300.0)


@sound("misc/r_tele5")
def teleport_5(g):
    return teleport(g, 55.0, 700.0, 0.42, 2.76, 1050.0)
