"""Doors, lifts, trains, buttons: stone, chain, oak, iron, steam.

What moves repeats one turn of its machine for as long as it moves, behind the jolt of its start; what stops has a sound of
its own. Turns are periodic to the sample: their noise is filtered round the circle and their tones make whole turns.
"""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import bandpass, highpass, lowpass, peaks, rush
from sounds.kit.master import Loop
from sounds.kit.modal import BRONZE, CHAIN, IRON, OAK, SLATE, STEEL, click, strike, thud, train
from sounds.kit.space import room, room_loop

from sounds.kit.waves import (
    RATE, coloured, curve, drift, layers, loop_samples, pulse, samples, saw, sequence, sine, unit, white
)  # fmt: skip


def whole(hz: float, n: int) -> float:
    """The frequency nearest to hz that makes whole turns in n samples."""
    return max(1, round(hz * n / RATE)) * RATE / n


def grinding(g, n: int, rate: float, base: float, rough: float = 1.0) -> np.ndarray:
    """Stone on stone, periodic: grains that let go one by one over a rumble."""
    grains = train(g, n, rate, strike(g, SLATE, base, 0.1, 2600.0, 0.8), 1.0, uneven=0.9)
    rumble = lowpass(coloured(g, n, -3.0), 240.0, loop=True)
    scrape = bandpass(white(g, n), 1300.0, 0.8, loop=True) * (0.6 + 0.4 * drift(g, n, 14.0, loop=True))
    sway = 0.8 + 0.2 * drift(g, n, 3.0, loop=True)
    return (0.7 * unit(grains) * rough + 0.8 * unit(rumble) + 0.18 * unit(scrape)) * sway


def chain(g, n: int, links: int, base: float) -> np.ndarray:
    """links of a chain that run over a wheel within n samples, periodic."""
    rate = links * RATE / n
    big = train(g, n, rate, strike(g, CHAIN, base, 0.25, 5200.0, 0.7), 0.12, uneven=0.25)
    small = train(g, n, 2.0 * rate, strike(g, CHAIN, 1.7 * base, 0.15, 6500.0, 0.4, 0.7), 0.3, uneven=0.6)
    return unit(big) + 0.35 * unit(small)


def jolt(g, weight: float = 1.0) -> np.ndarray:
    return layers(
        0.8 * thud(g, 0.3, 140.0 / weight, 55.0 / weight), 0.5 * strike(g, SLATE, 320.0 / weight, 0.15, 2600.0, 1.0)
    )


def stop(g, body, base: float, weight: float, echo: float = 0.9, rest: float = 0.16, rings: float = 1.0) -> np.ndarray:
    """Something heavy that comes to rest, and settles after rest seconds."""
    low = 0.7 * thud(g, 0.34, 120.0 / weight, 46.0 / weight, 0.8)
    hit = layers(low, 1.3 * strike(g, body, base, 0.4 + 0.4 * rings, 3200.0, 0.9, rings))
    settle = 0.3 * layers(0.6 * thud(g, 0.15, 150.0, 80.0), strike(g, body, 1.3 * base, 0.25, 2600.0, 0.8, rings))
    return room(sequence((0.0, hit), (rest, settle)), echo, 0.22, 0.5)


def crumble(g, seconds: float) -> np.ndarray:
    """Grit that runs down behind a stone."""
    n = samples(seconds)
    grains = train(g, n, 75.0, strike(g, SLATE, 950.0, 0.05, 4200.0, 0.9), 1.0, loop=False, uneven=0.95)
    return unit(grains) * curve(n, [(0, 0.2), (0.15, 1), (0.4, 0.4), (1, 0)])


def creak(g, seconds: float, low: float, high: float, base: float) -> np.ndarray:
    """Stick and slip of iron or wood: strokes that follow one another as fast as a low tone."""
    n = samples(seconds)
    speed = curve(n, [(0, low), (0.4, high), (1, 0.7 * low)]) * (1.0 + 0.12 * drift(g, n, 16.0))
    slips = np.diff(np.floor(np.cumsum(speed) / RATE), prepend=0.0) * g.uniform(0.5, 1.0, n)
    ringing = peaks(
        slips, [(base, 14.0, 4.0), (2.31 * base, 18.0, 3.0), (3.87 * base, 20.0, 2.0), (5.4 * base, 20.0, 1.2)], 0.1
    )
    return ringing * curve(n, [(0, 0), (0.15, 1), (0.7, 0.7), (1, 0)])


# -- stone


@sound("doors/doormv1")
def stone_door_moves(g):
    return Loop(
        grinding(g, loop_samples(1.6), 70.0, 210.0), layers(jolt(g), 0.4 * unit(creak(g, 0.4, 22.0, 60.0, 260.0))), 0.25
    )


