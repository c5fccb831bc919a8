"""Tables of project/screen_ray, the pure parts of the pyramids, probe/cubemap, probe/planar and probe/urp; see tables.py."""
import math
from tables import Function, add, clamp01, dot, flat, isNumber, kInf, kNaN, length, mul, sub, unit, write
from tables_core import (awayFromZero, deviceOf, fromView, isCleared, kAxes, kDegenerateRay, kEye, kFar, kNear, kSize, kSlope, kViews, linearOf, safeDivide,
                         toView, toViewDir)


def isTowards(v): return length(unit(v)) > 0.5


# ------------------------------------------------------------------------------------------- project/screen_ray.glsl

def screenRay(ortho, origin, direction):
    """The end by the first of the near plane, the far plane and 65504 m; two projections instead of a difference that does not cancel."""
    d, o = unit(toViewDir(direction)), toView(origin)
    none = [0, 0, 1e-20, 1e-20, 1e20, -1 if ortho else 1, 0, 7]
    if not isTowards(d) or not isNumber(o):
        return none + [kDegenerateRay]
    z, rate = -o[2], -d[2]
    far = 65504.0
    toNear = (kNear - z) / rate if rate < 0 else far
    toFar = (kFar - z) / rate if rate > 0 else far
    reason = 4 if toNear < toFar and toNear < far else 7
    none[7] = reason
    if toNear <= 0 or not z > 0:
        return none + [4]
    if toFar <= 0:
        return none + [7]
    s = min(far, toNear, toFar)
    end = add(o, mul(d, s))
    affine = (lambda x: -x) if ortho else (lambda x: 1 / x)
    place = lambda v: [(v[0] / (kSlope[0] * (1 if ortho else -v[2])) + 1) / 2 * kSize[0], (1 - v[1] / (kSlope[1] * (1 if ortho else -v[2]))) / 2 * kSize[1]]
    a, b = place(o), place(end)
    delta = [awayFromZero(x, 1e-20) for x in sub(b, a)]
    return [a, delta, 1 / max(abs(x) for x in delta), affine(z), affine(-end[2]) - affine(z), reason, 0]


def pixelAt(start, delta, first, s, inclusive):
    """By walking border after border."""
    if delta == 0:
        return first
    step = 1 if delta > 0 else -1
    pixel = first
    for _ in range(200):
        border = (pixel + 1 if step > 0 else pixel) - start
        t = border / delta
        if not (t <= s if inclusive else t < s):
            break
        pixel += step
    return pixel


def screenRayTables():
    at = lambda x, y, z: fromView([x, y, -z])
    turn = lambda x, y, z: sub(fromView([x, y, z]), kEye)
    rays = [([0.3, -0.2, 2], [1, 0.5, -1]), ([0.3, -0.2, 2], [-0.5, 1, 0.25]), ([1, 1, 8], [0.2, -0.3, 1]), ([-2, 1, 20], [0.1, 0.2, -1]), ([0, 0, 3], [0, 0, -1]), ([0, 0, 3], [0, 0, 1]),
            ([0.5, 0.25, 4], [1, 0, 0]), ([0.5, 0.25, 4], [0, -1, 0]), ([1, -1, 63], [0.3, 0.1, -0.05]), ([0.2, 0.1, 0.6], [0.1, 0.1, 1]), ([-0.4, 0.3, 2], [1, -1, 1e-3])]
    edges = [([0.1, 0.1, 0.25], [0, 0.2, 1]), ([0.1, 0.1, 0.25], [0, 0.2, -1]), ([0.1, 0.1, 70], [0, 0.2, -1]), ([0.1, 0.1, 70], [0, 0.2, 1]), ([0, 0, -1], [0, 0.2, -1]), ([0, 0, -1], [0, 0.2, 1]),
             ([0, 0, 80], [1, 0.5, 0]), ([0, 0, 0.25], [1, 0.5, 0])]
    rows = [[o, at(*p), turn(*d)] for o in (0, 1) for p, d in rays + edges]
    rows += [[o, p, d] for o in (0, 1) for p, d in (([kNaN, 0, 0], [1, 0, 0]), ([0, 0, 0], [0, 0, 0]), ([0, 0, 0], [kNaN, 0, 1]), ([0, 3, 0], [0, kInf, 0]))]

    def depths(o, z):
        return [-z if o else 1 / max(z, 1e-30), -z if o else 1 / max(z, 1e-30)]
    walks = [[a, d, int(math.floor(a)), s, i] for a, d in ((2.5, 7.25), (7.75, -5.5), (3.0, 4.0), (6.0, -4.0), (1.25, 0.5), (5.5, 0.0), (8.5, -9.0), (40.5, 20.0), (8.25, -0.125), (2.75, 1.0))
             for s in (0.0, 0.1, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0) for i in (0, 1)]
    walks += [[a, d, f, s, i] for a, d, f in ((2.5, 7.25, 4), (7.75, -5.5, 5)) for s in (0.0, 0.2, 0.6, 1.0) for i in (0, 1)]
    walks = [row for row in walks if row[1] == 0 or abs((row[0] + row[1] * row[3]) % 1 - 0.5) < 0.499 or row[3] in (0.0, 0.25, 0.5, 1.0)]

    def walked(a, d, f, s, i):
        return [pixelAt(a, d, f, s, i)]
    out = ["r.startSS.x", "r.startSS.y", "r.deltaSS.x", "r.deltaSS.y", "r.pixelLength", "r.startAffineDepth", "r.deltaAffineDepth", "float(r.endReason)", "float(r.status)"]
    plain = [row for row in rows if screenRay(*row)[-1] == 0 and min(abs(x) for x in flat(screenRay(*row))[2:4]) > 1e-3]
    odd = [row for row in rows if screenRay(*row)[-1] != 0]
    write("screen_ray", "A ray's way over the screen is the line between the projections of its ends, and pixels follow one another as its borders do.", [
        Function("ScreenRay", "o:b p:3 d:3", out, plain, screenRay, "ScreenRay r = makeScreenRay(tableView(o, true), p, d);", relative=1e-4, absolute=2e-5),
        Function("NoRay", "o:b p:3 d:3", out[:2] + out[5:7] + out[8:], odd, lambda *row: [flat(screenRay(*row))[k] for k in (0, 1, 5, 6, 8)],
                 "ScreenRay r = makeScreenRay(tableView(o, true), p, d);"),
        Function("Frame", "o:b", ["float(f.imageSize.x)", "float(f.imageSize.y)", "f.footprint", "number(f.orthographic)"], [[0], [1]],
                 lambda o: [64, 48, 2 * 0.5 / 48, o], "ScreenFrame f = makeScreenFrame(tableView(o, true));"),
        Function("Affine", "o:b z:1", ["affineDepthFromLinear(o, z)", "linearDepthFromAffine(o, z)"], [[o, z] for o in (0, 1) for z in (1, 4, 0.125, 0, -2, 1e-29, 1e-31, 1e29)], depths),
        Function("At", "s:1", ["screenRayPositionSS(r, s).x", "screenRayPositionSS(r, s).y", "screenRayAffineDepth(r, s)"], [[s] for s in (0, 0.25, 1, 1.5)],
                 lambda s: [3 + 10 * s, 5 - 4 * s, 0.5 + 0.25 * s], "ScreenRay r = ScreenRay(vec2(3.0, 5.0), vec2(10.0, -4.0), 0.1, 0.5, 0.25, 0, 0);"),
        Function("Border", "a:1 d:1 b:i", ["borderTime(a, d, b)", "float(entryBorder(b, d))", "float(exitBorder(b, d))"],
                 [[a, d, b] for a in (2.5, 7) for d in (4, -2, 0.5, 0, -0.25) for b in (0, 3, 9)],
                 lambda a, d, b: [1e30 if d == 0 else (b - a) / d, b if d > 0 else b + 1, b + 1 if d > 0 else b]),
        Function("PixelAt", "a:1 d:1 f:i s:1 i:b", ["float(pixelAt(a, d, f, s, i))"], walks, walked, absolute=0),
    ], ["crossray/project/screen_ray.glsl"], kViews)


