"""Tables of the files that read by hooks, whose hooks are formulas here; see tables.py."""
import math
from tables import Function, add, clamp01, copyOf, dot, flat, isNumber, kInf, kNaN, mul, single, sub, unit, write
from tables_core import kFar, kNear, kSize, kSlope, kViews, linearOf, isCleared, toViewDir
from tables_project import chooseSlope, cubePlace, fold, normalGradient

# ------------------------------------------------------------------------------------------ probe/cubemap_filter.glsl

# Cubemap 0: 4 texels a side and 3 levels; 1: the same texels, of which some are no radiance; 2: no level at all; 3: one level more; 4: 8 texels a side.
kTexels = """
int probeCubeSize(int cubemap) { return cubemap == 4 ? 8 : 4; }
int probeCubeLevelCount(int cubemap) { return cubemap == 2 ? 0 : cubemap == 3 ? 4 : 3; }

bool askedOutside = false; // for a face, a texel or a level that there is not
vec3 fetchProbeTexel(int cubemap, int face, ivec2 texel, int level)
{
    int last = max((probeCubeSize(cubemap) >> level) - 1, 0);
    bool isTexel = min(texel.x, texel.y) >= 0 && max(texel.x, texel.y) <= last;
    bool isThere = isTexel && face >= 0 && face <= 5 && level >= 0 && level < max(probeCubeLevelCount(cubemap), 1);
    askedOutside = askedOutside || !isThere;
    int number = face * 7 + texel.x * 3 + texel.y * 5 + level * 11;
    vec3 radiance = vec3(float(number % 13), float(number % 7) + 0.5, float(number % 5)) * 0.25;
    int kind = cubemap == 1 ? number % 6 : 0;
    radiance.x = kind == 1 ? -1.0 : kind == 2 ? uintBitsToFloat(0x7fc00000u) : kind == 3 ? 90000.0 : radiance.x;
    radiance.y = kind == 2 ? -1.0 : kind == 4 ? uintBitsToFloat(0x7fc00000u) : kind == 5 ? 80000.0 : radiance.y;
    radiance.z = kind == 4 ? uintBitsToFloat(0x7f800000u) : kind == 5 ? 70000.0 : radiance.z;
    return radiance;
}
"""


def texel(cubemap, face, x, y, level):
    number = face * 7 + x * 3 + y * 5 + level * 11
    found = [number % 13 * 0.25, (number % 7 + 0.5) * 0.25, number % 5 * 0.25]
    kind = number % 6 if cubemap == 1 else 0
    if kind in (1, 2):
        found[0] = 0.0
    if kind == 3:
        found[0] = 65504.0
    if kind in (2, 4):
        found[1] = 0.0
    if kind == 4:
        found[2] = 0.0
    if kind == 5:
        found[1] = found[2] = 65504.0
    return found


def bilinear(cubemap, face, u, v, level):
    """Four texels; where two edges meet the one beyond the corner is the mean of the other three."""
    n = max((8 if cubemap == 4 else 4) >> level, 1)
    x, y = u * n - 0.5, v * n - 0.5
    bx, by = math.floor(x), math.floor(y)
    taps = []
    for j in (0, 1):
        for i in (0, 1):
            tx, ty = bx + i, by + j
            outX, outY = not 0 <= tx < n, not 0 <= ty < n
            weight = (x - bx if i else 1 - x + bx) * (y - by if j else 1 - y + by)
            if outX and outY:
                taps.append((weight, None))
                continue
            f, fu, fv, _ = fold(face, [(tx + 0.5) / n, (ty + 0.5) / n])
            taps.append((weight, texel(cubemap, f, min(int(fu * n), n - 1), min(int(fv * n), n - 1), level)))
    known = [t for _, t in taps if t is not None]
    corner = [sum(t[k] for t in known) / 3 for k in range(3)]
    return [sum(w * (t or corner)[k] for w, t in taps) for k in range(3)]


def sampleCube(cubemap, d, level):
    last = 0 if cubemap == 2 else 3 if cubemap == 3 else 2
    level = min(level if level > 0 else 0, last)
    low = int(level)
    share = level - low
    face, u, v, _ = cubePlace(d)
    a, b = bilinear(cubemap, face, u, v, low), bilinear(cubemap, face, u, v, min(low + 1, last))
    return [p * (1 - share) + q * share for p, q in zip(a, b)]


