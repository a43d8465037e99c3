#!/usr/bin/env python3
"""Copies the compiled maps, and what texts say of their textures (MAP/TEXTURE.mat), to the game's folder.

    python3 Misc/basegame/maps/make.py --out DIR [--only PATTERN] [--list] [--wad FILE]

--wad puts the textures of that wad into the copies, where they have the same sizes, so that pictures which changed do not
ask for compiling. The .bsp themselves are made by write.py and compile.sh.
"""

from __future__ import annotations

import argparse
import fnmatch
import sys
from pathlib import Path

from sources import FOLDERS

from formats.bsp import Bsp
from formats.wad import read_wad


def compiled() -> dict[str, Path]:
    """The .bsp files by their game paths."""
    return {f"maps/{path.name}": path for folder in FOLDERS for path in sorted(folder.glob("*.bsp"))}


def texts() -> dict[str, Path]:
    """The .mat texts of single maps' textures by their game paths."""
    paths = [path for folder in FOLDERS for path in sorted(folder.glob("*/*.mat"))]
    return {f"textures/{path.parent.name}/{path.name}": path for path in paths}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, help="the game's folder")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="only paths that match, such as 'maps/start.bsp'")
    parser.add_argument("--list", action="store_true", help="print the paths and write nothing")
    parser.add_argument("--wad", type=Path)
    arguments = parser.parse_args()
    if arguments.out is None and not arguments.list:
        print("maps/make.py: --out DIR says where the files go", file=sys.stderr)
        return 2
    chosen = {name: path for name, path in (compiled() | texts()).items() if fnmatch.fnmatch(name, arguments.only)}
    if arguments.list:
        print("\n".join(chosen))
        return 0
    textures = {}
    if arguments.wad:
        textures = {name: lump.data for name, lump in read_wad(arguments.wad.read_bytes()).items()}
    for name, path in chosen.items():
        data = path.read_bytes()
        if textures and path.suffix == ".bsp":
            try:
                data = Bsp(data).with_textures(textures)
            except ValueError as error:
                print(f"maps/make.py: {path.name}: {error}", file=sys.stderr)
                return 1
        target = arguments.out / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    print(f"maps: {len(chosen)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
