#!/usr/bin/env python3
"""Both programs are told to end: stop_test.py BUILD_DIR. Whatever they do, SIGTERM, SIGINT and a terminal that closes end
them within two seconds (a frame that takes minutes: within the grace period), by that signal and with one sentence; a
recording is whole, nothing half done has its final name, and nothing further is executed. At a window SIGTERM is `quit`.
A log that nobody reads any more and a file that may not grow end nothing. What needs game data, a compiler of QuakeC, a
Vulkan device or a display is skipped, saying so."""
import os
import pathlib
import random
import pty
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import wave

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


class AtTerminal:
    """A program in a session of its own, at a terminal that this is the other end of."""

    def __init__(self, name, command):
        print(f"- {name}", flush=True)
        self.name, self.said = name, ""
        self.end, inner = pty.openpty()
        self.process = subprocess.Popen(["setsid", "--ctty", *command], stdin=inner, stdout=inner, stderr=inner)
        os.close(inner)

    def wait_for(self, pattern, seconds=60):
        until = time.monotonic() + seconds * SLOW
        while not (found := re.search(pattern, self.said)):
            assert time.monotonic() < until, f"{self.name} did not say {pattern!r}:\n{self.said}"
            if select.select([self.end], [], [], 0.1)[0]:
                self.said += os.read(self.end, 4096).decode(errors="replace")
        return found

    def close(self):
        """The status; the program ends in time."""
        os.close(self.end)
        return self.process.wait(AT_ONCE * SLOW)


def is_whole(demo):
    assert demo.exists() and not demo.with_suffix(".dem.part").exists(), "the recording is not whole"
    assert demo.read_bytes().endswith(b"\x02"), "the recording does not end as one does"


def servers(build, game, folder):
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
    ignored = re.search(r"^SigIgn:\s*(\w+)", pathlib.Path(f"/proc/{idle.running.process.pid}/status").read_text(), re.M)[1]
    assert int(ignored, 16) == 0, f"a program that a test starts ignores signals: {ignored}"
    idle.is_stopped_by(signal.SIGTERM)
    idle = dedicated("a server whose terminal hangs up", "+map", "start")
    idle.wait_for("^Server spawned")
    idle.is_stopped_by(signal.SIGHUP)

    unread = dedicated("a server whose log reader ends", "+map", "start")
    unread.wait_for("^Server spawned")
    unread.running.stop_reading()
    unread.running.say("echo who hears\n" * 100 + "seta zzz_unread 1\nwriteconfig unread")
    unread.wait_for_file(folder / "id1" / "unread.cfg", 10)
    unread.running.say("quit")
    assert unread.running.process.wait(AT_ONCE * SLOW) == 0
    assert "zzz_unread" in (folder / "id1" / "unread.cfg").read_text()

    if not shutil.which("setsid"):
        return print("skipped: terminals, for want of setsid")
    options = [build / "fullbright", "-dedicated", "1", "-nolan", *game, "+map", "start"]
    closed = AtTerminal("a server at a terminal that closes", options)
    closed.wait_for("Server spawned")
    assert closed.close() == -signal.SIGHUP
    # What is typed is the shell's.
    behind = AtTerminal("a server in the background of a shell", ["sh", "-m", "-c", '"$@" & echo "job $!."; wait', "sh", *options])
    job = int(behind.wait_for(r"job (\d+)\.")[1])
    behind.wait_for("Server spawned")
    os.write(behind.end, b"quit\n")
    time.sleep(1)
    state = pathlib.Path(f"/proc/{job}/stat").read_text().rpartition(") ")[2][0]
    assert state in "RSD", f"the server is in state {state}"
    os.kill(job, signal.SIGTERM)
    behind.wait_for("stopped by SIGTERM", AT_ONCE)
    behind.close()


def games(build, game, folder):
    def headless(name, *arguments):
        return Case(build, name, "fullbright", "-headless", "-seed", "1", *game, *arguments)

    small = ["-size", "16x16", "+r_bounces", "0"]
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
        name = number.name.lower()
        record = headless(f"a recording, {number.name}", *small, "-capture", folder / name, "-wavcapture", folder / f"{name}.wav", "+record", name, "start")
        record.wait_for("^recording to")
        record.wait_for_file(folder / name / "frame_000001.png")
        record.is_stopped_by(number)
        is_whole(folder / "id1" / f"{name}.dem")
        with wave.open(str(folder / f"{name}.wav")) as sound:
            assert sound.getnframes() > 0 and not (folder / f"{name}.wav.part").exists(), "the sound is not whole"
    if shutil.which("setsid"):
        record = AtTerminal("a recording at a terminal that closes", [build / "fullbright", "-headless", "-seed", "1", *game, *small,
                                                                     "+record", "closed", "start", "+wait", "+wait", "+echo", "is recorded"])
        record.wait_for(r"(?s)recording to.*is recorded")
        assert record.close() == -signal.SIGHUP
        is_whole(folder / "id1" / "closed.dem")
    limited = headless("a recording whose file may not grow", *small, "+record", "limited", "start", "+wait", "+wait", "+echo", "is recorded")
    limited.wait_for("^recording to")
    limited.wait_for("^is recorded")
    most = (folder / "id1" / "limited.dem.part").stat().st_size + 10000
    resource.prlimit(limited.running.process.pid, resource.RLIMIT_FSIZE, (most, most))
    limited.wait_for("cannot be written: File too large; the recording ends here, as .*limited.dem")
    is_whole(folder / "id1" / "limited.dem")
    limited.is_stopped_by(signal.SIGTERM)

    timed = headless("timedemo", "-size", "64x36", "-capture", folder / "frames", "+timedemo", "demo1", "+echo", "behind")
    timed.wait_for("^Playing demo")
    time.sleep(1)
    timed.is_stopped_by(signal.SIGINT)
    assert not [path for path in (folder / "frames").iterdir() if path.suffix != ".png"], "half a picture is left"

    def long_frame(name, seconds):
        frame = headless(name, "-size", "1280x720", "+r_spp", "4096", "+timedemo", "demo1")
        frame.wait_for("^Playing demo")
        time.sleep(seconds)  # shaders are compiled, and the first frame is begun
        return frame

    long_frame("a frame of minutes", 6).is_stopped_by(signal.SIGTERM, GRACE + AT_ONCE)
    for seconds in (6, 20, 60):  # while shaders are compiled the first signal ends it, and this is no test of the second
        frame = long_frame("a frame of minutes, told twice", seconds)
        frame.running.process.send_signal(signal.SIGTERM)
        time.sleep(0.5)
        if frame.is_running():
            break
    assert frame.is_running(), "no frame was long enough to test this"
    frame.is_stopped_by(signal.SIGTERM, AT_ONCE)


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
    # With an empty cache the first picture waits for shaders. What is not recorded begins with smaller ones; the whole ones are
    # compiled beside them, and what the second frame asks for besides is waited for again.
    shown = [*game, "+host_speeds", "1", "+map", "start"]
    for name, line, seconds in (("a game that waits for its first shaders", "^path guiding", 0.5),
                                ("a game that still compiles", "input to picture", 0.0),
                                ("a game that waits for its second shaders", "input to picture", 0.1)):
        os.environ["MESA_SHADER_CACHE_DIR"] = str(folder / name)
        case = Case(build, name, "fullbright", "-size", "320x180", *shown)
        case.wait_for(line)
        time.sleep(seconds)
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
            servers(build, game, folder)
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
