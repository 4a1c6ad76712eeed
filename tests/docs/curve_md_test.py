#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""curve_md_test.py PROGRAM [--renew]: docs/curve.md shows what the program prints, and the figures in its text are those
of the program's JSON. --renew writes the printed blocks anew."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
FILE = REPOSITORY / "docs" / "curve.md"
PAGE = FILE.read_text()
PROGRAM = REPOSITORY / "build/dev/sixstep"
BLOCK = re.compile(r"(<!-- test: run -->\n```sh\n\./run (.*?)\n```\n\n<!-- test: output -->\n```text\n)(.*?)(```)", re.S)


def run(command):
    with tempfile.TemporaryDirectory() as folder:
        sheet = (REPOSITORY / "data/motors/maxon-251601.toml").read_text()
        (pathlib.Path(folder) / "maxon-251601.toml").write_text(sheet)
        done = subprocess.run([PROGRAM, *command.split()], cwd=folder, capture_output=True, text=True, check=False, timeout=120)
        assert done.returncode == 0, done.stderr
        return done.stdout


class CurvePage(unittest.TestCase):
    def test_the_blocks_are_what_the_program_prints(self):
        blocks = BLOCK.findall(PAGE)
        self.assertGreaterEqual(len(blocks), 2)
        for _, command, shown, _ in blocks:
            self.assertEqual(shown, run(command), f"renew with: {sys.argv[0]} PROGRAM --renew")

    def test_the_figures_in_the_text_are_the_programs(self):
        curve = json.loads(run("curve maxon-251601 --json -"))
        table = dict(re.findall(r"<!-- figure: ([\w.]+) -->([\d.]+)", PAGE))
        self.assertGreaterEqual(len(table), 2)
        for path, shown in table.items():
            value = curve
            for word in path.split("."):
                value = value[word]
            digits = len(shown.split(".")[1]) if "." in shown else 0
            self.assertEqual(f"{value:.{digits}f}", shown, path)

    def test_the_claims_of_the_text_hold(self):
        curve = json.loads(run("curve maxon-251601 --json -"))
        half = curve["points"][20]
        self.assertGreater(1 - half["torque_Nm"] / half["ideal_torque_Nm"], 0.4)  # "more than 40 %"
        ideal_slope = curve["ideal"]["stall_torque_Nm"] / curve["ideal"]["no_load_speed_rad_s"]
        self.assertAlmostEqual(-ideal_slope / curve["no_load"]["slope_Nm_s"], 2.8, delta=0.05)  # "2.8 times"
        self.assertAlmostEqual(curve["ideal"]["no_load_speed_rad_s"], 716.4, delta=0.05)

    def test_the_picture_is_there(self):
        for picture in re.findall(r"!\[.*?\]\((.*?)\)", PAGE):
            self.assertTrue((FILE.parent / picture).is_file(), picture)

    def test_every_option_is_named(self):
        told = subprocess.run([PROGRAM, "curve", "--help"], capture_output=True, text=True, check=True).stdout
        for option in set(re.findall(r"--[a-z-]+", told)) - {"--help", "--data", "--quiet"}:
            self.assertRegex(PAGE, f"`{option}[ `]")


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else PROGRAM
    if "--renew" in sys.argv:
        FILE.write_text(BLOCK.sub(lambda m: m[1] + run(m[2]) + m[4], PAGE))
    else:
        unittest.main()
