#!/usr/bin/env python3
"""Writes bent_normals.exr and bent_normals.json beside this file: a G-buffer whose normals no geometry has.

A wall 5 m in front of the eye. Object 1 (columns 0 to 15): the normal leaves the direction to the eye by 60 to 170 degrees, as normal
maps do, and its length is 0.5, 1 or 2. Object 2 (columns 16 to 19): the normal is 0. Columns 20 to 23: nothing.
"""
import json
import math
import os
import sys

WIDTH, HEIGHT, FOV, DEPTH = 24, 16, 60.0, 5.0
HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", ".."))
import float_exr  # noqa: E402


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def pixel(x, y):
    slope = math.tan(math.radians(FOV / 2))
    u = (2 * (x + 0.5) / WIDTH - 1) * slope * WIDTH / HEIGHT
    v = (1 - 2 * (y + 0.5) / HEIGHT) * slope
    if x >= 20:
        return {"Depth.Z": 1e10}
    position = [u * DEPTH, v * DEPTH, -DEPTH]
    values = {"Depth.Z": DEPTH, "IndexOB.X": 1.0 if x < 16 else 2.0}
    values.update(zip(("Position.X", "Position.Y", "Position.Z"), position))
    values.update({"Combined.R": 0.5, "Combined.G": 0.25, "Combined.B": 0.125})
    if x < 16:
        to_eye = unit([-c for c in position])
        side = unit(cross(to_eye, [0.3, 1.0, 0.2]))
        other = cross(to_eye, side)
        turn = 2 * math.pi * y / HEIGHT
        angle = math.radians(60 + 110 * x / 15)
        length = (0.5, 1.0, 2.0)[y % 3]
        normal = [length * (math.cos(angle) * e + math.sin(angle) * (math.cos(turn) * s + math.sin(turn) * o))
                  for e, s, o in zip(to_eye, side, other)]
        values.update(zip(("Normal.X", "Normal.Y", "Normal.Z"), normal))
    return values


names = ["Combined.R", "Combined.G", "Combined.B", "Depth.Z", "IndexOB.X", "Normal.X", "Normal.Y", "Normal.Z",
         "Position.X", "Position.Y", "Position.Z"]
float_exr.write(os.path.join(HERE, "bent_normals.exr"), WIDTH, HEIGHT, {
    "ViewLayer." + name: lambda x, y, name=name: pixel(x, y).get(name, 0.0) for name in names})
camera = {
    "size": [WIDTH, HEIGHT],
    "camera": {"eye": [0, 0, 0], "target": [0, 0, -1], "fov_y_deg": FOV, "near": 0.1, "far": 100},
    "camera_to_world_rows": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
}
with open(os.path.join(HERE, "bent_normals.json"), "w") as file:
    json.dump(camera, file, indent=1)
    file.write("\n")
