"""Writes one and the same ring of quads in many kinds of files, independently of the program. After the program has
read a file and written the ring with other coordinates, the result must be, byte for byte, the file that is written
here with those coordinates.

    make_mesh.py KIND FILE [COORDINATES]   COORDINATES: an SU2 file of the ring, from which x and y are taken
    make_mesh.py list                      all kinds
    make_mesh.py format KIND               the name of its format for --format

Each file of the folder ring has the kinds of the format of its name, or of the format that its format_of() says.
"""
import importlib
import pkgutil
import sys

import ring

families = {name: importlib.import_module(f"ring.{name}") for _, name, _ in pkgutil.iter_modules(ring.__path__)}
kinds = {kind: write for family in families.values() for kind, write in family.KINDS.items()}
if sys.argv[1:] == ["list"]:
    print("\n".join(sorted(kinds)))
    sys.exit()
if sys.argv[1] == "format":
    name, family = next((name, family) for name, family in families.items() if sys.argv[2] in family.KINDS)
    print(family.format_of(sys.argv[2]) if hasattr(family, "format_of") else name)
    sys.exit()
kinds["fluent-polygons.msh"] = lambda: families["fluent"].solid("", 2)  # convert cannot write these cells
kind, path, *coordinates = sys.argv[1:]
if coordinates:
    ring.read_coordinates(*coordinates)
else:
    ring.make_coordinates()
content = kinds[kind]()
with open(path, "wb") as file:
    file.write(content.encode() if isinstance(content, str) else content)
