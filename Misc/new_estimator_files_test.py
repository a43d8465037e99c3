#!/usr/bin/env python3
"""new_estimator.py and the rules of the house, without a build: which names it refuses, the shape of what it writes, what it
says to do next. Besides these the table of steps that a new technique is written from, and what check_format.sh prints.

usage: new_estimator_files_test.py
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent
sys.path.insert(0, str(HERE))
import new_estimator  # noqa: E402

LONGEST = "z" * 31


def begin_estimator(root: pathlib.Path, *words: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, str(HERE / "new_estimator.py"), *words, "--root", str(root)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def contents(root: pathlib.Path) -> dict[pathlib.Path, bytes]:
    return {path: path.read_bytes() for path in root.rglob("*") if path.is_file()}


class InACopy(unittest.TestCase):
    """In a copy of what new_estimator.py reads and changes, one for all tests: each writes techniques of other names."""
    root: pathlib.Path

    @classmethod
    def setUpClass(cls):
        if hasattr(InACopy, "root"):
            return
        scratch = tempfile.TemporaryDirectory()
        unittest.addModuleCleanup(scratch.cleanup)
        InACopy.root = pathlib.Path(scratch.name)
        left_out = shutil.ignore_patterns("*.py", "*corpus*", "*.png", "__pycache__")
        for top in ("Quake", "Shaders"):
            shutil.copytree(SOURCE / top, cls.root / top, ignore=left_out)
        shutil.copy(SOURCE / ".clang-format", cls.root)


class Names(InACopy):
    def test_names_that_something_has_are_refused_and_nothing_is_written(self):
        before = contents(self.root)
        for words, found in (
                ("nee", "Shaders/estimators/nee is there"), ("ssmm_nee", "a shader ssmm_nee"), ("pt_medium", "a shader pt_medium"),
                ("gbuffer", "a shader gbuffer"), ("fold_seen", "a shader fold_seen"), ("mcpg_fold_cache", "a shader mcpg_fold_cache"),
                ("denoise_mean", "a shader denoise_mean"), ("denoise", "a shader denoise_"),
                ("probes memory setting view", "techniques/probes.cpp is there"), ("reservoirs", "techniques/reservoirs.cpp is there"),
                ("seen_grid", "techniques/seen_grid.cpp is there"), ("reweighting", "techniques/reweighting.cpp is there"),
                ("technique_memory", "techniques/technique_memory.cpp is there"), ("techniques", "techniques/techniques.cpp is there"),
                ("technique", "techniques/technique.h is there"), ("flame", "techniques/flame_test.cpp is there"),
                ("path_tail", "techniques/path_tail_statistics_test.cpp is there"),
                ("frame", "has kFrame"), ("guide memory", "guide_test.cpp is there"), ("light setting", "has FB_LIGHT_SETTINGS"),
                ("svgf setting", "has svgf_alpha"), ("albedo view", "has kViewAlbedo"), ("fold", "a shader fold_seen"),
                ("off view", "a debug view off"), ("path memory", "has PathTechnique"), ("former reuse", "former_kept"),
                ("gl_glow", "is no name"), ("glow__two", "is no name"), ("glow_", "is no name"), ("Glow", "is no name"),
                (LONGEST + "z", "is no name")):
            with self.subTest(words):
                done = begin_estimator(self.root, *words.split())
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(found, done.stdout)
                self.assertEqual(done.stdout.count("\n"), 1, done.stdout)
        self.assertEqual(contents(self.root), before)

    def test_a_second_technique_of_a_name_is_refused(self):
        done = begin_estimator(self.root, "glow", "memory")
        self.assertEqual(done.returncode, 0, done.stdout)
        before = contents(self.root)
        self.assertEqual(begin_estimator(self.root, "glow", "memory").returncode, 2)
        self.assertEqual(contents(self.root), before)


class Shape(InACopy):
    @unittest.skipIf(shutil.which("clang-format") is None, "no clang-format")
    def test_what_each_part_writes_needs_no_other_formatting(self):
        before = contents(self.root)
        for i, part in enumerate(["", *new_estimator.PARTS, "all"]):
            for name in (f"p{i}", f"{LONGEST[:-2]}{i:02}"):
                done = begin_estimator(self.root, name, *part.split())
                self.assertEqual(done.returncode, 0, done.stdout)
        written = [path for path, text in contents(self.root).items()
                   if before.get(path) != text and path.suffix in (".h", ".cpp", ".glsl", ".comp")]
        self.assertGreater(len(written), 150)
        done = subprocess.run(["clang-format", "--dry-run", "--Werror", f"--style=file:{self.root}/.clang-format", *map(str, written)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout[:2000])


class Next(InACopy):
    def test_what_is_said_to_do_next_hangs_on_the_parts(self):
        told = begin_estimator(self.root, "gleam", "record", "pass", "setting").stdout
        self.assertIn("make settings-page", told)
        self.assertIn("Quake/render/techniques/gleam_test.cpp", told)
        told = begin_estimator(self.root, "glint", "memory").stdout
        self.assertIn("Quake/render/techniques/glint_test.cpp", told)
        self.assertNotIn("settings-page", told)


class Steps(unittest.TestCase):
    def test_the_table_of_steps_is_that_of_the_steps(self):
        """Every function and constant of an empty step is in path.glsl's table, and every one of the table in a step."""
        text = (SOURCE / "Shaders/lib/path.glsl").read_text()
        table = re.search(r"// clang-format off\n(.*)// clang-format on\n", text, re.S)
        self.assertTrue(table, "the table of steps is not guarded from clang-format")
        rows = " ".join(line[2:].strip() for line in table[1].splitlines())
        function = r"\b(?:void|bool|float|vec3|Field|Proposal|Direct) \w+\([^)]*\)"
        told = {re.sub(r"\s+", " ", found) for found in re.findall(function, rows)}
        steps = "\n".join(path.read_text() for path in (SOURCE / "Shaders/lib/steps").glob("no_*.glsl"))
        steps += "".join((SOURCE / f"Shaders/lib/steps/{name}.glsl").read_text() for name in ("one_path", "propose_scatter"))
        defined = {re.sub(r"\s+", " ", found) for found in re.findall("^" + function + r"(?= \{)", steps, re.M)}
        self.assertGreater(len(defined), 20)
        self.assertEqual(told, defined)
        self.assertEqual(set(re.findall(r"\bk[A-Z]\w+", rows)), set(re.findall(r"^const bool (k\w+)", steps, re.M)))
        longest = max(map(len, text.splitlines()))
        self.assertLessEqual(longest, 120)


