"""Results of suites (Misc/docs/formats.md, "Suites of experiments"), with what figures are drawn from: curves over runs, intervals,
gains. Arrays have a row for each run."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fullbright_lab import exr

FORMAT = "fullbright suite results 1"
FEWEST_RUNS = 8  # of which an interval of errors is told: with fewer, rare samples are missing more often than it allows for
FEWEST_STEADY_RUNS = 4  # of times


def student_95(freedom: int) -> float:
    """Student's t of which |T| <= t in 95% of cases: T = sqrt(freedom) tan(angle), whose density is cos(angle)^(freedom - 1)."""
    angles = np.linspace(0, np.pi / 2, 20001)
    density = np.cos(angles) ** (freedom - 1)
    within = np.concatenate([[0.0], np.cumsum(density[1:] + density[:-1])])
    return float(np.sqrt(freedom) * np.tan(np.interp(0.95 * within[-1], within, angles)))


@dataclass
class Interval:
    """A value with its 95% interval."""

    value: float
    low: float
    high: float
    rare: bool = False  # rare runs rule the mean, so that it promises too much


def rare_runs_rule(values) -> bool:
    """Whether the mean of errors over runs is more than a tenth above what a typical run has (as `bench` tells it)."""
    values = np.asarray(values, float)
    return bool(len(values) > 1 and (values > 0).all() and values.mean() > 1.1 * np.exp(np.log(values).mean()))


def over_runs(values, fewest: int = FEWEST_RUNS) -> Interval:
    """Geometric mean of figures that multiply (errors, times, ratios of these) over independent runs, with Student's t of their logarithms;
    nan where one is not positive, and for the interval of fewer runs than `fewest`, as in the laboratory (Quake/lab/statistics.h)."""
    values = np.asarray(values, float)
    if len(values) == 0 or not (values > 0).all():
        return Interval(np.nan, np.nan, np.nan)
    logs = np.log(values)
    center = logs.mean()
    if len(values) < max(fewest, 2):
        return Interval(float(np.exp(center)), np.nan, np.nan)
    half = student_95(len(values) - 1) * logs.std(ddof=1) / np.sqrt(len(values))
    return Interval(*(float(np.exp(center + by)) for by in (0, -half, half)))


class Experiment:
    """One experiment of a suite: its description and its points."""

    def __init__(self, folder: Path, data: dict):
        self.folder, self.data = folder, data
        self.name, self.title, self.points = data["name"], data["title"], data["points"]
        self.configurations = [configuration["name"] for configuration in data["configurations"]]
        vary = data["vary"]
        self.what: str | None = vary and vary["what"]
        self.label = "milliseconds that the estimator may take" if self.what == "time" else self.what
        self.values: list[float] = vary["values"] if vary else [0.0]
        self.judged = "judge" in data  # pictures that a player sees, in place of raw samples

    def chosen(self, configuration: str, value: float | None = None) -> list[dict]:
        """Points of a configuration, at one value (default: the first), a run each."""
        value = self.values[0] if value is None else value
        return sorted((point for point in self.points if point["configuration"] == configuration and point["value"] == value),
                      key=lambda point: point["repeat"])

    def curve(self, configuration: str, name: str, value: float | None = None) -> np.ndarray | None:
        """(runs, frames) of "mse", "rel_mse", "running_mse", "running_rel_mse", "warm_rel_mse" (of frames behind the warm-up alone) or "milliseconds"; nan where a frame was not
        measured; None where there is no such curve."""
        rows = [point["curve"][name] for point in self.chosen(configuration, value) if name in point.get("curve", {})]
        return np.array(rows, float) if rows else None

    def errors(self, configuration: str, name: str, value: float | None = None) -> np.ndarray:
        """(runs,) of a metric of `fullbright-lab compare`, mean over the measured frames."""
        return np.array([point["errors"][name] for point in self.chosen(configuration, value)], float)

    def milliseconds(self, configuration: str, of: str = "estimator", value: float | None = None) -> np.ndarray:
        """(runs,) of the "estimator"'s own passes or of the whole "frame", medians."""
        return np.array([point["milliseconds"][of] for point in self.chosen(configuration, value)], float)

    def gain(self, configuration: str, equal: str, value: float | None = None, over: str | None = None) -> Interval:
        """How many times smaller the error (MSE less the reference's variance) is than that of the configuration `over` (default: the first), at
        equal "samples" or "time": geometric mean of the runs' own gains; nan where a run has no error above the reference's noise."""

        def rows(name):
            points = self.chosen(name, value)
            return np.array([[p["errors"].get("mse_corrected", p["errors"]["mse"]), p["samples"], p["milliseconds"]["estimator"]] for p in points], float).T

        mse, samples, time = rows(over or self.configurations[0])
        own, own_samples, own_time = rows(configuration)
        known = (mse > 0) & (own > 0)
        ratios = np.where(known, mse / np.where(known, own, 1), np.nan)
        gain = over_runs(ratios * (samples / own_samples if equal == "samples" else time / own_time))
        gain.rare = rare_runs_rule(mse) or rare_runs_rule(own)
        return gain

    def pictures(self, value_index: int = 0) -> dict[str, np.ndarray]:
        """(H, W, 3) float32 linear radiance by configuration, and the "reference"; empty where none were kept."""
        found = {}
        for name in [*self.configurations, "reference"]:
            path = self.folder / "pieces" / f"{self.name}.{value_index}.0.{name}.exr"
            if path.exists():
                planes, _ = exr.read(path)
                found[name] = np.stack([planes[channel] for channel in "RGB"], axis=-1)
        return found


