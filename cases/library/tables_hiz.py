"""The table of project/hiz.glsl: the march by its definition, over a pyramid of formulas; see tables.py."""
import math
import random
from tables import Function, copyOf, dot, flat, single, sub, unit, write
from tables_core import fromView, kEye, kSize, kSlope, kViews
from tables_linear import Undecided, decide, noStart, noStarts
from tables_patch import slopeOf, span
from tables_project import screenRay

# 64 x 48 pixels, 7 levels. Every cell's depths are those of the pixels that it covers, which is why surfaces are monotonous formulas: along each axis the nearest
# pixel is the first or the last.
kHooks = """
int tableKind = 0;

// Affine depth (1/m) of a pixel: a wall that turns away to the right, or a floor; before it from column `begin` on a box that faces the eye.
float wallAffine(ivec2 pixel)
{
    vec2 center = vec2(pixel) + vec2(0.5);
    return tableKind == 1 ? 0.03125 + 0.0078125 * center.y : tableKind == 2 ? 0.375 - 0.00390625 * center.x : 0.125 + 0.001953125 * center.x + 0.00048828125 * center.y;
}
ivec4 tableBox() { return tableKind == 3 ? ivec4(28, 12, 36, 34) : tableKind == 4 ? ivec4(20, 8, 52, 40) : ivec4(0); } // begin, end
float boxAffine() { return tableKind == 4 ? 0.28125 : 0.3125; }

ivec2 depthPyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int depthPyramidLevelCount() { return 7; }

vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 cells = depthPyramidSize(level);
    ivec2 begin = ivec2(cell.x << level, cell.y << level);
    ivec2 end = ivec2(cell.x == cells.x - 1 ? 64 : begin.x + (1 << level), cell.y == cells.y - 1 ? 48 : begin.y + (1 << level)) - ivec2(1);
    float a = wallAffine(begin), b = wallAffine(end), c = wallAffine(ivec2(begin.x, end.y)), d = wallAffine(ivec2(end.x, begin.y));
    float high = max(max(a, b), max(c, d));
    float low = min(min(a, b), min(c, d));
    ivec4 box = tableBox();
    bool touches = box.z > 0 && begin.x < box.z && end.x >= box.x && begin.y < box.w && end.y >= box.y;
    bool isInside = touches && begin.x >= box.x && end.x < box.z && begin.y >= box.y && end.y < box.w;
    high = touches ? boxAffine() : high;
    low = isInside ? boxAffine() : low;
    vec2 depths = 1.0 / vec2(high, low);
    return tableKind == 5 && begin.x >= 32 ? vec2(1e30) : depths;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedCells = 0.0;
void recordHizStep(HizStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * step.rayLinearDepth + 5.0 * min(step.nearestLinearDepth, 20.0) + 7.0 * min(step.farthestLinearDepth, 40.0)
        + 11.0 * min(step.thickLinearDepth, 40.0));
    recordedCells += share * float(step.level + 3 * step.cell.x + 5 * step.cell.y + 7 * step.cellSizeSS.x + 11 * step.cellSizeSS.y + 13 * step.intersectionKind);
}
"""


def size(level): return max(64 >> level, 1), max(48 >> level, 1)


def wall(kind, i, j):
    x, y = i + 0.5, j + 0.5
    return 0.03125 + 0.0078125 * y if kind == 1 else 0.375 - 0.00390625 * x if kind == 2 else 0.125 + 0.001953125 * x + 0.00048828125 * y


def cellDepths(kind, cell, level):
    columns, rows = (span(cell[k], level, size(level)[k], int(kSize[k])) for k in range(2))
    if kind == 5 and columns[0] >= 32:
        return 1e30, 1e30
    corners = [wall(kind, i, j) for i in (columns[0], columns[1] - 1) for j in (rows[0], rows[1] - 1)]
    high, low = max(corners), min(corners)
    if kind in (3, 4):
        box, at = ((28, 12, 36, 34), 0.3125) if kind == 3 else ((20, 8, 52, 40), 0.28125)
        if columns[0] < box[2] and columns[1] > box[0] and rows[0] < box[3] and rows[1] > box[1]:
            high = at
            if columns[0] >= box[0] and columns[1] <= box[2] and rows[0] >= box[1] and rows[1] <= box[3]:
                low = at
    return 1 / high, 1 / low


def plane(kind, cell, level, nearest, favour):
    """Centre, affine depth there, gradient: as the table depth_patch has it."""
    bend = (1 / nearest) / 48
    gradient = []
    for axis in range(2):
        depths = []
        for k in range(-2, 3):
            c = list(cell)
            c[axis] += k
            inside = 0 <= c[axis] < size(level)[axis]
            depths.append(cellDepths(kind, c, level)[0] if inside else 1e30)
        depths[2] = nearest
        gradient.append(slopeOf(False, depths, cell[axis], size(level)[axis], int(kSize[axis]), level, bend, favour[axis]))
    spans = [span(cell[k], level, size(level)[k], int(kSize[k])) for k in range(2)]
    center = [sum(s) / 2 for s in spans]
    return center, 1 / nearest - sum(abs(g) * (s[1] - s[0] - 1) / 2 for g, s in zip(gradient, spans)), gradient


