"""What the game expects of every model: frames, flags, skins, size; and a mesh that is whole."""

from __future__ import annotations

import collections
import functools
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from art.palette import GLOW_FIRST, PALETTE, linear_from_srgb  # noqa: E402
from formats.mdl import Frame, Mdl, read_mdl, write_mdl  # noqa: E402
from formats.mdl_normals import DIRECTIONS, icosphere, nearest_direction  # noqa: E402
from formats.png import read_png  # noqa: E402
from models import conventions  # noqa: E402
from models.catalogue import MODELS  # noqa: E402
from models.kit import paint  # noqa: E402
from models.kit.images import images, normals  # noqa: E402
from models.kit.motion import keyed  # noqa: E402
from models.kit.shapes import tube  # noqa: E402
from models.kit.skin import FINE, GLOSS, Place, Surface, paint_layers  # noqa: E402
from models.kit.turn import limb  # noqa: E402
from models.preview import sheet  # noqa: E402

MOST_VERTICES = 1024  # what Quake's own programs have room for


@functools.cache
def made(name: str) -> bytes:
    return write_mdl(MODELS[name]())


@functools.cache
def model(name: str) -> Mdl:
    return read_mdl(made(name))


class Format(unittest.TestCase):
    def test_directions_are_the_icospheres(self):
        alike = icosphere(2) @ DIRECTIONS.T
        self.assertEqual(alike.shape, (162, 162))
        self.assertEqual(sorted(alike.argmax(axis=1)), list(range(162)))
        self.assertGreater(alike.max(axis=1).min(), 1.0 - 1e-9)
        self.assertTrue((nearest_direction(DIRECTIONS) == np.arange(162)).all())

    def test_a_model_reads_back(self):
        corners = np.array([[[0, 0, 0], [10, 0, 0], [0, 20, 0], [0, 0, 30.0]]] * 2)
        normals = np.zeros((2, 4, 3)) + [0, 0, 1.0]
        skin = np.arange(32, dtype=np.uint8).reshape(4, 8)
        source = Mdl(
            corners,
            normals,
            np.array([[0, 2, 1], [0, 1, 3]]),
            np.array([[0, 0], [7, 0], [0, 3], [7, 3]]),
            [skin],
            [Frame("run1", [0]), Frame("run2", [1])],
            8,
        )
        back = read_mdl(write_mdl(source))
        np.testing.assert_allclose(back.positions, corners, atol=0.1)
        np.testing.assert_array_equal(back.triangles, source.triangles)
        np.testing.assert_array_equal(back.skins[0], skin)
        self.assertEqual([f.name for f in back.frames], ["run1", "run2"])
        self.assertEqual(back.flags, 8)

    def test_a_cut_file_is_refused(self):
        with self.assertRaises(ValueError):
            read_mdl(made("soldier")[:-1])


class Kit(unittest.TestCase):
    def test_keys_are_met_and_equal_keys_hold_still(self):
        clip = keyed(9, {0: {"a": 1.0}, 4: {"a": 5.0}, 8: {"a": 5.0}})["a"][:, 0]
        self.assertEqual((clip[0], clip[4]), (1.0, 5.0))
        np.testing.assert_allclose(clip[4:], 5.0)

    def test_a_limb_reaches_its_target(self):
        target = np.array([[3.0, 1.0, -8.0], [6.0, -2.0, -3.0]])
        upper, lower, joint, end = limb(np.zeros((2, 3)), target, np.array([[1.0, 0, 0]] * 2), 7.0, 6.0, (1, 0, 0))
        np.testing.assert_allclose(end, target, atol=1e-9)
        np.testing.assert_allclose(upper @ [0, 0, -7.0], joint, atol=1e-9)
        np.testing.assert_allclose(joint + lower @ [0, 0, -6.0], end, atol=1e-9)


def rod(painter):
    """A patch of one painter, and its place in a skin of 16 x 16."""
    return tube([(0, 0, 0), (0, 0, 4), (0, 0, 8)], [2.0, 2.0, 2.0], painter, caps=(None, None)), Place(1, 1, 14, 14)


