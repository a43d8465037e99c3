#!/usr/bin/env python3
"""Tables of Misc/docs/results.md from the results that are stored beside this file: no figure of theirs is typed by hand.

    tables.py keep DIR NAME    stores the results of a suite (DIR/results.json) as NAME.json, without curves and passes
    tables.py write            writes every table between its marks in results.md: <!-- table NAME --> ... <!-- end -->
    tables.py compare NAME A B gain of configuration B over A in each view of stored results, run by run, and where its interval leaves out 1
    tables.py check            exit status 1 where one is not what the stored results give
"""

from __future__ import annotations

import argparse
import json
import math
import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
DOCUMENT = HERE.parents[1] / "Misc" / "docs" / "results.md"
sys.path.insert(0, str(HERE.parents[1] / "Misc" / "python"))
from fullbright_lab import results  # noqa: E402

KEPT_ERRORS = ("mse", "mse_corrected", "relmse_corrected", "flip_hdr")
DIGITS = 5
FRAMES_OF_MEANS = (1, 4, 16, 64, 256)  # whose mean's error is kept, of runs so long
COLD_FRAMES = 8  # the first of a run, whose mean error is kept


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return [rounded(item) for item in value] if isinstance(value, list) else value


def keep(folder: str, name: str) -> None:
    data = results.read(folder).data
    for experiment in data["experiments"]:
        for point in experiment["points"]:
            curve = point.pop("curve", {})
            if point["frames"] >= FRAMES_OF_MEANS[-1] and "running_mse" in curve:
                point["mse_of_means"] = [curve["running_mse"][count - 1] for count in FRAMES_OF_MEANS]
            elif curve.get("running_mse"):
                point["mse_of_all"] = curve["running_mse"][-1]  # of the mean of all frames, those of the warm-up, too
                if point["warmup"] >= COLD_FRAMES:
                    point["mse_of_first"] = float(np.mean(curve["mse"][:COLD_FRAMES]))
            point.pop("passes", None)
            if "judge" in experiment:  # whose figures stand in "judged"
                point.pop("errors", None)
            elif "errors" in point:
                point["errors"] = {key: point["errors"][key] for key in KEPT_ERRORS if key in point["errors"]}
    text = json.dumps(rounded(data), indent=1)
    text = re.sub(r"\n {5,}", " ", text)  # a point a line
    (HERE / f"{name}.json").write_text(text + "\n")


def stored(name: str) -> results.Suite:
    return results.Suite(HERE, json.loads((HERE / f"{name}.json").read_text()))


