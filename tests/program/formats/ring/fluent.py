"""The ring in Fluent files: faces with the cells beside them, numbers in hexadecimal, ends of lines CR LF; and in three
dimensions between the planes z = 0 and z = 1, where point p of the ring is p in the first plane and p + N_POINTS in the
second one."""
from . import AROUND, CELLS, N_CELLS, N_POINTS, OUTWARDS, Out, circle, point, quad, x, y


def hexadecimal(*values):
    return " ".join("%x" % value for value in values)


def cell(i, j, wide=1):
    return 0 if j < 0 or j >= OUTWARDS else j * (AROUND // wide) + i % AROUND // wide + 1


def fluent(tight=False, binary=False):
    """Tight: no blanks and ends of lines but those that separate numbers; the nodes in two sections, the second one
    first; no names of zones. Binary: nodes in double precision and faces in whole numbers of four bytes."""
    out, line, n_faces, done = Out(not binary), "" if tight else "\r\n", AROUND * (2 * OUTWARDS + 1), 0
    out.say('(0 "a comment (with one bracket")\r\n(2 2)\r\n')
    if not tight:
        out.say(f"(10 (0 1 a8 0 2))\r\n(12 (0 1 {hexadecimal(N_CELLS)} 0))\r\n(13 (0 1 {hexadecimal(n_faces)} 0))\r\n")

    def section(number, head, rows):
        """rows: tuples of a kind of `struct` and numbers"""
        if binary:
            number += 3000 if number == 10 else 2000
            out.say(f"({number} ({hexadecimal(*head)})\r\n(")
            for kind, values in rows:
                out.put(kind, *values)
            out.say(f")\r\nEnd of Binary Section   {number})\r\n")
            return
        text = "\r\n".join(" ".join("%.16e" % v for v in values) if kind == "d" else hexadecimal(*values)
                           for kind, values in rows)
        before = line if number == 10 else ""
        out.say(f"({number} ({hexadecimal(*head)}){before}({line}{text}{line}))\r\n")

    for first, last in [(100, N_POINTS), (0, 100)] if tight else [(0, N_POINTS)]:
        section(10, (1, first + 1, last, 1, 2), [("d", (x[k], y[k])) for k in range(first, last)])
    if not tight:
        out.say(f"(12 (2 1 {hexadecimal(N_CELLS)} 1 0)(3 3 3))\r\n")
    # A face goes from a to b; the cell on its right is the first one.
    inner = [(point(i + 1, j), point(i, j), cell(i, j), cell(i, j - 1)) for i, j in CELLS if j > 0]
    inner += [(point(i, j), point(i, j + 1), cell(i, j), cell(i - 1, j)) for i, j in CELLS]
    body = [(b, a, cell(i, 0), 0) for i, (a, b) in enumerate(circle(0))]
    far = [(a, b, cell(i, OUTWARDS - 1), 0) for i, (a, b) in enumerate(circle(OUTWARDS))]
    for zone, kind, mixed, faces in ((3, 2, False, inner), (16, 3, True, body), (4, 9, False, far)):
        rows = [("i", ((2,) if mixed else ()) + (a + 1, b + 1, right, left)) for a, b, right, left in faces]
        section(13, (zone, done + 1, done + len(faces), kind, 0 if mixed else 2), rows)
        done += len(faces)
    if not tight:
        out.say('(45 (2 fluid air)())\r\n(45 (3 interior int_air)())\r\n(39 (16 wall body 1)())\r\n(45 (4 '
                'pressure-far-field far)(\r\n(gauge-pressure . 0) (text . ")")))\r\n(64 (anything ()))\r\n')
    return out


def solid(real, wide=1):
    """real: "": text; f, d: binary. Polygons are two neighbouring cells of the ring (wide 2), with 6 corners."""
    out, done = Out(not real, whole=" %x", real="\n%.16e"), 0
    out.say("(2 3)\n")

    def section(number, head, kind, values):
        number += 0 if not real else 3000 if kind == "d" else 2000
        out.say(f"({number} ({hexadecimal(*head)})(")
        out.put(kind, *values)
        out.say((f")\nEnd of Binary Section   {number}" if real else ")") + ")\n")

    section(10, (1, 1, 2 * N_POINTS, 1, 3), real or "d", [v for z in (0., 1.) for a, b in zip(x, y) for v in (a, b, z)])
    out.say(f"(12 (2 1 {hexadecimal(N_CELLS // wide)} 1 0)(0))\n")

    def side(a, b):
        return a, b, b + N_POINTS, a + N_POINTS

    def plane(layer):
        for i, j in CELLS[::wide]:
            corners = [point(i + k, j) for k in range(wide + 1)] + [point(i + k, j + 1) for k in range(wide, -1, -1)]
            yield [p + layer for p in corners], cell(i, j, wide), 0

    inner = []
    for i, j in CELLS:
        if j > 0:
            inner.append((side(point(i, j), point(i + 1, j)), cell(i, j, wide), cell(i, j - 1, wide)))
        inner.append((side(point(i, j), point(i, j + 1)), cell(i - 1, j, wide), cell(i, j, wide)))
    inner = [face for face in inner if face[1] != face[2]]  # none inside a cell of two
    body, far = ([(side(a, b), cell(i, j - (j > 0), wide), 0) for i, (a, b) in enumerate(circle(j))]
                 for j in (0, OUTWARDS))
    polygons = 5 if wide > 1 else 4  # the number of nodes stands before each face where faces have the type 0 or 5
    for zone, kind, face_type, faces in ((3, 2, polygons, inner), (20, 7, polygons, list(plane(0))),
                                         (21, 7, polygons, list(plane(N_POINTS))), (16, 3, 0, body), (4, 9, 4, far)):
        values = [v for points, right, left in faces
                  for v in ([] if face_type == 4 else [len(points)]) + [p + 1 for p in points] + [right, left]]
        section(13, (zone, done + 1, done + len(faces), kind, face_type), "i", values)
        done += len(faces)
    out.say("(45 (16 wall body)())\n(45 (4 pressure-far-field far)())\n(45 (20 symmetry front)())\n"
            "(45 (21 symmetry back)())\n")
    return out


KINDS = {"fluent.msh": fluent, "fluent-binary.msh": lambda: fluent(binary=True),
         "fluent-tight.msh": lambda: fluent(True),
         "fluent-solid.msh": lambda: solid(""), "fluent-solid-single.msh": lambda: solid("f"),
         "fluent-solid-binary.msh": lambda: solid("d")}
