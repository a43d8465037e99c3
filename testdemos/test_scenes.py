"""Holds the laboratory's scenes together: settings, maps, demos, references; what the demos show to what is expected, and
what pt draws to the references.

FULLBRIGHT_BUILD names the build folder (../build)."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), *(str(Path(__file__).resolve().parents[1] / folder) for folder in ("Misc/basegame", "Misc/python"))]

import numpy as np  # noqa: E402
from art.palette import LAMP, PALETTE, heat, hex_to_srgb, nearest  # noqa: E402
from fullbright_lab import exr  # noqa: E402
from make_demos import positions, record, timedemo_frames  # noqa: E402
from measure import CENTRES, SIZE, Lab  # noqa: E402
from scenes import HERE, demo_of, lab_args, load, names  # noqa: E402

BUILD = Path(os.environ.get("FULLBRIGHT_BUILD", HERE.parent / "build"))
MAPS = HERE.parent / "Misc/basegame/maps/lab"
has_game = (BUILD / "game/id1/progs.dat").exists() and (BUILD / "fullbright-lab").exists()


class Settings(unittest.TestCase):
    def test_every_scene_has_its_map_demo_reference_and_picture(self):
        self.assertGreaterEqual(len(names()), 17)
        for name in names():
            scene = load(name)
            for path in (MAPS / f"{scene['map']}.bsp", demo_of(name), HERE / f"expected/{name}.csv",
                         HERE / f"references/{name}.exr", HERE.parent / f"Misc/docs/pictures/scenes/{name}.jpg"):
                self.assertTrue(path.exists(), f"{path} is missing")
            self.assertTrue({"--map", "--demo"} & set(lab_args(name)), name)

    def test_a_wrong_key_is_refused(self):
        with self.assertRaisesRegex(ValueError, "there is no scene 'nowhere'"):
            load("nowhere")

    def test_references_are_small_and_say_their_variance(self):
        total = 0
        for name in names():
            path = HERE / f"references/{name}.exr"
            total += path.stat().st_size
            planes, _ = exr.read(path)
            self.assertEqual(sorted(planes), ["B", "G", "R", "variance.B", "variance.G", "variance.R"], name)
            self.assertTrue(all((plane >= 0).all() for plane in planes.values()), name)
        self.assertLess(total, 2_000_000)

    def test_the_furnace_is_of_one_radiance(self):
        """e (1 + a + a^2) at two reflections: a is the texture's colour, e that times r_emit_fullbright, 6."""
        planes, _ = exr.read(HERE / "references/furnace.exr")
        color = PALETTE[nearest(hex_to_srgb(heat(LAMP)), glow=True)]  # lab_light_warm
        for channel, value in zip("RGB", color):
            a = ((value / 255 + 0.055) / 1.055) ** 2.4
            closed = 6 * a * (1 + a + a * a)
            self.assertLess(abs(planes[channel] - closed).max(), 0.002 * closed, channel)

    def test_exr_files_read_back(self):
        planes, header = exr.read(HERE / f"references/{names()[0]}.exr")
        with tempfile.TemporaryDirectory() as scratch:
            again = Path(scratch) / "again.exr"
            exr.write(again, planes, header)
            for name, plane in exr.read(again)[0].items():
                self.assertTrue((plane == planes[name]).all(), name)


