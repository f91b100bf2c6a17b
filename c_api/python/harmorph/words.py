"""The words of this package for constants, members and calls of C: in options, in reports, in sentences.

Options take words and reports give them (``"tied"``, ``"conformal"``). Sentences of the library, in
refusals and in the comments of the headers, name what a C program writes; :func:`in_python` puts
the words of this package there.
"""

from __future__ import annotations

import re
from typing import Dict

from ._native import lib

_SHOWN: Dict[str, str] = {}


def kinds(*words: str, prefix: str = "", **constants: str) -> Dict[str, int]:
    """Return the numbers of words: of ``HM_`` + prefix + the word, and of constants that are named otherwise."""
    names = {**constants, **{word: prefix + word.upper() for word in words}}
    _SHOWN.update({f"HM_{name}": f'"{word}"' for word, name in names.items()})
    return {word: getattr(lib, f"HM_{name}") for word, name in names.items()}


CLOSED = kinds("open", "tied", "periodic", auto="CLOSED_AUTO")
OPERATORS = kinds("conformal", "laplace", "weighted")
ENGINES = kinds("direct", "multigrid", "fas")
SPACES = kinds("planes", "wedge", auto="SPACE_AUTO")
STRATEGIES = kinds("linear", "other", "substeps", "untangled", "improved", prefix="STRATEGY_")

# Members of reports that are words here.
OF_MEMBERS = {
    "closed": CLOSED, "operator_kind": OPERATORS, "engine": ENGINES, "kind": SPACES, "strategy": STRATEGIES,
    "scheme": kinds("compact", "bounded", "nodal_gradient", "nodal_gradient_plain"),
    "storage": kinds("double", "single"),
}
# Members that C programs need.
HIDDEN = ("struct_size", "bytes", "index_base")

_NAMES = tuple((re.compile(pattern), word) for pattern, word in (
    (r"\bhm_assess\b|\bhm_quality_report\b(?!\.\w)", "Morph.assess"),
    (r"\bhm_move_safe\b", "Morph.safe"),
    (r"\bhm_boundary_error\b", "Morph.boundary_error"),
    (r"\bhm_(displace(_adjoint)?|improve|morph|slip)\b", r"Morph.\1"),
    (r"\bhm_(plan_(factor|solve)|setup_solve)\b", "Morph.solve"),
    (r"\bhm_(analysis|setup)_init\b", "Morph"),
    (r"\bhm_fit_marker\b", "Curves.fit"),
    (r"\bhm_fit\b", "Curves.fit_points"),
    (r"\bhm_refit\b", "Curves.refit"),
    (r"\b(options\.study|options|problem|target|error|hm_\w+)\.(?=[a-z])", ""),
    (r"\boperator_kind\b", "operator"),
    (r"\bn_derivatives\b", "derivative"),
    (r"\bskipped_strategies\b", "skip"),
    (r"\bn_others\b", "the number of others"),
    (r"\bNULL\b", "None"),
))


def of_value(member: str, value: int) -> object:
    """Return the word for the value of a member of a report, or the value."""
    return next((word for word, number in OF_MEMBERS.get(member, {}).items() if number == value), value)


def in_python(sentence: str) -> str:
    """Return a sentence of the library with the words of this package."""
    for pattern, word in _NAMES:
        sentence = pattern.sub(word, sentence)
    return re.sub(r"\bHM_(\w+)", lambda found: _SHOWN.get(found[0], found[1]), sentence)
