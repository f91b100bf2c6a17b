"""`make compare`: harmorph in one step and with safe morph, restored heights and improvement, linear elasticity, radial
basis functions and inverse distances, for the same movements and judged by the same measures.

usage: compare.py FOLDER MESH:MARKER ...   airfoils of chord 1 from x = 0 to 1; the block of tests/meshes comes always
"""

import os
import pickle
import resource
import sys
import time
from types import SimpleNamespace

import numpy as np
import harmorph
import shared
from matplotlib import pyplot

from methods import Elasticity, InverseDistance, RadialBasis, area, cross


class Domain:
    """A mesh to deform, and the points of its boundary; points are complex numbers."""

    def __init__(self, mesh, wall):
        self.start = mesh.points @ [1, 1j]
        begin, corner = mesh.cell_rows()
        sizes = np.diff(begin)
        self.cells = []  # counter-clockwise: one array of triangles, one of quadrilaterals
        for n in (3, 4):
            cells = corner[begin[:-1][sizes == n][:, None] + np.arange(n)]
            clockwise = area(self.start[cells]) < 0
            cells[clockwise] = cells[clockwise, ::-1]
            self.cells.append(cells)
        sides = {side for cells in self.cells for side in zip(cells.ravel(), np.roll(cells, -1, axis=1).ravel())}
        faces = mesh._faces[mesh._face_markers == mesh.markers[wall]]
        faces = np.array([face if tuple(face) in sides else face[::-1] for face in faces])
        self.wall, self.next = faces[faces[:, 0].argsort()].T  # in a loop, with the mesh on the left
        self.previous = self.wall[self.next.argsort()]
        self.outer = np.setdiff1d(mesh._faces, self.wall)
        self.inner = np.setdiff1d(np.arange(len(self.start)), np.union1d(self.wall, self.outer))
        self.above = self._points_above(sides)

    def tangent(self, at):
        """The mean direction of the two faces at each wall point."""
        on, back = at[self.next] - at[self.wall], at[self.wall] - at[self.previous]
        both = on / abs(on) + back / abs(back)
        return both / abs(both)

    def rise(self, foot, top, at):
        """Edges from wall points, by their places in the list of the wall, along and normal to the wall."""
        return (at[top] - at[self.wall[foot]]) / self.tangent(at)[foot]

    def _points_above(self, sides):
        """For each wall point, the end of the edge into the mesh that is most normal to the wall."""
        place = {point: k for k, point in enumerate(self.wall)}
        edges = [(place[a], b) for side in sides for a, b in (side, side[::-1]) if a in place and b not in place]
        foot, top = np.array(edges).T
        slope = abs(np.angle(self.rise(foot, top, self.start) / 1j))
        order = np.lexsort((slope, foot))
        _places, first = np.unique(foot[order], return_index=True)
        assert len(first) == len(self.wall)
        return top[order][first]

    def corners(self, at):
        """Twice the areas of the corners of all cells, one array for each kind of cell."""
        return [cross(np.roll(z, -1, axis=1) - z, np.roll(z, 1, axis=1) - z) for z in (at[c] for c in self.cells)]

    def is_valid(self, at):
        return all((corner > 0).all() for corner in self.corners(at))

    def measure(self, at):
        """Size-skew quality relative to the start, angles [degrees] and heights at the wall."""
        qualities = []
        for cells, corner in zip(self.cells, self.corners(at)):
            z = at[cells]
            side = abs(np.roll(z, -1, axis=1) - z)
            size = area(z) / area(self.start[cells])
            with np.errstate(all="ignore"):
                if cells.shape[1] == 3:
                    skew = 4 * 3**0.5 * area(z) / (side**2).sum(axis=1)
                else:
                    skew = 4 / (side * np.roll(side, 1, axis=1) / corner).sum(axis=1)
                quality = skew * np.sqrt(np.minimum(size, 1 / size))
            qualities.append(np.where((corner > 0).all(axis=1), quality, 0))
        quality = np.concatenate(qualities)
        foot = np.arange(len(self.wall))
        before, now = self.rise(foot, self.above, self.start), self.rise(foot, self.above, at)
        ratio = now.imag / before.imag
        return SimpleNamespace(min_quality=quality.min(), mean_quality=quality.mean(),
                               angle=np.degrees(abs(np.angle(now / before))).mean(),
                               min_height=ratio.min(), max_height=ratio.max(), height_error=abs(ratio - 1).mean())