@sound("doors/drclos4")
def stone_door_stops(g):
    return layers(stop(g, SLATE, 240.0, 1.1), sequence((0.08, 0.16 * crumble(g, 0.7))))


@sound("doors/stndr1")
def stone_on_chain_moves(g):
    n = loop_samples(1.8)
    return Loop(room_loop(0.8 * grinding(g, n, 55.0, 180.0) + 0.65 * chain(g, n, 11, 620.0), 0.5, 0.12), jolt(g, 1.2), 0.25)


@sound("doors/stndr2")
def stone_on_chain_stops(g):
    slack = train(g, samples(0.4), 22.0, strike(g, CHAIN, 640.0, 0.2, 5200.0, 0.6), 0.8, loop=False, uneven=0.8)
    return layers(stop(g, SLATE, 200.0, 1.3, 1.1, 0.24), sequence((0.08, 0.5 * unit(slack)), (0.2, 0.15 * crumble(g, 0.8))))


# -- chain and oak


@sound("doors/winch2")
def winch_turns(g):
    n = loop_samples(1.4)
    wood = train(g, n, 46.0, strike(g, OAK, 240.0, 0.12, 1600.0, 0.7), 0.7, uneven=0.8)
    return Loop(
        room_loop(chain(g, n, 10, 560.0) + 0.5 * unit(wood), 0.6, 0.15),
        0.8 * strike(g, IRON, 340.0, 0.4, 3000.0, 0.8, 0.6),
        0.2,
    )


@sound("doors/latch2")
def latch(g):
    lift = strike(g, IRON, 720.0, 0.2, 4500.0, 0.7, 0.4)
    return room(
        sequence(
            (0.0, 0.6 * lift),
            (0.11, strike(g, IRON, 430.0, 0.35, 3400.0, 0.9, 0.5)),
            (0.12, 0.6 * strike(g, OAK, 210.0, 0.2, 1600.0, 0.8)),
        ),
        0.7,
        0.2,
    )


@sound("plats/medplat1")
def chain_lift_moves(g):
    n = loop_samples(1.3)
    return Loop(room_loop(chain(g, n, 8, 480.0) + 0.4 * grinding(g, n, 30.0, 260.0, 0.6), 0.6, 0.15), jolt(g), 0.2)


@sound("plats/medplat2")
def chain_lift_stops(g):
    return layers(
        stop(g, OAK, 150.0, 1.0, 0.7, 0.2, 1.6), sequence((0.02, 0.5 * strike(g, CHAIN, 520.0, 0.3, 4500.0, 0.6, 1.2)))
    )


# -- iron


@sound("doors/ddoor1")
def iron_door_moves(g):
    n = loop_samples(1.5)
    # The screech is one tone that slips: whole turns, its strength wandering round the circle.
    slide = bandpass(coloured(g, n, -1.0), 900.0, 1.0, loop=True) * (0.7 + 0.3 * drift(g, n, 12.0, loop=True))
    screech = sum(a * sine(whole(hz, n), n) for hz, a in ((1130, 0.5), (1174, 0.4), (1985, 0.25), (2875, 0.15)))
    screech *= np.clip(drift(g, n, 16.0, loop=True), 0.0, 1.0) * (0.6 + 0.4 * drift(g, n, 60.0, loop=True))
    slips = train(g, n, 34.0, strike(g, IRON, 420.0, 0.25, 3600.0, 0.5, 0.5), 0.9, uneven=0.9)
    body = 0.5 * unit(slide) + 0.32 * screech + 0.6 * unit(slips)
    return Loop(room_loop(body, 0.7, 0.15), strike(g, IRON, 260.0, 0.45, 3200.0, 0.8, 0.8), 0.12)


@sound("doors/ddoor2")
def iron_door_stops(g):
    return stop(g, IRON, 210.0, 0.9, 0.8, 0.09, 2.2)


@sound("plats/train1")
def train_moves(g):
    n = loop_samples(1.5)
    ratchet = train(g, n, 12.0, strike(g, IRON, 530.0, 0.2, 4500.0, 0.8, 0.45), 0.05, uneven=0.15)
    wheels = lowpass(coloured(g, n, -3.0), 320.0, loop=True) * (0.8 + 0.2 * sine(whole(6.0, n), n))
    rail = bandpass(white(g, n), 2100.0, 2.0, loop=True) * (0.5 + 0.5 * drift(g, n, 10.0, loop=True))
    return Loop(room_loop(0.8 * unit(ratchet) + 0.7 * unit(wheels) + 0.12 * unit(rail), 0.6, 0.15), jolt(g), 0.3)


