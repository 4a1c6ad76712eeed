#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each name in tests/slow.txt is a test of this build. Otherwise a renamed test would run in ./test again, and no one
would notice."""
import pathlib
import re
import subprocess
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop(1))
ROOT = pathlib.Path(__file__).resolve().parents[2]


class SlowTests(unittest.TestCase):
    def test_each_is_there_and_stands_once(self):
        lines = [line for line in (ROOT / "tests/slow.txt").read_text().splitlines() if not line.startswith("#")]
        names = [re.fullmatch(r" *\d+  (.+)", line).group(1) for line in lines]
        self.assertGreater(len(names), 10)
        self.assertEqual(len(set(names)), len(names))
        listed = subprocess.run(["ctest", "--test-dir", BUILD, "-N"], check=True, text=True, stdout=subprocess.PIPE).stdout
        there = set(re.findall(r"Test +#\d+: (.+)", listed))
        self.assertGreater(len(there), 1000)
        # without a browser, the tests that need it are not registered
        self.assertEqual([name for name in names if name not in there and not name.startswith("browser.")], [])


if __name__ == "__main__":
    unittest.main()