# --------------------------------------------------------------- the pure parts of project/*_pyramid, depth_patch, linear

def difference(o, first, second, a, b):
    sky = [not x < 0.5e30 for x in (first, second)]
    affine = lambda z: -z if o else 1 / max(z, 1e-30)
    if any(sky):
        return [0, 0]
    rise = affine(second) - affine(first)
    return [rise / max(b[1] - a[1] if rise > 0 else b[0] - a[0], 1), 1]


def agree(a, b, bend):
    flatter = min(abs(a), abs(b)) if a * b > 0 else 0
    return abs(a - b) <= max(bend, flatter) * (1 + 1 / 256)


def chooseSlope(n, has, left, knowsLeft, right, knowsRight, tolerance):
    """left and right: the slope on that side."""
    if not (knowsLeft and knowsRight):
        return n if has else left if knowsLeft else right if knowsRight else 0
    if has and min(left, right) - tolerance <= n <= max(left, right) + tolerance:
        return n
    same = min(abs(left), abs(right)) if left * right > 0 else 0
    if abs(left - right) <= max(tolerance, same):
        return (left + right) / 2
    return left if abs(left) < abs(right) else right


def normalGradient(o, ss, z, n):
    """The change of affine depth over a pixel, by the plane's own equation: u and v a pixel to the right and a pixel down."""
    n = unit(n)
    x = [(ss[0] / 64 * 2 - 1) * kSlope[0], (1 - ss[1] / 48 * 2) * kSlope[1]]
    facing = n[2] if o else -(n[0] * x[0] + n[1] * x[1] - n[2])
    facing = max(abs(facing), 1e-6) * (1 if facing >= 0 else -1)
    step = [2 * kSlope[0] / 64, -2 * kSlope[1] / 48]
    affine = 1 if o else 1 / z
    # 1/depth = (n.x u + n.y v - n.z) / (n . P), with n . P = -depth * facing.
    return [-(n[k] * step[k]) * affine / facing for k in range(2)]


