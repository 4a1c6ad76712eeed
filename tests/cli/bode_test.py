#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run --bode: its text and its files, and the scenarios that it refuses."""
import json
import math
import re
import unittest

from program import SOURCE, ProgramTest, some

LOCKED = str(SOURCE / "data/scenarios/thesis/7.3.1-locked-exact-design.toml")
NO_LOOP = str(SOURCE / "data/scenarios/thesis/7.2-no-load.toml")


HELD = """
motor = "maxon-251601"
duration_s = 0.3
load = { locked = true }
pwm = { alignment = "centre", sample = "middle" }
sensors = { capture_Hz = 16e6 }
reference = { value = 100, unit = "rad/s" }
[control]
drive = "sensorless"
mode = "speed"
"""

SLOW = """
motor = "maxon-251601"
duration_s = 0.2
load = { inertia_kg_m2 = 1e-2 }
reference = { value = 400, unit = "rad/s" }
[control]
mode = "speed"
speed = { settle_s = 10e-3 }
current = { settle_s = 1e-3 }
"""


class Bode(ProgramTest):
    def test_prints_and_writes(self):
        made = self.run_program("run", LOCKED, "--bode", "--json", "b.json", "--csv", "b.csv", "--html", "b.html")
        self.assertEqual(made.stderr, "")
        self.assertIn("current around -5 A", made.stdout)
        told = json.loads((self.path / "b.json").read_text())
        table = (self.path / "b.csv").read_text().splitlines()
        self.assertRegex(table[0], r"^# sixstep \d")  # this line marks a file of sixstep, which the command may overwrite
        self.assertEqual(len([line for line in table if not line.startswith("# ")]), 1 + len(told["points"]))
        self.assertIn("Frequency response of", (self.path / "b.html").read_text())
        self.assertAlmostEqual(told["measured"]["crossover_Hz"] / told["designed"]["crossover_Hz"], 1, delta=0.03)
        self.assertTrue(all(math.isfinite(p["gain_dB"]) for p in told["points"]))

    def test_a_loop_that_does_not_answer_is_not_measured(self):
        """A sensorless drive with a held rotor stops with a fault before the multisine begins. The loop does not
        respond at all."""
        (self.path / "held.toml").write_text(HELD)
        files = ("--json", "b.json", "--csv", "b.csv", "--html", "b.html")
        made = self.run_program("run", "held.toml", "--bode", *files, code=1)
        self.assertIn("NOTHING WAS MEASURED: no line reaches a coherence of 0.9", made.stdout)
        margins = re.split(r"measured +designed\n", made.stdout)[1].splitlines()[:5]
        self.assertEqual([re.split(r" {2,}", line.strip())[1] for line in margins], ["-"] * 5, made.stdout)
        # The linear loop includes the half period of samples in the middle and the crossings' delay, so that no deviation is reported.
        self.assertNotIn("no linear loop", made.stdout)
        self.assertIn("the loop includes the delay of the back-EMF's zero crossings: at this speed the measured speed is ", made.stdout)
        told = json.loads((self.path / "b.json").read_text())
        self.assertFalse(told["answered"])
        self.assertEqual(set(told["measured"].values()), {None})
        self.assertTrue(all(p["gain_dB"] is None and p["phase_deg"] is None for p in told["points"]))
        for text in (made.stdout, *[(self.path / name).read_text() for name in ("b.json", "b.csv")],
                     re.sub("<script.*?</script>", "", (self.path / "b.html").read_text(), flags=re.S)):
            self.assertIsNone(re.search(r"(?<![\w-])-?(nan|inf)(?!\w)", text))
        quiet = self.run_program("run", "held.toml", "--bode", "--quiet", code=1)
        self.assertEqual((quiet.stdout, quiet.stderr), ("", "held: NOTHING WAS MEASURED: no line reaches a coherence of 0.9; run without --quiet for the reason\n"))

    def test_refuses_a_drive_that_is_still_on_its_way(self):
        """This drive needs 20 s to reach 400 rad/s. While the speed rises along a straight line, every line of the
        spectrum has a coherence of 1, but the curve is wrong."""
        (self.path / "slow.toml").write_text(SLOW)
        made = self.run_program("run", "slow.toml", "--bode", "--json", "b.json", code=2)
        self.assertRegex(made.stderr, r"^slow: duration_s = 0\.\d+ ends while the drive still moves towards 400 rad/s: .*; lengthen duration_s")
        self.assertFalse((self.path / "b.json").exists())
        self.run_program("run", "slow.toml", "--set", "load.inertia_kg_m2=0", "--bode")

    def test_says_why_a_loop_is_beside_the_designed_one(self):
        """With soft chopping and no load, the drive cannot brake. The phase margin is ten degrees smaller than
        designed. With complementary chopping it is as designed."""
        speed = str(SOURCE / "data/scenarios/thesis/7.4-speed-exact-design.toml")
        for words, beside in (((), True), (("--set", "pwm.chopping=complementary"), False)):
            made = self.run_program("run", speed, "--bode", *words, "--json", "b.json", "--html", "b.html").stdout
            told = json.loads((self.path / "b.json").read_text())
            (self.path / "b.json").unlink()
            lost = told["designed"]["phase_margin_deg"] - told["measured"]["phase_margin_deg"]
            self.assertEqual(lost > 5, beside)
            self.assertEqual('deg from the designed loop' in made and 'set pwm.chopping = "complementary", with which the current can reverse' in made, beside)
            page = (self.path / "b.html").read_text()
            self.assertIn("±", page)
            self.assertNotIn("+-", page[page.index("<h1"):page.index("<footer") if "<footer" in page else len(page)])
            (self.path / "b.html").unlink()

    def test_a_cause_is_named_where_its_cure_works(self):
        """The program once suggested complementary chopping although the rotor sensor was the cause. With the cure
        that the program names, no loop differs from the designed loop."""
        for mode, name in (("speed", "sp"), ("position", "po")):
            self.run_program("new", name, "--motor", "maxon-251601", "--mode", mode)
        free = ("--set", "load.torque_Nm=0", "--set", "bridge.dead_time_s=0")  # near zero current the dead time also changes the loop
        both, ideal = ("--set", "pwm.chopping=complementary"), ("--set", "sensors.rotor=ideal")
        encoder = ("--set", "sensors.rotor=encoder", "--set", "pwm.commutation=sample")
        for words, said, cures in some((
                (("sp.toml", *free, *ideal), "with this chopping the current cannot reverse", (both,)),
                (("po.toml",), "Hall probes resolve the position only in steps of 7.5 deg", (encoder,)),
                (("sp.toml",), None, ()),
                (("sp.toml", *ideal), None, ()),
                (("po.toml", *both), "Hall probes resolve the position only in steps of 7.5 deg", (ideal,))), 3):
            with self.subTest(words=words):
                beside = re.findall("deg from the designed loop: (.*)", self.run_program("run", *words, "--bode").stdout)
                self.assertEqual(len(beside), said is not None, beside)
                if said:
                    self.assertTrue(beside[0].startswith(said), beside)
                for cure in cures:
                    self.assertNotIn("from the designed loop", self.run_program("run", *words, *cure, "--bode").stdout)

    def test_json_is_alone_on_standard_output(self):
        made = self.run_program("run", LOCKED, "--bode", "--amplitude", "0.5", "--json", "-")
        self.assertEqual(json.loads(made.stdout)["amplitude"], 0.5)
        self.assertIn("coherence", made.stderr)

    def test_refuses_with_a_way_out_and_writes_nothing(self):
        for words, said in (((NO_LOOP, "--bode"), "has no loop"),
                            ((LOCKED, "--bode", "--vary", "supply.voltage_V=20:28:3"), "--vary has no effect with --bode"),
                            ((LOCKED, "--bode", "--out", "all"), "--out has no effect with --bode"),
                            ((LOCKED, "--amplitude", "1"), "--bode"),
                            ((LOCKED, "--bode", "--amplitude", "-1"), "--amplitude"),
                            ((LOCKED, "--bode", "--set", "reference={ value = 0 }"), "--amplitude"),
                            ((LOCKED, "--bode", "--json", "/nowhere/b.json"), "/nowhere")):
            with self.subTest(words=words[1:]):
                made = self.run_program("run", *words, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
