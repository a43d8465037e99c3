#!/usr/bin/env python3
"""timedemo's lists and files, and what `fullbright-lab timedemos` says of them: timedemos_test.py BUILD_DIR. Plays demos
of the base game at 64x36. Skipped, saying so, without the base game or a Vulkan device."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from programs_needed import need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
COUNTS = {"cbox.dem": 84, "plain.dem": 63}  # what the classic line has


class Timedemos(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.user = pathlib.Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def play(self, *commands, size="64x36", **environment):
        return subprocess.run(
            [BUILD / "fullbright", "-headless", "-size", size, "-seed", "1", "-nosound", "-basedir", BUILD / "game",
             "-userdir", self.user, "+r_estimator", "pt", "+r_bounces", "0", *commands],
            capture_output=True, text=True, timeout=120, check=False, env={**os.environ, **environment})

    def compare(self, a, b, *options):
        folder = self.user / "id1"
        return subprocess.run([BUILD / "fullbright-lab", "timedemos", folder / a, folder / b, *options],
                              capture_output=True, text=True, timeout=60, check=False)

    def read(self, name):
        return json.loads((self.user / "id1" / name).read_text())

    def test_a_list_is_played_so_often_and_its_frames_are_the_classic_count(self):
        said = self.play("+scr_timedemo_json", "list", "+scr_timedemo_runs", "4", "+timedemo", "cbox", "plain", "+quit")
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
        lines = [int(n) for n in re.findall(r"^(\d+) frames .* fps$", said.stdout, re.M)]
        self.assertEqual(lines, [84, 63] * 4)
        self.assertRegex(said.stdout, r"cbox.dem: 4 runs, [\d.]+ fps \[")
        found = self.read("list.json")
        self.assertTrue(found["complete"])
        self.assertEqual({d["name"]: [r["frames"] for r in d["runs"]] for d in found["demos"]},
                         {name: [count] * 4 for name, count in COUNTS.items()})
        self.assertEqual(found["manifest"]["settings"]["r_bounces"], "0")
        self.assertEqual(found["manifest"]["size"], [64, 36])
        for demo in found["demos"]:
            for run in demo["runs"]:
                frames = run["each_frame"]["frame_ms"]
                self.assertEqual(len(frames), COUNTS[demo["name"]])
                # Every frame but those that loaded: no more than the classic line's time.
                self.assertLessEqual(sum(frames), 1000 * run["seconds"] + max(frames))
                self.assertEqual(run["worst"][0]["frame_ms"], max(frames))
                self.assertEqual(frames[run["worst"][0]["frame"]], max(frames))
                self.assertTrue(any(p["kind"] == "estimator" and p["mean_ms"] > 0 for p in run["passes"]))
        # A file says nothing against itself.
        same = self.compare("list.json", "list.json", "--json", "-")
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertEqual(json.loads(same.stdout)["speed"]["value"], 1)
        self.assertIn("No difference", json.loads(same.stdout)["sentence"])

    def test_what_the_first_frame_compiles_is_not_timed(self):
        with tempfile.TemporaryDirectory() as empty:
            said = self.play("+scr_timedemo_json", "cold", "+timedemo", "plain", "+quit", MESA_SHADER_CACHE_DIR=empty)
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
        run = self.read("cold.json")["demos"][0]["runs"][0]
        frames = run["each_frame"]["frame_ms"]
        self.assertLess(1000 * run["seconds"], sum(frames) + max(frames) + 100)

    def test_what_is_unlike_or_cut_short_is_refused(self):
        for name, demo, size in (("a", "plain", "64x36"), ("b", "cbox", "64x36"), ("c", "plain", "32x18")):
            self.assertEqual(self.play("+scr_timedemo_json", name, "+timedemo", demo, "+quit", size=size).returncode, 0)
        self.assertIn("not in", self.compare("a.json", "b.json").stderr)
        self.assertIn("64x36", self.compare("a.json", "c.json").stderr)
        # The second demo is missing: the first is written, and the file says that it is not all.
        said = self.play("+scr_timedemo_json", "cut", "+timedemo", "plain", "nothing", "+quit")
        self.assertEqual(said.returncode, 1)
        self.assertFalse(self.read("cut.json")["complete"])
        refused = self.compare("cut.json", "a.json")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("not played to their end", refused.stderr)
        self.assertIn("no such file", self.compare("a.json", "none.json").stderr.lower())

    def test_no_file_but_one_of_its_kind_is_written_over(self):
        (self.user / "id1").mkdir(exist_ok=True)
        (self.user / "id1/keep.cfg").write_text("// kept\n")
        self.play("+scr_timedemo_json", "keep.cfg", "+timedemo", "plain", "+quit")
        self.assertEqual((self.user / "id1/keep.cfg").read_text(), "// kept\n")
        outside = self.play("+scr_timedemo_json", "../../outside", "+timedemo", "plain", "+quit")
        self.assertEqual(outside.returncode, 1)
        self.assertFalse((self.user.parent / "outside.json").exists())
        self.assertIn("scr_timedemo_json: ", outside.stdout + outside.stderr)
        self.assertNotIn("63 frames", outside.stdout, "it is refused before the demo is played, not after")


if __name__ == "__main__":
    need(BUILD, base_game=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
