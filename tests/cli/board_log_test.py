#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run --compare LOG: a run's own trace, in a board's units and by a clock that is off, lies on the run."""
import csv
import re
import unittest

from program import SOURCE, ProgramTest

SCENARIO = str(SOURCE / "data/scenarios/firmware/avr.toml")


class BoardLog(ProgramTest):
    def trace(self):
        self.run_program("run", SCENARIO, "--csv", "trace.csv", "--quiet")
        with open(self.path / "trace.csv", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def write_log(self, off_us=0.0):
        lines = ["# a board", "t [us],i_m [mA],speed [1/min],hall,note"]
        for row in self.trace()[40:900:7]:
            lines.append(f"{float(row['t_s']) * 1e6 - off_us:.3f},{float(row['i_m_A']) * 1e3:.0f},"
                         f"{float(row['speed_rad_s']) * 30 / 3.141592653589793:.4f},{row['hall']},7")
        (self.path / "log.csv").write_text("\n".join(lines) + "\n12")

    def found(self, text):
        return {m[1]: (int(m[2]), float(m[3]) * {"m": 1e-3, "u": 1e-6, "n": 1e-9, "": 1}[m[4]])
                for m in re.finditer(r"^ +(\w+) +(\d+) rows +rms ([0-9.e-]+) ?([munp]?)", text, re.M)}

    def test_a_log_lies_on_its_run(self):
        self.write_log()
        made = self.run_program("run", SCENARIO, "--compare", "log.csv", "--shift", "0", code=0)
        found = self.found(made.stdout)
        self.assertEqual(set(found), {"i_m_A", "speed_rad_s", "hall"}, made.stdout)
        self.assertEqual(found["i_m_A"][0], 123)
        self.assertLess(found["i_m_A"][1], 0.6e-3)  # a millampere's half at most
        self.assertLess(found["speed_rad_s"][1], 1e-4)
        self.assertIn("mean of the samples at 3 A", made.stdout)

    def test_a_clock_that_is_off_is_told(self):
        self.write_log(off_us=30)
        told = self.run_program("run", SCENARIO, "--compare", "log.csv", code=0).stdout
        self.assertIn("moved by 30 us", told)
        self.assertLess(self.found(told)["i_m_A"][1], 0.01)
        self.assertGreater(self.found(self.run_program("run", SCENARIO, "--compare", "log.csv", "--shift", "0").stdout)["i_m_A"][1], 0.05)

    def test_a_page_lays_it_over(self):
        self.write_log()
        self.run_program("run", SCENARIO, "--compare", "log.csv", "--html", "over.html", "--quiet", code=0)
        page = (self.path / "over.html").read_text(encoding="utf-8")
        for word in ("A board's log over its simulation", "what a board sent", "What the board sent, less the simulation", "log.csv"):
            self.assertIn(word, page)

    def test_refuses_with_a_way_out(self):
        self.write_log()
        (self.path / "bad.csv").write_text("t [us],i_m [V]\n1,2\n2,3\n")
        for words, said in (((SCENARIO, "--compare", "none.csv"), "none.csv"),
                            ((SCENARIO, "--compare", "bad.csv"), "where A belongs"),
                            ((SCENARIO, SCENARIO, "--compare", "log.csv"), "name one scenario"),
                            ((SCENARIO, "--compare", "log.csv", "--csv", "x.csv"), "no output but --html"),
                            ((SCENARIO, "--compare", "log.csv", "--out", "d"), "no output but --html"),
                            ((SCENARIO, "--shift", "1"), "--compare"),
                            ((SCENARIO, "--compare", "log.csv", "--vary", "supply.voltage_V=20:28:3"), "--only N")):
            with self.subTest(words=words[1:]):
                made = self.run_program("run", *words, code=2)
                self.assertIn(said, made.stderr)


if __name__ == "__main__":
    unittest.main()
