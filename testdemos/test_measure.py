"""Holds measure.py's arithmetic: samples that are added to kept ones, pictures that are drawn until they are good enough."""

from __future__ import annotations

import csv
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1] / "Misc/python")]

import measure  # noqa: E402
import numpy as np  # noqa: E402
from fullbright_lab.exr import read, write  # noqa: E402
from scenes import HERE, names  # noqa: E402


LIMITS = {"ajar": 0.02, "pool": 0.05, "caustic": 0.1, "portal": 0.05}  # their light is found by chance: the error falls slowly


class NoisyLab:
    """Draws grey noise of standard deviation 1 a sample about 4, by the seed that it is given."""

    def __init__(self, folder: Path) -> None:
        self.program = folder / "fullbright-lab"
        self.header = read(HERE / "references/plain.exr")[1]
        self.seeds: list[str] = []

    def reference(self, name: str, out: Path, *sets: str, spp: int, **options) -> None:
        seed = next(s for s in sets if s.startswith("r_seed="))
        self.seeds.append(seed)
        if len(self.seeds) > 50:
            raise AssertionError("it draws for ever")
        samples = np.random.default_rng(int(seed[7:])).normal(4, 1, (spp, 54, 96))
        mean, variance = samples.mean(axis=0), samples.var(axis=0, ddof=1) / spp
        write(out, {key: v for c in "RGB" for key, v in ((c, mean), (f"variance.{c}", variance))}, self.header)


class Pictures(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="fullbright-measure-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.lab = NoisyLab(self.folder)

    def test_more_samples_are_as_if_drawn_at_once(self):
        measure.sample_picture(self.lab, "plain", 64, {}, 0)
        planes, spp = measure.sample_picture(self.lab, "plain", 192, *measure.load_picture(self.lab, "plain"))
        self.assertEqual(spp, 256)
        self.assertEqual(self.lab.seeds, ["r_seed=0", "r_seed=64"], "no seed comes twice")
        # 5184 pixels: a mean's spread is known to 1%, the mean of their variances to 0.1%; halves round by 0.05%.
        self.assertAlmostEqual(planes["G"].std() * 16, 1, delta=0.05)
        self.assertAlmostEqual(planes["variance.G"].mean() * 256, 1, delta=0.01)
        again, spp = measure.load_picture(self.lab, "plain")
        self.assertEqual(spp, 256)
        self.assertTrue((again["R"] == planes["R"]).all())

    def test_references_name_no_folder_of_this_machine(self):
        header = {"fullbright.view": ("string", f"--demo {measure.ROOT}/testdemos/pool.dem --frame 56".encode()), "other": ("int", b"1")}
        self.assertEqual(measure.without_folder(header)["fullbright.view"], ("string", b"--demo testdemos/pool.dem --frame 56"))
        self.assertEqual(measure.without_folder({"other": 1}), {"other": 1})
        for path in (HERE / "references").glob("*.exr"):
            self.assertNotIn(b"/testdemos", path.read_bytes(), path.name)

    @unittest.skipUnless(shutil.which("convert"), "needs ImageMagick")
    def test_a_picture_is_drawn_until_it_is_good_enough(self):
        with mock.patch.object(measure, "PICTURES", self.folder):
            row = measure.make_picture(self.lab, "plain", 16, False, 0.0008)
        # relMSE is 1 / spp / 16 for each pixel, and the exposure makes 4 grey: x^2 / (x^2 + 0.01) of it.
        expected = 1 / row["spp"] / 16 * 0.16**2 / (0.16**2 + 0.01)
        self.assertAlmostEqual(float(row["relmse"]) / expected, 1, delta=0.05)
        self.assertLessEqual(float(row["relmse"]), 0.0008)
        self.assertGreater(expected * row["spp"] / (row["spp"] - 16), 0.0008, "and not longer")
        self.assertTrue((self.folder / "plain.jpg").exists())
        drawn = len(self.lab.seeds)
        with mock.patch.object(measure, "PICTURES", self.folder):
            self.assertEqual(measure.make_picture(self.lab, "plain", 16, True, 0.0008), row, "what is kept is good enough")
            self.assertEqual(len(self.lab.seeds), drawn)
            measure.make_picture(self.lab, "plain", 16, False, 0.0008)
        self.assertEqual(self.lab.seeds[drawn], "r_seed=0", "without `more` it begins anew")

    def test_every_picture_in_the_docs_is_of_reference_quality(self):
        rows = {row["scene"]: float(row["relmse"]) for row in csv.DictReader(measure.NOISE.open())}
        self.assertEqual(sorted(rows), sorted(names()))
        self.assertEqual({name: v for name, v in rows.items() if not v <= LIMITS.get(name, 0.0125)}, {})


if __name__ == "__main__":
    unittest.main()
