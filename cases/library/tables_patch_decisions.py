"""The table of what project/patch_tracer.glsl decides in a pixel, function by function, the ray and the surfaces given by the row; see tables.py."""
import math
import random
from tables import Function, clamp01, copyOf, dot, length, single, sub, write
from tables_core import kSlope, kViews
from tables_linear import Undecided
from tables_patch_way import at, before, entry, kHooks, middle, planeAt


def depthOf(o, a): return -a if o else 1 / max(a, 1e-30)


def view(o, ss, depth):
    return [(ss[0] / 32 - 1) * kSlope[0] * (1 if o else depth), (1 - ss[1] / 24) * kSlope[1] * (1 if o else depth), -depth]


def settle(start, delta, affine, startPixel, surface, error):
    """A ray within 2^-10 of its depth, and twice the error, of its pixel's plane starts on it; the lifted one is nearer by 2^-18 and the error."""
    onPlane = planeAt(surface, middle(startPixel), start)
    stands = abs(affine[0] - onPlane) <= abs(onPlane) / 1024 + 2 * error and not surface[3] < 0
    first, last = onPlane if stands else affine[0], affine[0] + affine[1]
    lift = lambda a: a + abs(a) / 2 ** 18 + error
    return [first, last - first, lift(first), lift(last) - lift(first), stands, error, startPixel]


def clearance(o, start, delta, affine, hidden, hiddenS, last, s, plane, spots):
    """gap * width / chord^2: the smallest gap of both ends and four places between, at pixels that the image has; sky hides nothing."""
    spotted = {tuple(int(v) for v in q[:2]): q[2:] for q in spots}

    def surface(pixel):
        x, y = middle(pixel)
        return spotted.get(tuple(int(v) for v in pixel), [plane[0] + plane[1] * x + plane[2] * y, *plane[1:], 0.0])
    gap = lambda pixel, t: depthOf(o, affine[0] + affine[1] * t) - depthOf(o, surface(pixel)[0])
    gaps = [gap(hidden, hiddenS), gap(last, s)]
    for i in range(4):
        t = hiddenS + (s - hiddenS) * (i + 0.5) / 4
        place = at(start, delta, t)
        if any(abs(x - round(x)) < 1e-3 for x in place):
            raise Undecided
        pixel = [min(max(math.floor(x), 0), n - 1) for x, n in zip(place, (64, 48))]
        gaps += [] if surface(pixel)[3] < 0 else [gap(pixel, t)]
    first, final = [depthOf(o, surface(p)[0]) for p in (hidden, last)]
    a, b, mean = at(start, delta, hiddenS), at(start, delta, s), (first + final) / 2
    chord = sub(view(o, b, final), view(o, a, first))
    across = sub(view(o, b, mean), view(o, a, mean))
    return max(min(gaps), 0.0) * length(across) / dot(chord, chord) if dot(chord, chord) > 0 else 0.0


def goesOn(start, delta, affine, startPixel, error, pixel, s, byX, surface, front, other):
    """The ray nears the plane that it is behind, it was before it within the pixel before, and the planes meet within half a pixel of the border."""
    if list(pixel) == list(startPixel) or other[3] < 0:
        return False
    border = at(start, delta, s)
    rise = planeAt(surface, middle(pixel), border) - planeAt(other, middle(before(delta, startPixel, pixel, byX)), border)
    longer = max(abs(delta[0]), abs(delta[1]))
    bend = abs(sum((g - h) * x for g, h, x in zip(surface[1:3], other[1:3], delta))) / longer
    nearing = (affine[1] - sum(g * x for g, x in zip(surface[1:3], delta))) / longer
    return nearing < 2 * error and -front <= 2 * error - nearing and rise <= 2 * error + bend / 2