def pyramidTables():
    def cell(c, level, cells, pixels): return [c << level, pixels if c >= cells - 1 else (c + 1) << level]
    rects = [[x, y, l, 5, 3, 43, 27] for l in (0, 1, 3) for x, y in ((0, 0), (3, 1), (4, 2), (4, 0), (0, 2), (6, 3))]
    gradients = [[o, ss, z, unit(n)] for o in (0, 1) for ss in ([32, 24], [10, 40], [60, 5]) for z in (1, 4) for n in ([0, 0, 1], [1, 2, 3], [-2, 0.5, 1], [0.3, -0.4, -2], [3, -1, 0.5])]
    facing = [row for row in gradients if abs(normalGradient(*row)[0]) < 1e3]
    slopes = [[n, h, l, a, r, b, t] for n in (0.5, 0.2, -0.4, 0.31, 0.0) for h in (0, 1) for l, r in ((0.3, 0.4), (0.1, 0.5), (-0.2, 0.3), (0.3, 0.3), (0.4, 0.9), (0.5, 0.05)) for a in (0, 1) for b in (0, 1)
              for t in (0.02, 0.15)]
    slopes = [row for row in slopes if all(abs(row[0] - x) > 1e-6 for x in (row[2] - row[6], row[2] + row[6], row[4] + row[6], row[4] - row[6]))]
    sizes = [[w, h, l] for w, h in ((64, 48), (43, 27), (1, 1), (0, 5), (7, 300)) for l in (-1, 0, 1, 3, 9, 40)]
    linear = lambda s, n, end, length: end / max(n, 1) if n > 0 else (min(max(s, 0.001), 65536.0) if s > 0 else 1) * length

    def end(start, delta):
        times = [((0 if d < 0 else k) - a) / d for a, d, k in zip(start, delta, kSize)]
        return min(max(min(times), 0), 1)
    write("pyramids", "Cells, spans, slopes and levels of the pyramids are those of the pixels that they cover.", [
        Function("CellRect", "x:i y:i l:i cx:i cy:i px:i py:i", ["float(r.begin.x)", "float(r.begin.y)", "float(r.end.x)", "float(r.end.y)", "c.x", "c.y", "float(s.begin)", "float(s.end)"], rects,
                 lambda x, y, l, cx, cy, px, py: (lambda a, b: [a[0], b[0], a[1], b[1], (a[0] + a[1]) / 2, (b[0] + b[1]) / 2, a])(cell(x, l, cx, px), cell(y, l, cy, py)),
                 "CellRect r = computeCellRect(ivec2(x, y), l, ivec2(cx, cy), ivec2(px, py));\nvec2 c = computeRectCenter(r);\nCellSpan s = computeCellSpan(x, l, cx, px);", absolute=0),
        Function("Surface", "c:4 a:2 b:2", ["u.affineDepth", "u.gradient.x", "u.gradient.y", "u.slack", "number(isSky(u))", "packSurfaceCell(u).z", "surfaceAffineDepth(u, a, b)"],
                 [[[0.5, 0.1, -0.2, s], [3, 4], [5, 1]] for s in (0, 0.25, -1, 1)], lambda c, a, b: [c, c[3] < 0, c[2], c[0] + c[1] * (b[0] - a[0]) + c[2] * (b[1] - a[1])],
                 "SurfaceCell u = unpackSurfaceCell(c);"),
        Function("Sky", "o:b", ["makeSkySurface(v).affineDepth", "makeSkySurface(v).gradient.x", "makeSkySurface(v).slack", "computeFootprint(v, 0.25)", "makeDepthPyramidTexel(v, 0.0).x",
                 "makeDepthPyramidTexel(v, 0.0).y"], [[0], [1]], lambda o: [-128 if o else 0, 0, -1, 1 / 48 * (1 if o else 0.25), 1e30, 1e30], "View v = tableView(o, true);"),
        Function("Texel", "o:b d:1", ["makeDepthPyramidTexel(v, d).x", "makeDepthPyramidTexel(v, d).y"], [[o, d] for o in (0, 1) for d in (0.25, 0.75, 1.0)],
                 lambda o, d: [linearOf(d, o, True)] * 2, "View v = tableView(o, true);", relative=1e-4),
        Function("NormalGradient", "o:b ss:2 z:1 n:3", ["g.x", "g.y"], facing, normalGradient, "vec2 g = computeNormalGradient(tableView(o, true), ss, 1.0 / z, n);", relative=4e-5),
        Function("Steep", "n:3", ["g.x", "g.y"], [[[0.6, 0.8, 0.001]], [[0.6, 0.8, -0.001]], [[0.8, -0.6, 1e-7]], [[0.8, -0.6, -1e-7]]],
                 lambda n: [-n[k] * [0.025, -1 / 48][k] * 0.25 / (max(abs(n[2]), 1e-6) * (1 if n[2] > 0 else -1)) for k in range(2)],
                 "vec2 g = computeNormalGradient(tableView(false, true), vec2(32.0, 24.0), 0.25, n);", relative=4e-5),
        Function("ClampGradient", "g:2 a:1", ["clampGradient(g, a).x", "clampGradient(g, a).y"],
                 [[g, a] for g in ([0.01, 0.02], [0.1, -0.3], [-0.004, 0.05], [0.03, 0.03]) for a in (0.5, -2, 1.25, 0.1)],
                 lambda g, a: mul(g, min(1, 0.03 * abs(a) / (0.5 * (abs(g[0]) + abs(g[1])))))),
        Function("ChooseSlope", "n:1 h:b l:1 a:b r:1 b:b t:1", ["chooseSlope(n, h, NeighborRise(-l, a), NeighborRise(r, b), t)"], slopes, lambda *row: [chooseSlope(*row)]),
        Function("Sizes", "w:i h:i l:i", ["float(computeDepthPyramidSize(ivec2(w, h), l).x)", "float(computeDepthPyramidSize(ivec2(w, h), l).y)",
                 "float(computeDepthPyramidLevelCount(ivec2(w, h)))"], sizes,
                 lambda w, h, l: [max(w >> min(max(l, 0), 30), 1), max(h >> min(max(l, 0), 30), 1), max(w, h).bit_length()], absolute=0),
        Function("Cell", "x:i y:i l:i", ["float(c.x)", "float(c.y)"], [[x, y, l] for x, y in ((0, 0), (20, 13), (42, 26), (50, 30), (-3, 5), (5, -3)) for l in (0, 1, 2)],
                 lambda x, y, l: [min(max(x >> l, 0), (43 >> l) - 1), min(max(y >> l, 0), (27 >> l) - 1)], "ivec2 c = computeDepthPyramidCell(ivec2(x, y), l, ivec2(43 >> l, 27 >> l));", absolute=0),
        Function("Difference", "o:b f:1 s:1 a:2 b:2", ["d.slope", "number(d.isKnown)"],
                 [[o, f, s, [0, 4], [4, 9]] for o in (0, 1) for f, s in ((2, 3), (3, 2), (1, 1), (1e30, 2), (2, 1e30), (4e29, 4e29), (6e29, 1), (1, kInf))] + [[0, 2, 3, [4, 4], [4, 4]]],
                 difference, "DepthDifference d = computeDepthDifference(o, f, s, CellSpan(int(a.x), int(a.y)), CellSpan(int(b.x), int(b.y)));"),
        Function("Agree", "a:1 b:1 t:1", ["number(agree(a, b, t))"],
                 [[a, b, t] for a, b in ((1, 1.5), (1, 2), (1, 2.002), (1, 2.01), (2, 1), (-1, -2), (-1, 1), (0.1, -0.1), (0, 0.1), (1, 3), (3, 1), (-3, -1), (0.25, 0.45), (0.45, 0.25), (-0.3, -0.5), (0.5, -0.25)) for t in (0.0, 0.01, 0.125, 0.25, 0.5)], agree),
        Function("LinearStride", "s:1 n:i end:1 p:1", ["computeLinearStride(LinearSettings(s, n, 1, 0.0, 0), ScreenRay(vec2(0.0), vec2(1.0), p, 0.0, 0.0, 0, 0), end)"],
                 [[s, n, 0.75, 0.125] for s in (4, 0, -1, kNaN, 1e-5, 1e6, 0.5, 0.001, 1) for n in (0, -2, 1, 5)], linear),
        Function("LinearEnd", "a:2 d:2", ["computeLinearEnd(tableView(false, true), ScreenRay(a, d, 0.1, 0.0, 0.0, 0, 0))"],
                 [[[x, y], [dx, dy]] for x, y in ((10, 40), (60, 4)) for dx in (5, 100, -100, -1e-20) for dy in (3, 60, -60, 1e-20)], end),
    ], ["crossray/project/surface_pyramid.glsl", "crossray/project/depth_pyramid.glsl", "crossray/project/depth_patch.glsl", "crossray/project/linear.glsl"], kViews)


