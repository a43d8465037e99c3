"""A suite's results as one HTML page that needs nothing else: python3 -m fullbright_lab.report DIR [--out FILE] [--lab PROGRAM].

Figures with bands of 95%, tables of gains with their intervals, pictures side by side with zoom in step, errors in false colours, times by
pass, and beside each the command that repeats it. PROGRAM, a fullbright-lab, adds maps of FLIP."""

from __future__ import annotations

import argparse
import base64
import html
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from fullbright_lab import figures, page, pictures, results
from fullbright_lab.results import Experiment, Interval, Suite

MOST_ZOOM = 4  # pictures are shown enlarged to at least 320 pixels


def number(value: float) -> str:
    if not math.isfinite(value):
        return "–"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"


def interval(value: Interval) -> str:
    if not math.isfinite(value.value):
        return "–"
    rare = "<abbr title='rare runs rule the mean of the errors: the interval promises too much'>*</abbr>" if value.rare else ""
    return number(value.value) + rare + (f" <small>{number(value.low)} to {number(value.high)}</small>" if math.isfinite(value.low) else "")


def table(head: list[str], rows: list[list[str]], caption: str) -> str:
    cells = "".join(f"<th scope=col>{html.escape(text)}</th>" for text in head)
    body = "".join("<tr>" + "".join(f"<th scope=row>{html.escape(cell)}</th>" if i == 0 else f"<td>{cell}</td>" for i, cell in enumerate(row)) + "</tr>"
                   for row in rows)
    return f"<div class=scroll><table><caption>{html.escape(caption)}</caption><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table></div>"


def runs(experiment: Experiment, fewest: int = results.FEWEST_RUNS) -> str:
    count = len(experiment.chosen(experiment.configurations[0]))
    intervals = "with 95% intervals" if count >= fewest else f"too few for intervals, which want {fewest}"
    return f"{count} run{'' if count == 1 else 's'}, {intervals}"


def gains(experiment: Experiment) -> str:
    rows, rare = [], False
    for name in experiment.configurations:
        errors = experiment.errors(name, "relmse_corrected")
        error = results.over_runs(errors)
        error.rare = results.rare_runs_rule(errors)
        time = results.over_runs(experiment.milliseconds(name), results.FEWEST_STEADY_RUNS)
        first = name == experiment.configurations[0]
        gains = [] if first else [experiment.gain(name, equal) for equal in ("samples", "time")]
        rare = rare or any(told.rare for told in (error, *gains))
        rows.append([name, interval(error), interval(time), *(["1", "1"] if first else [interval(gain) for gain in gains])])
    return table(["", "relMSE of a frame", "ms of the estimator", "gain, equal samples", "gain, equal time"], rows,
                 f"Gains in MSE over {experiment.configurations[0]}, the reference's variance taken off; geometric means over {runs(experiment)}"
                 + ("; *: rare runs rule the mean of the errors, so that the interval promises too much" if rare else ""))


def errors_table(experiment: Experiment) -> str:
    names = [name for name in experiment.chosen(experiment.configurations[0])[0]["errors"] if name not in ("relmse_corrected",)]
    rows = [[configuration, *[number(float(np.mean(experiment.errors(configuration, name)))) for name in names]]
            for configuration in experiment.configurations]
    return "<details><summary>All metrics</summary>" + table(["", *names], rows, "Mean over frames and runs") + "</details>"


def flip_map(lab: str | None, folder: Path, name: str, configuration: str) -> np.ndarray | None:
    """(H, W) of HDR-FLIP, by the laboratory."""
    if not lab:
        return None
    stem = folder / "pieces" / f"{name}.0.0"
    with tempfile.TemporaryDirectory() as scratch:
        target = Path(scratch) / "flip.png"
        done = subprocess.run([lab, "compare", f"{stem}.reference.exr", f"{stem}.{configuration}.exr", "--flip-map", target, "--json", "-"], capture_output=True)
        if done.returncode != 0 or not target.exists():
            return None
        read = figures.plt.imread(target)
        return np.asarray(read if read.ndim == 2 else read[..., 0], float)


