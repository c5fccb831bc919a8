"""Tables of probe/ and project/proxy.glsl; see tables.py."""
import math
from tables import Function, add, clamp01, dot, flat, isNumber, kInf, kNaN, length, mul, single, smooth, sub, unit, write
from tables_core import kAxes, kDegenerateInput, kDegenerateRay, kViews, fromView, safeDivide, toView

kTurn = """
// A rotation without a zero: its columns are the axes.
mat3 tableTurn(bool turned)
{
    mat3 turn = mat3(vec3(2.0, 2.0, -1.0) / 3.0, vec3(-1.0, 2.0, 2.0) / 3.0, vec3(2.0, -1.0, 2.0) / 3.0);
    return turned ? turn : mat3(1.0);
}
"""
kFar = 65504.0


def local(v, turned): return [dot(axis, v) for axis in kAxes] if turned else list(v)


# ------------------------------------------------------------------------------------------------ project/proxy.glsl

def miss(origin, reason): return [origin if isNumber(origin) else [0, 0, 0], 0, 0, reason]


def hitAt(origin, d, t):
    t = max(t, 0.0)
    p = add(origin, mul(d, t))
    return [p, t, 1, 0] if isNumber(p) else miss(origin, kDegenerateRay)


def proxyBox(origin, direction, center, turned, half):
    d = unit(direction)
    if length(d) < 0.5 or not isNumber(origin):
        return miss(origin, kDegenerateRay)
    if not (min(half) >= 0 and isNumber(half) and all(h == h for h in half)):
        return miss(origin, kDegenerateInput)
    o, v = local(sub(origin, center), turned), local(d, turned)
    enter, leave = -1e30, 1e30
    for k in range(3):
        if abs(v[k]) < 1e-7:
            if abs(o[k]) > half[k] * (1 + 1e-5):
                return miss(origin, 6)
            continue
        a, b = sorted(((-half[k] - o[k]) / v[k], (half[k] - o[k]) / v[k]))
        enter, leave = max(enter, a), min(leave, b)
    margin = 1e-5 * max(half)
    if leave >= enter - margin and leave >= -margin and leave < 1e29:
        return hitAt(origin, d, leave)
    return miss(origin, 6)


def proxySphere(origin, direction, center, radius):
    d = unit(direction)
    if length(d) < 0.5 or not isNumber(origin):
        return miss(origin, kDegenerateRay)
    if not (radius >= 0 and isNumber(radius)):
        return miss(origin, kDegenerateInput)
    o = sub(origin, center)
    b = dot(o, d)
    disc = b * b - (dot(o, o) - radius * radius)
    if disc < -1e-6 * radius * radius:
        return miss(origin, 6)
    if radius * radius > 3.4e38:
        return miss(origin, kDegenerateRay)  # no float holds the square: the answer stays finite
    leave = math.sqrt(max(disc, 0)) - b
    if radius < length(o) <= radius * (1 + 1e-5):
        leave = max(leave, 0)  # an origin on the sphere to the tolerance is inside
    return hitAt(origin, d, leave) if leave >= -1e-5 * radius else miss(origin, 6)


def proxyInfinite(origin, direction):
    d = unit(direction)
    return hitAt(origin, d, kFar) if length(d) > 0.5 and isNumber(origin) else miss(origin, kDegenerateRay)


kRays = [([0, 0, 0], [1, 2, 3]), ([0.5, -0.5, 1], [-1, 0.5, 0.25]), ([0, 0, 0], [0, 0, -2]), ([1, 1, 1], [0, 1, 0]), ([-1.5, 0.5, 2], [3, -1, -2]),
         ([0.2, 0.1, -0.3], [-4, -5, 6]), ([0.5, 0.25, 0.125], [1, 1e-9, -1e-9])]
kOutside = [([-9, 0, 0], [1, 0.05, 0.02]), ([9, 0, 0], [1, 0, 0]), ([0, 20, 0], [0.1, -1, 0.2]), ([0, 20, 0], [1, -0.1, 0]), ([0, 0, -30], [0, 0, 1]), ([7, 7, 7], [1, -1, 0]),
            ([12, 1, 1], [0, 0, 1])]
kBad = [([kNaN, 0, 0], [1, 0, 0]), ([0, kInf, 0], [1, 0, 0]), ([0, 0, 0], [0, 0, 0]), ([0, 1, 0], [kNaN, 1, 0]), ([0, 0, 2], [0, kInf, 0]), ([1e36, 2e36, 0], [1, 0, 0]),
        ([2e37, 0, 0], [0, 1, 0])]


