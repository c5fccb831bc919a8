"""Tables of probe/planar and probe/urp; see tables.py."""
import math
from tables import Function, add, clamp01, dot, flat, isNumber, isTowards, kInf, kNaN, length, mul, single, sub, unit, write
from tables_core import fromView, isCleared, kAxes, kEye, kFar, kNear, kSlope, kViews, safeDivide, toView, toViewDir


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
    # The distance counts in metres, however long the normal is.
    views += [[0, 0.8, 0.5, p, n, points[1]] for p, n in (([1, 1.99995, 3], [0, 4, 0]), ([1, 1.9998, 3], [0, 0.25, 0]))]

    def thresholds(flat, s, far, p, n):
        """An eye at the origin that looks along -z, or sees nothing but the point (1, 1, 1): status of the mirrored view and of the oblique projection."""
        n, smallest = unit(n), single(1e-4)
        distance = 0 if flat else -dot(n, p)
        reach = sum(abs(n[k]) * s[k] for k in range(2)) - n[2] + (0 if far >= 65504 else distance / far)
        return [0 if -dot(n, p) > smallest else 1, 1 if not distance < -smallest else 0 if reach > single(1e-12) else 4]
    usual = [0.8, 0.5]
    # 1e-4 m exactly, and about it with normals of other lengths; a view in which the normal is none; the plane along the border of the image,
    # which the corner reaches by the slope alone.
    statuses = [[0, usual, 64, p, n] for p, n in (([0, -1e-4, 0], [0, 1, 0]), ([0, 1e-4, 0], [0, 1, 0]), ([0, 0, -5e-5], [0, 0, -4]), ([0, 0, -2e-4], [0, 0, -0.25]))]
    statuses += [[1, usual, 64, [0, 1, 0], [0, 1, 0]]] + [[0, [x, 0.5], far, [1, 0, 0], [1, 0, 0]] for x, far in ((1e-12, 70000), (1e-10, 70000), (1e-10, 65504))]
    mirrorAt = """View v = tableView(false, true);
v.worldFromView = mat4(1.0);
v.viewFromWorld = flattened ? mat4(vec4(0.0), vec4(0.0), vec4(0.0), vec4(1.0)) : mat4(1.0);
v.slope = s;
v.farDistance = far;"""

    def slope(fov, aspect):
        ok = 0 < fov < math.pi and aspect > 0 and isNumber(aspect)
        return [math.tan(fov / 2) * aspect, math.tan(fov / 2)] if ok else [0, 0]

    def oblique(o, r, far, point, n, x, y):
        """Status; then stored depth on the mirror along the view ray through (x, y), and that of the corner farthest from it."""
        if not (isTowards(n) and isNumber(point)):
            return [2, 0, 0]
        nv, pv = unit(toViewDir(unit(n))), toView(point)
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
    # The corner that is farthest from the mirror, in each quarter of the image.
    for x, y in ((-1, 0.5), (0.5, 1), (-0.5, -1)):
        n = add(add(mul(kAxes[0], x), mul(kAxes[1], y)), mul(kAxes[2], -1))
        front.append((add(kEye, mul(n, 2)), n))
    rowsOblique = [[o, r, far, p, n, 0.3, -0.4] for o in (0, 1) for r in (0, 1) for far in (64, 65504) for p, n in front]
    # A normal that is just long enough in the world's axes, and would not be in the camera's.
    rowsOblique += [[0, 1, 64, front[0][0], mul(axis, 6.3e-31), 0.3, -0.4] for axis in kAxes] + [[0, 1, 64, add(kEye, mul(kAxes[2], -5)), mul(kAxes[2], sign * 6.3e-31), 0.3, -0.4] for sign in (1, -1)]
    rowsOblique += [[o, 1, 64, p, n, 0.3, -0.4] for o in (0, 1) for p, n in ((kEye, [0, 1, 0]), ([0, 0, 0], [0, 0, 0]), ([kNaN, 0, 0], [0, 1, 0]), (add(kEye, mul(kAxes[2], 5)), kAxes[2]), ([0, -1, 0], [0, 1, 0]),
                     (sub(kEye, mul(kAxes[2], 100)), mul(kAxes[2], -1)))]
    glsl = """View v = tableView(o, r);
v.farDistance = far;
MirrorPlane plane = MirrorPlane(p, n);
ObliqueProjection found = makeObliqueProjection(v, plane);
vec4 row = depthRow(found.clipFromView);
vec3 nVS = safeNormalize(directionVSFromWS(v, safeNormalize(n, vec3(0.0))), vec3(0.0));
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
    numbers = [[0.5 + 0.25 * (4 * a + b) for b in range(4)] for a in range(4)]  # a matrix without two equal elements
    depthRows = [[o, r, row, ndc, d] for o in (0, 1) for r in (0, 1) for row in ([0.1, -0.2, -0.5, 0.75], [0.05, 0.3, -0.25, -0.5], [0.1, 0.1, 0.5, 2]) for ndc in ([0, 0], [0.5, -0.75]) for d in (0.25, 0.75, 0, 1, kNaN)]
    # A depth of 0, and one beyond the far plane.
    depthRows += [[1, 1, [0, 0, -0.5, 0.25], [0, 0], 0.25], [0, 1, [0.1, -0.2, -0.5, 0], [0.5, 0.5], 0.75], [0, 1, [0, 0, -0.5, 0.75], [0, 0], 0.5078125],
                  [1, 1, [0, 0, 0.00390625, 0.75], [0, 0], 0.25]]

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
    plain, forward = [0, 0, -1, -0.5], [0, 0, -1]
    borders = [[[x, y, -z], plain, forward] for z in (0.5, 1, 2, 0.25) for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (0.5, 0.25), (-0.5, 0.5), (2, 0), (0, -2), (1.25, 0), (-1.25, 0), (0, 1.25), (0, -1.25))]
    # A reflection at a right angle; beyond the near plane, but beside the eye or behind it.
    borders += [[[0, 0, -1], plain, [1, 0, 0]], [[0, 0, -1], plain, [0, -2, 0]]] + [[p, [0, 1, 0, 0], forward] for p in ([0, 1, -1], [0, 1, 0], [1, 0, 0], [0, 0, 0], [0, 1, 1])]

    def onBorder(p, row, d):
        if -d[2] < 0:
            return [0, 0, 0, 7]
        if not (-p[2] > 0 and dot(row, p + [1]) >= 0):
            return [0, 0, 0, 6]
        return [0, 0, 0, 5] if max(abs(p[0]), abs(p[1])) > -p[2] else [0.5 - 0.5 * p[0] / p[2], 0.5 + 0.5 * p[1] / p[2], 1, 0]
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
        Function("OnBorder", "p:3 row:4 d:3", ["f.positionUV.x", "f.positionUV.y", "f.weight", "float(f.status)"], borders, onBorder,
                 """View v = tableView(false, false);
