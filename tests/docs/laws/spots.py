# SPDX-License-Identifier: Apache-2.0
"""Finds the numbers that the pages print, in fenced blocks and tables. Each spot has its page, line, heading and the
words before it."""
import re
import typing

from page import BLOCK, REPOSITORY

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TABLE = re.compile(r"^\|.*\|\n\|[-|: ]+\|\n((?:\|.*\n)+)", re.M)
FEWEST = 2  # a block with this number of values needs a law


class Spot(typing.NamedTuple):
    page: str
    line: int
    heading: str
    kind: str     # the kind of test of the block, or "table"
    detail: str   # the details of the block's test
    text: str
    before: str   # the paragraph before it

    def __str__(self):
        return f"{self.page}:{self.line}"

    def rows(self):
        """The cells of each row of a table, without the heading."""
        lines = self.text.splitlines()
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]

    def head(self):
        return [cell.strip() for cell in self.text.splitlines()[0].strip("|").split("|")]


def spots_of(name):
    text = (REPOSITORY / name).read_text(encoding="utf-8")
    blocks = list(BLOCK.finditer(text))
    found = []
    for m in blocks:
        word, _, detail = (m["test"] or "").partition(" ")
        found.append((m.start(), word, detail, m["text"]))
    for m in TABLE.finditer(text):
        if not any(b.start() < m.start() < b.end() for b in blocks):
            found.append((m.start(), "table", "", m.group(0)))
    headings = [(m.start(), m.group(1)) for m in re.finditer(r"^#+ (.*)$", BLOCK.sub(lambda m: " " * len(m.group(0)), text), re.M)]
    for at, kind, detail, content in sorted(found):
        heading = [words for where, words in headings if where < at]
        before = text[:at].rstrip().removesuffix("-->").rsplit("\n\n", 2)
        yield Spot(name, text[:at].count("\n") + 1, heading[-1] if heading else "", kind, detail, content, "\n\n".join(before[-2:]))


def pages():
    return ["README.md"] + sorted(str(f.relative_to(REPOSITORY)) for f in (REPOSITORY / "docs").rglob("*.md"))


def all_spots():
    for name in pages():
        yield from spots_of(name)


def is_worth_judging(spot):
    return len(NUMBER.findall(spot.text)) >= FEWEST
