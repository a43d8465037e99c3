#!/usr/bin/env python3
"""Measures pt on the laboratory's scenes, and makes their small references and pictures.

    measure.py references|errors|pictures [--build build] [--basedir DIR] [--spp N] [--device NAME] [NAME ...]
    measure.py pictures [--estimator NAME] [--noise RELMSE] [--more] ...
    measure.py table                      errors.csv as a table for Misc/docs/scenes.md

references  pt (or the scene's reference_estimator), 96x54, --spp samples (16384): references/NAME.exr, colours in halves and the
            variance of their mean
errors      pt with 1, 16 and 256 samples, four runs of other seeds each, against these: three lines in errors.csv
pictures    nee (or --estimator), 384x216, as often --spp samples (256) as it takes until its own relMSE, as exposed, is at most
            --noise (0.01): Misc/docs/pictures/scenes/NAME.jpg (by ImageMagick), and a row of pictures.csv. Samples are kept in
            BUILD/pictures: --more adds to those of an earlier run, whose map and settings must have been the same
"""

from __future__ import annotations

import argparse
import csv
import json
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "Misc/python"))
from fullbright_lab.exr import read, write  # noqa: E402
from scenes import HERE, lab_args, load, names  # noqa: E402

ROOT = HERE.parent
REFERENCES, ERRORS, NOISE = HERE / "references", HERE / "errors.csv", HERE / "pictures.csv"
PICTURES = ROOT / "Misc/docs/pictures/scenes"
PICTURE = "384x216"
WARMUP = 128  # frames that an estimator that learns begins with
SIZE, SAMPLES, RUNS = "96x54", (1, 16, 256), 4
CENTRES = "r_jitter=0"  # rays through the centres of pixels: edges are no error of an estimator
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


class Lab:
    def __init__(self, build: Path, basedir: str | None = None, device: str | None = None) -> None:
        self.program = build / "fullbright-lab"
        self.common = (["--basedir", basedir] if basedir else []) + ["--quiet"]
        self.common += ["--device", device] if device else []

    def run(self, command: str, *args) -> str:
        said = subprocess.run([self.program, command, *map(str, args)], capture_output=True, text=True, check=False)
        if said.returncode != 0:
            raise RuntimeError(f"fullbright-lab {command}: {said.stderr.strip()[-800:]}")
        return said.stdout

    def reference_args(self, name: str, out: Path, *sets: str, **options) -> list[str]:
        frame = load(name).get("frame", 0)
        args = [a for key, value in options.items() for a in (f"--{key}", value)]
        args = [*self.common, *lab_args(name), "--frame", frame, "--out", out, *args]
        return [str(a) for a in [*args, *[a for cvar in sets for a in ("--set", cvar)]]]

    def reference(self, name: str, out: Path, *sets: str, **options) -> None:
        self.run("reference", *self.reference_args(name, out, *sets, **options))

    def keep_evidence(self, test: str, reference: Path, image: Path, command: list[str]) -> Path:
        """Fills out/failed/TEST with what a failing picture test saw: image, reference, their difference (FLIP per pixel, black
        to white), and the command that makes the image again. Returns the folder."""
        folder = HERE.parent / "out" / "failed" / test
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        shutil.copy(image, folder / "image.exr")
        shutil.copy(reference, folder / "reference.exr")
        (folder / "command").write_text(shlex.join(command) + "\n")
        self.run("compare", reference, image, "--flip-map", folder / "difference.png")
        return folder


def without_folder(header: dict) -> dict:
    """The header of an EXR file with the demo's path as from the repository's root, as its view is named."""
    kind, value = header.get("fullbright.view", ("string", b""))
    return header | {"fullbright.view": (kind, value.replace(f"{ROOT}/".encode(), b""))} if value else header


