#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""commissioning_md_test.py PROGRAM: docs/commissioning.md shows what the tests on the virtual board print."""
import re

import page


class CommissioningPage(page.PageTest):
    NAME, FEWEST = "docs/commissioning.md", 5

    def test_every_option_is_named(self):
        told = self.shell("./run motor commission --help")
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet", "--json", "--force"}:
            self.assertIn(f"`{option}", self.page.text)

    def test_every_phase_is_in_the_table(self):
        header = (page.REPOSITORY / "sixstep/control/commissioning/commissioning_phases.hpp").read_text(encoding="utf-8")
        phases = re.search(r"enum class CommissioningPhase.*?\{(.*?)\}", header, re.S)[1]
        for phase in set(re.findall(r"\w+", phases)) - {"done", "failed"}:
            self.assertRegex(self.page.prose, rf"(?m)^\|[^|]*\b{phase}\b")


if __name__ == "__main__":
    page.main(CommissioningPage)
