#!/usr/bin/env python3
"""Compares the mix of a scripted scene with QuakeSpasm's: when each sound is heard, and how loud on either side.

Writes a demo of sounds about the player (distances, sides, attenuations, overrides, stops, loops), records it here with
-wavcapture and in QuakeSpasm with SDL's disk driver, and prints a line for each event. That driver keeps no exact time,
so it writes into a pipe, and when a block of samples arrives says when it was heard. Needs LibreQuake beside the
repository, quakespasm and xvfb-run. Exit status 1 if a sound is more than a mix period early or late, or 1 dB louder or
softer.

    testdemos/compare_sound.py [--build DIR] [--keep DIR]
"""

import argparse
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import wave

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
RATE = 44100
BLOCK = 4 * 1024  # bytes: SDL's buffer here
STEP = 0.05  # seconds between messages
GAP = 2.5  # seconds between events
PLAYER = np.array([-1936.0, 720.0, -40.0])
EYE = PLAYER + (0, 0, 22)
SOUNDS = ["misc/null.wav", "weapons/rocket1i.wav", "weapons/guncock.wav", "doors/winch2.wav", "ambience/windfly.wav",
          "ogre/ogdrag.wav", "weapons/r_exp3.wav"]
ROCKET, COCK, WINCH, FLY, DRAG = 1, 2, 3, 4, 5
LIMIT_SECONDS = 1024 / RATE  # a period of QuakeSpasm's mix
LIMIT_DB = 1.0
SILENT_DB = -60.0


def sound(number, ahead=0.0, right=0.0, entity=5, channel=1, volume=255, attenuation=64):
    """svc_sound at a place as the player sees it, who looks along x."""
    place = EYE + (ahead, -right, 0)
    coords = b"".join(struct.pack("<h", round(8 * value)) for value in place)
    bits = 3
    return struct.pack("<BBBBHB", 6, bits, volume, attenuation, entity << 3 | channel, number + 1) + coords


def stop(entity, channel):
    return struct.pack("<BH", 16, entity << 3 | channel)


def explosion(ahead):
    place = EYE + (ahead, 0, 0)
    return struct.pack("<BB", 23, 3) + b"".join(struct.pack("<h", round(8 * value)) for value in place)


# Its frames must be short, since its sound waits for them: it draws nothing of the world.
# Name, and what is sent: seconds after the event's begin, message.
EVENTS = [
    ("ahead, 200 units", [(0, sound(ROCKET, 200))]),
    ("right, 200 units", [(0, sound(ROCKET, 0, 200))]),
    ("left, 200 units", [(0, sound(ROCKET, 0, -200))]),
    ("ahead and left, 500 units", [(0, sound(ROCKET, 300, -400))]),
    ("behind, 800 units", [(0, sound(ROCKET, -800))]),
    ("attenuation 3, 200 units", [(0, sound(ROCKET, 200, attenuation=192))]),
    ("no attenuation, 2000 units", [(0, sound(ROCKET, 2000, attenuation=0))]),
    ("half as loud", [(0, sound(ROCKET, 200, volume=128))]),
    ("the player's own", [(0, sound(COCK, 0, 0, entity=1))]),
    ("overridden on its channel", [(0, sound(DRAG, 200, channel=2)), (0.3, sound(COCK, 200, channel=2))]),
    ("both, on two channels", [(0, sound(DRAG, 200, channel=2)), (0.3, sound(COCK, 200, channel=3))]),
    ("a loop that is stopped", [(0, sound(WINCH, 200, 100, channel=4)), (1.4, stop(5, 4))]),
    ("8 bits, right, 20 units", [(0, sound(FLY, 0, 20, channel=5)), (1.4, stop(5, 5))]),
    ("16 bits, right, 20 units", [(0, sound(WINCH, 0, 20, channel=6)), (1.4, stop(5, 6))]),
    ("an explosion, 300 units", [(0, explosion(300))]),
]
FIRST = 3.0  # seconds: of the first event
LENGTH = FIRST + GAP * len(EVENTS) + 0.5


