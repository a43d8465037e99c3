"""The base game's 256 colours: our own, in the places that Quake's conventions give them.

A row is a ramp of 16. Rows 0-7 run from dark to light, 8-13 from light to dark; 224-254 glow, 255 is the hole of
pictures and of textures whose name begins with `{`. A row is drawn through a few chosen colours in OKLab (Ottosson
2020), so that its steps look alike and its darks keep their hue. What glows warmly has a black body's hue at every step.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from art.blackbody import light_of, xyz_of_heat

GLOW_FIRST, GLOW_LAST, TRANSPARENT = 224, 254, 255
LAMP = 2800.0  # kelvin, of the base game's warm lamps and candles


def hex_to_srgb(text: str) -> np.ndarray:
    """`rrggbb` as (3,) sRGB, 0..1."""
    return np.array([int(text[i : i + 2], 16) for i in (0, 2, 4)], float) / 255.0


def linear_from_srgb(rgb: np.ndarray) -> np.ndarray:
    """Encoded values 0..1 to linear light 0..1."""
    rgb = np.clip(np.asarray(rgb, float), 0.0, 1.0)
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def srgb_from_linear(light: np.ndarray) -> np.ndarray:
    """Linear light 0..1 to encoded values 0..1."""
    light = np.clip(np.asarray(light, float), 0.0, 1.0)
    return np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)


def heat(temperature: float, level: float = 1.0) -> str:
    """`rrggbb` of a black body of so many kelvin whose greatest channel is `level` in linear light."""
    light = level * light_of(xyz_of_heat(temperature))
    return "".join(f"{round(255.0 * channel):02x}" for channel in srgb_from_linear(light).tolist())


_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def oklab_from_srgb(rgb: np.ndarray) -> np.ndarray:
    """sRGB (..., 3), 0..1, to OKLab (..., 3): lightness 0..1, then green-red and blue-yellow."""
    return np.cbrt(linear_from_srgb(rgb) @ _LMS.T) @ _LAB.T


def srgb_from_oklab(lab: np.ndarray) -> np.ndarray:
    """OKLab (..., 3) to sRGB (..., 3), cut to 0..1."""
    return srgb_from_linear((np.asarray(lab, float) @ np.linalg.inv(_LAB).T) ** 3 @ np.linalg.inv(_LMS).T)


def mixed(colors: tuple[str, ...], at: np.ndarray) -> np.ndarray:
    """sRGB (..., 3) along `rrggbb` colours evenly spaced in 0..1, mixed in OKLab."""
    labs = oklab_from_srgb(np.array([hex_to_srgb(color) for color in colors]))
    places = np.linspace(0.0, 1.0, len(colors))
    return srgb_from_oklab(np.stack([np.interp(at, places, labs[:, i]) for i in range(3)], axis=-1))


@cache
def _table(colors: str, linear: bool) -> np.ndarray:
    rgb = mixed(tuple(colors.split()), np.linspace(0.0, 1.0, 256))
    return linear_from_srgb(rgb) if linear else rgb


def gradient(colors: str, at: np.ndarray | float, linear: bool = False) -> np.ndarray:
    """As mixed, from a table of 256 steps: sRGB (or linear light) along colours named in one text, ends repeated outside 0..1."""
    return _table(colors, linear)[np.clip(np.nan_to_num(np.asarray(at)) * 255.0 + 0.5, 0, 255).astype(np.int32)]


# sRGB colours along each row, from its first index to its last.
_ROWS: list[tuple[str, list[str]]] = [
    ("grey", ["000000", "1d1d1f", "48494c", "7b7c80", "b4b5b8", "f6f6f4"]),
    ("brown", ["130b07", "3a2316", "6b432a", "9a6a44", "cfa476"]),
    ("slate", ["0b0e14", "242c38", "46546a", "738299", "b9c7d8"]),
    ("olive", ["0c0d05", "2b2f10", "525a20", "7f883a", "b6bb6c"]),
    ("red", ["120203", "3c090b", "741518", "a92726", "cf4438"]),
    ("ochre", ["140e04", "3d2a0c", "73521b", "a67d2f", "dcb95c"]),
    ("ember", ["150502", "4e1608", "98350c", "d8711c", heat(2700, 0.9), heat(3800)]),
    ("tan", ["23150f", "573a2b", "946b51", "c89f80", "f3d9bd"]),
    ("mauve", ["d9bfe0", "9f7bb0", "643f7b", "33193f", "120817"]),
    ("coral", ["ffc4b2", "e98a7c", "b65452", "702a32", "330f17", "160609"]),
    ("sand", ["f6ecd2", "cfbf9a", "998866", "5d4f38", "2a2217", "120d08"]),
    ("verdigris", ["c4ead8", "82c0a9", "4a8f7c", "265d52", "10332f", "05120f"]),
    ("yellow", ["ffe88a", "e6b53c", "b07a1c", "6f410f", "341a08", "140803"]),
    ("blue", ["7cc4ff", "3a86e0", "1a56a8", "103668", "081a34", "02050c"]),
]
# Three steps each: what cools, a flame's body, a lamp (index 236) and the hottest of a fire.
FIRE = " ".join(["3a0a02", "8b2203", "d64e08", heat(1950), heat(LAMP), heat(4200)])
_GOLDS = [heat(2100, 0.43), heat(2300, 0.58), heat(2500, 0.79), heat(3000)]
_PALE_YELLOWS = [heat(4400), heat(5400)]
_LAST = [
    *_GOLDS,
    *"5fb8ff 9fdcff dff8ff 5a040c 8c0a14 bf1420 e8262a ff4a40".split(),
    *_PALE_YELLOWS,
    *"ffffff 7d5a52".split(),
]


def _palette() -> np.ndarray:
    rows = [mixed(tuple(colors), np.linspace(0.0, 1.0, 16)) for _, colors in _ROWS]
    rows.append(mixed(tuple(FIRE.split()), np.linspace(0.0, 1.0, 16)))
    rows.append(np.array([hex_to_srgb(color) for color in _LAST]))
    return np.round(np.concatenate(rows) * 255.0).astype(np.uint8)


PALETTE = _palette()  # (256, 3) uint8, sRGB

# Name -> indices from dark to light.
RAMPS: dict[str, list[int]] = {
    name: list(range(16 * row, 16 * row + 16)) if row < 8 else list(range(16 * row + 15, 16 * row - 1, -1))
    for row, (name, _) in enumerate(_ROWS)
}
RAMPS |= {
    "fire": list(range(224, 240)),
    "gold_glow": [240, 241, 242, 243],
    "blue_glow": [244, 245, 246],
    "red_glow": [247, 248, 249, 250, 251],
    "white_glow": [252, 253, 254],
}

_PALETTE_LAB = oklab_from_srgb(PALETTE / 255.0)
# What the eye forgives least in a flat picture is a wrong hue, so hue counts more than lightness.
_WEIGHTS = np.array([1.0, 1.6, 1.6])
BAYER = (np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) + 0.5) / 16.0 - 0.5


def nearest(rgb: np.ndarray, glow: bool = False, dither: float = 0.0, among: list[int] | None = None) -> np.ndarray:
    """Indices (...) uint8 of the colours nearest to `rgb` (..., 3), sRGB 0..1.

    Without `glow` none of 224-254, with it none but those; `among` names the only indices allowed instead. `dither` is
    the height of a 4x4 ordered pattern in OKLab lightness (0.02 is half a step of a row); it needs a picture (h, w, 3).
    """
    chosen = np.array(among if among is not None else range(224, 255) if glow else range(224))
    lab = oklab_from_srgb(rgb)
    if dither:
        height, width = lab.shape[:2]
        lab[..., 0] += dither * np.tile(BAYER, (-(-height // 4), -(-width // 4)))[:height, :width]
    flat = (lab.reshape(-1, 3) * _WEIGHTS).astype(np.float32)
    colors = (_PALETTE_LAB[chosen] * _WEIGHTS).astype(np.float32)
    distance = (colors**2).sum(axis=1) - 2.0 * flat @ colors.T
    return chosen[distance.argmin(axis=1)].astype(np.uint8).reshape(lab.shape[:-1])


def colormap() -> np.ndarray:
    """The software renderer's table (64, 256) uint8: row 0 is twice as bright, row 32 as painted, row 63 nearly black."""
    light = linear_from_srgb(PALETTE / 255.0)
    table = np.empty((64, 256), np.uint8)
    for row in range(64):
        table[row] = nearest(srgb_from_linear(light * ((64 - row) / 32.0) ** 1.6))
    table[32] = np.arange(256)
    table[:, GLOW_FIRST:] = np.arange(GLOW_FIRST, 256)
    return table
