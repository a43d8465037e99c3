"""Quake's alias models (IDPO, version 6): the file as arrays, written and read.

Coordinates are Quake's: x forward, y left, z up, in units. Positions are stored as bytes between the bounds of all
frames, so a model's precision is its size / 255.
"""

from __future__ import annotations

import dataclasses
import struct

import numpy as np

from formats.mdl_normals import DIRECTIONS, nearest_direction

_HEADER = struct.Struct("<4si 3f 3f f 3f 8i f")

# Trails and spin of the entity that shows the model.
ROCKET, GRENADE, GIB, ROTATE, TRACER, ZOMGIB, TRACER2, TRACER3 = (1 << bit for bit in range(8))


@dataclasses.dataclass
class Frame:
    """One frame, or with several poses a group that the client plays by itself."""

    name: str
    poses: list[int]  # into Mdl.positions
    pose_names: list[str] = dataclasses.field(default_factory=list)
    interval: float = 0.1  # seconds a pose of a group


@dataclasses.dataclass
class Mdl:
    """A model of V vertices, T triangles and P poses."""

    positions: np.ndarray  # (P, V, 3) units
    normals: np.ndarray  # (P, V, 3) unit length
    triangles: np.ndarray  # (T, 3) vertices, counter-clockwise as seen from outside
    texels: np.ndarray  # (V, 2) ints, s right and t down in the skin
    skins: list[np.ndarray]  # each (height, width) uint8 palette indices
    frames: list[Frame]
    flags: int = 0
    random_start: bool = False  # groups of several entities out of step


def _bounds(points: np.ndarray) -> tuple[bytes, bytes]:
    return bytes([*points.min(axis=0), 0]), bytes([*points.max(axis=0), 0])


def _pose_bytes(name: str, points: np.ndarray, normals: np.ndarray) -> bytes:
    low, high = _bounds(points)
    vertices = np.concatenate([points, normals[:, None]], axis=1).astype(np.uint8)
    return low + high + name.encode().ljust(16, b"\0")[:16] + vertices.tobytes()


def _group_bytes(model: Mdl, frame: Frame, points: np.ndarray, normals: np.ndarray) -> bytes:
    low, high = _bounds(points[frame.poses].reshape(-1, 3))
    times = [frame.interval * (i + 1) for i in range(len(frame.poses))]
    out = struct.pack("<ii", 1, len(frame.poses)) + low + high + struct.pack(f"<{len(times)}f", *times)
    names = frame.pose_names or [f"{frame.name}{i + 1}" for i in range(len(frame.poses))]
    return out + b"".join(_pose_bytes(n, points[p], normals[p]) for n, p in zip(names, frame.poses))


def write_mdl(model: Mdl) -> bytes:
    """The file's bytes."""
    low = model.positions.min(axis=(0, 1))
    scale = np.maximum(model.positions.max(axis=(0, 1)) - low, 1e-3) / 255.0
    points = np.clip(np.round((model.positions - low) / scale), 0, 255).astype(np.uint8)
    normals = nearest_direction(model.normals)
    height, width = model.skins[0].shape
    radius = float(np.linalg.norm(model.positions, axis=2).max())
    edges = model.positions[0][model.triangles]
    areas = np.linalg.norm(np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0]), axis=1)
    counts = (len(model.skins), width, height, points.shape[1], len(model.triangles), len(model.frames))
    out = [
        _HEADER.pack(
            b"IDPO",
            6,
            *scale,
            *low,
            radius,
            0.0,
            0.0,
            0.0,
            *counts,
            int(model.random_start),
            model.flags,
            float(areas.mean() / 2.0),
        )
    ]
    for skin in model.skins:
        out.append(struct.pack("<i", 0) + np.ascontiguousarray(skin, np.uint8).tobytes())
    texels = np.concatenate([np.zeros((len(model.texels), 1)), model.texels], axis=1)
    out.append(texels.astype("<i4").tobytes())
    clockwise = np.concatenate([np.ones((len(model.triangles), 1)), model.triangles[:, [0, 2, 1]]], axis=1)
    out.append(clockwise.astype("<i4").tobytes())
    for frame in model.frames:
        if len(frame.poses) == 1:
            pose = frame.poses[0]
            out.append(struct.pack("<i", 0) + _pose_bytes(frame.name, points[pose], normals[pose]))
        else:
            out.append(_group_bytes(model, frame, points, normals))
    return b"".join(out)


class _Reader:
    def __init__(self, data: bytes):
        self.data, self.at = data, 0

    def take(self, size: int) -> bytes:
        if self.at + size > len(self.data):
            raise ValueError(f"the model ends at {len(self.data)} where {self.at + size} bytes are needed")
        self.at += size
        return self.data[self.at - size : self.at]

    def array(self, kind: str, *shape: int) -> np.ndarray:
        size = int(np.prod(shape)) * np.dtype(kind).itemsize
        return np.frombuffer(self.take(size), kind).reshape(shape)

    def integer(self) -> int:
        return int(self.array("<i4", 1)[0])


def read_mdl(data: bytes) -> Mdl:
    """What `write_mdl` wrote; of skin groups the first picture. Raises ValueError where the file is cut short."""
    reader = _Reader(data)
    head = _HEADER.unpack(reader.take(_HEADER.size))
    if head[:2] != (b"IDPO", 6):
        raise ValueError(f"not an alias model of version 6: {head[0]!r} {head[1]}")
    scale, low = np.array(head[2:5]), np.array(head[5:8])
    skins, width, height, vertices, triangles, frames, sync, flags = head[12:20]
    pictures = []
    for _ in range(skins):
        count = 1
        if reader.integer():
            count = reader.integer()
            reader.take(4 * count)
        pictures.append(reader.array("u1", count, height, width)[0])
    texels = reader.array("<i4", vertices, 3)[:, 1:]
    corners = reader.array("<i4", triangles, 4)[:, [1, 3, 2]]
    poses: list[np.ndarray] = []
    named: list[Frame] = []
    for _ in range(frames):
        group = reader.integer()
        count, times = 1, np.array([0.1])
        if group:
            count = reader.integer()
            reader.take(8)
            times = reader.array("<f4", count)
        names = []
        for _ in range(count):
            reader.take(8)
            names.append(reader.take(16).split(b"\0")[0].decode("latin-1"))
            poses.append(reader.array("u1", vertices, 4))
        named.append(
            Frame(names[0], list(range(len(poses) - count, len(poses))), names if group else [], float(times[0]))
        )
    packed = np.array(poses)
    return Mdl(
        packed[..., :3] * scale + low, DIRECTIONS[packed[..., 3]], corners, texels, pictures, named, flags, bool(sync)
    )
