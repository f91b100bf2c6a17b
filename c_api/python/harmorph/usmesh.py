"""IDWarp's protocol: ADflow and DAFoam take a ``USMesh`` as the object that warps their mesh.

The displacements of the surface points are given point by point, and harmorph carries them to the
mesh (:meth:`harmorph.Morph.displace`). The names and arrays are those of ``idwarp.USMesh``:
coordinates have three columns, and points of the mesh are named by their number in the common grid.
"""

from __future__ import annotations

from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .conditions import Given
from .errors import Error
from .boundary import Marker
from .mesh import Mesh
from .morph import Morph
from .plane import Plane
from .surface import Surface


class USMesh(Surface):
    """A mesh that is warped by the coordinates of its surface.

    Parameters
    ----------
    grid : Mesh, Plane or path
        The common grid, the same on all processes. A :class:`harmorph.Mesh`, or a file of it, lies
        in the plane z = 0 of the solver; a :class:`harmorph.Plane` is a grid one cell thick, or a
        wedge, whose points are those of the grid of three dimensions.
    surfaces : marker or sequence of marker
        The markers that the solver's surface consists of.
    comm : mpi4py communicator, optional
        Each process then gives and receives its own part of the surface and of the grid. None: one
        process.
    conditions : mapping of marker to Condition or str, optional
        Of the other markers, for instance {"far": "slip"}; the default is fixed.
    tolerance : float
        How far a surface point may be from its place in the grid [length]; 0 means 1e-6 of the
        extent of the grid.
    **options
        Passed to :class:`harmorph.Morph`: operator, threads, ...

    Notes
    -----
    All processes call each method together, as those of IDWarp. Each process has the whole grid,
    and each computes the same bits.
    """

    def __init__(
        self,
        grid: Union[Mesh, Plane, str],
        surfaces: Union[Marker, Sequence[Marker]],
        comm: Any = None,
        *,
        conditions: Given = None,
        tolerance: float = 0.0,
        **options: Any,
    ) -> None:
        self.comm = comm
        self._plane = grid if isinstance(grid, Plane) else None
        if isinstance(grid, Plane):
            mesh = grid.mesh
        else:
            mesh = grid if isinstance(grid, Mesh) else Mesh.read(grid)
        names = [surfaces] if isinstance(surfaces, (str, int)) else surfaces
        given: List[Tuple[Marker, Any]] = [(name, "given") for name in names]
        more = conditions.items() if isinstance(conditions, Mapping) else conditions or ()
        others: List[Tuple[Marker, Any]] = list(more)
        self._morph = Morph(mesh, conditions=given + others, **options)
        self._start = grid.points if isinstance(grid, Plane) else _raised(self._morph.start)
        self._follows = grid.follows if isinstance(grid, Plane) else np.arange(mesh.n_points)
        self._given = self._morph.given_points
        extent = np.ptp(self._start, axis=0).max()
        self._tolerance = tolerance or 1e-6 * extent
        self._volume = self._start.copy()
        self._indices = np.arange(len(self._start))
        self._surface: Optional[np.ndarray] = None
        self._surface_start = np.empty((0, 3))
        self._place = np.empty(0, int)
        self._dxs = np.empty((0, 3))

    # ---- The protocol ----

    def __repr__(self) -> str:
        return f"USMesh({self._morph!r})"

    def setExternalMeshIndices(self, ind: Any) -> None:
        """Name the points of the common grid that this process needs.

        Parameters
        ----------
        ind : int array of shape (n,)
            Numbers of points, from 0.
        """
        indices = np.asarray(ind)
        if indices.size and (indices.min() < 0 or indices.max() >= len(self._start)):
            raise Error(f"ind must be between 0 and {len(self._start) - 1}; it reaches from "
                        f"{indices.min()} to {indices.max()}.")
        self._indices = indices.astype(int)

    def setSurfaceDefinition(self, pts: Any, conn: Any, faceSizes: Any, cgnsBlockID: Any = None) -> None:
        """Say where the surface points of this process are.

        Parameters
        ----------
        pts : array of shape (n, 3)
            Coordinates; each point must be at a place of the surfaces in the grid. Points of both
            layers of a grid one cell thick, and repeated points, are allowed.
        conn, faceSizes, cgnsBlockID
            Not used: the faces are those of the grid.
        """
        points = _three(pts, "pts")
        self._place = self._nearest(points)
        self._surface, self._surface_start = points.copy(), points
        self._dxs = np.zeros_like(points)

    def getSurfaceCoordinates(self) -> np.ndarray:
        """Return the surface coordinates of this process, shape (n, 3)."""
        if self._surface is None:  # as IDWarp, all surface points of the grid on the first process
            here = np.flatnonzero(np.isin(self._follows, self._given))
            if self.comm is not None and self.comm.rank > 0:
                here = here[:0]
            self.setSurfaceDefinition(self._start[here], np.empty(0, int), np.empty(0, int))
        assert self._surface is not None
        return self._surface.copy()

    def setSurfaceCoordinates(self, coordinates: Any) -> None:
        """Give the new coordinates of the surface points of this process, shape (n, 3)."""
        points = _three(coordinates, "coordinates")
        if self._surface is None:
            self.getSurfaceCoordinates()
        assert self._surface is not None
        if points.shape != self._surface.shape:
            raise Error(f"coordinates must have the shape {self._surface.shape}, not {points.shape}.")
        self._surface = points.copy()

    def warpMesh(self) -> None:
        """Move the grid so that it follows the surface coordinates.

        Raises
        ------
        Error
            A displacement leaves the plane, or differs between copies of a point; a point of the
            surfaces has no displacement.
        """
        self.getSurfaceCoordinates()
        assert self._surface is not None
        wall = self._wall(self._surface - self._surface_start)
        self._volume = self._spread(self._morph.displace(wall), self._start)

    def getSolverGrid(self) -> np.ndarray:
        """Return the grid of this process, flat, shape (3 * n,) with n given indices."""
        return self._volume[self._indices].ravel()

    def getCommonGrid(self) -> np.ndarray:
        """Return the whole grid, flat, in the order of the common grid."""
        return self._volume.ravel().copy()

    def getWarpGrid(self) -> np.ndarray:
        """Return the whole grid, flat: the order of warping is that of the common grid."""
        return self.getCommonGrid()

    def warpDeriv(self, dXv: Any, solverVec: bool = True) -> None:
        """Compute derivatives by the surface points from those by the grid; see :meth:`getdXs`.

        Parameters
        ----------
        dXv : array of shape (3 * n,)
            Derivatives by the points that :meth:`setExternalMeshIndices` named on this process.
            Those of all processes are added.
        solverVec : bool
            False: derivatives by the whole grid, the same on all processes.
        """
        self.getSurfaceCoordinates()
        if solverVec:
            values = self._flat(dXv, len(self._indices), "dXv")
            whole = np.zeros_like(self._start)
            np.add.at(whole, self._indices, values)
            if self.comm is not None:
                whole = np.sum(self.comm.allgather(whole), axis=0)
        else:
            whole = self._flat(dXv, len(self._start), "dXv")
        force = self._morph.displace_adjoint(self._gather(whole))
        self._dxs = self._of_wall(force)

    def getdXs(self) -> np.ndarray:
        """Return the derivatives by the surface points of this process, shape (n, 3).

        Several surface points that follow one point of the plane have equal parts of its derivative.
        """
        return self._dxs.copy()

    def warpDerivFwd(self, dXs: Any, solverVec: bool = True) -> np.ndarray:
        """Return the movement of the grid for a movement of the surface points.

        Parameters
        ----------
        dXs : array of shape (n, 3)
        solverVec : bool
            False: of the whole grid.

        Returns
        -------
        ndarray of shape (3 * n,)
        """
        self.getSurfaceCoordinates()
        seeds = _three(dXs, "dXs")
        if seeds.shape != self._surface_start.shape:
            raise Error(f"dXs must have the shape {self._surface_start.shape}, not {seeds.shape}.")
        wall = self._mean(seeds)
        moved = self._spread(self._morph.displace(wall), None)
        return (moved[self._indices] if solverVec else moved).ravel()

    def writeGrid(self, fileName: Any) -> None:
        """Write the mesh of the plane to a file, on the first process; see :meth:`harmorph.Mesh.write`."""
        if self.comm is None or self.comm.rank == 0:
            points = self._morph.start + self._gather_mean(self._volume - self._start)
            assert self._morph.mesh is not None
            self._morph.mesh.write(fileName, points)

    @staticmethod
    def _flat(values: Any, n: int, what: str) -> np.ndarray:
        array = np.asarray(values, float)
        if array.size != 3 * n:
            raise Error(f"{what} must have {3 * n} numbers, not {array.size}.")
        return array.reshape(n, 3)


def _raised(points: Any) -> np.ndarray:
    return np.column_stack([points, np.zeros(len(points))])


def _three(points: Any, what: str) -> np.ndarray:
    array = np.array(points, float)
    if array.size == 0:
        return array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise Error(f"{what} must have the shape (n, 3), not {array.shape}.")
    return array
