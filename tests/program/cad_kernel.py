# usage: cad_kernel.py CURVE FILE   Opens FILE (IGES or STEP) by OpenCASCADE, as gmsh has it, and compares points on its
# curves with those of CURVE, the program's own text of the same curves, which is evaluated here from the definition of
# B-splines: point(u) = sum of w_i N_i(u) P_i over sum of w_i N_i(u).
import sys

import gmsh


def read_curves(path):
    lines = [line.split("#")[0].split() for line in open(path)]
    words = [word for line in lines for word in line]
    take = iter(words)
    points, weights, curves = [], None, []
    for word in take:
        if word == "points":
            points = [(float(next(take)), float(next(take))) for _ in range(int(next(take)))]
        elif word == "weights":
            weights = [float(next(take)) for _ in range(int(next(take)))]
        elif word in ("degree", "closed"):
            if word == "degree" and (not curves or "degree" in curves[-1]):
                curves.append({})
            if not curves:
                curves.append({})
            curves[-1][word] = next(take)
        elif word in ("knots", "indices"):
            curves[-1][word] = [float(next(take)) for _ in range(int(next(take)))]
    for curve in curves:
        degree = int(curve["degree"])
        used = list(range(len(points)))
        used += {"periodic": used[:degree], "tied": used[:1], "open": []}[curve["closed"]]
        if "indices" in curve:
            used = [int(i) - 1 for i in curve["indices"]]
        curve["degree"] = degree
        curve["control"] = [points[i] + ((weights[i] if weights else 1.0),) for i in used]
    return curves


def basis(knots, degree, i, u):
    if degree == 0:
        last = u == knots[-1] and knots[i] < knots[i + 1] == u
        return 1.0 if knots[i] <= u < knots[i + 1] or last else 0.0
    value = 0.0
    if knots[i + degree] > knots[i]:
        value += (u - knots[i]) / (knots[i + degree] - knots[i]) * basis(knots, degree - 1, i, u)
    if knots[i + degree + 1] > knots[i + 1]:
        value += ((knots[i + degree + 1] - u) / (knots[i + degree + 1] - knots[i + 1])
                  * basis(knots, degree - 1, i + 1, u))
    return value


def point(curve, u):
    x = y = w = 0.0
    for i, (px, py, pw) in enumerate(curve["control"]):
        n = pw * basis(curve["knots"], curve["degree"], i, u)
        x, y, w = x + n * px, y + n * py, w + n
    return x / w, y / w


curves = read_curves(sys.argv[1])
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
edges = gmsh.model.occ.importShapes(sys.argv[2])
gmsh.model.occ.synchronize()
edges = [tag for dimension, tag in gmsh.model.getEntities(1)]
size = max(abs(c) for curve in curves for p in curve["control"] for c in p[:2])
metre = 1000.0  # OpenCASCADE computes in millimetres, and the files say metres
worst = 0.0
for curve in curves:
    # OpenCASCADE divides curves at corners: the pieces follow each other and keep their parameters.
    first, last = curve["knots"][curve["degree"]], curve["knots"][-1 - curve["degree"]]
    begin = first
    while begin < last:
        if not edges:
            sys.exit("the curve ends at %g, and not at %g" % (begin, last))
        edge = edges.pop(0)
        low, high = (bound[0] for bound in gmsh.model.getParametrizationBounds(1, edge))
        if abs(low - begin) > 1e-12 * (last - first):
            sys.exit("parameters from %g to %g, and not from %g on" % (low, high, begin))
        for k in range(41):
            u = low + (high - low) * (k + .37) / 41.4
            x, y, z = (c / metre for c in gmsh.model.getValue(1, edge, [u]))
            wanted = point(curve, u)
            worst = max(worst, abs(x - wanted[0]), abs(y - wanted[1]), abs(z))
        begin = high if high < last - 1e-12 * (last - first) else last
if edges:
    sys.exit("%d more curves than there should be" % len(edges))
gmsh.finalize()
print("largest distance", worst / size)
if not worst < 1e-13 * size:
    sys.exit(1)
