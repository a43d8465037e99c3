"""Every file that progs.dat names is made by a part of the base game."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from qc.make import CompileError, compile_progs  # noqa: E402
from qc.testing.game import names_in  # noqa: E402

GENERATORS = ["art", "models", "sounds", "maps"]
# Maps that the rules know by name: Quake's own, which need not be there.
NOT_LOADED = {"maps/e1m8.bsp", "maps/start.bsp"}


def made_by(part: str) -> set[str]:
    listing = subprocess.run(
        [sys.executable, str(HERE.parent / part / "make.py"), "--list"],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": str(HERE.parent), "PYTHONDONTWRITEBYTECODE": "1"},
    ).stdout
    return {line.split()[0] for line in listing.splitlines() if line.strip()}


class FilesTest(unittest.TestCase):
    def test_every_file_that_progs_names_is_made(self):
        if importlib.util.find_spec("numpy") is None:
            self.skipTest("the other parts' generators need numpy")
        try:
            names = names_in(compile_progs())
        except CompileError as error:
            if "not installed" in str(error):
                self.skipTest(str(error))
            raise
        made = set().union(*(made_by(part) for part in GENERATORS))
        paths = [f"sound/{name}" if name.endswith(".wav") else name for name in names]
        self.assertEqual([p for p in paths if p not in made | NOT_LOADED], [])


if __name__ == "__main__":
    unittest.main()
