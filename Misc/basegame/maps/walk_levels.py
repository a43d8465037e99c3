#!/usr/bin/env python3
"""Writes walk_fb2.cfg, walk_fb3.cfg and walk_fb4.cfg, as walk_fb1.py does for the first level, and walk_game.cfg: the whole game from
the hub to its end.

    walk_levels.py PROGRAM BASEDIR [NAME ...]      the program `fullbright`, the folder that holds id1/; fb2 fb3 fb4 game

In walk_game.cfg the player is set down before each level's rune (`setpos`), since the other scripts show the way there: what is
shown is that the gates lead to the levels, know the runes and open the end.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from walker import Game, Walker, write_walk

HERE = Path(__file__).resolve().parent


def way(walk: Walker, *places: tuple[float, float], near: float = 24.0, speed: float = 200.0) -> None:
    for x, y in places:
        walk.to(x, y, near=near, tries=8, speed=speed)


def through(walk: Walker) -> None:
    """From before the rune, looking at it, through it and the gate, past tally and text."""
    walk.hold("forward", 8)
    walk.stand(6)
    walk.mark("walk_rune")
    walk.hold("forward", 30)
    walk.stand(60)
    for _ in range(2):  # ends the tally, and then the text
        walk.hold("attack", 2)
        walk.stand(40)


def leave(walk: Walker) -> None:
    walk.turn(90)
    through(walk)
    walk.mark("walk_exit")


# ---- fb2, water ----


def dive(walk: Walker) -> None:
    way(walk, (0, -600), (0, -360))
    walk.mark("walk_hall")
    way(walk, (0, -100), speed=140)
    walk.hold("movedown", 50)
    way(walk, (-210, 0), speed=140)
    walk.mark("walk_under_water")
    way(walk, (-460, 0), (-600, 0), (-760, 0), (-900, 0), (-1056, 0), near=30, speed=140)


def cistern(walk: Walker) -> None:
    walk.hold("moveup", 50)
    walk.say("+moveup")
    way(walk, (-1056, 110), speed=140)
    walk.say("-moveup")
    way(walk, (-1056, 215), (-1032, 262))
    walk.mark("walk_silver")
    way(walk, (-960, 225), (-800, 270))
    walk.push(90)
    walk.stand(20)
    way(walk, (-700, 272), (-520, 272), (-390, 272))
    walk.mark("walk_back")


def silver_door(walk: Walker) -> None:
    way(walk, (-350, 320), (0, 332), (0, 400))
    walk.stand(50)
    way(walk, (0, 560), (0, 690))
    walk.mark("walk_court")


def fountain(walk: Walker) -> None:
    way(walk, (0, 770))
    walk.say("+moveup")
    way(walk, (150, 850), (150, 1090), speed=140)
    walk.say("-moveup")
    way(walk, (140, 1230), (0, 1290), (0, 1330))


# ---- fb3, glass ----


def west_wing(walk: Walker) -> None:
    way(walk, (0, -600), (0, -400), (-120, -220), (-210, -48))
    walk.mark("walk_hall")
    way(walk, (-400, -48), (-620, -48), (-850, -48))
    walk.push(180)
    walk.mark("walk_west")
    way(walk, (-620, -48), (-400, -48), (-210, -48))


def east_wing(walk: Walker) -> None:
    way(walk, (-120, -160), (120, -160), (210, -48), (400, -48))
    maze = ((440, -48), (463, 150), (562, 168), (564, 0), (563, -196), (660, -196), (662, 0), (664, 168), (752, 168), (754, 0), (754, -196),
            (840, -196), (826, -60), (850, 100))
    way(walk, *maze, near=16)
    walk.push(0)
    walk.stand(60)
    walk.mark("walk_east")
    way(walk, *maze[:-1][::-1], near=16)
    way(walk, (400, -48), (210, -48))


def gold_door(walk: Walker) -> None:
    way(walk, (70, -32), (0, -32))
    walk.mark("walk_gold")
    way(walk, (0, 100), (0, 345))
    walk.stand(40)
    way(walk, (0, 500), (0, 630))
    walk.mark("walk_dome")


def well(walk: Walker) -> None:
    """Down into the water and up again by the lift."""
    way(walk, (150, 640), (150, 740), near=40)
    walk.stand(30)
    walk.mark("walk_well")
    walk.say("+moveup")
    way(walk, (-140, 760), (-256, 722), speed=140)
    walk.say("-moveup")
    walk.stand(60)
    walk.mark("walk_lift")
    way(walk, (-256, 630), (0, 620))


def bridge(walk: Walker) -> None:
    way(walk, (0, 700), (0, 920), (0, 1180), (0, 1290), near=20)


# ---- fb4, the machine ----


def power(walk: Walker) -> None:
    way(walk, (0, -600), (0, -430), (-380, -400))
    walk.mark("walk_hall")
    way(walk, (-560, -400), (-790, -400))
    walk.push(180)
    walk.stand(40)
    walk.mark("walk_power")
    way(walk, (-560, -400), (-380, -400), (-30, -330))


def hammers(walk: Walker) -> None:
    way(walk, (0, -240), (0, 180), (0, 300), (0, 400), near=20)
    walk.mark("walk_bridge")


def lift(walk: Walker) -> None:
    way(walk, (120, 346), (288, 346), (288, 430), (288, 522))
    walk.stand(50)
    walk.mark("walk_lift")
    way(walk, (288, 610), (60, 598), (-288, 598))


def mover_at(walk: Walker, target: str) -> bool:
    """Whether a train stands still on its way to `target`'s end or there."""
    for block in walk.state().text.split("\nedict "):
        if '"classname" "train"' in block and f'"target" "{target}"' in block:
            return '"velocity"' not in block
    return False


