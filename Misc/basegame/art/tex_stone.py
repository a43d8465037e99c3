"""Stone, brick, plaster and earth: ashlar of slate, worn flags, cobbles, rock, and what grows on them."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.canvas import Blocks, Canvas
from art.noise import blur, hash01, smoothstep
from art.surface import Surface

SLATE = "3f4b57 5b6a78 768894 96a6ae b9c5c8"
BLUESTONE = "45535f 62737c 80918f a3b0a8 c2ccc0"
SANDSTONE = "6a5a44 94805f b8a37d d2bf97 e6d8b6"
MOSS = "2e3a12 4d6020 72863a 97a752"
JOINT = "2b3033"
LIME = "d5dfd8"
VERDIGRIS = "58a08c"


def _dressed(c: Canvas, blocks: Blocks, ramp: str, joint: float, rise: float, tilt: float = 0.5) -> None:
    """Blocks with worn edges: height, and colours that differ from block to block."""
    chips = 0.7 * c.noise(9, 4, seed=1) + 0.5 * c.noise(30, 2, seed=2)
    edge = blocks.edge - joint * 0.5 + 0.7 * np.minimum(chips, 0.3)
    face = c.bevel(edge, 3.0, rise)
    lean = tilt * ((blocks.random(3) - 0.5) * blocks.u + (blocks.random(4) - 0.5) * blocks.v) / 16.0
    rough = 0.22 * c.noise(20, 5, 0.55, seed=5)
    on = smoothstep(0.0, 2.0, edge)
    c.height = face + on * (lean + rough + 0.5 * (blocks.random(6) - 0.5))
    tone = 0.5 + 0.42 * (blocks.random(7) - 0.5) + 0.16 * c.noise(28, 4, 0.6, seed=8) + 0.06 * c.noise(5, 2, seed=9)
    c.color = c.ramp(ramp, tone)
    c.gloss = 0.3 + 0.2 * blocks.random(10) + 0.1 * c.noise(24, 3, seed=11)
    c.grain(0.10, 0.12)
    c.pits(5.0, 0.45, 0.17)
    c.paint(JOINT, 0.85 * (1.0 - smoothstep(-0.3, 0.8, edge)))


def stone_a(width: int, height: int) -> Surface:
    """Large ashlar of slate: four courses, blocks of 64x32."""
    c = Canvas(width, height, 11)
    blocks = c.blocks(2, 4, 0.5, widths=0.25)
    _dressed(c, blocks, SLATE, 1.6, 1.6)
    # Tool marks: shallow slanting grooves, their direction a matter of the block.
    slant = np.where(blocks.random(20) < 0.5, 1.0, -1.0)
    marks = np.sin((blocks.u + slant * blocks.v * 0.8) * 1.1 + 1.5 * c.noise(20, 2, seed=21))
    c.height += 0.16 * marks * smoothstep(2.0, 4.0, blocks.edge) * (blocks.random(22) < 0.7)
    c.wear("a9bccd", 0.35, 2.5, 0.15)
    c.paint(LIME, 0.22 * c.streaks(1, share=0.3) * smoothstep(0.0, 0.6, c.noise(60, 3, seed=23)))
    c.grime("343d38", 0.45, 3.0)
    return c.surface()


def stone_b(width: int, height: int) -> Surface:
    """Small courses of blue-green stone, of uneven lengths."""
    c = Canvas(width, height, 12)
    blocks = c.blocks(4, 6, 0.43, wander=0.7, widths=0.6)
    _dressed(c, blocks, BLUESTONE, 1.4, 1.3, tilt=0.9)
    odd = (blocks.random(30) < 0.13) * smoothstep(0.0, 1.5, blocks.edge)
    c.paint(c.ramp(SANDSTONE, 0.55 + 0.2 * c.noise(20, 3, seed=31)), 0.8 * odd)
    c.wear("c6d0c4", 0.3, 2.5, 0.15)
    c.grime("2c352c", 0.5, 3.0)
    return c.surface()


def stone_floor(width: int, height: int) -> Surface:
    """Flagstones, worn smooth and a little hollow, still damp: they shine."""
    c = Canvas(width, height, 13)
    blocks = c.blocks(2, 2, 0.0, widths=0.0)
    half = c.blocks(4, 2, 0.0)
    number = (blocks.number * 7 + 1) % 5
    edge = np.where(number == 3, np.minimum(blocks.edge, half.edge), blocks.edge)
    slabs = Blocks(np.where(number == 3, half.number + 50, blocks.number), edge, blocks.u, blocks.v)
    _dressed(c, slabs, SLATE, 1.2, 0.8, tilt=0.3)
    worn = smoothstep(3.0, 16.0, edge + 3.0 * c.noise(24, 3, seed=40))
    c.height -= 0.5 * worn
    c.gloss = 0.35 + 0.38 * worn + 0.1 * c.noise(32, 4, seed=41)
    c.paint("6f8f92", 0.18 * worn)
    shards = c.cells(30, 42, 1.0, warp=5.0)
    line = (1.0 - smoothstep(0.0, 0.022, shards.edge())) * (slabs.random(43) < 0.3) * (edge > 1.0)
    c.height -= 0.6 * line
    c.paint(JOINT, 0.6 * line)
    c.grime("2f3a36", 0.4, 2.5)
    return c.surface()


def stone_trim(width: int, height: int) -> Surface:
    """A carved band: fillets above and below a running wave."""
    c = Canvas(width, height, 14)
    middle, period = 0.5 * height, 32.0
    x = (c.x % period) - 0.5 * period
    # The wave: a breaking crest, as a spiral of half rings.
    crest = shapes.union(
        shapes.ring(shapes.circle(x, c.y, -1.0, middle, 7.5), 2.6) + 4.0 * ((c.y > middle) & (x > -1.0)),
        shapes.ring(shapes.circle(x, c.y, 1.5, middle, 4.2), 2.2) + 4.0 * ((c.y < middle) & (x < 1.5)),
    )
    swell = middle + 8.0 - 1.2 * np.cos(2 * np.pi * x / period)
    crest = shapes.union(crest, swell - c.y)
    crest = np.maximum(crest, c.y - (height - 5.0))
    fillet = np.minimum(np.abs(c.y - 2.5), np.abs(c.y - (height - 2.5)))
    band = c.bevel(2.5 - fillet, 2.0, 2.2)
    carved = c.bevel(-crest, 1.6, 1.5)
    c.height = np.maximum(band, carved) + 0.15 * c.noise(14, 4, seed=1)
    c.color = c.ramp(SLATE, 0.62 + 0.14 * c.noise(26, 4, 0.6, seed=2) + 0.1 * (carved > 0.4))
    c.gloss = 0.35 + 0.1 * c.noise(20, 3, seed=3)
    c.wear("c2d0da", 0.4, 2.0, 0.2)
    c.grime("37504c", 0.7, 3.0, 0.9)
    return c.surface()


def cobble(width: int, height: int) -> Surface:
    """Round stones set in earth, wet."""
    c = Canvas(width, height, 15)
    stones = c.cells(14, 1, 0.75, warp=1.2)
    edge = stones.edge() * 14.0 - 0.9
    dome = np.sqrt(np.clip(edge / 6.0, 0.0, 1.0))
    on = smoothstep(0.0, 1.0, edge)
    c.height = 2.6 * dome + 0.2 * c.noise(10, 4, seed=2) + 0.9 * (stones.random(3) - 0.5) * on
    c.color = c.ramp("38332c 4c4438 5c5242", 0.5 + 0.5 * c.noise(8, 3, seed=4))
    c.paint(c.ramp(SLATE, 0.2 + 0.62 * stones.random(5) + 0.14 * c.noise(12, 4, seed=6)), on)
    c.paint(c.ramp(SANDSTONE, 0.35 + 0.2 * c.noise(12, 3, seed=7)), 0.8 * on * (stones.random(8) < 0.14))
    c.gloss = 0.2 + on * (0.38 + 0.2 * stones.random(9))
    c.paint(c.ramp(MOSS, 0.4 + 0.4 * c.noise(6, 3, seed=11)), (1 - on) * smoothstep(0.1, 0.5, c.noise(40, 3, seed=12)))
    return c.surface()


def _facets(c: Canvas, size: float, seed: int, steep: float) -> np.ndarray:
    """Broken planes: each cell leans its own way, in texels."""
    cells = c.cells(size, seed, 1.0, warp=size * 0.16)
    lean = ((cells.random(seed + 1) - 0.5) * cells.dx + (cells.random(seed + 2) - 0.5) * cells.dy) * size
    return steep * lean + size * 0.1 * steep * (cells.random(seed + 3) - 0.5) * smoothstep(0.0, 0.1, cells.edge())


def rock_a(width: int, height: int) -> Surface:
    """Riven slate: broken planes in three sizes."""
    c = Canvas(width, height, 16)
    c.height = _facets(c, 43.0, 1, 0.9) + _facets(c, 21.0, 10, 0.6) + _facets(c, 9.0, 20, 0.35) + 0.25 * c.noise(8, 4, seed=30)
    tone = 0.5 + 0.1 * (c.height - c.height.mean()) / c.height.std() + 0.2 * c.noise(42, 4, 0.6, seed=31)
    c.color = c.ramp(SLATE, tone)
    c.paint("8f7d62", 0.35 * smoothstep(0.2, 0.8, c.noise(50, 4, seed=32)))
    c.wear("b7c6d2", 0.4, 2.0, 0.25)
    c.grime("2f3c3c", 0.55, 5.0, 2.0)
    c.gloss = 0.32 + 0.14 * c.noise(30, 3, seed=33)
    c.grain(0.08, 0.1)
    return c.surface()


def rock_b(width: int, height: int) -> Surface:
    """Bedded rock: strata that wander, some of them rotten and set back."""
    c = Canvas(width, height, 17)
    bend = 9.0 * c.noise((64, 80), 3, seed=1) + 2.0 * c.noise(18, 3, seed=2)
    level = (c.y + bend) / height * 11.0
    bed = np.floor(level)
    part = level - bed
    from_edge = np.minimum(part, 1.0 - part) * height / 11.0
    key = (bed.astype(int) % 11) * 13 + 5
    depth, tone = hash01(key, 3), hash01(key, 4)
    c.height = 3.0 * depth + c.bevel(from_edge, 2.5, 1.0) + _facets(c, 18.0, 5, 0.55) + 0.3 * c.noise(9, 4, seed=6)
    c.color = c.ramp("4c463f 6f665a 8f8474 ab9f8b c9bda6", 0.15 + 0.6 * tone + 0.2 * c.noise((40, 14), 4, seed=7))
    c.paint(c.ramp(SLATE, 0.5 + 0.3 * c.noise(20, 3, seed=8)), 0.75 * (hash01(key, 9) < 0.35))
    c.wear("ddd2bb", 0.12, 2.0, 0.5)
    c.grime("3a332b", 0.5, 4.0, 1.6)
    c.grain(0.09, 0.12)
    c.gloss = 0.25 + 0.12 * c.noise(30, 3, seed=10)
    return c.surface()


def dirt(width: int, height: int) -> Surface:
    """Trodden earth with pebbles."""
    c = Canvas(width, height, 18)
    c.height = 0.9 * c.noise(34, 5, 0.55, seed=1)
    c.color = c.ramp("5e4430 7a5a40 957352 b08f6a", 0.5 + 0.3 * c.noise(38, 5, 0.6, seed=2))
    pebbles = c.cells(8, 3, 1.0)
    radius = 0.12 + 0.22 * pebbles.random(4)
    present = pebbles.random(5) < 0.45
    dome = np.sqrt(np.clip(1.0 - (pebbles.nearest / radius) ** 2, 0.0, 1.0)) * present
    c.height += 1.8 * radius * 4.0 * dome
    on = (dome > 0.05).astype(float)
    c.paint(c.ramp("6d5f50 8e8070 a79b8a c0b6a4", pebbles.random(6)), blur(on, 0.6))
    c.grain(0.15, 0.2)
    c.gloss = 0.12 + 0.3 * on
    c.paint("3c2a1c", 0.4 * smoothstep(0.3, 0.9, c.noise(22, 3, seed=7)))
    return c.surface()


def moss_stone(width: int, height: int) -> Surface:
    """Ashlar that stood under water: moss in cushions along the joints, lime below."""
    c = Canvas(width, height, 19)
    blocks = c.blocks(2, 4, 0.5, widths=0.3)
    _dressed(c, blocks, BLUESTONE, 1.8, 1.5, tilt=0.8)
    c.grime("2c352c", 0.5, 3.0)
    grows = c.noise(44, 4, 0.6, seed=30) + 0.8 * smoothstep(5.0, -1.0, blocks.edge) - 0.2
    moss = smoothstep(0.05, 0.5, grows)
    tufts = c.noise(5, 3, 0.7, seed=31)
    c.height += moss * (0.9 + 0.5 * tufts)
    c.paint(c.ramp(MOSS, 0.5 + 0.3 * tufts + 0.25 * c.noise(24, 2, seed=32)), moss)
    c.gloss = c.gloss * (1.0 - 0.8 * moss)
    return c.surface()


def _bricks(c: Canvas, columns: int, rows: int, ramp: str, mortar: str) -> Blocks:
    blocks = c.blocks(columns, rows, 0.5, wander=0.4, widths=0.1)
    edge = blocks.edge - 0.8 + 0.35 * c.noise(5, 3, seed=1)
    on = smoothstep(-0.2, 0.7, edge)
    c.height = c.bevel(edge, 1.4, 1.1) + on * (0.14 * c.noise(6, 3, seed=2) + 0.7 * (blocks.random(3) - 0.5))
    c.color = c.ramp(mortar, 0.5 + 0.4 * c.noise(10, 4, seed=4))
    tone = 0.5 + 0.7 * (blocks.random(5) - 0.5) + 0.1 * c.noise(12, 3, seed=6)
    c.paint(c.ramp(ramp, tone), on)
    c.pits(3.0, 0.5, 0.35)
    c.grain(0.14, 0.14)
    c.gloss = 0.1 + on * (0.18 + 0.25 * (blocks.random(7) > 0.75))
    return blocks


def brick_red(width: int, height: int) -> Surface:
    """Bricks of the monastery's kilns, coral to liver red, pale mortar."""
    c = Canvas(width, height, 20)
    _bricks(c, 6, 12, "74403a 8e4e42 a66250 ba7a64 cc967c", "a89c88 c4b8a2 d6ccb8")
    c.paint("e2d8c6", 0.2 * smoothstep(0.3, 0.9, c.noise(40, 4, seed=20)))
    c.grime("4a3a30", 0.35, 2.5, 0.7)
    return c.surface()


