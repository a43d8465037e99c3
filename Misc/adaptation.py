#!/usr/bin/env python3
"""Measures how fast a learning estimator follows a moving light and forgets a vanished one.

Runs `fullbright-lab bench` on the scenes `rocket`, `lightsout`, `horde` and `candles_flicker` and prints tables of the error, frame by frame.

    Misc/adaptation.py [--lab build/fullbright-lab] [--estimator mcpg] [--size 160x90] [--reference-spp 1024] [--repeats 8]
                       [--keep DIR] [rocket|lightsout|flashes|flicker]

rocket: MSE of single frames of pt divided by that of the estimator (gain at equal samples), with and without prediction
(r_mc_predict): of the mean over the runs, and of the median run, which rare bright samples do not affect. "Settled" is
the gain for the same frame held still, after 60 frames of learning; the difference is the cost of motion. "Tracked"
means: from this frame on the median run's gain stays above 5.

lightsout: relMSE and MAPE of frames without the lamp, eight together, divided by those of the estimator when it has never seen
the lamp and has learnt for as many frames; with and without the light-loss heuristic (r_mc_loss) and the irradiance
cache (r_mc_cache), each divided by its own cold start. "Recovered" means: from these frames on the ratio stays below 1.1.

flashes: shots and explosions of the demo `horde`, a frame of it every 0.05 s: relMSE of pt divided by that of nee, and of the
estimator. (MSE is that of overexposed fireballs, which shine on themselves: there pt is as good as can be.)

flicker: the same of the scene `candles_flicker`, a frame every 0.05 s, in which each of the candles burns otherwise.
"""

import argparse
import csv
import pathlib
import statistics
import subprocess
import tempfile

TRACKED = 5
RECOVERED = 1.1
WINDOW = 8
LIGHTS_OUT = 100  # kLightsOutFrame of Quake/scene/in_code/scenes_in_motion.h


HORDE = str(pathlib.Path(__file__).resolve().parent.parent / "testdemos/horde.dem")


def bench(options, scene, frames, warmup, configurations, name, *more):
    """Runs the bench; returns {configuration: {frame: [record of each run]}}, frames counted from the first measured."""
    out = options.keep / f"{name}.csv"
    command = [options.lab, "bench", "--demo" if scene.endswith(".dem") else "--scene", scene, "--size", options.size, "--frames", frames]
    command += ["--warmup", str(warmup), "--repeats", str(options.repeats), "--quiet"]
    command += ["--reference-spp", str(options.reference_spp), "--reference-dir", str(options.keep / "references")]
    command += ["--csv", str(out)]
    command += more
    for configuration in configurations:
        command += ["--config", configuration]
    print("$", " ".join(command), flush=True)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    records = {}
    with open(out, newline="") as file:
        for row in csv.DictReader(file):
            frame = int(row["frame"]) - warmup
            if frame >= 0:
                records.setdefault(row["configuration"], {}).setdefault(frame, []).append(row)
    return records


def mean(records, column):
    return sum(float(r[column]) for r in records) / len(records)


def stays(frames, good):
    """The first frame from which on all values are good; None if the last is not."""
    first = None
    for frame in reversed(frames):
        if not good(frame):
            break
        first = frame
    return first


def typical(records, column):
    return statistics.median(float(r[column]) for r in records)


