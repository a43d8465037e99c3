"""The menus' pictures, `gfx/*.lmp`: titles, lists, boxes, the plaque. Whole pages are in pages.py."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.letters import Pen, text_distance, text_width
from art.palette import RAMPS, gradient
from art.picture import Picture

TITLE = "6a3416 a8682c e0b060 fff0c8"
ENTRY = "4a6a66 8cb4a8 cfe8da f6f6f4"
DIM = "24282e 3c424a 565e68 727a84"
COPPER = "4a2414 7a3c22 b06a40 d89a68 f2c89c"
TEAL = "04100f 0a2220 123634 1c4a46"
BROAD = Pen(0.12, 0.04, 32.0)

# name: (width, words); all are 24 high.
_TITLES = {
    "ttl_main": (96, "Main"),
    "ttl_sgl": (168, "Single Player"),
    "ttl_cstm": (136, "Controls"),
    "p_option": (120, "Options"),
    "p_load": (72, "Load"),
    "p_save": (72, "Save"),
    "p_multi": (152, "Multiplayer"),
    "vidmodes": (152, "Video Modes"),
    "loading": (120, "Loading"),
    "pause": (104, "Paused"),
    "complete": (168, "Completed"),
    "ranking": (120, "Ranking"),
    "finale": (288, "The Light Is Yours"),
}
# name: (width, height, lines); a line every 20 pixels, as the menus' cursor steps.
_LISTS = {
    "mainmenu": (240, 112, ["Single Player", "Multiplayer", "Options", "Help", "Quit"]),
    "sp_menu": (232, 64, ["New Game", "Load", "Save"]),
    "mp_menu": (232, 64, ["Join a Game", "New Game", "Setup"]),
}
_NETS = {"1": (96, "Modem"), "2": (188, "Direct Connect"), "3": (264, "IPX"), "4": (264, "TCP/IP"), "5": (192, "Multi")}
_DIM = {"modm": "1", "drct": "2", "ipx": "3", "tcp": "4", "mult": "5"}


def titles() -> dict[str, np.ndarray]:
    """Headings of menus and of the screens between levels."""
    out = {}
    for name, (width, words) in _TITLES.items():
        picture = Picture(width, 24)
        picture.text_fit(words, TITLE, 3.0, centre=True, pen=BROAD)
        out[name] = picture.indices()
    return out


def lists() -> dict[str, np.ndarray]:
    """Menus' entries, and those of the network's menu, live and dim."""
    out = {}
    for name, (width, height, lines) in _LISTS.items():
        picture = Picture(width, height)
        for i, words in enumerate(lines):
            picture.text(words, 3.0, 20.0 * i + 2.5, 14.5, ENTRY)
        out[name] = picture.indices()
    for number, (width, words) in _NETS.items():
        for prefix, ramp in (("netmen", ENTRY), ("dim_", DIM)):
            key = f"netmen{number}" if prefix == "netmen" else f"dim_{[k for k, v in _DIM.items() if v == number][0]}"
            picture = Picture(width, 19 if number == "5" else 20)
            picture.text(words, 3.0, 2.5, 14.0, ramp)
            out[key] = picture.indices()
    inter = Picture(160, 144)
    for words, top in (("Time", 10.0), ("Secrets", 50.0), ("Monsters", 90.0)):
        inter.text(words, 8.0, top, 17.0, TITLE, BROAD)
    out["inter"] = inter.indices()
    return out


def dots() -> dict[str, np.ndarray]:
    """The menus' cursor, menudot1 to 6: a lamp whose flame leans."""
    out = {}
    for frame in range(6):
        picture = Picture(16, 24)
        x, y = picture.x, picture.y
        lean = 1.3 * np.sin(2 * np.pi * frame / 6)
        tall = 1.2 * np.cos(4 * np.pi * frame / 6)
        bend = x - 8 - lean * np.clip((15 - y) / 10, 0, 1.4) ** 2
        flame = shapes.union(
            shapes.circle(bend, y, 0, 12.6, 4.0), shapes.polygon(bend, y, [(0, 2.2 - tall), (3.4, 10.6), (-3.4, 10.6)])
        )
        picture.lay(picture.mask(flame - 0.9), "5a1808")
        heat = np.clip(-flame / 3.6 + 0.18 * np.clip((y - 6) / 8, 0, 1), 0, 1)
        picture.lay(picture.mask(flame), gradient("c43c05 f26a0c ff9a24 ffc64e ffe894 ffffff", heat, linear=True))
        picture.fill(np.maximum(shapes.ellipse(x, y, 8, 15.0, 6.2, 5.0), 15.4 - y), COPPER, 2.0, 0.5, 0.5)
        picture.fill(
            shapes.union(shapes.box(x, y, 7, 19, 9, 21.4), shapes.box(x, y, 4, 21, 12, 23, 0.9)), COPPER, 1.0, 0.45, 0.4, None
        )
        out[f"menudot{frame + 1}"] = picture.indices()
    return out


