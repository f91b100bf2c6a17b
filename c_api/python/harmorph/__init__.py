"""harmorph morphs an airfoil and its CFD mesh together.

>>> import harmorph
>>> mesh = harmorph.Mesh.read("naca0012.su2")              # doctest: +SKIP
>>> curves = harmorph.Curves.fit(mesh, "airfoil")          # doctest: +SKIP
>>> morph = harmorph.Morph(mesh, curves)                   # doctest: +SKIP
>>> moved = morph.morph(move)                              # doctest: +SKIP

Points and cells, control points, curves and functions are counted from 0. Lengths have the unit of
the coordinates, angles are in degrees. Every refusal is a :class:`harmorph.Error`; what can be used
with a reservation is a :class:`harmorph.HarmorphWarning`. Adapters for other codes are the modules
``harmorph.usmesh``, ``harmorph.dvgeo``, ``harmorph.openmdao``, ``harmorph.torch`` and
``harmorph.jax``, which are imported, with their host, when they are first used.
"""

import importlib as _importlib
from typing import Any as _Any

from . import documents as _documents, measures as _measures
from ._native import ffi as _ffi, lib as _lib
from .conditions import Condition
from .curve import Curve
from .curves import Curves
from .errors import Error, HarmorphWarning
from .fields import Walls, swept_areas
from .functions import Assessment, rigid
from .large import Safe
from .measures import Measures
from .mesh import Mesh
from .morph import Morph
from .plane import Plane
from .quality import Bounds, Corners, Quality
from .reports import Report
from .shapes import Moved, Movement
from .transfer import Interpolation
from .variables import Variables

__version__: str = _ffi.string(_lib.hm_version()).decode()
__all__ = [
    "Assessment",
    "Bounds",
    "Condition",
    "Corners",
    "Curve",
    "Curves",
    "Error",
    "HarmorphWarning",
    "Interpolation",
    "Measures",
    "Mesh",
    "Morph",
    "Moved",
    "Movement",
    "Plane",
    "Quality",
    "Report",
    "Safe",
    "Variables",
    "Walls",
    "rigid",
    "swept_areas",
    "__version__",
]

for _one in (*(globals()[_name] for _name in __all__ if _name != "__version__"), _measures.measure):
    _documents.complete(_one)


def __getattr__(name: str) -> _Any:
    if name in ("usmesh", "dvgeo", "openmdao", "torch", "jax"):
        return _importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
