"""Whole screens, 320x200: the console's background and the six pages of help."""

from __future__ import annotations

from functools import cache

import numpy as np

from art import shapes
from art.font import conchars
from art.hud import ammo, armour, items, weapons
from art.letters import Pen, text_distance, text_width
from art.palette import gradient
from art.picture import Picture

WIDTH, HEIGHT = 320, 200
_NAME = "Fullbright"


def _nave(p: Picture) -> None:
    """A drowned nave: pillars step back to a lit window, water below mirrors it."""
    horizon = 138.0
    y = np.where(
        p.y > horizon, 2 * horizon - p.y + 1.6 * np.sin(p.y * 1.3 + 5 * p.noise((60, 6), 3)) * (p.y - horizon) / 20, p.y
    )
    x = np.where(p.y > horizon, p.x + 2.2 * p.noise((24, 3), 4) * (p.y - horizon) / 30, p.x)
    mx, my = x - 160.0, y - 74.0
    glow = np.exp(-np.hypot(mx / 70, my / 58) ** 1.5)
    p.lay(
        np.ones(x.shape),
        gradient("04090c 081a1e 10383c 2a6a62 7ab89a e8e0a8", 0.06 + 0.62 * glow + 0.03 * p.noise(50, 1), linear=True),
    )
    for depth in range(5):
        scale = 1.0 + 0.62 * depth
        near = depth / 4.0
        at = 34.0 * scale
        for side in (-1, 1):
            dx = side * mx - at - 10 * scale
            wide = (4.2 + 1.3 * np.clip((y - 20) / 120, 0, 1)) * scale
            pillar = np.abs(dx) - wide
            capital = np.maximum(np.abs(dx) - wide - 2.6 * scale, np.abs(y - (66 - 19 * scale * 0.6)) - 2.0 * scale)
            lit = np.clip(0.5 - 0.5 * dx / wide, 0, 1) * (1 - 0.75 * near)
            tone = gradient("020507 0a2024 1c484c 48887c a8d0b0", 0.1 + 0.8 * lit * (1 - 0.5 * near), linear=True)
            p.lay(p.mask(np.minimum(pillar, capital)), tone)
        rib = np.abs(np.hypot(mx, (y - (70 - 8 * scale)) * 0.9) - (at + 10 * scale)) - 2.6 * scale
        p.lay(p.mask(np.maximum(rib, y - (72 - 10 * scale))), gradient("020507 0a2024 1e4a4a", 0.7 - 0.6 * near, linear=True))
    arch = np.maximum(np.hypot(mx - 22, my - 2) - 46, np.hypot(mx + 22, my - 2) - 46)
    window = np.where(y < 76, arch, np.abs(mx) - 24)
    window = np.maximum(window, y - 128)
    lead = np.minimum(5.3 - np.abs((mx + 6) % 12 - 6), np.abs((y + 2) % 14 - 7) * -1 + 6.3)
    star = shapes.star(mx, my, 0, 0, 12, 16, 9)
    heat = np.clip(0.75 - np.hypot(mx / 60, (my - 6) / 70), 0, 1) + 0.25 * (star < 0)
    light = gradient("8c2a08 e87818 ffb43c ffe08a fff8d8", heat, linear=True)
    p.lay(p.mask(np.maximum(window, -lead * 0.8)), light)
    p.lay(p.mask(np.abs(window) - 1.2), "0a1416")
    p.lay(p.mask(np.abs(star) - 0.5), "3a1808")
    water = (p.y > horizon).astype(float)
    ripple = 0.5 + 0.5 * np.sin(p.y * 2.1 + 7.0 * p.noise((30, 5), 5))
    p.lay(0.42 * water * (0.6 + 0.4 * ripple), "06262a")
    sparkle = smooth(p.noise((10, 1.6), 6)) * water * np.exp(-(((p.x - 160) / 46) ** 2))
    p.lay(0.8 * sparkle, "ffe0a0")


def smooth(t: np.ndarray) -> np.ndarray:
    """Only the peaks of noise, 0..1."""
    return np.clip((t - 0.55) * 4.0, 0.0, 1.0)


def conback() -> np.ndarray:
    """The console's background: the nave, darker towards the top where text runs, and the name."""
    p = Picture(WIDTH, HEIGHT, 8, oversampling=2)
    _nave(p)
    p.color *= 0.5
    high = 25.0
    left = 0.5 * (WIDTH - text_width(_NAME, high, 0.2))
    letters = text_distance(p.x, p.y, _NAME, left, 156.0, high, Pen(0.12, 0.04, 32.0), 0.2, reach=1.2)
    halo = np.exp(-np.clip(letters, 0, None) / 5.0)
    p.color += halo[..., None] * np.array([0.30, 0.12, 0.03])
    p.lay(p.mask(letters - 1.1), "1a0a04")
    p.lay(p.mask(letters), gradient("e87818 ffc64e fff4cc", 1.0 - (p.y - 156.0) / high, linear=True))
    return p.indices(list(range(1, 224)), dither=0.02)