def march(kind, px, py, lift, d, minLevel, maxLevel, most, bias):
    z = cellDepths(kind, (px, py), 0)[0] * (1 + lift)
    ndc = [(px + 0.5) / 32 - 1, 1 - (py + 0.5) / 24]
    origin = fromView([ndc[0] * kSlope[0] * z, ndc[1] * kSlope[1] * z, -z])
    sx, sy, dx, dy, pixelLength, a0, da, endReason, status = flat(screenRay(False, origin, sub(fromView(d), kEye)))
    assert status == 0
    start, delta = [px + 0.5, py + 0.5], [dx, dy]  # the start's centre, as a float has it nearly
    minLevel = min(max(minLevel, 0), 6)
    maxLevel = min(max(maxLevel, minLevel), 6)
    most = min(max(most, 0), 65534)
    bias = min(bias, 1e30) if bias > 0 else 0.0
    depthOf = lambda a: 1 / max(a, 1e-30)

    def pixelsAt(s, pixel, inclusive, axis):
        x = start[axis] + delta[axis] * s
        if abs(x - round(x)) < 1e-3 and not (inclusive is None):
            raise Undecided
        found = int(math.floor(x))
        return max(found, pixel) if delta[axis] > 0 else min(found, pixel)
    s, pixel, level = 0.0, [px, py], minLevel
    inFront, attached, hidden, isStart = True, True, False, True
    total = cells = 0.0
    iterations, used, kindOf = 0, minLevel, 0
    result, endS, endA = None, 0.0, a0
    for k in range(most):
        grid = size(level)
        cell = [min(max(pixel[i] >> level, 0), grid[i] - 1) for i in range(2)]
        spans = [span(cell[i], level, grid[i], int(kSize[i])) for i in range(2)]
        finest = level == minLevel
        border = lambda i, out: ((spans[i][1] if (delta[i] > 0) == out else spans[i][0]) - start[i]) / delta[i]
        enter = min(max(border(0, False), border(1, False), 0.0), 1.0) if finest else s
        leaveX, leaveY = border(0, True), border(1, True)
        leave = max(min(leaveX, leaveY), enter)
        decide(leaveX, leaveY, 1e-6, 1e-5)
        goesOn = decide(leave, 1.0, 1e-5, 1e-6)
        leave = min(leave, 1.0)
        byX = leaveX < leaveY
        following = list(pixel)
        axis = 0 if byX else 1
        following[axis] = spans[axis][1] if delta[axis] > 0 else spans[axis][0] - 1
        following[1 - axis] = pixelsAt(leave, pixel[1 - axis], True, 1 - axis)
        leavesImage = goesOn and not (0 <= following[0] < 64 and 0 <= following[1] < 48)
        nearest, farthest = cellDepths(kind, cell, level)
        ends = [depthOf(a0 + da * x) for x in (enter, leave)]
        rayNear, rayFar = min(ends), max(ends)

        sky = nearest > 0.5e30
        margin = 1 + 1 / 4096 if attached else 1.0
        near = not sky and decide(rayFar * margin, nearest, 2e-6)
        clear = sky or (near and inFront and not isStart)
        deeper = not sky and decide(farthest + bias, rayNear, 2e-6)
        passed = deeper and not inFront and not sky
        skipped = passed or (clear and not (leavesImage and not sky))
        closer = s
        if inFront and da < 0 and not sky:
            closer = min(max((1 / nearest - a0) / da, s), leave)
        if clear:
            closer = leave
        test = [0 if skipped else 1, closer, 0.0, clear or (inFront and not skipped), attached and not skipped, passed and not isStart]
        if finest and not skipped:
            center, at, gradient = plane(kind, cell, level, nearest, delta if isStart else [0, 0])
            ray = a0 + da * enter
            here = at + sum(g * (start[i] + delta[i] * enter - center[i]) for i, g in enumerate(gradient))
            planeRate = dot(gradient, delta)
            rate = da - planeRate
            front, last = ray - here, ray - here + rate * (leave - enter)
            tolerance = abs(at) / 4096
            noise = tolerance if attached else 0.0
            sure = lambda a, b: decide(a, b, 0, 3e-6)
            if not attached and (abs(front) < 3e-6 or abs(last) < 3e-6):
                raise Undecided
            behind, goes = sure(front, -noise), sure(last, -noise)
            sinks = rate < 0
            if abs(rate) * max(leave - enter, pixelLength) < 1e-9:
                raise Undecided
            crosses = goes and not behind
            crossing = enter - front / rate
            length = max(q[1] - q[0] for q in spans) * pixelLength
            crossed = sinks and not decide(length, enter - crossing, 1e-3, 0)
            depth = depthOf(ray) - depthOf(here)
            solid = sinks and not decide(bias, depth, 1e-3, 1e-5)
            meets = behind and inFront and (crossed or solid)
            off = sure(tolerance, front)
            hit = crosses and off and level == 0 if isStart else crosses or meets
            isCrossing = crosses or crossed
            at2 = min(max(crossing, 0.0 if behind else enter), leave) if isCrossing else enter
            hitAffine = here + planeRate * (at2 - enter) if isCrossing else ray
            change = rate * max(leave - enter, pixelLength)
            sinksAtStart = decide(change, -tolerance / 64, 1e-2, 0) if isStart else False
            front2 = not sure(last, -(0.0 if behind else noise))
            front2 = front2 and not (isStart and sinksAtStart and not off)
            close = not sure(tolerance, last) and front2
            test = [2 if hit else 1, at2, hitAffine, front2, attached and close and not (isStart and off), behind and not isStart]
        position = [start[i] + delta[i] * s for i in range(2)]
        share = 1 / (k + 2)
        total += share * (position[0] + 2 * position[1] + 3 * depthOf(a0 + da * s) + 5 * min(nearest, 20) + 7 * min(farthest, 40) + 11 * min(nearest + bias, 40))
        cells += share * (level + 3 * cell[0] + 5 * cell[1] + 7 * (spans[0][1] - spans[0][0]) + 11 * (spans[1][1] - spans[1][0]) + 13 * test[0])
        descends = test[0] == 1 and not finest
        used, iterations, kindOf = max(used, level), k + 1, test[0]
        wasLevel = level
        if descends:
            guess = [pixelsAt(test[1], pixel[i], False, i) for i in range(2)]
            entry = max((guess[i] + (0 if delta[i] > 0 else 1) - start[i]) / delta[i] for i in range(2))
            entry = min(max(entry, 0.0), 1.0)
            pixel = guess if decide(depthOf(a0 + da * entry) * margin, nearest, 2e-6) else pixel
            s, level = test[1], level - 1
        else:
            s, pixel = leave, following
            level = min(level + 1, maxLevel) if test[0] == 0 else level
            hidden = hidden or test[5]
        inFront, attached, isStart = test[3], test[4], isStart and descends
        if test[0] == 2:
            result, endS, endA = 0, test[1], test[2]
            break
        endS, endA = s, a0 + da * s
        if not descends and not goesOn:
            result = endReason
            break
        if not descends and leavesImage:
            result = 2
            break
    if result is None:
        result = 1
    if result in (2, 4) and not inFront or result == 7 and (hidden or not inFront):
        result = 3
    hitClass = 1 if result == 0 else 2 if result == 7 else 3
    return [hitClass, result, start[0] + dx * endS, start[1] + dy * endS, depthOf(endA), iterations, used, kindOf, total, cells]


