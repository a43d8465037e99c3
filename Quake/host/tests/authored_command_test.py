#!/usr/bin/env python3
"""What `fullbright-lab authored` says and leaves out: authored_command_test.py BUILD_DIR. On a small map of LibreQuake's; skipped, saying so,
without LibreQuake or a Vulkan device."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from programs_needed import librequake, need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
SKIPPED = 77
MAP = "lqdm3"


class AuthoredCommand(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "id1/maps").mkdir(parents=True)
        data, _ = librequake()
        for pak in (data / "id1").glob("*.pak"):
            (self.folder / "id1" / pak.name).symlink_to(pak)

    def lab(self, *arguments, game_map=MAP, status=0):
        usual = [word for pair in (("--size", "32x18"), ("--spp", "1")) if pair[0] not in arguments for word in pair]
        command = [BUILD / "fullbright-lab", "authored", "--basedir", self.folder, "--map", game_map, *usual, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_a_camera_within_a_wall_is_told_and_measures_nothing(self):
        for place in ("0,0,100000,0,0,0", "-100000,5,5,0,0,0"):
            done = self.lab("--set", "r_authored=0", "--camera", place, status=1)
            self.assertEqual(done.stderr.count(f"--camera {place}: it is inside a wall"), 1, done.stderr)
            self.assertNotIn("median", done.stdout)
            self.assertNotIn("all ", done.stdout)

    def test_without_the_fit_it_says_so_and_makes_none(self):
        done = self.lab("--set", "r_authored=0", "--table", "--cameras", "1", "--out", self.folder / "out")
        self.assertEqual(done.stdout.count("r_authored 0: light is as the map's keys and textures say"), 1, done.stdout)
        self.assertNotIn("light as baked", done.stdout)
        self.assertNotIn("factor on its power", done.stdout)
        page = (self.folder / "out/index.html").read_text()
        self.assertIn("r_authored 0", page)
        self.assertNotIn("Emitters", page)
        done = self.lab("--table", "--cameras", "1")
        self.assertIn("light as baked", done.stdout)
        self.assertIn("factor on its power", done.stdout)

    def test_wrong_settings_are_a_sentence(self):
        done = self.lab("--set", "r_authored=7", status=1)
        self.assertIn("--set r_authored=7: r_authored: 7 is", done.stderr)
        done = self.lab("--spp", "2", "--spp", "1", status=114)
        self.assertEqual(done.stderr, "fullbright-lab: --spp: it is given 2 times and counts once\n")

    def test_what_cannot_be_compared_is_refused_before_the_map_is_fitted(self):
        for arguments, sentence in ((("--size", "8x8"), "--size 8x8: pictures are compared in 16 x 9 blocks"),
                                    (("--out", ""), "--out: the name of a folder is wanted"),
                                    (("--camera", "0,0,100000,0,0,0", "--out", self.folder / "never"), "it is inside a wall")):
            done = self.lab(*arguments, status=1)
            self.assertEqual(done.stderr.count(sentence), 1, done.stderr)
            self.assertNotIn("light as baked", done.stdout)
        self.assertFalse((self.folder / "never").exists())

    def test_a_views_figures_are_its_own(self):
        def rows(cameras):
            return [line for line in self.lab("--cameras", cameras, "--spp", "2").stdout.splitlines() if line.startswith("info_")]

        three, six = rows("3"), rows("6")
        self.assertEqual((len(three), len(six)), (3, 6))
        self.assertEqual(three, six[::2], "every second of six is one of three")

    def test_cameras_that_are_nowhere_are_named(self):
        (self.folder / f"id1/maps/{MAP}.ent").write_text('{"classname" "worldspawn"}\n{"classname" "info_player_start" "origin" "nan 0 0"}'
                                                         '\n{"classname" "info_intermission" "origin" "0 0 99999"}')
        done = self.lab(status=1)
        self.assertIn("1 of the map's cameras have no origin of three numbers, and do not count: info_player_start_1", done.stdout)
        self.assertIn("1 of the map's cameras are inside a wall", done.stdout)
        self.assertIn("none of its cameras counts; --camera", done.stderr)

    def test_a_map_that_nobody_lit_is_doubted(self):
        plain = self.lab("--set", "r_authored=0", "--cameras", "1").stdout
        self.assertNotIn("was it lit?", plain)
        samples = self.samples()
        (self.folder / f"id1/maps/{MAP}.lit").write_bytes(b"QLIT\x01\0\0\0" + bytes(3 * samples))
        done = self.lab("--set", "r_authored=0", "--cameras", "1", "--out", self.folder / "dark")
        self.assertIn("100% of the map's baked light is black: was it lit?", done.stdout)
        self.assertIn("was it lit?", (self.folder / "dark/index.html").read_text())

    def samples(self):
        """How many luxels the map has: what a .lit of no light at all is told."""
        lit = self.folder / f"id1/maps/{MAP}.lit"
        lit.write_bytes(b"QLIT\x01\0\0\0")
        done = self.lab("--set", "r_authored=0", "--cameras", "1")
        return int(re.search(r"where the map's (\d+) samples take", done.stderr)[1])

    def test_a_map_whose_entities_are_damaged_says_so_once(self):
        (self.folder / f"id1/maps/{MAP}.ent").write_text('{"classname" "worldspawn"\n"x')
        done = self.lab(status=1)
        self.assertEqual(done.stderr.count("the text ends inside an entity"), 1, done.stderr)
        self.assertIn("it names no camera", done.stderr)
        self.assertNotIn("median", done.stdout)

    def test_a_light_file_of_another_map_is_told_and_left_out(self):
        (self.folder / f"id1/maps/{MAP}.lit").write_bytes(b"")
        done = self.lab("--set", "r_authored=0", "--cameras", "1")
        self.assertEqual(done.stderr.count(f"maps/{MAP}.lit: it is empty; the map's own light is used"), 1, done.stderr)


if __name__ == "__main__":
    need(BUILD)
    lacks = librequake()[1]
    if lacks:
        print(f"skipped: {lacks}")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)
