"""The table of project/patch_tracer.glsl: the march over planes by its definition, over a pyramid of formulas; see tables.py."""
import math
import random
from tables import Function, clamp01, copyOf, dot, flat, length, mul, single, sub, unit, write
from tables_core import fromView, kEye, kSize, kSlope, kViews
from tables_linear import Undecided, decide, noStart, noStarts
from tables_patch import span
from tables_project import screenRay

# Walls, of which some have a box before them, a hole, or are seen from behind where the ray goes; coarser cells bound them, some of them loosely.
kHooks = """
int tableKind = 0;

vec3 wallPlane() // affine depth at the corner of the image, and its change a pixel
{
    return tableKind == 1 ? vec3(0.03125, 0.0, 0.0078125) : tableKind == 2 ? vec3(0.375, -0.00390625, 0.0) : vec3(0.125, 0.001953125, 0.00048828125);
}
ivec4 tableBox() { return tableKind == 3 ? ivec4(28, 12, 36, 34) : tableKind == 4 ? ivec4(20, 8, 52, 40) : ivec4(0); } // begin, end
float boxAffine() { return tableKind == 4 ? 0.28125 : 0.3125; }
ivec2 surfacePyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int surfacePyramidLevelCount() { return tableKind == 6 ? 0 : 7; }

vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    ivec2 cells = surfacePyramidSize(level);
    ivec2 begin = ivec2(cell.x << level, cell.y << level);
    ivec2 end = ivec2(cell.x == cells.x - 1 ? 64 : begin.x + (1 << level), cell.y == cells.y - 1 ? 48 : begin.y + (1 << level));
    vec2 center = 0.5 * vec2(begin + end);
    ivec4 box = tableBox();
    bool touches = box.z > 0 && begin.x < box.z && end.x > box.x && begin.y < box.w && end.y > box.y;
    bool isHole = tableKind == 5 && begin.x >= 32;
    vec3 wall = wallPlane();
    vec4 plane = vec4(wall.x + dot(wall.yz, center), wall.yz, level == 0 ? 0.0 : 0.0009765625 * float(level));
    vec4 front = level == 0 ? vec4(boxAffine(), 0.0, 0.0, 0.0) : vec4(plane.xyz, 0.25);
    vec4 edge = vec4(cell.x < 64 && cell.y < 48 ? 0.25 : 0.5, 0.0, 0.0, 0.0); // a wall that faces the eye, and no pixel beyond the image
    return tableKind == 7 ? edge : isHole ? vec4(0.0, 0.0, 0.0, -1.0) : touches ? front : plane;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedCells = 0.0;
void recordPatchStep(PatchStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * min(step.rayLinearDepth, 40.0) + 5.0 * min(step.nearLinearDepth, 40.0) + 7.0 * min(step.farLinearDepth, 40.0));
    recordedCells += share * float(step.level + 3 * step.cell.x + 5 * step.cell.y + 7 * (step.rect.end.x - step.rect.begin.x) + 11 * (step.rect.end.y - step.rect.begin.y) + 13 * step.intersectionKind);
}
"""

kStarts = """
// Looks along -z from the origin, 90 degrees wide and half as high: the border of its image is met exactly.
View startView(bool edge)
{
    View view = tableView(false, true);
    mat4 clip = mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, -1.0), vec4(0.0, 0.0, 0.5, 0.0));
    if (edge) view = View(mat4(1.0), mat4(1.0), clip, vec2(64.0, 48.0), vec2(1.0, 0.5), 0.0, 0.5, 0.5, 64.0, false, true);
    return view;
}
"""


def size(level): return max(64 >> level, 1), max(48 >> level, 1)


