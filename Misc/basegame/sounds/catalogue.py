"""Which recipe makes which sound.

A recipe is a function of a numpy Generator, seeded with the sound's name, that returns a signal (n,) or a Loop. It
stands in recipes/ under `@sound("weapons/sgun1")`; conventions.py says how loud and how long.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable

import numpy as np

from formats.wav import Wav
from sounds.conventions import CONVENTIONS
from sounds.kit.master import Loop, master
from sounds.kit.waves import generator

Recipe = Callable[[np.random.Generator], "np.ndarray | Loop"]

_recipes: dict[str, tuple[Recipe, bool]] = {}


def sound(*names: str, half: bool = False) -> Callable[[Recipe], Recipe]:
    """Registers a recipe for sounds (several differ by their random numbers). half: half the sampling rate is enough."""

    def register(recipe: Recipe) -> Recipe:
        for name in names:
            if name not in CONVENTIONS:
                raise ValueError(f"{name} is not in conventions.py")
            if name in _recipes:
                raise ValueError(f"{name} has two recipes")
            _recipes[name] = (recipe, half)
        return recipe

    return register


def recipes() -> dict[str, tuple[Recipe, bool]]:
    """name: recipe, in the order of names."""
    import sounds.recipes

    for module in pkgutil.iter_modules(sounds.recipes.__path__):
        importlib.import_module(f"sounds.recipes.{module.name}")
    return dict(sorted(_recipes.items()))


def make(name: str) -> Wav:
    """The sound of that name (without sound/ and .wav)."""
    recipe, half = recipes()[name]
    return master(recipe(generator(name)), CONVENTIONS[name].loudness, half)
