"""Convex brushes as closed polyhedra, and how their faces are textured.

A `Brush` keeps its faces as polygons (vertices counter-clockwise seen from outside), so that every primitive knows its
own corners and nothing has to be found by intersecting planes. Units are Quake's; +x is east, +y north, +z up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from .textures import size_of

Vec = tuple[float, float, float]

SIDES = {
    "top": (0, 0, 1), "bottom": (0, 0, -1), "north": (0, 1, 0), "south": (0, -1, 0), "east": (1, 0, 0),
    "west": (-1, 0, 0),
}


def add(a: Vec, b: Vec) -> Vec:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Vec, b: Vec) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a: Vec) -> Vec:
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length)


@dataclass(frozen=True)
class Tex:
    """A texture on a face.

    scale: units a texel (a number, or one each for s and t); shift: texels; turn: quarter turns of the picture.
    align: "world" (seamless over brushes in one plane), "face" (along the face, for slopes and round things) or "fit"
    (`repeat` whole pictures over the face).
    """

    name: str
    scale: float | tuple[float, float] = 1.0
    shift: tuple[float, float] = (0.0, 0.0)
    turn: int = 0
    align: str = "world"
    repeat: tuple[float, float] = (1.0, 1.0)

    @property
    def scales(self) -> tuple[float, float]:
        return self.scale if isinstance(self.scale, tuple) else (self.scale, self.scale)


def fit(name: str, repeat: tuple[float, float] = (1.0, 1.0), turn: int = 0) -> Tex:
    """Whole pictures over the face, so many across and down."""
    return Tex(name, align="fit", repeat=repeat, turn=turn)


def tex_of(tex, normal: Vec) -> Tex:
    """The texture for a face of that normal. A dict is by side: top bottom north south east west, `side` (any that is
    no top or bottom) and `all`."""
    if isinstance(tex, dict):
        side = max(SIDES, key=lambda name: dot(SIDES[name], normal))
        steep = side not in ("top", "bottom")
        keys = [side] + (["side"] if steep else []) + ["all"]
        found = next((tex[key] for key in keys if key in tex), None)
        if found is None:
            raise ValueError(f"no texture for side {side} in {sorted(tex)}")
        tex = found
    return tex if isinstance(tex, Tex) else Tex(tex)


@dataclass
class Axes:
    """Texture coordinates in texels: s = dot(p, u) / scale[0] + offset[0], and t with v."""

    u: Vec
    v: Vec
    offset: tuple[float, float]
    scale: tuple[float, float]


@dataclass
class Face:
    points: list[Vec]
    tex: Tex
    axes: Axes | None = None  # None: aligned with the world when the map is written

    @property
    def normal(self) -> Vec:
        """Newell's: also right where three neighbours lie on one line."""
        n = (0.0, 0.0, 0.0)
        for k in range(1, len(self.points) - 1):
            n = add(n, cross(sub(self.points[k], self.points[0]), sub(self.points[k + 1], self.points[0])))
        return unit(n)


def upright_axes(normal: Vec, along_face: bool) -> tuple[Vec, Vec]:
    """Right and down as somebody sees them who looks at the face; on floors east and south."""
    x, y, z = (abs(c) for c in normal)
    if not along_face:
        if z >= x and z >= y:
            return (1.0, 0.0, 0.0), (0.0, -1.0, 0.0) if normal[2] > 0 else (0.0, 1.0, 0.0)
        if x >= y:
            return (0.0, math.copysign(1.0, normal[0]), 0.0), (0.0, 0.0, -1.0)
        return (-math.copysign(1.0, normal[1]), 0.0, 0.0), (0.0, 0.0, -1.0)
    if z > 0.999:
        return (1.0, 0.0, 0.0), (0.0, math.copysign(1.0, -normal[2]), 0.0)
    u = unit((-normal[1], normal[0], 0.0))
    return u, cross(u, normal)


def resolve_axes(face: Face) -> Axes:
    """Axes of a face by its texture's alignment."""
    tex = face.tex
    normal = face.normal
    u, v = upright_axes(normal, tex.align != "world")
    for _ in range(tex.turn % 4):
        u, v = v, (-u[0], -u[1], -u[2])
    scale = tex.scales
    offset = tex.shift
    s = [dot(p, u) for p in face.points]
    t = [dot(p, v) for p in face.points]
    if tex.align == "fit":
        width, height = size_of(tex.name)
        scale = ((max(s) - min(s)) / (width * tex.repeat[0]), (max(t) - min(t)) / (height * tex.repeat[1]))
        offset = (-min(s) / scale[0], -min(t) / scale[1])
    elif tex.align == "face":
        offset = (tex.shift[0] - min(s) / scale[0], tex.shift[1] - min(t) / scale[1])
    return Axes(u, v, offset, scale)


