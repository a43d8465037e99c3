"""Quake's compiled maps (version 29, and BSP2 with its wider indices): entities, textures, sizes of models, and a copy
with other textures of the same sizes."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass

LUMPS = ["entities", "planes", "textures", "vertices", "visibility", "nodes", "texinfo", "faces", "lighting",
         "clipnodes", "leafs", "marksurfaces", "edges", "surfedges", "models"]
VERSIONS = {b"\x1d\0\0\0": "BSP29", b"BSP2": "BSP2", b"2PSB": "2PSB"}
HEADER_SIZE = 4 + 8 * len(LUMPS)
MODEL = struct.Struct("<9f7i")
KEY_AND_VALUE = re.compile(r'"([^"]*)"\s*"([^"]*)"')


@dataclass
class Model:
    """A brush model's box, a unit larger on each side than its brushes, as the compilers write it."""

    mins: tuple[float, float, float]
    maxs: tuple[float, float, float]
    face_count: int


class Bsp:
    def __init__(self, data: bytes):
        if len(data) < HEADER_SIZE or data[:4] not in VERSIONS:
            raise ValueError("not a compiled Quake map")
        self.data = data
        self.version = VERSIONS[data[:4]]
        self.places = {name: struct.unpack_from("<ii", data, 4 + 8 * k) for k, name in enumerate(LUMPS)}
        for name, (offset, size) in self.places.items():
            if offset < 0 or size < 0 or offset + size > len(data):
                raise ValueError(f"its {name} reach beyond the file")

    def lump(self, name: str) -> bytes:
        offset, size = self.places[name]
        return self.data[offset:offset + size]

    def entities(self) -> list[dict[str, str]]:
        text = self.lump("entities").split(b"\0")[0].decode("latin-1")
        return [dict(KEY_AND_VALUE.findall(block)) for block in re.findall(r"\{(.*?)\}", text, re.S)]

    def models(self) -> list[Model]:
        return [Model(row[0:3], row[3:6], row[15]) for row in MODEL.iter_unpack(self.lump("models"))]

    def face_count(self) -> int:
        return len(self.lump("faces")) // (20 if self.version == "BSP29" else 28)

    def textures(self) -> dict[str, bytes]:
        """Each texture's lump as in a wad, by name."""
        return {name: self.data[start:start + size] for name, start, size in self._texture_places()}

    def with_textures(self, lumps: dict[str, bytes]) -> bytes:
        """The file with those textures' texels that `lumps` has (by lower-case name, of the same size) in place."""
        result = bytearray(self.data)
        for name, start, size in self._texture_places():
            new = lumps.get(name.lower())
            if new is None:
                continue
            if new[16:24] != self.data[start + 16:start + 24]:
                raise ValueError(f"{name} has another size than in the map; compile it anew")
            result[start + 40:start + size] = new[40:size]
        return bytes(result)

    def _texture_places(self):
        offset, size = self.places["textures"]
        if not size:
            return
        (count,) = struct.unpack_from("<i", self.data, offset)
        for (at,) in struct.iter_unpack("<i", self.data[offset + 4:offset + 4 + 4 * count]):
            if at < 0:
                continue
            start = offset + at
            name, width, height, first = struct.unpack_from("<16sIII", self.data, start)
            if first:
                yield name.split(b"\0")[0].decode("latin-1"), start, 40 + width * height * 85 // 64