def brick_dark(width: int, height: int) -> Surface:
    """Engineering brick of the foundry: slate blue, some glazed by heat, dark mortar."""
    c = Canvas(width, height, 21)
    blocks = _bricks(c, 6, 12, "3c444c 525d68 687682 82909a a2acb0", "4c4a46 5e5a54 706a62")
    glazed = (blocks.random(20) < 0.12) * smoothstep(0.2, 1.0, blocks.edge)
    c.paint(c.ramp("24574e 2f7164 469181", 0.5 + 0.3 * c.noise(10, 2, seed=21)), 0.85 * glazed)
    c.gloss = np.maximum(c.gloss, 0.7 * glazed)
    c.paint("a8a69a", 0.2 * c.streaks(2, share=0.25))
    return c.surface()


def _limewash(c: Canvas) -> None:
    swirl = 8.0 * c.noise(40, 2, seed=7)
    c.height = 1.1 * c.noise(48, 3, seed=1) + 0.3 * c.noise((26, 6), 3, seed=2, warp=swirl)
    c.color = c.ramp("b8a582 cdbd9a ddd0b0 e8dec4", 0.62 + 0.22 * c.noise(64, 4, 0.55, seed=3) + 0.05 * c.noise(7, 2, seed=4))
    c.tint(1.0 + 0.07 * c.noise((26, 6), 3, seed=2, warp=swirl))
    c.paint("8fb3a0", 0.3 * smoothstep(0.2, 0.9, c.noise((50, 90), 4, seed=5)))
    c.grain(0.05, 0.06)
    c.gloss = 0.15 + 0.05 * c.noise(40, 3, seed=6)


