"""Pictures as the programs' tests read and write them."""

import struct
import zlib


def read_png(path):
    """Width, height and rows of RGB bytes of an 8-bit PNG (all that the program writes)."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        (size,), kind = struct.unpack_from(">I", data, at), data[at + 4 : at + 8]
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", data, at + 8)
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += 12 + size
    raw, rows, former = zlib.decompress(packed), [], bytearray(3 * width)
    for y in range(height):
        kind, row = raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1 : (y + 1) * (3 * width + 1)])
        for i in range(len(row)):
            left, up, corner = (row[i - 3] if i > 2 else 0), former[i], (former[i - 3] if i > 2 else 0)
            nearest = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest[2])[kind]) & 255
        rows.append(bytes(row))
        former = row
    return width, height, rows


def write_png(path, width, height, color):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = (b"\0" + bytes(color) * width) * height
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_tga(path):
    """Width, height and rows of RGB bytes, top row first, of an uncompressed TGA of 24 bits."""
    data = path.read_bytes()
    width, height = struct.unpack_from("<HH", data, 12)
    if data[2] != 2 or data[16] != 24:
        raise ValueError(f"{path}: no uncompressed TGA of 24 bits")
    rows = []
    for y in range(height):
        row = bytearray(data[18 + data[0] + 3 * width * y : 18 + data[0] + 3 * width * (y + 1)])
        row[0::3], row[2::3] = row[2::3], row[0::3]
        rows.append(bytes(row))
    return width, height, rows if data[17] & 32 else rows[::-1]
