#!/usr/bin/env python3
"""The settings of the laboratory's scenes, testdemos/scenes/NAME.json, as options of fullbright-lab.

    scenes.py list              the scenes' names
    scenes.py args NAME         options for `fullbright-lab render|reference|bench ...`, one line
    scenes.py script NAME       the script that its demo is recorded with, as console commands
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
KEYS = {"map", "hard", "camera", "set", "frame", "tick", "script", "protocol", "reference_estimator"}


def names() -> list[str]:
    return sorted(path.stem for path in (HERE / "scenes").glob("*.json"))


def load(name: str) -> dict:
    """A scene's settings; ValueError says what is wrong with them."""
    path = HERE / "scenes" / f"{name}.json"
    if not path.exists():
        raise ValueError(f"there is no scene '{name}'; there are: {', '.join(names())}")
    scene = json.loads(path.read_text(encoding="utf-8"))
    unknown, missing = set(scene) - KEYS, {"map", "hard", "script"} - set(scene)
    if unknown or missing:
        raise ValueError(f"{path}: " + ", ".join([f"'{k}' is no key" for k in unknown] + [f"no '{k}'" for k in missing]))
    return {"set": {}, "tick": 0.05, "reference_estimator": "pt"} | scene


def demo_of(name: str) -> Path:
    return HERE / f"{name}.dem"


def lab_args(name: str) -> list[str]:
    """What the laboratory looks at: a frame of the demo where the scene names one, else its map."""
    scene = load(name)
    if "frame" in scene:
        args = ["--demo", str(demo_of(name)), "--fps", f"{1 / scene['tick']:g}"]
    else:
        args = ["--map", scene["map"]]
    if "camera" in scene:
        args += ["--camera", ",".join(f"{c:g}" for c in scene["camera"])]
    for key, value in scene["set"].items():
        args += ["--set", f"{key}={value}"]
    return args


def script_lines(name: str) -> list[str]:
    """Console commands; `wait N` stands for N frames. Signing on takes the first."""
    lines = ["wait"] * 12
    for command in load(name)["script"]:
        word, _, count = command.partition(" ")
        lines += ["wait"] * int(count or 1) if word == "wait" else [command]
    return lines + ["stop", "quit"]


def main() -> int:
    try:
        if sys.argv[1:] == ["list"]:
            print("\n".join(names()))
        elif len(sys.argv) == 3 and sys.argv[1] in ("args", "script"):
            print(" ".join(lab_args(sys.argv[2])) if sys.argv[1] == "args" else "\n".join(script_lines(sys.argv[2])))
        else:
            print(__doc__.strip(), file=sys.stderr)
            return 2
    except ValueError as error:
        print(f"scenes.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
