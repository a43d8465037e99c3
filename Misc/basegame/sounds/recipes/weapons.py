"""Weapons, what they hit, and explosions.

A shot is a crack (a few milliseconds of everything), a body (noise whose highs die first), a blow (a tone falling below
100 Hz), its machine, and the room. They are kept apart by which of these leads: shotguns crack, nail guns clack,
launchers blow, lightning tears.
"""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import bandpass, drive, highpass, rush, sweep
from sounds.kit.liquid import crackle, squelch
from sounds.kit.modal import CHAIN, COPPER, IRON, OAK, SLATE, STEEL, click, ring, strike, thud
from sounds.kit.space import room
from sounds.kit.waves import coloured, curve, decay, drift, fm, layers, samples, saw, sequence, sine, unit, white


def blow(seconds: float, high: float, low: float, speed: float = 0.04) -> np.ndarray:
    """A tone that falls from high to low Hz within about speed seconds: what the chest hears of a shot."""
    n = samples(seconds)
    t = np.arange(n) / 22050
    return sine(low + (high - low) * np.exp(-t / speed), n) * decay(n, seconds, 0.002)


def shot(g, seconds: float, bright: float, dark: float, crack: float, body: float, boom: float) -> np.ndarray:
    """The gunpowder's part of a shot; bright and dark: Hz below which its noise begins and ends."""
    n = samples(seconds)
    noise = sweep(white(g, n), [(0.0, bright), (0.12, 0.35 * bright), (0.5, dark), (1.0, 0.6 * dark)], 0.6, "low")
    out = body * noise * decay(n, 0.9 * seconds, 0.0006)
    snap = crack * click(g, 0.012, 9500.0)
    out[: len(snap)] += snap
    return layers(out, boom * blow(0.6 * seconds, 190.0, 48.0))


def explosion(g, seconds: float, size: float = 1.0) -> np.ndarray:
    n = samples(seconds)
    fire = sweep(coloured(g, n, -2.0), [(0.0, 9000.0), (0.05, 3500.0), (0.25, 900.0), (1.0, 220.0)], 0.6, "low")
    fire *= curve(n, [(0.0, 0.0), (0.004, 1.0), (0.08, 0.75), (0.3, 0.3), (0.7, 0.07), (1.0, 0.0)])
    fire *= 1.0 + 0.5 * drift(g, n, 18.0)
    debris = crackle(g, n, 160.0, density=curve(n, [(0.0, 0.1), (0.15, 1.0), (0.5, 0.5), (1.0, 0.05)]))
    out = layers(
        1.6 * fire, 1.1 * blow(0.7 * seconds, 150.0 / size, 34.0 / size, 0.09), 0.9 * click(g, 0.02, 9000.0), 0.35 * debris
    )
    return drive(room(out, 1.1 * size, 0.25, 0.6), 2.2)


@sound("weapons/r_exp3")
def explosion_of_rocket(g):
    return explosion(g, 1.25)


@sound("weapons/guncock")
def shotgun(g):
    bang = shot(g, 0.38, 9000.0, 700.0, 1.3, 1.0, 0.9)
    out = drive(room(bang, 0.7, 0.22, 0.5), 2.4)
    pump = sequence(
        (0.0, 0.9 * strike(g, IRON, 620.0, 0.12, 3800.0, 0.7, 0.35)),
        (0.02, 0.35 * rush(g, 0.09, [(0, 1400), (1, 2600)], [(0, 0), (0.3, 1), (1, 0)], 2.0)),
        (0.13, strike(g, IRON, 480.0, 0.16, 3200.0, 0.9, 0.35)),
    )
    return layers(out, sequence((0.42, 0.16 * pump)))


@sound("weapons/shotgn2")
def super_shotgun(g):
    bang = shot(g, 0.5, 8500.0, 420.0, 1.2, 1.1, 1.3)
    second = shot(g, 0.42, 6500.0, 380.0, 0.8, 0.8, 0.8)
    out = drive(room(sequence((0.0, bang), (0.014, 0.8 * second)), 0.9, 0.25, 0.5), 3.2)
    shells = sequence(
        (0.0, strike(g, CHAIN, 700.0, 0.15, 4200.0, 0.8, 0.5)),
        (0.17, 0.5 * strike(g, COPPER, 2100.0, 0.2, 8000.0, 0.2, 0.15)),
        (0.23, 0.9 * strike(g, IRON, 380.0, 0.2, 3000.0, 0.9, 0.35)),
    )
    return layers(out, sequence((0.5, 0.14 * shells)))


