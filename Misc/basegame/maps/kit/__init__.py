"""Quake maps built by Python scripts: see README.md."""

from .brush import Tex, fit
from .map import Group, Map, side_textures

__all__ = ["Group", "Map", "Tex", "fit", "side_textures"]
