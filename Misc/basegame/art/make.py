#!/usr/bin/env python3
"""Makes the base game's pictures: palette, textures, status bar, menus, sprites.

    python3 Misc/basegame/art/make.py --out DIR [--only PATTERN] [--list]

writes files under DIR with their game paths, the same bytes every time. `basegame.wad` is for the map compiler.
"""

from __future__ import annotations

import argparse
import fnmatch
import pathlib
import sys
from collections.abc import Callable, Iterator

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from art.catalogue import TEXTURES  # noqa: E402
from art.palette import PALETTE, colormap  # noqa: E402
from art.surface import Surface, files, miptex  # noqa: E402
from formats.wad import TYPE_MIPTEX, Lump, write_wad  # noqa: E402

Files = dict[str, bytes]


def palette_files() -> Files:
    """The palette, and the software renderer's table with the count of glowing colours after it."""
    return {"gfx/palette.lmp": PALETTE.tobytes(), "gfx/colormap.lmp": colormap().tobytes() + b"\x20"}


def paint(name: str) -> Surface:
    """The named texture's surface."""
    width, height, painter = TEXTURES[name]
    surface = painter(width, height)
    expected = (height * surface.scale, width * surface.scale, 3)
    if surface.color.shape != expected:
        raise ValueError(f"{name}: painted {surface.color.shape}, the catalogue asks for {expected}")
    return surface


def texture_files(pattern: str) -> Files:
    """Those of `basegame.wad` and `textures/` that match."""
    wad_wanted = fnmatch.fnmatch("basegame.wad", pattern)
    out: Files = {}
    lumps = []
    for name in TEXTURES:
        if not wad_wanted and not fnmatch.fnmatch(f"textures/{name.replace('*', '#')}.png", pattern):
            continue
        surface = paint(name)
        lumps.append(Lump(name, TYPE_MIPTEX, miptex(name, surface)))
        out |= files(name, surface)
    if wad_wanted:
        out["basegame.wad"] = write_wad(lumps)
    return out


# What each part writes: the prefixes of its paths, and its maker.
PARTS: list[tuple[str, list[str], Callable[[str], Files]]] = [
    ("palette", ["gfx/palette.lmp", "gfx/colormap.lmp"], lambda pattern: palette_files()),
    ("textures", ["basegame.wad", "textures/"], texture_files),
]


def make(pattern: str = "*") -> Iterator[tuple[str, Files]]:
    """Each part's name and those of its files that match the pattern."""
    for name, _, maker in PARTS:
        yield name, {path: data for path, data in maker(pattern).items() if fnmatch.fnmatch(path, pattern)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, help="the game's folder")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="only paths that match, such as 'gfx/*'")
    parser.add_argument("--list", action="store_true", help="print the paths and write nothing")
    arguments = parser.parse_args()
    if arguments.out is None and not arguments.list:
        print("art/make.py: --out DIR says where the files go", file=sys.stderr)
        return 2
    count = 0
    for part, made in make(arguments.only):
        for path, data in made.items():
            if arguments.list:
                print(path)
                continue
            target = arguments.out / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)
        count += len(made)
        if not arguments.list:
            print(f"art: {part}: {len(made)} files")
    if count == 0:
        print(f"art/make.py: nothing is called {arguments.only}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
