"""Figures of a report, as SVG by matplotlib. Text stays text, in the page's font."""

from __future__ import annotations

import html
import io
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from fullbright_lab.results import FEWEST_RUNS, Experiment, student_95  # noqa: E402

# Okabe and Ito's colours, told apart by all.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"]
MARKERS = "osD^vPX"
STILL = {"pt", "nee"}  # these learn nothing that a frame of theirs would gain by
plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "fullbright", "font.family": "sans-serif", "font.size": 10, "axes.spines.top": False,
                     "axes.spines.right": False, "axes.grid": True, "grid.color": "#d9d9d9", "grid.linewidth": 0.6, "legend.frameon": False,
                     "figure.figsize": (5.6, 3.6), "figure.constrained_layout.use": True})


def svg(figure, label: str) -> str:
    """The drawing alone, scaled by its box, with a name for those who cannot see it."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    drawing = text.getvalue()
    drawing = drawing[drawing.index("<svg"):]
    drawing = re.sub(r'<svg ([^>]*?)width="[^"]*" height="[^"]*"', r"<svg \1", drawing, count=1)
    drawing = re.sub(r'(height|width)="[\d.]+pt" ', "", drawing, count=2)
    return drawing.replace("<svg ", f'<svg role="img" aria-label="{html.escape(label)}" ', 1)


def _band(axes, x, rows, color, name, marker=None):
    x, measured = np.asarray(x, float), np.isfinite(rows).all(axis=0)
    x, rows = x[measured], rows[:, measured]
    positive = (rows > 0).all(axis=0)
    mean = np.where(positive, np.exp(np.log(np.where(positive, rows, 1)).mean(axis=0)), 0)  # as intervals have it: geometric
    keep = (mean > 0) & (x > 0)
    if not keep.any():
        return
    every = max(1, int(keep.sum()) // 8)
    axes.plot(x[keep], mean[keep], color=color, marker=marker, markevery=every, markersize=4, linewidth=1.6, label=name)
    if len(rows) >= FEWEST_RUNS:
        spread = np.exp(student_95(len(rows) - 1) * np.log(rows[:, keep]).std(axis=0, ddof=1) / np.sqrt(len(rows)))
        axes.fill_between(x[keep], mean[keep] / spread, mean[keep] * spread, color=color, alpha=0.2, linewidth=0)


def over_frames(experiment: Experiment, axis: str):
    """Error of the mean of the frames so far over samples a pixel ("samples") or the estimator's time ("time")."""
    figure, axes = plt.subplots()
    for name, color, marker in zip(experiment.configurations, COLORS, MARKERS):
        rows = experiment.curve(name, "running_rel_mse")
        if rows is None:
            continue
        times = experiment.curve(name, "milliseconds")
        samples = experiment.chosen(name)[0]["samples"]
        x = np.arange(1, rows.shape[1] + 1) * samples if axis == "samples" else np.cumsum(np.nanmean(times, axis=0)) / 1000
        _band(axes, x, rows, color, name, marker)
        warm = experiment.curve(name, "warm_rel_mse")
        if warm is not None and warm.shape[1] < rows.shape[1] and name not in STILL:
            axes.plot(x[: warm.shape[1]], np.where(warm.mean(axis=0) > 0, warm.mean(axis=0), np.nan), color=color, linestyle="--", linewidth=1.2)
    axes.set(xscale="log", yscale="log", xlabel="samples a pixel" if axis == "samples" else "seconds of the estimator's passes",
             ylabel="relMSE of the mean so far")
    axes.legend()
    return svg(figure, f"{experiment.title}: error over {axis}")


def adaptation(experiment: Experiment):
    """Error of each frame alone over the frames since the start."""
    figure, axes = plt.subplots()
    for name, color, marker in zip(experiment.configurations, COLORS, MARKERS):
        rows = experiment.curve(name, "rel_mse")
        if rows is not None:
            _band(axes, np.arange(1, rows.shape[1] + 1), rows, color, name, marker)
    axes.set(yscale="log", xlabel="frame since nothing was learnt", ylabel="relMSE of the frame alone")
    axes.legend()
    return svg(figure, f"{experiment.title}: error of each frame")


def over_values(experiment: Experiment, quantity: str):
    """Milliseconds ("time") or error ("error") over what is varied, each run a point, with the fitted exponent."""
    figure, axes = plt.subplots()
    for name, color, marker in zip(experiment.configurations, COLORS, MARKERS):
        rows = np.array([experiment.milliseconds(name, "estimator", value) if quantity == "time" else experiment.errors(name, "relmse", value)
                         for value in experiment.values]).T
        fits = [fit for fit in experiment.data["fits"] if fit["configuration"] == name and fit["of"] == "estimator"]
        label = f'{name}: exponent {fits[0]["exponent"]:.2f} ({fits[0]["low"]:.2f} to {fits[0]["high"]:.2f})' if fits and quantity == "time" else name
        _band(axes, np.array(experiment.values), rows, color, label, marker)
    axes.set(xscale="log", yscale="log", xlabel=experiment.label, ylabel="milliseconds of the estimator's passes" if quantity == "time" else "relMSE of a frame")
    axes.legend(fontsize=8)
    return svg(figure, f"{experiment.title}: {quantity} over {experiment.what}")


def passes(experiment: Experiment, value: float):
    """Milliseconds of a frame by pass, a bar a configuration; the frame's own passes are grey."""
    figure, axes = plt.subplots(figsize=(5.6, 0.5 * len(experiment.configurations) + 1.3))
    names: dict[str, str] = {}
    for configuration in experiment.configurations:
        for entry in experiment.chosen(configuration, value)[0]["passes"]:
            names.setdefault(entry["name"], entry["kind"])
    ordered = sorted(names, key=lambda name: names[name] != "estimator")
    own = [name for name in ordered if names[name] == "estimator"]
    greys = np.linspace(0.55, 0.88, max(1, len(ordered) - len(own)))
    left = np.zeros(len(experiment.configurations))
    for index, name in enumerate(ordered):
        width = []
        for configuration in experiment.configurations:
            found = [entry["milliseconds"] for point in experiment.chosen(configuration, value) for entry in point["passes"] if entry["name"] == name]
            width.append(np.median(found) if found else 0.0)
        color = COLORS[index % len(COLORS)] if names[name] == "estimator" else str(greys[index - len(own)])
        axes.barh(experiment.configurations, width, left=left, color=color, label=name, height=0.62)
        left += width
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("milliseconds a frame")
    axes.legend(fontsize=7, ncols=2, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return svg(figure, f"{experiment.title}: time by pass")
