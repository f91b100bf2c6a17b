"""The schemes that the text of the paper may mean, as matrices on the meshes of the paper and on squares: why the
averages of nodal gradients diverge or converge slowly, and what the other readings do. Written apart from the library;
only the reader of mesh files is the library's.

usage: schemes.py FOLDER NAME=MESH ...   prints a table for each mesh, and draws the eigenvalues of the last mesh
"""

import sys

import numpy as np
import harmorph
from matplotlib import pyplot
from scipy import linalg, sparse

SCHEMES = {"plain": "plain averages of nodal gradients", "corrected": "averages, corrected along the edge",
           "edge-dual": "gradients over edge-dual volumes", "compact": "compact"}


class Mesh:
    """Points z as complex numbers, counter-clockwise cells, and the edges with the normals of their dual faces."""

    def __init__(self, z, cells, known):
        self.z, self.known, n = z, known, len(z)
        self.cells = [cell if area(z[cell]) > 0 else cell[::-1] for cell in cells]
        # All sides of cells: begin, end, cell, and the line from the middle of the side to the barycentre of the cell.
        sides = [(a, b, k, z[cell].mean() - 0.5 * (z[a] + z[b])) for k, cell in enumerate(self.cells)
                 for a, b in zip(cell, np.roll(cell, -1))]
        a, b, self.cell, line = (np.array(one) for one in zip(*sides))
        self.side_begin, self.side_end = a, b
        key, self.edge = np.unique(np.minimum(a, b) * n + np.maximum(a, b), return_inverse=True)
        self.begin, self.end = key // n, key % n
        normal = np.where(a < b, 1, -1) * line * -1j
        self.normal = np.bincount(self.edge, normal.real) + 1j * np.bincount(self.edge, normal.imag)
        self.area = np.array([area(z[cell]) for cell in self.cells])

    def matrix(self, rows, columns, values, n_rows=None):
        return sparse.coo_matrix((values, (rows, columns)), shape=(n_rows or len(self.z), len(self.z))).tocsr()

    def gradients(self, volume_of_side, n):
        """The gradients as complex numbers over n volumes, which consist of cells: Green-Gauss on the sides of cells.

        volume_of_side: pairs of arrays, a volume and a cell that belongs to the volume."""
        outward = (self.z[self.side_end] - self.z[self.side_begin]) * -1j
        in_cell = sum(self.matrix(self.cell, point, 0.5 * outward, len(self.cells))
                      for point in (self.side_begin, self.side_end))
        volume, cell = volume_of_side
        members = sparse.coo_matrix((np.ones(len(volume)), (volume, cell)), shape=(n, len(self.cells))).tocsr()
        return sparse.diags(1 / (members @ self.area)) @ members @ in_cell

    def compact(self):
        """Cotangents of the angles; a quadrilateral is the mean of the two ways to divide it."""
        parts = [(cell, 1) if len(cell) == 3 else (np.roll(cell, -k)[:3], 0.5)
                 for cell in self.cells for k in range(1 if len(cell) == 3 else 4)]
        corner, share = np.array([one for one, _ in parts]), np.array([share for _, share in parts])
        total = sparse.csr_matrix((len(self.z), len(self.z)))
        for k in range(3):
            i, j, o = (np.roll(corner, -k, axis=1)[:, c] for c in range(3))
            angle = (self.z[i] - self.z[o]).conj() * (self.z[j] - self.z[o])
            weight = 0.5 * share * angle.real / angle.imag
            for rows, columns, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                total = total + self.matrix(rows, columns, sign * weight)
        return total

    def rows(self, scheme):
        """Minus the sums of the fluxes into the volumes of all points."""
        if scheme == "compact":
            return self.compact()
        edges = np.arange(len(self.begin))
        along = self.z[self.end] - self.z[self.begin]
        direct = (self.normal * along.conj()).real / abs(along) ** 2 if scheme == "corrected" else 0 * along.real
        if scheme == "edge-dual":
            gradient = self.gradients((self.edge, self.cell), len(edges))
        else:
            nodal = self.gradients((self.side_begin, self.cell), len(self.z))
            gradient = 0.5 * (nodal[self.begin] + nodal[self.end])
        flux = (sparse.diags((self.normal - direct * along).conj()) @ gradient).real
        ends = self.matrix(edges, self.end, np.ones(len(edges)), len(edges)) - \
            self.matrix(edges, self.begin, np.ones(len(edges)), len(edges))
        return ends.T @ (flux + sparse.diags(direct) @ ends)


def area(z):
    return 0.5 * (z.conj() * np.roll(z, -1)).imag.sum()


