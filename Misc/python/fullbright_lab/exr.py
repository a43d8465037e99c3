"""OpenEXR files of scan lines, uncompressed or with ZIP, as numpy arrays: enough to read what `fullbright-lab reference` writes
and to keep a part of it in halves. The layout is that of OpenEXR's technical introduction."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

MAGIC = 20000630
LONG_NAMES = 0x400  # of attributes and channels: they are read alike
TYPES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
LINES = {0: 1, 2: 1, 3: 16}  # of a chunk, by compression: none, ZIPS, ZIP


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _unzip(packed: bytes, size: int) -> bytes:
    if len(packed) == size:
        return packed  # what would not shrink is stored as it is
    steps = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    steps[1:] -= 128
    halves = (np.cumsum(steps) & 255).astype(np.uint8)
    whole, middle = np.empty(size, np.uint8), (size + 1) // 2
    whole[0::2], whole[1::2] = halves[:middle], halves[middle:]
    return whole.tobytes()


def _zip(data: bytes) -> bytes:
    raw = np.frombuffer(data, np.uint8)
    halves = np.concatenate([raw[0::2], raw[1::2]]).astype(np.int64)
    halves[1:] = (np.diff(halves) + 128) & 255
    packed = zlib.compress(halves.astype(np.uint8).tobytes(), 9)
    return packed if len(packed) < len(data) else data


def read(path: str | Path) -> tuple[dict[str, np.ndarray], dict[str, tuple[str, bytes]]]:
    """Channels (H, W) float32 by name, and the header's attributes as (type, bytes)."""
    data = Path(path).read_bytes()
    magic, version = struct.unpack_from("<II", data)
    if magic != MAGIC or version & ~(0xFF | LONG_NAMES):
        raise ValueError(f"{path}: no OpenEXR file of scan lines")
    at, header = 8, {}
    while data[at]:
        name, at = _text(data, at)
        kind, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = (kind, data[at + 4:at + 4 + size])
        at += 4 + size
    channels, list_, where = [], header["channels"][1], 0
    while list_[where]:
        name, where = _text(list_, where)
        channels.append((name, TYPES[struct.unpack_from("<i", list_, where)[0]]))
        where += 16
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"][1])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES[header["compression"][1][0]]
    planes = {name: np.empty((height, width), np.float32) for name, _ in channels}
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at + 1):
        first, size = struct.unpack_from("<ii", data, offset)
        first -= y0
        count = min(lines, height - first)
        raw = _unzip(data[offset + 8:offset + 8 + size], count * width * sum(kind.itemsize for _, kind in channels))
        place = 0
        for line in range(first, first + count):
            for name, kind in channels:
                planes[name][line] = np.frombuffer(raw, kind, width, place)
                place += width * kind.itemsize
    return planes, header


def write(path: Path, planes: dict[str, np.ndarray], header: dict[str, tuple[str, bytes]], full: str = "variance.") -> None:
    """Writes channels as halves, those whose name begins with `full` as floats; other attributes as they were."""
    names = sorted(planes)
    kinds = {name: 2 if name.startswith(full) else 1 for name in names}
    height, width = planes[names[0]].shape
    listed = b"".join(n.encode() + b"\0" + struct.pack("<iBxxxii", kinds[n], 0, 1, 1) for n in names) + b"\0"
    header = header | {"channels": ("chlist", listed), "compression": ("compression", b"\x03")}
    out = struct.pack("<II", MAGIC, 2)
    for name, (kind, value) in header.items():
        out += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    out += b"\0"
    chunks = []
    for first in range(0, height, 16):
        raw = b"".join(planes[n][line].astype(TYPES[kinds[n]]).tobytes()
                       for line in range(first, min(first + 16, height)) for n in names)
        packed = _zip(raw)
        chunks.append(struct.pack("<ii", first, len(packed)) + packed)
    place = len(out) + 8 * len(chunks)
    for chunk in chunks:
        out += struct.pack("<Q", place)
        place += len(chunk)
    path.write_bytes(out + b"".join(chunks))
