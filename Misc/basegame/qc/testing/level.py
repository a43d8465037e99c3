"""A small level for tests: one room with a pool, and boxes that move; no faces, for nobody looks at it.

The room reaches from ROOM_LOW to ROOM_HIGH. West of x = POOL_EAST a liquid stands below z = POOL_TOP: water in the south
(y < POOL_SLIME), slime, and lava in the north (y > POOL_LAVA). Brush models are boxes, solid throughout, as doors are.
Quake's level format, version 29; distances in units.
"""

import struct

Box = tuple[tuple[int, int, int], tuple[int, int, int]]  # lowest corner, highest corner

ROOM_LOW, ROOM_HIGH = (-1024, -1024, -256), (1024, 1024, 1024)
POOL_EAST, POOL_TOP, POOL_SLIME, POOL_LAVA = -512, 0, -256, 256
EMPTY, SOLID, WATER, SLIME, LAVA = -1, -2, -3, -4, -5
# The three sizes of things that traces know: a point, players, large monsters.
HULLS = [((0, 0, 0), (0, 0, 0)), ((-16, -16, -24), (16, 16, 32)), ((-32, -32, -24), (32, 32, 64))]
LUMPS = 15


class _Tree:
    """Planes, nodes, leafs and clip nodes as they are met."""

    def __init__(self) -> None:
        self.planes: list[bytes] = []
        self.nodes: list[bytes] = []
        self.leafs = [struct.pack("<ii6hHH4B", SOLID, -1, *[0] * 6, 0, 0, 0, 0, 0, 0)]
        self.clips: list[bytes] = []

    def plane(self, axis: int, distance: float) -> int:
        normal = [0.0] * 3
        normal[axis] = 1.0
        self.planes.append(struct.pack("<3ffi", *normal, distance, axis))
        return len(self.planes) - 1

    def leaf(self, contents: int) -> int:
        """The child number of a leaf; all that is solid shares the first."""
        if contents == SOLID:
            return -1
        self.leafs.append(struct.pack("<ii6hHH4B", contents, -1, *ROOM_LOW, *ROOM_HIGH, 0, 0, 0, 0, 0, 0))
        return -len(self.leafs)

    def node(self, axis: int, distance: float, front, back) -> int:
        """front and back: functions that make what is beyond and below the plane, or contents."""
        number = len(self.nodes)
        self.nodes.append(b"")
        children = [side() if callable(side) else self.leaf(side) for side in (front, back)]
        self.nodes[number] = struct.pack("<i2h6hHH", self.plane(axis, distance), *children, *ROOM_LOW, *ROOM_HIGH, 0, 0)
        return number

    def clip(self, axis: int, distance: float, front, back) -> int:
        number = len(self.clips)
        self.clips.append(b"")
        children = [side() if callable(side) else side for side in (front, back)]
        self.clips[number] = struct.pack("<i2h", self.plane(axis, distance), *children)
        return number

    def box(self, make, low, high, outside: int, inside) -> int:
        """Cuts off what is outside, side by side; `make` is node or clip, `inside` contents or what makes them."""

        def side(i: int):
            axis = i // 2
            rest = inside if i == 5 else lambda: side(i + 1)
            if i % 2 == 0:
                return make(axis, high[axis], outside, rest)
            return make(axis, low[axis], rest, outside)

        return side(0)


def _pool(tree: _Tree):
    def liquid() -> int:
        return tree.node(1, POOL_LAVA, LAVA, lambda: tree.node(1, POOL_SLIME, SLIME, WATER))

    return tree.node(0, POOL_EAST, EMPTY, lambda: tree.node(2, POOL_TOP, EMPTY, liquid))


def _model(low, high, heads, leafs: int) -> bytes:
    # Engines make a model's box a unit larger on each side, and compilers of maps know it.
    low, high = [c + 1 for c in low], [c - 1 for c in high]
    return struct.pack("<9f7i", *low, *high, 0, 0, 0, *heads, leafs, 0, 0)


def write_level(entities: list[dict[str, str]], boxes: list[Box]) -> bytes:
    """A .bsp of the room; boxes are models *1, *2 ..., entities get a worldspawn in front where they have none."""
    tree = _Tree()
    heads = [tree.box(tree.node, ROOM_LOW, ROOM_HIGH, SOLID, lambda: _pool(tree))]
    for low, high in HULLS[1:]:
        inner_low = [r - h for r, h in zip(ROOM_LOW, low)]
        inner_high = [r - h for r, h in zip(ROOM_HIGH, high)]
        heads.append(tree.box(tree.clip, inner_low, inner_high, SOLID, EMPTY))
    models = [_model(ROOM_LOW, ROOM_HIGH, [*heads, 0], len(tree.leafs) - 1)]
    for box_low, box_high in boxes:
        heads = [tree.box(tree.node, box_low, box_high, EMPTY, SOLID)]
        for low, high in HULLS[1:]:
            outer_low = [b - h for b, h in zip(box_low, high)]
            outer_high = [b - h for b, h in zip(box_high, low)]
            heads.append(tree.box(tree.clip, outer_low, outer_high, EMPTY, SOLID))
        models.append(_model(box_low, box_high, [*heads, 0], 0))
    if not entities or entities[0].get("classname") != "worldspawn":
        entities = [{"classname": "worldspawn"}, *entities]
    text = "".join("{\n" + "".join(f'"{k}" "{v}"\n' for k, v in e.items()) + "}\n" for e in entities)
    lumps = {
        0: text.encode("latin-1") + b"\0",
        1: b"".join(tree.planes),
        2: struct.pack("<i", 0),
        5: b"".join(tree.nodes),
    }
    lumps |= {9: b"".join(tree.clips), 10: b"".join(tree.leafs), 14: b"".join(models)}
    return _file(lumps)


def _file(lumps: dict[int, bytes]) -> bytes:
    place = 4 + 8 * LUMPS
    header, body = struct.pack("<i", 29), b""
    for i in range(LUMPS):
        data = lumps.get(i, b"")
        header += struct.pack("<ii", place + len(body), len(data))
        body += data + b"\0" * (-len(data) % 4)
    return header + body
