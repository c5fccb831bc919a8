"""A second table of project/surface_pyramid.glsl: what its bounds add for rounding, means that fit best, and how far a normal is trusted; see tables.py."""
import itertools
from tables import Function, add, copyOf, mul, sub, unit, write
from tables_core import kAxes, kSlope, kViews
from tables_hooks import finerCells
from tables_project import chooseSlope, normalGradient

# Planes of cells that stray from one plane by turns, so that mostly their mean fits best; the pixels of a plane, also a far one.
kHooks = """
ivec2 tableSize = ivec2(7, 5);
ivec2 finerSurfaceSize(int level) { return tableSize; }
vec4 fetchFinerSurface(ivec2 cell, int level)
{
    int number = cell.x * 7 + cell.y * 5 + cell.x * cell.y * 3;
    ivec2 last = max(tableSize, ivec2(1)) - ivec2(1);
    vec2 center = vec2(cell.x == last.x ? 4 * cell.x + 3 : 4 * cell.x + 2, cell.y == last.y ? 4 * cell.y + 3 : 4 * cell.y + 2) * 0.5;
    vec2 strays = vec2(float(number * 3 % 11 - 5), float(number * 5 % 13 - 6)) * 0.0009765625;
    return vec4(0.5 + 0.03125 * center.x - 0.015625 * center.y, vec2(0.03125, -0.015625) + strays, 0.001953125 * float(number % 3));
}

bool tableOrthographic = false;
float tableShift = 0.0;
vec3 tableNormal = vec3(0.0);
float fetchDeviceDepth(ivec2 pixel)
{
    float affine = tableOrthographic ? tableShift - 8.0 + 0.03125 * float(pixel.x) - 0.0625 * float(pixel.y) : 0.25 + 0.00390625 * float(pixel.x) - 0.001953125 * float(pixel.y);
    return deviceDepthFromLinear(tableView(tableOrthographic, true), tableOrthographic ? -affine : 1.0 / affine);
}
vec3 fetchNormalWS(ivec2 pixel) { return tableNormal; }
"""


def cover(bx, by, ex, ey, level, g, low, high):
    """The bound allows a millionth of all that was added up: the ends, and the gradient over the pixels of the cells' sides."""
    pixels = (ex - bx + ey - by) * 2 ** level
    return [(low + high) / 2, g, (high - low) / 2 + 1e-6 * (abs(low) + abs(high) + (abs(g[0]) + abs(g[1])) * pixels)]


def strayCell(x, y, w, h):
    n = x * 7 + y * 5 + x * y * 3
    c = [(4 * x + (3 if x == w - 1 else 2)) / 2, (4 * y + (3 if y == h - 1 else 2)) / 2]
    g = [0.03125 + (n * 3 % 11 - 5) / 1024, -0.015625 + (n * 5 % 13 - 6) / 1024]
    return 0.5 + 0.03125 * c[0] - 0.015625 * c[1], g, n % 3 / 512


def reduceStray(x, y, w, h, px, py):
    """As tables_hooks.reduceSurface, over these planes."""
    w, h = max(w, 1), max(h, 1)
    columns, rows, size = finerCells(x, y, w, h)
    span = lambda c, level, count, pixels: (c << level, pixels if c >= count - 1 else (c + 1) << level)
    center = [sum(span(x, 2, size[0], px)) / 2, sum(span(y, 2, size[1], py)) / 2]
    under = [(strayCell(i, j, w, h), span(i, 1, w, px), span(j, 1, h, py)) for j in rows for i in columns]
    count = len(under)
    gradients = [[0, 0]] + [s[1] for s, _, _ in under] + [[sum(s[1][k] for s, _, _ in under) / count for k in range(2)]]
    found = []
    for g in gradients:
        ends = [affine + own[0] * (qx - sum(fx) / 2) + own[1] * (qy - sum(fy) / 2) - g[0] * (qx - center[0]) - g[1] * (qy - center[1]) + side * slack
                for (affine, own, slack), fx, fy in under for qx in fx for qy in fy for side in (-1, 1)]
        found.append([(max(ends) - min(ends)) / 2, (max(ends) + min(ends)) / 2, g])
    found.sort(key=lambda one: one[0])
    isTie = any(abs(one[0] - found[0][0]) < 4e-6 and max(abs(a - b) for a, b in zip(one[2], found[0][2])) > 1e-9 for one in found[1:])
    return None if isTie else [found[0][1], found[0][2], found[0][0]]


def affineAt(o, shift, x, y): return shift - 8 + 0.03125 * x - 0.0625 * y if o else 0.25 + 0.00390625 * x - 0.001953125 * y


def normalOf(o, x, y, a, g):
    """World space: the normal of the plane with this gradient."""
    v = [((x + 0.5) / 32 - 1) * kSlope[0], (1 - (y + 0.5) / 24) * kSlope[1]]
    scale = 1 if o else a
    n = [g[0] / (2 * kSlope[0] / 64 * scale), g[1] / (-2 * kSlope[1] / 48 * scale)]
    n.append(-1 if o else n[0] * v[0] + n[1] * v[1] - 1)
    return unit([sum(n[k] * kAxes[k][i] for k in range(3)) for i in range(3)])


def trusted(o, shift, x, y, n, error):
    """An inner pixel of the plane: both neighbours say its slope, and the normal counts as far as the tolerance goes."""
    a = affineAt(o, shift, x, y)
    inView = [sum(p * q for p, q in zip(axis, unit(n))) for axis in kAxes]
    normal = normalGradient(o, [x + 0.5, y + 0.5], 1 if o else 1 / a, inView)
    tolerance = 0.05 / 48 * (1 if o else a) + 2 * error + 1e-6 * abs(a)
    inside = [0 < x < 63, 0 < y < 47]
    g = [0.03125, -0.0625] if o else [0.00390625, -0.001953125]
    return [a, [chooseSlope(normal[k], True, g[k], inside[k], g[k], inside[k], tolerance) for k in range(2)], 0]