def proxyTables():
    center, half = [0.5, -0.25, 1.0], [3.0, 2.0, 4.0]
    boxes = [[o, d, center, t, half] for t in (0, 1) for o, d in kRays + kOutside + kBad]
    boxes += [[[0, 0, 0], [1, 2, 3], [0, 0, 0], 0, h] for h in ([0, 0, 0], [-1, 2, 2], [2, -1, 2], [2, 2, -1], [kNaN, 1, 1], [1, kNaN, 1], [1, 1, kNaN], [kInf, 1, 1], [0, 5, 5], [5, 0, 5], [5, 5, 0])]
    # On faces: outwards is there, along them and inwards is across.
    for k in range(3):
        for s in (-1, 1):
            on = [0.25, 0.25, 0.25]
            on[k] = s * half[k]
            out, across, off = [0.1, 0.1, 0.1], [1, 1, 1], list(on)
            out[k], across[k], off[k] = s, 0, on[k] * 1.25
            boxes += [[on, out, [0, 0, 0], 0, half], [on, mul(out, -1), [0, 0, 0], 0, half], [on, across, [0, 0, 0], 0, half], [off, across, [0, 0, 0], 0, half],
                      [off, out, [0, 0, 0], 0, half]]
            near = list(on)
            near[k] = on[k] * (1 + 5e-6)
            boxes += [[near, across, [0, 0, 0], 0, half], [near, out, [0, 0, 0], 0, half]]
            far = list(on)
            far[k] = on[k] * (1 + 3e-5)
            boxes += [[far, across, [0, 0, 0], 0, half]]
    boxes += [[[-8, 0, 0], [1, 1, 0], [0, 0, 0], 0, [3, 4.5, 4]], [[-8, 0, 0], [1, 1, 0], [0, 0, 0], 0, [3, 5.5, 4]], [[0, 0, 0], [1e-8, 1e-8, 1], [0, 0, 0], 0, [1, 1, 1e9]],
              [[0.5, 0, 0], [2e-7, 0, 1], [0, 0, 0], 0, [1, 1, 1e8]], [[0.5, 0, 0], [5e-8, 0, 1], [0, 0, 0], 0, [1, 1, 1e8]]]
    # What is beyond all distances is met nowhere; along a face of a plane; past an edge within the tolerance and beyond it.
    boxes += [[[0, 0, 0], [0, 0, 1], [0, 0, 0], 0, h] for h in ([1, 1, 5e28], [1, 1, 1e29], [1, 1, 1e31])] + [[[0, 0, 0], [0, 1, 0], [0, 0, 0], 0, [0, 5, 5]], [[0, 0, 0], [0, 0, 1], [0, 0, 0], 0, [5, 0, 5]]]
    boxes += [[[-2, 0, 0], [1, 1, 0], [0, 0, 0], 0, [1, h, 1]] for h in (1 - 4e-6, 1, 1 - 3e-5)]
    boxes += [[o, [0, 1, 1], [0, 0, 0], 0, [1, *h]] for h in (1 - 4e-6, 1 - 3e-5) for o, h in (([0, -2, 0], [1, h]), ([0, 0, -2], [h, 1]))]
    # The hit lies on its face to the last bits, though the sum of origin and way is half a millimetre beside it; where it is the origin, it
    # stays there.
    exact = []
    for k in range(3):
        for s in (-1, 1):
            far, along, beyond = [0.25, -0.5, 0.125], [0, 0, 0], [0.25, -0.5, 0.125]
            far[k], along[k], beyond[k] = -s * (8191 + 2 ** -11), s, s * 1024 * (1 + 2 ** -18)
            exact += [[far, along, [0, 0, 0], 0, half], [beyond, along, [0, 0, 0], 0, [1024] * 3]]
    spheres = [[o, d, center, 5] for o, d in kRays + kOutside + kBad] + [[[0, 0, 0], [1, 2, 3], [0, 0, 0], r] for r in (0, -1, kNaN, kInf, 2)]
    spheres += [[[1e30, 0, 0], [1, 0, 0], [0, 0, 0], 1]]  # behind, so far that the squares overflow
    spheres += [[[3, 0, 0], [1, 0, 0], [0, 0, 0], 3], [[3, 0, 0], [-1, 0, 0], [0, 0, 0], 3], [[3, 0, 0], [0, 1, 0], [0, 0, 0], 3], [[0, 3, 0], [1, 1, 0], [0, 0, 0], 3],
                [[0, 0, -3], [0, 1, 1], [0, 0, 0], 3], [[0, 0, -3], [0, 1, -1], [0, 0, 0], 3], [[-7, 3.5, 0], [1, 0, 0], [0, 0, 0], 3], [[-7, 2.5, 0], [1, 0, 0], [0, 0, 0], 3],
                [[7, 2.5, 0], [1, 0, 0], [0, 0, 0], 3], [[0, 1, 0], [0, 1, 0], [0, 0, 0], 3], [[2, -1, 0.5], [5, 1, 0], [0, 0, 0], 3], [[1, 0, 0], [1, 0, 0], [0, 0, 0], 1.000005]]
    # A ray that touches, that passes within the tolerance, and just beyond it; an origin within the tolerance of the sphere, from which the
    # ray leaves at a flat angle; one near a large sphere, where the difference of the roots cancels; a square that no float holds.
    spheres += [[[-7, 3, 0], [1, 0, 0], [0, 0, 0], 3], [[-200, 0, 100.00003], [1, 0, 0], [0, 0, 0], 100], [[-7, 0, 3.00015], [1, 0, 0], [0, 0, 0], 3],
                [[1 + 5e-6, 0, 0], [0.005, 1, 0], [0, 0, 0], 1], [[100.0005, 0, 0], [1, 0, 0], [0, 0, 0], 100], [[8191.5, 0, 0], [3, 4, 0], [0, 0, 0], 8192], [[0, 0, 0], [1, 2, 3], [0, 0, 0], 1e20], [[2, 0, 0], [1, 0, 0], [0, 0, 0], 1e20],
                [[8192, 0, 0], [0.9, 8192, 0], [0, 0, 0], 8192]]  # and one on it, along which it would be noise
    out = ["hit.positionWS.x", "hit.positionWS.y", "hit.positionWS.z", "hit.distance", "number(hit.hit)", "float(hit.reason)"]
    write("proxy", "A ray meets a box or a sphere from inside where its far face is, and every ray that meets none says why.", [
        Function("Box", "o:3 d:3 c:3 turned:b h:3", out, boxes, proxyBox, "ProxyHit hit = projectProxyBox(o, d, c, tableTurn(turned), h);", absolute=6e-5, relative=2e-5),
        Function("OnFace", "o:3 d:3 c:3 turned:b h:3", out, exact, proxyBox, "ProxyHit hit = projectProxyBox(o, d, c, tableTurn(turned), h);", relative=5e-7),
        Function("Sphere", "o:3 d:3 c:3 r:1", out, spheres, proxySphere, "ProxyHit hit = projectProxySphere(o, d, c, r);", absolute=3e-5, relative=2e-5),
        Function("Infinite", "o:3 d:3", out, kRays + kBad, proxyInfinite, "ProxyHit hit = projectProxyInfinite(o, d);"),
    ], ["crossray/project/proxy.glsl"], kTurn)


