"""What lived, or still does: coral flesh, bones, skulls, vines, wax."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.canvas import Canvas
from art.noise import blur, smoothstep
from art.surface import Surface

CORAL = "6e2a34 9c4648 c4685e e08c7a f2b49c"
MEMBRANE = "54263e 7c3c54 a85a68 cc8480 e8b4a4"
BONE = "7c6a4c a8946c cbb88e e4d6b2 f2ead2"
LEAF = "3c6226 58843a 7aa44c a4c66c"


def flesh_a(width: int, height: int) -> Surface:
    """Coral flesh: polyps like cushions, wet."""
    c = Canvas(width, height, 91)
    bumps = c.cells(18, 1, 0.9, warp=4.0)
    edge = bumps.edge()
    dome = np.sqrt(np.clip(edge / 0.5, 0.0, 1.0))
    mouth = bumps.nearest - 0.14 - 0.08 * bumps.random(2)
    small = c.cells(6, 3, 0.9)
    c.height = 4.0 * dome + 0.35 * (1 - small.nearest) - 1.5 * smoothstep(0.06, -0.06, mouth) + 0.6 * c.noise(40, 3, seed=4)
    c.color = c.ramp(CORAL, 0.18 + 0.5 * dome + 0.25 * (bumps.random(5) - 0.5) + 0.12 * c.noise(10, 3, seed=6))
    c.paint("f4cdb4", 0.6 * smoothstep(0.09, 0.02, np.abs(mouth - 0.05)))
    c.paint("4c1424", 0.85 * smoothstep(0.03, -0.03, mouth))
    c.gloss = 0.5 + 0.2 * c.noise(30, 3, seed=7)
    return c.surface()


def flesh_b(width: int, height: int) -> Surface:
    """A membrane over sinews and veins."""
    c = Canvas(width, height, 92)
    bend = 12.0 * c.noise(60, 3, seed=1)
    sinew = c.noise((14, 90), 3, 0.5, seed=2, warp=bend * 0.6)
    folds = 1.0 - np.abs(sinew)
    vein = np.abs(c.noise((40, 60), 4, 0.5, seed=3, warp=bend))
    line = smoothstep(0.11, 0.02, vein)
    c.height = 3.0 * smoothstep(0.2, 1.0, folds) + 1.2 * line + 0.15 * c.noise(5, 3, seed=4)
    c.color = c.ramp(MEMBRANE, 0.15 + 0.55 * smoothstep(0.1, 1.0, folds) + 0.16 * c.noise(24, 4, seed=5))
    c.paint("4a3a74", 0.6 * line)
    c.paint("f0c8b0", 0.4 * smoothstep(0.93, 1.0, folds))
    c.gloss = 0.55 + 0.2 * c.noise(26, 3, seed=6)
    return c.surface()


def _skull(c: Canvas, cx: float, cy: float, size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A skull seen from before: relief (texels), where it is (0..1) and where its holes are (0..1)."""
    x, y = (c.x - cx) / size, (c.y - cy) / size
    x = np.abs((x + 0.5 * c.width / size) % (c.width / size) - 0.5 * c.width / size)
    cranium = shapes.ellipse(x, y, 0.0, -0.22, 0.78, 0.72)
    cheek = shapes.ellipse(x, y, 0.42, 0.22, 0.3, 0.24)
    jaw = shapes.box(x, y, -0.42, 0.2, 0.42, 0.88, 0.14)
    skull = shapes.union(cranium, cheek, jaw)
    socket = shapes.ellipse(x, y, 0.32, -0.02, 0.23, 0.25)
    nose = shapes.polygon(x, y, [(0.0, 0.2), (0.13, 0.44), (-0.13, 0.44)])
    teeth = np.maximum(np.abs(((x + 0.07) % 0.14) - 0.07) - 0.018, np.maximum(np.abs(y - 0.72) - 0.15, x - 0.38))
    bite = np.maximum(np.abs(y - 0.71) - 0.02, x - 0.38)
    holes = shapes.union(socket, nose)
    high = size * 0.42
    relief = high * np.sqrt(np.clip(-skull / 0.55, 0.0, 1.0)) * (0.85 + 0.15 * np.cos(x * 1.4))
    relief -= high * 0.9 * c.mask(holes * size, 1.5) + high * 0.22 * c.mask(shapes.union(teeth, bite) * size, 0.8)
    return relief, c.mask(skull * size), np.maximum(c.mask(holes * size), 0.6 * c.mask(shapes.union(teeth, bite) * size))


