#!/usr/bin/env python3
"""`fullbright-lab still`: still_test.py BUILD_DIR. Pictures of a scene in code at 64x36: what is said, what is refused,
and a picture whose program is killed between iterations. Skipped, saying so, without a Vulkan device."""

import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from pictures import read_png
from programs_needed import need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
GUIDED = ("--guided", "--samples", "64", "--set", "r_deterministic=1")


class Still(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def command(self, out, *options):
        return [BUILD / "fullbright-lab", "still", "--scene", "cbox", "--size", "64x36", "--out", self.folder / out,
                *options]

    def still(self, out, *options):
        return subprocess.run(self.command(out, *options), capture_output=True, text=True, timeout=300, check=False)

    def test_it_says_what_it_takes_and_writes_a_picture(self):
        said = self.still("plain.png", "--samples", "2")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("plain: 2 samples a pixel by mcpg_nee, unbiased\n", said.stdout)
        width, height, rows = read_png(self.folder / "plain.png")
        self.assertEqual((width, height), (64, 36))
        self.assertGreater(len(set(rows[18])), 8, "it is no plain colour")
        said = self.still("guided.png", "--samples", "8", "--guided")
        self.assertEqual(said.returncode, 0, said.stderr)
        lines = said.stdout.splitlines()
        self.assertEqual(lines[0], "guided: 8 samples a pixel by mir in iterations of 2,2,2,2, "
                                   "biased: less with more samples")
        self.assertRegex(lines[1], r"^memory at most: [\d.]*[1-9][\d.]* MB of the device, [\d.]+ MB of the host \(stored ")
        self.assertRegex(lines[2], r"^[\d.e-]+ s a sample: about [\d.e-]+ s for the 6 that are left$")
        self.assertRegex(lines[3], r"guided\.png: [\d.]+ s; \d+ paths stored")
        self.assertNotEqual(read_png(self.folder / "guided.png")[2], rows)

    def test_what_cannot_be_is_refused_in_one_sentence(self):
        for sentence, options in (
            ("--decorrelated: it is a form of --guided", ("--decorrelated",)),
            ("--resume: it keeps the iterations of --guided; `reference` goes on with plain samples",
             ("--resume", "x")),
            ("--guided: its estimator is mir; leave --estimator out", ("--guided", "--estimator", "pt")),
            ("--estimator mir: it learns in iterations; use --guided", ("--estimator", "mir")),
        ):
            said = self.still("a.png", *options)
            self.assertEqual((said.returncode, said.stderr), (1, f"fullbright-lab: {sentence}\n"))
        self.assertIn("a picture is a .png or an .exr file", self.still("a.jpg").stderr)
        said = self.still("a.png", "--guided", "--samples", "1048576", "--set", "r_bounces=64",
                          "--set", "r_mir_split=10", "--set", "r_mir_share=0.0001")
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr, r"^fullbright-lab: --guided: up to \d+ MB of the (machine|device)'s memory are ")

    def test_killed_it_goes_on_and_makes_the_same_picture(self):
        whole = self.still("whole.exr", *GUIDED)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        state = self.folder / "state"
        with subprocess.Popen(self.command("parts.exr", *GUIDED, "--resume", state), stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as program:
            until = time.monotonic() + 120
            while not state.exists() and time.monotonic() < until and program.poll() is None:
                time.sleep(0.01)
            program.send_signal(signal.SIGTERM)
            self.assertIn("stopped by SIGTERM", program.stderr.read())
            self.assertEqual(program.wait(), -signal.SIGTERM)
        self.assertTrue(state.exists())
        self.assertFalse((self.folder / "parts.exr").exists())
        other = self.still("parts.exr", *GUIDED, "--resume", state, "--set", "r_seed=5")
        self.assertEqual(other.returncode, 1)
        self.assertIn("it is of another picture", other.stderr)
        rest = self.still("parts.exr", *GUIDED, "--resume", state)
        self.assertEqual(rest.returncode, 0, rest.stderr)
        self.assertRegex(rest.stdout, r"state: goes on after \d+ samples\n")
        self.assertEqual((self.folder / "parts.exr").read_bytes(), (self.folder / "whole.exr").read_bytes())
        self.assertFalse(state.exists(), "its picture is there")


if __name__ == "__main__":
    need(BUILD)
    unittest.main(argv=sys.argv[:1])
