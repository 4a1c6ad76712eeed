#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""renew_trust.py [ARGUMENTS OF drawn_scenarios]: draws scenarios, runs them, and writes the results into docs/explanation/drawn-scenarios.md.

Without arguments it draws 100 000 valid and 1 000 000 hostile scenarios from a new seed, with the program of build/dev."""
import datetime
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build/dev/tests/drawn_scenarios"
USUAL = ["--valid", "100000", "--hostile", "1000000", "--seed", "new"]

page = ROOT / "docs/explanation/drawn-scenarios.md"
drawn = subprocess.run([PROGRAM, *(sys.argv[1:] or USUAL)], stdout=subprocess.PIPE, text=True)
block = f"begin -->\n## Results of {datetime.date.today()}\n\n{drawn.stdout.strip()}\n<!-- end -->"
text, found = re.subn(r"begin -->.*<!-- end -->", lambda _: block, page.read_text(), flags=re.S)
assert found == 1, "the page has lost its markers"
page.write_text(text)
sys.exit(drawn.returncode)