def plaster(width: int, height: int) -> Surface:
    """Limewash over rubble, trowelled by hand."""
    c = Canvas(width, height, 22)
    _limewash(c)
    return c.surface()


def plaster_crack(width: int, height: int) -> Surface:
    """Limewash that has come off in sheets and shows the brick behind."""
    base = Canvas(width, height, 20)
    _bricks(base, 6, 12, "74403a 8e4e42 a66250 ba7a64 cc967c", "a89c88 c4b8a2 d6ccb8")
    c = Canvas(width, height, 22)
    _limewash(c)
    fallen = c.noise(70, 5, 0.5, seed=30) + 0.12 * c.noise(8, 2, seed=31) - 0.28
    crack = np.abs(c.noise(64, 4, 0.5, seed=32)) + 0.25 * smoothstep(0.1, -0.5, fallen)
    sheet = smoothstep(0.03, -0.03, fallen)
    line = (1.0 - smoothstep(0.0, 0.05, crack)) * sheet
    c.height = sheet * (c.height + 2.4) + (1.0 - sheet) * base.height * 0.8 - 0.9 * line
    rim = smoothstep(0.16, 0.02, np.abs(fallen + 0.07)) * sheet
    c.paint("efe7d2", 0.5 * rim)
    c.color = c.color * sheet[..., None] + base.color * (1.0 - sheet[..., None])
    c.paint("5c4f3e", 0.75 * line)
    c.gloss = c.gloss * sheet + base.gloss * (1.0 - sheet)
    return c.surface()
