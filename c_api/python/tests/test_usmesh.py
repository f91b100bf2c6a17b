"""IDWarp's protocol, as class USMesh in idwarp/UnstructuredMesh.py (mdolab/idwarp, read 2026-11-24)
documents it: names of methods, shapes and orders. IDWarp itself is not installed here.

A solver (ADflow, DAFoam) calls, in this order: setExternalMeshIndices, setSurfaceDefinition,
getSurfaceCoordinates, setSurfaceCoordinates, warpMesh, getSolverGrid, warpDeriv, getdXs,
warpDerivFwd.
"""

import sys

import harmorph
import numpy as np
import pytest
from conftest import ring_mesh
from harmorph.usmesh import USMesh
from test_plane import thick


def grids(kind):
    mesh = ring_mesh(ni=33, nj=9)
    if kind == "2D":
        return mesh, np.column_stack([mesh.points, np.zeros(mesh.n_points)])
    points, faces, sides = thick(mesh, kind == "wedge")
    return harmorph.Plane(points, faces, sides), points


def surface(grid, points):
    mesh = grid if isinstance(grid, harmorph.Mesh) else grid.mesh
    follows = np.arange(mesh.n_points) if mesh is grid else grid.follows
    return np.flatnonzero(np.isin(follows, mesh.faces("wall")))


def stretched(points, size, kind):
    """The surface moves in its plane: x by a parabola of x, and outward by a wave."""
    move = np.zeros_like(points)
    move[:, 0] = size * points[:, 0] ** 2
    if kind == "wedge":
        radius = np.hypot(points[:, 1], points[:, 2])
        move[:, 1:] = (size * np.sin(points[:, 0]) / radius)[:, None] * points[:, 1:]
    else:
        move[:, 1] = size * np.sin(points[:, 0])
    return move


