"""A dolfinx problem on a morphed mesh: harmorph moves the coordinates of dolfinx where they are.

The mesh is a ring of triangles around an ellipse. Laplace's equation with a linear solution is solved before
and after a movement of the wall; linear elements have no error for it on any mesh.
"""
import dolfinx
import harmorph
import numpy as np
import ufl
from mpi4py import MPI
from petsc4py.PETSc import ScalarType

ni, nj = 96, 24
angle = 2 * np.pi * np.arange(ni) / ni
r = np.exp(2 * np.arange(nj) / (nj - 1))[:, None]
grid = np.stack([(r + 0.4 / r) * np.cos(angle), (r - 0.4 / r) * np.sin(angle)], axis=-1).reshape(-1, 2)
number = np.arange(ni * nj).reshape(nj, ni)
corner = [number[:-1], np.roll(number[:-1], -1, 1), np.roll(number[1:], -1, 1), number[1:]]
cells = np.concatenate([np.stack([corner[k].ravel() for k in three], 1) for three in ((0, 1, 2), (0, 2, 3))])
domain = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.triangle, 1))
mesh = dolfinx.mesh.create_mesh(MPI.COMM_SELF, cells, grid, domain)

# harmorph views the coordinates of dolfinx: two of three columns. dolfinx numbers points in its own way.
points = mesh.geometry.x[:, :2]
given = np.argsort(mesh.geometry.input_global_indices)
ring = harmorph.Mesh(points, mesh.geometry.dofmap.array.reshape(-1, 3),
                     {"wall": given[np.append(number[0], number[0, 0])],
                      "far": given[np.append(number[-1], number[-1, 0])]})
assert np.shares_memory(ring.points, mesh.geometry.x)
curves = harmorph.Curves.fit(ring, "wall", n_control=12, closed="periodic")
morph = harmorph.Morph(ring, curves)


def error():
    """Solve, and return the largest difference from the exact solution at the points."""
    space = dolfinx.fem.FunctionSpace(mesh, ("Lagrange", 1))
    exact = dolfinx.fem.Function(space)
    exact.interpolate(lambda x: 1 + 2 * x[0] - 3 * x[1])
    mesh.topology.create_connectivity(1, 2)
    edges = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    boundary = dolfinx.fem.dirichletbc(exact, dolfinx.fem.locate_dofs_topological(space, 1, edges))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    load = dolfinx.fem.Constant(mesh, ScalarType(0)) * v * ufl.dx
    problem = dolfinx.fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, load, [boundary],
                                              petsc_options={"ksp_type": "preonly", "pc_type": "lu"})
    return abs(problem.solve().x.array - exact.x.array).max()


def area():
    return dolfinx.fem.assemble_scalar(dolfinx.fem.form(dolfinx.fem.Constant(mesh, ScalarType(1)) * ufl.dx))


before = area()
print(f"error before {error():.1e}")
move = np.zeros((12, 2))
move[curves.control[:, 1] > 0, 1] = 0.15
quality = morph.assess(morph.displacement(move)).quality
morph.morph(move, points, out=points)
print(f"error after {error():.1e}; inverted cells {quality.inverted}")
wall = [curve.measure("area", chord=((-1, 0), (1, 0))).values[0] for curve in (curves, curves.moved(move))]
print(f"area: {before - area():.4f} less for a section of {wall[1] - wall[0]:.4f} more")
