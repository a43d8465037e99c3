"""The images beside a model: `progs/NAME.mdl_0.png` for skin 0, with `_gloss`, `_norm` and, where something glows, `_luma`.

They are painted at FINE times the skin's resolution and in all colours; the model's own skin stays for programs that read
no images. A model in players' colours has no image of colour: what is to change its colour has to stay paletted.
"""

from __future__ import annotations

import numpy as np

from formats.png import write_png
from models.kit.figure import Figure
from models.kit.skin import GLOSS, GLOW, paint_layers

STEEPEST = 0.8  # slope that normals come near to: beyond it low light would blacken every groove
_LEVEL = 4  # of zlib: half the time of 6, and a twentieth more bytes


def _bytes(values: np.ndarray) -> np.ndarray:
    return np.round(np.clip(values, 0.0, 1.0) * 255.0).astype(np.uint8)


def normals(slopes: np.ndarray) -> np.ndarray:
    """Tangent-space normals (h, w, 3) uint8 of slopes to the right and down (h, w, 2); green points up the image."""
    gentle = slopes / np.sqrt(1.0 + (slopes**2).sum(axis=-1, keepdims=True) / STEEPEST**2)
    normal = np.stack([-gentle[..., 0], gentle[..., 1], np.ones(slopes.shape[:2], np.float32)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.round(normal * 127.0 + 128.0).astype(np.uint8)


def images(path: str, figure: Figure, colored: bool = False) -> dict[str, bytes]:
    """Files by their paths for the model at `path`; none for a skin that is all light. `colored`: players' colours."""
    out = {}
    for skin, picture in enumerate(figure.skins):
        height, width = picture.shape
        layers, slopes = paint_layers(figure.patches, figure.places, width, height, skin)
        glow, painted = layers[..., GLOW] > 0.5, layers.any(axis=-1)
        if glow[painted].all():
            continue
        stem = f"{path}_{skin}"
        if not colored:
            color = _bytes(layers[..., :GLOW])
            out[f"{stem}.png"] = write_png(color, _LEVEL)
            if glow.any():
                out[f"{stem}_luma.png"] = write_png(color * glow[..., None], _LEVEL)
        out[f"{stem}_gloss.png"] = write_png(_bytes(layers[..., GLOSS]), _LEVEL)
        out[f"{stem}_norm.png"] = write_png(normals(slopes), _LEVEL)
    return out
