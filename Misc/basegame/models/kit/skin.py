"""Skins: every patch gets a rectangle of the picture, and its painter colours each texel by its place on the body."""

from __future__ import annotations

import dataclasses

import numpy as np

from art.palette import RAMPS
from models.kit.noise import fbm
from models.kit.shapes import Patch

_PAD = 1  # texels around a rectangle that repeat its edge, for filters
_BAYER = (np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) + 0.5) / 16.0 - 0.5


class Surface:
    """What a painter is given: for each texel (h, w) of a patch where it is, at rest."""

    def __init__(self, patch: Patch, width: int, height: int, skin: int):
        along, _ = patch_lengths(patch)
        u = (np.arange(-_PAD, width + _PAD) + 0.0) / max(width - 1, 1)
        v = np.clip((np.arange(-_PAD, height + _PAD) + 0.0) / max(height - 1, 1), 0.0, 1.0)
        self.u, self.v = np.meshgrid(u % 1.0, v)
        rows = np.interp(v, along, np.arange(len(along)))
        columns = (u % 1.0) * (patch.grid.shape[1] - 1)
        self.position = _bilinear(patch.grid, rows, columns)  # (h, w, 3) units
        self.x, self.y, self.z = np.moveaxis(self.position, -1, 0)
        self.skin = skin  # which of the model's skins this is

    def noise(self, size: float, seed: int = 0, octaves: int = 3) -> np.ndarray:
        """Grain 0..1 with features of `size` units."""
        return fbm(self.position + 50.0, size, octaves, seed)

    def near(self, point, radius: float, soft: float = 0.0) -> np.ndarray:
        """Whether texels lie within `radius` units of a point; with `soft` 1 inside falling to 0."""
        distance = np.linalg.norm(self.position - np.asarray(point, float), axis=-1)
        return np.clip((radius - distance) / soft + 0.5, 0, 1) if soft else distance < radius

    def ramp(self, name: str, value, spread: float = 1.0) -> np.ndarray:
        """Indices of a palette's ramp at `value` 0..1, dithered over one step."""
        steps = np.array(RAMPS[name])
        height, width = self.u.shape
        pattern = np.tile(_BAYER, (-(-height // 4), -(-width // 4)))[:height, :width]
        value = np.broadcast_to(np.asarray(value, float), self.u.shape)
        at = np.round(value * (len(steps) - 1) + pattern * spread * 0.45)
        return steps[np.clip(at, 0, len(steps) - 1).astype(int)].astype(np.uint8)


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


def paint_skin(patches: list[Patch], places: list[Place], width: int, height: int, skin: int) -> np.ndarray:
    """The picture (height, width) uint8."""
    picture = np.zeros((height, width), np.uint8)
    done: set[tuple[int, int]] = set()
    for patch, place in zip(patches, places):
        if (place.x, place.y) in done:
            continue
        done.add((place.x, place.y))
        surface = Surface(patch, place.width, place.height, skin)
        rows, columns = slice(place.y - _PAD, place.y + place.height + _PAD), slice(
            place.x - _PAD, place.x + place.width + _PAD
        )
        picture[rows, columns] = patch.paint(surface)
    return picture


def texels(patch: Patch, place: Place) -> np.ndarray:
    """Texel coordinates (rings, columns, 2) of a patch's vertices."""
    along, _ = patch_lengths(patch)
    s = place.x + np.round(np.linspace(0.0, 1.0, patch.grid.shape[1]) * (place.width - 1))
    t = place.y + np.round(along * (place.height - 1))
    return np.stack(np.meshgrid(s, t), axis=-1).astype(int)
