"""The table of project/depth_patch.glsl: the plane of a cell from the depths about it; see tables.py."""
import random
from tables import Function, copyOf, flat, single, write
from tables_linear import Undecided
import tables_linear
from tables_project import agree

# A cross of nine cells; beside it stands what no plane has.
kCross = """
ivec2 tableCells = ivec2(1);
ivec2 tableCell = ivec2(0);
float tableMiddle = 0.0;
vec4 tableLine = vec4(0.0);
vec4 tableColumn = vec4(0.0);
float pick(vec4 line, int step) { return step == -2 ? line.x : step == -1 ? line.y : step == 1 ? line.z : line.w; }
ivec2 depthPyramidSize(int level) { return tableCells; }
vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ivec2 to = cell - tableCell;
    float nearest = to.y == 0 ? pick(tableLine, to.x) : to.x == 0 ? pick(tableColumn, to.y) : 0.001;
    nearest = to == ivec2(0) ? tableMiddle : nearest;
    return vec2(nearest, nearest + 100.0);
}
"""


exact = False  # rows of numbers that a float holds: no comparison is too close


def decide(a, b, share=2e-4, least=1e-6):
    """a < b."""
    return a < b if exact else tables_linear.decide(a, b, share, least)


def atMost(a, b, share): return not decide(b, a, share)


def span(c, level, count, pixels): return (c << level, pixels if c >= count - 1 else (c + 1) << level)


def slopeOf(o, depths, place, count, pixels, level, bend, favour):
    """depths: of the cells -2 to 2; None where it is not in the image."""
    affine = lambda z: -z if o else 1 / z
    spans = {k: span(place + k, level, count, pixels) for k in range(-2, 3)}
    inside = {k: depths[k + 2] if 0 <= place + k < count and depths[k + 2] < 0.5e30 else None for k in range(-2, 3)}

    def step(k):
        """Slope from cell k to cell k + 1; None where one shows nothing."""
        if inside[k] is None or inside[k + 1] is None:
            return None
        rise = affine(inside[k + 1]) - affine(inside[k])
        if not exact and 0 < abs(rise) < 1e-6:
            raise Undecided
        end = 1 if rise > 0 else 0
        return rise / max(spans[k + 1][end] - spans[k][end], 1)

    def same(a, b):
        flatter = min(abs(a), abs(b)) if a * b > 0 else 0
        decide(abs(a - b), max(bend, flatter) * (1 + 1 / 256), 1e-4)
        return agree(a, b, bend)
    farBefore, before, after, farAfter = step(-2), step(-1), step(0), step(1)
    a, b = before or 0.0, after or 0.0
    between = before is not None and after is not None
    difference = abs(b - a)
    if between and (difference < 1e-7 or atMost(difference, bend / 16, 1e-3)):
        return (a + b) / 2
    smooth = between and same(a, b)
    if before is None:
        takeBefore = False
    elif after is None:
        takeBefore = True
    else:
        takeBefore = decide(a * favour, b * favour, 1e-4, 1e-9) if favour != 0 else decide(abs(a), abs(b), 1e-4) if a != b else False
    slope = a if takeBefore else b
    sure = smooth or atMost(abs(slope), 4 * bend, 1e-4) or favour != 0
    if smooth:
        slope = (a + b) / 2
    bendBefore = abs(a - farBefore) if before is not None and farBefore is not None else 1e30
    bendAfter = abs(farAfter - b) if after is not None and farAfter is not None else 1e30
    if between and decide(min(bendBefore, bendAfter), difference / 4, 1e-3):
        return a if atMost(bendBefore, bendAfter, 1e-3) else b
    beyond, knows = (farBefore, bendBefore < 1e30) if takeBefore else (farAfter, bendAfter < 1e30)
    goesOn = knows and same(beyond, slope)
    return slope if sure or goesOn else 0.0


def patch(o, x, y, cx, cy, px, py, level, middle, row, column, fx, fy):
    nearest = -middle if o else 1 / middle
    bend = (1 if o else nearest) / 48
    gradient = [slopeOf(o, [*row[:2], middle, *row[2:]], x, cx, px, level, bend, fx), slopeOf(o, [*column[:2], middle, *column[2:]], y, cy, py, level, bend, fy)]
    sx, sy = span(x, level, cx, px), span(y, level, cy, py)
    center = nearest - (abs(gradient[0]) * (sx[1] - sx[0] - 1) + abs(gradient[1]) * (sy[1] - sy[0] - 1)) / 2
    return [sum(sx) / 2, sum(sy) / 2, center, gradient, center + gradient[0] * 3 - gradient[1] * 2]


def slope(o, count, place, level, axis, middle, line, bend, favour):
    """In whole cells, by numbers that a float holds."""
    global exact
    exact = True
    found = slopeOf(o, [*line[:2], middle, *line[2:]], place, count, count << level, level, bend, favour)
    exact = False
    return [found]


