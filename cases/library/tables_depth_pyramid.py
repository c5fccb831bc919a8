"""The table of project/depth_pyramid.glsl; see tables.py."""
from tables import copyOf, Function, kInf, kNaN, write
from tables_core import isCleared, kViews, linearOf

# Every cell has a number of its own; `salt` turns which is the least, and what lies outside gives itself away.
kCells = """
ivec2 tableSize = ivec2(0);
int tableSalt = 0;

ivec2 finerDepthSize() { return tableSize; }

vec2 fetchFinerDepth(ivec2 cell)
{
    ivec2 size = max(tableSize, ivec2(1));
    bool isInside = cell.x >= 0 && cell.y >= 0 && cell.x < size.x && cell.y < size.y;
    int number = (cell.x % 3 + cell.y % 3 * 3 + tableSalt) % 9;
    return isInside ? vec2(0.0625 * float(number + 1), 0.0625 * float(number + 2)) : vec2(-1.0, 2e30);
}
"""


def reduce(x, y, w, h, salt):
    """What the pixels under a cell have: two a side, and what an odd size leaves over in the last one."""
    w, h = max(w, 1), max(h, 1)
    last = [max(n // 2, 1) - 1 for n in (w, h)]
    under = [[i for i in range(n) if min(i // 2, end) == c] for c, n, end in zip((x, y), (w, h), last)]
    numbers = [(i % 3 + j % 3 * 3 + salt) % 9 for i in under[0] for j in under[1]]
    return [(min(numbers) + 1) / 16, (max(numbers) + 2) / 16]


def make():
    cells = [[x, y, w, h, salt] for w, h in ((7, 5), (6, 4), (3, 3), (2, 7), (1, 3), (3, 1), (1, 1), (0, 0), (0, 4), (5, -2)) for y in range(max(h // 2, 1)) for x in range(max(w // 2, 1))
             for salt in (range(9) if w * h in (9, 3, 1, 0) else (0, 4, 7))]
    devices = [0.0, 1.0, 0.25, 0.5, 0.75, 0.015625, -0.25, 1.25, 1.0005, -0.0005, 1.002, -0.002, kNaN, kInf, -kInf]
    texels = [[o, r, d] for o in (0, 1) for r in (0, 1) for d in devices]
    sizes = [[w, h, l] for w, h in ((64, 48), (43, 27), (1, 1), (0, 5), (7, 300), (70000, 5), (-3, 70000)) for l in (-1, 0, 1, 3, 9, 16, 17, 31, 40)]
    write("depth_pyramid", "A texel of the depth pyramid is the pixel's depth or sky, and a cell has the nearest and the farthest of what lies under it.", [
        Function("Reduce", "x:i y:i w:i h:i salt:i", ["c.x", "c.y"], cells, reduce, "tableSize = ivec2(w, h);\ntableSalt = salt;\nvec2 c = reduceDepthPyramidCell(ivec2(x, y));", relative=0, absolute=0),
        Function("Texel", "o:b r:b d:1", ["makeDepthPyramidTexel(v, d).x", "makeDepthPyramidTexel(v, d).y"], texels,
                 lambda o, r, d: [1e30 if isCleared(d, r) else linearOf(d, o, r)] * 2, "View v = tableView(o, r);", relative=1e-4),
        Function("Sizes", "w:i h:i l:i", ["float(s.x)", "float(s.y)", "float(computeDepthPyramidLevelCount(ivec2(w, h)))"], sizes,
                 lambda w, h, l: [max(w >> min(max(l, 0), 30), 1), max(h >> min(max(l, 0), 30), 1), max(w, h, 1).bit_length()], "ivec2 s = computeDepthPyramidSize(ivec2(w, h), l);", absolute=0),
        Function("Cell", "x:i y:i l:i w:i h:i", ["float(c.x)", "float(c.y)"],
                 [[x, y, l, max(w >> l, 1), max(h >> l, 1)] for w, h in ((43, 27), (5, 9)) for x, y in ((0, 0), (20, 13), (42, 26), (50, 30), (-3, 5), (5, -3), (4, 8)) for l in (0, 1, 2, 3)],
                 lambda x, y, l, w, h: [min(max(x >> l, 0), w - 1), min(max(y >> l, 0), h - 1)], "ivec2 c = computeDepthPyramidCell(ivec2(x, y), l, ivec2(w, h));", absolute=0),
    ], [], kViews + copyOf("crossray/project/depth_pyramid.glsl", ["CROSSRAY_REDUCE_DEPTH_PYRAMID"]) + kCells)
