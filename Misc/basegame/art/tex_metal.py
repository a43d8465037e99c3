"""Iron, steel and copper of the foundry: plates, treads, ribs and trims; rust, soot and verdigris."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.canvas import Blocks, Canvas
from art.noise import blur, smoothstep
from art.surface import Surface

IRON = "43464a 5d6164 777a7c 909392 aaaca8"
STEEL = "5d666f 77818a 929ba2 aeb5b9 cacdcc"
COPPER = "7a3c22 9c5432 bb7048 d49468 ebbf98"
PATINA = "2f6d60 47897a 65a793 8bc4af b4dcca"
RUST = "5a2a14 7c3c1a 9c5424 b8743a"
SOOT = "26262a"


def rivets(c: Canvas, spots: list[tuple[float, float]], radius: float, high: float, color: str | None = None) -> np.ndarray:
    """Domed heads, across the edges too; gives the distance to the nearest."""
    distance = np.full(c.x.shape, 1e9)
    for x, y in spots:
        dx = np.abs(c.x - x)
        dy = np.abs(c.y - y)
        distance = np.minimum(distance, np.hypot(np.minimum(dx, c.width - dx), np.minimum(dy, c.height_texels - dy)))
    dome = np.sqrt(np.clip(1.0 - (distance / radius) ** 2, 0.0, 1.0))
    c.height = c.height - 0.35 * high * smoothstep(radius + 1.5, radius, distance) * (distance > radius) + high * dome
    if color is not None:
        c.paint(color, 0.8 * c.mask(distance - radius))
    c.tint(1.0 - 0.35 * np.exp(-(((distance - radius - 0.4) / 0.7) ** 2)))
    return distance


def grid(x0: float, y0: float, x1: float, y1: float, columns: int, rows: int) -> list[tuple[float, float]]:
    """Evenly spaced spots from one corner to the other."""
    return [
        (x0 + (x1 - x0) * i / max(columns - 1, 1), y0 + (y1 - y0) * j / max(rows - 1, 1))
        for j in range(rows)
        for i in range(columns)
    ]


def frame_spots(x0: float, y0: float, x1: float, y1: float, step: float) -> list[tuple[float, float]]:
    """Spots around a rectangle, about `step` apart."""
    nx, ny = max(2, round((x1 - x0) / step) + 1), max(2, round((y1 - y0) / step) + 1)
    around = grid(x0, y0, x1, y0, nx, 1) + grid(x0, y1, x1, y1, nx, 1)
    return around + grid(x0, y0, x0, y1, 1, ny)[1:-1] + grid(x1, y0, x1, y1, 1, ny)[1:-1]


def sheet(c: Canvas, ramp: str, tone: float, seed: int, spread: float = 0.2, gloss: float = 0.55) -> None:
    """A rolled sheet all over: clouded colour, scratches, and a gloss that varies with both."""
    clouds = c.noise(44, 4, 0.55, seed=seed)
    rolled = c.noise((64, 3), 3, 0.6, seed=seed + 1)
    c.color = c.ramp(ramp, tone + spread * clouds + 0.25 * spread * rolled)
    c.height = 0.22 * c.noise(36, 2, seed=seed + 2) + 0.035 * c.noise(5, 3, seed=seed + 3)
    c.gloss = gloss + 0.16 * clouds + 0.06 * rolled - 0.1 * smoothstep(0.2, 0.9, c.noise(18, 4, seed=seed + 4))
    scratch = smoothstep(0.06, 0.0, np.abs(c.noise((70, 16), 3, 0.6, seed=seed + 5))) * smoothstep(
        0.2, 0.7, c.noise(26, 2, seed=seed + 6)
    )
    c.tint(1.0 + 0.25 * scratch)
    c.gloss = c.gloss - 0.15 * scratch


def rust(c: Canvas, amount: float, seed: int, where: np.ndarray | float = 0.0) -> np.ndarray:
    """Rust in scabs: rough, raised, ochre at its edges; `where` draws it to places. Gives its mask."""
    grows = c.noise(40, 5, 0.6, seed=seed) + 0.25 * c.noise(7, 2, seed=seed + 1) + where - 1.0 + 1.6 * amount
    mask = smoothstep(-0.05, 0.35, grows)
    c.paint(c.ramp(RUST, 0.75 - 0.55 * smoothstep(0.0, 1.0, grows) + 0.25 * c.noise(6, 3, seed=seed + 2)), 0.95 * mask)
    c.height = c.height + mask * (0.25 + 0.3 * c.noise(4, 3, 0.7, seed=seed + 3))
    c.gloss = c.gloss * (1.0 - 0.8 * mask)
    return mask


def verdigris(c: Canvas, amount: float, seed: int, where: np.ndarray | float = 0.0) -> np.ndarray:
    """Copper's green: smooth, matt, pale where it is thick."""
    grows = c.noise(46, 5, 0.55, seed=seed) + 0.5 * c.streaks(seed, share=0.5) + where - 1.0 + 1.6 * amount
    mask = smoothstep(-0.1, 0.4, grows)
    c.paint(c.ramp(PATINA, 0.3 + 0.5 * smoothstep(0.0, 1.2, grows) + 0.14 * c.noise(8, 3, seed=seed + 2)), mask)
    c.height = c.height + mask * (0.12 + 0.12 * c.noise(4, 3, seed=seed + 3))
    c.gloss = c.gloss * (1.0 - 0.6 * mask)
    return mask


