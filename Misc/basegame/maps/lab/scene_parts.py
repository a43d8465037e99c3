"""What several of the laboratory's scenes are made of."""

from __future__ import annotations

import math

from kit import Group, Map
from kit.brush import polyhedron


def stand(world: Map, x: float, y: float, floor: float, angle: float) -> None:
    """Where the player begins: feet on the floor, looking along angle (degrees, 90 is north)."""
    world.entity("info_player_start", (x, y, floor + 25), angle=angle)


def lathe(profile: list[tuple[float, float]], tex, sides: int = 16) -> Group:
    """A turned body about z = 0, 0: (height, radius) from below; neighbours become stumps of cones."""
    group = Group()
    for (z0, r0), (z1, r1) in zip(profile, profile[1:]):
        if z0 == z1:
            continue  # a ledge
        if r0 == r1:
            group.detail.cylinder((0, 0), r0, z0, z1, tex, sides=sides)
        elif r0 == 0:  # a cone upside down
            apex = (0.0, 0.0, float(z0))
            rim = [(r1 * math.cos(a), r1 * math.sin(a), float(z1)) for a in _angles(sides)]
            faces = [rim] + [[rim[k], rim[(k + 1) % sides], apex] for k in range(sides)]
            group.detail.brush(polyhedron(faces, tex))
        else:
            group.detail.cylinder((0, 0), r0, z0, z1, tex, sides=sides, top_radius=r1)
    return group


def _angles(sides: int) -> list[float]:
    return [2.0 * math.pi * (k + 0.5) / sides for k in range(sides)]


def torus(radius: float, tube: float, tex, sides: int = 24, facets: int = 8) -> Group:
    """A ring that lies flat about 0 0 0: one brush a side, of `facets` faces round the tube."""
    group = Group()

    def corner(k: int, m: int) -> tuple[float, float, float]:
        a, b = 2.0 * math.pi * k / sides, 2.0 * math.pi * (m + 0.5) / facets
        r = radius + tube * math.cos(b)
        return (r * math.cos(a), r * math.sin(a), tube * math.sin(b))

    for k in range(sides):
        near, far = [[corner(n, m) for m in range(facets)] for n in (k, k + 1)]
        faces = [near, far] + [[near[m], near[(m + 1) % facets], far[(m + 1) % facets], far[m]] for m in range(facets)]
        group.detail.brush(polyhedron(faces, tex))
    return group


PIECE = 40  # brushes of an entity: a compiler's time grows with their square


def furnish(world: Map, group: Group, solid: bool = True) -> None:
    """Puts a group into the world as entities of their own, whose planes do not cut the world's: that keeps it small. What
    nobody comes near need not be solid."""
    brushes = [brush for part in group.parts for brush in part.brushes]
    for first in range(0, len(brushes), PIECE):
        world.part("func_wall" if solid else "func_illusionary").brush(*brushes[first:first + PIECE])


def candle(height: float, wax: float = 2.0, flame: str = "lab_light_warm") -> Group:
    """A candle whose foot is at 0 0 0: wax of that height (units) and half-width, and a flame that glows."""
    group = Group()
    group.detail.box((-wax, -wax, 0), (wax, wax, height), "candle_wax")
    rim = [(1.5, 0.0, height + 3.0), (0.0, 1.5, height + 3.0), (-1.5, 0.0, height + 3.0), (0.0, -1.5, height + 3.0)]
    ends = (0.0, 0.0, height + 1.0), (0.0, 0.0, height + 8.0)
    group.detail.brush(polyhedron([[rim[k], rim[(k + 1) % 4], end] for end in ends for k in range(4)], flame))
    return group


def lantern(glow: str, half: float = 6.0) -> Group:
    """A lamp on a foot plate, its middle at 0 0 0: a glowing core in a cage of four posts."""
    group = Group()
    d, core = half, half - 2
    group.detail.box((-core, -core, -half), (core, core, half), glow)
    for x in (-d, d - 1):
        for y in (-d, d - 1):
            group.detail.box((x, y, -half), (x + 1, y + 1, half), "copper_trim")
    group.detail.box((-d, -d, half), (d, d, half + 2), "copper_trim")
    group.detail.box((-d, -d, -half - 2), (d, d, -half), "copper_trim")
    return group
