"""The table of the parts of project/linear.glsl, and of its march where two numbers are one: exactly on a surface, exactly as thick; see tables.py."""
from tables import copyOf, flat, Function, kInf, kNaN, single, unit, write
from tables_core import kSize, kViews
from tables_linear import kRecorder, marchRay, Undecided
from tables_project import screenRayInView

kSurfaces = """
int tableKind = 0; // 0: columns of 8 pixels, again after 32; 1: five pixels in a row; 2: a plane; 3: two folds
vec4 tableDepths = vec4(0.0);
float tableLast = 0.0;
ivec2 tableAxis = ivec2(1, 0);
bool tableOrthographic = false;

float fetchLinearDepth(ivec2 pixel)
{
    ivec2 from = pixel - ivec2(20, 30);
    int along = tableAxis.x == 1 ? from.x : from.y;
    int aside = tableAxis.x == 1 ? from.y : from.x;
    int at = tableKind == 0 ? pixel.x / 8 % 4 : along + 2;
    float depth = at == 0 ? tableDepths.x : at == 1 ? tableDepths.y : at == 2 ? tableDepths.z : at == 3 ? tableDepths.w : tableLast;
    bool isStray = tableKind == 1 && (aside != 0 || at < 0 || at > 4);
    float affine = tableDepths.x + tableDepths.y * float(pixel.x) + tableDepths.z * float(pixel.y);
    affine = tableKind == 3 ? tableDepths.x + tableDepths.y * abs(float(pixel.x - 50)) + tableDepths.z * abs(float(pixel.y - 46)) : affine;
    return tableKind >= 2 ? linearDepthFromAffine(tableOrthographic, affine) : isStray ? 0.015625 : depth;
}

""" + kRecorder + """
// A pixel a metre, and world space is view space.
View plainView() { return View(mat4(1.0), mat4(1.0), mat4(1.0), vec2(64.0, 48.0), vec2(32.0, 24.0), 0.0, 1.0, 0.5, 64.0, true, true); }
"""
kTolerance = 2.0 ** -12


def affineOf(o, z): return -z if o else 1 / max(z, single(1e-30))


def gradient(o, z, axis, place, last):
    """The side that goes on straight to the pixel; where only one has two pixels in the image, that one; none, or one that shows nothing: 0."""
    a = [affineOf(o, x) for x in z]
    bends = [abs(a[2] - 2 * a[1] + a[0]), abs(a[2] - 2 * a[3] + a[4])]
    before, after = place >= 2, last - place >= 2
    if not before and not after:
        return 0
    useBefore = bends[0] < bends[1] if before and after else before
    if z[1 if useBefore else 3] >= single(1e30):
        return 0
    return a[2] - a[1] if useBefore else a[3] - a[2]