def make_reference(lab: Lab, name: str, spp: int) -> None:
    REFERENCES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        whole = Path(scratch) / "whole.exr"
        lab.reference(name, whole, CENTRES, spp=spp, size=SIZE, estimator=load(name)["reference_estimator"])
        planes, header = read(whole)
        kept = {n: p for n, p in planes.items() if n in "RGB" or n.startswith("variance.")}
        write(REFERENCES / f"{name}.exr", kept, without_folder(header))


def errors_of(lab: Lab, name: str) -> list[dict]:
    """A row for each number of samples. The reference's own error is the mean of its variance."""
    reference = REFERENCES / f"{name}.exr"
    planes, header = read(reference)
    variance, relative = noise(planes)
    mean = float(np.mean([planes[c].mean() for c in "RGB"]))
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for spp in SAMPLES:
            tests = [Path(scratch) / f"{spp}_{k}.exr" for k in range(RUNS)]
            for k, path in enumerate(tests):
                lab.reference(name, path, CENTRES, f"r_seed={100 * spp + k + 1}", spp=spp, size=SIZE)
            found = json.loads(lab.run("compare", "--no-flip", "--json", "-", reference, *tests))
            of_runs = figures(found)
            rows.append({"scene": name, "spp": spp} | of_runs | {
                "reference_mse": variance, "reference_relmse": relative,
                "relative_variance": relative_variance(spp, float(of_runs["mse"]), mean)})
    return rows


def relative_variance(spp: int, mse: float, mean: float) -> str:
    """The variance of one sample's estimate, averaged over the picture, in squares of the picture's mean. It is the same for any
    number of samples, and known best from many."""
    return f"{spp * mse / mean**2:.3g}"


def noise(planes: dict, gain: float = 1.0) -> tuple[str, str]:
    """A picture's own MSE and relMSE, exposed by `gain`: the mean of its variance, plain and relative."""
    color, variance = (np.stack([planes[f"{key}{c}"] for c in "RGB"]).astype(float) for key in ("", "variance."))
    color, variance = gain * color, gain**2 * variance
    return f"{variance.mean():.3g}", f"{(variance / (color**2 + 0.01)).mean():.3g}"


def figures(found: dict) -> dict:
    result = {}
    for key in ("mse", "relmse"):
        values = [run[f"{key}_corrected"] for run in found["files"]]
        result |= {key: f"{np.mean(values):.3g}", f"{key}_low": f"{min(values):.3g}", f"{key}_high": f"{max(values):.3g}"}
    return result


def save(path: Path, rows: list[dict]) -> None:
    """Replaces these scenes' rows in a file."""
    old = list(csv.DictReader(path.open())) if path.exists() else []
    kept = [row for row in old if row["scene"] not in {r["scene"] for r in rows}] + rows
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(kept, key=lambda row: (row["scene"], int(row["spp"]))))


def kept_picture(lab: Lab, name: str) -> Path:
    return lab.program.parent / f"pictures/{name}_{PICTURE}.npz"


def load_picture(lab: Lab, name: str) -> tuple[dict, int]:
    """Planes RGB and their variances, float64, and how many samples they hold: nothing and 0 if none were kept."""
    path = kept_picture(lab, name)
    planes = dict(np.load(path)) if path.exists() else {"spp": np.array(0)}
    return planes, int(planes.pop("spp"))


def sample_picture(lab: Lab, name: str, spp: int, old: dict, done: int, estimator: str = "nee") -> tuple[dict, int]:
    """`spp` samples with a seed that no others have, together with `done` old ones; kept for `more`."""
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "picture.exr"
        lab.reference(name, out, "r_jitter=1", f"r_seed={done}", "r_nee_candidates=16", spp=spp,
                      warmup=WARMUP if estimator != "nee" else 0, size=PICTURE, estimator=estimator)
        drawn, _ = read(out)
    planes = {key: drawn[key].astype(float) for c in "RGB" for key in (c, f"variance.{c}")}
    share = spp / (done + spp)
    for key, plane in old.items():
        a, b = (share**2, (1 - share) ** 2) if key.startswith("variance") else (share, 1 - share)
        planes[key] = a * planes[key] + b * plane
    kept_picture(lab, name).parent.mkdir(exist_ok=True)
    np.savez(kept_picture(lab, name), spp=done + spp, **planes)
    return planes, done + spp


