#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""citations_test.py: everything that a comment cites is in the repository.

`model.md 4b` cites a section of docs/reference/model.md or of the pages beside it (model-*.md). `model.md (5)` cites
an equation there. `pitfall 4` cites a row of the table in docs/architecture.md. Any other NAME.md is a page of the
repository."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUFFIXES = {".hpp", ".cpp", ".h", ".py", ".sh", ".cmake", ".js", ".mjs"}
ROOMS = ("sixstep", "batch", "io", "text", "files", "report", "faces", "tests", "benchmarks", "tools")
SOURCES = sorted(f for room in ROOMS for f in (ROOT / room).glob("**/*") if f.suffix in SUFFIXES and f.resolve() != pathlib.Path(__file__).resolve())
MODEL = "\n".join(f.read_text(encoding="utf-8") for f in sorted((ROOT / "docs/reference").glob("model*.md")))
PLACES = set(re.findall(r"(?m)^## (\d+b?) ", MODEL)) | set(re.findall(r"(?m)^    .* (\(\d+\))$", MODEL))
PITFALLS = set(re.findall(r"(?m)^\| (\d+) \|", (ROOT / "docs/architecture.md").read_text(encoding="utf-8")))
PAGES = {file.name for file in [*ROOT.glob("*.md"), *(ROOT / "docs").glob("**/*.md"), *(ROOT / "faces").glob("**/*.md")]}
PLACE = r"(?:\(\d+\)|\d+b?\b)"


def flowing(text):
    """The text with each comment of several lines joined into one line."""
    return re.sub(r"\n\s*(?://+|#)\s*", " ", text)


def unresolved(text):
    text = flowing(text)
    cited = [place for group in re.findall(rf"model\.md ({PLACE}(?:(?:, | and ){PLACE})*)", text) for place in re.findall(PLACE, group)]
    missing = [f"model.md {place}" for place in cited if place not in PLACES]
    missing += [f"pitfall {n}" for n in re.findall(r"\bpitfall (\d+)", text) if n not in PITFALLS]
    missing += [name for name in re.findall(r"\b([A-Za-z][\w-]*\.md)\b", text) if name not in PAGES]
    return missing + re.findall(r"\b(?:MODEL2? \d\w*|THESIS\b|ENGINE, pitfall|DESIGN (?=\"))", text), len(cited)


class Citations(unittest.TestCase):
    def test_each_resolves(self):
        found = 0
        for file in SOURCES:
            missing, cited = unresolved(file.read_text(encoding="utf-8"))
            self.assertEqual(missing, [], file.relative_to(ROOT))
            found += cited
        self.assertGreater(found, 80)

    def test_the_check_can_fail(self):
        text = "/// As there (model.md 3, 4b and (99)); see DESIGN.md (model.md\n/// 77).  // pitfall 99\n# MODEL 4b"
        self.assertEqual(unresolved(text)[0], ["model.md (99)", "model.md 77", "pitfall 99", "DESIGN.md", "MODEL 4b"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