# ---------------------------------------------------------------------------------- probe/parallax, box_projection, shapes

def parallax(p, d, shape, center, turned, half, nearest, capture):
    u = unit(d)
    if shape == 2:
        hit = proxyBox(p, d, center, turned, half)
    elif shape == 3:
        hit = proxySphere(p, d, center, half[0])
    elif shape == 1:
        hit = proxyInfinite(p, d)
    else:
        hit = miss(p, kDegenerateInput)
    _, t, met, reason = hit
    if length(u) < 0.5 or not isNumber(p) or reason == kDegenerateRay:
        return [u, 0, 0, 0, kDegenerateRay]
    nearest = min(nearest, kFar) if nearest > 0 else 0
    t = max(t, nearest) if met else kFar
    seen = sub(add(p, mul(u, t)), capture)
    if not isNumber(seen):
        return [u, t, kFar, 0, kDegenerateInput]
    return [unit(seen, u), t, length(seen), met, reason]


def boxProjection(p, d, low, high, capture):
    u = unit(d)
    size = sub(high, low)
    if not (isNumber(low, high, capture[:3]) and min(size) >= 0 and capture[3] > 0 and length(u) > 0.5):
        return [u, 0, 0]
    ahead = min((((high if v > 0 else low)[k] - p[k]) / v if abs(v) >= 1e-7 else 1e30) for k, v in enumerate(u))
    margin = 1e-5 * max(size)
    if not -margin <= ahead < 1e29:
        return [u, 0, 0]
    t = max(ahead, 0)
    hit = add(p, mul(u, t))
    if not sum(abs(x) for x in hit) < 1e37 or min(sub(hit, low)) < -margin or min(sub(high, hit)) < -margin:
        return [u, 0, 0]
    return [unit(sub(hit, capture[:3]), u), t, 1]


def parallaxTables():
    half = [3, 2, 4]
    rays = kRays[:6] + kOutside[:3] + [kBad[0], kBad[2], kBad[5]]
    rows = [[p, d, s, [0.5, -0.25, 1], t, half, n, [0.25, 1, -0.5]] for s in (0, 1, 2, 3, 4) for t in (0, 1) for n in (0, 6) for p, d in rays]
    rows += [[[0.5, 0, 0], [1, 2, 3], 2, [0, 0, 0], 0, half, n, c] for n, c in [(-3, [1, 0, 0]), (kNaN, [1, 0, 0]), (70000, [1, 0, 0]), (2.5, [0.5, 0, 0]), (kInf, [0, 1, 0]), (0, [kNaN, 0, 0]),
                                                                           (0, [0, 0, kInf]), (0, [1e20, 0, 0]), (0, [0, -2e18, 1e19])]]
    rows += [[[0, 0, 0], [0, 0, 2], 3, [0, 0, 0], 0, [2, 9, 9], 0, [0, 0, 2]], [[0, 0, 0], [0, 2, 0], 2, [0, 0, 0], 0, [1, 3, 5], 0, [0, 3, 0]],
             [[1, 0, 0], [0, 2, 0], 2, [0, 0, 0], 0, [-1, 3, 5], 0, [0.5, 0, 0]]]
    # The hit is no number: the origin's magnitudes add up to one less than half a step below 1e37, and the way there to more.
    most = 1e37 - 2.0 ** 99
    beyond = [[[most, 2.5e29, 0], [0, 1, 0], 2, [most, 2.5e29, 0], 0, [1, 9e28, 1], 0, [0, 0, 0]]]
    # A least distance below 1 m is one, too.
    rows += [[[2.75, 0, 0], [1, 0, 0], 2, [0, 0, 0], 0, half, 0.5, [0, 0, 0]]]
    # The capture is beyond what is seen on all axes.
    rows += [[[0.5, 0, 0], [-1, -2, -3], 2, [0, 0, 0], 0, half, 0, [4, 5, 6]]]
    low, high = [-3, -1, -2], [2, 3, 4]
    boxes = [[p, d, low, high, [0.25, 0.5, -0.75, 1]] for p, d in kRays + kOutside + kBad[:5]]
    boxes += [[[0.5, 0.5, 0.5], [1, 2, 3], l, h, c] for l, h, c in [(low, high, [0, 0, 0, 0]), (low, high, [0, 0, 0, -1]), (low, high, [0, 0, 0, kNaN]), (low, high, [0, 0, 0, 0.5]),
              (low, high, [kNaN, 0, 0, 1]), (low, high, [0, kInf, 0, 1]), (high, low, [0, 0, 0, 1]), (low, [2, 3, kInf], [0, 0, 0, 1]),
              ([-3, -1, 5], high, [0, 0, 0, 1]), ([-3, 4, -2], high, [0, 0, 0, 1]), ([3, -1, -2], high, [0, 0, 0, 1])]]
    # A box that is one point, which the ray starts at; an end that is not finite; just beyond a large box's face, where the answer is the
    # position; a point that is together no number, though each of its parts is.
    boxes += [[[0.5, 0.25, 1], [1, 2, 3], [0.5, 0.25, 1], [0.5, 0.25, 1], [0, 0, 0, 1]], [[0.5, 0.5, 0.5], [1, 2, 3], [-3, -kInf, -2], high, [0, 0, 0, 1]],
              [[1024 * (1 + 2 ** -18), 1, 2], [1, 0, 0], [-1024] * 3, [1024] * 3, [0.5, 0.25, 1, 1]], [[-9e36, 9e36, 0], [0, 0, 1], [-9e36, 0, -1], [0, 9e36, 1], [0, 0, 0, 1]]]
    # A box beyond the origin; one whose ends are swapped by less than the margin; what is beyond all distances.
    boxes += [[[-2, 0, 0.5], [1, 2, 3], [-3, -4, -5], [-1, 2, 3], [0, 0, 0, 1]], [[0.5, 0.5, 1], [1, 2, 0], [-3, -1, 1.00001], [2, 3, 1], [0, 0, 0, 1]]]
    boxes += [[[0, 0, 0], [0, 0, 1], [-far] * 3, [far] * 3, [1, 0, 0, 1]] for far in (5e28, 1e29, 1e31)]
    boxes += [[[0.5, 1, 0], [1, 0, 2], [-3, 1, -2], [2, 1, 4], [0, 0, 0, 1]], [[0, 1, 2], [0, 1, 0], low, high, [0, 3, 2, 1]]]
    for k in range(3):
        for face, s in ((low, -1), (high, 1)):
            on, out, across = [0.25, 0.5, 0.75], [0.1, 0.2, -0.1], [1, 1, 1]
            on[k], out[k], across[k] = face[k], s, 0
            off, far, near = list(on), list(on), list(on)
            off[k], far[k], near[k] = on[k] + s, on[k] + 4e-4 * s, on[k] + 2e-5 * s
            grazing = [1, -1, 0.5]
            grazing[k] = 0.05 * s
            boxes += [[q, v, low, high, [0.5, 0.25, 1, 1]] for q in (on, off, far) for v in (out, mul(out, -1), across)]
            boxes.append([near, grazing, low, high, [0.5, 0.25, 1, 1]])
    form = [[f] + row for f in (0, 1) for row in boxes]
    broken = [[f, [0.5, 0.5, 0.5], [1, 2, 3], [-3, kNaN, -2], high, [0, 0, 0, 1]] for f in (0, 1)]
    shapes = [[a, b] for a in range(-1, 6) for b in range(-1, 6)]
    write("parallax", "A probe is read towards what the reflection meets on its proxy, by parallax and by both forms of box projection.", [
        Function("Parallax", "p:3 d:3 s:i c:3 t:b h:3 n:1 q:3", ["r.dirWS.x", "r.dirWS.y", "r.dirWS.z", "r.distance", "r.distanceFromCapture", "number(r.hit)", "float(r.reason)"],
                 rows, parallax, "ParallaxRay r = computeParallax(p, d, ProbeProxy(s, c, tableTurn(t), h, n), q);", absolute=3e-5, relative=2e-5),
        Function("Beyond", "p:3 d:3 s:i c:3 t:b h:3 n:1 q:3", ["r.dirWS.y", "r.distance", "r.distanceFromCapture", "number(r.hit)", "float(r.reason)"], beyond,
                 lambda *given: [1, 0, 0, 0, kDegenerateRay], "ParallaxRay r = computeParallax(p, d, ProbeProxy(s, c, tableTurn(t), h, n), q);"),
        Function("BoxProjection", "f:i p:3 d:3 low:3 high:3 q:4", ["b.dirWS.x", "b.dirWS.y", "b.dirWS.z", "b.distance", "number(b.applied)"], form,
                 lambda f, *rest: boxProjection(*rest),
                 "ProbeBox box = ProbeBox(low, high, q);\nBoxProjection b = computeBoxProjectionDivision(p, d, box);\nif (f == 1) b = computeBoxProjectionSelect(p, d, box);", absolute=2e-5,
                 vulkanRows=broken),
        Function("Shapes", "a:i b:i", ["number(acceptsProxyShape(a, b))"], shapes, lambda a, b: a in (2, 3) and b in (1, a)),
    ], ["crossray/probe/parallax.glsl", "crossray/probe/box_projection.glsl", "crossray/probe/shapes.glsl"], kTurn)


