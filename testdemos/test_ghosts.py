"""Holds ghosts.py's arithmetic: what it says of pictures made of known parts."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import ghosts  # noqa: E402
import numpy as np  # noqa: E402


class Arithmetic(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(3)
        self.exact = random.random((9, 40, 50))
        self.truth, self.other = (self.exact + 0.3 * random.standard_normal(self.exact.shape) for _ in range(2))

    def test_the_truth_has_neither_ghosts_nor_blur(self):
        said = ghosts.with_parts(self.exact, self.truth, self.other)
        self.assertAlmostEqual(said["ghosts"][0], 0, delta=0.02)
        self.assertAlmostEqual(said["sharpness"][0], 1, delta=0.02)
        self.assertAlmostEqual(said["error"][0], 0, delta=0.002)
        for value, least, most in said.values():
            self.assertLessEqual(least, value)
            self.assertGreaterEqual(most, value)

    def test_a_share_of_the_former_frame_is_its_ghost(self):
        late = self.exact.copy()
        late[1:] += 0.25 * (self.exact[:-1] - self.exact[1:])
        self.assertAlmostEqual(ghosts.figures(late, self.truth, self.other)["ghosts"], 0.25, delta=0.02)

    def test_less_detail_is_less_sharp(self):
        dull = self.exact.mean((1, 2), keepdims=True) + 0.6 * (self.exact - self.exact.mean((1, 2), keepdims=True))
        said = ghosts.figures(dull, self.truth, self.other)
        self.assertAlmostEqual(said["sharpness"], 0.6, delta=0.02)
        self.assertAlmostEqual(said["error"], 0.16 / 12, delta=0.002)

    def test_a_still_view_has_no_ghosts_to_measure(self):
        still = np.repeat(self.exact[:1], 9, 0)
        with self.assertRaisesRegex(ValueError, "nothing moves"):
            ghosts.figures(still, still, still)


if __name__ == "__main__":
    unittest.main()
