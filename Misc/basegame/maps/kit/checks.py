"""What must hold of a map before it is worth compiling."""

from __future__ import annotations

from .brush import Brush, dot, sub
from .textures import sizes

FLAT = 0.1  # units that a corner may be off its face's plane or outside another's
GRID = 0.25  # units: boxes keep to it
TOOLS = {"skip", "clip", "trigger", "origin", "hint", "hintskip"}


def problems_of(world, limit: float) -> list[str]:
    """Sentences, none where all is well."""
    problems = []
    groups = [("world", world)] + [(f"{p.classname} {p.keys.get('targetname', '')}".strip(), p) for p in world.parts]
    for name, group in groups:
        if not group.brushes:
            problems.append(f"{name} has no brushes")
        for brush in group.brushes:
            problems.extend(f"{name}: brush {_place(brush)}: {p}" for p in _brush_problems(brush, limit))
    problems.extend(_entity_problems(world, limit))
    return problems


def _place(brush: Brush) -> str:
    lo, hi = brush.bounds()
    return f"{tuple(round(c, 2) for c in lo)} .. {tuple(round(c, 2) for c in hi)}"


def _brush_problems(brush: Brush, limit: float) -> list[str]:
    problems = []
    points = brush.points()
    if len(brush.faces) < 4:
        problems.append("fewer than four faces")
    if brush.box and any(c / GRID != round(c / GRID) for p in brush.box for c in p):
        problems.append(f"off the grid of {GRID:g} units")
    if any(abs(c) > limit for p in points for c in p):
        problems.append(f"beyond {limit:g} units")
    for face in brush.faces:
        if face.tex.name not in sizes():
            problems.append(f"there is no texture '{face.tex.name}'")
        normal = face.normal
        if any(abs(dot(normal, sub(p, face.points[0]))) > FLAT for p in face.points):
            problems.append(f"a face with {face.tex.name} is not flat")
        if any(dot(normal, sub(p, face.points[0])) > FLAT for p in points):
            problems.append(f"not convex at a face with {face.tex.name}")
    return problems


def _entity_problems(world, limit: float) -> list[str]:
    problems = []
    every = world.entities + [p.keys | {"classname": p.classname} for p in world.parts]
    names = {e["targetname"] for e in every if "targetname" in e}
    aims = {e[key] for e in every for key in ("target", "killtarget") if key in e}
    for entity in every:
        where = f"{entity['classname']} at {entity.get('origin', '(brushes)')}"
        for key in ("target", "killtarget"):
            if key in entity and entity[key] not in names:
                problems.append(f"{where}: {key} '{entity[key]}' names nothing")
        if "origin" in entity and any(abs(c) > limit for c in entity["origin"]):
            problems.append(f"{where}: beyond {limit:g} units")
    for entity in world.entities:
        if entity["classname"] in ("info_player_start",) and "origin" not in entity:
            problems.append("info_player_start without origin")
    problems.extend(f"nothing uses '{name}'" for name in sorted(names - aims) if not name.startswith("spare_"))
    solids = [b.box for b in world.brushes if b.box]
    for entity in world.entities:
        if "origin" in entity and any(all(a[k] < entity["origin"][k] < b[k] for k in range(3)) for a, b in solids):
            if not _in_liquid(world, entity["origin"]):
                problems.append(f"{entity['classname']} at {entity['origin']} is inside a brush")
    is_box = not world.entities and not world.parts  # an item, not a level
    if not any(e["classname"] == "info_player_start" for e in world.entities) and not is_box:
        problems.append("no info_player_start")
    return problems


def _in_liquid(world, origin) -> bool:
    """Whether all boxes round the point are liquids or what nobody sees."""
    for brush in world.brushes:
        if brush.box and all(brush.box[0][k] < origin[k] < brush.box[1][k] for k in range(3)):
            name = brush.faces[0].tex.name
            if not name.startswith("*") and name not in TOOLS:
                return False
    return True
