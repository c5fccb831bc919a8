#!/usr/bin/env python3
"""Writes thickness.exr beside this file: 32 x 32 pixels, metres.

A bowl, 2 m thick in the middle and 0 at the corners; row 4 holds NaN, row 8 holds -1, row 12 an infinity: what a broken map may.
"""
import math
import os
import struct

SIZE = 32


def thickness(x, y):
    broken = {4: math.nan, 8: -1.0, 12: math.inf}
    if y in broken:
        return broken[y]
    u, v = (x + 0.5) / SIZE * 2 - 1, (y + 0.5) / SIZE * 2 - 1
    return max(0.0, 2.0 - (u * u + v * v))


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


window = struct.pack("<iiii", 0, 0, SIZE - 1, SIZE - 1)
header = struct.pack("<ii", 20000630, 2)
header += attribute("channels", "chlist", b"Y\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) + b"\0")
header += attribute("compression", "compression", b"\0")
header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
header += attribute("lineOrder", "lineOrder", b"\0")
header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
lines = []
for row in range(SIZE):
    data = b"".join(struct.pack("<f", thickness(column, row)) for column in range(SIZE))
    lines.append(struct.pack("<ii", row, len(data)) + data)
offset = len(header) + 8 * SIZE
table = b""
for line in lines:
    table += struct.pack("<Q", offset)
    offset += len(line)
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "thickness.exr"), "wb") as file:
    file.write(header + table + b"".join(lines))