v.viewFromWorld = mat4(1.0);
v.worldFromView = mat4(1.0);
PlanarLookup f = lookUpPlanar(v, withDepthRow(mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, -1.0), vec4(0.0)), row), p, d);"""),
        Function("Thresholds", "flattened:b s:2 far:1 p:3 n:3", ["float(makeMirroredView(v, MirrorPlane(p, n)).status)", "float(makeObliqueProjection(v, MirrorPlane(p, n)).status)"], statuses,
                 thresholds, mirrorAt, absolute=0),
        Function("DepthRow", "a:4 b:4 c:4 d:4 row:4", [f"m[{k}].{c}" for k in range(4) for c in "xyzw"] + [f"was.{c}" for c in "xyzw"], [numbers + [[9, 8, 7, 6]]],
                 lambda a, b, c, d, row: [[a[:2], row[0], a[3], b[:2], row[1], b[3], c[:2], row[2], c[3], d[:2], row[3], d[3]], [a[2], b[2], c[2], d[2]]],
                 "mat4 m = withDepthRow(mat4(a, b, c, d), row);\nvec4 was = depthRow(mat4(a, b, c, d));", absolute=0),
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
             ([0, 0, 0], [148, 148, 148]), ([0, 0, 0], [147, 147, 147]), ([-2, 0, 0], [300, 5, 1]), ([0, 0, 0], [252, 44, 8]), ([0, 0, 0], [1e16, 1e16, 1e16]),
             ([0, 0, -kInf], [1, 1, 1]), ([0, 0, 0], [-kInf, 1, 1])]
    inside = [[1, 0, -1], [2.75, 0, -1], [-0.75, 0.5, -1], [1, 1.5, -1], [1, -1.75, -1], [1, 0, 0.5], [1, 0, -2.5], [3, 0, -1], [4, 0, -1], [1, -3, -1], [1, 0, 2], [kInf, 0, 0]]
    ranks = [(2, 1, 3, 0), (2, 1, 3, 1), (2, 1, 4, 2), (1, 1, 3, 3), (2, 2, 3, 4), (3, 0, 9, 5), (2.00001, 1, 3, 6), (150, 1, 0, 7), (160, 1, 0, 8), (1, 2, 1, 9), (2, -1, 3, 10), (2, -2, 3, 11), (2, -3, 3, 12)]  # the last: less important than nothing
    probe = "UrpProbe(vec3(0.0), vec3({0}.x), 0.5, {0}.y, {0}.z, int({0}.w))"
    placed = "UrpProbe({0}.w * vec3(1.0, 2.0, 3.0), {0}.w * vec3(1.0, 2.0, 3.0) + vec3({0}.x), 0.5 + {0}.w, {0}.y, {0}.z, int({0}.w))"
    cube, point = "UrpProbe(vec3(0.0), x, 0.5, 1.0, 1.0, 0)", "UrpProbe(vec3(0.0), vec3(0.0), 0.5, 1.0, 1.0, 1)"
    pairs = [[p, list(a), list(b)] for p in (0, 1, 2) for a in ranks[:10] for b in ranks[:10]]
    triples = [[p, list(ranks[i]), list(ranks[j]), list(ranks[k])] for p in (0, 1, 2) for i, j, k in ((0, 1, 2), (2, 1, 0), (4, 3, 5), (5, 4, 3), (3, 5, 4), (9, 7, 8), (8, 7, 9), (1, 0, 6), (6, 3, 9), (7, 8, 2),
               (10, 11, 12), (12, 11, 10), (11, 12, 10))]

    def offered(p, *probes):
        order = sorted(range(3), key=lambda i: [sum(urpFirst(q, probes[i], p) for q in probes)])
        keep = [order[0], order[1]]
        return keep
    shares = [[a, b, d, p] for p in (0, 1, 2) for d in (-1, 0, 1) for a, b in ((0.5, 0.25), (0.75, 0.75), (1, 0.5), (0.5, 1), (0, 0), (1, 1), (0.3, 0), (0, 0.995), (0.5, 0.495), (1.5, -1), (kNaN, 0.5), (0.25, kNaN), (0.6, 0.385))]

    def step(total, weight):
        before = clamp01(total)
        got = 0 if before >= kFull else min(clamp01(weight), 1 - before)
        return [got, min(before + got, 1), min(before + got, 1) >= kFull]
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
                 [[*boxes[0], b, p] for b in (0.5, 1, 0, -1, kNaN, 5) for p in inside] + [[*box, 0.5, [0.5, 0.5, 0.5]] for box in boxes], lambda *row: [urpWeight(*row)],
                 vulkanRows=[[*boxes[0], b, p] for b in (0, 0.5) for p in ([kNaN, 0, -1], [1, kNaN, -1], [1, 0, kNaN])]),
        Function("Size", "low:3 high:3 p:i", ["computeUrpSize(UrpProbe(low, high, 0.5, 0.0, 0.0, 0), p)"], [[*box, p] for box in boxes for p in (0, 1, 2)], lambda *row: [urpSize(*row)]),
        Function("Order", "p:i a:4 b:4", [f"number(urpProbeComesFirst({probe.format('a')}, {probe.format('b')}, p))", f"float(computeUrpDominance({probe.format('a')}, {probe.format('b')}, p))"], pairs,
                 lambda p, a, b: [urpFirst(a, b, p), urpDominance(a, b, p)], absolute=0),
        # The positions of the two, and all that is known of them: boxes that start at 1, 2 and 3 times the index.
        Function("Pair", "p:i a:4 b:4 c:4", ["float(pair.first)", "float(pair.second)"] + [f"float(pair.{which}Probe.{what})" for which in ("first", "second") for what in
                 [f"box{end}WS.{c}" for end in ("Min", "Max") for c in "xyz"] + ["blendDistance", "importance", "coveredArea", "index"]], triples,
                 lambda p, a, b, c: (lambda o: [o, [[[k * q[3] for k in (1, 2, 3)], [k * q[3] + q[0] for k in (1, 2, 3)], 0.5 + q[3], q[1:]] for q in ((a, b, c)[o[0]], (a, b, c)[o[1]])]])(offered(p, a, b, c)),
                 f"UrpPair pair = offerUrpProbe(makeUrpPair(), {placed.format('a')}, 0, p);\npair = offerUrpProbe(pair, {placed.format('b')}, 1, p);\npair = offerUrpProbe(pair, {placed.format('c')}, 2, p);"),
        # Diagonals of 1e-4 m2, exactly in floats, and of nothing: equal. One that is a little longer is not.
        Function("Nearly", "p:i x:3", [f"float(computeUrpDominance({{}}, {{}}, p))".format(*pair) for pair in ((cube, point), (point, cube))],
                 [[p, [k * 2.0 ** -19 for k in side]] for p in (1, 2) for side in ((4077, 3295, 94), (4077, 3295, 95))], lambda p, x: [-1, 1] if dot(x, x) > single(1e-4) else [0, 0], absolute=0),
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
    planarTables()
    urpTables()
