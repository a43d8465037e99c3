#!/usr/bin/env python3
"""capturedemo: capturedemo_test.py BUILD_DIR. The base game's Cornell box demo as pictures and, where ffmpeg is, as a film.
Skipped, saying so, without a Vulkan device or the base game."""

import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import wave

from programs_needed import need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
SECONDS = 4.3  # of the demo


class CaptureDemo(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        self.captures = self.folder / "id1/captures"

    def tearDown(self):
        self.scratch.cleanup()

    def command(self, *words, size="48x27"):
        return [BUILD / "fullbright", "-basedir", BUILD / "game", "-headless", "-size", size, "-userdir", self.folder, *words]

    def play(self, *words, **more):
        return subprocess.run(self.command(*words, **more), capture_output=True, text=True, timeout=300, check=False)

    def test_pictures_are_at_even_steps_and_the_same_each_time(self):
        for name in ("one", "two"):
            said = self.play("+set", "r_deterministic", "1", "+capture_fps", "10", "+capturedemo", "cbox", name)
            self.assertEqual(said.returncode, 0, said.stderr)
        one, two = (sorted((self.captures / name).iterdir()) for name in ("one", "two"))
        pictures = [p for p in one if p.suffix == ".png"]
        self.assertAlmostEqual(len(pictures), 10 * SECONDS, delta=1)
        self.assertEqual([p.name for p in one], [p.name for p in two])
        for a, b in zip(one, two):
            self.assertEqual(a.read_bytes(), b.read_bytes(), a.name)
        self.assertNotEqual(pictures[10].read_bytes(), pictures[30].read_bytes(), "the camera moves")
        with wave.open(str(self.captures / "one/sound.wav")) as sound:
            self.assertAlmostEqual(sound.getnframes() / sound.getframerate(), len(pictures) / 10, delta=0.11)

    def test_the_first_frame_looks_where_the_player_does(self):
        looks = ["+viewpos", "+wait"] * 6
        said = self.play("+capture_fps", "30", "+capturedemo", "cbox", "first", *looks, "+capturestop")
        self.assertEqual(said.returncode, 0, said.stderr)
        found = [line.split(") ")[1] for line in said.stdout.splitlines() if line.startswith("Viewpos:")]
        self.assertGreater(len(found), 3, said.stdout)
        self.assertEqual(set(found), {"0 90 0"}, "the demo's player stands still, turned by 90 degrees")

    def test_a_film_has_its_frames_and_its_sound(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("no ffmpeg")
        said = self.play("+capture_fps", "20", "+capturedemo", "cbox")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertEqual([p.name for p in self.captures.iterdir()], ["cbox.mp4"])
        probe = ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=codec_type,nb_read_frames,duration", "-of", "csv=p=0",
                 self.captures / "cbox.mp4"]
        streams = dict(line.split(",")[:2] for line in subprocess.run(probe, capture_output=True, text=True, check=True).stdout.split())
        self.assertAlmostEqual(float(streams["video"]), SECONDS, delta=0.1)
        self.assertAlmostEqual(float(streams["audio"]), SECONDS, delta=0.1)

    def test_stopped_it_keeps_what_there_is(self):
        said = self.play("+capture_fps", "10", "+capturedemo", "cbox", "part", "+wait", "+wait", "+wait", "+wait", "+wait", "+wait", "+capturestop")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("frames in", said.stdout)
        count = sum(p.suffix == ".png" for p in (self.captures / "part").iterdir())
        self.assertTrue(0 < count < 10, count)

    def test_what_cannot_be_is_a_sentence_and_leaves_nothing(self):
        said = self.play("+capturedemo", "nosuch", "film")
        self.assertEqual(said.returncode, 1)
        self.assertIn("nothing was saved", said.stderr)
        self.assertEqual(list(self.captures.iterdir()), [])
        (self.captures / "full").mkdir()
        (self.captures / "full/kept").write_text("kept")
        said = self.play("+capturedemo", "cbox", "full")
        self.assertIn("a new folder", said.stderr)
        self.assertEqual([p.name for p in self.captures.iterdir()], ["full"])
        self.assertEqual((self.captures / "full/kept").read_text(), "kept")

    def test_a_full_disk_ends_the_film_and_not_the_game(self):
        # No file may grow beyond 32 KB, which the sound does within a quarter of a second.
        limit = ["sh", "-c", 'ulimit -f 64; exec "$@"', "sh"]
        said = subprocess.run([*limit, *self.command("+capturedemo", "cbox", "film")], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(said.returncode, 1)
        self.assertEqual(said.stderr.count("nothing was saved"), 1, said.stderr)
        self.assertIn("Server disconnected", said.stdout, "the demo was played to its end")
        self.assertEqual(list(self.captures.iterdir()), [])

    def test_killed_there_is_no_film(self):
        running = subprocess.Popen(self.command("+capturedemo", "cbox", "killed", size="640x360"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while not list(self.captures.glob("killed.part/*.png")) and time.monotonic() < until:
            time.sleep(0.02)
        running.send_signal(signal.SIGKILL)
        running.wait()
        self.assertTrue((self.captures / "killed.part").exists())
        self.assertFalse((self.captures / "killed").exists())


if __name__ == "__main__":
    need(BUILD, base_game=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
