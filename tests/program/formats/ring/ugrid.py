"""The ring in UGRID files, between the planes y = 0 and y = 1. Point p of the ring is 2 p + 2 in the first plane and
2 p + 1 in the second one."""
from . import AROUND, CELLS, N_CELLS, N_POINTS, OUTWARDS, Out, circle, quad, x, y


def ugrid(text=False, swapped=False, real="d", split=False):
    out = Out(text, swapped, "%.16e ")

    def item(*values):
        out.put("i", *values)
        out.line()

    def low(cell):
        return [2 * p + 2 for p in quad(*cell)]

    def high(cell):
        return [2 * p + 1 for p in quad(*cell)]

    n = N_CELLS
    item(2 * N_POINTS, 4 * n if split else 0, 2 * AROUND + (0 if split else 2 * n), 0, 0, 2 * n if split else 0,
         0 if split else n)
    for a, b in zip(x, y):
        for layer in (1, 0):
            out.put(real, a, layer, b)
            out.line()
    parts = ((0, 1, 2), (0, 2, 3)) if split else [range(4)]
    planes = [[at(cell)[k] for k in part] for at in (low, high) for cell in CELLS for part in parts]
    walls = [(2 * a + 2, 2 * a + 1, 2 * b + 1, 2 * b + 2) for j in (0, OUTWARDS) for a, b in circle(j)]
    for corners in planes + walls if split else walls + planes:
        item(*corners)
    body, sides = [1] * AROUND + [2] * AROUND, [3] * (len(planes) // 2) + [4] * (len(planes) // 2)
    for tag in sides + body if split else body + sides:
        item(tag)
    for cell in CELLS:
        a, b = low(cell), high(cell)
        if split:
            item(a[0], a[1], a[2], b[0], b[1], b[2])
            item(b[0], b[2], b[3], a[0], a[2], a[3])
        elif cell[0] % 3 == 0:  # a side of the plane at the bottom, in front, at the left
            item(*a, *b)
        elif cell[0] % 3 == 1:
            item(b[0], b[1], a[1], a[0], b[3], b[2], a[2], a[3])
        else:
            item(a[0], b[0], b[1], a[1], a[3], b[3], b[2], a[2])
    return out


KINDS = {"text.ugrid": lambda: ugrid(text=True), "prisms.lb8.ugrid": lambda: ugrid(split=True),
         "hexahedra.b8.ugrid": lambda: ugrid(swapped=True), "single.lb4.ugrid": lambda: ugrid(real="f")}
