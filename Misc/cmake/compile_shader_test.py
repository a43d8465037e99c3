#!/usr/bin/env python3
"""compile_shader.py writes what glslang writes, and takes from its cache what is the same and nothing else.

usage: compile_shader_test.py GLSLANG
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import compile_shader

GLSLANG = "glslangValidator"
SOURCE = """#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/step.glsl"
layout(local_size_x = 1) in;
layout(binding = 0) buffer Words { uint words[]; };
void main() { words[0] = step_of(WORD); }
"""
STEP = """#include "lib/number.glsl"
uint step_of(uint word) { return word + kNumber; }
"""


class CompileShader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.cache = self.root / "cache"
        self.write("a b/shader.comp", SOURCE)
        self.write("a b/lib/step.glsl", STEP)
        self.write("a b/lib/number.glsl", "const uint kNumber = 7u;\n")

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def words(self, *options: str, name: str = "word_spv", folder: str = "a b") -> list[str]:
        root = self.root / folder
        return [GLSLANG, "-V", "--quiet", "--target-env", "vulkan1.2", f"-I{root}", *(options or ["-DWORD=1u"]), *(["--vn", name] if name else []),
                "--depfile", str(self.root / "out.d"), "-o", str(self.root / "out.h"), str(root / "shader.comp")]

    def compiled(self, *options: str, cache: pathlib.Path | str | None = None, **others: str) -> bool:
        """Whether it was compiled, and not taken from the cache; what is written is glslang's in either case."""
        words = self.words(*options, **others)
        before = self.kept()
        script = pathlib.Path(__file__).with_name("compile_shader.py")
        environment = dict(os.environ, FULLBRIGHT_SHADER_CACHE=str(self.cache if cache is None else cache))
        done = subprocess.run([sys.executable, str(script), *words], env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found, depfile = (self.root / "out.h").read_bytes(), (self.root / "out.d").read_text()
        subprocess.run(words, check=True, capture_output=True)
        self.assertEqual(found, (self.root / "out.h").read_bytes())
        self.assertEqual(self.paths(depfile), self.paths((self.root / "out.d").read_text()))
        return self.kept() != before

    @staticmethod
    def paths(depfile: str) -> tuple[str, set[str]]:
        target, _, sources = depfile.replace("\\ ", "\0").partition(": ")
        return target, set(sources.split())

    def kept(self) -> set[str]:
        return {file.name for file in self.cache.glob("*")} if self.cache.is_dir() else set()

    def test_takes_what_is_the_same(self):
        self.assertTrue(self.compiled())
        self.assertFalse(self.compiled())
        self.assertFalse(self.compiled(name="another_spv"))

    def test_code_as_bytes_is_no_text(self):
        self.compiled()
        self.assertTrue(self.compiled(name=""))
        self.assertFalse(self.compiled(name=""))
        self.assertEqual((self.root / "out.h").read_bytes()[:4], b"\x03\x02\x23\x07")

    def test_comments_and_the_place_of_the_checkout_change_nothing(self):
        self.compiled()
        self.write("a b/lib/step.glsl", "/* what\nit is */\n\n" + STEP.replace("}\n", "}  // a \"step\"\n"))
        self.assertFalse(self.compiled())
        for name in ("shader.comp", "lib/step.glsl", "lib/number.glsl"):
            self.write("elsewhere/" + name, (self.root / "a b" / name).read_text())
        self.assertFalse(self.compiled(folder="elsewhere"))

    def test_compiles_what_is_not_the_same(self):
        self.compiled()
        self.assertTrue(self.compiled("-DWORD=2u"))
        self.write("a b/lib/number.glsl", "const uint kNumber = 8u;\n")
        self.assertTrue(self.compiled())
        self.write("a b/lib/number.glsl", "const uint kNumber = 8u; // and its comment\n")
        self.assertFalse(self.compiled())
        self.write("a b/number.glsl", "const uint kNumber = 9u;\n")
        self.write("a b/lib/step.glsl", STEP.replace("lib/number", "number"))
        self.assertTrue(self.compiled())

    def test_text_that_a_comment_hides_is_another(self):
        self.assertNotEqual(compile_shader.without_comments("// a \\\nint b;\n"), compile_shader.without_comments("// a\nint b;\n"))
        self.assertNotEqual(compile_shader.without_comments("#define A \\\n\nint b;\n"), compile_shader.without_comments("#define A \\\nint b;\n"))
        self.assertEqual(compile_shader.without_comments('X("a // b \\" // c")  // d\n'), 'X("a // b \\" // c")')

    def test_a_damaged_file_is_compiled_anew(self):
        self.compiled()
        (file,) = self.cache.glob("*")
        data = bytearray(file.read_bytes())
        data[len(data) // 2] ^= 1
        file.write_bytes(data)
        self.compiled()
        self.assertNotEqual(file.read_bytes(), data)
        file.write_bytes(b"")
        self.compiled()
        self.assertFalse(self.compiled())

    def test_without_a_cache_it_compiles(self):
        self.write("file", "")
        for cache in ("", self.root / "file" / "folder"):
            self.assertFalse(self.compiled(cache=cache))

    def test_errors_are_the_compilers(self):
        self.write("a b/lib/number.glsl", "uint kNumber = ;\n")
        done = subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name("compile_shader.py")), *self.words()],
                              env=dict(os.environ, FULLBRIGHT_SHADER_CACHE=str(self.cache)), capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("number.glsl", done.stdout)
        self.assertEqual(self.kept(), set())

    def test_the_oldest_go_first(self):
        for age in range(10):
            self.write(f"cache/{age}", "x" * 100)
            os.utime(self.cache / str(age), (1000 - age, 1000 - age))
        compile_shader.trim(self.cache, 1000)
        self.assertEqual(len(self.kept()), 10)
        compile_shader.trim(self.cache, 900)
        self.assertEqual(self.kept(), {str(age) for age in range(8)})


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        GLSLANG = sys.argv.pop(1)
    unittest.main()