@unittest.skipIf(shutil.which("git") is None, "no git")
class CheckFormat(unittest.TestCase):
    def test_its_lines_are_whole_where_many_runs_speak_at_once(self):
        """With a clang-format that says its lines in pieces, in many runs at once."""
        with tempfile.TemporaryDirectory() as scratch:
            root, tools = pathlib.Path(scratch), pathlib.Path(scratch) / "tools"
            for folder in ("Misc", "tools", "Quake/render"):
                (root / folder).mkdir(parents=True)
            shutil.copy(HERE / "check_format.sh", root / "Misc")
            files = [f"Quake/render/a_file_{i}.cpp" for i in range(256)]
            for name in files:
                (root / name).touch()
            (tools / "nproc").write_text("#!/bin/sh\necho 8\n")
            (tools / "clang-format").write_text(
                '#!/bin/bash\n[ "$1" = --version ] && echo "version 14.0.6" && exit\nshift\n'
                'for f; do printf "%s" "${f%.cpp}" >&2; read -rt 0.005 <> <(:); printf "%s:1:2: warning: code\\n" .cpp >&2; done\ntrue\n')
            for tool in tools.iterdir():
                tool.chmod(0o755)
            subprocess.run("git init -q . && git add Quake", shell=True, cwd=root, check=True)
            done = subprocess.run([root / "Misc/check_format.sh"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}, check=False)
        self.assertEqual(done.returncode, 1, done.stdout[:500])
        self.assertEqual(sorted(done.stdout.splitlines()),
                         sorted(f"check_format: {name} is not as .clang-format wants it (make format)" for name in files))


if __name__ == "__main__":
    unittest.main()