# ------------------------------------------------------------------------------------------------- probe/influence.glsl

def usable(x): return min(x, kFar) if x > 0 else 0.0
def blendOf(x): return min(x, kFar) if x > 1e-4 else 1e-4


def influence(shape, p, n, d, center, turned, half, blendP, blendN, normalP, normalN, faceP, faceN, capture, weight):
    q = local(sub(p, center), turned)
    volume = 0.0
    if shape == 3 and half[0] >= 0 and isNumber(q):
        volume = clamp01(1 - max(length(q) - (min(half[0], kFar) - usable(blendP[0])), 0) / blendOf(blendP[0]))
    if shape == 2 and all(h >= 0 for h in half) and isNumber(q):
        sides = [(usable(half[k]) - q[k]) / blendOf(blendP[k]) for k in range(3)] + [(usable(half[k]) + q[k]) / blendOf(blendN[k]) for k in range(3)]
        volume = clamp01(min(sides))
    if shape == 3:
        inside = length(q) <= half[0] - usable(normalP[0])
    else:
        inside = all(half[k] - q[k] - usable(normalP[k]) >= 0 and half[k] + q[k] - usable(normalN[k]) >= 0 for k in range(3))
    away = sub(p, capture)
    cosine = dot(unit(n), unit(away)) if max(abs(x) for x in away) > 1e-4 else 0
    normal = 1.0 if inside else clamp01(1.5 - 2.5 * cosine)
    face = 1.0
    if shape == 2:
        v = local(unit(d), turned)
        face = clamp01(sum(clamp01((4 * v[k] - 1) * clamp01(faceP[k])) + clamp01((-4 * v[k] - 1) * clamp01(faceN[k])) for k in range(3)))
    return [volume, normal, face, smooth(volume * normal * face) * clamp01(weight)]


