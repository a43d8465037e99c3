"""Which textures there are, and their sizes: the art's catalogue says."""

from __future__ import annotations

import functools


@functools.cache
def sizes() -> dict[str, tuple[int, int]]:
    """Width and height in texels by name."""
    from art.catalogue import TEXTURES

    return {name: (entry[0], entry[1]) for name, entry in TEXTURES.items()}


def size_of(name: str) -> tuple[int, int]:
    if name not in sizes():
        raise ValueError(f"there is no texture '{name}'")
    return sizes()[name]
