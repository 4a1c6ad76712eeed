#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""names_test.py PROGRAM: all names in prose, messages and comments of examples exist.

- Every key path (`pwm.period_s`) in Markdown code and in the string literals of the sources is a key of the schema.
- Every option that a page or a message shows after `sixstep VERB` is an option of this verb."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else str(ROOT / "build/dev/sixstep")
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").glob("**/*.md")])
SOURCES = sorted(file for room in ("sixstep", "text", "files", "report", "faces/cli") for file in (ROOT / room).glob("**/*.[ch]pp"))
FILE_NAMES = r"(?!\w*(?:hpp|cpp|md|h|toml|csv|json|html|py)\b)"


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def paths_of(schema, prefix=""):
    for key, inner in schema.get("properties", {}).items():
        yield prefix + key
        yield from paths_of(inner.get("items", inner), f"{prefix}{key}.")


def code_in(page):
    """The fenced blocks and the `code` of a page, without the blocks that show mistakes."""
    text = re.sub(r"(?ms)^<!-- test: [^\n]*exit=2[^\n]*\n```.*?^```$", "", page.read_text(encoding="utf-8"))
    blocks = re.findall(r"(?ms)^```\w*\n(.*?)^```$", text)
    return blocks + re.findall(r"`([^`\n]+)`", re.sub(r"(?ms)^```.*?^```$", "", text))


def strings_in(source):
    """All string literals. Literals that are separated only by the end of a line count as one."""
    text = re.sub(r"(?m)^\s*//.*$|^#include.*$", "", source.read_text(encoding="utf-8"))
    return [re.sub(r"\"\s*\n\s*\"", "", literal).replace('\\"', '"')
            for literal in re.findall(r"\"((?:[^\"\\\n]|\\.)*(?:\"\s*\n\s*\"(?:[^\"\\\n]|\\.)*)*)\"", text)]


class Names(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = json.loads(said("schema"))
        cls.keys = set(paths_of(cls.scenario))
        cls.tables = [key for key, schema in cls.scenario["properties"].items() if schema.get("type") in ("object", "array")]

    def named_keys(self, text):
        text = re.sub(r"(?m)^.*(?:is not a key|lacks its unit).*$", "", text)  # quoted messages
        found = re.findall(rf"(?<![\w./-])((?:{'|'.join(self.tables)})(?:\[\d*\])?(?:\.{FILE_NAMES}[A-Za-z_]\w*)+)", text)
        return [re.sub(r"\[\d*\]", "", key).rstrip("_") for key in found]

    def unknown_keys(self, text):
        return [key for key in self.named_keys(text) if key not in self.keys]

    def test_keys_exist(self):
        checked = 0
        for file, texts in [(page, code_in(page)) for page in PAGES] + [(source, strings_in(source)) for source in SOURCES]:
            for text in texts:
                checked += len(self.named_keys(text))
                with self.subTest(text[:60]):
                    self.assertEqual(self.unknown_keys(text), [], f"{file.relative_to(ROOT)}: {text[:200]}")
        self.assertGreater(checked, 100)

    def test_the_check_can_fail(self):
        self.assertEqual(self.unknown_keys("set pwm.perod_s, not pwm.period_s or control/pwm.hpp"), ["pwm.perod_s"])
        self.assertEqual(self.unknown_keys("require[0].metric and control.current.d1"), [])
        self.assertEqual(self.foreign_options("sixstep run a.toml --hmtl b.html"), [("run", "--hmtl")])

    def foreign_options(self, text):
        found = []
        for verb, rest in re.findall(r"(?:sixstep|\./run) (\w+)((?: [^\n`|;]+)?)", text):
            if verb not in self.options:
                continue
            found += [(verb, option) for option in re.findall(r"(?<!\S)(--[a-z][\w-]+)", rest) if option not in self.options[verb]]
        return found

    @property
    def options(self):
        if not hasattr(Names, "declared"):
            manual = re.sub(r"\\f[BIR]", "", said("man")).replace("\\-", "-")
            Names.declared = {}
            for verb, section in re.findall(r"(?ms)^\.SS sixstep (\w+)[^\n]*\n(.*?)(?=^\.S[SH] )", manual):
                Names.declared.setdefault(verb, {"--help"}).update(re.findall(r"(?m)^(--[\w-]+)", section))
        return Names.declared

    def test_options_exist(self):
        for file, texts in [(page, code_in(page)) for page in PAGES] + [(source, strings_in(source)) for source in SOURCES]:
            for text in texts:
                self.assertEqual(self.foreign_options(text), [], f"{file.relative_to(ROOT)}: {text[:200]}")


if __name__ == "__main__":
    unittest.main()
