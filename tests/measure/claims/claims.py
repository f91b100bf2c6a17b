"""Measures the numbers that README and the pages state with a command beside them: `make claims`.

usage: claims.py BUILD [NAME ...]      NAME: measures only claims whose command contains this text
       claims.py --pages               compares the pages with the list of claims, and measures nothing

The file claims.txt beside this script has one block of lines for each claim:

    page       the page, from the top level
    text       words of the page, as they stand there, with the claimed number in angle brackets
    command    what is run, once for all claims that name the command, with BUILD in the environment
    pattern    a regular expression with one group; its last match in the output is the measured number.
               With two groups, the ratio of the first to the second number is measured.
    worse      below or above: a measured number below (above) the claimed one is worse
    tolerance  how much worse the measured number may be, in per cent of the claimed one

A page or a command that a block does not name is that of the block before. A block with the lines
page, exempt (the reason) and text, once or several times, stands for sentences whose numbers are
not measured, as they are limits, or state a case or the time of one machine.

Every sentence, item and table of a page, and every sentence of a comment in the headers, with a
number of a measurement needs a claim or an exemption whose text stands in it. In a paragraph that
names a measuring command all numbers are those of measurements; elsewhere those with a unit of
time, memory or share, with an exponent, and those of iterations, cycles and ratios.

Three things are failures: a text that the page no longer contains, a sentence with such a number
that no text stands for, and a measured number that is worse by more than the tolerance. The last
line counts. A command that needs a program that is not installed says so in
its output with the word "skipped"; claims on it are then skipped.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

COMMAND = re.compile(r"`([^`]*(?:make (?:deform|compare|paper|bench[a-z-]*|test-saturne|coverage|mutate|sanitize)|"
                     r"(?:sh|python) tests/|sh c_api/)[^`]*)`")
# A number of a measurement; numbers inside words, code, dates and versions are not.
NUMBER = re.compile(r"(?<![\w.,-])\d*\.?\d+(?![\w-])")
# A number of a measurement outside paragraphs with a command: with one of these units, or with an exponent.
UNITS = (r"%|per cent|ms|milliseconds?|microseconds?|ns|us|seconds?|minutes?|hours?|s|[GMk]B|[KM]iB|bytes|"
         r"[GM]B/s|cycles|iterations|times")
MEASURED = re.compile(r"(?<![\w.,-])(?:\d+(?: \d{3})*(?:\.\d+)?|\.\d+)(?: (?:to|or|and) [\d.]+)? "
                      rf"(?:{UNITS})(?!\w)|\d(?:\.\d+)?e-\d+")
NOT_PROSE = re.compile(r"`[^`]*`|\(?\d{4}-\d\d-\d\d\)?")
KEYS = {"page", "text", "command", "pattern", "worse", "tolerance"}


def normal(text):
    return re.sub(r"\s+", " ", text)


def claims(path):
    found, last = [], {}
    for block in re.split(r"\n\s*\n", path.read_text(encoding="utf-8")):
        lines = [line for line in block.split("\n") if line and not line.startswith("#")]
        if not lines:
            continue
        pairs = [line.split(None, 1) for line in lines]
        claim = {**last, **dict(pairs)}
        last = {key: claim[key] for key in ("page", "command") if key in claim}
        if "exempt" in claim:
            claim.pop("command", None)
            texts = [text for key, text in pairs if key == "text"]
            found.extend({**claim, "text": text} for text in texts[:-1])
        if set(claim) not in (KEYS, {"page", "text", "exempt"}):
            sys.exit(f"{path}: a claim needs the lines {', '.join(sorted(KEYS))}: {lines[0]}")
        found.append(claim)
    return found


def paragraphs(page):
    """Paragraphs and items of lists; a table belongs to the paragraph before it."""
    text = re.sub(r"^```.*?^```$", "", page, flags=re.M | re.S)
    out = []
    for part in re.split(r"\n\s*\n|\n(?=- )", text):
        if part.lstrip().startswith("|") and out:
            out[-1] += "\n" + part
        else:
            out.append(part)
    return out


def units(part):
    """The sentences of a paragraph or an item; its table is one of them."""
    prose = "\n".join(line for line in part.split("\n") if not line.lstrip().startswith("|"))
    table = "\n".join(line for line in part.split("\n") if line.lstrip().startswith("|"))
    text = normal(re.sub(r"^\s*\d+\. ", "", prose, flags=re.M))
    sentences = re.split(r"(?<=[^\d.][.!?]) (?=[A-Z`(])|(?<=\d\d\.) (?=[A-Z])", text)
    return [unit for unit in sentences + [normal(table)] if unit.strip()]


def comments(header):
    """The comments of a header, without what marks them."""
    return [re.sub(r"^\s*\* ?", "", text, flags=re.M) for text in re.findall(r"/\*(.*?)\*/", header, re.S)]


def number(text):
    return float(text.replace(" ", ""))


class Count:
    def __init__(self):
        self.passed = self.failed = self.skipped = 0

    def judge(self, good, text):
        self.passed, self.failed = self.passed + good, self.failed + (not good)
        print(("  " if good else "FAIL claims: ") + text, flush=True)


def contents(page):
    text = Path(page).read_text(encoding="utf-8")
    return normal(" ".join(comments(text)) if page.endswith(".h") else text)


def find_texts(known, count):
    """All texts of claims stand on their pages."""
    for claim in known:
        text = normal(claim["text"]).replace("<", "").replace(">", "")
        if text not in contents(claim["page"]):
            count.judge(False, f"{claim['page']} does not say: {text}")


def find_numbers(known, count):
    """Each sentence with a number of a measurement has a claim or an exemption."""
    history = "c_api/packaging/CHANGELOG.md"
    pages = ["README.md"] + [path for top in ("c_api", "fortran", "include", "src", "tests")
                             for path in sorted(map(str, Path(top).rglob("*.md"))) if path != history]
    pages += sorted(map(str, Path("include").glob("*.h")))
    for page in pages:
        text = Path(page).read_text(encoding="utf-8")
        texts = [normal(claim["text"]).replace("<", "").replace(">", "") for claim in known if claim["page"] == page]
        for part in comments(text) if page.endswith(".h") else paragraphs(text):
            wanted = NUMBER if COMMAND.search(part) else MEASURED
            stands = [one for one in texts if one in normal(part)]
            for unit in units(part):
                if wanted.search(NOT_PROSE.sub("", unit)):
                    good = any(one in unit or unit.strip() in one for one in stands)
                    count.judge(good, f"{page}: \"{unit.strip()[:90]}...\"" +
                                ("" if good else " has a number, but neither a claim nor an exemption"))


def outputs(build, command):
    """What a command prints, which is kept in the folder claims of BUILD."""
    folder = Path(build, "claims")
    folder.mkdir(parents=True, exist_ok=True)
    print(f"running: {command}", flush=True)
    run = subprocess.run(["sh", "-c", command], env={**os.environ, "BUILD": str(build)},
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    name = re.sub(r"\W+", "-", command).strip("-")[:80]
    (folder / f"{name}.txt").write_text(run.stdout, encoding="utf-8")
    return run.stdout


def measure(known, build, names, count):
    done = {}
    for claim in known:
        if "exempt" in claim:
            continue
        command = claim["command"]
        if names and not any(name in command for name in names):
            continue
        if command not in done:
            done[command] = outputs(build, command)
        found = re.findall(claim["pattern"], done[command], re.M)
        claimed = number(re.search("<(.*?)>", claim["text"]).group(1))
        what = f"{claim['page']}: {claim['text']}"
        if not found and "skipped" in done[command]:
            count.skipped += 1
            print(f"  skipped: {what}")
        elif not found:
            count.judge(False, f"{command} prints nothing that matches {claim['pattern']}")
        else:
            last = found[-1]
            measured = number(last[0]) / number(last[1]) if isinstance(last, tuple) else number(last)
            slack = float(claim["tolerance"]) / 100 * abs(claimed)
            good = measured >= claimed - slack if claim["worse"] == "below" else \
                measured <= claimed + slack
            count.judge(good, f"{what}: measured {measured:.4g}, tolerance {claim['tolerance']} %")


def main(build, *names):
    known = claims(Path(__file__).with_name("claims.txt"))
    count = Count()
    find_texts(known, count)
    find_numbers(known, count)
    if build != "--pages":
        measure(known, build, names, count)
    if count.skipped:
        print(f"{count.skipped} skipped")
    print(f"{count.passed} passed, {count.failed} failed")
    return count.failed > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