# ------------------------------------------------------------------------------------------------- probe/cubemap.glsl

# Of each face: the major axis with its sign, what runs to the right and what runs down, as (axis, sign).
kFaces = [((0, 1), (2, -1), (1, -1)), ((0, -1), (2, 1), (1, -1)), ((1, 1), (0, 1), (2, 1)), ((1, -1), (0, 1), (2, -1)), ((2, 1), (0, 1), (1, -1)), ((2, -1), (0, -1), (1, -1))]


def cubePlace(d):
    if not isTowards(d):
        return [0, 0.5, 0.5, 0]
    size = [abs(x) for x in d]
    axis = 2 if size[2] >= max(size[:2]) else 1 if size[1] >= size[0] else 0
    face = axis * 2 + (0 if d[axis] > 0 else 1)
    _, right, down = kFaces[face]
    return [face] + [clamp01((d[a] * s / size[axis] + 1) / 2) for a, s in (right, down)] + [1]


def cubePoint(face, s, t, major):
    p = [0, 0, 0]
    for (axis, sign), x in zip(kFaces[min(max(face, 0), 5)], (major, s, t)):
        p[axis] = sign * x
    return p


def fold(face, uv):
    known = min(max(face, 0), 5)
    if not isNumber(uv):
        return [known, 0.5, 0.5, 0]
    s, t = uv[0] * 2 - 1, uv[1] * 2 - 1
    ex, ey = min(max(abs(s) - 1, 0), 2), min(max(abs(t) - 1, 0), 2)
    s, t = min(max(s, -1), 1), min(max(t, -1), 1)
    if ex == 0 and ey == 0:
        return [known, (s + 1) / 2, (t + 1) / 2, 1]
    overSide = ex > 0 and ex >= ey
    point = cubePoint(known, s, t, 1 - (ex if overSide else ey))
    edge = cubePoint(known, s if overSide else 0, 0 if overSide else t, 0)
    axis = max(range(3), key=lambda k: abs(edge[k]))
    neighbour = axis * 2 + (0 if edge[axis] > 0 else 1)
    _, right, down = kFaces[neighbour]
    return [neighbour] + [clamp01((point[a] * sign + 1) / 2) for a, sign in (right, down)] + [1]


def cubemapTables():
    directions = [[1, 0.25, -0.5], [-1, 0.25, -0.5], [0.25, 1, -0.5], [0.25, -1, -0.5], [0.25, -0.5, 1], [0.25, -0.5, -1], [3, -2, 1], [-3, 2, -1], [1, 5, 2], [-1, -5, 2], [2, 1, 7], [-2, 1, -7],
                  [1, 1, 1], [-1, -1, -1], [1, 1, 0.5], [1, -1, 0.5], [1, 0.5, 1], [0.5, 1, 1], [0.5, -1, -1], [-1, 0.5, -1], [0, 0, 0], [kNaN, 0, 1], [0, kInf, 0], [1e-20, 0, 0], [0, -1e20, 3e19],
                  [-1, 1, -0.25], [-1, -0.5, 1], [0.25, 1, -1]]
    places = [[0.5, 0.5], [0.1, 0.2], [0.9, 0.3], [0, 1], [1, 0], [-0.25, 0.3], [1.25, 0.7], [0.3, -0.25], [0.7, 1.25], [-0.1, -0.2], [1.2, 1.1], [-0.3, 1.2], [1.1, -0.4], [1.6, 0.4], [-0.8, 0.4],
              [0.4, 1.9], [0.4, -1.2], [2.5, 0.4], [0.25, 3], [kNaN, 0.5], [0.5, kInf], [1.2, 1.2], [-0.25, 1.25],
              [2.2, 2.8]]  # both excesses count as one face, so that x wins
    faces = range(-1, 7)
    write("cubemap", "A direction's face and place are the specifications' tables, and beyond an edge they go on upon the neighbour.", [
        Function("Place", "d:3", ["float(c.face)", "c.uv.x", "c.uv.y", "number(c.valid)"], [[d] for d in directions], cubePlace, "CubePosition c = cubePositionFromDirection(d);"),
        Function("Point", "f:i s:1 t:1 m:1", ["cubePoint(f, s, t, m).x", "cubePoint(f, s, t, m).y", "cubePoint(f, s, t, m).z"], [[f, 0.25, -0.5, 0.75] for f in faces], cubePoint),
        # A place that is no number has the direction of the face's middle.
        Function("Direction", "f:i uv:2", ["d.x", "d.y", "d.z"], [[f, uv] for f in faces for uv in places],
                 lambda f, uv: unit(cubePoint(f, uv[0] * 2 - 1, uv[1] * 2 - 1, 1), cubePoint(f, 0, 0, 1)), "vec3 d = directionFromCubePosition(f, uv);"),
        Function("Fold", "f:i uv:2", ["float(c.face)", "c.uv.x", "c.uv.y", "number(c.valid)"], [[f, uv] for f in faces for uv in places], fold, "CubePosition c = foldCubePosition(f, uv);"),
    ], ["crossray/probe/cubemap.glsl"])


