"""Tables of core/, hierarchy/, debug/ and shared/; see tables.py."""
import math
from tables import Function, add, clamp01, dot, flat, isNumber, kInf, kLimit, kLongest, kNaN, kShortest, length, mul, smooth, sub, unit, write

# ---------------------------------------------------------------------------------------------------- core/math.glsl

kNumbers = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, -0.5, -3.0, kNaN, kInf, -kInf, 1e-30, 9.9e36, 1.1e37, -9.9e36, -1.1e37, 12.5]


def finiteOr(x, fallback): return x if isNumber(x) else fallback


def safeDivide(a, b, fallback):
    if not abs(b) > 0 or a != a:
        return fallback
    return finiteOr(0.0 if abs(b) == kInf and abs(a) != kInf else a / b, fallback)


def awayFromZero(x, smallest):
    return x if abs(x) >= smallest else (-smallest if x < 0 else smallest)


def together(v): return sum(abs(x) for x in v) < kLimit


def mathTables():
    triples = [[x, y, z] for x, y, z in zip(kNumbers, kNumbers[5:] + kNumbers[:5], kNumbers[11:] + kNumbers[:11])]
    vectors = [[1, 2, 3], [-4, 5, -6], [0.5, -0.25, 2], [3, -1, 2], [2, 3, -7], [-1, -2, -0.5], [4, 4, 4], [0, 0, 5], [0, -7, 0], [6, 0, 0]]
    finites = [[1e37, 0, 0, 0], [0, 1e37, 0, 0], [0, 0, 1e37, 0], [0, 0, 0, -1e37], [-1e37, 0, 0, 0], [0, -2e37, 0, 0], [0, 0, -2e37, 0], [1, 2, 3, 4], [kNaN, 0, 0, 0], [0, kNaN, 0, 0], [0, 0, kNaN, 0], [0, 0, 0, kNaN], [kInf, 0, 0, 0], [0, -kInf, 0, 0],
               [0, 0, 2e37, 0], [0, 0, 0, -2e37], [2e36, -2e36, 2e36, -2e36], [6e36, 3e36, 3e36, 1e36], [1e36, 5e36, 3e36, 3e36], [3e36, -2e36, 6e36, 1e36], [1e36, 1e36, 1e36, 9e36], [2e37, 1, 1, 1], [1, 2e37, 1, 1], [1, 1, 1, 2e37], [-2e37, 1, 1, 1]]
    directions = vectors + [[0, 0, 0], [1e-31, 0, 0], [3e-31, 3e-31, 3e-31], [5e-31, 5e-31, 5e-31], [1e-29, 2e-29, -1e-29], [1e-25, 0, 0],
                            [1e25, 2e25, -1e25], [4e29, 4e29, 1e29], [4e29, 4e29, 4e29], [-4e29, 4e29, 4e29], [2e30, 0, 0], [0, kNaN, 0],
                            [kInf, 0, 0], [0, 0, -kInf], [1e-30, 0, 0], [1e30, 0, 0], [2e-27, 0, 0], [0, 1.5e-30, 0], [0, 0, 9e29]]

    def hasDirection(v): return kShortest < sum(abs(x) for x in v) < kLongest
    write("math", "The helpers of core/math answer what they say, for numbers of all sizes, NaN and infinities.", [
        Function("Choose", "c:b x:2 y:3", ["choose(c, x.x, x.y)", "float(choose(c, int(x.x), int(x.y)))", "choose(c, x, y.xy).x",
                 "choose(c, x, y.xy).y", "choose(c, y, y.yzx).x", "choose(c, y, y.yzx).y", "choose(c, y, y.yzx).z",
                 "float(choose(c, ivec2(x), ivec2(y.xy)).x)", "float(choose(c, ivec2(x), ivec2(y.xy)).y)"],
                 [[1, 3, 4, 5, 6, 7], [0, 3, 4, 5, 6, 7]],
                 lambda c, x, y: ([x[0], x[0], x, y, x] if c else [x[1], x[1], y[:2], y[1:] + y[:1], y[:2]])),
        Function("Saturate", "v:3", ["saturate(v.x)", "saturate(v).x", "saturate(v).y", "saturate(v).z", "saturate(v.yz).x", "saturate(v.yz).y",
                 "smoothRamp(v.x)"], triples + [[0.9, 1.1, 0.1], [0.1, 0.9, 1.1]],
                 lambda v: [clamp01(v[0]), [clamp01(x) for x in v], [clamp01(x) for x in v[1:]], smooth(v[0])], relative=1e-6, absolute=0),
        Function("IsFinite", "v:4", ["number(isFinite(v.x))", "number(isFinite(v.xy))", "number(isFinite(v.xyz))", "number(isFinite(v))",
                 "finiteOr(v.x, 7.0)"], finites,
                 lambda v: [isNumber(v[0]), together(v[:2]), together(v[:3]), together(v), finiteOr(v[0], 7)], absolute=0),
        Function("Direction", "v:3 f:3", ["number(hasDirection(v))", "safeNormalize(v, f).x", "safeNormalize(v, f).y", "safeNormalize(v, f).z"],
                 [[v, [7, 8, 9]] for v in directions],
                 lambda v, f: [hasDirection(v), unit(v, f)], absolute=2e-7),
        Function("Magnitudes", "v:3", ["sumOfMagnitudes(v)", "minComponent(v)", "maxComponent(v)"], vectors,
                 lambda v: [sum(abs(x) for x in v), min(v), max(v)], relative=0, absolute=0),
        Function("SafeDivide", "a:1 b:1 f:1", ["safeDivide(a, b, f)"],
                 [[6, 3, 9], [-6, 4, 9], [6, -4, 9], [1, 0, 9], [0, 0, 9], [1, -0.0, 9], [kNaN, 2, 9], [2, kNaN, 9], [kInf, 2, 9], [1e30, 1e-10, 9],
                  [1e20, 1e-10, 9], [0, 5, 9], [1, 0.5, 9], [-1e30, 1e-10, 9], [1, 1, 9], [5, 1e-20, 9]], safeDivide),
        Function("AwayFromZero", "x:1 s:1", ["awayFromZero(x, s)"],
                 [[0, 0.5], [-0.0, 0.5], [0.25, 0.5], [-0.25, 0.5], [0.5, 0.5], [-0.5, 0.5], [2, 0.5], [-2, 0.5], [kNaN, 0.5], [-0.75, 0.5], [1.25, 2]],
                 awayFromZero, relative=0, absolute=0),
        Function("Constants", "x:1", ["kPi * x", "kFarAway * x", "kShortestVector * x", "kLongestVector * x"], [[1]],
                 lambda x: [math.pi, 65504.0, 1e-30, 1e30], absolute=0),
    ], ["crossray/core/math.glsl"])


