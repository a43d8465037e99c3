#!/usr/bin/env python3
"""Suites of experiments, by the program: suite_test.py BUILD_DIR. The same errors to the last digit when run again, killed
at any moment and started again, and when split in four and merged; and what is refused, with its sentence.
Skipped, saying so, without a Vulkan device."""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

from programs_needed import need


SUITE = {
    "title": "Small", "size": [24, 16], "repeats": 2, "reference_samples": 64, "set": {"r_deterministic": 1},
    "configurations": {"pt": {"r_estimator": "pt"}, "mcpg": {"r_estimator": "mcpg", "r_mc_states": 4096}},
    "experiments": [
        {"name": "cbox", "picture": True, "view": {"name": "cbox", "scene": "cbox", "frames": [4, 7], "warmup": 4}},
        {"name": "moving", "view": {"name": "moving", "scene": "moving", "frames": [3, 4], "warmup": 2}},
        {"name": "lights", "errors": False, "repeats": 1, "view": {"name": "lights", "scene": "many", "frames": [1, 2]},
         "vary": {"what": "lights", "scene": "many", "values": [1, 4, 16]}},
        {"name": "elsewhere", "view": {"name": "elsewhere", "map": "start", "data": "librequake", "frames": [0, 1]}},
    ],
}
PIECES = 2 + 2 + 3


class Lab:
    def __init__(self, build, folder):
        self.program, self.folder = build / "fullbright-lab", folder
        self.suite = folder / "suite.json"
        self.suite.write_text(json.dumps(SUITE, indent=1))

    def command(self, *words):
        return [self.program, *map(str, words)]

    def run(self, *words):
        return subprocess.run(self.command(*words), capture_output=True, text=True, timeout=300)

    def measure(self, out, *words):
        done = self.run("suite", self.suite, "--out", self.folder / out, "--librequake", "/nowhere", "--quiet", *words)
        assert done.returncode == 0, done.stderr
        return done

    def errors(self, out):
        """All that does not depend on the clock."""
        results = json.loads((self.folder / out / "results.json").read_text())
        kept = {}
        for experiment in results["experiments"]:
            for point in experiment["points"]:
                key = experiment["name"], point["configuration"], point["value"], point["repeat"]
                assert key not in kept, key
                curve = point.get("curve", {})
                kept[key] = (point.get("errors"), curve.get("mse"), curve.get("running_mse"))
        return kept, results

    def refuses(self, pattern, *words):
        done = self.run(*words)
        assert done.returncode == 1, (words, done.returncode)
        said = [line for line in done.stderr.splitlines() if not line.startswith("elsewhere: skipped, there is no LibreQuake")]
        assert len(said) == 1 and pattern in said[0], (pattern, done.stderr)


def repeats(lab):
    lab.measure("whole")
    first, results = lab.errors("whole")
    assert results["complete"] is False, "an experiment without its data was skipped"
    assert [skipped["experiment"] for skipped in results["skipped"]] == ["elsewhere"]
    assert len(list((lab.folder / "whole/pieces").glob("*.json"))) == PIECES
    assert first["cbox", "pt", 0.0, 0][0]["mse"] > 0 and first["cbox", "pt", 0.0, 0] != first["cbox", "pt", 0.0, 1]
    assert (lab.folder / "whole/pieces/cbox.0.0.mcpg.exr").stat().st_size > 1000
    fits = {(fit["configuration"], fit["of"]) for fit in results["experiments"][2]["fits"]}
    assert fits == {("pt", "estimator"), ("pt", "frame"), ("mcpg", "estimator"), ("mcpg", "frame")}, fits
    return first


