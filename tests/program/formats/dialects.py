# Writes meshes with the Python packages of gmsh, meshio and VTK, and reads points with meshio and VTK, for dialects.sh.
#   has PACKAGE | gmsh VERSION BINARY KIND FILE | meshio CODING FILE | vtk CODING FILE | points PACKAGE FILE
import sys


def ring(around=24, outwards=6):
    from math import cos, pi, sin
    points, cells = [], []
    for j in range(outwards + 1):
        for i in range(around):
            r, angle = 4.0 ** (j / outwards), 2 * pi * (i + .25) / around
            points.append((r * cos(angle), r * sin(angle), 0.0))
    for j in range(outwards):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            cells.append((a, b, b + around, a + around))
    return points, cells


def write_gmsh(version, binary, kind, path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.MshFileVersion", float(version))
    gmsh.option.setNumber("Mesh.Binary", int(binary))
    geo, points = gmsh.model.geo, []
    from math import cos, pi, sin
    n = 24 if kind == "lines" else 4
    inner = [geo.addPoint(cos(2 * pi * k / n), sin(2 * pi * k / n), 0, .4) for k in range(n)]
    centre = geo.addPoint(0, 0, 0)
    outer = [geo.addPoint(x, y, 0, 1.5) for x, y in ((-4, -4), (4, -4), (4, 4), (-4, 4))]
    if kind == "lines":
        body = [geo.addLine(inner[k], inner[(k + 1) % n]) for k in range(n)]
    else:
        body = [geo.addCircleArc(inner[k], centre, inner[(k + 1) % n]) for k in range(n)]
    far = [geo.addLine(outer[k], outer[(k + 1) % 4]) for k in range(4)]
    surface = geo.addPlaneSurface([geo.addCurveLoop(far), geo.addCurveLoop(body)])
    if kind == "thick":
        made = geo.extrude([(2, surface)], 0, 0, .5, [1], recombine=True)
        geo.synchronize()
        volume = [tag for dimension, tag in made if dimension == 3]
        sides = [tag for dimension, tag in made if dimension == 2]
        gmsh.model.addPhysicalGroup(2, [surface, sides[0]], 1)
        gmsh.model.setPhysicalName(2, 1, "frontAndBack")
        gmsh.model.addPhysicalGroup(2, sides[1:5], 2)
        gmsh.model.setPhysicalName(2, 2, "far")
        gmsh.model.addPhysicalGroup(2, sides[5:], 3)
        gmsh.model.setPhysicalName(2, 3, "body")
        gmsh.model.addPhysicalGroup(3, volume, 4)
    else:
        geo.synchronize()
    if kind == "groups":
        for number, name, curves in ((1, "body", body), (2, "far", far), (3, "upper", body[:2]), (4, "all", body + far)):
            gmsh.model.addPhysicalGroup(1, curves, number)
            gmsh.model.setPhysicalName(1, number, name)
        gmsh.model.addPhysicalGroup(2, [surface], 5)
    gmsh.model.mesh.generate(1 if kind == "curves" else 3 if kind == "thick" else 2)
    gmsh.write(path)


def write_meshio(coding, path):
    import meshio, numpy
    points, cells = ring()
    mesh = meshio.Mesh(numpy.array(points), [("quad", numpy.array(cells))])
    if coding == "ascii":
        mesh.write(path, binary=False)
    else:
        mesh.write(path, binary=True, compression=None if coding == "none" else coding)


def write_vtk(coding, path):
    import vtk
    points, cells = ring()
    grid, at = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
    at.SetDataTypeToDouble()
    for point in points: at.InsertNextPoint(point)
    grid.SetPoints(at)
    if coding == "second":   # cells of second order
        linear, middles = cells, {}
        def middle(a, b):
            if (min(a, b), max(a, b)) not in middles:
                middles[min(a, b), max(a, b)] = at.InsertNextPoint(*((points[a][d] + points[b][d]) / 2 for d in range(3)))
            return middles[min(a, b), max(a, b)]
        for a, b, c, d in linear:
            grid.InsertNextCell(vtk.VTK_QUADRATIC_QUAD, 8, (a, b, c, d, middle(a, b), middle(b, c), middle(c, d), middle(d, a)))
    elif coding == "thick":
        for x, y, z in points: at.InsertNextPoint(x, y, .5)
        n = len(points)
        for cell in cells: grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, (*cell, *(k + n for k in cell)))
    else:
        for cell in cells: grid.InsertNextCell(vtk.VTK_QUAD, 4, cell)
    if path.endswith(".vtk"):
        writer = vtk.vtkUnstructuredGridWriter()
    elif path.endswith(".pvtu"):   # in three pieces, each in a file of its own
        writer, producer, parts = vtk.vtkXMLPUnstructuredGridWriter(), vtk.vtkTrivialProducer(), \
            vtk.vtkExtractUnstructuredGridPiece()
        producer.SetOutput(grid)
        parts.SetInputConnection(producer.GetOutputPort())
        parts.SetCreateGhostCells(coding == "ghosts")
        writer.SetInputConnection(parts.GetOutputPort())
        writer.SetNumberOfPieces(3)
        writer.SetEndPiece(2)
        writer.SetGhostLevel(1 if coding == "ghosts" else 0)
    else:
        writer = vtk.vtkXMLUnstructuredGridWriter()
    if not path.endswith(".vtk"):
        mode, encoded, compressor = {"binary": ("Binary", 1, "None"), "binary-zlib": ("Binary", 1, "ZLib"),
            "appended": ("Appended", 1, "None"), "appended-zlib": ("Appended", 1, "ZLib"),
            "raw-zlib": ("Appended", 0, "ZLib"), "lz4": ("Appended", 0, "LZ4"),
            "second": ("Appended", 0, "ZLib"), "thick": ("Appended", 1, "None"), "ascii": ("Ascii", 0, "None"),
            "raw": ("Appended", 0, "None"), "raw-64": ("Appended", 0, "None"), "ghosts": ("Ascii", 0, "None")}[coding]
        getattr(writer, "SetDataModeTo" + mode)()
        writer.SetEncodeAppendedData(encoded)
        if coding == "raw-64": writer.SetHeaderTypeToUInt64()
        getattr(writer, "SetCompressorTypeTo" + compressor)()
        writer.SetBlockSize(1 << 15)
    if not path.endswith(".pvtu"): writer.SetInputData(grid)
    writer.SetFileName(path)
    writer.Write()


def print_points(package, path):
    if package == "meshio":
        import meshio
        points = meshio.read(path).points
    else:
        import vtk
        reader = vtk.vtkUnstructuredGridReader() if path.endswith(".vtk") else vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        grid = reader.GetOutput()
        used = set()   # VTK writes points into pieces that no cell of the piece has
        for c in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(c).GetPointIds()
            used.update(cell.GetId(k) for k in range(cell.GetNumberOfIds()))
        points = [grid.GetPoint(k) for k in sorted(used)]
    for point in points: print(repr(float(point[0])), repr(float(point[1])))


kind, *rest = sys.argv[1:]
if kind == "has": __import__(rest[0])
elif kind == "gmsh": write_gmsh(*rest)
elif kind == "meshio": write_meshio(*rest)
elif kind == "vtk": write_vtk(*rest)
else: print_points(*rest)
