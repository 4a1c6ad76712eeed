#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each pitfall of docs/architecture.md has tests with its name, in exactly those files that its row lists."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROW = re.compile(r"^\| (\d+) \|[^|]*\|([^|]*)\|$", re.M)
TEST = re.compile(r"(?:TEST(?:_F|_P)?\(|no_libm_test\([\w.]*?)Pitfall(\d\d)_")


class Pitfalls(unittest.TestCase):
    def test_the_table_names_the_files_that_have_them(self):
        section = (ROOT / "docs/architecture.md").read_text(encoding="utf-8").partition("\n## Which pitfalls should you know?\n")[2]
        named = {int(number): set(re.findall("`([^`]+)`", files)) for number, files in ROW.findall(section)}
        self.assertEqual(sorted(named), list(range(1, 14)))
        found = {number: set() for number in named}
        for file in [*(ROOT / "tests").rglob("*_test.cpp"), ROOT / "tests/CMakeLists.txt"]:
            for number in TEST.findall(file.read_text(encoding="utf-8")):
                found[int(number)].add(file.relative_to(ROOT).as_posix())
        self.assertEqual(found, named)

    def test_each_pair_of_coincident_things_has_its_test(self):
        things = ["Step", "Tick", "PwmEdge", "Comparator", "SectorEdge", "CurrentZero"]
        text = "".join((ROOT / "tests/rig" / name).read_text(encoding="utf-8")
                       for name in ("coincidence_test.cpp", "coincident_events_test.cpp"))
        for n, first in enumerate(things):
            for second in things[n + 1:]:
                self.assertRegex(text, rf"TEST\(Pitfall01_\w+, {first}And{second}")


if __name__ == "__main__":
    unittest.main()
