#!/usr/bin/env python3
"""Compiles the base game's QuakeC into progs.dat, by Debian's fteqcc, and takes no warning for an answer.

    python3 Misc/basegame/qc/make.py --out DIR     writes DIR/progs.dat

The compiler works in a folder of its own, since it writes beside its sources whatever it is told.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PRODUCTS = ["progs.dat"]


class CompileError(Exception):
    """What the compiler said, where that was more than progress."""


def compile_progs(sources: pathlib.Path = HERE, *extra: pathlib.Path) -> bytes:
    """progs.dat of the sources in a folder; `extra` files are compiled behind all others (for tests)."""
    compiler = shutil.which("fteqcc")
    if not compiler:
        raise CompileError("fteqcc is not installed (Linux/install-deps.sh build)")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder) / "qc"
        shutil.copytree(sources, work, ignore=shutil.ignore_patterns("__pycache__", "*.dat", "*.lno"))
        for path in extra:
            shutil.copy(path, work / path.name)
            with open(work / "progs.src", "a", encoding="ascii") as listing:
                listing.write(f"{path.name}\n")
        done = subprocess.run(
            [compiler, "-Tstandard", "-srcfile", "progs.src"], cwd=work, capture_output=True, text=True, check=False
        )
        said = [line for line in (done.stdout + done.stderr).splitlines() if "warning:" in line or "rror" in line]
        progs = work / "progs.dat"
        if done.returncode != 0 or said or not progs.exists():
            raise CompileError("\n".join(said) or done.stdout + done.stderr)
        return progs.read_bytes()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, help="the game's folder")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="only files whose game path matches")
    parser.add_argument("--list", action="store_true", help="say what would be written")
    arguments = parser.parse_args()
    wanted = [name for name in PRODUCTS if pathlib.PurePath(name).match(arguments.only)]
    if arguments.list:
        print("\n".join(wanted))
        return 0
    if not arguments.out:
        parser.error("--out DIR says where the game's folder is")
    if not wanted:
        return 0
    try:
        data = compile_progs()
    except CompileError as error:
        print(f"qc: {error}", file=sys.stderr)
        return 1
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "progs.dat").write_bytes(data)
    print(f"progs.dat: {len(data)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
