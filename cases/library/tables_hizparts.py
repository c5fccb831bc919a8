"""The table of the parts of project/hiz.glsl, each by itself: exact borders and ties that a whole march never meets; see tables.py."""
import math
import random
from tables import Function, copyOf, dot, flat, kInf, kNaN, single, write
from tables_linear import Undecided
from tables_patch import slopeOf, span
from tables_project import pixelAt

# A pyramid over one plane, bent along x where it says so: in orthographic views linear depth is affine too, and every number of a row can be exact.
kHooks = """
ivec2 tableImage = ivec2(32, 24);
int tableLevels = 6;
bool tableOrtho = false;
vec4 tablePlane = vec4(0.0); // affine depth at the image's corner, its change a pixel, and the bend
ivec2 depthPyramidSize(int level) { return max(ivec2(tableImage.x >> level, tableImage.y >> level), ivec2(1)); }
int depthPyramidLevelCount() { return tableLevels; }
float planeAffine(vec2 center) { return tablePlane.x + dot(tablePlane.yz, center) + tablePlane.w * center.x * center.x; }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 cells = depthPyramidSize(level);
    vec2 begin = vec2(cell.x << level, cell.y << level) + vec2(0.5);
    vec2 end = vec2(cell.x == cells.x - 1 ? tableImage.x : (cell.x + 1) << level, cell.y == cells.y - 1 ? tableImage.y : (cell.y + 1) << level) - vec2(0.5);
    float a = planeAffine(begin), b = planeAffine(end), c = planeAffine(vec2(begin.x, end.y)), d = planeAffine(vec2(end.x, begin.y));
    float high = max(max(a, b), max(c, d));
    float low = min(min(a, b), min(c, d));
    return tableOrtho ? -vec2(high, low) : 1.0 / vec2(high, low);
}
void recordHizStep(HizStep step) {}
ScreenFrame tableFrame() { return ScreenFrame(tableImage, 0.03125, tableOrtho); }
float runs(int pixel) { return float(clamp(pixel, -4, 999)); } // pixels so far away that a float says it all
"""
kImage = [32, 24]
kSky = single(1e30)
kCell, kHit = 1, 2
# How a row is judged: "margin" refuses what rounding may turn, "exact" what a float does not hold, "plain" nothing.
mode = "plain"
decisions = []  # of the last row: how each comparison went, and whether it was a tie


def less(a, b, least=0.0):
    if mode == "margin" and abs(a - b) <= 1e-4 * max(abs(a), abs(b)) + least:
        raise Undecided
    decisions.append((a < b, a == b))
    return a < b


def num(x):
    if mode == "exact" and single(x) != x:
        raise Undecided
    return x


def affineOf(o, z): return num(-z if o else 1 / max(z, 1e-30))
def depthOf(o, a): return num(-a if o else 1 / max(a, 1e-30))
def size(level, image): return [max(n >> level, 1) for n in image]


def cellDepths(o, q, cell, level, image):
    at = lambda x, y: q[0] + q[1] * x + q[2] * y + q[3] * x * x
    (bx, ex), (by, ey) = (span(cell[k], level, size(level, image)[k], image[k]) for k in range(2))
    corners = [at(x, y) for x in (bx + 0.5, ex - 0.5) for y in (by + 0.5, ey - 0.5)]
    return depthOf(o, max(corners)), depthOf(o, min(corners))


def fit(o, q, cell, level, near, favour):
    """Centre, affine depth there, gradient."""
    nearest = affineOf(o, near)
    bend = (1 if o else nearest) / 32
    gradient = []
    for axis in range(2):
        depths = [cellDepths(o, q, [cell[0] + (k if axis == 0 else 0), cell[1] + (k if axis == 1 else 0)], level, kImage)[0] for k in range(-2, 3)]
        depths[2] = near
        gradient.append(num(slopeOf(o, depths, cell[axis], size(level, kImage)[axis], kImage[axis], level, bend, favour[axis])))
    side = 1 << level
    return [(c + 0.5) * side for c in cell], num(nearest - sum(abs(g) for g in gradient) * (side - 1) / 2), gradient


