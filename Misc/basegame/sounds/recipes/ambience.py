"""Places: wind, water, fire, machines, swamps. Each is a loop without a seam, made on a circle."""

from __future__ import annotations

import numpy as np

from sounds.catalogue import sound
from sounds.kit.filters import bandpass, drive, lowpass, peaks, rush, sweep
from sounds.kit.liquid import bubble, bubbles, crackle
from sounds.kit.master import Loop
from sounds.kit.modal import BRONZE, IRON, OAK, click, ring, strike, train
from sounds.kit.space import room_loop
from sounds.kit.waves import coloured, curve, drift, lay, layers, loop_samples, samples, saw, sine, unit, white
from sounds.recipes.movers import whole


def wander(g, knots: int, low: float, high: float) -> list[tuple[float, float]]:
    """Points of a course between two frequencies that ends where it began."""
    values = np.exp(g.uniform(np.log(low), np.log(high), knots))
    values = np.append(values, values[0])
    return [(k / knots, float(v)) for k, v in enumerate(values)]


def gusts(g, n: int, rate: float, least: float = 0.3) -> np.ndarray:
    return least + (1.0 - least) * (0.5 + 0.5 * drift(g, n, rate, loop=True)) ** 1.5


@sound("ambience/wind2", half=True)
def wind(g):
    n = loop_samples(13.0)
    howl = sum(
        sweep(white(g, n), wander(g, 11, low, high), q, loop=True) * gusts(g, n, 0.6, 0.1) * weight
        for low, high, q, weight in ((230, 480, 5.0, 1.0), (450, 900, 7.0, 0.5), (900, 1500, 9.0, 0.15))
    )
    air = lowpass(coloured(g, n, -3.0), 500.0, loop=True) * gusts(g, n, 0.8)
    return Loop(unit(howl) + 0.5 * unit(air))


@sound("ambience/suck1", half=True)
def draught(g):
    """Air that a shaft draws in: a low note of the shaft, breathing."""
    n = loop_samples(7.0)
    breath = (0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) * 2 / n)) ** 1.5
    down = sweep(white(g, n), [(0, 300), (0.25, 720), (0.5, 300), (0.75, 640), (1, 300)], 3.0, loop=True) * (0.15 + breath)
    shaft = peaks(coloured(g, n, -2.0), [(88.0, 20.0, 1.0), (176.0, 20.0, 0.6), (264.0, 20.0, 0.4)], 0.02, loop=True)
    return Loop(unit(down) + 0.7 * unit(shaft) * (0.4 + 0.6 * breath))


@sound("ambience/windfly")
def flight(g):
    return rush(g, 1.7, [(0, 260), (0.4, 1100), (0.7, 850), (1, 300)], [(0, 0), (0.35, 1), (0.65, 0.8), (1, 0)], 1.0)


@sound("ambience/water1")
def running_water(g):
    n = loop_samples(6.0)
    brook = bubbles(g, n, 150.0, (0.0012, 0.007), 0.12, loop=True)
    deep = bubbles(g, n, 9.0, (0.008, 0.016), 0.2, 1.5, loop=True)
    rush_of = bandpass(coloured(g, n, -2.0), 420.0, 0.6, loop=True) * gusts(g, n, 1.5, 0.6)
    return Loop(room_loop(unit(brook) + 0.5 * unit(deep) + 0.35 * unit(rush_of), 0.8, 0.12))


@sound("ambience/drip1")
def dripping(g):
    n = loop_samples(9.0)
    out = np.zeros(n)
    at = 0.3
    while at < 8.6:
        drop = layers(0.25 * click(g, 0.004, 8000.0), bubble(g.uniform(0.0016, 0.0034), 0.25, 0.8))
        lay(out, drop, at, g.uniform(0.4, 1.0), wrap=True)
        if g.random() < 0.4:
            lay(out, bubble(g.uniform(0.0012, 0.002), 0.25), at + g.uniform(0.05, 0.12), 0.4, wrap=True)
        at += g.uniform(0.35, 1.3)
    cave = lowpass(coloured(g, n, -4.0), 160.0, loop=True) * gusts(g, n, 0.5, 0.6)
    return Loop(room_loop(out, 2.4, 0.5, 0.3) + 0.035 * unit(cave))


