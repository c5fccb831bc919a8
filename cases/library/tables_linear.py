"""The table of project/linear.glsl: the march over surfaces that are formulas; see tables.py."""
import math
from tables import Function, add, copyOf, dot, flat, mul, sub, unit, write
from tables_core import fromView, kEye, kSize, kSlope, kViews
from tables_project import screenRay

kRecorder = """float recorded = 0.0; // a sum over the steps that knows their order
float recordedKinds = 0.0;
void recordLinearStep(LinearStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * step.rayLinearDepth + 5.0 * min(step.surfaceLinearDepth, 20.0));
    recordedKinds += float(step.intersectionKind) * float(step.iteration + 1);
}
"""
kSurfaces = """
int tableKind = 0;

// Floor and back wall; a wall with a hole, behind which nothing is; a slab that floats before a wall; a step to the right; small and nearly flat.
float fetchLinearDepth(ivec2 pixel)
{
    float x = float(pixel.x) + 0.5;
    float y = float(pixel.y) + 0.5;
    float floorDepth = y > 26.0 ? 1.0 / (0.0234375 * (y - 24.0)) : 1e30;
    float depth = min(floorDepth, 12.0);
    bool isHole = pixel.x >= 36 && pixel.x < 52;
    depth = tableKind == 1 ? (isHole ? 1e30 : 1.0 / (0.125 + 0.0009765625 * x)) : depth;
    bool isSlab = pixel.x >= 28 && pixel.x < 40 && pixel.y >= 10 && pixel.y < 30;
    depth = tableKind == 2 ? (isSlab ? 3.0 : 1.0 / (0.25 - 0.001953125 * y)) : depth;
    depth = tableKind == 3 ? (pixel.x < 30 ? 1.0 / (0.25 - 0.00390625 * x) : 1.0 / (0.125 + 0.00390625 * (x - 30.0))) : depth;
    return depth;
}

""" + kRecorder


def depthAt(kind, i, j):
    x, y = i + 0.5, j + 0.5
    if kind == 1:
        return 1e30 if 36 <= i < 52 else 1 / (0.125 + 0.0009765625 * x)
    if kind == 2:
        return 3.0 if 28 <= i < 40 and 10 <= j < 30 else 1 / (0.25 - 0.001953125 * y)
    if kind == 3:
        return 1 / (0.25 - 0.00390625 * x) if i < 30 else 1 / (0.125 + 0.00390625 * (x - 30))
    return min(1 / (0.0234375 * (y - 24)) if y > 26 else 1e30, 12.0)


class Undecided(Exception):
    """A decision that a rounding would turn."""


def decide(a, b, share=2e-4, least=1e-6):
    """a < b."""
    if abs(a - b) <= share * max(abs(a), abs(b)) + least:
        raise Undecided
    return a < b


def march(o, kind, px, py, lift, d, *settings):
    z = depthAt(kind, px, py) * (1 + lift)
    ndc = [(px + 0.5) / 32 - 1, 1 - (py + 0.5) / 24]
    origin = fromView([ndc[0] * kSlope[0] * (1 if o else z), ndc[1] * kSlope[1] * (1 if o else z), -z])
    direction = sub(fromView(d), kEye)
    return marchRay(o, lambda i, j: depthAt(kind, i, j), flat(screenRay(o, origin, direction)), *settings)


