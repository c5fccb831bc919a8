"""The table of how project/patch_tracer.glsl goes from cell to cell, function by function, the ray and the cell given by the row; see tables.py.

Where a row is an exact border, its numbers are sums of powers of two, which no backend rounds.
"""
import math
from tables import Function, copyOf, write
from tables_core import kViews
from tables_patch import span

# One plane all over, but three pixels (or cells), and a ray and its lifted copy that differ by what the row says.
kHooks = """
vec3 tablePlane = vec3(0.125, 0.0, 0.0); // affine depth at the corner of the image, and its change a pixel
float tableSlack = 0.0;
ivec2 spotA = ivec2(-9);
ivec2 spotB = ivec2(-9);
ivec2 spotC = ivec2(-9);
vec4 cellA = vec4(0.0);
vec4 cellB = vec4(0.0);
vec4 cellC = vec4(0.0);
ivec2 surfacePyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int surfacePyramidLevelCount() { return 7; }
void recordPatchStep(PatchStep step) {}

vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    vec2 center = (vec2(cell) + vec2(0.5)) * float(1 << level);
    vec4 found = vec4(tablePlane.x + dot(tablePlane.yz, center), tablePlane.yz, level == 0 ? tableSlack : 0.0009765625 * float(level));
    found = cell == spotC ? cellC : found;
    found = cell == spotB ? cellB : found;
    return cell == spotA ? cellA : found;
}

ivec2 whole(vec2 v) { return ivec2(int(v.x), int(v.y)); }
ScreenRay tableRay(vec2 start, vec2 delta, vec2 affine) { return ScreenRay(start, delta, 0.0, affine.x, affine.y, 7, 0); }

PatchWalk tableWalk(vec2 start, vec2 delta, vec4 affine, vec2 startPixel, bool stands, float error)
{
    return PatchWalk(tableRay(start, delta, affine.xy), tableRay(start, delta, affine.zw), whole(startPixel), stands, error);
}

CellRect tableRect(vec4 r) { return CellRect(whole(r.xy), whole(r.zw)); }
PatchCell tableCell(vec4 r, vec4 surface, vec2 s, vec2 front, bool byX)
{
    return PatchCell(whole(r.xy), tableRect(r), unpackSurfaceCell(surface), s.x, s.y, front.x, front.y, byX, false);
}
"""
kNever = 1e30


def at(start, delta, s): return [start[k] + delta[k] * s for k in range(2)]


def planeAt(surface, center, place): return surface[0] + sum(g * (x - c) for g, x, c in zip(surface[1:3], place, center))


def middle(pixel): return [pixel[0] + 0.5, pixel[1] + 0.5]


# ------------------------------------------------------------------------------------------------ the way over cells

def entry(start, delta, startPixel, pixel):
    """The later of the borders crossed on the way into a pixel; of two at once the one in y is the later."""
    moved = [pixel[k] != startPixel[k] for k in range(2)]
    times = [((pixel[k] if delta[k] > 0 else pixel[k] + 1) - start[k]) / delta[k] if moved[k] else 0.0 for k in range(2)]
    return [min(max(max(times), 0.0), 1.0), moved[0] and (not moved[1] or times[0] > times[1])]


def before(delta, startPixel, pixel, byX):
    found = list(pixel)
    if found != list(startPixel):
        k = 0 if byX else 1
        found[k] -= 1 if delta[k] > 0 else -1
    return found


def reached(start, delta, first, s, inclusive):
    """The pixel when all borders up to s are crossed, by walking border after border."""
    pixel = int(first)
    while True:
        t = ((pixel + 1 if delta > 0 else pixel) - start) / delta
        if not (t <= s if inclusive else t < s):
            return pixel
        pixel += 1 if delta > 0 else -1


def exitPixel(start, delta, rect, leave, byX, pixel):
    k, other = (0, 1) if byX else (1, 0)
    found = [0, 0]
    found[k] = rect[2 + k] if delta[k] > 0 else rect[k] - 1
    found[other] = reached(start[other], delta[other], pixel[other], leave, not byX)  # what is crossed in y at once with x comes later
    return found


def finer(front, s, delta, slack, level):
    """Where the planes may stray from the cell's, the ray is undecided for 2 slack / (its nearing a pixel) pixels."""
    way = max((s[1] - s[0]) * max(abs(delta[0]), abs(delta[1])), 1e-20)
    rate = abs(front[1] - front[0]) / way
    pixels = 2 * max(slack, 0.0) / rate if rate > 0 else 1e9
    return min(max(math.ceil(math.log2(max(pixels, 1.0))), 0), level - 1)


