"""`make paper`: free-form deformation of a mesh against harmonic functions, for the same movement of the wall.

A box of Bernstein polynomials round the body moves all mesh points inside; the outermost nodes of the box stay, so that
the mesh is continuous there. The other nodes are the least-squares fit to the displacements of the wall points, with a
penalty on the movement of the nodes: the smallest of several penalties that leaves the fewest inverted cells.

usage: ffd.py FOLDER MESH:MARKER LAPLACE-BASIS CONFORMAL-BASIS
"""

import sys

import numpy as np
import harmorph
import shared
from matplotlib import pyplot
from scipy.linalg import solve
from scipy.special import binom

PENALTIES = (1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2)


class Lattice:
    """The box of the wall, larger by half of the longer side on each side."""

    def __init__(self, degree, points, wall):
        low, high = points[wall].min(axis=0), points[wall].max(axis=0)
        margin = 0.5 * (high - low).max()
        t = (points - (low - margin)) / (high - low + 2 * margin)
        k = np.arange(1, degree)  # the inner nodes
        a, b = (binom(degree, k) * t[:, d, None] ** k * (1 - t[:, d, None]) ** (degree - k) for d in (0, 1))
        inside = ((t >= 0) & (t <= 1)).all(axis=1)
        self.weights = np.where(inside[:, None], (b[:, :, None] * a[:, None, :]).reshape(len(points), -1), 0)
        self.wall, self.nodes = wall, (degree - 1) ** 2

    def fit(self, displacement, penalty):
        """The displacement of all points that fits those of the wall."""
        w = self.weights[self.wall]
        matrix = w.T @ w
        matrix += penalty * np.trace(matrix) / self.nodes * np.eye(self.nodes)
        return self.weights @ solve(matrix, w.T @ displacement[self.wall], assume_a="pos")


def row(method, morph, wall, wanted, found):
    """Print one row; return how far the wall is from the wanted place, and the number of inverted cells."""
    largest = np.hypot(*wanted[wall].T).max()
    off = np.hypot(*(found - wanted)[wall].T) / largest
    still = np.hypot(*wanted[wall].T) <= 1e-3 * largest
    others = (np.hypot(*found[wall][still].T) / largest).max(initial=0)
    moving = (np.hypot(*found.T) > 0.01 * largest).mean()
    step = morph.assess(found).step
    quality = morph.assess(points=morph.start + found, reference=morph.start).quality
    print(f"{method:24}  {off.max():10.1e}  {others:11.1e}  {step.admissible:11.3g}  {quality.inverted:9d}  "
          f"{quality.min_quality:11.3g}  {quality.mean_quality:12.3g}  {100 * moving:8.0f} %")
    return off.max()


def compare(folder, laplace, conformal, marker, letter, name, what, move):
    mesh = laplace.mesh
    wall = np.unique(mesh._faces[mesh._face_markers == mesh.markers[marker]])
    print(f"table {what}: largest distance of wall points from where the B-spline has them, and of those that it "
          "leaves where they are; admissible step; cells; quality; mesh points that move by more than 1 %")
    print(f"{'method':24}  {'wall off':>10}  {'others off':>11}  {'admissible':>11}  {'inverted':>9}  "
          f"{'min quality':>11}  {'mean quality':>12}  {'moving':>10}")
    wanted = laplace.displacement(move)
    row("harmonic functions", laplace, wall, wanted, wanted)
    row("conformal functions", laplace, wall, wanted, conformal.displacement(move))
    best, shown = np.inf, None
    for degree in (3, 5, 7, 9, 12, 16):
        lattice = Lattice(degree, mesh.points, wall)
        fields = [lattice.fit(wanted, penalty) for penalty in PENALTIES]
        inverted = [laplace.assess(points=mesh.points + field).quality.inverted for field in fields]
        field = fields[int(np.argmin(inverted))]
        off = row(f"FFD, {lattice.nodes} free nodes", laplace, wall, wanted, field)
        if off < best:
            best, shown = off, field
    figure, panels = pyplot.subplots(1, 2, figsize=(12, 5), sharex=True, sharey=True)
    control = laplace.curves.control + move
    for axes, field, method in zip(panels, (wanted, shown), ("harmonic functions", "free-form deformation")):
        mesh.plot(mesh.points, axes, whole=True, colors="#0072b2", label="mesh before")
        mesh.plot(mesh.points + field, axes, whole=True, colors="#d55e00", label="mesh after")
        axes.plot(*control.T, "k.-", linewidth=0.5, label="control polygon of the moved B-spline")
        axes.set(xlim=(-0.3, 1.45), ylim=(-0.35, 0.85), xlabel="x [chords]", ylabel="y [chords]", title=method)
    panels[0].legend(fontsize="small", loc="upper left")
    figure.savefig(f"{folder}/ffd-{name}.svg", bbox_inches="tight")
    print(f"\nfigure ffd-{name}.svg Figure {letter} | {what}, by harmonic functions on the left, by the box of "
          "free-form deformation that fits the wall best on the right. The mesh before is blue and the mesh after is "
          f"red, with the control polygon of the moved B-spline. The wall of the box is off by {best:.3g} of the "
          "movement.")


if __name__ == "__main__":
    folder, word, *bases = sys.argv[1:]
    mesh, marker, _name = shared.file_and_marker(word)
    laplace, conformal = (harmorph.Morph.load(basis, mesh) for basis in bases)
    every, one = np.zeros((2, laplace.functions, 2))
    every[:] = 0.08, 0.065
    one[3, 1] = 0.05
    compare(folder, laplace, conformal, marker, "O", "all", "All control points move by (.08, .065)", every)
    compare(folder, laplace, conformal, marker, "P", "one", "Control point 4 alone moves up by .05", one)
