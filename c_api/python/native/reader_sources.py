"""The sources of the program harmorph that read and write mesh files, and read airfoil files.

``reader_sources(folder)`` follows the includes from the formats on: a header needs the source of
the same name beside it. New formats need no edit here.
"""

import re
from pathlib import Path


def reader_sources(folder):
    """Return all files below `folder` (c_api/cli) that the readers need, as sorted paths."""
    folder = Path(folder)
    waiting = [*folder.glob("formats/*.[ch]pp"), folder / "mesh/mesh_file.hpp",
               folder / "curves/section.hpp"]
    found = set()
    while waiting:
        path = waiting.pop()
        if path in found or not path.is_file():
            continue
        found.add(path)
        waiting.append(path.with_suffix(".cpp"))
        text = path.read_text(encoding="utf-8")
        waiting += [folder / name for name in re.findall(r'^#include "([^"]+)"', text, flags=re.M)]
    return sorted(found)