def coarser(byX, following, delta, level, high):
    k = 0 if byX else 1
    border = int(following[k]) if delta[k] > 0 else int(following[k]) + 1
    for _ in range(2):
        level += 0 if (border >> level) & 1 else 1
    return min(level, high)


def descend(start, delta, rect, surface, s, front, pixel, level, free):
    found = list(pixel)
    if free > s[0]:
        found = [min(max(reached(start[k], delta[k], pixel[k], free, True), rect[k]), rect[2 + k] - 1) for k in range(2)]
    return [found, finer(front, s, delta, surface[3], level), 0, 5, 6, 0.375, 0.875]


def freePath(lifted, rect, surface, s, front, inFront):
    terms = abs(surface[0]) + abs(lifted[0]) + abs(lifted[0] + lifted[1] * s[1]) + abs(surface[1]) * rect[2] + abs(surface[2]) * rect[3]
    margin = max(surface[3], 0.0) + 1e-6 * terms
    a, b = [(x if inFront else -x) - margin for x in front]
    if not a > 0:
        return s[0]
    return kNever if b > 0 else s[0] + (s[1] - s[0]) * a / (a - b)


def entered(o, start, delta, lifted, startPixel, pixel, level, plane, error=0.0):
    grid = [max(64 >> level, 1), max(48 >> level, 1)]
    cell = [min(max(int(pixel[k]) >> level, 0), grid[k] - 1) for k in range(2)]
    spans = [span(cell[k], level, grid[k], (64, 48)[k]) for k in range(2)]
    center = [(c + 0.5) * 2 ** level for c in cell]
    surface = [plane[0] + plane[1] * center[0] + plane[2] * center[1], plane[1], plane[2], level / 1024]
    leaves = [((spans[k][1] if delta[k] > 0 else spans[k][0]) - start[k]) / delta[k] for k in range(2)]
    enter = entry(start, delta, startPixel, pixel)[0]
    leave = max(min(leaves), enter)
    fronts = []
    for s in (enter, min(leave, 1.0)):
        place = [min(max(x, q[0]), q[1]) for x, q in zip(at(start, delta, s), spans)]
        fronts.append(lifted[0] + lifted[1] * s - planeAt(surface, [sum(q) / 2 for q in spans], place))
    return [cell, spans[0][0], spans[1][0], spans[0][1], spans[1][1], surface, enter, min(leave, 1.0), fronts, leaves[0] <= leaves[1], leave >= 1.0]


# --------------------------------------------------------------------------------------------------------------- rows

kRayHead = "PatchWalk w = tableWalk(start, delta, vec4(0.0), first, false, 0.0);\n"
kRays = [[[8.5, 8.25], d] for d in ([16.0, 8.0], [-16.0, 8.0], [16.0, -8.0], [-16.0, -8.0], [4.0, 32.0], [0.5, -32.0], [-32.0, 0.5])]


def entryRows():
    rows = []
    for start, delta in kRays:
        rows += [[start, delta, [8, 8], [8 + x, 8 + y]] for x in range(-3, 4) for y in range(-3, 4)]  # also two borders at once, and pixels behind the start
    rows += [[[8.5, 8.25], [16.0, 8.0], [8, 8], p] for p in ([40, 8], [8, 40], [40, 40])]  # beyond the end
    rows += [[[8.0, 8.25], [-16.0, 8.0], [8, 8], [7, 8]], [[8.25, 8.0], [16.0, -8.0], [8, 8], [8, 7]]]  # from the border itself: at 0
    return rows + [[[8.5, 8.25], [16.0, 8.0], p, p] for p in ([9, 9], [12, 9], [9, 12])]  # the start's pixel is entered at 0, wherever it is


def exitRows():
    rows = []
    for start, delta in kRays:
        for rect in ([8, 8, 9, 9], [8, 8, 16, 16], [0, 8, 32, 12]):
            for byX in (0, 1):
                rows += [[start, delta, rect, leave, byX, [8, 8]] for leave in (0.03125, 0.09375, 0.21875, 0.3)]  # 0.09375: borders of x and y at once
                rows.append([[start[0] + 8, start[1]], delta, [rect[0] + 8, rect[1], rect[2] + 8, rect[3]], 0.09375, byX, [16, 8]])
    return rows


