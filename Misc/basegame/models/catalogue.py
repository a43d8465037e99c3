"""Every model by name, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable

from formats.mdl import Mdl
from models import boss, demon, dog, enforcer, fish, items, knight, missiles, ogre, oldone, player, shalrath, shambler, soldier, tarbaby, weapons, wizard, zombie

MODELS: dict[str, Callable[[], Mdl]] = {}
for _module in (player, weapons, soldier, knight, items, missiles, ogre, zombie, enforcer, demon, shambler, dog, wizard, fish, tarbaby, shalrath, boss, oldone):
    MODELS.update(_module.MODELS)