@unittest.skipUnless(has_game, "the base game is not built")
class Demos(unittest.TestCase):
    def test_players_are_where_they_were(self):
        for name in names():
            with self.subTest(name):
                self.assertEqual(positions(demo_of(name), BUILD), (HERE / f"expected/{name}.csv").read_text())

    def test_frames_are_as_many_as_expected(self):
        expected = dict(re.findall(r"(\S+) (\d+)\n", (HERE / "expected/frames.txt").read_text()))
        self.assertEqual(sorted(expected), names())
        for name in ("horde", "rocket", "far"):  # the busy ones, and another protocol
            with self.subTest(name):
                self.assertEqual(timedemo_frames(demo_of(name), BUILD, None), int(expected[name]))

    def test_a_script_played_again_gives_the_same_walk(self):
        with tempfile.TemporaryDirectory() as scratch:
            for name in ("tears", "far"):
                again = record(name, BUILD, None, Path(scratch))
                said = subprocess.run([BUILD / "fullbright-lab", "track", demo_of(name), again, "--tolerance", "0"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(said.returncode, 0, said.stdout + said.stderr)


@unittest.skipUnless(has_game, "the base game is not built")
class References(unittest.TestCase):
    """A reference that no longer is what its estimator converges to (maps, textures, rules or the renderer changed) is worse than none."""

    def test_what_is_drawn_differs_by_noise_alone(self):
        """The mean of 108 blocks scatters by sqrt(2 / 108), 0.14, about 1: the bound is three and a half of that. As made: 0.05 to
        1.21. One reflection less: 1.6 to 9, but in pool and shafts, whose rare hits hide it."""
        lab = Lab(BUILD)
        with tempfile.TemporaryDirectory() as scratch:
            test = Path(scratch) / "test.exr"
            for name in names():
                with self.subTest(name):
                    options = {"spp": 256, "size": SIZE, "estimator": load(name)["reference_estimator"]}
                    lab.reference(name, test, CENTRES, "r_seed=7", **options)
                    reference = HERE / f"references/{name}.exr"
                    found = deviation(reference, test)
                    if found >= 1.5:
                        again = lab.reference_args(name, Path("out/again.exr"), CENTRES, "r_seed=7", **options)
                        kept = lab.keep_evidence(f"scenes_{name}", reference, test,
                                                 [str(lab.program), "reference", *again])
                        self.fail(f"{name}: {found:.2f} is not below 1.5; {kept} has the pictures and the command")

    def test_evidence_of_a_failure_is_kept(self):
        lab = Lab(BUILD)
        reference, other = HERE / "references/cbox.exr", HERE / "references/furnace.exr"
        kept = lab.keep_evidence("evidence_test", reference, other, [str(lab.program), "reference", "--help"])
        self.assertEqual(sorted(p.name for p in kept.iterdir()), ["command", "difference.png", "image.exr", "reference.exr"])
        self.assertEqual(subprocess.run((kept / "command").read_text(), shell=True, capture_output=True).returncode, 0)
        shutil.rmtree(kept)


BLOCK = (6, 8)  # rows and columns of pixels, so that single bright samples do not hide the rest


def deviation(reference: Path, test: Path) -> float:
    """The squared difference of two pictures' blocks over its variance, on average: about 1 for two draws of one picture.

    The test's variance is the reference's for fewer samples: it saw too few of what is rare to know its own. A block counts
    for no more than three standard deviations, since light that single samples bring has no normal distribution."""
    (known, header), (drawn, drawn_header) = exr.read(reference), exr.read(test)
    color, found, noise = (np.stack([planes[f"{key}{c}"] for c in "RGB"]).astype(float)
                           for planes, key in ((known, ""), (drawn, ""), (known, "variance.")))
    samples, fewer = (int(h["fullbright.spp"][1]) for h in (header, drawn_header))
    variance = blocks(noise) * (1.0 + samples / fewer) + blocks(color * 2.0**-11) ** 2  # the reference's halves round
    lit = variance > 0.0
    return float(np.minimum(blocks(found - color)[lit] ** 2 / variance[lit], 9.0).mean())


def blocks(planes: np.ndarray) -> np.ndarray:
    """Sums over blocks: (channels, h, w) to (channels, h / rows, w / columns)."""
    channels, height, width = planes.shape
    return planes.reshape(channels, height // BLOCK[0], BLOCK[0], width // BLOCK[1], BLOCK[1]).sum(axis=(2, 4))


if __name__ == "__main__":
    unittest.main()
