#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compare.py EXPECTED PRINTED | compare.py EXPECTED --of PROGRAM: prints the cases that have other bits than the
table. Exits with 1 on any difference.

Each line is a comment with # or NAME TRAJECTORY FIGURES SEGMENTS. For each case it prints the first difference: the
trajectory, or only the figures computed from it."""
import pathlib
import subprocess
import sys

RENEW = "if this change is meant to change bits: tools/check_bits.sh --renew"


def table(text):
    return {words[0]: words[1:] for words in (line.split() for line in text.splitlines()) if words and words[0] != "#"}


def difference(expected, printed):
    """The difference in words; None if the two are equal."""
    if expected == printed:
        return None
    if expected is None or printed is None:
        return "is not in the table" if expected is None else "was not printed"
    for what, there, here in zip(("trajectory", "figures", "segments"), expected, printed):
        if there != here:
            moved = f", segments {expected[2]} -> {printed[2]}" if what == "trajectory" and expected[2] != printed[2] else ""
            return f"{what} {there} -> {here}{moved}"
    return f"{' '.join(expected)} -> {' '.join(printed)}"


def main():
    golden = pathlib.Path(sys.argv[1])
    if sys.argv[2] == "--of":
        text = subprocess.run(sys.argv[3:], stdout=subprocess.PIPE, text=True, check=True).stdout
    else:
        text = pathlib.Path(sys.argv[2]).read_text()
    expected, printed = table(golden.read_text() if golden.exists() else ""), table(text)
    wrong = 0
    for name in dict.fromkeys([*expected, *printed]):
        what = difference(expected.get(name), printed.get(name))
        if what:
            print(f"  {name}: {what}")
            wrong += 1
    if wrong or not printed:
        print(f"  {wrong} of {len(expected)} cases differ; {RENEW}")
        return 1
    print(f"{len(printed)} of {len(expected)} cases have the same bits")
    return 0


if __name__ == "__main__":
    sys.exit(main())