def borderTime(a, d, border): return num((border - a) / d)


def entry(a, d, begin, end): return min(max(max(borderTime(a[k], d[k], begin[k] if d[k] > 0 else end[k]) for k in range(2)), 0.0), 1.0)


def testPlane(o, q, cell, wide, tall, level, near, a, d, pixelLength, a0, da, inFront, attached, isStart, enter, leave, bias):
    center, middle, g = fit(o, q, cell, level, near, d if isStart else [0, 0])
    ray, onPlane = num(a0 + da * enter), num(middle + sum(g[k] * (a[k] + d[k] * enter - center[k]) for k in range(2)))
    planeRate = num(dot(g, d))
    rate = num(da - planeRate)
    first = num(ray - onPlane)
    last = num(first + rate * (leave - enter))
    rough = 1e-5 * abs(middle)
    tolerance = abs(middle) / 4096
    noise = tolerance if attached else 0.0
    behind, goesBehind = less(first, -noise, rough), less(last, -noise, rough)
    sinks = less(rate, 0, rough)
    crosses = goesBehind and not behind
    # It came in behind: by a crossing at most a cell before, or into what the bias makes solid.
    crossing = num(enter - first / rate) if rate != 0 else enter
    crossed = sinks and not less(max(wide, tall) * pixelLength, enter - crossing, 1e-5)
    solid = sinks and not less(bias, depthOf(o, ray) - depthOf(o, onPlane), 1e-4)
    off = less(tolerance, first, rough)
    hit = crosses and off and level == 0 if isStart else crosses or behind and inFront and (crossed or solid)
    s, affine = enter, ray
    if crosses or crossed:
        if mode == "margin" and 1e-6 * abs(middle) > 1e-5 * abs(rate):
            raise Undecided
        s = min(max(crossing, 0.0 if behind else enter), leave)
        affine = num(onPlane + planeRate * (s - enter))
    # On the start's plane, not well in front of it: behind as soon as the ray sinks by more than a rounding, over a pixel at least.
    decisions.append((leave - enter > pixelLength, wide > tall))
    sunk = isStart and not off and less(num(rate * max(leave - enter, pixelLength)), -tolerance / 64, 1e-7 * abs(middle))
    frontAfter = not less(last, 0.0 if behind else -noise, rough) and not sunk
    close = frontAfter and not less(tolerance, last, rough)
    return [kHit if hit else kCell, s, affine, frontAfter, attached and close and not (isStart and off), behind and not isStart]


def testCell(o, q, cell, level, near, far, rayNear, rayFar, leavesImage, minLevel, a, d, pixelLength, a0, da, inFront, attached, isStart, s, enter, leave, bias):
    sky = not near < kSky / 2
    nearer = less(num(rayFar * (1 + 1 / 4096 if attached else 1)), near)
    clear = sky or nearer and inFront and not isStart
    passed = less(num(far + bias), rayNear) and not inFront and not sky
    skipped = passed or clear and not (leavesImage and not sky)
    if level == minLevel and not skipped:
        return testPlane(o, q, cell, 1 << level, 1 << level, level, near, a, d, pixelLength, a0, da, inFront, attached, isStart, enter, leave, bias)
    closer = s
    if clear:
        closer = leave
    elif inFront and da < 0:
        closer = min(max(num((affineOf(o, near) - a0) / da), s), leave)
    return [0 if skipped else kCell, closer, 0.0, clear or inFront and not skipped, attached and not skipped, passed and not isStart]


def closerPixel(o, near, a, d, a0, da, pixel, attached, s):
    guess = [pixelAt(a[k], d[k], pixel[k], s, False) for k in range(2)]
    at = entry(a, d, guess, [x + 1 for x in guess])
    depth = depthOf(o, num(a0 + da * at))
    return guess if less(num(depth * (1 + 1 / 4096 if attached else 1)), near) else pixel


