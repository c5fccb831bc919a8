#!/usr/bin/env python3
"""Writes thickness.exr beside this file: 32 x 32 pixels, metres.

A bowl, 2 m thick in the middle and 0 at the corners; row 4 holds NaN, row 8 holds -1, row 12 an infinity: what a broken map may.
"""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", ".."))
import float_exr  # noqa: E402

SIZE = 32


def thickness(x, y):
    broken = {4: math.nan, 8: -1.0, 12: math.inf}
    if y in broken:
        return broken[y]
    u, v = (x + 0.5) / SIZE * 2 - 1, (y + 0.5) / SIZE * 2 - 1
    return max(0.0, 2.0 - (u * u + v * v))


float_exr.write(os.path.join(HERE, "thickness.exr"), SIZE, SIZE, {"Y": thickness})