# ---------------------------------------------------------------------------------------------------- core/view.glsl

kAxes = [[2 / 3, 2 / 3, -1 / 3], [-1 / 3, 2 / 3, 2 / 3], [2 / 3, -1 / 3, 2 / 3]]  # right, up, back of the table's camera in world space
kEye = [1.0, 2.0, 3.0]
kViews = """
// Cameras of one place and turn: perspective and orthographic, standard and reversed depth; images of 64 x 48 pixels.
View tableView(bool orthographic, bool reversed)
{
    vec4 right = vec4(2.0, 2.0, -1.0, 0.0) / 3.0;
    vec4 up = vec4(-1.0, 2.0, 2.0, 0.0) / 3.0;
    vec4 back = vec4(2.0, -1.0, 2.0, 0.0) / 3.0;
    mat4 world = mat4(right, up, back, vec4(1.0, 2.0, 3.0, 1.0));
    mat4 view = transpose(mat4(right, up, back, vec4(0.0, 0.0, 0.0, 1.0)));
    view[3] = vec4(-(view * vec4(1.0, 2.0, 3.0, 0.0)).xyz, 1.0);
    float nearDistance = 0.5;
    float farDistance = 64.0;
    // Depth 0 at the near plane and 1 at the far one, and its mirror image.
    float b = orthographic ? 1.0 / 63.5 : -32.0 / 63.5;
    float a = orthographic ? -0.5 / 63.5 : 64.0 / 63.5;
    a = reversed ? 1.0 - a : a;
    b = reversed ? -b : b;
    vec2 slope = vec2(0.8, 0.5);
    float z = orthographic ? -1.0 : 0.0;
    mat4 clip = orthographic ? mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -b, 0.0), vec4(0.0, 0.0, a, 1.0))
                             : mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -a, -1.0), vec4(0.0, 0.0, b, 0.0));
    return View(view, world, clip, vec2(64.0, 48.0), slope, a, b, nearDistance, farDistance, orthographic, reversed);
}
"""
kSlope, kSize, kNear, kFar = [0.8, 0.5], [64.0, 48.0], 0.5, 64.0