def cubemapFilterTables():
    inside = [[1, 0.3, -0.45], [-1, 0.2, 0.6], [0.35, 1, -0.1], [0.1, -1, -0.55], [0.4, -0.3, 1], [-0.15, 0.2, -1]]
    edges = [[1, 0.95, 0.1], [1, 0.1, 0.95], [-1, -0.9, 0.3], [0.2, 1, 0.93], [-0.97, 1, 0.1], [0.9, -1, 0.2], [0.1, 0.94, 1], [0.92, -0.2, 1], [-0.9, 0.15, -1], [0.1, -0.93, -1], [0.2, -1, -0.9], [-1, 0.1, -0.96]]
    corners = [[s * 1.0, t * 0.93, r * 0.9] for s in (-1, 1) for t in (-1, 1) for r in (-1, 1)] + [[0.9, 1, 0.95], [-0.9, -1, 0.92], [0.93, -0.91, 1], [-0.95, 0.9, -1]]
    rows = [[0, d, level] for d in inside + edges + corners for level in (0, 1, 0.25, 1.5)] + [[0, d, level] for d in inside[:3] + corners[:2] for level in (2, 3, 1.75, -1, kNaN, kInf)]
    rows += [[4, d, 0.25] for d in edges[:4] + corners]
    rows += [[3, d, level] for d in inside[:3] + corners[:2] for level in (2, 2.5, 3, 4)]
    rows += [[c, d, level] for c in (1, 2) for d in inside + edges[:4] for level in (0, 0.5, 2)] + [[0, d, 0.5] for d in ([0, 0, 0], [0, 0, 5], [-3, 0, 0], [0.5, 1, 0], [0, -0.5, 1])]
    write("cubemap_filter", "A cubemap is read linearly within faces, across their edges, at corners and between levels.", [
        Function("Sample", "c:i d:3 level:1", ["r.x", "r.y", "r.z", "number(askedOutside)"], rows, lambda *row: sampleCube(*row) + [0], "vec3 r = sampleProbeCubemap(c, d, level);", relative=4e-6, absolute=4e-6),
    ], [], copyOf("crossray/probe/cubemap_filter.glsl") + kTexels)


# ----------------------------------------------------------------------------------------- project/color_pyramid.glsl

# An image of 11 x 6 pixels; level 1 has 5 x 3 cells, level 2 2 x 1, level 3 one. Or of 6 x 11 pixels. A cell's colour and coverage are
# formulas, or all cells have one coverage, and no red.
kColors = """
int tableLevels = 4;
float tableCoverage = -1.0; // of all cells, from 0 on
bool askedOutside = false; // for a cell or a level that there is not
bool tableIsTall = false;
ivec2 colorImageSize() { return tableIsTall ? ivec2(6, 11) : ivec2(11, 6); }
ivec2 colorPyramidSize(int level) { return max(ivec2(colorImageSize().x >> level, colorImageSize().y >> level), ivec2(1)); }

vec4 fetchColorPyramid(ivec2 cell, int level)
{
    ivec2 size = colorPyramidSize(level);
    bool isCell = min(cell.x, cell.y) >= 0 && cell.x < size.x && cell.y < size.y;
    askedOutside = askedOutside || !isCell || level < 0 || level >= tableLevels;
    int number = cell.x * 3 + cell.y * 5 + level * 7;
    float coverage = tableCoverage >= 0.0 ? tableCoverage : float(number % 4) * 0.25;
    float red = tableCoverage >= 0.0 ? 0.0 : float(number % 9) * 0.5;
    return coverage > 0.0 ? vec4(red, float(number % 5), float(number % 7) * 0.25, coverage) : vec4(0.0);
}

int tableLevel = 0;
bool tableIsEmpty = false;
vec4 fetchFinerColor(ivec2 cell) { return fetchColorPyramid(cell, tableLevel); }
ivec2 finerColorSize() { return tableIsEmpty ? ivec2(0) : colorPyramidSize(tableLevel); }
int finerColorLevel() { return tableLevel; }
"""


def colorSize(level, isTall=False): return [max((6 if isTall else 11) >> level, 1), max((11 if isTall else 6) >> level, 1)]


def colorCell(x, y, level, everywhere):
    number = x * 3 + y * 5 + level * 7
    coverage = everywhere if everywhere >= 0 else number % 4 * 0.25
    return [0.0 if everywhere >= 0 else number % 9 * 0.5, float(number % 5), number % 7 * 0.25, coverage] if coverage > 0 else [0, 0, 0, 0]