def influenceTables():
    one, none = [1, 1, 1], [0, 0, 0]
    half, center = [3, 2, 4], [0.5, -0.25, 1]
    places = [[0.5, -0.25, 1], [3, 0, 1], [-2, 0.5, 2], [1, 1.5, -1], [0, -1.75, 1], [0.2, 0.3, 4.5], [1, 0, -2.6], [9, 0, 0], [0, 5, 0], [0, 0, -7], [2.5, 1, 3.5], [-2.25, -1.5, -2]]
    rows = []
    for shape in (2, 3):
        for turned in (0, 1):
            rows += [[shape, p, [0.2, 0.5, 1], [1, -2, 0.5], center, turned, half, [1, 0.5, 2], [0.75, 1.25, 1.5], none, none, one, one, [0, 0.5, 0], 1] for p in places]
            rows += [[shape, p, [0.9, 0.1, 0.3], [0.3, 1, -0.4], center, turned, half, none, none, [1, 0.8, 1.5], [0.5, 1.2, 2], one, one, [0.5, 0.25, 0.5], 0.75] for p in places]
    face = [([1, 0, 0], 0), ([0.35, 0.2, 0.9], 1), ([-1, 0, 0], 0), ([0, 1, 0], 0), ([0, -1, 0], 0), ([0, 0, 1], 0), ([0, 0, -1], 0), ([0.3, 0.35, -0.4], 1), ([-0.3, -0.4, 0.35], 0),
            ([0, 0, 0], 0), ([kNaN, 1, 0], 0), ([0.2, -0.5, 0.3], 0), ([-1, 2, -0.5], 1), ([0.27, 0.96, 0], 0)]
    for faceP, faceN in (([0.25, 0.5, 0.75], [0.3, 0.6, 0.9]), (one, one), ([1, 0, 0], none), (none, [0, 1, 0]), ([2, -1, kNaN], [-3, kNaN, 4]), (none, [1, 0, 0.5]), ([0, 0.125, 1], none)):
        rows += [[2, [1, 0.5, 1.5], [0, 1, 0], d, center, turned, half, none, none, none, none, faceP, faceN, none, 1] for d, turned in face]
    # Blend distances and extents of no meaning; a blend beyond the extent; the border itself, where a step is as wide as 500 ulps.
    steps = []
    for shape in (2, 3):
        for h in ([-1, 2, 2], [2, -1, 2], [2, 2, -1], [kNaN, 2, 2], [2, kNaN, 2], [2, 2, kNaN], [0, 0, 0], [2, 2, 2], [70000, 70000, 70000]):
            rows += [[shape, [0, 0, 0], [0, 1, 0], [1, 2, 3], none, 0, h, b, b, none, none, one, one, [0, 1, 0], 1] for b in (none, [kNaN] * 3, [-1] * 3, [5, 6, 7], [2, 1, 1.5])]
        steps += [[shape, p, [0, 1, 0], [1, 2, 3], none, 0, [2, 2, 2], b, b, none, none, one, one, [0, 1, 0], 1]
                 for p in ([1.99995, 0, 0], [2.00005, 0, 0], [1.9998, 0, 0], [2, 0, 0], [0, -1.99995, 0], [0, 0, 1.99995]) for b in (none, [1e-4] * 3, [5e-5] * 3, [3e-4] * 3, [0.1, 0.1, 0.1])]
        rows += [[shape, p, [0, 1, 0], [1, 2, 3], none, 0, [2, 2, 2], one, one, none, none, one, one, none, 1] for p in ([kNaN, 0, 0], [0, kInf, 0], [0, 0, kNaN])]
        rows += [[shape, [1.25, 0, 0], [0, 1, 0], [1, 2, 3], none, 0, [2, 2, 2], one, one, none, none, one, one, none, w] for w in (0, 0.5, 1, 1.5, -1, kNaN)]
        rows += [[shape, [60000, 1, 1], [0, 1, 0], [1, 2, 3], none, 0, [8e4] * 3, b, b, none, none, one, one, none, 1] for b in ([7e4] * 3, [6e4] * 3, [1e3] * 3)]
        # The blend normal by the cosine, at and about its ends; the capture position itself.
        for c in (-1, -0.5, 0, 0.2, 0.3, 0.4, 0.55, 0.6, 0.7, 1):
            rows.append([shape, [1, 0, 0], [c, math.sqrt(1 - c * c), 0], [1, 2, 3], none, 0, [2, 2, 2], none, none, [1.5] * 3, [1.5] * 3, one, one, none, 1])
        for n, q in (([0, 0, 0], none), ([1, 0, 0], [1, 0, 0]), ([1, 0, 0], [0.99995, 0, 0]), ([1, 0, 0], [0.9998, 0, 0]), ([kNaN, 0, 0], none), ([2, 0, 0], [0.5, 0.25, 0])):
            rows.append([shape, [1, 0, 0], n, [1, 2, 3], none, 0, [2, 2, 2], none, none, [1.5] * 3, [1.5] * 3, one, one, q, 1])
        for k in range(3):
            for s in (-1, 1):  # each face's own blend-normal distance, and its border
                for x in (0.5, 0.75, 1, 1.25, 1.5, 1.75):
                    p, a, b = [0, 0, 0], [0.25, 0.25, 0.25], [0.25, 0.25, 0.25]
                    p[k] = s * x
                    (a if s > 0 else b)[k] = 1.0
                    rows.append([shape, p, p, [1, 2, 3], none, 0, [2, 2, 2], none, none, a, b, one, one, none, 1])
    for k in range(3):  # a distance below 0 or NaN counts as 0
        for s in (-1, 1):
            for x, length in ((2.5, -1), (1.5, kNaN), (2.5, kNaN)):
                p, a, b = [0, 0, 0], [0, 0, 0], [0, 0, 0]
                p[k] = s * x
                (a if s > 0 else b)[k] = length
                rows.append([2, p, p, [1, 2, 3], none, 0, [2, 2, 2], none, none, a, b, one, one, none, 1])
    rows.append([2, [1e-4, 0, 0], [1, 0, 0], [1, 2, 3], none, 0, [2, 2, 2], none, none, [1.9999, 0, 0], [3, 0, 0], one, one, none, 1])
    rows += [[s, [0, 0, 0], [0, 1, 0], [1, 2, 3], none, 0, [2, 2, 2], one, one, none, none, one, one, [0, 1, 0], 1] for s in (0, 1, 4)]
    # A sphere's blend distance and blend normal below 0, and its own component of each; a box of less than a metre.
    rows += [[3, [x, 0, 0], [1, 0, 0], [1, 2, 3], none, 0, [2, 9, 9], none, none, [b, 0, 0], [9, 9, 9], one, one, none, 1] for x, b in ((2.5, -1), (2.5, kNaN), (1.5, 1), (1.5, 0.25))]
    rows += [[3, [2.5, 0, 0], [1, 0, 0], [1, 2, 3], none, 0, [2, 9, 9], [b, 9, 9], none, none, none, one, one, none, 1] for b in (-1, kNaN, 2)]
    rows += [[2, [0.125, -0.25, 0.0625], [0, 1, 0], [1, 2, 3], none, 0, [0.5, 0.75, 0.25], [0.5] * 3, [0.5] * 3, none, none, one, one, none, 1]]
    rows += [[3, [1, 0.5, 1.5], [0, 1, 0], [1, 2, 3], center, 0, half, none, none, none, none, none, none, none, 1]]  # a sphere has no faces
    # A capture position without a way from it: nothing faces away.
    rows += [[2, [0.5, 0.25, 0], [1, 1, 1], [1, 2, 3], none, 0, [1, 1, 1], none, none, one, one, one, one, q, 1] for q in ([-2e30, 0, 0], [0, -kInf, 0])]
    # Directions at the shortest and longest that are: only the sum of the components' magnitudes, which a rotation changes, is beyond the limit.
    rows += [[2, [1, 0.5, 1.5], [0, 1, 0], mul(d, s), center, 1, half, none, none, none, none, [0.25, 0.125, 0.5], none, none, 1]
             for d, s in ((kAxes[0], 0.9e-30), (kAxes[1], 0.9e-30), (add(kAxes[0], add(kAxes[1], kAxes[2])), 0.55e30))]
    # Faces that count for more than 1 or less than 0, where the sum does not hide it.
    rows += [[2, [1, 0.5, 1.5], [0, 1, 0], d, none, 0, half, none, none, none, none, p, q, none, 1]
             for d, p, q in (([0.27, 0.9, 0], [3, 0, 0], none), ([0.9, -0.27, 0], none, [0, 3, 0]), ([0.27, 0.3, 0.2], [-4, 1, 1], one), ([-0.3, -0.27, 0.2], one, [1, -4, 1]))]
    colors = [[[0.5, 1, 2], 3], [[-1, kNaN, kInf], 2], [[kInf, -2, kNaN], 2], [[kNaN, kInf, -3], 2], [[1, 2, 3], 0], [[1, 2, 3], -1], [[1, 2, 3], kNaN], [[70000, 3, 65504], 1],
              [[1000, 65504, 0.001], 100], [[4, 70000, 80000], 0.5], [[9e36, 1, 2e37], 1], [[0.25, 0.5, 1e38], kInf], [[0, 0.125, 4], 7], [[0.3, 0.6, 0], 80000], [[0.001, 65504, 1000], 100], [[65504, 0.001, 0.002], 100], [[80000, 2, 1], 0.5], [[0.001, 0.002, 65504], 100]]

    def color(c, m):
        fit = lambda x: min(x, kFar) if x > 0 and isNumber(x) else 0.0
        return [fit(fit(x) * usable(m)) for x in c]
    write("influence", "How much a probe counts follows its volumes, the normal and the faces, at their borders and for sizes of no meaning too.", [
        Function("Influence", "s:i p:3 n:3 d:3 c:3 t:b h:3 bp:3 bn:3 np:3 nn:3 fp:3 fn:3 q:3 w:1", ["r.volume", "r.blendNormal", "r.faceFade", "r.weight"], rows, influence,
                 "ProbeWeight r = computeProbeWeight(ProbeInfluence(s, c, tableTurn(t), h, bp, bn, np, nn, fp, fn, q, w), p, n, d);", absolute=1e-5, relative=1e-5),
        Function("Step", "s:i p:3 n:3 d:3 c:3 t:b h:3 bp:3 bn:3 np:3 nn:3 fp:3 fn:3 q:3 w:1", ["r.volume", "r.blendNormal", "r.faceFade", "r.weight"], steps, influence,
                 "ProbeWeight r = computeProbeWeight(ProbeInfluence(s, c, tableTurn(t), h, bp, bn, np, nn, fp, fn, q, w), p, n, d);", absolute=3e-3),
        # A rotation makes all components NaN of one: here one alone is.
        Function("Box", "p:3 h:3 a:3 b:3", ["computeBoxInfluence(p, h, a, b)"], [[p, [2, 3, 4], [1, 2, 3], [3, 2, 1]] for p in ([0.5, 0, 0], [1.5, 0, 0], [0, -2, 0], [0, 0, 3], [0, kInf, 0], [-2e37, 0, 0], [kNaN, 0, 0], [0, kNaN, 0], [0, 0, kNaN])],
                 lambda p, h, a, b: [clamp01(min(min((h[k] - p[k]) / a[k], (h[k] + p[k]) / b[k]) for k in range(3))) if isNumber(p) else 0]),
        Function("FaceFade", "d:3 p:3 n:3", ["computeFaceFade(d, p, n)"], [[d, [0.25, 0.5, 0.75], [0.3, 0.6, 0.9]] for d in ([3, 1, 0.5], [-0.1, -0.2, 0.05], [0, 9, 0], [1e-20, 2e-20, 0], [0, 0, 0])],
                 lambda d, p, n: [clamp01(sum(clamp01((4 * v - 1) * a) + clamp01((-4 * v - 1) * b) for v, a, b in zip(unit(d), p, n)))]),
        Function("Color", "c:3 m:1", ["r.x", "r.y", "r.z"], colors, color, "vec3 r = multiplyProbeColor(c, m);", absolute=0, relative=1e-6),
    ], ["crossray/probe/influence.glsl"], kTurn)