def gallery(experiment: Experiment, lab: str | None) -> str:
    kept = experiment.pictures()
    if "reference" not in kept:
        return ""
    reference = kept["reference"]
    height, width = reference.shape[:2]
    scale = pictures.exposure(reference)
    maps = {name: pictures.relative_error(picture, reference) for name, picture in kept.items() if name != "reference"}
    top = max(1e-6, float(np.quantile(np.concatenate([values.ravel() for values in maps.values()]), 0.99)))

    def picture(data: np.ndarray, text: str, caption: str) -> str:
        return f'<figure><div class=zoom style="aspect-ratio:{width}/{height}"><img alt="{html.escape(text)}" src="{pictures.data_uri(data)}"></div><figcaption>{caption}</figcaption></figure>'

    choices = "".join(f"<option>{html.escape(name)}</option>" for name in kept)
    sources = "".join(f'<img hidden data-name="{html.escape(name)}" alt="" src="{pictures.data_uri(pictures.displayed(linear, scale))}">' for name, linear in kept.items())
    slider = (f'<div class=slider style="aspect-ratio:{width}/{height}"><div class=pair><img class=under alt="left picture"><img class=over alt="right picture"></div>'
              f'<input type=range min=0 max=100 value=50 aria-label="how much of each picture"></div>'
              f"<p class=pick><label>left <select>{choices}</select></label> <label>right <select>{choices}</select></label></p>{sources}")
    shown = "".join(picture(pictures.displayed(linear, scale), f"{experiment.title}, {name}", html.escape(name)) for name, linear in kept.items())
    errors = "".join(picture(pictures.false_color(values, top), f"relative error of {name}", f"{html.escape(name)}: relative error, white {number(top)}") for name, values in maps.items())
    flips = {name: flip_map(lab, experiment.folder, experiment.name, name) for name in maps}
    flip = "".join(picture(pictures.false_color(values, 1.0), f"FLIP of {name}", f"{html.escape(name)}: HDR-FLIP, mean {values.mean():.3f}") for name, values in flips.items() if values is not None)
    return (f"<section class=gallery><h3>Pictures</h3>{slider}<p class=hint>The wheel zooms all pictures below in step, dragging moves them, a double click goes back.</p>"
            f"<div class=grid>{shown}</div><div class=grid>{errors}</div>{f'<div class=grid>{flip}</div>' if flip else ''}</section>")


def figure(drawing: str, caption: str) -> str:
    return f"<figure class=plot>{drawing}<figcaption>{html.escape(caption)}</figcaption></figure>"


def words(experiment: Experiment) -> str:
    rows = [(label, experiment.data.get(key)) for label, key in (("Stands beside", "source"), ("There", "paper"), ("Differs", "differs"))]
    return "".join(f"<p class=paper><b>{label}:</b> {html.escape(text)}</p>" for label, text in rows if text)


JUDGED = (("FLIP", "flip", 1), ("silhouettes", "flip_silhouettes", 1), ("relMSE", "relmse", 1), ("bias, %", "bias", 100), ("flicker", "flicker", 1),
          ("ms of a frame", "all_ms", 1), ("ms of the estimator", "paths_ms", 1))


def judged_table(judged: list[dict], caption: str) -> str:
    rows = []
    for entry in judged:
        cells = []
        for _, name, factor in JUDGED:
            figure = results.judged_figure(entry, name)
            cells.append(interval(Interval(factor * figure.value, factor * figure.low, factor * figure.high)))
        cells += [f"{number(results.judged_figure(entry, name).value)} <small>most {entry['most'][name]}</small>" for name in ("isolated_dark", "isolated_bright")]
        if "gain_equal_samples" in entry:
            cells += [interval(results.judged_figure(entry, f"gain_equal_{equal}")) for equal in ("samples", "time")]
        rows.append([entry["configuration"], *cells])
    head = ["", *(label for label, _, _ in JUDGED), "isolated dark", "isolated bright"]
    if judged and "gain_equal_samples" in judged[0]:
        head += ["gain, equal samples", "gain, equal time"]
    return table(head, rows, caption)


def side_by_side(experiment: Experiment) -> str:
    path = experiment.folder / "pieces" / f"{experiment.name}.0.0.png"
    if not path.exists():
        return ""
    source = "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode()
    text = f"{experiment.title}: the reference, then {', '.join(experiment.configurations)}; below them silhouettes and FLIP"
    return f'<figure><img class=wide alt="{html.escape(text)}" src="{source}"><figcaption>{html.escape(text)}</figcaption></figure>'


def judged_section(experiment: Experiment) -> str:
    truth = experiment.data["truth"]
    seeds = runs(experiment, results.FEWEST_STEADY_RUNS)
    caption = f"Final pictures of seeds, {seeds}. FLIP of the reference's own noise: {number(truth['flip'])}"
    return judged_table(experiment.data["judged"], caption) + side_by_side(experiment)


