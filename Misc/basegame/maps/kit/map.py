"""Groups of brushes and entities, maps made of them, and the .map text (Valve 220).

Everything is built into a `Group`; a `Map` is the group that has a worldspawn. Groups are prefabs: `add` puts a copy of one
into another, turned, mirrored and moved. The text depends on nothing but the calls: the same script, the same bytes.
"""

from __future__ import annotations

from pathlib import Path

from . import shapes
from .brush import Brush, Tex, Vec, _cos_sin, add, box, resolve_axes, subtract, transformed
from .checks import problems_of

WAD = "basegame.wad"


def text_of(value) -> str:
    """A number or vector as short as it can be; other values as they are."""
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, (int, float)):
        rounded = round(float(value), 6) + 0.0  # no negative zero
        return str(int(rounded)) if rounded == int(rounded) else f"{rounded:.6f}".rstrip("0")
    if isinstance(value, (tuple, list)):
        return " ".join(text_of(v) for v in value)
    return str(value)


class Group:
    """Brushes, entities and brush entities. All box-like calls take `tex`: a name, a Tex, or a dict by side."""

    def __init__(self, classname: str = "", keys: dict | None = None):
        self.classname, self.keys = classname, dict(keys or {})
        self.brushes: list[Brush] = []
        self.entities: list[dict] = []
        self.parts: list[Group] = []  # brush entities

    # Brushes.

    def brush(self, *brushes: Brush) -> "Group":
        self.brushes.extend(brushes)
        return self

    def box(self, lo: Vec, hi: Vec, tex) -> "Group":
        return self.brush(box(lo, hi, tex))

    def wedge(self, lo: Vec, hi: Vec, tex, rise: str = "+x") -> "Group":
        return self.brush(shapes.wedge(lo, hi, tex, rise))

    def frustum(self, lo: Vec, hi: Vec, top_lo, top_hi, tex) -> "Group":
        return self.brush(shapes.frustum(lo, hi, top_lo, top_hi, tex))

    def prism(self, profile, start: float, end: float, tex, axis: str = "z", wrap: bool = False) -> "Group":
        return self.brush(shapes.prism(profile, start, end, tex, axis, wrap))

    def cylinder(self, center, radius: float, start: float, end: float, tex, **options) -> "Group":
        return self.brush(shapes.cylinder(center, radius, start, end, tex, **options))

    def ring(self, center, inner: float, outer: float, start: float, end: float, tex, **options) -> "Group":
        return self.brush(*shapes.ring(center, inner, outer, start, end, tex, **options))

    def arch(self, lo: Vec, hi: Vec, tex, **options) -> "Group":
        return self.brush(*shapes.arch(lo, hi, tex, **options))

    def stairs(self, lo: Vec, hi: Vec, tex, rise: str = "+x", **options) -> "Group":
        return self.brush(*shapes.stairs(lo, hi, tex, rise, **options))

    def room(self, lo: Vec, hi: Vec, tex, wall: float = 16.0) -> "Group":
        """Six slabs round the empty box lo..hi; open doors into them with cut()."""
        return self.brush(*shapes.shell(lo, hi, tex, wall))

    def cut(self, lo: Vec, hi: Vec) -> "Group":
        """Removes a box from all boxes that the group holds so far (not from other shapes, nor from its parts)."""
        kept: list[Brush] = []
        for brush in self.brushes:
            kept.extend(subtract(brush, lo, hi) if brush.box else [brush])
        self.brushes = kept
        return self

    # Entities.

    def entity(self, classname: str, origin: Vec | None = None, **keys) -> dict:
        """A point entity. Keys whose names Python keeps for itself take a trailing underscore (`_class_`: use a dict)."""
        entity = {"classname": classname} | ({"origin": tuple(origin)} if origin is not None else {}) | keys
        self.entities.append(entity)
        return entity

    def part(self, classname: str, **keys) -> "Group":
        """A brush entity, to be filled with brushes."""
        part = Group(classname, keys)
        self.parts.append(part)
        return part

    @property
    def detail(self) -> "Group":
        """Brushes that do not divide space for visibility: all that is not wall, floor or ceiling. They seal nothing."""
        for part in self.parts:
            if part.classname == "func_detail":
                return part
        return self.part("func_detail")

    # Prefabs.

    def add(self, other: "Group", at: Vec = (0, 0, 0), turn: float = 0.0, mirror: bool = False) -> "Group":
        """A copy of the other group: mirrored in x, turned counter-clockwise about z by degrees, then moved."""
        self.brushes.extend(transformed(b, turn, mirror, at) for b in other.brushes)
        self.entities.extend(_moved_entity(e, at, turn, mirror) for e in other.entities)
        for part in other.parts:
            keys = _moved_entity(part.keys, at, turn, mirror)
            into = self.detail if part.classname == "func_detail" else self.part(part.classname, **keys)
            into.brushes.extend(transformed(b, turn, mirror, at) for b in part.brushes)
        return self


