#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_md_test.py PROGRAM [--renew]: what the pages in docs/manual say is so, and two pages link to what is there.
The gallery has its own script."""
import re

import page


class Contents(page.PageTest):
    NAME, FEWEST = "docs/manual/README.md", 0

    def test_every_page_is_in_the_contents(self):
        for file in self.page.file.parent.glob("*.md"):
            self.assertTrue(file.name == "README.md" or f"({file.name})" in self.page.text, file)


class Tour(page.PageTest):
    NAME, FEWEST = "docs/manual/tour.md", 12


class Questions(page.PageTest):
    NAME, FEWEST = "docs/manual/faq.md", 12


class Controllers(page.PageTest):
    NAME, FEWEST = "docs/manual/control.md", 3

    def test_every_option_is_named(self):
        told = self.shell("./run compare --help")
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet", "--force", "--jobs"}:
            self.assertRegex(self.page.text, f"`[^`]*{option}[ `]")


class Gallery(page.LinkTest):
    NAME = "docs/manual/gallery.md"


class Position(page.LinkTest):
    NAME = "docs/manual/position.md"


class Model(page.LinkTest):
    NAME = "docs/model.md"


class Contributing(page.LinkTest):
    NAME = "docs/contributing.md"


if __name__ == "__main__":
    page.main(Contents, Controllers, Tour, Questions)
