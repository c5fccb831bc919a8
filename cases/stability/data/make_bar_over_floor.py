#!/usr/bin/env python3
"""Writes bar_over_floor.exr, its camera .json and its truth .exr beside this file: a mirror floor, a wall, a bar that floats between, a post.

DeviceDepth is that of the pixels' centres, reversed, near 0.1 m, far 100 m. AveragedDepth is the mean of four samples a pixel, as a resolve of a
multisampled depth buffer leaves it: where an edge runs through a pixel it is a depth that no surface has. IndexOB is 1 on the floor; HalfIndex is 1 on
the first of each two by two pixels of the floor alone, those that a trace at half the resolution starts from.
"""
import functools
import json
import math
import os
import sys

WIDTH, HEIGHT, FOV, NEAR, FAR = 64, 48, 60.0, 0.1, 100.0
EYE, TARGET = (0.0, 1.5, 3.0), (0.0, 0.5, -2.0)
BOXES = [((0.1, 1.2, 1.0), (0.6, 0.15, 0.05)), ((-1.3, 1.0, -1.0), (0.12, 1.0, 0.12))]
HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", ".."))
import float_exr  # noqa: E402


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    return tuple(c / length for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def along(origin, direction, distance):
    return tuple(o + d * distance for o, d in zip(origin, direction))


BACK = unit(tuple(e - t for e, t in zip(EYE, TARGET)))
RIGHT = unit(cross((0.0, 1.0, 0.0), BACK))
UP = cross(BACK, RIGHT)


def meet_plane(origin, direction, axis, place, half):
    if direction[axis] == 0:
        return None
    distance = (place - origin[axis]) / direction[axis]
    point = along(origin, direction, distance)
    inside = all(abs(point[i]) <= half for i in range(3) if i != axis)
    return distance if distance > 1e-9 and inside else None


def meet_box(origin, direction, center, half):
    near, far, entered = -math.inf, math.inf, 0
    for i in range(3):
        if direction[i] == 0:
            if abs(origin[i] - center[i]) > half[i]:
                return None
            continue
        sides = sorted((center[i] + side * half[i] - origin[i]) / direction[i] for side in (-1, 1))
        if sides[0] > near:
            near, entered = sides[0], i
        far = min(far, sides[1])
    return (near, entered) if 1e-9 < near < far else None


def cast(origin, direction):
    """(distance, normal, object): 1 the floor, 2 the wall, 3 and on the boxes; None for nothing."""
    best = None
    for axis, place, half, index in ((1, 0.0, 4.0, 1), (2, -4.0, 50.0, 2)):
        distance = meet_plane(origin, direction, axis, place, half)
        if distance is not None and (best is None or distance < best[0]):
            best = (distance, tuple(1.0 if i == axis else 0.0 for i in range(3)), index)
    for number, (center, half) in enumerate(BOXES):
        hit = meet_box(origin, direction, center, half)
        if hit and (best is None or hit[0] < best[0]):
            normal = tuple(-math.copysign(1.0, direction[i]) if i == hit[1] else 0.0 for i in range(3))
            best = (hit[0], normal, 3 + number)
    return best


def look(x, y):
    slope = math.tan(math.radians(FOV / 2))
    u, v = (2 * x / WIDTH - 1) * slope * WIDTH / HEIGHT, (1 - 2 * y / HEIGHT) * slope
    return unit(tuple(u * r + v * t - b for r, t, b in zip(RIGHT, UP, BACK)))


def device_depth(x, y):
    direction = look(x, y)
    hit = cast(EYE, direction)
    if not hit:
        return 0.0
    depth = -hit[0] * dot(direction, BACK)
    return NEAR * (FAR - depth) / (depth * (FAR - NEAR))


@functools.lru_cache(None)
def pixel(x, y):
    direction = look(x + 0.5, y + 0.5)
    hit = cast(EYE, direction)
    if not hit:
        return {"Depth.Z": 1e10}
    distance, normal, index = hit
    position = along(EYE, direction, distance)
    values = {"Depth.Z": -distance * dot(direction, BACK), "IndexOB.X": float(index), "DeviceDepth.Z": device_depth(x + 0.5, y + 0.5)}
    values["HalfIndex.X"] = values["IndexOB.X"] if index != 1 or (x % 2 == 0 and y % 2 == 0) else 9.0
    values["AveragedDepth.Z"] = sum(device_depth(x + i, y + j) for i in (0.25, 0.75) for j in (0.25, 0.75)) / 4
    values.update(zip(("Position.X", "Position.Y", "Position.Z"), position))
    values.update(zip(("Normal.X", "Normal.Y", "Normal.Z"), normal))
    values.update({"Combined.R": 0.2 * index, "Combined.G": 0.5, "Combined.B": 0.1})
    if index == 1:
        mirrored = (direction[0], -direction[1], direction[2])
        found = cast(position, mirrored)
        if found:
            values.update(zip(("Truth.R", "Truth.G", "Truth.B"), (c + 64 for c in along(position, mirrored, found[0]))))
    return values


def write(name, channels):
    float_exr.write(os.path.join(HERE, name), WIDTH, HEIGHT, {
        "ViewLayer." + stored: lambda x, y, source=source: pixel(x, y).get(source, 0.0) for stored, source in channels.items()})


names = ["Combined.R", "Combined.G", "Combined.B", "Depth.Z", "DeviceDepth.Z", "AveragedDepth.Z", "IndexOB.X", "HalfIndex.X",
         "Normal.X", "Normal.Y", "Normal.Z", "Position.X", "Position.Y", "Position.Z"]
write("bar_over_floor.exr", {name: name for name in names})
write("bar_over_floor_truth.exr", {"Combined." + c: "Truth." + c for c in "RGB"})
rows = [[RIGHT[i], UP[i], BACK[i], EYE[i]] for i in range(3)] + [[0, 0, 0, 1]]
camera = {"size": [WIDTH, HEIGHT], "camera": {"eye": EYE, "target": TARGET, "fov_y_deg": FOV, "near": NEAR, "far": FAR},
          "camera_to_world_rows": rows}
with open(os.path.join(HERE, "bar_over_floor.json"), "w") as file:
    json.dump(camera, file, indent=1)
    file.write("\n")
