"""The player's face in the status bar, 24x24: a smith of the monastery in her hood, in five states of health."""

from __future__ import annotations

import numpy as np

from art import shapes
from art.palette import gradient, srgb_from_linear
from art.picture import Picture

# Skin from well to nearly dead: dark, middle, light.
_SKIN = ["6a3c28 c48a62 f0c49c", "683c28 be845e e8ba94", "603a2c b07c60 dab09a", "58403a a0786c ccaaa0", "4a4444 8a7a78 b8a8a4"]
_HOOD = "10201f 24524c 4a8f7c 82c0a9"
_BLOOD = "9c1a1c"


def _face(health: int, pain: bool) -> Picture:
    """`health` 1 (well) to 5 (nearly dead)."""
    p = Picture(24, 24, 40 + health)
    x, y = p.x, p.y + (0.8 if pain else 0.0)
    side = np.abs(x - 12)
    p.lay(np.ones(x.shape), gradient("1a1e24 2e353d", 1.0 - p.y / 24, linear=True))
    hood = shapes.union(
        shapes.ellipse(x, y, 12, 11.5, 10.4, 11.2), shapes.polygon(side, y, [(0, 14), (9.5, 16), (12.5, 25), (-2, 25)])
    )
    p.fill(hood, _HOOD, 4.0, 0.5, 0.5)
    opening = shapes.ellipse(x, y, 12, 12.6, 7.2, 9.4)
    p.lay(p.mask(opening - 0.8), "0a1413")
    skin = _SKIN[health - 1]
    face = shapes.union(shapes.ellipse(x, y, 12, 11.6, 6.2, 7.4), shapes.ellipse(x, y, 12, 15.6, 4.6, 5.2))
    p.fill(face, skin, 4.5, 0.62, 0.5, None)
    p.lay(p.mask(np.maximum(shapes.ellipse(x, y, 12, 4.4, 7.0, 4.4), face)) * 0.9, "0f1c1b")
    _features(p, x, y, side, health, pain, skin.split())
    _wounds(p, x, y, health, face)
    return p


def _features(p: Picture, x: np.ndarray, y: np.ndarray, side: np.ndarray, health: int, pain: bool, skin: list[str]) -> None:
    brow = 9.2 + (0.10 if pain else -0.04) * 10 * (side - 3.2) / 3.2 * (-1 if pain else 1)
    p.lay(p.mask(np.maximum(np.abs(y - brow) - 0.7, np.abs(side - 3.2) - 2.1)), "2a1610")
    opened = 0.5 if pain else (1.15, 1.1, 0.95, 0.8, 0.6)[health - 1]
    eye = shapes.ellipse(side, y, 3.1, 11.3, 1.75, opened)
    p.lay(p.mask(eye - 0.4), skin[0])
    p.lay(p.mask(eye), "f2ece0")
    p.lay(p.mask(np.maximum(shapes.circle(side, y, 2.9, 11.3, 0.95), eye)), "143c3a")
    p.lay(p.mask(shapes.polygon(side, y, [(0, 11), (0.7, 11.4), (1.5, 14.6), (0, 15.4), (-1, 14)])) * 0.45, skin[2])
    p.lay(p.mask(np.maximum(np.abs(y - 15.2) - 0.35, side - 1.5)) * 0.8, skin[0])
    if pain:
        p.lay(p.mask(shapes.ellipse(x, y, 12, 18.0, 2.4, 1.9)), "2c0c0c")
        p.lay(p.mask(np.maximum(np.abs(y - 16.9) - 0.4, side - 1.6)), "efe6d6")
    else:
        bend = (0.10, 0.03, 0.0, -0.05, -0.1)[health - 1] * (side**2)
        p.lay(p.mask(np.maximum(np.abs(y - 17.7 + bend) - 0.45, side - 2.7)), "5a2420")
    # A brand on the brow, the works' sign.
    p.lay(p.mask(shapes.star(x, y, 12, 6.9, 4, 1.8, 0.7)), "ffc64e" if health < 4 else "b0761e")


def _wounds(p: Picture, x: np.ndarray, y: np.ndarray, health: int, face: np.ndarray) -> None:
    cuts = [
        [(14.6, 12.9), (17.0, 15.6)],
        [(7.4, 8.0), (9.2, 10.2), (8.4, 13.0)],
        [(12.4, 16.2), (12.9, 20.5)],
        [(15.4, 7.4), (13.8, 9.4)],
    ]
    for cut in cuts[: health - 1]:
        p.lay(p.mask(np.maximum(shapes.strokes(x, y, cut, 0.5), face)), _BLOOD)
    if health >= 4:
        p.lay(p.mask(np.maximum(shapes.ellipse(x, y, 8.4, 14.6, 2.0, 2.6), face)) * 0.6, _BLOOD)
    if health == 5:
        p.lay(p.mask(np.maximum(shapes.ellipse(x, y, 15.4, 11.4, 2.2, 1.5), face)) * 0.55, "3a1a3c")
        p.lay(p.mask(np.maximum(shapes.segment(x, y, 10.6, 18.2, 10.2, 22, 0.7), face)), _BLOOD)


def _tinted(picture: Picture, ramp: str, share: float, eyes: str | None = None) -> np.ndarray:
    """The face in one colour's tones."""
    light = picture.color @ np.array([0.2126, 0.7152, 0.0722])
    tones = gradient(ramp, srgb_from_linear(light), linear=True)
    picture.color += (tones - picture.color) * share
    if eyes is not None:
        side = np.abs(picture.x - 12)
        picture.lay(picture.mask(shapes.ellipse(side, picture.y, 3.1, 11.3, 2.3, 1.5)), eyes)
    return picture.indices()


def faces() -> dict[str, np.ndarray]:
    """face1 (well) to face5, face_p1 to face_p5 (in pain), and those of the powers."""
    out = {}
    for health in range(1, 6):
        out[f"face{health}"] = _face(health, False).indices()
        out[f"face_p{health}"] = _face(health, True).indices()
    out["face_quad"] = _tinted(_face(1, False), "02050c 103668 3a86e0 dff8ff", 0.9, "dff8ff")
    out["face_invis"] = _tinted(_face(1, False), "14161c 22262e 363c48", 0.97, "d9bfe0")
    out["face_invul1"] = _tinted(_face(1, False), "160502 8c2a0a e89a30 fff0a0", 0.85, "ff4a40")
    out["face_invul2"] = _tinted(_face(1, False), "160502 98350c f6b23a fff8d4", 0.85, "ffffff")
    out["face_inv2"] = _tinted(_face(1, False), "160502 3c1408 6a2c10", 0.97, "ff4a40")
    return out
