#!/usr/bin/env python3
"""The package fullbright_lab, and its report as a browser shows it: test_report.py. What needs matplotlib or Chromium is skipped, saying so,
where it is absent."""
import base64
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np  # noqa: E402
from fullbright_lab import exr, results  # noqa: E402

REFERENCE = Path(__file__).resolve().parents[2] / "testdemos/references/cbox.exr"
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--enable-logging=stderr", "--virtual-time-budget=5000", "--window-size=1280,2000"]
PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==")  # one pixel
# Moves the slider, zooms one picture with the wheel, drags, and says in the title what came of it.
SELF_TEST = """<script>
const told = [];
const gallery = document.querySelector('.gallery'), range = gallery.querySelector('input[type=range]');
range.value = 20; range.dispatchEvent(new Event('input'));
told.push(gallery.querySelector('.over').style.clipPath);
const boxes = [...gallery.querySelectorAll('.zoom')], area = boxes[1].getBoundingClientRect();
boxes[1].dispatchEvent(new WheelEvent('wheel', {deltaY: -300, clientX: area.left + area.width / 2, clientY: area.top + area.height / 2, cancelable: true}));
told.push(new Set(boxes.map(box => box.firstChild.style.transform)).size, boxes[0].firstChild.style.transform);
told.push([...gallery.querySelectorAll('.pair img')].every(image => image.complete && image.naturalWidth > 0));
document.title = JSON.stringify(told);
</script>"""


def point(configuration, repeat, mse, spp=1, ms=10.0, value=0.0):
    return {"configuration": configuration, "value": value, "repeat": repeat, "samples": spp, "warmup": 0, "frames": 4,
            "milliseconds": {"estimator": ms, "frame": 2 * ms}, "not_finite": 0,
            "passes": [{"name": "paths", "kind": "estimator", "milliseconds": ms}, {"name": "gbuffer", "kind": "frame", "milliseconds": ms}],
            "errors": {"mse": mse, "mse_corrected": mse, "relmse": 2 * mse, "relmse_corrected": 2 * mse},
            "curve": {"mse": [mse] * 4, "rel_mse": [None, mse, mse, mse], "running_mse": [mse / n for n in (1, 2, 3, 4)],
                      "running_rel_mse": [mse / n for n in (1, 2, 3, 4)], "milliseconds": [ms] * 4}}


def judged(configuration, flip):
    figures = {name: {"value": 0.125, "interval95": [0.0625, 0.1875]} for name in
               ("flip_silhouettes", "relmse", "bias", "flicker", "all_ms", "paths_ms", "isolated_dark", "isolated_bright")}
    return {"configuration": configuration, "flip": {"value": flip, "interval95": [None, None]}, **figures, "most": {"isolated_dark": 3, "isolated_bright": 4}}


def made_results():
    def experiment(name, points, vary=None, fits=()):
        return {"name": name, "title": f"Of <{name}>", "view": name, "size": [96, 54], "vary": vary, "reference": {"estimator": "nee", "samples": 64, "relative_error": 0.01},
                "configurations": [{"name": "pt", "set": []}, {"name": "nee", "set": []}], "command": "again", "fits": list(fits), "points": points,
                "source": "A paper, Figure 1", "paper": "a curve", "differs": "the scene"}

    fit = {"configuration": "pt", "of": "estimator", "exponent": 0.5, "low": 0.4, "high": 0.6}
    lights = [point(name, r, 0.1, value=v, ms=10 * v) for name in ("pt", "nee") for v in (1.0, 10.0, 100.0) for r in (0, 1)]
    seen = experiment("seen", [point(name, r, 0.1) for name in ("pt", "nee") for r in (0, 1)])
    seen |= {"judge": True, "truth": {"flip": 0.0625}, "judged": [judged("pt", 0.5), judged("nee", 0.25)]}
    summary = [judged(name, 0.5) | {f"gain_equal_{equal}": {"value": 7.5, "interval95": [3.5, None]} for equal in ("samples", "time")} for name in ("pt", "nee")]
    return {"format": results.FORMAT, "title": "Made", "command": "all", "complete": True, "manifest": {"format": "x", "device": "d"}, "skipped": [], "judged": summary,
            "experiments": [seen, experiment("box", [point("pt", 0, 0.8), point("pt", 1, 0.4), point("nee", 0, 0.1, 2, 40.0), point("nee", 1, 0.2, 2, 40.0)]),
                            experiment("lights", lights, {"what": "lights", "values": [1.0, 10.0, 100.0]}, [fit])]}


