"""Ways between levels: gates there, the gate home with its rune before it, and words to those who come near."""

from __future__ import annotations

from kit import Group, Map, fit
from pieces import slipgate

STRAIGHT = 1  # an exit's spawnflag: without the tally


def word(world: Map, lo, hi, message: str) -> None:
    """Said to who comes by."""
    world.part("trigger_multiple", message=message, wait=4).box(lo, hi, "trigger")


def gate(level: str, width: float, height: float, flags: int = STRAIGHT, frame: str = "copper_plate",
         light: str = "rune_a") -> Group:
    """A gate in the plane y = 0, to be walked into northwards, that leads to a level."""
    group = Group().add(slipgate(width, height, frame, light))
    half = width / 2
    group.part("func_illusionary").box((-half, -2, 0), (half, 2, height), "*teleport")
    group.part("trigger_changelevel", map=level, spawnflags=flags).box((-half, -6, 0), (half, 6, height - 6), "trigger")
    return group


def passage_home(level: str, width: float, height: float) -> Group:
    """A way back, straight."""
    return gate(level, width, height, STRAIGHT, "copper_plate", "rune_b")


def way_out(rune: int, width: float = 80, height: float = 128) -> Group:
    """The end of a level: the gate to the four gates, after the tally; the rune lies on a plate before it."""
    group = gate("gates", width, height, 0, "copper_plate", "rune_b")
    group.detail.cylinder((0, -96), 40, 0, 4, {"all": "copper_trim", "top": fit("rune_a")}, sides=8)
    group.detail.cylinder((0, -96), 30, 4, 8, {"all": "marble_black", "top": fit("rune_b")}, sides=8)
    group.entity("item_sigil", (0, -96, 34), spawnflags=rune)
    return group


def arrival(world: Map, x: float, y: float, floor: float, title: str) -> None:
    """Where players begin, looking north, before a dead gate; the level's name is said as they go on."""
    world.add(slipgate(72, 112, "copper_plate", "rune_a"), (x, y - 56, floor))
    world.part("func_illusionary").box((x - 36, y - 58, floor), (x + 36, y - 54, floor + 112), "*teleport")
    world.entity("info_player_start", (x, y, floor + 28), angle=90)
    for dx, dy in ((-36, 40), (36, 40), (-36, 88), (36, 88)):
        world.entity("info_player_coop", (x + dx, y + dy, floor + 28), angle=90)
    world.part("trigger_multiple", message=title, wait=-1).box((x - 64, y + 48, floor), (x + 64, y + 64, floor + 96), "trigger")
