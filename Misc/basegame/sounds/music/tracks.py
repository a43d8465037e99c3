"""The music's files: Ogg Vorbis, by oggenc of Debian's vorbis-tools.

The samples are the same every time, and the stream's serial number is fixed; the bytes are the same as long as oggenc and
its libraries are.
"""

from __future__ import annotations

import pathlib
import shutil
import subprocess

import numpy as np

from sounds.kit.waves import RATE
from sounds.music.pieces import PIECES

PATHS = {f"music/{name}.ogg": name for name in PIECES}
QUALITY = "2.5"


class NoEncoder(Exception):
    """There is no oggenc."""


def pcm(samples: np.ndarray) -> bytes:
    """(2, n) in -1..1 as interleaved 16-bit PCM."""
    return np.rint(samples.T * 32767.0).astype("<i2").tobytes()


def write(name: str, target: pathlib.Path) -> int:
    """Renders and encodes a piece; returns the file's size. NoEncoder where oggenc is missing or refuses."""
    program = shutil.which("oggenc")
    if program is None:
        raise NoEncoder(
            f"oggenc is missing (Debian: vorbis-tools), so {target.name} is left out; the game plays without music"
        )
    command = [program, "--quiet", "--raw", "--raw-bits=16", "--raw-chan=2", f"--raw-rate={RATE}"]
    command += ["--serial", "1", "--quality", QUALITY, "--output", str(target), "-"]
    done = subprocess.run(command, input=pcm(PIECES[name]()), stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise NoEncoder(f"oggenc could not write {target}: {done.stderr.decode(errors='replace').strip()}")
    return target.stat().st_size
