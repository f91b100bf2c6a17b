"""Mesh files. The readers and writers of the program harmorph are compiled into the extension."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import Any, List

import numpy as np

from ._native import ffi, lib
from .errors import Error
from .reports import new

_TEXT = 4096


class File:
    """A mesh as it was read, with the bytes of its file.

    Parameters
    ----------
    path : path
    format, zone : str
        See :meth:`harmorph.Mesh.read`.
    """

    def __init__(self, path: Any, format: str, zone: str) -> None:
        text = ffi.new("char[]", _TEXT)
        file = lib.hmpy_read(os.fsencode(path), format.encode(), zone.encode(), text, _TEXT)
        if file == ffi.NULL:
            raise _failure(text)
        self.handle = ffi.gc(file, lib.hmpy_file_free)
        self.path = Path(os.fspath(path))
        self.remarks: List[str] = [
            ffi.string(lib.hmpy_file_remark(file, k)).decode("utf-8", "replace")
            for k in range(lib.hmpy_file_remarks(file))
        ]

    def arrays(self) -> tuple:
        """Return copies of points, cells (compressed rows) and boundary; whether cells are polygons."""
        mesh = new("hm_mesh")
        lib.hmpy_file_mesh(self.handle, mesh)
        n, cells, faces = mesh.n_points, mesh.n_cells, mesh.n_faces
        points = np.stack([_doubles(mesh.points.x, n), _doubles(mesh.points.y, n)], axis=1)
        start = _int32s(mesh.cell_start, cells + 1)
        rows = (start, _int32s(mesh.cell_points, int(start[-1])))
        edges = _int32s(mesh.face_points, 2 * faces).reshape(-1, 2)
        markers = _int32s(mesh.face_markers, faces)
        boundary = {}
        for marker in range(lib.hmpy_file_markers(self.handle)):
            length = ffi.new("size_t*")
            name = lib.hmpy_file_marker(self.handle, marker, length)
            text = ffi.buffer(name, length[0])[:].decode("utf-8", "surrogateescape")
            boundary[text] = edges[markers == marker]
        return points, rows, boundary, mesh.cell_layout == lib.HM_CELLS_POLYGONS


def write(mesh: Any, path: Any, x: np.ndarray, y: np.ndarray, format: str) -> None:
    """Write the mesh with the coordinates x, y; see :meth:`harmorph.Mesh.write`."""
    x, y = np.ascontiguousarray(x, np.float64), np.ascontiguousarray(y, np.float64)
    text = ffi.new("char[]", _TEXT)
    name = os.fsencode(path)
    is_moved = mesh._file and not format and _is_same_kind(mesh._file.path, Path(os.fsdecode(path)))
    if is_moved:
        written = lib.hmpy_moved(mesh._file.handle, name, ffi.from_buffer("double[]", x),
                                 ffi.from_buffer("double[]", y), text, _TEXT)
    else:
        start, points = mesh.cell_rows()
        markers = list(mesh.markers)
        place = {number: k for k, number in enumerate(mesh.markers.values())}
        numbers = np.array([place[int(one)] for one in mesh._face_markers], np.int32)
        names = [ffi.new("char[]", str(one).encode("utf-8", "surrogateescape")) for one in markers]
        view = new("hm_mesh")
        view.n_points, view.n_cells, view.n_faces = len(x), len(start) - 1, len(numbers)
        view.points = (ffi.from_buffer("double[]", x), ffi.from_buffer("double[]", y), 1)
        view.cell_layout = lib.HM_CELLS_POLYGONS if mesh._layout == "polygons" else lib.HM_CELLS_ROWS
        faces = np.ascontiguousarray(mesh._faces.reshape(-1))
        view.cell_start, view.cell_points = _int32_view(start), _int32_view(points)
        view.face_points, view.face_markers = _int32_view(faces), _int32_view(numbers)
        written = lib.hmpy_created(view, len(names), ffi.new("char*[]", names), name, format.encode(),
                                   text, _TEXT)
    if written == ffi.NULL:
        raise _failure(text)
    written = ffi.gc(written, lib.hmpy_text_free)
    length = ffi.new("size_t*")
    data = lib.hmpy_text_bytes(written, length)
    if not lib.hmpy_place(name, text, _TEXT):
        raise Error(f"The name {path!r} is too long.", Error.BAD_FILE)
    replace(os.fsdecode(ffi.string(text)), ffi.buffer(data, length[0]))
    if is_moved:
        _copy_names(mesh._file, name)


def replace(path: str, *parts: Any) -> None:
    """Write bytes to a new file that takes the place of `path` when it is complete."""
    target = os.path.realpath(path)
    if os.path.exists(target) and not os.path.isfile(target):  # a device or a pipe
        with open(target, "wb") as out:
            out.writelines(parts)
        return
    try:
        number, temporary = tempfile.mkstemp(dir=os.path.dirname(target), prefix=".harmorph-")
    except OSError as error:
        raise Error(f"{path}: cannot be written: {error.strerror}", Error.BAD_FILE) from None
    try:
        with os.fdopen(number, "wb") as out:
            out.writelines(parts)
        if os.path.exists(target):
            shutil.copymode(target, temporary)
        else:
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, target)
    except OSError as error:
        os.unlink(temporary)
        raise Error(f"{path}: cannot be written: {error.strerror}", Error.BAD_FILE) from None


def _copy_names(read: File, path: bytes) -> None:
    """Copy the names of markers beside the file that was read to their place beside `path`, if no file is there."""
    text = ffi.new("char[]", _TEXT)
    places = []
    for mesh in (os.fsencode(read.path), path):
        if not lib.hmpy_names_place(read.handle, mesh, text, _TEXT):
            raise Error(f"The name {os.fsdecode(mesh)!r} is too long.", Error.BAD_FILE)
        places.append(os.fsdecode(ffi.string(text)))
    source, target = places
    if source and os.path.isfile(source) and not os.path.exists(target):
        replace(target, Path(source).read_bytes())


def _is_same_kind(read: Path, written: Path) -> bool:
    def kind(path: Path) -> str:
        if path.is_dir() or path.name in ("points", "points.gz"):
            return "points"
        suffix = path.with_suffix("").suffix if path.suffix == ".gz" else path.suffix
        return ".vtu" if suffix == ".pvtu" else suffix

    return kind(read) == kind(written)


def _failure(text: Any) -> Error:
    said = ffi.string(text).decode("utf-8", "replace")
    # The readers are those of the program, which has an option of the command line, and may read CGNS.
    return Error(said.replace("cgns, ", "").replace("--format", "`format`"), Error.BAD_FILE)


def _doubles(pointer: Any, n: int) -> np.ndarray:
    return np.frombuffer(ffi.buffer(pointer, 8 * n), np.float64) if n else np.empty(0)


def _int32s(pointer: Any, n: int) -> np.ndarray:
    if n == 0:
        return np.empty(0, np.int32)
    return np.frombuffer(ffi.buffer(pointer, 4 * n), np.int32).copy()


def _int32_view(array: np.ndarray) -> Any:
    return ffi.from_buffer("int32_t[]", array) if array.size else ffi.NULL
