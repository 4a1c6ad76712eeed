#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""coverage_test.py PROGRAM: the pages name every option, key, word, phase and block of the program, the header files
and the plans."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from page import REPOSITORY, Page

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else REPOSITORY / "build/dev/sixstep"
USUAL = {"--help", "--data", "--quiet", "--json", "--force", "--jobs"}
VERBS = {"compare": ("howto/choose-a-controller",), "curve": ("howto/read-the-curve",), "motor wiring": ("howto/find-a-wiring-fault",),
         "motor commission": ("howto/commission-a-drive",),
         "motor identify": ("howto/record-a-motor", "howto/find-the-hall-order", "howto/measure-the-back-emf"),
         "motor emf": ("howto/record-a-motor", "howto/find-the-hall-order", "howto/measure-the-back-emf")}
FIGURES = Page("docs/reference/figures.md").text


def told(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True, timeout=60).stdout


def words_of(key):
    """The words that the key accepts, from `sixstep help KEY`."""
    return [line.split(None, 1)[0] for line in told("help", key).splitlines() if line.startswith("    ")]


def rows(heading):
    """The rows of the table below a heading of the page of figures. The cells have no spaces at their ends."""
    part = FIGURES.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    cells = ([cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in part.splitlines() if line.startswith("| `"))
    return {tuple(re.findall(r"`([^`]+)`", row[0])): row[1:] for row in cells}


class Coverage(unittest.TestCase):
    def test_every_option_is_on_the_page_of_its_command(self):
        for verb, pages in VERBS.items():
            text = "".join(Page(f"docs/{name}.md").text for name in pages)
            for option in set(re.findall(r"--[a-z-]+", told(*verb.split(), "--help"))) - USUAL:
                self.assertRegex(text, f"`[^`]*{option}[ `]", verb)

    def test_every_key_of_a_plan_is_on_a_page(self):
        text = Page("docs/reference/plan-file.md").text + Page("docs/howto/find-the-best-point.md").text
        for key in set(json.loads(told("schema", "plan"))["properties"]) - {"title", "notes"}:
            self.assertRegex(text, rf"`\[?\[?{key}\]?\]?`")

    def test_every_phase_of_commissioning_is_in_its_table(self):
        header = (REPOSITORY / "sixstep/control/commissioning/commissioning_phases.hpp").read_text(encoding="utf-8")
        phases = re.search(r"enum class CommissioningPhase.*?\{(.*?)\}", header, re.S)[1]
        for phase in set(re.findall(r"\w+", phases)) - {"done", "failed"}:
            self.assertRegex(Page("docs/howto/commission-a-drive.md").prose, rf"(?m)^\|[^|]*\b{phase}\b")

    def test_every_header_of_the_control_library_is_in_the_table_of_blocks(self):
        named = sorted(re.findall(r"`([\w/]+\.hpp)`", Page("docs/reference/blocks.md").text.split("<!-- blocks -->")[1]))
        headers = (REPOSITORY / "sixstep/control").rglob("*.hpp")
        self.assertEqual(named, sorted(p.relative_to(REPOSITORY / "sixstep/control").as_posix() for p in headers))

    def test_each_word_of_the_table_of_wirings_is_explained(self):
        page = Page("docs/howto/find-a-wiring-fault.md")
        for word in ("FORWARD", "BACKWARD", "early", "late", "hums"):
            self.assertIn(word, page.texts("output")[0])
            self.assertRegex(page.prose, rf"(?m)^\|.*\b{word}\b.*\|.*\|.*\|$")

    def test_the_picture_of_the_wirings_is_what_the_program_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            told("motor", "wiring", "maxon-251601", "--svg", f"{folder}/now.svg", "--quiet")
            now = pathlib.Path(folder, "now.svg").read_bytes()
        self.assertEqual((REPOSITORY / "docs/images/wiring.svg").read_bytes(), now, "renew with tools/renew_docs.sh")


class Figures(unittest.TestCase):
    def test_every_metric_is_defined(self):
        defined = {names[0]: cells for names, cells in rows("Metrics").items()}
        self.assertEqual(sorted(defined), sorted(words_of("require.metric")))
        for name, cells in defined.items():
            self.assertEqual(len(cells), 4, name)
            self.assertTrue(all(cells), f"{name}: a cell is empty")

    def test_every_signal_is_named_once(self):
        named = [name for names in rows("Signals") for name in names]
        self.assertEqual(sorted(named), sorted(words_of("require.signal")))

    def test_units_are_those_of_the_words(self):
        for names, (unit, _) in rows("Signals").items():
            for name in names:
                suffix = re.search(r"_(A|V|W|Nm|rad_s|rad|deg)$", name)
                if suffix:
                    self.assertIn({"Nm": "N m", "rad_s": "rad/s"}.get(suffix[1], suffix[1]), unit.split(", "), name)

    def test_every_key_that_shapes_a_figure_is_explained(self):
        keys = re.findall(r"^  require\.(\w+)", told("help", "require"), re.M)
        self.assertIn("frequency_Hz", keys)
        for key in set(keys) - {"label"}:
            self.assertIn(f"`{key}", FIGURES, key)


if __name__ == "__main__":
    unittest.main()