def finerRows():
    rows = []
    for slack in (0.375, 0.625, 0.875, 1.125, 3, 20, 300, -1, 0):
        rows += [[front, [0.25, 0.5], delta, slack, level] for front in ([0.5, 0.25], [-0.25, 0.5], [0.25, 0.3125]) for delta in ([4, 1], [-2, -8]) for level in (1, 3, 6)]
    rows += [[[0.0, 1e-20], [0.25, 0.5], [1e-20, -1e-20], 3.0, 6]]  # a ray of no length on the screen
    return rows + [[[0.25, 0.25], [0.25, 0.5], [4, 1], 0.5, 5], [[0.5, 0.25], [0.25, 0.25], [4, 1], 0.5, 5], [[0.25, 0.25], [0.5, 0.5], [4, 1], 0.0, 5]]  # along the plane; a cell's corner


def descendRows():
    rows = []
    for start, delta in kRays:
        for rect in ([8, 8, 16, 16], [0, 8, 16, 12], [8, 8, 9, 9], [0, 0, 9, 9]):
            surface = [0.25, 0, 0, 0.125]
            rows += [[start, delta, rect, surface, [0.015625, 0.25], [0.5, 0.125], [8, 8], 4, free] for free in (0.015625, 0.03125, 0.09375, 0.21875, 0.3)]
            rows.append([[start[0] + 8, start[1]], delta, [rect[0] + 8, rect[1], rect[2] + 8, rect[3]], surface, [0.015625, 0.25], [0.5, 0.125], [16, 8], 4, 0.09375])
    # At the corner of a pixel a ray that is undecided at once stays where it is.
    return rows + [[[0.5, 0.5], [4.0, 4.0], [0, 0, 8, 8], [0.25, 0, 0, 0.125], [0.125, 0.5], [0.5, 0.125], [1, 0], 3, free] for free in (0.125, 0.0625, 0.25)]


def freeRows():
    rows = []
    for inFront in (0, 1):
        sign = 1 if inFront else -1
        for a, b in ((0.5, 0.25), (0.5, -0.25), (-0.5, 0.25), (0.25, -0.5), (0.0625, -0.75), (0.75, 0.0625), (-0.5, -0.25)):
            for lifted, surface in (([0.25, 0.5], [0.25, 0.0078125, -0.0078125, 0.125]), ([0.25, 0.5], [0.25, 0, 0, -1.0])):
                rows.append([lifted, [8, 16, 24, 20], surface, [0.25, 0.75], [sign * a, sign * b], inFront])
            # Each of the terms that rounding is reckoned from, made large enough to be seen.
            for lifted, surface in (([-3e4, 0], [0, 0, 0, 0.0]), ([0, -6e4], [0, 0, 0, 0.0]), ([0, 0], [-3e4, 0, 0, 0.0]), ([0, 0], [0, -2e3, 0, 0.0]), ([0, 0], [0, 0, 3e3, 0.0]), ([4e4, -6e4], [2e4, 300, -500, 0.0])):
                rows.append([lifted, [8, 16, 24, 20], surface, [0.25, 0.75], [sign * a, sign * b], inFront])
        # The cell's bound itself: not in front of it at the entry, not past it at the end.
        rows += [[[0, 0], [8, 16, 24, 20], [0, 0, 0, 0.25], [0.25, 0.75], [sign * a, sign * b], inFront] for a, b in ((0.25, 0.5), (0.5, 0.25), (0.25, 0.25))]
    return rows


def enterRows():
    rows = []
    for start, delta in kRays:
        rows += [[o, start, delta, [0.25, -0.0625], [8, 8], p, level, [0.125, 0.001953125, -0.00048828125]] for o in (0, 1) for level in (0, 1, 3, 5)
                 for p in ([8, 8], [8 + (1 if delta[0] > 0 else -1), 8], [8 + (2 if delta[0] > 0 else -2), 8 + (1 if delta[1] > 0 else -1)])]
    plane = [0.125, 0.001953125, -0.00048828125]
    ends = [[[8.5, 8.5], d, [0.25, 0.125], [8, 8], [8, 8], 3, plane] for d in ([7.5, 1.0], [7.5, 7.5], [1.0, 7.5], [7.0, 1.0], [8.0, 1.0], [-0.5, 0.25], [1.0, 8.0])]  # the end at, before and past the border
    ends += [[[8.5, 8.5], [32.0, 16.0], [0.25, 0.125], [8, 8], p, 0, plane] for p in ([20, 8], [8, 14], [60, 8])]  # a pixel that the ray does not meet is left where it is entered
    return rows + [[0, *row] for row in ends] + [[0, [60.5, 46.5], [20.0, 9.0], [0.25, 0.125], [60, 46], [60, 46], level, plane] for level in (2, 4, 5, 6)]