@sound("weapons/rocket1i")
def nail_gun(g):
    n = samples(0.16)
    gas = highpass(sweep(white(g, n), [(0.0, 6500.0), (1.0, 1400.0)], 0.7, "low"), 500.0) * decay(n, 0.13, 0.0005)
    rail = strike(g, STEEL, 510.0, 0.22, 5200.0, 0.6, 0.28)
    bolt = sequence((0.0, rail), (0.055, 0.45 * strike(g, IRON, 330.0, 0.12, 2600.0, 0.7, 0.3)))
    return drive(room(layers(1.1 * gas, 0.9 * bolt, 0.7 * blow(0.14, 240.0, 80.0, 0.02)), 0.35, 0.12), 1.8)


@sound("weapons/spike2")
def super_nail_gun(g):
    n = samples(0.2)
    gas = sweep(white(g, n), [(0.0, 7500.0), (0.3, 2400.0), (1.0, 700.0)], 0.7, "low") * decay(n, 0.17, 0.0005)
    rails = layers(strike(g, STEEL, 340.0, 0.26, 4200.0, 0.7, 0.3), 0.8 * strike(g, IRON, 270.0, 0.2, 3000.0, 0.5, 0.3))
    out = sequence((0.0, layers(1.3 * gas, rails, 1.1 * blow(0.2, 200.0, 58.0, 0.03))), (0.035, 0.5 * rails))
    return drive(room(out, 0.45, 0.15), 2.6)


@sound("weapons/sgun1")
def rocket_launcher(g):
    n = samples(0.95)
    jet = sweep(coloured(g, n, -1.5), [(0.0, 700.0), (0.06, 2600.0), (0.35, 1500.0), (1.0, 500.0)], 0.7)
    jet *= curve(n, [(0, 0), (0.01, 1.0), (0.1, 0.75), (0.4, 0.3), (1, 0)]) * (1.0 + 0.35 * drift(g, n, 60.0))
    tube = bandpass(white(g, n), 165.0, 6.0) * decay(n, 0.5, 0.004)
    out = layers(1.3 * jet, 2.4 * tube, 1.3 * blow(0.45, 170.0, 52.0, 0.06), 0.5 * click(g, 0.01, 6000.0))
    return drive(room(out, 0.9, 0.2, 0.5), 2.2)


@sound("weapons/grenade")
def grenade_launcher(g):
    n = samples(0.3)
    thump = layers(1.5 * blow(0.3, 260.0, 74.0, 0.035), 3.0 * bandpass(white(g, n), 230.0, 4.0) * decay(n, 0.22, 0.002))
    air = sweep(white(g, n), [(0.0, 3000.0), (1.0, 500.0)], 0.7, "low") * decay(n, 0.18, 0.001)
    chamber = sequence((0.19, 0.22 * strike(g, IRON, 540.0, 0.2, 3600.0, 0.8, 0.3)))
    return drive(room(layers(thump, 0.7 * air, chamber), 0.6, 0.18, 0.5), 1.6)


@sound("weapons/bounce")
def grenade_bounces(g):
    shell = layers(strike(g, IRON, 760.0, 0.3, 4200.0, 0.4, 0.5), 0.8 * strike(g, SLATE, 300.0, 0.1, 2200.0, 0.8))
    return room(layers(shell, 0.35 * blow(0.08, 230.0, 130.0, 0.02)), 0.5, 0.15)


def arc(g, seconds: float, rate: float, level) -> np.ndarray:
    """An electric arc: a buzz of mains that tears itself, and sparks."""
    n = samples(seconds)
    hum = saw(rate * (1.0 + 0.03 * drift(g, n, 40.0)), n) + 0.6 * saw(rate * 2.013, n)
    gate = np.clip(drift(g, n, 150.0) + 0.55, 0.0, 1.0)
    tear = highpass(white(g, n), 1800.0) * gate * (0.4 + 0.6 * np.abs(sine(rate, n)))
    ringing = fm(rate * 9.0 * (1.0 + 0.12 * drift(g, n, 25.0)), 1.414, 2.5 + 1.5 * drift(g, n, 30.0), n)
    sparks = crackle(g, n, 240.0)
    out = 0.55 * highpass(hum, 160.0) + 0.75 * tear + 0.4 * ringing * gate + 1.2 * sparks
    return drive(out * curve(n, level), 2.0)


