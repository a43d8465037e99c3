"""What the programs' tests need, or are skipped without: exit status 77, and why."""

import subprocess
import sys

SKIPPED = 77


def need(build, base_game=False):
    """Ends the test where there is no Vulkan device, or no base game though it is wanted."""
    if base_game and not (build / "game/id1/progs.dat").exists():
        print("skipped: the base game is not built")
        sys.exit(SKIPPED)
    if subprocess.run([build / "fullbright", "-listdevices"], capture_output=True, check=False).returncode != 0:
        print("skipped: no Vulkan device")
        sys.exit(SKIPPED)