def qplaque() -> np.ndarray:
    """The plaque at the menus' left, 32x144: the name upwards on slate in a copper frame."""
    p = Picture(32, 144, 5)
    p.lay(np.ones(p.x.shape), gradient(TEAL, 0.5 + 0.25 * p.noise(16, 1), linear=True))
    rim = shapes.box(p.x, p.y, 0.6, 0.6, 31.4, 143.4, 3.0)
    p.erase(1.0 - p.mask(rim - 0.6))
    p.fill(np.abs(rim + 2.0) - 1.8, COPPER, 1.4, 0.5, 0.45)
    for y in (7.0, 137.0):
        p.fill(shapes.star(p.x, p.y, 16, y, 8, 4.2, 2.4), "8a5a18 dcb04c fff0a0", 1.6, 0.55, 0.4)
    high = 117.0 / text_width("Fullbright", 1.0, 0.16)
    letters = text_distance(
        np.ascontiguousarray(144.0 - p.y.T),
        np.ascontiguousarray(p.x.T),
        "Fullbright",
        13.0,
        16.0 - 0.5 * high,
        high,
        BROAD,
        0.16,
    ).T
    p.lay(p.mask(letters - 2.6) * 0.45, "8c3a08")
    p.lay(p.mask(letters - 1.2), "1c0a04")
    p.lay(p.mask(letters), gradient("ffffff ffe894 ffb43c e87818", np.clip((p.x - 9.0) / 15.0, 0, 1), linear=True))
    return p.indices()


def boxes() -> dict[str, np.ndarray]:
    """Pieces of text boxes (8x8 corners and sides, 16x8 middles) and the big box round the player's figure."""
    whole = Picture(48, 24, 6)
    whole.lay(np.ones(whole.x.shape), gradient(TEAL, 0.45 + 0.16 * whole.noise(16, 1, 2), linear=True))
    rim = shapes.box(whole.x, whole.y, 1, 1, 47, 23, 3.0)
    whole.erase(1.0 - whole.mask(rim - 0.6))
    whole.fill(np.abs(rim + 1.6) - 1.2, COPPER, 1.2, 0.5, 0.45)
    sheet = whole.indices()
    out = {
        "box_tl": sheet[:8, :8],
        "box_ml": sheet[8:16, :8],
        "box_bl": sheet[16:, :8],
        "box_tm": sheet[:8, 16:32],
        "box_mm": sheet[8:16, 16:32],
        "box_mm2": sheet[8:16, 16:32],
        "box_bm": sheet[16:, 16:32],
        "box_tr": sheet[:8, 40:],
        "box_mr": sheet[8:16, 40:],
        "box_br": sheet[16:, 40:],
    }
    big = Picture(72, 72, 7)
    big.lay(
        np.ones(big.x.shape),
        gradient(TEAL, 0.5 + 0.25 * big.noise(24, 1) - 0.3 * np.hypot(big.x - 36, big.y - 36) / 50, linear=True),
    )
    frame = shapes.box(big.x, big.y, 0.6, 0.6, 71.4, 71.4, 4.0)
    big.erase(1.0 - big.mask(frame - 0.6))
    big.fill(np.abs(frame + 2.4) - 2.0, COPPER, 1.8, 0.5, 0.45)
    for cx in (6.5, 65.5):
        for cy in (6.5, 65.5):
            big.fill(shapes.circle(big.x, big.y, cx, cy, 2.4), "8a5a18 dcb04c fff0a0", 1.8, 0.5, 0.5)
    return out | {"bigbox": big.indices()}


