"""The ring in VTK files: legacy ones, whose binary numbers are big-endian, and XML."""
import zlib
from base64 import b64encode

from . import CELLS, N_CELLS, N_POINTS, Out, quad, x, y

CORNERS = [p for cell in CELLS for p in quad(*cell)]


def legacy(text, real, new_cells):
    out = Out(text, True, "%.10g ")
    out.say(f"# vtk DataFile Version {'5.1' if new_cells else '3.0'}\n\n{'ASCII' if text else 'BINARY'}\n"
            "DATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n")
    kind = {"float": "f", "double": "d"}[real]
    out.put(kind, .25)
    out.say(f"\nPOINTS {N_POINTS} {real}\n")
    for p, (a, b) in enumerate(zip(x, y)):
        out.put(kind, a, b, 0.)
        if p % 3 == 2 and text:
            out.say("\n")
    lines = 0 if new_cells else 1  # a line among the cells is passed over
    if new_cells:
        out.say("\nMETADATA\nINFORMATION 0\n")
    out.say(f"\nCELLS {N_CELLS + 1} {(4 if new_cells else 5) * N_CELLS + 3 * lines}\n")
    if new_cells:
        out.say("OFFSETS vtktypeint64\n")
        out.put("q", *range(0, 4 * N_CELLS + 1, 4))
        out.say("\nCONNECTIVITY vtktypeint64\n")
        out.put("q", *CORNERS)
    else:
        out.put("i", 2, 0, 1)
        for cell in CELLS:
            out.put("i", 4, *quad(*cell))
    out.say(f"\nCELL_TYPES {N_CELLS + lines}\n")
    out.put("i", *[3] * lines, *[9] * N_CELLS)
    out.say("\nCELL_DATA 1\nanything\n")
    return out


def stored(data):
    """A stream of zlib that stores the bytes as they are."""
    packer = zlib.compressobj(0)
    return packer.compress(data) + packer.flush()


def vtu(header, swapped=False, real="d", coding="raw"):
    """header: "I" or "Q", the kind of the lengths before arrays; "": all is text. coding: raw; in place or base64: in
    base64, the second one appended; packed, packed in place: compressed."""
    order = ("Big" if swapped else "Little") + "Endian"
    is_packed, is_in_place, appended = "packed" in coding, "in place" in coding, bytearray()
    out = Out()

    def array(kind, attributes, values):
        name = {"B": "UInt8", "i": "Int32", "q": "Int64", "f": "Float32", "d": "Float64"}[kind]
        out.say(f'<DataArray type="{name}" {attributes}')
        if not header:
            text = " ".join(("%.16g" if kind in "fd" else "%d") % value for value in values)
            out.say((">" if swapped else ' format="ascii">') + text + "</DataArray>\n")  # text is usual
            return
        data, head = Out(False, swapped), Out(False, swapped)
        data.put(kind, *values)
        if is_packed:
            blocks = [stored(bytes(data[k:k + 1000])) for k in range(0, len(data), 1000)]
            head.put(header, len(blocks), 1000, len(data) % 1000, *map(len, blocks))
            parts = [head, b"".join(blocks)]
        else:
            head.put(header, len(data))
            parts = [head + data]
        whole = b"".join(parts if coding in ("raw", "packed") else map(b64encode, parts))
        if is_in_place:
            out.say(' Format="binary">\n   ' + whole.decode() + "\n</DataArray>\n")
        else:
            out.say(f" format='appended'  offset=\"{len(appended)}\"/>\n")
            appended.extend(whole)

    whole = "q" if header == "Q" else "i"
    # VTK names a compressor in text, too.
    more = (' compressor="vtkZLibDataCompressor"' if is_packed or not header else "") + \
        (' header_type="UInt64"' if header == "Q" else "")
    out.say('<?xml version="1.0"?>\n<!-- a <comment> -->\n<VTKFile type="UnstructuredGrid" version="1.0" '
            f'byte_order="{order}"{more}>\n<UnstructuredGrid>\n<Piece NumberOfPoints="{N_POINTS}" '
            f'NumberOfCells="{N_CELLS}">\n<PointData>\n')
    array("B", 'Name="types"', [60] * N_POINTS)  # an array of the same name elsewhere, of the character <
    out.say("</PointData>\n<Points>\n")
    array(real, 'Name="xyz" NumberOfComponents="3"', [value for a, b in zip(x, y) for value in (a, b, 0.)])
    out.say("</Points>\n<Cells>\n")
    array(whole, 'Name="connectivity"', CORNERS)
    array(whole, 'Name="offsets"', range(4, 4 * N_CELLS + 1, 4))
    array("B", 'Name="types"', [9] * N_CELLS)
    out.say("</Cells>\n</Piece>\n</UnstructuredGrid>\n")
    if appended:
        out.say(f'<AppendedData encoding="{"base64" if coding == "base64" else "raw"}">\n _')
        out += appended
        out.say("\n</AppendedData>\n")
    out.say("</VTKFile>\n")
    return out


def format_of(kind):
    return "vtu" if kind.endswith(".vtu") else "vtk"


KINDS = {"text.vtk": lambda: legacy(True, "float", False), "text-5.vtk": lambda: legacy(True, "double", True),
         "binary.vtk": lambda: legacy(False, "double", True),
         "binary-single.vtk": lambda: legacy(False, "float", False),
         "in-place.vtu": lambda: vtu("I", coding="in place"),
         "in-place-single.vtu": lambda: vtu("Q", True, "f", "in place"),
         "base64.vtu": lambda: vtu("Q", coding="base64"), "packed.vtu": lambda: vtu("I", coding="packed"),
         "packed-in-place.vtu": lambda: vtu("Q", True, coding="packed in place"),
         "no-format.vtu": lambda: vtu("", True),
         "text.vtu": lambda: vtu(""), "appended-32.vtu": lambda: vtu("I"), "appended-64.vtu": lambda: vtu("Q"),
         "appended-single.vtu": lambda: vtu("I", real="f"), "appended-swapped.vtu": lambda: vtu("Q", True)}
