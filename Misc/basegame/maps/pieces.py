"""Furniture of the foundry-monastery: prefabs that the hub and the level share. Each stands on z = 0 round the origin
unless it says otherwise, and is detail: it seals nothing."""

from __future__ import annotations

import math
import random

from kit import Group, Tex, fit
from kit.brush import polyhedron
from kit.shapes import circle


def pillar(height: float, radius: float = 20.0, shaft: str = "marble_white", trim: str = "stone_trim",
           sides: int = 8) -> Group:
    """Plinth, base ring, shaft, capital that widens, abacus."""
    group = Group()
    part = group.detail
    wide = radius + 10
    part.box((-wide, -wide, 0), (wide, wide, 12), {"all": trim, "top": "stone_a"})
    part.cylinder((0, 0), radius + 5, 12, 22, trim, sides=sides)
    part.cylinder((0, 0), radius, 22, height - 40, shaft, sides=sides)
    part.cylinder((0, 0), radius + 4, height - 40, height - 34, "copper_trim", sides=sides)
    part.cylinder((0, 0), radius, height - 34, height - 12, trim, sides=sides, top_radius=wide + 2)
    part.box((-wide - 2, -wide - 2, height - 12), (wide + 2, wide + 2, height), trim)
    return group


def hollow(profile: list[tuple[float, float]], wall: float, tex, sides: int = 12, floor: float = 0.0) -> Group:
    """A body of revolution with a wall: the profile is (z, outer radius) upwards."""
    group = Group()
    part = group.detail
    for (z0, r0), (z1, r1) in zip(profile, profile[1:]):
        loops = [circle((0, 0), r, sides, 2.0**-10) for r in (r0, r1, max(r0 - wall, 1), max(r1 - wall, 1))]
        for k in range(sides):
            n = (k + 1) % sides
            low, high = floor + z0, floor + z1
            a, b = (*loops[0][k], low), (*loops[0][n], low)
            c, d = (*loops[1][n], high), (*loops[1][k], high)
            e, f = (*loops[2][k], low), (*loops[2][n], low)
            g, h = (*loops[3][n], high), (*loops[3][k], high)
            part.brush(polyhedron([[a, b, c, d], [e, f, g, h], [a, b, f, e], [d, c, g, h], [a, d, h, e], [b, c, g, f]],
                                  tex))
    return group


def bell(radius: float, rope: float) -> Group:
    """A copper bell with its lip at z = 0, hung from a rod that ends `rope` above its crown."""
    r = radius
    group = hollow([(0, r), (r * 0.12, r * 0.96), (r * 0.5, r * 0.74), (r * 1.05, r * 0.62), (r * 1.3, r * 0.46)],
                   max(3.0, r * 0.07), Tex("copper_plate", align="face"))
    part = group.detail
    top = round(r * 1.3)
    part.cylinder((0, 0), r * 0.46, top, top + 6, "copper_plate", sides=12, top_radius=r * 0.2)
    part.cylinder((0, 0), r * 0.12, top + 6, top + 20, "copper_trim", sides=6)
    part.box((-2, -2, top + 20), (2, 2, top + 20 + rope), "metal_rust")
    # The clapper.
    part.box((-1.5, -1.5, round(r * 0.2)), (1.5, 1.5, top), "metal_rust")
    part.cylinder((0, 0), r * 0.16, -r * 0.08, r * 0.2, "metal_plate", sides=8)
    return group


def hanging_lamp(rod: float, tex: str = "lamp_round", radius: float = 12.0) -> Group:
    """A lantern whose rod ends at z = 0; it hangs below."""
    group = Group()
    part = group.detail
    r, z = radius, -rod
    part.box((-1, -1, z), (1, 1, 0), "metal_rust")
    part.cylinder((0, 0), r + 5, z - 10, z, "copper_plate", sides=8, top_radius=3)
    part.cylinder((0, 0), r, z - 34, z - 10, fit(tex), sides=8)
    part.cylinder((0, 0), r + 3, z - 38, z - 34, "copper_trim", sides=8)
    for k in range(4):
        angle = math.radians(45 + 90 * k)
        x, y = (r + 1) * math.cos(angle), (r + 1) * math.sin(angle)
        part.box((round(x) - 1, round(y) - 1, z - 34), (round(x) + 1, round(y) + 1, z - 10), "metal_trim")
    return group


