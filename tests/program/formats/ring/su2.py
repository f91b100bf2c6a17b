"""The ring in SU2 files: plain, with numbers in several formats, with comments and unusual blanks, and in zones."""
from . import AROUND, CELLS, N_CELLS, OUTWARDS, circle, quad, x, y


def fortran(value):
    """D17.9 of Fortran: 0.123456789D+01."""
    exponent = 0
    while abs(value) >= 1:
        value, exponent = value / 10, exponent + 1
    while value != 0 and abs(value) < .1:
        value, exponent = value * 10, exponent - 1
    return "%.9fD%+03d" % (value, exponent)


def cells(blank=" "):
    return f"NELEM= {N_CELLS}\n" + "".join(
        blank.join(map(str, (9, *quad(*cell), n))) + "\n" for n, cell in enumerate(CELLS))


def points(number, blank=" ", behind="", counts="168"):
    return f"NPOIN= {counts}\n" + "".join(number(a) + blank + number(b) + behind + "\n" for a, b in zip(x, y))


def marker(tag, j):
    return f"MARKER_TAG= {tag}\nMARKER_ELEMS= {AROUND}\n" + "".join("3 %d %d\n" % side for side in circle(j))


def zone(number):
    return "NDIME= 2\n" + cells() + points(number) + "NMARK= 2\n" + marker("body", 0) + marker("far", OUTWARDS)


def odd():
    text = ("% a comment = here\nNDIME=2\n" + points("{:.13E}".format, "\t ", " 0 17 % z", "168 150") +
            "\nNMARK = 4\n" + marker("body", 0) + marker("inside line", 2) + marker("17", OUTWARDS) +
            "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_TO= 1\n1 0 0\n1 5 0\n"
            "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nRECEIVE_FROM= 1\n1 0 0\n" +
            cells("\t") + "FFD_NBOX= 1\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n")
    return text.replace("\n", "\r\n")


def zones():
    other = ("NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1.0 0\n0 1\nNMARK= 1\nMARKER_TAG= b\nMARKER_ELEMS= 3\n"
             "3 0 1\n3 1 2\n3 2 0\n")
    return "NZONE= 3\nIZONE= 1\n" + other + "IZONE= 2\n" + zone("{:.17g}".format) + "IZONE= 3\n" + other


KINDS = {"plain.su2": lambda: zone("{:.17g}".format), "fixed.su2": lambda: zone("{:.8f}".format),
         "leading-zero.su2": lambda: zone(fortran), "odd.su2": odd, "zones.su2": zones}