def enterCell(o, image, a, d, a0, da, s, pixel, level, isFinest):
    grid = size(level, image)
    cell = [min(max(pixel[k] >> level, 0), grid[k] - 1) for k in range(2)]
    spans = [span(cell[k], level, grid[k], image[k]) for k in range(2)]
    begin, end = [x[0] for x in spans], [x[1] for x in spans]
    leaves = [borderTime(a[k], d[k], begin[k] if d[k] < 0 else end[k]) for k in range(2)]
    byX = not less(leaves[1], leaves[0], 1e-5)
    enter = entry(a, d, begin, end) if isFinest else s
    leave = max(min(leaves), enter)
    goesOn = less(leave, 1, 1e-5)
    leave = min(leave, 1.0)
    beyond = [begin[k] - 1 if d[k] < 0 else end[k] for k in range(2)]
    # By both at once: in x first.
    following = [beyond[0], pixelAt(a[1], d[1], pixel[1], leave, False)] if byX else [pixelAt(a[0], d[0], pixel[0], leave, True), beyond[1]]
    inside = all(0 <= following[k] < image[k] for k in range(2))
    depths = [depthOf(o, num(a0 + da * x)) for x in (enter, leave)]
    near, far = cellDepths(o, [-8.0 if o else 0.125, 0.0078125, -0.00390625, 0.0], cell, level, image)
    return [*cell, *begin, *end, near, far, enter, leave, *following, goesOn and not inside, not goesOn, min(depths), max(depths)]


def step(kind, s, hit, level, minLevel, maxLevel, attached, wasHidden, isStart, testS, inFront, hidden, closer):
    """closer: the pixel there is (9, 7), else (4, 5) where the ray is."""
    descends = kind != 0 and level > minLevel
    pixel = ([9, 7] if closer else [4, 5]) if descends else [12, 13]
    after = min(level + 1, maxLevel) if kind == 0 else level
    return [testS if descends else 0.75, *pixel, level - 1 if descends else after, inFront, attached, wasHidden or hidden and not descends, isStart and descends]


def rounded(row): return [rounded(x) if isinstance(x, list) else single(x) if isinstance(x, float) else x for x in row]


def keep(how, rows, model, most, alike=1):
    """Of the rows that the model can decide the first `alike` of each sequence of decisions, `most` in all."""
    global mode
    kept, seen = [], {}
    for row in rows:
        mode = how
        decisions.clear()
        try:
            numbers = flat(row)
            if how == "exact" and any(single(x) != x for x in numbers):
                continue
            model(*row)
        except (Undecided, ZeroDivisionError):
            continue
        finally:
            mode = "plain"
        flags = [x for x in row if x in (0, 1) and not isinstance(x, float)]
        kind = (tuple(decisions), tuple(flags))
        seen[kind] = seen.get(kind, 0) + 1
        if seen[kind] > alike:
            continue
        kept.append(row)
        if len(kept) == most:
            break
    return kept


