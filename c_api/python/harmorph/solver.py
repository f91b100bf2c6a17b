"""Analysis and plan: what is needed to solve functions, and for calls that solve on the way."""

from __future__ import annotations

from typing import Any, List, Optional, Tuple

import numpy as np

from ._native import ffi, lib
from .conditions import Condition, structs
from .curves import Curves
from .errors import MEMORY, Error, call, call_with_memory
from .mesh import Mesh
from .reports import fill, new
from .threads import Executor
from .words import ENGINES, OPERATORS


def options_of(
    operator: str,
    engine: str,
    exponent: Optional[float],
    offset_correction: bool,
    tolerance: float,
) -> dict:
    """Return the members of ``hm_options`` for these arguments of :class:`harmorph.Morph`."""
    for name, value, known in (("operator", operator, OPERATORS), ("engine", engine, ENGINES)):
        if value not in known:
            raise Error(f"{name} must be one of {list(known)}, not {value!r}.")
    if exponent is not None and not isinstance(exponent, (int, float)):
        raise Error(f"exponent must be a number, not {exponent!r}.")
    return {
        "operator_kind": OPERATORS[operator],
        "engine": ENGINES[engine],
        "exponent": 0 if exponent is None else exponent or -1,
        "offset_correction": int(offset_correction),
        "tolerance": tolerance,
    }


class Solver:
    """Analysis, plan and factor of one problem. One thread at a time may use a solver.

    Parameters
    ----------
    mesh : Mesh
        Its coordinates must not change but by the owner, who then calls :meth:`factor`.
    curves : Curves or None
    pairs : list of (int, Condition)
    options : dict
        What :func:`options_of` returned, and ``max_curve_distance``.
    executor : Executor
    fluxes : pair of arrays, optional
        See :class:`harmorph.Morph`.
    known : tuple of arrays of shape (n,), optional
        Mesh points on curves, counted from 0, their curves and their parameters; the parameters of other
        points are found by projection.
    """

    def __init__(
        self,
        mesh: Mesh,
        curves: Optional[Curves],
        pairs: List[Tuple[int, Condition]],
        options: dict,
        executor: Executor,
        fluxes: Any = None,
        known: Any = None,
    ) -> None:
        self.mesh = mesh
        self._alive = (curves, pairs, executor, fluxes)
        own = dict(options)
        problem = fill(new("hm_problem"), max_curve_distance=own.pop("max_curve_distance", 0.0))
        struct = fill(new("hm_options"), **own)
        struct.executor = executor.view
        conditions = structs(mesh, curves, pairs)
        problem.mesh = mesh._c
        problem.curves = curves._c if curves is not None else ffi.NULL
        problem.n_conditions, problem.conditions = len(pairs), conditions
        if fluxes is not None:
            faces, values = fluxes
            fill(problem, n_fluxes=len(faces), flux_points=ffi.from_buffer("int32_t[]", faces),
                 fluxes=ffi.from_buffer("double[]", values))
        if known is not None:
            points, numbers, u = (known[0] + np.int32(mesh._c.index_base), *known[1:])
            fill(problem, n_known=len(points), known_points=ffi.from_buffer("int32_t[]", points),
                 known_curves=ffi.from_buffer("int32_t[]", numbers), known_u=ffi.from_buffer("double[]", u))
        analysis, plan = ffi.new("hm_analysis**"), ffi.new("hm_plan**")
        self._analysis_block = call_with_memory(lib.hm_analysis_init, analysis, MEMORY, problem, struct,
                                                names=mesh.names)
        self.analysis = analysis[0]
        self._plan_block = call_with_memory(lib.hm_plan_init, plan, MEMORY, self.analysis)
        self.plan = plan[0]
        self.has_factor = False

    def factor(self) -> None:
        """Factor the matrix on the coordinates of the mesh, unless the plan has a factor."""
        if not self.has_factor:
            call(lib.hm_plan_factor, self.plan, ffi.NULL)
            self.has_factor = True

    @property
    def bytes(self) -> int:
        """Memory of analysis and plan."""
        return len(self._analysis_block) + len(self._plan_block)

    def given_points(self) -> np.ndarray:
        """Return the wall points with given displacements, in the order of the library."""
        n = ffi.new("int32_t*")
        points = np.empty(self.mesh.n_points, np.int32)
        call(lib.hm_given_points, self.plan, ffi.from_buffer("int32_t[]", points), len(points), n)
        return points[: n[0]].copy()
