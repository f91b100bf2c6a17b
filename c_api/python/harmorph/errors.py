"""Refusals and warnings of the library as Python exceptions and warnings."""

from __future__ import annotations

import warnings
from typing import Any, Mapping, Optional

import numpy as np

from ._native import ffi, lib

_KINDS = {
    getattr(lib, name): name[len("HM_ITEM_") :].lower().replace("_", " ")
    for name in dir(lib)
    if name.startswith("HM_ITEM_") and name != "HM_ITEM_NONE"
}


MEMORY = object()  # the place of the hm_memory among the arguments of call_with_memory


class _Finding:
    """What the library says about a call, for :class:`Error` and :class:`HarmorphWarning`.

    Attributes
    ----------
    code : int
        The status of the C header, for instance ``harmorph.Error.BAD_MESH``.
    name : str
        The name of the status, for instance ``"HM_BAD_MESH"``.
    kind : str or None
        What the item is: ``"point"``, ``"cell"``, ``"marker"``, ``"control point"`` and so on.
    item : int or None
        The first offending item, counted from 0 (markers: the number of the marker).
    other_kind, other : str or None, int or None
        A second item that the finding is about.
    value : float
        The value found (area in length^2, residual, missing bytes), or 0.
    place : tuple of float
        The place that the text names [length], or ``(0.0, 0.0)``.
    text : str
        One or two sentences.
    """

    def __init__(
        self,
        text: str,
        code: int = lib.HM_BAD_ARGUMENT,
        kind: Optional[str] = None,
        item: Optional[int] = None,
        other_kind: Optional[str] = None,
        other: Optional[int] = None,
        value: float = 0.0,
        place: tuple = (0.0, 0.0),
    ) -> None:
        super().__init__(text)  # type: ignore[call-arg]
        self.text = text
        self.code = code
        self.name = ffi.string(lib.hm_status_name(code)).decode() if code else "BAD_FILE"
        self.kind, self.item = kind, item
        self.other_kind, self.other = other_kind, other
        self.value, self.place = value, place

    def __reduce__(self) -> Any:
        state = (self.text, self.code, self.kind, self.item, self.other_kind, self.other)
        return type(self), (*state, self.value, self.place)


class Error(_Finding, ValueError):
    """A call was refused. Outputs are as before the call.

    The attributes are `code`, `name`, `kind`, `item`, `other_kind`, `other`, `value`, `place` and
    `text`. The codes of the C header are attributes of the class, without their prefix:
    ``Error.CANCELLED``, ``Error.BAD_ARGUMENT``, ``Error.BAD_MESH`` and so on. Wrong shapes, types
    and strides have the code ``Error.BAD_ARGUMENT``; files have ``Error.BAD_FILE``, which is 0.
    """

    CANCELLED = lib.HM_CANCELLED
    BAD_ARGUMENT = lib.HM_BAD_ARGUMENT
    BAD_MESH = lib.HM_BAD_MESH
    BAD_CURVE = lib.HM_BAD_CURVE
    BAD_CONDITION = lib.HM_BAD_CONDITION
    BAD_BASIS = lib.HM_BAD_BASIS
    BLOCK_TOO_SMALL = lib.HM_BLOCK_TOO_SMALL
    NOT_POSITIVE = lib.HM_NOT_POSITIVE
    UNSUPPORTED = lib.HM_UNSUPPORTED
    CROSSING = lib.HM_CROSSING
    BAD_FILE = 0


class HarmorphWarning(_Finding, UserWarning):
    """A call succeeded, and its result can be used with the reservation that the text names.

    The attributes are those of :class:`Error`. The codes are attributes of the class:
    ``HarmorphWarning.NOT_CONVERGED``, ``MOVED``, ``SHORT``, ``BACKTRACKS``, ``FAR_FROM_CURVE``,
    ``FAR_FROM_POINTS``, ``POOR`` and ``TORN``.
    """

    NOT_CONVERGED = lib.HM_NOT_CONVERGED
    MOVED = lib.HM_MOVED
    SHORT = lib.HM_SHORT
    BACKTRACKS = lib.HM_BACKTRACKS
    FAR_FROM_CURVE = lib.HM_FAR_FROM_CURVE
    FAR_FROM_POINTS = lib.HM_FAR_FROM_POINTS
    POOR = lib.HM_POOR
    TORN = lib.HM_TORN


def check(status: int, error: Any, names: Optional[Mapping[int, str]] = None) -> int:
    """Raise what the library refused, warn of what it reports, and return the status.

    Parameters
    ----------
    status : int
        The result of a call of the library.
    error : cdata
        Its ``hm_error``.
    names : mapping of int to str, optional
        Names of markers by their numbers, which are added to the text.
    """
    if status == 0:
        return status
    text = ffi.string(error.text).decode("utf-8", "replace")
    kind, item = _item(error.item_kind, error.item, error.item_base)
    other_kind, other = _item(error.other_kind, error.other, error.other_base)
    if names and kind == "marker" and item in names:
        text += f"; marker {item} is {names[item]!r}"
    finding = (text, status, kind, item, other_kind, other, error.value, (error.x, error.y))
    if status < 0:
        raise Error(*finding)
    warnings.warn(HarmorphWarning(*finding), stacklevel=_stack_level())
    return status


def call(function: Any, *arguments: Any, names: Optional[Mapping[int, str]] = None) -> int:
    """Call `function` of the library with an ``hm_error``; see :func:`check`."""
    error = ffi.new("hm_error*")
    try:
        status = function(*arguments, error)
    except (TypeError, OverflowError) as reason:
        raise Error(f"An argument has another type, or is too large: {reason}.") from None
    return check(status, error, names)


def call_with_memory(
    function: Any, *arguments: Any, names: Optional[Mapping[int, str]] = None
) -> np.ndarray:
    """Call `function` twice, with an ``hm_memory`` in the place of `MEMORY`: for its size, and with a block.

    Returns the block, which keeps an object alive that the call has made.
    """
    memory = ffi.new("hm_memory*")
    given = [memory if one is MEMORY else one for one in arguments]
    call(function, *given, names=names)
    block = np.empty(memory.bytes, np.uint8)
    memory.block = ffi.from_buffer(block)
    call(function, *given, names=names)
    return block


def _item(kind: int, item: int, base: int) -> tuple:
    return (_KINDS[kind], item - base) if kind in _KINDS else (None, None)


def _stack_level() -> int:
    """The level of the first caller outside of this package, for the place of a warning."""
    import sys

    level, frame = 2, sys._getframe(2)
    while frame.f_back and frame.f_globals.get("__name__", "").startswith("harmorph."):
        frame, level = frame.f_back, level + 1
    return level
