#!/usr/bin/env python3
"""Records the scenes' demos anew: plays each map headless by the script of its settings.

    make_demos.py [--build build] [--basedir DIR] [--out DIR] [NAME ...]

The base game must be built; without --basedir the program finds it itself. The demos are written to --out, by default this
folder; expected/NAME.csv beside them says where they have the player, message by message, expected/frames.txt how many
frames `timedemo` counts.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from scenes import HERE, load, names, script_lines

SECONDS = 120  # a recording that takes longer hangs


def record(name: str, build: Path, basedir: str | None, out: Path) -> Path:
    """The demo that was recorded; RuntimeError with what the program said."""
    scene = load(name)
    with tempfile.TemporaryDirectory() as user:
        game = Path(user) / "id1"
        game.mkdir()
        (game / "scene.cfg").write_text("\n".join(script_lines(name)) + "\n")
        command = [build / "fullbright", "-headless", "-size", "32x18", "-seed", "1", "-userdir", user]
        command += ["-basedir", basedir] if basedir else []
        command += ["+r_estimator", "pt", "+r_bounces", "0", "+host_framerate", f"{scene['tick']:g}"]
        command += ["+sv_protocol", str(scene["protocol"])] if "protocol" in scene else []
        command += ["+record", name, scene["map"], "+exec", "scene.cfg"]
        said = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
        made = game / f"{name}.dem"
        if said.returncode != 0 or not made.exists():
            raise RuntimeError(f"{name}: no demo was recorded\n{(said.stdout + said.stderr)[-2000:]}")
        out.mkdir(parents=True, exist_ok=True)
        target = out / made.name
        target.write_bytes(made.read_bytes())
        return target


def positions(demo: Path, build: Path) -> str:
    return subprocess.run([build / "fullbright-lab", "track", demo, "--csv", "-"], capture_output=True, text=True,
                          check=True).stdout


def timedemo_frames(demo: Path, build: Path, basedir: str | None) -> int:
    """How many frames `timedemo` counts; the demo need not be in a game's folder."""
    with tempfile.TemporaryDirectory() as user:
        game = Path(user) / "id1"
        game.mkdir()
        (game / demo.name).write_bytes(demo.read_bytes())
        command = [build / "fullbright", "-headless", "-size", "16x9", "-userdir", user]
        command += ["-basedir", basedir] if basedir else []
        command += ["+r_estimator", "pt", "+r_bounces", "0", "+timedemo", demo.stem, "+quit"]
        said = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
        found = re.search(r"(\d+) frames", said.stdout + said.stderr)
        if not found:
            raise RuntimeError(f"{demo.name}: timedemo did not end\n{(said.stdout + said.stderr)[-2000:]}")
        return int(found[1])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--build", type=Path, default=HERE.parent / "build")
    parser.add_argument("--basedir")
    parser.add_argument("--out", type=Path, default=HERE)
    options = parser.parse_intermixed_args()
    counts = options.out / "expected/frames.txt"
    try:
        for name in options.names or names():
            demo = record(name, options.build.resolve(), options.basedir, options.out)
            expected = options.out / "expected" / f"{name}.csv"
            expected.parent.mkdir(exist_ok=True)
            expected.write_text(positions(demo, options.build))
            frames = dict(re.findall(r"(\S+) (\d+)\n", counts.read_text())) if counts.exists() else {}
            frames[name] = timedemo_frames(demo, options.build.resolve(), options.basedir)
            counts.write_text("".join(f"{key} {frames[key]}\n" for key in sorted(frames)))
            print(f"{demo.name}: {demo.stat().st_size} bytes, {frames[name]} frames")
    except (RuntimeError, ValueError) as error:
        print(f"make_demos.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
