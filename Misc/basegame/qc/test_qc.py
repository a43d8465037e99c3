"""progs.dat as a file: it compiles without a warning, is what engines expect, and knows every classname."""

import pathlib
import re
import struct
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from qc.make import CompileError, compile_progs  # noqa: E402
from qc.testing.classnames import ALL  # noqa: E402


def functions_of(progs: bytes) -> dict[str, int]:
    """Each function's name and first statement (negative: a builtin's number)."""
    words = struct.unpack_from("<15i", progs)
    functions, count, strings = words[8], words[9], words[10]
    found = {}
    for i in range(count):
        first, name = struct.unpack_from("<i12xi", progs, functions + 36 * i)
        end = progs.index(b"\0", strings + name)
        found[progs[strings + name : end].decode("latin-1")] = first
    return found


class ProgsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            cls.progs = compile_progs()
        except CompileError as error:
            if "not installed" in str(error):
                raise unittest.SkipTest(str(error)) from error
            raise
        cls.functions = functions_of(cls.progs)

    def test_header_is_quakes(self):
        self.assertEqual(struct.unpack_from("<2i", self.progs), (6, 5927))

    def test_no_name_of_a_function_twice(self):
        """Saved games keep functions by their names, so what is static to a file may not share one either."""
        texts = [path.read_text(encoding="ascii") for path in HERE.rglob("*.qc") if not path.name.startswith("test_")]
        names = [name for text in texts for name in re.findall(r"^(?:static )?\w+\([^;=]*\) (\w+) = \{", text, re.M)]
        self.assertGreater(len(names), 500)
        self.assertEqual(sorted({name for name in names if names.count(name) > 1}), [])

    def test_same_bytes_twice(self):
        self.assertEqual(self.progs, compile_progs())

    def test_every_classname_spawns(self):
        self.assertEqual([name for name in ALL if self.functions.get(name, 0) <= 0], [])

    def test_every_classname_of_our_maps_spawns(self):
        used = {}
        for path in (HERE.parent / "maps").rglob("*.map"):
            for name in re.findall(r'^\s*"classname"\s+"(\w+)"', path.read_text(encoding="latin-1"), re.M):
                used[name] = path.name
        # What the map's compiler takes away.
        kept = {
            name: where
            for name, where in used.items()
            if not name.startswith(("func_group", "func_detail", "misc_external"))
        }
        self.assertEqual({n: w for n, w in kept.items() if self.functions.get(n, 0) <= 0}, {})

    def test_only_quakes_builtins(self):
        used = sorted(-first for first in self.functions.values() if first < 0)
        self.assertLessEqual(used[-1], 78)

    def test_no_assignment_loses_half_its_condition(self):
        """The compiler reads `x = a && b` as `(x = a) && b`, and says nothing."""
        for path in HERE.rglob("*.qc"):
            for number, line in enumerate(path.read_text(encoding="ascii").split("\n"), 1):
                taken = re.match(r"\s*[\w.]+ = (.*);", line.split("//")[0])
                inner = taken.group(1) if taken else ""
                while re.search(r"\([^()]*\)", inner):
                    inner = re.sub(r"\([^()]*\)", "", inner)
                self.assertNotRegex(inner, r"&&|\|\|", f"{path.name}:{number}: put parentheses around the condition")

    def test_every_file_is_known_to_sources(self):
        """Each source is compiled, and each that is named exists."""
        named = (HERE / "progs.src").read_text(encoding="ascii").split()[1:]
        for name in [*named]:
            named += re.findall(r'^#include "([^"]+)"', (HERE / name).read_text(encoding="ascii"), re.M)
        there = [str(p.relative_to(HERE)) for p in HERE.rglob("*.qc") if not p.name.startswith("test_")]
        self.assertEqual(sorted(named), sorted(there))


if __name__ == "__main__":
    unittest.main()
