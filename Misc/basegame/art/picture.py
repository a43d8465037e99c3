"""Pictures of the screen's furniture: drawn by distances at four times their size, then made palette indices.

Unlike the world's textures these are seen as painted, so they carry their own light: from the left above.
"""

from __future__ import annotations

import numpy as np

from art.letters import Pen, text_distance, text_width
from art.noise import fractal_noise
from art.palette import TRANSPARENT, gradient, hex_to_srgb, linear_from_srgb, nearest, srgb_from_linear
from art.surface import shrink

Field = np.ndarray
OVERSAMPLING = 4  # subpixels a pixel each way, unless a picture asks otherwise


class Picture:
    """A picture of width x height pixels; x and y are its coordinates in pixels at each of its subpixels."""

    def __init__(self, width: int, height: int, seed: int = 1, oversampling: int = OVERSAMPLING):
        self.width, self.high, self.seed, self.oversampling = width, height, seed, oversampling
        s = oversampling
        self.x, self.y = np.meshgrid((np.arange(width * s) + 0.5) / s, (np.arange(height * s) + 0.5) / s)
        self.color = np.zeros((*self.x.shape, 3))  # linear light
        self.cover = np.zeros(self.x.shape)

    def noise(self, wavelength: float | tuple[float, float], seed: int = 0, octaves: int = 4) -> Field:
        """Noise of about -1..1; `wavelength` in pixels."""
        across, down = wavelength if isinstance(wavelength, tuple) else (wavelength, wavelength)
        return fractal_noise(
            self.x[0] / self.width,
            self.y[:, 0] / self.high,
            max(1, self.width / across),
            max(1, self.high / down),
            self.seed * 131 + seed,
            octaves,
        )

    def mask(self, distance: Field) -> Field:
        """1 inside a figure, 0 outside, an edge a subpixel wide."""
        return np.clip(0.5 - distance * self.oversampling, 0.0, 1.0)

    def lay(self, mask: Field, color: str | Field) -> None:
        """Lays a colour (`rrggbb`, or linear light (h, w, 3)) over the picture."""
        rgb = linear_from_srgb(hex_to_srgb(color)) if isinstance(color, str) else color
        self.color += (rgb - self.color) * np.asarray(mask)[..., None]
        self.cover = np.maximum(self.cover, mask)

    def erase(self, mask: Field) -> None:
        """Makes a hole."""
        self.cover = np.minimum(self.cover, 1.0 - mask)

    def fill(
        self,
        distance: Field,
        ramp: str,
        bevel: float = 1.5,
        at: Field | float = 0.5,
        contrast: float = 0.5,
        outline: str | None = "14161a",
        width: float = 0.9,
    ) -> None:
        """A solid figure: edges `bevel` pixels wide catch the light, `at` is where the flat has its colour on the ramp."""
        if outline is not None:
            self.lay(self.mask(distance - width), outline)
        gy, gx = np.gradient(distance, 1.0 / self.oversampling)
        edge = np.clip(1.0 + distance / max(bevel, 1e-3), 0.0, 1.0)
        light = -(gx * 0.62 + gy * 0.78) * edge * -1.0
        self.lay(self.mask(distance), gradient(ramp, at - contrast * light, linear=True))

    def text(
        self,
        words: str,
        left: float,
        top: float,
        high: float,
        ramp: str,
        pen: Pen = Pen(0.105, 0.045, 32.0),
        spacing: float = 0.14,
        outline: str | None = "14161a",
        width: float = 1.0,
    ) -> None:
        """A line of text, lighter towards its top."""
        distance = text_distance(self.x, self.y, words, left, top, high, pen, spacing)
        if outline is not None:
            self.lay(self.mask(distance - width), outline)
        self.lay(self.mask(distance), gradient(ramp, 1.0 - (self.y - top) / high, linear=True))

    def text_fit(
        self,
        words: str,
        ramp: str,
        margin: float = 2.0,
        centre: bool = False,
        pen: Pen = Pen(0.105, 0.045, 32.0),
        spacing: float = 0.14,
    ) -> None:
        """A line of text as large as the picture allows."""
        high = min(self.high - 2 * margin, (self.width - 2 * margin) / (text_width(words, 1.0, spacing) + 0.2))
        left = margin + 0.08 * high
        if centre:
            left = 0.5 * (self.width - text_width(words, high, spacing))
        self.text(words, left, 0.5 * (self.high - high), high, ramp, pen, spacing)

    def indices(self, among: list[int] | None = None, dither: float = 0.0) -> np.ndarray:
        """The picture as palette indices (h, w); 255 where less than half is covered."""
        cover = shrink(self.cover, self.oversampling)
        light = shrink(self.color * self.cover[..., None], self.oversampling) / np.maximum(cover, 1e-6)[..., None]
        out = nearest(srgb_from_linear(light), dither=dither, among=among if among is not None else list(range(255)))
        return np.where(cover >= 0.5, out, TRANSPARENT).astype(np.uint8)