@pytest.mark.parametrize("kind", ["2D", "planes", "wedge"])
def test_the_order_of_calls_of_a_solver(kind, random):
    grid, points = grids(kind)
    warper = USMesh(grid, ["wall"])
    indices = random.permutation(len(points))
    warper.setExternalMeshIndices(indices)
    here = random.permutation(surface(grid, points))
    warper.setSurfaceDefinition(points[here], np.arange(len(here)), np.full(len(here) // 4, 4))
    assert np.array_equal(warper.getSurfaceCoordinates(), points[here])
    assert np.array_equal(warper.getSolverGrid(), points[indices].ravel())
    move = stretched(points[here], 0.05, kind)
    warper.setSurfaceCoordinates(points[here] + move)
    warper.warpMesh()
    solver_grid = warper.getSolverGrid().reshape(-1, 3)
    common = np.empty_like(points)
    common[indices] = solver_grid
    assert abs(common[here] - points[here] - move).max() < 1e-14  # the wall is exact
    assert np.array_equal(warper.getCommonGrid(), common.ravel())
    assert np.array_equal(warper.getWarpGrid(), common.ravel())
    # The derivatives are linear and transposes of each other.
    seed, dual = stretched(points[here], 1.0, kind), random.normal(size=3 * len(points))
    forward = warper.warpDerivFwd(seed)
    warper.warpDeriv(dual)
    backward = warper.getdXs()
    assert backward.shape == (len(here), 3)
    assert forward @ dual == pytest.approx((seed * backward).sum(), rel=1e-11)
    assert forward * 0.05 == pytest.approx((common - points)[indices].ravel(), abs=1e-12)
    whole = np.empty((len(points), 3))
    whole[indices] = dual.reshape(-1, 3)
    warper.warpDeriv(whole.ravel(), solverVec=False)
    assert np.array_equal(warper.getdXs(), backward)
    assert np.array_equal(warper.warpDerivFwd(seed, solverVec=False).reshape(-1, 3)[indices].ravel(), forward)


def test_a_random_seed(random):
    """The products agree for any seed in the plane, also if copies of a point move differently."""
    grid, points = grids("planes")
    warper = USMesh(grid, ["wall"])
    n = len(warper.getSurfaceCoordinates())
    seed, dual = random.normal(size=(n, 3)), random.normal(size=3 * len(points))
    forward = warper.warpDerivFwd(seed)
    warper.warpDeriv(dual)
    assert forward @ dual == pytest.approx((seed * warper.getdXs()).sum(), rel=1e-11)


def test_a_grid_from_a_file(meshes, tmp_path):
    warper = USMesh(meshes / "naca0012.su2", "airfoil", operator="laplace")
    coordinates = warper.getSurfaceCoordinates()
    assert coordinates.shape == (132, 3)
    warper.setSurfaceCoordinates(coordinates + [0.01, 0.02, 0])
    warper.warpMesh()
    warper.writeGrid(tmp_path / "moved.su2")
    moved = harmorph.Mesh.read(tmp_path / "moved.su2")
    assert moved.points.ravel() == pytest.approx(warper.getCommonGrid().reshape(-1, 3)[:, :2].ravel(), abs=1e-12)


def test_refusals():
    grid, points = grids("planes")
    warper = USMesh(grid, ["wall"])
    here = surface(grid, points)
    with pytest.raises(harmorph.Error, match="ind must be"):
        warper.setExternalMeshIndices([len(points)])
    with pytest.raises(harmorph.Error, match="away from the surfaces"):
        warper.setSurfaceDefinition(points[here] + 0.1, [], [])
    with pytest.raises(harmorph.Error, match="shape"):
        warper.setSurfaceDefinition(points[here][:, :2], [], [])
    warper.setSurfaceDefinition(points[here[1:]][:30], [], [])
    with pytest.raises(harmorph.Error, match="No process has"):
        warper.warpMesh()
    warper.setSurfaceDefinition(points[here], [], [])
    with pytest.raises(harmorph.Error, match="shape"):
        warper.setSurfaceCoordinates(points)
    warper.setSurfaceCoordinates(points[here] + [0, 0, 0.1])
    with pytest.raises(harmorph.Error, match="out of its plane"):
        warper.warpMesh()
    bent = points[here].copy()
    bent[0, 1] += 0.1
    warper.setSurfaceCoordinates(bent)
    with pytest.raises(harmorph.Error, match="move differently"):
        warper.warpMesh()
    for use in (warper.warpDeriv, warper.warpDerivFwd):
        with pytest.raises(harmorph.Error):
            use(np.zeros((5, 3)))


PARALLEL = """
from mpi4py import MPI
import numpy as np, sys
sys.path.insert(0, sys.argv[1])
from test_usmesh import grids, stretched, surface
from harmorph.usmesh import USMesh
comm = MPI.COMM_WORLD
grid, points = grids("planes")
here = surface(grid, points)
mine, nodes = here[comm.rank::comm.size], np.arange(len(points))[comm.rank::comm.size]
warper, alone = USMesh(grid, ["wall"], comm), USMesh(grid, ["wall"])
warper.setExternalMeshIndices(nodes)
warper.setSurfaceDefinition(points[mine], [], [])
alone.setSurfaceDefinition(points[here], [], [])
warper.setSurfaceCoordinates(points[mine] + stretched(points[mine], .05, "planes"))
alone.setSurfaceCoordinates(points[here] + stretched(points[here], .05, "planes"))
warper.warpMesh(), alone.warpMesh()
assert np.array_equal(warper.getSolverGrid(), alone.getCommonGrid().reshape(-1, 3)[nodes].ravel())
dual = np.sin(np.arange(3.0 * len(points))).reshape(-1, 3)
warper.warpDeriv(dual[nodes].ravel()), alone.warpDeriv(dual.ravel())
assert abs(warper.getdXs() - alone.getdXs()[comm.rank::comm.size]).max() < 1e-13
seed = stretched(points[here], 1.0, "planes")
forward = warper.warpDerivFwd(seed[comm.rank::comm.size])
assert abs(forward - alone.warpDerivFwd(seed).reshape(-1, 3)[nodes].ravel()).max() < 1e-13
print("process %d of %d agrees" % (comm.rank, comm.size))
"""


def test_several_processes(tmp_path):
    pytest.importorskip("mpi4py")
    import os
    import shutil
    import subprocess
    from pathlib import Path

    if not shutil.which("mpirun"):
        pytest.skip("mpirun is not installed")
    script = tmp_path / "parallel.py"
    script.write_text(PARALLEL)
    command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", sys.executable, str(script),
               str(Path(__file__).parent)]
    found = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert found.returncode == 0, found.stderr
    assert all(f"process {k} of 2 agrees" in found.stdout for k in (0, 1))
