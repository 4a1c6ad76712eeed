#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""motors_md_test.py PROGRAM [--renew]: what docs/motors.md shows is what the program says."""
import page


class MotorsPage(page.PageTest):
    NAME, FEWEST = "docs/motors.md", 6


if __name__ == "__main__":
    page.main(MotorsPage)
