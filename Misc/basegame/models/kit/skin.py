"""Skins: every patch gets a rectangle of the picture, and its painter colours each texel by its place on the body.

A painter paints twice: palette indices at the skin's own resolution, and for the images beside it (`kit/images.py`)
layers (h, w, 6) at FINE times that: red, green, blue (sRGB 0..1), glow (0 or 1), gloss (1 - roughness, 0..1), height
(units, outwards).
"""

from __future__ import annotations

import dataclasses
import functools

import numpy as np

from art.palette import GLOW_FIRST, PALETTE, RAMPS
from models.kit.noise import fbm
from models.kit.shapes import Patch

FINE = 2  # texels of an image for one of the skin, each way
GLOW, GLOSS, HEIGHT = 3, 4, 5  # layers behind the colours
_PAD = 1  # texels around a rectangle that repeat its edge, for filters
_BAYER = (np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) + 0.5) / 16.0 - 0.5


class Surface:
    """What a painter is given: for each texel (h, w) of a patch where it is, at rest; `fine` times as many for layers."""

    def __init__(self, patch: Patch, width: int, height: int, skin: int, fine: int = 0):
        along, _ = patch_lengths(patch)
        u, v = (_shares(size, max(fine, 1)) for size in (width, height))
        v = np.clip(v, 0.0, 1.0)
        self.u, self.v = np.meshgrid(u % 1.0, v)
        rows = np.interp(v, along, np.arange(len(along)))
        columns = (u % 1.0) * (patch.grid.shape[1] - 1)
        self.position = _bilinear(patch.grid, rows, columns)  # (h, w, 3) units
        self.x, self.y, self.z = np.moveaxis(self.position, -1, 0)
        self.skin = skin  # which of the model's skins this is
        self.fine = fine  # 0: indices are wanted, else layers

    def noise(self, size: float, seed: int = 0, octaves: int = 3) -> np.ndarray:
        """Grain 0..1 with features of `size` units."""
        return fbm(self.position + 50.0, size, octaves, seed)

    def near(self, point, radius: float, soft: float = 0.0) -> np.ndarray:
        """Whether texels lie within `radius` units of a point; with `soft` 1 inside falling to 0."""
        distance = np.linalg.norm(self.position - np.asarray(point, float), axis=-1)
        return np.clip((radius - distance) / soft + 0.5, 0, 1) if soft else distance < radius

    def ramp(self, name: str, value, gloss=0.0, height=0.0) -> np.ndarray:
        """A palette's ramp at `value` 0..1: indices, dithered over one step; or layers, which have gloss and height."""
        value = np.broadcast_to(np.asarray(value, float), self.u.shape)
        if self.fine:
            return _layers(name, value, gloss, height)
        steps = np.array(RAMPS[name])
        rows, columns = self.u.shape
        pattern = np.tile(_BAYER, (-(-rows // 4), -(-columns // 4)))[:rows, :columns]
        at = np.round(value * (len(steps) - 1) + pattern * 0.45)
        return steps[np.clip(at, 0, len(steps) - 1).astype(int)].astype(np.uint8)


def _shares(size: int, fine: int) -> np.ndarray:
    """Places 0..1 of the texels along a rectangle of the skin, its padding included."""
    return ((np.arange(-_PAD * fine, (size + _PAD) * fine) + 0.5) / fine - 0.5) / max(size - 1, 1)


@functools.cache
def _colors(ramp: str) -> np.ndarray:
    """A ramp's colours (256, 3), sRGB 0..1, without steps."""
    steps = PALETTE[RAMPS[ramp]].astype(np.float32) / 255.0
    at, places = np.linspace(0.0, 1.0, 256), np.linspace(0.0, 1.0, len(steps))
    return np.stack([np.interp(at, places, steps[:, i]) for i in range(3)], axis=1).astype(np.float32)


def _layers(ramp: str, value: np.ndarray, gloss, height) -> np.ndarray:
    out = np.empty((*value.shape, HEIGHT + 1), np.float32)
    out[..., :GLOW] = _colors(ramp)[np.clip(value * 255.0 + 0.5, 0, 255).astype(np.int32)]
    out[..., GLOW], out[..., GLOSS], out[..., HEIGHT] = RAMPS[ramp][0] >= GLOW_FIRST, gloss, height
    return out


def choose(mask: np.ndarray, inside: np.ndarray, outside: np.ndarray) -> np.ndarray:
    """One painting (indices or layers) where `mask` (h, w) holds, else another."""
    return np.where(mask if inside.ndim == 2 else mask[..., None], inside, outside)


def patch_lengths(patch: Patch) -> tuple[np.ndarray, float]:
    """The rings' places 0..1 along the patch by length, and its largest girth in units."""
    steps = np.linalg.norm(np.diff(patch.grid, axis=0), axis=2).mean(axis=1) + 1e-6
    along = np.concatenate([[0.0], np.cumsum(steps)])
    girth = np.linalg.norm(np.diff(patch.grid, axis=1), axis=2).sum(axis=1).max()
    return along / along[-1], float(girth)


def _size(patch: Patch, density: float) -> tuple[int, int]:
    steps = np.linalg.norm(np.diff(patch.grid, axis=0), axis=2).mean(axis=1)
    _, girth = patch_lengths(patch)
    scale = density * patch.detail
    return max(6, int(girth * scale)), max(5, int(steps.sum() * scale))


def _bilinear(grid: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    r0 = np.clip(rows.astype(int), 0, grid.shape[0] - 2)
    c0 = np.clip(columns.astype(int), 0, grid.shape[1] - 2)
    fr, fc = (rows - r0)[:, None, None], (columns - c0)[None, :, None]
    top = grid[r0][:, c0] * (1 - fc) + grid[r0][:, c0 + 1] * fc
    bottom = grid[r0 + 1][:, c0] * (1 - fc) + grid[r0 + 1][:, c0 + 1] * fc
    return top * (1 - fr) + bottom * fr


@dataclasses.dataclass
class Place:
    """A patch's rectangle, without its padding."""

    x: int
    y: int
    width: int
    height: int


def _shelves(sizes: list[tuple[int, int]], width: int) -> tuple[list[Place], int] | None:
    places: dict[int, Place] = {}
    x = y = shelf = 0
    for i in sorted(range(len(sizes)), key=lambda i: (-sizes[i][1], i)):
        w, h = sizes[i][0] + 2 * _PAD, sizes[i][1] + 2 * _PAD
        if w > width:
            return None
        if x + w > width:
            x, y, shelf = 0, y + shelf, 0
        places[i] = Place(x + _PAD, y + _PAD, sizes[i][0], sizes[i][1])
        x, shelf = x + w, max(shelf, h)
    return [places[i] for i in range(len(sizes))], y + shelf


def pack(patches: list[Patch], width: int, height: int) -> list[Place]:
    """A place for each patch in a picture of this size, at the greatest density that fits."""
    sheets: dict[object, int] = {}
    owner = [sheets.setdefault(p.sheet if p.sheet >= 0 else ("own", i), len(sheets)) for i, p in enumerate(patches)]
    first = [patches[owner.index(k)] for k in range(len(sheets))]
    low, high, best = 0.05, 60.0, None
    for _ in range(18):
        density = (low + high) / 2.0
        found = _shelves([_size(p, density) for p in first], width)
        if found and found[1] <= height:
            low, best = density, found[0]
        else:
            high = density
    if best is None:
        raise ValueError(f"{len(first)} patches do not fit a skin of {width}x{height}")
    return [best[k] for k in owner]


def _painted(patches: list[Patch], places: list[Place], skin: int, fine: int):
    """Each rectangle once: its patch, its rows and columns with the padding, the surface and what is painted on it."""
    done: set[tuple[int, int]] = set()
    for patch, place in zip(patches, places):
        if (place.x, place.y) in done:
            continue
        done.add((place.x, place.y))
        surface = Surface(patch, place.width, place.height, skin, fine)
        part = [
            slice((at - _PAD) * max(fine, 1), (at + size + _PAD) * max(fine, 1))
            for at, size in ((place.y, place.height), (place.x, place.width))
        ]
        yield tuple(part), surface, patch.paint(surface)


def paint_skin(patches: list[Patch], places: list[Place], width: int, height: int, skin: int) -> np.ndarray:
    """The picture (height, width) uint8."""
    picture = np.zeros((height, width), np.uint8)
    for part, _, painted in _painted(patches, places, skin, 0):
        picture[part] = painted
    return picture


def paint_layers(
    patches: list[Patch], places: list[Place], width: int, height: int, skin: int
) -> tuple[np.ndarray, np.ndarray]:
    """Layers of the whole skin (FINE * height, FINE * width, 6), and the slopes (..., 2) of its height to the right and
    down, units per unit."""
    layers = np.zeros((FINE * height, FINE * width, HEIGHT + 1), np.float32)
    slopes = np.zeros((*layers.shape[:2], 2), np.float32)
    for part, surface, painted in _painted(patches, places, skin, FINE):
        layers[part] = painted
        slopes[part] = _slopes(surface.position, painted[..., HEIGHT])
    return layers, slopes


def _slopes(position: np.ndarray, height: np.ndarray) -> np.ndarray:
    """How much `height` (h, w) rises to the right and down, by the distances between the texels' places."""
    out = np.zeros((*height.shape, 2), np.float32)
    for axis, direction in ((1, 0), (0, 1)):
        step = np.linalg.norm(np.gradient(position, axis=axis), axis=-1)
        # Where a patch closes to a point its texels lie together: there the relief would be a wall.
        out[..., direction] = np.gradient(height, axis=axis) / np.maximum(step, 0.5 * step.mean() + 1e-6)
    return out


def texels(patch: Patch, place: Place) -> np.ndarray:
    """Texel coordinates (rings, columns, 2) of a patch's vertices."""
    along, _ = patch_lengths(patch)
    s = place.x + np.round(np.linspace(0.0, 1.0, patch.grid.shape[1]) * (place.width - 1))
    t = place.y + np.round(along * (place.height - 1))
    return np.stack(np.meshgrid(s, t), axis=-1).astype(int)
