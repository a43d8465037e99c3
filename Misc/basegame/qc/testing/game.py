"""A game's folder for tests, and sessions in it: a player without a window, scripts, and the level's state read back.

Models, sprites and sounds are what progs.dat names, as small as their formats allow.
"""

import pathlib
import re
import struct
import subprocess

from qc.testing.level import Box, write_level

TICK = 0.05  # seconds of a session's frame


def small_model(frames: int = 150) -> bytes:
    """An alias model of one triangle."""
    header = struct.pack("<4si3f3ff3f8if", b"IDPO", 6, 1, 1, 1, 0, 0, 0, 8, 0, 0, 0, 1, 8, 8, 3, 1, frames, 0, 0, 1)
    skin = struct.pack("<i", 0) + bytes(64)
    corners = b"".join(struct.pack("<iii", 0, i % 2, i // 2) for i in range(3))
    triangle = struct.pack("<iiii", 1, 0, 1, 2)
    pose = bytes([0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0])
    frame = struct.pack("<i4B4B16s", 0, 0, 0, 0, 0, 2, 2, 0, 0, b"frame") + pose
    return header + skin + corners + triangle + frame * frames


def small_sprite(frames: int = 6) -> bytes:
    header = struct.pack("<4siifiiifi", b"IDSP", 1, 2, 4, 4, 4, frames, 0, 0)
    return header + (struct.pack("<iiiii", 0, -2, 2, 4, 4) + bytes(16)) * frames


def small_sound() -> bytes:
    samples = bytes([128]) * 64
    fmt = struct.pack("<4sIHHIIHH", b"fmt ", 16, 1, 1, 11025, 11025, 1, 8)
    data = struct.pack("<4sI", b"data", len(samples)) + samples
    return struct.pack("<4sI4s", b"RIFF", 4 + len(fmt) + len(data), b"WAVE") + fmt + data


def names_in(progs: bytes) -> list[str]:
    """What a compiled game may load: its strings that look like files."""
    words = re.findall(rb"[\w/]+\.(?:mdl|spr|wav|bsp)(?=\0)", progs)
    return sorted({word.decode("ascii") for word in words})


class Game:
    """A folder with progs.dat and everything that it names."""

    def __init__(self, folder: pathlib.Path, progs: bytes, engine: pathlib.Path):
        self.folder = folder
        self.engine = str(engine)
        self._write("progs.dat", progs)
        self._write("gfx/palette.lmp", bytes(c for i in range(256) for c in (i, i, i)))
        for name in names_in(progs):
            if name.endswith(".mdl"):
                self._write(name, small_model())
            elif name.endswith(".spr"):
                self._write(name, small_sprite())
            elif name.endswith(".wav"):
                self._write("sound/" + name, small_sound())
            elif name.startswith("maps/b_"):
                self._write(name, write_level([], []))

    def _write(self, name: str, data: bytes) -> None:
        path = self.folder / "id1" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)

    def write_map(self, name: str, entities: list[dict[str, str]], boxes: list[Box]) -> None:
        self._write(f"maps/{name}.bsp", write_level(entities, boxes))

    def play(self, script: list[str], setup: str = "", arguments: tuple[str, ...] = (), quits: bool = True) -> "Session":
        """Plays the map `test`. A line is a console command, or a number of seconds to wait, `see NAME`, which keeps the
        level's state under that name, or `at X Y Z`, which puts the player there. Without `quits` the game itself has to."""
        lines: list[str] = []
        for line in script:
            if re.fullmatch(r"[\d.]+", line):
                lines += ["wait"] * round(float(line) / TICK)
            elif line.startswith("see "):
                lines.append(f"sv_dump {line[4:]}.txt")
            elif line.startswith("at "):
                lines += [f"setpos {line[3:]}", "noclip"]  # setpos lets him float
            else:
                lines.append(line)
        self._write("script.cfg", ("\n".join([*lines, "quit" if quits else ""]) + "\n").encode("ascii"))
        self._write("setup.cfg", (setup + "\n").encode("ascii"))
        user = self.folder / "user"
        # The picture is not looked at.
        command = [self.engine, "-headless", "-size", "8x8", "-seed", "1", "-basedir", str(self.folder)]
        command += ["-userdir", str(user), *arguments, "+r_norefresh", "1"]
        command += ["+exec", "setup.cfg", "+host_framerate", str(TICK), "+host_maxfps", "1000"]
        command += ["+map", "test", "+exec", "script.cfg"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        return Session(done.stdout + done.stderr, user / "id1")


class Session:
    """What a session said, and the states that it kept."""

    def __init__(self, said: str, folder: pathlib.Path):
        self.said = said
        self._states = {path.stem: State(path.read_text(encoding="latin-1")) for path in folder.glob("*.txt")}
        for path in folder.glob("*.txt"):
            path.unlink()

    def __getitem__(self, name: str) -> "State":
        if name not in self._states:
            raise KeyError(f"no state {name}; the session said:\n{self.said}")
        return self._states[name]


class State:
    """sv_dump's text: `globals`, and each edict as a dict of texts."""

    def __init__(self, text: str):
        blocks = re.findall(r"^(globals|edict \d+).*?\n\{\n(.*?)^\}", text, re.S | re.M)
        read = {head: dict(re.findall(r'^"([^"]+)" "(.*?)"$', body, re.M)) for head, body in blocks}
        self.globals = read.pop("globals", {})
        self.edicts = {int(head.split()[1]): fields for head, fields in read.items()}
        self.time = float(self.globals.get("time", "0"))

    @property
    def player(self) -> dict[str, str]:
        return self.edicts[1]

    def number(self, name: str, edict: dict[str, str] | None = None) -> float:
        """A field of the player's, or of another; what a dump leaves out is 0."""
        return float((self.player if edict is None else edict).get(name, "0"))

    def place(self, edict: dict[str, str] | None = None) -> tuple[float, ...]:
        text = (self.player if edict is None else edict).get("origin", "0 0 0")
        return tuple(float(word) for word in text.split())

    def all(self, classname: str) -> list[dict[str, str]]:
        return [e for e in self.edicts.values() if e.get("classname") == classname]

    def one(self, **fields: str) -> dict[str, str]:
        """The only edict whose fields have these values."""
        found = [e for e in self.edicts.values() if all(e.get(k) == v for k, v in fields.items())]
        if len(found) != 1:
            raise AssertionError(f"{len(found)} edicts have {fields}")
        return found[0]
