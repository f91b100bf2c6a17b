"""Writes the sources of the browsable manual for Sphinx with the MyST parser.

usage: pages.py SOURCES FOLDER      SOURCES: the top level of harmorph, FOLDER: where the pages go

Every README.md and every page of c_api/packaging becomes a page at the same place. Every C header
becomes a page with a heading for each call and each struct, and the manual of the Fortran modules
becomes a page each. A file that a page links to becomes a page with the text of the file. The first
page lists one page for each kind of user.
"""

import re
import shutil
import sys
from pathlib import Path, PurePosixPath

# Title of a group and the pages of it, in order; a pattern stands for all pages that match and that
# no other group names. Pages of the first group have the user's language as their title.
GROUPS = [
    ("Where to begin", {
        "Introduction": "README.md",
        "C": "c_api/README.md",
        "C++": "c_api/cpp/README.md",
        "Fortran": "fortran/README.md",
        "FORTRAN 77": "fortran/harmorph77/README.md",
        "Python": "c_api/python/README.md",
        "JavaScript": "c_api/web/README.md",
        "OpenFOAM": "c_api/openfoam/README.md",
        "Command line": "c_api/cli/README.md",
    }),
    ("Reference", ["include/*.h", "fortran/*/manual.f90.in"]),
    ("Examples and other codes", ["c_api/*/README.md", "fortran/**/README.md"]),
    ("Releases and packages", ["c_api/packaging/*.md"]),
    ("Mathematics and design", ["src/README.md", "src/METHODS.md", "src/RECIPES.md", "src/*/README.md"]),
    ("Tests and measurements", ["tests/**/README.md"]),
]
LANGUAGES = {".c": "c", ".h": "c", ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".sh": "sh",
             ".f90": "fortran", ".in": "fortran", ".f": "fortranfixed"}
PICTURES = {".svg", ".png"}
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")


class Site:
    """Pages below a folder of sources, of which each is written once."""

    def __init__(self, top, to):
        self.top, self.to, self.written = top, to, set()

    def page_name(self, path):
        """The page of a file of the sources, without the suffix that Sphinx adds."""
        path = PurePosixPath(path)
        return str(path.with_suffix("")) if path.suffix == ".md" else f"{path}.page"

    def write(self, path, text):
        out = self.to / (self.page_name(path) + ".md")
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text, encoding="utf-8")

    def add(self, path):
        """Writes the page of a file, and the pages that this page links to."""
        if path in self.written:
            return
        self.written.add(path)
        text = (self.top / path).read_text(encoding="utf-8")
        if path.endswith(".md"):
            self.write(path, self.with_links(path, text))
        elif path.startswith("include/"):
            self.write(path, header_page(PurePosixPath(path).name, text))
        else:
            self.write(path, source_page(path, text))

    def with_links(self, path, text):
        """The text of a page with links to pages of the site instead of files and folders."""
        folder = PurePosixPath(path).parent

        def linked(match):
            words, target = match.groups()
            file, mark, place = target.partition("#")
            if not file or re.match(r"[a-z]+:", file):
                return match.group()
            full = normal(folder / file)
            if (self.top / full).is_dir():
                full = f"{full}/README.md".removeprefix("./")
                if not (self.top / full).is_file():
                    return words[1:-1]
            if PurePosixPath(full).suffix in PICTURES:
                (self.to / full).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.top / full, self.to / full)
                return match.group()
            self.add(full)
            depth = "../" * (len(folder.parts))
            return f"{words}({depth}{self.page_name(full)}.md{mark}{place})"

        # Blocks of code stay as they are. A link may continue on the next line.
        parts = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
        return "".join(part if part.startswith("```") else LINK.sub(linked, part) for part in parts)


def normal(path):
    """A path without the parts `..`."""
    parts = []
    for part in path.parts:
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts) or "."


def fenced(language, text):
    return f"````{language}\n{text.strip()}\n````\n"


def source_page(path, text):
    """A page with the text of a file; the manual of a module, as plain text, without exclamation marks."""
    path = PurePosixPath(path)
    if path.name == "manual.f90.in":
        manual = "\n".join(re.sub("^! ?", "", line) for line in text.split("\n"))
        return f"# Module {path.parent.name}\n\n{fenced('text', manual)}"
    return f"# {path}\n\n{fenced(LANGUAGES.get(path.suffix, 'text'), text)}"


def declarations(text):
    """Comments and declarations of a header, cut where a declaration ends outside of braces."""
    depth, chunk, in_comment = 0, [], False
    for line in text.split("\n"):
        if not line.strip() and not chunk:
            continue
        if re.match(r"/\* ---- .* ---- \*/$", line):
            yield "\n".join(chunk)
            chunk = []
            yield line
            continue
        chunk.append(line)
        code = re.sub(r"/\*.*?\*/", "", line)
        if in_comment:
            in_comment = "*/" not in line
            continue
        in_comment = "/*" in code
        depth += code.count("{") - code.count("}")
        ended = code.rstrip().endswith(";") and not in_comment
        if depth == 0 and ended:
            yield "\n".join(chunk)
            chunk = []
    yield "\n".join(chunk)


def header_page(name, text):
    """A page with a heading for each section, call and struct of a header."""
    for not_read in (r"/\* clang-format (off|on) \*/\n", r"#ifdef __cplusplus\n(extern \"C\" \{|\})\n#endif\n",
                     r"#ifndef \w+_H\n#define \w+_H\n", r"#endif\s*\Z"):
        text = re.sub(not_read, "", text)
    end = text.index("*/") + 2
    intro, rest = text[:end], text[end:]
    out = [f"# {name}\n", fenced("c", intro)]
    level = "##"
    for chunk in declarations(rest):
        section = re.match(r"/\* ---- (.*) ---- \*/$", chunk)
        if section:
            out.append(f"## {section.group(1)}\n")
            level = "###"
        elif chunk.strip():
            names = re.findall(r"^HM_API\b[^(;]*?\b(hm_\w+)\(", chunk, re.M)
            names += re.findall(r"^\} (hm_\w+);", chunk, re.M)
            if names:
                out.append(f"{level} {', '.join(names)}\n")
            out.append(fenced("c", chunk))
    return "\n".join(out)


def matching(top, patterns, taken):
    found = []
    for pattern in patterns:
        for path in sorted(top.glob(pattern)):
            name = path.relative_to(top).as_posix()
            if name not in taken and name not in found:
                found.append(name)
    return found


def contents(title, lines):
    """A table of contents, whose title stands on the first page and in the navigation of all pages."""
    return f"```{{toctree}}\n:maxdepth: 1\n:caption: {title}\n\n" + "\n".join(lines) + "\n```\n"


def main(top, to):
    site = Site(top, to)
    taken = set(GROUPS[0][1].values())
    index = ["# harmorph\n", "harmorph morphs an airfoil and the CFD mesh around the airfoil "
             "together. This manual has one page for each kind of user, and all headers and pages "
             "of the sources. It needs no network; the field on the left searches all pages.\n"]
    for title, pages in GROUPS:
        named = dict(pages) if isinstance(pages, dict) else None
        paths = list(named.values()) if named else matching(top, pages, taken)
        taken.update(paths)
        for path in paths:
            site.add(path)
        lines = [f"{words} <{site.page_name(path)}>" for words, path in named.items()] if named \
            else [site.page_name(path) for path in paths]
        index.append(contents(title, lines))
    quoted = sorted(site.written - taken)
    index.append(contents("Files that the pages name", [site.page_name(path) for path in quoted]))
    (to / "index.md").write_text("\n".join(index), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
