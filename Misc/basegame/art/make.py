#!/usr/bin/env python3
"""Makes the base game's pictures: palette, textures, status bar, menus, sprites.

    python3 Misc/basegame/art/make.py --out DIR [--only PATTERN] [--list]

writes files under DIR with their game paths, the same bytes every time. `basegame.wad` is for the map compiler.
"""

from __future__ import annotations

import argparse
import fnmatch
import pathlib
import re
import sys
from collections.abc import Callable, Iterator

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from art.catalogue import OF_MAPS, TEXTURES  # noqa: E402
from art.hud import hud_files  # noqa: E402
from art.menus import menu_pictures  # noqa: E402
from art.pages import page_pictures  # noqa: E402
from art.palette import PALETTE, colormap  # noqa: E402
from art.sprites import sprite_files  # noqa: E402
from art.surface import Surface, files, miptex  # noqa: E402
from formats.lmp import write_lmp  # noqa: E402
from formats.wad import TYPE_MIPTEX, Lump, write_wad  # noqa: E402

Files = dict[str, bytes]


def palette_files() -> Files:
    """The palette, and the software renderer's table with the count of glowing colours after it."""
    return {"gfx/palette.lmp": PALETTE.tobytes(), "gfx/colormap.lmp": colormap().tobytes() + b"\x20"}


def paint(name: str) -> Surface:
    """The named texture's surface."""
    width, height, painter = (TEXTURES | OF_MAPS)[name]
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
    for name in [*TEXTURES, *OF_MAPS]:
        stem = f"textures/{name.replace('*', '#')}"
        if not wad_wanted and not any(
            fnmatch.fnmatch(f"{stem}{kind}.png", pattern) for kind in ("", "_norm", "_gloss", "_luma")
        ):
            continue
        surface = paint(name)
        if name in TEXTURES:
            lumps.append(Lump(name, TYPE_MIPTEX, miptex(name, surface)))
        out |= files(name, surface)
    if wad_wanted:
        out["basegame.wad"] = write_wad(lumps)
    return out


def picture_files(pattern: str) -> Files:
    """`gfx/*.lmp` of menus, pages and the console."""
    return {f"gfx/{name}.lmp": write_lmp(picture) for name, picture in (menu_pictures() | page_pictures()).items()}


# What each part is called, how its paths begin, and its maker, which may make more than the pattern asks for.
PARTS: list[tuple[str, tuple[str, ...], Callable[[str], Files]]] = [
    ("palette", ("gfx/palette.lmp", "gfx/colormap.lmp"), lambda pattern: palette_files()),
    ("status bar", ("gfx.wad",), hud_files),
    ("menus", ("gfx/",), picture_files),
    ("sprites", ("progs/s_",), sprite_files),
    ("textures", ("textures/", "basegame.wad"), texture_files),
]


def make(pattern: str = "*") -> Iterator[tuple[str, Files]]:
    """Each part's name and those of its files that match the pattern."""
    literal = re.split(r"[*?\[]", pattern)[0]
    for name, starts, maker in PARTS:
        if any(start.startswith(literal) or literal.startswith(start) for start in starts):
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