def panels(c: Canvas, blocks: Blocks, gap: float, rise: float) -> np.ndarray:
    """Plates side by side: gaps between, each with its own tone. Gives the distance to a plate's edge."""
    edge = blocks.edge - 0.5 * gap
    c.height = c.height + c.bevel(edge, 1.6, rise) + 0.25 * (blocks.random(70) - 0.5) * (edge > 0)
    c.tint(0.86 + 0.28 * blocks.random(71))
    c.paint(SOOT, 0.8 * smoothstep(0.3, -0.3, edge))
    return edge


def metal_plate(width: int, height: int) -> Surface:
    """Boiler plate: sheets of 64, welded, with bolts in the corners."""
    c = Canvas(width, height, 31)
    sheet(c, IRON, 0.6, 1)
    blocks = c.blocks(2, 2, 0.0)
    edge = panels(c, blocks, 1.4, 0.9)
    spots = [(x + dx, y + dy) for x in (0, 64) for y in (0, 64) for dx in (6, 58) for dy in (6, 58)]
    rivets(c, spots, 2.2, 1.4)
    rust(c, 0.16, 20, 0.6 * smoothstep(6.0, 0.0, edge))
    c.wear("b3b5b2", 0.5, 2.0, 0.15, gloss=0.15)
    c.paint(SOOT, 0.35 * c.streaks(3, share=0.25))
    return c.surface()


def metal_rivet(width: int, height: int) -> Surface:
    """Straps over sheets: a bar of rivets every 64 texels each way."""
    c = Canvas(width, height, 32)
    sheet(c, IRON, 0.52, 1)
    across = np.abs((c.x % 64) - 32) - 24  # > 0 in the upright straps
    along = np.abs((c.y % 64) - 32) - 24
    strap = np.maximum(across, along)
    c.height += 1.6 * smoothstep(-0.8, 0.4, strap)
    c.color = np.where((strap > 0)[..., None], c.color * 0.9 + 0.02, c.color)
    c.tint(1.0 - 0.45 * smoothstep(0.9, 0.0, np.abs(strap + 0.8)))
    spots = [(x, y) for x in (0, 64) for y in range(8, 128, 16)] + [(x, y) for y in (0, 64) for x in range(8, 128, 16)]
    spots += [(x, y) for x in (0, 64) for y in (0, 64)]
    distance = rivets(c, spots, 2.9, 1.9)
    rust(c, 0.14, 20, 0.5 * smoothstep(5.0, 2.5, distance))
    c.wear("babbb6", 0.5, 2.0, 0.2, gloss=0.15)
    return c.surface()