# -------------------------------------------------------------------------------------------------- probe/planar.glsl

def mirrored(p, point, n):
    n = unit(n)
    return sub(p, mul(n, 2 * dot(sub(p, point), n)))


def planarTables():
    planes = [([0, -1, 0], [0, 2, 0]), ([1, 0, -2], [1, 2, 2]), ([0.5, 0.25, 0], [-1, 0.5, 3]), ([-2, 1, 1], [3, -1, 0.5])]
    points = [[0, 0, 0], [1, -2, 3], [-4, 0.5, 2]]

    def reflection(p, point, n):
        if not isTowards(n):
            return p
        return mirrored(p, point if isNumber(point) else [0, 0, 0], n)

    def view(o, sx, sy, point, n, p):
        """Status, and a point in the mirrored view."""
        seen = toView(mirrored(p, point, n)) if isTowards(n) and isNumber(point) else None
        if seen is None:
            return [2, toView(p)]
        if not (sx > 0 and sy > 0 and isNumber(sx, sy)):
            return [3, toView(p)]
        if not dot(sub(kEye, point), unit(n)) > 1e-4:
            return [1, toView(p)]
        return [0, seen]
    views = [[0, 0.8, 0.5, p, n, q] for p, n in planes + [(kEye, [0, 1, 0]), ([0, 9, 0], [0, 1, 0]), ([1, 1.99995, 3], [0, 1, 0]), ([1, 1.9998, 3], [0, 1, 0]), ([0, 0, 0], [0, 0, 0]),
             ([kNaN, 0, 0], [0, 1, 0]), ([0, 0, 0], [kNaN, 1, 0])] for q in points[1:]]
    views += [[0, sx, sy, [0, -1, 0], [0, 1, 0], points[1]] for sx, sy in ((0, 0.5), (0.5, 0), (-1, 0.5), (0.5, -1), (kNaN, 0.5), (0.5, kInf), (0.1, 0.1))]

    def slope(fov, aspect):
        ok = 0 < fov < math.pi and aspect > 0 and isNumber(aspect)
        return [math.tan(fov / 2) * aspect, math.tan(fov / 2)] if ok else [0, 0]

    def oblique(o, r, far, point, n, x, y):
        """Status; then stored depth on the mirror along the view ray through (x, y), and that of the corner farthest from it."""
        if not (isTowards(n) and isNumber(point)):
            return [2, 0, 0]
        nv, pv = unit(toViewDir(n)), toView(point)
        distance = lambda q: dot(nv, sub(q, pv))
        if not distance([0, 0, 0]) < -1e-4:
            return [1, 0, 0]
        reach = corner(o, far, nv, pv)
        if not reach > 1e-12:
            return [4, 0, 0]
        return [0, 1 if r else 0, 0 if r else 1]

    def corner(o, far, nv, pv):
        side = [(-1 if nv[k] < 0 else 1) * kSlope[k] for k in range(2)]
        if o:
            return dot(nv, sub([side[0], side[1], -far], pv))
        return dot(nv, [side[0], side[1], -1]) - dot(nv, pv) * (0 if far >= 65504 else 1 / far)
    front = [([0, -1, 0], [1, -0.5, -1]), ([-3, 4, -2], [-2, 1, -2]), ([-2, 4, 0], [-1, 1.5, -2]), ([0, 3, 1], [-1, 0.25, -2])]
    rowsOblique = [[o, r, far, p, n, 0.3, -0.4] for o in (0, 1) for r in (0, 1) for far in (64, 65504) for p, n in front]
    rowsOblique += [[o, 1, 64, p, n, 0.3, -0.4] for o in (0, 1) for p, n in ((kEye, [0, 1, 0]), ([0, 0, 0], [0, 0, 0]), ([kNaN, 0, 0], [0, 1, 0]), (add(kEye, mul(kAxes[2], 5)), kAxes[2]), ([0, -1, 0], [0, 1, 0]),
                     (sub(kEye, mul(kAxes[2], 100)), mul(kAxes[2], -1)))]
    glsl = """View v = tableView(o, r);
v.farDistance = far;
MirrorPlane plane = MirrorPlane(p, n);
ObliqueProjection found = makeObliqueProjection(v, plane);
vec4 row = depthRow(found.clipFromView);
vec3 nVS = safeNormalize(directionVSFromWS(v, n), vec3(0.0));
vec3 pVS = positionVSFromWS(v, p);
vec2 side = vec2(nVS.x < 0.0 ? -0.8 : 0.8, nVS.y < 0.0 ? -0.5 : 0.5);
vec3 along = o ? vec3(0.0, 0.0, -1.0) : vec3(x * 0.8, y * 0.5, -1.0);
vec3 from = o ? vec3(x * 0.8, y * 0.5, 0.0) : vec3(0.0);
vec3 onPlane = from + along * (dot(nVS, pVS - from) / dot(nVS, along));
float w = o ? 1.0 : -onPlane.z;
vec4 corner = o ? vec4(side, -far, 1.0) : vec4(side, -1.0, far >= 65504.0 ? 0.0 : 1.0 / far);
float valid = found.status == 0 ? 1.0 : 0.0;
float near = valid > 0.5 ? dot(row, vec4(onPlane, 1.0)) / w : 0.0;
float end = valid > 0.5 ? dot(row, corner) : 0.0;
mat4 clip = v.clipFromView;
float kept = number(found.clipFromView[0].x == clip[0].x && found.clipFromView[1].y == clip[1].y && found.clipFromView[2].w == clip[2].w && found.clipFromView[3].w == clip[3].w
    && found.clipFromView[0].y == 0.0 && found.clipFromView[1].x == 0.0 && found.clipFromView[3].x == 0.0 && found.clipFromView[2].y == 0.0);"""

    def fromOblique(o, r, row, ndc, device):
        """Depth at which (x, y, -z, 1) gives that value."""
        if isCleared(device, r):
            return kFar
        sx, sy = ndc[0] * kSlope[0], ndc[1] * kSlope[1]
        across = row[0] * sx + row[1] * sy
        if o:  # across - row.z * z + row.w = device
            z = safeDivide(across + row[3] - device, row[2], kFar)
        else:  # (z * across - row.z * z + row.w) / z = device
            z = safeDivide(row[3], device - across + row[2], kFar)
        return min(z, kFar) if z > 0 else kFar
    depthRows = [[o, r, row, ndc, d] for o in (0, 1) for r in (0, 1) for row in ([0.1, -0.2, -0.5, 0.75], [0.05, 0.3, -0.25, -0.5], [0.1, 0.1, 0.5, 2]) for ndc in ([0, 0], [0.5, -0.75]) for d in (0.25, 0.75, 0, 1, kNaN)]

    def lookUp(o, r, p, d):
        if not (isTowards(d) and isNumber(p)):
            return [0, 0, 0, 8]
        if dot(unit(d), mul(kAxes[2], -1)) < 0:
            return [0, 0, 0, 7]
        v = toView(p)
        z = -v[2]
        w = 1 if o else z
        if not (w > 0 and z - kNear >= 0):
            return [0, 0, 0, 6]
        uv = [(v[0] / (kSlope[0] * w) + 1) / 2, (1 - v[1] / (kSlope[1] * w)) / 2]
        if not all(0 <= x <= 1 for x in uv):
            return [0, 0, 0, 5]
        return [uv, 1, 0]
    at = lambda x, y, z: fromView([x, y, -z])
    ahead = mul(kAxes[2], -1)
    looks = [[o, r, p, d] for o in (0, 1) for r in (0, 1) for p, d in ((at(0.3, -0.2, 2), ahead), (at(-0.5, 0.4, 1.25), [-1, 2, -2]), (at(0.1, 0.1, 0.4), ahead), (at(0.1, 0.1, 0.6), ahead), (at(0, 0, -3), ahead),
             (at(5, 0, 2), ahead), (at(-5, 0, 2), ahead), (at(0, 3, 2), ahead), (at(0, -3, 2), ahead), (at(0, 0, 2), mul(ahead, -1)), (at(0, 0, 2), [0, 0, 0]), ([kNaN, 0, 0], ahead), (at(0.3, 0.2, 80), ahead),
             (at(0.2, 0.1, 3), [2, 1, -1]), (at(0.2, 0.1, 3), add(kAxes[0], mul(kAxes[2], -0.01))), (at(0.2, 0.1, 3), add(kAxes[1], mul(kAxes[2], 0.01))))]
    write("planar", "The mirrored camera, its oblique near plane and the look-up in its image are geometry, and each refusal has its reason.", [
        Function("Reflection", "p:3 q:3 n:3", ["m.x", "m.y", "m.z"], [[p, q, n] for q, n in planes + [([1, 2, 3], [0, 0, 0]), ([kNaN, 0, 0], [1, 2, 2]), ([0, kInf, 0], [1, 2, 2])] for p in points], reflection,
                 "vec3 m = (makeReflectionMatrix(MirrorPlane(q, n)) * vec4(p, 1.0)).xyz;", absolute=4e-6),
        Function("View", "o:b sx:1 sy:1 p:3 n:3 q:3", ["float(m.status)", "s.x", "s.y", "s.z", "b.x", "b.y", "b.z"], views, lambda o, sx, sy, p, n, q: [view(o, sx, sy, p, n, q), q],
                 "View v = tableView(o, true);\nv.slope = vec2(sx, sy);\nMirroredView m = makeMirroredView(v, MirrorPlane(p, n));\nvec3 s = (m.view.viewFromWorld * vec4(q, 1.0)).xyz;\n"
                 "vec3 b = (m.view.worldFromView * vec4(s, 1.0)).xyz;", absolute=1e-5),
        Function("Slope", "f:1 a:1", ["computeCaptureSlope(f, a).x", "computeCaptureSlope(f, a).y"],
                 [[f, a] for f in (1, 2, 0.25, 0, -1, 3.2, 4, math.pi, kNaN) for a in (1, 1.5, 0, -2, kNaN, kInf)], slope, relative=1e-4),
        Function("Oblique", "o:b r:b far:1 p:3 n:3 x:1 y:1", ["float(found.status)", "near", "end", "kept"], rowsOblique, lambda *row: oblique(*row) + [1], glsl, absolute=2e-5),
        Function("FromOblique", "o:b r:b row:4 ndc:2 d:1", ["linearDepthFromOblique(tableView(o, r), withDepthRow(mat4(1.0), row), ndc, d)"], depthRows, lambda *row: [fromOblique(*row)], relative=4e-5),
        Function("LookUp", "o:b r:b p:3 d:3", ["f.positionUV.x", "f.positionUV.y", "f.weight", "float(f.status)"], looks, lookUp,
                 "View v = tableView(o, r);\nPlanarLookup f = lookUpPlanar(v, v.clipFromView, p, d);", absolute=4e-6),
        Function("OnBorder", "p:3", ["f.positionUV.x", "f.positionUV.y", "f.weight", "float(f.status)"],
                 [[[x, y, -z]] for z in (0.5, 1, 2, 0.25) for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (0.5, 0.25), (-0.5, 0.5), (2, 0), (0, -2))],
                 lambda p: [0, 0, 0, 6] if p[2] > -0.5 else [0, 0, 0, 5] if max(abs(p[0]), abs(p[1])) > -p[2] else [0.5 - 0.5 * p[0] / p[2], 0.5 + 0.5 * p[1] / p[2], 1, 0],
                 """View v = tableView(false, false);
v.viewFromWorld = mat4(1.0);
v.worldFromView = mat4(1.0);
PlanarLookup f = lookUpPlanar(v, mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, -1.0, -1.0), vec4(0.0, 0.0, -0.5, 0.0)), p, vec3(0.0, 0.0, -1.0));"""),
        Function("Alignment", "n:3 m:3", ["computeMirrorAlignment(MirrorPlane(vec3(0.0), n), m)"], [[n, m] for n in ([1, 2, 2], [0, 0, 0], [0, -3, 1]) for m in ([0, 1, 0], [2, -1, 2], [0, 0, 0], [1, 1, 5])],
                 lambda n, m: [dot(unit(n), unit(m))]),
    ], ["crossray/probe/planar.glsl"], kViews)


