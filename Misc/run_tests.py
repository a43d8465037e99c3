#!/usr/bin/env python3
"""Runs the tests of a build, several at a time: says how many there are and about how long they take, and at the end what
failed, and what was skipped, for want of what.

usage: run_tests.py BUILD [--jobs N] [--skipped-in FILE] [--results FILE] [--keep-times] [--keep-passed] [--spot-check] [CTEST OPTIONS ...]

  --jobs N           tests that run at a time; default: one more than there are processors, since some of them wait
  --results FILE     keeps ctest's JUnit file there
  --skipped-in FILE  runs again what was skipped for want of LibreQuake in that file of results: the test, or, of GoogleTest's,
                     the cases
  --keep-times       writes what the tests took into Misc/test_seconds.csv, from which the estimate is made
  --keep-passed      writes with which files tests passed into Misc/passed.csv: elsewhere they run only where these changed
                     (unless_passed.py)
  --spot-check       one of the tests in that file runs all the same; another one after each change to the file

Test programs say that they skip something by a line "skipped: WHY" (and exit status 77, if it is all they have), as GoogleTest
does, or as unittest does with --verbose. Each is told with its reason. The exit status is ctest's.
"""
import argparse
import collections
import csv
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

from unless_passed import KNOWN, PASSED, read_passed, write_passed

SECONDS = pathlib.Path(__file__).with_name("test_seconds.csv")
DATA = "LibreQuake"
LINES_OF_A_FAILURE = 40


