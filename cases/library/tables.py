#!/usr/bin/env python3
"""Makes cases/library/*.toml, *.glsl and data/*: functions of the shader library on tables of inputs, each held to a closed form that is
written here once more, in doubles, from what the function's comment promises.

A table is a G-buffer: row by row, its normals from column 1 on hold the inputs and the expected answers, three to a pixel; column 0 alone
sends a ray, and its own tracer (docs/own-tracer.md) asks the function of that row.
"""
import importlib
import json
import math
import os
import re
import struct
import sys

sys.dont_write_bytecode = True
kHere = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(kHere, ".."))
import float_exr  # noqa: E402

kNaN = float("nan")
kInf = float("inf")


def single(x):
    """The float nearest to x."""
    return struct.unpack("<f", struct.pack("<f", x))[0] if abs(x) < 3e38 else x


def flat(values):
    found = []
    for value in values if isinstance(values, (list, tuple)) else [values]:
        found += flat(value) if isinstance(value, (list, tuple)) else [float(value)]
    return found


class Function:
    """`inputs`: "name:kind ..." with the kinds 1 to 4 (floats), i, b; `body`: GLSL that computes `outs`, floats. `model` answers the same
    numbers for the inputs, vectors as lists. A row is right within `relative` of the expected magnitude or within `absolute`."""

    def __init__(self, name, inputs, outs, rows, model, body="", relative=1e-5, absolute=1e-6, vulkanRows=()):
        self.name, self.outs, self.body = name, outs, body
        self.inputs = [part.split(":") for part in inputs.split()]
        self.relative, self.absolute, self.model, self.vulkanRows = relative, absolute, model, vulkanRows
        self.setRows(rows)

    def setRows(self, rows):
        model, name, outs = self.model, self.name, self.outs
        self.ins, self.expected = [], []
        for row in rows:
            numbers = [single(x) for x in flat(row)]
            self.ins.append(numbers)
            self.expected.append([float(x) for x in flat(model(*self.arguments(numbers)))])
            assert len(self.expected[-1]) == len(outs), (name, row, self.expected[-1])

    def arguments(self, numbers):
        found, at = [], 0
        for _, kind in self.inputs:
            count = int(kind) if kind.isdigit() else 1
            part = numbers[at:at + count]
            at += count
            found.append(bool(part[0]) if kind == "b" else int(part[0]) if kind == "i" else part[0] if count == 1 else part)
        assert at == len(numbers), (self.name, numbers)
        return found

    def glsl(self, number):
        width = len(self.ins[0])
        cell = lambda k: f"d{k // 3}.{'xyz'[k % 3]}"
        text = f"void check{self.name}(int tableRow)\n{{\n"
        text += "".join(f"    vec3 d{k} = ownNormalWS(ivec2({k + 1}, tableRow));\n" for k in range((width + len(self.outs) + 2) // 3))
        at = 0
        for name, kind in self.inputs:
            count = int(kind) if kind.isdigit() else 1
            parts = ", ".join(cell(at + k) for k in range(count))
            kinds = {"i": f"int {name} = int({parts});", "b": f"bool {name} = {parts} > 0.5;", "1": f"float {name} = {parts};"}
            text += "    " + kinds.get(kind, f"vec{kind} {name} = vec{kind}({parts});") + "\n"
            at += count
        text += "".join(f"    {line}\n" for line in self.body.strip().splitlines())
        for k, out in enumerate(self.outs):
            text += f"    check({number * 100 + k + 1}, {out}, {cell(width + k)}, {self.relative}, {self.absolute});\n"
        return text + "}\n"


kPreamble = """
int wrongCheck = 0; // function * 100 + output, from 1, of the first wrong answer; what it was, and what was expected
vec2 wrongAnswer = vec2(0.0);

void check(int which, float answer, float expected, float relative, float absolute)
{
    bool isRight = abs(answer - expected) <= max(absolute, relative * abs(expected)); // false for a NaN
    bool isFirst = !isRight && wrongCheck == 0;
    wrongCheck = isFirst ? which : wrongCheck;
    wrongAnswer = isFirst ? vec2(answer, expected) : wrongAnswer;
}

float number(bool condition) { return condition ? 1.0 : 0.0; }
"""


def copyOf(include, defines=()):
    """The file once more, under other names, so that its hooks are the table's own functions: their prototypes are renamed with it."""
    with open(os.path.join(kHere, "..", "..", "shaders", include)) as file:
        text = file.read()
    names = re.findall(r"^(?:const )?\w+ (\w+)(?:\(| = )", text, re.M) + re.findall(r"^struct (\w+)", text, re.M)
    guard = re.search(r"#ifndef (\w+)", text).group(1)
    lines = [f"#define {name} copyOf_{name}" for name in dict.fromkeys(names)] + [f"#define {name}" for name in defines]
    return "\n".join(lines + [f"#undef {guard}", f'#include "{include}"']) + "\n"


def writeData(name, functions):
    rows = [a + b for function in functions for a, b in zip(function.ins, function.expected)]
    width = 1 + (max(len(row) for row in rows) + 2) // 3

    def normal(channel):
        def at(x, y):
            if x == 0:
                return 1.0 if channel == 2 else 0.0  # towards the eye
            place = (x - 1) * 3 + channel
            return rows[y][place] if place < len(rows[y]) else 0.0
        return at
    planes = {"Combined." + c: lambda x, y: 0.0 for c in "RGB"}
    planes |= {"Depth.Z": lambda x, y: 4.0, "IndexOB.X": lambda x, y: 1.0 if x == 0 else 2.0}
    planes |= {"Normal." + c: normal(k) for k, c in enumerate("XYZ")}
    os.makedirs(os.path.join(kHere, "data"), exist_ok=True)
    float_exr.write(os.path.join(kHere, "data", name + ".exr"), width, len(rows), {"ViewLayer." + k: f for k, f in planes.items()}, compress=True)
    camera = {"size": [width, len(rows)], "camera": {"eye": [0, 0, 0], "target": [0, 0, -1], "fov_y_deg": 60, "near": 0.1, "far": 100},
              "camera_to_world_rows": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}
    with open(os.path.join(kHere, "data", name + ".json"), "w") as file:
        json.dump(camera, file, indent=1)
        file.write("\n")


def write(name, summary, functions, includes=(), preamble=""):
    """One case, and one for Vulkan alone where a function has rows for it. HitDepth is 0 where the row's answer is right."""
    writeCase(name, summary, functions, includes, preamble)
    functions = [function for function in functions if function.vulkanRows]
    for function in functions:
        function.setRows(function.vulkanRows)
    if functions:
        writeCase(name + "_vulkan", "On Vulkan what is no number is answered as it is promised, also where compilers of GLSL turn comparisons round.", functions, includes,
                  preamble, 'backends = ["lavapipe", "swiftshader"]\n')


def writeCase(name, summary, functions, includes, preamble, more=""):
    writeData(name, functions)
    text = "// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth\n"
    text += "// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.\n"
    text += "".join(f'#include "{include}"\n' for include in includes) + kPreamble + preamble + "\n"
    text += "\n".join(function.glsl(k) for k, function in enumerate(functions))
    text += "\nOwnHit traceOwn(OwnRay ray)\n{\n    int row = ray.pixel.y;\n"
    first = 0
    for function in functions:
        last = first + len(function.ins) - 1
        text += f"    if (row >= {first} && row <= {last}) check{function.name}(row);\n"
        first = last + 1
    text += "    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));\n}\n"
    with open(os.path.join(kHere, name + ".glsl"), "w") as file:
        file.write(text)
    with open(os.path.join(kHere, name + ".toml"), "w") as file:
        file.write(f"""schema  = 1
name    = "library/{name}"
summary = "{summary}"
tags    = ["library", "own"]
use     = ["table"]
{more}
[gbuffer]
file   = "data/{name}.exr"
camera = "data/{name}.json"
object = 1

[projection]
model  = "own"
tracer = "{name}.glsl"
""")


# Vectors.
def add(a, b): return [x + y for x, y in zip(a, b)]
def sub(a, b): return [x - y for x, y in zip(a, b)]
def mul(a, s): return [x * s for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def length(a): return math.sqrt(dot(a, a))
kLimit, kShortest, kLongest = single(1e37), single(1e-30), single(1e30)


def isNumber(*values): return all(abs(x) < kLimit for x in flat(values))


def unit(v, fallback=(0.0, 0.0, 0.0)):
    size = sum(abs(x) for x in v)
    if not kShortest < size < kLongest:
        return list(fallback)
    scaled = [x / size for x in v]
    return mul(scaled, 1 / length(scaled))


def isTowards(v): return length(unit(v)) > 0.5


def clamp01(x):
    return min(x, 1.0) if x > 0 else 0.0


def smooth(x):
    t = clamp01(x)
    return t * t * (3 - 2 * t)


if __name__ == "__main__":
    for name in sorted(os.listdir(kHere)):
        if re.fullmatch(r"tables_\w+\.py", name):
            part = importlib.import_module(name[:-3])
            if hasattr(part, "make"):
                part.make()