def menuplyr() -> np.ndarray:
    """The player for choosing colours, 48x56: what is brown takes the shirt's colour, what is ember the trousers'."""
    p = Picture(48, 56)
    x, y = p.x, p.y
    side = np.abs(x - 24)
    shirt, trousers = "130b07 3a2316 6b432a 9a6a44 cfa476", "150502 4e1608 98350c d8711c f6b23a"
    p.fill(shapes.union(shapes.box(side, y, 1.6, 34, 7.0, 51, 2.0)), trousers, 3.0, 0.5, 0.5)
    p.fill(shapes.box(side, y, 1.2, 49, 8.0, 54.6, 2.0), "14171b 2e343b 565e68", 1.6, 0.5, 0.5)
    p.fill(shapes.polygon(side, y, [(-1, 17), (5, 17), (9.6, 19.4), (9.0, 36), (10.4, 41), (-1, 42)]), shirt, 4.0, 0.5, 0.5)
    p.fill(shapes.segment(side, y, 9.6, 21.5, 12.6, 30.0, 2.9), shirt, 2.6, 0.5, 0.5)
    p.fill(shapes.segment(side, y, 12.6, 30.5, 9.0, 34.0, 2.2), "573a2b c89f80 f3d9bd", 2.0, 0.45, 0.5)
    p.fill(shapes.box(x, y, 10.5, 30.5, 40, 33.4, 0.8), "1c1e22 50565e 9aa2aa", 1.4, 0.5, 0.4)
    p.fill(shapes.box(x, y, 12, 32.4, 20, 36.0, 1.2), "3a2a10 a8782c ffe68c", 1.4, 0.5, 0.4)
    p.fill(shapes.box(x, y, 14.8, 37.4, 33.2, 39.8, 0.6), "2a160c 5a3a22 8a6038", 1.0, 0.5, 0.4)
    p.fill(
        shapes.union(
            shapes.ellipse(x, y, 24, 10.6, 7.4, 8.8), shapes.polygon(side, y, [(0, 14), (6, 14), (8.6, 20), (-1, 21)])
        ),
        shirt,
        3.0,
        0.55,
        0.5,
    )
    p.lay(p.mask(shapes.ellipse(x, y, 24, 11.6, 4.9, 6.6)), "120a06")
    p.fill(shapes.ellipse(x, y, 24, 12.2, 4.2, 5.6), "573a2b c89f80 f3d9bd", 3.0, 0.5, 0.5, None)
    p.lay(p.mask(np.maximum(shapes.ellipse(x, y, 24, 6.6, 5.0, 3.2), shapes.ellipse(x, y, 24, 12.2, 4.3, 5.7))) * 0.8, "120a06")
    p.lay(p.mask(shapes.ellipse(side, y, 2.0, 12.0, 0.9, 0.6)), "16100e")
    p.lay(p.mask(np.maximum(np.abs(y - 15.6) - 0.3, side - 1.5)), "5a2420")
    p.lay(p.mask(shapes.star(x, y, 24, 8.6, 4, 1.6, 0.6)), "ffc64e")
    return p.indices(sorted(set(range(224)) - set(RAMPS["ochre"])))


def menu_pictures() -> dict[str, np.ndarray]:
    """All of this module's, by name."""
    return titles() | lists() | dots() | boxes() | {"qplaque": qplaque(), "menuplyr": menuplyr()}
