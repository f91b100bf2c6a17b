"""JAX: displacements of mesh points as a function with its own reverse derivative.

Importing this module imports ``jax``. The library runs on the host by ``jax.pure_callback``; inside
of ``jax.jit``, too. Sums are in double precision; the result has the type of the argument, which is
single precision unless ``jax_enable_x64`` is set.
"""

from __future__ import annotations

from typing import Any, Callable

import jax
import numpy as np

from .errors import Error
from .morph import Morph


def displacement(morph: Morph) -> Callable[[Any], Any]:
    """Return a function from movements to displacements of the mesh points.

    Parameters
    ----------
    morph : Morph

    Returns
    -------
    function
        Takes an array of shape (..., functions, 2), whose leading dimensions are a batch, and
        returns an array of shape (..., n_points, 2). ``jax.grad`` and ``jax.vjp`` use the exact
        transpose.
    """

    def on_host(function: Any, shape: tuple) -> Callable[[Any], np.ndarray]:
        def rows(values: Any) -> np.ndarray:
            batch = np.asarray(values)
            result = np.empty((*batch.shape[:-2], *shape))
            for index in np.ndindex(batch.shape[:-2]):
                function(batch[index].astype(np.float64), result[index])
            return result.astype(batch.dtype)

        return rows

    forward = on_host(morph.displacement, (morph.n_points, 2))
    backward = on_host(morph.adjoint, (morph.functions, 2))

    def called(function: Any, values: Any, shape: tuple) -> Any:
        kind = jax.ShapeDtypeStruct((*values.shape[:-2], *shape), values.dtype)
        return jax.pure_callback(function, kind, values)

    @jax.custom_vjp
    def displaced(move: Any) -> Any:
        if move.shape[-2:] != (morph.functions, 2):
            raise Error(f"move must have the shape (..., {morph.functions}, 2), not {move.shape}.")
        return called(forward, move, (morph.n_points, 2))

    def first(move: Any) -> Any:
        return displaced(move), None

    def second(_residuals: None, dj: Any) -> Any:
        return (called(backward, dj, (morph.functions, 2)),)

    displaced.defvjp(first, second)
    return displaced