def square(n):
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1))
    here = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    cells = np.stack([here[:-1, :-1], here[:-1, 1:], here[1:, 1:], here[1:, :-1]], axis=-1).reshape(-1, 4)
    return Mesh((i + 1j * j).ravel(), cells, ((i % n == 0) | (j % n == 0)).ravel())


def read(path):
    mesh = harmorph.Mesh.read(path)
    start, points = mesh.cell_rows()
    known = np.zeros(mesh.n_points, bool)
    known[mesh._faces] = True
    return Mesh(mesh.points @ [1, 1j], np.split(points, start[1:-1]), known)


def growth(z):
    """One step of the paper's Runge-Kutta scheme multiplies a mode by this; z: minus the eigenvalue times the step."""
    value = 1
    for coefficient in (0.11, 0.2766, 0.5, 1.0):
        value = 1 + coefficient * z * value
    return abs(value)


def study(mesh, scheme):
    """Print a row; return the eigenvalues of the matrix of the unknowns, and how much their modes alternate from point
    to point: the mean of (u_P - u_Q)^2 over the edges, relative to that of 2 (u_P^2 + u_Q^2); 1 for a checkerboard, 0
    for a constant. Each row is divided by the diagonal of the compact scheme, as local time steps do."""
    free = np.flatnonzero(~mesh.known)
    scaled = sparse.diags(1 / mesh.compact().diagonal()) @ mesh.rows(scheme)
    values, vectors = linalg.eig(scaled.tocsr()[free][:, free].toarray())
    u = np.zeros((len(mesh.z), len(free)), complex)
    u[free] = vectors
    differences = (abs(u[mesh.begin] - u[mesh.end]) ** 2).sum(axis=0)
    alternation = differences / (2 * (abs(u[mesh.begin]) ** 2 + abs(u[mesh.end]) ** 2)).sum(axis=0)
    order = values.real.argsort()
    values, alternation = values[order], alternation[order]
    largest = abs(values).max()
    slowest = growth(-4.3 / largest * values).max()
    steps = f"{np.ceil(np.log(1e-10) / np.log(slowest)):.0f}" if slowest < 1 else "diverges"
    print(f"{SCHEMES[scheme]:36}  {values[0].real:18.2e}  {(values.real <= 0).sum():9d}  {largest:18.3f}  "
          f"{alternation[0]:25.2f}  {steps:>22}", flush=True)
    return values, alternation


def print_head(title):
    print(f"\ntable {title}\n{'scheme':36}  {'least eigenvalue':>18}  {'0 or less':>9}  {'largest eigenvalue':>18}  "
          f"{'alternation of least mode':>25}  {'Runge-Kutta steps':>22}")


def print_symbols():
    """The symbol on squares: what the scheme makes of two waves in the middle of a square."""
    mesh = square(8)
    stripes, checkerboard = (-1) ** mesh.z.real.astype(int), (-1) ** (mesh.z.real + mesh.z.imag).astype(int)
    print("table Squares: what becomes of waves that alternate from point to point\n"
          f"{'scheme':36}  {'(-1)^i':>12}  {'(-1)^(i+j)':>12}")
    for scheme, name in SCHEMES.items():
        row = mesh.rows(scheme)[4 * 9 + 4]
        print(f"{name:36}  {(row @ stripes)[0]:12.3f}  {(row @ checkerboard)[0]:12.3f}")


def draw(panels, path):
    """Each mode is a point; eigenvalues of the wrong sign are larger points at the left edge."""
    figure, axes = pyplot.subplots(2, 2, figsize=(9, 6), sharex=True, sharey=True, layout="constrained")
    for place, (name, (values, alternation)) in zip(axes.flat, panels.items()):
        wrong = values.real <= 0
        place.semilogx(values.real[~wrong], alternation[~wrong], ".", color="#0072b2", markersize=3)
        place.semilogx(np.full(wrong.sum(), 1e-4), alternation[wrong], "o", color="#d55e00", markersize=6)
        place.set(title=name, xlim=(0.8e-4, 2))
    figure.supxlabel("real part of the eigenvalue of the rows divided by the compact diagonal; orange: 0 or less")
    figure.supylabel("alternation of the mode; 0: constant, 1: checkerboard")
    figure.savefig(path)


if __name__ == "__main__":
    print_symbols()
    print_head("A square of 24 x 24 cells")
    for scheme in SCHEMES:
        study(square(24), scheme)
    for word in sys.argv[2:]:
        title, path = word.split("=", 1)
        mesh = read(path)
        print_head(title)
        panels = {name: study(mesh, scheme) for scheme, name in SCHEMES.items()}
    draw(panels, f"{sys.argv[1]}/spectrum.svg")
