"""One ring of quadrilaterals that make_mesh.py writes in many formats: coordinates, cells, and numbers as text and
bytes."""
import struct
from math import cos, pi, sin

AROUND, OUTWARDS = 24, 6  # cells
N_POINTS, N_CELLS = AROUND * (OUTWARDS + 1), AROUND * OUTWARDS
CELLS = [(i, j) for j in range(OUTWARDS) for i in range(AROUND)]
x, y = [], []  # point (i, j) has the number j * AROUND + i


def point(i, j):
    return j * AROUND + i % AROUND


def quad(i, j):
    return point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)


def circle(j):
    """The sides of a circle of points: that of the body for j = 0, that of the far field for j = OUTWARDS."""
    return [(point(i, j), point(i + 1, j)) for i in range(AROUND)]


def make_coordinates():
    for j in range(OUTWARDS + 1):
        for i in range(AROUND):
            r, angle = 4.0 ** (j / OUTWARDS), 2 * pi * (i + .25) / AROUND
            x.append(r * cos(angle))
            y.append(r * sin(angle))


def read_su2(path, n):
    """The coordinates of the n points of an SU2 file."""
    with open(path, encoding="ascii") as file:
        lines = iter(file)
        for line in lines:
            if line.startswith("NPOIN="):
                return [tuple(map(float, next(lines).split()[:2])) for _ in range(n)]
    raise SystemExit(2)


def read_coordinates(path):
    at = read_su2(path, N_POINTS)
    if "two-" in path:  # points of a mesh of two blocks: those of the first block, then the others of the second one
        half = AROUND // 2
        second = (OUTWARDS + 1) * (half + 1) - half - 1
        at = [at[j * (half + 1) + i if i <= half else second + j * (half - 1) + i]
              for j in range(OUTWARDS + 1) for i in range(AROUND)]
    for a, b in at:
        x.append(a)
        y.append(b)


class Out(bytearray):
    """A file of text or of binary numbers; `real` and `whole` are the formats of numbers in text."""

    def __init__(self, is_text=True, swapped=False, real="%.16g ", whole="%d "):
        super().__init__()
        self.is_text, self.order, self.real, self.whole = is_text, "><"[not swapped], real, whole

    def say(self, text):
        self += text.encode()

    def put(self, kind, *values):
        """Numbers of a kind of `struct`: f and d are real."""
        if self.is_text:
            self.say("".join((self.real if kind in "fd" else self.whole) % value for value in values))
        else:
            self += struct.pack(f"{self.order}{len(values)}{kind}", *values)

    def line(self):
        """Text: the blank behind the last number becomes the end of the line."""
        if self.is_text:
            self[-1:] = b"\n"

    def end(self, text):
        """A line of text behind numbers."""
        self.say(text if self.is_text else "\n" + text)