# ----------------------------------------------------------------------------------------------------- probe/urp.glsl

def urpSize(low, high, profile):
    if not isNumber(low) or not isNumber(high):
        return 1e30
    side = [max(b - a, 0) for a, b in zip(low, high)]
    size = side[0] * side[1] * side[2] if profile == 0 else dot(side, side)
    return size if size <= (65504 if profile == 2 else 1e30) else 1e30


def urpFirst(a, b, profile):
    """Probes as (size of a cube's side, importance, area, index)."""
    key = lambda q: (-q[1], urpSize([0, 0, 0], [q[0]] * 3, profile), -q[2] if profile == 0 else 0, q[3])
    return key(a) < key(b)


def urpWeight(low, high, blend, p):
    if not (isNumber(p) and isNumber(low) and isNumber(high)):
        return 0
    depth = min(flat([sub(p, low), sub(high, p)]))
    if not depth > 0:
        return 0
    return clamp01(depth / blend) if blend > 0 else 1


def urpShares(first, second, dominance, profile):
    a, b = clamp01(first), clamp01(second)
    if dominance > 0:
        b = min(b, 1 - a)
    if dominance < 0:
        a = min(a, 1 - b)
    scale = max(a + b, 1)
    a, b = a / scale, b / scale
    total = clamp01(a + b)
    return [a, b, 0 if profile != 0 and total >= 0.99 else 1 - total]


