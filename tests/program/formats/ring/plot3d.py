"""The ring as PLOT3D grids of one or two blocks."""
from . import AROUND, OUTWARDS, Out, point, x, y


def plot3d(count=False, iblank=False, text=False, record=0, real="d", swapped=False, across="-", blocks=1):
    """record: bytes of the lengths of records; across: "-" for two dimensions, "j" or "k" for the index across, where
    the planes are y = constant and z = constant."""
    out, in_line = Out(text, swapped, whole=" %d"), 0
    ni, nj, layers = AROUND // blocks + 1, OUTWARDS + 1, 1 if across == "-" else 2
    middle, last = (2, nj) if across == "j" else (nj, layers)

    def write(*lists):
        nonlocal in_line
        n_bytes = sum(len(values) * (4 if kind in "if" else 8) for kind, values in lists)
        length = {0: "", 4: "i", 8: "q"}[record]
        if length:
            out.put(length, n_bytes)
        for kind, values in lists:
            if text and kind == "d":
                for value in values:
                    in_line += 1
                    out.say(" %.15E" % value + ("\n" if in_line % 4 == 0 else ""))
            else:
                out.put(kind, *values)
        if length:
            out.put(length, n_bytes)
        if text:
            out.say("\n")

    if count:
        write(("i", [blocks]))
    write(("i", ([ni, middle] + ([last] if across != "-" else [])) * blocks))
    for block in range(blocks):
        places = [(point(i + block * (ni - 1), k if across == "j" else j), j if across == "j" else k)
                  for k in range(last) for j in range(middle) for i in range(ni)]
        up = [-.5 * layer for _, layer in places]
        columns = [[x[p] for p, _ in places], [y[p] for p, _ in places]]
        if across != "-":
            columns.insert(1 if across == "j" else 2, up)
        write(*((real, column) for column in columns), *([("i", [1] * len(places))] if iblank else []))
    return out


TABLE = {"text.p3d": dict(text=True), "two-text-iblank.p3d": dict(count=True, iblank=True, text=True, blocks=2),
         "text-k.p3d": dict(count=True, text=True, across="k"), "stream.p3d": dict(count=True),
         "stream-single.p3d": dict(iblank=True, real="f", swapped=True, across="j"),
         "two-stream-swapped.p3d": dict(count=True, iblank=True, swapped=True, across="k", blocks=2),
         "two-fortran.p3d": dict(count=True, record=4, across="j", blocks=2),
         "fortran-swapped.p3d": dict(iblank=True, record=4, swapped=True),
         "fortran-8.p3d": dict(count=True, iblank=True, record=8, across="k"),
         "two-fortran-8-single.p3d": dict(count=True, record=8, real="f", swapped=True, blocks=2)}
KINDS = {name: lambda how=how: plot3d(**how) for name, how in TABLE.items()}
