#!/usr/bin/env python3
"""What figures 7, 11, 12, 13 and 15 of Dittebrandt 2023 show besides errors (testdemos/suites/dittebrandt2023.json has these).

    mixture_figures.py [--program build/fullbright-lab] [--size 64x36] [--runs 8] [NAME ...]

A display shows light up to four times the mean of the reference, and not what a frame keeps in a few bright samples.

brightness   figures 7, 11, 13: what it shows of single frames, as a share of what it shows of the reference
borders      figure 12: squared error of what it shows, over the square of the reference, where two lamps shine alike, over that
             where one does
edges        figure 15: the same at edges of the shadow, over that where the lamp shines

Intervals are of 95% by Student's t over runs, which begin with nothing learnt. The reference is the mean of `nee` with 256 samples a
pixel and frame, at the same moments.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "Misc/python"))
from fullbright_lab.exr import read  # noqa: E402

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
SHOWN = 4.0  # a display's white, times the mean of the reference
T95 = {4: 3.182, 8: 2.365, 16: 2.131}  # Student's t by number of runs

# Estimators, each with its settings.
PAPER = {"ssmm": ["ssmm"], "1024 samples": ["ssmm", "r_ssmm_count=1024"]}
TILES = {f"tile of {tile}": ["ssmm", f"r_ssmm_tile={tile}"] for tile in (16, 32)}
REUSED = ["restir_di", "r_restir_candidates=1", "r_restir_neighbors=1"]
RESTIR = {"restir": [*REUSED, "r_restir_visibility=2"], "restir, confidence alone": [*REUSED, "r_restir_mis=1"]}
PT = {"pt": ["pt"]}


def luminance(image: np.ndarray) -> np.ndarray:
    return image @ LUMINANCE


def shown(image: np.ndarray, reference: np.ndarray) -> np.ndarray:
    return np.minimum(luminance(image), SHOWN * luminance(reference).mean())


def brightness(frames: np.ndarray, reference: np.ndarray) -> float:
    """What a display shows of `frames`, over what it shows of `reference`: [frame, row, column, colour] both."""
    return float(shown(frames, reference).mean() / shown(reference, reference).mean())


def relative_error(frames: np.ndarray, reference: np.ndarray, chosen: np.ndarray) -> float:
    """Mean squared error of what is shown over the mean square of the reference, in chosen pixels: [frame, row, column]."""
    wanted = shown(reference, reference)[chosen]
    return float(np.mean((shown(frames, reference)[chosen] - wanted) ** 2) / np.mean(wanted**2))


def lit(reference: np.ndarray) -> np.ndarray:
    """Where a surface is seen and lit: not lamps, which are far brighter than what they light, nor what is black."""
    y = luminance(reference)
    return (y > 0.02 * np.median(y)) & (y < 50 * np.median(y))


def borders(frames: np.ndarray, reference: np.ndarray) -> float:
    """Figure 12. Lamps are red, green and blue: a colour's share is that of its lamp."""
    share = np.sort(reference / np.maximum(reference.sum(axis=-1, keepdims=True), 1e-9), axis=-1)
    border, part = share[..., 1] > 0.8 * share[..., 2], share[..., 1] < 0.4 * share[..., 2]
    return relative_error(frames, reference, lit(reference) & border) / relative_error(frames, reference, lit(reference) & part)


def edges(frames: np.ndarray, reference: np.ndarray) -> float:
    """Figure 15. An edge of the shadow is where light falls or rises by half from a pixel to the next but one; the lamp shines on
    the brighter half of the others."""
    y = np.log(np.maximum(luminance(reference), 1e-6))
    edge = np.zeros(y.shape, bool)
    for axis in (1, 2):
        step = np.abs(np.roll(y, -1, axis) - np.roll(y, 1, axis)) > np.log(2)
        edge |= step
    seen, shines = lit(reference), luminance(reference) > np.median(luminance(reference))
    seen[:, [0, -1]] = seen[:, :, [0, -1]] = False  # which have no pixel beyond them
    return relative_error(frames, reference, seen & edge) / relative_error(frames, reference, seen & shines & ~edge)


