# Meshes one cell thick with elements of second order, written by gmsh, by VTK, and as text without a package; and the
# law by which a morph moves their nodes.
#   gmsh VERSION BINARY prisms|hexahedra complete|incomplete planes|wedge FILE
#   vtk TYPE FILE        TYPE: a type of cells of VTK
#   text 25|26 FILE      quadratic hexahedra or wedges of VTK's legacy format
#   law gmsh|vtk|text planes|wedge BEFORE AFTER
# The law: in the plane, the middle of an edge keeps its place relative to the edge, and the middle of more corners moves
# by their mean; nodes do not leave their layer. The corners of each node come from gmsh and VTK themselves, or from TEXT_CELLS.
import itertools
import sys
from math import cos, hypot, pi, sin


def write_gmsh(version, binary, cells, nodes, kind, path):
    import gmsh
    gmsh.initialize()
    for name, value in (("General.Terminal", 0), ("Mesh.MshFileVersion", float(version)), ("Mesh.Binary", int(binary)),
                        ("Mesh.ElementOrder", 2), ("Mesh.SecondOrderIncomplete", int(nodes == "incomplete"))):
        gmsh.option.setNumber(name, value)
    geo, y = gmsh.model.geo, 6 if kind == "wedge" else 0
    inner = [geo.addPoint(cos(pi * k / 2), y + sin(pi * k / 2), 0, .4) for k in range(4)]
    centre = geo.addPoint(0, y, 0)
    outer = [geo.addPoint(a, y + b, 0, 1.5) for a, b in ((-4, -4), (4, -4), (4, 4), (-4, 4))]
    body = [geo.addCircleArc(inner[k], centre, inner[(k + 1) % 4]) for k in range(4)]
    far = [geo.addLine(outer[k], outer[(k + 1) % 4]) for k in range(4)]
    surface = geo.addPlaneSurface([geo.addCurveLoop(far), geo.addCurveLoop(body)])
    if cells == "hexahedra": geo.mesh.setRecombine(2, surface)
    if kind == "wedge": made = geo.revolve([(2, surface)], 0, 0, 0, 1, 0, 0, pi / 36, [1], recombine=True)
    else: made = geo.extrude([(2, surface)], 0, 0, .5, [1], recombine=True)
    geo.synchronize()
    sides = [tag for dimension, tag in made if dimension == 2]
    for number, name, surfaces in ((1, "frontAndBack", [surface, sides[0]]), (2, "far", sides[1:5]),
                                   (3, "body", sides[5:])):
        gmsh.model.addPhysicalGroup(2, surfaces, number)
        gmsh.model.setPhysicalName(2, number, name)
    gmsh.model.addPhysicalGroup(3, [tag for dimension, tag in made if dimension == 3], 4)
    gmsh.model.mesh.generate(3)
    gmsh.write(path)


# The corners of a quadratic hexahedron and a quadratic wedge of VTK, and the edges whose middles the other nodes are.
TEXT_CELLS = {
    25: ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
         [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]),
    26: ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
         [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)])}


# A ring of cells whose nodes have these parametric places; lines between the nodes are bent.
def ring(places, is_triangle):
    at, numbers, cells = [], {}, []
    around, outwards = 12, 4
    def node(i, j, k):
        key = (round(i * 12) % (12 * around), round(j * 12), round(k * 12))
        if key not in numbers:
            angle = 2 * pi * (key[0] / 12 + .25) / around
            r = 4.0 ** ((key[1] / 12 + .1 * sin(3 * angle) * j * (outwards - j) / 4) / outwards)
            numbers[key] = len(at)
            at.append((r * cos(angle), r * sin(angle), .5 * key[2] / 12))
        return numbers[key]
    for j in range(outwards):
        for i in range(around):
            turns = [lambda a, b: (i + a, j + b), lambda a, b: (i + 1 - a, j + 1 - b)]
            for turn in turns if is_triangle else turns[:1]:
                cells.append([node(*turn(a, b), c) for a, b, c in places])
    return at, cells


# Cells of any type of VTK whose corners are those of a hexahedron, a wedge, a quadrilateral or a triangle.
def write_vtk(kind, path):
    import vtk
    cell = vtk.vtkGenericCell.InstantiateCell(int(kind))
    where = cell.GetParametricCoords()
    places = [tuple(where[3 * k + d] for d in range(3)) for k in range(cell.GetNumberOfPoints())]
    at, cells = ring(places, "Wedge" in cell.GetClassName() or "Triangle" in cell.GetClassName())
    points, grid = vtk.vtkPoints(), vtk.vtkUnstructuredGrid()
    points.SetDataTypeToDouble()
    for place in at: points.InsertNextPoint(place)
    for nodes in cells: grid.InsertNextCell(int(kind), len(nodes), nodes)
    grid.SetPoints(points)
    writer = vtk.vtkUnstructuredGridWriter() if path.endswith(".vtk") else vtk.vtkXMLUnstructuredGridWriter()
    if path.endswith(".vtk"): writer.SetFileTypeToBinary()   # the text has 11 digits only
    writer.SetInputData(grid)
    writer.SetFileName(path)
    writer.Write()


