#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""many_runs_md_test.py PROGRAM [--renew]: docs/many-runs.md shows what the program prints, and names every key of a plan."""
import json

import page


class ManyRunsPage(page.PageTest):
    NAME, FEWEST = "docs/many-runs.md", 5

    def test_every_key_of_a_plan_is_named(self):
        keys = json.loads(self.shell("./run schema plan"))["properties"]
        for key in set(keys) - {"title", "notes"}:
            self.assertRegex(self.page.text, rf"`\[?\[?{key}\]?\]?`")


if __name__ == "__main__":
    page.main(ManyRunsPage)
