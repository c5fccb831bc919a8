"""The table of refract/ and core/reflection.glsl; see tables.py."""
import math
from tables import Function, add, dot, flat, isNumber, kInf, kNaN, length, mul, sub, unit, write
from tables_core import kDegenerateInput, kDegenerateRay, kNone, kNoRefractedRay


def reflect(n, v):
    n, v = unit(n), unit(v)
    if length(n) < 0.5 or length(v) < 0.5:
        return [0, 0, 0]
    return unit(sub(mul(n, 2 * max(dot(n, v), 0)), v), mul(v, -1))


def enter(n, v, index, thickness):
    """Snell's law by the angle; answers status, normal, direction inside, cosines, index, thickness."""
    v, n = unit(v), unit(n)
    t = min(thickness, 65504.0) if thickness > 0 else 0.0
    known = 0 < index < 1e30
    index = min(max(index, 0.001), 1000.0) if known else 1.0
    c = dot(n, v)
    if c < 1e-4:
        side = sub(n, mul(v, c))
        if not (length(side) > 1e-5 and length(v) > 0.5):
            return kDegenerateRay, n, mul(v, -1), 1, 1, index, t, v
        n = add(mul(unit(side), math.sqrt(1 - 1e-8)), mul(v, 1e-4))
        c = 1e-4
    if not known:
        return kDegenerateInput, n, mul(v, -1), 1, 1, index, t, v
    c = min(c, 1.0)
    across = sub(v, mul(n, c))  # along the surface, towards the eye
    sine = math.sqrt(max(1 - c * c, 0)) / index
    if sine * sine > 1 and (1 - c * c) / (index * index) > 1:
        return kNoRefractedRay, n, reflect(n, v), c, c, index, t, v
    # 1 - sine^2 without its cancellation.
    inside = math.sqrt(max((index * index - 1) / (index * index) + c * c / (index * index), 0))
    direction = sub(mul(unit(across), -sine), mul(n, inside)) if length(across) > 0 else mul(n, -1)
    return kNone, n, unit(direction, mul(v, -1)), c, inside, index, t, v


def entry(n, v, index, thickness):
    status, n, d, c, inside, index, t, v = enter(n, v, index, thickness)
    return [[0, 0, 0] if status == kDegenerateRay else n, v, d, c, inside, index, t, status]


def exitOf(model, p, n, v, index, thickness):
    if model not in (1, 2, 3):
        v = unit(v)
        status = kNone if length(v) > 0.5 else kDegenerateRay
        status = status if isNumber(p) else kDegenerateRay
        return [p if isNumber(p) else [0, 0, 0], mul(v, -1), 0, status]
    status, n, d, c, inside, index, t, v = enter(n, v, index, 0.005 if model == 3 else thickness)
    origin = p if isNumber(p) else [0, 0, 0]
    if not isNumber(p):
        status = kDegenerateRay
    if status != kNone:
        return [origin, d, 0, status]
    if model == 1:
        path = inside * t  # the chord of a sphere of diameter t
        inwards = sub(mul(n, -1), mul(d, 2 * inside))  # the normal where the chord ends
        # Out again by Snell's law: the tangential part grows by the index, the cosine is that of the entry.
        tangent = sub(d, mul(inwards, dot(d, inwards)))
        out = sub(mul(tangent, index), mul(inwards, c))
        return [add(origin, mul(d, path)), unit(out, mul(v, -1)), path, kNone]
    path = t / max(inside, 0.01)
    return [add(origin, mul(d, path)), mul(v, -1), path, kNone]


def fresnelTerms(cosine, index):
    """The index and the cosine within their bounds, and the index times the inner cosine; None where all is reflected."""
    if not 0 < index < 1e30:
        return None
    index = min(max(index, 0.001), 1000.0)
    c = min(cosine, 1.0) if cosine > 1e-4 else 1e-4
    q = index * index - 1 + c * c
    return (index, c, math.sqrt(q)) if q > 0 else None


def fresnelExact(cosine, index):
    terms = fresnelTerms(cosine, index)
    if terms is None:
        return 1.0
    index, c, k = terms
    rs = (c - k) / (c + k)
    rp = (index * index * c - k) / (index * index * c + k)
    return 0.5 * (rs * rs + rp * rp)


def fresnelSchlick(cosine, index):
    terms = fresnelTerms(cosine, index)
    if terms is None:
        return 1.0
    index, c, k = terms
    side = k / index if index < 1 else c
    base = ((index - 1) / (index + 1)) ** 2
    return base + (1 - base) * (1 - side) ** 5


def transmittance(color, distance, path):
    path = min(path, 65504.0) if path > 0 else 0.0
    distance = distance if distance > 1e-5 else 1e-5
    return [max(c, 1e-4) ** (path / distance) if c < 1 else 1.0 for c in color]


