"""Every model by name, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable

from formats.mdl import Mdl
from models import items, knight, missiles, player, soldier, weapons

MODELS: dict[str, Callable[[], Mdl]] = {}
for _module in (player, weapons, soldier, knight, items, missiles):
    MODELS.update(_module.MODELS)
