"""The reference for improvement: the objective J = log(smallest quality) + WEIGHT log(mean quality), its exact
gradient, and its maximum by L-BFGS over the inner points, with smooth minima that become sharper and sharper.

The memory of L-BFGS starts from the factor of a Hessian whose cells are projected to positive matrices (scipy's splu),
so that thin layers and large cells converge alike; the limit is that of L-BFGS without it.
"""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from meshes import area, cross

WEIGHT = 1.0  # w of the mean
LAYER = 4.0  # wall points have a layer where faces are longer than this, in heights of the first layer
SHARPNESS = (10, 50, 250, 1250)  # rho of the smooth minimum: 1 / rho is its relative width


class Cells:
    """Cells of one kind with their areas before the movement: logarithms of quality and gradients."""

    def __init__(self, cells, start):
        self.cells = cells
        self.n = cells.shape[1]
        self.before = area(start[cells])

    def log_quality(self, z, blur=0.0):
        """log(sqrt(f_size) f_skew) of cells with the corners z [m, n], -inf where inverted; the derivatives with
        respect to the corners as complex numbers. blur > 0 rounds off the kink of f_size."""
        along = np.roll(z, -1, axis=1) - z
        back = np.roll(along, 1, axis=1)
        corner = cross(back, along)  # twice the areas of the corner triangles
        good = (corner > 0).all(axis=1)
        corner = np.where(good[:, None], corner, 1.0)
        by_area = -0.5j * (np.roll(z, -1, axis=1) - np.roll(z, 1, axis=1))
        size = np.where(good, area(z), 1.0)
        if self.n == 3:
            squares = (abs(along) ** 2).sum(axis=1)
            skew = np.log(4 * 3**0.5 * size / squares)
            slope = by_area / size[:, None] - 2 * (back - along) / squares[:, None]
        else:
            length = abs(along)
            ratio = np.roll(length, 1, axis=1) * length / corner
            total = ratio.sum(axis=1)
            skew = np.log(4 / total)
            part = ratio / total[:, None]  # of each corner
            unit = along / length**2
            both = part + np.roll(part, -1, axis=1)
            after = np.roll(along, -1, axis=1)
            by_side = -both * unit + part / corner * 1j * back
            by_side -= np.roll(part / corner, -1, axis=1) * 1j * after
            slope = np.roll(by_side, 1, axis=1) - by_side
        change = np.log(size / self.before)
        root = np.sqrt(change**2 + blur**2)
        value = skew - 0.5 * (root - blur)
        with np.errstate(all="ignore"):
            sign = np.where(root > 0, change / root, 0.0)
        slope = slope - (0.5 * sign / size)[:, None] * by_area
        return np.where(good, value, -np.inf), slope

    def hessians(self, z, blur):
        """Second derivatives of the logarithms, [m, 2n, 2n]: differences of gradients."""
        side = abs(np.roll(z, -1, axis=1) - z)
        step = 1e-4 * np.minimum(2 * area(z) / side.max(axis=1), side.min(axis=1))
        out = np.empty((len(z), 2 * self.n, 2 * self.n))
        for k in range(2 * self.n):
            move = np.zeros(self.n, complex)
            move[k // 2] = (1, 1j)[k % 2]
            move = step[:, None] * move
            slope = (self.log_quality(z + move, blur)[1] - self.log_quality(z - move, blur)[1]) / (2 * step[:, None])
            out[:, k, 0::2], out[:, k, 1::2] = slope.real, slope.imag
        return 0.5 * (out + out.transpose(0, 2, 1))


    def strain(self, z):
        """The sum over corners of |dE inverse(E)|^2, E the two sides at the corner, as a matrix [m, n, n] for both
        coordinates alike: a step for which this is small changes no cell much, however thin the cell is."""
        out = np.zeros((len(z), self.n, self.n))
        for k in range(self.n):
            three = np.array([k - 1, k, k + 1]) % self.n
            p = z[:, three]
            side = np.roll(p, -2, axis=1) - np.roll(p, -1, axis=1)
            slope = side / (2 * area(p))[:, None]
            out[:, three[:, None], three] += (slope[:, :, None] * slope[:, None, :].conj()).real / self.n
        return out


class Objective:
    """J of a mesh whose points `free` may move. pulled: points, where they should be, and the weights of the squared
    distances from there, which are added to -J."""

    def __init__(self, mesh, free, pulled=None):
        self.mesh, self.free, self.pulled = mesh, free, pulled
        self.kinds = [Cells(cells, mesh.points) for cells in mesh.cells if len(cells)]
        self.number = np.full(len(mesh.points), -1)
        self.number[free] = np.arange(len(free))

    def qualities(self, at):
        return np.concatenate([np.exp(kind.log_quality(at[kind.cells])[0]) for kind in self.kinds])

    def report(self, at):
        """The smallest and the mean quality, as the program reports them."""
        quality = self.qualities(at)
        return quality.min(), quality.mean()

    def rounding(self, at):
        """How far the coordinates' rounding may change a quality: in parts of the shortest height of a cell."""
        shortest = min((2 * area(z) / abs(np.roll(z, -1, axis=1) - z).max(axis=1)).min()
                       for z in (at[kind.cells] for kind in self.kinds))
        return 16 * np.finfo(float).eps * max(abs(at.real).max(), abs(at.imag).max()) / shortest

    def value(self, at):
        smallest, mean = self.report(at)
        return np.log(smallest) + WEIGHT * np.log(mean) if smallest > 0 else -np.inf

    def smooth(self, at, rho, blur, damping=None):
        """Minus J with a smooth minimum, its gradient by the free points and, with a damping, a positive Hessian with
        the damping times Cells.strain."""
        found = [kind.log_quality(at[kind.cells], blur) for kind in self.kinds]
        logs = np.concatenate([log for log, _ in found])
        smallest = logs.min()
        if not np.isfinite(smallest):
            return np.inf, None, None
        share = np.exp(-rho * (logs - smallest))
        quality = np.exp(logs)
        total, whole = share.sum(), quality.sum()
        value = -(smallest - np.log(total) / rho) - WEIGHT * np.log(whole / len(logs))
        share, part = share / total, WEIGHT * quality / whole
        gradient = np.zeros(len(at), complex)
        begin, rows = 0, []
        for kind, (log, slope) in zip(self.kinds, found):
            here = slice(begin, begin + len(log))
            begin += len(log)
            np.add.at(gradient, kind.cells, -(share[here] + part[here])[:, None] * slope)
            if damping is not None:
                rows.append(self._rows(kind, at, slope, share[here], part[here], rho, blur, damping))
        if self.pulled:
            points, places, weight = self.pulled
            way = at[points] - places
            value += 0.5 * (weight * abs(way) ** 2).sum()
            gradient[points] += weight * way
            unknown = (2 * self.number[points][:, None] + [0, 1]).reshape(-1, 1)
            if damping is not None:
                rows.append((np.repeat(weight, 2).reshape(-1, 1, 1), unknown))
        return value, gradient[self.free], self._matrix(rows) if damping is not None else None

    def _rows(self, kind, at, slope, share, part, rho, blur, damping):
        """The matrices of cells without negative eigenvalues, and their unknowns."""
        by = np.empty((len(slope), 2 * kind.n))
        by[:, 0::2], by[:, 1::2] = slope.real, slope.imag
        outer = by[:, :, None] * by[:, None, :]
        local = -(share + part)[:, None, None] * kind.hessians(at[kind.cells], blur)
        local += (rho * share - part)[:, None, None] * outer
        values, vectors = np.linalg.eigh(local)
        local = (vectors * np.maximum(values, 0)[:, None, :]) @ vectors.transpose(0, 2, 1)
        strain = (damping * (share + part))[:, None, None] * kind.strain(at[kind.cells])
        local[:, 0::2, 0::2] += strain
        local[:, 1::2, 1::2] += strain
        unknown = self.number[kind.cells]
        unknown = np.stack([np.where(unknown < 0, -1, 2 * unknown + k) for k in (0, 1)], axis=-1)
        return local, unknown.reshape(len(slope), -1)

    def _matrix(self, rows):
        value, row, column = [], [], []
        for local, unknown in rows:
            row.append(np.repeat(unknown, unknown.shape[1], axis=1).ravel())
            column.append(np.tile(unknown, (1, unknown.shape[1])).ravel())
            value.append(local.ravel())
        value, row, column = (np.concatenate(x) for x in (value, row, column))
        inner = (row >= 0) & (column >= 0)
        n = 2 * len(self.free)
        return sparse.csc_matrix((value[inner], (row[inner], column[inner])), shape=(n, n))


def factor(matrix):
    """The solution by this matrix, made a little more positive."""
    matrix = matrix + sparse.diags(1e-9 * matrix.diagonal() + 1e-300)
    return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True}).solve


