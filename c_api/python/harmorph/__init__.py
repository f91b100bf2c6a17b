"""harmorph morphs an airfoil and its CFD mesh together.

This program makes a mesh around an ellipse, and moves the upper side up:

    import harmorph
    import numpy as np

    ni, nj = 129, 49
    angle = 2 * np.pi * (np.arange(ni) % (ni - 1)) / (ni - 1)
    r = np.exp(3 * np.arange(nj) / (nj - 1))[:, None]
    points = np.stack([(r + 0.6 / r) * np.cos(angle), (r - 0.6 / r) * np.sin(angle)], axis=-1)
    mesh = harmorph.Mesh.structured(points, j_min="wall", j_max="far")

    # A periodic cubic B-spline with 12 control points through the points of the wall; one function for each.
    curves = harmorph.Curves.fit(mesh, "wall", n_control=12, closed="periodic")
    morph = harmorph.Morph(mesh, curves)

    # The upper control points go up. The displacements are judged before the mesh moves.
    move = np.zeros((12, 2))
    move[curves.control[:, 1] > 0.05, 1] = 0.1
    step, quality = morph.assess(morph.displacement(move))
    print(f"{quality.inverted} inverted cells; the mesh could follow {step.admissible:.1f} times as far")
    if quality.inverted:
        raise SystemExit(1)
    morph.morph(move, mesh.points, out=mesh.points)

    # Derivatives of an objective by the mesh points become derivatives by the control points.
    gradient = morph.adjoint(np.ones((mesh.n_points, 2)))

`Mesh.read` reads a mesh file, and `mesh.write` writes the same file with moved points. Read the help
of `Mesh`, `Curves`, `Morph`, `Assessment` and `Error` in this order; `safe` of `Morph` moves a mesh
where `inverted` is not 0. `mesh.plot(points)` and `curves.plot()` draw by matplotlib.

Points and cells, control points, curves and functions are counted from 0. Lengths have the unit of
the coordinates, angles are in degrees. What these classes refuse, they refuse by a :class:`Error`,
also an option that a call does not have (`displacement`, `morph` and `adjoint`, the calls of
microseconds, raise Python's TypeError then); what can be used with a reservation is a
:class:`HarmorphWarning`. Adapters for other codes are the modules ``harmorph.usmesh``,
``harmorph.dvgeo``, ``harmorph.openmdao``, ``harmorph.torch`` and ``harmorph.jax``, which are
imported, with their host, when they are first used.
"""

import importlib as _importlib
from typing import Any as _Any

from . import documents as _documents, measures as _measures
from ._native import ffi as _ffi, lib as _lib
from .conditions import Condition
from .curve import Curve
from .curves import Curves
from .errors import Error, HarmorphWarning, guard as _guard, guarded as _guarded
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
for _one in (one for one in map(globals().get, __all__) if isinstance(one, type)):
    _guard(_one)
rigid, swept_areas = _guarded(rigid, "rigid"), _guarded(swept_areas, "swept_areas")


def __getattr__(name: str) -> _Any:
    if name in ("usmesh", "dvgeo", "openmdao", "torch", "jax"):
        return _importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