def planeRows(chance):
    """Before and behind the plane by shares of the tolerance with which a start lies on it."""
    def row(o, level, sides, q, e, l, enter, leave, start, delta, pixelLength, flags, bias):
        cell = [min(max(int(start[k]) >> level, 2), (kImage[k] >> level) - 3) for k in range(2)]
        near = cellDepths(o, q, cell, level, kImage)[0]
        center, middle, g = fit(o, q, cell, level, near, delta if flags[2] else [0, 0])
        tolerance = abs(middle) / 4096
        e, l = (x[1] if isinstance(x, tuple) else x * tolerance for x in (e, l))
        rate = (l - e) / (leave - enter)
        onPlane = middle + sum(g[k] * (start[k] + delta[k] * enter - center[k]) for k in range(2))
        da = rate + dot(g, delta)
        return [o, q, cell, *sides, level, near, start, delta, pixelLength, onPlane + e - da * enter, da, *flags, enter, leave, bias]
    gaps = [0, 0.5, -0.5, 1, -1, 2, -2, (0, 0.125), (0, -0.125), (0, 0.25), (0, -0.25), (0, -0.5), (0, 0.5), -1 / 64, 1 / 64, -1 / 32, -1 / 128, -9 / 512, 129 / 128]
    flags = [[i, j, k] for i in (1, 0) for j in (1, 0) for k in (0, 1)]
    # Come in behind, of which the bias makes some solid; by a crossing before the cell, of which some is too long ago.
    rows = [(1, 0, sides, [-8.0, 0, 0, 0], (0, -0.125), (0, l), 0.25, leave, [12.5, 8.5], [8.0, 2.0], pixel, [1, 0, 0], bias)
            for sides in ([1, 2], [2, 1], [1, 1]) for l, leave in ((-0.25, 0.375), (-0.1875, 0.3125)) for pixel in (0.0625, 0.03125, 0.125) for bias in (0.0, 0.0625, 0.125, 0.25)]
    # Sinks from the tolerance's border through it so flatly that the crossing lies far back.
    rows += [(1, 0, [1, 1], [-8.0, 0, 0, 0], e, -2, 0.25, 0.375, [12.5, 8.5], [8.0, 2.0], 0.0625, [1, 1, k], 0.0) for e in (-1, 0) for k in (0, 1)]
    # From the start's plane so flatly that only the length decides whether the ray sinks: in the cell, or over a pixel; and from just off it, so that it does not stand there.
    rows += [(1, 0, [1, 1], [-8.0, 0, 0, 0], 0, -1 / 128, 0.25, 0.375, [12.5, 8.5], [8.0, 2.0], pixel, [1, 1, 1], 0.0) for pixel in (0.0625, 0.5)]
    rows += [(1, 0, [1, 1], [-8.0, 0, 0, 0], 129 / 128, 1, 0.25, 0.375, [12.5, 8.5], [8.0, 2.0], 0.0625, [1, 1, k], 0.0) for k in (0, 1)]
    while len(rows) < 40000:
        level = chance.choice((0, 0, 1))
        sides = chance.choice(([1 << level] * 2, [1 << level] * 2, [2, 1], [1, 2]))
        e, l = chance.choice(gaps), chance.choice(gaps)
        enter, leave = chance.choice(((0.0, 0.0625), (0.25, 0.375), (0.5, 0.75), (0.125, 0.25)))
        q = chance.choice(([-8.0, 0, 0, 0], [-8.0, 0, 0, 0], [-8.0, 0.03125, 0, 0], [-8.0, 0, -0.0625, 0]))
        pixel = chance.choice((0.0625, 0.125, 0.25, 0.5))
        rows.append((1, level, sides, q, e, l, enter, leave, [12.5, 8.5], [chance.choice((8.0, -4.0)), chance.choice((2.0, -8.0))], pixel, chance.choice(flags), chance.choice((0.0, 0.125, 0.25, 0.5))))

    def exact():
        for r in rows:
            try:
                yield row(*r)
            except Undecided:
                continue
    free = []
    while len(free) < 1500:
        o, level = chance.randrange(2), chance.choice((0, 0, 1, 2))
        q = [-8.0 if o else 0.25, *[chance.uniform(-1, 1) * (0.05 if o else 0.004) for _ in range(2)], 0.0]
        if level == 0 and chance.random() < 0.3:
            q[3] = chance.choice((-1, 1)) * (0.15 if o else 0.0045)
            q[1] = -q[3] * 2 * 12.5 + chance.uniform(-1, 1) * q[3]
        gap = lambda: chance.choice((0, 0.3, 0.7, 1.6, 5, 50, 400)) * chance.choice((-1, 1))
        enter = chance.choice((0, 0.2, 0.6))
        try:
            free.append(row(o, level, [1 << level] * 2, q, gap(), gap(), enter, enter + chance.choice((0.03, 0.1, 0.3)), [12 + chance.uniform(0.2, 0.8), 8 + chance.uniform(0.2, 0.8)],
                            [chance.uniform(-12, 12), chance.uniform(-9, 9)], chance.choice((0.05, 0.11, 0.23)), chance.choice(flags), chance.choice((0.0, 0.01, 0.2, 3.0))))
        except Undecided:
            continue
    return keep("exact", exact(), testPlane, 304) + keep("margin", map(rounded, free), testPlane, 200)


