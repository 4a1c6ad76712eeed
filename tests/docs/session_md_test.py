#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""session_md_test.py EXAMPLE [--renew]: the program in docs/session.md is the one that is built, and prints what stands below it."""
import pathlib
import subprocess
import sys
import unittest

from page import REPOSITORY, Page

PAGE = Page("docs/session.md")


def now(example):
    source = (REPOSITORY / "tests/docs/session_example.cpp").read_text(encoding="utf-8").partition("\n")[2]
    return {"example": source, "printed": subprocess.run([example], capture_output=True, text=True, check=True).stdout}


class SessionPage(unittest.TestCase):
    def test_the_example_is_built_and_prints_what_is_shown(self):
        self.assertEqual([b.word for b in PAGE.blocks], ["example", "printed"])
        for block in PAGE.blocks:
            self.assertEqual(block.text, now(EXAMPLE)[block.word], f"renew with: {sys.argv[0]} EXAMPLE --renew")


if __name__ == "__main__":
    EXAMPLE = pathlib.Path(sys.argv.pop(1)).resolve()
    if "--renew" in sys.argv:
        text, fresh = PAGE.text, now(EXAMPLE)
        for block in reversed(PAGE.blocks):
            text = text[:block.span[0]] + fresh[block.word] + text[block.span[1]:]
        PAGE.file.write_text(text, encoding="utf-8")
    else:
        unittest.main()
