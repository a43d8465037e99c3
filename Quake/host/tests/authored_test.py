#!/usr/bin/env python3
"""What `fullbright-lab authored` takes for the author's picture, and the view `r_debug authored`, held to a screenshot of quakespasm from the same place:
authored_test.py BUILD_DIR. LibreQuake's `start`, from where a player starts. Skipped, saying so, without quakespasm and Xvfb,
LibreQuake, the base game (whose code both play) or a Vulkan device."""

import math
import os
import pathlib
import pwd
import shutil
import subprocess
import sys
import tempfile
import unittest

from pictures import read_png, read_tga
from programs_needed import librequake, need

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
SKIPPED = 77
MAP, CAMERA = "start", "info_player_start_1"
ACROSS, DOWN = 16, 9  # blocks
BLACK = 5e-4          # as lab/authored/authored_measure.cpp has it
# Frames until the console has gone up.
SHOT = """alias w4 "wait;wait;wait;wait"
alias w20 "w4;w4;w4;w4;w4"
alias w100 "w20;w20;w20;w20;w20"
w100
w100
screenshot tga
wait
quit
"""
# Light does not flicker: the screenshot is of whatever moment the machine got to.
SETTINGS = """crosshair 0
r_flatlightstyles 1
r_drawviewmodel 0
viewsize 130
fov 90
fov_adapt 0
gamma 1
contrast 1
r_particles 0
cl_bob 0
v_idlescale 0
gl_polyblend 0
"""


def linear(byte):
    value = byte / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


LINEAR = [linear(byte) for byte in range(256)]


def luminances(width, rows):
    """Mean luminance of each block of a picture that starts at the rows' first byte."""
    found = []
    height = len(rows)
    for y in range(DOWN):
        for x in range(ACROSS):
            total, count = 0.0, 0
            for row in rows[y * height // DOWN : (y + 1) * height // DOWN]:
                for i in range(x * width // ACROSS, (x + 1) * width // ACROSS):
                    total += 0.2126 * LINEAR[row[3 * i]] + 0.7152 * LINEAR[row[3 * i + 1]] + 0.0722 * LINEAR[row[3 * i + 2]]
                    count += 1
            found.append(total / count)
    return found


class Authored(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "id1").mkdir()
        data, _ = librequake()
        for pak in (data / "id1").glob("*.pak"):
            (self.folder / "id1" / pak.name).symlink_to(pak)
        shutil.copy(BUILD / "game/id1/progs.dat", self.folder / "id1")

    def screenshot(self):
        game = self.folder.name  # quakespasm writes below the user's own home, whatever HOME says
        (self.folder / game).mkdir()
        (self.folder / game / "autoexec.cfg").write_text(SETTINGS)
        (self.folder / game / "shot.cfg").write_text(SHOT)
        written = pathlib.Path(pwd.getpwuid(os.getuid()).pw_dir) / ".quakespasm" / game
        self.addCleanup(shutil.rmtree, written, ignore_errors=True)
        environment = {**os.environ, "SDL_AUDIODRIVER": "dummy", "PATH": os.environ["PATH"] + ":/usr/games"}
        done = subprocess.run(["xvfb-run", "--auto-servernum", "--server-args=-screen 0 640x480x24", "quakespasm", "-basedir", self.folder,
                               "-game", game, "-window", "-width", "640", "-height", "360", "-nosound", "+skill", "1", "+map", MAP,
                               "+exec", "shot.cfg"], capture_output=True, text=True, errors="replace", timeout=240, env=environment, check=False)
        found = [*written.glob("*.tga"), *(self.folder / game).glob("*.tga")]
        self.assertEqual(len(found), 1, done.stdout[-2000:] + done.stderr[-1000:])
        return read_tga(found[0])

    def hold(self, what, own, theirs, half, three_of_four):
        off = sorted(abs(math.log2((a + BLACK) / (b + BLACK))) for a, b in zip(own, theirs))
        print(what, "stops off: median", *(round(off[int(len(off) * part)], 3) for part in (0.5, 0.75, 0.9)), "(half, three of four, nine of ten)")
        self.assertLess(off[len(off) // 2], half)
        self.assertLess(off[len(off) * 3 // 4], three_of_four)

    def lab(self, *arguments):
        done = subprocess.run([BUILD / "fullbright-lab", *arguments, "--basedir", self.folder, "--map", MAP], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_both_pictures_are_quakespasms(self):
        width, _, rows = self.screenshot()
        theirs = luminances(width, rows)
        self.assertGreater(max(theirs) / min(theirs), 8, "a picture with light and dark")
        # What differs are torches, which the author's picture leaves out, and what moves in teleporters.
        self.lab("authored", "--cameras", "100", "--spp", "1", "--out", self.folder / "out")
        width, _, rows = read_png(self.folder / "out" / f"{CAMERA}.png")
        self.hold("the host's picture:", luminances(width // 2, [row[3 * (width // 2) :] for row in rows]), theirs, 0.1, 0.25)
        self.lab("render", "--estimator", "pt", "--set", "r_debug=authored", "--set", "fov=90", "--set", "fov_adapt=0", "--size", "640x360", "--frames", "1:1",
                 "--out", self.folder / "view")
        width, _, rows = read_png(next((self.folder / "view").glob("*.png")))
        self.hold("the view:", luminances(width, rows), theirs, 0.1, 0.25)


if __name__ == "__main__":
    need(BUILD, base_game=True)
    lacks = librequake()[1]
    if not lacks and not (shutil.which("quakespasm", path=os.environ["PATH"] + ":/usr/games") and shutil.which("Xvfb")):
        lacks = "quakespasm or Xvfb is not installed (Linux/install-deps.sh test)"
    if lacks:
        print(f"skipped: {lacks}")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