def cellRows(chance):
    """Depths of cell and ray that touch, and touch but for the tolerance or the bias."""
    rows = []
    while len(rows) < 30000:
        near = chance.choice((8.0, 8.0, 8.001953125, 9.0, kSky, kSky / 2, 16.0))
        far = near if near > 1e29 else chance.choice((near, near + 0.5, near + 2, kSky))
        bias = chance.choice((0.0, 0.5))
        rayNear = chance.choice((far, far + bias, far + 0.25, far + 1, 8.0, 4.0)) if far < 1e29 else chance.choice((8.0, 4.0, kSky))
        rayFar = max(rayNear, chance.choice((8.0, 7.0, 8.001953125, 16.0, 12.0)))
        minLevel = chance.choice((0, 0, 1, 2))
        level = chance.choice((minLevel, minLevel + 1))
        a0, da = chance.choice(((-4.0, -8.0), (-16.0, 16.0), (-7.0, -4.0), (-8.0, 0.0), (-9.0, -2.0), (-9.0, 0.5), (-4.0, -16.0)))
        s = chance.choice((0.125, 0.25, 0.375))
        leave = s + chance.choice((0.125, 0.25, 0.5))
        cell = [12 >> level, 8 >> level]
        rows.append([1, [-8.0, 0.0, 0.0, 0.0], cell, level, near, far, rayNear, rayFar, chance.randrange(2), minLevel, [12.5, 8.5], [4.0, -2.0], 0.25, a0, da, *[chance.randrange(2) for _ in range(3)],
                     s, s - 0.0625, leave, bias])
    for front, start in ((1, 0), (0, 0), (1, 1)):
        for near, attached in ((9.0, 1), (9.0, 0), (8.0, 1), (8.001953125, 1), (8.001953125, 0)):  # a tolerance nearer, and much
            rows.insert(0, [1, [-8.0, 0.0, 0.0, 0.0], [6, 4], 1, near, near, 4.0, 8.0, 0, 0, [12.5, 8.5], [4.0, -2.0], 0.25, -4.0, -8.0, front, attached, start, 0.25, 0.1875, 0.5, 0.0])
        # Sky hides nothing, not even a ray as deep as it is.
        rows.insert(0, [1, [-8.0, 0.0, 0.0, 0.0], [6, 4], 1, kSky / 2, kSky / 2, kSky, kSky, 0, 0, [12.5, 8.5], [4.0, -2.0], 0.25, -4.0, -8.0, front, 0, start, 0.25, 0.1875, 0.5, 0.0])
    usable = [r for r in rows if r[4] == 8.0 or not (r[3] == r[9])]  # a tested cell has the plane's own depth
    return keep("exact", usable, testCell, 306)


def enterRows(chance):
    """Rays that leave by one border, by a corner, exactly at their end, or out of the image, over images whose sizes are no powers of two."""
    rows = []
    while len(rows) < 4000:
        image = chance.choice(([32, 24], [11, 7], [13, 6]))
        o, level = chance.randrange(2), chance.choice((0, 0, 1, 1, 2))
        a = [chance.randrange(4 * n) / 4 for n in image]
        d = [chance.choice((-1, 1)) * chance.choice((1, 2, 4, 8, 16, 32, 1, 0.5)) for _ in range(2)]
        d = [x * 2.0 ** -67 if chance.random() < 0.06 else x for x in d]
        s = chance.choice((0, 0, 0.125, 0.25, 0.5))
        at = chance.choice((s, s, s, s, 0, 1.5))  # the pixel may lag behind, or lie beyond the end
        pixel = [pixelAt(a[k], d[k], int(math.floor(a[k])), at, k == 0) for k in range(2)]
        if not all(0 <= pixel[k] < image[k] for k in range(2)) or any(a[k] == int(a[k]) and d[k] < 0 for k in range(2)):
            continue
        a0, da = chance.choice(((-8.0, 4.0), (-6.0, -2.0))) if o else chance.choice(((0.25, 0.25), (0.5, -0.25)))
        rows.append([o, image, a, d, a0, da, s, pixel, level, chance.randrange(2)])
    return keep("margin", [r for r in rows if r[1] != kImage], enterCell, 60, 3) + keep("exact", [r for r in rows if r[0] == 1], enterCell, 140, 3)


