"""LibreQuake's maps under the base game's rules: each runs for a minute, and nothing on it lacks a spawn function."""

import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from qc.make import CompileError, compile_progs  # noqa: E402

DATA = pathlib.Path(os.environ.get("FULLBRIGHT_TEST_DATA", "../shared/librequake")) / "id1"
# What the engine says of a class that the rules do not know.
MISSING = re.compile(r"no spawn function|no class", re.IGNORECASE)
ERRORS = re.compile(r"error|SV_|runaway", re.IGNORECASE)


def maps_of_pak(path: pathlib.Path) -> list[str]:
    """Names of the playable maps in a pak; b_*.bsp are boxes of items."""
    data = path.read_bytes()
    start, size = struct.unpack_from("<ii", data, 4)
    names = [data[at : at + 56].split(b"\0")[0].decode() for at in range(start, start + size, 64)]
    return [pathlib.Path(name).stem for name in names if re.fullmatch(r"maps/(?!b_)\w+\.bsp", name)]


class LibreQuakeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.engine = os.environ.get("FULLBRIGHT", "")
        if not cls.engine:
            raise unittest.SkipTest("FULLBRIGHT names no program to play with")
        if not DATA.is_dir():
            raise unittest.SkipTest(f"no LibreQuake in {DATA.parent}: FULLBRIGHT_TEST_DATA names the folder that holds its id1/pak0.pak")
        try:
            progs = compile_progs()
        except CompileError as error:
            if "not installed" in str(error):
                raise unittest.SkipTest(str(error)) from error
            raise
        cls._folder = tempfile.TemporaryDirectory()
        cls.user = pathlib.Path(cls._folder.name) / "user"
        (cls.user / "id1").mkdir(parents=True)
        (cls.user / "id1" / "progs.dat").write_bytes(progs)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def run_map(self, name: str) -> tuple[str, str]:
        """What the server says in a minute of the map, and the level's state behind it."""
        command = [self.engine, "-dedicated", "1", "-seed", "1", "-port", str(21000 + os.getpid() % 5000), "-userdir", str(self.user)]
        command += ["-basedir", str(DATA.parent), "+host_framerate", "0.05", "+map", name, "+sv_run", "60", "+sv_dump", "state.txt"]
        done = subprocess.run([*command, "+quit"], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        said = done.stdout + done.stderr
        self.assertIn(f"Server spawned: {name}", said)
        state = self.user / "id1" / "state.txt"
        self.assertTrue(state.exists(), said)
        text = state.read_text(encoding="latin-1")
        state.unlink()
        return said, text

    def test_every_map_runs_for_a_minute(self):
        names = [name for pak in sorted(DATA.glob("*.pak")) for name in maps_of_pak(pak)]
        names += [path.stem for path in sorted(DATA.glob("maps/*.bsp"))]
        self.assertGreater(len(names), 4)
        for name in names:
            with self.subTest(name):
                said, state = self.run_map(name)
                self.assertNotRegex(said, MISSING)
                self.assertNotRegex(said.partition("Server spawned: ")[2], ERRORS)
                self.assertGreater(state.count('"classname"'), 20)
                self.assertGreater(float(re.search(r"time\W+([\d.]+)", state).group(1)), 60)


if __name__ == "__main__":
    unittest.main()