def _moved_entity(entity: dict, at: Vec, turn: float, mirror: bool) -> dict:
    result = dict(entity)
    if "origin" in result:
        x, y, z = result["origin"]
        c, s = _cos_sin(turn)
        x = -x if mirror else x
        result["origin"] = add((c * x - s * y, s * x + c * y, z), at)
    for key in ("angle", "mangle", "angles"):
        if key not in result:
            continue
        value = result[key]
        if key == "angle":
            if value >= 0:  # -1 and -2 are up and down
                result[key] = ((180 - value if mirror else value) + turn) % 360
        else:
            # A light's mangle is yaw pitch roll, all others pitch yaw roll.
            place = 0 if entity.get("classname", "").startswith("light") else 1
            angles = list(value)
            angles[place] = ((180 - angles[place] if mirror else angles[place]) + turn) % 360
            result[key] = tuple(angles)
    return result


class Map(Group):
    """The world. Keys are the worldspawn's: message, sounds, fog, _wateralpha, _sunlight ..."""

    def __init__(self, message: str, limit: float = 4096.0, **keys):
        super().__init__("worldspawn", {"message": message, "wad": WAD, "mapversion": 220} | keys)
        self.limit = limit

    def check(self) -> list[str]:
        return problems_of(self, self.limit)

    def text(self) -> str:
        lines = [f"// {self.keys['message']}. Written by the script of this name; change that one."]
        _write_entity(lines, self.classname, self.keys, self.brushes)
        for part in self.parts:
            _write_entity(lines, part.classname, part.keys, part.brushes)
        for entity in self.entities:
            keys = dict(entity)
            _write_entity(lines, keys.pop("classname"), keys, [])
        return "\n".join(lines) + "\n"

    def write(self, path: str | Path) -> None:
        """Writes the .map after its checks; raises ValueError with all that is wrong."""
        problems = self.check()
        if problems:
            raise ValueError(f"{path}:\n  " + "\n  ".join(problems))
        path = Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.text(), encoding="ascii")


def _write_entity(lines: list[str], classname: str, keys: dict, brushes: list[Brush]) -> None:
    lines.append("{")
    lines.append(f'"classname" "{classname}"')
    for key, value in keys.items():
        lines.append(f'"{key}" "{text_of(value)}"')
    for brush in brushes:
        lines.append("{")
        lines.extend(_face_line(face) for face in brush.faces)
        lines.append("}")
    lines.append("}")


def _face_line(face) -> str:
    axes = face.axes or resolve_axes(face)
    a, b, c = _three_points(face.points)
    # Quake's planes look outwards where the three points run clockwise.
    corners = " ".join(f"( {text_of(p)} )" for p in (c, b, a))
    u, v = (f"[ {text_of(axis)} {text_of(shift)} ]" for axis, shift in zip((axes.u, axes.v), axes.offset))
    return f"{corners} {face.tex.name} {u} {v} 0 {text_of(axes.scale)}"


def _three_points(points: list[Vec]) -> tuple[Vec, Vec, Vec]:
    """Three corners far from lying on one line: those with the largest triangle."""
    best, chosen = -1.0, (points[0], points[1], points[2])
    n = len(points)
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(j + 1, n):
                a, b, c = points[i], points[j], points[k]
                e, f = tuple(b[m] - a[m] for m in range(3)), tuple(c[m] - a[m] for m in range(3))
                area = sum(q * q for q in (e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]))
                if area > best + 1e-6:
                    best, chosen = area, (a, b, c)
    return chosen


def side_textures(wall: str | Tex, floor: str | Tex, ceiling: str | Tex) -> dict:
    """For room(): walls, floor and ceiling."""
    return {"side": wall, "bottom": floor, "top": ceiling}
