"""A solved basis: one block of memory, which may be the content of a file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Optional, Tuple

import numpy as np

from ._native import ffi, lib
from .arrays import doubles, points_in
from .conditions import Condition, of_basis
from .curves import Curves
from .errors import MEMORY, Error, call, call_with_memory
from .files import replace
from .mesh import Mesh
from .reports import Report, new, report
from .words import in_python

_TITLE = b"\nharmorph markers "


class Basis:
    """The functions of a mesh, which do not change any more. For the other modules of the package.

    Parameters
    ----------
    pointer : cdata
        The ``hm_basis*``, inside of `memory`.
    memory : object
        Keeps the block alive.

    Attributes
    ----------
    before : ndarray of shape (functions, 2), or None
        The movement that the mesh had made since the basis was made when the functions were solved; None: none.
    has_moved : bool
        The basis was attached to a mesh of other coordinates than those on which the functions were solved.
    """

    before: Optional[np.ndarray] = None
    has_moved = False

    def __init__(self, pointer: Any, memory: Any) -> None:
        self.pointer, self.memory = pointer, memory
        info = new("hm_basis_info")
        call(lib.hm_basis_info_get, pointer, info)
        self.bytes: int = info.bytes
        self.info: Report = report(info)
        self.shape = (self.info.functions, 2)
        n = info.shared_points
        self.shared_points = np.array(
            [[info.shared_point[k], info.shared_condition[2 * k], info.shared_condition[2 * k + 1]]
             for k in range(n)], np.int32).reshape(n, 3)
        self.n_points: int = self.info.points

    @classmethod
    def empty(cls, analysis: Any) -> Tuple[Any, np.ndarray]:
        """Return a new ``hm_basis*`` to be solved, and its block."""
        pointer = ffi.new("hm_basis**")
        block = call_with_memory(lib.hm_basis_init, pointer, MEMORY, analysis)
        return pointer[0], block

    @classmethod
    def attach(cls, memory: Any, mesh: Optional[Mesh]) -> "Basis":
        """Return the basis in a buffer of bytes; warns if the mesh has other coordinates."""
        view = ffi.from_buffer(memory)
        pointer = ffi.new("hm_basis**")
        status = call(lib.hm_basis_attach, pointer, view, len(view), mesh._c if mesh else ffi.NULL,
                      names=mesh.names if mesh else None)
        basis = cls(pointer[0], (view, memory))
        basis.has_moved = status == lib.HM_MOVED
        return basis

    @classmethod
    def load(cls, path: Any, mesh: Optional[Mesh]) -> "Basis":
        """Read a file and attach the basis in it; later changes of the file have no influence."""
        try:
            memory = Path(os.fspath(path)).read_bytes()
        except OSError as error:
            raise Error(f"{path}: cannot be read: {error.strerror}", Error.BAD_FILE) from None
        if len(memory) == 0:
            raise Error(f"{path}: cannot be read: the file is empty", Error.BAD_FILE)
        return cls.attach(memory, mesh)

    def save(self, path: Any, mesh: Optional[Mesh]) -> None:
        """Write the block, and behind it the names of the markers as the program harmorph does."""
        behind = b""
        markers = mesh.markers if mesh else {}
        can_be_lines = not any("\n" in str(name) for name in markers)
        if can_be_lines and markers and sorted(markers.values()) == list(range(len(markers))):
            ordered = sorted(markers, key=lambda name: markers[name])
            lines = [str(name).encode("utf-8", "surrogateescape") for name in ordered]
            behind = _TITLE + b"%d\n" % len(lines) + b"".join(line + b"\n" for line in lines)
        replace(os.fsdecode(path), self._buffer(), behind)

    def _buffer(self) -> Any:
        return ffi.buffer(ffi.cast("char*", self.pointer), self.bytes)

    def to_bytes(self) -> bytes:
        """Return a copy of the block."""
        return bytes(self._buffer())

    def curves(self, move: Optional[np.ndarray] = None) -> Optional[Curves]:
        """Return the curves that the basis was solved with, or those after a movement; None if it has none.

        Parameters
        ----------
        move : array of shape (functions, 2), optional
            The movement since the basis was made [length].
        """
        if self.info.curves == 0:
            return None
        views, out = ffi.new("hm_curve[]", self.info.curves), new("hm_curves")
        views[0].struct_size = ffi.sizeof("hm_curve")
        step = control = ffi.NULL
        if move is not None:
            step, control = doubles(move, self.shape, "move"), ffi.new("double[]", 2 * self.info.control_points)
        call(lib.hm_basis_curves, self.pointer, step, control, out, views, self.info.curves)
        return Curves._copied(out)

    def known(self) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the mesh points on curves, counted from 0, their curves and their parameters: arrays of shape (n,)."""
        info, arrays = new("hm_basis_info"), []
        call(lib.hm_basis_info_get, self.pointer, info)
        for member, kind in (("curve_point", np.int32), ("point_curve", np.int32), ("point_u", np.float64)):
            size = info.curve_points * np.dtype(kind).itemsize
            arrays.append(np.frombuffer(ffi.buffer(getattr(info, member), size), kind) if size else np.empty(0, kind))
        on_curve = arrays[1] < info.curves  # the others belong to rigid bodies, or are given
        return arrays[0][on_curve], arrays[1][on_curve], arrays[2][on_curve]

    def recover(self, points: Any, tolerance: float = 0.0) -> np.ndarray:
        """Return the movement, shape (functions, 2), of a mesh since the basis was made.

        Parameters
        ----------
        points : array of shape (n_points, 2), or pair of arrays
            The mesh now [length].
        tolerance : float
            See :meth:`harmorph.Morph.recover`.

        Raises
        ------
        Error
            ``BAD_MESH``: the wall is farther from where any movement leads it.
        """
        view, _alive = points_in(points, self.n_points, "points")
        move = np.empty(self.shape)
        call_with_memory(lib.hm_recover_movement, self.pointer, view, tolerance,
                         doubles(move, self.shape, "move", out=True), ffi.NULL, MEMORY)
        return move

    def conditions(self, mesh: Mesh) -> List[Tuple[int, Condition]]:
        """Return the conditions that the basis was solved with."""
        n = ffi.new("int32_t*")
        room = 1 + len(mesh.markers) * 4
        while True:
            structs = ffi.new("hm_condition[]", room)
            structs[0].struct_size = ffi.sizeof("hm_condition")
            error = ffi.new("hm_error*")
            status = lib.hm_basis_conditions(self.pointer, structs, room, n, error)
            if status == 0:
                return of_basis(mesh, self.pointer, structs, n[0])
            if n[0] <= room:
                raise Error(in_python(ffi.string(error.text).decode()), status)
            room = n[0]