def until(walk: Walker, target: str) -> None:
    for _ in range(30):
        if mover_at(walk, target):
            return
        walk.stand(20)
    raise RuntimeError(f"nothing comes to {target}")


def crane(walk: Walker) -> None:
    until(walk, "crane_north")
    way(walk, (-288, 524), near=20)
    until(walk, "crane_south")
    walk.mark("walk_crane")
    way(walk, (-288, -450), (-288, -475))
    walk.push(270)
    walk.stand(20)
    walk.mark("walk_balcony")


def rune_door(walk: Walker) -> None:
    until(walk, "crane_north")
    way(walk, (-288, -395), near=40)
    walk.stand(20)
    way(walk, (-30, -330), (0, -240), (0, 180), (0, 300), (0, 420), (0, 660), (10, 790), (10, 1000), (0, 1076), near=20)


# ---- the game ----


def hub(walk: Walker) -> None:
    way(walk, (0, -660), (-60, -540), (-236, -400), (-246, -180), (-246, 120), (-236, 320), (-60, 372), (0, 530))
    walk.mark("game_hub")
    way(walk, (0, 700))
    walk.turn(90)
    walk.hold("forward", 12)
    walk.stand(40)
    walk.mark("game_gates")


# Which level, the frames from the start of the gates' hall to beside its gate, where that is, and a place before its rune.
LEVELS = (("fb1", 24, "moveleft", (-832, 1070, 220)), ("fb2", 56, "moveleft", (0, 1330, 30)), ("fb3", 56, "moveright", (0, 1300, 30)),
          ("fb4", 24, "moveright", (0, 1076, 30)))


def levels(walk: Walker) -> None:
    """By counted frames, always looking north: to look up where one is would play all levels again."""
    for name, frames, side, (x, y, z) in LEVELS:
        walk.hold("forward", frames)
        walk.stand(8)
        walk.hold(side, 36)
        walk.stand(40)
        walk.mark(f"game_{name}")
        safe(walk)
        walk.say(f"setpos {x} {y} {z} 0 90 0")
        walk.say("noclip")  # setpos has turned it on
        walk.stand(10)
        through(walk)
        walk.mark(f"game_after_{name}")


def safe(walk: Walker) -> None:
    walk.say("god")
    walk.say("notarget")


def below(walk: Walker) -> None:
    """Into the shaft, out of the water, up to the gate in the south, backwards."""
    safe(walk)
    walk.hold("forward", 44)
    walk.stand(50)
    walk.mark("game_below")
    walk.say("+moveup")
    walk.say("+back")
    walk.stand(34)
    walk.say("-moveup")
    walk.stand(10)
    walk.say("-back")


def end(walk: Walker) -> None:
    walk.stand(90)  # until what circles is where it has to be
    walk.mark("game_before")
    walk.say("record the_end")  # what is told at the end is in no dump
    walk.hold("back", 24)
    walk.stand(30)
    walk.mark("game_frag")
    walk.stand(120)
    walk.mark("game_end")
    walk.say("stop")


WALKS = {"fb2": ("fb2", (dive, cistern, silver_door, fountain, leave)), "fb3": ("fb3", (west_wing, east_wing, gold_door, well, bridge, leave)),
         "fb4": ("fb4", (power, hammers, lift, crane, rune_door, leave)), "game": ("start", (hub, levels, below, end))}


def main() -> int:
    wanted = sys.argv[3:] or list(WALKS)
    if len(sys.argv) < 3 or any(name not in WALKS for name in wanted):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    status = 0
    for name in wanted:
        level, legs = WALKS[name]
        walk = Walker(Game(Path(sys.argv[1]), Path(sys.argv[2]), Path(tempfile.mkdtemp()), level), first=("notarget", "god"))
        header = (f"A player on the way through {'the game' if name == 'game' else name}. Written by walk_levels.py; -headless -seed 1 "
                  f"+skill 0 +host_framerate 0.05 +map {level} +exec this.")
        status |= write_walk(walk, legs, HERE / f"walk_{name}.cfg", header)
    return status


if __name__ == "__main__":
    sys.exit(main())
