"""pyGeo's protocol: design variables that move sets of points on a section.

The methods are those of ``pygeo.parameterization.BaseDVGeometry``. Points lie on the curves and
move with them; :class:`harmorph.usmesh.USMesh` then carries the mesh along.
"""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np

from .curves import Curves
from .errors import Error
from .variables import Variables


class _Group(NamedTuple):
    variables: Variables
    lower: Any
    upper: Any
    scale: Any


class DVGeo:
    """Design variables of a section, and sets of points on it.

    Parameters
    ----------
    curves : Curves
        The curves of the section, in the plane of the first two of `axes`.
    axes : pair of int
        The columns of three-dimensional points that are x and y of the curves; (0, 2) for a grid
        whose layers are planes y = constant.
    tolerance : float
        How far a point may be from the curves, in parts of their extent.

    Examples
    --------
    >>> geometry = DVGeo(curves)                                            # doctest: +SKIP
    >>> geometry.addVariables("shape", curves.variables("cst", n_upper=4))  # doctest: +SKIP
    >>> solver.setDVGeo(geometry)                                           # doctest: +SKIP
    """

    def __init__(self, curves: Curves, axes: tuple = (0, 1), tolerance: float = 0.05) -> None:
        self.curves = curves
        self._axes = list(axes)
        self._tolerance = tolerance * np.ptp(curves.control, axis=0).max()
        self._groups: Dict[str, _Group] = {}
        self._values: Dict[str, np.ndarray] = {}
        self._points: Dict[str, np.ndarray] = {}
        self._basis: Dict[str, np.ndarray] = {}
        self.updated: Dict[str, bool] = {}

    def addVariables(
        self, name: str, variables: Variables, lower: Any = None, upper: Any = None, scale: Any = 1.0
    ) -> int:
        """Add a group of design variables, all 0 at first.

        Parameters
        ----------
        name : str
        variables : Variables
            Made by :meth:`harmorph.Curves.variables`.
        lower, upper, scale : float or array, optional
            For the optimiser.

        Returns
        -------
        int
            The number of values of the group: n, or 2 n for "ffd" (x and y of each node in turn).
        """
        if name in self._groups:
            raise Error(f"There is a group of variables {name!r} already.")
        if len(variables.matrix) != len(self.curves.control):
            raise Error(f"The variables move {len(variables.matrix)} control points, the curves have "
                        f"{len(self.curves.control)}.")
        self._groups[name] = _Group(variables, lower, upper, scale)
        self._values[name] = np.zeros(int(np.prod(variables.shape)))
        return len(self._values[name])

    # ---- The protocol ----

    def __repr__(self) -> str:
        return f"DVGeo({self.getNDV()} design variables)"

    def addPointSet(self, points: Any, ptName: str, **_ignored: Any) -> None:
        """Add a set of points on the section.

        Parameters
        ----------
        points : array of shape (n, 3)
        ptName : str

        Raises
        ------
        Error
            The point `item` is too far from the curves.
        """
        array = np.array(points, float).reshape(-1, 3)
        basis = np.zeros((len(array), len(self.curves.control)))
        for k, point in enumerate(array[:, self._axes]):
            found = [self.curves.project(point, curve) for curve in range(len(self.curves.curves))]
            curve = int(np.argmin([distance for _, distance in found]))
            if found[curve][1] > self._tolerance:
                raise Error(f"Point {k} of {ptName!r} is {found[curve][1]:g} away from the curves.",
                            Error.BAD_CURVE, "point", k, value=found[curve][1])
            basis[k] = self.curves.basis([found[curve][0]], curve)[0]
        self._points[ptName], self._basis[ptName], self.updated[ptName] = array, basis, False

    def addVariablesPyOpt(self, optProb: Any, **_ignored: Any) -> None:
        """Add all groups to a pyOptSparse problem by its `addVarGroup`."""
        for name, group in self._groups.items():
            value = self._values[name]
            optProb.addVarGroup(name, len(value), "c", value=value, lower=group.lower, upper=group.upper,
                                scale=group.scale)

    def getNDV(self) -> int:
        """Return the number of all values."""
        return sum(len(value) for value in self._values.values())

    def getValues(self) -> Dict[str, np.ndarray]:
        """Return copies of the values by group."""
        return {name: value.copy() for name, value in self._values.items()}

    def getVarNames(self, **_ignored: Any) -> List[str]:
        """Return the names of the groups."""
        return list(self._groups)

    def pointSetUpToDate(self, ptSetName: str) -> bool:
        """Return if :meth:`update` was called for the set since the values were set."""
        return self.updated.get(ptSetName, True)

    def setDesignVars(self, dvDict: Dict[str, Any]) -> None:
        """Set values by group; names of other objects are passed over.

        Parameters
        ----------
        dvDict : dict of str to array
            For each group as many values as :meth:`addVariables` returned.

        Raises
        ------
        Error
            A group has another number of values, or a value is infinite or NaN. All values are then unchanged.
        """
        new = {}
        for name, value in dvDict.items():
            if name in self._groups:
                new[name] = np.array(value, float).ravel()
                if new[name].shape != self._values[name].shape:
                    raise Error(f"The group {name!r} has {len(self._values[name])} values, not {new[name].size}.")
                if not np.isfinite(new[name]).all():
                    first = int(np.argmin(np.isfinite(new[name])))
                    raise Error(f"Value {first} of the group {name!r} is {new[name][first]}; values must be finite.")
        self._values.update(new)
        self.updated = dict.fromkeys(self.updated, False)

    def update(self, ptSetName: str, **_ignored: Any) -> np.ndarray:
        """Return the points of a set at the current values, shape (n, 3)."""
        points = self._set(ptSetName).copy()
        points[:, self._axes] += self._basis[ptSetName] @ self.move()
        self.updated[ptSetName] = True
        return points

    def totalSensitivity(self, dIdpt: Any, ptSetName: str, comm: Any = None, **_ignored: Any) -> Dict[str, np.ndarray]:
        """Return derivatives by the values from those by the points of a set.

        Parameters
        ----------
        dIdpt : array of shape (n, 3) or (m, n, 3)
            Of one function or of m functions.
        ptSetName : str
        comm : mpi4py communicator, optional
            The derivatives of all processes are added.

        Returns
        -------
        dict of str to ndarray of shape (m, values of the group)
            m is 1 for one function.
        """
        n = len(self._set(ptSetName))
        seeds = np.asarray(dIdpt, float)
        if seeds.shape[-2:] != (n, 3) or seeds.ndim not in (2, 3):
            raise Error(f"dIdpt must have the shape ({n}, 3) or (m, {n}, 3), not {seeds.shape}.")
        gradients = np.einsum("kc,mka->mca", self._basis[ptSetName], seeds.reshape(-1, n, 3)[:, :, self._axes])
        result = {}
        for name, group in self._groups.items():
            rows = np.array([group.variables.gradient(one).ravel() for one in gradients])
            result[name] = rows if comm is None else sum(comm.allgather(rows))
        return result

    def totalSensitivityProd(self, vec: Dict[str, Any], ptSetName: str, **_ignored: Any) -> np.ndarray:
        """Return the movement of the points of a set for a movement of the values, shape (n, 3)."""
        result = np.zeros_like(self._set(ptSetName))
        for name, seed in vec.items():
            if name in self._groups:
                variables = self._groups[name].variables
                step = variables.move(np.asarray(seed, float).reshape(variables.shape))
                result[:, self._axes] += self._basis[ptSetName] @ step
        return result

    def move(self, values: Optional[Dict[str, Any]] = None) -> np.ndarray:
        """Return the movement of the control points at the current values, shape (n_control, 2)."""
        result = np.zeros_like(self.curves.control)
        for name, value in (self._values if values is None else values).items():
            variables = self._groups[name].variables
            result += variables.move(np.asarray(value, float).reshape(variables.shape))
        return result

    def _set(self, name: str) -> np.ndarray:
        if name not in self._points:
            raise Error(f"There is no point set {name!r}; there are {list(self._points)}.")
        return self._points[name]
