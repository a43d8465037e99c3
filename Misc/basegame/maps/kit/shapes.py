"""Round, sloped and repeated shapes as lists of convex brushes."""

from __future__ import annotations

import math

from .brush import Axes, Brush, Vec, box, dot, polyhedron, sub, unit

AXES = {"x": 0, "y": 1, "z": 2}


def _on_axis(axis: str, a: float, b: float, along: float) -> Vec:
    """A point of a profile: across the axis a and b (for x: y z, for y: x z, for z: x y)."""
    return {"x": (along, a, b), "y": (a, along, b), "z": (a, b, along)}[axis]


def prism(profile: list[tuple[float, float]], start: float, end: float, tex, axis: str = "z",
          wrap: bool = False) -> Brush:
    """A convex profile drawn out along an axis. wrap: the picture runs round the sides instead of face by face."""
    near = [_on_axis(axis, a, b, start) for a, b in profile]
    far = [_on_axis(axis, a, b, end) for a, b in profile]
    n = len(profile)
    sides = [[near[k], near[(k + 1) % n], far[(k + 1) % n], far[k]] for k in range(n)]
    brush = polyhedron([near, far] + sides, tex)
    if wrap:
        _run_round(brush.faces[2:], near, axis)
    return brush


def _run_round(faces, rim: list[Vec], axis: str) -> None:
    """Texture coordinates that go on from face to face round the axis."""
    along = _on_axis(axis, 0.0, 0.0, 1.0)
    run = 0.0
    for k, face in enumerate(faces):
        edge = sub(rim[(k + 1) % len(rim)], rim[k])
        round_it, scale, shift = unit(edge), face.tex.scales, face.tex.shift
        which = 0 if axis == "z" else 1
        start = run + shift[which] - dot(rim[k], round_it) / scale[which]
        if axis == "z":
            face.axes = Axes(round_it, (0.0, 0.0, -1.0), (start, shift[1]), scale)
        else:
            face.axes = Axes(along, round_it, (shift[0], start), scale)
        run += math.sqrt(dot(edge, edge)) / scale[which]


def wedge(lo: Vec, hi: Vec, tex, rise: str = "+x") -> Brush:
    """A ramp that fills the box's lower half and rises towards +x, -x, +y or -y."""
    across = rise[1]
    a0, a1 = (lo[0], hi[0]) if across == "x" else (lo[1], hi[1])
    peak = a1 if rise[0] == "+" else a0
    axis, start, end = ("y", lo[1], hi[1]) if across == "x" else ("x", lo[0], hi[0])
    return prism([(a0, lo[2]), (a1, lo[2]), (peak, hi[2])], start, end, tex, axis)


def frustum(lo: Vec, hi: Vec, top_lo: tuple[float, float], top_hi: tuple[float, float], tex) -> Brush:
    """A block whose top is another rectangle than its base; a pyramid where the top is one point."""
    base = [(lo[0], lo[1], lo[2]), (hi[0], lo[1], lo[2]), (hi[0], hi[1], lo[2]), (lo[0], hi[1], lo[2])]
    z = hi[2]
    if tuple(top_lo) == tuple(top_hi):
        apex = (top_lo[0], top_lo[1], z)
        return polyhedron([base] + [[base[k], base[(k + 1) % 4], apex] for k in range(4)], tex)
    top = [(top_lo[0], top_lo[1], z), (top_hi[0], top_lo[1], z), (top_hi[0], top_hi[1], z), (top_lo[0], top_hi[1], z)]
    return polyhedron([base, top] + [[base[k], base[(k + 1) % 4], top[(k + 1) % 4], top[k]] for k in range(4)], tex)


def circle(center: tuple[float, float], radius: float | tuple[float, float], sides: int, grid: float = 0.25,
           first: float | None = None) -> list[tuple[float, float]]:
    """Corners on a circle or ellipse, rounded to the grid; by default with a flat side towards each axis."""
    rx, ry = radius if isinstance(radius, tuple) else (radius, radius)
    first = 180.0 / sides if first is None else first
    result = []
    for k in range(sides):
        angle = math.radians(first + 360.0 * k / sides)
        result.append((round((center[0] + rx * math.cos(angle)) / grid) * grid,
                       round((center[1] + ry * math.sin(angle)) / grid) * grid))
    return result


def cylinder(center: tuple[float, float], radius: float, start: float, end: float, tex, sides: int = 12,
             axis: str = "z", top_radius: float | None = None, grid: float = 0.25) -> Brush:
    """A column along an axis; with top_radius a cone's stump (of 0: a cone). The picture runs round it."""
    low = circle(center, radius, sides, grid)
    if top_radius is None:
        return prism(low, start, end, tex, axis, wrap=True)
    if top_radius == 0:
        apex = _on_axis(axis, center[0], center[1], end)
        base = [_on_axis(axis, a, b, start) for a, b in low]
        return polyhedron([base] + [[base[k], base[(k + 1) % sides], apex] for k in range(sides)], tex)
    # A stump's sides are planar only if unrounded.
    exact = [circle(center, r, sides, 2.0 ** -10) for r in (radius, top_radius)]
    near = [_on_axis(axis, a, b, start) for a, b in exact[0]]
    far = [_on_axis(axis, a, b, end) for a, b in exact[1]]
    return polyhedron([near, far] + [[near[k], near[(k + 1) % sides], far[(k + 1) % sides], far[k]]
                                     for k in range(sides)], tex)