class Images(unittest.TestCase):
    def test_texels_of_layers_lie_in_the_skins(self):
        patch, place = rod(paint.plain("grey"))
        coarse, fine = Surface(patch, place.width, place.height, 0), Surface(patch, place.width, place.height, 0, FINE)
        height, width = coarse.u.shape
        mean = fine.z.reshape(height, FINE, width, FINE).mean(axis=(1, 3))
        np.testing.assert_allclose(mean[2:-2, 2:-2], coarse.z[2:-2, 2:-2], atol=1e-6)

    def test_metal_and_gems_shine_and_cloth_does_not(self):
        gloss = {}
        for name, painter in {
            "steel": paint.steel(),
            "iron": paint.iron(0.5, 0.0),
            "brass": paint.copper(0.0),
            "gem": paint.glow("red_glow"),
            "canvas": paint.canvas(),
            "stone": paint.plain("grey"),
            "rust": paint.iron(0.5, 1.0),
        }.items():
            patch, place = rod(painter)
            gloss[name] = paint_layers([patch], [place], 16, 16, 0)[0][4:-4, 4:-4, GLOSS].mean()
        self.assertGreater(min(gloss[name] for name in ("steel", "iron", "brass", "gem")), 0.5)
        self.assertLess(max(gloss[name] for name in ("canvas", "stone")), 0.05)
        self.assertLess(gloss["rust"], gloss["iron"] - 0.1)

    def test_relief_is_as_steep_as_the_shape_says(self):
        patch, place = rod(lambda s: s.ramp("grey", 0.5, 0.0, 0.25 * s.z))
        slopes = paint_layers([patch], [place], 16, 16, 0)[1][8:-8, 8:-8]
        np.testing.assert_allclose(slopes[..., 1], 0.25, atol=0.01)  # v runs down the image and up the rod
        np.testing.assert_allclose(slopes[..., 0], 0.0, atol=0.01)
        down = normals(np.array([[[0.0, 0.25], [0.25, 0.0]]], np.float32))[0].astype(float) / 127.0 - 128 / 127
        self.assertGreater(down[0, 1], 0.2, "rises down the image: faces up it, which is green")
        self.assertLess(down[1, 0], -0.2)

    def test_layers_have_the_skins_colours(self):
        for name in ("armor", "v_shot", "ogre"):
            with self.subTest(model=name):
                figure = MODELS[name]()
                files = images(f"progs/{name}.mdl", figure)
                self.assertEqual(len([path for path in files if path.endswith("_norm.png")]), len(figure.skins))
                for number, skin in enumerate(figure.skins):
                    color = read_png(files[f"progs/{name}.mdl_{number}.png"])
                    self.assertEqual(color.shape, (FINE * skin.shape[0], FINE * skin.shape[1], 3))
                    dull = skin < GLOW_FIRST
                    light = linear_from_srgb(color / 255.0).reshape(skin.shape[0], FINE, skin.shape[1], FINE, 3)
                    paletted = linear_from_srgb(PALETTE[skin] / 255.0)
                    difference = light.mean(axis=(1, 3))[dull].mean(axis=0) - paletted[dull].mean(axis=0)
                    self.assertLess(np.abs(difference).max(), 0.02, "mean colour, linear")
                    lamp = files.get(f"progs/{name}.mdl_{number}_luma.png")
                    shares = read_png(lamp).any(axis=-1).mean() if lamp else 0.0
                    self.assertAlmostEqual(shares, (skin >= GLOW_FIRST).mean(), delta=0.01)

    def test_players_colours_have_no_image(self):
        for name in conventions.COLORED:
            files = images(f"progs/{name}.mdl", MODELS[name](), colored=True)
            self.assertEqual(sorted(files), [f"progs/{name}.mdl_0_gloss.png", f"progs/{name}.mdl_0_norm.png"])

    def test_what_is_all_light_has_no_image(self):
        self.assertEqual(images("progs/flame2.mdl", MODELS["flame2"]()), {})

    def test_the_same_images_every_time(self):
        self.assertEqual(images("a", MODELS["v_axe"]()), images("a", MODELS["v_axe"]()))


