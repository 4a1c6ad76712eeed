# SPDX-License-Identifier: Apache-2.0
"""Reads all pages: the content of README.md and docs/ must agree with the program.

A comment above each fenced block says how the block is tested. A block without a comment fails:
  <!-- test: console [exit=N] -->   each line after "$ " is run; the lines below are exactly its output
  <!-- test: run [exit=N] -->       is run, with ./run as the program
  <!-- test: output -->             is exactly the output of the block before it
  <!-- test: excerpt of COMMAND[; exit=N] -->   its lines are lines of the command's output; a line "..." replaces omitted lines
  <!-- test: write NAME -->         is written into the folder in which the page's commands run
  <!-- test: file PATH -->          is this file without its licence line; a scenario must pass
  <!-- test: chip --> or host       C++: the blocks of a page compile together, for a chip without a C library or for the host
  <!-- test: c -->              C statements with an open session `drive` of current-square.toml; compiled as C99 and run
  <!-- test: python -->             Python: the blocks of the page run from top to bottom (tests/python/page_test.py)
  <!-- test: programs -->           each line begins with a program of the repository, which exists and is executable
  <!-- test: measured -->           differs from machine to machine: not compared
pages_test.py runs them."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import typing

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- test: (?P<test>.*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
COMMAND = re.compile(r"^\$ (.*)\n", re.M)


class Block(typing.NamedTuple):
    line: int
    word: str    # the kind of the test
    detail: str  # the text after this word
    text: str
    span: tuple  # the position in the page's text


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


C_PROGRAM = """
#include <sixstep.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  sixstep_session* drive;
  if (sixstep_open_file("data/scenarios/current-square.toml", NULL, &drive) != SIXSTEP_OK) return 2;
  {
%s
  }
  sixstep_free(drive);
  return 0;
}
"""


class Desk:
    """A temporary copy of the folder that a reader uses, with the built program as ./run and sixstep."""

    def __init__(self, program):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        for name in ("data", "tools"):
            shutil.copytree(REPOSITORY / name, self.folder / name)
        for name in ("build/release", "bin"):
            (self.folder / name).mkdir(parents=True)
        for name in ("build/release/sixstep", "bin/sixstep", "run"):  # the real ./run would first install packages and build
            (self.folder / name).symlink_to(program)
        (self.folder / "build/dev").symlink_to(program.parent)
        for name in ("tests", "sixstep", "faces"):
            (self.folder / name).symlink_to(REPOSITORY / name)
        # the same files as an installed libsixstep
        library = program.parent / "lib"
        (self.folder / "sixstep.pc").write_text(f"Name: sixstep\nVersion: 0\nDescription: of the build\nLibs: -L{library} -lsixstep\n"
                                                f"Cflags: -I{REPOSITORY / 'faces/c'} -I{REPOSITORY}\n", encoding="utf-8")
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "PKG_CONFIG_PATH": str(self.folder),
                            "LD_LIBRARY_PATH": str(library)}

    def close(self):
        self._folder.cleanup()

    def shell(self, command, code=0):
        done = subprocess.run(["bash", "-euc", command], cwd=self.folder, env=self.environment, timeout=120, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        assert done.returncode == code, f"{command}: exit code {done.returncode}\n{done.stdout}"
        return done.stdout

    def c(self, statements):
        """The output of the statements, compiled with the library."""
        (self.folder / "block.c").write_text(C_PROGRAM % statements, encoding="utf-8")
        return self.shell("cc -std=c99 -Wall -Wextra -Werror block.c $(pkg-config --cflags --libs sixstep) -o block && ./block")

    def console(self, text, detail):
        """The console block with the present output of its commands."""
        code = int(detail.removeprefix("exit=") or 0)
        return "".join(f"$ {command}\n{self.shell(command, code)}" for command in COMMAND.findall(text))


def first_missing(quoted, printed):
    """The first quoted line that is not at its place, or None. Lines between two "..." must follow each other
    directly."""
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
    """Executes a page block by block. Yields each block and, if the block shows output, its present output."""
    printed = None
    for block in page.blocks:
        now = None
        if block.word == "run":
            printed = None
            printed = desk.shell(block.text, int(block.detail.removeprefix("exit=") or 0))
        elif block.word == "c":
            printed = None
            printed = desk.c(block.text)
        elif block.word == "output":
            now = printed
        elif block.word == "console":
            now = desk.console(block.text, block.detail)
        elif block.word == "write":
            (desk.folder / block.detail).write_text(block.text, encoding="utf-8")
        yield block, now


def anchors(file):
    """The targets of links on a page: its headings, and its older names in <a id="...">."""
    text = BLOCK.sub("", file.read_text(encoding="utf-8"))
    headings = [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in re.findall(r"^#+ (.*)", text, re.M)]
    return headings + re.findall(r'^<a id="([\w-]+)"></a>$', text, re.M)