AZAD = ["--map", "lab_azad", "--camera=-70,60,84,-2,79,0"]
TEARS = ["--map", "lab_tears", "--camera=60,-450,40,-6,97,0"]
MANY = ["--scene", "many"]

# Name: figure, view, frames, frames before these, samples a pixel, what is compared, what is measured.
Figure = tuple[str, list[str], tuple[int, int], int, int, dict, Callable[[np.ndarray, np.ndarray], float]]
FIGURES: dict[str, Figure] = {
    "fig7_tears": ("7: one lamp", TEARS, (32, 39), 32, 1, PT | PAPER | RESTIR, brightness),
    "fig7_azad": ("7: candles and sparks", AZAD, (32, 39), 32, 1, PT | PAPER | RESTIR, brightness),
    "fig7_many": ("7: many lights", MANY, (32, 39), 32, 1, PT | PAPER | RESTIR, brightness),
    "fig11": ("11: the rocket before it meets the wall", ["--scene", "rocket"], (36, 39), 36, 1, PT | PAPER | RESTIR, brightness),
    "fig12": ("12: borders between three lamps", ["--scene", "three_lamps"], (32, 39), 32, 1, PT | PAPER, borders),
    "fig13_many": ("13: many lights, 32 samples", MANY, (8, 11), 8, 32, PT | PAPER | TILES | RESTIR, brightness),
    "fig13_azad": ("13: candles and sparks, 32 samples", AZAD, (8, 11), 8, 32, PT | PAPER | TILES | RESTIR, brightness),
    "fig15": ("15: edges of a shadow that moves", ["--scene", "occluder"], (32, 39), 32, 1, PT | PAPER, edges),
}


def draw(program: str, figure: Figure, size: str, estimator: list[str], spp: int, seed: int) -> np.ndarray:
    _, view, (first, last), warmup, *_ = figure
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "render", *view, "--frames", f"{first}:{last}", "--warmup", warmup, "--size", size, "--spp", spp]
        command += ["--format", "exr", "--quiet", "--out", folder, "--estimator", estimator[0]]
        for cvar in [*estimator[1:], f"r_seed={seed}", "r_bounces=1", "r_jitter=0"]:
            command += ["--set", cvar]
        try:
            said = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        except OSError as error:
            sys.exit(f"mixture_figures.py: {program} cannot be run: {error.strerror}")
        if said.returncode != 0:
            sys.exit(f"mixture_figures.py: {' '.join(map(str, command))}: {said.stderr.strip()[-400:]}")
        frames = []
        for path in sorted(Path(folder).rglob("*.exr")):
            planes, _ = read(path)
            frames.append(np.stack([planes[c] for c in "RGB"], axis=-1).astype(np.float64))
    return np.stack(frames)


def interval(values: list[float]) -> str:
    mean, half = np.mean(values), T95[len(values)] * np.std(values, ddof=1) / np.sqrt(len(values))
    return f"{mean:.3g} ({mean - half:.3g} to {mean + half:.3g})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(FIGURES)}; all of them where none is named")
    parser.add_argument("--program", default="build/fullbright-lab")
    parser.add_argument("--size", default="64x36")
    parser.add_argument("--runs", type=int, choices=sorted(T95), default=8)
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in FIGURES]
    if unknown:
        parser.error(f"no figure {', '.join(unknown)}: {', '.join(FIGURES)}")
    columns = list(PT | PAPER | TILES | RESTIR)
    for number, name in enumerate(options.names or FIGURES):
        figure = FIGURES[name]
        reference = draw(options.program, figure, options.size, ["nee"], 256, 1000)
        if number == 0:
            print(f"| figure | measured | {' | '.join(f'`{c}`' for c in columns)} |\n|{' --- |' * (len(columns) + 2)}", flush=True)
        cells = dict.fromkeys(columns, "")
        for configuration, settings in figure[5].items():
            frames = (draw(options.program, figure, options.size, settings, figure[4], seed) for seed in range(options.runs))
            cells[configuration] = interval([figure[6](f, reference) for f in frames])
        print(f"| {figure[0]} | {figure[6].__name__} | {' | '.join(cells.values())} |", flush=True)


if __name__ == "__main__":
    main()
