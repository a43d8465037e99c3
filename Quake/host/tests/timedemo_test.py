#!/usr/bin/env python3
"""timedemo's counts held to QuakeSpasm's: timedemo_test.py BUILD_DIR. Records demos by script in the base game's rooms,
with changes of level, a restart, and from the midst of a game, in all three protocols; cuts and joins more from them; and
plays each here and, where it is installed (with Xvfb), in quakespasm: both must count the same, and what stands here.
Skipped, saying so, without the base game or a Vulkan device."""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time

from programs_needed import librequake

SKIPPED = 77
SECONDS = 240  # no run takes that long
MAP, OTHER = "lab_cbox", "lab_plain"
WAITS = 'alias w4 "wait;wait;wait;wait"\nalias w20 "w4;w4;w4;w4;w4"\n'
# What is recorded: the protocol, the commands before the script, the script.
RECORDED = {
    "two15": (15, f"record two15 {MAP}", f"w20\nchangelevel {OTHER}\nw20\nchangelevel {MAP}\nw20\nstop\nquit\n"),
    "two999": (999, f"record two999 {MAP}", f"w20\nchangelevel {OTHER}\nw20\nchangelevel {MAP}\nw20\nstop\nquit\n"),
    "restart": (666, f"record restart {MAP}", "w20\nrestart\nw20\nstop\nquit\n"),
    "late": (666, f"map {MAP}", f"w20\nrecord late\nw20\nchangelevel {OTHER}\nw20\nstop\nquit\n"),
}
# What quakespasm 0.95.1 counts in them, and in those that joined() makes.
COUNTS = {"two15": 49, "two999": 49, "restart": 32, "late": 35, "silent": 31, "middle": 10, "endless": 15, "intermission": 27}
SVC_DISCONNECT, SVC_STUFFTEXT, SVC_INTERMISSION, SVC_FINALE = 2, 9, 30, 31


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def messages_of(demo):
    """A demo's messages, each with its angles."""
    messages, at = [], demo.index(b"\n") + 1
    while at < len(demo):
        (size,) = struct.unpack_from("<i", demo, at)
        messages.append((demo[at + 4 : at + 16], demo[at + 16 : at + 16 + size]))
        at += 16 + size
    return messages


def demo_of(messages):
    return b"-1\n" + b"".join(struct.pack("<i", len(data)) + angles + data for angles, data in messages)


def joined(recorded):
    """More demos, by cutting and joining the recorded ones."""

    def message(data):
        return (struct.pack("<3f", 0, 0, 0), data)

    end = message(bytes([SVC_DISCONNECT]))
    announcement = bytes([SVC_STUFFTEXT]) + b"reconnect\n\0"
    level = messages_of(recorded["restart"])
    begin = [i for i, (_, data) in enumerate(level) if announcement in data][0]
    first, second = level[:begin], [m for m in level[begin:] if m[1] != announcement]
    middle = len(first) - 5
    return {
        "silent": demo_of(first + second),  # a change that nothing announces
        "middle": demo_of(first[:middle] + [end] + first[middle:]),
        "endless": demo_of(first),
        "intermission": demo_of(first + [message(bytes([SVC_INTERMISSION]))] + first[middle:] +
                                [message(bytes([SVC_FINALE]) + b"The end\0")] + first[middle:] + [end]),
    }


class Ours:
    def __init__(self, build, folder):
        self.command = [build / "fullbright", "-headless", "-size", "16x9", "-seed", "1", "-basedir", build / "game",
                        "-userdir", folder, "+r_estimator", "pt", "+r_bounces", "0", "+host_framerate", "0.1"]

    def run(self, *commands):
        return subprocess.run([*self.command, *commands], capture_output=True, text=True, timeout=SECONDS, check=False)

    def record(self, name, protocol, first, script, folder):
        (folder / "id1" / f"{name}.cfg").write_text(WAITS + script)
        said = self.run("+sv_protocol", str(protocol), f"+{first}", "+exec", f"{name}.cfg")
        demo = folder / "id1" / f"{name}.dem"
        if said.returncode != 0 or not demo.exists():
            raise AssertionError(f"{name}: not recorded\n{(said.stdout + said.stderr)[-3000:]}")
        return demo.read_bytes()

    def count(self, name):
        said = self.run("+timedemo", name, "+quit")
        found = re.search(r"^(\d+) frames .* fps$", said.stdout, re.M)
        if said.returncode != 0 or not found:
            raise AssertionError(f"{name}: not played\n{(said.stdout + said.stderr)[-3000:]}")
        return int(found[1])


