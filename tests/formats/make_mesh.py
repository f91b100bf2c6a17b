"""Writes one and the same ring of quads in many kinds of files, independently of the program. After the program has
read a file and written the ring with other coordinates, the result must be, byte for byte, the file that is written
here with those coordinates.

    make_mesh.py KIND FILE [COORDINATES]   COORDINATES: an SU2 file of the ring, from which x and y are taken
    make_mesh.py list                      all kinds
"""
import sys

import ring
from ring import fluent, gmsh, plot3d, su2, ugrid, vtk

kinds = {name: write for family in (su2, gmsh, plot3d, ugrid, vtk, fluent) for name, write in family.KINDS.items()}
if sys.argv[1:] == ["list"]:
    print("\n".join(sorted(kinds)))
    sys.exit()
kinds["fluent-polygons.msh"] = lambda: fluent.solid("", 2)  # convert cannot write these cells
kind, path, *coordinates = sys.argv[1:]
if coordinates:
    ring.read_coordinates(*coordinates)
else:
    ring.make_coordinates()
content = kinds[kind]()
with open(path, "wb") as file:
    file.write(content.encode() if isinstance(content, str) else content)