def _write(page: np.ndarray, words: str, x: int, y: int, gold: bool = False) -> None:
    """A line in the console's letter."""
    if x + 8 * len(words) > WIDTH - 12:
        raise ValueError(f"too long for a page: {words}")
    sheet = conchars()
    for letter in words:
        code = ord(letter) + (128 if gold else 0)
        cell = sheet[8 * (code // 16) : 8 * (code // 16) + 8, 8 * (code % 16) : 8 * (code % 16) + 8]
        part = page[y : y + 8, x : x + 8]
        np.copyto(part, cell, where=cell != 0)
        x += 8


def _put(page: np.ndarray, picture: np.ndarray, x: int, y: int) -> None:
    part = page[y : y + picture.shape[0], x : x + picture.shape[1]]
    np.copyto(part, picture, where=picture != 255)


@cache
def _ground() -> np.ndarray:
    """A page's ground: slate in a copper frame."""
    p = Picture(WIDTH, HEIGHT, 10, oversampling=2)
    fade = np.hypot((p.x - 160) / 190, (p.y - 100) / 130)
    p.lay(np.ones(p.x.shape), gradient("03090b 0a1c20 123236", 0.95 - 0.75 * fade + 0.08 * p.noise((40, 30), 1), linear=True))
    rim = shapes.box(p.x, p.y, 3, 3, 317, 197, 5.0)
    p.fill(np.abs(rim) - 1.6, "4a2414 7a3c22 b06a40 d89a68 f2c89c", 1.6, 0.5, 0.45)
    p.lay(p.mask(np.abs(rim + 4.0) - 0.4), "7a3c22")
    return p.indices(list(range(1, 224)), dither=0.02)


def _page(title: str) -> np.ndarray:
    """A page with its title."""
    page, p, high = _ground().copy(), Picture(WIDTH, 28), 16.0
    p.text(title, 0.5 * (WIDTH - text_width(title, high)), 6.0, high, "6a3416 a8682c e0b060 fff0c8", Pen(0.12, 0.04, 32.0))
    _put(page, p.indices(), 0, 5)
    return page


_STORY = [
    "",
    "The sea took the monastery of lamps",
    "and the works that cast its bells,",
    "and stranger things.",
    "",
    "Its furnaces burn again under water,",
    "and no monk tends them. Down by the",
    "hub's gate lie four more, to fire,",
    "water, glass and machine. Each keeps",
    "a rune.",
    "",
    "Four runes unseal what waits below:",
    "only who steps into it ends it.",
]
_KEYS = [
    ("W S or arrows", "forward, back"),
    ("A D", "step aside"),
    ("mouse", "look"),
    ("left button", "fire"),
    ("space", "jump, swim up"),
    ("shift", "run, or walk"),
    ("1 to 8, wheel", "weapons"),
    ("tab", "score"),
    ("F6, F9", "save, load quickly"),
    ("~", "console"),
    ("escape", "menu"),
]
_WEAPONS = [
    ("shotgun", "Shotgun: steady, tight"),
    ("sshotgun", "Double shotgun: be near"),
    ("nailgun", "Nailgun: a stream of nails"),
    ("snailgun", "Heavy nailgun: more of them"),
    ("rlaunch", "Grenades: roll, wait, burst"),
    ("srlaunch", "Rockets: mind the walls"),
    ("lightng", "Lightning: not under water!"),
]
_ITEMS = [
    ("sb_armor1", "Green armour, to 100"),
    ("sb_armor2", "Yellow armour, to 150"),
    ("sb_armor3", "Red armour, to 200"),
    ("sb_quad", "Four times the damage"),
    ("sb_invuln", "Nothing hurts"),
    ("sb_invis", "Hard to see"),
    ("sb_suit", "Breathe, wade in slime"),
    ("sb_key1", "Silver key: the moon"),
    ("sb_key2", "Gold key: the sun"),
]
_HINTS = [
    "",
    "What glows gives light. Dark places",
    "have a lamp that waits to be lit.",
    "",
    "A wall that differs may open: shoot",
    "it, press it, walk into it.",
    "",
    "Slime burns slowly, slag at once.",
    "You can hold your breath for twelve",
    "seconds.",
    "",
    "Monsters that hit one another forget",
    "you for a while.",
]
_CREDITS = [
    "",
    "Fullbright is free software under",
    "the GNU General Public License,",
    "version 2 or later. Its base game is",
    "made by programs: every texture,",
    "letter, sound and wall.",
    "",
    "It plays Quake's levels and mods,",
    "with every light path-traced.",
    "",
    "Quake is by id Software, whose",
    "released source made this possible.",
]


def _lines(page: np.ndarray, lines: list[str]) -> np.ndarray:
    for i, words in enumerate(lines):
        _write(page, words, 20, 34 + 12 * i)
    return page


def help_pages() -> dict[str, np.ndarray]:
    """help0 to help5."""
    out = {"help0": _lines(_page(_NAME), _STORY)}
    page = _page("Controls")
    for i, (key, what) in enumerate(_KEYS):
        _write(page, key, 20, 42 + 13 * i, gold=True)
        _write(page, what, 152, 42 + 13 * i)
    out["help1"] = page
    page, pictures = _page("Weapons"), weapons()
    for i, (name, what) in enumerate(_WEAPONS):
        picture = pictures[f"inv2_{name}"]
        _put(page, picture, 44 - picture.shape[1] // 2, 38 + 21 * i)
        _write(page, what, 76, 42 + 21 * i)
    out["help2"] = page
    page, pictures = _page("Things"), items() | armour() | ammo()
    for i, (name, what) in enumerate(_ITEMS):
        picture = pictures[name]
        _put(page, picture, 40 - picture.shape[1] // 2, 43 + 17 * i - picture.shape[0] // 2)
        _write(page, what, 76, 40 + 17 * i)
    out["help3"] = page
    out["help4"] = _lines(_page("Advice"), _HINTS)
    out["help5"] = _lines(_page("Thanks"), _CREDITS)
    return out


def page_pictures() -> dict[str, np.ndarray]:
    """All of this module's, by name."""
    return {"conback": conback()} | help_pages()
