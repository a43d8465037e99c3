"""Rings inside a block of glass, lit by one small lamp: every path between ring and lamp has to cross the glass twice, and is bent
there (lab_torus/glass_teal.mat). Engines that know no such texts, and r_glass 0, let a share of the light straight through."""

from kit import Group, Map, fit
from scene_parts import furnish, lathe, stand, torus


def upright(group: Group) -> Group:
    """Turned about x by 90 degrees."""
    from kit.brush import polyhedron

    result = Group()
    for part in group.parts:
        for brush in part.brushes:
            result.detail.brush(polyhedron([[(x, -z, y) for x, y, z in face.points] for face in brush.faces],
                                           brush.faces[0].tex))
    return result


def build() -> Map:
    world = Map("The ring in the glass")
    world.room((-288, -256, 0), (288, 256, 256), {"side": "brick_red", "bottom": "lab_white", "top": "stone_b"})
    world.detail.frustum((-84, -84, 0), (84, 84, 40), (-68, -68), (68, 68), "marble_black")
    rings = Group()
    # Two rings, one through the other, and a chrome ring before the block that throws light on the floor.
    rings.add(torus(34, 10, "lab_yellow", 20, 8), (-16, 0, 89))
    rings.add(upright(torus(34, 10, "lab_red", 20, 8)), (16, 0, 89))
    rings.add(torus(46, 8, "lab_chrome", 28, 8), (-66, -138, 9))
    furnish(world, rings)
    glass = world.part("func_wall", alpha=0.2)
    glass.box((-64, -52, 41), (64, 52, 137), fit("glass_teal", (4, 3)))
    for x, y in ((-264, -232), (232, -232), (-264, 200), (232, 200)):
        world.detail.box((x, y, 0), (x + 32, y + 32, 256), "stone_a")
    world.detail.box((-288, -256, 0), (288, -250, 12), "stone_trim")
    world.detail.box((-288, 250, 0), (288, 256, 12), "stone_trim")
    lamp = Group()
    # The lamp, on a gallows.
    world.detail.box((-172, 120, 0), (-164, 128, 236), "metal_trim")
    world.detail.box((-172, 60, 228), (-164, 128, 236), "metal_trim")
    lamp.add(lathe([(0, 14), (8, 14), (14, 5)], "copper_plate", 10), (-168, 64, 218))
    lamp.add(lathe([(0, 0), (5, 12), (14, 12)], "lab_light_warm", 10), (-168, 64, 206))
    furnish(world, lamp)
    stand(world, 40, -200, 0, 97)
    return world
