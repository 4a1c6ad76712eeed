#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""design_md_test.py PROGRAM [--renew]: what docs/design.md quotes is what the program prints."""
import re

import page


class DesignPage(page.PageTest):
    NAME, FEWEST = "docs/design.md", 9

    def test_every_option_it_names_exists(self):
        help_text = self.shell("./run design --help")
        for option in set(re.findall(r"--[a-z][a-z-]+", self.page.text)):
            self.assertIn(option + " ", help_text)


if __name__ == "__main__":
    page.main(DesignPage)