@sound("plats/train2")
def train_stops(g):
    return layers(stop(g, IRON, 170.0, 1.1, 0.8, 0.22, 1.4), 0.35 * unit(creak(g, 0.45, 40.0, 90.0, 420.0)))


# -- steam and water pressure


def motor(n: int, hz: float) -> np.ndarray:
    """A motor's hum of whole turns."""
    base = whole(hz, n)
    return lowpass(
        saw(base, n) + 0.6 * pulse(whole(1.5 * hz, n), n, 0.3) + 0.4 * sine(whole(0.5 * hz, n), n), 900.0, loop=True
    )


@sound("doors/hydro1")
def pressure_door_moves(g):
    n = loop_samples(1.4)
    fluid = bandpass(coloured(g, n, -1.0), 680.0, 1.2, loop=True) * (0.8 + 0.2 * drift(g, n, 9.0, loop=True))
    lead = layers(
        strike(g, IRON, 380.0, 0.3, 3000.0, 0.8, 0.4),
        0.5 * unit(rush(g, 0.35, [(0, 3600), (1, 1500)], [(0, 0), (0.05, 1), (1, 0)], 0.8)),
    )
    return Loop(0.6 * unit(motor(n, 82.0)) + 0.55 * unit(fluid), lead, 0.2)


@sound("doors/hydro2")
def pressure_door_stops(g):
    vent = rush(g, 0.5, [(0, 4200), (1, 1800)], [(0, 0), (0.05, 1), (0.3, 0.4), (1, 0)], 0.7)
    return sequence((0.0, stop(g, IRON, 260.0, 0.8, 0.5)), (0.06, 0.4 * unit(vent)))


@sound("doors/airdoor1")
def air_door_moves(g):
    n = loop_samples(1.5)
    air = highpass(coloured(g, n, -1.0), 700.0, loop=True) * (0.85 + 0.15 * drift(g, n, 12.0, loop=True))
    rollers = train(g, n, 26.0, strike(g, STEEL, 620.0, 0.15, 5200.0, 0.4, 0.3), 0.3, uneven=0.5)
    lead = layers(click(g, 0.02, 6000.0), 0.9 * unit(rush(g, 0.4, [(0, 5200), (1, 2400)], [(0, 0), (0.04, 1), (1, 0)], 0.7)))
    return Loop(0.45 * unit(air) + 0.3 * unit(motor(n, 61.0)) + 0.3 * unit(rollers), lead, 0.15)


@sound("doors/airdoor2")
def air_door_stops(g):
    vent = rush(g, 0.6, [(0, 5600), (1, 2600)], [(0, 0), (0.03, 1), (0.3, 0.35), (1, 0)], 0.7)
    return sequence(
        (0.0, layers(strike(g, STEEL, 300.0, 0.5, 3800.0, 0.8, 0.4), 0.7 * thud(g, 0.25))), (0.05, 0.5 * unit(vent))
    )


@sound("doors/basesec1")
def hidden_wall_moves(g):
    n = loop_samples(1.4)
    gears = train(g, n, 21.0, strike(g, IRON, 680.0, 0.15, 4500.0, 0.7, 0.3), 0.05, uneven=0.2)
    return Loop(
        0.6 * unit(motor(n, 74.0)) + 0.45 * unit(gears) + 0.3 * grinding(g, n, 40.0, 300.0),
        0.9 * strike(g, IRON, 300.0, 0.35, 3000.0, 0.9),
        0.2,
    )


@sound("doors/basesec2")
def hidden_wall_stops(g):
    return sequence((0.0, 0.6 * strike(g, IRON, 520.0, 0.2, 3800.0, 0.8, 0.4)), (0.09, stop(g, IRON, 230.0, 1.0, 0.6)))


@sound("plats/plat1")
def pressure_lift_moves(g):
    n = loop_samples(1.3)
    whine = 0.3 * sine(whole(446.0, n), n) + 0.2 * sine(whole(669.0, n), n)
    fluid = bandpass(coloured(g, n, -1.0), 420.0, 1.0, loop=True)
    return Loop(
        0.7 * unit(motor(n, 68.0)) + whine * (0.8 + 0.2 * drift(g, n, 6.0, loop=True)) + 0.4 * unit(fluid), jolt(g, 0.9), 0.2
    )


@sound("plats/plat2")
def pressure_lift_stops(g):
    n = samples(0.4)
    falling = saw(curve(n, [(0, 68), (1, 30)]), n) * curve(n, [(0, 0.6), (1, 0)])
    return layers(stop(g, IRON, 190.0, 1.0, 0.6), 0.3 * lowpass(falling, 700.0))


# -- buttons


