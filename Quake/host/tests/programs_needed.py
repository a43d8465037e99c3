"""What the programs' tests need, or are skipped without: exit status 77, and why."""

import os
import pathlib
import subprocess
import sys

import default_signals  # noqa: F401

SKIPPED = 77


def librequake():
    """LibreQuake's folder, and what is missing of it in one sentence (None where nothing is)."""
    data = pathlib.Path(os.environ.get("FULLBRIGHT_TEST_DATA", "../shared/librequake"))
    lacks = None if (data / "id1/pak0.pak").exists() else f"no LibreQuake in {data}: FULLBRIGHT_TEST_DATA names the folder that holds its id1/pak0.pak"
    return data.resolve(), lacks


def need(build, base_game=False):
    """Ends the test where there is no Vulkan device, or no base game though it is wanted."""
    if base_game and not (build / "game/id1/progs.dat").exists():
        print("skipped: the base game is not built")
        sys.exit(SKIPPED)
    if subprocess.run([build / "fullbright", "-listdevices"], capture_output=True, check=False).returncode != 0:
        print("skipped: no Vulkan device")
        sys.exit(SKIPPED)
