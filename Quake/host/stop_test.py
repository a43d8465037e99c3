#!/usr/bin/env python3
"""Both programs are told to end: stop_test.py BUILD_DIR. Whatever they do, SIGTERM and SIGINT end them within two seconds
(a frame that takes minutes: within the grace period), by that signal and with one sentence; a recording is whole, nothing
half done has its final name, and nothing further is executed. At a window SIGTERM is `quit`. What needs game data, a
compiler of QuakeC, a Vulkan device or a display is skipped, saying so."""
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from network_game_test import SKIPPED, Program, compile_rules
from programs_needed import librequake

AT_ONCE, GRACE = 2.0, 5.0  # seconds; the second is base/stop.h's
SLOW = float(os.environ.get("FULLBRIGHT_TEST_SLOWNESS", "1"))  # where other tests run beside, or the build is sanitized


class Case:
    def __init__(self, build, name, program, *arguments):
        print(f"- {name}", flush=True)
        self.name = name
        self.running = Program(name, [build / program, *arguments])

    def wait_for(self, pattern, seconds=60):
        return self.running.wait_for(pattern, seconds * SLOW)

    def wait_for_file(self, path, seconds=60):
        """A frame's picture, say: by then its shaders are compiled, which no signal cuts short."""
        until = time.monotonic() + seconds * SLOW
        while not path.exists():
            assert time.monotonic() < until and self.is_running(), f"{self.name}: there is no {path.name}"
            time.sleep(0.1)

    def tell(self, number, seconds=AT_ONCE):
        """Sends the signal; the exit status, which comes in time."""
        start = time.monotonic()
        self.running.process.send_signal(number)
        try:
            status = self.running.process.wait(seconds * SLOW)
        except subprocess.TimeoutExpired:
            self.running.process.kill()
            raise AssertionError(f"{self.name}: {number.name} was not obeyed within {seconds * SLOW:.0f} s")
        print(f"  {number.name}: {time.monotonic() - start:.2f} s", flush=True)
        time.sleep(0.1)
        self.running.catch_up()
        return status

    def is_stopped_by(self, number, seconds=AT_ONCE, program="fullbright", before_grace=False):
        start = time.monotonic()
        status = self.tell(number, seconds)
        assert not before_grace or time.monotonic() - start < GRACE - 1, f"{self.name}: ended by the grace period"
        assert status == -number, f"{self.name}: status {status}\n" + "\n".join(self.running.lines[-20:])
        sentences = [line for line in self.running.lines if "stopped by" in line]
        assert sentences == [f"{program}: stopped by {number.name}"], sentences
        assert "behind" not in self.running.lines, "what stood behind was executed"

    def is_running(self):
        return self.running.process.poll() is None


def servers(build, game):
    def dedicated(name, *arguments):
        port = str(random.randint(20000, 60000))
        return Case(build, name, "fullbright", "-dedicated", "1", "-port", port, "-seed", "1", *game, *arguments)

    run = dedicated("sv_run", "+map", "start", "+sv_run", "1e6", "+echo", "behind", "+quit")
    run.wait_for("^Server spawned")
    line = run.wait_for("^sv_run", 30)
    assert re.fullmatch(r"sv_run, second of the game: \d+ of 1000000, \d+ s left", line), line
    run.is_stopped_by(signal.SIGTERM, before_grace=True)
    run = dedicated("sv_run of tiny frames", "+host_framerate", "0.00000001", "+map", "start", "+sv_run", "1e6", "+echo", "behind")
    run.wait_for("^host_framerate: 0.00000001 is not allowed .*so it is 0.0001 now")
    run.wait_for("^Server spawned")
    run.is_stopped_by(signal.SIGINT, before_grace=True)
    idle = dedicated("a server that waits", "+map", "start")
    idle.wait_for("^Server spawned")
    idle.is_stopped_by(signal.SIGTERM)


