"""The definition of project/screen_ray, and tables of the pure parts of the pyramids and probe/cubemap; see tables.py."""
from tables import Function, add, clamp01, isNumber, isTowards, kInf, kLimit, kNaN, length, mul, sub, unit, write
from tables_core import awayFromZero, kDegenerateRay, kFar, kNear, kSize, kSlope, kViews, linearOf, toView, toViewDir


# ------------------------------------------------------------------------------------------- project/screen_ray.glsl

def screenRay(ortho, origin, direction):
    return screenRayInView(ortho, toView(origin), unit(toViewDir(direction)))


def screenRayInView(ortho, o, d, slope=kSlope):
    """The end by the first of the near plane, the far plane and 65504 m; two projections instead of a difference that does not cancel."""
    none = [0, 0, 1e-20, 1e-20, 1e20, -1 if ortho else 1, 0, 7]
    if not isTowards(d) or not isNumber(o):
        return none + [kDegenerateRay]
    z, rate = -o[2], -d[2]
    far = 65504.0
    # What moves by so little that the way there is no number counts as standing still.
    toNear = (kNear - z) / rate if rate < 0 and isNumber((kNear - z) / rate) else far
    toFar = (kFar - z) / rate if rate > 0 and isNumber((kFar - z) / rate) else far
    reason = 4 if toNear < toFar and toNear < far else 7
    none[7] = reason
    if toNear <= 0 or not z > 0:
        return none + [4]
    if toFar <= 0:
        return none + [7]
    s = min(far, toNear, toFar)
    end = add(o, mul(d, s))
    affine = (lambda x: -x) if ortho else (lambda x: 1 / x)
    place = lambda v: [(v[0] / (slope[0] * (1 if ortho else -v[2])) + 1) / 2 * kSize[0], (1 - v[1] / (slope[1] * (1 if ortho else -v[2]))) / 2 * kSize[1]]
    a, b = place(o), place(end)
    change = affine(-end[2]) - affine(z)
    if not sum(abs(x) for x in a + sub(b, a)) < kLimit or not abs(affine(z)) + abs(change) < kLimit:
        return none + [kDegenerateRay]
    delta = [awayFromZero(x, 1e-20) for x in sub(b, a)]
    return [a, delta, 1 / max(abs(x) for x in delta), affine(z), change, reason, 0]


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


def make():
    pyramidTables()
    cubemapTables()
