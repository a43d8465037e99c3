"""Holds the map builder to volumes, planes and texture coordinates that are known beforehand."""

import math
import random
import sys
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1])]

from kit import Group, Map, Tex, fit  # noqa: E402
from kit import shapes  # noqa: E402
from kit.brush import box, dot, resolve_axes, sub, transformed  # noqa: E402
from kit.checks import problems_of  # noqa: E402


def volume(brushes) -> float:
    """By the divergence theorem: a third of each face's area times its distance, over triangles."""
    total = 0.0
    for brush in brushes:
        for face in brush.faces:
            a = face.points[0]
            for b, c in zip(face.points[1:], face.points[2:]):
                total += dot(a, (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])) / 6.0
    return total


def level(*groups: Group) -> Map:
    """A map that has what a level needs besides the groups."""
    world = Map("test")
    world.room((-512, -512, -512), (512, 512, 512), "stone_a")
    world.entity("info_player_start", (500, 500, 500), angle=0)
    for group in groups:
        world.add(group)
    return world


class Shapes(unittest.TestCase):
    def test_volumes(self):
        self.assertAlmostEqual(volume([box((0, 0, 0), (2, 3, 4), "stone_a")]), 24)
        self.assertAlmostEqual(volume([shapes.wedge((0, 0, 0), (8, 4, 2), "stone_a", "-y")]), 32)
        self.assertAlmostEqual(volume([shapes.frustum((0, 0, 0), (6, 6, 9), (3, 3), (3, 3), "stone_a")]), 108)
        self.assertAlmostEqual(volume(shapes.shell((0, 0, 0), (64, 64, 64), "stone_a", 16)), 96**3 - 64**3)
        self.assertAlmostEqual(volume(shapes.stairs((0, 0, 0), (32, 10, 32), "stone_a")), 32 * 10 * 32 * 5 / 8)
        for axis in "xyz":
            self.assertAlmostEqual(volume([shapes.cylinder((8, 9), 100, 0, 10, "stone_a", sides=32, axis=axis)]) / 10,
                                   16 * 100**2 * math.sin(2 * math.pi / 32), delta=40)

    def test_an_arch_and_its_opening_fill_the_box(self):
        arch = shapes.arch((0, 0, 0), (100, 10, 50), "stone_a", segments=40)
        self.assertAlmostEqual(volume(arch) / 10, 100 * 50 - math.pi * 50 * 50 / 2, delta=20)

    def test_cuts_leave_the_rest(self):
        chance = random.Random(5)
        for _ in range(200):
            corners = [tuple(chance.randint(0, 8) for _ in range(3)) for _ in range(2)]
            lo, hi = (tuple(f(c[k] for c in corners) for k in range(3)) for f in (min, max))
            group = Group().box((2, 2, 2), (6, 6, 6), "stone_a").cut(lo, hi)
            inside = math.prod(max(0, min(6, hi[k]) - max(2, lo[k])) for k in range(3))
            self.assertAlmostEqual(volume(group.brushes), 64 - inside)

    def test_all_shapes_pass_the_checks_turned_and_mirrored(self):
        group = Group()
        group.cylinder((0, 0), 30, 0, 40, "stone_a", sides=16).cylinder((0, 0), 30, 40, 80, "stone_a", top_radius=10)
        group.cylinder((0, 0), 10, 80, 90, "stone_a", top_radius=0)
        group.arch((-64, 60, 0), (64, 80, 64), "stone_b", segments=9, pointed=True)
        group.ring((100, 0), 20, 32, 0, 64, "stone_b", degrees=(0, 90), sides=5)
        group.wedge((-100, 0, 0), (-80, 20, 20), "stone_a").stairs((-200, 0, 0), (-120, 30, 64), "stone_a", "-x")
        for turn in (0, 90, 180, 30):
            for mirror in (False, True):
                self.assertEqual(level(Group().add(group, (10, 20, 30), turn, mirror)).check(), [])
        self.assertAlmostEqual(volume(Group().add(group, turn=33, mirror=True).brushes), volume(group.brushes), places=3)


