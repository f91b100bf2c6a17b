"""Refusals and warnings of the library as Python exceptions and warnings."""

from __future__ import annotations

import difflib
import functools
import inspect
import warnings
from typing import Any, Mapping, Optional

import numpy as np

from ._native import ffi, lib
from .words import in_python

_KINDS = {
    getattr(lib, name): name[len("HM_ITEM_") :].lower().replace("_", " ")
    for name in dir(lib)
    if name.startswith("HM_ITEM_") and name != "HM_ITEM_NONE"
}


MEMORY = object()  # the place of the hm_memory among the arguments of call_with_memory


class _Finding:
    """What the library says about a call, for :class:`Error` and :class:`HarmorphWarning`."""

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

    Attributes
    ----------
    code : int
        What was refused, one of these attributes of the class:

        {CANCELLED: HM_CANCELLED}
        - BAD_ARGUMENT: a shape, type, stride or number out of range, an option that a call does not have
        {BAD_MESH: HM_BAD_MESH}
        {BAD_CURVE: HM_BAD_CURVE}
        {BAD_CONDITION: HM_BAD_CONDITION}
        {BAD_BASIS: HM_BAD_BASIS}
        {BLOCK_TOO_SMALL: HM_BLOCK_TOO_SMALL}
        {NOT_POSITIVE: HM_NOT_POSITIVE}
        {UNSUPPORTED: HM_UNSUPPORTED}
        {CROSSING: HM_CROSSING}
        - BAD_FILE: a file that cannot be read or written; its value is 0
    name : str
        The name of the code in C: that of the attribute, with a prefix.
    kind : str or None
        What the item is: ``"point"``, ``"cell"``, ``"marker"``, ``"control point"`` and so on.
    item : int or None
        The first offending item, counted from 0 (markers: the number of the marker).
    other_kind, other : str or None, int or None
        A second item that the error is about.
    value : float
        The value found (area in length^2, residual, missing bytes), or 0.
    place : tuple of float
        The place that the text names [length], or ``(0.0, 0.0)``.
    text : str
        One or two sentences.
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

    Attributes
    ----------
    code : int
        One of these attributes of the class:

        {NOT_CONVERGED: HM_NOT_CONVERGED}
        {MOVED: HM_MOVED}
        {SHORT: HM_SHORT}
        {BACKTRACKS: HM_BACKTRACKS}
        {FAR_FROM_CURVE: HM_FAR_FROM_CURVE}
        {FAR_FROM_POINTS: HM_FAR_FROM_POINTS}
        {POOR: HM_POOR}
        {TORN: HM_TORN}
    name, kind, item, other_kind, other, value, place, text
        As in :class:`Error`.
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
    text = in_python(ffi.string(error.text).decode("utf-8", "replace"))
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


def guard(one: Any) -> None:
    """Make the calls of a class refuse arguments that they do not have by an :class:`Error`."""
    for base in one.__mro__:
        for name, member in list(vars(base).items()):
            function = getattr(member, "__func__", member)
            is_own = inspect.isfunction(function) and function.__module__.startswith(f"{__package__}.")
            makes = name in ("__init__", "__new__")
            is_quick = name in ("displacement", "morph", "adjoint")  # calls of microseconds
            if is_own and not is_quick and not hasattr(function, "__wrapped__") and (makes or name[0] != "_"):
                called = one.__name__ if makes else f"{one.__name__}.{name}"
                wrapped = guarded(function, called)
                setattr(base, name, wrapped if function is member else type(member)(wrapped))


def guarded(function: Any, name: str) -> Any:
    """Return `function`, which is called `name`, with refusals of arguments that it does not have."""

    @functools.wraps(function)
    def called(*arguments: Any, **named: Any) -> Any:
        try:
            return function(*arguments, **named)
        except TypeError:
            refusal = _misnamed(function, name, arguments, named)
            if refusal is None:  # the arguments are right: something else went wrong
                raise
            raise refusal from None

    return called


def _misnamed(function: Any, name: str, arguments: tuple, named: Mapping[str, Any]) -> Optional[Error]:
    known = inspect.signature(function).parameters
    try:
        inspect.signature(function).bind(*arguments, **named)
        return None
    except TypeError as reason:
        unknown = next((one for one in named if one not in known), None)
        if unknown is None:
            return Error(f"{name}: {reason}.")
    options = [one for one, kind in known.items() if kind.default is not kind.empty]
    close = difflib.get_close_matches(unknown, list(known), 1)
    end = f"; did you mean {close[0]!r}?" if close else "."
    listed = f"; options are {', '.join(options)}" if options else ""
    return Error(f"{name} has no option {unknown!r}{listed}{end}")


def _item(kind: int, item: int, base: int) -> tuple:
    return (_KINDS[kind], item - base) if kind in _KINDS else (None, None)


def _stack_level() -> int:
    """The level of the first caller outside of this package, for the place of a warning."""
    import sys

    level, frame = 2, sys._getframe(2)
    while frame.f_back and frame.f_globals.get("__name__", "").startswith("harmorph."):
        frame, level = frame.f_back, level + 1
    return level
