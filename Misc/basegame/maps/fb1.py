"""The first level, fire: the Sunken Works. A court; the sluice hall, from which all ways go; west the furnace with the silver key over
lava; north behind the silver door the chapel and its well; down the well and under water to the cistern with the gold key;
from there back to the hall, up by the lift to the gallery, and through the gold door to the bell tower and out."""

from __future__ import annotations

import fb1_chapel
import fb1_cistern
import fb1_court
import fb1_furnace
import fb1_hall
import fb1_tower
from kit import Group, Map

PARTS = (fb1_court, fb1_hall, fb1_furnace, fb1_chapel, fb1_cistern, fb1_tower)


def build() -> Map:
    world = Map("The Sunken Works", sounds=3, worldtype=0, _wateralpha=0.6, _minlight=22, fog="0.04 0.36 0.42 0.46", _sunlight=200,
                _sunlight_color="255 206 160", _sun_mangle="118 -52 0", _sunlight_penumbra=3, _sunlight2=110,
                _sunlight2_color="140 165 205")
    # All walls first, then all openings, so that a doorway goes through whatever walls meet there.
    walls = Group()
    for part in PARTS:
        part.rooms(walls)
    for part in PARTS:
        part.openings(walls)
    world.add(walls)
    for part in PARTS:
        part.furnish(world)
        part.people(world)
    return world
