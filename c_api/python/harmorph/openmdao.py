"""OpenMDAO: a component from movements of control points to mesh points, matrix-free.

Importing this module imports ``openmdao.api``.
"""

from __future__ import annotations

from typing import Any

import openmdao.api as om

from .morph import Morph


class MorphComp(om.ExplicitComponent):
    """points = start + sum_i F_i (dx, dy)_i.

    Options
    -------
    morph : Morph

    Inputs
    ------
    move : shape (functions, 2)
        [length]

    Outputs
    -------
    points : shape (n_points, 2)
        [length]

    Notes
    -----
    ``compute_jacvec_product`` works in both modes, so that a problem with this component needs no
    matrix of partial derivatives.
    """

    def initialize(self) -> None:
        """Declare the option `morph`."""
        self.options.declare("morph", types=Morph, desc="functions of the mesh")

    def setup(self) -> None:
        """Add the input and the output."""
        morph = self.options["morph"]
        self.add_input("move", val=0.0, shape=(morph.functions, 2))
        self.add_output("points", val=morph.start)

    def compute(self, inputs: Any, outputs: Any, *_discrete: Any) -> None:
        """Move the mesh."""
        outputs["points"] = self.options["morph"].morph(inputs["move"])

    def compute_jacvec_product(
        self, inputs: Any, d_inputs: Any, d_outputs: Any, mode: str, *_discrete: Any
    ) -> None:
        """Add the product with the derivative ("fwd") or its transpose ("rev")."""
        if "points" not in d_outputs or "move" not in d_inputs:
            return
        morph = self.options["morph"]
        if mode == "fwd":
            d_outputs["points"] += morph.displacement(d_inputs["move"])
        else:
            d_inputs["move"] += morph.adjoint(d_outputs["points"])