def exposure(planes: dict) -> float:
    """The factor that makes the middle of what is not black grey."""
    bright = np.maximum(np.stack([planes[c] for c in "RGB"], axis=-1), 0.0) @ LUMINANCE
    shown = bright[bright > 1e-4 * bright.max()]
    return 0.16 / max(np.exp(np.log(shown).mean()), 1e-9)


def make_picture(lab: Lab, name: str, spp: int, more: bool, goal: float, estimator: str = "nee") -> dict:
    """A row of pictures.csv. What is brighter than the screen is rolled off towards white, as film does."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    planes, samples = load_picture(lab, name) if more else ({}, 0)
    relmse = noise(planes, exposure(planes))[1] if planes else "inf"
    while float(relmse) > goal:
        planes, samples = sample_picture(lab, name, spp, planes, samples, estimator)
        relmse = noise(planes, exposure(planes))[1]
        print(f"{name}: {samples} samples, relMSE {relmse}", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        raw = Path(scratch) / "picture.ppm"
        light = exposure(planes) * np.maximum(np.stack([planes[c] for c in "RGB"], axis=-1), 0.0)
        light = (1.0 - np.exp(-1.1 * light)) ** 0.9
        srgb = np.where(light <= 0.0031308, light * 12.92, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
        pixels = np.round(np.clip(srgb, 0, 1) * 255).astype(np.uint8)
        raw.write_bytes(b"P6 %d %d 255\n" % pixels.shape[1::-1] + pixels.tobytes())
        subprocess.run(["convert", raw, "-quality", "90", PICTURES / f"{name}.jpg"], check=True)
    return {"scene": name, "estimator": estimator, "spp": samples, "relmse": relmse}


def table() -> str:
    """relMSE (and MSE in brackets) by samples; relative variance, from most samples; the reference's own relMSE; the picture's."""
    rows = list(csv.DictReader(ERRORS.open()))
    pictures = {row["scene"]: f"{row['relmse']} ({row['spp']} of {row['estimator']})" for row in csv.DictReader(NOISE.open())}
    lines = ["| scene | 1 spp | 16 spp | 256 spp | relative variance | reference's own | picture's own |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name in sorted({row["scene"] for row in rows}):
        of = {int(row["spp"]): row for row in rows if row["scene"] == name}
        cells = [f"{of[n]['relmse']} ({of[n]['mse']})" for n in SAMPLES if n in of]
        own = next(iter(of.values()))
        cells.append(of[max(of)]["relative_variance"])
        cells += [f"{own['reference_relmse']} ({own['reference_mse']})", pictures.get(name, "none yet")]
        lines.append(f"| `{name}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["references", "errors", "pictures", "table"])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--basedir")
    parser.add_argument("--device")
    parser.add_argument("--spp", type=int, help="samples a pixel of references, or of a picture at a time")
    parser.add_argument("--estimator", default="nee", help="pictures: one that is unbiased")
    parser.add_argument("--noise", type=float, default=0.01, help="pictures: relMSE of their own that is good enough")
    parser.add_argument("--more", action="store_true", help="pictures: add to the samples of an earlier run of the same scene")
    options = parser.parse_intermixed_args()
    if options.what == "table":
        print(table())
        return 0
    lab = Lab(options.build, options.basedir, options.device)
    try:
        for name in options.names or names():
            if options.what == "references":
                make_reference(lab, name, options.spp or 16384)
            elif options.what == "pictures":
                save(NOISE, [make_picture(lab, name, options.spp or 256, options.more, options.noise, options.estimator)])
            else:
                save(ERRORS, errors_of(lab, name))
            print(f"{options.what}: {name}", flush=True)
    except (RuntimeError, ValueError) as error:
        print(f"measure.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