def write_text(kind, path):
    corners, edges = TEXT_CELLS[int(kind)]
    at, cells = ring(corners + [tuple((a + b) / 2 for a, b in zip(corners[i], corners[j])) for i, j in edges],
                     len(corners) == 6)
    with open(path, "w", encoding="ascii") as file:
        print("# vtk DataFile Version 3.0\nring\nASCII\nDATASET UNSTRUCTURED_GRID", file=file)
        print("POINTS", len(at), "double", file=file)
        for place in at: print(*map(repr, place), file=file)
        print("CELLS", len(cells), sum(len(nodes) + 1 for nodes in cells), file=file)
        for nodes in cells: print(len(nodes), *nodes, file=file)
        print("CELL_TYPES", len(cells), file=file)
        for _ in cells: print(kind, file=file)


# For the parametric places of the nodes of an element: the corners of which each other node is the middle. Both
# diagonals of a quadrilateral have one middle, which is that of all four corners.
def middles(places, n_corners):
    found = []
    for node in range(n_corners, len(places)):
        corners_of_node = set()
        for size in (2, 3):
            for corners in itertools.combinations(range(n_corners), size):
                mean = [sum(places[c][d] for c in corners) / size for d in range(len(places[0]))]
                if all(abs(a - b) < 1e-3 for a, b in zip(mean, places[node])):
                    corners_of_node.update(corners)
            if corners_of_node: break
        found.append((node, sorted(corners_of_node)))
    return found


def read_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    tags, x, _ = gmsh.model.mesh.getNodes()
    points = {int(tag): tuple(x[3 * k:3 * k + 3]) for k, tag in enumerate(tags)}
    found = {}
    for kind, _, nodes in zip(*gmsh.model.mesh.getElements(3)):
        _, dimension, _, count, where, n_corners = gmsh.model.mesh.getElementProperties(kind)
        table = middles([where[dimension * k:dimension * (k + 1)] for k in range(count)], n_corners)
        for first in range(0, len(nodes), count):
            for node, corners in table:
                found[int(nodes[first + node])] = [int(nodes[first + c]) for c in corners]
    gmsh.finalize()
    return points, found


def read_vtk(path):
    import vtk
    reader = vtk.vtkUnstructuredGridReader() if path.endswith(".vtk") else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    found, table = {}, None
    for number in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(number)
        if table is None:
            where = cell.GetParametricCoords()
            places = [tuple(where[3 * k + d] for d in range(3)) for k in range(cell.GetNumberOfPoints())]
            table = middles(places, sum(all(v in (0, 1) for v in place) for place in places))
        for node, corners in table: found[cell.GetPointId(node)] = [cell.GetPointId(c) for c in corners]
    return {k: grid.GetPoint(k) for k in range(grid.GetNumberOfPoints())}, found


def read_text(path):
    with open(path, encoding="ascii") as file: words = file.read().split()
    start, cell, found = words.index("POINTS") + 3, words.index("CELLS") + 3, {}
    at = list(map(float, words[start:start + 3 * int(words[start - 2])]))
    for _ in range(int(words[cell - 2])):
        nodes = list(map(int, words[cell + 1:cell + 1 + int(words[cell])]))
        cell += 1 + len(nodes)
        corners, edges = TEXT_CELLS[25 if len(nodes) == 20 else 26]
        for node, edge in zip(nodes[len(corners):], edges): found[node] = sorted(nodes[c] for c in edge)
    return {k: tuple(at[3 * k:3 * k + 3]) for k in range(len(at) // 3)}, found


def check_law(package, kind, before, after):
    read = {"gmsh": read_gmsh, "vtk": read_vtk, "text": read_text}[package]
    (old, corners_of), (new, same) = read(before), read(after)
    assert corners_of and corners_of == same and old.keys() == new.keys()
    plane = (lambda p: complex(p[0], hypot(p[1], p[2]))) if kind == "wedge" else (lambda p: complex(p[0], p[1]))
    layer = (lambda p: p[2] / p[1]) if kind == "wedge" else (lambda p: p[2])
    moved = worst = 0
    for node, corners in corners_of.items():
        was, now = {}, []
        for c in corners:   # one corner for each place in the plane
            key = (round(plane(old[c]).real, 6), round(plane(old[c]).imag, 6))
            if key not in was:
                was[key] = plane(old[c])
                now.append(plane(new[c]))
        was, here, there = list(was.values()), plane(old[node]), plane(new[node])
        mean = sum(now) / len(now) - sum(was) / len(was)
        if len(was) == 2:
            wanted = sum(now) / 2 + (here - sum(was) / 2) * (now[1] - now[0]) / (was[1] - was[0])
        elif len(was) == 1 and kind == "wedge":
            wanted = complex((here + mean).real, here.imag * now[0].imag / was[0].imag)
        else:
            wanted = here + mean
        worst = max(worst, abs(there - wanted), abs(layer(new[node]) - layer(old[node])))
        moved = max(moved, abs(there - here))
    print("%d nodes, %g moved, %g off" % (len(corners_of), moved, worst))
    assert moved > .05 and worst < 1e-11


what, *rest = sys.argv[1:]
{"gmsh": write_gmsh, "vtk": write_vtk, "text": write_text, "law": check_law}[what](*rest)