def demo():
    """The demo's bytes, protocol 15."""
    out = b"-1\n"

    def text(value):
        return value.encode() + b"\0"

    def add(data):
        nonlocal out
        out += struct.pack("<i3f", len(data), 0, 0, 0) + data

    def coords(places):
        return b"".join(struct.pack("<hb", round(8 * value), 0) for value in places)

    info = struct.pack("<BiBB", 11, 15, 1, 0) + text("Sounds")
    info += b"".join(text(name) for name in ("maps/lqdm3.bsp", "progs/player.mdl")) + b"\0"
    info += b"".join(text(name) for name in SOUNDS) + b"\0"
    add(info + struct.pack("<BH", 5, 1) + bytes([25, 1]))
    add(struct.pack("<BHBBBB", 22, 1, 2, 0, 0, 0) + coords(PLAYER) + bytes([25, 2]))
    add(bytes([25, 3]))
    due = sorted(
        (FIRST + GAP * i + delay, message) for i, (_, messages) in enumerate(EVENTS) for delay, message in messages
    )
    for step in range(round(LENGTH / STEP)):
        now = step * STEP
        data = struct.pack("<Bf", 7, 1.0 + now)
        data += struct.pack("<BHihBBBBBB", 15, 1 << 9 | 1 << 10, 0, 100, 0, 0, 0, 0, 0, 0)
        data += struct.pack("<BB", 0x80 | 0x0E, 1) + b"".join(struct.pack("<h", round(8 * v)) for v in PLAYER)
        while due and due[0][0] < now + STEP / 2:
            data += due.pop(0)[1]
        add(data)
    add(bytes([2]))
    return out


