#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""readme_md_test.py PROGRAM [--renew]: what README.md says is so."""
import page


class Readme(page.PageTest):
    NAME, FEWEST = "README.md", 5

    def test_two_runs_give_the_same_bits(self):
        scenario = "data/scenarios/thesis/7.4-speed-thesis-gains.toml"
        for name in ("one", "two"):
            self.shell(f"./run run {scenario} --csv {name}.csv --quiet")
        # The comment names the command, and with it the file; all that follows is the same.
        one, two = ((self.desk.folder / f"{name}.csv").read_text().splitlines()[3:] for name in ("one", "two"))
        self.assertEqual(one, two)


if __name__ == "__main__":
    page.main(Readme)
