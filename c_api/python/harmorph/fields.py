"""Fields of moving meshes for flow solvers: swept areas, distances to the walls, first layers."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, int32_view, int32s, points_in, points_out
from .boundary import Marker
from .errors import MEMORY, Error, call, call_with_memory
from .mesh import Mesh
from .reports import Report, new


def swept_areas(mesh: Mesh, to: Any, start: Any = None) -> Report:
    """Return the areas that lines of the mesh sweep while its points move linearly.

    Parameters
    ----------
    mesh : Mesh
    to, start : arrays of shape (n_points, 2)
        The mesh points after and before the movement; `start` None means ``mesh.points``.

    Returns
    -------
    Report
        `sides` and `duals`, of shape (n,), have one entry for each entry of ``mesh.cell_rows()[1]``:
        the side from this point of the cell to the next, and the face of the median dual from the
        middle of this side to the mean of the corners. `halves`, of shape (n, 2), are the halves of
        the sides. Unit: length^2. A line that moves to its right, seen along its direction, has a
        positive area, so the sum over the sides of a counter-clockwise cell is the growth of its area.
    """
    n = ffi.new("int64_t*")
    call(lib.hm_swept_count, mesh._c, n)
    result = Report(sides=np.empty(n[0]), duals=np.empty(n[0]), halves=np.empty((n[0], 2)))
    target, _target = points_in(to, mesh.n_points, "to")
    first, _first = points_in(mesh.points if start is None else start, mesh.n_points, "start")
    views = [ffi.from_buffer("double[]", array) for array in vars(result).values()]
    call(lib.hm_swept_areas, mesh._c, first, target, *views, ffi.NULL)
    kept = mesh._distinct_sides()
    return result if kept is None else Report(**{name: array[kept] for name, array in vars(result).items()})


class Walls:
    """The faces of chosen markers in one position of the mesh, for distances to them.

    Parameters
    ----------
    mesh : Mesh
    markers : sequence of markers
        The walls.

    Attributes
    ----------
    faces : int32 ndarray of shape (n_faces, 2)
        The points of each face, in order along the boundary with the mesh on the left.
    points, layer_points : int32 ndarrays of shape (n_wall_points,)
        The points of the walls, and for each of them the other end of its first-layer edge, or -1.
    """

    def __init__(self, mesh: Mesh, markers: Sequence[Marker]) -> None:
        numbers = int32s(mesh.numbers_of(markers), "markers")
        analysis, _block = mesh._analysis()
        walls, view = ffi.new("hm_walls**"), int32_view(numbers)
        self._block = call_with_memory(lib.hm_walls_init, walls, MEMORY, analysis, len(numbers), view, ffi.NULL)
        self._walls, self._n = walls[0], mesh.n_points
        info = new("hm_walls_info")
        call(lib.hm_walls_info_get, self._walls, info)
        self.faces = _copy(info.face_points, 2 * info.n_faces).reshape(-1, 2)
        self.points = _copy(info.wall_points, info.n_wall_points)
        self.layer_points = _copy(info.layer_points, info.n_wall_points)

    def __repr__(self) -> str:
        return f"Walls({len(self.faces)} faces, {len(self.points)} points)"

    def move(self, points: Any) -> None:
        """Move the walls to the mesh points `points` [n_points, 2], after a morph for instance."""
        view, _alive = points_in(points, self._n, "points")
        call(lib.hm_walls_move, self._walls, view)

    def distance(self, points: Any, hint: Optional[Any] = None) -> Report:
        """Return the exact distances of any points to the nearest place on the walls.

        Parameters
        ----------
        points : array of shape (n, 2)
        hint : int array of shape (n,), optional
            Faces that are probably nearest, which save time: `face` before the last movement.

        Returns
        -------
        Report
            `distance` [length], `face` and `parameter`, of shape (n,): the nearest place is
            (1 - parameter) * first + parameter * second point of the face.
        """
        n = len(points[0]) if isinstance(points, tuple) else len(points)
        view, _alive = points_in(points, n, "points")
        hints = ffi.NULL
        if hint is not None:
            faces = int32s(hint, "hint")
            if faces.shape != (n,):
                raise Error(f"hint must have the shape ({n},), not {faces.shape}.")
            hints = int32_view(faces)
        result = Report(distance=np.empty(n), face=np.empty(n, np.int32), parameter=np.empty(n))
        call(lib.hm_wall_distance, self._walls, n, view, hints, ffi.from_buffer("double[]", result.distance),
             int32_view(result.face), ffi.from_buffer("double[]", result.parameter), ffi.NULL)
        return result

    def distance_change(self, points: Any, face: Any, change: Any = None, mesh_change: Any = None) -> np.ndarray:
        """Return the derivative of the distances of `points`, shape (n,), each to the face that is nearest.

        Parameters
        ----------
        points, face
            The points of :meth:`distance`, and the faces that the call has found.
        change : array of shape (n, 2), optional
            Changes of the points; None: 0.
        mesh_change : array of shape (n_points, 2), optional
            Changes of the mesh points, which move the walls; None: 0.
        """
        n, view, faces, _alive = self._faced(points, face)
        first, _first = (ffi.NULL, None) if change is None else points_in(change, n, "change")
        second, _second = (ffi.NULL, None)
        if mesh_change is not None:
            second, _second = points_in(mesh_change, self._n, "mesh_change")
        result = np.empty(n)
        call(lib.hm_wall_distance_change, self._walls, n, view, faces, first, second,
             ffi.from_buffer("double[]", result))
        return result

    def distance_adjoint(self, points: Any, face: Any, dj: Any) -> Tuple[np.ndarray, np.ndarray]:
        """Return derivatives by the points and by the mesh points from those by the distances.

        Parameters
        ----------
        points, face
            The points of :meth:`distance`, and the faces that the call has found.
        dj : array of shape (n,)

        Returns
        -------
        point_dj : ndarray of shape (n, 2)
        mesh_dj : ndarray of shape (n_points, 2)
            Where the points are the mesh points, the derivative is the sum of both.
        """
        n, view, faces, _alive = self._faced(points, face)
        result = np.zeros((n, 2)), np.zeros((self._n, 2))
        (first, _first), (second, _second) = (points_out(one, len(one), "out") for one in result)
        call(lib.hm_wall_distance_adjoint, self._walls, n, view, faces, doubles(dj, (n,), "dj"), first, second)
        return result

    def _faced(self, points: Any, face: Any) -> tuple:
        n = len(points[0]) if isinstance(points, tuple) else len(points)
        view, alive = points_in(points, n, "points")
        faces = int32s(face, "face")
        if faces.shape != (n,):
            raise Error(f"face must have the shape ({n},), not {faces.shape}.")
        return n, view, int32_view(faces), (alive, faces)

    def heights(self, points: Any) -> np.ndarray:
        """Return the heights of the first layer at the wall points, for the mesh points `points`.

        A height is 0 where no edge leaves the wall.
        """
        view, _alive = points_in(points, self._n, "points")
        result = np.empty(len(self.points))
        call(lib.hm_first_layer, self._walls, ffi.NULL, view, ffi.from_buffer("double[]", result), ffi.NULL, ffi.NULL)
        return result

    def layer_changes(self, before: Any, points: Any) -> Tuple[np.ndarray, np.ndarray]:
        """Return how the first layer has changed at the wall points, from the mesh points `before` to `points`.

        Returns
        -------
        ratios : ndarray of shape (n,)
            Heights after divided by heights before; 1 where no edge leaves the wall.
        angles : ndarray of shape (n,)
            Degrees by which the edges have rotated more than the wall; 0 where no edge leaves the wall.
        """
        (start, _start), (view, _view) = points_in(before, self._n, "before"), points_in(points, self._n, "points")
        ratios, angles = np.empty(len(self.points)), np.empty(len(self.points))
        call(lib.hm_first_layer, self._walls, start, view, ffi.NULL,
             *(ffi.from_buffer("double[]", one) for one in (ratios, angles)))
        return ratios, angles


def _copy(pointer: Any, n: int) -> np.ndarray:
    return np.frombuffer(ffi.buffer(pointer, 4 * n), np.int32).copy() if n else np.empty(0, np.int32)