def marchRay(o, depth, ray, stride, steps, most, bias, halvings, isExact=False):
    """isExact: depths are numbers that floats hold, and of two equal ones the comment of the file says which is which."""
    affine = (lambda z: -z) if o else (lambda z: 1 / z)
    back = (lambda a: -a) if o else (lambda a: 1 / max(a, 1e-30))
    less = (lambda a, b, *_: a < b) if isExact else decide
    sx, sy, dx, dy, pixelLength, a0, da, reason, status = ray
    px, py = [min(max(int(math.floor(p)), 0), int(n) - 1) for p, n in zip((sx, sy), kSize)]
    assert status == 0
    end = min(max(min(((0 if v < 0 else k) - s) / v for s, v, k in zip((sx, sy), (dx, dy), kSize)), 0), 1)
    step = end / steps if steps > 0 else (min(max(stride, 0.001), 65536) if stride > 0 else 1) * pixelLength
    bias = bias if bias > 0 else 0
    endReason = 2 if end < 1 else reason

    def gradient(axis, place, last):
        at = lambda k: affine(depth(px + k * (1 - axis), py + k * axis))
        before, after = place >= 2, place <= last - 2
        if not (before or after):
            return 0.0
        if before and after:
            bends = [abs(at(0) - 2 * at(s) + at(2 * s)) for s in (-1, 1)]
            if abs(bends[0] - bends[1]) < 1e-6 * abs(at(0)) and abs(at(0) - at(-1) - at(1) + at(0)) > 1e-6 * abs(at(0)):
                raise Undecided
            useBefore = bends[0] < bends[1]
        else:
            useBefore = before
        side = -1 if useBefore else 1
        if depth(px + side * (1 - axis), py + side * axis) >= 1e30:
            return 0.0
        return (at(0) - at(side)) * (1 if useBefore else -1)
    slope = [gradient(0, px, 63), gradient(1, py, 47)]
    here = affine(depth(px, py))
    ahead = a0 - here - dot(slope, [sx - px - 0.5, sy - py - 0.5])
    tolerance = abs(here) / 4096
    if 0.5 * tolerance < abs(ahead) < 1.5 * tolerance and not isExact:
        raise Undecided
    on = abs(ahead) <= tolerance
    startsInFront = ahead >= -tolerance

    def look(s):
        """Position, the ray's and the surface's depth, whether the ray is behind."""
        p = [sx + dx * s, sy + dy * s]
        for x, size in zip(p, kSize):
            if abs(x - round(x)) < 1e-3 and 0.5 < x < size - 0.5:
                raise Undecided
        i, j = min(max(int(math.floor(p[0])), 0), 63), min(max(int(math.floor(p[1])), 0), 47)
        surface, ray = depth(i, j), back(a0 + da * s)
        if surface >= 1e30:
            return p, ray, surface, False
        strays = abs(affine(surface) - here - dot(slope, [i - px, j - py]))
        bound = abs(affine(surface)) / 4096
        if on and 0.5 * bound < strays < 1.5 * bound and not isExact:
            raise Undecided
        own = on and strays <= bound
        return p, ray, surface, not own and (ray > surface if isExact else not decide(ray, surface, 4e-5))

    inFront, hidden = startsInFront, not startsInFront
    taken, last, kindOf, iterations, total, kinds = 0, 0.0, 0, 0, 0.0, 0
    inner = outer = gap = 0.0
    left, result = 0, None
    for k in range(most):
        halving = left > 0
        following = (taken + 1) * step
        s = (inner + outer) / 2 if halving else following if decide(following, end * (1 - 1e-6), 1e-5 if following > end or abs(following - end) > 1e-5 * end else 0, 0) else end
        p, ray, surface, behind = look(s)
        hit, passed, wasDecided = False, False, False
        if halving:
            if behind:
                outer, gap = s, ray - surface
            else:
                inner = s
            left -= 1
            wasDecided = left == 0
        else:
            taken += 1
            if behind and inFront:
                inner, outer, gap, left = last, s, ray - surface, max(halvings, 0)
                wasDecided = left == 0
                starts = True
            else:
                hidden = hidden or (behind and not inFront)
                inFront = not behind
            last = s
        if halving or (behind and outer == s and last == s and gap == ray - surface and inFront):
            inFront = True
        if wasDecided:
            hit = not less(max(bias, abs(back(a0 + da * outer) - back(a0 + da * inner))), gap, 1e-4)
            if not hit:
                inFront, hidden = False, True
        kindOf = 2 if hit else 1 if behind else 0
        share = 1 / (k + 2)
        total += share * (p[0] + 2 * p[1] + 3 * ray + 5 * min(surface, 20.0))
        kinds += kindOf * (k + 1)
        iterations = k + 1
        if hit:
            result = 0
            break
        if last >= end and left == 0:
            result = endReason
            break
    if result is None:
        result = 1
    if result == 0:
        where = outer
    else:
        where = last
        if result in (2, 4) and not inFront or result == 7 and (hidden or not inFront):
            result = 3
    hitClass = 1 if result == 0 else 2 if result == 7 else 3
    return [hitClass, result, sx + dx * where, sy + dy * where, back(a0 + da * where), iterations, kindOf, total, kinds]


def noStart(p, d):
    """What a march answers that cannot start: class, reason, position, depth, steps."""
    sx, sy, *_, affine, _, _, status = flat(screenRay(False, p, d))
    if status != 0:
        return [0 if status == 9 else 2 if status == 7 else 3, status, 0, 0, 1, 0]
    return [3, 2, sx, sy, 1 / affine, 0]


