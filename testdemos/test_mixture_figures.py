"""Holds what mixture_figures.py measures to pictures made so that it is known."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import mixture_figures as figures  # noqa: E402


def grey(values: np.ndarray) -> np.ndarray:
    return np.repeat(values[..., None], 3, axis=-1)


class Measures(unittest.TestCase):
    def test_brightness_leaves_out_what_a_few_samples_hold(self) -> None:
        reference = grey(np.ones((2, 10, 10)))
        self.assertAlmostEqual(figures.brightness(reference / 2, reference), 0.5)
        rare = np.zeros((2, 10, 10))
        rare[:, 0, 0] = 100  # the same mean, in one pixel of a hundred
        self.assertAlmostEqual(figures.brightness(grey(rare), reference), 0.04)

    def test_borders_are_where_two_lamps_shine_alike(self) -> None:
        reference = np.zeros((1, 4, 3, 3))
        reference[:, :, 0] = [1.0, 0.02, 0.02]
        reference[:, :, 1] = [0.6, 0.55, 0.02]  # the border
        reference[:, :, 2] = [0.02, 1.0, 0.02]
        frames = reference.copy()
        frames[:, :, 1] *= 1.4
        frames[:, :, [0, 2]] *= 1.1
        self.assertAlmostEqual(figures.borders(frames, reference), 16, places=6)

    def test_edges_are_where_light_changes(self) -> None:
        y = np.ones((1, 12, 20))
        y[:, :, 10:] = 0.3
        reference, frames = grey(y), grey(y)
        frames[:, :, 9:11] *= 1.2
        frames[:, :, :9] *= 1.1
        self.assertAlmostEqual(figures.edges(frames, reference), 4, places=6)

    def test_every_figure_names_estimators(self) -> None:
        for name, figure in figures.FIGURES.items():
            with self.subTest(name):
                self.assertLessEqual(figure[2][0], figure[2][1])
                for estimator in figure[5].values():
                    self.assertIn(estimator[0], ("pt", "ssmm", "restir_di"))
                    self.assertTrue(all("=" in cvar for cvar in estimator[1:]))


if __name__ == "__main__":
    unittest.main()