def sconce(tex: str = "light_warm") -> Group:
    """A lamp on a wall to the south of it (the wall's face is y = 0), lamp towards -y; its middle is at z = 0."""
    group = Group()
    part = group.detail
    part.box((-8, -3, -16), (8, 0, 16), "copper_plate")
    part.box((-2, -10, -14), (2, -3, -10), "metal_rust")
    part.frustum((-6, -16, -10), (6, -4, -6), (-8, -18), (8, -2), "copper_trim")
    part.box((-6, -16, -6), (6, -4, 12), fit(tex))
    part.frustum((-8, -18, 12), (8, -2, 20), (-2, -12), (2, -8), "copper_plate")
    return group


def candles(count: int, spread: float, seed: int) -> Group:
    """A cluster of wax candles of several heights, with flames."""
    group = Group()
    part = group.detail
    chance = random.Random(seed)
    placed: list[tuple[float, float, float]] = []
    for _ in range(count * 20):
        if len(placed) == count:
            break
        r = chance.choice((2.0, 2.5, 3.0))
        x, y = (round(chance.uniform(-spread, spread) * 2) / 2 for _ in range(2))
        if all(math.hypot(x - a, y - b) > r + c + 0.5 for a, b, c in placed):
            placed.append((x, y, r))
    for x, y, r in placed:
        height = chance.randint(5, 18)
        part.cylinder((x, y), r, 0, height, "candle_wax", sides=6)
        part.box((x - 0.25, y - 0.25, height), (x + 0.25, y + 0.25, height + 1), "metal_rust")
        part.frustum((x - 1, y - 1, height + 1), (x + 1, y + 1, height + 5), (x, y), (x, y), fit("light_warm"))
    return group


def candle_stand(seed: int, height: float = 48.0) -> Group:
    """An iron stand with a dish of candles."""
    group = Group()
    part = group.detail
    part.cylinder((0, 0), 10, 0, 3, "metal_rust", sides=8)
    part.box((-1.5, -1.5, 3), (1.5, 1.5, height - 3), "metal_rust")
    part.cylinder((0, 0), 3, height - 5, height, "metal_trim", sides=8, top_radius=12)
    return group.add(candles(6, 8.0, seed), (0, 0, height))


def lancet(width: float, height: float, tex: str, depth: float = 16.0, frame: str = "stone_trim") -> Group:
    """A stained window of two lights in the wall north of y = 0: a pane `depth` behind the wall's face, a sill, a mullion
    and a pointed head. Cut width x depth x height out of the wall first; its sill is at z = 0."""
    group = Group()
    part = group.detail
    half = width / 2
    head = round(min(height / 2, width * 0.9))
    part.box((-half, depth - 4, 0), (half, depth, height), fit(tex))
    part.box((-half, 0, 0), (half, depth - 4, 4), frame)
    part.arch((-half, 2, height - head), (half, depth - 4, height), frame, axis="y", segments=8, pointed=True)
    part.box((-2, 6, 4), (2, depth - 4, height), frame)
    for x in (-half, half - 3):
        part.box((x, 2, 4), (x + 3, depth - 4, height - head), frame)
    for z in (height - head, round((height - head) / 2)):
        part.box((-half, depth - 8, z - 1), (half, depth - 4, z + 1), "metal_rust")
    return group


def rose(radius: float, tex: str, depth: float = 24.0) -> Group:
    """A round window in the wall north of y = 0, round z = 0: glowing panes behind stone tracery. Its square hole is to be
    cut; the corners are filled here."""
    group = Group()
    part = group.detail
    r = radius
    part.box((-r, depth - 4, -r), (r, depth, r), fit(tex, (2, 1)))
    for low in (False, True):
        for side in (-1, 1):
            for k in range(4):
                a, b = (math.radians(90 * j / 4) for j in (k, k + 1))
                pts = [(side * r * math.cos(t), (-1 if low else 1) * r * math.sin(t)) for t in (a, b)]
                corner = (side * r, -r if low else r)
                rounded = [(round(x * 4) / 4, round(z * 4) / 4) for x, z in pts]
                part.prism([rounded[0], rounded[1], corner], 0, depth - 4, "stone_trim", axis="y")
    part.ring((0, 0), r - 8, r, 4, depth - 4, "stone_trim", sides=16, axis="y")
    part.ring((0, 0), r * 0.32, r * 0.32 + 6, 6, depth - 4, "stone_trim", sides=12, axis="y")
    for k in range(8):
        angle = math.radians(22.5 + 45 * k)
        c, s = math.cos(angle), math.sin(angle)
        inner, outer, w = r * 0.32 + 4, r - 5, 2.5
        spoke = [(inner * c - w * s, inner * s + w * c), (outer * c - w * s, outer * s + w * c),
                 (outer * c + w * s, outer * s - w * c), (inner * c + w * s, inner * s - w * c)]
        part.prism([(round(x * 4) / 4, round(z * 4) / 4) for x, z in spoke], 6, depth - 4, "stone_trim", axis="y")
    return group