def closerRows(chance):
    # A ray of one depth, by just the tolerance of the start nearer than the cell.
    rows = [[1, 8.001953125, [2.5, 2.5], [8, 4], -8.0, 0.0, [2, 2], attached, 0.25] for attached in (0, 1)]
    while len(rows) < 2000:
        a = [chance.randrange(8, 60) / 4 + 0.25 for _ in range(2)]
        d = [chance.choice((-1, 1)) * chance.choice((1, 2, 4, 8, 16)) for _ in range(2)]
        pixel = [int(math.floor(x)) for x in a]
        if any(x == int(x) for x in a):
            continue
        s = chance.choice((0, 0.0625, 0.125, 0.1875, 0.25, 0.3125, 0.375, 0.5))
        rows.append([1, chance.choice((8.0, 8.001953125, 10.0, 7.0)), a, d, -8.0, chance.choice((0.0, 0.0, 4.0, -4.0)), pixel, chance.randrange(2), s])
    perspective = [[0, 1 / (0.25 + 0.125 * chance.uniform(0, 0.5)), *r[2:4], 0.25, 0.125, *r[6:]] for r in rows[:200]]
    return keep("exact", rows, closerPixel, 102, 8) + keep("margin", map(rounded, perspective), closerPixel, 40, 8)


def traces():
    """Whole marches before a wall at 8 m, a metre a pixel, from starts that no pixel's centre is: place, depth, direction over the screen and in depth, settings; class, reason, end."""
    return [
        # From the lowest border at a column's: the march leaves the first pixel at once, and is still in the image.
        ([12, 24], 5, [-1, -0.25, 2], [0, 0, 99, 0], [1, 0, 10.5, 23.625, 8, 3, 0, 2]),
        # From the last column, and the last row.
        ([31.5, 12.5], 5.5, [-1, -0.25, 2], [0, 0, 99, 0], [1, 0, 30.25, 12.1875, 8, 2, 0, 2]),
        ([12.5, 23.5], 5.5, [-0.25, -1, 2], [0, 0, 99, 0], [1, 0, 12.1875, 22.25, 8, 2, 0, 2]),
        # On the right border, out of the image.
        ([32, 8.5], 5, [1, 0.25, -1], [0, 0, 99, 0], [3, 2, 32, 8.5, 5, 1, 0, 1]),
        # Along the wall, behind it by half of what a start may be: over 25 pixels in sight to the border.
        ([12.5, 8.5], 8 + 2 ** -10, [1, 0.25, 0], [0, 0, 99, 0], [3, 2, 32, 13.375, 8 + 2 ** -10, 25, 0, 1]),
        # Behind it by twice that: hidden.
        ([12.5, 8.5], 8 + 2 ** -8, [1, 0.25, 0], [0, 0, 99, 0], [3, 3, 32, 13.375, 8 + 2 ** -8, 25, 0, 0]),
        # No step at all: unknown, and at the level on which it would begin.
        ([12.5, 8.5], 5, [1, 0.25, 1], [2, 3, 0, 0], [3, 1, 12.5, 8.5, 5, 0, 2, 0]),
    ]


