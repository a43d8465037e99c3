#!/usr/bin/env python3
"""Writes fight_fb1.cfg: a player without god, who walks into the level's court and fights whoever is there.

    fight_fb1.py PROGRAM BASEDIR [USERDIR]     the program `fullbright`, the folder that holds id1/

He shoots at the nearest monster that is left, and goes up to it where it is far: no more than a beginner does. The marks
fight_begin, fight_hurt (the first time that something has hit him) and fight_end are where the test reads the state.
"""

from __future__ import annotations

import math
import re
import sys
import tempfile
from pathlib import Path

from walker import Game, State, Walker

HERE = Path(__file__).resolve().parent
COURT_NORTH = 0.0  # y of what belongs to the court
SKILL = 1
ROUNDS = 60  # of a burst or a few steps each
SHOT_FRAMES = 10  # the shotgun's half second
IN_REACH = 420.0  # units; its pellets spread


def monsters(state: State) -> list[dict[str, str]]:
    """The court's monsters that are alive, as a dump has them."""
    blocks = (dict(re.findall(r'"([^"]+)" "([^"]*)"', block)) for block in state.text.split("\nedict ")[1:])
    return [m for m in blocks if m.get("classname", "").startswith("monster_") and float(m.get("health", "0")) > 0
            and place(m)[1] < COURT_NORTH]


def place(edict: dict[str, str]) -> list[float]:
    return [float(c) for c in edict["origin"].split()]


def far(state: State, monster: dict[str, str]) -> float:
    return math.dist(state.origin, place(monster))


def fight(walk: Walker) -> None:
    hurt = False
    for _ in range(ROUNDS):
        state = walk.state()
        if not hurt and float(state.player("health")) < 100:
            walk.mark("fight_hurt")
            hurt = True
        left = monsters(state)
        if not left:
            return
        if float(state.player("health", "0")) <= 0:
            raise RuntimeError("the player died")
        nearest = min(left, key=lambda m: far(state, m))
        x, y, _ = place(nearest)
        here = state.origin
        walk.turn(math.degrees(math.atan2(y - here[1], x - here[0])))
        if far(state, nearest) <= IN_REACH:
            walk.hold("attack", SHOT_FRAMES)
        else:
            walk.hold("forward", 12)
    raise RuntimeError("the fight does not end")


def main() -> int:
    if len(sys.argv) not in (3, 4):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    user = Path(sys.argv[3]) if len(sys.argv) == 4 else Path(tempfile.mkdtemp())
    walk = Walker(Game(Path(sys.argv[1]), Path(sys.argv[2]), user, "fb1", before=[f"skill {SKILL}"]))
    walk.mark("fight_begin")
    walk.to(0, -720)
    try:
        fight(walk)
    except RuntimeError as error:
        print(f"fight_fb1.py: {error}", file=sys.stderr)
        return 1
    walk.stand(10)
    walk.mark("fight_end")
    print(f"health {walk.state().player('health')}, {len(walk.lines)} lines")
    header = (f"A player fights in fb1's court. Written by fight_fb1.py; -headless -seed 1 +skill {SKILL} +host_framerate 0.05 "
              "+map fb1 +exec this.")
    (HERE / "fight_fb1.cfg").write_text(walk.text(header) + "quit\n", encoding="ascii")
    return 0


if __name__ == "__main__":
    sys.exit(main())