def make():
    chance = random.Random(11)
    rows = []
    for _ in range(3000):
        kind = chance.randrange(6)
        row = [kind, chance.randrange(2, 62), chance.randrange(2, 46), chance.choice((0, 0, -0.05, -0.3, 0.04)), unit([chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(-1, 1)]),
               chance.choice((0, 0, 0, 1, 2)), chance.choice((0, 3, 6, 9)), chance.choice((200, 200, 200, 6)), chance.choice((0.05, 0.5, 3, 0))]
        numbers = [single(x) for x in flat(row)]
        try:
            march(*[int(x) for x in numbers[:3]], numbers[3], numbers[4:7], *[int(x) for x in numbers[7:10]], numbers[10])
        except (Undecided, AssertionError, ZeroDivisionError):
            continue
        rows.append(row)
    write("hiz", "The march by the depth pyramid visits, passes and hits what its definition says, over surfaces that are formulas.", [
        Function("March", "k:i x:i y:i lift:1 d:3 low:i high:i most:i bias:1",
                 ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.maxUsedLevel)", "float(r.intersectionKind)", "recorded", "recordedCells"],
                 rows[:700], march,
                 "tableKind = k;\nView v = tableView(false, true);\nfloat z = fetchDepthPyramid(ivec2(x, y), 0).x * (1.0 + lift);\nvec3 p = positionWSFromSS(v, vec2(float(x) + 0.5, float(y) + 0.5), z);\n"
                 "vec3 w = (v.worldFromView * vec4(d, 0.0)).xyz;\nTraceResult r = traceHiz(v, p, w, HizSettings(low, high, most, bias));", relative=3e-4, absolute=4e-3),
        Function("NoStart", "p:3 d:3", ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)", "float(r.maxUsedLevel)"], noStarts(),
                 lambda p, d: noStart(p, d) + [0], "TraceResult r = traceHiz(tableView(false, true), p, d, HizSettings(1, 4, 100, 1.0));", relative=2e-5, absolute=1e-4),
    ], [], kViews + copyOf("crossray/project/depth_patch.glsl") + copyOf("crossray/project/hiz.glsl") + kHooks)