@sound("ambience/fire1")
def fire(g):
    n = loop_samples(5.0)
    flicker = 0.6 + 0.25 * drift(g, n, 11.0, loop=True) + 0.15 * drift(g, n, 28.0, loop=True)
    roar = lowpass(coloured(g, n, -3.5), 480.0, loop=True) * flicker
    lick = bandpass(white(g, n), 1100.0, 0.7, loop=True) * np.clip(drift(g, n, 15.0, loop=True), 0.0, 1.0)
    wood = crackle(g, n, 24.0, loop=True)
    return Loop(unit(roar) + 0.12 * unit(lick) + 0.75 * unit(wood))


@sound("ambience/hum1", half=True)
def machine_hum(g):
    n = loop_samples(7.0)
    hum = sum(
        a * sine(whole(hz, n), n, g.random())
        for hz, a in (
            (55, 1.0),
            (55.4, 0.7),
            (110, 0.7),
            (110.6, 0.4),
            (165, 0.35),
            (220.4, 0.3),
            (330, 0.2),
            (440.6, 0.12),
            (661, 0.06),
        )
    )
    air = lowpass(coloured(g, n, -3.0), 400.0, loop=True)
    return Loop(hum * gusts(g, n, 0.5, 0.8) + 0.6 * unit(air))


@sound("ambience/drone6", half=True)
def drone(g):
    n = loop_samples(8.0)
    voices = sum(saw(whole(hz, n), n, g.random()) for hz in (55.0, 55.3, 73.5, 77.8, 110.0, 110.4))
    moved = sweep(voices, wander(g, 6, 260.0, 900.0), 1.5, "low", loop=True)
    metal = room_loop(train(g, n, 0.6, ring(g, BRONZE, 92.0, 3.0, 900.0), 0.9), 2.0, 0.4)
    return Loop(unit(moved) + 0.35 * unit(metal))


def mains(n: int, hz: float, harmonics: int, fall: float) -> np.ndarray:
    return sum(sine(whole(hz * k, n), n, 0.37 * k * k) / k**fall for k in range(1, harmonics))


@sound("ambience/fl_hum1")
def lamp_hums(g):
    n = loop_samples(4.0)
    ballast = mains(n, 120.0, 24, 1.1) * (0.9 + 0.1 * drift(g, n, 5.0, loop=True))
    return Loop(unit(ballast) + 0.12 * unit(bandpass(white(g, n), 2400.0, 2.0, loop=True)))


@sound("ambience/buzz1")
def lamp_buzzes(g):
    n = loop_samples(5.0)
    gate = np.clip(4.0 * drift(g, n, 7.0, loop=True) + 1.5, 0.12, 1.0)
    sparks = crackle(g, n, 60.0, loop=True) * (gate > 0.9)
    return Loop(unit(mains(n, 100.0, 60, 0.6)) * gate + 0.7 * unit(sparks))


@sound("ambience/comp1")
def reckoning_engine(g):
    """The abbey's reckoner: relays, a drum that turns, and notes it writes down."""
    n = loop_samples(5.5)
    out = 0.25 * unit(mains(n, 60.0, 8, 1.3)) + 0.2 * unit(
        train(g, n, 4.0, strike(g, OAK, 300.0, 0.1, 1500.0, 0.5), 0.0, uneven=0.1)
    )
    relay = strike(g, IRON, 1150.0, 0.06, 6500.0, 1.0, 0.12)
    for _ in range(9):
        at = g.uniform(0.0, 5.4)
        for k in range(g.integers(2, 7)):
            lay(out, relay, at + 0.062 * k, 0.6 * g.uniform(0.5, 1.0), wrap=True)
    scale = (587.0, 698.0, 784.0, 880.0, 1047.0)
    for k in range(14):
        m = samples(0.09)
        note = sine(g.choice(scale), m) * np.sin(np.pi * np.linspace(0, 1, m)) ** 0.7
        lay(out, note, 5.5 * k / 14 + g.choice([0.0, 0.1]), 0.16 * (g.random() > 0.3), wrap=True)
    return Loop(room_loop(out, 0.5, 0.15))


