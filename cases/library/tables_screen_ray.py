"""The table of project/screen_ray.glsl; see tables.py."""
import math
from tables import flat, Function, kInf, kNaN, sub, unit, write
from tables_core import fromView, kEye, kViews
from tables_project import pixelAt, screenRay, screenRayInView


def make():
    at = lambda x, y, z: fromView([x, y, -z])
    turn = lambda x, y, z: sub(fromView([x, y, z]), kEye)
    rays = [([0.3, -0.2, 2], [1, 0.5, -1]), ([0.3, -0.2, 2], [-0.5, 1, 0.25]), ([1, 1, 8], [0.2, -0.3, 1]), ([-2, 1, 20], [0.1, 0.2, -1]), ([0, 0, 3], [0, 0, -1]), ([0, 0, 3], [0, 0, 1]),
            ([0.5, 0.25, 4], [1, 0, 0]), ([0.5, 0.25, 4], [0, -1, 0]), ([1, -1, 63], [0.3, 0.1, -0.05]), ([0.2, 0.1, 0.6], [0.1, 0.1, 1]), ([-0.4, 0.3, 2], [1, -1, 1e-3])]
    edges = [([0.1, 0.1, 0.25], [0, 0.2, 1]), ([0.1, 0.1, 0.25], [0, 0.2, -1]), ([0.1, 0.1, 70], [0, 0.2, -1]), ([0.1, 0.1, 70], [0, 0.2, 1]), ([0, 0, -1], [0, 0.2, -1]), ([0, 0, -1], [0, 0.2, 1]),
             ([0, 0, 80], [1, 0.5, 0]), ([0, 0, 0.25], [1, 0.5, 0])]
    rows = [[o, at(*p), turn(*d)] for o in (0, 1) for p, d in rays + edges]
    rows += [[o, p, d] for o in (0, 1) for p, d in (([kNaN, 0, 0], [1, 0, 0]), ([0, 0, 0], [0, 0, 0]), ([0, 0, 0], [kNaN, 0, 1]), ([0, 3, 0], [0, kInf, 0]))]

    # In a view that is the world's axes, where origins and directions are exact: at the eye, on the near plane and on the far one, across the
    # view and nearly so, straight away, from far behind the far plane, and what overflows.
    exact = [([0, 0, 0], [0, 0.2, -1]), ([0.1, 0.1, -0.5], [0, 0.2, 1]), ([0.1, 0.1, -0.5], [0, 0.3, -1]), ([0.1, 0.1, -64], [0, 0.2, -1]), ([0.1, 0.1, -63.5], [0, 0.2, -1]), ([0.1, 0.1, -64], [0, 0.2, 1]),
             ([0.5, 0.25, -4], [1, 0.5, 0]), ([0.5, 0.25, -4], [1, 0.5, -1e-5]), ([0.5, 0.25, -4], [-0.5, 1, 1e-5]), ([0, 0, -3], [0, 0, -1]), ([0, 0, -3], [0, 0, 1]), ([0, 0.5, -3], [0, 1, 0]),
             ([0, 0, -0.25], [0, 0.2, 1]), ([1e36, 0, -1e-3], [0, 0.2, -1]), ([1e36, 0, -1e-3], [0, 0.2, 1]), ([0.1, 0, -0.25], [1, 0, 2e-38]), ([0.1, 0, -70], [1, 0, -2e-38])]
    exact = [[o, p, unit(d)] for o in (0, 1) for p, d in exact] + [[0, [0, 0, -2e-38], [0, 0, -1]]] + [[0, [1, 1, -30000], unit([k / 64, 0.125, 1])] for k in (31, 34, 41, 47, 54)]

    def depths(o, z, _):
        return [-z if o else 1 / max(z, 1e-30), -z if o else 1 / max(z, 1e-30)]
    walks = [[a, d, int(math.floor(a)), s, i] for a, d in ((2.5, 7.25), (7.75, -5.5), (3.0, 4.0), (6.0, -4.0), (1.25, 0.5), (5.5, 0.0), (8.5, -9.0), (40.5, 20.0), (8.25, -0.125), (2.75, 1.0))
             for s in (0.0, 0.1, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0) for i in (0, 1)]
    walks += [[a, d, f, s, i] for a, d, f in ((2.5, 7.25, 4), (7.75, -5.5, 5)) for s in (0.0, 0.2, 0.6, 1.0) for i in (0, 1)]
    walks = [row for row in walks if row[1] == 0 or abs((row[0] + row[1] * row[3]) % 1 - 0.5) < 0.499 or row[3] in (0.0, 0.25, 0.5, 1.0)]

    walks += [[5.5, 0.0, f, 0.5, i] for f in (2, 9) for i in (0, 1)] + [[a, d, 1, 10.0, i] for a, d in ((1.25, 0.5), (1.75, -0.5)) for i in (0, 1)]
    # Far off the image the guess stops at 2 pixels and at a million, and two rounds go on from there.
    ends = [[2.5, -100, 2, 1, i, -4] for i in (0, 1)] + [[0.5, 1e20, 0, 1, i, 1000002] for i in (0, 1)] + [[-10, 5, -10, 1, i, -4] for i in (0, 1)] + [[3e6, -1e6, 3000000, 1, i, 1000002] for i in (0, 1)]

    def walked(a, d, f, s, i):
        return [pixelAt(a, d, f, s, i)]
    out = ["r.startSS.x", "r.startSS.y", "r.deltaSS.x", "r.deltaSS.y", "r.pixelLength", "r.startAffineDepth", "r.deltaAffineDepth", "float(r.endReason)", "float(r.status)"]
    plain = [row for row in rows if screenRay(*row)[-1] == 0 and min(abs(x) for x in flat(screenRay(*row))[2:4]) > 1e-3]
    odd = [row for row in rows if screenRay(*row)[-1] != 0]
    write("screen_ray", "A ray's way over the screen is the line between the projections of its ends, and pixels follow one another as its borders do.", [
        Function("ScreenRay", "o:b p:3 d:3", out, plain, screenRay, "ScreenRay r = makeScreenRay(tableView(o, true), p, d);", relative=1e-4, absolute=2e-5),
        Function("NoRay", "o:b p:3 d:3", out[:2] + out[4:7] + out[8:], odd, lambda *row: [flat(screenRay(*row))[k] for k in (0, 1, 4, 5, 6, 8)],
                 "ScreenRay r = makeScreenRay(tableView(o, true), p, d);"),
        Function("Frame", "o:b", ["float(f.imageSize.x)", "float(f.imageSize.y)", "f.footprint", "number(f.orthographic)"], [[0], [1]],
                 lambda o: [64, 48, 2 * 0.5 / 48, o], "ScreenFrame f = makeScreenFrame(tableView(o, true));"),
        Function("Affine", "o:b z:1 back:1", ["affineDepthFromLinear(o, z)", "linearDepthFromAffine(o, back)"], [[o, z, z] for o in (0, 1) for z in (1, 4, 0.125, 0, -2, 1e-29, 1e-31, 1e29)], depths),
        Function("At", "s:1", ["screenRayPositionSS(r, s).x", "screenRayPositionSS(r, s).y", "screenRayAffineDepth(r, s)"], [[s] for s in (0, 0.25, 1, 1.5)],
                 lambda s: [3 + 10 * s, 5 - 4 * s, 0.5 + 0.25 * s], "ScreenRay r = ScreenRay(vec2(3.0, 5.0), vec2(10.0, -4.0), 0.1, 0.5, 0.25, 0, 0);"),
        Function("Border", "a:1 d:1 b:i", ["borderTime(a, d, b)", "float(entryBorder(b, d))", "float(exitBorder(b, d))"],
                 [[a, d, b] for a in (2.5, 7) for d in (4, -2, 0.5, 0, -0.25) for b in (0, 3, 9)],
                 lambda a, d, b: [1e30 if d == 0 else (b - a) / d, b if d > 0 else b + 1, b + 1 if d > 0 else b]),
        Function("PixelAt", "a:1 d:1 f:i s:1 i:b", ["float(pixelAt(a, d, f, s, i))"], walks, walked, absolute=0),
        Function("PixelFar", "a:1 d:1 f:i s:1 i:b e:1", ["float(pixelAt(a, d, f, s, i))"], ends, lambda *row: [row[-1]], relative=0, absolute=0),
        Function("ExactRay", "o:b p:3 d:3", out[:2] + [out[2] + " * 1e20", out[3] + " * 1e20"] + out[4:], exact,
                 lambda o, p, d: [x * 1e20 if k in (2, 3) else x for k, x in enumerate(flat(screenRayInView(o, p, d)))],
                 "View v = tableView(o, true);\nv.viewFromWorld = mat4(1.0);\nScreenRay r = makeScreenRay(v, p, d);", relative=1e-4, absolute=2e-5),
        Function("Constants", "x:1", ["kNever * x", "float(kMostMarchSteps) * x"], [[1]], lambda x: [1e30, 65534]),
    ], ["crossray/project/screen_ray.glsl"], kViews)
