"""Every model by name, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable

from formats.mdl import Mdl
from models import demon, dog, enforcer, fish, items, knight, missiles, ogre, player, shambler, soldier, tarbaby, weapons, wizard, zombie

MODELS: dict[str, Callable[[], Mdl]] = {}
for _module in (player, weapons, soldier, knight, items, missiles, ogre, zombie, enforcer, demon, shambler, dog, wizard, fish, tarbaby):
    MODELS.update(_module.MODELS)
