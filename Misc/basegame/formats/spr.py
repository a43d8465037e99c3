"""SPR sprites (IDSP, version 1): pictures of palette indices that face the viewer; 255 is transparent."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

# How a sprite stands: upright, facing; upright and fixed; flat to the view; as its angles say; flat, turned by its roll.
PARALLEL_UPRIGHT, FACING_UPRIGHT, PARALLEL, ORIENTED, PARALLEL_ORIENTED = range(5)


@dataclass
class Frame:
    """A picture (h, w) uint8, and where its upper left corner lies from the sprite's origin: units right and up."""

    picture: np.ndarray
    left: int
    top: int

    @staticmethod
    def centred(picture: np.ndarray) -> Frame:
        """The picture about the origin."""
        return Frame(picture, -(picture.shape[1] // 2), picture.shape[0] // 2)


@dataclass
class Sprite:
    """A sprite of single frames."""

    orientation: int
    frames: list[Frame]


def write_spr(sprite: Sprite) -> bytes:
    """The sprite's file."""
    height = max(frame.picture.shape[0] for frame in sprite.frames)
    width = max(frame.picture.shape[1] for frame in sprite.frames)
    radius = 0.5 * (width**2 + height**2) ** 0.5
    out = struct.pack("<4siifiiifi", b"IDSP", 1, sprite.orientation, radius, width, height, len(sprite.frames), 0.0, 0)
    for frame in sprite.frames:
        rows, columns = frame.picture.shape
        out += struct.pack("<iiiii", 0, frame.left, frame.top, columns, rows)
        out += np.ascontiguousarray(frame.picture, np.uint8).tobytes()
    return out


def read_spr(data: bytes) -> Sprite:
    """The sprite of a file whose frames are all single; ValueError for another."""
    magic, version, orientation, _, _, _, count, _, _ = struct.unpack_from("<4siifiiifi", data)
    if magic != b"IDSP" or version != 1:
        raise ValueError("not a sprite of version 1")
    at, frames = 36, []
    for _ in range(count):
        group, left, top, columns, rows = struct.unpack_from("<iiiii", data, at)
        if group != 0 or at + 20 + columns * rows > len(data):
            raise ValueError("a group of frames, or a frame cut short")
        frames.append(Frame(np.frombuffer(data, np.uint8, columns * rows, at + 20).reshape(rows, columns), left, top))
        at += 20 + columns * rows
    return Sprite(orientation, frames)