def judged_figure(entry: dict, name: str) -> Interval:
    """A figure of an entry of a "judged" list, with the judge's own interval over seeds (Student's t); nan where it is unknown."""
    value = entry[name]["value"]
    low, high = entry[name]["interval95"]
    return Interval(*(np.nan if number is None else number for number in (value, low, high)))


class Suite:
    """results.json of a folder."""

    def __init__(self, folder: Path, data: dict):
        self.folder, self.data = folder, data
        self.title, self.manifest, self.complete = data["title"], data["manifest"], data["complete"]
        self.experiments = [Experiment(folder, experiment) for experiment in data["experiments"]]

    def __getitem__(self, name: str) -> Experiment:
        for experiment in self.experiments:
            if experiment.name == name:
                return experiment
        raise KeyError(f"{self.folder} has no experiment {name!r}; it has {', '.join(experiment.name for experiment in self.experiments)}")


NUMBER = (int, float, type(None))  # null: not a number
MEMBERS = {"": {"title": str, "manifest": dict, "complete": bool, "experiments": list},
           "experiments": {"name": str, "title": str, "points": list, "configurations": list, "vary": (dict, type(None)), "command": str},
           "configurations": {"name": str},
           "points": {"configuration": str, "value": NUMBER, "repeat": int, "samples": NUMBER, "errors": dict, "milliseconds": dict}}


def check(data, what: str = "", of: str = "") -> None:
    """Raises ValueError, naming the place, where a member of results is missing or of another kind than formats.md says."""
    if not isinstance(data, dict):
        raise ValueError(f"{what or 'the file'}: an object is wanted")
    for name, kind in MEMBERS[of].items():
        if name not in data and not (of == "points" and name in ("samples", "errors", "milliseconds")):
            raise ValueError(f"{what or 'the file'}: there is no \"{name}\"")
        if name in data and not isinstance(data[name], kind):
            raise ValueError(f"{what or 'the file'}: \"{name}\" is of another kind than results have")
        if isinstance(data.get(name), list):
            for i, entry in enumerate(data[name]):
                check(entry, f"{what}{', ' if what else ''}{name}[{i}]", name)
    for name in ("errors", "milliseconds") if of == "points" else ():
        for key, value in data.get(name, {}).items():
            if not isinstance(value, NUMBER) or isinstance(value, bool):
                raise ValueError(f"{what}: {name}.{key}: a number is wanted")
    for key, rows in data.get("curve", {}).items() if of == "points" and isinstance(data.get("curve", {}), dict) else ():
        if not isinstance(rows, list) or not all(isinstance(value, NUMBER) for value in rows):
            raise ValueError(f"{what}: curve.{key}: numbers are wanted")


def read(folder: str | Path) -> Suite:
    """Raises ValueError with one sentence where the folder holds no results."""
    path = Path(folder) / "results.json"
    try:
        data = json.loads(path.read_text())
    except FileNotFoundError:
        raise ValueError(f"{path}: there is no such file; `fullbright-lab suite SUITE --out {folder}` makes it") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"{path}: line {error.lineno}: {error.msg}") from None
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise ValueError(f"{path}: these are no results of a suite")
    try:
        check(data)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    return Suite(Path(folder), data)
