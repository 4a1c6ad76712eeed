#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep motor commission: its results as text, as JSON and as a motor file, and its message if it cannot find them."""
import json
import tomllib
import unittest

from program import Started

ORDERS, DIGITS = ["abc", "bca", "cab", "acb", "cba", "bac"], ["123", "231", "312", "132", "321", "213"]


class Commission(Started):
    def commission(self, *words, code=0):
        return self.run_program("motor", "commission", *words, code=code)

    def found(self, *words, code=0):
        return json.loads(self.commission(*words, "--json", code=code).stdout)

    def test_what_was_found_lies_within_its_bounds_and_is_the_same_each_time(self):
        told = self.found("maxon-251601", "--offset", "7")
        self.assertTrue(told["holds"])
        self.assertEqual(told["failure"], "")
        for name in ("resistance_ohm", "inductance_H", "flux_linkage_Vs"):
            with self.subTest(name):
                q = told[name]
                self.assertAlmostEqual(q["off_part"], q["found"] / q["is"] - 1)
                self.assertLess(abs(q["found"] - q["is"]), q["bound_part"] * q["found"])
        hall = told["hall"]
        self.assertAlmostEqual(hall["true_offset_deg"], 7)
        self.assertLess(abs(hall["offset_deg"] - 7), hall["bound_deg"])
        self.assertTrue(hall["straight"])
        self.assertEqual([row["code"] for row in hall["sectors"]], ["100", "110", "010", "011", "001", "101"])
        self.assertEqual(told, self.found("maxon-251601", "--offset", "7"))
        self.assertNotEqual(told["resistance_ohm"], self.found("maxon-251601", "--offset", "7", "--seed", "5")["resistance_ohm"])

    def test_lines_are_named_as_they_hang(self):
        for wires, inverted in (("213", "2"), ("312", "13")):
            with self.subTest(wires):
                hall = self.found("maxon-251601", "--wires", wires, "--inverted", inverted)["hall"]
                self.assertFalse(hall["straight"])
                # Each pin has the probe connected to it, unless all three lines are shifted by the same number of pins. Such a shift equals
                # a shifted angle.
                self.assertEqual(len({row["code"] for row in hall["sectors"]}), 6)
                turned = DIGITS.index(wires) < 3
                found = "".join(map(str, hall["probes_at_pins"]))
                self.assertEqual(DIGITS.index(found) < 3, turned)

    def test_a_motors_file_has_what_was_found(self):
        told = self.found("maxon-251601", "--write", "found.toml")
        written = tomllib.loads((self.path / "found.toml").read_text())
        self.assertAlmostEqual(written["resistance_ohm"]["value"], told["resistance_ohm"]["found"],
                               delta=0.1 * told["resistance_ohm"]["bound_part"] * told["resistance_ohm"]["found"])
        self.assertEqual(written["resistance_ohm"]["frame"], "phase")
        self.assertAlmostEqual(written["inductance_mH"]["value"], 1e3 * told["inductance_H"]["found"], delta=1e-2)
        self.assertAlmostEqual(written["flux_linkage_mWb"]["value"], 1e3 * told["flux_linkage_Vs"]["found"], delta=1e-1)

    def test_what_is_not_found_is_told_with_exit_code_1(self):
        shown = self.commission("dji-2212-920kv", "--current", "4", code=1).stdout
        self.assertRegex(shown, r"(?m)^NOT FOUND: Hall edges .*give more current$")
        self.assertIsNone(self.found("dji-2212-920kv", "--current", "4", code=1)["hall"])

    def test_crossed_phases_are_named(self):
        """If two phases are swapped, the chip's forward direction is backward for the motor. A cyclic exchange of all
        three phases does not reverse it."""
        for phases, turns_over in (("abc", False), ("bca", False), ("bac", True)):
            text = self.commission("maxon-251601", "--phases", phases).stdout
            self.assertEqual(f"Phases {phases} are at the legs a b c." in text, phases != "abc")
            self.assertEqual("its forward direction is backward for the motor" in text, turns_over)
            self.assertIn("sixstep motor wiring", text)

    def test_what_cannot_be_is_refused(self):
        for words, told in ((["example-linear"], "example-linear: kind = linear cannot be commissioned"),
                            (["hoverboard-hub"], "--voltage is missing"),
                            (["maxon-251601", "--voltage", "nan"], "--voltage = nan"),
                            (["maxon-251601", "--current", "-1"], "--current = -1 must be above 0"),
                            (["maxon-251601", "--current", "inf"], "--current = inf must be above 0"),
                            (["maxon-251601", "--offset", "1e9"], "--offset = 1e+09"),
                            (["maxon-251601", "--phases", "abd"], "--phases = abd must be one of"),
                            (["maxon-251601", "--wires", "112"], "--wires = 112 must be one of"),
                            (["maxon-251601", "--inverted", "4"], "--inverted = 4 must be one of")):
            with self.subTest(words):
                shown = self.commission(*words, code=2)
                self.assertTrue(shown.stderr.startswith(told), shown.stderr)
                self.assertEqual(shown.stdout, "")
                self.assertEqual(shown.stderr.count("\n"), 1)

    def test_a_page_shows_the_test(self):
        self.commission("maxon-251601", "--html", "c.html", "--quiet")
        page = (self.path / "c.html").read_text()
        for word in ("Currents of the fast turn", "The rotor's path", "All values were found", "leg c"):
            self.assertIn(word, page.replace("&#39;", "'"))
        self.assertNotIn("nan", page.split("<body")[-1].lower().split("<pre")[0])


if __name__ == "__main__":
    unittest.main()
