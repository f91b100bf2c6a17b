"""Cells of a mesh in the layouts of the library, and as compressed rows."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from ._native import lib
from .arrays import int32_view, int32s, numbers
from .errors import Error

Arrays = Tuple[np.ndarray, ...]


def layout_of(cells: Any, polygons: Optional[bool]) -> Tuple[str, Arrays]:
    """Return the layout ("triangles", "quads", "mixed", "rows" or "polygons") and its arrays."""
    pair = isinstance(cells, (tuple, list)) and len(cells) == 2
    if pair and np.ndim(cells[0]) == 1 and np.ndim(cells[1]) == 1 and isinstance(cells, tuple):
        return _rows_layout(int32s(cells[0], "start"), int32s(cells[1], "The points of the cells"), polygons)
    if pair and np.ndim(cells[0]) == 2 and np.ndim(cells[1]) == 2:
        first = int32s(cells[0], "The triangles", 2)
        second = int32s(cells[1], "The quadrilaterals", 2)
        if first.shape[1] != 3 or second.shape[1] != 4:
            raise Error("A pair of cell arrays must be triangles of shape (n, 3) and quadrilaterals "
                        f"of shape (m, 4); the shapes are {first.shape} and {second.shape}.")
        return "mixed", (first, second)
    array = int32s(cells, "The cells", 2)
    if array.shape[1] not in (3, 4):
        raise Error(f"The cells must have 3 or 4 columns; their shape is {array.shape}.")
    if polygons:
        start = np.arange(0, array.size + 1, array.shape[1], dtype=np.int32)
        return "polygons", (start, np.ascontiguousarray(array.reshape(-1)))
    return ("triangles" if array.shape[1] == 3 else "quads"), (array,)


def _rows_layout(start: np.ndarray, points: np.ndarray, polygons: Optional[bool]) -> Tuple[str, Arrays]:
    if len(start) < 2 or start[0] != 0 or start[-1] != len(points):
        raise Error(f"start must begin with 0 and end with {len(points)}, the number of entries.")
    lengths = np.diff(start)
    if lengths.min() < 3:
        raise Error(f"Cell {int(lengths.argmin())} has {int(lengths.min())} points; at least 3 are "
                    "needed.", Error.BAD_MESH, "cell", int(lengths.argmin()))
    is_polygons = bool(lengths.max() > 4) if polygons is None else polygons
    return ("polygons" if is_polygons else "rows"), (start, points)


def count(layout: str, arrays: Arrays) -> int:
    """Return the number of cells."""
    if layout == "blocks":
        return int(((arrays[0][:, 0] - 1).astype(np.int64) * (arrays[0][:, 1] - 1)).sum())
    if layout in ("rows", "polygons"):
        return len(arrays[0]) - 1
    return sum(len(one) for one in arrays)


def fill(mesh: Any, layout: str, arrays: Arrays) -> None:
    """Fill in the members of ``hm_mesh`` that describe the cells."""
    mesh.cell_layout = getattr(lib, "HM_CELLS_" + layout.upper())
    mesh.n_cells = count(layout, arrays)
    if layout == "blocks":
        mesh.n_blocks = len(arrays[0])
        mesh.block_sizes = int32_view(arrays[0].reshape(-1))
    elif layout in ("rows", "polygons"):
        mesh.cell_start, mesh.cell_points = int32_view(arrays[0]), int32_view(arrays[1])
    else:
        mesh.cell_points = int32_view(arrays[0].reshape(-1))
        if layout == "mixed":
            mesh.n_quads = len(arrays[1])
            mesh.quad_points = int32_view(arrays[1].reshape(-1))


def distinct_sides(layout: str, arrays: Arrays) -> Optional[np.ndarray]:
    """Return which sides of the library's cells are sides of `rows`, or None if all are.

    The library counts four sides of each quadrilateral. Of a triangle that repeats its last point,
    the side between the repetitions is none of the sides of `rows`.
    """
    if layout not in ("quads", "mixed"):
        return None
    masks: List[np.ndarray] = []
    for table in arrays:
        kept = np.ones(table.shape, bool)
        if table.shape[1] == 4:
            kept[:, 2] = table[:, 3] != table[:, 2]
        masks.append(kept.reshape(-1))
    return np.concatenate(masks)


def rows(layout: str, arrays: Arrays) -> Tuple[np.ndarray, np.ndarray]:
    """Return the cells as compressed rows; a quadrilateral that repeats a point is a triangle."""
    if layout in ("rows", "polygons"):
        return arrays[0].copy(), arrays[1].copy()
    if layout == "blocks":
        tables = _block_quads(arrays[0])
    else:
        tables = list(arrays)
    lengths: List[np.ndarray] = []
    points: List[np.ndarray] = []
    for table in tables:
        kept = np.ones(table.shape, bool)
        if table.shape[1] == 4:
            kept[:, 3] = table[:, 3] != table[:, 2]
        lengths.append(kept.sum(axis=1))
        points.append(table[kept])
    start = np.concatenate([[0], np.cumsum(np.concatenate(lengths))]).astype(np.int32)
    return start, np.concatenate(points).astype(np.int32)


def _block_quads(sizes: np.ndarray) -> List[np.ndarray]:
    tables, first = [], 0
    for ni, nj in sizes:
        number = first + np.arange(ni * nj, dtype=np.int32).reshape(nj, ni)
        corners = (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
        tables.append(np.stack([one.ravel() for one in corners], axis=1))
        first += int(ni) * int(nj)
    return tables


def joined_blocks(blocks: Sequence[Any], sides: Sequence[Sequence[Any]]) -> tuple:
    """Return the points, the sizes (ni, nj) and the boundary of structured blocks."""
    if len(blocks) == 0 or len(blocks) != len(sides):
        raise Error(f"There are {len(blocks)} blocks and sides of {len(sides)}; give four markers for "
                    "each block.")
    sizes, parts, first = [], [], 0
    boundary: Dict[Any, List[np.ndarray]] = {}
    for number, (block, markers) in enumerate(zip(blocks, sides)):
        block = numbers(block, f"Block {number}")
        if block.ndim != 3 or block.shape[2] != 2 or min(block.shape[:2]) < 2 or len(markers) != 4:
            raise Error(f"Block {number} must have the shape (nj, ni, 2), nj and ni at least 2, and "
                        f"four markers; its shape is {block.shape}.", kind="block", item=number)
        nj, ni = block.shape[:2]
        index = first + np.arange(ni * nj).reshape(nj, ni)
        runs = (index[:, 0], index[:, -1], index[0], index[-1])
        for marker, run in zip(markers, runs):
            if marker is not None:
                boundary.setdefault(marker, []).append(np.stack([run[:-1], run[1:]], axis=1))
        sizes.append((ni, nj))
        parts.append(block.reshape(-1, 2))
        first += ni * nj
    points = parts[0] if len(parts) == 1 else np.concatenate(parts)
    faces = {marker: np.concatenate(runs) for marker, runs in boundary.items()}
    return points, np.array(sizes, np.int32), faces


def from_meshio(source: Any, markers: str) -> tuple:
    """Return points, cells and boundary of a ``meshio.Mesh``."""
    names = {int(value[0]): name for name, value in source.field_data.items() if int(value[1]) == 1}
    tables: Dict[int, List[np.ndarray]] = {3: [], 4: []}
    boundary: Dict[Any, List[np.ndarray]] = {}
    for number, block in enumerate(source.cells):
        if block.type in ("triangle", "quad"):
            tables[block.data.shape[1]].append(block.data)
        elif block.type == "line":
            if markers not in source.cell_data:
                raise Error(f"The mesh has no cell data {markers!r} with the markers of its lines; "
                            f"there are {sorted(source.cell_data)}.")
            tags = np.asarray(source.cell_data[markers][number])
            for tag in np.unique(tags):
                boundary.setdefault(names.get(int(tag), int(tag)), []).append(block.data[tags == tag])
        elif block.type != "vertex":
            raise Error(f"Cells of type {block.type!r} are not supported; triangles and "
                        "quadrilaterals are.", Error.UNSUPPORTED)
    found = [np.concatenate(one) for one in tables.values() if one]
    if not found:
        raise Error("The mesh has neither triangles nor quadrilaterals.", Error.BAD_MESH)
    points = np.asarray(source.points)
    faces = {marker: np.concatenate(parts) for marker, parts in boundary.items()}
    return points[:, :2], (found[0] if len(found) == 1 else tuple(found)), faces
