#!/usr/bin/env python3
"""A player at the console of the window: play_console_test.py BUILD_DIR [--pictures DIR]. Pastes, completes, gives a line up,
chats, writes the console into a file, resizes the window, and quits by y; a second start knows what was typed and how large the
window was. Skipped, saying so, without Xvfb, xdotool, xclip, the base game or a Vulkan device."""
import re
import subprocess
import sys

from play_test import Player, main

SIZE = (800, 450)


def copy(text):
    """Into the clipboard, which a process of xclip's serves until the display ends."""
    subprocess.run(["xclip", "-selection", "clipboard"], input=text, text=True, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def size_of(player):
    geometry = player.tool("getwindowgeometry", "--shell", player.window)
    return tuple(int(re.search(f"^{name}=([0-9]+)$", geometry, re.M)[1]) for name in ("WIDTH", "HEIGHT"))


def by_console(build, folder, pictures):
    player = Player(build, folder, pictures, "+set", "zz_one", "11", "+set", "zz_two", "22")
    player.keys("grave")
    copy("echo \u201cpasted words\u201d\nquit\n")
    player.keys("ctrl+v", "Return")
    player.says("^Pasted the first line; 1 further was left out")
    player.says("^pasted words")
    player.type("zz")
    player.keys("Tab", "Tab", "Tab")
    player.show("40_tab")
    player.keys("Return")
    player.says('^"zz_two" is "22"')
    player.type("zz")
    player.keys("Tab", "Tab", "Tab", "shift+Tab", "Return")
    player.says('^"zz_one" is "11"')
    player.type("quit")
    player.keys("ctrl+c", "Return")
    player.type("echo one three")
    player.keys("ctrl+Left")
    player.type("two ")
    player.keys("Return")
    player.says("^one two three")
    player.type("rcon_password hush")
    player.keys("Return")
    player.type("map start")
    player.keys("Return")
    player.says("Server spawned|entered the game")
    player.frames(6)
    player.keys("t")
    player.type("heard")
    player.keys("ctrl+Left")
    copy("once ")
    player.keys("ctrl+v", "Return")
    player.says("^player: once heard")
    player.frames(4)
    player.console("condump notes")
    player.says("^Dumped console text")
    notes = (folder / "id1" / "notes.txt").read_text()
    assert notes.count("player: once heard") == 1, notes
    player.tool("windowsize", player.window, *map(str, SIZE))
    player.frames(4)
    player.console("vid_width; vid_height")
    player.says(f'^"vid_width" is "{SIZE[0]}"')
    player.says(f'^"vid_height" is "{SIZE[1]}"')
    player.keys("F10")
    player.show("41_quit")
    player.tool("key", "y")
    player.ends()
    lines = (folder / "history.txt").read_text().splitlines()
    assert "echo \"pasted words\"" in lines and lines[-1] == "vid_width; vid_height", lines
    assert not [line for line in lines if "hush" in line], lines

    player = Player(build, folder, pictures, sized=False)
    player.frames(4)
    assert size_of(player) == SIZE, size_of(player)
    player.keys("grave", *["Up"] * (len(lines) - lines.index("echo one two three")), "Return")
    player.says("^one two three")
    player.keys("Escape", "F10")
    player.tool("key", "y")
    player.ends()


if __name__ == "__main__":
    sys.exit(main(plays=[by_console], programs=("Xvfb", "xdotool", "xclip")))
