"""Finds the maps' scripts. A script NAME.py has `build() -> Map | dict[str, Map]` (a dict: of several maps, by name) and
stands in this folder or in lab/; its maps are written beside it."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
FOLDERS = (HERE, HERE / "lab")
for place in (HERE, HERE.parent):
    if str(place) not in sys.path:
        sys.path.insert(0, str(place))


def scripts() -> list[Path]:
    """All scripts that build maps, in order."""
    return [path for folder in FOLDERS for path in sorted(folder.glob("*.py"))
            if "\ndef build(" in path.read_text(encoding="utf-8")]


def maps_of(script: Path) -> dict[Path, str]:
    """The .map files that a script writes, and their text."""
    if str(script.parent) not in sys.path:
        sys.path.insert(0, str(script.parent))
    spec = importlib.util.spec_from_file_location(f"map_script_{script.stem}", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    built = module.build()
    named = built if isinstance(built, dict) else {script.stem: built}
    texts = {}
    for name, world in named.items():
        problems = world.check()
        if problems:
            raise ValueError(f"{script.name}: {name}:\n  " + "\n  ".join(problems))
        texts[script.parent / f"{name}.map"] = world.text()
    return texts