def urpDominance(a, b, profile):
    if a[1] != b[1]:
        return 1 if a[1] > b[1] else -1
    d = urpSize([0] * 3, [a[0]] * 3, profile) - urpSize([0] * 3, [b[0]] * 3, profile)
    return 0 if profile == 0 or abs(d) <= 1e-4 else 1 if d < 0 else -1


def urpTables():
    boxes = [([-1, -2, -3], [3, 2, 1]), ([0, 0, 0], [1, 1, 1]), ([2, 0, 0], [1, 1, 1]), ([0, 2, 0], [1, 1, 1]), ([0, 0, 2], [1, 1, 1]), ([kInf, 0, 0], [1, 1, 1]), ([0, 0, 0], [1, kInf, 1]), ([0, 0, 0], [200, 10, 20]),
             ([0, 0, 0], [148, 148, 148]), ([0, 0, 0], [147, 147, 147]), ([-2, 0, 0], [300, 5, 1]), ([0, 0, 0], [252, 44, 8]), ([0, 0, 0], [1e16, 1e16, 1e16])]
    inside = [[1, 0, -1], [2.75, 0, -1], [-0.75, 0.5, -1], [1, 1.5, -1], [1, -1.75, -1], [1, 0, 0.5], [1, 0, -2.5], [3, 0, -1], [4, 0, -1], [1, -3, -1], [1, 0, 2], [kInf, 0, 0]]
    ranks = [(2, 1, 3, 0), (2, 1, 3, 1), (2, 1, 4, 2), (1, 1, 3, 3), (2, 2, 3, 4), (3, 0, 9, 5), (2.00001, 1, 3, 6), (150, 1, 0, 7), (160, 1, 0, 8), (1, 2, 1, 9)]
    probe = "UrpProbe(vec3(0.0), vec3({0}.x), 0.5, {0}.y, {0}.z, int({0}.w))"
    pairs = [[p, list(a), list(b)] for p in (0, 1, 2) for a in ranks for b in ranks]
    triples = [[p, list(ranks[i]), list(ranks[j]), list(ranks[k])] for p in (0, 1, 2) for i, j, k in ((0, 1, 2), (2, 1, 0), (4, 3, 5), (5, 4, 3), (3, 5, 4), (9, 7, 8), (8, 7, 9), (1, 0, 6), (6, 3, 9), (7, 8, 2))]

    def offered(p, *probes):
        order = sorted(range(3), key=lambda i: [sum(urpFirst(q, probes[i], p) for q in probes)])
        keep = [order[0], order[1]]
        return [keep[0], keep[1], probes[keep[0]][3], probes[keep[1]][3]]
    shares = [[a, b, d, p] for p in (0, 1, 2) for d in (-1, 0, 1) for a, b in ((0.5, 0.25), (0.75, 0.75), (1, 0.5), (0.5, 1), (0, 0), (1, 1), (0.3, 0), (0, 0.995), (0.5, 0.495), (1.5, -1), (kNaN, 0.5), (0.25, kNaN), (0.6, 0.385))]

    def step(total, weight):
        before = clamp01(total)
        got = 0 if before >= kFull else min(clamp01(weight), 1 - before)
        return [got, min(before + got, 1), min(before + got, 1) >= kFull]
    from tables import single
    kFull = single(0.99)

    def pairShares(p, a, b, wa, wb, which):
        """Cubes of the probes' sides about the point; the blend makes the weight."""
        first = wa if which in (1, 3) else 0
        second = wb if which in (2, 3) else 0
        return urpShares(first, second, urpDominance(a, b, p) if first > 0 and second > 0 else 0, p)
    mixed = [[p, list(a), list(b), wa, wb, w] for p in (0, 1) for a, b in ((ranks[0], ranks[3]), (ranks[3], ranks[0]), (ranks[0], ranks[4]), (ranks[4], ranks[0]), (ranks[0], ranks[1]))
             for wa, wb in ((0.75, 0.5), (1, 1), (0.25, 0.9)) for w in (0, 1, 2, 3)]
    write("urp", "URP's probes are weighed, ordered and mixed as its manual and its code say, each by its own rule.", [
        Function("Weight", "low:3 high:3 blend:1 p:3", ["computeUrpWeight(UrpProbe(low, high, blend, 0.0, 0.0, 0), p)"],
                 [[*boxes[0], b, p] for b in (0.5, 1, 0, -1, kNaN, 5) for p in inside] + [[*box, 0.5, [0.5, 0.5, 0.5]] for box in boxes], lambda *row: [urpWeight(*row)]),
        Function("Size", "low:3 high:3 p:i", ["computeUrpSize(UrpProbe(low, high, 0.5, 0.0, 0.0, 0), p)"], [[*box, p] for box in boxes for p in (0, 1, 2)], lambda *row: [urpSize(*row)]),
        Function("Order", "p:i a:4 b:4", [f"number(urpProbeComesFirst({probe.format('a')}, {probe.format('b')}, p))", f"float(computeUrpDominance({probe.format('a')}, {probe.format('b')}, p))"], pairs,
                 lambda p, a, b: [urpFirst(a, b, p), urpDominance(a, b, p)], absolute=0),
        Function("Pair", "p:i a:4 b:4 c:4", ["float(pair.first)", "float(pair.second)", "float(pair.firstProbe.index)", "float(pair.secondProbe.index)", "pair.secondProbe.boxMaxWS.y", "pair.secondProbe.importance",
                 "pair.secondProbe.coveredArea", "pair.firstProbe.blendDistance", "pair.firstProbe.boxMaxWS.z"], triples,
                 lambda p, a, b, c: (lambda o: [o, (a, b, c)[o[1]][0], (a, b, c)[o[1]][1], (a, b, c)[o[1]][2], 0.5, (a, b, c)[o[0]][0]])(offered(p, a, b, c)),
                 f"UrpPair pair = offerUrpProbe(makeUrpPair(), {probe.format('a')}, 0, p);\npair = offerUrpProbe(pair, {probe.format('b')}, 1, p);\npair = offerUrpProbe(pair, {probe.format('c')}, 2, p);"),
        Function("Shares", "a:1 b:1 d:i p:i", ["s.first", "s.second", "s.sky"], shares, urpShares, "UrpWeights s = computeUrpShares(a, b, d, p);"),
        Function("SkyWeight", "t:1 p:i", ["computeUrpSkyWeight(t, p)"], [[t, p] for t in (0, 0.5, 0.98, 0.985, 0.995, 1, 2, -1, kNaN, 0.99) for p in (0, 1, 2)],
                 lambda t, p: [0 if p != 0 and t >= kFull else 1 - clamp01(t)]),
        Function("ForwardPlus", "t:1 w:1", ["s.weight", "s.total", "number(s.done)"], [[t, w] for t in (0, 0.5, 0.985, 0.99, 0.995, 1, 1.5, -1, kNaN) for w in (0, 0.25, 0.48, 0.495, 1, 2, -1, kNaN)], step,
                 "UrpStep s = stepUrpForwardPlus(t, w);"),
        Function("PairShares", "p:i a:4 b:4 wa:1 wb:1 which:i", ["s.first", "s.second", "s.sky"], mixed, pairShares,
                 f"UrpProbe first = {probe.format('a')};\nUrpProbe second = {probe.format('b')};\nfirst.boxMinWS = vec3(-0.5 * a.x);\nfirst.boxMaxWS = vec3(0.5 * a.x);\nsecond.boxMinWS = vec3(-0.5 * b.x);\n"
                 "second.boxMaxWS = vec3(0.5 * b.x);\nfirst.blendDistance = 0.5 * a.x / wa;\nsecond.blendDistance = 0.5 * b.x / wb;\n"
                 "UrpWeights s = computeUrpPairShares(UrpPair((which & 1) == 1 ? 0 : kUrpNoProbe, which >= 2 ? 1 : kUrpNoProbe, first, second), vec3(0.0), p);"),
    ], ["crossray/probe/urp.glsl"])


def make():
    screenRayTables()
    pyramidTables()
    cubemapTables()
    planarTables()
    urpTables()