def start(o, p, s, affine):
    """Depths of a plane: its number at pixel 0,0 and its slopes. `affine`: the ray's."""
    pixel = [min(max(int(x // 1), 0), int(n) - 1) for x, n in zip(s, kSize)]
    here = p[0] + p[1] * pixel[0] + p[2] * pixel[1]
    ahead = affine - (here + p[1] * (s[0] - pixel[0] - 0.5) + p[2] * (s[1] - pixel[1] - 0.5))
    return [pixel[0] + 0.5, pixel[1] + 0.5, here, p[1], p[2], ahead >= -abs(here) * kTolerance, abs(ahead) <= abs(here) * kTolerance]


def starts():
    rows = []
    for o, p in ((1, [-8, 0.03125, -0.0625]), (0, [0.25, 0.00390625, -0.001953125])):
        for s in ([10.25, 20.75], [33.5, 11.5], [-3.5, 10.25], [70.5, 8.25], [9.25, -2.5], [12.75, 50.5], [0.5, 47.25]):
            cx, cy, here, *_ = start(o, p, s, 0)
            plane = here + p[1] * (s[0] - cx) + p[2] * (s[1] - cy)
            # Exactly on the border of both conditions in the orthographic view, where all are sums of powers of two.
            rows += [[o, p, s, plane + t * abs(here) * kTolerance] for t in ((-1.5, -1, -0.5, 0, 0.5, 1, 1.5) if o else (-1.25, -0.75, 0, 0.75, 1.25))]
    return rows


def foldedStart(p, s):
    """In the folds both sides are straight, and only what the image holds of them decides."""
    depth = lambda x, y: -(p[0] + p[1] * abs(x - 50) + p[2] * abs(y - 46))
    x, y = [int(v) for v in s]
    return [gradient(1, [depth(x + k, y) for k in range(-2, 3)], 0, x, 63), gradient(1, [depth(x, y + k) for k in range(-2, 3)], 1, y, 47)]


def onPlane(o, a, g, x, y, z):
    affine = affineOf(o, z)
    return [abs(affine - (a + g[0] * (x - 20) + g[1] * (y - 30))) <= abs(affine) * kTolerance]


def end(a, d):
    return [min(max(min(((0 if v < 0 else n) - p) / v for p, v, n in zip(a, d, kSize)), 0), 1)]


def stride(s, n, e, length):
    return [e / max(n, 1) if n > 0 else (min(max(s, 0.001), 65536.0) if s > 0 else 1) * length]


def march(p, d, e, *settings):
    s = list(settings)
    s[3] = s[3] if s[3] > 0 else 0.0
    return marchRay(True, lambda i, j: e[i // 8 % 4], flat(screenRayInView(True, p, d, [32.0, 24.0])), *s, isExact=True)


def marches():
    across, x = [1, 0, 0], -29.25  # starts at pixel 2.75 and runs at one depth
    at = lambda depth, y=-5.5: [x, y, -depth]
    four, three = [4, 0, 256], [4, 0, 256, 0.5, 3]
    rows = [[at(4), across, e, *four, bias, h] for e in ([5, 4, 3, 9], [5, 9, 4, 3.5], [4, 3, 9, 5], [3, 9, 4, 9], [3, 3, 2, 3], [5, 3, 4, 2])
            for bias in (0.5, 1, 0) for h in (0, 1, 3)]
    # No bias is one that is negative or no number, and the largest is beyond all gaps.
    rows += [[at(4), across, [5, 9, 3, 6], *four, bias, 0] for bias in (-1, -8, kNaN, kInf, 1e30)]
    # The plane of the start goes on, exactly as far off as its tolerance, and farther.
    rows += [[at(4), across, [4, z, 9, z], *four, 1, 0] for z in (4 - 2.0 ** -9, 4 - 2.0 ** -10, 4 - 2.0 ** -11)]
    rows += [[at(4), across, [4 + 2.0 ** -k, 3.999, 9, 4 + 2.0 ** -k], *four, 1, 0] for k in (9, 11)]
    rows += [[at(4), across, [4 - 2.0 ** -k, 3.999, 9, 4 - 2.0 ** -k], *four, 1, 0] for k in (9, 11)]
    # The last sample alone is behind; the march is cut short before, in the middle of the halvings and after them.
    rows += [[at(4), across, [5, 5, 5, 3], 16, 0, most, bias, h] for bias in (0.5, 1) for most, h in ((256, 0), (256, 2), (4, 2), (5, 2), (6, 2), (3, 0))]
    rows += [[at(4), across, [5, 9, 3, 6], 4, 0, most, 1, 3] for most in (0, -3, 1, 4, 5, 6, 7, 8)] + [[at(4), across, [5, 9, 3, 6], 4, 0, 8, 0.25, h] for h in (-2, 0, 1)]
    # Straight away from the eye and towards it: one sample, which is the end.
    rows += [[at(z), [0, 0, s], e, *four, 1, h] for s in (-1, 1) for z, e in ((4, [4, 4, 4, 4]), (4, [5, 5, 5, 5]), (6, [5, 5, 5, 5]), (4, [1e30] * 4), (4, [0.25] * 4)) for h in (0, 2)]
    # Ways that end in the image, at the far plane and at the near one: what hid the ray on them, and whether something does at the end.
    rows += [[at(4), unit([0.25, 0, -1]), e, stride, 0, 256, bias, 0] for e in ([99, 99, 99, 99], [3, 99, 99, 99], [4, 99, 99, 99], [99, 10, 99, 99], [99, 99, 10, 10], [3, 3, 99, 99], [3, 99, 10, 99], [99, 10, 10, 99])
             for stride, bias in ((1, 1), (4, 20))]
    rows += [[at(60), unit([4, 0, -1]), e, 8, 0, 256, 1, 0] for e in ([99, 10, 99, 99], [99, 99, 99, 99])]  # one sample alone is hidden
    rows += [[at(40), unit([1, 0, 0.25]), [99, 37, 99, 99], 8, 0, 256, bias, h] for bias in (0.5, 1) for h in (0, -2)]  # nearer by the change of its depth
    rows += [[at(4), across, [5, 9, 3, 6], *four, 1, -2]]
    rows += [[at(10), unit([0.25, 0, 1]), [z] * 4, 0.5, 0, 256, 1, 0] for z in (99, 3, 0.25)]
    # Beyond what stands for no surface there is none all the same.
    rows += [[[x, -5.5, -1e35], [0, 0, 1], [1e30] * 4, *four, 1, 0], [at(4), across, [5, 1e30, 3e30, 6], *four, 1, 0]]
    # One sample less than the way's end by a thousandth and by a ten-millionth; parts of the way.
    way = 61.25
    rows += [[at(4), across, [5, 9, 6, 8], way * k / n, 0, 256, 1, 0] for n in (1, 4) for k in (0.9995, 0.9998, 1.001)]
    rows += [[at(4), across, [5, 9, 3, 6], 1, n, 256, bias, 2] for n in (1, 7, 13) for bias in (0.5, 2)]
    return [row for row in rows if isDecided(row)]


def isDecided(row):
    try:
        march(*row)
    except Undecided:
        return False
    return True


def make():
    five = [[8, 6, 4, 3, 1], [1, 3, 4, 6, 8], [8, 6, 4, 2, 0.5], [1, 3, 4, 5, 7], [4, 4, 4, 4, 4], [2, 3, 4, 7, 10], [16, 8, 4, 2, 1], [1e30, 1e30, 4, 0.5, 4], [1e30, 1e30, 4, 2, 1e30],
            [4, 0.5, 4, 1e30, 1e30], [0.5, 9, 4, 3, 1e30], [3, 9e29, 4, 0.25, 8], [3e30, 2e30, 4, 0.5, 4], [4, 0.5, 4, 3e30, 2e30], [7, 5, 4, 6, 9], [9, 6, 4, 5, 7]]
    places = [(8, 63), (2, 63), (1, 63), (0, 63), (61, 63), (62, 63), (63, 63), (2, 4), (1, 4), (3, 4), (1, 3), (2, 3), (1, 2), (0, 0)]
    rows = [[o, z, axis, 8, 63] for o in (0, 1) for z in five for axis in (0, 1)] + [[o, z, (o + k) % 2, *place] for o in (0, 1) for k, z in enumerate((five[0], five[5], five[14])) for place in places]
    view = "tableView(o, true)"
    planes = [[1, -9 + t / 512, [0.25, -0.5], 22, 29, 8] for t in (-1.5, -1, -0.5, 0, 0.5, 1, 1.5)] + [[0, -0.75 + t / 16384, [0.25, -0.5], 22, 29, 4] for t in (-1.5, -1, -0.5, 0, 0.5, 1, 1.5)]
    planes += [[o, -8 if o else 0.25, [1, 2], x, y, 8 if o else 4] for o in (0, 1) for x, y in ((20, 30), (22, 29), (21, 30), (20, 31), (18, 31))]
    write("linear_parts", "The parts of the linear march, and the march where a ray lies exactly on a surface or exactly its thickness behind.", [
        Function("Gradient", "o:b a:4 b:1 axis:i place:i last:i", ["computeLinearGradient(" + view + ", ivec2(20, 30), tableAxis, place, last)"],
                 [[row[0], row[1][:4], row[1][4], *row[2:]] for row in rows], lambda o, a, b, *rest: gradient(o, a + [b], *rest),
                 "tableKind = 1;\ntableDepths = a;\ntableLast = b;\ntableAxis = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);"),
        Function("Start", "o:b p:3 s:2 a:1", ["t.centerSS.x", "t.centerSS.y", "t.affineDepth", "t.gradient.x", "t.gradient.y", "number(t.inFront)", "number(t.isOn)"], starts(), start,
                 "tableKind = 2;\ntableDepths = vec4(p, 0.0);\ntableOrthographic = o;\n"
                 "LinearStart t = makeLinearStart(" + view + ", ScreenRay(s, vec2(5.0, 3.0), 0.2, a, 0.0, 0, 0), ivec2(63, 47));", relative=1e-5, absolute=2e-6),
        Function("Folds", "p:3 s:2", ["t.gradient.x", "t.gradient.y"], [[[-8, 0.0625, 0.03125], s] for s in ([50.5, 46.5], [50.5, 30.5], [20.5, 46.5])], foldedStart,
                 "tableKind = 3;\ntableDepths = vec4(p, 0.0);\ntableOrthographic = true;\n"
                 "LinearStart t = makeLinearStart(tableView(true, true), ScreenRay(s, vec2(5.0, 3.0), 0.2, -4.0, 0.0, 0, 0), ivec2(63, 47));"),
        Function("OnPlane", "o:b a:1 g:2 x:i y:i z:1", ["number(isOnStartPlane(" + view + ", LinearStart(vec2(20.5, 30.5), a, g, true, true), ivec2(x, y), z))"], planes, onPlane),
        Function("End", "a:2 d:2", ["computeLinearEnd(tableView(false, true), ScreenRay(a, d, 0.1, 0.0, 0.0, 0, 0))"],
                 [[a, d] for a in ([10, 40], [60, 4], [70, 10], [10, -5]) for d in ([5, 3], [100, 60], [-100, 3], [5, -60], [200, -1e-20], [1e-20, 96])], end),
        Function("Stride", "s:1 n:i end:1 p:1", ["computeLinearStride(LinearSettings(s, n, 1, 0.0, 0), ScreenRay(vec2(0.0), vec2(1.0), p, 0.0, 0.0, 0, 0), end)"],
                 [[s, n, 0.75, 0.125] for s in (4, 0, -1, kNaN, 1e-5, 1e6) for n in (0, 1, 5)], stride),
        Function("RayDepth", "o:b s:1", ["linearRayDepth(" + view + ", r, s)"], [[o, s] for o in (0, 1) for s in (0, 0.5, 1)],
                 lambda o, s: [-0.5 + 0.25 * s if o else 1 / (0.5 - 0.25 * s)], "ScreenRay r = ScreenRay(vec2(3.0, 5.0), vec2(10.0, -4.0), 0.1, 0.5, -0.25, 0, 0);"),
        Function("March", "p:3 d:3 e:4 stride:1 n:i most:i bias:1 h:i",
                 ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.intersectionKind)", "recorded", "recordedKinds"],
                 marches(), march, "tableDepths = e;\nLinearResult r = traceLinear(plainView(), p, d, LinearSettings(stride, n, most, bias, h));\ntableKind = 0;", relative=2e-4, absolute=2e-3),
    ], [], kViews + copyOf("crossray/project/linear.glsl") + kSurfaces)
