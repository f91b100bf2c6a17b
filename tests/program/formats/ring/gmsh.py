"""The ring in Gmsh files of versions 2.2 and 4.1. Nodes are numbered 10, 12, 14, ... as numbers may have gaps."""
from . import AROUND, CELLS, N_CELLS, N_POINTS, OUTWARDS, Out, circle, quad, x, y

NAMES = '$PhysicalNames\n3\n1 1 "body"\n1 2 "far"\n2 3 "fluid, all of it"\n$EndPhysicalNames\n'
THICK_NAMES = '$PhysicalNames\n4\n2 1 "body"\n2 2 "far"\n2 4 "frontAndBack"\n3 3 "fluid"\n$EndPhysicalNames\n'


def begin(version, is_text, swapped, names):
    out = Out(is_text, swapped)
    out.say(f"$MeshFormat\n{version} {int(not is_text)} 8\n")
    if not is_text:
        out.put("i", 1)
    out.end("$EndMeshFormat\n" + names)
    return out


def tags(points):
    return [10 + 2 * p for p in points]


def write_2(nodes, elements, is_text=True, swapped=False, names=NAMES, version="2.2", entity=7):
    """nodes: tags with coordinates; elements: type, physical group, tags of nodes."""
    out = begin(version, is_text, swapped, names)
    out.say(f"$Nodes\n{len(nodes)}\n")
    for number, at in nodes:
        out.put("i", number)
        out.put("d", *at)
        out.line()
    out.end(f"$EndNodes\n$Elements\n{len(elements)}\n")
    for number, (kind, group, corners) in enumerate(elements, 1):
        out.put("i", *((number, kind, 2) if is_text else (kind, 1, 2, number)), group, entity, *corners)
        out.line()
    out.end("$EndElements\n")
    return out


def plane(**how):
    nodes = [(10 + 2 * k, (x[k], y[k], 0)) for k in range(N_POINTS)]
    elements = [(1, 1, tags(side)) for side in circle(0)] + [(1, 2, tags(side)) for side in circle(OUTWARDS)] + \
        [(3, 3, tags(quad(*cell))) for cell in CELLS]
    return write_2(nodes, elements, **how) + b'$NodeData\n1\n"anything"\n1\n0\n$EndNodeData\n'


def with_comments():
    """As Pointwise writes version 2, with comments first and names behind the elements."""
    return b"$Comments\nwritten by a test, $ and all\n$EndComments\n" + plane(names="", version="2.0") + NAMES.encode()


def quadratic():
    """Quads of eight nodes; the middle of an edge is off the straight edge by (.01, .02) times length and normal."""
    nodes, found = [(k + 1, (x[k], y[k], 0)) for k in range(N_POINTS)], {}

    def middle(a, b):
        p, q = sorted((a, b))
        if (p, q) not in found:
            dx, dy = x[q] - x[p], y[q] - y[p]
            found[p, q] = len(nodes) + 1
            nodes.append((found[p, q], ((x[p] + x[q]) / 2 + .01 * dx - .02 * dy,
                                        (y[p] + y[q]) / 2 + .01 * dy + .02 * dx, 0)))
        return found[p, q]

    elements = [(8, group, (a + 1, b + 1, middle(a, b))) for group, j in ((1, 0), (2, OUTWARDS)) for a, b in circle(j)]
    for cell in CELLS:
        c = quad(*cell)
        elements.append((16, 3, [p + 1 for p in c] + [middle(c[k], c[(k + 1) % 4]) for k in range(4)]))
    return write_2(nodes, elements, entity=1)


def thick(is_text):
    """Hexahedra between z = 0 and z = .5, as gmshToFoam takes them."""
    nodes = [(k + 1, (x[k % N_POINTS], y[k % N_POINTS], .5 * (k // N_POINTS))) for k in range(2 * N_POINTS)]
    elements = [(3, group, (a + 1, b + 1, b + 1 + N_POINTS, a + 1 + N_POINTS))
                for group, j in ((1, 0), (2, OUTWARDS)) for a, b in circle(j)]
    for cell in CELLS:
        low = [p + 1 for p in quad(*cell)]
        high = [p + N_POINTS for p in low]
        elements += [(3, 4, [low[0], low[3], low[2], low[1]]), (3, 4, high), (5, 3, low + high)]
    return write_2(nodes, elements, is_text, names=THICK_NAMES)


def gmsh_4(is_text, swapped=False):
    out = begin("4.1", is_text, swapped, NAMES)

    def row(*pairs):
        for kind, values in pairs:
            out.put(kind, *values)
        out.line()

    out.say("$Entities\n")
    row(("Q", (0, 2, 1, 0)))
    box = ("d", (-4, -4, -4, 4, 4, 4))
    for curve in (4, 5):
        row(("i", (curve,)), box, ("Q", (1,)), ("i", (curve - 3,)), ("Q", (0,)))
    row(("i", (6,)), box, ("Q", (1,)), ("i", (3,)), ("Q", (2,)), ("i", (4, -5)))
    out.end("$EndEntities\n$Nodes\n")
    row(("Q", (2, N_POINTS, 10, 10 + 2 * (N_POINTS - 1))))
    for is_curve, points in ((True, range(AROUND)), (False, range(AROUND, N_POINTS))):  # a curve has parameters
        row(("i", (1, 4, 1) if is_curve else (2, 6, 0)), ("Q", (len(points),)))
        for k in points:
            row(("Q", (10 + 2 * k,)))
        for k in points:
            row(("d", (x[k], y[k], 0) + ((.125 * k,) if is_curve else ())))
    out.end("$EndNodes\n$Elements\n")
    total = N_CELLS + 2 * AROUND
    row(("Q", (3, total, 1, total)))
    number = 0
    for entity, items in (((1, 4, 1), circle(0)), ((1, 5, 1), circle(OUTWARDS)),
                          ((2, 6, 3), [quad(*cell) for cell in CELLS])):
        row(("i", entity), ("Q", (len(items),)))
        for points in items:
            number += 1
            row(("Q", (number, *tags(points))))
    out.end("$EndElements\n")
    return out


KINDS = {"comments-2.msh": with_comments, "thick-2.msh": lambda: thick(True),
         "thick-binary-2.msh": lambda: thick(False), "text-2.msh": plane, "binary-2.msh": lambda: plane(is_text=False),
         "swapped-2.msh": lambda: plane(is_text=False, swapped=True), "text-4.msh": lambda: gmsh_4(True),
         "binary-4.msh": lambda: gmsh_4(False), "swapped-4.msh": lambda: gmsh_4(False, True),
         "quadratic.msh": quadratic}
