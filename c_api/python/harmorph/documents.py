"""Docstrings with the sentences of the headers, for those who do not read C.

A line ``{members of hm_step_report}`` of a docstring becomes the members of the report, with types,
units and meanings, and a line ``{"rotate": HM_ROTATE}`` becomes the word with its meaning. The
sentences come from the comments of the headers (``native/manual.py``).
"""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import Any

from . import words
from ._manual import MEANINGS, MEMBERS

_MEMBERS = re.compile(r"^( *)\{members of (hm_\w+)\}$", flags=re.M)
_MEANING = re.compile(r"^( *)\{(.+): (HM_\w+)\}$", flags=re.M)
# Members that mean something else here, or that the headers explain elsewhere.
_OTHERWISE = {
    "has_factor": "1: the factor of the start was kept; 0: later calls factor again by themselves",
    "may_improve": "1: the last improvement ended at its limit of solutions, and more work may give better cells; "
                   "0: more work would bring little",
    "strategy": "what moved the mesh last; see `skip` of :meth:`Morph.safe`",
    "other": "which of `others`, from 0; -1: none. Where `others` is empty and the library has solved functions of "
             "another operator itself: that operator, a str",
    "operator_kind": "what :class:`Morph` was given; the scheme is \"compact\" unless a C program has chosen another",
    "min_quality_cell": "the cell of the smallest quality",
    "storage": "the precision of the functions: \"double\", or \"single\" of a file that a C program has made",
    "control_points": "functions = (combined, or control_points where that is 0) + 2 * bodies + modes",
}


def complete(thing: Any) -> None:
    """Fill the marked lines in the docstrings of a function, or of a class and its methods."""
    if inspect.isclass(thing):
        for base in thing.__mro__:
            if base.__module__.startswith(__package__):
                _fill(base)
                for member in vars(base).values():
                    _fill(getattr(member, "__func__", member))
    else:
        _fill(thing)


def _fill(thing: Any) -> None:
    text = getattr(thing, "__doc__", None)  # there are none with python -OO
    if (inspect.isfunction(thing) or inspect.isclass(thing)) and text and "{" in text:
        text = _MEMBERS.sub(lambda found: _members(found[1], found[2]), text)
        thing.__doc__ = _MEANING.sub(lambda found: _meaning(found[1], found[2], MEANINGS[found[3]]), text)


def _members(indent: str, struct: str) -> str:
    lines = []
    for names, kind, meaning in MEMBERS[struct]:
        shown = [name for name in names.split(", ") if name not in words.HIDDEN and not name.startswith("reserved")]
        if shown:
            kind = "str" if shown[0] in words.OF_MEMBERS else kind
            lines.append(_item(indent, f"- `{'`, `'.join(shown)}` : {kind}. ", _OTHERWISE.get(shown[0], meaning)))
    return "\n".join(lines)


def _meaning(indent: str, word: str, meaning: str) -> str:
    return _item(indent, f"- {word}: ", meaning)


def _item(indent: str, head: str, meaning: str) -> str:
    meaning = re.sub(r"[,;:]? \(?see (?:hm_\w+|harmorph_\w+\.h|CONVENTIONS|options\.\w+|max_solutions)\)?", "", meaning)
    meaning = re.sub(r" \([^()]*(?:harmorph_\w+\.h|README\.md)[^()]*\)", "", meaning)
    meaning = re.sub(r" See `\w+` of hm_\w+ [^.]*\.", "", meaning)
    meaning = re.sub(r" ?\(hm_\w+\)", "", meaning)
    for argument, name in (("`from`", "`points`"), ("from + t", "points + t"), ("`to`", "the result")):
        meaning = meaning.replace(argument, name)
    meaning = words.in_python(meaning)
    return textwrap.fill((head + meaning).strip(), 100, initial_indent=indent, subsequent_indent=indent + "  ",
                         break_on_hyphens=False)
