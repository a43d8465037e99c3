"""Writes scripts for a player: waypoints in, console commands out.

A script is open-loop text of `wait`s, one a frame of 1/20 s. To know where it has brought the player, the walker plays what it
has so far, headless, and reads the server's dump; the next leg starts from there. As the game repeats to the last bit for
one seed, so does the script. What one play told is kept, so that a changed route is walked again only from the change on.
"""

from __future__ import annotations

import hashlib
import math
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

FRAME = 0.05  # seconds
WALK = 200.0  # units a second: cl_forwardspeed
KEY_FRAME = 0.5  # of a frame that a key counts which is pressed in it
COAST = 30.0  # units that friction lets one go on after walking
SETTINGS = ("cl_alwaysrun 0", "cl_movespeedkey 2", "cl_forwardspeed 200", "cl_upspeed 200", "lookspring 0")
UNSEEN = ("+r_norefresh", "1")  # nobody looks
ALIASES = ("alias w5 \"wait;wait;wait;wait;wait\"", "alias w20 \"w5;w5;w5;w5\"", "alias w100 \"w20;w20;w20;w20;w20\"")


@dataclass
class State:
    """What a dump says of the player and the world."""

    text: str

    def player(self, key: str, fallback: str = "") -> str:
        block = re.search(r"\nedict 1\n\{(.*?)\n\}", self.text, re.S).group(1)
        found = re.search(rf'"{key}" "([^"]*)"', block)
        return found.group(1) if found else fallback

    @property
    def origin(self) -> tuple[float, float, float]:
        return tuple(float(c) for c in self.player("origin", "0 0 0").split())

    @property
    def yaw(self) -> float:
        return float(self.player("v_angle", "0 0 0").split()[1])


@dataclass
class Game:
    """How to play: the program, the game's folder, a folder to write in, and what begins the script."""

    program: Path
    basedir: Path
    userdir: Path
    level: str
    before: list[str] = field(default_factory=lambda: ["skill 0"])

    def play(self, lines: list[str], dumps: str = "walk_state.txt") -> State:
        folder = self.userdir / "id1"
        folder.mkdir(parents=True, exist_ok=True)
        text = "\n".join([*SETTINGS, *ALIASES, *lines, f"sv_dump {dumps}", "quit"]) + "\n"
        kept = folder / f"kept_{self._sum(text)}.txt"
        if not kept.exists():
            (folder / "walk_now.cfg").write_text(text, encoding="ascii")
            (folder / dumps).unlink(missing_ok=True)
            begin = [word for line in self.before for word in f"+{line}".split()]
            subprocess.run([self.program, "-headless", "-size", "16x16", "-seed", "1", "-basedir", self.basedir, "-userdir",
                            self.userdir, *UNSEEN, "+host_framerate", str(FRAME), *begin, "+map", self.level, "+exec",
                            "walk_now.cfg"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=600)
            (folder / dumps).rename(kept)
        return State(kept.read_text(encoding="latin-1"))

    def _sum(self, text: str) -> str:
        """Of all that a play depends on."""
        files = [self.basedir / "id1" / name for name in (f"maps/{self.level}.bsp", "progs.dat")]
        sums = [hashlib.sha256(path.read_bytes()).hexdigest() for path in files if path.exists()]
        return hashlib.sha256("\n".join([*sums, text]).encode()).hexdigest()[:20]


def waits(frames: int) -> list[str]:
    result = []
    for name, count in (("w100", 100), ("w20", 20), ("w5", 5), ("wait", 1)):
        result += [name] * (frames // count)
        frames %= count
    return [";".join(result)] if result else []


class Walker:
    def __init__(self, game: Game, first: tuple[str, ...] = ()):
        self.game, self.lines = game, [*waits(4), *first]  # nobody is there to obey before
        self.stand(10)

    # What a player does.

    def say(self, line: str) -> None:
        self.lines.append(line)

    def stand(self, frames: int) -> None:
        self.lines += waits(frames)

    def hold(self, key: str, frames: int) -> None:
        self.lines += [f"+{key}", *waits(frames), f"-{key}", "wait"]

    def turn(self, yaw: float) -> None:
        """To a yaw in degrees, in one frame."""
        by = (yaw - self.state().yaw + 180.0) % 360.0 - 180.0
        if abs(by) > 0.05:
            self.lines += [f"cl_yawspeed {abs(by) / (FRAME * KEY_FRAME):.3f}", "+left" if by > 0 else "+right", "wait",
                           "-left" if by > 0 else "-right", "wait"]

    def pitch(self, degrees: float) -> None:
        """Looks down by so much (up where it is negative) from where it looks now."""
        self.lines += [f"cl_pitchspeed {abs(degrees) / (FRAME * KEY_FRAME):.3f}",
                       "+lookdown" if degrees > 0 else "+lookup", "wait", "-lookdown" if degrees > 0 else "-lookup", "wait"]

    def to(self, x: float, y: float, near: float = 24.0, tries: int = 4, speed: float = WALK) -> "State":
        """Walks straight to a point and stands there; again if it fell short. Raises where it gets nowhere."""
        for _ in range(tries):
            here = self.state().origin
            distance = math.hypot(x - here[0], y - here[1])
            if distance <= near:
                return self.state()
            self.turn(math.degrees(math.atan2(y - here[1], x - here[0])))
            self.hold("forward", max(1, round((distance - COAST + 6.0) / (speed * FRAME))))
            self.stand(8)
        here = self.state().origin
        if math.hypot(x - here[0], y - here[1]) > near:
            raise RuntimeError(f"the way to {x:g} {y:g} ends at {here[0]:.0f} {here[1]:.0f} {here[2]:.0f}")
        return self.state()

    def push(self, yaw: float, frames: int = 12) -> None:
        """Against what is there: buttons."""
        self.turn(yaw)
        self.hold("forward", frames)
        self.stand(8)

    def mark(self, name: str) -> None:
        """Where the script writes the state down for a test."""
        self.say(f"sv_dump {name}.txt")

    def state(self) -> State:
        return self.game.play(self.lines)

    def text(self, header: str) -> str:
        return "\n".join([f"// {line}" for line in header.splitlines()] + [*SETTINGS, *ALIASES, *self.lines]) + "\n"


def write_walk(walk: Walker, legs, target: Path, header: str) -> int:
    """Walks the legs and writes the script; where one fails, the script ends before it. The exit status."""
    status = 0
    for leg in legs:
        before = list(walk.lines)
        try:
            leg(walk)
        except RuntimeError as error:
            print(f"{target.stem}: {leg.__name__}: {error}", file=sys.stderr)
            walk.lines, status = before, 1
            break
        print(f"{target.stem}: {leg.__name__}: at {walk.state().origin}, {len(walk.lines)} lines", flush=True)
    target.write_text(walk.text(header) + "quit\n", encoding="ascii")
    return status
