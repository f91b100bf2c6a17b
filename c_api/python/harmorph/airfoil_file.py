"""Airfoil files: coordinates in Selig's or Lednicer's order, as databases of airfoils have them."""

from __future__ import annotations

from typing import Any, List, Tuple

import numpy as np

from .errors import Error


def read(path: Any) -> Tuple[np.ndarray, bool]:
    """Return the outline as points of shape (n, 2) from the trailing edge around, and if it closes.

    Selig's order: one run from the trailing edge over the leading edge and back. Lednicer's order:
    the first line has the numbers of points of the two sides, which follow from the leading edge on.
    A point that is equal to the first one at the end is left out, and the outline is then a loop; so
    is an outline whose ends lie apart, as its blunt base closes it.
    """
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = file.read().splitlines()
    except OSError as error:
        raise Error(f"{path}: cannot be read: {error.strerror}", Error.BAD_FILE) from None
    rows: List[Tuple[float, float]] = []
    for number, line in enumerate(lines, 1):
        words = line.replace(",", " ").split()
        try:
            values = [float(word) for word in words]
        except ValueError:
            values = []
        if len(values) == 2:
            rows.append((values[0], values[1]))
        elif words and rows:
            raise Error(f"{path}:{number}: expected two numbers, found {line.strip()!r}", Error.BAD_FILE)
    if len(rows) < 4:
        raise Error(f"{path}: an airfoil has at least four points, this file has {len(rows)}.",
                    Error.BAD_FILE)
    if rows[0][0] > 1.5 and all(value == int(value) for value in rows[0]):
        upper, lower = int(rows[0][0]), int(rows[0][1])
        if upper + lower + 1 != len(rows):
            raise Error(f"{path}: the file says {upper} + {lower} points and has {len(rows) - 1}.",
                        Error.BAD_FILE)
        points = np.array(rows[1:])
        points = np.concatenate([points[:upper][::-1], points[upper + 1 :]])
    else:
        points = np.array(rows)
    if (points[0] == points[-1]).all():
        points = points[:-1]
    return points, True
