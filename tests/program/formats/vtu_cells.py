"""VTU files of a ring, for tests of cells and of packed arrays.

vtu_cells.py cells TYPE NODES FILE      all cells of this type and number of nodes, in text
vtu_cells.py packed ARRAY EXTRA FILE    compressed by zlib, where ARRAY (Points, connectivity, offsets, types, field)
                                        has EXTRA bytes more than the points and cells need at most
"""

import base64
import math
import struct
import sys
import zlib

TRIANGLES = (5, 22, 34, 69)
AROUND, ALONG = 24, 5


def corner(i, j):
    angle, radius = 2 * math.pi * (i % AROUND) / AROUND, 1.3 ** j
    return radius * math.cos(angle), radius * math.sin(angle)


class Ring:
    def __init__(self, kind, nodes):
        self.numbers, self.points, self.cells = {}, [], []
        self.is_triangle, self.nodes = kind in TRIANGLES, nodes
        for j in range(ALONG):
            for i in range(AROUND):
                a, b, c, d = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                for corners in ((a, b, c), (a, c, d)) if self.is_triangle else ((a, b, c, d),):
                    self.add(corners)

    def node(self, corners):
        """The node in the middle of these corners; middles are moved a little from the straight edge."""
        names = frozenset((i % AROUND, j) for i, j in corners)
        if names not in self.numbers:
            x, y = (sum(v) / len(corners) for v in zip(*(corner(*one) for one in corners)))
            bulge = 1 if len(corners) == 1 else 1.01
            self.numbers[names] = len(self.points)
            self.points.append((bulge * x, bulge * y, 0.0))
        return self.numbers[names]

    def add(self, corners):
        n = len(corners)
        cell = [self.node([one]) for one in corners]
        if self.nodes >= 2 * n:
            cell += [self.node([corners[k], corners[(k + 1) % n]]) for k in range(n)]
        if self.nodes == 2 * n + 1:
            cell.append(self.node(corners))
        self.cells.append(cell)


def write(path, ring, kind, array, attributes=""):
    flat = [number for cell in ring.cells for number in cell]
    ends = [ring.nodes * (k + 1) for k in range(len(ring.cells))]
    with open(path, "w") as out:
        out.write(f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt64"{attributes}>\n'
                  f'<UnstructuredGrid><Piece NumberOfPoints="{len(ring.points)}" NumberOfCells="{len(ring.cells)}">\n'
                  f'<PointData>{array("field", "Float64", [x + 2 * y for x, y, _ in ring.points])}</PointData>\n'
                  f'<Points>{array("Points", "Float64", [v for point in ring.points for v in point], 3)}</Points>\n'
                  f'<Cells>{array("connectivity", "Int32", flat)}\n{array("offsets", "Int32", ends)}\n'
                  f'{array("types", "UInt8", [kind] * len(ends))}</Cells>\n</Piece></UnstructuredGrid></VTKFile>\n')


def tag(name, kind, components, form, text):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="{form}">{text}'
            '</DataArray>')


def in_text(name, kind, values, components=1):
    return tag(name, kind, components, "ascii", " ".join(map(repr, values)))


def main(what, *rest):
    if what == "cells":
        kind, nodes, path = int(rest[0]), int(rest[1]), rest[2]
        write(path, Ring(kind, nodes), kind, in_text)
        return
    longer, extra, path = rest[0], int(rest[1]), rest[2]
    ring = Ring(9, 4)
    # What an array needs at most, where connectivity is bounded by cells of 27 points, and by polygons of a plane.
    most = {"connectivity": 4 * (27 * len(ring.cells) + 6 * len(ring.points))}

    def packed(name, kind, values, components=1):
        letter = {"Float64": "d", "Int32": "i", "UInt8": "B"}[kind]
        data = struct.pack(f"<{len(values)}{letter}", *values)
        if name == longer:
            data += bytes(max(most.get(name, 0) - len(data), 0) + extra)
        blocks = [zlib.compress(data[k:k + 2 ** 24], 9) for k in range(0, len(data), 2 ** 24)]
        head = struct.pack("<3Q", len(blocks), 2 ** 24, len(data) % 2 ** 24)
        head += struct.pack(f"<{len(blocks)}Q", *map(len, blocks))
        text = base64.b64encode(head) + base64.b64encode(b"".join(blocks))
        return tag(name, kind, components, "binary", text.decode())

    write(path, ring, 9, packed, ' compressor="vtkZLibDataCompressor"')


main(*sys.argv[1:])