def metal_floor(width: int, height: int) -> Surface:
    """Tread plate: raised lozenges, bright where boots have been."""
    c = Canvas(width, height, 33)
    sheet(c, IRON, 0.42, 1, gloss=0.45)
    cell = 16.0
    column, row = np.floor(c.x / cell), np.floor(c.y / cell)
    lx, ly = c.x - (column + 0.5) * cell, c.y - (row + 0.5) * cell
    turn = np.where((column + row) % 2 == 0, 1.0, -1.0)
    a, b = (lx + turn * ly) * 0.7071, (ly - turn * lx) * 0.7071
    lozenge = np.hypot(a / 7.6, b / 2.3) - 1.0
    bump = np.sqrt(np.clip(-lozenge, 0.0, 1.0))
    c.height += 1.3 * bump
    trodden = smoothstep(-0.5, 0.7, c.noise(60, 3, seed=20))
    c.paint("b9bbb8", 0.75 * bump * (0.35 + 0.65 * trodden))
    c.gloss += 0.3 * bump * trodden
    rust(c, 0.08, 30, 0.35 * smoothstep(0.5, 0.0, lozenge))
    c.paint(SOOT, 0.3 * smoothstep(0.3, 0.0, lozenge) * (lozenge > 0))
    frame = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    c.height -= 1.2 * smoothstep(0.9, 0.3, frame)
    c.paint(SOOT, 0.8 * smoothstep(1.0, 0.4, frame))
    return c.surface()


def metal_rust(width: int, height: int) -> Surface:
    """Plate that the water has had for a hundred years."""
    c = Canvas(width, height, 34)
    sheet(c, IRON, 0.55, 1)
    blocks = c.blocks(2, 4, 0.5)
    edge = panels(c, blocks, 1.2, 0.8)
    spots = [(x, y) for y in range(0, 128, 32) for x in range(8, 128, 16)]
    distance = rivets(c, [(x, y + 4) for x, y in spots], 1.7, 1.1)
    pull = 0.5 * smoothstep(6.0, 0.0, edge) + 0.4 * smoothstep(5.0, 1.5, distance) + 0.6 * c.streaks(1, share=0.5)
    rust(c, 0.42, 20, pull)
    c.paint("d0914e", 0.4 * c.streaks(2, share=0.35))
    c.grime("3a2014", 0.4, 3.0)
    return c.surface()


def metal_trim(width: int, height: int) -> Surface:
    """A girder's face: flanges above and below, hexagonal bolts between."""
    c = Canvas(width, height, 35)
    sheet(c, IRON, 0.45, 1)
    flange = np.maximum(6.0 - c.y, c.y - (height - 6.0))
    c.height += 2.6 * smoothstep(-1.2, 0.6, flange)
    c.tint(1.0 - 0.4 * smoothstep(1.4, 0.0, np.abs(flange + 1.4)))
    lx = (c.x % 32) - 16
    ly = c.y - 0.5 * height
    hexagon = np.maximum(np.abs(lx), 0.5 * np.abs(lx) + 0.866 * np.abs(ly)) - 4.6
    washer = np.hypot(lx, ly) - 6.6
    c.height += 0.7 * c.mask(washer, 1.2) + c.bevel(-hexagon, 1.2, 1.9)
    c.tint(1.0 - 0.35 * np.exp(-((washer - 0.4) ** 2)) + 0.12 * c.mask(hexagon))
    groove = np.abs(np.abs((c.x % 32) - 16) - 14.5)
    c.height -= 0.5 * smoothstep(1.0, 0.2, groove) * (flange < -2)
    rust(c, 0.14, 20, 0.5 * smoothstep(3.0, 0.0, np.abs(washer)) + 0.35 * smoothstep(3.0, 0.0, np.abs(flange + 1)))
    c.wear("bcbdb8", 0.55, 2.0, 0.2, gloss=0.15)
    return c.surface()