def slopeRows(chance):
    """Steps of a surface in shares of the bend, of which many lie on a border: of a plane, of what is one surface, flat enough or straight."""
    bend = 1 / 32
    sizes = [0, 1 / 16, 1 / 8, 1, 1 + 1 / 256, 2, 2.25, 2.5, 3, 4, 4.25, 4.0625, 8, 8.03125, 12, 16]
    rows, kept = [], []
    while len(rows) < 6000:
        level, count, axis = chance.choice((0, 0, 1)), chance.choice((5, 5, 5, 4, 3, 1)), chance.randrange(2)
        size = lambda: chance.choice(sizes) * chance.choice((1, 1, -1))
        before, after = size(), size()
        after = chance.choice((before, before * 2, before * (2 + 1 / 256), before * (2 + 9 / 2048), before + 1, before + 1 / 16, before + 4, -before, after, after))
        gap = abs(after - before) / 4
        far = [x if chance.random() < 0.1 else x + chance.choice((0, gap, -gap, gap / 2, 1, -1, 1 + 1 / 256)) if chance.random() < 0.6 else chance.choice((x * 2, x / 2, x * (2 + 1 / 256), size(), -x)) for x in (before, after)]
        pixels = bend * (1 << level)
        values = [-8 - (before + far[0]) * pixels, -8 - before * pixels, -8 + after * pixels, -8 + (after + far[1]) * pixels]
        line = [1e30 if chance.random() < 0.06 else -v for v in values]
        place = chance.choice((count // 2, count // 2, count // 2, chance.randrange(count)))
        row = [1, count, place, level, axis, 8.0, line, bend, chance.choice((0, 0, 0, 2, -2, 0.5, -0.5))]
        if all(v == 1e30 or single(v) == v and v > 0 for v in line):
            rows.append(row)
    seen = set()
    for row in rows:  # one row a kind: of how the sides stand to each other and to the bend, and what comes of it
        line, found = row[6], slope(*row)[0]
        steps = [None if 1e30 in (a, b) else (a - b) / bend for a, b in zip([line[0], line[1], 8.0, line[2]], [line[1], 8.0, line[2], line[3]])]
        key = (row[8], row[1] == 5, *[None if x is None or y is None else (abs(x - y) <= 1, abs(x) < abs(y), x * y > 0) for x, y in zip(steps, steps[1:])],
               found == 0, round(found / bend) if abs(found) < bend * 5 else 9)
        if key not in seen and len(kept) < 320:
            seen.add(key)
            kept.append(row)
    return kept


def make():
    chance = random.Random(7)
    rows = []
    while len(rows) < 700:
        o, level = chance.randrange(2), chance.choice((0, 0, 1, 2))
        cx, cy = chance.randrange(3, 9), chance.randrange(3, 8)
        px, py = (cx << level) + chance.randrange(1 << level), (cy << level) + chance.randrange(1 << level)
        x, y = chance.randrange(cx), chance.randrange(cy)
        middle = chance.choice((2.0, 4.0))
        nearest = -middle if o else 1 / middle
        bend = (1 if o else nearest) / 48
        lines = []
        for _ in range(2):
            size = lambda: chance.choice((0, 0.2, 0.9, 1.2, 1.9, 3, 3.8, 4.3, 6, 12)) * chance.choice((-1, 1)) * bend
            before, after = size(), size()
            after = before * chance.choice((1, 1.02, 1.5, 1.9, 2.2)) if chance.random() < 0.3 else after
            farBefore = before * chance.choice((1, 1.03, 1.4, 2.5)) if chance.random() < 0.6 else size()
            farAfter = after * chance.choice((1, 1.03, 1.4, 2.5)) if chance.random() < 0.6 else size()
            pixels = 1 << level
            values = [nearest - (before + farBefore) * pixels, nearest - before * pixels, nearest + after * pixels, nearest + (after + farAfter) * pixels]
            line = [(-v if o else 1 / v) if (v < -0.01 if o else v > 0.01) else 1e30 for v in values]
            lines.append([1e30 if chance.random() < 0.08 else v for v in line])
        favour = [chance.choice((0, 0, 0, 5, -3)) for _ in range(2)]
        row = [o, x, y, cx, cy, px, py, level, middle, *lines, *favour]
        numbers = [single(v) for v in flat(row)]
        try:
            patch(*[int(v) for v in numbers[:8]], numbers[8], numbers[9:13], numbers[13:17], *numbers[17:])
        except Undecided:
            continue
        rows.append(row)
    write("depth_patch", "A cell's plane has the slopes of the sides that are its surface's own, and 0 where none is.", [
        Function("Patch", "o:b x:i y:i cx:i cy:i px:i py:i level:i middle:1 line:4 column:4 fx:1 fy:1",
                 ["p.centerSS.x", "p.centerSS.y", "p.affineDepth", "p.gradient.x", "p.gradient.y", "patchAffineDepth(p, p.centerSS + vec2(3.0, -2.0))"], rows, patch,
                 "tableCells = ivec2(cx, cy);\ntableCell = ivec2(x, y);\ntableMiddle = middle;\ntableLine = line;\ntableColumn = column;\n"
                 "DepthPatch p = fitDepthPatch(ScreenFrame(ivec2(px, py), 1.0 / 48.0, o), ivec2(x, y), level, middle, vec2(fx, fy));", relative=2e-4, absolute=2e-6),
        Function("Slope", "o:b n:i place:i level:i axis:i middle:1 line:4 bend:1 favour:1", ["s"], slopeRows(chance), slope,
                 "tableCells = ivec2(n);\ntableCell = axis == 0 ? ivec2(place, 0) : ivec2(0, place);\ntableMiddle = middle;\ntableLine = axis == 0 ? line : vec4(0.001);\n"
                 "tableColumn = axis == 0 ? vec4(0.001) : line;\n"
                 "float s = fitSlope(ScreenFrame(ivec2(n << level), 0.03125, o), tableCell, axis, level, middle, bend, favour);", absolute=0, relative=0),
    ], [], copyOf("crossray/project/depth_patch.glsl") + kCross)