def toView(p): return [dot(axis, sub(p, kEye)) for axis in kAxes]
def toViewDir(d): return [dot(axis, d) for axis in kAxes]
def fromView(p): return add(kEye, [sum(p[k] * kAxes[k][i] for k in range(3)) for i in range(3)])


def deviceOf(z, ortho, reversedDepth):
    standard = (z - kNear) / (kFar - kNear) if ortho else (1 / kNear - 1 / z) / (1 / kNear - 1 / kFar)
    return 1 - standard if reversedDepth else standard


def linearOf(device, ortho, reversedDepth):
    if isCleared(device, reversedDepth):
        return kFar
    standard = 1 - device if reversedDepth else device
    if ortho:
        z = kNear + standard * (kFar - kNear)
    else:
        inverse = 1 / kNear - standard * (1 / kNear - 1 / kFar)
        z = 1 / inverse if abs(inverse) > 1e-12 else kFar
    return min(z, kFar) if z > 0 else kFar


def isCleared(device, reversedDepth):
    fromCleared = device if reversedDepth else 1 - device
    return not 0 < fromCleared < 1 + 2 ** -10  # nearer than the near plane by more than a rounding: nothing was drawn


def toScreen(p, ortho):
    """positionSS, linear depth, in front."""
    v = toView(p)
    z = -v[2]
    if not z > 0:
        return [0, 0, z, 0]
    x = [v[k] / (kSlope[k] * (1 if ortho else z)) for k in range(2)]
    place = [(x[0] * 0.5 + 0.5) * kSize[0], (0.5 - x[1] * 0.5) * kSize[1]]
    return [place, z, 1] if isNumber(place) else [0, 0, z, 0]


def rayDirNDC(ortho, p, d):
    v, dv = toView(p), toViewDir(d)
    z, rate = -v[2], -dv[2]
    if not z > 0 or not isNumber(z):
        return [0, 0, 0]
    at = lambda t: [(v[k] + t * dv[k]) / (kSlope[k] * (1 if ortho else z + t * rate)) for k in range(2)]
    # The derivative in closed form: of (x + t dx)/(z + t dz).
    change = [dv[k] / kSlope[k] if ortho else (dv[k] * z - v[k] * rate) / (kSlope[k] * z * z) for k in range(2)]
    way = math.hypot(*change)
    if not way > 1e-6 / z:
        return [0, 0, 0]
    return [change[0] / way, change[1] / way, -rate / (z * z) / way]


