#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""core_tables.py [--check]: writes the tables of docs/reference/core-*.md and block-costs.md from the counts on the cores (data/cores/,
tests/target/digests.txt, both by tools/check_target.sh). With --check it only checks whether the pages contain these tables."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = [ROOT / "docs/reference" / name for name in ("core-costs.md", "block-costs.md", "core-bits.md")]
CORES = ROOT / "data" / "cores"
COMMUTATED = ("duty", "hysteresis", "current", "speed", "position", "product")
DRIVES = (*COMMUTATED, "field")


def rows(file):
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
    return [line.split() for line in lines]


def keyed(file, width):
    return {tuple(row[:width]): row[width:] for row in rows(file)}


def table(head, lines):
    return "\n".join(["| " + " | ".join(line) + " |" for line in (head, ["---"] * len(head), *lines)])


def places(found):
    """Core and arithmetic in the order of the table."""
    return list(dict.fromkeys((key[0], key[2]) for key in found))


def of_entry(entry, cell, drives=DRIVES):
    found = keyed(CORES / "drives.txt", 4)
    lines = []
    for core, scalar in places(found):
        cells = [found.get((core, drive, scalar, entry)) for drive in drives]
        if any(cells):
            lines.append([core, scalar, *(cell(c) if c else "" for c in cells)])
    return table(["core", "arithmetic", *drives], lines)


def blocks():
    found = keyed(CORES / "blocks.txt", 4)
    where = [place for place in places(found) if place[1] != "whole"]
    lines = []
    for block, function in dict.fromkeys((key[1], key[3]) for key in found):
        def worst(core, scalar):
            row = found.get((core, block, scalar, function)) or found.get((core, block, "whole", function))
            return row[3] if row else ""
        lines.append([f"`{block}.hpp`", ", ".join(f"`{name}`" for name in function.split("+")), *(worst(*place) for place in where)])
    return table(["block", "function", *(f"{core} {scalar}" for core, scalar in where)], lines)


def sizes():
    found = keyed(CORES / "sizes.txt", 3)
    lines = [[core, scalar, *(" + ".join(found.get((core, drive, scalar), ())) for drive in DRIVES)] for core, scalar in places(found)]
    return table(["core", "arithmetic", *DRIVES], lines)


def digests():
    found = rows(ROOT / "tests" / "target" / "digests.txt")
    scalars = list(dict.fromkeys(row[1] for row in found))
    counted = [[scalar, str(sum(row[1] == scalar for row in found))] for scalar in scalars]
    return table(["arithmetic", "digests"], counted)


TABLES = {"ticks": lambda: of_entry("tick", lambda c: f"{c[2]} / {c[3]}"), "edges": lambda: of_entry("hall", lambda c: c[3], COMMUTATED),
          "interrupts": lambda: of_entry("tick_interrupt", lambda c: c[3]),
          "edge interrupts": lambda: of_entry("hall_interrupt", lambda c: c[3], COMMUTATED),
          "blocks": blocks, "sizes": sizes, "digests": digests}


def written(text):
    def place(found):
        return f"<!-- table: {found[1]} -->\n{TABLES[found[1]]()}\n<!-- end -->"
    return re.sub(r"<!-- table: ([a-z ]+) -->\n.*?<!-- end -->", place, text, flags=re.S)


def main():
    texts = {page: page.read_text(encoding="utf-8") for page in PAGES}
    missing = [name for name in TABLES if not any(f"<!-- table: {name} -->" in text for text in texts.values())]
    if missing:
        print(f"docs/reference has no place for: {', '.join(missing)}")
        return 1
    stale = [page for page, text in texts.items() if written(text) != text]
    if "--check" not in sys.argv:
        for page in stale:
            page.write_text(written(texts[page]), encoding="utf-8")
    elif stale:
        print(f"{', '.join(page.name for page in stale)}: tables differ from the counts; write them with tools/core_tables.py")
    return 1 if stale and "--check" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
