"""Who and what is placed in a level: monsters by skill, items, triggers."""

from __future__ import annotations

from kit import Map

NOT_EASY, NOT_NORMAL, NOT_HARD, NOT_DEATHMATCH = 256, 512, 1024, 2048
SKILL_FLAGS = {0: 0, 1: NOT_EASY, 2: NOT_EASY | NOT_NORMAL}


def monster(world: Map, kind: str, x: float, y: float, floor: float, angle: float, skill: int = 0, **keys) -> None:
    """A monster on a floor, from that skill on, never in deathmatch."""
    flags = SKILL_FLAGS[skill] | NOT_DEATHMATCH | keys.pop("flags", 0)
    world.entity(f"monster_{kind}", (x, y, floor + 26), angle=angle, spawnflags=flags, **keys)


def item(world: Map, kind: str, x: float, y: float, floor: float, flags: int = 0, **keys) -> None:
    """An item on a floor; boxes of ammunition and health have their corner there, so they are moved to their middle."""
    if kind in ("health", "shells", "spikes", "rockets", "cells"):
        x, y = x - 16, y - 16
        keys["origin"] = (x, y, floor + 2)
    else:
        keys["origin"] = (x, y, floor + 26)
    if flags:
        keys["spawnflags"] = flags
    origin = keys.pop("origin")
    prefix = "" if kind.startswith("weapon_") else "item_"
    world.entity(prefix + kind, origin, **keys)


def trigger(world: Map, kind: str, lo, hi, **keys) -> None:
    world.part(f"trigger_{kind}", **keys).box(lo, hi, "trigger")


def secret(world: Map, lo, hi) -> None:
    trigger(world, "secret", lo, hi)
