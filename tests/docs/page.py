# SPDX-License-Identifier: Apache-2.0
"""One reader for all pages: what README.md and docs/ show is what the program does.

A comment above each fenced block says how it is tested; a block without one fails:
  <!-- test: console [exit=N] -->   each line after "$ " is run; below it stands exactly what it prints
  <!-- test: run [exit=N] -->       is run, with ./run as the program
  <!-- test: output -->             is exactly what the block before it printed
  <!-- test: excerpt of COMMAND[; exit=N] -->   its lines stand so in the command's output; a line "..." leaves lines out
  <!-- test: write NAME -->         is written into the folder in which the page's commands run
  <!-- test: file PATH -->          is that file without its licence line, and the scenario passes
  <!-- test: programs -->           each line begins with a program of the repository: it exists, may be executed
  <!-- test: measured -->           differs from machine to machine: not compared
A page's test ends with page.main(); with --renew it writes the page's console and output blocks anew instead.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import typing
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- test: (?P<test>.*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
COMMAND = re.compile(r"^\$ (.*)\n", re.M)


class Block(typing.NamedTuple):
    line: int
    word: str    # how it is tested
    detail: str  # what follows the word
    text: str
    span: tuple  # of the text, within the page


class Page:
    def __init__(self, name):
        self.name, self.file = name, REPOSITORY / name
        self.text = self.file.read_text(encoding="utf-8")
        self.blocks = []
        for m in BLOCK.finditer(self.text):
            word, _, detail = (m["test"] or "").partition(" ")
            self.blocks.append(Block(self.text[:m.start()].count("\n") + 1, word, detail, m["text"], m.span("text")))
        self.prose = BLOCK.sub("", self.text)
        assert "```" not in self.prose, f"{name}: a fenced block is not closed"

    def texts(self, word):
        return [block.text for block in self.blocks if block.word == word]


class Desk:
    """A scratch copy of what a reader has in front of him, with the built program as ./run and sixstep."""

    def __init__(self, program):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        for name in ("data", "tools"):
            shutil.copytree(REPOSITORY / name, self.folder / name)
        for name in ("build/release", "bin"):
            (self.folder / name).mkdir(parents=True)
        for name in ("build/release/sixstep", "bin/sixstep", "run"):  # the real ./run installs and builds first
            (self.folder / name).symlink_to(program)
        (self.folder / "build/dev").symlink_to(program.parent)
        (self.folder / "tests").symlink_to(REPOSITORY / "tests")
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}

    def close(self):
        self._folder.cleanup()

    def shell(self, command, code=0):
        done = subprocess.run(["bash", "-euc", command], cwd=self.folder, env=self.environment, timeout=120, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        assert done.returncode == code, f"{command}: exit code {done.returncode}\n{done.stdout}"
        return done.stdout

    def console(self, text, detail):
        """The console block with what its commands print now."""
        code = int(detail.removeprefix("exit=") or 0)
        return "".join(f"$ {command}\n{self.shell(command, code)}" for command in COMMAND.findall(text))


def first_missing(quoted, printed):
    """The first quoted line that does not stand in its place, or None. Between two "..." lines follow each other."""
    at, anywhere = 0, False
    for line in quoted:
        if line == "...":
            anywhere = True
            continue
        hit = next((n for n in range(at, len(printed)) if printed[n] == line), None) if anywhere else at
        if hit is None or hit >= len(printed) or printed[hit] != line:
            return line
        at, anywhere = hit + 1, False
    return None


def walk(page, desk):
    """Does what the page says, block by block: yields each block, and for one that shows output what that is now."""
    printed = None
    for block in page.blocks:
        now = None
        if block.word == "run":
            printed = None
            printed = desk.shell(block.text, int(block.detail.removeprefix("exit=") or 0))
        elif block.word == "output":
            now = printed
        elif block.word == "console":
            now = desk.console(block.text, block.detail)
        elif block.word == "write":
            (desk.folder / block.detail).write_text(block.text, encoding="utf-8")
        yield block, now


def anchors(file):
    """The headings of a page, as links name them, and what it keeps by <a id="..."> of older ones."""
    text = BLOCK.sub("", file.read_text(encoding="utf-8"))
    headings = [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in re.findall(r"^#+ (.*)", text, re.M)]
    return headings + re.findall(r'^<a id="([\w-]+)"></a>$', text, re.M)


class LinkTest(unittest.TestCase):
    NAME = None  # of the page, from the repository's root
    PROGRAM = REPOSITORY / "build/dev/sixstep"
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        if cls.NAME is None:
            raise unittest.SkipTest("no page")
        cls.page = Page(cls.NAME)

    def test_what_is_linked_named_or_pictured_is_there(self):
        links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", self.page.prose)
        named = re.findall(r"`((?:tools|tests|data|docs|sixstep)/[\w./-]+)`", self.page.prose)
        for path in [self.page.file.parent / link for link in links if "://" not in link] + [REPOSITORY / n for n in named]:
            self.assertTrue(path.exists(), path)
        for words, picture in re.findall(r"!\[(.*?)\]\((.*?)\)", self.page.prose, re.S):
            self.assertGreater(len(words), 10, f"{picture}: somebody who does not see it wants to know what it shows")
            self.assertLess((self.page.file.parent / picture).stat().st_size, 100_000)

    def test_every_anchor_is_a_heading(self):
        for path, anchor in re.findall(r"\]\(([^)#:]*)#([^)]+)\)", self.page.prose):
            self.assertIn(anchor, anchors(self.page.file.parent / path if path else self.page.file), path)


class PageTest(LinkTest):
    FEWEST = 1  # blocks

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.desk = Desk(cls.PROGRAM)
        cls.addClassCleanup(cls.desk.close)

    def shell(self, command, code=0):
        return self.desk.shell(command, code)

    def test_every_block_does_what_it_says(self):
        self.assertGreaterEqual(len(self.page.blocks), self.FEWEST)
        for block, now in walk(self.page, self.desk):
            with self.subTest(f"{self.NAME}:{block.line}"):
                self.check(block, now)

    def check(self, block, now):
        if block.word in ("output", "console"):
            self.assertEqual(block.text, now, f"renew with: {sys.argv[0]} PROGRAM --renew")
        elif block.word == "excerpt":
            command, _, code = block.detail.removeprefix("of ").partition("; exit=")
            output = self.shell(command, int(code or 0))
            self.assertIsNone(first_missing(block.text.splitlines(), output.splitlines()))
        elif block.word == "file":
            licence, _, content = (REPOSITORY / block.detail).read_text(encoding="utf-8").partition("\n")
            self.assertIn("SPDX", licence)
            self.assertEqual(block.text, content)
            self.shell(f"./run run {block.detail} --quiet")
        elif block.word == "programs":
            for command in block.text.splitlines():
                self.assertTrue(os.access(REPOSITORY / command.split()[0], os.X_OK), command)
        else:
            self.assertIn(block.word, ("run", "write", "measured"), "the block does not say how it is tested")


def renew(name, program):
    page, desk, text, at = Page(name), Desk(program), [], 0
    try:
        for block, now in walk(page, desk):
            if now is not None:
                text += [page.text[at:block.span[0]], now]
                at = block.span[1]
    except AssertionError as failure:  # as where a program is not built
        print(f"{name}: the rest is left as it is, after {failure}", file=sys.stderr)
    page.file.write_text("".join(text) + page.text[at:], encoding="utf-8")
    desk.close()


def main(*tests):
    """The arguments of the test of one or more pages: PROGRAM [--renew]."""
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        LinkTest.PROGRAM = pathlib.Path(os.path.abspath(sys.argv.pop(1)))
    if "--renew" in sys.argv:
        for test in tests:
            renew(test.NAME, test.PROGRAM)
    else:
        unittest.main(module="__main__")
