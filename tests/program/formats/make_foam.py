"""Writes a ring of quads, one cell thick, as an OpenFOAM case, independently of the program.

    make_foam.py FOLDER STORAGE PLANE [COORDINATES]
    STORAGE      text, binary-32, binary-64, binary-single: how numbers are stored; 32 and 64: bits of labels
    PLANE        z, y: between coordinate planes; inclined; wedge: about the x axis; polygons: z, with the cells of the
                 innermost ring joined in pairs, which have six corners, and hanging nodes; interface: z, a rotor and a
                 stator that meet on one circle with different points
    COORDINATES  an SU2 file of the ring in the coordinates of the plane, from where x and y are taken
"""
import os
import struct
import sys
from math import cos, pi, sin

from ring import AROUND, OUTWARDS, read_su2

SLIDES_AT = 3
HEAD = """/*---- a test ----*\\
\\*----*/
FoamFile
{{
    version     2.0;
    format      {};
    arch        "LSB;label={};scalar={}";
    class       {};
    object      {};
}}
// * * * //

"""
PATCH = """    {}
    {{
        type            {};
        inGroups        1({});
        nFaces          {};
        startFace       {};
{}    }}
"""
SYSTEM = {
    "controlDict": "application simpleFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1;\n"
                   "deltaT 1; writeControl timeStep; writeInterval 1;\n",
    "fvSchemes": "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {}\n"
                 "snGradSchemes {}\n",
    "fvSolution": ""}

folder, storage, plane, *coordinates = sys.argv[1:]
is_text, slides = storage == "text", plane == "interface"
layer = AROUND * (OUTWARDS + (2 if slides else 1))  # points of one plane
if coordinates:
    at = read_su2(*coordinates, layer)
else:
    at = []
    for row in range(OUTWARDS + (2 if slides else 1)):
        is_stator = slides and row > SLIDES_AT
        for i in range(AROUND):
            r, angle = 4.0 ** ((row - is_stator) / OUTWARDS), 2 * pi * (i + (.6 if is_stator else .25)) / AROUND
            at.append((r * cos(angle), r * sin(angle) + (6 if plane == "wedge" else 0)))


def point(i, j):
    return j * AROUND + i % AROUND


def below(j):
    """The row of points below row j of cells: the circle of an interface has two rows."""
    return j + 1 if slides and j >= SLIDES_AT else j


def place(k):
    (a, b), up = at[k % layer], k // layer
    if plane == "y":
        return a, -.5 * up, b
    if plane == "inclined":  # turned about the y axis, which the library takes as its x
        return -cos(.5) * b + sin(.5) * up, a, sin(.5) * b + cos(.5) * up
    if plane == "wedge":
        turn = (up - .5) * 5 * pi / 180
        return a, b * cos(turn), b * sin(turn)
    return a, b, .5 * up


# The cells, each with the points of the front and those of the back; joined cells have one number.
cells, cell_of = [], {}
for j in range(OUTWARDS):
    width = 2 if plane == "polygons" and j == 0 else 1
    for i in range(0, AROUND, width):
        cell_of.update({(i + k, j): len(cells) for k in range(width)})
        front = [point(i + k, below(j)) for k in range(width + 1)] + \
            [point(i + k, below(j) + 1) for k in range(width, -1, -1)]
        cells.append((front, [k + layer for k in front]))


def middle(points):
    return [sum(place(k)[d] / len(points) for k in points) for d in range(3)]


def face(points, owner, neighbour=-1):
    """The normal points out of the owner; it is the sum of those of all corners, as one of them may be reflex."""
    normal, first = [0, 0, 0], place(points[0])
    for b, c in zip(points[1:], points[2:]):
        u, v = ([p - q for p, q in zip(place(k), first)] for k in (b, c))
        for d in range(3):
            normal[d] += u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3]
    outward = [p - q for p, q in zip(middle(points), middle(sum(cells[owner], [])))]
    if sum(p * q for p, q in zip(normal, outward)) < 0:
        points = points[:1] + points[:0:-1]
    return points, owner, neighbour