def games(build, game, folder):
    def headless(name, *arguments):
        return Case(build, name, "fullbright", "-headless", "-seed", "1", *game, *arguments)

    record = headless("a recording", "-size", "16x16", "-capture", folder / "recorded", "+r_bounces", "0", "+record", "cut", "start")
    record.wait_for("^recording to")
    record.wait_for_file(folder / "recorded" / "frame_000001.png")
    record.is_stopped_by(signal.SIGTERM)
    demo = folder / "id1" / "cut.dem"
    assert demo.exists() and not demo.with_suffix(".dem.part").exists(), "the recording is not whole"
    assert demo.read_bytes().endswith(b"\x02"), "the recording does not end as one does"

    timed = headless("timedemo", "-size", "64x36", "-capture", folder / "frames", "+timedemo", "demo1", "+echo", "behind")
    timed.wait_for("^Playing demo")
    time.sleep(1)
    timed.is_stopped_by(signal.SIGINT)
    assert not [path for path in (folder / "frames").iterdir() if path.suffix != ".png"], "half a picture is left"

    for name, tell in (("a frame of minutes", 1), ("a frame of minutes, told twice", 2)):
        frame = headless(name, "-size", "1280x720", "+r_spp", "4096", "+timedemo", "demo1")
        frame.wait_for("^Playing demo")
        time.sleep(6)  # shaders are compiled, and the first frame is begun
        if tell == 2:
            frame.running.process.send_signal(signal.SIGTERM)
            time.sleep(0.5)
            assert frame.is_running(), "the frame was too short to test this"
        frame.is_stopped_by(signal.SIGTERM, AT_ONCE if tell == 2 else GRACE + AT_ONCE)


def laboratory(build, folder):
    scene = ["--scene", "cbox", "--size", "320x180"]
    commands = {
        "render": [*scene, "--spp", "64", "--frames", "0:100000", "--out", folder / "rendered"],
        "reference": [*scene, "--spp", "16777216", "--out", folder / "reference.exr"],
        "bench": [*scene, "--frames", "0:1000000", "--reference-spp", "32", "--json", folder / "bench.json"],
        "picture": ["testdemos/suites/picture_free.json", "--views", "cbox", "--reference-spp", "16777216", "--references", folder / "kept"],
        "ztest": [*scene, "--estimator", "pt", "--runs", "100000"],
    }
    for name, arguments in commands.items():
        case = Case(build, "fullbright-lab " + name, "fullbright-lab", name, *arguments)
        time.sleep(3)
        assert case.is_running(), "\n".join(case.running.lines)
        case.is_stopped_by(signal.SIGTERM if name != "bench" else signal.SIGINT, program="fullbright-lab")
    assert not list((folder / "kept").glob("*"))
    assert not (folder / "reference.exr").exists() and not (folder / "bench.json").exists()
    assert all(path.stat().st_size > 0 for path in (folder / "rendered").glob("*.png"))


def window(build, game, folder):
    config = folder / "id1" / "config.cfg"

    def quits(case):
        config.unlink(missing_ok=True)
        status = case.tell(signal.SIGTERM)
        assert status == 0, f"status {status}\n" + "\n".join(case.running.lines[-20:])
        assert config.exists(), "quit writes config.cfg"

    case = Case(build, "a game in a window", "fullbright", "-size", "320x180", "-capture", folder / "shown", *game, "+map", "start")
    case.wait_for_file(folder / "shown" / "frame_000001.png")
    quits(case)
    # What is not recorded begins with a smaller shader; the whole one is compiled beside it, as the cache is empty.
    os.environ["MESA_SHADER_CACHE_DIR"] = str(folder / "shaders")
    case = Case(build, "a game that still compiles", "fullbright", "-size", "320x180", *game, "+host_speeds", "1", "+map", "start")
    case.wait_for("input to picture")
    quits(case)
    del os.environ["MESA_SHADER_CACHE_DIR"]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    data, lacks = librequake()
    skipped = []
    device = subprocess.run([build / "fullbright", "-listdevices"], capture_output=True).returncode == 0
    lacks = lacks or (None if shutil.which("fteqcc") else "fteqcc is not installed (Linux/install-deps.sh test)")
    has_game = not lacks
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        game = ["-basedir", data, "-userdir", folder]
        if has_game:
            (folder / "id1").mkdir()
            compile_rules("testdemos/rules", folder / "id1" / "progs.dat")
            servers(build, game)
        else:
            skipped.append(lacks)
        if device:
            laboratory(build, folder)
        else:
            skipped.append("no Vulkan device")
        if device and has_game:
            games(build, game, folder)
        if device and has_game and os.environ.get("DISPLAY"):
            window(build, game, folder)
        elif device and has_game:
            skipped.append("no display, which a window needs (Linux/install-deps.sh test)")
    print(*(f"skipped: {why}" for why in skipped), sep="\n")
    return 0 if has_game or device else SKIPPED


if __name__ == "__main__":
    sys.exit(main())
