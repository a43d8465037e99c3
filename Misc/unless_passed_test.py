#!/usr/bin/env python3
"""unless_passed.py runs a command where files or the command changed, or it failed, and only there."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest


class UnlessPassed(unittest.TestCase):
    def test_runs_what_has_not_passed_with_the_same_files(self):
        with tempfile.TemporaryDirectory() as scratch:
            root = pathlib.Path(scratch)
            (root / "folder/part").mkdir(parents=True)
            file = root / "folder/part/a.txt"
            file.write_text("good")

            def ran(word: str = "", status: int = 0, **environment: str) -> bool:
                (root / "ran").unlink(missing_ok=True)
                command = ["sh", "-c", f'touch {root}/ran; echo "$2"; grep -q good "$1"', "sh", str(file), word]
                done = subprocess.run([sys.executable, pathlib.Path(__file__).with_name("unless_passed.py"), root / "stamps/a", root / "folder", *command],
                                      env=dict(os.environ, **environment), stdout=subprocess.DEVNULL, check=False)
                self.assertEqual(done.returncode, status)
                return (root / "ran").exists()

            self.assertTrue(ran())
            self.assertFalse(ran())
            self.assertTrue(ran(FULLBRIGHT_RUN_AGAIN="1"))
            self.assertTrue(ran("another word"))
            file.write_text("bad")
            self.assertTrue(ran("another word", status=1))
            self.assertTrue(ran("another word", status=1), "what failed is no pass")
            file.write_text("good")
            self.assertTrue(ran("another word"), "nor is what passed before it failed")
            (root / "folder/b.txt").write_text("")
            self.assertTrue(ran("another word"))
            self.assertFalse(ran("another word"))
            for _ in range(2):
                self.assertTrue(ran("skipped"), "the rest of it may have its turn")


if __name__ == "__main__":
    unittest.main()