def surfaceTables():
    covers = [[bx, by, bx + nx, by + ny, level, g, low, high] for bx, by, nx, ny in ((2, 9, 3, 2), (4, 0, 1, 6)) for level in (0, 3) for g in ([0.5, -0.25], [-0.125, 0.75], [0, 0]) for low, high in ((-3, -3), (2, 2))]
    covers += [[0, 0, 2, 2, 1, [0, 0], low, high] for low, high in ((-1, 1), (-2, 3), (1, 4))]
    sizes = [(7, 5), (6, 4), (5, 4), (4, 5), (9, 2), (2, 7), (2, 9), (5, 5), (1, 3), (3, 1), (1, 1), (2, 2)]
    cells = [[x, y, w, h, 2 * w + 1, 2 * h + 1] for w, h in sizes for y in range(max(h // 2, 1)) for x in range(max(w // 2, 1))] + [[0, 0, 0, 0, 3, 3]]  # no cell counts as one
    # At a corner the normal alone speaks, however long it is and wherever in the pixel it is taken.
    corner = [[o, 0, x, y, mul(normalOf(o, x, y, affineAt(o, 0, x, y), mul(g, 1 if o else affineAt(o, 0, x, y))), s), 0]
              for o in (0, 1) for x, y in ((0, 0), (63, 47)) for g, s in itertools.product(([0.02, 0.01], [-0.03, 0.02], [0.01, -0.04]), (1, 1e-9, 3e9))]
    # Near the ends of what the tolerance takes in: a plane's slope, and a twelfth more or less of a part of it.
    ends = []
    for o, shift, x, y, error in ((0, 0, 20, 20, 0), (0, 0, 40, 10, 0.0009765625), (1, 0, 20, 20, 0), (1, 0, 40, 10, 0.0009765625), (1, -50, 20, 20, 0)):
        a = affineAt(o, shift, x, y)
        slope = [0.03125, -0.0625] if o else [0.00390625, -0.001953125]
        base = 0.05 / 48 * (1 if o else a)
        far = 1e-6 * abs(a)
        reaches = [base + far / 2] if shift else [0.9 * base, 1.12 * base] if not error else [base + 1.9 * error, base + 2.2 * error]
        for reach, sx, sy in itertools.product(reaches, (-1, 0, 1), (-1, 0, 1)):
            ends.append([o, shift, x, y, normalOf(o, x, y, a, add(slope, [sx * reach, sy * reach])), error])
    build = "tableOrthographic = o;\ntableShift = shift;\ntableNormal = n;\nvec4 c = buildSurfacePixel(tableView(o, true), ivec2(x, y), e);"
    write("surface_cells", "A bound allows for rounding what its terms add up to, a mean of planes is taken where it fits best, and a normal counts within a tolerance.", [
        Function("Cover", "bx:i by:i ex:i ey:i l:i g:2 low:1 high:1", ["c.affineDepth", "c.gradient.x", "c.gradient.y", "c.slack"], covers, cover,
                 "SurfaceCell c = makeCover(FinerCells(CellRect(ivec2(bx, by), ivec2(ex, ey)), ivec2(64), l, ivec2(512), vec2(0.0)), g, SurfaceRange(low, high));", relative=1e-5, absolute=1e-10),
        Function("Reduce", "x:i y:i w:i h:i px:i py:i", ["c.x", "c.y", "c.z", "c.w"], [row for row in cells if reduceStray(*row)], reduceStray,
                 "tableSize = ivec2(w, h);\nvec4 c = reduceSurfaceCell(ivec2(x, y), 1, ivec2(px, py));", absolute=4e-6),
        # Borders that powers of two meet exactly: the tolerance's ends belong to it, a slope and its double agree, of two as flat the second is taken.
        Function("SlopeEnds", "n:1 h:b l:1 r:1 t:1", ["chooseSlope(n, h, NeighborRise(-l, true), NeighborRise(r, true), t)"],
                 [[0.125, 1, 0.25, 0.5, 0.125], [0.625, 1, 0.25, 0.5, 0.125], [0.625, 1, 0.5, 0.25, 0.125], [0, 0, 0.25, 0.5, 0.125], [0, 0, -0.25, -0.5, 0.0625], [0, 0, -0.5, -0.25, 0.0625],
                  [0, 0, 0.0625, -0.0625, 0.25], [0, 0, -0.5, 0.5, 0.125]],
                 lambda n, h, left, right, t: [chooseSlope(n, h, left, True, right, True, t)], absolute=0),
        Function("EdgeOn", "n:3", ["g.x", "g.y"], [[[0.6, 0.8, 0]]], lambda n: [-n[k] * [0.025, -1 / 48][k] * 0.25 / 1e-6 for k in range(2)],
                 "vec2 g = computeNormalGradient(tableView(false, true), vec2(32.0, 24.0), 0.25, n);", relative=4e-5),
        Function("Corner", "o:b shift:1 x:i y:i n:3 e:1", ["c.x", "c.y", "c.z", "c.w"], corner, trusted, build, relative=4e-5, absolute=1e-6),
        Function("Trusted", "o:b shift:1 x:i y:i n:3 e:1", ["c.x", "c.y", "c.z", "c.w"], ends, trusted, build, relative=1e-3, absolute=3e-5),
    ], [], kViews + copyOf("crossray/project/surface_pyramid.glsl", ["CROSSRAY_BUILD_SURFACE_PYRAMID"]) + kHooks)


def make():
    surfaceTables()