def skull_trim(width: int, height: int) -> Surface:
    """Skulls in a niche between two slate fillets."""
    c = Canvas(width, height, 93)
    fillet = np.minimum(c.y, height - c.y)
    c.height = 2.2 * c.bevel(4.5 - fillet, 1.5, 1.0) + 0.15 * c.noise(12, 4, seed=1)
    c.color = c.ramp("3f4b57 5b6a78 768894 96a6ae", 0.45 + 0.2 * c.noise(24, 4, seed=2) + 0.16 * (fillet < 4.5))
    c.paint("2c2f33", 0.55 * (fillet > 4.5))
    c.gloss = 0.35 + 0.1 * c.noise(20, 3, seed=3)
    for i in range(width // 32):
        relief, on, holes = _skull(c, 16.0 + 32.0 * i, 16.5, 11.0)
        c.height = np.maximum(c.height * (1 - on), 0) + on * (relief + 0.4) + (1 - on) * np.minimum(c.height, 9)
        c.paint(c.ramp(BONE, 0.55 + 0.2 * c.noise(14, 4, seed=4 + i)), on)
        c.paint("2a1e16", 0.9 * holes)
    c.grime("3c3626", 0.35, 2.5, 1.5)
    return c.surface()


def bones(width: int, height: int) -> Surface:
    """An ossuary's wall: long bones stacked end on, rows of skulls between."""
    c = Canvas(width, height, 94)
    c.color = c.ramp("2e261c 40362a", 0.5 + 0.5 * c.noise(10, 3, seed=1))
    c.height -= 3.0
    row = np.floor(c.y / 32.0).astype(int)
    knobs = c.cells(8.0, 2, 0.55)
    edge = knobs.edge() * 8.0
    dome = np.sqrt(np.clip((edge - 0.3) / 3.2, 0.0, 1.0))
    cleft = np.abs(knobs.dx * np.cos(6.0 * knobs.random(3)) + knobs.dy * np.sin(6.0 * knobs.random(3)))
    on = smoothstep(0.2, 0.8, edge)
    c.height += (3.0 * dome - 0.8 * np.exp(-((cleft / 0.08) ** 2))) * on
    c.paint(c.ramp(BONE, 0.2 + 0.4 * knobs.random(4) + 0.2 * dome + 0.1 * c.noise(6, 3, seed=5)), on)
    c.paint("6a5236", 0.6 * on * np.exp(-((cleft / 0.1) ** 2)))
    band = np.abs(((c.y + 32.0) % 64.0) - 32.0) < 12.0
    c.height = np.where(band, -2.0, c.height)
    c.color = np.where(band[..., None], np.array([0.16, 0.13, 0.1]), c.color)
    # One skull, drawn once and put where the others are: rows of six, the second half a skull further.
    model = _skull(c, 0.5 * width, 0.5 * height, 10.2)
    for level in range(2):
        for i in range(6):
            across = round(((i + 0.5 * level) * width / 6.0 + 10.0 - 0.5 * width) * c.scale)
            down = round((64.0 * level - 0.5 * height) * c.scale)
            relief, here, holes = (np.roll(layer, (down, across), (0, 1)) for layer in model)
            if here.any():
                c.height = np.where(here > 0.5, relief, c.height)
                c.paint(c.ramp(BONE, 0.6 + 0.3 * ((i * 5 + level * 3) % 7) / 7.0 - 0.15 + 0.12 * c.noise(10, 3, seed=7)), here)
                c.paint("241a12", 0.9 * holes)
    c.gloss = 0.3 + 0.1 * c.noise(20, 3, seed=8)
    c.tint(np.where(row >= 0, 1.0 - 0.15 * smoothstep(0.2, 0.9, c.noise(40, 3, seed=9)), 1.0))
    return c.surface()


def vine(width: int, height: int) -> Surface:
    """Hanging stems with pointed leaves; the rest is holes."""
    c = Canvas(width, height, 95)
    on = np.zeros(c.x.shape)
    for i, stem in enumerate((9.0, 27.0, 44.0, 57.0)):
        bend = stem + 3.2 * np.sin(2 * np.pi * (c.y / height + 0.23 * i)) + 1.2 * np.sin(4 * np.pi * c.y / height + i)
        d = np.abs((c.x - bend + 0.5 * width) % width - 0.5 * width) - 0.9
        inside = c.mask(d)
        c.paint(c.ramp("4a3a20 6c5a30", 0.5 + 0.3 * c.noise(6, 2, seed=i)), inside)
        c.height += 1.2 * np.sqrt(np.clip(-d / 0.9, 0, 1))
        on = np.maximum(on, inside)
        for j in range(8):
            at = 8.0 * j + 3.0 * (i % 2) + 1.5
            root = stem + 3.2 * np.sin(2 * np.pi * (at / height + 0.23 * i)) + 1.2 * np.sin(4 * np.pi * at / height + i)
            side = 1.0 if (i + j) % 2 else -1.0
            lx = ((c.x - root + 0.5 * width) % width - 0.5 * width) * side
            ly = (c.y - at + 0.5 * height) % height - 0.5 * height
            a, b = 0.82 * lx + 0.57 * ly, -0.57 * lx + 0.82 * ly
            leaf = np.abs(b) - 3.4 * np.sin(np.pi * np.clip(a / 9.5, 0.0, 1.0)) ** 0.8 * (1.0 - 0.35 * np.clip(a / 9.5, 0, 1))
            leaf = np.where((a > 0.2) & (a < 9.4), leaf, 1.0)
            here = c.mask(leaf)
            tone = 0.3 + 0.5 * ((i * 3 + j * 5) % 8) / 8.0
            c.paint(c.ramp(LEAF, tone + 0.1 * c.noise(5, 2, seed=40)), here)
            c.paint("a8c070", 0.6 * here * (np.abs(b) < 0.35))
            c.height = np.where(here > 0.5, 1.2 + 0.35 * np.abs(b) + 0.1 * a, c.height)
            on = np.maximum(on, here)
    c.holes = on < 0.5
    bleed(c)
    c.gloss = np.where(c.holes, 0.1, 0.4)
    return c.surface()


def bleed(c: Canvas) -> None:
    """Colour under the holes is that of what surrounds them, so that filtering brings no dark fringe."""
    weight = blur((~c.holes).astype(float), 3.0) + 1e-4
    spread = np.stack([blur(c.color[..., i] * ~c.holes, 3.0) / weight for i in range(3)], axis=-1)
    c.color = np.where(c.holes[..., None], np.clip(spread, 0, 1), c.color)


def candle_wax(width: int, height: int) -> Surface:
    """Wax that ran and set: pale, waxy, in tears."""
    c = Canvas(width, height, 96)
    runs = c.noise((9, 60), 3, 0.55, seed=1, warp=2.0 * c.noise(20, 2, seed=2))
    ridge = smoothstep(-0.3, 0.9, runs)
    c.height = 2.6 * ridge + 0.4 * c.noise((20, 30), 2, seed=3)
    c.color = c.ramp("c8a878 dcc398 ecdab4 f6ecd0", 0.3 + 0.45 * ridge + 0.1 * c.noise(16, 3, seed=4))
    c.gloss = 0.55 + 0.12 * c.noise(14, 3, seed=5)
    return c.surface()
