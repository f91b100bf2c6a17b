"""Structs of the library: options to fill in, and reports that describe a result."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from . import words
from ._native import ffi
from .errors import Error


class Report(SimpleNamespace):
    """The members of a struct of the C header as attributes, in its units.

    Arrays are tuples; kinds are the words that the options take. Numbers of points and cells are
    counted from 0; -1 means none.
    """

    def __repr__(self) -> str:
        lines = (f"    {name}={_shown(value)}," for name, value in vars(self).items())
        return "\n".join(["Report(", *lines, ")"])


def new(name: str) -> Any:
    """Return a new struct of the library, as HM_INIT makes it."""
    struct = ffi.new(f"{name}*")
    struct.struct_size = ffi.sizeof(name)
    return struct


def fill(struct: Any, **values: Any) -> Any:
    """Set members of a struct; a value of another type, or beyond the range of the member, is refused."""
    for name, value in values.items():
        try:
            setattr(struct, name, value)
        except (TypeError, OverflowError):
            kind = dict(ffi.typeof(struct).item.fields)[name].type.cname
            raise Error(f"{name} must be a number that fits into {kind}, not {value!r}.") from None
    return struct


def pair(value: Any, what: str) -> tuple:
    """Return the two entries of `value`; anything but two entries is refused."""
    try:
        first, second = value
    except (TypeError, ValueError):
        raise Error(f"{what} must have two entries, not {value!r}.") from None
    return first, second


def report(struct: Any) -> Report:
    """Return a copy of a struct that the library has filled."""
    members = {}
    for name, field in ffi.typeof(struct[0]).fields:
        if name in words.HIDDEN or name.startswith("reserved") or field.type.kind == "pointer":
            continue
        members[name] = words.of_value(name, _value(getattr(struct, name), field.type))
    return Report(**members)


def _shown(value: Any) -> str:
    """A value with 6 digits; reports inside of a tuple are indented."""
    if isinstance(value, tuple):
        inner = ", ".join(map(_shown, value))
        return f"({inner},)" if len(value) == 1 else f"({inner})"
    text = f"{value:.6g}" if isinstance(value, float) else repr(value)
    return text.replace("\n", "\n    ")


def _value(value: Any, kind: Any) -> Any:
    if kind.kind == "array":
        if kind.item.kind == "struct":
            return tuple(report(ffi.addressof(one)) for one in value)
        return tuple(value)
    return value
