#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""figures_md_test.py PROGRAM [--renew]: docs/figures.md defines every metric and names every signal and key, and its example
runs and prints what the page shows. --renew writes the printed block anew."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FILE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "figures.md"
PAGE = FILE.read_text()
PROGRAM = pathlib.Path("build/dev/sixstep")
OUTPUT = re.compile(r"(<!-- test: output -->\n```text\n)(.*?)(```)", re.S)


def told(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True, timeout=60).stdout


def words_of(key):
    """Words of a choice, as `sixstep help KEY` lists them, with their meanings."""
    lines = (line for line in told("help", key).splitlines() if line.startswith("    "))
    return dict(line.split(None, 1) for line in lines)


def rows(heading):
    """The rows of the table below a heading, cells without their spaces."""
    part = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    cells = ([cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in part.splitlines() if line.startswith("| `"))
    return {tuple(re.findall(r"`([^`]+)`", row[0])): row[1:] for row in cells}


class FiguresPage(unittest.TestCase):
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
            self.assertIn(f"`{key}", PAGE, key)

    def test_the_example_prints_what_is_shown(self):
        self.assertEqual(OUTPUT.search(PAGE)[2], example(), f"renew with: {sys.argv[0]} PROGRAM --renew")


def example():
    scenario = re.search(r"<!-- test: scenario -->\n```toml\n(.*?)```", PAGE, re.S)[1]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "half-duty.toml").write_text(scenario)
        done = subprocess.run([PROGRAM, "run", "half-duty.toml"], cwd=folder, capture_output=True, text=True, check=False, timeout=60)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    if "--renew" in sys.argv:
        FILE.write_text(OUTPUT.sub(lambda m: m[1] + example() + m[3], PAGE))
    else:
        unittest.main()
