#!/usr/bin/env python3
"""unless_passed.py runs a command where files, command, choice or device changed, or it failed, and only there; and what run_tests.py
keeps for other folders is believed there."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import run_tests  # noqa: E402
import unless_passed  # noqa: E402


class UnlessPassed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def checkout(self, name: str) -> pathlib.Path:
        """A folder of sources with the script in it, since what is kept for others is kept beside it."""
        root = self.root / name
        (root / "Misc").mkdir(parents=True)
        shutil.copy(HERE / "unless_passed.py", root / "Misc")
        (root / "folder/part").mkdir(parents=True)
        (root / "folder/part/a.txt").write_text("good")
        (root / "folder/one_test.cpp").write_text("one")
        (root / "folder/two_test.cpp").write_text("two")
        device = root / "device"
        device.write_text("#!/bin/sh\necho '* 0: a device (driver 1)'\n")
        device.chmod(0o755)
        return root

    def ran(self, root: pathlib.Path, word: str = "", status: int = 0, options=(), **environment: str) -> bool:
        ran = root / "ran"
        ran.unlink(missing_ok=True)
        command = ["sh", "-c", f'touch {ran}; echo "$2"; grep -q good "$1"', "sh", str(root / "folder/part/a.txt"), word]
        done = subprocess.run([sys.executable, root / "Misc/unless_passed.py", "a", "--stamps", root / "build/passed", *options, "--of", root / "folder",
                               "--", *command], env=dict(os.environ, **environment), stdout=subprocess.DEVNULL, check=False)
        self.assertEqual(done.returncode, status)
        return ran.exists()

    def test_runs_what_has_not_passed_with_the_same_files(self):
        root = self.checkout("here")
        file = root / "folder/part/a.txt"
        self.assertTrue(self.ran(root))
        self.assertFalse(self.ran(root))
        self.assertTrue(self.ran(root, FULLBRIGHT_RUN_AGAIN="1"))
        self.assertTrue(self.ran(root, FULLBRIGHT_RUN_AGAIN="b a"))
        self.assertFalse(self.ran(root, FULLBRIGHT_RUN_AGAIN="b"))
        self.assertTrue(self.ran(root, "another word"))
        file.write_text("bad")
        self.assertTrue(self.ran(root, "another word", status=1))
        self.assertTrue(self.ran(root, "another word", status=1), "what failed is no pass")
        file.write_text("good")
        self.assertTrue(self.ran(root, "another word"), "nor is what passed before it failed")
        (root / "folder/b.txt").write_text("")
        self.assertTrue(self.ran(root, "another word"))
        self.assertFalse(self.ran(root, "another word"))
        for _ in range(2):
            self.assertTrue(self.ran(root, "Skipped"), "the rest of it may have its turn")
        self.assertTrue(self.ran(root, "Skipped", options=("--may-skip", "--keep")))
        self.assertFalse(self.ran(root, "Skipped"))
        self.assertEqual(list(unless_passed.read_passed(root / "Misc/passed.csv")), [("a", "none")])

    def test_counts_what_chooses_what_compiled_and_what_draws(self):
        root = self.checkout("here")
        one = ("--tests", "one_*", "--tools", "gcc 1", "--device", root / "device")
        self.assertTrue(self.ran(root, options=one))
        (root / "folder/two_test.cpp").write_text("changed")
        self.assertFalse(self.ran(root, options=one), "it is no test of these")
        (root / "folder/one_test.cpp").write_text("changed")
        self.assertTrue(self.ran(root, options=one))
        self.assertTrue(self.ran(root, options=(*one, "--tools", "gcc 2")))
        self.assertTrue(self.ran(root, options=one, GTEST_FILTER="a"))
        self.assertTrue(self.ran(root, options=one, GTEST_FILTER="b"))
        self.assertFalse(self.ran(root, options=one, GTEST_FILTER="b"))
        (root / "device").write_text("#!/bin/sh\necho '* 0: a device (driver 2)'\n")
        self.assertTrue(self.ran(root, options=one, GTEST_FILTER="b"))

    def test_what_passed_in_one_folder_is_believed_in_another(self):
        here, there = self.checkout("here"), self.checkout("there")
        one = {root: ("--device", root / "device") for root in (here, there)}
        self.assertTrue(self.ran(here, options=one[here]))
        kept = here / "Misc/passed.csv"
        case = ET.fromstring('<testcase name="a" status="run"/>')
        run_tests.keep_passed(here / "build", [case], kept)
        self.assertEqual(list(unless_passed.read_passed(kept)), [("a", "a device (driver 1)")])
        self.assertEqual(run_tests.spot_check(["a", "b"], kept), "a")
        self.assertEqual(run_tests.spot_check(["b"], kept), "")
        shutil.copy(kept, there / "Misc")
        self.assertFalse(self.ran(there, options=one[there]))
        (there / "device").write_text("#!/bin/sh\necho '* 0: a device (driver 2)'\n")
        self.assertTrue(self.ran(there, options=one[there]))
        run_tests.keep_passed(there / "build", [case], there / "Misc/passed.csv")
        self.assertEqual(len(unless_passed.read_passed(there / "Misc/passed.csv")), 2, "one row a device")
        (there / "folder/part/a.txt").write_text("good, but other")
        self.assertTrue(self.ran(there, options=one[there]))
        run_tests.keep_passed(here / "build", [ET.fromstring('<testcase name="a" status="fail"/>')], kept)
        self.assertEqual(unless_passed.read_passed(kept), {})


if __name__ == "__main__":
    unittest.main()