def noStarts():
    at = lambda x, y, z: fromView([x, y, -z])
    away = sub(fromView([0.1, 0.2, -1]), kEye)
    towards = sub(fromView([0.1, 0.2, 1]), kEye)
    nan = float("nan")
    rows = [[at(*p), d] for p in ((4, 0, 2), (-4, 0.3, 2), (0.1, 3, 2), (0.2, -3, 4)) for d in (away, towards)]
    rows += [[at(0.1, 0.1, 2), [0, 0, 0]], [[nan, 0, 0], away], [at(0.1, 0.1, 2), [0, nan, 0]], [at(0.1, 0.1, 0.25), towards], [at(0, 0, -2), away], [at(0.1, 0.1, 80), away]]
    return [row for row in rows if row is not None]


def hiddenStarts():
    """Off the image, and farther away than what its border shows."""
    return [[fromView(p), sub(fromView([0.1, 0.2, s]), kEye)] for p in ([-50, 3, -40], [3, 40, -40]) for s in (-1, 1)]


def make():
    rows = []
    starts = {0: [(20, 40), (10, 30), (50, 44), (33, 36)], 1: [(10, 20), (30, 40), (58, 9)], 2: [(12, 20), (34, 20), (50, 40)], 3: [(12, 20), (40, 30), (29, 10), (1, 24)]}
    ways = {0: [[0.2, 0.5, -1], [1, 0.2, -0.5], [-0.4, 0.15, -0.6], [0.3, 0.6, 0.4]], 1: [[1, -0.2, 0.1], [0.8, 0.3, 0.5], [-0.5, 0.4, 0.2], [1, 0.1, -0.15]],
            2: [[1, -0.1, 0.2], [0.9, 0.25, 0.05], [-0.5, 0.6, 0.3], [1, 0.02, -0.4]], 3: [[1, 0.1, 0.2], [1, -0.15, 0.02], [-0.7, 0.2, 0.3], [0.6, 0.5, -0.8]]}
    settings = [[4, 0, 256, 1, 0], [1, 0, 256, 0.25, 0], [6, 0, 256, 0.5, 4], [4, 16, 256, 0.125, 3], [4, 9, 256, 3, 0], [0, 0, 30, 1, 2], [2.5, 0, 7, 1, 1], [3, 0, 200, -1, 5], [5, 0, 0, 1, 0], [8, 0, 256, 40, 2]]
    for o in (0, 1):
        for kind in starts:
            for (px, py) in starts[kind]:
                for k, d in enumerate(ways[kind]):
                    for lift in (0.0, -0.02, 0.05):
                        rows += [[o, kind, px, py, lift, unit(d), *s] for s in settings[(k + px) % 3::3]]

    def right(row):
        from tables import single
        row = [single(x) for x in flat(row)]
        try:
            march(*row[:2], int(row[2]), int(row[3]), row[4], row[5:8], row[8], int(row[9]), int(row[10]), row[11], int(row[12]))
        except (Undecided, AssertionError):
            return False
        return True
    rows = [row for row in rows if right(row)]
    write("linear", "The linear march samples, halves, hits and passes as its definition says, over surfaces that are formulas.", [
        Function("March", "o:b k:i x:i y:i lift:1 d:3 stride:1 n:i most:i bias:1 h:i",
                 ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.intersectionKind)", "recorded", "recordedKinds"],
                 rows, march,
                 "tableKind = k;\nView v = tableView(o, true);\nfloat z = fetchLinearDepth(ivec2(x, y)) * (1.0 + lift);\nvec3 p = positionWSFromSS(v, vec2(float(x) + 0.5, float(y) + 0.5), z);\n"
                 "vec3 w = (v.worldFromView * vec4(d, 0.0)).xyz;\nLinearResult r = traceLinear(v, p, w, LinearSettings(stride, n, most, bias, h));", relative=2e-4, absolute=2e-3),
        Function("NoStart", "p:3 d:3", ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)"], noStarts() + hiddenStarts(), noStart,
                 "LinearResult r = traceLinear(tableView(false, true), p, d, LinearSettings(4.0, 0, 100, 1.0, 0));", relative=2e-5, absolute=1e-4),
    ], [], kViews + copyOf("crossray/project/linear.glsl") + kSurfaces)