def estimated_minutes(seconds: dict[str, float], names: list[str], jobs: int, processors: int) -> float:
    """How long these tests take. `seconds` are each test's where one more ran at a time than there were processors, and the row
    "processors" says how many these were. A test that is not among them counts as their median."""
    known = sorted(value for name, value in seconds.items() if name != "processors")
    if not known:
        return 0.0
    each = [seconds.get(name, known[len(known) // 2]) for name in names]
    measured = seconds["processors"]
    busy = sum(each) / (measured + 1) * measured  # of all processors together
    return max(busy / min(jobs, processors), max(each, default=0.0)) / 60


def skips_of(case: ET.Element) -> list[tuple[str, str]]:
    """What one test of the JUnit file skipped: what, and why."""
    output = case.findtext("system-out") or ""
    lines = output.splitlines()
    found = []
    for i, line in enumerate(lines):
        if line.startswith("skipped"):
            found.append((case.get("name"), re.sub(r"^skipped:? *", "", line)))
        by_unittest = re.match(r"(\w+) \(.*\.\.\. skipped ['\"](.*)['\"]$", line)
        if by_unittest:
            found.append((f"{case.get('name')} ({by_unittest[1]})", by_unittest[2]))
        # GoogleTest prints each twice: where it is skipped, with its time, and in its list at the end.
        skipped = re.match(r"\[  SKIPPED \] (\S+) \(\d+ ms\)", line)
        if skipped:
            why = next((lines[j] for j in range(i - 1, -1, -1) if lines[j].strip()), "")
            found.append((f"{case.get('name')} ({skipped[1].rstrip(',')})", why))
    skipped = case.find("skipped")
    if not found and skipped is not None and case.get("status") == "notrun":
        found.append((case.get("name"), "its program is not built" if "Unable to find" in (skipped.get("message") or "") else "it does not say why"))
    return found


def failures_of(case: ET.Element) -> list[tuple[str, str]]:
    """GoogleTest's cases that failed in one test of the JUnit file, or in which its program ended, each with what it said."""
    found = []
    name, said = "", []
    for line in [*(case.findtext("system-out") or "").splitlines(), "[ RUN      ] "]:
        begins = re.match(r"\[ RUN      \] (\S*)$", line)
        ends = re.match(r"\[( +OK|  SKIPPED|  FAILED ) \] (\S+) \(\d+ ms\)$", line)
        failed = ends and "FAILED" in ends[1]
        if name and (begins or failed):
            found.append((name, "\n".join(said[-LINES_OF_A_FAILURE:])))
        if begins or ends:
            name, said = begins[1] if begins else "", []
        else:
            said.append(line)
    return found


def summary(cases: list[ET.Element]) -> str:
    """What was skipped, by reason, what is known to pass, and what failed, with what it said; empty where there is none of them."""
    reasons = collections.defaultdict(list)
    for case in cases:
        for what, why in skips_of(case):
            reasons[why].append(what)
    lines = []
    if reasons:
        lines.append("Skipped:")
    for why, what in sorted(reasons.items(), key=lambda item: -len(item[1])):
        tests = collections.Counter(name.split(" (")[0] for name in what)
        lines.append(f"  {why}")
        for name, count in sorted(tests.items()):
            whole = name in what
            lines.append(f"    {name}" + ("" if whole else f": {count} case{'s' if count > 1 else ''}"))
    known = [case.get("name") for case in cases if (case.findtext("system-out") or "").startswith(KNOWN)]
    if known:
        lines.append("Known to pass with the same files, and not run (FULLBRIGHT_RUN_AGAIN=1 runs them): " + ", ".join(sorted(known)))
    failed = {case.get("name"): failures_of(case) for case in cases if case.get("status") == "fail"}
    for name, text in [part for parts in failed.values() for part in parts]:
        lines += [f"{name}:", text]
    if failed:
        lines.append("Failed: " + ", ".join(name + (f" ({', '.join(part for part, _ in parts)})" if parts else "") for name, parts in failed.items()))
    return "\n".join(lines)


def for_want_of_data(cases: list[ET.Element]) -> tuple[list[str], list[str]]:
    """Names of tests that skipped something, and of GoogleTest's cases."""
    tests, parts = [], []
    for case in cases:
        skipped = [what for what, why in skips_of(case) if DATA in why]
        if skipped:
            tests.append(case.get("name"))
        parts += [part[1] for part in (re.search(r"\((\S+\.\S+)\)$", what) for what in skipped) if part]
    return tests, parts


def read_seconds() -> dict[str, float]:
    if not SECONDS.exists():
        return {}
    with SECONDS.open() as file:
        return {row["test"]: float(row["seconds"]) for row in csv.DictReader(file)}


def keep_seconds(cases: list[ET.Element], processors: int) -> None:
    rows = {"processors": float(processors)} | {case.get("name"): float(case.get("time") or 0) for case in cases if case.get("status") == "run"}
    with SECONDS.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("test", "seconds"))
        writer.writerows((name, f"{seconds:.0f}") for name, seconds in sorted(rows.items()))


def keep_passed(build: pathlib.Path, cases: list[ET.Element], path: pathlib.Path = PASSED) -> None:
    """What these cases' stamps say goes into the file; of a test that failed nothing stays."""
    passed = read_passed(path)
    ran = {case.get("name"): case.get("status") == "run" for case in cases}
    for which in [which for which in passed if not ran.get(which[0], True)]:
        del passed[which]
    for name in filter(ran.get, ran):
        stamp = build / "passed" / name
        if stamp.exists():
            device, key = stamp.read_text().splitlines()
            passed[name, device] = key
    write_passed(path, passed)


def spot_check(names: list[str], path: pathlib.Path = PASSED) -> str:
    """One of these tests that the file knows, as its contents have it; empty if it knows none."""
    known = sorted({name for name, _ in read_passed(path)} & set(names))
    return known[int.from_bytes(hashlib.sha256(path.read_bytes()).digest()[:8], "little") % len(known)] if known else ""


def main() -> int:
    processors = len(os.sched_getaffinity(0))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=processors + 1)
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--skipped-in", type=pathlib.Path)
    parser.add_argument("--keep-times", action="store_true")
    parser.add_argument("--keep-passed", action="store_true")
    parser.add_argument("--spot-check", action="store_true")
    options, chosen = parser.parse_known_args()

    ctest = ["ctest", "--test-dir", str(options.build), *chosen]
    environment = dict(os.environ)
    if options.keep_times:
        environment["FULLBRIGHT_RUN_AGAIN"] = "1"  # also what passed before (unless_passed.py)
    if options.skipped_in:
        again, parts = for_want_of_data(list(ET.parse(options.skipped_in).getroot().iter("testcase")))
        environment["GTEST_FILTER"] = ":".join(parts) or "*"
        if not again:
            print(f"run_tests: nothing was skipped for want of {DATA}")
            return 0
        ctest += ["--tests-regex", "^(" + "|".join(map(re.escape, again)) + ")$"]
    listed = subprocess.run([*ctest, "--show-only=json-v1"], capture_output=True, text=True, check=False)
    if listed.returncode != 0:
        sys.stderr.write(listed.stderr)
        return listed.returncode
    names = [test["name"] for test in json.loads(listed.stdout)["tests"]]
    if options.spot_check and "FULLBRIGHT_RUN_AGAIN" not in environment and (again := spot_check(names)):
        environment["FULLBRIGHT_RUN_AGAIN"] = again
        print(f"run_tests: {again} runs again, whatever {PASSED.name} says of it")
    known = set() if environment.get("FULLBRIGHT_RUN_AGAIN") == "1" else {name for name, _ in read_passed(PASSED)}

    def minutes(tests: list[str]) -> int:
        return max(1, round(estimated_minutes(read_seconds(), tests, options.jobs, processors)))

    unless = f", {minutes([name for name in names if name not in known])} if what {PASSED.name} knows did not change" if known & set(names) else ""
    print(f"{len(names)} tests, {options.jobs} at a time: about {minutes(names)} min on {processors} processor{'s' if processors > 1 else ''}{unless}", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        results = (options.results or pathlib.Path(folder) / "results.xml").resolve()
        status = subprocess.run([*ctest, "--parallel", str(options.jobs), "--output-on-failure", "--output-junit", str(results), "--test-output-size-passed",
                                 "10000000", "--test-output-size-failed", "10000000"], check=False, env=environment).returncode
        if not results.exists():
            return status
        cases = list(ET.parse(results).getroot().iter("testcase"))
    text = summary(cases)
    if text:
        print("\n" + text)
    if options.keep_times:
        keep_seconds(cases, processors)
    if options.keep_passed:
        keep_passed(options.build, cases)
    return status


if __name__ == "__main__":
    sys.exit(main())
