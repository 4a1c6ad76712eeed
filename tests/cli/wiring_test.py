#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep motor wiring: all 36 ways to connect a motor, its files, and its messages about unsupported motors.

With --every-motor it tests all motors of the library (ctest --preset long)."""
import json
import sys
import unittest
import xml.etree.ElementTree

EVERY = "--every-motor" in sys.argv and not sys.argv.remove("--every-motor")

from program import BRISK, SOURCE, WIRING, Started  # noqa: E402, it takes its own words from the command line

SHIPPED = (SOURCE / "data/motors/maxon-251601.toml").read_text()
ORDERS, DIGITS = ["abc", "bca", "cab", "acb", "cba", "bac"], ["123", "231", "312", "132", "321", "213"]
TURN = {word: n for n, word in enumerate(ORDERS)}


def table(text, number):
    """The six rows of the first or second table whose rows begin with an order of the phases."""
    rows = [line.split("  ") for line in text.splitlines() if line[2:5] in ORDERS]
    return {row[1]: [cell.strip() for cell in row[2:] if cell.strip()] for row in rows[6 * number:6 * number + 6]}


class Wiring(Started):
    def wirings(self, *words, code=0):
        return json.loads(self.run_program("motor", "wiring", *words, "--json", code=code).stdout)

    def check_all(self, told):
        self.assertEqual(told["agreeing"], 36)
        self.assertEqual([(w["phases"], w["hall_lines"]) for w in told["wirings"]], [(p, h) for p in ORDERS for h in DIGITS])
        for w in told["wirings"]:
            with self.subTest(w["phases"] + " " + w["hall_lines"]):
                phases, probes = TURN[w["phases"]], DIGITS.index(w["hall_lines"])
                does = w["measured"]["does"]
                self.assertEqual(does, w["theory"]["does"])
                # If the order of either the phases or the probes is reversed, but not of both, the motor hums. Otherwise the
                # difference of their two shifts decides.
                self.assertEqual(does == "hums", (phases < 3) != (probes < 3))
                if phases < 3 and probes < 3:
                    self.assertEqual(does, ["forward", "backward_early", "backward_late"][(phases - probes) % 3])
                self.assertEqual(w["cures"][0]["wires"], 0 if does == "forward" else 2 if does == "hums" else 3 if phases < 3 else 4)
                for run in w["measured"]["runs"]:
                    way = 0 if does == "hums" else 1 if does.startswith("forward") else -1
                    self.assertEqual((run["electrical_turns_from_start"] > 1) - (run["electrical_turns_from_start"] < -1), way)

    def test_a_trapezoid_as_text_and_as_json(self):
        told = self.wirings("maxon-251601")
        self.check_all(told)
        self.assertAlmostEqual(told["bench"]["stalled_A"], 2.33)
        (self.path / "brisk.toml").write_text(BRISK)
        text = self.run_program(*WIRING.split()).stdout
        told = json.loads(self.run_program(*WIRING.split(), "--json").stdout)
        words = {"forward": "FORWARD", "backward": "BACKWARD"}
        shown = table(text, 0)
        for w in told["wirings"]:
            does = words.get(w["measured"]["does"], w["measured"]["does"].replace("_", ", "))
            self.assertEqual(shown[w["phases"]][DIGITS.index(w["hall_lines"])], does)
        self.assertEqual([row["hall"] for row in told["commutation"]], ["100", "110", "010", "011", "001", "101"])

    def test_an_outer_rotor_of_sines_and_a_delta_in_files_of_their_own(self):
        self.check_all(self.wirings("dji-2212-920kv"))
        (self.path / "delta.toml").write_text(SHIPPED.replace('back_emf = "trapezoid"', 'back_emf = "trapezoid"\nconnection = "delta"'))
        self.check_all(self.wirings("delta.toml", "--current", "3", "--voltage", "12"))

    def test_a_linear_motor_in_its_words(self):
        told = self.wirings("example-linear")
        self.check_all(told)
        self.assertIn("force_N_A", told["wirings"][0]["theory"])
        self.assertGreater(told["wirings"][0]["measured"]["runs"][0]["speed_m_s"], 1)

    def test_the_number_of_cores_changes_nothing(self):
        (self.path / "brisk.toml").write_text(BRISK)
        made = [self.run_program(*WIRING.split(), "--json", "--jobs", jobs).stdout for jobs in "123"]
        self.assertEqual(made[1:], made[:1] * 2)

    def test_files(self):
        (self.path / "brisk.toml").write_text(BRISK)
        words = [*WIRING.split(), "--svg", "w.svg", "--html", "w.html", "--toml", "w.toml", "--quiet"]
        self.assertEqual(self.run_program(*words).stdout, "")
        first = [(self.path / name).read_bytes() for name in ("w.svg", "w.html")]
        self.run_program(*words)  # the program replaces the files that it wrote before
        self.assertEqual(first, [(self.path / name).read_bytes() for name in ("w.svg", "w.html")])
        picture = xml.etree.ElementTree.fromstring(first[0])
        self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertEqual(sum(title.text.startswith("phases ") for title in picture.iter("{http://www.w3.org/2000/svg}title")), 36)
        # The scenario describes the bench: with crossed wires the motor behaves as the table says.
        crossed = ["--set", 'bridge.phases="bac"', "--set", 'sensors.hall_lines="132"']
        for extra, sign in (([], 1), (crossed, -1)):
            told = json.loads(self.run_program("run", "w.toml", *extra, "--json", "-", "--quiet").stdout)
            self.assertGreater(told["compare"][0]["measured"] * sign, 50)
        # The scenario expects the measured values, and names the bench by the keys that cross wires.
        told = json.loads(self.run_program("run", "w.toml", "--json", "-", "--quiet").stdout)
        for figure in told["compare"]:
            self.assertAlmostEqual(figure["measured"] / figure["value"], 1, places=9)
        self.assertEqual(told["title"], "Released from rest, connected as in bridge.phases and sensors.hall_lines")
        self.assertEqual(self.names(), ["brisk.toml", "w.html", "w.svg", "w.toml"])

    def test_what_it_cannot_do_is_one_line_and_bad_input(self):
        for words, told in ((["be8108"], "be8108: simulatable = false because no source gives its inertia"),
                            (["hoverboard-hub"], "--voltage is missing, and the sheet prints no nominal voltage; give the bus voltage"),
                            (["nobody"], "nobody is neither nobody nor nobody.toml nor a built-in motor"),
                            (["maxon-251601", "--current", "0"], "--current = 0 must be above 0 and at most 23.3 A"),
                            (["maxon-251601", "--current", "nan"], "--current = nan must be above 0"),
                            (["maxon-251601", "--current", "24"], "--current = 24 must be above 0 and at most 23.3 A"),
                            (["maxon-251601", "--current", "1e-6"], "--current = 1e-06 makes each of the 252 runs last "),
                            (["maxon-251601", "--voltage", "-1"], "--voltage = -1 must be above 0"),
                            (["maxon-251601", "--voltage", "1e300"], "--voltage = 1e+300"),
                            (["maxon-251601", "--svg", "a", "--html", "a"], "--html = a is also the file of --svg"),
                            (["maxon-251601", "--svg", "no/a"], "no/a"),
                            ([], "sixstep motor wiring needs MOTOR")):
            with self.subTest(words):
                result = self.run_program("motor", "wiring", *words, code=2)
                self.assertTrue(result.stderr.startswith(told), result.stderr)
                self.assertEqual((result.stdout, result.stderr.count("\n")), ("", 1))
        self.assertEqual(self.names(), [])

    def test_a_motor_that_friction_holds_differs_from_theory_and_fails(self):
        (self.path / "stiff.toml").write_text(SHIPPED + "\ncoulomb_friction_mNm = 60\n")
        text = self.run_program("motor", "wiring", "stiff.toml", code=1).stdout
        self.assertIn("phases abc, Hall lines 231: backward, late by theory, hums in simulation\n", text)
        self.assertIn("24 of 36 move in simulation as theory predicts", text)

    @unittest.skipUnless(EVERY, "only with --every-motor")
    def test_every_motor_of_the_library(self):
        tried = 0
        for motor in json.loads(self.run_program("motor", "list", "--json").stdout):
            if not motor["simulatable"]:
                continue
            with self.subTest(motor["name"]):
                self.check_all(self.wirings(motor["name"], *(() if motor["nominal_voltage_V"] else ("--voltage", "36"))))
                tried += 1
        self.assertGreater(tried, 14)


if __name__ == "__main__":
    unittest.main()
