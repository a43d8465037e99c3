#!/usr/bin/env python3
"""The fuzzers' kept inputs: what they found that their seeds do not reach, small, in Misc/fuzz_corpus/TARGET.txt, an input
a line, in base64, shortest first.

    Misc/fuzz_corpus.py unpack DIR                 writes each into DIR/TARGET/NUMBER
    Misc/fuzz_corpus.py keep PROGRAM SEEDS FOUND   adds to the file of PROGRAM what of the folder FOUND reaches code that
                                                   neither the folder SEEDS nor what is kept reaches
    Misc/fuzz_corpus.py --self-test

`Misc/fuzz.sh --keep` does the latter for every target.
"""

import base64
import pathlib
import subprocess
import sys
import tempfile

KEPT = pathlib.Path(__file__).parent / "fuzz_corpus"
MOST_BYTES = 1024  # of an input
MOST_OF_TARGET = 32 * 1024  # of a target's inputs together


def read(target, folder=KEPT):
    file = folder / f"{target}.txt"
    return [base64.b64decode(line) for line in file.read_text().splitlines()] if file.exists() else []


def write(target, inputs, folder=KEPT):
    """The shortest, as many as there is room for; returns their number."""
    total, lines = 0, []
    for data in sorted(set(inputs), key=lambda data: (len(data), data)):
        total += len(data)
        if total > MOST_OF_TARGET or len(data) > MOST_BYTES:
            break
        lines.append(base64.b64encode(data).decode() + "\n")
    if lines:
        folder.mkdir(exist_ok=True)
        (folder / f"{target}.txt").write_text("".join(lines))
    return len(lines)


def unpack(to, folder=KEPT):
    for file in sorted(folder.glob("*.txt")):
        out = pathlib.Path(to) / file.stem
        out.mkdir(parents=True, exist_ok=True)
        for number, data in enumerate(read(file.stem, folder)):
            (out / f"{number:04}").write_bytes(data)


def keep(program, seeds, found, folder=KEPT):
    target = pathlib.Path(program).name
    before = read(target, folder)
    with tempfile.TemporaryDirectory() as scratch:
        out, small = pathlib.Path(scratch) / "out", pathlib.Path(scratch) / "small"
        out.mkdir()
        small.mkdir()
        for number, data in enumerate(before):
            (out / f"kept{number}").write_bytes(data)
        for file in pathlib.Path(seeds).glob("*"):
            (out / f"seed_{file.name}").write_bytes(file.read_bytes())
        known = {file.name for file in out.iterdir()}
        for file in pathlib.Path(found).glob("*"):
            if file.stat().st_size <= MOST_BYTES:
                (small / file.name).write_bytes(file.read_bytes())
        if not any(small.iterdir()):
            return len(before)
        # libFuzzer adds to the first folder what of the others reaches more.
        merge = subprocess.run([program, "-merge=1", "-verbosity=0", "-rss_limit_mb=4096", out, small],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if merge.returncode != 0:
            sys.exit(f"{target}: merging failed\n{merge.stderr[-2000:]}")
        new = [file.read_bytes() for file in out.iterdir() if file.name not in known]
    return write(target, before + new, folder)


def self_test():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "kept"
        assert read("none", folder) == []
        assert write("none", [], folder) == 0 and not folder.exists()
        inputs = [b"longer", b"", b"\x00\xff\n", b"longer", b"x" * (MOST_BYTES + 1)]
        assert write("t", inputs, folder) == 3
        assert read("t", folder) == [b"", b"\x00\xff\n", b"longer"]
        unpack(pathlib.Path(scratch) / "out", folder)
        assert (pathlib.Path(scratch) / "out/t/0002").read_bytes() == b"longer"
        many = [bytes([i % 256, i // 256]) * (MOST_BYTES // 2) for i in range(100)]
        assert write("t", many, folder) == MOST_OF_TARGET // MOST_BYTES
        # A program that takes every input for news.
        program = pathlib.Path(scratch) / "fuzz_t"
        program.write_text('#!/bin/sh\nfor f; do :; done\nfor g; do case $g in */out) o=$g;; esac; done\ncp "$f"/* "$o"\n')
        program.chmod(0o755)
        seeds, found = pathlib.Path(scratch) / "seeds", pathlib.Path(scratch) / "found"
        for place, name, data in ((seeds, "s", b"seed"), (found, "a", b"new"), (found, "b", b"y" * (MOST_BYTES + 1))):
            place.mkdir(exist_ok=True)
            (place / name).write_bytes(data)
        write("fuzz_t", [b"kept"], folder)
        assert keep(program, seeds, found, folder) == 2
        assert read("fuzz_t", folder) == [b"new", b"kept"]
    print("fuzz_corpus: self-test passed")


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["unpack", to]:
            unpack(to)
        case ["keep", program, seeds, found]:
            print(f"{pathlib.Path(program).name}: {keep(program, seeds, found)} inputs kept")
        case ["--self-test"]:
            self_test()
        case _:
            sys.exit(__doc__)