def sampleColor(uv, level, levels, coverage):
    uv = [clamp01(x) for x in uv]
    last = max(levels, 1) - 1
    level = min(level, last) if level > 0 else 0
    low = int(level)
    sums = [0.0] * 4
    for l, w in ((low, 1 - level + low), (min(low + 1, last), level - low)):
        size = colorSize(l)
        p = [u * n - 0.5 for u, n in zip(uv, size)]
        b = [math.floor(x) for x in p]
        for j in (0, 1):
            for i in (0, 1):
                share = (p[0] - b[0] if i else 1 - p[0] + b[0]) * (p[1] - b[1] if j else 1 - p[1] + b[1]) * w
                c = colorCell(min(max(b[0] + i, 0), size[0] - 1), min(max(b[1] + j, 0), size[1] - 1), l, coverage)
                for k in range(3):
                    sums[k] += c[k] * c[3] * share
                sums[3] += c[3] * share
    valid = sums[3] >= single(1e-6)
    return [[x / sums[3] for x in sums[:3]] if valid else [0, 0, 0], min(sums[3], 1), valid, 0]


def reduceColor(x, y, level, coverage, isEmpty, isTall):
    """By pixels: each finer cell counts as often as it has pixels. A level without cells counts as one cell."""
    finer, size = [1, 1] if isEmpty else colorSize(level, isTall), colorSize(level + 1, isTall)
    width = lambda c, n, l, pixels: pixels - (c << l) if c == n - 1 else 1 << l
    end = [finer[0] if x == size[0] - 1 else 2 * x + 2, finer[1] if y == size[1] - 1 else 2 * y + 2]
    sums, pixels = [0.0] * 4, 0
    for j in range(2 * y, end[1]):
        for i in range(2 * x, end[0]):
            area = width(i, finer[0], level, 6 if isTall else 11) * width(j, finer[1], level, 11 if isTall else 6)
            c = colorCell(i, j, level, coverage)
            pixels += area
            for k in range(3):
                sums[k] += c[k] * c[3] * area
            sums[3] += c[3] * area
    return [[s / sums[3] for s in sums[:3]], sums[3] / pixels, 0] if sums[3] > 0 else [0, 0, 0, 0, 0]


def colorTables():
    places = [[0.5, 0.5], [0.1, 0.8], [0.93, 0.2], [0, 0], [1, 1], [-0.5, 0.3], [0.3, 1.5], [0.03, 0.97], [0.62, 0.37], [0.27, 0.11], [kNaN, 0.4]]
    cells = [[x, y, l, -1, 0, tall] for tall in (0, 1) for l in (0, 1, 2) for y in range(colorSize(l + 1, tall)[1]) for x in range(colorSize(l + 1, tall)[0])]
    # No pixel is valid; the finer level has no cell, a hook that breaks its word; valid pixels without red.
    cells += [[1, 1, 0, 0, 0, 0], [0, 0, 3, -1, 1, 0], [1, 1, 0, 0.5, 0, 0]]
    # The smallest coverage itself, at the middle of the one cell of level 3, where the weights are 1 and 0 and nothing rounds.
    faint = [[[0.5, 0.5], 3, 4, c] for c in (0, 0.5e-6, 1e-6, 2e-6, 5e-4)]
    # A flat exponent shows what becomes of the smallest roughness.
    rough = [[r, e, n] for r in (0, 0.25, 0.5, 1, 1.5, -1, kNaN) for e in (0.8, 1.3) for n in (-1, 0, 1, 2, 4)] + [[r, 0.05, 4] for r in (0, 1e-29)]
    write("color_pyramid", "A rough look-up mixes four cells of two levels by their coverage, and a cell has what its valid pixels have.", [
        Function("Sample", "uv:2 level:1 n:i c:1", ["s.color.x", "s.color.y", "s.color.z", "s.coverage", "number(s.isValid)", "number(askedOutside)"],
                 faint + [[uv, level, n, -1] for uv in places for level, n in ((0, 4), (0.5, 4), (1, 4), (1.25, 4), (2.75, 4), (3, 4), (9, 4), (-1, 4), (kNaN, 4), (2.5, 2), (1, 0), (0.3, 1))], sampleColor,
                 "tableLevels = max(n, 1);\ntableCoverage = c;\nColorSample s = sampleColorPyramid(uv, level, n);", absolute=4e-6),
        Function("Reduce", "x:i y:i l:i f:1 empty:b tall:b", ["c.x", "c.y", "c.z", "c.w", "number(askedOutside)"], cells, reduceColor,
                 "tableLevel = l;\ntableCoverage = f;\ntableIsEmpty = empty;\ntableIsTall = tall;\nvec4 c = reduceColorPyramidCell(ivec2(x, y));", absolute=4e-6),
        Function("Level", "r:1 e:1 n:i", ["computeColorLevel(r, e, n)"], rough, lambda r, e, n: [clamp01(r) ** e * max(n - 1, 0)], relative=2e-5),
    ], [], copyOf("crossray/project/color_pyramid.glsl", ["CROSSRAY_REDUCE_COLOR_PYRAMID"]) + kColors)