def viewTables():
    kinds = [[o, r] for o in (0, 1) for r in (0, 1)]
    devices = [0.0, 1.0, 0.25, 0.5, 0.75, 0.99, 0.015625, -0.25, 1.25, -2.0, 3.0, kNaN, 0.001, 0.9999, 1.0005, -0.0005, 1.002, -0.002, kInf, -kInf, 1 + 2 ** -10, -2 ** -10]
    points = [[0, 0, 0], [1, 2, 3], [-3, 1, 2], [4, 1, -5], [-2, 3, -1], [5, -6, 7], [-6, 4, 0.5], [1e20, 1e20, -1e30], [-7, 5, 1], [3, 1, 5]]
    directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-2 / 3, 1 / 3, -2 / 3], [0.6, -0.8, 0], [0, 0.6, 0.8], [2 / 3, -1 / 3, 2 / 3]]

    def toWorld(x, y, z): return fromView([x, y, -z])

    def placeOf(ortho, ss, z):
        ndc = [ss[0] / kSize[0] * 2 - 1, 1 - ss[1] / kSize[1] * 2]
        scale = 1 if ortho else z
        vs = [ndc[0] * kSlope[0] * scale, ndc[1] * kSlope[1] * scale, -z]
        return [ndc, vs, fromView(vs)]

    def viewDirection(ortho, p):
        back = kAxes[2]
        return back if ortho else unit(sub(kEye, p), back)

    ahead = [toWorld(0.3, -0.2, 2.0), toWorld(-4, 1, 8), toWorld(0, 0, 3), toWorld(0.5, 0.75, -1), toWorld(0.5, 0.75, 0.0), toWorld(1, -2, 30)]
    write("view", "Depth-buffer values, world, view and screen space go into one another as the projections are defined.", [
        Function("Depths", "o:b r:b d:1", ["number(isClearedDepth(tableView(o, r), d))", "linearDepthFromDevice(tableView(o, r), d)"],
                 [[o, r, d] for o, r in kinds for d in devices],
                 lambda o, r, d: [isCleared(d, r), linearOf(d, o, r)], relative=2e-4),
        # Of an infinite far plane depths go on beyond what counts as far; an orthographic view that begins at the eye stores what is not ahead of it.
        Function("InfiniteFar", "d:1", ["linearDepthFromDevice(v, d)"], [[d] for d in (1e-9, 0.001, 0.25, 1, 0)], lambda d: [min(0.5 / d, 65504) if d > 0 else 65504],
                 "View v = tableView(false, true);\nv.depthA = 0.0;\nv.depthB = 0.5;\nv.farDistance = 65504.0;"),
        Function("FromEye", "d:1", ["linearDepthFromDevice(v, d)"], [[d] for d in (-2 ** -13, -2 ** -12, 0, 0.25)], lambda d: [64 * (d + 2 ** -13) if d > -2 ** -13 else 64],
                 "View v = tableView(true, false);\nv.depthA = -0.0001220703125;\nv.depthB = 0.015625;"),
        Function("DeviceDepth", "o:b r:b z:1", ["deviceDepthFromLinear(tableView(o, r), z)"],
                 [[o, r, z] for o, r in kinds for z in ([0.5, 1, 2, 8, 64] if not o else [0.5, 1, 2, 8, 64, -3])] + [[0, 0, -1], [0, 1, 0], [0, 1, -8]],
                 lambda o, r, z: [deviceOf(z if z > 0 or o else kNear, o, r)]),
        Function("NearestDepth", "z:1", ["deviceDepthFromLinear(tableView(false, false), z) / 1e30"], [[1e-32], [1e-36], [1e-31]], lambda z: [-32 / 63.5]),
        Function("NoAxis", "p:3", ["d.x", "d.y", "d.z"], [[kEye], [[kNaN, 2, 3]]], lambda p: [0, 0, 1],
                 "View v = tableView(false, true);\nv.worldFromView[2] = vec4(0.0);\nvec3 d = viewDirectionWS(v, p);"),
        Function("NearEye", "z:1 d:3", ["found.x", "found.y", "found.z"], [[1e-20, [1, 0, 0]], [1e-25, [0.6, 0.8, 0]], [1e-19, [0, 1, 0]], [1e-22, [0, 0.6, -0.8]], [2, [1, 0, 0]]],
                 lambda z, d: [0, 0, 0] if z < 1e-18 else [1, 0, 0],
                 "View v = tableView(false, true);\nv.viewFromWorld = mat4(1.0);\nvec3 found = computeRayDirNDC(v, vec3(z, z, -z), d);"),
        # Nearly towards the eye, with exact matrices: a direction as long as the way on screen is more than rounding, at every depth.
        Function("Along", "z:1 x:1", ["found.x", "found.y", "found.z"], [[2, 1e-4], [1000, 1e-4], [0.25, 1e-4], [2, 1e-7], [1000, 1e-7]],
                 lambda z, x: [1, 0, -0.8 / (z * x)] if x / 0.8 > 1e-6 else [0, 0, 0],
                 "View v = tableView(false, true);\nv.viewFromWorld = mat4(1.0);\nvec3 found = computeRayDirNDC(v, vec3(0.0, 0.0, -z), vec3(x, 0.0, -1.0));"),
        Function("FromScreen", "o:b ss:2 z:1", ["positionNDCFromSS(tableView(o, false), ss).x", "positionNDCFromSS(tableView(o, false), ss).y",
                 "vs.x", "vs.y", "vs.z", "ws.x", "ws.y", "ws.z"],
                 [[o, ss, z] for o in (0, 1) for ss, z in [([0, 0], 1), ([64, 48], 2), ([10, 40], 4), ([50, 6], 0.75), ([32, 24], 8)]], placeOf,
                 "vec3 vs = positionVSFromSS(tableView(o, false), ss, z);\nvec3 ws = positionWSFromSS(tableView(o, false), ss, z);", absolute=4e-6),
        Function("ToScreen", "o:b p:3", ["found.positionSS.x", "found.positionSS.y", "found.linearDepth", "number(found.inFront)"],
                 [[o, p] for o in (0, 1) for p in points + ahead + [toWorld(0.1, -0.05, 0.25)]], lambda o, p: toScreen(p, o),
                 "ScreenPosition found = projectWSToSS(tableView(o, true), p);", absolute=2e-5, relative=4e-6),
        Function("Overflow", "o:b p:3", ["found.positionSS.x", "found.positionSS.y", "found.linearDepth", "number(found.inFront)"],
                 [[0, 1e37, 0, -0.001], [0, 0, 1e37, -0.001], [1, 1, 2, -3], [0, 1, 2, -3], [0, 1, 2, 0], [0, 3, 4, 5], [1, 3, 4, 5]],
                 lambda o, p: [[0, 0, -p[2], 0]] if abs(p[0]) > 1e30 or abs(p[1]) > 1e30 or p[2] >= 0 else
                 [(p[0] / (kSlope[0] * (1 if o else -p[2])) * 0.5 + 0.5) * 64, (0.5 - p[1] / (kSlope[1] * (1 if o else -p[2])) * 0.5) * 48, -p[2], 1],
                 "ScreenPosition found = projectVSToSS(tableView(o, true), p);"),
        Function("Directions", "o:b p:3 d:3", ["directionVSFromWS(tableView(o, true), d).x", "directionVSFromWS(tableView(o, true), d).y",
                 "directionVSFromWS(tableView(o, true), d).z", "toEye.x", "toEye.y", "toEye.z", "positionVSFromWS(tableView(o, true), p).x",
                 "positionVSFromWS(tableView(o, true), p).y", "positionVSFromWS(tableView(o, true), p).z"],
                 [[o, p, d] for o in (0, 1) for p, d in zip([[0, 0, 0], [1, 2, 3], [-3, 1, 2], [4, 1, -5], [-2, 3, -1], [5, -6, 7], [-6, 4, 0.5]], directions)],
                 lambda o, p, d: [toViewDir(d), viewDirection(o, p), toView(p)],
                 "vec3 toEye = viewDirectionWS(tableView(o, true), p);", absolute=4e-6),
        Function("OnScreen", "ss:2", ["number(isOnScreen(tableView(false, true), ss))", "screenScale(tableView(false, true)).x",
                 "screenScale(tableView(true, true)).y"],
                 [[0, 0], [64, 48], [0, 48], [64, 0], [-0.01, 5], [5, -0.01], [64.01, 5], [5, 48.01], [32, 24], [50, 47], [0, 20], [20, 0], [64, 20], [20, 48], [kNaN, 3], [3, kNaN]],
                 lambda ss: [0 <= ss[0] <= 64 and 0 <= ss[1] <= 48, 40, -48]),
        Function("RayDirNDC", "o:b p:3 d:3", ["found.x", "found.y", "found.z"],
                 [[o, p, unit(d)] for o in (0, 1) for p in ahead[:3] + ahead[5:] for d in ([1, 0, 0], [0, 1, 0], [-1, 2, 2], [0.1, 0.2, -1], [2, -1, 2])]
                 + [[o, p, 1, 0, 0] for o in (0, 1) for p in (ahead[3], ahead[4], kEye)]
                 + [[1, ahead[0], 2 / 3, -1 / 3, 2 / 3], [0, toWorld(0, 0, 4), -2 / 3, 1 / 3, -2 / 3], [0, kNaN, 0, 0, 1, 0, 0], [0, ahead[0], kNaN, 0, 0]],
                 lambda o, p, d: rayDirNDC(o, p, d) if isNumber(p, d) else [0, 0, 0],
                 "vec3 found = computeRayDirNDC(tableView(o, true), p, d);", absolute=1e-5, relative=2e-5),
    ], ["crossray/core/ray_ndc.glsl", "crossray/core/view.glsl"], kViews)