def rocket(options):
    configurations = ["pt:r_estimator=pt"]
    configurations += [f"{c}:r_estimator={options.estimator},r_mc_predict={on}" for c, on in (("with", 1), ("without", 0))]
    runs = bench(options, "rocket", "0:20", 0, configurations, "rocket")
    settled = {}
    for frame in (5, 12, 20):
        held = bench(options, "rocket", f"{frame}:{frame + 7}", 60, configurations[:2], f"rocket_{frame}", "--hold")
        pooled = {c: [r for f in held[c].values() for r in f] for c in held}
        settled[frame] = [
            of(pooled["pt"], "mse_corrected") / of(pooled["with"], "mse_corrected") for of in (mean, typical)
        ]
    frames = sorted(runs["pt"])
    print("| frame | MSE of pt | gain, with prediction | without | typical, with | without | settled: gain, typical |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    typical_gain = {}
    for f in frames:
        gains = []
        for of in (mean, typical):
            base = of(runs["pt"][f], "mse_corrected")
            gains += [base / of(runs[c][f], "mse_corrected") for c in ("with", "without")]
        typical_gain[f] = dict(zip(("with", "without"), gains[2:]))
        still = " {:.2f}, {:.2f}".format(*settled[f]) if f in settled else ""
        base = mean(runs["pt"][f], "mse_corrected")
        print(f"| {f} | {base:.4g} | " + " | ".join(f"{g:.2f}" for g in gains) + f" |{still} |")
    for c in ("with", "without"):
        overall = sum(mean(runs["pt"][f], "mse_corrected") for f in frames[1:]) / sum(
            mean(runs[c][f], "mse_corrected") for f in frames[1:])
        first = stays(frames[1:], lambda f: typical_gain[f][c] > TRACKED)
        print(f"{c} prediction: gain over frames 1 to 20 {overall:.2f}; tracked from frame {first}")


def lightsout(options):
    frames = f"{LIGHTS_OUT}:{LIGHTS_OUT + options.frames - 1}"
    variants = {"loss": "", "none": ",r_mc_loss=0", "uncached": ",r_mc_cache=0", "neither": ",r_mc_loss=0,r_mc_cache=0"}
    configurations = [f"{name}:r_estimator={options.estimator}{sets}" for name, sets in variants.items()]
    warm = bench(options, "lightsout", frames, 60, configurations, "lightsout_warm")
    cold = bench(options, "lightsout", frames, 0, configurations, "lightsout_cold")
    columns = [(c, of) for c in variants for of in ("relmse_corrected", "mape")]
    print("| frames without the lamp | with the heuristic | without | no cache, with | no cache, without |")
    print("| --- | --- | --- | --- | --- |")
    ratios = {column: [] for column in columns}
    for first in range(0, options.frames, WINDOW):
        window = range(first, min(first + WINDOW, options.frames))
        for c, of in columns:
            ratios[c, of].append(sum(mean(warm[c][f], of) for f in window) / sum(mean(cold[c][f], of) for f in window))
        cells = [" and ".join(f"{ratios[c, of][-1]:.2f}" for of in ("relmse_corrected", "mape")) for c in variants]
        print(f"| {first + 1} to {window[-1] + 1} | " + " | ".join(cells) + " |")
    for c in variants:
        for of in ("relmse_corrected", "mape"):
            first = stays(list(range(len(ratios[c, of]))), lambda i: ratios[c, of][i] <= RECOVERED)
            words = "not yet" if first is None else f"from frame {first * WINDOW + 1} on"
            print(f"{variants[c] or 'default'}: within {100 * (RECOVERED - 1):.0f}% of a cold start by {of}: {words}")


def flashes(options):
    in_motion(options, HORDE, "flashes")


def flicker(options):
    in_motion(options, "candles_flicker", "flicker")


def in_motion(options, scene, experiment):
    names = ["nee", options.estimator]
    configurations = [f"{name}:r_estimator={name}" for name in ["pt", *names]]
    runs = bench(options, scene, "24:55", 24, configurations, experiment, "--fps", "20")
    print("| frame | relMSE of pt | " + " | ".join(f"gain of {name}, typical" for name in names) + " |")
    print("| --- | --- | --- | --- |")
    worst = {}
    for f in sorted(runs["pt"]):
        cells = []
        for name in names:
            gains = [of(runs["pt"][f], "relmse_corrected") / of(runs[name][f], "relmse_corrected") for of in (mean, typical)]
            worst.setdefault(name, []).append(gains)
            cells.append("{:.1f}, {:.1f}".format(*gains))
        print(f"| {f + 24} | {mean(runs['pt'][f], 'relmse_corrected'):.4g} | " + " | ".join(cells) + " |")
    for name in names:
        gains = list(zip(*worst[name]))
        print(f"{name}: least gain " + ", ".join(f"{min(g):.1f}" for g in gains) +
              "; median frame " + ", ".join(f"{statistics.median(g):.1f}" for g in gains))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="rocket, lightsout, flashes, flicker; all if none is named")
    parser.add_argument("--lab", default="build/fullbright-lab")
    parser.add_argument("--estimator", default="mcpg", help="one that learns")
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--reference-spp", type=int, default=1024)
    parser.add_argument("--repeats", type=int, default=8)
    parser.add_argument("--frames", type=int, default=32, help="of lightsout, from the one without the lamp on")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for references and CSV files")
    options = parser.parse_args()
    experiments = {"rocket": rocket, "lightsout": lightsout, "flashes": flashes, "flicker": flicker}
    with tempfile.TemporaryDirectory() as folder:
        if options.keep is None:
            options.keep = pathlib.Path(folder)
        options.keep.mkdir(parents=True, exist_ok=True)
        for scene in options.scenes or experiments:
            experiments[scene](options)


if __name__ == "__main__":
    main()