def rows_of(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def made_with(suite: results.Suite) -> str:
    manifest = suite.manifest
    return f"{manifest['driver']}, {manifest['program']}."


def scaling() -> str:
    suite = stored("scaling")
    names = suite.experiments[0].configurations
    words = {"lights": "lights", "triangles": "triangles", "movers": "moving things", "pixels": "pixels", "bounces": "reflections",
             "reflections": "reflections", "samples": "samples"}
    rows = []
    for experiment in suite.experiments:
        fits = {fit["configuration"]: fit for fit in experiment.data["fits"] if fit["of"] == "estimator"}
        cells = [f"{fits[n]['exponent']:.2f} ({fits[n]['low']:.2f} to {fits[n]['high']:.2f})" if n in fits else "" for n in names]
        rows.append([f"{words.get(experiment.name, experiment.name)}, {experiment.values[0]:,.0f} to {experiment.values[-1]:,.0f}", *cells])
    return rows_of(["varied", *(f"`{n}`" for n in names)], rows) + "\n\n" + made_with(suite)


def number(value: float) -> str:
    return f"{value:.0f}" if value >= 99.5 else f"{value:.3g}"


def gain_of(experiment: results.Experiment, name: str, key: str) -> results.Interval:
    """Of a kept error over the first configuration's; nan where one is below the reference's noise."""
    own, first = (np.array([point[key] for point in experiment.chosen(n)]) for n in (name, experiment.configurations[0]))
    return results.over_runs(np.where(own > 0, first, np.nan) / np.where(own > 0, own, 1))


def marked(gain: results.Interval) -> str:
    """Bold where the interval is above 1, in italics where it is below; with a dagger where rare runs rule."""
    if math.isnan(gain.value):
        return "unknown"
    rare = "†" if gain.rare else ""
    return (f"**{number(gain.value)}**" if gain.low > 1 else f"*{number(gain.value)}*" if gain.high < 1 else number(gain.value)) + rare


def rivals(which: str) -> str:
    """Warm frames at equal samples and at equal time; or cold frames and the mean of all. Intervals are in the marks."""
    suite = stored("rivals")
    rows = []
    for experiment in suite.experiments:
        cells = []
        for name in experiment.configurations[1:]:
            if which == "warm":
                gains = [experiment.gain(name, equal) for equal in ("samples", "time")]
            else:
                gains = [gain_of(experiment, name, key) for key in ("mse_of_first", "mse_of_all")]
            cells.append(" / ".join(marked(gain) for gain in gains))
        rows.append([experiment.title, *cells])
    return rows_of(["view", *(f"`{n}`" for n in suite.experiments[0].configurations[1:])], rows) + "\n\n" + made_with(suite)


def gains_of(name: str, label: str, every_value: bool = False, without: tuple[str, ...] = ()) -> str:
    suite = stored(name)
    experiments = [e for e in suite.experiments if e.name not in without]
    names = list(dict.fromkeys(n for e in experiments for n in e.configurations if n != "denoised"))  # pictures alone
    rows = []
    for experiment in experiments:
        for value in experiment.values if every_value else experiment.values[:1]:
            cells = []
            for other in names[1:]:
                if not experiment.chosen(other, value):
                    cells.append("")
                    continue
                samples, time = (experiment.gain(other, equal, value) for equal in ("samples", "time"))
                interval = ("†" if samples.rare else "") + ("" if math.isnan(samples.low) else f" ({number(samples.low)} to {number(samples.high)})")
                cells.append(f"{number(samples.value)}{interval} / {number(time.value)}")
            of_value = f"; {experiment.what} {value:g}" if every_value and experiment.what else ""
            rows.append([experiment.title + of_value, *cells])
    return rows_of([label, *(f"`{n}`" for n in names[1:])], rows) + "\n\n" + made_with(suite)


def errors_of_means(name: str, experiment: str) -> str:
    """Relative to the first configuration's at one frame."""
    suite = stored(name)
    points = {n: suite[experiment].chosen(n) for n in suite[experiment].configurations}
    mse = {n: list(zip(*(point["mse_of_means"] for point in of))) for n, of in points.items()}
    unit = results.over_runs(next(iter(mse.values()))[0]).value
    rows = []
    for i, frames in enumerate(FRAMES_OF_MEANS):
        figures = [results.over_runs([value / unit for value in mse[n][i]]) for n in mse]
        rows.append([f"{frames}", *(f"{f.value:.2g} ({f.low:.2g} to {f.high:.2g})" for f in figures)])
    return rows_of(["frames", *(f"`{n}`" for n in mse)], rows) + "\n\n" + made_with(suite)


def shown(entry: dict, name: str, factor: float = 1, enough: bool = True) -> str:
    figure = results.judged_figure(entry, name)
    if math.isnan(figure.value):
        return ""
    interval = "" if math.isnan(figure.low) or not enough else f" ({factor * figure.low:.3g} to {factor * figure.high:.3g})"
    return f"{factor * figure.value:.3g}{interval}"


def judge(name: str) -> str:
    """FLIP of every configuration and of the reference's own noise, and all that the judge says of the last one, the game's."""
    suite = stored(name)
    names = suite.experiments[0].configurations
    rows = []
    seeds = min(len(e.chosen(names[0])) for e in suite.experiments if e.points)
    enough = seeds >= results.FEWEST_STEADY_RUNS
    views = [(e.name, e.data["judged"], f"{e.data['truth']['flip']:.3f}") for e in suite.experiments if e.points]
    for title, judged, noise in [*views, ("all", suite.data["judged"], "")]:
        of = {entry["configuration"]: entry for entry in judged}
        game = of[names[-1]]
        rows.append([title, *(shown(of[n], "flip", 1, enough) for n in names), noise, shown(game, "bias", 100, enough), shown(game, "flicker").split(" ")[0],
                     *(f"{game[key]['value']:.3g} ({game['most'][key]})" for key in ("isolated_dark", "isolated_bright")),
                     " / ".join(shown(of[n], "all_ms").split(" ")[0] for n in names)])
    head = ["view", *(f"FLIP: `{n}`" if i == 0 else f"`{n}`" for i, n in enumerate(names)), "of noise", f"bias of `{names[-1]}`, %", "flicker", "isolated dark", "isolated bright", "ms"]
    return rows_of(head, rows) + "\n\n" + made_with(suite)


def rivals_picture() -> str:
    """FLIP of every configuration, marked where its interval leaves the first one's out: bold below it, in italics above; the last rows are
    geometric means over views, of FLIP and of a frame's time."""
    suite = stored("rivals_picture")
    names = suite.experiments[0].configurations
    views = [e for e in suite.experiments if all(e.chosen(name) for name in names)]
    rows, flips, times = [], [], []
    for experiment in views:
        of = {entry["configuration"]: entry for entry in experiment.data["judged"]}
        told = [results.judged_figure(of[name], "flip") for name in names]
        flips.append([figure.value for figure in told])
        times.append([of[name]["all_ms"]["value"] for name in names])
        first = told[0]
        marks = [number(first.value)] + [f"**{number(f.value)}**" if f.high < first.low else f"*{number(f.value)}*" if f.low > first.high else number(f.value)
                                         for f in told[1:]]
        rows.append([experiment.name, *marks, f"{experiment.data['truth']['flip']:.3f}"])
    for title, values in (("FLIP, all", flips), ("ms, all", times)):
        rows.append([title, *map(number, np.exp(np.log(values).mean(axis=0))), ""])
    return rows_of(["view", *(f"`{n}`" for n in names), "of noise"], rows) + "\n\n" + made_with(suite)


def outside() -> str:
    data = json.loads((HERE / "outside.json").read_text())
    rows = []
    for name, view in data["views"].items():
        differs = "; ".join(view["differs"]) or "nothing"
        rows.append([f"`{name}`: {view['about']}", differs, f"{view['mean']:.4g}", f"{view['ratio']:.4f} ({view['low']:.4f} to {view['high']:.4f})",
                     f"{view['blocks_median_abs_z']:.2f}", f"{view['blocks_beyond_4']} of {view['blocks']}"])
    head = ["view", "differs from play", "mean", "Cycles over ours", "median abs(z) of blocks", "beyond 4"]
    return rows_of(head, rows) + f"\n\n{data['blender']}, {data['samples']} samples a pixel of each, {data['size']}."


def gpu() -> str:
    """Times of the traversal for GPUs beside that for processors, where both were measured; frame rates of timedemos."""
    data = json.loads((HERE / "gpu.json").read_text())
    rows = []
    for new in data["rows"]:
        old = [r for r in data["rows"] if (r["view"], r["estimator"], r["lanes"]) == (new["view"], new["estimator"], "processor")]
        if new["lanes"] != "gpu" or not old:
            continue
        times = [f"{old[0][key]:.3g} / {new[key]:.3g}" if key in new else "" for key in ("gbuffer", "paths", "fog", "all")]
        rows.append([new["view"], f"`{new['estimator']}`", *times, f"{new['all'] / old[0]['all']:.2f}"])
    head = ["view", "estimator", "G-buffer: `processor` / `gpu`, ms", "paths", "fog", "all", "ratio"]
    speeds = ", ".join(f"{t['size']} {t['fps']:.0f} frames a second ({t['device_ms']} ms of the device)" for t in data["timedemos"])
    return (rows_of(head, rows) + f"\n\n{data['device']}, {data['driver']}; {data['what']}.\n\n`timedemo hub`, denoised, `r_lanes processor`: {speeds}.")


TABLES = {
    "scaling": scaling,
    "alber2025": lambda: gains_of("alber2025", "figure"),
    "default": lambda: gains_of("default", "scene"),
    "guiding": lambda: gains_of("guiding", "view"),
    "reuse": lambda: gains_of("reuse", "view"),
    "rivals": lambda: rivals("warm"),
    "rivals_first_and_all": lambda: rivals("rest"),
    "rivals_picture": rivals_picture,
    "dittebrandt2023_rest": lambda: gains_of("dittebrandt2023_rest", "figure", True),
    "dittebrandt2023_moving": lambda: gains_of("dittebrandt2023_moving", "figure", True),
    "dittebrandt2023": lambda: gains_of("dittebrandt2023", "figure", True, ("fig16_cbox",)),
    "dittebrandt2023_means": lambda: errors_of_means("dittebrandt2023", "fig16_cbox"),
    "pantaleoni2020": lambda: gains_of("pantaleoni2020", "figure", True),
    "judge": lambda: judge("judge"),
    "judge_quick": lambda: judge("judge_quick"),
    "gpu": gpu,
    "outside": outside,
}


def compared(name: str, below: str, above: str) -> str:
    """Gains of one configuration over another, of each run, by view; and in how many views the interval begins above 1 or ends below it."""
    lines = []
    for equal in ("samples", "time"):
        ahead, behind, open_ = [], [], []
        for experiment in stored(name).experiments:
            if not {below, above} <= set(experiment.configurations):
                continue
            gain = experiment.gain(above, equal, over=below)
            text = f"{experiment.name} {number(gain.value)} ({number(gain.low)} to {number(gain.high)})"
            (ahead if gain.low > 1 else behind if gain.high < 1 else open_).append(text)
        lines += [f"{above} over {below} at equal {equal}"] + [
            f"  {what} in {len(views)}: {', '.join(views)}" for what, views in (("ahead", ahead), ("behind", behind), ("open", open_))]
    return "\n".join(lines)


MARKED = re.compile(r"(<!-- table (\w+) -->\n)(?:.*?\n)??(<!-- end -->)", re.S)


def written(text: str) -> str:
    unknown = sorted({name for _, name, _ in MARKED.findall(text)} - TABLES.keys())
    if unknown:
        raise ValueError(f"{DOCUMENT.name}: there is no table {', '.join(unknown)}")
    return MARKED.sub(lambda match: match[1] + TABLES[match[2]]() + "\n" + match[3], text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    keeping = commands.add_parser("keep")
    keeping.add_argument("folder")
    keeping.add_argument("name", choices=[name for name in TABLES if name not in ("gpu", "outside", "dittebrandt2023_means", "rivals_first_and_all")])
    comparing = commands.add_parser("compare")
    comparing.add_argument("name", choices=[name for name in TABLES if name not in ("gpu", "outside", "judge", "judge_quick")])
    comparing.add_argument("below")
    comparing.add_argument("above")
    commands.add_parser("write")
    commands.add_parser("check")
    options = parser.parse_args()
    if options.command == "keep":
        keep(options.folder, options.name)
        return 0
    if options.command == "compare":
        try:
            print(compared(options.name, options.below, options.above))
        except (OSError, ValueError, KeyError, IndexError) as error:
            print(f"{options.name}: {error}", file=sys.stderr)
            return 1
        return 0
    text = DOCUMENT.read_text()
    try:
        now = written(text)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    if options.command == "write":
        DOCUMENT.write_text(now)
    elif now != text:
        print("a table of Misc/docs/results.md is not what testdemos/results has: testdemos/results/tables.py write", file=sys.stderr)
        return 1
    else:
        print(f"{len(MARKED.findall(text))} tables are what the stored results give")
    return 0


if __name__ == "__main__":
    sys.exit(main())