def copper_plate(width: int, height: int) -> Surface:
    """Copper sheets with standing seams, green from the top down."""
    c = Canvas(width, height, 36)
    sheet(c, COPPER, 0.52, 1, gloss=0.6)
    blocks = c.blocks(4, 2, 0.0)
    half = c.blocks(4, 2, 0.0)
    seam = 16.0 - np.abs(half.u)
    lap = 32.0 - np.abs(blocks.v)
    c.tint(0.88 + 0.24 * blocks.random(5))
    c.height += 1.7 * np.exp(-((seam / 1.4) ** 2)) + 0.9 * smoothstep(0.0, 5.0, blocks.v + 32.0)
    c.height += 0.5 * (blocks.random(6) - 0.5) * blocks.u / 16.0
    verdigris(
        c, 0.7, 20, 0.3 * smoothstep(6.0, 0.0, lap) + 0.35 * (blocks.random(7) - 0.5) - 0.5 * np.exp(-((seam / 1.2) ** 2))
    )
    rivets(c, [(x, y) for x in range(8, 128, 16) for y in (4, 68)], 1.5, 1.0)
    c.wear("e8ab7c", 0.65, 2.0, 0.2, gloss=0.25)
    c.grime("2c4a42", 0.35, 3.0)
    return c.surface()


def copper_trim(width: int, height: int) -> Surface:
    """A beaten band: bosses between two ropes."""
    c = Canvas(width, height, 37)
    sheet(c, COPPER, 0.6, 1, gloss=0.65)
    for middle in (4.0, height - 4.0):
        across = (c.y - middle) / 3.2
        rope = np.sqrt(np.clip(1.0 - across**2, 0.0, 1.0))
        twist = 0.5 + 0.5 * np.cos(2 * np.pi * (c.x / 5.333 + across * 0.45 * (1 if middle < 8 else -1)))
        c.height += rope * (1.6 + 0.9 * twist)
    lx = (c.x % 32) - 16
    ly = c.y - 0.5 * height
    radius = np.hypot(lx, ly)
    c.height += 2.6 * np.sqrt(np.clip(1 - (radius / 5.5) ** 2, 0, 1)) + 0.9 * np.exp(-(((radius - 7.4) / 0.9) ** 2))
    dx = (c.x + 16) % 32 - 16
    leaf = np.hypot(dx / 3.4, ly / 6.0) - 1.0
    c.height += 1.3 * np.sqrt(np.clip(-leaf, 0, 1)) - 0.8 * np.exp(-((dx / 0.5) ** 2)) * (leaf < 0)
    high = c.height - blur(c.height, 6.0)
    verdigris(c, 0.5, 20, -0.6 * np.clip(high, -1.5, 1.5))
    c.wear("f0bd8e", 0.6, 2.0, 0.2, gloss=0.25)
    return c.surface()


def copper_floor(width: int, height: int) -> Surface:
    """Copper plates with rows of round studs, polished by feet."""
    c = Canvas(width, height, 38)
    sheet(c, COPPER, 0.5, 1, gloss=0.6)
    blocks = c.blocks(2, 2, 0.0)
    edge = panels(c, blocks, 1.0, 0.7)
    column = np.floor(c.x / 8)
    lx, ly = (c.x % 8) - 4, ((c.y + 4 * (column % 2)) % 8) - 4
    stud = np.hypot(lx, ly)
    # A stud stands where its whole foot does.
    beside = 32.0 - np.maximum(np.abs((c.x - lx) % 64 - 32), np.abs((c.y - ly) % 64 - 32))
    dome = np.sqrt(np.clip(1 - (stud / 2.5) ** 2, 0, 1)) * (beside > 7.0)
    c.height += 0.9 * dome
    verdigris(c, 0.5, 20, 0.5 * smoothstep(6.0, 0.0, edge) - 0.8 * dome)
    c.paint("e6b284", 0.5 * dome)
    c.gloss += 0.2 * dome
    return c.surface()


