"""Sprites: bubbles, the fire of an explosion, a light. In the renderer every texel of a sprite glows."""

from __future__ import annotations

import numpy as np

from art.noise import fractal_noise, smoothstep
from art.palette import FIRE, RAMPS, TRANSPARENT, gradient, nearest
from formats.spr import PARALLEL, Frame, Sprite, write_spr

FLAMES = [*RAMPS["fire"], *RAMPS["white_glow"]]


def _grid(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates -1..1 of a square picture."""
    axis = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    return np.meshgrid(axis, axis)


def bubble(frame: int) -> np.ndarray:
    """A bubble of 16 texels: a rim, and light within; the second frame is flatter."""
    x, y = _grid(16)
    y = y * (1.0 if frame == 0 else 1.18)
    x = x * (1.0 if frame == 0 else 0.92)
    radius = np.hypot(x, y)
    light = np.hypot(x + 0.32, y + 0.36)
    rgb = gradient("103668 2a6fae 7cc4ff dff8ff", smoothstep(0.45, 0.85, radius) * 0.75)
    indices = nearest(rgb, among=RAMPS["blue"] + RAMPS["slate"])
    indices[light < 0.2] = 246
    # Only rim and light are there: one sees through the rest.
    seen = ((radius > 0.66) & (radius < 0.9)) | (light < 0.2)
    return np.where(seen, indices, TRANSPARENT).astype(np.uint8)


def explosion(frame: int) -> np.ndarray:
    """Fire of 64 texels: bursts white, swells in lobes, breaks up and goes red."""
    x, y = _grid(64)
    age = frame / 5.0
    u, v = 0.5 + 0.5 * x, 0.5 + 0.5 * y
    radius = np.hypot(x, y)
    size = 0.46 + 0.55 * age**0.5
    push = fractal_noise(u * 0.8 / size**0.5 + 0.13 * frame, v * 0.8 / size**0.5 - 0.07 * frame, 5, 5, 61, 4, 0.6)
    fine = fractal_noise(u + 0.1 * frame, v + 0.21 * frame, 9, 9, 62, 3, 0.6)
    edge = 1.0 - radius / size + 0.26 * push + 0.08 * fine
    heat = np.clip(edge * 1.5, 0.0, 1.0) * (1.15 - 0.75 * age) + 0.16 * push * (1.0 - 0.4 * age)
    # It tears from its border inwards, in lumps: holes of single texels look like dirt.
    lumps = fractal_noise(u * 0.7 + 0.1 * frame, v * 0.7 + 0.21 * frame, 4, 4, 63, 1, 0.5)
    tear = np.clip(lumps + 0.1, 0, 1) * smoothstep(0.35, 0.75, radius / size)
    open_ = edge - smoothstep(0.35, 1.0, age) * (0.06 + 1.3 * tear)
    rgb = gradient(f"{FIRE} ffffff", heat)
    seen = (open_ > 0.04) & (radius < 0.98)
    return np.where(seen, nearest(rgb, among=FLAMES), TRANSPARENT).astype(np.uint8)


def light() -> np.ndarray:
    """A flame's ball of 32 texels."""
    x, y = _grid(32)
    radius = np.hypot(x, y)
    star = np.maximum(np.abs(x), np.abs(y)) * 4.5 * np.minimum(np.abs(x), np.abs(y)) + 0.3 * radius
    heat = np.clip(1.0 - 1.15 * np.minimum(radius * 1.6, star + 0.35), 0.0, 1.0)
    rgb = gradient(f"{FIRE} ffffff", heat)
    return np.where(heat > 0.06, nearest(rgb, among=FLAMES), TRANSPARENT).astype(np.uint8)


def sprite_files(pattern: str) -> dict[str, bytes]:
    """`progs/s_*.spr`."""
    made = {"s_bubble": [bubble(0), bubble(1)], "s_explod": [explosion(frame) for frame in range(6)], "s_light": [light()]}
    return {
        f"progs/{name}.spr": write_spr(Sprite(PARALLEL, [Frame.centred(picture) for picture in pictures]))
        for name, pictures in made.items()
    }