def balustrade(length: float, tex: str = "stone_trim") -> Group:
    """A stone rail along +x, 36 high and 12 deep, from x = 0 on."""
    group = Group()
    part = group.detail
    part.box((0, -6, 0), (length, 6, 6), tex)
    part.box((0, -6, 30), (length, 6, 36), tex)
    count = max(1, round(length / 24))
    for k in range(count):
        x = round((k + 0.5) * length / count)
        part.cylinder((x, 0), 4, 6, 30, "marble_white", sides=6)
    return group


def pew(length: float) -> Group:
    """A bench along x that looks north."""
    group = Group()
    part = group.detail
    part.box((-length / 2, -8, 16), (length / 2, 8, 20), "wood_plank")
    part.box((-length / 2, -12, 20), (length / 2, -8, 44), "wood_plank")
    for x in (-length / 2, length / 2 - 4):
        part.box((x, -12, 0), (x + 4, 8, 20), "wood_beam")
    return group


def crates(seed: int) -> Group:
    """Three crates, one upon two."""
    group = Group()
    part = group.detail
    chance = random.Random(seed)
    kinds = [chance.choice(("crate_a", "crate_b")) for _ in range(3)]
    part.box((-50, -24, 0), (-2, 24, 48), fit(kinds[0]))
    part.box((2, -20, 0), (42, 20, 40), fit(kinds[1]))
    part.box((-40, -16, 48), (-8, 16, 80), fit(kinds[2]))
    return group


def brazier(tex: str = "*lava_a") -> Group:
    """An iron bowl of embers on three legs."""
    group = hollow([(20, 8), (26, 16), (36, 22), (40, 24)], 4, "metal_rust", sides=10)
    part = group.detail
    part.cylinder((0, 0), 7, 19, 22, "metal_rust", sides=10)
    part.cylinder((0, 0), 17, 26, 33, fit("lamp_round") if tex == "lamp_round" else "light_warm", sides=10)
    for k in range(3):
        angle = math.radians(120 * k)
        x, y = round(14 * math.cos(angle)), round(14 * math.sin(angle))
        part.box((x - 2, y - 2, 0), (x + 2, y + 2, 27), "metal_rust")
    return group


def slipgate(width: float, height: float, frame: str = "copper_plate", light: str = "rune_a") -> Group:
    """A gate's frame in the plane y = 0, open between -width/2 and width/2, with a teleporter's surface within."""
    group = Group()
    part = group.detail
    half = width / 2
    for side in (-1, 1):
        x0, x1 = sorted((side * half, side * (half + 16)))
        part.box((x0, -12, 0), (x1, 12, height), {"all": frame, "south": fit(light, (1, round(height / 32)))})
        part.box((x0 - 2, -14, 0), (x1 + 2, 14, 12), "metal_trim")
    part.box((-half - 18, -14, height), (half + 18, 14, height + 16), "copper_trim")
    part.arch((-half, -8, height - half * 0.8), (half, 8, height), frame, axis="y", segments=8)
    return group


def pipe_run(length: float, radius: float = 10.0, tex: str = "copper_plate") -> Group:
    """A pipe along +x at z = 0 with flanges every 96 units."""
    group = Group()
    part = group.detail
    part.cylinder((0, 0), radius, 0, length, tex, sides=8, axis="x")
    x = 0.0
    while x <= length - 6:
        part.cylinder((0, 0), radius + 3, x, x + 6, "metal_trim", sides=8, axis="x")
        x += 96
    return group
