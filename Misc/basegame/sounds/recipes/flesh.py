"""Bodies: blows that land, flesh that bursts, corpses that fall, swings that miss."""

from __future__ import annotations

from sounds.catalogue import sound
from sounds.kit.filters import drive, lowpass, rush
from sounds.kit.liquid import splash, squelch
from sounds.kit.modal import CHAIN, IRON, OAK, SLATE, STEEL, click, ring, strike, thud, train
from sounds.kit.space import room
from sounds.kit.waves import curve, layers, samples, sequence, sine, unit, white


def burst(g, seconds: float, weight: float) -> object:
    """A body that is torn apart: a blow, a wet burst, pieces that land."""
    first = layers(thud(g, 0.25, 170.0 / weight, 55.0 / weight, 0.9), 0.8 * click(g, 0.02, 5500.0))
    wet = unit(squelch(g, 0.55 * seconds, weight, 140.0))
    out = [(0.0, drive(first, 1.6)), (0.01, 0.95 * wet)]
    for _ in range(5):
        piece = layers(0.5 * thud(g, 0.12, 190.0, 90.0, 0.8), 0.8 * unit(squelch(g, 0.16, 0.8)))
        out.append((seconds * g.uniform(0.3, 0.75), g.uniform(0.2, 0.5) * piece))
    return room(sequence(*out), 0.5, 0.12)


def crack_of_bone(g) -> object:
    grain = strike(g, OAK, 900.0, 0.06, 4200.0, 1.0, 0.6)
    return train(g, samples(0.14), 60.0, grain, 0.9, loop=False, uneven=0.8)


@sound("player/gib")
def gibs(g):
    return burst(g, 1.1, 1.0)


@sound("player/udeath")
def bursts_apart(g):
    return sequence((0.0, burst(g, 0.95, 1.15)), (0.015, 0.45 * unit(crack_of_bone(g))))


@sound("player/teledth1")
def burst_by_teleport(g):
    n = samples(0.25)
    snap = sine(curve(n, [(0, 2400), (1, 60)], exponential=True), n) * curve(n, [(0, 1), (0.3, 0.4), (1, 0)])
    return sequence((0.0, 0.5 * snap), (0.05, burst(g, 1.0, 1.0)))


@sound("player/tornoff2")
def torn_off(g):
    return sequence((0.0, 0.9 * unit(crack_of_bone(g))), (0.05, unit(squelch(g, 0.5, 0.9, 120.0))))


@sound("zombie/z_gib")
def zombie_bursts(g):
    return sequence((0.0, burst(g, 1.0, 0.95)), (0.02, 0.35 * unit(squelch(g, 0.7, 1.4, 60.0))))


@sound("zombie/z_hit")
def thrown_flesh_hits(g):
    return sequence((0.0, thud(g, 0.2, 210.0, 80.0, 0.8)), (0.005, unit(squelch(g, 0.32, 1.0, 110.0))))


@sound("zombie/z_miss")
def thrown_flesh_misses(g):
    slap = layers(0.8 * thud(g, 0.14, 260.0, 120.0, 1.0), 0.5 * click(g, 0.02, 3500.0))
    return sequence((0.0, slap), (0.01, 0.8 * unit(squelch(g, 0.4, 0.7, 130.0))))


@sound("zombie/z_shot1")
def flesh_is_thrown(g):
    tear = 0.8 * unit(squelch(g, 0.2, 0.8, 90.0))
    swing = rush(g, 0.3, [(0, 350), (0.5, 1100), (1, 500)], [(0, 0), (0.5, 1), (1, 0)], 1.4)
    return layers(tear, 0.9 * unit(swing))


@sound("zombie/z_fall")
def zombie_falls(g):
    ground = layers(thud(g, 0.35, 120.0, 48.0, 0.7), 0.35 * strike(g, SLATE, 260.0, 0.1, 1500.0, 0.5))
    return sequence((0.0, ground), (0.13, 0.45 * thud(g, 0.2, 160.0, 80.0, 0.8)), (0.02, 0.25 * unit(squelch(g, 0.35))))


@sound("player/land")
def lands(g):
    sole = layers(thud(g, 0.14, 140.0, 70.0, 0.8), 0.4 * strike(g, SLATE, 380.0, 0.06, 2200.0, 0.6))
    return layers(sole, sequence((0.02, 0.08 * strike(g, CHAIN, 1500.0, 0.12, 5000.0, 0.3))))


