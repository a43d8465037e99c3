#!/usr/bin/env python3
"""Records testdemos/hub.dem: half a minute's walk through the hub, as a film would show it.

    walk_hub.py PROGRAM BASEDIR [FILE.dem]     the program `fullbright`, the folder that holds id1/

The way is a table below; the same program and game give the same demo.
"""

from __future__ import annotations

import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from walker import ALIASES, FRAME, waits

HERE = Path(__file__).resolve().parent
DEMO = HERE.parents[2] / "testdemos" / "hub.dem"
SETTINGS = ("cl_alwaysrun 0", "lookspring 0", "cl_bob 0.01", "r_drawviewmodel 0", "crosshair 0")
PIECE = 5  # frames between changes of speed
# Seconds, x, y, yaw, pitch (down is positive) that the walk passes.
WAY = [
    (0.0, 0, -992, 90, 0),
    (4.5, 0, -660, 90, -3),  # through the porch, towards the light in the middle door
    (7.0, -60, -540, 112, -14),  # into the nave, looking up to the bell
    (10.0, -236, -400, 92, -6),
    (13.0, -246, -180, 52, 6),  # along the pool, looking across it
    (17.0, -246, 120, 22, 8),
    (20.0, -236, 320, 58, -6),
    (23.0, -60, 372, 86, -16),  # the furnaces, the rose, up the stairs
    (25.5, 0, 530, 90, -6),
    (30.0, 0, 560, -90, 4),  # and round, back over the water
    (33.0, 0, 536, -90, 2),
]


def between(time: float) -> tuple[float, float, float, float]:
    """Where the walk is at a time: along straight lines, views eased."""
    for (t0, *a), (t1, *b) in zip(WAY, WAY[1:]):
        if time <= t1:
            part = (time - t0) / (t1 - t0)
            eased = part * part * (3.0 - 2.0 * part)
            return tuple(p + (q - p) * (part if k < 2 else eased) for k, (p, q) in enumerate(zip(a, b)))
    return tuple(WAY[-1][1:])


def film() -> list[str]:
    """All four keys are held throughout; only the speeds change, which may be negative."""
    lines = waits(12) + ["cl_forwardspeed 0;cl_sidespeed 0;cl_yawspeed 0;cl_pitchspeed 0", "+forward;+moveright;+left;+lookdown"]
    step = PIECE * FRAME
    for k in range(round(WAY[-1][0] / step)):
        x0, y0, yaw0, pitch0 = between(k * step)
        x1, y1, yaw1, pitch1 = between((k + 1) * step)
        angle = math.radians((yaw0 + yaw1) / 2.0)
        vx, vy = (x1 - x0) / step, (y1 - y0) / step
        forward, right = vx * math.cos(angle) + vy * math.sin(angle), vx * math.sin(angle) - vy * math.cos(angle)
        lines.append(f"cl_forwardspeed {forward:.2f};cl_sidespeed {right:.2f};cl_yawspeed {(yaw1 - yaw0) / step:.3f};"
                     f"cl_pitchspeed {(pitch1 - pitch0) / step:.3f};w5")
    return lines + ["-forward;-moveright;-left;-lookdown", *waits(10), "stop", "wait", "quit"]


def main() -> int:
    if len(sys.argv) not in (3, 4):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    target = Path(sys.argv[3]) if len(sys.argv) == 4 else DEMO
    with tempfile.TemporaryDirectory() as user:
        folder = Path(user) / "id1"
        folder.mkdir()
        (folder / "film.cfg").write_text("\n".join([*SETTINGS, *ALIASES, *film()]) + "\n", encoding="ascii")
        subprocess.run([sys.argv[1], "-headless", "-size", "16x16", "-seed", "1", "-basedir", sys.argv[2], "-userdir", user,
                        "+host_framerate", str(FRAME), "+skill", "1", "+record", "hub", "start", "+exec", "film.cfg"],
                       check=True, stdout=subprocess.DEVNULL, timeout=600)
        shutil.copy(folder / "hub.dem", target)
    print(f"{target}: {target.stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