def section(experiment: Experiment, lab: str | None) -> str:
    parts = [f'<section class=experiment id="{html.escape(experiment.name)}"><h2>{html.escape(experiment.title)}</h2>', words(experiment)]
    width, height = experiment.data["size"]
    reference = experiment.data.get("reference")
    text = f"View {experiment.data['view']}, {width}x{height}."
    if reference:
        text += f" Reference: {reference['samples']} samples of {reference['estimator']}; {'standard error of its mean' if experiment.judged else 'root mean square error of its pixels'} {100 * reference['relative_error']:.2g}% of its mean."
    parts.append(f"<p>{html.escape(text)}</p>")
    if not experiment.points:
        return "".join(parts) + "<p>Not measured yet.</p></section>"
    measured = "errors" in experiment.points[0]
    if experiment.judged:
        parts.append(judged_section(experiment))
    elif experiment.what:
        drawings = []
        if experiment.what != "time":
            drawings.append(figure(figures.over_values(experiment, "time"), f"Time over {experiment.what}; bands are 95% over runs, where there are {results.FEWEST_RUNS} or more."))
        if measured:
            drawings.append(figure(figures.over_values(experiment, "error"), f"Error over {experiment.label}; bands are 95% over runs, where there are {results.FEWEST_RUNS} or more."))
        parts.append(f"<div class='grid plots'>{''.join(drawings)}</div>")
    elif measured:
        drawings = []
        if experiment.curve(experiment.configurations[0], "running_rel_mse") is not None:
            drawings += [figure(figures.over_frames(experiment, "samples"), f"Error of the mean of the frames so far, over samples. Lines begin with nothing learnt, dashed ones after the warm-up. Bands are 95% over runs, where there are {results.FEWEST_RUNS} or more."),
                         figure(figures.over_frames(experiment, "time"), "The same over time.")]
        drawings.append(figure(figures.adaptation(experiment), "Adaptation: error of each frame alone."))
        parts.append(f"<div class='grid plots'>{''.join(drawings)}</div>{gains(experiment)}{errors_table(experiment)}")
    parts.append(figure(figures.passes(experiment, experiment.values[-1]), "Time of a frame by pass" + (f" at {number(experiment.values[-1])} {experiment.label}" if experiment.what else "") + "; grey: the frame's, coloured: the estimator's."))
    if not experiment.judged:
        parts.append(gallery(experiment, lab))
    parts.append(f"<p class=command>Again: <code>{html.escape(experiment.data['command'])}</code></p></section>")
    return "".join(parts)


def report(suite: Suite, lab: str | None) -> str:
    manifest = "".join(f"<dt>{html.escape(key)}</dt><dd>{html.escape(str(value))}</dd>" for key, value in suite.manifest.items() if key != "format")
    contents = "".join(f'<li><a href="#{html.escape(e.name)}">{html.escape(e.title)}</a></li>' for e in suite.experiments)
    skipped = "".join(f"<p class=paper>{html.escape(entry['why'])}</p>" for entry in suite.data["skipped"])
    state = "" if suite.complete else "<p class=paper><b>Incomplete:</b> some pieces are not measured yet, or were skipped.</p>"
    body = "".join(section(experiment, lab) for experiment in suite.experiments)
    if "judged" in suite.data:
        judged = [experiment for experiment in suite.experiments if experiment.judged and experiment.points]
        views, few = len(judged), runs(judged[0], results.FEWEST_STEADY_RUNS)
        state += judged_table(suite.data["judged"], f"Final pictures of all {views} views, {few}: geometric means; bias and isolated pixels are plain means. Gains in relMSE over {suite.data['judged'][0]['configuration']}")
    return page.html_page(suite.title, f"<nav><ol>{contents}</ol></nav>{state}{skipped}{body}<section><h2>Measured with</h2><dl>{manifest}</dl><p class=command>All of it: <code>{html.escape(suite.data['command'])}</code></p></section>")


def write_whole(target: Path, text: str) -> None:
    """As the engine writes files: under a name of its own, then renamed; a link is followed."""
    target = target.resolve()
    umask = os.umask(0)
    os.umask(umask)
    handle, fresh = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}-", suffix=".new")
    try:
        with os.fdopen(handle, "w") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(fresh, 0o666 & ~umask)
        os.replace(fresh, target)
    except BaseException:
        os.unlink(fresh)
        raise


def main() -> int:
    parser = argparse.ArgumentParser(prog="fullbright-lab report", description="writes a suite's results as one HTML page")
    parser.add_argument("folder", type=Path, help="the folder that `fullbright-lab suite` wrote")
    parser.add_argument("--out", type=Path, help="the page (default: report.html in the folder)")
    parser.add_argument("--lab", help="a fullbright-lab, which draws maps of FLIP")
    options = parser.parse_args()
    target = options.out or options.folder / "report.html"
    try:
        text = report(results.read(options.folder), options.lab)
        write_whole(target, text)
    except (ValueError, OSError) as error:
        print(f"fullbright-lab: {error}", file=sys.stderr)
        return 1
    print(f"{target}: {len(text) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
