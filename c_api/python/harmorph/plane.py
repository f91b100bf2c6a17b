"""Meshes of three dimensions that are one cell thick: planes and wedges."""

from __future__ import annotations

from typing import Any, Mapping, Optional

import numpy as np

from ._native import ffi, lib
from .arrays import int32_view, int32s, numbers, points_in, points_out
from .errors import MEMORY, Error, call, call_with_memory
from .boundary import Marker, numbered
from .mesh import Mesh
from .reports import Report, fill, new, report
from .words import SPACES


class Plane:
    """The mesh of one symmetry plane of a mesh of three dimensions, and the way back.

    Parameters
    ----------
    points : array of shape (n_space_points, 3)
        Coordinates of all points: layers of points in parallel planes, or in planes rotated about
        an axis (a wedge).
    faces : int array of shape (n_cells, 3) or (n_cells, 4)
        The faces in one symmetry plane; they are the cells of the mesh of the plane. A triangle
        among quadrilaterals repeats its last point.
    sides : mapping of marker to int array of shape (m, 4)
        Faces of the boundary from one layer to the next, by marker. A triangle at the axis of a
        wedge repeats a point.
    kind : {"auto", "planes", "wedge"}
    axis_point, axis : sequences of three floats, optional
        A point of the axis and its direction; the default of a wedge is to find the axis.
    tolerance : float
        How far a point may be from its place [length]; 0 means 1e-5 of the extent.

    Attributes
    ----------
    mesh : Mesh
        The mesh of the plane.
    follows : int32 ndarray of shape (n_space_points,)
        The plane point that each point follows.
    info : Report
        {members of hm_plane_info}

    Raises
    ------
    Error
        ``BAD_MESH``: the mesh is not one cell thick.
    """

    def __init__(
        self,
        points: Any,
        faces: Any,
        sides: Mapping[Marker, Any],
        *,
        kind: str = "auto",
        axis_point: Optional[Any] = None,
        axis: Optional[Any] = None,
        tolerance: float = 0.0,
    ) -> None:
        if kind not in SPACES:
            raise Error(f"kind must be one of {list(SPACES)}, not {kind!r}.")
        xyz = np.array(numbers(points, "points"), np.float64, order="C")
        if xyz.ndim != 2 or xyz.shape[1] != 3:
            raise Error(f"points must have the shape (n, 3), not {xyz.shape}.")
        cells = int32s(faces, "faces", 2)
        if cells.shape[1] == 3:
            cells = np.ascontiguousarray(cells[:, [0, 1, 2, 2]])
        if cells.shape[1] != 4:
            raise Error(f"faces must have 3 or 4 columns; their shape is {cells.shape}.")
        markers = numbered(sides)
        tables = [int32s(sides[name], f"The sides of marker {name!r}", 2) for name in markers]
        if any(one.shape[1] != 4 for one in tables):
            raise Error("sides must have 4 columns.")
        quads = np.concatenate(tables) if tables else np.empty((0, 4), np.int32)
        numbers_of_sides = np.repeat(np.array(list(markers.values()), np.int32), [len(t) for t in tables])
        space = new("hm_space_mesh")
        space.n_points, space.points = len(xyz), self._view(xyz)
        space.kind = SPACES[kind]
        space.n_faces, space.face_points = len(cells), int32_view(cells.reshape(-1))
        side_points = np.ascontiguousarray(quads.reshape(-1))
        space.n_sides = len(quads)
        space.side_points, space.side_markers = int32_view(side_points), int32_view(numbers_of_sides)
        for name, value in (("axis_point", axis_point), ("axis", axis)):
            if value is not None:
                setattr(space, name, _triple(value, name))
        fill(space, tolerance=tolerance)
        plane = ffi.new("hm_plane**")
        names = {number: name for name, number in markers.items() if isinstance(name, str)}
        self._block = call_with_memory(lib.hm_plane_init, plane, MEMORY, space, names=names)
        self._plane, self._points = plane[0], xyz
        info, view = new("hm_plane_info"), new("hm_mesh")
        call(lib.hm_plane_info_get, self._plane, info)
        call(lib.hm_plane_mesh, self._plane, view)
        self.info: Report = report(info)
        self.follows = np.frombuffer(ffi.buffer(info.follows, 4 * len(xyz)), np.int32).copy()
        self.mesh = self._mesh(view, markers)

    def __repr__(self) -> str:
        return f"Plane({len(self.follows)} points, of which {self.mesh.n_points} in the plane)"

    @staticmethod
    def _view(xyz: np.ndarray) -> tuple:
        start = ffi.from_buffer("double[]", xyz)
        return (start, start + 1, start + 2, 3)

    @staticmethod
    def _mesh(view: Any, markers: Mapping[Marker, int]) -> Mesh:
        def ints(pointer: Any, n: int) -> np.ndarray:
            return np.frombuffer(ffi.buffer(pointer, 4 * n), np.int32).copy() if n else np.empty(0, np.int32)

        n, stride = view.n_points, max(view.points.stride, 1)
        xy = np.array([[view.points.x[k * stride], view.points.y[k * stride]] for k in range(n)])
        if view.cell_layout in (lib.HM_CELLS_TRIANGLES, lib.HM_CELLS_QUADS):
            width = 3 if view.cell_layout == lib.HM_CELLS_TRIANGLES else 4
            cells: Any = ints(view.cell_points, width * view.n_cells).reshape(-1, width)
        else:
            start = ints(view.cell_start, view.n_cells + 1)
            cells = (start, ints(view.cell_points, int(start[-1])))
        edges = ints(view.face_points, 2 * view.n_faces).reshape(-1, 2)
        of_edges = ints(view.face_markers, view.n_faces)
        boundary = {name: edges[of_edges == number] for name, number in markers.items()}
        return Mesh(xy, cells, boundary, polygons=view.cell_layout == lib.HM_CELLS_POLYGONS)

    @property
    def points(self) -> np.ndarray:
        """A copy of the coordinates of all points, shape (n_space_points, 3)."""
        return self._points.copy()

    def spread(self, displacement: Any, points: Any = None) -> np.ndarray:
        """Return `points` plus the displacement of the plane point that each point follows.

        Parameters
        ----------
        displacement : array of shape (mesh.n_points, 2)
            In the plane [length].
        points : array of shape (n_space_points, 3), optional
            None: displacements of all points are returned.

        Returns
        -------
        ndarray of shape (n_space_points, 3)
        """
        view, _alive = points_in(displacement, self.mesh.n_points, "displacement")
        result = np.empty_like(self._points)
        from_ = ffi.NULL
        if points is not None:
            xyz = self._all(points, "points")
            from_ = ffi.new("hm_space_points*", self._view(xyz))
        to = ffi.new("hm_space_points_out*", self._view(result))
        call(lib.hm_plane_spread, self._plane, view, from_, to, ffi.NULL)
        return result

    def gather(self, dj: Any) -> np.ndarray:
        """The transpose of :meth:`spread`: sum derivatives over the layers.

        Parameters
        ----------
        dj : array of shape (n_space_points, 3)

        Returns
        -------
        ndarray of shape (mesh.n_points, 2)
        """
        xyz = self._all(dj, "dj")
        result = np.empty((self.mesh.n_points, 2))
        to, _alive = points_out(result, self.mesh.n_points, "out")
        call(lib.hm_plane_gather, self._plane, ffi.new("hm_space_points*", self._view(xyz)), to, ffi.NULL)
        return result

    def to_plane(self, vectors: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return vectors at points of any layer in the directions of the plane.

        Parameters
        ----------
        vectors, points : array of shape (n, 3)

        Returns
        -------
        ndarray of shape (n, 3)
            Along x and y of the plane (in a wedge: along the axis and outward), and across the plane.
        """
        axis, unit = self._directions(points)
        across = np.cross(axis, unit)
        return np.stack([vectors @ axis, (vectors * unit).sum(1), (vectors * across).sum(1)], axis=1)

    def from_plane(self, vectors: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return vectors of the plane, shape (n, 2), at points of any layer: shape (n, 3)."""
        axis, unit = self._directions(points)
        return vectors[:, :1] * axis + vectors[:, 1:2] * unit

    def _directions(self, points: np.ndarray) -> tuple:
        """The direction of x, and that of y at each point: in a wedge outward from the axis."""
        axis, y = np.array(self.info.x_direction), np.array(self.info.y_direction)
        if self.info.kind == "planes":
            return axis, np.tile(y, (len(points), 1))
        offset = points - np.array(self.info.origin)
        outward = offset - (offset @ axis)[:, None] * axis
        radius = np.linalg.norm(outward, axis=1)[:, None]
        return axis, np.where(radius > 0, outward / np.where(radius > 0, radius, 1), y)

    def _all(self, points: Any, what: str) -> np.ndarray:
        xyz = np.ascontiguousarray(numbers(points, what), np.float64)
        if xyz.shape != self._points.shape:
            raise Error(f"{what} must have the shape {self._points.shape}, not {xyz.shape}.")
        return xyz

    def __reduce__(self) -> Any:
        raise TypeError("A Plane cannot be copied or pickled; make it anew from its arrays.")


def _triple(values: Any, what: str) -> list:
    array = numbers(values, what)
    if array.shape != (3,):
        raise Error(f"{what} must be three numbers, not {values!r}.")
    return [float(one) for one in array]