class Models(unittest.TestCase):
    def each(self):
        return ((name, model(name)) for name in sorted(MODELS))

    def test_every_model_of_the_conventions_is_made(self):
        self.assertEqual(sorted(MODELS), conventions.every_model())

    def test_frames_are_the_conventions(self):
        for name, m in self.each():
            with self.subTest(model=name):
                groups = conventions.GROUPS.get(name)
                if groups:
                    self.assertEqual([len(f.poses) for f in m.frames], groups)
                else:
                    self.assertEqual([f.name for f in m.frames], conventions.frame_names(name))
                    self.assertEqual(len(m.positions), len(m.frames))

    def test_flags_and_skins_are_the_conventions(self):
        for name, m in self.each():
            with self.subTest(model=name):
                self.assertEqual(m.flags, conventions.FLAGS.get(name, 0))
                self.assertEqual(len(m.skins), conventions.SKINS.get(name, 1))
                self.assertEqual(m.skins[0].shape[1] % 4, 0, "rows of four bytes")
                self.assertFalse((m.skins[0] == 255).all())

    def test_meshes_are_whole(self):
        for name, m in self.each():
            with self.subTest(model=name):
                self.assertLessEqual(m.positions.shape[1], MOST_VERTICES)
                self.assertLess(m.triangles.max(), m.positions.shape[1])
                self.assertEqual(len(np.unique(m.triangles)), m.positions.shape[1], "vertices that nothing uses")
                height, width = m.skins[0].shape
                self.assertTrue(((m.texels >= 0) & (m.texels < [width, height])).all())
                corner = m.positions[:, m.triangles]
                area = np.linalg.norm(
                    np.cross(corner[:, :, 1] - corner[:, :, 0], corner[:, :, 2] - corner[:, :, 0]), axis=2
                ).max(axis=0)
                self.assertLess((area < 1e-6).mean(), 0.04, "triangles without area in every frame")

    def test_meshes_are_nearly_closed(self):
        for name, m in self.each():
            with self.subTest(model=name):
                # Seams part vertices, so edges are told by places in all frames.
                places = {}
                number = [
                    places.setdefault(m.positions[:, v].tobytes(), len(places)) for v in range(m.positions.shape[1])
                ]
                edges = collections.Counter()
                for a, b, c in m.triangles:
                    for u, v in ((a, b), (b, c), (c, a)):
                        edges[number[u], number[v]] += 1
                alone = sum(count for (u, v), count in edges.items() if u != v and edges[v, u] == 0)
                self.assertLess(alone / (3 * len(m.triangles)), 0.12, "open edges")

    def test_triangles_face_outwards(self):
        for name, m in self.each():
            with self.subTest(model=name):
                a, b, c = np.moveaxis(m.positions[0][m.triangles] - m.positions[0].mean(axis=0), 1, 0)
                self.assertGreater((a * np.cross(b, c)).sum(), 0.0, "the volume inside")

    def test_a_preview_shows_the_model(self):
        picture = sheet(model("soldier"), [0, 3], [30.0], 48, 0, False)
        self.assertEqual(picture.shape, (48, 96, 3))
        background = picture[0, 0]
        for half in (picture[:, :48], picture[:, 48:]):
            self.assertGreater((half != background).any(axis=2).mean(), 0.05)

    def test_bodies_stand_in_their_hulls(self):
        for name, (half, height) in conventions.HULLS.items():
            if name not in MODELS:
                continue
            with self.subTest(model=name):
                m = model(name)
                first = next(
                    (i for i, f in enumerate(m.frames) if f.name.startswith(("stand", "walk", "hover", "swim"))), 0
                )
                low, high = m.positions[first].min(axis=0), m.positions[first].max(axis=0)
                self.assertGreater(low[2], -24.5 if name not in ("fish", "wizard") else -30.0)
                self.assertLess(high[2], height - 24.0 + 4.0)
                self.assertGreater(high[2] - low[2], 0.45 * height if name not in ("fish", "tarbaby", "dog") else 8.0)
                self.assertLess(np.abs(m.positions[first][:, 1]).max(), half * 1.5)
                self.assertGreater(m.positions[..., 2].min(), -32.0, "sinks through the ground")

    def test_feet_stay_where_they_are_put(self):
        m = model("soldier")
        run = [i for i, f in enumerate(m.frames) if f.name.startswith("prowl_")]
        lowest = m.positions[run][:, :, 2].min(axis=1)
        self.assertLess(np.abs(lowest + 24.0).max(), 1.5)

    def test_the_same_bytes_every_time(self):
        for name in ("v_shot", "soldier"):
            self.assertEqual(write_mdl(MODELS[name]()), made(name))


if __name__ == "__main__":
    unittest.main()