@dataclass
class Brush:
    faces: list[Face] = field(default_factory=list)
    box: tuple[Vec, Vec] | None = None  # corners, where it is an axis-aligned box: those can be cut

    def points(self) -> list[Vec]:
        seen: dict[Vec, None] = {}
        for face in self.faces:
            for p in face.points:
                seen.setdefault(p)
        return list(seen)

    def bounds(self) -> tuple[Vec, Vec]:
        points = self.points()
        return tuple(min(p[k] for p in points) for k in range(3)), tuple(max(p[k] for p in points) for k in range(3))


def polyhedron(polygons: list[list[Vec]], tex) -> Brush:
    """A brush of polygons, each turned outwards, away from the mean of all corners."""
    corners = [p for polygon in polygons for p in polygon]
    middle = tuple(sum(p[k] for p in corners) / len(corners) for k in range(3))
    brush = Brush()
    for polygon in polygons:
        points = [tuple(float(c) for c in p) for p in polygon]
        face = Face(points, Tex(""))
        if dot(face.normal, sub(points[0], middle)) < 0:
            face.points = points[::-1]
        face.tex = tex_of(tex, face.normal)
        if face.tex.align != "world":
            face.axes = resolve_axes(face)
        brush.faces.append(face)
    return brush


def box(lo: Vec, hi: Vec, tex) -> Brush:
    """An axis-aligned box; its corners may be given in any order."""
    a = tuple(float(min(lo[k], hi[k])) for k in range(3))
    b = tuple(float(max(lo[k], hi[k])) for k in range(3))
    if any(a[k] == b[k] for k in range(3)):
        raise ValueError(f"box without volume: {lo} {hi}")
    (x0, y0, z0), (x1, y1, z1) = a, b
    brush = polyhedron([
        [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
        [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)],
        [(x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)],
        [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        [(x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)],
        [(x0, y0, z0), (x0, y1, z0), (x0, y1, z1), (x0, y0, z1)],
    ], tex)
    brush.box = (a, b)
    return brush


def subtract(brush: Brush, lo: Vec, hi: Vec) -> list[Brush]:
    """What is left of a box brush outside a box: up to six boxes, with the same textures."""
    assert brush.box is not None
    (a, b) = brush.box
    if any(hi[k] <= a[k] or lo[k] >= b[k] or lo[k] >= hi[k] for k in range(3)):
        return [brush]
    sides = {name: next(f.tex for f in brush.faces if dot(f.normal, n) > 0.9) for name, n in SIDES.items()}
    pieces = []
    low, high = list(a), list(b)
    # Walls are cut by slabs from floor to ceiling first, so that the pieces are few and tall.
    for axis in (0, 1, 2):
        if lo[axis] > low[axis]:
            top = list(high)
            top[axis] = lo[axis]
            pieces.append(box(tuple(low), tuple(top), sides))
            low[axis] = lo[axis]
        if hi[axis] < high[axis]:
            bottom = list(low)
            bottom[axis] = hi[axis]
            pieces.append(box(tuple(bottom), tuple(high), sides))
            high[axis] = hi[axis]
    return pieces


def transformed(brush: Brush, turn: float, mirror: bool, at: Vec) -> Brush:
    """Mirrored in x (if asked), turned counter-clockwise about z by `turn` degrees, and moved."""
    c, s = _cos_sin(turn)

    def rotate(p: Vec) -> Vec:
        x = -p[0] if mirror else p[0]
        return (c * x - s * p[1], s * x + c * p[1], p[2])

    result = Brush()
    for face in brush.faces:
        points = [add(rotate(p), at) for p in face.points]
        moved = Face(points[::-1] if mirror else points, face.tex)
        if face.axes:
            u, v = rotate(face.axes.u), rotate(face.axes.v)
            offset = (face.axes.offset[0] - dot(at, u) / face.axes.scale[0],
                      face.axes.offset[1] - dot(at, v) / face.axes.scale[1])
            moved.axes = replace(face.axes, u=u, v=v, offset=offset)
        result.faces.append(moved)
    if brush.box and turn % 90 == 0:
        result.box = result.bounds()
    return result


def _cos_sin(degrees: float) -> tuple[float, float]:
    """Exact for quarter turns."""
    quarter = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}.get(degrees % 360)
    return quarter or (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
