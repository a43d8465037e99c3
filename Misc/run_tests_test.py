#!/usr/bin/env python3
"""run_tests.py on a folder of tests made for it: what it says at the end, of each way in which a test can end."""
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import run_tests  # noqa: E402

GOOGLETEST = r"""
echo "runs ${GTEST_FILTER:-all}" >>"$0.ran"
cat <<'TEXT'
[ RUN      ] Maps.Parse
maps_test.cpp:12: Skipped
no LibreQuake in nowhere: FULLBRIGHT_TEST_DATA names the folder
[  SKIPPED ] Maps.Parse (0 ms)
[ RUN      ] Maps.Spawn
maps_test.cpp:20: Skipped
no LibreQuake in nowhere: FULLBRIGHT_TEST_DATA names the folder

[  SKIPPED ] Maps.Spawn (0 ms)
[  SKIPPED ] 2 tests, listed below:
[  SKIPPED ] Maps.Parse
[  SKIPPED ] Maps.Spawn
TEXT
"""
FAILS_IN_PARTS = r"""
cat <<'TEXT'
[ RUN      ] Maps.Parse
[       OK ] Maps.Parse (1 ms)
[ RUN      ] Maps.Spawn
maps_test.cpp:20: Failure
1 where 2 was expected
[  FAILED  ] Maps.Spawn (0 ms)
[ RUN      ] Maps.Skip
[  SKIPPED ] Maps.Skip (0 ms)
[ RUN      ] Maps.Crash
the last that it said
TEXT
exit 3
"""
TESTS = {
    "passes": "echo all is well",
    "maps": GOOGLETEST,
    "whole": "echo 'skipped: no LibreQuake in nowhere: FULLBRIGHT_TEST_DATA names the folder'; exit 77",
    "python": "echo \"test_seen (x.Case.test_seen) ... ok\"; echo \"test_drawn (x.Case.test_drawn) ... skipped 'matplotlib is not installed'\"",
    "display": "echo 'skipped: no display'; exit 77",
    "known": "echo 'known to pass: it did here'",
    "fails": "echo 'skipped: one of its parts'; exit 1",
}


class RunTestsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, tests, *options):
        listed = "".join(f'add_test({name} "{self.folder / name}.sh")\nset_tests_properties({name} PROPERTIES SKIP_RETURN_CODE 77)\n' for name in tests)
        (self.folder / "CTestTestfile.cmake").write_text(listed)
        for name in tests:
            script = self.folder / f"{name}.sh"
            script.write_text("#!/bin/sh\n" + TESTS[name])
            script.chmod(0o755)
        return subprocess.run([sys.executable, HERE / "run_tests.py", self.folder, *options], capture_output=True, text=True, check=False)

    def test_says_what_was_skipped_and_why(self):
        done = self.run_it(TESTS, "--results", str(self.folder / "results.xml"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("7 tests, ", done.stdout.splitlines()[0])
        end = done.stdout[done.stdout.index("\nSkipped:"):].strip().splitlines()
        self.assertEqual(end, ["Skipped:",
                               "  no LibreQuake in nowhere: FULLBRIGHT_TEST_DATA names the folder", "    maps: 2 cases", "    whole",
                               "  matplotlib is not installed", "    python: 1 case",
                               "  no display", "    display",
                               "  one of its parts", "    fails",
                               "Known to pass with the same files, and not run (FULLBRIGHT_RUN_AGAIN=1 runs them): known",
                               "Failed: fails"])
        again = self.run_it(TESTS, "--skipped-in", str(self.folder / "results.xml"))
        self.assertEqual(again.returncode, 0)
        self.assertIn("2 tests, ", again.stdout.splitlines()[0])
        self.assertNotIn("display", again.stdout)
        self.assertEqual((self.folder / "maps.sh.ran").read_text(), "runs all\nruns Maps.Parse:Maps.Spawn\n")

    def test_failures_come_last_with_what_they_said(self):
        TESTS["parts"] = FAILS_IN_PARTS
        self.addCleanup(TESTS.pop, "parts")
        done = self.run_it(["parts", "passes"])
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stdout.strip().splitlines()[-6:],
                         ["Maps.Spawn:", "maps_test.cpp:20: Failure", "1 where 2 was expected", "Maps.Crash:", "the last that it said",
                          "Failed: parts (Maps.Spawn, Maps.Crash)"])

    def test_says_nothing_where_all_is_well(self):
        done = self.run_it(["passes"])
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("Skipped:", done.stdout)
        self.assertNotIn("Failed:", done.stdout)
        self.assertNotIn("Known", done.stdout)

    def test_runs_again_only_what_was_skipped(self):
        self.assertEqual(self.run_it(["passes"], "--results", str(self.folder / "results.xml")).returncode, 0)
        again = self.run_it(["passes"], "--skipped-in", str(self.folder / "results.xml"))
        self.assertEqual(again.returncode, 0)
        self.assertIn("nothing was skipped", again.stdout)

    def test_a_program_that_is_not_built_is_no_silent_pass(self):
        (self.folder / "CTestTestfile.cmake").write_text(f'add_test(absent "{self.folder / "absent"}")\n')
        done = subprocess.run([sys.executable, HERE / "run_tests.py", self.folder], capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)

    def test_estimate(self):
        seconds = {"processors": 2.0, "a": 30.0, "b": 60.0, "c": 90.0}
        # 180 s of three at a time: a minute on two processors, half of it on four, but never less than the longest.
        self.assertAlmostEqual(run_tests.estimated_minutes(seconds, ["a", "b", "c"], 3, 2), 90 / 60)
        self.assertAlmostEqual(run_tests.estimated_minutes(seconds, ["a", "a", "a", "a", "new", "new"], 3, 2), 240 / 3 * 2 / 2 / 60)
        self.assertEqual(run_tests.estimated_minutes({}, ["a"], 3, 2), 0.0)

    def test_of_a_case_without_output(self):
        case = ET.fromstring('<testcase name="x" status="notrun"><skipped message="Disabled"/></testcase>')
        self.assertEqual(run_tests.skips_of(case), [("x", "it does not say why")])


if __name__ == "__main__":
    unittest.main()
