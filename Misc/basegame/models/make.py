#!/usr/bin/env python3
"""Writes the base game's models and their images: `make.py --out DIR [--only PATTERN] [--list]` puts them under DIR/progs."""

from __future__ import annotations

import argparse
import fnmatch
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from formats.mdl import write_mdl  # noqa: E402
from models.catalogue import MODELS  # noqa: E402
from models.conventions import COLORED  # noqa: E402
from models.kit.images import images  # noqa: E402


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, help="the game's folder")
    parser.add_argument("--only", default="*", help="a pattern of models' paths, such as progs/v_*.mdl")
    parser.add_argument("--list", action="store_true", help="names the models that would be written")
    options = parser.parse_args()
    paths = {f"progs/{name}.mdl": make for name, make in MODELS.items()}
    chosen = [path for path in paths if fnmatch.fnmatch(path, options.only)]
    if not chosen:
        parser.error(f"no model's path fits {options.only!r}")
    if options.list:
        print("\n".join(chosen))
        return 0
    if options.out is None:
        parser.error("--out DIR says where the models go")
    started = time.monotonic()
    for path in chosen:
        figure = paths[path]()
        files = {path: write_mdl(figure), **images(path, figure, pathlib.Path(path).stem in COLORED)}
        for name, content in files.items():
            target = options.out / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
    print(f"{len(chosen)} models in {time.monotonic() - started:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
