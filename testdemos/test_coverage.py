"""Holds coverage.py's arithmetic and the names of its views; with a built laboratory, that what it says follows the guide."""

from __future__ import annotations

import argparse
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import coverage  # noqa: E402
import numpy as np  # noqa: E402

BUILD = os.environ.get("FULLBRIGHT_BUILD", "")
LAB = f"{BUILD}/fullbright-lab"


class Arithmetic(unittest.TestCase):
    def test_shares(self):
        samples = np.zeros((8, 1000, 3))
        samples[:, :, 2] = 0.5
        samples[:, :, 1] = 0.25
        samples[:, ::5, 0] = 0.25  # a fifth is where no lobe is
        said = coverage.shares(samples)
        self.assertAlmostEqual(said["uncovered"], 0.2)
        self.assertAlmostEqual(said["least"], 0.2)
        self.assertAlmostEqual(said["moment"], 1)
        self.assertAlmostEqual(said["top"], 0.001)

    def test_darkness_is_no_share(self):
        with self.assertRaisesRegex(ValueError, "no sample brought any light"):
            coverage.shares(np.zeros((4, 10, 3)))

    def test_views(self):
        self.assertEqual(coverage.view_args("code:cbox"), ["--scene", "cbox"])
        self.assertEqual(coverage.view_args("map:start"), ["--map", "start"])
        self.assertIn("lab_tears", coverage.view_args("tears"))
        for unknown in ("nowhere", "demo:x", "code:"):
            with self.assertRaisesRegex(ValueError, "there is no view"):
                coverage.view_args(unknown)


@unittest.skipUnless(BUILD, "FULLBRIGHT_BUILD names no build")
class Guide(unittest.TestCase):
    def test_lobes_cover_what_they_learnt(self):
        def of(warmup: int) -> dict[str, float]:
            return coverage.measure(argparse.Namespace(lab=LAB, estimator="mcpg", size="48x48", frames=8, warmup=warmup, at=0,
                                                       basedir=None), "code:cbox")
        cold, warm = of(0), of(24)
        # One sample far from all lobes can bring half of all second moments: the part of the warm frames with the least decides.
        self.assertLess(warm["least"], 0.3 * cold["uncovered"])
        self.assertLess(warm["moment"], cold["moment"])


if __name__ == "__main__":
    unittest.main()