def side(a, b):
    return [a, b, b + layer, a + layer]


def circle(row, owner_row):
    return [face(side(point(i, row), point(i + 1, row)), cell_of[i, owner_row]) for i in range(AROUND)]


inner = []
for (i, j), cell in cell_of.items():
    across = [(point(i + 1, below(j)), point(i + 1, below(j) + 1), cell_of[(i + 1) % AROUND, j])]
    if j + 1 < OUTWARDS and not (slides and j + 1 == SLIDES_AT):
        across.append((point(i, j + 1), point(i + 1, j + 1), cell_of[i, j + 1]))
    inner += [face(side(a, b), min(cell, other), max(cell, other)) for a, b, other in across if cell != other]
inner.sort(key=lambda one: one[1:])
flat = [[face(cell[up], number) for number, cell in enumerate(cells)] for up in (0, 1)]
patches = [("body", "wall", circle(0, 0), ""),
           ("far", "patch", circle(below(OUTWARDS - 1) + 1, OUTWARDS - 1), "")]
for number in (1, 2) if slides else ():
    row = SLIDES_AT + number - 1
    patches.append((f"AMI{number}", "cyclicAMI", circle(row, row - 1),
                    "        matchTolerance  0.0001;\n        transform       noOrdering;\n"
                    f"        neighbourPatch  AMI{3 - number};\n"))
patches += [("front", "wedge", flat[0], ""), ("back", "wedge", flat[1], ""), ("axis", "empty", [], "")] \
    if plane == "wedge" else [("frontAndBack", "empty", flat[0] + flat[1], ""), ("defaultFaces", "empty", [], "")]
faces = inner + [one for patch in patches for one in patch[2]]


def write(name, kind, *contents):
    head = HEAD.format("ascii" if is_text else "binary", 64 if storage == "binary-64" else 32,
                       32 if storage == "binary-single" else 64, kind, name)
    with open(f"{folder}/constant/polyMesh/{name}", "wb") as file:
        for content in (head, *contents):
            file.write(content.encode() if isinstance(content, str) else content)


def labels(values):
    if is_text:
        return f"{len(values)}\n(\n" + "".join(f"{value}\n" for value in values) + ")\n"
    kind = "q" if storage == "binary-64" else "i"
    return f"{len(values)}\n(".encode() + struct.pack(f"<{len(values)}{kind}", *values) + b")\n"


os.makedirs(f"{folder}/constant/polyMesh", exist_ok=True)
os.makedirs(f"{folder}/system", exist_ok=True)
places = [place(k) for k in range(2 * layer)]
if is_text:
    body = "\n" + "".join("(%.17g %.17g %.17g)\n" % one for one in places)
else:
    body = b"".join(struct.pack("<3f" if storage == "binary-single" else "<3d", *one) for one in places)
write("points", "vectorField", f"{2 * layer}\n(", body, ")\n\n// * * * //\n")
write("owner", "labelList", labels([one[1] for one in faces]))
write("neighbour", "labelList", labels([one[2] for one in inner]))
if is_text:
    write("faces", "faceList", f"{len(faces)}\n(\n" + "".join(
        f"{len(points)}({' '.join(map(str, points))})\n" for points, _owner, _neighbour in faces) + ")\n")
else:
    start = [0]
    for one in faces:
        start.append(start[-1] + len(one[0]))
    write("faces", "faceCompactList", labels(start), labels([k for one in faces for k in one[0]]))
text, first = "", len(inner)
for name, kind, members, more in patches:
    text += PATCH.format(name, kind, kind, len(members), first, more)
    first += len(members)
write("boundary", "polyBoundaryMesh", f"{len(patches)}\n(\n{text})\n")
for name, entries in SYSTEM.items():
    with open(f"{folder}/system/{name}", "w", encoding="ascii") as file:
        file.write("FoamFile { version 2.0; format ascii; class dictionary; object " + name + "; }\n" + entries)