class Textures(unittest.TestCase):
    def test_turned_prefabs_keep_fitted_pictures(self):
        panel = box((0, 0, 0), (32, 4, 96), fit("window_a"))
        moved = transformed(panel, 90, False, (100, 200, 300))
        for before, after in zip(panel.faces, moved.faces):
            for p, q in zip(before.points, after.points):
                for axis in range(2):
                    old, new = (dot(x, (f.axes.u, f.axes.v)[axis]) / f.axes.scale[axis] + f.axes.offset[axis]
                                for x, f in ((p, before), (q, after)))
                    self.assertAlmostEqual(old, new)

    def test_a_fitted_picture_spans_the_face(self):
        face = next(f for f in box((0, 0, 0), (32, 4, 96), fit("window_a")).faces if f.normal == (0.0, -1.0, 0.0))
        axes = resolve_axes(face)
        s = [dot(p, axes.u) / axes.scale[0] + axes.offset[0] for p in face.points]
        t = [dot(p, axes.v) / axes.scale[1] + axes.offset[1] for p in face.points]
        self.assertEqual((min(s), max(s), min(t), max(t)), (0, 64, 0, 128))

    def test_walls_read_from_left_to_right(self):
        for face in box((0, 0, 0), (64, 64, 64), "stone_a").faces:
            axes = resolve_axes(face)
            right_handed = dot(face.normal, (axes.u[1] * axes.v[2] - axes.u[2] * axes.v[1],
                                             axes.u[2] * axes.v[0] - axes.u[0] * axes.v[2],
                                             axes.u[0] * axes.v[1] - axes.u[1] * axes.v[0]))
            self.assertEqual(right_handed, -1.0, face.normal)  # t goes down

    def test_a_column_s_picture_runs_on_round_it(self):
        column = shapes.cylinder((0, 0), 64, 0, 64, Tex("stone_a", scale=0.5), sides=8)
        sides = column.faces[2:]
        for face, following in zip(sides, sides[1:]):
            shared = [p for p in face.points if p in following.points]
            for p in shared:
                a, b = (dot(p, f.axes.u) / f.axes.scale[0] + f.axes.offset[0] for f in (face, following))
                self.assertAlmostEqual(a, b)


class Maps(unittest.TestCase):
    def test_the_text_is_the_same_and_its_planes_look_outwards(self):
        self.assertEqual(level().text(), level().text())
        lines = [line for line in level().text().splitlines() if line.startswith("(")]
        self.assertEqual(len(lines), 36)
        numbers = [float(n) for n in lines[0].replace("(", " ").replace(")", " ").split()[:9]]
        a, b, c = (tuple(numbers[k:k + 3]) for k in (0, 3, 6))
        e, f = sub(a, b), sub(c, b)
        self.assertGreater(e[0] * f[1] - e[1] * f[0], 0)  # the first face of a box is its top

    def test_what_is_wrong_is_said(self):
        world = level()
        world.box((0, 0, 0), (64, 64, 64), "no_such_picture")
        world.box((0, 0, 0.1), (64, 64, 64), "stone_a")
        world.box((0, 0, 0), (5000, 64, 64), "stone_a")
        world.entity("item_health", (32, 32, 32))
        world.entity("trigger_relay", (300, 300, 300), target="nobody")
        said = "\n".join(problems_of(world, 4096))
        for words in ("no texture 'no_such_picture'", "off the grid", "beyond 4096", "is inside a brush", "names nothing"):
            self.assertIn(words, said)

    def test_prefabs_turn_their_entities(self):
        prefab = Group()
        prefab.entity("monster_army", (64, 0, 24), angle=0)
        prefab.entity("light", (0, 0, 64), mangle=(90, -45, 0))
        prefab.part("func_door", angle=-1).box((0, 0, 0), (8, 8, 8), "steel_door")
        turned = Group().add(prefab, (0, 0, 8), 90)
        self.assertEqual(turned.entities[0], {"classname": "monster_army", "origin": (0, 64, 32), "angle": 90})
        self.assertEqual(turned.entities[1]["mangle"], (180, -45, 0))
        self.assertEqual(turned.parts[0].keys["angle"], -1)


if __name__ == "__main__":
    unittest.main()
