"""PyTorch: displacements of mesh points as a differentiable function of control points.

Importing this module imports ``torch``. The function is linear, so derivatives of any order exist.
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import torch

from .errors import Error
from .morph import Morph


def displacement(morph: Morph, move: torch.Tensor) -> torch.Tensor:
    """Return the displacement of each mesh point.

    Parameters
    ----------
    morph : Morph
    move : tensor of shape (..., functions, 2)
        Any number of leading dimensions is a batch. The sums are in double precision; the result
        has the type and the device of `move`.

    Returns
    -------
    tensor of shape (..., n_points, 2)
    """
    if move.shape[-2:] != (morph.functions, 2):
        raise Error(f"move must have the shape (..., {morph.functions}, 2), not {tuple(move.shape)}.")
    return _Displacement.apply(move, morph)


def morph_points(morph: Morph, move: torch.Tensor, points: Optional[torch.Tensor] = None) -> torch.Tensor:
    """Return moved coordinates.

    Parameters
    ----------
    morph : Morph
    move : tensor of shape (..., functions, 2)
    points : tensor of shape (n_points, 2) or (..., n_points, 2), optional
        Coordinates before the movement; the default is ``morph.start``.

    Returns
    -------
    tensor of shape (..., n_points, 2)
    """
    if points is None:
        points = torch.as_tensor(np.array(morph.start), dtype=move.dtype, device=move.device)
    return points + displacement(morph, move)


class _Displacement(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, move: torch.Tensor, morph: Morph) -> torch.Tensor:  # type: ignore[override]
        ctx.morph = morph
        return _rows(morph.displacement, move, (morph.n_points, 2))

    @staticmethod
    def backward(ctx: Any, dj: torch.Tensor) -> Any:  # type: ignore[override]
        return _Adjoint.apply(dj, ctx.morph), None


class _Adjoint(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, dj: torch.Tensor, morph: Morph) -> torch.Tensor:  # type: ignore[override]
        ctx.morph = morph
        return _rows(morph.adjoint, dj, (morph.functions, 2))

    @staticmethod
    def backward(ctx: Any, seed: torch.Tensor) -> Any:  # type: ignore[override]
        return _Displacement.apply(seed, ctx.morph), None


def _rows(function: Any, values: torch.Tensor, shape: tuple) -> torch.Tensor:
    """Apply `function` to each entry of a batch."""
    batch = values.detach().to("cpu", torch.float64).numpy()
    result = np.empty((*batch.shape[:-2], *shape))
    for index in np.ndindex(batch.shape[:-2]):
        function(batch[index], result[index])
    return torch.as_tensor(result).to(values.device, values.dtype)
