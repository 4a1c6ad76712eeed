#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""published_numbers_test.py: a law checks every number in README.md and docs/. A comparison with the present output
is not sufficient.

The numbers are found by blocks and tables. A block without a law fails, and the message names its place. The laws are
in laws/. Each law uses physics, a sum, a closed form or a second computation."""
import random
import re
import unittest

from laws import pages_laws, run_output, spots

PRINTED = re.compile(r"(?<![\w.^-])\d+(?:\.\d+)?(?![\w-]*\.toml)")


def walk():
    """Each spot with the command above it, and the files that its page has written before."""
    for name in spots.pages():
        command, written = "", {}
        for spot in spots.spots_of(name):
            if spot.kind == "write":
                written[spot.detail] = spot.text
            if spot.kind == "run":
                command = spot.text.strip().splitlines()[0]
            if spot.kind == "excerpt":
                command = spot.detail.removeprefix("of ")
            yield spot, command, written


class PublishedNumbers(unittest.TestCase):
    maxDiff = None

    def judge(self, spot, command, written):
        """Returns whether a law has checked the spot."""
        by_run, law = run_output.judges(spot), pages_laws.law_of(spot)
        if by_run:
            run_output.judge(self, spot, command, written)
        if law:
            law(self, spot)
        return by_run or law is not None

    def test_each_is_judged(self):
        unjudged = []
        for spot, command, written in walk():
            with self.subTest(str(spot)):
                if not self.judge(spot, command, written) and spot.kind not in pages_laws.INPUT and spots.is_worth_judging(spot):
                    unjudged.append(f"{spot} [{spot.heading}] {spot.kind} {spot.text.splitlines()[0][:60]}")
        self.assertEqual([], unjudged, "nobody judges these numbers: give each a law in tests/docs/laws")

    def test_a_number_that_is_ten_times_what_it_was_is_seen(self):
        """The laws can fail: if printed results are multiplied by ten, the laws notice most of these errors."""
        draw, seen, changed = random.Random(20261127), 0, 0
        for spot, command, written in walk():
            law = pages_laws.law_of(spot)
            if law in pages_laws.NO_RESULTS or not (law or run_output.judges(spot)):
                continue
            places = list(PRINTED.finditer(spot.text))
            for m in draw.sample(places, min(4, len(places))):
                wrong = f"{10 * float(m.group(0)):.6g}" if float(m.group(0)) else "7"
                text = spot.text[:m.start()] + wrong + spot.text[m.end():]
                changed += 1
                try:
                    self.judge(spot._replace(text=text), command, written)
                except (AssertionError, AttributeError, IndexError, KeyError, TypeError, ValueError):
                    seen += 1
        self.assertGreater(changed, 500)
        self.assertGreater(seen / changed, 0.5, f"of {changed} wrong numbers {seen} are seen")


if __name__ == "__main__":
    unittest.main()
