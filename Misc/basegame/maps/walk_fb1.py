#!/usr/bin/env python3
"""Writes walk_fb1.cfg: a player on the way through the level, from the start to the exit; where a leg fails, the script ends
before it and the exit status is 1.

    walk_fb1.py PROGRAM BASEDIR [USERDIR]      the program `fullbright`, the folder that holds id1/

Nobody fights on the way: `notarget` keeps the monsters from noticing and `god` is for those who wake all the same, as what is
shown is that the level can be finished (keys, doors, the train, water, the lift), not how well a script aims.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from walker import Game, Walker, write_walk

HERE = Path(__file__).resolve().parent


def court_and_hall(walk: Walker) -> None:
    for x, y in ((0, -560), (0, -330), (20, -180), (0, -30), (0, 100)):
        walk.to(x, y)
    walk.to(-220, 192)
    walk.mark("walk_hall")


def furnace(walk: Walker) -> None:
    walk.to(-460, 192)
    walk.to(-700, 200)
    ride(walk)
    walk.to(-1328, 212, near=24)
    walk.mark("walk_silver")
    walk.to(-1298, 400)
    walk.to(-1370, 484)
    walk.push(180)
    walk.to(-1300, 486)
    walk.to(-1000, 486)
    walk.to(-745, 486)
    walk.to(-745, 220)
    walk.to(-620, 192)
    walk.to(-220, 192)


def ride(walk: Walker) -> None:
    """Waits until the train stands at the near ledge, steps on, and off at the far one."""
    for _ in range(9):
        if train_at(walk, "near"):
            break
        walk.stand(40)
    walk.to(-824, 208)
    for _ in range(9):
        if train_at(walk, "far"):
            break
        walk.stand(40)
    walk.to(-1300, 212)


def train_at(walk: Walker, end: str) -> bool:
    text = walk.state().text
    for block in text.split("\nedict "):
        if '"classname" "train"' in block:
            mins = next(line for line in block.splitlines() if line.startswith('"absmin"'))
            x = float(mins.split('"')[3].split()[0])
            return abs(x - (-873 if end == "near" else -1257)) < 3
    raise RuntimeError("there is no train")


def chapel(walk: Walker) -> None:
    walk.to(0, 270)
    walk.to(0, 520)
    walk.to(0, 735)
    walk.stand(60)
    walk.mark("walk_silver_door")
    walk.to(0, 1000)
    walk.to(0, 1095)
    walk.to(30, 1150)
    walk.to(30, 1205)
    walk.to(22, 1272)
    walk.to(140, 1276)


def well(walk: Walker) -> None:
    walk.to(128, 1250, near=12)  # clear of the knight and of the crystals at the corner
    walk.to(204, 1256, near=20)
    walk.to(208, 1344, near=30)
    walk.hold("movedown", 40)
    walk.turn(0)
    walk.mark("walk_under_water")


def water(walk: Walker) -> None:
    swim(walk, 656, 1344)
    swim(walk, 656, 830)
    walk.hold("moveup", 60)
    swim(walk, 808, 830)
    swim(walk, 808, 690)
    walk.lines.append("+moveup")
    swim(walk, 904, 690)
    walk.to(904, 556, near=20, tries=8, speed=140)
    walk.lines.append("-moveup")
    walk.stand(10)
    walk.mark("walk_gold")


def swim(walk: Walker, x: float, y: float) -> None:
    walk.to(x, y, near=24, tries=8, speed=140)


def out_of_the_water(walk: Walker) -> None:
    swim(walk, 904, 690)
    swim(walk, 808, 690)
    walk.lines.append("+moveup")
    swim(walk, 592, 690)
    walk.lines.append("-moveup")
    walk.to(576, 600, near=20, tries=8)
    walk.to(572, 400)
    walk.to(576, 322)
    walk.push(180)
    walk.stand(40)
    walk.to(590, 240)
    walk.to(420, 240)
    walk.mark("walk_cistern_door")


def lift_and_out(walk: Walker) -> None:
    walk.to(0, 260)
    walk.to(0, 545)
    walk.to(300, 545)
    walk.to(392, 524)
    walk.stand(50)
    walk.mark("walk_lift")
    walk.to(392, 706)
    walk.to(0, 706, near=30)
    walk.to(-428, 690, near=24)
    walk.stand(40)
    walk.mark("walk_gold_door")
    walk.to(-620, 680)
    walk.to(-832, 800)
    walk.to(-832, 1060)
    walk.mark("walk_tower")
    walk.turn(90)
    walk.hold("forward", 40)
    walk.stand(140)
    for _ in range(2):  # ends the tally, and then the text of the rune
        walk.hold("attack", 2)
        walk.stand(40)
    walk.mark("walk_exit")


LEGS = (court_and_hall, furnace, chapel, well, water, out_of_the_water, lift_and_out)


def main() -> int:
    if len(sys.argv) not in (3, 4):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    user = Path(sys.argv[3]) if len(sys.argv) == 4 else Path(tempfile.mkdtemp())
    walk = Walker(Game(Path(sys.argv[1]), Path(sys.argv[2]), user, "fb1"), first=("notarget", "god"))
    header = "A player on the way through fb1. Written by walk_fb1.py; -headless -seed 1 +skill 0 +host_framerate 0.05 +map fb1 +exec this."
    return write_walk(walk, LEGS, HERE / "walk_fb1.cfg", header)


if __name__ == "__main__":
    sys.exit(main())
