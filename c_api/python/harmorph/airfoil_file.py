"""Airfoil files. The reader of the program harmorph is compiled into the extension."""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np

from ._native import ffi, lib
from .errors import Error

_TEXT = 4096


def read(path: Any, element: int = 0) -> np.ndarray:
    """Return the outline as points of shape (n, 2); the last point is connected to the first one.

    The layouts are those of ``harmorph fit``: one run round the section (Selig), two sides with
    counts (Lednicer) or without, tables, Tecplot, OpenFAST, and several elements (MSES, XFOIL), of
    which `element` chooses one, from 1. An outline that jumps or crosses itself is refused.
    """
    text = ffi.new("char[]", _TEXT)
    found = lib.hmpy_read_section(os.fsencode(path), element, text, _TEXT)
    if found == ffi.NULL:
        raise Error(ffi.string(text).decode("utf-8", "replace"), Error.BAD_FILE)
    section = ffi.gc(found, lib.hmpy_section_free)
    n, k = lib.hmpy_section_points(section), 0
    while (warning := lib.hmpy_section_warning(section, k)) != ffi.NULL:
        warnings.warn(ffi.string(warning).decode("utf-8", "replace"), stacklevel=3)
        k += 1
    x, y = (np.frombuffer(ffi.buffer(values, 8 * n)).copy()
            for values in (lib.hmpy_section_x(section), lib.hmpy_section_y(section)))
    return np.stack([x, y], axis=1)
