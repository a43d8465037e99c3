#!/usr/bin/env python3
"""An outside judge: views rendered by `fullbright-lab reference` and by Blender's Cycles, which share no line of code.

    testdemos/outside/compare.py [VIEW ...] [--samples N] [--size WxH] [--lab PROGRAM] [--librequake DIR] [--json FILE] [--pictures DIR]

Needs Blender (Debian: blender; tested with 3.4) and numpy. Each view is exported (`fullbright-lab export`) with Lambert's materials alone
(--lambert; `furnace` and `cbox` have no others), rendered N times a pixel by `nee` here and, in four parts of different seeds, by Cycles (cycles.py).
What is told: mean radiance here and there; their ratio with a 95% interval; and z-scores of blocks of 8x8 pixels, by the
reference's own variance and by the scatter of Cycles' parts: how many lie beyond what chance allows. Exit status 1: a ratio's
interval does not hold 1, within --tolerance.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "Misc" / "python"))
from fullbright_lab import exr  # noqa: E402

PARTS = 4  # of Cycles' samples
BLOCK = 8  # pixels
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
STUDENT_95 = 3.182  # of PARTS - 1 degrees of freedom, two-sided
COARSE = 0.03  # what Cycles errs by where it looks for what glows
NO_SKY = ["--set", "r_emit_sky=0", "--set", "r_emit_sun=0"]


@dataclass
class View:
    about: str
    arguments: list[str]
    librequake: bool = False
    looked_for: bool = False  # Cycles looks for what glows, and errs there; without, small lamps take too many samples
    differs: list[str] = field(default_factory=list)  # from the view as it is played


VIEWS = {
    "furnace": View("closed form: 1.75 everywhere", ["--scene", "furnace_objects"]),
    "cbox": View("the Cornell box, two reflections", ["--scene", "cbox"]),
    "cbox4": View("the same, four", ["--scene", "cbox", "--set", "r_bounces=4"]),
    "many": View("400 small spheres that glow", ["--scene", "many"], looked_for=True),
    "tears": View("a map: hidden light in a cavern, textures, models", ["--map", "lab_tears", "--camera=60,-450,40,-6,97,0"], differs=["Lambert"]),
    "portal": View("a map: four reflections, none of one", ["--map", "lab_portal", "--camera=-180,-240,110,0,66,0", "--set", "r_bounces=4"],
                   looked_for=True, differs=["Lambert"]),
    "villa": View("a map: its lamps", ["--map", "lab_villa", "--camera=-404,-124,64,-4,26,0", "--set", "r_bounces=4", *NO_SKY],
                  looked_for=True, differs=["Lambert", "no sky, no sun: one that differs by direction is no surface of glTF's"]),
    "start": View("LibreQuake's start", ["--map", "start", "--camera=-1152,-672,31,0,90,0", "--set", "r_water=0", *NO_SKY], librequake=True,
                  differs=["Lambert", "no sky, no sun"]),
}


# Blender's Python takes its modules from where the first python of PATH has them; the system's has numpy.
SYSTEM_FIRST = os.environ | {"PATH": "/usr/bin:" + os.environ.get("PATH", "")}


def run(command: list[str]) -> str:
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=SYSTEM_FIRST)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout.strip()[-2000:]}")
    return done.stdout


def luminance(planes: dict[str, np.ndarray], prefix: str = "") -> np.ndarray:
    return sum(weight * planes[prefix + c].astype(np.float64) for weight, c in zip(LUMINANCE, "RGB"))


def in_blocks(plane: np.ndarray) -> np.ndarray:
    h, w = (n // BLOCK * BLOCK for n in plane.shape)
    return plane[:h, :w].reshape(h // BLOCK, BLOCK, w // BLOCK, BLOCK).mean((1, 3)).ravel()


def judged(here: dict[str, np.ndarray], there: list[dict[str, np.ndarray]]) -> dict[str, float]:
    """Means, their ratio's interval, blocks' z-scores."""
    ours, variance = luminance(here), luminance(here, "variance.")
    theirs = [luminance(p) for p in there]
    mean, other = ours.mean(), np.mean([t.mean() for t in theirs])
    own_error = math.sqrt(variance.sum()) / variance.size
    other_error = np.std([t.mean() for t in theirs], ddof=1) / math.sqrt(PARTS)
    half = math.hypot(1.96 * own_error, STUDENT_95 * other_error) / mean
    blocks = np.array([in_blocks(t) for t in theirs])
    scatter = in_blocks(variance) / BLOCK**2 + blocks.var(0, ddof=1) / PARTS
    z = (in_blocks(ours) - blocks.mean(0)) / np.sqrt(np.maximum(scatter, 1e-12 * mean**2))
    return {"mean": mean, "cycles_mean": other, "ratio": other / mean, "low": other / mean - half, "high": other / mean + half,
            "blocks": z.size, "blocks_median_abs_z": float(np.median(np.abs(z))), "blocks_beyond_4": int((np.abs(z) > 4).sum())}


def picture(path: Path, here: dict[str, np.ndarray], there: list[dict[str, np.ndarray]]) -> None:
    """Here, there and four times the difference beside each other, as a PPM: the mean at 20% grey."""
    a = np.stack([here[c] for c in "RGB"], -1)
    b = np.mean([np.stack([t[c] for c in "RGB"], -1) for t in there], 0)
    joined = np.concatenate([a, b, 4 * np.abs(a - b)], 1) * (0.2 / max(float(a.mean()), 1e-12))
    bytes_ = (np.clip(joined, 0, 1) ** (1 / 2.2) * 255).astype(np.uint8)
    path.write_bytes(b"P6 %d %d 255\n" % (joined.shape[1], joined.shape[0]) + bytes_.tobytes())


def compare(name: str, options: argparse.Namespace, scratch: Path) -> dict[str, float]:
    view = VIEWS[name]
    arguments = [*view.arguments, "--size", options.size, "--lambert"]
    if view.librequake:
        arguments += ["--basedir", options.librequake]
    scene, reference = scratch / f"{name}.gltf", scratch / f"{name}.exr"
    told = run([options.lab, "export", *arguments, "--out", str(scene)])
    print(f"{name}: {view.about}; {told.splitlines()[0].split(': ')[-1]}", flush=True)
    run([options.lab, "reference", *arguments, "--quiet", "--estimator", "nee", "--set", "r_jitter=1", "--spp", str(options.samples),
         "--out", str(reference)])
    parts = []
    for seed in range(1, PARTS + 1):
        out = scratch / f"{name}.{seed}.exr"
        said = run([options.blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python", str(HERE / "cycles.py"), "--",
                    str(scene), str(out), str(max(options.samples // PARTS, 1)), str(seed), str(int(view.looked_for))])
        if not out.exists():
            raise RuntimeError(f"{name}: Blender wrote no picture:\n{said[-2000:]}")
        parts.append(exr.read(out)[0])
    here = exr.read(reference)[0]
    if options.pictures:
        Path(options.pictures).mkdir(parents=True, exist_ok=True)
        picture(Path(options.pictures) / f"{name}.ppm", here, parts)
    return judged(here, parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("views", nargs="*", metavar="VIEW", help=f"of {', '.join(VIEWS)}; default: all")
    parser.add_argument("--samples", type=int, default=4096, help="samples a pixel of each program (4096)")
    parser.add_argument("--size", default="96x54", help="WIDTHxHEIGHT (96x54)")
    parser.add_argument("--tolerance", type=float, default=0.003, help="by how much a ratio's interval may miss 1 (0.003; where Cycles looks for what glows, 0.03)")
    parser.add_argument("--lab", default=str(HERE.parents[1] / "build" / "fullbright-lab"), help="the laboratory (build/fullbright-lab)")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--librequake", default=os.environ.get("FULLBRIGHT_TEST_DATA", str(HERE.parents[1] / ".." / "shared" / "librequake")),
                        help="LibreQuake's folder; views of it are left out where it is absent")
    parser.add_argument("--json", help="file for the figures")
    parser.add_argument("--pictures", help="folder for pictures: here, Cycles, four times the difference")
    options = parser.parse_args()
    unknown = [name for name in options.views if name not in VIEWS]
    if unknown:
        parser.error(f"no view {', '.join(unknown)}; there are {', '.join(VIEWS)}")
    try:
        version = run([options.blender, "--version"]).splitlines()[0]
    except OSError:
        print("skipped: there is no Blender (Linux/install-deps.sh outside)")
        return 77
    try:
        run([options.blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python-expr", "import numpy"])
    except RuntimeError:
        print("skipped: Blender's Python has no numpy (Debian: python3-numpy)")
        return 77
    results, apart = {"blender": version, "samples": options.samples, "size": options.size, "views": {}}, []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.views or VIEWS:
            if VIEWS[name].librequake and not (Path(options.librequake) / "id1").is_dir():
                print(f"{name}: left out, there is no LibreQuake in {options.librequake}")
                continue
            r = compare(name, options, Path(folder))
            results["views"][name] = r | {"about": VIEWS[name].about, "differs": VIEWS[name].differs}
            tolerance = max(options.tolerance, COARSE if VIEWS[name].looked_for else 0)
            agrees = r["low"] - tolerance <= 1 <= r["high"] + tolerance
            print(f"  {r['mean']:.6g} here, {r['cycles_mean']:.6g} Cycles: ratio {r['ratio']:.4f} [{r['low']:.4f}, {r['high']:.4f}]; "
                  f"{r['blocks']} blocks, median |z| {r['blocks_median_abs_z']:.2f} (0.7 to 0.8 by chance), {r['blocks_beyond_4']} beyond 4"
                  f"{'' if agrees else '  DIFFERS'}", flush=True)
            if not agrees:
                apart.append(name)
    if options.json:
        Path(options.json).write_text(json.dumps(results, indent=1) + "\n")
    return 1 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
