#!/usr/bin/env python3
"""Checks that C++ sources compile alone.

A build in groups (FULLBRIGHT_QUICK_BUILD) gives a source the headers of its neighbours, so a missing #include shows only where
sources are compiled one by one. This parses single sources (-fsyntax-only) with an ungrouped build's commands and an existing
build's generated headers.

    Misc/check_alone.py [FILE ...]   checks these; without any, the sources that the last COMMITS commits changed
    Misc/check_alone.py --all        checks every source (some minutes)
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile


def changed_sources(root: pathlib.Path, commits: int) -> set[str]:
    git = ["git", "-C", str(root), "log", f"-{commits}", "--name-only", "--format="]
    names = subprocess.run(git, capture_output=True, text=True, check=True).stdout.split("\n")
    git = ["git", "-C", str(root), "status", "--porcelain", "--untracked-files=all"]
    names += [line[3:] for line in subprocess.run(git, capture_output=True, text=True, check=True).stdout.split("\n")]
    return {name for name in names if name.endswith(".cpp")}


def compile_commands(root: pathlib.Path, build: pathlib.Path) -> list[dict]:
    """An ungrouped build's commands, with the folder of generated headers replaced by `build`."""
    with tempfile.TemporaryDirectory() as folder:
        configure = ["cmake", "-S", str(root), "-B", folder, "-G", "Ninja", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                     "-DCMAKE_BUILD_TYPE=Debug", "-DFULLBRIGHT_QUICK_BUILD=OFF"]
        done = subprocess.run(configure, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"check_alone: the build cannot be configured:\n{done.stdout}{done.stderr}")
        text = (pathlib.Path(folder) / "compile_commands.json").read_text()
        return json.loads(text.replace(folder, str(build)))


def parse_alone(command: dict) -> str:
    """The compiler's errors, or nothing."""
    words = shlex.split(re.sub(r" -o \S+", " -fsyntax-only", command["command"]))
    return subprocess.run(words, cwd=command["directory"], capture_output=True, text=True).stderr


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--commits", type=int, default=40, help="of how many commits the changed sources are checked (40)")
    parser.add_argument("--build", default="build", help="a finished build, whose generated headers are used (build)")
    arguments = parser.parse_args()

    root = pathlib.Path(__file__).resolve().parents[1]
    build = pathlib.Path(arguments.build).resolve()
    if not (build / "CMakeCache.txt").exists():
        sys.exit(f"check_alone: {build} is no build: make one first (make), or name one with --build")
    wanted = set(arguments.files) or changed_sources(root, arguments.commits)
    commands = {}
    for command in compile_commands(root, build):
        name = os.path.relpath(command["file"], root)
        if name.endswith(".cpp") and (arguments.all or name in wanted):
            commands[name] = command
    unknown = sorted(name for name in arguments.files if name not in commands)
    if unknown:
        sys.exit(f"check_alone: the build has no source {', '.join(unknown)}")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, errors in zip(commands, pool.map(parse_alone, commands.values())):
            if errors:
                failed += 1
                print(f"{name} does not compile alone:\n{errors}", file=sys.stderr)
    print(f"check_alone: {len(commands)} sources, {failed} do not compile alone")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