def lbfgs(objective, at, rho, blur, tolerance, limit=400, refresh=15, memory=15):
    """Minimise the smooth objective from the points `at`; return the points and the number of steps."""
    free, since, small, damping, pairs = objective.free, refresh, 0, 0.1, []
    value, gradient, _ = objective.smooth(at, rho, blur)
    for step in range(limit):
        if since >= refresh:
            solve, pairs, since = factor(objective.smooth(at, rho, blur, damping)[2]), [], 0
        way = _direction(gradient.view(float), pairs, solve)
        slope = gradient.view(float) @ way
        if not slope < -0.1 * tolerance:
            break
        part = 1.0
        while part > 1e-3:
            trial = at.copy()
            trial[free] += part * way.view(complex)
            new, new_gradient, _ = objective.smooth(trial, rho, blur)
            if new <= value + 1e-4 * part * slope:
                break
            part *= 0.5
        else:
            if since == 0:
                damping *= 10
            since = refresh
            if damping > 1e8:
                break
            continue
        s, y = part * way, (new_gradient - gradient).view(float)
        if s @ y > 1e-12 * np.sqrt((s @ s) * (y @ y)):
            pairs = pairs[-memory + 1 :] + [(s, y)]
        small = small + 1 if value - new < tolerance else 0
        at, value, gradient, since = trial, new, new_gradient, since + 1
        if since == 1:
            damping = min(max(damping * (0.3 if part == 1 else 3 if part < 0.2 else 1), 1e-3), 1e4)
        if part < 0.2:
            since = refresh
        if small >= 8:
            break
    return at, step + 1


