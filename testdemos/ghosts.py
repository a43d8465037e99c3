#!/usr/bin/env python3
"""Whether the denoiser leaves ghosts of what moved, and keeps sharp what moves: of water's waves, say.

Renders a span of frames as the game shows them (r_denoise 1, linear pictures), and each of them twice with many samples and no
denoiser. Of luminance y, as y / (y + mean), prints

ghosts     how much of the former frame is in a frame: the factor g of the best fit of (picture - truth) by
           g (former truth - truth); 0: none, 1: the picture is a frame late
sharpness  how much of the detail is in a frame: the factor of the best fit of the picture's detail (what is not in the mean of
           5x5 pixels) by the truth's; 1: all of it
error      mean square of (picture - truth), less the truth's noise

each with the smallest and the largest of four parts of the frames. The truth is noisy: no sum has one noise twice, since the two
references of a frame are independent.

    testdemos/ghosts.py [--lab build/fullbright-lab] [--view "--map start --camera 0,-300,130,60,90,0"] [--size 128x72] [--frames 12]
                        [--at 60] [--spp 512] [--basedir DIR] [--set CVAR=VALUE ...] [NAME:CVAR=VALUE,... ...]

NAME:...: a configuration of the picture; default: one, of the game's own settings.
"""

from __future__ import annotations

import argparse
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "Misc/python"))
from fullbright_lab.exr import read  # noqa: E402

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
DETAIL, PARTS = 5, 4


def detail(frames: np.ndarray) -> np.ndarray:
    """Of (frames, rows, columns): less the mean of DETAIL x DETAIL pixels; without the edge, where there is no such mean."""
    windows = np.lib.stride_tricks.sliding_window_view(frames, (DETAIL, DETAIL), axis=(1, 2))
    edge = DETAIL // 2
    return frames[:, edge:-edge, edge:-edge] - windows.mean((-1, -2))


def figures(picture: np.ndarray, truth: np.ndarray, other: np.ndarray) -> dict[str, float]:
    """Of frames (frames, rows, columns), the first of which is only a past. `truth`, `other`: independent references."""
    late, late_other = truth[:-1] - truth[1:], other[:-1] - other[1:]
    fine = [detail(x[1:]) for x in (picture, truth, other)]
    moved = float((late * late_other).sum())
    if not moved > 0:
        raise ValueError("nothing moves that the references can tell from their noise: more samples, or another view")
    return {"ghosts": float(((picture - truth)[1:] * late_other).sum()) / moved,
            "sharpness": float((fine[0] * fine[2]).sum() / (fine[1] * fine[2]).sum()),
            "error": float(((picture - truth) * (picture - other))[1:].mean())}


def with_parts(picture: np.ndarray, truth: np.ndarray, other: np.ndarray) -> dict[str, tuple[float, float, float]]:
    """Of all frames, and the smallest and the largest of PARTS of them."""
    whole = figures(picture, truth, other)
    ends = np.linspace(1, len(picture), PARTS + 1).astype(int)
    parts = [figures(*(x[a - 1:b] for x in (picture, truth, other))) for a, b in zip(ends[:-1], ends[1:]) if b > a]
    return {name: (value, min(p[name] for p in parts), max(p[name] for p in parts)) for name, value in whole.items()}


def render(options: argparse.Namespace, *more: str) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        command = [options.lab, "render", *shlex.split(options.view), "--size", options.size, "--format", "exr", "--out", folder,
                   "--frames", f"{options.at}:{options.at + options.frames - 1}", "--quiet", "--set", "r_accumulate=0", "--set", "r_jitter=0", "--set", "r_texture_filter=2", *more]
        command += ["--basedir", options.basedir] if options.basedir else []
        command += [a for cvar in options.set for a in ("--set", cvar)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        frames = [read(path)[0] for path in sorted(Path(folder).glob("*.exr"))]
        return np.stack([np.stack([f[c] for c in "RGB"], -1).astype(np.float64) @ LUMINANCE for f in frames])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("configurations", nargs="*", default=["default:"])
    parser.add_argument("--lab", default="build/fullbright-lab")
    parser.add_argument("--view", default="--map start --camera 0,-300,130,60,90,0 --set r_water=1")
    parser.add_argument("--size", default="128x72")
    parser.add_argument("--frames", type=int, default=12)
    parser.add_argument("--at", type=int, default=60, help="frames before the first; of these the denoiser has its past")
    parser.add_argument("--spp", type=int, default=512, help="samples of a reference")
    parser.add_argument("--basedir")
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_intermixed_args()
    try:
        truths = [render(options, "--estimator", "nee", "--spp", str(options.spp), "--set", f"r_seed={seed}")
                  for seed in (1, 2)]
        mean = (truths[0].mean() + truths[1].mean()) / 2
        shown = [t / (t + mean) for t in truths]
        for configuration in options.configurations:
            name, _, sets = configuration.partition(":")
            more = [a for cvar in sets.split(",") if cvar for a in ("--set", cvar)]
            picture = render(options, "--estimator", "mcpg_nee", "--denoised", "--warmup", str(options.at), *more)
            said = with_parts(picture / (picture + mean), *shown)
            print(f"{name:24}", *(f"{k} {v:.4f} [{a:.4f}, {b:.4f}]" for k, (v, a, b) in said.items()), sep="  ", flush=True)
    except (ValueError, subprocess.CalledProcessError) as problem:
        print(f"ghosts.py: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
