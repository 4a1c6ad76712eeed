#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""test_costs.py [BUILD]          prints the time of each test that ctest has measured in this build, the longest first
test_costs.py [BUILD] --write  writes the long tests into tests/slow.txt: ./test leaves them out, .ci/run has them"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SLOW = ROOT / "tests/slow.txt"
SECONDS = 8  # a test is long if it takes more than this, with two tests in parallel
HEAD = f"""# Tests that take more than {SECONDS} s, with their times. tools/test_costs.py --write measures them, two tests in parallel.
# ./test does not run them. ./test --faces runs all of them. .ci/run runs one half of them in two of four turns.
"""


def measured(build):
    """{name: seconds} of the tests that ctest has measured to their end."""
    text = (build / "Testing/Temporary/CTestCostData.txt").read_text().split("---")[0]
    costs = {name: float(seconds) for name, runs, seconds in (line.rsplit(" ", 2) for line in text.splitlines()) if int(runs)}
    return {name: seconds for name, seconds in costs.items() if not name.startswith("long.")}


def main(words):
    writes = "--write" in words
    folders = [word for word in words if word != "--write"]
    costs = measured(pathlib.Path(folders[0] if folders else ROOT / "build/dev"))
    dear = sorted(((seconds, name) for name, seconds in costs.items() if seconds > SECONDS), reverse=True)
    rows = "".join(f"{seconds:4.0f}  {name}\n" for seconds, name in dear)
    if writes:
        SLOW.write_text(HEAD + rows)
    else:
        print(rows, end="")
    rest = sum(costs.values()) - sum(seconds for seconds, _ in dear)
    print(f"{sum(costs.values()):.0f} s of {len(costs)} tests; without these {len(dear)} {rest:.0f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
