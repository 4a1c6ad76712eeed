#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pages_test.py PROGRAM [--renew] [PAGE...]: the pages agree with the program, and each page has the form that the
style section of docs/contributing.md requires. Without PAGE it tests all pages. --renew writes the console and output
blocks again."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

import page
from page import REPOSITORY

NAMES = ["README.md", *sorted(str(f.relative_to(REPOSITORY)) for f in (REPOSITORY / "docs").rglob("*.md"))]
GENERATED = ("docs/gallery/", "docs/reference/keys/")  # tools/gallery.py and tools/scenario_reference.py write and check these pages
PROGRAM = REPOSITORY / "build/dev/sixstep"
WARNINGS = ["-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wno-sign-conversion", "-Wdouble-promotion", "-Werror"]
ALONE = {"chip": ["-ffreestanding", "-fno-exceptions", "-fno-rtti"], "host": []}


def links(text):
    return re.findall(r"\]\(([^)#:]*)(?:#([^)]+))?\)", text)


def each_page(judge):
    def test(self):
        for name in self.names:
            with self.subTest(name):
                judge(self, page.Page(name))
    return test


class Pages(unittest.TestCase):
    maxDiff = None
    names = NAMES

    @each_page
    def test_what_is_linked_named_or_pictured_is_there(self, it):
        named = re.findall(r"`((?:tools|tests|data|docs|sixstep)/[\w./-]+)`", it.prose)
        for path in [it.file.parent / path for path, _ in links(it.prose) if path] + [REPOSITORY / n for n in named]:
            self.assertTrue(path.exists(), path)
        for words, picture in re.findall(r"!\[(.*?)\]\((.*?)\)", it.prose, re.S):
            self.assertGreater(len(words), 10, f"{picture}: somebody who does not see it wants to know what it shows")
            self.assertLess((it.file.parent / picture).stat().st_size, 100_000)

    @each_page
    def test_every_anchor_is_a_heading(self, it):
        for path, anchor in links(it.prose):
            if anchor:
                self.assertIn(anchor, page.anchors(it.file.parent / path if path else it.file), path)

    @each_page
    def test_a_page_is_short_asks_its_question_and_says_where_to_go_next(self, it):
        self.assertLessEqual(it.text.count("\n"), 250, "split the page")
        asks = re.match(r"# [^\n]+\n\n(?:(?!\n\n).)*\?", it.text, re.S) or it.name == "README.md"
        self.assertTrue(asks, "the first paragraph asks the question that the page answers")
        self.assertRegex(it.text[-1000:], r"\nNext: .*(?:\n.+)*\n\Z", "the last line names the next pages")

    @each_page
    def test_every_block_does_what_it_says(self, it):
        if not it.name.startswith(GENERATED):
            self.walk(it)

    def walk(self, it):
        desk = page.Desk(PROGRAM)
        try:
            for block, now in page.walk(it, desk):
                with self.subTest(f"{it.name}:{block.line}"):
                    self.check(it, desk, block, now)
            for kind in ALONE:
                self.compile(it, desk, kind)
        finally:
            desk.close()

    def check(self, it, desk, block, now):
        if block.word in ("output", "console"):
            self.assertEqual(block.text, now, f"renew with: {sys.argv[0]} PROGRAM --renew {it.name}")
        elif block.word == "excerpt":
            command, _, code = block.detail.removeprefix("of ").partition("; exit=")
            output = desk.shell(command, int(code or 0))
            self.assertIsNone(page.first_missing(block.text.splitlines(), output.splitlines()))
        elif block.word == "file":
            licence, _, content = (REPOSITORY / block.detail).read_text(encoding="utf-8").partition("\n")
            self.assertIn("SPDX", licence)
            self.assertEqual(block.text, content)
            if block.detail.endswith(".toml"):
                desk.shell(f"./run run {block.detail} --quiet")
        elif block.word == "programs":
            for command in block.text.splitlines():
                self.assertTrue(os.access(REPOSITORY / command.split()[0], os.X_OK), command)
        elif block.word == "by":
            self.assertTrue((REPOSITORY / block.detail).is_file(), block.detail)
        else:
            self.assertIn(block.word, ("run", "c", "write", "measured", "shown", "python", *ALONE), "the block does not say how it is tested")

    def compile(self, it, desk, kind):
        source = "\n".join(it.texts(kind))
        if source:
            (desk.folder / "snippet.cpp").write_text(source, encoding="utf-8")
            done = subprocess.run([os.environ.get("CXX", "c++"), *WARNINGS, *ALONE[kind], f"-I{REPOSITORY}", "-I.", "-c", "-O1", "-o", os.devnull,
                                   "snippet.cpp"], cwd=desk.folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{it.name}, {kind}: {done.stderr}")


def renew(name):
    it, desk, text, at = page.Page(name), page.Desk(PROGRAM), [], 0
    try:
        for block, now in page.walk(it, desk):
            if now is not None:
                text += [it.text[at:block.span[0]], now]
                at = block.span[1]
    except AssertionError as failure:  # for example if a program is not built
        print(f"{name}: the rest is left as it is, after {failure}", file=sys.stderr)
    it.file.write_text("".join(text) + it.text[at:], encoding="utf-8")
    desk.close()


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if not word.startswith("-")]
    PROGRAM = pathlib.Path(os.path.abspath(words[0])) if words else PROGRAM
    Pages.names = words[1:] or NAMES
    if "--renew" in sys.argv:
        for name in Pages.names:
            if not name.startswith(GENERATED):
                renew(name)
    else:
        unittest.main(argv=sys.argv[:1])