def _direction(gradient, pairs, solve):
    """The two loops of L-BFGS."""
    way, kept = -gradient, []
    for s, y in reversed(pairs):
        kept.append((s @ way) / (s @ y))
        way = way - kept[-1] * y
    way = solve(way)
    for (s, y), k in zip(pairs, reversed(kept)):
        way = way + (k - (y @ way) / (s @ y)) * s
    return way


def maximum(objective, start, tolerance=1e-6, notify=None):
    """The best mesh found from a valid mesh by ever sharper minima: points, J and steps."""
    best, at, steps = (objective.value(start), start), start, 0
    for rho in SHARPNESS:
        at, n = lbfgs(objective, at, rho, 1 / rho, tolerance)
        steps += n
        best = max(best, (objective.value(at), at), key=lambda pair: pair[0])
        if notify:
            notify(rho, n, objective.report(at))
    return best[1], best[0], steps


class Layer:
    """The first layer at the walls `given`, where the mesh has a layer: wall points `foot`, the outer ends `top` of
    their edges, and where these ends should be."""

    def __init__(self, mesh, given):
        self.start = mesh.points
        self.sides = np.concatenate([np.stack([c, np.roll(c, -1, axis=1)], -1).reshape(-1, 2) for c in mesh.cells])
        known = set(map(tuple, self.sides))
        faces = np.concatenate([mesh.sides[name] for name in given])
        self.faces = np.array([face if tuple(face) in known else face[::-1] for face in faces])
        self.boundary = np.unique(np.concatenate([faces.ravel() for faces in mesh.sides.values()]))
        self._find()

    def _sum(self, values):
        """The sums of the values of faces over their ends, for all points."""
        total = np.zeros(len(self.start), values.dtype)
        for end in (0, 1):
            np.add.at(total, self.faces[:, end], values)
        return total

    def _find(self):
        z, way = self.start, self.start[self.faces[:, 1]] - self.start[self.faces[:, 0]]
        count, length = self._sum(np.ones(len(way))), self._sum(abs(way))
        normal = 1j * self._sum(way / abs(way))
        edges = np.concatenate([self.sides, self.sides[:, ::-1]])
        edges = edges[(count[edges[:, 0]] > 0) & (count[edges[:, 1]] == 0)]
        edge = z[edges[:, 1]] - z[edges[:, 0]]
        height = cross(-1j * normal[edges[:, 0]], edge) / abs(normal[edges[:, 0]])
        above = dict(tuple(edges[k]) for k in np.argsort(height / abs(edge)) if height[k] > 0)
        high = {tuple(e): h for e, h in zip(edges, height)}
        thin = [(a, b) for a, b in above.items() if length[a] > LAYER * count[a] * high[a, b]]
        self.foot, self.top = np.array(sorted(thin), int).reshape(-1, 2).T
        inner = ~np.isin(self.top, self.boundary)
        self.foot, self.top = self.foot[inner], self.top[inner]

    def turn(self, at):
        """The mean rotation of both faces beside each wall point; the shorter face counts more, as in the program."""
        a, b = self.faces.T
        before, now = self.start[b] - self.start[a], at[b] - at[a]
        turned = now / abs(now) / before * abs(before)
        weight = 1 / abs(before)
        total = self._sum(weight * turned)[self.foot]
        return total / abs(total)

    def wanted(self, at):
        """Where the outer ends should be: at the heights and angles before."""
        return at[self.foot] + self.turn(at) * (self.start[self.top] - self.start[self.foot])

    def error(self, at):
        """The largest distance of an outer end from there, in parts of its edge; 0 without a layer."""
        if not len(self.foot):
            return 0.0
        return (abs(at[self.top] - self.wanted(at)) / abs(self.start[self.top] - self.start[self.foot])).max()


