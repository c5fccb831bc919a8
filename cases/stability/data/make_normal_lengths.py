#!/usr/bin/env python3
"""Writes normal_lengths.exr and normal_lengths.json beside this file: a G-buffer whose normals are right in direction and of any length.

A wall 5 m in front of the eye, turned by 30 degrees as far as its normals go. Column by column they are 1e-25 to 1e25 long: the squares of the
outer ones are 0 or infinite in floats.
"""
import json
import math
import os
import sys

LENGTHS = (1e-25, 1e-20, 1e-15, 1e-5, 1.0, 1e5, 1e15, 1e19, 1e20, 1e25)
WIDTH, HEIGHT, FOV, DEPTH = len(LENGTHS), 8, 60.0, 5.0
HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", ".."))
import float_exr  # noqa: E402


def pixel(x, y):
    slope = math.tan(math.radians(FOV / 2))
    u = (2 * (x + 0.5) / WIDTH - 1) * slope * WIDTH / HEIGHT
    v = (1 - 2 * (y + 0.5) / HEIGHT) * slope
    normal = [LENGTHS[x] * c for c in (math.sin(math.radians(30)), 0.0, math.cos(math.radians(30)))]
    values = {"Depth.Z": DEPTH, "IndexOB.X": 1.0, "Combined.R": 0.5, "Combined.G": 0.25, "Combined.B": 0.125}
    values.update(zip(("Position.X", "Position.Y", "Position.Z"), (u * DEPTH, v * DEPTH, -DEPTH)))
    values.update(zip(("Normal.X", "Normal.Y", "Normal.Z"), normal))
    return values


names = ["Combined.R", "Combined.G", "Combined.B", "Depth.Z", "IndexOB.X", "Normal.X", "Normal.Y", "Normal.Z",
         "Position.X", "Position.Y", "Position.Z"]
float_exr.write(os.path.join(HERE, "normal_lengths.exr"), WIDTH, HEIGHT, {
    "ViewLayer." + name: lambda x, y, name=name: pixel(x, y).get(name, 0.0) for name in names})
camera = {
    "size": [WIDTH, HEIGHT],
    "camera": {"eye": [0, 0, 0], "target": [0, 0, -1], "fov_y_deg": FOV, "near": 0.1, "far": 100},
    "camera_to_world_rows": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
}
with open(os.path.join(HERE, "normal_lengths.json"), "w") as file:
    json.dump(camera, file, indent=1)
    file.write("\n")
