"""What painters of textures work on: coordinates in texels, noise by wavelength, layers, and the usual wear.

    c = Canvas(width, height, seed)
    c.color = c.ramp(SLATE, 0.5 + 0.3 * c.noise(32))
    c.height = ...; c.gloss = ...
    return c.surface()
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from art import noise
from art.noise import Cells, blur, hash01, smoothstep
from art.palette import BAYER, gradient, hex_to_srgb, linear_from_srgb, srgb_from_linear
from art.surface import Surface

Field = np.ndarray


@dataclass
class Blocks:
    """A layout of bricks or slabs, per pixel: which (a number), the distance to its edge in texels, and where in it."""

    number: Field
    edge: Field
    u: Field  # texels from the block's middle
    v: Field

    def random(self, seed: int) -> Field:
        """A number 0..1 for each block."""
        return hash01(self.number, seed)


class Canvas:
    """Layers of one texture, `scale` pixels a texel."""

    def __init__(self, width: int, height: int, seed: int, scale: int = 2):
        self.width, self.height_texels, self.scale, self.seed = width, height, scale, seed
        columns, rows = (np.arange(width * scale) + 0.5) / scale, (np.arange(height * scale) + 0.5) / scale
        self.x, self.y = np.meshgrid(columns, rows)
        self.u, self.v = self.x / width, self.y / height
        self.color = np.zeros((*self.x.shape, 3))
        self.height = np.zeros(self.x.shape)
        self.gloss = np.full(self.x.shape, 0.2)
        self.glow: Field | None = None
        self.holes: Field | None = None
        self.shine = 1.0

    def noise(
        self,
        wavelength: float | tuple[float, float],
        octaves: int = 4,
        gain: float = 0.5,
        seed: int = 0,
        warp: Field | None = None,
    ) -> Field:
        """Fractal noise, about -1..1; `wavelength` in texels, one or (across, down). `warp` (texels) moves it sideways."""
        across, down = wavelength if isinstance(wavelength, tuple) else (wavelength, wavelength)
        u = self.u[0] if warp is None else self.u + warp / self.width
        v = self.v[:, 0] if warp is None else self.v + warp / self.height_texels
        columns, rows = max(1, self.width / across), max(1, self.height_texels / down)
        return noise.fractal_noise(u, v, columns, rows, self.seed * 7919 + seed, octaves, gain)

    def cells(self, size: float | tuple[float, float], seed: int = 0, jitter: float = 0.9, warp: float = 0.0) -> Cells:
        """Cells about `size` texels wide; their borders wander by `warp` texels."""
        across, down = size if isinstance(size, tuple) else (size, size)
        u, v = self.u, self.v
        if warp:
            u = u + warp * self.noise(across, 3, seed=seed + 50) / self.width
            v = v + warp * self.noise(across, 3, seed=seed + 51) / self.height_texels
        columns, rows = round(self.width / across), round(self.height_texels / down)
        return noise.cells(u, v, columns, rows, self.seed * 7919 + seed, jitter)

    def blocks(self, columns: int, rows: int, shift: float = 0.5, wander: float = 0.0, widths: float = 0.0) -> Blocks:
        """Courses of blocks, every other one shifted by a part of a block; `widths` varies them, `wander` bends joints."""
        x, y = self.x, self.y
        if wander:
            x = x + wander * self.noise(24, 2, seed=900)
            y = y + wander * self.noise(24, 2, seed=901)
        high, wide = self.height_texels / rows, self.width / columns
        row = np.floor(y / high)
        v = y - (row + 0.5) * high
        row = row.astype(int) % rows
        across = (x / wide + shift * (row % 2)) % columns
        # Vertical joints stand at j + offset(j): the pixel's block is between those on either side of it.
        j = np.floor(across).astype(int)

        def joint(k: Field) -> Field:
            return k + widths * (hash01(k % columns, row, self.seed + 902) - 0.5)

        j = np.where(across < joint(j), j - 1, np.where(across >= joint(j + 1), j + 1, j))
        left, right = joint(j), joint(j + 1)
        u = (across - 0.5 * (left + right)) * wide
        edge = np.minimum(0.5 * (right - left) * wide - np.abs(u), 0.5 * high - np.abs(v))
        return Blocks((j % columns) + columns * row, edge, u, v)

    @staticmethod
    def ramp(colors: str, at: Field | float) -> Field:
        """sRGB along colours (`rrggbb` in one text) for 0..1."""
        return gradient(colors, at)

    def paint(self, color: Field | str, mask: Field) -> None:
        """Lays a colour, or an sRGB picture, over what is there where the mask is 1."""
        rgb = hex_to_srgb(color) if isinstance(color, str) else color
        mask = np.clip(mask, 0.0, 1.0)[..., None]
        self.color = self.color * (1.0 - mask) + rgb * mask

    def tint(self, factor: Field) -> None:
        """Multiplies reflectance (linear light) by a factor, such as each block's own."""
        self.color = srgb_from_linear(linear_from_srgb(self.color) * np.asarray(factor)[..., None])

    def pattern(self) -> Field:
        """An ordered pattern of 4x4 pixels, -0.5..0.5, that mixes a ramp's colours where the palette has few."""
        height, width = self.x.shape
        return np.tile(BAYER, (-(-height // 4), -(-width // 4)))[:height, :width]

    def mask(self, distance: Field, soft: float = 0.0) -> Field:
        """1 inside of a figure, with an edge one pixel (or `soft` texels) wide."""
        width = max(soft, 1.0 / self.scale)
        return np.clip(0.5 - distance / width, 0.0, 1.0)

    def bevel(self, edge: Field, width: float, high: float = 1.0) -> Field:
        """A rounded rise of `high` texels over the first `width` texels from an edge (distance inwards)."""
        t = np.clip(edge / width, 0.0, 1.0)
        return high * np.sqrt(1.0 - (1.0 - t) ** 2)

    def cavity(self, radius: float = 4.0) -> Field:
        """How far a place lies below its surroundings, in texels: positive in joints, negative on edges."""
        return blur(self.height, radius * self.scale) - self.height

    def wear(self, color: str, amount: float = 0.6, radius: float = 3.0, threshold: float = 0.12, gloss: float = 0.0) -> None:
        """Rubs edges down to a colour, where they stand out and noise allows."""
        raised = smoothstep(threshold, threshold + 0.5, -self.cavity(radius) * (1.0 + 0.8 * self.noise(10, 3, seed=930)))
        self.paint(color, amount * raised)
        self.gloss = self.gloss + gloss * raised

    def grime(self, color: str, amount: float = 0.6, radius: float = 4.0, reach: float = 0.8) -> None:
        """Dirt that settles where the surface lies low."""
        low = smoothstep(0.0, reach, self.cavity(radius) + 0.1 * self.noise(16, 3, seed=931))
        self.paint(color, amount * low)
        self.gloss = self.gloss * (1.0 - 0.7 * amount * low)

    def grain(self, color: float, high: float, seed: int = 0) -> None:
        """Fine unevenness: reflectance varies by about `color` of itself, height by `high` texels."""
        fine = self.noise(4, 3, 0.8, seed=950 + seed)
        self.tint(np.clip(1.0 + color * fine, 0.3, 2.0))
        self.height = self.height + high * (0.6 * fine + 0.4 * self.noise(2, 1, seed=951 + seed))

    def pits(self, size: float, depth: float, share: float, seed: int = 0) -> None:
        """Small round holes, at most `depth` texels deep, in a `share` of cells `size` texels wide."""
        holes = self.cells(size, 960 + seed, 1.0)
        radius = 0.1 + 0.25 * holes.random(1) ** 2
        deep = np.clip(1.0 - (holes.nearest / radius) ** 2, 0.0, 1.0) * (holes.random(2) < share)
        self.height = self.height - depth * deep
        self.tint(1.0 - 0.25 * deep)

    def streaks(self, seed: int = 0, length: float = 96.0, share: float = 0.4) -> Field:
        """Where water ran down: 0..1, in vertical streaks that cover about a `share` of the width."""
        lines = self.noise((7, length), 3, seed=940 + seed) + 0.7 * self.noise((40, length), 2, seed=941 + seed)
        return smoothstep(0.6 - share, 1.3 - share, lines)

    def surface(self, palette: list[int] | None = None, dither: float = 0.0, tiles: bool = True) -> Surface:
        """The layers as a surface."""
        return Surface(
            np.clip(self.color, 0.0, 1.0),
            self.height,
            np.clip(self.gloss, 0.0, 0.97),
            self.glow,
            shine=self.shine,
            holes=self.holes,
            scale=self.scale,
            palette=palette,
            dither=dither,
            tiles=tiles,
        )
