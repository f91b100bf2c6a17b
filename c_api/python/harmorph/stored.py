"""Files and copies of a solved object."""

from __future__ import annotations

import copy
from typing import Any, Dict, Optional, Type, TypeVar

from .basis import Basis
from .conditions import with_moved_centres
from .curves import Curves
from .errors import Error
from .mesh import Mesh
from .reports import Report
from .words import ENGINES, OPERATORS


Self = TypeVar("Self", bound="Stored")


class Stored:
    """Methods of :class:`harmorph.Morph` that write and read it, and that copy it."""

    mesh: Optional[Mesh]
    curves: Optional[Curves]
    solve_report: Optional[Report]
    _options: Dict[str, Any]
    _pairs: Any
    _executor: Any
    _problem: Optional[Mesh]
    _analysed: Any
    _known: Any
    _moved: Any
    _lost: Optional[Error]

    def save(self, path: Any) -> None:
        """Write the basis to a file, which C, Fortran and, for meshes that were read, the program
        harmorph load, too. The file appears as a whole or not at all."""
        self._open().save(path, self.mesh)

    @classmethod
    def load(cls: Type[Self], path: Any, mesh: Optional[Mesh] = None, *, threads: int = 1) -> Self:
        """Read a basis file.

        Parameters
        ----------
        path : path
            A file of :meth:`save`, or of C, Fortran or the program.
        mesh : Mesh, optional
            The mesh of the basis, which is compared. Without it only `displacement`, `morph` with
            `points`, and `adjoint` are possible. The mesh may have moved by the functions of the basis: `curves`
            are those after the movement, if this movement can be found, and points keep their places on the
            curves. Then :meth:`solve` makes functions of the mesh as it is, without which :meth:`safe` is
            refused. Rigid bodies, rotated offsets and lines of points that slip are those of `mesh` after
            :meth:`solve`, not those of the first analysis: the centre of a body is where the movement has taken
            it, and :func:`harmorph.rigid` needs no `before` for what the body did before :meth:`load`.
        threads : int
            See :class:`Morph`.

        Raises
        ------
        Error
            ``BAD_FILE``, or ``BAD_BASIS``: no basis, cut off, damaged, of another mesh.

        Warns
        -----
        HarmorphWarning
            ``MOVED``: the mesh has other coordinates than the basis was solved on.
        """
        basis = Basis.load(path, mesh)
        pairs = basis.conditions(mesh) if mesh else []
        self = cls._attached(basis, mesh, basis.curves(), pairs, threads)
        if self._problem is not None:
            self._known = basis.known()
            self._find_curves(basis)
        return self

    def _find_curves(self, basis: Basis) -> None:
        """Find the curves and the centres of bodies at the coordinates of the mesh."""
        if basis.shape[0] == 0:
            return
        try:
            moved = basis.recover(self._problem.points)
        except Error as reason:
            if basis.has_moved or reason.code == Error.BAD_MESH:  # or the basis has not all of its functions
                self._lost = reason
            return
        if moved.any():
            self.curves = basis.curves(moved)
            first = basis.shape[0] - basis.info.modes - 2 * basis.info.bodies
            self._pairs = with_moved_centres(self._pairs, moved[first::2])
            basis.before = None if basis.has_moved else moved

    @classmethod
    def _attached(cls: Type[Self], basis: Basis, mesh: Any, curves: Any, pairs: Any, threads: int) -> Self:
        self = cls.__new__(cls)
        info = basis.info
        self._options = {
            "operator_kind": OPERATORS[info.operator_kind], "engine": ENGINES[info.engine],
            "exponent": info.exponent or -1,
            "offset_correction": info.offset_correction,
        }
        self._own(mesh, curves, pairs, threads)
        self._set_basis(basis)
        return self

    def __getstate__(self) -> Dict[str, Any]:
        return {
            "mesh": self.mesh, "start": self._problem, "analysed": self._analysed,
            "curves": self.curves, "pairs": self._pairs, "options": self._options,
            "threads": self._executor.threads, "fluxes": self._fluxes,
            "basis": self._open().to_bytes(), "report": self.solve_report, "before": self._open().before,
            "places": (self._known, self._moved, self._lost),
        }

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self._options = state["options"]
        self._own(state["mesh"], state["curves"], state["pairs"], state["threads"], state["fluxes"])
        self._problem, self._analysed = state["start"], state["analysed"]
        self._known, self._moved, self._lost = state["places"]
        basis = Basis.attach(state["basis"], self._problem)
        basis.before = state["before"]
        self._set_basis(basis)
        self.solve_report = state["report"]

    def __copy__(self: Self) -> Self:
        basis, other = self._open(), self.__class__.__new__(self.__class__)
        other._options = dict(self._options)
        other._own(self.mesh, self.curves, self._pairs, self._executor.threads, self._fluxes)
        other._problem, other._analysed = self._problem, self._analysed
        other._known, other._moved, other._lost = self._known, self._moved, self._lost
        other._set_basis(basis)
        other.solve_report = copy.copy(self.solve_report)
        return other

    def _own(self, mesh: Optional[Mesh], curves: Optional[Curves], pairs: Any, threads: int,
             fluxes: Any = None) -> None:
        raise NotImplementedError

    def _set_basis(self, basis: Basis) -> None:
        raise NotImplementedError

    def _open(self) -> Basis:
        raise NotImplementedError
