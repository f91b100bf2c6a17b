"""Meshes: views of numpy arrays, with markers that have names."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from . import cells as _cells
from . import files as _files
from . import pictures as _pictures
from ._native import lib
from .arrays import finite, int32_view, points_in
from .boundary import Boundary, Marker, faces_of, numbered
from .errors import Error, call
from .reports import Report, new, report


class Mesh(Boundary):
    """A mesh in two dimensions.

    Parameters
    ----------
    points : array of shape (n_points, 2), or a pair (x, y) of arrays of shape (n_points,)
        Coordinates in any unit of length. A float64 array is viewed, not copied, where x and y
        advance by one positive stride (see :mod:`harmorph.arrays`); the mesh keeps it alive. Other
        arrays are copied once.
    cells : array or pair of arrays
        Points of the cells in order around each cell, counted from 0:

        - shape (n_cells, 3): triangles;
        - shape (n_cells, 4): quadrilaterals; a triangle repeats its last point;
        - a pair of two-dimensional arrays: triangles, then quadrilaterals; cells are counted in this
          order, so take compressed rows where they shall keep the order of a file;
        - a pair (start, points) of one-dimensional arrays: compressed rows. Cell k has the points
          ``points[start[k]:start[k + 1]]``. With more than four corners in any cell, or with
          `polygons`, cells are polygons, and hanging nodes are corners.

        int32 arrays are viewed, others copied once.
    boundary : mapping of marker to array
        The edges of the boundary. A marker is a name or an integer. An array of shape (m, 2) has
        one edge in each row; an array of shape (m,) is a run of points in order, whose first point
        is repeated at the end if it is closed. Edges without a marker must form cuts.
    polygons : bool, optional
        Cells in compressed rows are polygons even if none has more than four corners.

    Attributes
    ----------
    points : ndarray of shape (n_points, 2), or the pair that was given
    markers : dict of marker to int
        The number of each marker in the library. Integers are their own numbers; names have the
        smallest numbers that are free, in the order of the names.
    n_points, n_cells : int

    Raises
    ------
    Error
        Wrong shapes or types (``BAD_ARGUMENT``). The cells themselves are checked by
        :meth:`report` and by :class:`harmorph.Morph`.

    Notes
    -----
    A mesh views its coordinates, and reads none when it is made. A coordinate that is infinite or
    NaN is refused, with the point, by :meth:`report`, :meth:`write`, :meth:`plot`, fits, and
    :class:`harmorph.Morph`. Movements do not look at coordinates: :meth:`Morph.morph` adds to what
    it is given, so that NaN stays NaN, and :meth:`Morph.assess` counts cells with such a point as
    inverted.
    """

    def __init__(
        self,
        points: Any,
        cells: Any,
        boundary: Mapping[Marker, Any],
        *,
        polygons: Optional[bool] = None,
    ) -> None:
        layout, arrays = _cells.layout_of(cells, polygons)
        self._set(points, layout, arrays, boundary)

    def _set(
        self, points: Any, layout: str, arrays: Tuple[np.ndarray, ...], boundary: Mapping[Marker, Any]
    ) -> None:
        self._points: Any = points if isinstance(points, np.ndarray) else tuple(points)
        is_pair = isinstance(points, (tuple, list)) and len(points) == 2 and np.ndim(points[0]) == 1
        if not is_pair:
            self._points = np.asarray(points)
        self.n_points: int = len(points[0]) if is_pair else len(self._points)
        if self.n_points > 2**30:
            raise Error(f"The mesh has {self.n_points} points; at most 2^30 are possible.")
        self._layout, self._cells = layout, arrays
        self.n_cells: int = _cells.count(layout, arrays)
        self.markers: Dict[Marker, int] = numbered(boundary)
        faces: List[np.ndarray] = [faces_of(boundary[name], name) for name in self.markers]
        counts = [len(one) for one in faces]
        joined = np.concatenate(faces) if faces else np.empty((0, 2), np.int32)
        self._faces = np.ascontiguousarray(joined, np.int32)
        self._face_markers = np.repeat(np.array(list(self.markers.values()), np.int32), counts)
        self._file: Any = None
        self._view()

    def _view(self) -> None:
        mesh = new("hm_mesh")
        view, alive = points_in(self._points, self.n_points, "The coordinates of the mesh")
        if isinstance(self._points, np.ndarray) and not np.shares_memory(alive[-1], self._points):
            self._points = np.stack(alive, axis=1)  # the one copy
            view, alive = points_in(self._points, self.n_points, "The coordinates of the mesh")
        elif not isinstance(self._points, np.ndarray):
            self._points = alive
        mesh.points = view[0]
        mesh.n_points = self.n_points
        _cells.fill(mesh, self._layout, self._cells)
        mesh.n_faces = len(self._faces)
        mesh.face_points = int32_view(self._faces.reshape(-1))
        mesh.face_markers = int32_view(self._face_markers)
        self._c, self._alive = mesh, (view, alive)

    # ---- Other ways to make a mesh ----

    @classmethod
    def structured(
        cls,
        points: np.ndarray,
        *,
        i_min: Optional[Marker] = None,
        i_max: Optional[Marker] = None,
        j_min: Optional[Marker] = None,
        j_max: Optional[Marker] = None,
    ) -> "Mesh":
        """Return one structured block.

        Parameters
        ----------
        points : array of shape (nj, ni, 2)
            Coordinates; ``points[j, i]`` is point i + ni * j. A C-contiguous float64 array is
            viewed, not copied.
        i_min, i_max, j_min, j_max : marker, optional
            The markers of the four sides. A side without a marker must be a cut: the seam of an
            O-mesh, the wake line of a C-mesh.
        """
        return cls.blocks([points], [(i_min, i_max, j_min, j_max)])

    @classmethod
    def blocks(
        cls, blocks: Sequence[np.ndarray], sides: Sequence[Sequence[Optional[Marker]]]
    ) -> "Mesh":
        """Return a mesh of structured blocks, one after the other.

        Parameters
        ----------
        blocks : sequence of arrays of shape (nj, ni, 2)
            Coordinates. Points of interfaces exist once in each block, with equal coordinates. A
            single C-contiguous float64 block is viewed; several are copied into one array.
        sides : sequence of four markers for each block
            The markers of i_min, i_max, j_min and j_max; None: an interface or a cut.
        """
        points, sizes, boundary = _cells.joined_blocks(blocks, sides)
        mesh = cls.__new__(cls)
        mesh._set(points, "blocks", (sizes,), boundary)
        return mesh

    @classmethod
    def from_meshio(cls, source: Any, markers: str = "gmsh:physical") -> "Mesh":
        """Return the mesh of a ``meshio.Mesh``.

        Parameters
        ----------
        source : meshio.Mesh
            Triangles and quadrilaterals, and the boundary as cells of type "line". Of three
            coordinates the first two are taken.
        markers : str
            The entry of ``source.cell_data`` with the number of the marker of each line. Numbers
            that ``source.field_data`` names get their names.
        """
        points, cells, boundary = _cells.from_meshio(source, markers)
        return cls(points, cells, boundary)

    @classmethod
    def read(cls, path: Any, *, format: str = "", zone: str = "") -> "Mesh":
        """Read a mesh file of any format of the program harmorph.

        Parameters
        ----------
        path : path
            SU2, Gmsh, PLOT3D, UGRID, Fluent, OpenFOAM (the case or its file `points`), VTK or VTU;
            the content tells the format. Of a mesh one cell thick the plane is read.
        format : str
            The format, if the content is not to tell it: "su2", "gmsh", "plot3d", "ugrid",
            "fluent", "openfoam", "vtk", "vtu".
        zone : str
            The zone of an SU2 file with several zones.

        Returns
        -------
        Mesh
            With a list `remarks` of sentences on what was passed over. :meth:`write` writes the
            same file with other coordinates.

        Raises
        ------
        Error
            ``BAD_FILE``; the text names the file and the line or byte.
        """
        file = _files.File(path, format, zone)
        points, cells, boundary, polygons = file.arrays()
        mesh = cls(points, cells, boundary, polygons=polygons)
        mesh._file = file
        return mesh

    def write(self, path: Any, points: Any = None, *, format: str = "") -> None:
        """Write a mesh file. It appears as a whole or not at all.

        Parameters
        ----------
        path : path
            If the mesh was read from a file whose name has the same extension, the file is that
            file, byte for byte, with other coordinates, and names of markers in a file beside it
            (.nmf, .mapbc) are copied to their place beside `path`, unless a file is there.
            Otherwise a new file is written, and the extension tells its format: .su2, .msh, .vtk,
            .vtu.
        points : array of shape (n_points, 2) or pair of arrays, optional
            Coordinates to be written; the default is `points` of the mesh.
        format : str
            The format of a new file: "su2", "gmsh", "vtk" or "vtu".

        Raises
        ------
        Error
            ``BAD_FILE``: the file cannot be written, or the format cannot hold the mesh.
        """
        x, y = finite(self.points if points is None else points, self.n_points, "points")
        _files.write(self, path, x, y, format)

    @property
    def points(self) -> Any:
        """The coordinates: an array of shape (n_points, 2), or the pair of arrays that was given."""
        return self._points

    @property
    def remarks(self) -> List[str]:
        """Sentences of the reader on what was passed over; empty for other meshes."""
        return self._file.remarks if self._file else []

    # ---- Questions ----

    def cell_rows(self) -> Tuple[np.ndarray, np.ndarray]:
        """Return the cells as compressed rows (start, points), two int32 arrays."""
        return _cells.rows(self._layout, self._cells)

    def _distinct_sides(self) -> Optional[np.ndarray]:
        return _cells.distinct_sides(self._layout, self._cells)

    def report(self) -> Report:
        """Check the mesh and count what is in it.

        Returns
        -------
        Report
            {members of hm_mesh_report}

        Raises
        ------
        Error
            ``BAD_MESH``: what :class:`harmorph.Morph` refuses, except for inverted cells.
        """
        analysis, _alive = self._analysis()
        result = new("hm_mesh_report")
        call(lib.hm_analysis_report, analysis, result, names=self.names)
        return report(result)

    # ---- Pictures, copies ----

    def _repr_svg_(self) -> str:
        return _pictures.svg(self)

    def plot(self, points: Any = None, ax: Any = None, *, whole: bool = False, **style: Any) -> Any:
        """Draw the edges of the mesh by matplotlib: those around the bodies, and the whole as an inset.

        Parameters
        ----------
        points : array of shape (n_points, 2) or pair of arrays, optional
            Coordinates, for instance what :meth:`Morph.morph` returns; the default is `points` of the mesh.
        ax : matplotlib axes, optional
            The default is ``matplotlib.pyplot.gca()``.
        whole : bool
            The axes show the whole mesh, and there is no inset.
        **style
            Passed to ``matplotlib.collections.LineCollection``, for instance ``color="r"``, ``lw=0.5``.

        Returns
        -------
        matplotlib axes
            ``matplotlib.pyplot.show()`` shows them, ``axes.figure.savefig("mesh.png")`` writes a file.
        """
        return _pictures.plot(self, points, ax, whole, style)

    def with_points(self, points: Any) -> "Mesh":
        """Return a mesh with the same cells and markers and with other coordinates."""
        mesh = self.__class__.__new__(self.__class__)
        mesh.__dict__.update(self.__dict__)
        mesh._points = points
        mesh._view()
        return mesh

    def __copy__(self) -> "Mesh":
        return self.with_points(self.points)

    def __getstate__(self) -> Dict[str, Any]:
        # A file that was read belongs to its process: the copy writes new files.
        state = {key: value for key, value in self.__dict__.items() if key not in ("_c", "_alive")}
        return {**state, "_file": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._view()

    def __repr__(self) -> str:
        return f"Mesh({self.n_points} points, {self.n_cells} cells, markers {list(self.markers)})"