# --------------------------------------------------------------------- project/depth_pyramid.glsl, surface_pyramid.glsl

# A level of 7 x 5 cells over 14 x 11 pixels or of 6 x 4 over 12 x 8, at level 1; formulas again.
kSurfaces = """
ivec2 tableSize = ivec2(7, 5);
float tableDepth(ivec2 cell, int salt) { return 1.0 + float((cell.x * 5 + cell.y * 3 + cell.x * cell.y + salt) % 11) * 0.5; }
vec2 fetchFinerDepth(ivec2 cell) { return vec2(tableDepth(cell, 0), tableDepth(cell, 4) + 6.0); }
ivec2 finerDepthSize() { return tableSize; }
ivec2 finerSurfaceSize(int level) { return tableSize; }
vec4 fetchFinerSurface(ivec2 cell, int level)
{
    int number = cell.x * 5 + cell.y * 3 + cell.x * cell.y;
    return vec4(0.25 + float(number % 7) * 0.0625, float(number % 5 - 2) * 0.0078125, float(number % 3 - 1) * 0.015625,
                number % 6 == 5 ? -1.0 : float(number % 4) * 0.015625);
}

// Pixels for level 0: a plane, on which one pixel is nearer and one shows nothing.
bool tableOrthographic = false;
vec3 tableNormal = vec3(0.0);
float fetchDeviceDepth(ivec2 pixel)
{
    float affine = tableOrthographic ? -8.0 + 0.03125 * float(pixel.x) - 0.0625 * float(pixel.y) : 0.25 + 0.00390625 * float(pixel.x) - 0.001953125 * float(pixel.y);
    affine = affine + (pixel == ivec2(20, 20) ? 0.25 : 0.0);
    float linear = tableOrthographic ? -affine : 1.0 / affine;
    return pixel == ivec2(30, 20) ? 0.0 : deviceDepthFromLinear(tableView(tableOrthographic, true), linear);
}
vec3 fetchNormalWS(ivec2 pixel) { return tableNormal; }
"""


def depthOf(x, y, salt): return 1 + (x * 5 + y * 3 + x * y + salt) % 11 * 0.5


