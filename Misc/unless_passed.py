#!/usr/bin/env python3
"""Runs a test that is a function of files, unless it passed with the same ones.

usage: unless_passed.py STAMP FOLDER COMMAND ...

STAMP keeps a hash of all files in FOLDER, of the words of COMMAND and of the versions of Python and numpy, once COMMAND has passed
and skipped nothing: with the same hash it does not run, and that is said. FULLBRIGHT_RUN_AGAIN=1 runs it in any case, and so does a new build folder,
which has no stamps. The exit status is COMMAND's.
"""
import hashlib
import importlib.metadata
import os
import pathlib
import platform
import subprocess
import sys


def hash_of(folder: pathlib.Path, command: list[str]) -> str:
    root = str(folder.resolve())
    try:
        numpy = importlib.metadata.version("numpy")
    except importlib.metadata.PackageNotFoundError:
        numpy = "none"
    digest = hashlib.sha256(f"{platform.python_version()} {numpy}\n".encode())
    for word in command:  # the same in every checkout
        digest.update(word.replace(root, "FOLDER").encode() + b"\0")
    for path in sorted(folder.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            data = path.read_bytes()
            digest.update(f"{path.relative_to(folder)} {len(data)}\n".encode() + data)
    return digest.hexdigest()


def main() -> int:
    if len(sys.argv) < 4:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    stamp, folder, command = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
    found = hash_of(folder, command)
    if not os.environ.get("FULLBRIGHT_RUN_AGAIN") and stamp.exists() and stamp.read_text() == found:
        print(f"passed before with the same files in {folder}; FULLBRIGHT_RUN_AGAIN=1 runs it again")
        return 0
    stamp.unlink(missing_ok=True)
    skipped = False
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as running:
        for line in running.stdout:
            sys.stdout.buffer.write(line)
            sys.stdout.buffer.flush()
            skipped = skipped or b"skipped" in line
    status = running.returncode
    if status == 0 and not skipped:
        stamp.parent.mkdir(parents=True, exist_ok=True)
        stamp.write_text(found)
    return status


if __name__ == "__main__":
    sys.exit(main())