kNone, kNoRefractedRay, kDegenerateRay, kDegenerateInput = 0, 8, 9, 10  # reasons


# ------------------------------------------------------------------ hierarchy/, project/march_end, project/reprojection

def screenRamp(x, d, form):
    if not 0 <= x <= 1:
        return 0
    width = max(d / 2 if form == 2 else d, 1e-30)
    ramp = clamp01(min(x, 1 - x) / width) if d > 0 else 1
    return ramp if form == 0 else smooth(ramp)


def addTier(h, w):
    before = clamp01(h)
    got = min(clamp01(w), 1 - before)
    return [before + got, got]


def marchReason(reason, inFront, wasHidden):
    # Unknown by the border only in sight; a miss only where nothing hid the ray, on the way or at its end.
    if reason in (2, 4) and not inFront:
        return 3
    if reason == 7 and (wasHidden or not inFront):
        return 3
    return reason


def placeOfHistory(uv, placed=True):
    number = placed and isNumber(uv)
    return [uv if number else [0, 0], number and 0 <= uv[0] <= 1 and 0 <= uv[1] <= 1]


def hierarchyTables():
    coordinates = [0, 0.02, 0.05, 0.1, 0.15, 0.5, 0.84, 0.9, 0.97, 1, -0.01, 1.01, kNaN]
    weights = [0, 0.25, 0.5, 0.9, 1, 1.5, -0.5, kNaN]

    def byView(p):
        x, y, _, inFront = flat(toScreen(p, False))
        return placeOfHistory([x / 64, y / 48], bool(inFront))
    points = [fromView(x) for x in ([0, 0, -2], [0.8, 0.2, -2], [-1.5, 0.1, -2], [0, 2, -3], [0, -2, -3], [2, 0, -2], [0.1, 0.1, 1], [0.3, -0.4, -1])]
    write("hierarchy", "Fading at the border, sharing between tiers, the end of a march and the place in the previous frame follow their definitions.", [
        Function("ScreenWeight", "uv:2 d:1 form:i", ["computeScreenWeight(uv, d, form)"],
                 [[x, 0.5, d, f] for f in (0, 1, 2) for d in (0.1, 0.25) for x in coordinates] + [[0.5, x, 0.2, f] for f in (0, 1, 2) for x in coordinates]
                 + [[0.5, 0.5, 0, 0], [0, 1, 0, 1], [1, 0, -0.5, 2], [0.3, 0.7, kNaN, 0], [0.04, 0.06, 0.125, 1], [0.04, 0.06, 0.125, 2], [0.4, 0.3, 1, 0], [1.2, 0.5, 0, 0], [-0.01, 0.5, 0, 0], [0.5, -0.25, -1, 1], [5e-29, 0.5, 1e-28, 0], [0.5, 2e-31, 4e-31, 0]],
                 lambda uv, d, form: [screenRamp(uv[0], d, form) * screenRamp(uv[1], d, form)], relative=1e-5, absolute=1e-6),
        Function("Tiers", "h:1 w:1", ["addTier(h, w).hierarchyWeight", "addTier(h, w).weight", "addSky(h).hierarchyWeight", "addSky(h).weight"],
                 [[h, w] for h in weights for w in weights], lambda h, w: [addTier(h, w), addTier(h, 1)], relative=0, absolute=1e-7),
        Function("MarchEnd", "r:i f:b h:b", ["float(computeMarchReason(r, f, h))", "float(computeMarchClass(r))"],
                 [[r, f, h] for r in range(11) for f in (0, 1) for h in (0, 1)],
                 lambda r, f, h: [marchReason(r, f, h), 1 if r == 0 else 2 if r == 7 else 0 if r == 9 else 3], absolute=0),
        Function("ByMotion", "uv:2 m:2", ["r.positionUV.x", "r.positionUV.y", "number(r.isOnScreen)"],
                 [[0.5, 0.25, 0.125, -0.25], [0, 0, 0, 0], [1, 1, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0.75, 0], [0.5, 0.5, 0, 0.75], [0.5, 0.5, -0.75, 0], [0.5, 0.5, 0, -0.75],
                  [0.5, 0.5, kNaN, 0], [0.5, 0.5, 0, kInf], [0.25, 0.75, 0.5, 0.5], [0.75, 0.25, 0.5, 0.5]],
                 lambda uv, m: placeOfHistory(sub(uv, m)), "Reprojection r = reprojectByMotion(uv, m);", relative=0, absolute=0),
        Function("ByView", "p:3", ["r.positionUV.x", "r.positionUV.y", "number(r.isOnScreen)"], points, byView,
                 "Reprojection r = reprojectByView(tableView(false, true), p);", absolute=2e-6),
    ], ["crossray/hierarchy/screen_weight.glsl", "crossray/hierarchy/weights.glsl", "crossray/project/march_end.glsl", "crossray/project/reprojection.glsl"], kViews)