def refractTables():
    v1 = [0, 0, 1]
    normals = [([0, 0, 1], v1), ([0.6, 0, 0.8], v1), ([0, 0.8, 0.6], v1), ([1, 2, 2], [2, 1, 2]), ([-3, 0, 1], [0.3, 0.2, 1]), ([5, 0, 0.05], v1)]
    turned = [([1, 0, -0.5], v1), ([0, 1, -3], v1), ([1, 2, 0], [0, 0, 2]), ([3e-5, 0, -1], v1), ([1e-3, 0, -1], v1), ([1, 0, 1e-4], v1)]
    broken = [([0, 0, -1], v1), ([0, 0, 0], v1), ([0, 0, 1], [0, 0, 0]), ([1, 0, 0], [0, 0, 0]), ([kNaN, 0, 1], v1), ([0, 0, 1], [kInf, 0, 0]), ([5e-6, 0, -1], v1),
              ([0.6, 0.8, 0], [kNaN, 0, 0])]
    p = [1, 2, 3]
    rows = [[m, p, n, v, index, t] for m in (1, 2, 3) for n, v in normals for index, t in [(1.5, 2), (1.0, 0.5), (0.7, 1)]]
    rows += [[m, p, n, v, 1.5, 2] for m in (1, 2, 3) for n, v in turned[:5]]
    rows += [[m, p, n, v, 1.5, 2] for m in (0, 1, 2, 4) for n, v in broken]
    rows += [[m, p, [0, 0, 1], [2, 1, 2], 1.5, 2] for m in (0, 4)]  # a view direction of any length, with nothing to refract
    rows += [[m, p, [0.6, 0, 0.8], v1, index, 1] for m in (1, 2) for index in (0, -1, kNaN, kInf, 1e-4, 0.001, 1e30, 1.25, 0.61, 0.59)]
    dense = [[m, p, [0.6, 0, 0.8], v1, index, 1] for m in (1, 2) for index in (1e29, 2000, 1000, 500)]
    rows += [[m, p, [0.6, 0, 0.8], v1, 1.3, t] for m in (1, 2) for t in (0, -2, kNaN, 0.25, 70000, 65504, kInf)]
    rows += [[m, x, [0.6, 0, 0.8], v1, 1.3, 1] for m in (0, 1, 2, 3) for x in ([kNaN, 0, 0], [0, kInf, 0], [0, 0, kNaN], [-3, 4, 5])]
    rows += [[2, p, [1, 0, c], v1, index, 1] for c in (0.005, 0.008, 0.012, 0.02) for index in (1.0, 1.00001)]
    rows += [[m, p, [0, 0, 1], v1, 0.5, 1] for m in (1, 2)]  # straight down: no total reflection whatever the index
    entries = [[n, v, index, t] for n, v in normals for index, t in [(1.5, 2), (1.0, 0.5), (0.7, 1)]] + [[n, v, 1.5, 2] for n, v in turned[:5] + broken]
    entries += [[[0.6, 0, 0.8], v1, index, t] for index, t in ((0, 1), (-1, 1), (kNaN, 1), (kInf, 1), (1e30, 1), (1e-4, 1), (0.59, 1), (2000, 1), (700, 1), (1.3, 0), (1.3, -2), (1.3, 7e4), (1.3, kNaN))]
    # Straight down into what is thin, a cosine that a rounding takes off 1 counts a million times: the direction is the normal's all the same.
    steep = [[a, 1 / 998, 1] for a in ([1, 2, 2], [3, 1, 2], [1, 1, 1], [5, 3, 1], [7, 2, 3], [1, 4, 9], [2, 3, 11], [13, 5, 7], [1, 6, 2], [4, 9, 5], [3, 7, 8], [10, 3, 9])]
    # What leaves a dense sphere is the difference of long vectors, and of length 1 none the less.
    long = [[n, [0, 0, 1], index] for n in ([0.6, 0, 0.8], [1, 2, 2], [3, 1, 2], [5, 3, 1], [1, 4, 9], [2, 3, 11]) for index in (300, 700, 1000)]
    cosines = [1, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01, 1e-4, 5e-5, 2e-4, 0, -0.5, 1.5, kNaN]
    indices = [1.5, 1.0, 0.75, 2.4, 1.05, 0.999]
    fresnelRows = [[m, c, i] for m in (1, 2) for c in cosines for i in indices]
    fresnelRows += [[m, c, i] for m in (0, 1, 2, 3) for c in (0.8, 0.2) for i in (0, -1, kNaN, kInf, 1e30, 9e29, 1e-4, 0.001, 1000, 5000)]
    fresnelRows += [[m, 1, i] for m in (1, 2) for i in (0, -1)]  # where an index of 0.001 would let light in
    reflections = normals + turned + broken + [([0, 3, 4], [0, 1, -2]), ([1e-31, 0, 0], v1)]
    write("refraction", "The refraction models, what a surface reflects, absorption and reflection follow Snell, Fresnel and Beer, and answer every degenerate input.", [
        Function("Refraction", "m:i p:3 n:3 v:3 ior:1 t:1", ["e.positionWS.x", "e.positionWS.y", "e.positionWS.z", "e.dirWS.x", "e.dirWS.y", "e.dirWS.z",
                 "e.pathLength", "float(e.status)"], rows, exitOf,
                 "RefractionExit e = computeRefraction(m, p, n, v, ior, t);", relative=2e-5, absolute=2e-5),
        Function("DenseRefraction", "m:i p:3 n:3 v:3 ior:1 t:1", ["e.positionWS.x", "e.positionWS.z", "e.dirWS.x", "e.dirWS.z", "e.pathLength", "float(e.status)"],
                 dense, lambda *given: [flat(exitOf(*given))[k] for k in (0, 2, 3, 5, 6, 7)],
                 "RefractionExit e = computeRefraction(m, p, n, v, ior, t);", absolute=2e-4),
        # With no ray inside what is left of an entry is a ray straight through, cosines and index 1; its normal is nobody's.
        Function("Enter", "n:3 v:3 ior:1 t:1", ["n.x", "n.y", "n.z", "e.viewDirWS.x", "e.viewDirWS.y", "e.viewDirWS.z", "e.dirWS.x", "e.dirWS.y", "e.dirWS.z", "e.cosineOutside", "e.cosineInside",
                 "e.indexOfRefraction", "e.thickness", "float(e.status)"], entries, entry,
                 "RefractionEntry e = enterRefractor(n, v, ior, t);\nn = e.status == kHitReasonDegenerateRay ? vec3(0.0) : e.normalWS;", relative=2e-5, absolute=2e-5),
        Function("SteepEntry", "n:3 ior:1 t:1", ["e.dirWS.x", "e.dirWS.y", "e.dirWS.z", "float(e.status)", "number(e.cosineInside < 1.1)"], steep, lambda n, ior, t: [mul(unit(n), -1), 0, 1],
                 "RefractionEntry e = enterRefractor(n, n, ior, t);", absolute=1e-3),
        Function("LongExit", "n:3 v:3 ior:1", ["dot(e.dirWS, e.dirWS)"], long, lambda n, v, ior: [1], "RefractionExit e = computeRefraction(kRefractionSphere, vec3(0.0), n, v, ior, 1.0);"),
        Function("Fresnel", "m:i c:1 ior:1", ["computeFresnel(m, c, ior)"], fresnelRows,
                 lambda m, c, i: [fresnelExact(c, i) if m == 1 else fresnelSchlick(c, i) if m == 2 else 0], relative=2e-5, absolute=2e-6),
        Function("FresnelEnds", "m:i c:1 ior:1", ["computeFresnel(m, c, ior)"], [[m, c, i] for m in (1, 2) for c in (1, 1.5) for i in (1e-4, 0.001, 0.002, 500, 1000, 5000)],
                 lambda m, c, i: [fresnelExact(c, i) if m == 1 else fresnelSchlick(c, i)], absolute=4e-4),
        Function("Reflection", "n:3 v:3", ["d.x", "d.y", "d.z"], reflections, reflect, "vec3 d = computeReflectionDirection(n, v);", absolute=1e-6),
        Function("Transmittance", "c:3 a:1 path:1", ["t.x", "t.y", "t.z"],
                 [[[0.5, 0.25, 0.75], 1, 1], [[0.5, 0.25, 0.75], 2, 1], [[0.5, 0.25, 0.75], 1, 3], [[1, 1.1, 1.2], 1, 4], [[1.2, 1, 1.1], 0.5, 4],
                  [[1.1, 1.2, 1], 0.5, 4], [[0, -1, kNaN], 1, 1], [[kNaN, 0, 5e-5], 8, 1], [[2e-4, kNaN, 0], 4, 1], [[0.5, 0.9, 0.8], 1, 0], [[0.5, 0.9, 0.8], 1, -2],
                  [[0.5, 0.9, 0.8], 1, kNaN], [[0.5, 0.9, 0.8], 0, 1e-5], [[0.5, 0.9, 0.8], -3, 1e-5], [[0.5, 0.9, 0.8], kNaN, 1e-5], [[0.5, 0.9, 0.8], 2e-5, 1e-5],
                  [[0.5, 0.9, 0.8], 0.005, 0.004], [[0.5, 0.9, 0.8], 5e-6, 1e-5], [[0.5, 0.9, 0.8], 65504, 65504], [[0.5, 0.9, 0.8], 65504, 1e6], [[0.5, 0.9, 0.8], 65504, kInf],
                  [[0.95, 0.2, 0.999], 0.75, 0.5], [[0, 0, 0], 1, -0.0], [[0, 0, 0], 1, 0]],
                 transmittance, "vec3 t = computeTransmittance(c, a, path);", relative=4e-5, absolute=1e-7),
    ], ["crossray/refract/refraction.glsl", "crossray/refract/fresnel.glsl", "crossray/refract/absorption.glsl", "crossray/core/reflection.glsl"])


def make():
    refractTables()
