#!/usr/bin/env python3
"""Runs a test that is a function of files, unless it is known to have passed with the same ones.

usage: unless_passed.py NAME --stamps FOLDER [--tests PATTERN] [--tools TEXT] [--device PROGRAM] [--may-skip] [--keep] --of PATH ... -- COMMAND ...

  --of PATH ...     files and folders that the test is a function of
  --tests PATTERN   of files named x_test.cpp, x_test.py, x_bench.cpp and fuzz_x.cpp in there only those count that match it; else all files count
  --tools TEXT      what compiled it, by version
  --device PROGRAM  the test draws: PROGRAM -listdevices says on what
  --stamps FOLDER   where the build folder keeps what passed in it
  --may-skip        it has passed where parts of it were skipped, too
  --keep            its key goes into passed.csv at once

A test that passed and skipped nothing has a key: a hash of the files, of the words of COMMAND, of what GTEST_FILTER and the like choose of it, of
the versions of Python and numpy, of the tools and the device. The key is kept in FOLDER/NAME, and by `run_tests.py --keep-passed` in passed.csv
beside this file, with the sources. Where one of these has the same key, COMMAND does not run, and that is said. FULLBRIGHT_RUN_AGAIN runs it in any
case: 1 for all, or names. The exit status is COMMAND's.
"""
import argparse
import csv
import fnmatch
import hashlib
import importlib.metadata
import os
import pathlib
import platform
import subprocess
import sys

PASSED = pathlib.Path(__file__).with_name("passed.csv")
COLUMNS = ("test", "device", "key")
NOT_COUNTED = ("*_test.cpp", "*_test.py", "*_bench.cpp", "fuzz_*.cpp")
CHOOSES = ("GTEST_FILTER", "GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX", "FULLBRIGHT_UNBIASED_TIMES")
NO_DEVICE = "none"
KNOWN = "known to pass:"  # begins the line of a test that did not run


def files_of(paths: list[pathlib.Path], tests: str | None) -> list[tuple[str, pathlib.Path]]:
    """Every file of these paths with the name by which it counts, in order."""
    found = []
    for root in paths:
        for path in [root] if root.is_file() else root.rglob("*"):
            if not path.is_file() or "__pycache__" in path.parts:
                continue
            left_out = tests is not None and any(fnmatch.fnmatch(path.name, pattern) for pattern in NOT_COUNTED)
            if not left_out or fnmatch.fnmatch(path.name, tests):
                found.append((f"{root.name}/{path.relative_to(root)}", path))
    return sorted(found)


def numpy_version() -> str:
    try:
        return importlib.metadata.version("numpy")
    except importlib.metadata.PackageNotFoundError:
        return "none"


def device_of(program: str) -> str:
    """The device that `program` would draw on, in its own words, with its driver."""
    listed = subprocess.run([program, "-listdevices"], capture_output=True, text=True, check=False).stdout
    chosen = [line for line in listed.splitlines() if line.startswith("* ")]
    return chosen[0].removeprefix("* ").partition(": ")[2] if chosen else NO_DEVICE


def key_of(files: list[tuple[str, pathlib.Path]], folders: list[str], command: list[str], about: list[str]) -> str:
    """`folders` are left out of the command's words: they are others in each checkout."""
    digest = hashlib.sha256()

    def add(data: bytes) -> None:
        digest.update(f"{len(data)}:".encode() + data)

    for text in about:
        add(text.encode())
    for word in command:
        for folder in folders:
            word = word.replace(folder, "FOLDER")
        add(word.encode())
    for name, path in files:
        add(name.encode())
        add(path.read_bytes())
    return digest.hexdigest()[:32]


def read_passed(path: pathlib.Path) -> dict[tuple[str, str], str]:
    """The key of each test and device."""
    if not path.exists():
        return {}
    with path.open(newline="") as file:
        return {(row["test"], row["device"]): row["key"] for row in csv.DictReader(file)}


def write_passed(path: pathlib.Path, passed: dict[tuple[str, str], str]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows((*which, key) for which, key in sorted(passed.items()))


def arguments_of(words: list[str]) -> argparse.Namespace:
    if "--" not in words:
        words = ["--help"] if "--help" in words else [*words, "--"]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name")
    parser.add_argument("--stamps", type=pathlib.Path, required=True)
    parser.add_argument("--tests")
    parser.add_argument("--tools", default="")
    parser.add_argument("--device")
    parser.add_argument("--may-skip", action="store_true")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--of", type=pathlib.Path, nargs="+", required=True)
    at = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:at])
    arguments.command = words[at + 1:]
    if not arguments.command:
        parser.error("a command follows --")
    missing = [str(path) for path in arguments.of if not path.exists()]
    if missing:
        parser.error(f"--of: there is no {', '.join(missing)}")
    return arguments


def main() -> int:
    arguments = arguments_of(sys.argv[1:])
    again = os.environ.get("FULLBRIGHT_RUN_AGAIN", "")
    device = device_of(arguments.device) if arguments.device else NO_DEVICE
    chosen = [f"{name}={os.environ[name]}" for name in CHOOSES if name in os.environ]
    build = str(arguments.stamps.resolve().parent)
    root = str(PASSED.resolve().parents[1])
    key = key_of(files_of(arguments.of, arguments.tests), [build, root], arguments.command,
                 [platform.python_version(), numpy_version(), arguments.tools, device, *chosen])
    stamp = arguments.stamps / arguments.name
    if again != "1" and arguments.name not in again.split():
        here = stamp.exists() and stamp.read_text() == f"{device}\n{key}\n"
        if here or read_passed(PASSED).get((arguments.name, device)) == key:
            where = "it did here" if here else f"it did where {PASSED.name} was written"
            print(f"{KNOWN} {where}, with the same files on the same device; FULLBRIGHT_RUN_AGAIN=1 runs it again")
            return 0
    stamp.unlink(missing_ok=True)
    skipped = False
    with subprocess.Popen(arguments.command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as running:
        for line in running.stdout:
            sys.stdout.buffer.write(line)
            sys.stdout.buffer.flush()
            skipped = skipped or (b"skipped" in line.lower() and not arguments.may_skip)
    if running.returncode == 0 and not skipped:
        stamp.parent.mkdir(parents=True, exist_ok=True)
        stamp.write_text(f"{device}\n{key}\n")
        if arguments.keep:
            write_passed(PASSED, read_passed(PASSED) | {(arguments.name, device): key})
    return running.returncode


if __name__ == "__main__":
    sys.exit(main())
