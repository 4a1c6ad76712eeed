#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""curve_md_test.py PROGRAM [--renew]: docs/curve.md shows what the program prints."""
import re

import page


class CurvePage(page.PageTest):
    NAME, FEWEST = "docs/curve.md", 4

    def test_every_option_is_named(self):
        told = self.shell("./run curve --help")
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet"}:
            self.assertRegex(self.page.text, f"`{option}[ `]")


if __name__ == "__main__":
    page.main(CurvePage)