def steel_wall(width: int, height: int) -> Surface:
    """Ribbed cladding: pressed channels, a riveted seam at the middle."""
    c = Canvas(width, height, 39)
    sheet(c, STEEL, 0.5, 1, gloss=0.6)
    phase = (c.x % 16) - 8
    c.height += 2.2 * (smoothstep(5.5, 3.0, np.abs(phase)))
    seam = np.abs((c.y % 64) - 32) - 27.5
    flat = smoothstep(-0.6, 0.6, seam)
    c.height = c.height * (1 - flat) + flat * 2.9
    c.tint(1.0 - 0.4 * np.exp(-(((seam + 0.6) / 0.7) ** 2)))
    rivets(c, [(x, y) for y in (0, 64) for x in range(8, 128, 16)], 1.9, 1.2)
    rust(c, 0.03, 20, 0.7 * smoothstep(4.0, 0.0, np.abs(seam + 1.5)) * (0.5 + 0.5 * c.noise(12, 2, seed=29)))
    c.wear("dde0de", 0.5, 2.0, 0.25, gloss=0.15)
    c.paint("5a4634", 0.4 * c.streaks(4, share=0.3))
    return c.surface()


def steel_door(width: int, height: int) -> Surface:
    """A bulkhead door: frame, crossed braces, a wheel in the middle."""
    c = Canvas(width, height, 40)
    sheet(c, STEEL, 0.42, 1, gloss=0.6)
    from_frame = np.minimum(np.minimum(c.x, width - c.x), np.minimum(c.y, height - c.y))
    raised = smoothstep(13.5, 12.0, from_frame)
    mx, my = c.x - 0.5 * width, c.y - 0.5 * height
    brace = np.minimum(np.abs(mx - my), np.abs(mx + my)) * 0.7071 - 5.0
    raised = np.maximum(raised, smoothstep(0.7, -0.7, brace))
    hub = np.hypot(mx, my)
    raised = np.maximum(raised, smoothstep(27.7, 26.3, hub))
    c.paint(c.ramp(STEEL, 0.62 + 0.2 * c.noise(40, 4, seed=40)), 0.7 * raised)
    c.height += 2.2 * raised
    c.tint(1.0 - 0.3 * smoothstep(0.3, 0.5, raised) * smoothstep(0.8, 0.6, raised))
    wheel = shapes.ring(hub - 19.0, 4.4)
    for turn in (0.0, 60.0, 120.0):
        a = np.deg2rad(turn)
        wheel = np.minimum(wheel, np.maximum(np.abs(mx * np.sin(a) - my * np.cos(a)) - 1.5, hub - 19.0))
    wheel = np.minimum(wheel, hub - 5.0)
    c.height += c.bevel(-wheel, 2.0, 2.6)
    c.paint(c.ramp("7c1c16 a8281c c8402c", 0.6 + 0.3 * c.noise(20, 3, seed=41)), 0.92 * c.mask(wheel))
    rivets(c, frame_spots(6.5, 6.5, width - 6.5, height - 6.5, 11.5), 2.1, 1.3)
    rivets(c, [(64 + d * sx, 64 + d * sy) for d in (26, 37) for sx in (-1, 1) for sy in (-1, 1)], 1.8, 1.1)
    rust(c, 0.05, 20, 0.25)
    c.wear("dcdfdd", 0.5, 2.0, 0.25, gloss=0.15)
    outer = smoothstep(1.2, 0.3, from_frame)
    c.height -= 1.5 * outer
    c.paint(SOOT, 0.8 * outer)
    return c.surface()
