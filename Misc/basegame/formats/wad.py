"""WAD2 archives: textures for a map compiler (type D, miptex) and pictures of the status bar (type B, as lmp)."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

TYPE_PICTURE, TYPE_MIPTEX, TYPE_RAW = 0x42, 0x44, 0x40
# The console's characters have no size before them and a type of their own.
TYPE_CONCHARS = TYPE_MIPTEX


@dataclass
class Lump:
    """One entry: its name (at most 15 bytes), its type and its bytes."""

    name: str
    kind: int
    data: bytes


def write_wad(lumps: list[Lump]) -> bytes:
    """The archive with the lumps in the order given."""
    body, directory = bytearray(b"WAD2" + bytes(8)), bytearray()
    for lump in lumps:
        name = lump.name.encode("ascii")
        if len(name) > 15:
            raise ValueError(f"{lump.name} is longer than the 15 bytes of a lump's name")
        body += bytes(-len(body) % 4)
        directory += struct.pack("<iiiBBH16s", len(body), len(lump.data), len(lump.data), lump.kind, 0, 0, name)
        body += lump.data
    body += bytes(-len(body) % 4)
    struct.pack_into("<ii", body, 4, len(lumps), len(body))
    return bytes(body + directory)


def read_wad(data: bytes) -> dict[str, Lump]:
    """Lumps by their lower-case names; ValueError for another format."""
    if data[:4] != b"WAD2":
        raise ValueError("not a WAD2 archive")
    count, at = struct.unpack_from("<ii", data, 4)
    lumps = {}
    for i in range(count):
        offset, size, _, kind, _, _, name = struct.unpack_from("<iiiBBH16s", data, at + 32 * i)
        text = name.split(b"\0")[0].decode("ascii")
        lumps[text.lower()] = Lump(text, kind, data[offset : offset + size])
    return lumps


def write_miptex(name: str, levels: list[np.ndarray]) -> bytes:
    """A texture's lump: four levels of palette indices, each half the size of the one before."""
    height, width = levels[0].shape
    if width % 16 or height % 16 or len(levels) != 4:
        raise ValueError(f"{name}: {width}x{height} with {len(levels)} levels; sizes are multiples of 16, levels four")
    data, offsets = b"", []
    for level, indices in enumerate(levels):
        if indices.shape != (height >> level, width >> level):
            raise ValueError(f"{name}: level {level} is {indices.shape[1]}x{indices.shape[0]}")
        offsets.append(40 + len(data))
        data += np.ascontiguousarray(indices, np.uint8).tobytes()
    return struct.pack("<16sII4I", name.encode("ascii"), width, height, *offsets) + data


def read_miptex(data: bytes) -> tuple[str, list[np.ndarray]]:
    """A texture's name and its four levels of palette indices."""
    name, width, height, *offsets = struct.unpack_from("<16sII4I", data)
    levels = [
        np.frombuffer(data, np.uint8, (width >> i) * (height >> i), offset).reshape(height >> i, width >> i)
        for i, offset in enumerate(offsets)
    ]
    return name.split(b"\0")[0].decode("ascii"), levels
