"""From patches, bones and poses to a model file's contents."""

from __future__ import annotations

import dataclasses

import numpy as np

from formats.mdl import Frame, Mdl
from models.kit.shapes import Patch
from models.kit.skeleton import Posing, Skeleton
from models.kit.skin import Place, pack, paint_skin, texels


@dataclasses.dataclass
class Figure(Mdl):
    """A model that knows how it was painted, for the images beside it."""

    patches: list[Patch] = dataclasses.field(default_factory=list)
    places: list[Place] = dataclasses.field(default_factory=list)


def _faces(grid: np.ndarray, first: int, fan: bool = False) -> list[tuple[int, int, int]]:
    """Triangles of a patch's grid, counter-clockwise from outside; none where a ring is a point."""
    rings, columns = grid.shape[:2]
    point = np.ptp(grid, axis=1).max(axis=1) < 1e-6  # a ring that is one point has one vertex, its middle column's
    index = lambda r, c: first + r * columns + (columns // 2 if point[r] and not fan else c)
    quads = [
        (index(r, c), index(r, c + 1), index(r + 1, c + 1), index(r + 1, c))
        for r in range(rings - 1)
        for c in range(columns - 1)
    ]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    points = grid.reshape(-1, 3)
    corner = points[np.array(triangles) - first] - points.mean(axis=0)
    areas = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    volume = np.einsum("ti,ti->t", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])).sum()
    kept = [t for t, area in zip(triangles, areas) if area > 1e-5]
    return kept if volume > 0 else [(a, c, b) for a, b, c in kept]


def _normals(positions: np.ndarray, triangles: np.ndarray, weld: np.ndarray) -> np.ndarray:
    """Unit normals (P, V, 3): faces around a place, weighted by area; `weld` numbers the vertices' places."""
    corner = positions[:, triangles]
    face = np.cross(corner[:, :, 1] - corner[:, :, 0], corner[:, :, 2] - corner[:, :, 0])
    total = np.zeros((len(positions), weld.max() + 1, 3))
    for k in range(3):
        np.add.at(total, (slice(None), weld[triangles[:, k]]), face)
    out = total[:, weld]
    length = np.linalg.norm(out, axis=2, keepdims=True)
    return np.where(length > 1e-9, out / np.maximum(length, 1e-9), [0.0, 0.0, 1.0])


def _without_loose(patches_points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices that some triangle uses, and the triangles renumbered."""
    used = np.unique(triangles)
    renumber = np.zeros(len(patches_points), int)
    renumber[used] = np.arange(len(used))
    return used, renumber[triangles]


def still(bone: str = "root") -> Posing:
    """One frame of a body that does not move."""
    return Posing(Skeleton({bone: ("", (0, 0, 0))}), 1)


def build(
    patches: list[Patch],
    posing: Posing | None = None,
    frames: list[Frame] | list[str] | None = None,
    skin=(256, 192),
    skins: int = 1,
    flags: int = 0,
    floor: float | None = None,
    random_start: bool = False,
) -> Figure:
    """The model. `frames` are names, one a pose, or Frames; nothing sinks below `floor` (units)."""
    posing = posing or still()
    points = np.concatenate([p.grid.reshape(-1, 3) for p in patches])
    shares = [ring for p in patches for ring in p.bones for _ in range(p.grid.shape[1])]
    firsts = np.cumsum([0] + [p.grid.shape[0] * p.grid.shape[1] for p in patches])
    triangles = np.array([t for p, first in zip(patches, firsts) for t in _faces(p.grid, int(first), p.fan)])
    width, height = skin
    places = pack(patches, width, height)
    skin_places = np.concatenate([texels(p, place).reshape(-1, 2) for p, place in zip(patches, places)])
    used, triangles = _without_loose(points, triangles)
    positions = posing.skin(points[used], [shares[i] for i in used])
    if floor is not None:
        positions[..., 2] = np.maximum(positions[..., 2], floor)
    patch_of = np.repeat(np.arange(len(patches)), np.diff(firsts))[used]
    keys = np.concatenate([np.round(points[used], 4), patch_of[:, None]], axis=1)
    _, weld = np.unique(keys, axis=0, return_inverse=True)
    names = frames or ["frame1"]
    listed = [Frame(name, [i]) if isinstance(name, str) else name for i, name in enumerate(names)]
    pictures = [paint_skin(patches, places, width, height, k) for k in range(skins)]
    return Figure(
        positions,
        _normals(positions, triangles, weld.reshape(-1)),
        triangles,
        skin_places[used],
        pictures,
        listed,
        flags,
        random_start,
        patches,
        places,
    )
