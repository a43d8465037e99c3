"""Holds the pictures to what the game's conventions ask: formats read back, names, sizes, the same bytes twice."""

from __future__ import annotations

import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from art import make  # noqa: E402
from art.palette import GLOW_FIRST, PALETTE, RAMPS, colormap, linear_from_srgb, nearest, oklab_from_srgb  # noqa: E402
from formats import lmp, png, wad  # noqa: E402


class Palette(unittest.TestCase):
    def test_ramps_rise(self):
        lightness = oklab_from_srgb(PALETTE / 255.0)[:, 0]
        for name, ramp in RAMPS.items():
            if name != "grey":
                self.assertTrue((np.diff(lightness[ramp]) > 0).all(), name)
        self.assertGreater(lightness[254], 0.999)
        self.assertEqual(PALETTE[0].tolist(), [0, 0, 0])

    def test_nearest_finds_the_palette(self):
        found = nearest(PALETTE[:GLOW_FIRST] / 255.0)
        np.testing.assert_array_equal(PALETTE[found], PALETTE[:GLOW_FIRST])
        glowing = nearest(PALETTE[GLOW_FIRST:255] / 255.0, glow=True)
        np.testing.assert_array_equal(PALETTE[glowing], PALETTE[GLOW_FIRST:255])
        self.assertLess(nearest(np.array([1.0, 0.5, 0.1])), GLOW_FIRST)

    def test_colormap(self):
        table = colormap()
        self.assertEqual(table[32].tolist(), list(range(256)))
        light = linear_from_srgb(PALETTE[table] / 255.0)[:, :GLOW_FIRST].mean(axis=(1, 2))
        self.assertTrue((np.diff(light) <= 1e-3).all())
        self.assertEqual(table[63, 240], 240)


class Formats(unittest.TestCase):
    def test_png(self):
        for shape in [(5, 7), (4, 6, 3), (3, 2, 4)]:
            pixels = np.random.default_rng(1).integers(0, 256, shape, np.uint8)
            np.testing.assert_array_equal(png.read_png(png.write_png(pixels)).reshape(shape), pixels)
        with self.assertRaises(ValueError):
            png.read_png(b"GIF89a")

    def test_lmp(self):
        picture = np.arange(24, dtype=np.uint8).reshape(4, 6)
        np.testing.assert_array_equal(lmp.read_lmp(lmp.write_lmp(picture)), picture)
        with self.assertRaises(ValueError):
            lmp.read_lmp(lmp.write_lmp(picture)[:-1])

    def test_wad(self):
        lumps = [wad.Lump("ONE", 0x42, b"abc"), wad.Lump("two", 0x44, b"")]
        found = wad.read_wad(wad.write_wad(lumps))
        self.assertEqual(found["one"], lumps[0])
        self.assertEqual(found["two"], lumps[1])
        with self.assertRaises(ValueError):
            wad.write_wad([wad.Lump("a" * 16, 0x42, b"")])


if __name__ == "__main__":
    unittest.main()