# --------------------------------------------------------------------------------------- debug/, shared/outputs.glsl

def fract(x): return x - math.floor(x)


def debugTables():
    bad = [1, 0, 1]

    def rayDir(d):
        if not isNumber(d):
            return bad
        z = safeDivide(0.1, d[2], 0)
        return [clamp01(d[0] / 2 + 0.5), clamp01(d[1] / 2 + 0.5), fract(z)]

    def index(i):
        bits = 0 if i <= 0 else (i - 1) % 7 + 1
        return [bits & 1, bits >> 1 & 1, bits >> 2 & 1]
    vectors = [[0.2, -0.6, 0.7], [1, 0, -1], [-0.9, 0.3, 0.25], [2, -3, 0.04], [kNaN, 0, 0], [0, kInf, 0], [0, 0, kNaN], [0.1, 0.9, 0], [-0.25, 0.5, 0.375],
               [0, 0, 1e-37]]
    write("debug_modes", "What a debug mode shows is the document's encoding of its value, and magenta for what is no number.", [
        Function("Vectors", "v:3", [f"{name}(v).{c}" for name in ("encodeDirection", "encodePositionNDC", "encodeRayDirNDC", "encodeColor") for c in "xyz"], vectors,
                 lambda v: [[clamp01(x / 2 + 0.5) for x in v] if isNumber(v) else bad,
                            [clamp01(v[0]), clamp01(v[1]), 0] if isNumber(v[:2]) else bad, rayDir(v), v if isNumber(v) else bad], absolute=2e-6),
        Function("Scalars", "x:1", [f"{name}(x).{c}" for name in ("encodeLinearDepth", "encodeWeight") for c in "xyz"],
                 [[x] for x in (0, 3, 12.5, 9.75, 104, 0.5, kNaN, kInf, -kInf)],
                 lambda x: [[fract(x * 0.1)] * 3 if isNumber(x) else bad, [x] * 3 if isNumber(x) else bad], absolute=4e-6),
        Function("Classes", "c:i", [f"{name}(c).{c}" for name in ("encodeHitClass", "encodeIndex") for c in "xyz"], [[c] for c in range(-1, 16)],
                 lambda c: [[0.5, 1, 0.5] if c == 1 else [0.5, 0.5, 1] if c in (2, 3) else [0, 0, 0], index(c)], relative=0, absolute=0),
        Function("Counts", "c:i m:i", [f"encodeCount(c, m).{c}" for c in "xyz"],
                 [[c, m] for c in (-3, 0, 1, 5, 16, 20) for m in (16, 1, 0, -4, 4)],
                 lambda c, m: [clamp01(c / m) if m > 0 else 0] * 3),
    ], ["crossray/debug/debug_modes.glsl"])