def make():
    chance = random.Random(31)
    ray = "ScreenRay ray = ScreenRay(a, d, pixel, a0, da, 0, 0);\n"
    outTest = ["float(t.kind)", "t.s", "t.affineDepth", "number(t.inFront)", "number(t.attached)", "number(t.isHidden)"]
    state = "HizState state = HizState({}, ivec2(0), level, front, attached, false, start);\n"
    cell = "ivec2 begin = ivec2(cx << level, cy << level);\nHizCell c = HizCell(ivec2(cx, cy), begin, begin + {}, vec2(near, {}), enter, leave, ivec2(0), {}, false, {});\n"
    bodyPlane = "tableOrtho = o;\ntablePlane = q;\n" + ray + state.format("0.25") + cell.format("ivec2(wide, tall)", "near", "false", "0.0, 0.0") + "HizTest t = testHizPlane(tableFrame(), ray, state, c, bias);"
    bodyCell = "tableOrtho = o;\ntablePlane = q;\n" + ray + state.format("s") + cell.format("ivec2(1 << level)", "far", "leaves", "rayNear, rayFar") + \
        "HizTest t = testHizCell(tableFrame(), ray, state, c, HizSettings(low, 5, 9, bias));"
    bodyEnter = "tableOrtho = o;\ntableImage = ivec2(ix, iy);\ntablePlane = vec4(o ? -8.0 : 0.125, 0.0078125, -0.00390625, 0.0);\nfloat pixel = 0.125;\n" + ray + \
        "HizCell c = enterHizCell(tableFrame(), ray, HizState(s, ivec2(px, py), level, true, true, false, false), finest);"
    bodyCloser = "tableOrtho = o;\nfloat pixel = 0.125;\n" + ray + "HizCell c = HizCell(ivec2(0), ivec2(0), ivec2(0), vec2(near, near + 4.0), 0.0, 1.0, ivec2(0), false, false, 0.0, 0.0);\n" \
        "ivec2 p = computeHizCloserPixel(tableFrame(), ray, HizState(0.0, ivec2(px, py), 1, true, attached, false, false), c, s);"
    # The ray runs right and down by a pixel a sixteenth, at depth 8: it is nearer than what lies at 9, and not than what lies at 7.
    bodyStep = "ScreenRay ray = ScreenRay(vec2(4.5, 5.5), vec2(16.0, 8.0), 0.0625, -8.0, 0.0, 0, 0);\ntableOrtho = true;\n" \
        "HizCell c = HizCell(ivec2(0), ivec2(0), ivec2(0), vec2(near), 0.0, 0.75, ivec2(12, 13), false, false, 0.0, 0.0);\n" \
        "HizState n = stepHiz(tableFrame(), ray, HizState(s, ivec2(4, 5), level, front, true, hid, start), c, HizTest(kind, to, 0.0, inFront, attached, hidden), HizSettings(low, high, 9, 1.0));"
    bodyTrace = "mat4 one = mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 0.0), vec4(0.0, 0.0, 0.0, 1.0));\n" \
        "View v = View(one, one, one, vec2(tableImage), vec2(16.0, 12.0), 0.0, 1.0, 0.5, 64.0, true, false);\ntableOrtho = true;\ntablePlane = vec4(-8.0, 0.0, 0.0, 0.0);\n" \
        "TraceResult r = traceHiz(v, vec3(a.x - 16.0, 12.0 - a.y, -z), vec3(d.x, -d.y, -d.z), HizSettings(low, high, most, bias));"
    steps = [[kind, 0.125, near, level, low, high, front, hid, start, attached, 0.3125, 1 - front if kind else front, hidden]
             for kind, near, level, low, high in ((0, 9, 1, 0, 4), (0, 9, 4, 0, 4), (0, 9, 0, 0, 0), (1, 9, 1, 0, 4), (1, 7, 2, 0, 4), (1, 9, 1, 1, 4), (1, 9, 0, 0, 4), (2, 9, 0, 0, 3), (0, 9, 2, 2, 3))
             for front, hid, start, attached, hidden in ((1, 0, 1, 1, 0), (0, 0, 0, 0, 1), (0, 1, 1, 0, 0), (1, 1, 0, 1, 1))]
    sanitized = [[n, low, high, most, bias] for n, low, high in ((6, 0, 5), (6, -1, 9), (6, 2, 1), (6, 9, 9), (6, 3, -2), (1, 1, 1), (0, 2, 3), (2, 1, 1)) for most, bias in ((5, 0.5), (-3, 0), (0, -1), (70000, 1e35))]
    sanitized += [[6, 0, 5, most, bias] for most, bias in ((65534, kNaN), (65535, kInf), (1, 1e-20), (65533, 1e29))]

    def sanitize(n, low, high, most, bias):
        last = max(n, 1) - 1
        low = min(max(low, 0), last)
        return [low, min(max(high, low), last), min(max(most, 0), 65534), min(bias, 1e30) if bias > 0 else 0]
    write("hiz_parts", "Each part of the march by the depth pyramid is right at exact borders, corners and ties.", [
        Function("Plane", "o:b q:4 cx:i cy:i wide:i tall:i level:i near:1 a:2 d:2 pixel:1 a0:1 da:1 front:b attached:b start:b enter:1 leave:1 bias:1", outTest, planeRows(chance),
                 lambda o, q, cx, cy, *more: testPlane(o, q, [cx, cy], *more), bodyPlane, relative=1e-4, absolute=2e-5),
        Function("Cell", "o:b q:4 cx:i cy:i level:i near:1 far:1 rayNear:1 rayFar:1 leaves:b low:i a:2 d:2 pixel:1 a0:1 da:1 front:b attached:b start:b s:1 enter:1 leave:1 bias:1", outTest,
                 cellRows(chance), lambda o, q, cx, cy, *more: testCell(o, q, [cx, cy], *more), bodyCell),
        Function("Enter", "o:b ix:i iy:i a:2 d:2 a0:1 da:1 s:1 px:i py:i level:i finest:b",
                 [f"float(c.{v})" for v in ("cell.x", "cell.y", "begin.x", "begin.y", "end.x", "end.y")] + ["c.depths.x", "c.depths.y", "c.enter", "c.leave"] +
                 [f"runs(c.leavePixel.{k})" for k in "xy"] + ["number(c.leavesImage)", "number(c.isLast)", "c.rayNearest", "c.rayFarthest"], enterRows(chance),
                 lambda o, ix, iy, a, d, a0, da, s, px, py, level, finest: enterCell(o, [ix, iy], a, d, a0, da, s, [px, py], level, finest), bodyEnter),
        Function("Closer", "o:b near:1 a:2 d:2 a0:1 da:1 px:i py:i attached:b s:1", ["float(p.x)", "float(p.y)"], closerRows(chance),
                 lambda o, near, a, d, a0, da, px, py, attached, s: closerPixel(o, near, a, d, a0, da, [px, py], attached, s), bodyCloser, absolute=0),
        Function("Step", "kind:i s:1 near:1 level:i low:i high:i front:b hid:b start:b attached:b to:1 inFront:b hidden:b",
                 ["n.s", "float(n.pixel.x)", "float(n.pixel.y)", "float(n.level)", "number(n.inFront)", "number(n.attached)", "number(n.wasHidden)", "number(n.isStart)"], steps,
                 lambda kind, s, near, level, low, high, front, hid, start, attached, to, inFront, hidden: step(kind, s, 0, level, low, high, attached, hid, start, to, inFront, hidden, near > 8), bodyStep),
        Function("Sanitize", "n:i low:i high:i most:i bias:1", ["float(t.minLevel)", "float(t.maxLevel)", "float(t.maxIterations)", "t.depthBias"], sanitized, sanitize,
                 "tableLevels = n;\nHizSettings t = sanitizeHizSettings(HizSettings(low, high, most, bias));", absolute=0),
        Function("Trace", "a:2 z:1 d:3 low:i high:i most:i bias:1", ["float(r.hitClass)", "float(r.reason)", "r.positionSS.x", "r.positionSS.y", "r.linearDepth", "float(r.iterations)",
                 "float(r.maxUsedLevel)", "float(r.intersectionKind)"], [row[:4] for row in traces()], lambda a, z, d, *more: next(row[4] for row in traces() if [*row[0], row[1], *row[2], *row[3]] == [*a, z, *d, *more]),
                 bodyTrace, absolute=1e-4, relative=1e-5),
    ], [], copyOf("crossray/project/depth_patch.glsl") + copyOf("crossray/project/hiz.glsl") + kHooks)
