#!/usr/bin/env python3
"""Tells whether every .map is what its script writes, every .bsp is compiled from its .map, and the base game still is small.

    check.py                  all maps; exit status 1 where one is out of date
    check.py --wad FILE       and whether the textures in the .bsp are those of the wad
    check.py --stamp FILE.map after compiling: writes FILE.bsp.src, the sums of both files

`write.py` writes the .map files anew, compile.sh compiles them.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from pathlib import Path

from sources import FOLDERS, HERE, maps_of, scripts

from formats.bsp import Bsp
from formats.wad import read_wad

LIMIT = 34_000_000  # bytes of Misc/basegame, nearly all of it maps


def sums(map_path: Path) -> str:
    bsp_path = map_path.with_suffix(".bsp")
    return "".join(f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p.name}\n" for p in (map_path, bsp_path))


def stamp_of(map_path: Path) -> Path:
    return map_path.with_suffix(".bsp.src")


def problems_of_bsp(map_path: Path, wad) -> list[str]:
    bsp_path, stamp = map_path.with_suffix(".bsp"), stamp_of(map_path)
    name = map_path.relative_to(HERE)
    if not bsp_path.exists() or not stamp.exists():
        return [f"{name} has not been compiled: compile.sh"]
    if stamp.read_text() != sums(map_path):
        return [f"{name.with_suffix('.bsp')} is not what compile.sh made of {name.name}: compile it again"]
    stale = [texture for texture, data in Bsp(bsp_path.read_bytes()).textures().items()
             if texture.lower() in wad and wad[texture.lower()].data[40:len(data)] != data[40:]]
    return [f"{name.with_suffix('.bsp')} has old textures: {', '.join(stale)}: write.py and compile.sh"] if stale else []


def problems(wad_path: Path | None) -> list[str]:
    found: list[str] = []
    wad = read_wad(wad_path.read_bytes()) if wad_path else {}
    written: set[Path] = set()
    for script in scripts():
        try:
            texts = maps_of(script)
        except ValueError as error:
            found.append(str(error))
            continue
        for path, text in texts.items():
            written.add(path)
            if not path.exists() or path.read_text(encoding="ascii") != text:
                found.append(f"{path.relative_to(HERE)} is not what {script.name} writes: write.py {script.stem}")
            else:
                found.extend(problems_of_bsp(path, wad))
    for folder in FOLDERS:
        found.extend(f"{path.relative_to(HERE)} has no script" for path in sorted(folder.glob("*.map"))
                     if path not in written)
    size = sum(path.stat().st_size for path in HERE.parent.rglob("*") if path.is_file() and path.suffix != ".pyc")
    if size > LIMIT:
        found.append(f"{HERE.parent} holds {size / 1e6:.1f} MB, more than {LIMIT / 1e6:.0f}")
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wad", type=Path)
    parser.add_argument("--stamp", type=Path, metavar="FILE.map")
    arguments = parser.parse_args()
    if arguments.stamp:
        stamp_of(arguments.stamp).write_text(sums(arguments.stamp))
        return 0
    found = problems(arguments.wad)
    for sentence in found:
        print(f"check.py: {sentence}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