def moved_by(method, domain, walls):
    """One step or, if that inverts cells, ten steps on the mesh as it moves, each with a new set-up.

    walls: the wall before the movement, after each tenth of the movement, and at the target.
    """
    for steps in (1, 10):
        at, begun = domain.start, time.process_time()
        for step in range(1, steps + 1):
            prepared = method(domain, at)
            if step == 1:
                setup = time.process_time() - begun
            at = prepared.moved(walls[10 * step // steps])
        movement = time.process_time() - begun - setup
        if domain.is_valid(at):
            break
    return steps, setup, movement, at


def alone(run, domain):
    """The row of a method, computed in a process of its own, so that the growth of memory is that of this row."""
    sys.stdout.flush()
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        result = run()
        grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
        with open(write, "wb") as pipe:
            pickle.dump((*result, grown), pipe)
        os._exit(0)
    os.close(write)
    with open(read, "rb") as pipe:
        steps, setup, movement, at, memory = pickle.load(pipe)
    os.waitpid(child, 0)
    row = domain.measure(at)
    row.steps, row.setup, row.movement, row.memory, row.valid = steps, setup, movement, memory, domain.is_valid(at)
    return row


METHODS = {"elasticity 1/area": Elasticity, "RBF Wendland C2": RadialBasis, "inverse distance": InverseDistance,
           "harmorph, one step": None, "harmorph --safe": None}


class Comparison:
    """One mesh with the curve and the conditions of the safe morph."""

    best = columns = 0  # of the safe morph, on all meshes

    def __init__(self, mesh, wall, curves, conditions=None):
        self.domain, self.wall = Domain(mesh, wall), wall
        self.solve = lambda: harmorph.Morph(mesh, curves, conditions)
        self.morph = self.solve()
        self.bars = {}

    def compare(self, what, moves):
        """moves(t): the movement of the control points at t from 0 to 1. All methods get the wall of the B-spline."""
        domain, move = self.domain, moves(1)
        walls = [(domain.start + self.morph.displacement(moves(t / 10)) @ [1, 1j])[domain.wall] for t in range(11)]

        def harmorph_by(way):
            setup, morph = shared.processor_seconds(self.solve)
            movement, (steps, points) = shared.processor_seconds(lambda: way(morph))
            return steps, setup, movement, points @ [1, 1j]

        def one_step(morph):
            return 1, morph.morph(move)

        def safe_morph(morph):
            safe = morph.safe(move, heights=1.0)
            return safe.report.steps, morph.improve(safe.points)[0]

        rows = [alone(lambda method=method: moved_by(method, domain, walls), domain)
                for method in METHODS.values() if method]
        rows += [alone(lambda: harmorph_by(one_step), domain), alone(lambda: harmorph_by(safe_morph), domain)]
        self.print(what, rows)
        self.bars[what] = [(row.min_quality, row.mean_quality) if row.valid else (0, 0) for row in rows]

    def print(self, what, rows):
        """A star: within 2 % of the best, of quality, of a radian, and of the height."""
        kinds = {"min_quality": (-1, lambda best: 0.98 * best), "mean_quality": (-1, lambda best: 0.98 * best),
                 "angle": (1, lambda best: best + 1.15), "height_error": (1, lambda best: best + 0.02)}
        stars = [{} for _row in rows]
        for name, (sign, bound) in kinds.items():
            valid = [sign * getattr(row, name) for row in rows if row.valid]
            for star, row in zip(stars, rows):
                star[name] = "*" if row.valid and sign * getattr(row, name) <= sign * bound(sign * min(valid)) else " "
            Comparison.best += stars[-1][name] == "*"
            Comparison.columns += 1
        print(f"  {what}")
        for name, row, star in zip(METHODS, rows, stars):
            print(f"  {name:18}  {row.steps:5d}  {'valid' if row.valid else 'inverted':>8}  "
                  f"{row.min_quality:8.3f}{star['min_quality']}  {row.mean_quality:8.3f}{star['mean_quality']}  "
                  f"{row.angle:7.2f}{star['angle']}  {row.min_height:6.3f}  {row.max_height:6.3f}  "
                  f"{row.height_error:7.4f}{star['height_error']}  {row.setup:8.4f}  {row.movement:8.5f}  "
                  f"{row.memory:6.1f}", flush=True)

    def draw(self, path, name):
        figure, axes = pyplot.subplots(figsize=(10, 3.2))
        for k, method in enumerate(METHODS):
            places = np.arange(len(self.bars)) + 0.16 * (k - 2)
            low, mean = np.array([bars[k] for bars in self.bars.values()]).T
            axes.bar(places, low, 0.14, color=f"C{k}", label=method)
            axes.bar(places, mean, 0.14, edgecolor=f"C{k}", fill=False)
        axes.set_xticks(np.arange(len(self.bars)), self.bars)
        axes.legend(ncols=5, fontsize="small", loc="lower center", bbox_to_anchor=(0.5, 1))
        figure.savefig(path, bbox_inches="tight")
        print(f"\nfigure {os.path.basename(path)} Size-skew quality on {name} by method: full bars are the smallest "
              "values, outlines the means; there is no bar where cells are inverted.")


def begin_table(mesh, remark=""):
    print(f"\n== Against other methods: {mesh}\n\ntable The same movements by other methods{remark}. Quality is "
          "size-skew; angle is the mean change [degrees] between the wall and the first-layer edges; heights are "
          "ratios of first-layer heights, error the mean of |ratio - 1|; a star: the best, or within 2 % of the best "
          "valid one; seconds of processor time for what is done once for a mesh, and for this movement; memory [MiB]")
    print(f"  {'method':18}  {'steps':>5}  {'cells':>8}  {'min q':>9}  {'mean q':>9}  {'angle':>8}  {'lowest':>6}  "
          f"{'highest':>6}  {'error':>8}  {'set-up':>8}  {'movement':>8}  {'memory':>6}")


def airfoil(folder, word):
    mesh, marker, name = shared.file_and_marker(word)
    curves = harmorph.Curves.fit(mesh, marker)
    begin_table(name)
    comparison = Comparison(mesh, marker, curves)
    for what, movement, amount in (("camber .1", shared.camber, 0.1), ("camber .3", shared.camber, 0.3),
                                   ("camber .6", shared.camber, 0.6), ("rotation 20", shared.rotation, 20),
                                   ("rotation 60", shared.rotation, 60), ("rotation 120", shared.rotation, 120),
                                   ("bump .3", shared.bump, 0.3), ("flap 30", shared.flap, 30)):
        comparison.compare(what, lambda t: movement(curves.control, t * amount))
    comparison.draw(f"{folder}/compared-{name}.svg", name)


def block(folder):
    mesh = harmorph.Mesh.read(os.path.join(folder, "../meshes/block.su2"))
    begin_table("block.su2",
                " (the outer sides slide in harmorph's mesh, and are fixed in the others)")
    control = np.array([[0.4, 0.48], [0.6, 0.48], [0.6, 0.52], [0.4, 0.52]])
    curves = harmorph.Curves(control, degree=1, closed="tied")
    comparison = Comparison(mesh, "block", curves, {"block": "curve", "outer": "slip"})
    comparison.compare("60 degrees and (-.2, -.3)",
                       lambda t: shared.rotation(control, 60 * t, (0.5, 0.5), (-0.2 * t, -0.3 * t)))
    comparison.draw(f"{folder}/compared-block.svg", "the block")


if __name__ == "__main__":
    block(sys.argv[1])
    for word in sys.argv[2:]:
        airfoil(sys.argv[1], word)
    print(f"\nharmorph is best or within 2 % of the best in {Comparison.best} of {Comparison.columns} columns")