@sound("weapons/lhit")
def lightning(g):
    return arc(g, 0.6, 118.0, [(0, 0), (0.01, 1), (0.85, 0.85), (1, 0)])


@sound("weapons/lstart")
def lightning_begins(g):
    discharge = arc(g, 0.8, 96.0, [(0, 0), (0.006, 1), (0.25, 0.55), (1, 0)])
    crack = layers(1.6 * click(g, 0.03, 10000.0), 1.2 * blow(0.35, 320.0, 60.0, 0.05))
    return drive(room(layers(discharge, crack), 1.0, 0.25, 0.4), 1.8)


@sound("weapons/ax1")
def axe_swings(g):
    air = rush(g, 0.26, [(0, 380), (0.45, 1500), (1, 600)], [(0, 0), (0.35, 0.5), (0.5, 1), (0.75, 0.3), (1, 0)], 1.6)
    edge = rush(g, 0.26, [(0, 1800), (0.5, 4200), (1, 2200)], [(0, 0), (0.4, 0.2), (0.52, 0.6), (0.7, 0), (1, 0)], 4.0)
    return air + 0.5 * edge


@sound("player/axhit1")
def axe_in_flesh(g):
    chop = layers(
        thud(g, 0.16, 190.0, 75.0, 0.7), 0.7 * strike(g, OAK, 320.0, 0.12, 1800.0, 0.9), 0.5 * click(g, 0.012, 5000.0)
    )
    return sequence((0.0, drive(chop, 1.5)), (0.012, 0.55 * unit(squelch(g, 0.24))))


@sound("player/axhit2")
def axe_on_stone(g):
    blade = strike(g, STEEL, 880.0, 0.4, 7000.0, 0.4, 0.45)
    chips = sequence((0.03, 0.25 * crackle(g, samples(0.18), 120.0)))
    return room(
        layers(blade, 1.3 * strike(g, SLATE, 420.0, 0.16, 3600.0, 1.2), 0.5 * blow(0.1, 240.0, 110.0, 0.02), chips), 0.5, 0.14
    )


@sound("weapons/tink1")
def nail_on_wall(g):
    nail = ring(g, STEEL, 2350.0, 0.16, 9000.0, 0.22)
    return layers(nail, 0.7 * strike(g, SLATE, 900.0, 0.07, 5200.0, 1.0, 0.8))


def ricochet(g, seconds: float, high: float, low: float, spin: float) -> np.ndarray:
    """A stray shot that tumbles away: a whine that falls, and trembles as fast as the shot spins."""
    n = samples(seconds)
    whine = curve(n, [(0.0, high), (0.25, 0.85 * high), (1.0, low)], exponential=True)
    whine *= 1.0 + 0.04 * sine(curve(n, [(0, spin), (1, 0.45 * spin)]), n)
    tone = fm(whine, 0.503, curve(n, [(0, 1.8), (1, 0.4)]), n) * curve(n, [(0, 0), (0.02, 1), (0.3, 0.5), (1, 0)])
    hit = layers(strike(g, SLATE, 620.0, 0.12, 5000.0, 1.5), 0.6 * ring(g, STEEL, 1700.0, 0.2, 8000.0, 0.3))
    return room(layers(hit, 0.5 * tone), 0.6, 0.16)


@sound("weapons/ric1")
def ricochet_1(g):
    return ricochet(g, 0.55, 3200.0, 1050.0, 52.0)


@sound("weapons/ric2")
def ricochet_2(g):
    return ricochet(g, 0.38, 2300.0, 1500.0, 85.0)


@sound("weapons/ric3")
def ricochet_3(g):
    return ricochet(g, 0.72, 3900.0, 700.0, 33.0)


@sound("soldier/sattck1")
def soldier_fires(g):
    bang = shot(g, 0.3, 7000.0, 900.0, 1.4, 0.8, 0.6)
    return drive(room(bang, 0.8, 0.3, 0.5), 2.0)