@sound("demon/dland2")
def heavy_landing(g):
    claws = sequence(*[(0.02 * k, 0.3 * strike(g, SLATE, 700.0 + 150.0 * k, 0.1, 4200.0, 0.6)) for k in range(4)])
    return room(layers(1.2 * thud(g, 0.45, 110.0, 40.0, 0.7), claws), 0.6, 0.15, 0.6)


@sound("demon/dhit2")
def claws_hit(g):
    rip = rush(g, 0.22, [(0, 3800), (1, 900)], [(0, 0), (0.04, 1), (0.5, 0.4), (1, 0)], 1.0)
    return drive(layers(thud(g, 0.22, 180.0, 65.0, 0.8), 0.8 * unit(rip), 0.6 * unit(squelch(g, 0.3, 0.9, 110.0))), 1.4)


@sound("shambler/smack")
def great_claws_hit(g):
    hit = layers(1.3 * thud(g, 0.4, 130.0, 42.0, 0.9), 0.5 * click(g, 0.02, 4500.0))
    return drive(
        sequence((0.0, hit), (0.01, 0.7 * unit(squelch(g, 0.5, 1.3, 110.0))), (0.02, 0.4 * unit(crack_of_bone(g)))), 1.5
    )


@sound("shambler/melee1", "shambler/melee2")
def great_swing(g):
    high = g.uniform(620.0, 900.0)
    air = rush(g, 0.5, [(0, 180), (0.5, high), (1, 220)], [(0, 0), (0.35, 0.5), (0.52, 1), (0.8, 0.2), (1, 0)], 1.2)
    low = rush(g, 0.5, [(0, 90), (0.5, 240), (1, 80)], [(0, 0), (0.5, 1), (1, 0)], 1.5)
    return unit(air) + 0.8 * unit(low)


def blade(g, seconds: float, high: float, steel: float) -> object:
    air = rush(
        g,
        seconds,
        [(0, 0.3 * high), (0.5, high), (1, 0.45 * high)],
        [(0, 0), (0.35, 0.3), (0.5, 1), (0.7, 0.25), (1, 0)],
        1.8,
    )
    return sequence((0.0, unit(air)), (0.4 * seconds, steel * ring(g, STEEL, 1350.0, 0.3, 9000.0, 0.35)))


@sound("knight/sword1")
def sword(g):
    return blade(g, 0.3, 2300.0, 0.16)


@sound("knight/sword2")
def sword_strikes(g):
    return blade(g, 0.34, 1800.0, 0.3)


@sound("hknight/slash1")
def great_sword(g):
    return layers(
        blade(g, 0.38, 1500.0, 0.34), 0.7 * unit(rush(g, 0.38, [(0, 150), (0.5, 420), (1, 160)], [(0, 0), (0.5, 1), (1, 0)]))
    )


@sound("ogre/ogdrag")
def drags_the_saw(g):
    n = samples(0.85)
    scrape = train(g, n, 95.0, strike(g, IRON, 420.0, 0.12, 4200.0, 0.6, 0.3), 0.9, loop=False, uneven=0.8)
    stone = lowpass(white(g, n), 1800.0) * 0.25
    return (unit(scrape) + stone) * curve(n, [(0, 0), (0.1, 0.6), (0.35, 1), (0.6, 0.5), (0.8, 0.7), (1, 0)])


@sound("fish/bite")
def jaws_snap(g):
    snap = sequence(
        (0.0, 0.6 * strike(g, OAK, 620.0, 0.1, 3800.0, 1.0, 0.8)), (0.018, strike(g, OAK, 480.0, 0.12, 3200.0, 1.2, 0.8))
    )
    return layers(snap, 0.8 * unit(splash(g, 0.42, 0.7)))


@sound("blob/hit1")
def slime_hits(g):
    return layers(0.7 * thud(g, 0.2, 200.0, 70.0, 0.5), unit(squelch(g, 0.45, 1.6, 70.0)))


@sound("blob/land1")
def slime_lands(g):
    return layers(0.9 * thud(g, 0.25, 150.0, 60.0, 0.4), unit(squelch(g, 0.38, 2.0, 55.0)))


@sound("boss2/pop2")
def flesh_pops(g):
    n = samples(0.3)
    pop = sine(curve(n, [(0, 120), (0.15, 700), (1, 160)], exponential=True), n) * curve(
        n, [(0, 0), (0.05, 1), (0.4, 0.2), (1, 0)]
    )
    return drive(room(layers(pop, burst(g, 1.1, 1.4)), 1.2, 0.25, 0.5), 1.4)
