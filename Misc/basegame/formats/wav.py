"""Reads and writes the wave files that Quake plays: mono PCM of 8 or 16 bits, and where they loop.

Quake finds a loop in two chunks of the RIFF format: `cue ` holds the sample at which the loop begins; a `LIST` of kind
`adtl` right behind it may hold an `ltxt` with purpose `mark`, whose length in samples says where it ends. The engine
looks for the LIST as the very next chunk and for `mark` at its 28th byte, so both are written in that order and the
label stands first.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

CUE = 1


@dataclass
class Wav:
    """One sound. samples: (n,) float64 in -1..1; loop: first sample of the loop, which ends with the file, or None."""

    rate: int
    samples: np.ndarray
    loop: int | None = None
    bits: int = 16

    def quantized(self) -> np.ndarray:
        """(n,) integers as they stand in the file: int16, or uint8 around 128."""
        full = 32767 if self.bits == 16 else 127
        values = np.rint(np.clip(self.samples, -1.0, 1.0) * full)
        return values.astype("<i2") if self.bits == 16 else (values + 128).astype(np.uint8)

    def to_bytes(self) -> bytes:
        if self.bits not in (8, 16):
            raise ValueError(f"a wave file of {self.bits} bits; 8 and 16 are what Quake plays")
        if self.loop is not None and not 0 <= self.loop < len(self.samples):
            raise ValueError(f"a loop from sample {self.loop} of {len(self.samples)}")
        width = self.bits // 8
        body = _chunk(b"fmt ", struct.pack("<HHIIHH", 1, 1, self.rate, self.rate * width, width, self.bits))
        body += _chunk(b"data", self.quantized().tobytes())
        if self.loop is not None:
            body += _chunk(b"cue ", struct.pack("<III4sIII", 1, CUE, self.loop, b"data", 0, 0, self.loop))
            length = len(self.samples) - self.loop
            label = struct.pack("<II4sHHHH", CUE, length, b"mark", 0, 0, 0, 0)
            body += _chunk(b"LIST", b"adtl" + _chunk(b"ltxt", label))
        return b"RIFF" + struct.pack("<I", 4 + len(body)) + b"WAVE" + body


def from_bytes(data: bytes) -> Wav:
    """Reads what to_bytes writes, and other mono PCM files; ValueError says what is wrong with anything else."""
    if data[:4] != b"RIFF" or data[8:12] != b"WAVE":
        raise ValueError("not a RIFF/WAVE file")
    chunks = _chunks(data)
    if b"fmt " not in chunks or b"data" not in chunks:
        raise ValueError("a wave file without fmt or data chunk")
    kind, channels, rate, _, _, bits = struct.unpack_from("<HHIIHH", chunks[b"fmt "])
    if kind != 1 or channels != 1 or bits not in (8, 16):
        raise ValueError(f"format {kind}, {channels} channels, {bits} bits; mono PCM of 8 or 16 bits is what Quake plays")
    if bits == 16:
        samples = np.frombuffer(chunks[b"data"], "<i2") / 32767.0
    else:
        samples = (np.frombuffer(chunks[b"data"], np.uint8).astype(float) - 128.0) / 127.0
    return Wav(rate, samples, _loop(chunks, len(samples)), bits)


def _loop(chunks: dict[bytes, bytes], count: int) -> int | None:
    cue = chunks.get(b"cue ")
    if cue is None:
        return None
    (start,) = struct.unpack_from("<I", cue, 24)
    mark = chunks.get(b"LIST", b"")
    if mark[20:24] == b"mark" and start + struct.unpack_from("<I", mark, 16)[0] > count:
        raise ValueError("the loop ends behind the last sample")
    if start >= count:
        raise ValueError("the loop begins behind the last sample")
    return start


def _chunk(name: bytes, payload: bytes) -> bytes:
    return name + struct.pack("<I", len(payload)) + payload + b"\0" * (len(payload) & 1)


def _chunks(data: bytes) -> dict[bytes, bytes]:
    """The first chunk of each name."""
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= len(data):
        name, size = data[at : at + 4], struct.unpack_from("<I", data, at + 4)[0]
        if at + 8 + size > len(data):
            raise ValueError(f"chunk {name!r} at {at} is longer than the file")
        found.setdefault(name, data[at + 8 : at + 8 + size])
        at += 8 + size + (size & 1)
    return found