def with_layer(mesh, layer, start):
    """A valid mesh whose first layer is where it should be. Where no such mesh is found, the layer stays near there."""
    at, inner = start, np.setdiff1d(np.arange(len(start)), layer.boundary)
    if layer.error(at) < 1e-9:
        return at
    wanted = layer.wanted(at)
    for strength in (1, 1e2, 1e4):
        weight = strength / abs(wanted - at[layer.foot]) ** 2
        objective = Objective(mesh, inner, (layer.top, wanted, weight))
        at, _ = lbfgs(objective, at, 10, 0.1, 1e-5, limit=150)
        trial = at.copy()
        trial[layer.top] = wanted
        if objective.report(trial)[0] > 0.5 * objective.report(at)[0]:
            return trial
    return at


def free_points(mesh, layer):
    """The points that the objective may move."""
    return np.setdiff1d(np.arange(len(mesh.points)), np.append(layer.boundary, layer.top))


def reference(mesh, given, starts, notify=None):
    """The best mesh that L-BFGS finds from some valid meshes with the same boundary; its smallest and mean quality, the
    distance of its layer from where it should be, and the steps."""
    layer = Layer(mesh, given)
    objective = Objective(mesh, free_points(mesh, layer))
    found, steps = [], 0
    for k, start in enumerate(starts):
        at, n = lbfgs(objective, with_layer(mesh, layer, start), SHARPNESS[0], 1 / SHARPNESS[0], 1e-5)
        steps += n
        found.append((layer.error(at) < 1e-6, objective.value(at), -k, at))
    at, _, n = maximum(objective, max(found)[3], notify=notify)
    return at, (*objective.report(at), layer.error(at), steps + n)
