"""Every model by name, and the function that makes it."""

from __future__ import annotations

from collections.abc import Callable

from formats.mdl import Mdl
from models import (
    boss,
    demon,
    dog,
    enforcer,
    fire,
    fish,
    hell_knight,
    items,
    keys,
    knight,
    missiles,
    ogre,
    oldone,
    player,
    shalrath,
    shambler,
    soldier,
    tarbaby,
    weapons,
    wizard,
    zombie,
)

MODELS: dict[str, Callable[[], Mdl]] = {}
for _module in (
    boss,
    demon,
    dog,
    enforcer,
    fire,
    fish,
    hell_knight,
    items,
    keys,
    knight,
    missiles,
    ogre,
    oldone,
    player,
    shalrath,
    shambler,
    soldier,
    tarbaby,
    weapons,
    wizard,
    zombie,
):
    MODELS.update(_module.MODELS)
