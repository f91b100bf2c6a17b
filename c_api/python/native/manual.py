"""What the comments of the headers say about members of structs and about constants.

The headers are the manual of the library, and docstrings of the package repeat it for those who do
not read C. ``manual(folder)`` returns the text of the module ``harmorph._manual``, which is written
when the extension is built; ``harmorph.documents`` puts its sentences into docstrings.
"""

import pprint
import re
from pathlib import Path

from declarations import topics

COMMENT = re.compile(r"/\*(.*?)\*/", flags=re.S)
TYPES = {"double": "float", "int32_t": "int", "int64_t": "int", "uint64_t": "int", "size_t": "int"}


def manual(folder):
    """Return the module `_manual`: MEMBERS of structs and MEANINGS of constants, from the headers in `folder`."""
    members, meanings = {}, {}
    for name in topics(folder):
        text = (Path(folder) / f"{name}.h").read_text(encoding="utf-8")
        for struct, body in re.findall(r"^typedef struct (hm_\w+) \{\n(.*?)^\} \1;", text, flags=re.S | re.M):
            members[struct] = [one for one in map(_member, _parts(body, ";")) if one]
        for body in re.findall(r"^enum \{(.*?)\};", text, flags=re.S | re.M):
            for declared, comment in _parts(body, ","):
                constant = re.match(r"\s*(HM_\w+)\s*=", declared)
                if constant and comment:
                    meanings[constant.group(1)] = comment
    head = '"""Sentences of the headers; written when the extension is built."""\n\n'
    return f"{head}MEMBERS = {pprint.pformat(members, width=110)}\n\nMEANINGS = {pprint.pformat(meanings, width=110)}\n"


def _parts(body, end):
    """Yield pairs of a declaration and its comment: the one on lines before, and the one behind it on its line."""
    before, declared, complete, has_code = "", "", None, False
    for piece in re.split(r"(/\*.*?\*/|\n)", body, flags=re.S):
        comment = COMMENT.fullmatch(piece)
        if piece == "\n":
            has_code = False
        elif comment and has_code and complete and not declared.strip():
            complete = complete[0], f"{complete[1]} {_plain(comment.group(1))}".strip()
        elif comment:
            before = f"{before} {_plain(comment.group(1))}".strip()
        else:
            has_code = has_code or bool(piece.strip())
            *ended, declared = (declared + piece).split(end)
            for one in ended:
                if complete:
                    yield complete
                complete, before = (one, before), ""
    if complete:
        yield complete
    if declared.strip():
        yield declared, before


def _plain(comment):
    return re.sub(r"\s*\n\s*\*?\s*", " ", comment).strip()


def _member(part):
    declared, comment = part
    found = re.match(r"\s*(\w+)\s+(\w[\w\s,\[\]]*)$", declared)
    if found is None or found.group(1) not in TYPES or found.group(2).startswith(("struct_size", "reserved")):
        return None
    names = re.sub(r"\s+", " ", found.group(2)).strip()
    kind = "tuple of " + TYPES[found.group(1)] if "[" in names else TYPES[found.group(1)]
    return re.sub(r"\[\w+\]", "", names), kind, comment
