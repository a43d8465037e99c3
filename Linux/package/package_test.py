#!/usr/bin/env python3
"""The package of a build folder as somebody gets it: package_test.py BUILD_DIR. It is made without compression, unpacked into an empty
folder, and played from there; made again, it has the same bytes. Skipped, saying so, without Debian's dpkg-dev, file or dpkg-deb."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path("build").resolve()
TOOLS = ("dpkg-deb", "dpkg-shlibdeps", "file", "cpack", "ldd")
SKIPPED = 77
TIME = "1700000000"


def run(*command, **more) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, **more)
    assert done.returncode == 0, f"{command}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.deb = cls.make("first")
        cls.root = cls.folder / "root"
        run("dpkg-deb", "--extract", cls.deb, cls.root)

    @classmethod
    def make(cls, name: str) -> pathlib.Path:
        out = cls.folder / name
        run("cpack", "-G", "DEB", "-B", out, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none", cwd=BUILD, env=os.environ | {"SOURCE_DATE_EPOCH": TIME})
        (deb,) = out.glob("fullbright_*.deb")
        return deb

    def test_it_says_what_it_needs(self):
        field = lambda name: run("dpkg-deb", "--field", self.deb, name).strip()  # noqa: E731
        self.assertEqual(field("Package"), "fullbright")
        for library in ("libvulkan1", "libsdl2-2.0-0", "libc6"):
            self.assertIn(library, field("Depends"))
        self.assertEqual(field("Recommends"), "mesa-vulkan-drivers")
        self.assertNotIn("\n \n", field("Description"))

    def test_its_programs_find_their_game_and_play_it(self):
        program = self.root / "usr/bin/fullbright"
        said = run(program, "-dedicated", "1", "-nolan", "-userdir", self.folder / "user", "+map", "start", "+status", "+quit", cwd=self.folder)
        self.assertIn("Server spawned: start", said)
        estimators = run(self.root / "usr/bin/fullbright-lab", "estimators", cwd=self.folder)
        self.assertIn("mcpg_nee", estimators)

    def test_its_pages_are_of_these_programs(self):
        man = (self.root / "usr/share/man/man6/fullbright.6").read_text()
        options = re.findall(r"^  -(\w+)", run(self.root / "usr/bin/fullbright", "-help"), re.M)
        self.assertGreater(len(options), 10)
        for option in options:
            self.assertIn(f"\n  \\-{option}", man)
        lab = (self.root / "usr/share/man/man1/fullbright-lab.1").read_text()
        for command in ("RENDER", "AUTHORED", "ZTEST"):
            self.assertIn(f"\n.SH {command}\n", lab)

    def test_what_it_loads_is_in_the_bill_of_materials(self):
        document = json.loads((self.root / "usr/share/doc/fullbright/fullbright.spdx.json").read_text())
        names = {package["name"] for package in document["packages"]}
        self.assertTrue({"fullbright", "libvulkan1", "libsdl2-2.0-0", "libc6"} <= names, names)
        self.assertEqual(len(document["relationships"]), len(names))
        for package in document["packages"]:
            self.assertTrue(package["versionInfo"], package)

    def test_a_desktop_shows_it(self):
        entry = (self.root / "usr/share/applications/fullbright.desktop").read_text()
        self.assertIn("\nExec=fullbright\n", entry)
        self.assertTrue((self.root / "usr/share/icons/hicolor/scalable/apps/fullbright.svg").stat().st_size > 0)
        if shutil.which("desktop-file-validate"):
            run("desktop-file-validate", self.root / "usr/share/applications/fullbright.desktop")

    def test_made_again_it_has_the_same_bytes(self):
        sums = {hashlib.sha256(deb.read_bytes()).hexdigest() for deb in (self.deb, self.make("second"))}
        self.assertEqual(len(sums), 1)


if __name__ == "__main__":
    lacks = [tool for tool in TOOLS if not shutil.which(tool)]
    lacks += [] if (BUILD / "package/fullbright.spdx.json").exists() else ["package_files, which is not built"]
    if lacks:
        print(f"skipped: {', '.join(lacks)} (Linux/install-deps.sh package)")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)
