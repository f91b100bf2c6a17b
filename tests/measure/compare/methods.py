"""Methods that deform meshes, beside which harmorph is measured.

Each class is made from a domain and its points `at` (complex numbers) now, and moved(wall) returns all points where the
wall is at these places. A domain has the arrays
    cells     triangles [m, 3] and quadrilaterals [m, 4], counter-clockwise
    wall      the points that move; next, previous: their neighbours along the wall
    outer     the points of the boundary that stay
    inner     all other points
"""

import numpy as np
from scipy import linalg, sparse
from scipy.sparse.linalg import splu
from scipy.spatial.distance import cdist


def cross(u, v):
    return (u.conj() * v).imag


def area(z):
    return 0.5 * cross(z, np.roll(z, -1, axis=1)).sum(axis=1)


class Elasticity:
    """The mesh as an elastic solid of stiffness 1 / area, as SU2_DEF has it: linear triangles, plane strain,
    quadrilaterals as the mean of their two divisions. R. P. Dwight, Robust mesh deformation using the linear elasticity
    equations, Computational Fluid Dynamics 2006."""

    poisson = 0.35

    def __init__(self, domain, at):
        self.domain, self.at, nu = domain, at, self.poisson
        triangles, quads = domain.cells
        corner = np.concatenate([triangles] + [np.roll(quads, k, axis=1)[:, :3] for k in range(4)])
        part = np.repeat([1, 0.5], [len(triangles), 4 * len(quads)])
        z = at[corner]
        by = (np.roll(z, -2, axis=1) - np.roll(z, -1, axis=1)) / (2 * area(z)[:, None])  # the gradients, turned
        strain = np.zeros((len(z), 3, 6))
        strain[:, 0, 0::2] = strain[:, 2, 1::2] = -by.imag
        strain[:, 1, 1::2] = strain[:, 2, 0::2] = by.real
        law = np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, 0.5 - nu]]) / ((1 + nu) * (1 - 2 * nu))
        local = part[:, None, None] * (strain.transpose(0, 2, 1) @ law @ strain)
        number = (2 * corner[:, :, None] + [0, 1]).reshape(-1, 6)
        matrix = sparse.coo_matrix((local.ravel(), (np.repeat(number, 6), np.tile(number, (1, 6)).ravel()))).tocsr()
        self.unknown = (2 * domain.inner[:, None] + [0, 1]).ravel()
        self.known = (2 * domain.wall[:, None] + [0, 1]).ravel()
        rows = matrix[self.unknown]
        self.boundary = rows[:, self.known]
        self.factor = splu(rows[:, self.unknown].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0,
                           options={"SymmetricMode": True})

    def moved(self, wall):
        out, move = self.at.copy(), wall - self.at[self.domain.wall]
        out[self.domain.inner] += -self.factor.solve(self.boundary @ move.view(float)).view(complex)
        out[self.domain.wall] = wall
        return out


class RadialBasis:
    """Wendland's C2 function with compact support, without a polynomial. A. de Boer, M. S. van der Schoot, H. Bijl,
    Comput. Struct. 85 (2007) 784. radius: in chords."""

    def __init__(self, domain, at, radius=10):
        self.domain, self.at, self.radius = domain, at, radius
        self.centre = at[np.append(domain.wall, domain.outer)]
        self.factor = linalg.lu_factor(self.wendland(self.centre))

    def wendland(self, at):
        x = cdist(at.view(float).reshape(-1, 2), self.centre.view(float).reshape(-1, 2)) / self.radius
        rest = np.maximum(1 - x, 0) ** 2
        return rest * rest * (4 * x + 1)

    def moved(self, wall):
        out, move = self.at.copy(), np.zeros(len(self.centre), complex)  # the outer boundary stays
        move[: len(wall)] = wall - self.at[self.domain.wall]
        weight = linalg.lu_solve(self.factor, move.view(float).reshape(-1, 2))
        for part in blocks(self.domain.inner):
            out[part] += self.wendland(self.at[part]) @ weight @ [1, 1j]
        out[self.domain.wall] = wall
        return out


class InverseDistance:
    """Displacement and rotation of the boundary, averaged by inverse distances, as IDWarp does: E. Luke, E. Collins,
    E. Blades, A fast mesh deformation method using explicit interpolation, J. Comput. Phys. 231 (2012) 586, with the
    exponents 3 and 5 and the fraction 0.25 that are usual there."""

    alpha = 0.25

    def __init__(self, domain, at):  # nothing is prepared: the weights follow from distances to boundary points
        self.domain, self.at = domain, at

    def moved(self, wall):
        domain, at = self.domain, self.at
        out = at.copy()
        out[domain.wall] = wall
        turn = 0
        for other in (domain.previous, domain.next):
            ratio = (out[other] - wall) / (at[other] - at[domain.wall])
            turn = turn + abs(at[other] - at[domain.wall]) * ratio / abs(ratio)
        turn /= abs(turn)
        length = (abs(at[domain.previous] - at[domain.wall]) + abs(at[domain.next] - at[domain.wall])) / 2
        size = abs(at[domain.outer] - at[domain.outer].mean()).max()  # half the width of the domain
        source = at[np.append(domain.wall, domain.outer)]
        length = np.append(length, np.full(len(domain.outer), 2 * np.pi * size / len(domain.outer)))
        turns = np.append(turn, np.ones(len(domain.outer)))  # each source moves z to turn z + shift
        shifts = np.append(wall - turn * at[domain.wall], np.zeros(len(domain.outer)))
        for part in blocks(domain.inner):
            ratio = size / abs(at[part][:, None] - source)
            weight = length * (ratio**3 + (self.alpha * ratio) ** 5)
            out[part] = (at[part] * (weight @ turns) + weight @ shifts) / weight.sum(axis=1)
        return out


def blocks(points):
    return np.array_split(points, len(points) // 256 + 1)
