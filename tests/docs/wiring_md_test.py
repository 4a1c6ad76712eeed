#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wiring_md_test.py PROGRAM [--renew]: docs/wiring.md shows what the program prints, and its picture is what the program draws."""
import re

import page


class WiringPage(page.PageTest):
    NAME, FEWEST = "docs/wiring.md", 2

    def test_every_option_is_named(self):
        told = self.shell("./run motor wiring --help")
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet"}:
            self.assertRegex(self.page.text, f"`{option}[ `]")

    def test_the_picture_is_what_the_program_draws(self):
        self.shell("./run motor wiring maxon-251601 --svg now.svg --quiet")
        kept = (page.REPOSITORY / "docs/images/wiring.svg").read_bytes()
        self.assertEqual(kept, (self.desk.folder / "now.svg").read_bytes(), "renew with tools/renew_docs.sh")

    def test_each_word_of_the_table_is_explained(self):
        printed = self.page.texts("output")[0]
        for word in ("FORWARD", "BACKWARD", "early", "late", "hums"):
            self.assertIn(word, printed)
            self.assertRegex(self.page.prose, rf"(?m)^\|.*\b{word}\b.*\|.*\|.*\|$")


if __name__ == "__main__":
    page.main(WiringPage)
