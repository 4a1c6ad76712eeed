#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/reference/glossary.md is a table. No page and no text of the program uses the words
that the last column excludes."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GLOSSARY = ROOT / "docs/reference/glossary.md"
READ = ("README.md", "docs/**/*.md", "faces/cli/*.cpp", "text/**/*.cpp", "report/*.cpp", "report/web/*", "sixstep/study/**/*.[ch]pp",
        "sixstep/design/**/*.[ch]pp", "sixstep/analysis/**/*.[ch]pp", "sixstep/plant/**/*.[ch]pp", "sixstep/rig/**/*.[ch]pp")


def rows():
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in GLOSSARY.read_text().splitlines()
            if line.startswith("| ") and not line.startswith("| term ")]


def excluded():
    return [word.strip() for row in rows() for word in row[3].split(",") if word.strip()]


class Glossary(unittest.TestCase):
    def test_is_a_short_sorted_table(self):
        terms = [row[0].lower() for row in rows()]
        self.assertLessEqual(len(terms), 80)
        self.assertEqual(terms, sorted(set(terms)))
        for row in rows():
            self.assertEqual(len(row), 4, row)
            self.assertTrue(row[1], row)

    def test_excluded_words_are_not_used(self):
        self.assertGreater(len(excluded()), 8)
        word = re.compile(r"\b(" + "|".join(map(re.escape, excluded())) + r")s?\b", re.I)
        found = [f"{path.relative_to(ROOT)}:{n}: {m[0]}" for pattern in READ for path in sorted(ROOT.glob(pattern)) if path != GLOSSARY
                 for n, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) for m in word.finditer(line)]
        self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main()