def frog(g, pitch: float, pulses: int, rate: float) -> np.ndarray:
    """A croak: short pulses of one resonance."""
    n = samples(pulses / rate + 0.06)
    throat = np.zeros(n)
    for k in range(pulses):
        lay(throat, bubble(3.0 / pitch, 0.05, 0.6) * (0.5 + 0.5 * k / pulses), k / rate, 1.0)
    return bandpass(drive(unit(throat), 1.5), 1.3 * pitch, 1.5)


def crickets(g, n: int, pitch: float, chirps: float) -> np.ndarray:
    m = samples(0.22)
    chirp = sine(pitch, m) * np.clip(sine(42.0, m), 0.0, 1.0) * curve(m, [(0, 0), (0.3, 1), (0.8, 0.9), (1, 0)])
    return train(g, n, chirps, chirp, 0.25, uneven=0.3)


def swamp(g, seconds: float, frogs, pitch: float, chirps: float) -> Loop:
    n = loop_samples(seconds)
    out = 0.25 * unit(lowpass(coloured(g, n, -3.0), 350.0, loop=True)) * gusts(g, n, 0.5, 0.5)
    out += 0.5 * unit(bubbles(g, n, 2.6, (0.006, 0.022), 0.5, 1.6, loop=True))
    out += 0.05 * crickets(g, n, pitch, chirps) + 0.03 * crickets(g, n, 1.13 * pitch, 0.8 * chirps)
    for hz, pulses, rate, often in frogs:
        for k in range(often):
            lay(
                out,
                unit(frog(g, hz * g.uniform(0.95, 1.05), pulses, rate)),
                seconds * (k + g.uniform(0.1, 0.8)) / often,
                g.uniform(0.2, 0.5),
                wrap=True,
            )
    return Loop(room_loop(out, 0.9, 0.12, 0.6))


@sound("ambience/swamp1")
def swamp_by_day(g):
    return swamp(g, 7.5, ((310.0, 9, 34.0, 4), (720.0, 3, 11.0, 3)), 4150.0, 1.6)


@sound("ambience/swamp2")
def swamp_by_night(g):
    return swamp(g, 9.0, ((185.0, 12, 26.0, 4), (430.0, 5, 17.0, 3)), 3650.0, 2.4)


@sound("ambience/thunder1")
def thunder(g):
    n = loop_samples(12.0)
    out = 0.08 * unit(lowpass(coloured(g, n, -3.0), 300.0, loop=True)) * gusts(g, n, 0.4, 0.4)
    for at, near in ((0.8, 1.0), (5.4, 0.45), (8.2, 0.7)):
        m = samples(4.5)
        claps = sum(
            curve(m, [(0, 0), (p, 0), (min(0.99, p + 0.004), 1), (1, 0)]) ** 3 * w
            for p, w in zip(g.uniform(0, 0.45, 7), g.uniform(0.3, 1, 7))
        )
        roll = (
            sweep(coloured(g, m, -2.5), [(0, 4200 * near), (0.1, 900), (1, 160)], 0.6, "low")
            * claps
            * (0.7 + 0.3 * drift(g, m, 9.0))
        )
        lay(out, unit(roll) * curve(m, [(0, 1), (0.9, 1), (1, 0)]), at, near, wrap=True)
    return Loop(room_loop(out, 2.4, 0.3, 0.7))