@sound("enforcer/enfire")
def laser(g):
    n = samples(0.42)
    falling = curve(n, [(0, 1900), (0.25, 820), (1, 240)], exponential=True)
    beam = fm(falling, 1.5, curve(n, [(0, 4.0), (0.4, 1.6), (1, 0.3)]), n) + 0.5 * saw(0.5 * falling, n)
    beam *= curve(n, [(0, 0), (0.006, 1), (0.35, 0.45), (1, 0)])
    return drive(room(layers(beam, 0.5 * click(g, 0.015, 8000.0), 0.5 * blow(0.2, 300.0, 90.0, 0.04)), 0.5, 0.18), 1.6)


@sound("enforcer/enfstop")
def laser_hits(g):
    n = samples(0.4)
    sizzle = highpass(white(g, n), 2200.0) * decay(n, 0.33, 0.001) * (0.5 + 0.5 * drift(g, n, 90.0))
    zap = fm(curve(n, [(0, 900), (1, 150)], exponential=True), 2.01, 2.0, n) * decay(n, 0.16, 0.001)
    return drive(room(layers(0.5 * sizzle, zap, 0.5 * strike(g, SLATE, 380.0, 0.1, 3000.0, 1.0)), 0.5, 0.15), 1.3)


@sound("wizard/hit")
def spittle_hits(g):
    n = samples(0.5)
    hiss = sweep(white(g, n), [(0.0, 5200.0), (1.0, 2400.0)], 0.8) * decay(n, 0.42, 0.004) * (0.7 + 0.3 * drift(g, n, 60.0))
    return layers(0.5 * hiss, 0.9 * unit(squelch(g, 0.3, 0.7)), 0.5 * thud(g, 0.12, 220.0, 110.0))


@sound("hknight/hit")
def fire_bolt_hits(g):
    n = samples(0.55)
    flame = sweep(coloured(g, n, -1.5), [(0.0, 2600.0), (1.0, 420.0)], 0.7, "low") * decay(n, 0.5, 0.003)
    flame *= 1.0 + 0.5 * drift(g, n, 30.0)
    return drive(layers(flame, 0.5 * crackle(g, n, 130.0), 0.7 * blow(0.2, 180.0, 70.0)), 1.4)


@sound("hknight/attack1")
def fire_bolt(g):
    bolt = rush(g, 0.5, [(0, 600), (0.2, 2300), (1, 800)], [(0, 0), (0.06, 1), (0.35, 0.4), (1, 0)], 1.1)
    n = len(bolt)
    flutter = 0.7 + 0.3 * sine(curve(n, [(0, 34), (1, 18)]), n)
    hum = fm(curve(n, [(0, 420), (1, 130)], True), 1.99, 1.4, n) * decay(n, 0.42, 0.01)
    return drive(room(layers(unit(bolt) * flutter, 0.6 * hum, 0.4 * crackle(g, n, 70.0) * decay(n, 0.5)), 0.7, 0.18), 1.3)


@sound("shambler/sattck1")
def lightning_gathers(g):
    n = samples(1.15)
    rise = curve(n, [(0, 70), (1, 420)], exponential=True)
    hum = saw(rise, n) + 0.6 * saw(1.498 * rise, n) + 0.8 * fm(3.0 * rise, 1.414, curve(n, [(0, 0.5), (1, 5)]), n)
    sparks = crackle(g, n, 260.0, density=curve(n, [(0, 0.05), (1, 1)]))
    swell = curve(n, [(0, 0), (0.3, 0.25), (0.9, 1.0), (1, 0)])
    out = sweep(hum, [(0, 300), (1, 4800)], 0.8, "low") * swell * (1.0 + 0.5 * sine(curve(n, [(0, 9), (1, 34)]), n))
    return drive(room(out + 1.6 * sparks * swell, 0.4, 0.15)[: samples(1.35)], 1.6)


@sound("shambler/sboom")
def lightning_bolt(g):
    crack = arc(g, 0.7, 74.0, [(0, 0), (0.004, 1), (0.2, 0.5), (1, 0)])
    roll = explosion(g, 0.8, 1.3)
    return drive(layers(1.1 * crack, 0.8 * roll, 1.8 * click(g, 0.035, 10000.0)), 1.8)


@sound("misc/power")
def great_discharge(g):
    crack = arc(g, 1.3, 60.0, [(0, 0), (0.01, 1), (0.6, 0.7), (1, 0)])
    return drive(room(layers(crack, blow(0.8, 210.0, 40.0, 0.12)), 1.2, 0.3, 0.4), 1.6)
