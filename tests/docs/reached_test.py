#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""reached_test.py: links lead from README.md to every page."""
import re
import unittest

from page import REPOSITORY, Page


class Reached(unittest.TestCase):
    def test_every_page_is_reached_from_the_readme(self):
        reached, left = set(), [REPOSITORY / "README.md"]
        while left:
            file = left.pop().resolve()
            if file not in reached and file.exists():
                reached.add(file)
                left += [file.parent / path for path in re.findall(r"\]\(([^)#:]+\.md)", Page(file).prose)]
        self.assertEqual([], sorted(str(f) for f in (REPOSITORY / "docs").rglob("*.md") if f.resolve() not in reached))


if __name__ == "__main__":
    unittest.main()