def surface(kind, cell, level):
    """Rect, affine depth at its centre, gradient, slack."""
    spans = [span(cell[k], level, size(level)[k], int(kSize[k])) for k in range(2)]
    center = [sum(s) / 2 for s in spans]
    if kind == 5 and spans[0][0] >= 32:
        return spans, 0.0, [0.0, 0.0], -1.0
    a, *g = (0.03125, 0.0, 0.0078125) if kind == 1 else (0.375, -0.00390625, 0.0) if kind == 2 else (0.125, 0.001953125, 0.00048828125)
    box, at = ((28, 12, 36, 34), 0.3125) if kind == 3 else ((20, 8, 52, 40), 0.28125) if kind == 4 else (None, 0)
    middle = a + dot(g, center)
    if box and spans[0][0] < box[2] and spans[0][1] > box[0] and spans[1][0] < box[3] and spans[1][1] > box[1]:
        return (spans, at, [0.0, 0.0], 0.0) if level == 0 else (spans, middle, g, 0.25)
    return spans, middle, g, 0.0 if level == 0 else level / 1024


def march(kind, px, py, lift, d, maxLevel, most, caution, error):
    z = 1 / surface(kind, (px, py), 0)[1] * (1 + lift) if surface(kind, (px, py), 0)[3] >= 0 else 8.0 * (1 + lift)
    ndc = [(px + 0.5) / 32 - 1, 1 - (py + 0.5) / 24]
    view = lambda ss, depth: [(ss[0] / 32 - 1) * kSlope[0] * depth, (1 - ss[1] / 24) * kSlope[1] * depth, -depth]
    origin = fromView([ndc[0] * kSlope[0] * z, ndc[1] * kSlope[1] * z, -z])
    _, _, dx, dy, _, a0, da, endReason, status = flat(screenRay(False, origin, sub(fromView(d), kEye)))
    assert status == 0
    start, delta = [px + 0.5, py + 0.5], [dx, dy]
    maxLevel, caution, error = min(max(maxLevel, 0), 0 if kind == 6 else 6), caution if caution > 0 else 0.0, error if error > 0 else 0.0
    depthOf = lambda a: 1 / max(a, 1e-30)
    rawStart, rawDelta = a0, da
    _, onPlane, _, slack = surface(kind, (px, py), 0)
    if 0.7 < abs(a0 - onPlane) / (abs(onPlane) / 1024 + 2 * error + 1e-30) < 1.4:
        raise Undecided
    stands = abs(a0 - onPlane) <= abs(onPlane) / 1024 + 2 * error and slack >= 0
    end = a0 + da
    a0 = onPlane if stands else a0
    da = end - a0
    raise_ = lambda a: a + abs(a) / 2 ** 18 + error
    l0 = raise_(a0)
    ld = raise_(end) - l0
    at = lambda s: [start[k] + delta[k] * s for k in range(2)]

    def front(base, rate, s, spans, affine, gradient):
        center = [sum(q) / 2 for q in spans]
        place = [min(max(x, q[0]), q[1]) for x, q in zip(at(s), spans)]
        return base + rate * s - affine - sum(g * (x - c) for g, x, c in zip(gradient, place, center))

    def entryOf(pixel):
        moved = [pixel[0] != px, pixel[1] != py]
        times = [((pixel[k] if delta[k] > 0 else pixel[k] + 1) - start[k]) / delta[k] if moved[k] else 0.0 for k in range(2)]
        if moved[0] and moved[1] and abs(times[0] - times[1]) < 1e-6:
            raise Undecided
        return min(max(max(times), 0.0), 1.0), moved[0] and (not moved[1] or times[0] > times[1])

    def pixelBefore(pixel, byX):
        if tuple(pixel) == (px, py):
            return list(pixel)
        k = 0 if byX else 1
        found = list(pixel)
        found[k] -= 1 if delta[k] > 0 else -1
        return found

    def floorAt(s, k, least):
        x = start[k] + delta[k] * s
        if abs(x - round(x)) < 1e-3:
            raise Undecided
        found = int(math.floor(x))
        return max(found, least) if delta[k] > 0 else min(found, least)

    def gapOf(affine, s): return depthOf(a0 + da * s) - depthOf(affine)

    def clearanceOf(hidden, last, s):
        (hp, hs) = hidden
        first, final = surface(kind, hp, 0)[1], surface(kind, last, 0)[1]
        gap = min(gapOf(first, hs), gapOf(final, s))
        for i in range(4):
            between = hs + (s - hs) * (i + 0.5) / 4
            p = at(between)
            if any(abs(x - round(x)) < 1e-3 for x in p):
                raise Undecided
            pixel = [min(max(int(math.floor(x)), 0), int(n) - 1) for x, n in zip(p, kSize)]
            _, affine, _, slack = surface(kind, pixel, 0)
            if slack >= 0:
                gap = min(gap, gapOf(affine, between))
        firstDepth, finalDepth = depthOf(first), depthOf(final)
        chord = sub(view(at(s), finalDepth), view(at(hs), firstDepth))
        middle = (firstDepth + finalDepth) / 2
        across = sub(view(at(s), middle), view(at(hs), middle))
        square = dot(chord, chord)
        if square < 1e-6:
            raise Undecided
        return max(gap, 0.0) * length(across) / square

    def goesOn(pixel, spans, affine, gradient, entry, frontAtEnter):
        if tuple(pixel) == (px, py):
            return False
        s, byX = entry
        before = pixelBefore(pixel, byX)
        _, other, otherGradient, slack = surface(kind, before, 0)
        if slack < 0:
            return False
        border = at(s)
        value = lambda a, g, q: a + sum(k * (x - c - 0.5) for k, x, c in zip(g, border, q))
        rise = value(affine, gradient, pixel) - value(other, otherGradient, before)
        per = 1 / max(abs(dx), abs(dy))
        bend = abs(dot(sub(gradient, otherGradient), delta)) * per
        nearing = (da - dot(gradient, delta)) * per
        e = 2 * error
        one, two, three = decide(nearing, e, 1e-3, 1e-7), not decide(e - nearing, -frontAtEnter, 1e-3, 2e-6), not decide(e + bend / 2, rise, 1e-3, 2e-7)
        return one and two and three

    def confidence(c):
        if c > 0.5e30:
            return 0.998
        log = math.log(max(c, 1e-4))
        return min(1 / (1 + math.exp(-min(2.2 + 1.3 * log, 3.25 + 2.5 * log))), 0.995)
    pixel, level, inFront, hidden, clearance = [px, py], min(2, maxLevel), True, ((px, py), 0.0), 1e30
    total = cells = 0.0
    iterations = used = kindOf = 0

    def ended(s, reason, base=rawStart, rate=rawDelta):
        return [2 if reason == 7 else 3, reason, *at(s), depthOf(base + rate * s), iterations, used, kindOf, 0.0, total, cells]
    for k in range(most):
        grid = size(level)
        cell = [min(max(pixel[i] >> level, 0), grid[i] - 1) for i in range(2)]
        spans, affine, gradient, slack = surface(kind, cell, level)
        leaves = [((spans[i][1] if delta[i] > 0 else spans[i][0]) - start[i]) / delta[i] for i in range(2)]
        decide(leaves[0], leaves[1], 1e-6, 1e-5)
        enter, byXIn = entryOf(pixel)
        leave = max(min(leaves), enter)
        goes = decide(leave, 1.0, 1e-5, 1e-6)
        leave = min(leave, 1.0)
        byX = leaves[0] <= leaves[1]
        atEnter, atLeave = front(l0, ld, enter, spans, affine, gradient), front(l0, ld, leave, spans, affine, gradient)
        iterations, used = k + 1, max(used, level)
        free = 1e30
        if level > 0:
            terms = abs(affine) + abs(l0) + abs(l0 + ld * leave) + abs(gradient[0]) * spans[0][1] + abs(gradient[1]) * spans[1][1]
            margin = max(slack, 0.0) + 1e-6 * terms
            sign = 1 if inFront else -1
            a, b = sign * atEnter - margin, sign * atLeave - margin
            if min(abs(a), abs(b)) < 3e-6:
                raise Undecided
            if not a > 0:
                free = enter
            elif not b > 0:
                free = enter + (leave - enter) * clamp01(a / (a - b))
        kindOf = 0 if level > 0 and free >= 1e30 else 1
        hit, refused, sHit = False, False, 0.0
        state = (inFront, hidden, clearance)
        if level == 0:
            sky = slack < 0
            mine = stands and tuple(pixel) == (px, py)
            if not sky and not mine and min(abs(atEnter), abs(atLeave)) < 2e-6:
                raise Undecided
            behind, goesBehind = not sky and atEnter < 0, not sky and atLeave < 0
            found = False
            if mine:
                state = (True, hidden, clearance)
            elif inFront and behind:
                if goesOn(pixel, spans, affine, gradient, (enter, byXIn), atEnter):
                    found = True
                else:
                    state = (not goesBehind, (tuple(pixel), enter), clearance if goesBehind else 0.0)
                    refused = not goesBehind and caution > 0
            elif not inFront and behind:
                state = (not goesBehind, hidden, clearance if goesBehind else 0.0)
                refused = not goesBehind and caution > 0
            else:
                now = clearance
                if not inFront:
                    now = min(now, clearanceOf(hidden, pixelBefore(pixel, byXIn), enter))
                    refused = decide(now, caution, 1e-3, 1e-6) if caution > 0 else False
                clearance = now
                if not refused and goesBehind:
                    found = True
                else:
                    state = (True, hidden, now)
            if found:
                hit = True
                a, b = front(a0, da, enter, spans, affine, gradient), front(a0, da, leave, spans, affine, gradient)
                share = clamp01(a / (a - b)) if a > 0 else 0.0
                sHit = enter + (leave - enter) * share
        if hit:
            kindOf = 2
        plane = l0 + ld * enter - atEnter
        wide = max(slack, 0.0)
        share = 1 / (k + 2)
        p = at(enter)
        bounded = lambda a: min(depthOf(a), 40.0)
        total += share * (p[0] + 2 * p[1] + 3 * bounded(a0 + da * enter) + 5 * bounded(plane + wide) + 7 * bounded(plane - wide))
        cells += share * (level + 3 * cell[0] + 5 * cell[1] + 7 * (spans[0][1] - spans[0][0]) + 11 * (spans[1][1] - spans[1][0]) + 13 * kindOf)
        if hit:
            place = [min(max(x, q[0]), q[1]) for x, q in zip(at(sHit), spans)]
            depth = affine + sum(g * (x - sum(q) / 2) for g, x, q in zip(gradient, place, spans))
            return [1, 0, *place, depthOf(depth), iterations, used, 2, confidence(clearance), total, cells]
        if refused:
            return ended(enter, 3)
        inFront, hidden, clearance = state
        if free < 1e30:
            if free > enter:
                pixel = [min(max(floorAt(free, i, pixel[i]), spans[i][0]), spans[i][1] - 1) for i in range(2)]
            per = abs(atLeave - atEnter) / max((leave - enter) * max(abs(dx), abs(dy)), 1e-20)
            pixels = min(max(2 * max(slack, 0.0) / per if per > 0 else 1e9, 1.0), 1e9)
            power = math.log2(pixels)
            if abs(power - round(power)) < 1e-3 and 0 < power < 7:
                raise Undecided
            level = min(max(math.ceil(power), 0), level - 1)
        else:
            following = [0, 0]
            i = 0 if byX else 1
            following[i] = spans[i][1] if delta[i] > 0 else spans[i][0] - 1
            following[1 - i] = floorAt(leave, 1 - i, pixel[1 - i])
            inside = 0 <= following[0] < 64 and 0 <= following[1] < 48
            if not goes or not inside:
                return ended(leave, (endReason if not goes else 2) if inFront else 3)
            border = following[i] if delta[i] > 0 else following[i] + 1
            wanted = level
            for _ in range(2):
                wanted += 0 if (border >> wanted) & 1 else 1
            level = min(wanted, maxLevel)
            pixel = following
    return ended(entryOf(pixel)[0], 1)


