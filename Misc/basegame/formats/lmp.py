"""LMP pictures (`gfx/*.lmp`): width and height as 32-bit integers, then palette indices row by row."""

from __future__ import annotations

import struct

import numpy as np


def write_lmp(indices: np.ndarray) -> bytes:
    """The file of a picture of palette indices (h, w) uint8."""
    height, width = indices.shape
    return struct.pack("<ii", width, height) + np.ascontiguousarray(indices, np.uint8).tobytes()


def read_lmp(data: bytes) -> np.ndarray:
    """The picture's palette indices (h, w); ValueError if the size does not fit."""
    width, height = struct.unpack_from("<ii", data)
    if width <= 0 or height <= 0 or len(data) < 8 + width * height:
        raise ValueError(f"a picture of {width}x{height} in {len(data)} bytes")
    return np.frombuffer(data, np.uint8, width * height, 8).reshape(height, width)
