"""PNG files of 8 bits a channel, written and (those of this writer's kind) read; the standard library's zlib."""

from __future__ import annotations

import struct
import zlib

import numpy as np

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_COLOR_TYPES = {1: 0, 3: 2, 4: 6}  # channels -> colour type


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write_png(pixels: np.ndarray, level: int = 6) -> bytes:
    """The file of `pixels`, uint8 (h, w) grey, (h, w, 3) RGB or (h, w, 4) RGBA."""
    pixels = np.asarray(pixels, np.uint8)
    if pixels.ndim == 2:
        pixels = pixels[..., None]
    height, width, channels = pixels.shape
    rows = pixels.reshape(height, width * channels)
    # Filter 2 (the difference from the row above) suits all our pictures.
    filtered = np.empty((height, width * channels + 1), np.uint8)
    filtered[:, 0] = 2
    filtered[:, 1:] = rows
    filtered[1:, 1:] -= rows[:-1]
    head = struct.pack(">IIBBBBB", width, height, 8, _COLOR_TYPES[channels], 0, 0, 0)
    return _SIGNATURE + _chunk(b"IHDR", head) + _chunk(b"IDAT", zlib.compress(filtered.tobytes(), level)) + _chunk(b"IEND", b"")


def read_png(data: bytes) -> np.ndarray:
    """The pixels (h, w, channels) of a file from write_png; ValueError for any other kind."""
    if data[:8] != _SIGNATURE:
        raise ValueError("not a PNG file")
    at, body, head = 8, b"", b""
    while at < len(data):
        (size,) = struct.unpack_from(">I", data, at)
        kind, content = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            head = content
        elif kind == b"IDAT":
            body += content
        at += size + 12
    width, height, depth, color_type = struct.unpack(">IIBB", head[:10])
    channels = {kind: count for count, kind in _COLOR_TYPES.items()}.get(color_type)
    rows = np.frombuffer(zlib.decompress(body), np.uint8)
    if channels is None or depth != 8 or rows.size != height * (width * channels + 1):
        raise ValueError("a PNG of a kind that is not read here")
    rows = rows.reshape(height, width * channels + 1)
    if (rows[:, 0] != 2).any():
        raise ValueError("a PNG with filters that are not read here")
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(height, width, channels)
