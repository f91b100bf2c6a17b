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

from ._manual import MEANINGS, MEMBERS

_MEMBERS = re.compile(r"^( *)\{members of (hm_\w+)\}$", flags=re.M)
_MEANING = re.compile(r"^( *)\{(.+): (HM_\w+)\}$", flags=re.M)
# The names that calls and reports of the library have in this package.
_WORDS = {
    "hm_assess": "Morph.assess", "hm_move_safe": "Morph.safe", "hm_boundary_error": "Morph.boundary_error",
    "hm_displace": "Morph.displace", "hm_fit_marker": "Curves.fit", "hm_fit": "Curves.fit_points",
    "hm_quality_report": "Morph.assess",
}
# Members that C programs need, or that mean something else here.
_HIDDEN = ("bytes", "index_base")
_OTHERWISE = {
    "has_factor": "1: the factor of the start was kept; 0: later calls factor again by themselves",
    "may_improve": "1: the last improvement ended at its limit of solutions, and more work may give better cells; "
                   "0: more work would bring little",
    "strategy": "what moved the mesh last: 0 linear, 1 other, 2 substeps, 3 untangled, 4 improved",
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
        shown = [name for name in names.split(", ") if name not in _HIDDEN and not name.startswith("reserved")]
        if shown:
            lines.append(_item(indent, f"- `{'`, `'.join(shown)}` : {kind}. ", _OTHERWISE.get(shown[0], meaning)))
    return "\n".join(lines)


def _meaning(indent: str, word: str, meaning: str) -> str:
    return _item(indent, f"- {word}: ", meaning)


def _item(indent: str, head: str, meaning: str) -> str:
    for name, word in _WORDS.items():
        meaning = re.sub(rf"\b{name}\b", word, meaning)
    meaning = re.sub(r"[,;:]? \(?see (?:hm_\w+|harmorph_\w+\.h|CONVENTIONS|options\.\w+|max_solutions)\)?", "", meaning)
    meaning = re.sub(r" \([^()]*harmorph_\w+\.h[^()]*\)", "", meaning)
    meaning = re.sub(r" ?\(hm_\w+\)", "", meaning)
    meaning = re.sub(r"\bHM_(\w+)", lambda found: found[1], meaning).replace("NULL", "None")
    return textwrap.fill((head + meaning).strip(), 100, initial_indent=indent, subsequent_indent=indent + "  ",
                         break_on_hyphens=False)