class QuakeSpasm:
    """Debian's, under a display of its own, with LibreQuake's paks (it wants a colormap) over the base game."""

    def __init__(self, build, data, folder):
        self.folder = folder / "theirs"
        (self.folder / "id1").mkdir(parents=True)
        for entry in [*(build / "game/id1").iterdir(), *(data / "id1").glob("*.pak")]:
            (self.folder / "id1" / entry.name).symlink_to(entry.resolve())
        read, write = os.pipe()
        self.display = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "640x480x24"],
                                        pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.number = number.readline().strip()

    @staticmethod
    def lacks():
        found = shutil.which("quakespasm", path=os.environ["PATH"] + ":/usr/games")
        return "" if found and shutil.which("Xvfb") else "quakespasm or Xvfb is not installed (Linux/install-deps.sh test)"

    def close(self):
        self.display.kill()
        self.display.wait()

    def count(self, name, demo):
        (self.folder / "id1" / f"{name}.dem").unlink(missing_ok=True)
        (self.folder / "id1" / f"{name}.dem").write_bytes(demo)
        environment = {**os.environ, "DISPLAY": f":{self.number}", "SDL_AUDIODRIVER": "dummy", "HOME": str(self.folder),
                       "PATH": os.environ["PATH"] + ":/usr/games"}
        # r_norefresh: drawing by software OpenGL takes long and is not needed. quakespasm does not quit by itself.
        command = ["stdbuf", "-oL", "quakespasm", "-basedir", str(self.folder), "-window", "-width", "320", "-height", "240",
                   "-nosound", "-nojoy", "+r_norefresh", "1", "+timedemo", name]
        log = self.folder / f"{name}.log"
        with log.open("w") as out:
            game = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, env=environment)
        until = time.monotonic() + SECONDS
        found, running = None, True
        while not found and running and time.monotonic() < until:
            time.sleep(0.1)
            running = game.poll() is None
            # Behind a finale's text the line begins with what is left of a bar.
            found = re.search(r"(-?\d+) frames .* fps$", log.read_text(errors="replace"), re.M)
        game.kill()
        game.wait()
        if not found:
            raise AssertionError(f"{name}: quakespasm did not play it\n{log.read_text(errors='replace')[-3000:]}")
        return int(found[1])


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    if not (build / "game/id1/progs.dat").exists():
        skip("the base game is not built")
    if subprocess.run([build / "fullbright", "-listdevices"], capture_output=True, check=False).returncode != 0:
        skip("no Vulkan device")
    failures = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "id1").mkdir()
        ours = Ours(build, folder)
        demos = {name: ours.record(name, *how, folder) for name, how in RECORDED.items()}
        for name, demo in joined(demos).items():
            (folder / "id1" / f"{name}.dem").write_bytes(demo)
            demos[name] = demo
        data, no_data = librequake()
        lacks = no_data or QuakeSpasm.lacks()
        theirs = None if lacks else QuakeSpasm(build, data, folder)
        try:
            for name, demo in demos.items():
                counted = {"here": ours.count(name), "in quakespasm": theirs.count(name, demo) if theirs else COUNTS[name]}
                right = set(counted.values()) == {COUNTS[name]}
                print(f"{'ok' if right else 'FAILED'}: {name}: {COUNTS[name]} frames; {counted}")
                failures += not right
        finally:
            if theirs:
                theirs.close()
        if lacks:
            print(f"skipped: {lacks}")
            print("(QuakeSpasm's counts of an earlier run were taken)")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
