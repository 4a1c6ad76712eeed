#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""release_test.py PROGRAM: every stated version is equal to the version in CMakeLists.txt. The newest entry of the
changelog has this version. CITATION.cff has all necessary keys."""
import datetime
import email.utils
import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else str(ROOT / "build/dev/sixstep")
VERSION = re.search(r"(?m)^project\(sixstep VERSION (\d+\.\d+\.\d+) ", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
CHANGELOG = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
HEADINGS = re.findall(r"(?m)^## (.*)$", CHANGELOG)
# The keys at the root of Citation File Format 1.2.0.
CITATION_KEYS = set("abstract authors cff-version commit contact date-released doi identifiers keywords license license-url message "
                    "preferred-citation references repository repository-artifact repository-code title type url version".split())


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def released():
    """(version, date) of each release in the changelog, the newest first."""
    return [(found[1], found[2]) for found in map(re.compile(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)").fullmatch, HEADINGS) if found]


class Version(unittest.TestCase):
    def test_the_program_says_it(self):
        self.assertEqual(said("--version"), f"sixstep {VERSION}\n")
        self.assertIn(f'"sixstep {VERSION}"', said("man").partition("\n")[0])

    def test_what_the_program_wrote_for_pages_and_firmware_says_it(self):
        stated = 0
        for folder in ("docs", "faces/firmware", "data"):
            for file in (ROOT / folder).rglob("*"):
                if file.suffix in (".md", ".hpp", ".svg", ".toml", ".csv"):
                    for version in re.findall(r"sixstep[ _](\d+\.\d+\.\d+)\b", file.read_text(encoding="utf-8")):
                        self.assertEqual(version, VERSION, f"{file.relative_to(ROOT)}: tools/renew_docs.sh writes it anew")
                        stated += 1
        self.assertGreaterEqual(stated, 4)

    def test_packages_of_other_tools_state_none(self):
        self.assertNotIn("version", json.loads((ROOT / "package.json").read_text(encoding="utf-8")))
        lock = json.loads((ROOT / "package-lock.json").read_text(encoding="utf-8"))
        self.assertNotIn("version", lock)
        self.assertNotIn("version", lock["packages"][""])

    def test_no_other_list_of_the_build_states_it(self):
        for file in [*ROOT.glob("*/CMakeLists.txt"), *ROOT.glob("*/*/CMakeLists.txt"), *ROOT.glob("cmake/*")]:
            self.assertNotIn(VERSION, file.read_text(encoding="utf-8"), f"{file.relative_to(ROOT)}: take PROJECT_VERSION")


class Changelog(unittest.TestCase):
    def test_the_newest_entry_is_this_version(self):
        self.assertEqual(released()[0][0], VERSION)

    def test_it_has_the_form(self):
        self.assertTrue(CHANGELOG.startswith("# Changelog\n"))
        self.assertLess(len(CHANGELOG.splitlines()), 80 * len(released()))
        self.assertEqual(len(HEADINGS), len(released()) + HEADINGS.count("[Unreleased]"), "each is [Unreleased] or [VERSION] - DATE")
        self.assertNotIn("[Unreleased]", HEADINGS[1:])
        versions = [tuple(map(int, version.split("."))) for version, _ in released()]
        self.assertEqual(versions, sorted(set(versions), reverse=True))
        for _, date in released():
            datetime.date.fromisoformat(date)
        kinds = set(re.findall(r"(?m)^### (.*)$", CHANGELOG))
        self.assertLessEqual(kinds, {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"})

    def test_debian_can_read_it(self):
        made = subprocess.run([ROOT / "tools/debian_changelog.py", "a name <a@b.example>"], capture_output=True, text=True, check=True).stdout
        self.assertRegex(made, rf"\Asixstep \({re.escape(VERSION)}\) unstable; urgency=medium\n\n  \* ")
        signed = re.findall(r"(?m)^ -- a name <a@b\.example>  (.*)$", made)
        self.assertEqual([email.utils.parsedate_to_datetime(date).date().isoformat() for date in signed], [date for _, date in released()])
        self.assertEqual(len(re.findall(r"(?m)^  \* ", made)), len(re.findall(r"(?m)^- ", CHANGELOG.partition("\n## [Unreleased]\n")[2].partition("\n## [")[2] or CHANGELOG)))
        self.assertNotRegex(made, r"[`\[\]]", "no marks of Markdown")


class Citation(unittest.TestCase):
    def setUp(self):
        self.text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
        self.keys = dict(re.findall(r"(?m)^([a-z-]+):[ ]?(.*)$", self.text))

    def test_it_has_the_keys_that_the_format_asks_for(self):
        self.assertEqual(self.keys["cff-version"], "1.2.0")
        self.assertLessEqual(self.keys.keys(), CITATION_KEYS)
        self.assertTrue(self.keys["message"] and self.keys["title"])
        self.assertIn(self.keys["type"], ("software", "dataset"))
        self.assertRegex(self.text, r"(?m)^authors:\n  - (?:name|family-names): \S")
        self.assertNotRegex(self.text, r"\t", "YAML has no tabs")
        for line in self.text.splitlines():
            self.assertRegex(line, r'^(?:[a-z-]+:(?: (?:"[^"]*"|>-|[^"#:]+))?|  (?:- )?[^"#]+)$', "plain YAML, which needs no reader")

    def test_it_agrees(self):
        self.assertEqual((self.keys["version"], self.keys["date-released"]), released()[0])
        self.assertEqual(self.keys["license"], json.loads((ROOT / "package.json").read_text(encoding="utf-8"))["license"])
        self.assertIn(said("--help").partition("\n")[0].lower(), self.keys["title"].lower())


if __name__ == "__main__":
    unittest.main()
