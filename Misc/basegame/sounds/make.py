#!/usr/bin/env python3
"""Makes the sounds and the music of the base game.

    python3 Misc/basegame/sounds/make.py --out DIR [--only PATTERN] [--list]

writes DIR/sound/**.wav and DIR/music/*.ogg. PATTERN is a shell pattern of game paths ('sound/ogre/*', '*rocket*'). The
wave files are the same bytes every time; the ogg files are as long as oggenc stays the same version. Without oggenc
the music is left out, with a warning.
"""

from __future__ import annotations

import argparse
import fnmatch
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from sounds import catalogue  # noqa: E402
from sounds.conventions import CONVENTIONS  # noqa: E402
from sounds.music import tracks  # noqa: E402


def main() -> int:
    arguments = parse()
    everything = {CONVENTIONS[name].path: name for name in catalogue.recipes()} | tracks.PATHS
    wanted = {path: name for path, name in everything.items() if fnmatch.fnmatch(path, arguments.only)}
    if not wanted:
        return complain(f"no sound matches '{arguments.only}'; --list names them all")
    if arguments.list:
        print("\n".join(wanted))
        return 0
    if arguments.out is None:
        return complain("--out DIR says where the sounds go")
    return write(wanted, arguments.out)


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", help="the game directory to write to")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="shell pattern of game paths")
    parser.add_argument("--list", action="store_true", help="name what would be made, make nothing")
    return parser.parse_args()


def write(wanted: dict[str, str], out: pathlib.Path) -> int:
    begun, size, folder = time.monotonic(), 0, ""
    for path, name in wanted.items():
        if path.rsplit("/", 1)[0] != folder:
            folder = path.rsplit("/", 1)[0]
            print(f"sounds: {folder}", flush=True)
        target = out / path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            if path in tracks.PATHS:
                size += tracks.write(name, target)
            else:
                data = catalogue.make(name).to_bytes()
                size += len(data)
                target.write_bytes(data)
        except tracks.NoEncoder as error:
            print(f"sounds: warning: {error}", file=sys.stderr)
        except OSError as error:
            return complain(f"{target}: {error.strerror}")
    print(f"sounds: {len(wanted)} files, {size / 1e6:.1f} MB, {time.monotonic() - begun:.1f} s")
    return 0


def complain(sentence: str) -> int:
    print(f"make.py: {sentence}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