class Made(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "pieces").mkdir()
        (self.folder / "results.json").write_text(json.dumps(made_results()))
        (self.folder / "pieces/seen.0.0.png").write_bytes(PNG)
        for name in ("pt", "nee", "reference"):
            shutil.copy(REFERENCE, self.folder / "pieces" / f"box.0.0.{name}.exr")


class Results(Made):
    def test_curves_and_errors_have_a_row_for_each_run(self):
        box = results.read(self.folder)["box"]
        self.assertEqual(box.curve("pt", "rel_mse").shape, (2, 4))
        self.assertTrue(np.isnan(box.curve("pt", "rel_mse")[0, 0]))
        np.testing.assert_allclose(box.errors("pt", "mse"), [0.8, 0.4])
        self.assertEqual(box.pictures()["nee"].shape[2], 3)
        self.assertEqual(results.read(self.folder)["lights"].milliseconds("nee", value=10.0).tolist(), [100.0, 100.0])

    def test_gains_are_of_equal_samples_and_time(self):
        box = results.read(self.folder)["box"]
        gain = box.gain("nee", "samples")
        self.assertAlmostEqual(gain.value, np.sqrt(0.8 / 0.1 * 0.4 / 0.2) / 2)
        self.assertTrue(np.isnan(gain.low), "of two runs")
        self.assertAlmostEqual(box.gain("nee", "time").value, np.sqrt(0.8 / 0.1 * 0.4 / 0.2) / 4)
        with self.assertRaisesRegex(KeyError, "no experiment 'bax'; it has seen, box, lights"):
            results.read(self.folder)["bax"]

    def test_gains_over_another_are_of_each_run_and_rare_runs_are_told(self):
        box = results.read(self.folder)["box"]
        self.assertAlmostEqual(box.gain("pt", "samples", over="nee").value, 1 / box.gain("nee", "samples").value)
        self.assertFalse(results.rare_runs_rule([0.002, 0.003, 0.004, 0.003]))
        self.assertTrue(results.rare_runs_rule([0.002, 0.003, 1.05, 0.003]))
        self.assertTrue(box.gain("nee", "samples").rare is False)
        made = made_results()
        made["experiments"][1]["points"][0]["errors"]["mse_corrected"] = 80.0
        (self.folder / "results.json").write_text(json.dumps(made))
        self.assertTrue(results.read(self.folder)["box"].gain("nee", "samples").rare)

    def test_the_interval_of_a_mean_holds_it_as_often_as_it_says(self):
        random = np.random.default_rng(4)
        for freedom, t in ((1, 12.706), (7, 2.3646), (30, 2.0423)):
            self.assertAlmostEqual(results.student_95(freedom), t, 3)
        for count in (8, 30):
            held = sum(e.low <= 1 <= e.high for e in (results.over_runs(np.exp(random.normal(size=count))) for _ in range(1000)))
            self.assertTrue(930 <= held <= 970, held)  # three binomial standard errors
        self.assertTrue(np.isnan(results.over_runs([1.0] * 7).low))
        self.assertTrue(np.isnan(results.over_runs([1.0, -1.0]).value))

    def test_what_cannot_be_read_is_said_in_a_sentence(self):
        for text, pattern in ((None, "no such file"), ("{", "line 1"), ("{}", "no results of a suite")):
            if text is None:
                (self.folder / "results.json").unlink()
            else:
                (self.folder / "results.json").write_text(text)
            with self.assertRaisesRegex(ValueError, pattern):
                results.read(self.folder)

    def test_damaged_members_are_named(self):
        def damaged(change):
            made = made_results()
            change(made["experiments"][1])
            (self.folder / "results.json").write_text(json.dumps(made))
            return results.read(self.folder)

        for change, pattern in ((lambda e: e.pop("points"), r'experiments\[1\]: there is no "points"'),
                                (lambda e: e["points"][2]["errors"].update(mse="x"), r"points\[2\]: errors.mse: a number"),
                                (lambda e: e["points"][2]["errors"].update(mse={}), r"points\[2\]: errors.mse: a number"),
                                (lambda e: e["points"][0]["curve"].update(mse=[[]]), r"points\[0\]: curve.mse: numbers"),
                                (lambda e: e["points"].append([]), r"points\[4\]: an object is wanted"),
                                (lambda e: e.update(configurations=3), '"configurations" is of another kind')):
            with self.subTest(pattern), self.assertRaisesRegex(ValueError, pattern):
                damaged(change)
        damaged(lambda e: e["points"][0]["errors"].update(mse=None))  # not a number, and no damage

    def test_exr_reads_back_what_it_writes(self):
        planes, header = exr.read(str(REFERENCE))
        exr.write(self.folder / "again.exr", planes, header)
        for name, plane in exr.read(self.folder / "again.exr")[0].items():
            np.testing.assert_array_equal(plane, planes[name])


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class Report(Made):
    def page(self):
        from fullbright_lab import report
        return report.report(results.read(self.folder), None)

    def test_it_needs_nothing_else_and_escapes_names(self):
        text = self.page()
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:|#)([^"]*)"', text), [])
        self.assertFalse("<box>" in text)
        self.assertTrue("A paper, Figure 1" in text and "exponent 0.50 (0.40 to 0.60)" in text)
        self.assertEqual(text.count("<svg"), 3 + 1 + 2 + 1 + 1)

    def test_judged_pictures_have_their_table_and_are_shown(self):
        text = self.page()
        section = text[text.index('id="seen"'):]
        section = section[:section.index("</section>")]
        self.assertTrue("<td>0.25</td>" in section and "12.5 <small>6.25 to 18.8</small>" in section and "most 3" in section and "noise: 0.0625" in section)
        self.assertTrue("data:image/png;base64," + base64.b64encode(PNG).decode() in section)
        summary = text[text.index("Final pictures of all 1 views"):text.index('id="seen"')]
        self.assertTrue("over pt" in summary and "7.5 <small>3.5 to –</small>" in summary)

    def test_pictures_are_shown_alike(self):
        from fullbright_lab import pictures
        grey = np.full((2, 2, 3), 0.7, np.float32)
        self.assertAlmostEqual(pictures.exposure(grey) * 0.7, 0.18, 6)
        self.assertTrue((pictures.displayed(grey, 1e9) >= 254).all() and (pictures.displayed(grey, 0.0) == 0).all())
        self.assertAlmostEqual(float(pictures.relative_error(1.5 * grey, grey)[0, 0]), 0.5 / 1.01, 5)
        self.assertTrue((pictures.false_color(np.zeros((1, 1)), 1.0) < 5).all())

    @unittest.skipUnless(BROWSER, "Chromium is not installed")
    def test_a_browser_shows_it_without_an_error(self):
        page = self.folder / "page.html"
        page.write_text(self.page().replace("</body>", SELF_TEST + "</body>"))
        done = subprocess.run([BROWSER, *FLAGS, f"--user-data-dir={self.folder / 'browser'}", "--dump-dom", page.as_uri()], capture_output=True, text=True, timeout=120)
        told = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
        self.assertEqual(told, [])
        title = re.search(r"<title>(.*?)</title>", done.stdout, re.S)
        self.assertTrue(title, done.stderr[-2000:])
        clip, different, transform, loaded = json.loads(title[1].replace("&quot;", '"'))
        self.assertEqual(clip, "inset(0px 80% 0px 0px)")
        self.assertEqual(different, 1, "every picture shows the same part")
        self.assertRegex(transform, r"^scale\(2\.718")
        self.assertTrue(loaded)


if __name__ == "__main__":
    unittest.main()
