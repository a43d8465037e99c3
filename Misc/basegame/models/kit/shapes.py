"""The shapes that models are made of: grids of vertices, closed around, each with bones and a painter.

A `Patch` is a grid of rings by columns; its first and last column coincide, so that the skin has a seam there (at the
back of upright shapes). Everything is in units at rest.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Sequence

import numpy as np

Vec = Sequence[float] | np.ndarray
_sheets = itertools.count()
Weights = dict[str, float]  # bone -> share, 1 in all


@dataclasses.dataclass
class Patch:
    grid: np.ndarray  # (rings, columns, 3); the last column repeats the first
    paint: Callable  # Surface -> palette indices
    bones: list[Weights]  # per ring
    detail: float = 1.0  # texels per unit, relative to the model's
    fan: bool = False  # ends have a vertex for each column, so that what is painted on a disc is not drawn together
    sheet: int = -1  # patches of one sheet share their place in the skin; -1: its own


def unit(v: Vec) -> np.ndarray:
    v = np.asarray(v, float)
    return v / max(np.linalg.norm(v), 1e-12)


def round_section(sides: int) -> np.ndarray:
    """A circle from behind around (sides + 1, 2)."""
    angle = np.pi + np.linspace(0.0, 2.0 * np.pi, sides + 1)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def box_section(chamfer: float = 0.18) -> np.ndarray:
    """A square -1..1 with its corners cut (9, 2)."""
    c = 1.0 - chamfer
    points = [(-1, c), (-1, -c), (-c, -1), (c, -1), (1, -c), (1, c), (c, 1), (-c, 1), (-1, c)]
    return np.array(points, float)


def flat_section() -> np.ndarray:
    """A lens: for blades, fins and cloth (5, 2); the first radius is the thickness."""
    return np.array([(0, 1), (-1, 0), (0, -1), (1, 0), (0, 1)], float)


def ring_bones(bones: str | Weights | Sequence, count: int) -> list[Weights]:
    """One bone for all rings, or one entry (a name or shares) for each."""
    if isinstance(bones, str):
        return [{bones: 1.0}] * count
    if isinstance(bones, dict):
        return [bones] * count
    return [{b: 1.0} if isinstance(b, str) else b for b in bones]


def tube(
    path: Sequence[Vec],
    radii: Sequence,
    paint: Callable,
    bones="root",
    sides: int = 8,
    up: Vec = (1, 0, 0),
    section: np.ndarray | None = None,
    caps: tuple[float | None, float | None] = (0.0, 0.0),
    detail: float = 1.0,
) -> Patch:
    """A loft along `path`: at each point a ring of `radii` (one number, or along `up` and across it).

    `caps` close the ends with a point that stands out by so many units; None leaves an end open.
    """
    points = np.asarray(path, float)
    shape = section if section is not None else round_section(sides)
    tangents = np.gradient(points, axis=0) if len(points) > 1 else np.array([[0, 0, 1.0]])
    rings, names = [], ring_bones(bones, len(points))
    for point, tangent, radius in zip(points, tangents, radii):
        a, b = (radius, radius) if np.isscalar(radius) else radius
        along = unit(tangent)
        first = unit(np.asarray(up, float) - along * np.dot(up, along))
        rings.append(point + shape[:, :1] * a * first + shape[:, 1:] * b * np.cross(along, first))
    for end, cap in enumerate(caps):
        if cap is None:
            continue
        at, sign = (0, -1.0) if end == 0 else (-1, 1.0)
        pole = np.repeat((points[at] + unit(tangents[at]) * sign * cap)[None], len(shape), axis=0)
        rings, names = ([pole] + rings, [names[0]] + names) if end == 0 else (rings + [pole], names + [names[-1]])
    return Patch(np.array(rings), paint, names, detail)


def lathe(
    profile: Sequence[tuple[float, float]],
    paint: Callable,
    bones="root",
    at: Vec = (0, 0, 0),
    axis: Vec = (0, 0, 1),
    sides: int = 10,
    up: Vec = (1, 0, 0),
    caps: tuple[float | None, float | None] = (0.0, 0.0),
    detail: float = 1.0,
    squash: float = 1.0,
    section: np.ndarray | None = None,
) -> Patch:
    """A turned shape: `profile` lists (distance along the axis, radius); `squash` scales the radius across `up`."""
    axis = unit(axis)
    if abs(np.dot(axis, unit(up))) > 0.9:
        up = (0, 0, 1)
    path = [np.asarray(at, float) + axis * h for h, _ in profile]
    # Rings of equal place have no tangent of their own: give them the axis.
    patch = tube(path, [(r, r * squash) for _, r in profile], paint, bones, sides, up, section, (None, None), detail)
    first = unit(np.asarray(up, float) - axis * np.dot(up, axis))
    shape = section if section is not None else round_section(sides)
    across = np.cross(axis, first)
    rings = [p + shape[:, :1] * r * first + shape[:, 1:] * r * squash * across for p, (_, r) in zip(path, profile)]
    names = patch.bones
    if caps[0] is not None:
        rings.insert(0, np.repeat((path[0] - axis * caps[0])[None], len(shape), axis=0))
        names = [names[0]] + names
    if caps[1] is not None:
        rings.append(np.repeat((path[-1] + axis * caps[1])[None], len(shape), axis=0))
        names = names + [names[-1]]
    return Patch(np.array(rings), paint, names, detail)


def ellipsoid(
    at: Vec,
    radii: Vec,
    paint: Callable,
    bones="root",
    rings: int = 5,
    sides: int = 8,
    axis: Vec = (0, 0, 1),
    up: Vec = (1, 0, 0),
    detail: float = 1.0,
) -> Patch:
    """`radii` are along `up`, across it and along the axis."""
    axis = unit(axis)
    if abs(np.dot(axis, unit(up))) > 0.9:
        up = (0, 0, 1)
    angle = np.linspace(0.0, np.pi, rings + 2)[1:-1]
    path = [np.asarray(at, float) - axis * np.cos(a) * radii[2] for a in angle]
    sizes = [(np.sin(a) * radii[0], np.sin(a) * radii[1]) for a in angle]
    out = radii[2] * (1.0 - np.cos(angle[0]))
    return tube(path, sizes, paint, bones, sides, up, None, (out, out), detail)


def box(
    at: Vec,
    size: Vec,
    paint: Callable,
    bones="root",
    axis: Vec = (0, 0, 1),
    up: Vec = (1, 0, 0),
    bevel: float = 0.18,
    detail: float = 1.0,
    taper: float = 1.0,
) -> Patch:
    """A bevelled block of full lengths `size` along `up`, across and along the axis; `taper` scales its far end."""
    axis = unit(axis)
    if abs(np.dot(axis, unit(up))) > 0.9:
        up = (0, 0, 1)
    half = np.asarray(size, float) / 2.0
    cut = bevel * min(half)
    places = [-half[2], -half[2] + cut, half[2] - cut, half[2]]
    scale = [1.0, 1.0, taper, taper]
    inset = [cut, 0.0, 0.0, cut]
    path = [np.asarray(at, float) + axis * p for p in places]
    sizes = [(half[0] * s - i, half[1] * s - i) for s, i in zip(scale, inset)]
    return tube(path, sizes, paint, bones, up=up, section=box_section(bevel), detail=detail)


def torus(
    at: Vec,
    axis: Vec,
    radius: float,
    thick: float | tuple[float, float],
    paint: Callable,
    bones="root",
    around: int = 12,
    sides: int = 5,
    up: Vec = (1, 0, 0),
    squash: float = 1.0,
    detail: float = 1.0,
) -> Patch:
    """A ring; `thick` is the radius of its body (or out of the axis, along it)."""
    axis = unit(axis)
    if abs(np.dot(axis, unit(up))) > 0.9:
        up = (0, 0, 1)
    first = unit(np.asarray(up, float) - axis * np.dot(up, axis))
    across = np.cross(axis, first)
    out, along = (thick, thick) if np.isscalar(thick) else thick
    rings = []
    for angle in np.linspace(0.0, 2.0 * np.pi, around + 1):
        direction = first * np.cos(angle) + across * np.sin(angle) * squash
        section = round_section(sides)
        rings.append(
            np.asarray(at, float)
            + direction * radius
            + section[:, :1] * out * unit(direction)
            + section[:, 1:] * along * axis
        )
    return Patch(np.array(rings), paint, ring_bones(bones, around + 1), detail)


def new_sheet() -> int:
    """A number for patches that share their place in the skin."""
    return next(_sheets)


def mirrored(patch: Patch) -> Patch:
    """The same on the other side (y -> -y), painted by the same part of the skin; bones `_l` become `_r`."""
    if patch.sheet < 0:
        patch.sheet = new_sheet()
    other = [{_swap(name): share for name, share in ring.items()} for ring in patch.bones]
    return dataclasses.replace(patch, grid=patch.grid * [1, -1, 1], bones=other)


def _swap(bone: str) -> str:
    return bone[:-2] + {"_l": "_r", "_r": "_l"}[bone[-2:]] if bone[-2:] in ("_l", "_r") else bone


def disc(patch: Patch) -> Patch:
    """The patch with flat ends that show what is painted on them."""
    return dataclasses.replace(patch, fan=True)


def both(*patches: Patch) -> list[Patch]:
    """Each of the left side's patches and its mirror image."""
    return [p for patch in patches for p in (patch, mirrored(patch))]


def moved(patch: Patch, by: Vec = (0, 0, 0), turn: np.ndarray | None = None, scale: float | Vec = 1.0) -> Patch:
    """The patch scaled, turned (3, 3) and moved; its painter sees the new place."""
    grid = patch.grid * scale
    if turn is not None:
        grid = grid @ np.asarray(turn).T
    return dataclasses.replace(patch, grid=grid + np.asarray(by, float))
