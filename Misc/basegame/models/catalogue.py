"""Every model by name, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from models.kit.figure import Figure

FILES = """
boss demon dog enforcer fire fish hell_knight items keys knight missiles ogre oldone player shalrath shambler
soldier tarbaby weapons wizard zombie
""".split()

MODELS: dict[str, Callable[[], Figure]] = {}
for _file in FILES:
    MODELS.update(import_module(f"models.{_file}").MODELS)