def wayFunctions():
    cell = "tableCell(rect, surface, s, front, "
    return [
        Function("Entry", "start:2 delta:2 first:2 pixel:2", ["e.s", "number(e.isByX)"], entryRows(), entry, kRayHead + "PixelEntry e = computePixelEntry(w, whole(pixel));"),
        Function("Before", "delta:2 first:2 pixel:2 byX:b", ["p.x", "p.y"], [[d, [8, 8], p, byX] for _, d in kRays for p in ([8, 8], [9, 8], [7, 9]) for byX in (0, 1)], before,
                 "vec2 p = vec2(computePixelBefore(tableWalk(vec2(8.5), delta, vec4(0.0), first, false, 0.0), whole(pixel), byX));"),
        Function("Exit", "start:2 delta:2 rect:4 leave:1 byX:b pixel:2", ["p.x", "p.y"], exitRows(), exitPixel,
                 "vec2 first = pixel;\n" + kRayHead + "vec2 p = vec2(computeExitPixel(w, tableCell(rect, vec4(0.0), vec2(0.0, leave), vec2(0.0), byX), whole(pixel)));"),
        Function("Finer", "front:2 s:2 delta:2 slack:1 level:i", ["float(chooseFinerLevel(w, tableCell(vec4(0.0, 0.0, 8.0, 8.0), vec4(0.25, 0.0, 0.0, slack), s, front, false), level))"],
                 finerRows(), finer, "PatchWalk w = tableWalk(vec2(0.5), delta, vec4(0.0), vec2(0.0), false, 0.0);"),
        Function("Coarser", "byX:b next:2 delta:2 level:i high:i", ["float(chooseCoarserLevel(tableCell(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0), byX), whole(next), delta, level, high))"],
                 [[byX, p, d, level, high] for byX in (0, 1) for p in ([7, 8], [12, 15], [16, 6], [31, 32], [9, 11], [10, 13]) for d in ([0.5, 3], [-4, 0.5], [4, -3]) for level in (0, 1, 2, 3) for high in (6, 3)], coarser),
        Function("Descend", "start:2 delta:2 rect:4 surface:4 s:2 front:2 pixel:2 level:i free:1",
                 ["float(n.pixel.x)", "float(n.pixel.y)", "float(n.level)", "number(n.inFront)", "float(n.hidden.pixel.x)", "float(n.hidden.pixel.y)", "n.hidden.s", "n.clearance"], descendRows(), descend,
                 "vec2 first = pixel;\n" + kRayHead + "PatchState from = PatchState(whole(pixel), level, false, HiddenStart(ivec2(5, 6), 0.375), 0.875);\n"
                 f"PatchState n = descendPatch(w, {cell}true), from, free);"),
        Function("Free", "lifted:2 rect:4 surface:4 s:2 front:2 inFront:b", ["min(computeFreePath(w, " + cell + "false), inFront), 4.0)"], freeRows(), lambda *a: min(freePath(*a), 4.0),
                 "PatchWalk w = tableWalk(vec2(8.5), vec2(4.0), vec4(100.0, 100.0, lifted), vec2(8.0), false, 0.0);", relative=1e-6, absolute=1e-6),
        Function("Enter", "o:b start:2 delta:2 lifted:2 first:2 pixel:2 level:i plane:3",
                 ["float(c.cell.x)", "float(c.cell.y)", "float(c.rect.begin.x)", "float(c.rect.begin.y)", "float(c.rect.end.x)", "float(c.rect.end.y)", "c.surface.affineDepth", "c.surface.gradient.x",
                  "c.surface.gradient.y", "c.surface.slack", "c.enter", "c.leave", "c.frontAtEnter", "c.frontAtLeave", "number(c.leavesByX)", "number(c.isLast)"], enterRows(), entered,
                 "tablePlane = plane;\nPatchWalk w = tableWalk(start, delta, vec4(lifted + vec2(1.0), lifted), first, false, 0.0);\n"
                 "PatchCell c = enterPatchCell(tableView(o, true), w, PatchState(whole(pixel), level, true, HiddenStart(whole(first), 0.0), kNoClearance));"),
    ]


def make():
    write("patch_way", "The way of the march over planes from cell to cell and level to level, function by function, its borders and ties among them.", wayFunctions(), [],
          kViews + copyOf("crossray/project/patch_tracer.glsl") + kHooks)
