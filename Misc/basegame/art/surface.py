"""A painted surface: colour, glow, holes, height and gloss at one resolution, and what the game's files make of it.

Painters work at `scale` times the texels that the map sees (2 for most): the PNG files keep that resolution, the
paletted texture is the mean of linear light over each texel. No light or shadow is painted: height becomes a normal
map, and the path tracer does the rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from art.palette import TRANSPARENT, linear_from_srgb, nearest, srgb_from_linear
from formats.png import write_png
from formats.wad import write_miptex


@dataclass
class Surface:
    """A texture's layers, each (H, W) or (H, W, 3) with H and W `scale` times the texture's size."""

    color: np.ndarray  # sRGB 0..1
    height: np.ndarray | None = None  # texels of the texture, up is towards the viewer
    gloss: np.ndarray | None = None  # 1 - roughness, 0..1
    glow: np.ndarray | None = None  # bool: these texels are lights, and their colour is their light's
    luma: np.ndarray | None = None  # (H, W, 3) sRGB: the light itself, where the palette has no such light
    shine: float = 1.0  # light of what glows as a share of a lamp's; below 1 hues are kept, where a lamp's burn out
    holes: np.ndarray | None = None  # bool: nothing is here
    open_sky: np.ndarray | None = None  # bool: index 0, where a sky's near layer shows the far one
    exact: bool = False  # a PNG keeps the colour, which the palette has not
    scale: int = 1
    palette: list[int] | None = None  # the only indices that texels without glow may have
    dither: float = 0.0
    tiles: bool = True  # its edges meet (normals are taken across them)


def shrink(image: np.ndarray, factor: int) -> np.ndarray:
    """The mean over blocks of `factor` x `factor`; any number of channels."""
    if factor == 1:
        return image
    height, width = image.shape[0] // factor, image.shape[1] // factor
    return image.reshape(height, factor, width, factor, *image.shape[2:]).mean(axis=(1, 3))


def _level(surface: Surface, factor: int) -> np.ndarray:
    """Palette indices of the surface at 1/factor of its resolution."""
    rgb = srgb_from_linear(shrink(linear_from_srgb(surface.color), factor))
    indices = nearest(rgb, dither=surface.dither, among=surface.palette)
    if surface.glow is not None:
        lit = shrink(surface.glow.astype(float), factor) >= 0.5
        if lit.any():
            # A texel that glows in part has the colour of the part that glows.
            weight = np.maximum(shrink(surface.glow.astype(float), factor), 1e-6)[..., None]
            light = shrink(linear_from_srgb(surface.color) * surface.glow[..., None], factor) / weight
            indices[lit] = nearest(srgb_from_linear(light), glow=True)[lit]
    if surface.holes is not None:
        indices[shrink(surface.holes.astype(float), factor) >= 0.5] = TRANSPARENT
    if surface.open_sky is not None:
        indices[shrink(surface.open_sky.astype(float), factor) >= 0.5] = 0
    return indices


def miptex(name: str, surface: Surface) -> bytes:
    """The texture's lump for the map compiler's archive."""
    return write_miptex(name, [_level(surface, surface.scale << level) for level in range(4)])


STEEPEST = 0.75  # slope that normals come near to but never reach: beyond it low light would blacken every groove


def normal_map(height: np.ndarray, scale: int, tiles: bool = True) -> np.ndarray:
    """Tangent-space normals (H, W, 3) uint8 of a height field in texels; green points up the image."""
    padded = np.pad(height, 1, mode="wrap" if tiles else "edge")
    across = (padded[1:-1, 2:] - padded[1:-1, :-2]) * (0.5 * scale)
    down = (padded[2:, 1:-1] - padded[:-2, 1:-1]) * (0.5 * scale)
    gentler = 1.0 / np.sqrt(1.0 + (across**2 + down**2) / STEEPEST**2)
    across, down = across * gentler, down * gentler
    normal = np.stack([-across, down, np.ones_like(height)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.round(normal * 127.0 + 128.0).astype(np.uint8)


def _bytes(values: np.ndarray) -> np.ndarray:
    return np.round(np.clip(values, 0.0, 1.0) * 255.0).astype(np.uint8)


def files(name: str, surface: Surface) -> dict[str, bytes]:
    """The PNG files beside a texture: none for a surface without height, gloss, finer texels or a colour of its own."""
    plain = surface.height is None and surface.gloss is None and surface.luma is None
    if plain and not surface.exact and surface.scale == 1:
        return {}
    stem = "textures/" + name.replace("*", "#")
    color = _bytes(surface.color)
    if surface.holes is not None:
        color = np.concatenate([color, _bytes(~surface.holes)[..., None]], axis=-1)
    out = {f"{stem}.png": write_png(color)}
    if surface.luma is not None:
        out[f"{stem}_luma.png"] = write_png(_bytes(surface.luma))
    elif surface.glow is not None and surface.glow.any():
        light = linear_from_srgb(surface.color)
        if surface.shine < 1.0:
            light = surface.shine * light * (light / np.maximum(light.max(axis=-1, keepdims=True), 1e-6)) ** 1.5
        out[f"{stem}_luma.png"] = write_png(_bytes(srgb_from_linear(light) * surface.glow[..., None]))
    if surface.height is not None:
        out[f"{stem}_norm.png"] = write_png(normal_map(surface.height, surface.scale, surface.tiles))
    if surface.gloss is not None:
        out[f"{stem}_gloss.png"] = write_png(_bytes(surface.gloss))
    return out