def share(start, delta, affine, rect, surface, s):
    """Where in a cell a ray crosses its plane: at its entry where it is behind there, at its end at the latest."""
    center = [(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2]
    fronts = []
    for t in s:
        place = [min(max(x, rect[k]), rect[2 + k]) for k, x in enumerate(at(start, delta, t))]
        fronts.append(affine[0] + affine[1] * t - planeAt(surface, center, place))
    a, b = fronts
    part = (clamp01(a / (a - b)) if a != b else 0.0) if a > 0 else 0.0
    return s[0] + (s[1] - s[0]) * part


def confidence(c):
    if c > 0.5 * single(1e30):
        return 0.998
    log = math.log(max(c, 1e-4))
    return min(1 / (1 + math.exp(-min(2.2 + 1.3 * log, 3.25 + 2.5 * log))), 0.995)


def kept(make, sure, count):
    """The first rows of `make` that no rounding would turn."""
    found = []
    while len(found) < count:
        row = make()
        try:
            sure(*row)
        except Undecided:
            continue
        found.append(row)
    return found


def decision(start, delta, affine, first, stands, error, pixel, inFront, caution, known, surface, fronts, s, plane):
    """What a pixel decides: hit, refused, where the ray crosses its plane, in front after it, where it went out of sight, clearance."""
    hidden, hiddenS = ([10, 9], 0.125)
    noSurface = surface[3] < 0
    behind, goesBehind = [not noSurface and f < 0 for f in fronts]
    rect = [*pixel, pixel[0] + 1, pixel[1] + 1]
    if stands and pixel == first:
        return [0, 0, 0, 1, hidden, hiddenS, known]
    enter, byX = entry(start, delta, first, pixel)
    last = before(delta, first, pixel, byX)
    other = [planeAt([plane[0], *plane[1:]], [0, 0], middle(last)), *plane[1:], 0.0]
    where = share(start, delta, affine[:2], rect, surface, s)
    if behind:
        if inFront and goesOn(start, delta, affine, first, error, pixel, enter, byX, surface, fronts[0], other):
            return [1, 0, where, 0, hidden, hiddenS, known]
        hidden, hiddenS = (pixel, s[0]) if inFront else (hidden, hiddenS)  # it is hidden from here, or still
        return [0, not goesBehind and caution > 0, 0, not goesBehind, hidden, hiddenS, known if goesBehind else 0]
    if not inFront:
        known = min(known, clearance(False, start, delta, affine, hidden, hiddenS, last, s[0], plane, []))
        if known < caution:
            return [0, 1, 0, 1, hidden, hiddenS, known]
    return [1, 0, where, 0, hidden, hiddenS, known] if goesBehind else [0, 0, 0, 1, hidden, hiddenS, known]


def settleRows():
    rows = []
    ray = [[8.75, 8.25], [16.0, 8.0]]
    for sign in (1, -1):
        for surface in ([sign * 0.25, 0.0078125, -0.00390625, 0.0], [sign * 0.25, 0, 0, 0.0], [sign * 0.25, 0, 0, -1.0]):
            for error in (0.0, 0.001953125):
                onPlane = planeAt(surface, [8.5, 8.5], ray[0])
                border = abs(onPlane) / 1024 + 2 * error
                rows += [[*ray, [onPlane + side * border * part, -sign * 0.375], [8, 8], surface, error] for side in (1, -1) for part in (0, 0.25, 0.9375, 1, 1.0625, 3)]
    return rows


def clearanceRows():
    chance = random.Random(5)

    def row():
        o = chance.randrange(2)
        start, delta = [chance.uniform(4, 60), chance.uniform(4, 44)], [chance.choice((-1, 1)) * chance.uniform(4, 60) for _ in range(2)]
        first = chance.uniform(0, 0.6)
        s = first + chance.uniform(0.1, 0.4)
        near = lambda z: -z if o else 1 / z
        plane = [near(chance.uniform(2, 4)), 0, 0] if o else [near(chance.uniform(2, 4)), chance.uniform(-1, 1) / 1024, chance.uniform(-1, 1) / 1024]
        affine = [near(chance.uniform(4, 6)), near(chance.uniform(4, 6))]
        affine[1] -= affine[0]
        ends = [[min(max(math.floor(x), 0), n - 1) for x, n in zip(at(start, delta, t), (64, 48))] for t in (first, s)]
        # A surface at a place that is asked, nearer to the ray than the others are; it may be sky, and any of the ends.
        spots = []
        for _ in range(3):
            t = chance.choice([first, s] + [first + (s - first) * (i + 0.5) / 4 for i in range(4)])
            pixel = [min(max(math.floor(x), 0), n - 1) for x, n in zip(at(start, delta, t), (64, 48))]
            z = depthOf(o, affine[0] + affine[1] * t) - chance.choice((0.05, 0.3, 0.8, -0.2, 0.1, 0.5))
            sky = chance.random() < 0.15 and pixel not in ends
            spots.append([*pixel, -128.0 if o and sky else 0 if sky else near(z), 0, 0, -1 if sky else 0])
        spots = [spot for k, spot in enumerate(spots) if all(spot[:2] != other[:2] for other in spots[:k])]
        spots += [[-9, -9, 0, 0, 0, 0]] * (3 - len(spots))
        return [o, start, delta, affine, ends[0], first, ends[1], s, plane, *spots]
    rows = kept(row, lambda *a: clearance(*a[:9], a[9:]), 160)
    return rows + [[o, [8.5, 8.25], [16.0, 8.0], [-4, -0.5] if o else [0.25, -0.0625], [9, 8], 0.0625, [9, 8], 0.0625, [-3, 0, 0] if o else [0.375, 0, 0]] + [[-9, -9, 0, 0, 0, 0]] * 3 for o in (0, 1)]


def goesOnRows():
    """Each of the three conditions at its border, beside it, and far from it; by x and by y, in all directions, with and without an error."""
    rows = []
    for sx in (1, -1):
        for sy in (1, -1):
            for byX in (0, 1):
                for error in (0.0, 0.00390625):
                    delta = [sx * 16.0, sy * 8.0] if byX else [sx * 8.0, sy * 16.0]
                    start, pixel = [8.5, 8.5], [8 + 2 * sx, 8 + sy] if byX else [8 + sx, 8 + 2 * sy]
                    s, e = 0.09375, 2 * error
                    surface, other = [0.25, sx / 64, -sy / 128, 0.0], [0.25, sx / 128, sy / 128, 0.0]
                    slope = sum(g * x for g, x in zip(surface[1:3], delta))
                    border = at(start, delta, s)
                    bend = abs(sum((g - h) * x for g, h, x in zip(surface[1:3], other[1:3], delta))) / 16

                    def row(nearing, front, rise):
                        """With the given nearing a pixel, depth behind, and rise of the planes at the border."""
                        now = planeAt(surface, middle(pixel), border) - planeAt(other, middle(before(delta, [8, 8], pixel, byX)), border)
                        return [start, delta, [0.25, nearing * 16 + slope], [8, 8], error, pixel, s, byX, surface, front, [other[0] + now - rise, *other[1:]]]
                    near = -0.03125
                    rows += [row(n, f, r) for n in (e, e - 1 / 512, near) for f in (-1 / 1024, -1 / 64) for r in (-0.25, 0.0)]
                    rows += [row(near, near - e + d, -0.25) for d in (0, -1 / 1024, 1 / 1024)] + [row(near, -1 / 1024, e + bend / 2 + d) for d in (0, -1 / 1024, 1 / 1024, -bend / 4, bend / 4)]
                    rows += [row(near, -0.25, -0.25), row(-0.25, -1 / 64, 0.25)]
    plain = [[8.5, 8.5], [16.0, 8.0], [0.25, -0.5], [8, 8], 0.0, [9, 8], 0.03125, 1, [0.25, 0, 0, 0], -1 / 1024, [0.25, 0, 0, 0]]
    # A ray along the eye's own, which moves by 1e-20 pixels, from the border into the next pixel.
    rows += [[[9.0, 8.5], [-1e-20, -1e-20], [0.25, -0.125], [9, 8], 0.0, [8, 8], 0.0, 1, [0.25, 1 / 64, 0, 0], -1 / 1024, [0.25 + rise, -1 / 64, 0, 0]] for rise in (-0.00390625, -0.0234375)]
    rows += [plain, [*plain[:3], [9, 8], *plain[4:]], [*plain[:-1], [0.25, 0, 0, -1.0]]]  # it goes on; the start's own pixel; sky before
    return rows


def decisionRows():
    rows = []
    start, delta, first = [8.5, 8.25], [16.0, 8.0], [8, 8]
    for pixel, s in (([8, 8], [0.0, 0.03125]), ([12, 10], [0.21875, 0.28125])):
        for stands in (0, 1):
            for inFront in (0, 1):
                for caution in (0.0, 0.25):  # of which a clearance of 0.25 is enough
                    for fronts in ([1 / 1024, 1 / 512], [-1 / 1024, -1 / 512], [1 / 512, -1 / 1024], [-1 / 512, 1 / 1024], [0.0, 0.0]):
                        for surface, plane in (([0.25, 0, 0, 0], [0.25, 0, 0]), ([0.25, 0, 0, 0], [0.5, 0, 0]), ([0.25, 0, 0, 0], [0.125, 0, 0]), ([0.0, 0, 0, -1.0], [0.25, 0, 0])):
                            rows += [[start, delta, [a, -0.0625, 7, 8], first, stands, 0.0, pixel, inFront, caution, known, surface, fronts, s, plane]
                                     for a in (0.255859375, 0.2646484375) for known in (1e30, 0.25)]
    return rows


def shareRows():
    rows = []
    for affine in ([0.5, 0.0], [0.5, -1.0], [0.25, -1.0], [0.375, -0.5], [0.5, -0.25], [0.3125, -0.25], [0.25, 0.0], [0.125, 1.0]):
        for rect, surface in (([8, 8, 9, 9], [0.25, 0.0, 0.0, 0.0]), ([8, 8, 16, 16], [0.25, 0.0078125, -0.00390625, 0.0])):
            rows += [[[8.5, 8.25], [16.0, 8.0], affine, rect, surface, s] for s in ([0.0, 0.03125], [0.125, 0.375], [0.25, 0.25])]
    return rows


kSpots = "spotA = whole(a.xy);\nspotB = whole(b.xy);\nspotC = whole(c.xy);\ncellA = vec4(a.zw, a2);\ncellB = vec4(b.zw, b2);\ncellC = vec4(c.zw, c2);\n"


def decisionFunctions():
    cell = "tableCell(rect, surface, s, front, false)"
    state = "PatchState(whole(pixel), 0, inFront, HiddenStart(ivec2(10, 9), 0.125), known)"
    test = ["number(t.isHit)", "number(t.isRefused)", "t.s", "number(t.inFront)", "float(t.hidden.pixel.x)", "float(t.hidden.pixel.y)", "t.hidden.s", "t.clearance"]
    walk = "PatchWalk w = tableWalk(start, delta, affine, first, stands, error);\n"
    ray = "PatchWalk w = tableWalk(start, delta, vec4(affine, 7.0, 8.0), first, false, error);\n"
    step = ["float(p.iteration)", "float(p.level)", "float(p.cell.x)", "float(p.cell.y)", "float(p.rect.end.x)", "float(p.rect.end.y)", "p.positionSS.x", "p.positionSS.y", "p.rayLinearDepth",
            "p.nearLinearDepth", "p.farLinearDepth", "float(p.intersectionKind)"]
    result = ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.maxUsedLevel)", "float(r.intersectionKind)", "r.confidence"]
    counts = "PatchTraceResult counts = PatchTraceResult(8, 8, vec2(88.0), 88.0, 31, 4, 1, 88.0);\n"

    def stepOf(o, start, delta, affine, rect, surface, s, front):
        plane = affine[2] + affine[3] * s[0] - front[0]
        slack = max(surface[3], 0.0)
        return [17, 3, rect[:2], rect[2:], at(start, delta, s[0]), depthOf(o, affine[0] + affine[1] * s[0]), depthOf(o, plane + slack), depthOf(o, plane - slack), 2]

    def endOf(o, start, delta, affine, s, reason, status):
        kind = 0 if reason == 9 else 2 if reason == 7 else 3
        return [kind, reason, at(start, delta, s), depthOf(o, affine[0] + affine[1] * s) if status == 0 else 0, 31, 4, 1, 0]

    def hitOf(o, start, delta, rect, surface, s, known):
        place = [min(max(x, rect[k]), rect[2 + k]) for k, x in enumerate(at(start, delta, s))]
        return [1, 0, place, depthOf(o, planeAt(surface, [(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2], place)), 31, 4, 2, confidence(known)]
    way = [[8.5, 8.25], [16.0, 8.0]]
    steps = [[o, *way, [-4, -2, -3.75, -1.5] if o else [0.25, -0.125, 0.28125, -0.0625], rect, [9, 9, 9, slack], [0.25, 0.5], [front, 9]]
             for o in (0, 1) for rect in ([8, 8, 16, 12], [2, 3, 4, 4]) for slack in (0.015625, -1.0, 0.0) for front in (0.03125, -0.03125)]
    ends = [[o, *way, [-4, -2] if o else [0.25, -0.125], s, reason, status] for o in (0, 1) for s in (0.0, 0.25) for reason, status in ((7, 0), (2, 0), (3, 0), (1, 0), (4, 0), (9, 9), (7, 7), (4, 4))]
    hits = [[o, *way, rect, [-4 if o else 0.25, 0.0078125, -0.00390625, 0], s, known] for o in (0, 1) for rect in ([8, 8, 16, 12], [10, 9, 11, 10]) for s in (0.125, 0.25, 0.0) for known in (1e30, 0.5)]
    knows = [1e30, 8e29, 5.5e29, 0.5 * single(1e30), 4e29, 0, -1, 1e-5, 1e-4, 2e-4, 0.01, 0.1, 0.2, 0.4, 0.4167, 0.6, 1, 2, 3, 1e3, 1e6]
    return [
        Function("Settle", "start:2 delta:2 affine:2 first:2 surface:4 error:1",
                 ["w.ray.startAffineDepth", "w.ray.deltaAffineDepth", "w.lifted.startAffineDepth * 16384.0", "w.lifted.deltaAffineDepth * 16384.0", "number(w.stands)", "w.depthError", "float(w.startPixel.x)", "float(w.startPixel.y)"],
                 settleRows(), lambda *a: (lambda q: [*q[:2], q[2] * 16384, q[3] * 16384, *q[4:]])(settle(*a)),
                 "spotA = whole(first);\ncellA = surface;\nPatchWalk w = makePatchWalk(tableRay(start, delta, affine), whole(first), error);", relative=1e-6, absolute=2e-3),
        Function("Clearance", "o:b start:2 delta:2 affine:2 from:2 fromS:1 last:2 s:1 plane:3 a:4 a2:2 b:4 b2:2 c:4 c2:2", ["computeClearance(tableView(o, true), w, HiddenStart(whole(from), fromS), whole(last), s)"],
                 clearanceRows(), lambda *a: clearance(*a[:9], [a[9] + a[10], a[11] + a[12], a[13] + a[14]]),
                 kSpots + "tablePlane = plane;\nPatchWalk w = tableWalk(start, delta, vec4(affine, 7.0, 8.0), vec2(8.0), false, 0.0);", relative=1e-4, absolute=1e-6),
        Function("GoesOn", "start:2 delta:2 affine:2 first:2 error:1 pixel:2 s:1 byX:b surface:4 front:1 other:4",
                 ["number(doesSurfaceGoOn(w, tableCell(vec4(pixel, pixel + vec2(1.0)), surface, vec2(s, 1.0), vec2(front, 5.0), false), whole(pixel), PixelEntry(s, byX)))"], goesOnRows(), goesOn,
                 "tablePlane = other.xyz;\ntableSlack = other.w;\n" + ray + "spotA = computePixelBefore(w, whole(pixel), byX);\ncellA = other;"),
        Function("PixelHit", "start:2 delta:2 affine:2 rect:4 surface:4 s:2", ["t.s", "number(t.isHit && !t.isRefused && !t.inFront)", "t.clearance", "t.hidden.s"], shareRows(), lambda *a: [share(*a), 1, 0.625, 0.125],
                 "vec2 first = vec2(8.0);\nfloat error = 0.0;\nbool inFront = true;\nfloat known = 0.625;\nvec2 pixel = first;\nvec2 front = vec2(6.0, 7.0);\n" + ray
                 + f"PixelTest t = makePixelHit(w, {cell}, {state}, known);"),
        Function("Decision", "start:2 delta:2 affine:4 first:2 stands:b error:1 pixel:2 inFront:b caution:1 known:1 surface:4 front:2 s:2 plane:3", test, decisionRows(), decision,
                 walk + f"tablePlane = plane;\nvec4 rect = vec4(pixel, pixel + vec2(1.0));\nPixelTest t = testPixel(tableView(false, true), w, {cell}, {state}, caution);", relative=1e-4),
        Function("Confidence", "c:1", ["computeConfidence(c)"], [[c] for c in knows], confidence),
        Function("Step", "o:b start:2 delta:2 affine:4 rect:4 surface:4 s:2 front:2", step, steps, stepOf,
                 "vec2 first = vec2(8.0);\nbool stands = false;\nfloat error = 0.0;\n" + walk + f"PatchStep p = makePatchStep(tableView(o, true), w, {cell}, 3, 2, 17);"),
        Function("End", "o:b start:2 delta:2 affine:2 s:1 reason:i status:i", result, ends, endOf,
                 counts + "ScreenRay ray = tableRay(start, delta, affine);\nray.status = status;\nPatchTraceResult r = makePatchEnd(tableView(o, true), ray, s, reason, counts);"),
        Function("Hit", "o:b start:2 delta:2 rect:4 surface:4 s:1 known:1", result, hits, hitOf,
                 counts + "PatchWalk w = tableWalk(start, delta, vec4(0.25, -0.125, 7.0, 8.0), vec2(8.0), false, 0.0);\n"
                 "PatchCell cell = tableCell(rect, surface, vec2(5.0, 6.0), vec2(7.0, 8.0), false);\nPixelTest t = PixelTest(true, false, s, false, HiddenStart(ivec2(1), 9.0), known);\n"
                 "PatchTraceResult r = makePatchHit(tableView(o, true), w, cell, t, counts);"),
    ]


def make():
    write("patch_decisions", "What the march over planes decides in a pixel, function by function: where it starts, hits, hides and comes out again.", decisionFunctions(), [],
          kViews + copyOf("crossray/project/patch_tracer.glsl") + kHooks)