def outputTables():
    names = {"kOutput": "Color RayDirWS HitDepth HitSuccess HitReason TracingModel PositionNDC RayDirNDC IterationCount MaxUsedMipLevel IntersectionKind "
                        "HitWeight SampledColor HitPositionSS PathLength RayOriginWS TierWeights ProbeWeights ProbeDirWS ProbeMipLevel Confidence PlanarUV "
                        "PlanarStatus Transmittance ColorMipLevel HistoryUV FetchCount Count",
             "kHitClass": "NoRaycast Hit Miss Unknown",
             "kHitReason": "None IterationCap OffScreen BehindSurface NearPlane BehindCamera NoProxyHit Sky NoRefractedRay DegenerateRay DegenerateInput Count",
             "kTracingModel": "None ProxyInfinite ProxyBox ProxySphere Hiz Linear Patches ProxyProbe Own",
             "kIntersection": "None Cell Depth", "kRefraction": "None Sphere Box Thin", "kFresnel": "None Exact Schlick",
             "kScreenWeight": "Linear Smooth2018 SmoothToday"}
    functions = []
    for prefix, words in names.items():
        words = words.split()
        functions.append(Function(prefix[1:], "x:1", [f"float({prefix}{word}) * x" for word in words], [[1]], lambda x, n=len(words): list(range(n)),
                                  relative=0, absolute=0))
    write("outputs", "The numbers by which shaders and harness know outputs, classes, reasons and models are those that files hold.", functions,
          ["crossray/shared/outputs.glsl"])


def make():
    mathTables()
    viewTables()
    hierarchyTables()
    debugTables()
    outputTables()