def ring(center: tuple[float, float], inner: float, outer: float, start: float, end: float, tex, sides: int = 12,
         axis: str = "z", degrees: tuple[float, float] = (0.0, 360.0), grid: float = 0.25) -> list[Brush]:
    """A hollow pipe, or a part of one: one brush a side."""
    first, last = degrees
    whole = abs(last - first) >= 360.0

    def corner(radius: float, k: int) -> tuple[float, float]:
        angle = math.radians(first + (last - first) * (k % sides if whole else k) / sides)
        return (round((center[0] + radius * math.cos(angle)) / grid) * grid,
                round((center[1] + radius * math.sin(angle)) / grid) * grid)

    return [prism([corner(inner, k), corner(outer, k), corner(outer, k + 1), corner(inner, k + 1)], start, end, tex, axis)
            for k in range(sides)]


def arch(lo: Vec, hi: Vec, tex, axis: str = "y", segments: int = 8, pointed: bool = False,
         grid: float = 0.25) -> list[Brush]:
    """Fills the top of an opening with an arch: what is between the curve and the box's top. The box is the part of the
    opening from the springing line up; `axis` is the way through. Round (an ellipse), or pointed as in a cloister."""
    a0, a1 = (lo[1], hi[1]) if axis == "x" else (lo[0], hi[0])
    start, end = (lo[0], hi[0]) if axis == "x" else (lo[1], hi[1])
    half, height = (a1 - a0) / 2.0, hi[2] - lo[2]
    curve = []
    for k in range(segments + 1):
        if pointed:
            # Each half is an arc about a point 0.5 half-widths beyond the middle, which gives a calm lancet.
            part = abs(2.0 * k / segments - 1.0)
            x = part
            y = math.sqrt(max(0.0, 1.5 ** 2 - (x + 0.5) ** 2)) / math.sqrt(1.5 ** 2 - 0.25)
            a = a0 + half + math.copysign(part * half, k - segments / 2.0)
        else:
            angle = math.pi * (1.0 - k / segments)
            a, y = a0 + half + half * math.cos(angle), math.sin(angle)
        curve.append((round(a / grid) * grid, min(round((lo[2] + height * y) / grid) * grid, hi[2])))
    result = []
    for (xa, za), (xb, zb) in zip(curve, curve[1:]):
        corners = [(xa, za), (xb, zb)] + ([(xb, hi[2])] if zb < hi[2] else []) + ([(xa, hi[2])] if za < hi[2] else [])
        if len(corners) >= 3:
            result.append(prism(corners, start, end, tex, axis))
    return result


def stairs(lo: Vec, hi: Vec, tex, rise: str = "+x", steps: int | None = None, solid: bool = True) -> list[Brush]:
    """Steps that fill a box and rise towards +x, -x, +y or -y; 8 units high unless their number is given. Not solid: each
    step is as thick as it is high."""
    axis = AXES[rise[1]]
    steps = steps or max(1, round((hi[2] - lo[2]) / 8.0))
    run, height = (hi[axis] - lo[axis]) / steps, (hi[2] - lo[2]) / steps
    result = []
    for k in range(steps):
        a, b = list(lo), list(hi)
        place = k if rise[0] == "+" else steps - 1 - k
        a[axis], b[axis] = lo[axis] + place * run, lo[axis] + (place + 1) * run
        b[2] = lo[2] + (k + 1) * height
        if not solid:
            a[2] = lo[2] + k * height
        result.append(box(tuple(a), tuple(b), tex))
    return result


def shell(lo: Vec, hi: Vec, tex, wall: float = 16.0) -> list[Brush]:
    """Six slabs round an empty box. The dict's sides are those of the room: `top` is the ceiling, `north` the wall that
    one sees looking north."""
    (x0, y0, z0), (x1, y1, z1), w = lo, hi, wall

    def side(name: str):
        if not isinstance(tex, dict):
            return tex
        keys = [name] + (["side"] if name not in ("top", "bottom") else []) + ["all"]
        found = next((tex[key] for key in keys if key in tex), None)
        if found is None:
            raise ValueError(f"no texture for the room's {name}")
        return found

    return [
        box((x0 - w, y0 - w, z1), (x1 + w, y1 + w, z1 + w), side("top")),
        box((x0 - w, y0 - w, z0 - w), (x1 + w, y1 + w, z0), side("bottom")),
        box((x0 - w, y1, z0), (x1 + w, y1 + w, z1), side("north")),
        box((x0 - w, y0 - w, z0), (x1 + w, y0, z1), side("south")),
        box((x1, y0, z0), (x1 + w, y1, z1), side("east")),
        box((x0 - w, y0, z0), (x0, y1, z1), side("west")),
    ]
