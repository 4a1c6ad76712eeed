#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bode_md_test.py PROGRAM [--renew]: docs/bode.md shows what the program prints."""
import page


class BodePage(page.PageTest):
    NAME, FEWEST = "docs/bode.md", 2


if __name__ == "__main__":
    page.main(BodePage)
