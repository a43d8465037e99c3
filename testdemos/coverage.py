#!/usr/bin/env python3
"""How much of the variance of guided samples is of light that no lobe stands for.

Renders the debug view `guide_cover` of mcpg or mcpg_nee, whose linear pictures hold, for one sample of the first vertex
in each pixel, its second moment where the lobes have less than a tenth of the BSDF's density, its second moment, and the
sample. Prints for each view: the former's sum over the latter's, with the smallest and the largest of four parts of the
frames; the second moment over the square of the mean (both over the picture); and the share that 0.1% of the samples have
of it, since means of heavy tails hang on few.

    testdemos/coverage.py [--lab build/fullbright-lab] [--estimator mcpg] [--size 160x90] [--frames 32] [--warmup 60]
                          [--basedir DIR] VIEW ...

VIEW: a scene of the laboratory (tears, azad, ...), one in code (code:cbox), or a map (map:start).
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "Misc/python"))
from fullbright_lab.exr import read  # noqa: E402
from scenes import lab_args, names  # noqa: E402

PARTS = 4


def view_args(view: str) -> list[str]:
    """What the laboratory looks at; ValueError says what is wrong with the name."""
    kind, _, name = view.rpartition(":")
    if kind in ("code", "map") and name:
        return ["--scene" if kind == "code" else "--map", name]
    if kind or view not in names():
        raise ValueError(f"there is no view '{view}': code:NAME, map:NAME, or one of {', '.join(names())}")
    return lab_args(view)


def shares(moments: np.ndarray) -> dict[str, float]:
    """Of samples (frames, pixels, 3): second moment without lobes, second moment, sample."""
    uncovered, second = moments[..., 0].astype(np.float64), moments[..., 1].astype(np.float64)
    mean = moments[..., 2].mean(dtype=np.float64)
    total = second.sum()
    if not total > 0:
        raise ValueError("no sample brought any light")
    parts = [u.sum() / s.sum() for u, s in zip(np.array_split(uncovered, PARTS), np.array_split(second, PARTS)) if s.sum() > 0]
    largest = np.sort(second.ravel())[-max(1, second.size // 1000):].sum()
    return {"uncovered": uncovered.sum() / total, "least": min(parts), "most": max(parts),
            "moment": total / second.size / mean**2, "top": largest / total}


def measure(options: argparse.Namespace, view: str) -> dict[str, float]:
    with tempfile.TemporaryDirectory() as folder:
        command = [options.lab, "render", *view_args(view), "--estimator", options.estimator, "--size", options.size,
                   "--frames", f"0:{options.warmup + options.frames - 1}", "--format", "exr", "--out", folder, "--quiet",
                   "--set", "r_debug=guide_cover", "--set", "r_accumulate=0", "--set", "r_jitter=0"]
        if "--demo" in command:  # the view is a frame of it: hold it
            at = command.index("--frames")
            command[at + 1] = f"{options.at}:{options.at + options.warmup + options.frames - 1}"
        if options.basedir:
            command += ["--basedir", options.basedir]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        frames = sorted(Path(folder).glob("*.exr"))[-options.frames:]
        return shares(np.stack([np.stack([read(f)[0][c].ravel() for c in "RGB"], -1) for f in frames]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("views", nargs="+", metavar="VIEW")
    parser.add_argument("--lab", default="build/fullbright-lab")
    parser.add_argument("--estimator", default="mcpg", choices=["mcpg", "mcpg_nee"])
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--frames", type=int, default=32)
    parser.add_argument("--warmup", type=int, default=60)
    parser.add_argument("--at", type=int, default=0, help="first frame of a demo")
    parser.add_argument("--basedir")
    options = parser.parse_args()
    print("| view | uncovered share of the second moment | second moment / mean^2 | share of the top 0.1% |")
    print("| --- | --- | --- | --- |")
    for view in options.views:
        try:
            row = measure(options, view)
        except (ValueError, subprocess.CalledProcessError) as error:
            print(f"coverage.py: {view}: {error}", file=sys.stderr)
            return 1
        print(f"| {view} | {row['uncovered']:.2f} [{row['least']:.2f}, {row['most']:.2f}] | {row['moment']:.3g} | {row['top']:.2f} |",
              flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