def resumes(lab, first):
    kills = 0
    pieces = lab.folder / "killed/pieces"
    for wait in (0.3, 1.2, None):  # the last one once something has been measured, however slow the machine is
        process = subprocess.Popen(lab.command("suite", lab.suite, "--out", lab.folder / "killed", "--librequake", "/nowhere", "--quiet"),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + (wait or 120)
        while time.monotonic() < end and process.poll() is None and not (wait is None and any(pieces.glob("*.json"))):
            time.sleep(0.02)
        kills += process.poll() is None
        process.kill()
        process.wait()
        for piece in pieces.glob("*.json"):
            json.loads(piece.read_text())
    assert kills > 0, "it was never killed"
    made = {piece: piece.stat().st_mtime_ns for piece in pieces.glob("*.json")}
    assert made, "nothing was measured before it was killed"
    lab.measure("killed")
    assert all(piece.stat().st_mtime_ns == when for piece, when in made.items()), "a piece was measured again"
    assert lab.errors("killed")[0] == first
    # One experiment again, in a folder that has more: the others stay in the results.
    lab.measure("killed", "--experiments", "lights")
    assert lab.errors("killed")[0] == first


def merges(lab, first):
    shards = [lab.folder / f"shard{i}" for i in (1, 2, 3, 4)]
    for i in (1, 2, 3, 4):
        lab.measure(f"shard{i}", "--shard", f"{i}/4")
    merge = ["suite-merge", lab.suite, "--experiments", "cbox,moving,lights", "--out", lab.folder / "merged"]
    lab.refuses("of 7 pieces are missing: ", *merge, *shards[:3])
    lab.refuses("is in ", *merge, *shards, shards[0])
    lab.refuses("of another set of options", *merge, *shards, "--size", "48x32")
    other = lab.folder / "other.json"
    other.write_text(lab.suite.read_text().replace('"repeats": 2', '"picture": false, "repeats": 2'))
    lab.refuses("of another suite", merge[0], other, *merge[2:], *shards)
    assert not (lab.folder / "merged").exists()
    done = lab.run(*merge, *shards)
    assert done.returncode == 0, done.stderr
    merged, results = lab.errors("merged")
    assert merged == first and results["complete"]
    manifest = shards[1] / "manifest.json"
    text = manifest.read_text()
    manifest.write_text(text.replace('"device": "', '"device": "another '))
    lab.refuses("of another device", *merge, *shards)
    manifest.write_text(text)


def judges(lab):
    """Pictures that a player sees are pieces like others: the same again, split and merged."""
    (lab.folder / "views.json").write_text(json.dumps({"views": [
        {"name": "cbox", "scene": "cbox", "frames": [1, 2], "warmup": 1, "quick": True}, {"name": "moving", "scene": "moving", "frames": [1, 2]}]}))
    path = lab.folder / "judge.json"
    whole = {"title": "Judged", "size": [24, 16], "repeats": 2, "reference_samples": 64, "picture": True, "set": {"r_deterministic": 1},
             "configurations": {"pt": {"r_estimator": "pt"}, "nee": {"r_estimator": "nee", "r_spp": 4}}, "judge": {"views": "views.json"}}

    def run(suite, out, *words):
        path.write_text(json.dumps(suite))
        done = lab.run("suite", path, "--out", lab.folder / out, "--references", lab.folder / "judged references", "--quiet", *words)
        assert done.returncode == 0, done.stderr

    def figures(out):
        results = json.loads((lab.folder / out / "results.json").read_text())
        points = {(e["name"], p["configuration"], p["repeat"]): (p["errors"], p["most"]) for e in results["experiments"] for p in e["points"]}
        return points, [[entry["flip"], entry["bias"], entry["gain_equal_samples"]] for entry in results["judged"]], results

    run(whole, "judged")
    points, summary, results = figures("judged")
    assert len(points) == 2 * 2 * 2 and results["complete"]
    assert points["cbox", "nee", 0][0]["flip"] < points["cbox", "pt", 0][0]["flip"], "four shadow rays look better than a path"
    assert points["cbox", "pt", 0] != points["cbox", "pt", 1], "runs have their own seeds"
    passes = {p["name"]: p["kind"] for p in results["experiments"][0]["points"][0]["passes"]}
    assert passes["paths"] == "estimator" and passes["gbuffer"] == passes["denoise_temporal"] == "frame", passes
    assert (lab.folder / "judged/pieces/moving.0.0.png").stat().st_size > 1000
    for i in (1, 2):
        run(whole, f"judged{i}", "--shard", f"{i}/2")
    done = lab.run("suite-merge", path, lab.folder / "judged1", lab.folder / "judged2", "--out", lab.folder / "judged merged")
    assert done.returncode == 0, done.stderr
    assert figures("judged merged")[:2] == (points, summary)
    run({**whole, "judge": {"views": "views.json", "quick": True}, "repeats": 1}, "judged quick")
    assert set(figures("judged quick")[0]) == {("cbox", "pt", 0), ("cbox", "nee", 0)}
    path.write_text(json.dumps({**whole, "configurations": {"old@1234": {"r_estimator": "pt"}}}))
    lab.refuses("there is no program 1234; --binary names it", "suite", path, "--out", lab.folder / "x1", "--quiet")
    path.write_text(json.dumps({**whole, "judge": {"views": "views.json", "qiuck": True}}))
    lab.refuses('"qiuck" is no key here; "quick" is', "suite", path, "--out", lab.folder / "x2")


def fits_time(lab):
    """More time, more samples; a frame takes one at least."""
    path = lab.folder / "time.json"
    path.write_text(json.dumps({**SUITE, "repeats": 1, "experiments": [
        {"name": "time", "view": {"name": "time", "scene": "cbox", "frames": [0, 3]}, "vary": {"what": "time", "values": [0.001, 60]}}]}))
    done = lab.run("suite", path, "--out", lab.folder / "time", "--quiet")
    assert done.returncode == 0, done.stderr
    points = json.loads((lab.folder / "time/results.json").read_text())["experiments"][0]["points"]
    for configuration in SUITE["configurations"]:
        few, many = (next(p for p in points if p["configuration"] == configuration and p["value"] == value) for value in (0.001, 60))
        assert few["samples"] == 1 and many["samples"] >= 4, (few["samples"], many["samples"])
        assert many["errors"]["mse"] < few["errors"]["mse"], configuration


def iterates(lab):
    """Pictures in iterations are pieces like others, each as its schedule says: split, merged, and made at once."""
    path = lab.folder / "iterated.json"
    path.write_text(json.dumps({**SUITE, "configurations": {"pt": {"r_estimator": "pt"}, "mir": {"r_estimator": "mir"}}, "experiments": [
        {"name": "iterated", "view": {"name": "cbox", "scene": "cbox", "frames": [0, 0]}, "vary": {"what": "iterations", "schedules": ["1,1,2", "4"]}}]}))
    for out, words in (("iterated", ()), ("iterated1", ("--shard", "1/2")), ("iterated2", ("--shard", "2/2"))):
        done = lab.run("suite", path, "--out", lab.folder / out, "--references", lab.folder / "iterated references", "--quiet", *words)
        assert done.returncode == 0, done.stderr
    done = lab.run("suite-merge", path, lab.folder / "iterated1", lab.folder / "iterated2", "--out", lab.folder / "iterated merged")
    assert done.returncode == 0, done.stderr
    first, results = lab.errors("iterated")
    assert lab.errors("iterated merged")[0] == first and len(first) == 2 * 2 * 2 and results["complete"]
    assert results["experiments"][0]["vary"]["schedules"] == ["1,1,2", "4"]
    for point in results["experiments"][0]["points"]:
        assert point["samples"] == 4 and point["milliseconds"]["clock"] > 0, point
        assert ("distributions of 2 iterations" in point["kept"]) == (point["configuration"] == "mir" and point["value"] == 3), point
    assert first["iterated", "mir", 1.0, 0] != first["iterated", "mir", 3.0, 0], "what was learnt shows"


def refuses(lab):
    lab.refuses("of another set of options", "suite", lab.suite, "--out", lab.folder / "whole", "--repeats", "3")
    lab.refuses("--shard 5/4", "suite", lab.suite, "--out", lab.folder / "x", "--shard", "5/4")
    lab.refuses("has no such experiment", "suite", lab.suite, "--out", lab.folder / "x", "--experiments", "cobx")
    typo = lab.folder / "typo.json"
    typo.write_text(lab.suite.read_text().replace('"repeats": 2', '"repaets": 2'))
    lab.refuses('typo.json: line 7: "repaets" is no key here; "repeats" is', "suite", typo, "--out", lab.folder / "x")
    typo.write_text(lab.suite.read_text().replace('"r_mc_states"', '"r_mc_stats"'))
    lab.refuses("there is no cvar r_mc_stats", "suite", typo, "--out", lab.folder / "x")
    lab.measure("x", "--experiments", "lights")  # the folder of a mistake is not spoilt
    (lab.folder / "file").write_text("")
    lab.refuses("file", "suite", lab.suite, "--out", lab.folder / "file")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    need(build)
    with tempfile.TemporaryDirectory() as name:
        lab = Lab(build, pathlib.Path(name))
        first = repeats(lab)
        resumes(lab, first)
        merges(lab, first)
        iterates(lab)
        judges(lab)
        fits_time(lab)
        refuses(lab)
    return 0


if __name__ == "__main__":
    sys.exit(main())
