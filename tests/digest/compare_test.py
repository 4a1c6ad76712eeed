#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The message of a failed comparison names the case and the first difference."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPARE = pathlib.Path(__file__).with_name("compare.py")
TABLE = "# a comment\none 11 22 3\ntwo 44 55 6\n"


class Compare(unittest.TestCase):
    def compared(self, expected, printed):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, name) for name in ("expected", "printed")]
            for path, text in zip(paths, (expected, printed)):
                path.write_text(text)
            done = subprocess.run([sys.executable, COMPARE, *paths], stdout=subprocess.PIPE, text=True, check=False)
        return done.returncode, done.stdout

    def test_the_same_passes(self):
        self.assertEqual(self.compared(TABLE, TABLE), (0, "2 of 2 cases have the same bits\n"))

    def test_names_the_case_and_what_differs(self):
        for printed, words in ((TABLE.replace("44", "45"), "two: trajectory 44 -> 45"),
                               (TABLE.replace("55", "56"), "two: figures 55 -> 56"),
                               (TABLE.replace("44 55 6", "45 55 7"), "two: trajectory 44 -> 45, segments 6 -> 7"),
                               (TABLE.replace("two 44 55 6\n", ""), "two: was not printed"),
                               (TABLE + "three 7 8 9\n", "three: is not in the table"),
                               (TABLE.replace("55 6", "55 6 fault"), "two: 44 55 6 -> 44 55 6 fault")):
            code, text = self.compared(TABLE, printed)
            self.assertEqual(code, 1)
            self.assertIn(f"  {words}\n", text)
            self.assertNotIn("  one:", text)

    def test_nothing_printed_is_no_agreement(self):
        self.assertEqual(self.compared("", "")[0], 1)


if __name__ == "__main__":
    unittest.main()