@sound("buttons/airbut1")
def steam_button(g):
    steam = rush(g, 0.55, [(0, 3000), (0.2, 5000), (1, 2600)], [(0, 0), (0.04, 1), (0.35, 0.4), (1, 0)], 0.7)
    return sequence((0.0, strike(g, IRON, 410.0, 0.3, 3600.0, 0.9, 0.4)), (0.07, 0.45 * unit(steam)))


@sound("buttons/switch21")
def wooden_button(g):
    push = layers(strike(g, OAK, 260.0, 0.2, 2200.0, 1.0), 0.6 * thud(g, 0.15, 150.0, 85.0))
    return room(
        sequence(
            (0.0, 0.5 * unit(creak(g, 0.14, 50.0, 90.0, 420.0))),
            (0.12, push),
            (0.24, 0.35 * strike(g, OAK, 380.0, 0.12, 2200.0, 0.8)),
        ),
        0.5,
        0.15,
    )


@sound("buttons/switch02")
def metal_button(g):
    return room(
        sequence(
            (0.0, 0.7 * strike(g, STEEL, 980.0, 0.3, 7000.0, 0.6, 0.3)), (0.07, strike(g, IRON, 560.0, 0.4, 4200.0, 0.8, 0.5))
        ),
        0.5,
        0.15,
    )


@sound("buttons/switch04")
def pressed_in_and_out(g):
    first = strike(g, IRON, 480.0, 0.2, 3200.0, 0.9, 0.3)
    slide = rush(g, 0.16, [(0, 1200), (1, 2000)], [(0, 0), (0.5, 1), (1, 0)], 2.0)
    return room(
        sequence((0.0, first), (0.05, 0.3 * unit(slide)), (0.2, 0.8 * strike(g, IRON, 640.0, 0.25, 4200.0, 0.9, 0.3))),
        0.4,
        0.12,
    )


# -- locks: of iron, of runes, of electricity


@sound("doors/medtry")
def iron_lock_holds(g):
    rattle = [
        (
            0.13 * k,
            g.uniform(0.6, 1.0) * layers(strike(g, IRON, 360.0, 0.2, 3000.0, 0.8, 0.35), 0.5 * thud(g, 0.12, 150.0, 80.0)),
        )
        for k in range(3)
    ]
    return room(sequence(*rattle), 0.6, 0.18)


@sound("doors/meduse")
def iron_lock_opens(g):
    key = train(g, samples(0.3), 26.0, strike(g, CHAIN, 1500.0, 0.1, 7000.0, 0.5, 0.5), 0.7, loop=False, uneven=0.6)
    bolt = layers(strike(g, IRON, 300.0, 0.5, 3000.0, 0.9, 0.6), 0.7 * thud(g, 0.25, 140.0, 60.0))
    return room(
        sequence((0.0, 0.4 * unit(key)), (0.3, 0.6 * strike(g, IRON, 620.0, 0.2, 4200.0, 0.9, 0.4)), (0.46, bolt)), 0.8, 0.2
    )


@sound("doors/runetry")
def rune_lock_holds(g):
    gong = lowpass(strike(g, BRONZE, 110.0, 1.2, 1200.0, 0.4, 0.5), 1500.0)
    return room(layers(gong, 0.6 * thud(g, 0.3, 110.0, 50.0), 0.4 * strike(g, SLATE, 260.0, 0.15, 2000.0)), 1.0, 0.25)


@sound("doors/runeuse")
def rune_lock_opens(g):
    notes = [
        (0.1 * k, 0.6 * strike(g, BRONZE, hz, 1.0, 5000.0, 0.1, 0.4)) for k, hz in enumerate((294.0, 440.0, 587.0, 698.0))
    ]
    return room(sequence(*notes, (0.35, 0.6 * jolt(g))), 1.0, 0.25)


def beep(hz: float, seconds: float) -> np.ndarray:
    n = samples(seconds)
    return lowpass(pulse(hz, n, 0.35), 3200.0) * curve(n, [(0, 0), (0.06, 1), (0.8, 0.8), (1, 0)])


@sound("doors/basetry")
def electric_lock_holds(g):
    return sequence(
        (0.0, beep(196.0, 0.18)), (0.22, beep(155.6, 0.3)), (0.0, 0.3 * strike(g, IRON, 500.0, 0.15, 3600.0, 0.8, 0.3))
    )


@sound("doors/baseuse")
def electric_lock_opens(g):
    relay = strike(g, IRON, 560.0, 0.25, 4200.0, 0.9, 0.4)
    return sequence((0.0, 0.7 * beep(523.0, 0.09)), (0.1, 0.7 * beep(784.0, 0.14)), (0.26, relay))