def record_here(build, base, home, work):
    mix = work / "fullbright.wav"
    command = [build / "fullbright", "-basedir", base, "-userdir", home, "-headless", "-size", "32x18", "-wavcapture",
               mix, "+volume", "1", "+bgmvolume", "0", "+ambient_level", "0", "+host_framerate", "0.0125",
               "+r_estimator", "pt", "+playdemo", "sounds"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with wave.open(str(mix)) as file:
        return np.frombuffer(file.readframes(file.getnframes()), "<i2").reshape(-1, 2) / 32768


class Blocks(threading.Thread):
    """What comes out of a pipe, and how much had come at which time (seconds)."""

    def __init__(self, pipe):
        super().__init__(daemon=True)
        os.mkfifo(pipe)
        self.pipe, self.data, self.counts, self.times = pipe, bytearray(), [], []

    def run(self):
        with open(self.pipe, "rb", buffering=0) as file:
            while data := file.read(BLOCK):
                self.counts.append(len(self.data))
                self.times.append(time.monotonic())
                self.data += data

    def seconds(self, sample):
        """When a sample was heard: it waits in its block for those before it."""
        byte = 4 * sample
        block = np.searchsorted(self.counts, byte, side="right") - 1
        return self.times[block] + (byte - self.counts[block]) / 4 / RATE


def record_quakespasm(base, home, work):
    mix = work.with_suffix(".pipe")
    blocks = Blocks(mix)
    blocks.start()
    environment = dict(os.environ, HOME=str(home), SDL_AUDIODRIVER="disk", SDL_DISKAUDIOFILE=str(mix),
                       LIBGL_ALWAYS_SOFTWARE="1")
    program = shutil.which("quakespasm") or "/usr/games/quakespasm"
    command = ["xvfb-run", "-a", program, "-basedir", base, "-window", "-width", "320", "-height", "240", "+volume", "1",
               "+bgmvolume", "0", "+ambient_level", "0", "+r_drawworld", "0", "+r_drawentities", "0",
               "+_snd_mixahead", "0.2", "+playdemo", "sounds"]
    process = subprocess.Popen([str(word) for word in command], env=environment, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    time.sleep(LENGTH + 12)
    os.killpg(process.pid, signal.SIGKILL)  # it goes on after a demo, and without its display, too
    process.wait()
    if not blocks.data:
        raise SystemExit("QuakeSpasm wrote no sound: can it open a window, and has it SDL's disk driver?")
    blocks.join()
    mix.unlink()
    work.with_suffix(".pcm").write_bytes(blocks.data)
    data = np.frombuffer(bytes(blocks.data), "<i2")
    return data[: data.size // 2 * 2].reshape(-1, 2) / 32768, blocks


def heard(mix):
    """Begin and end of each stretch of sound, in samples: stretches are a fifth of a second of silence apart."""
    loud = np.flatnonzero(np.abs(mix).max(axis=1) > 0.003)
    breaks = np.flatnonzero(np.diff(loud) > RATE // 5)
    return list(zip(loud[np.append(0, breaks + 1)], loud[np.append(breaks, -1)] + 1))


def decibels(mix, begin, end):
    return 20 * np.log10(np.maximum(np.sqrt((mix[begin:end] ** 2).mean(axis=0)), 1e-9))


def delays(ours, theirs):
    """How much later each event is heard here, in seconds, and where it is in either recording; None if one is missing."""
    mix, blocks = theirs
    a, b = heard(ours), heard(mix)
    if len(a) != len(EVENTS) or len(b) != len(EVENTS):
        print(f"{len(EVENTS)} sounds; heard here {len(a)}, in QuakeSpasm {len(b)}")
        return None
    mine = np.array([begin for begin, _ in a]) / RATE
    yours = np.array([blocks.seconds(begin) for begin, _ in b])
    return (mine - yours) - np.median(mine - yours), a, b  # they did not start together


def compare(ours, recordings):
    runs = [delays(ours, theirs) for theirs in recordings]
    if None in runs:
        return False
    late = np.array([run[0] for run in runs])
    middle = np.median(late, axis=0)
    (theirs, _), (_, a, b) = recordings[0], runs[0]
    good = True
    print(f"{'event':28} {'time (range), ms':>22}  {'left, dB':>16}  {'right, dB':>16}")
    for i, ((name, _), here, there) in enumerate(zip(EVENTS, a, b)):
        spread = f"({1000 * late[:, i].min():+.0f} to {1000 * late[:, i].max():+.0f})"
        row, fits = f"{name:28} {1000 * middle[i]:+6.1f} {spread:>15}", abs(middle[i]) <= LIMIT_SECONDS
        for level, other in zip(decibels(ours, *here), decibels(theirs, *there)):
            if max(level, other) < SILENT_DB:
                row += f"  {'silent':>16}"
                continue
            row += f"  {level:7.2f} ({level - other:+5.2f})"
            fits = fits and abs(level - other) <= LIMIT_DB
        print(row + ("" if fits else "  <-- differs"))
        good = good and fits
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the recordings")
    parser.add_argument("--runs", type=int, default=5, help="of QuakeSpasm, whose times differ by frames; their median counts (5)")
    arguments = parser.parse_args()
    data = ROOT.parent / "shared" / "librequake"
    with tempfile.TemporaryDirectory() as folder:
        work = arguments.keep or pathlib.Path(folder)
        base, home = pathlib.Path(folder) / "base", pathlib.Path(folder) / "home"
        (base / "id1").mkdir(parents=True)
        home.mkdir()
        work.mkdir(exist_ok=True)
        for entry in (data / "id1").iterdir():
            (base / "id1" / entry.name).symlink_to(entry)
        (base / "id1" / "sounds.dem").write_bytes(demo())
        ours = record_here(arguments.build, base, home, work)
        theirs = [record_quakespasm(base, home, work / f"quakespasm{i}") for i in range(max(arguments.runs, 1))]
        return 0 if compare(ours, theirs) else 1


if __name__ == "__main__":
    sys.exit(main())