# ------------------------------------------------- probe/roughness, rgbm, sky, two_probes, hdrp_order, project/color_pyramid

def lookUpTables():
    rough = [0, 0.1, 0.25, 0.5, 0.75, 0.9, 1, 1.5, -0.5, kNaN]

    def mips(r, lods):
        r = clamp01(r)
        top = max(lods - 1, 0)
        power = (2 / max(1.192092896e-7, r ** 4) - 2) / 4
        curve = r * (1.7 - 0.7 * r)
        return [r ** 0.8 * top, r ** 1.3 * top, curve * top, curve * 6, (2 / (power + 2)) ** 0.25 * 6, r ** 0.8 * top, r ** 1.3 * top]

    def distanceBased(r, hit, capture):
        r = clamp01(r)
        ratio = safeDivide(max(hit, 0), max(capture, 0), 1) if isNumber(hit, capture) else 1
        scaled = min(max(ratio * r, 0), r)
        return scaled * (1 - r) + r * r

    def dominant(n, reflected, v, r, form):
        u = unit(n)
        m = unit(reflected, u)
        if form == 0 or length(u) < 0.5 or length(unit(v)) < 0.5:
            return m
        c = clamp01(dot(u, unit(v, u)))
        a = c if form == 1 else c * c
        s2 = clamp01(r) ** 2
        smoothness = 1 - s2
        f = (math.sqrt(smoothness) + s2) * clamp01(smoothness * smoothness + smoothness * a)
        return unit(add(mul(u, 1 - f), mul(m, f)), m)

    def contain(x): return min(x, kFar) if x > 0 else 0.0

    def rgbm(texel, decode):
        a = contain(decode[3] * (texel[3] - 1) + 1)
        y = contain(decode[1])
        linear = contain(contain(decode[0]) * ((a ** y if a > 0 else 0) if y > 0 else 1))
        gamma = contain(contain(decode[0]) * a)
        return [[contain(contain(x) * f) for x in texel[:3]] for f in (linear, gamma)]

    def sky(up, sharp, d):
        s = dot(unit(d), unit(up))
        h = min(max(s * (min(sharp, kFar) if sharp > 0 else 0), -1), 1)
        end, t = ([1, 2, 3], h) if h >= 0 else ([7, 9, 11], -h)
        return [a * (1 - t) + b * t for a, b in zip([4, 5.5, 6.25], end)]

    def two(w):
        alone = not w < single(0.99999)
        first = 1 if alone else clamp01(w)
        return [not alone, first, 1 - first, [a if alone else b if not w > 0 else b * (1 - w) + a * w for a, b in zip([1, 2, 3], [5, 7, 11])]]

    def key(h):
        side = [max(x, 0) * 2 for x in h]
        volume = side[0] * side[1] * side[2]
        if not isNumber(h) or not isNumber(volume):
            return 1048575
        k = math.log(1 + volume) * 1000 / math.log(1.05)
        return min(int(k), 1048575)
    mirror = [([0, 0, 1], [0.6, 0, 0.8], [-0.6, 0, 0.8]), ([1, 2, 2], [0.2, 0.9, -0.1], [0.5, 0.3, 0.8]), ([0, 3, 0], [1, 0.1, 0], [-1, 0.1, 0]), ([0, 0, 0], [1, 0, 0], [0, 0, 1]),
              ([0, 1, 0], [0, 0, 0], [0.3, 0.5, 0]), ([0, 1, 0], [0.6, 0.8, 0], [0, 0, 0]), ([0, 0, 0], [0, 0, 0], [0, 1, 0]), ([0, 0, 1], [0.6, 0, 0.8], [0.6, 0, -0.8])]
    texels = [[[0.5, 0.25, 1, 0.5], [4, 2, 0, 1]], [[0.5, 0.25, 1, 0.5], [4, 2, 0, 0]], [[0.5, 0.25, 1, 0.5], [4, 2, 0, 0.5]], [[0.5, 0.25, 1, 0.5], [4, 0, 0, 1]], [[0.5, 0.25, 1, 0], [4, 2, 0, 1]],
              [[0.5, 0.25, 1, 0], [4, 0, 0, 1]], [[0.5, 0.25, 1, 0.25], [4, -1, 0, 1]], [[0.5, 0.25, 1, 0.25], [4, kNaN, 0, 1]], [[-1, kNaN, kInf, 1], [2, 1, 0, 1]], [[0.5, 2, 3, 0.75], [kNaN, 1, 0, 1]],
              [[0.5, 2, 3, 0.75], [-4, 1, 0, 1]], [[0.5, 2, 3, 0.75], [90000, 1, 0, 1]], [[0.5, 2, 3, -0.5], [4, 1, 0, 1]], [[0.5, 2, 3, 3], [4, 1.5, 0, 2]], [[90000, 0.5, 0.125, 1], [3, 2, 0, 1]],
              [[0.5, 2, 3, kNaN], [4, 1, 0, 1]], [[0.75, 0.5, 0.1, 0.9], [5, 2.2, 0, 1]], [[0.5, 1, 2, 0.5], [4, 0.25, 0, 1]], [[0.5, 1, 2, 0.5], [60000, 0.25, 0, -3]],
              # Colours, an alpha and an exponent beyond the largest half-float, and a factor that takes them below it.
              [[90000, 1, 2, 1], [0.5, 1, 0, 1]], [[1, 70000, 80000, 1], [0.25, 2, 0, 1]], [[0.5, 0.25, 1, 1e5], [0.5, 0.5, 0, 1]], [[0.5, 0.25, 1, 1], [4, kInf, 0, 1]]]
    keys = [[h] for h in ([0.5, 0.5, 0.5], [1, 2, 3], [3, 1, 2], [0, 1, 1], [1, 0, 1], [1, 1, 0], [-1, 2, 2], [2, -1, 2], [2, 2, -1], [10, 20, 30], [1e4, 1e4, 1e4], [1e7, 1e7, 1e7],
            [1e15, 1e15, 1e15], [1, kInf, 1], [0.1, 0.2, 0.3], [100, 100, 100], [0.03, 0.04, 0.05], [4e6, 4e6, 4e6], [5e5, 5e5, 1e10], [-kInf, 1, 1], [1, -kInf, 1], [1, 1, -kInf])]
    write("look_up", "Roughness, dominant direction, RGBM, the gradient sky, two probes and HDRP's order are the documents' formulas.", [
        Function("Mips", "r:1 n:i", ["computeReflectionMip(r, n)", "computeRefractionMip(r, n)", "computeProbeMip(r, n)", "computeBuiltInMip(r)", "computeBuiltInMipExact(r)",
                 "computeReflectionColorLevel(r, n)", "computeRefractionColorLevel(r, n)"], [[r, n] for r in rough + [0.02] for n in (-1, 0, 1, 2, 7)], mips, relative=3e-5, absolute=2e-6),
        Function("DistanceBased", "r:1 h:1 c:1", ["computeDistanceBasedRoughness(r, h, c)"],
                 [[r, h, c] for r in (0, 0.25, 0.5, 0.9, 1, 1.5, kNaN) for h, c in ((1, 2), (2, 1), (0, 3), (3, 0), (0, 0), (-1, 2), (2, -1), (kInf, 1), (1, kInf), (1, 8))],
                 distanceBased, vulkanRows=[[r, h, c] for r in (0.25, 0.5, 0.9) for h, c in ((kNaN, 1), (1, kNaN), (kNaN, kNaN))]),
        Function("Dominant", "n:3 m:3 v:3 r:1 form:i", ["d.x", "d.y", "d.z"], [[n, m, v, r, f] for f in (0, 1, 2) for n, m, v in mirror for r in (0, 0.3, 0.6, 0.85, 1, 1.5, -1, kNaN)],
                 dominant, "vec3 d = computeDominantDirection(n, m, v, r, form);", absolute=4e-6),
        Function("Rgbm", "t:4 d:4", ["a.x", "a.y", "a.z", "b.x", "b.y", "b.z"], texels, rgbm, "vec3 a = decodeRgbmLinear(t, d);\nvec3 b = decodeRgbmGamma(t, d);", relative=3e-5),
        Function("Sky", "up:3 s:1 d:3", ["c.x", "c.y", "c.z"],
                 [[up, s, d] for up, s in (([0, 2, 0], 1), ([1, 2, 2], 2), ([0, 1, 0], 0), ([0, 1, 0], -1), ([0, 1, 0], kNaN), ([0, 0, 0], 1), ([0, 1, 0], 70000), ([0, 1, 0], 0.5))
                  for d in ([1, 1, 0], [0, -1, 2], [1, 0, 0], [0, 0, 0], [3, -4, 0], [0, 5, 0], [1, 1e-6, 0], [2, 2e-5, -1])],
                 sky, "vec3 c = evaluateGradientSky(GradientSky(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.5, 6.25), vec3(7.0, 9.0, 11.0), up, s), d);", absolute=4e-6),
        Function("TwoProbes", "w:1", ["number(needsSecondProbe(w))", "computeTwoProbeWeights(w).first", "computeTwoProbeWeights(w).second", "c.x", "c.y", "c.z"],
                 [[w] for w in (0, 0.25, 0.5, 0.9, 0.9999, 0.99998, 0.99999, 0.999995, 1, 1.5, -0.5, kNaN, 0.001)], two, "vec3 c = blendTwoProbes(vec3(1.0, 2.0, 3.0), vec3(5.0, 7.0, 11.0), w);"),
        Function("LargestKey", "h:3", ["float(computeHdrpProbeKey(h))"], [[[5e5, 5e5, 1e10]], [[1e15, 1e15, 1e15]]], lambda h: 2 ** 20 - 1, absolute=0, relative=0),
        # A probe without weight may be anything.
        Function("TwoColors", "a:3 b:3 w:1", ["c.x", "c.y", "c.z"], [[[kNaN, kInf, 1], [5, 7, 11], 0], [[kNaN, kInf, 1], [5, 7, 11], -0.5], [[1, 2, 3], [kInf, 7, kNaN], 1], [[1, 2, 3], [5, 7, 11], 0.75]],
                 lambda a, b, w: b if w <= 0 else a if w >= 1 else add(mul(a, w), mul(b, 1 - w)), "vec3 c = blendTwoProbes(a, b, w);"),
        Function("Key", "h:3", ["float(computeHdrpProbeKey(h))"], keys, lambda h: key(h), relative=3e-6, absolute=3, vulkanRows=[[kNaN, 1, 1], [1, kNaN, 1], [1, 1, kNaN]]),
        Function("Order", "a:i i:i b:i j:i", ["number(hdrpProbeComesFirst(a, i, b, j))"], [[a, i, b, j] for a in (1, 2) for b in (1, 2) for i in (0, 1) for j in (0, 1)],
                 lambda a, i, b, j: (a, i) < (b, j)),
        Function("ColorTexel", "c:3", ["t.x", "t.y", "t.z", "t.w"], [[c] for c in ([1, 2, 3], [0, 0, 0], [-1, 1, 1], [1, -1, 1], [1, 1, -1], [kNaN, 1, 1], [1, kInf, 1], [1, 1, kNaN], [0.5, 0, 0.25])],
                 lambda c: [c, 1] if isNumber(c) and min(c) >= 0 else [0, 0, 0, 0], "vec4 t = makeColorPyramidTexel(c);", absolute=0),
    ], ["crossray/probe/roughness.glsl", "crossray/probe/rgbm.glsl", "crossray/probe/sky.glsl", "crossray/probe/two_probes.glsl", "crossray/probe/hdrp_order.glsl",
        "crossray/project/color_pyramid.glsl"])


def make():
    proxyTables()
    parallaxTables()
    influenceTables()
    lookUpTables()