def edges():
    """From the very border of the image, on the wall of its last pixels, 4 m away, into the wall."""
    rows = []
    for at in (0.2578125, -0.3671875):
        rows += [[1, [4.0, 2 * at, -4.0], [-1, 0, -0.5]], [1, [4 * at, -2.0, -4.0], [0, 1, -0.5]]]
    return rows


def start(isEdge, p, d):
    if not isEdge:
        answer = noStart(p, d)
        return answer[:4] + [answer[4] if answer[1] == 2 else 0, 0, 0, 0, 0]
    # It stands on its own pixel's wall and hits that of the pixel before, whose border is where (4 - t) / (4 + t / 2) is a pixel less than the image's half.
    axis = 0 if d[0] != 0 else 1
    half = (32, 24)[axis]
    x = 1 - 1 / half
    t = (4 - 4 * x) / (1 + x / 2) if axis == 0 else (2 - 2 * x) / (1 + x / 4)
    z = 4 + t / 2
    place = [63, 24 * (1 - 2 * p[1] / z)] if axis == 0 else [32 * (1 + p[0] / z), 47]
    return [1, 0, *place, 4, 2, 0, 2, 0.998]


def make():
    chance = random.Random(23)
    def draw(kinds, highs):
        row = [chance.choice(kinds), chance.randrange(2, 62), chance.randrange(2, 46), chance.choice((0, 0, -0.05, -0.3, 0.04)), unit([chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(-1, 1)]),
               chance.choice(highs), chance.choice((200, 200, 200, 5)), chance.choice((0, 0.05, 0.4, 1.5, -1)), chance.choice((0, 0, 0, 0.001953125, -1))]
        numbers = [single(x) for x in flat(row)]
        try:
            march(*[int(x) for x in numbers[:3]], numbers[3], numbers[4:7], int(numbers[7]), int(numbers[8]), numbers[9], numbers[10])
        except (Undecided, AssertionError, ZeroDivisionError):
            return None
        return row
    rows = [draw(range(6), (0, 1, 3, 6, 9)) for _ in range(3000)]
    more = [draw((6,), (0, 3)) for _ in range(40)] + [draw((0, 3), (-2,)) for _ in range(40)]  # a pyramid of no levels, and none that may be used
    rows, more = [row for row in rows if row], [row for row in more if row]
    rows = rows[:780] + more[::2][:20] + [[0, 20, 20, 0, unit([0.3, 0.2, -1]), 6, most, 0.4, 0] for most in (0, -1, 1)]
    write("patches", "The march over planes descends, hits, refuses and passes as its definition says, over surfaces that are formulas.", [
        Function("March", "k:i x:i y:i lift:1 d:3 high:i most:i caution:1 error:1",
                 ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.maxUsedLevel)", "float(r.intersectionKind)", "r.confidence",
                  "recorded", "recordedCells"],
                 rows, march,
                 "tableKind = k;\nView v = tableView(false, true);\nvec4 s = fetchSurfaceCell(ivec2(x, y), 0);\nfloat z = (s.w < 0.0 ? 8.0 : 1.0 / s.x) * (1.0 + lift);\n"
                 "vec3 p = positionWSFromSS(v, vec2(float(x) + 0.5, float(y) + 0.5), z);\nvec3 w = (v.worldFromView * vec4(d, 0.0)).xyz;\n"
                 "PatchTraceResult r = tracePatches(v, p, w, PatchTracerSettings(high, most, caution, error));", relative=4e-4, absolute=4e-3),
    ], [], kViews + copyOf("crossray/project/patch_tracer.glsl") + kHooks)
    result = ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.maxUsedLevel)", "float(r.intersectionKind)", "r.confidence"]
    write("patch_starts", "The march over planes starts on the very border of the image, and answers why it cannot start.", [
        Function("Start", "edge:b p:3 d:3", result, [[0, *row] for row in noStarts()] + edges(), start,
                 "tableKind = edge ? 7 : 0;\nPatchTraceResult r = tracePatches(startView(edge), p, d, PatchTracerSettings(edge ? 0 : 4, 100, 0.4, 0.0));", relative=2e-5, absolute=1e-4),
    ], [], kViews + copyOf("crossray/project/patch_tracer.glsl") + kHooks + kStarts)
