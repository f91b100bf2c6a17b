"""Random sequences of calls on a mesh that moves: after each call, curves and bodies are where formulas lead them."""

import copy
import pickle

import harmorph
import numpy as np
import pytest


class Problem:
    """An O-mesh between a B-spline and a circle, which is fixed or a rigid body.

    `control` is the movement of the control points so far, `body` the translation and the complex rotation of
    the body, both since the first analysis; those of `at_start` belong to ``morph.start``.
    """

    def __init__(self, random, tmp_path):
        self.random, self.path = random, tmp_path / "of.basis"
        self.unit = 10.0 ** random.integers(-6, 7)
        n, ni, nj = random.integers(6, 14), random.integers(20, 50), random.integers(5, 14)
        angle, around = 2 * np.pi * np.arange(n) / n, 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
        control = np.stack([np.cos(angle), 0.7 * np.sin(angle)], 1) * random.uniform(1, 1.05, (n, 1))
        weights = random.uniform(0.9, 1.1, n) if random.random() < 0.3 else None
        degree = random.integers(2, 5)
        self.curves = harmorph.Curves(self.unit * control, degree, "periodic", weights=weights)
        first, last = self.curves.range()
        u = first + (last - first) * (np.arange(ni) % (ni - 1)) / (ni - 1)
        wall = self.curves.points(u)
        # The circle begins where the curve does.
        around += np.arctan2(wall[0, 1], wall[0, 0])
        circle = 6 * self.unit * np.stack([np.cos(around), np.sin(around)], 1)
        t = np.linspace(0, 1, nj)[:, None, None] ** 1.5
        self.mesh = harmorph.Mesh.structured((1 - t) * wall + t * circle, j_min="wall", j_max="far")
        self.u, self.wall, self.far = u[:-1], np.arange(ni - 1), np.arange((nj - 1) * ni, nj * ni - 1)
        self.points = self.first = self.mesh.points.copy()
        self.centre = self.unit * random.normal(size=2)
        self.options = {"operator": str(random.choice(["conformal", "laplace", "weighted"]))}
        if self.options["operator"] == "conformal":
            self.options["offset_correction"] = bool(random.random() < 0.3)
        else:
            self.options["engine"] = str(random.choice(["direct", "multigrid"]))
        self.has_body = bool(random.random() < 0.5)
        self.threads = int(random.integers(1, 3))
        self.morph = self.solved(self.mesh, self.curves, self.centre)
        self.control, self.body = np.zeros((n, 2)), (np.zeros(2), 1 + 0j)
        self.at_start = self.of_first = (self.control, self.body)

    def solved(self, mesh, curves, centre):
        conditions = {"wall": "curve"}
        if self.has_body:
            conditions["far"] = harmorph.Condition("rigid", centre=tuple(centre))
        return harmorph.Morph(mesh, curves, conditions, threads=self.threads, **self.options)

    def move(self, control, body):
        """Rows of a movement by `control`, and by `body`: the translation and the change of the rotation."""
        rows = [body[0], (body[1].real, body[1].imag)] if self.has_body else np.empty((0, 2))
        return np.concatenate([control, rows])

    def any_move(self, size):
        control = size * self.unit * self.random.normal(size=self.control.shape)
        if not self.has_body:
            return control
        rotation = self.body[1]
        rows = harmorph.rigid(size * self.unit * self.random.normal(size=2), 60 * size * self.random.normal(),
                              1 + size * self.random.normal(), before=(np.degrees(np.angle(rotation)), abs(rotation)))
        return np.concatenate([control, rows])

    def after(self, move):
        """The movement so far and then `move`, as the pair (control, body)."""
        n, (shift, rotation) = len(self.control), self.body
        if self.has_body:
            shift, rotation = shift + move[n], rotation + complex(*move[n + 1])
        return self.control + move[:n], (shift, rotation)

    def take(self, move, points):
        (self.control, self.body), self.points = self.after(move), points

    def since(self, before, now):
        return self.move(now[0] - before[0], (now[1][0] - before[1][0], now[1][1] - before[1][1]))

    def near(self, found, expected, tolerance):
        assert np.abs(found - expected).max() <= tolerance * self.unit

    def check_places(self, points, now):
        self.near(points[self.wall], self.curves.moved(now[0]).points(self.u), 1e-9)
        shift, rotation = now[1]
        z = (self.first[self.far] - self.centre) @ [1, 1j] * rotation
        self.near(points[self.far], np.stack([z.real, z.imag], 1) + self.centre + shift, 1e-9)

    def check_recovered(self, points, before, now):
        found, expected = self.morph.recover(points), self.since(before, now)
        if self.has_body:  # the rotation has no unit
            assert np.abs(found[-1] - expected[-1]).max() < 1e-6
        self.near(found[: self.morph.functions - self.has_body], expected[: self.morph.functions - self.has_body], 1e-6)

    def check_area(self, now):
        area = self.curves.moved(now[0]).measure("area").values
        assert self.morph.measure("area").values == pytest.approx(area, rel=1e-8)

    def check(self):
        now = (self.control, self.body)
        self.check_places(self.points, now)
        self.check_recovered(self.points, self.at_start, now)
        self.check_area(self.at_start)
        move, force = self.any_move(0.02), self.random.normal(size=self.points.shape)
        work = (self.morph.displacement(move) * force).sum()
        self.near((self.morph.adjoint(force) * move).sum(), work, 1e-9 * len(force))

    # ---- Calls ----

    def step(self):
        move = self.any_move(0.01)
        self.take(move, self.morph.morph(move, self.points))

    def solve(self):
        pair = (self.points[:, 0].copy(), self.points[:, 1].copy())
        self.morph.solve(self.points if self.random.random() < 0.5 else pair)
        self.at_start = (self.control, self.body)

    def copy(self):
        ways = [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))]
        self.morph = ways[self.random.integers(3)](self.morph)

    def release(self):
        self.morph.release()

    def safe(self):
        if not np.array_equal(self.morph.start, self.points):
            self.solve()
        found = self.morph.safe(self.any_move(0.03))
        self.take(found.reached, found.points)

    def compare(self):
        """The functions are those of a new object whose curve and body are where they are now."""
        if not np.array_equal(self.morph.start, self.points):
            self.solve()
        shift, rotation = self.body
        other = self.solved(self.mesh.with_points(self.points.copy()), self.curves.moved(self.control),
                            self.centre + shift)
        move = self.any_move(0.02)
        turned = move.copy()
        if self.has_body:
            change = complex(*move[-1]) / rotation
            turned[-1] = change.real, change.imag
        self.near(self.morph.displacement(move), other.displacement(turned), 3e-6)

    def load(self):
        """The file is loaded on the mesh as it is; solve() then begins with the body where it is."""
        is_start = np.array_equal(self.morph.start, self.points)
        self.morph.save(self.path)
        self.morph = harmorph.Morph.load(self.path, self.mesh.with_points(self.points.copy()), threads=self.threads)
        now, move = (self.control, self.body), self.any_move(0.01)
        moved = self.morph.morph(move)
        self.check_places(moved, self.after(move))
        self.check_recovered(moved, now if is_start else self.of_first, self.after(move))
        self.check_area(now)
        self.morph.solve()
        self.first, self.centre, self.body = self.points, self.centre + self.body[0], (np.zeros(2), 1 + 0j)
        self.at_start = self.of_first = (self.control, self.body)


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.filterwarnings("ignore::harmorph.HarmorphWarning")
def test_random_sequences(seed, tmp_path):
    random = np.random.default_rng(seed)
    problem = Problem(random, tmp_path)
    calls = [problem.step, problem.step, problem.solve, problem.copy, problem.release, problem.safe, problem.compare,
             problem.load]
    for _ in range(random.integers(3, 9)):
        calls[random.integers(len(calls))]()
        problem.check()