def finerCells(x, y, w, h):
    size = [max(w // 2, 1), max(h // 2, 1)]
    return range(2 * x, w if x == size[0] - 1 else 2 * x + 2), range(2 * y, h if y == size[1] - 1 else 2 * y + 2), size


def reduceDepth(x, y, w, h):
    columns, rows, _ = finerCells(x, y, w, h)
    return [min(depthOf(i, j, 0) for i in columns for j in rows), max(depthOf(i, j, 4) for i in columns for j in rows) + 6]


def surfaceOf(x, y):
    n = x * 5 + y * 3 + x * y
    return 0.25 + n % 7 * 0.0625, [(n % 5 - 2) * 0.0078125, (n % 3 - 1) * 0.015625], -1 if n % 6 == 5 else n % 4 * 0.015625


def reduceSurface(x, y, w, h, px, py):
    """The cell with the least slack over the corners of all that lies under it, of the gradients that are asked."""
    columns, rows, size = finerCells(x, y, w, h)
    span = lambda c, level, count, pixels: (c << level, pixels if c >= count - 1 else (c + 1) << level)
    bx, by = span(x, 2, size[0], px), span(y, 2, size[1], py)
    center = [sum(bx) / 2, sum(by) / 2]
    under = []
    for j in rows:
        for i in columns:
            fx, fy = span(i, 1, w, px), span(j, 1, h, py)
            under.append((surfaceOf(i, j), [sum(fx) / 2, sum(fy) / 2], [fx, fy]))
    gradients = [[0, 0]] + [s[1] for s, _, _ in under] + [[sum(s[1][k] for s, _, _ in under) / len(under) for k in range(2)]]
    found = []
    for g in gradients:
        low, high = 1e30, -1e30
        for (affine, own, slack), c, (fx, fy) in under:
            for qx in fx:
                for qy in fy:
                    strays = affine + own[0] * (qx - c[0]) + own[1] * (qy - c[1]) - g[0] * (qx - center[0]) - g[1] * (qy - center[1])
                    low, high = min(low, strays - max(slack, 0)), max(high, strays + max(slack, 0))
        found.append([(high - low) / 2, (low + high) / 2, g])
    found.sort(key=lambda cover: cover[0])
    isTie = len(found) > 1 and any(abs(c[0] - found[0][0]) < 1e-6 and c[2] != found[0][2] for c in found[1:])
    return None if isTie else [found[0][1], found[0][2], found[0][0]]


def pixelAffine(o, x, y):
    a = -8 + 0.03125 * x - 0.0625 * y if o else 0.25 + 0.00390625 * x - 0.001953125 * y
    return a + (0.25 if (x, y) == (20, 20) else 0)


def buildPixel(o, x, y, n, error):
    if (x, y) == (30, 20):
        return [-128 if o else 0, 0, 0, -1]
    a = pixelAffine(o, x, y)
    has = isNumber(n) and any(n)
    normal = normalGradient(o, [x + 0.5, y + 0.5], 1 if o else 1 / a, toViewDir(unit(n))) if has else [0, 0]
    tolerance = 0.05 / 48 * (1 if o else a) + 2 * error + 1e-6 * abs(a)
    found = []
    for k, (dx, dy) in enumerate(((1, 0), (0, 1))):
        sides = []
        for s in (-1, 1):
            q = (x + s * dx, y + s * dy)
            known = 0 <= q[0] < 64 and 0 <= q[1] < 48 and q != (30, 20)
            sides.append((s * (pixelAffine(o, *q) - a), known))
        found.append(chooseSlope(normal[k], has, sides[0][0], sides[0][1], sides[1][0], sides[1][1], tolerance))
    extent = (abs(found[0]) + abs(found[1])) / 2
    if extent > 0.03 * abs(a):
        found = mul(found, 0.03 * abs(a) / extent)
    return [a, found, 0]


def surfaceTables():
    # Of two that stray alike, rounding chooses.
    cells = [[x, y, w, h] for w, h in ((7, 5), (6, 4), (1, 3), (3, 1)) for y in range(max(h // 2, 1)) for x in range(max(w // 2, 1))]
    from tables_core import kAxes
    back = kAxes[2]
    pixels = [[o, x, y, n, e] for o in (0, 1) for x, y in ((10, 10), (0, 0), (63, 47), (20, 20), (21, 20), (19, 20), (20, 21), (20, 19), (29, 20), (31, 20), (30, 19), (30, 21), (30, 20), (63, 0), (0, 47), (5, 40))
              for n in ([0, 0, 0], [kNaN, 0, 1], back, [0.3, -0.5, 1]) for e in (0, 0.0009765625)]
    write("surface_pyramid", "Pixels become planes by depth and normal, and a cell of a pyramid covers what lies under it as tightly as its rule allows.", [
        Function("ReduceDepth", "x:i y:i w:i h:i", ["c.x", "c.y"], cells, reduceDepth, "tableSize = ivec2(w, h);\nvec2 c = reduceDepthPyramidCell(ivec2(x, y));", absolute=0),
        Function("Reduce", "x:i y:i w:i h:i px:i py:i", ["c.x", "c.y", "c.z", "c.w"], [row for row in ([*c, 2 * c[2] + 1, 2 * c[3] + 1] for c in cells) if reduceSurface(*row)], reduceSurface,
                 "tableSize = ivec2(w, h);\nvec4 c = reduceSurfaceCell(ivec2(x, y), 1, ivec2(px, py));", absolute=4e-6),
        Function("Build", "o:b x:i y:i n:3 e:1", ["c.x", "c.y", "c.z", "c.w"], pixels, buildPixel,
                 "tableOrthographic = o;\ntableNormal = n;\nvec4 c = buildSurfacePixel(tableView(o, true), ivec2(x, y), e);", relative=1e-3, absolute=3e-5),
    ], [], kViews + copyOf("crossray/project/depth_pyramid.glsl", ["CROSSRAY_REDUCE_DEPTH_PYRAMID"])
        + copyOf("crossray/project/surface_pyramid.glsl", ["CROSSRAY_BUILD_SURFACE_PYRAMID"]) + kSurfaces)


def make():
    cubemapFilterTables()
    colorTables()
    surfaceTables()
