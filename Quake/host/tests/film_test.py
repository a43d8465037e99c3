#!/usr/bin/env python3
"""`fullbright-lab film`: film_test.py BUILD_DIR. Films of a few frames at 64x36, of scenes in code and of a demo of the
base game. Skipped, saying so, without a Vulkan device; what needs ffmpeg or the base game is skipped by itself."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from pictures import read_png, write_png
from programs_needed import need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
SPEC = {"scene": "kinds", "frames": [0, 2], "fps": 25, "size": [64, 36], "set": {"r_bounces": 0},
        "lanes": [{"name": "pt"}, {"name": "nee", "set": {"r_estimator": "nee"}}]}


class Film(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def command(self, spec, out, *options):
        text = spec if isinstance(spec, str) else json.dumps(spec, indent=1)
        (self.folder / "spec.json").write_text(text)
        return [BUILD / "fullbright-lab", "film", self.folder / "spec.json", "--quiet", "--out", self.folder / out, *options]

    def film(self, spec, out, *options, **how):
        return subprocess.run(self.command(spec, out, *options), capture_output=True, text=True, timeout=120, check=False, **how)

    def captured(self, name, color, count=3, width=64):
        (self.folder / name).mkdir()
        for i in range(count):
            write_png(self.folder / name / f"f{i}.png", width, 36, color)
        return {"name": name, "pictures": name}

    def test_captured_pictures_stand_where_their_lanes_are(self):
        lanes = [self.captured("red", (200, 0, 0)), self.captured("green", (0, 150, 0))]
        view = {"frames": [0, 2], "size": [64, 36], "lanes": lanes}
        said = self.film(view, "wipe")
        self.assertEqual(said.returncode, 0, said.stderr)
        width, height, rows = read_png(self.folder / "wipe/frame_000002.png")
        self.assertEqual((width, height, len(list((self.folder / "wipe").iterdir()))), (64, 36, 3))
        last = rows[35]
        self.assertEqual(last[: 3 * 31], bytes((200, 0, 0)) * 31)
        self.assertEqual(last[3 * 31 : 3 * 33], b"\xff" * 6, "the line")
        self.assertEqual(last[3 * 33 :], bytes((0, 150, 0)) * 31)
        self.assertNotEqual(rows[7][: 3 * 31], last[: 3 * 31], "the caption")
        self.assertEqual(self.film({**view, "layout": "side"}, "side").returncode, 0)
        width, _, rows = read_png(self.folder / "side/frame_000000.png")
        self.assertEqual((width, rows[35]), (130, bytes((200, 0, 0)) * 64 + bytes(6) + bytes((0, 150, 0)) * 64))

    def test_a_rendered_film_shows_the_lanes_own_pictures(self):
        own = {**SPEC, "exposure": "own"}
        self.assertEqual(self.film({**own, "layout": "side", "reference_samples": 4}, "f", "--validation").returncode, 0)
        width, _, both = read_png(self.folder / "f/frame_000002.png")
        self.assertEqual(width, 130)
        # Below the captions a lane alone has the same picture as beside the other.
        self.assertEqual(self.film({**own, "lanes": SPEC["lanes"][1:]}, "alone").returncode, 0)
        _, _, alone = read_png(self.folder / "alone/frame_000002.png")
        self.assertEqual([row[3 * 66 :] for row in both[34:]], alone[34:])

    def test_lanes_have_the_exposure_of_the_first(self):
        dim = {"name": "dim", "set": {"r_emit_fullbright": 0.6, "r_emit_lava": 0.8, "r_emit_slime": 0.1, "r_emit_teleport": 0.4, "r_emit_sky": 0.1,
                                       "r_emit_sprite": 0.8, "r_emit_particle": 0.1, "r_emit_dlight": 0.1, "r_emit_sun": 0.1}}
        means = []
        for name, more in (("first", {}), ("own", {"exposure": "own"})):
            view = {**SPEC, "size": [64, 72], "set": {"r_bounces": 1, "r_estimator": "pt"}, "lanes": [{"name": "bright"}, dim], "layout": "side", **more}
            said = self.film(view, name)
            self.assertEqual(said.returncode, 0, said.stderr)
            _, _, rows = read_png(self.folder / name / "frame_000002.png")
            means.append([sum(sum(row[3 * at : 3 * (at + 64)]) for row in rows[34:]) for at in (0, 66)])  # below the captions
        (bright, dim_too), (own_bright, own_dim) = means
        self.assertEqual(bright, own_bright)
        self.assertLess(dim_too, 0.7 * own_dim, "a tenth of the light is shown as such")

    def test_ffmpeg_makes_a_stream_of_the_right_size_length_and_sound(self):
        if not shutil.which("ffprobe"):
            self.skipTest("ffmpeg is not installed")
        spec, options = SPEC, []
        if (BUILD / "game/id1/progs.dat").exists():
            spec, options = {**SPEC, "demo": "plain", "frames": [5, 14]}, ["--basedir", BUILD / "game"]
            del spec["scene"]
        said = self.film(spec, "f.mp4", *options)
        self.assertEqual(said.returncode, 0, said.stderr)
        probed = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-of", "json", "-show_streams", self.folder / "f.mp4"],
                                capture_output=True, text=True, check=True)
        streams = {s["codec_type"]: s for s in json.loads(probed.stdout)["streams"]}
        frames = spec["frames"][1] - spec["frames"][0] + 1
        video = streams["video"]
        self.assertEqual((video["width"], video["height"], int(video["nb_read_frames"])), (64, 36, frames))
        self.assertAlmostEqual(float(video["duration"]), frames / 25, places=3)
        if options:
            self.assertAlmostEqual(float(streams["audio"]["duration"]), frames / 25, delta=0.03)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["f.mp4", "spec.json"])

    def test_without_ffmpeg_frames_are_pictures_and_a_sentence_says_so(self):
        said = self.film(SPEC, "f.mp4", env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("ffmpeg is not here", said.stdout)
        self.assertEqual(len(list((self.folder / "f").glob("*.png"))), 3)

    def test_a_film_zooms_and_its_line_sweeps(self):
        lanes = [self.captured("red", (200, 0, 0), count=9), self.captured("green", (0, 150, 0), count=9)]
        film = {"frames": [0, 8], "fps": 8, "size": [64, 36], "lanes": lanes}
        self.assertEqual(self.film({**film, "sweep": 1}, "sweep").returncode, 0)
        at = [read_png(self.folder / f"sweep/frame_{i:06}.png")[2][35].count(b"\xc8\0\0") for i in range(9)]
        self.assertEqual(max(at), at[2])
        self.assertEqual(min(at), at[6])
        self.assertTrue(at[6] < 20 < 42 < at[2] and abs(at[0] - at[8]) <= 1, at)
        # A picture whose right half is green: what is zoomed in is green alone.
        (self.folder / "halves").mkdir()
        self.assertEqual(self.film({**film, "frames": [0, 2]}, "f").returncode, 0)
        for i in range(3):
            shutil.copy(self.folder / f"f/frame_{i:06}.png", self.folder / f"halves/{i}.png")
        said = self.film({**film, "frames": [0, 2], "lanes": [{"name": "halves", "pictures": "halves"}],
                          "zoom": {"to": [40, 20, 16, 9], "frames": [0, 2]}}, "zoom")
        self.assertEqual(said.returncode, 0, said.stderr)
        first, middle, last = (read_png(self.folder / f"zoom/frame_{i:06}.png")[2][35] for i in range(3))
        self.assertTrue(first.count(b"\0\x96\0") < middle.count(b"\0\x96\0") < 64, "on the way")
        self.assertEqual(last, b"\0\x96\0" * 64)

    def test_frames_can_be_linear(self):
        film = {"frames": [0, 0], "size": [64, 36], "format": "exr"}
        for name, color in (("grey", (188, 188, 188)), ("black", (0, 0, 0))):
            said = self.film({**film, "lanes": [{**self.captured(name, color, count=1), "name": "-"}]}, f"{name} film")
            self.assertEqual(said.returncode, 0, said.stderr)
        said = subprocess.run([BUILD / "fullbright-lab", "compare", self.folder / "black film/frame_000000.exr", self.folder / "grey film/frame_000000.exr", "--json", "-"],
                              capture_output=True, text=True, check=True)
        # 188 of 255 is 0.5 of the light; the caption, the same in both, covers some of it.
        self.assertTrue(0.2 < json.loads(said.stdout)["files"][0]["mse"] <= 0.2504, said.stdout)

    def test_lanes_of_equal_time_take_samples_until_they_last_as_long(self):
        few = {"name": "long", "set": {"r_spp": 8, "r_estimator": "nee", "r_bounces": 3}}
        for equal in ("samples", "time"):
            short = {"name": "short", "set": {"r_estimator": "pt"}}
            command = self.command({**SPEC, "scene": "cbox", "size": [160, 90], "equal": equal, "lanes": [few, short]}, equal)
            command.remove("--quiet")
            said = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual(said.returncode, 0, said.stderr)
            samples = dict(re.findall(r"^(\w+): (\d+) samples a pixel", said.stdout, re.M))
            self.assertEqual(samples["long"], "8")
            if equal == "samples":
                self.assertEqual(samples["short"], "1")
            else:
                self.assertGreater(int(samples["short"]), 8, "a path without reflections is shorter")

    def test_guided_lanes_are_those_that_name_no_estimator(self):
        timed = {**SPEC, "equal": "time"}
        said = self.film(timed, "timed", "--guided")
        self.assertEqual(said.returncode, 1)
        self.assertIn('pt: "equal": "time": frames of mir_nee are of one picture, whose time grows', said.stderr)
        still = {**SPEC, "scene": "cbox", "set": {"r_bounces": 2}, "exposure": "own"}
        pictures = {}
        for out, lane, options in (("plain", 0, ()), ("guided", 0, ("--guided",)), ("named", 1, ()), ("kept", 1, ("--guided",))):
            said = self.film({**still, "lanes": [SPEC["lanes"][lane]]}, out, *options)
            self.assertEqual(said.returncode, 0, said.stderr)
            pictures[out] = read_png(self.folder / out / "frame_000002.png")[2][34:]
        self.assertNotEqual(pictures["guided"], pictures["plain"])
        self.assertEqual(pictures["kept"], pictures["named"])

    def test_what_is_wrong_is_named_with_its_line(self):
        self.captured("few", (1, 2, 3), count=2)
        self.captured("small", (1, 2, 3), width=32)
        for change, words in (({"lains": []}, '"lains"'), ({"layout": "left"}, '"wipe" or "side"'), ({"frames": [3, 1]}, "before the first"),
                              ({"zoom": {"to": [0, 0, 99, 36]}}, "not within 64x36"), ({"lanes": [{"name": "a", "sett": {}}]}, '"sett"'),
                              ({"lanes": [{"name": "a", "set": {"r_bonces": 1}}]}, "r_bonces"),
                              ({"lanes": [{"name": "few", "pictures": "few"}]}, "2 PNG files"),
                              ({"lanes": [{"name": "small", "pictures": "small"}]}, "32x36"),
                              ({"lanes": [{"name": "none", "pictures": "none"}]}, "No such file")):
            said = self.film({**SPEC, **change}, "f")
            self.assertEqual(said.returncode, 1, words)
            self.assertIn(words, said.stderr)
            self.assertEqual(said.stderr.strip().count("\n"), 0, said.stderr)
            self.assertFalse((self.folder / "f").exists())
        self.assertIn("line 3", self.film('{"frames": [0, 1],\n "lanes": [{"name": "a"}],\n "lains": 1\n}', "f").stderr)
        (self.folder / "full").mkdir()
        (self.folder / "full/kept").write_text("kept")
        self.assertIn("a new folder", self.film(SPEC, "full").stderr)
        self.assertEqual((self.folder / "full/kept").read_text(), "kept")

    def test_killed_or_out_of_space_there_is_no_film(self):
        for out in ["f"] + (["f.mp4"] if shutil.which("ffmpeg") else []):
            running = subprocess.Popen(self.command({**SPEC, "frames": [0, 5000]}, out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            until = time.monotonic() + 60
            while not (self.folder / f"{out}.part").exists() and time.monotonic() < until:
                time.sleep(0.02)
            time.sleep(0.2)
            running.send_signal(signal.SIGKILL)
            running.wait()
            self.assertFalse((self.folder / out).exists())
            # A file may not grow beyond a kilobyte: as a full disk.
            limit = ["sh", "-c", 'ulimit -f 2; exec "$@"', "sh"]
            said = subprocess.run([*limit, *self.command({**SPEC, "size": [640, 360]}, out)], capture_output=True, text=True, timeout=120, check=False)
            self.assertNotEqual(said.returncode, 0)
            self.assertFalse((self.folder / out).exists())


if __name__ == "__main__":
    need(BUILD)
    unittest.main(argv=sys.argv[:1], verbosity=2)
