#!/usr/bin/env python3
"""A player at the window: play_test.py BUILD_DIR [--pictures DIR]. The base game is played with a real keyboard and a real
mouse (xdotool): a new game from the menu, settings, a key, saves, hurt, death and what comes after, quitting, and a second
start that has kept it all; then a new game, hurt, death, a save, loading, settings and the end by mouse alone, and with a walk by a game
controller alone (virtual_pad.cpp). It has an X server of its own, since a window that others open would take the keys. Skipped, saying so, without Xvfb, xdotool, the base game or a Vulkan device."""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from network_game_test import SKIPPED, Program

SLOW = float(os.environ.get("FULLBRIGHT_TEST_SLOWNESS", "1"))
WIDTH, HEIGHT = 640, 360
SLOT = (200, 69)  # the first row of saves
PAGE = ((WIDTH - 320) // 2, (HEIGHT - 200) // 2)  # of a page with a plaque, at scale 1


class Player:
    """The program in a window, with somebody before it."""

    def __init__(self, build, folder, pictures, *commands, pad=None, sized=True):
        game = build / "game"
        self.pictures = pictures
        if pad:
            os.environ.update(LD_PRELOAD=str(build / "libvirtual_pad.so"), FULLBRIGHT_TEST_PAD=str(pad))
        self.running = Program("the game", [build / "fullbright", "-basedir", game, "-userdir", folder, "-seed", "1", "-nolan",
                                            *(["-size", f"{WIDTH}x{HEIGHT}"] if sized else []), "+r_cpu_pixels", "4096", "+r_target_ms", "0", "+r_estimator", "pt", "+r_denoise", "0", "+host_speeds", "1", *commands])
        if pad:
            del os.environ["LD_PRELOAD"]
        self.said = 0  # lines that says() has gone past
        window = self.tool("search", "--sync", "--name", "^Fullbright$")
        self.window = window.split()[0]
        self.says("^Playing demo", 60)
        self.tool("windowfocus", "--sync", self.window)
        self.frames(4)
        self.says("^FULLBRIGHT SERVER")  # the demo's

    def tool(self, *words):
        return subprocess.run(["xdotool", *words], check=True, capture_output=True, text=True, timeout=60 * SLOW).stdout

    def frames(self, count=2):
        """Waits until so many are drawn: the second one has seen what was pressed before."""
        self.running.catch_up()
        for _ in range(count):
            self.running.wait_for(" ms, host", 60 * SLOW)

    def plays(self, seconds):
        """Lets the game go on: as long, and a few frames."""
        time.sleep(seconds)
        self.frames(3)

    def keys(self, *names):
        for name in names:
            self.tool("key", name)
            self.frames()

    def type(self, text):
        self.tool("type", "--delay", "20", "--", text)
        self.frames()

    def point(self, x, y, button=None):
        """Moves the pointer to a place of the window's contents, and clicks."""
        self.tool("mousemove", "--window", self.window, str(int(x)), str(int(y)))
        self.frames()
        if button:
            self.tool("click", str(button))
            self.frames()

    def row(self, large, small=None):
        """The middle of a page's row: of the listed ones, or of the small ones behind so many listed."""
        y = PAGE[1] + 34 + 20 * large + (10 if small is None else 4 * (large > 0) + 10 * small + 5)
        return PAGE[0] + 100, y

    def says(self, pattern, seconds=30):
        lines = self.running.lines
        for number in range(self.said, len(lines)):
            if re.search(pattern, lines[number]):
                self.said = number + 1
                return lines[number]
        self.running.wait_for(pattern, seconds * SLOW)
        self.said = len(lines)
        return lines[-1]

    def console(self, *commands):
        """Typed at the console, which is closed again; time stands meanwhile."""
        self.keys("grave")
        for text in commands:
            self.type(text)
            self.keys("Return")
        self.keys("Escape")

    def field(self, name):
        """The player's, as the server has it."""
        self.keys("grave")
        self.type("edict 1")
        self.running.catch_up()
        self.said = len(self.running.lines)  # not what was printed before
        self.tool("key", "Return")
        line = self.says(f"^{name} ")
        self.keys("Escape")
        return float(line.split()[1])

    def show(self, name):
        if self.pictures:
            subprocess.run(["import", "-silent", "-window", self.window, self.pictures / f"{name}.png"], check=True)

    def ends(self):
        status = self.running.process.wait(20 * SLOW)
        assert status == 0, f"status {status}"


def by_keyboard(build, folder, pictures):
    config = folder / "id1" / "config.cfg"
    player = Player(build, folder, pictures)
    player.show("01_start")
    player.keys("Escape")
    player.show("02_main")
    player.keys("Return")  # single player
    player.show("03_single")
    player.keys("Return")  # new game
    player.show("04_new")
    if "trigger_setskill" not in start_map(build):
        player.keys("Down", "Return")
    player.says("Server spawned|entered the game")
    player.frames(6)
    player.show("05_game")
    player.keys("Escape", "Down", "Down", "Return")  # options
    player.keys(*["Down"] * 8, "Right", "Right")  # mouse speed: 3 to 4
    player.show("06_options")
    player.keys("Up", "Up", "Up", "Up", "Up", "Up", "Up", "Up", "Return")  # keys
    player.keys("Return")
    player.show("07_capture")
    player.keys("i")
    player.show("08_keys")
    player.keys("Escape", "Down", "Down", "Down", "Return")
    player.type("volum")
    player.show("09_search")
    player.keys(*["BackSpace"] * 5)
    player.type("r_bounces")
    player.keys("Right")  # 2 to 4
    player.keys("Escape", "Escape", "Escape", "Escape", "Escape")
    player.keys("F2", "Return")  # save in the first slot
    player.says("saved as s0")
    player.keys("F2")
    player.show("10_saves")
    player.keys("Escape", "Escape", "Escape")
    die_and_go_back(player, folder / "id1")
    player.keys("F10")
    player.show("11_quit")
    player.tool("key", "Return")
    player.ends()
    text = config.read_text()
    assert 'bind "i" "+forward"' in text, text
    assert 'sensitivity "4"' in text, text
    assert 'r_bounces "4"' in text, text
    for name in ("s0", "quick", "autosave/start"):
        assert (folder / "id1" / f"{name}.sav").exists(), name
        picture = (folder / "id1" / f"{name}.png").read_bytes()
        assert picture.startswith(b"\x89PNG") and len(picture) > 1000, f"{name}.png: {len(picture)} bytes"
    assert not list(folder.rglob("*.new")), "half files"

    player = Player(build, folder, pictures)
    player.keys("F3", "Return")  # load
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    player.keys("grave")
    player.type("sensitivity")
    player.keys("Return")
    player.says('"sensitivity" is "4"')
    player.type("r_bounces")
    player.keys("Return")
    player.says('"r_bounces" is "4"')
    player.type("bind i")
    player.keys("Return")
    player.says('"i" = "\\+forward"')
    player.show("12_console")
    player.keys("Escape", "t")
    player.type("hello")
    player.show("13_message")
    player.keys("Return")
    player.says("hello")
    player.keys("F10")
    player.tool("key", "Return")
    player.ends()


def die_and_go_back(player, saves):
    """A quicksave, rockets at one's own feet until dead, the save again by a key and by F9; then the autosave."""
    assert (saves / "autosave" / "start.sav").exists(), "the level's beginning was not saved"
    player.console("impulse 9", "+lookdown")
    player.plays(1.0)
    player.keys("F6")
    player.says("saved as quick")
    whole, rockets = player.field("health"), player.field("ammo_rockets")
    player.console("impulse 7")
    player.plays(0.5)
    player.console("+attack")
    player.plays(0.3)
    player.console("-attack")
    player.plays(0.7)
    player.show("10a_hurt")
    assert player.field("health") < whole, "a rocket at one's feet hurts"
    player.console("+attack")
    player.says("stood too near to the rocket", 60)
    player.console("-attack")
    player.plays(1.0)
    player.show("10b_dead")
    assert player.field("health") <= 0
    player.tool("key", "space")  # on, which loads
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    assert player.field("health") == whole and player.field("ammo_rockets") == rockets, "the quicksave, not the level's start"
    player.show("10c_back")
    player.console("kill")  # sv_autoload is 2
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    player.keys("F9")
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    assert player.field("ammo_rockets") == rockets
    player.console("-lookdown")
    player.keys("F3")
    player.show("10d_load")
    player.keys("Escape", "Escape", "Escape")


# What a player has on buttons: everything, the rocket launcher, and, for the test to see, the player's fields and place.
ARMED, FACTS = "impulse 9; wait; impulse 7", "edict 1; viewpos"


class Fight:
    """Hurt, death and what comes after, however keys are pressed: `press(what)` of "armed", "facts" and "on", `fire(True)`."""

    def __init__(self, player, press, fire, name):
        self.player, self.press, self.fire, self.name = player, press, fire, name

    def fields(self):
        """The player's health and rockets."""
        self.player.running.catch_up()
        self.player.said = before = len(self.player.running.lines)
        self.press("facts")
        self.player.says("^Viewpos")  # behind the fields
        words = (line.split() for line in self.player.running.lines[before:])
        return {line[0]: float(line[1]) for line in words if line and line[0] in ("health", "ammo_rockets")}

    def burst(self, seconds):
        self.fire(True)
        self.player.plays(seconds)
        self.fire(False)
        self.player.plays(0.7)

    def hurt_and_die(self):
        player = self.player
        self.press("armed")
        player.plays(1.0)
        whole = self.fields()
        self.burst(0.1)
        hurt = self.fields()
        assert hurt["health"] < whole["health"] and hurt["ammo_rockets"] < whole["ammo_rockets"], f"{whole} to {hurt}: a rocket at one's feet hurts"
        player.show(f"{self.name}_hurt")
        self.fire(True)
        player.says("stood too near to the rocket", 60)
        self.fire(False)
        player.plays(1.5)
        player.show(f"{self.name}_dead")
        assert self.fields()["health"] <= 0
        self.press("on")
        player.says("^FULLBRIGHT SERVER")
        player.frames(6)
        assert self.fields()["health"] == 100, "the level's beginning again"


def by_mouse(build, folder, pictures):
    """With keys for nothing but the first look at the menu."""
    player = Player(build, folder, pictures, "+bind", "MOUSE2", ARMED, "+bind", "MOUSE3", FACTS)
    player.keys("Escape")
    player.point(*player.row(0), 1)  # single player
    player.point(*player.row(0), 1)  # new game
    if "trigger_setskill" not in start_map(build):
        player.point(*player.row(1), 1)
    player.says("Server spawned|entered the game")
    player.frames(6)
    buttons = {"armed": 3, "facts": 2, "on": 1}

    def press(what):
        player.tool("click", str(buttons[what]))
        player.frames(3)

    for _ in range(12):  # looks down
        player.tool("mousemove_relative", "--", "0", "200")
        player.frames(1)
    Fight(player, press, lambda down: player.tool("mousedown" if down else "mouseup", "1"), "22_mouse").hurt_and_die()
    player.keys("Escape")
    player.point(*player.row(0), 1)  # single player
    player.point(*player.row(2), 1)  # save
    player.point(*SLOT, 1)
    player.says("saved as s0")
    player.keys("Escape")
    player.point(*player.row(0), 1)
    player.point(*player.row(1), 1)  # load
    player.show("23_mouse_load")
    player.point(*SLOT, 1)
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    player.keys("Escape")
    player.point(*player.row(2), 1)  # options
    x, y = player.row(0, 8)  # mouse speed: the slider's end
    player.point(PAGE[0] + 184 + 71, y, 1)
    player.show("20_mouse_options")
    player.point(x, y, 3)  # the other button goes back
    player.point(*player.row(4), 1)  # quit
    player.show("21_mouse_quit")
    player.point(*player.row(0, 3))
    player.tool("click", "1")
    player.ends()
    text = (folder / "id1" / "config.cfg").read_text()
    assert 'sensitivity "11"' in text, text


A, B, START, UP, DOWN, LEFT, RIGHT = 0, 1, 6, 11, 12, 13, 14  # SDL's numbers of a controller's buttons
MOVE_Y, LOOK_X, LOOK_Y, TRIGGER = 1, 2, 3, 5  # and of its axes: sticks, the right trigger


def by_pad(build, folder, pictures):
    """Nothing else is touched."""
    pipe = folder / "pad"
    os.mkfifo(pipe)
    writing = os.open(pipe, os.O_RDWR)  # it opens before there is a reader
    player = Player(build, folder, pictures, "+bind", "LEFTARROW", "viewpos", "+bind", "RIGHTARROW", ARMED, "+bind", "UPARROW", FACTS, pad=pipe)

    def tell(line):
        os.write(writing, (line + "\n").encode())
        player.frames()

    def press(*buttons):
        for button in buttons:
            tell(f"button {button} 1")
            tell(f"button {button} 0")

    def whereabouts():
        player.running.catch_up()
        player.said = len(player.running.lines)
        press(LEFT)
        return [float(number) for number in re.findall(r"-?[0-9]+", player.says("^Viewpos"))]

    tell(f"axis {TRIGGER} -32768")
    press(START, A, A)  # single player, new game
    if "trigger_setskill" not in start_map(build):
        press(DOWN, A)
    player.says("Server spawned|entered the game")
    player.frames(6)
    before = whereabouts()
    tell(f"axis {MOVE_Y} -32768")
    player.plays(1.0)
    tell(f"axis {MOVE_Y} 0")
    walked = whereabouts()
    assert max(abs(a - b) for a, b in zip(before[:2], walked[:2])) > 20, f"{before} to {walked}: the left stick walks"
    tell(f"axis {LOOK_X} 32767")
    player.plays(0.3)
    tell(f"axis {LOOK_X} 0")
    turned = whereabouts()
    assert turned[4] != walked[4], f"{walked} to {turned}: the right stick turns"
    tell(f"axis {LOOK_Y} 32767")
    player.plays(1.5)
    tell(f"axis {LOOK_Y} 0")
    buttons = {"armed": RIGHT, "facts": UP, "on": A}
    Fight(player, lambda what: press(buttons[what]), lambda down: tell(f"axis {TRIGGER} {32767 if down else -32768}"),
          "32_pad").hurt_and_die()
    press(START, A, DOWN, DOWN, A, A)  # single player, save, the first slot
    player.says("saved as s0")
    press(START, A, UP, A)  # load, one row above where the page was left
    player.show("33_pad_load")
    press(A)
    player.says("^FULLBRIGHT SERVER")
    player.frames(6)
    press(START, DOWN, DOWN, A)  # options
    press(*[DOWN] * 8, RIGHT, RIGHT)  # mouse speed: 3 to 4
    player.show("30_pad_options")
    press(B, DOWN, DOWN, A)  # quit
    player.show("31_pad_quit")
    os.write(writing, f"button {A} 1\n".encode())
    player.ends()
    os.close(writing)
    assert 'sensitivity "4"' in (folder / "id1" / "config.cfg").read_text()


class Display:
    """An X server of the test's own while it lives."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x720x24", "-noreset"],
                                       pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            os.environ["DISPLAY"] = ":" + pipe.readline().strip()
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def start_map(build):
    return (build / "game" / "id1" / "maps" / "start.bsp").read_bytes().decode("latin-1")


def main(plays=(by_keyboard, by_mouse, by_pad), programs=("Xvfb", "xdotool")):
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--pictures", type=pathlib.Path)
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    wanting = [program for program in programs if not shutil.which(program)]
    wanting += [what for what, there in (
        ("the base game", (build / "game" / "id1" / "progs.dat").exists()),
        ("a Vulkan device", subprocess.run([build / "fullbright", "-listdevices"], capture_output=True).returncode == 0)) if not there]
    if wanting:
        print("skipped: no " + ", no ".join(wanting) + " (Linux/install-deps.sh test)")
        return SKIPPED
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    with Display():
        for play in plays:
            start = time.monotonic()
            with tempfile.TemporaryDirectory() as name:
                play(build, pathlib.Path(name), arguments.pictures)
            print(f"{play.__name__}: {time.monotonic() - start:.0f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
