#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep export: a drive is exported only if its run has passed and has measured all that is necessary."""
import pathlib
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest, some

DESPITE = ["--despite", "the tests look at its text"]
BOARD = "current-square-board"  # this scenario may be exported: it has converters, and the command is delayed by a period


class Export(ProgramTest):
    def scenario(self, name):
        return str(SOURCE / f"data/scenarios/{name}.toml")

    def test_export_writes_a_header_or_prints_it(self):
        position = self.scenario("thesis/7.5-position")
        printed = self.run_program("export", "header", position, *DESPITE).stdout
        self.assertIn("using Scalar = double;", printed)
        self.assertIn("c.mode = Mode::position;", printed)
        self.assertIn("= 0x1.2p+2;", printed)  # 4.5 V/A
        self.assertIn("2.4 rad/s per deg; given as gain_rad_s_per_deg, for at most 716.4 rad/s, the bus voltage divided by K_t", printed)
        self.assertRegex(printed, r"// 24 V: duty 1\n")
        self.assertEqual(self.run_program("export", "header", position, *DESPITE, "--out", "d.hpp").stdout, "")
        written = (self.path / "d.hpp").read_text()
        self.assertEqual(written.replace(" --out d.hpp", ""), printed)
        self.assertEqual(self.names(), ["d.hpp"])
        own = self.run_program("export", "header", position, *DESPITE, "--set", "control.arithmetic=float").stdout
        self.assertIn("using Scalar = float;", own)
        single = self.run_program("export", "header", position, *DESPITE, "--single-header", "--namespace", "left::wheel").stdout
        self.assertIn('#include "sixstep_control.hpp"\n\nnamespace left::wheel {', single)

    def test_a_header_asks_for_a_profile_where_its_drive_has_one(self):
        asks, told = "#define SIXSTEP_POSITION_PROFILE", {}
        for name in ("gallery/position-profile", "gallery/position-step"):
            header = self.run_program("export", "header", self.scenario(name), *DESPITE, "--set", "control.arithmetic=float").stdout
            told[name] = asks in header
            (self.path / "drive_config.hpp").write_text(header)
            (self.path / "main.cpp").write_text(
                '#include "drive_config.hpp"\n'
                f"static_assert(sixstep::control::position_profile_is_there == {str(told[name]).lower()});\n")
            space = re.search(r"^namespace (\S+) \{", header, re.M).group(1)
            with (self.path / "main.cpp").open("a") as main:
                main.write(f"constexpr auto drive = {space}::drive;\n")
            subprocess.run(["g++", "-std=c++20", "-fsyntax-only", f"-I{SOURCE}", "main.cpp"], cwd=self.path, check=True)
        self.assertEqual(list(told.values()), [True, False])

    def test_an_exported_header_can_be_made_again_by_its_own_comment(self):
        (self.path / "my drive.toml").write_text(pathlib.Path(self.scenario("thesis/7.5-position")).read_text())
        first = self.run_program("export", "header", "my drive.toml", "--arithmetic", "q31", "--range", "current_A=60", *DESPITE).stdout
        command = re.search(r"^//   sixstep (.*)$", first, re.M).group(1)
        again = subprocess.run(f"{PROGRAM} {command}", shell=True, cwd=self.path, capture_output=True, text=True, check=True)
        self.assertEqual(again.stdout, first)

    def test_export_refuses_properly(self):
        position = self.scenario("thesis/7.5-position")
        def told(*words):
            result = self.run_program("export", "header", *words, "--out", "d.hpp", code=2)
            self.assertEqual(result.stdout, "")
            return result.stderr
        off = told(position, "--set", "control.mode=off")
        self.assertEqual(off, f"{position}: control.mode = off leaves no drive to export; set control.mode to duty, current, speed or position\n")
        self.assertIn("absent.toml", told("absent.toml"))
        self.assertEqual(told(position, "--arithmetic", "q51"),
                         "--arithmetic = q51 must be one of double, float, q15, q14, q31, q30; did you mean q15?\n")
        self.assertEqual(told(position, "--range", "curent_A=3", "--arithmetic", "q15"),
                         "--range curent_A=3 is not a quantity of the range; did you mean current_A?\n")
        self.assertIn("--range current_A = 3A must be a number above 0", told(position, "--range", "current_A=3A", "--arithmetic", "q15"))
        self.assertIn("--range current_A", told(position, "--range", "current_A", "--arithmetic", "q15"))
        self.assertIn("add --arithmetic q15", told(position, "--range", "current_A=3"))
        # A range must include the scenario's own largest setpoint and its source's values.
        square = self.scenario("current-square-board")
        for stated, least in (("current_A=4.9", "5 A"), ("setpoint=4.9", "5 of its unit"), ("bus_V=23", "24 V")):
            self.assertIn(f"is less than {least}, the largest value that this scenario", told(square, "--range", stated, "--arithmetic", "q15"))
        for name in ("7up", "int", "left::class", "std"):
            self.assertIn(f"--namespace = {name} is not the name of a C++ namespace", told(position, "--namespace", name))
        self.assertIn("does not name a key and a value", told(position, "--set", "novalue"))
        small = told(position, "--arithmetic", "q15", "--set", "control.speed.d1=1e-9", "--set", "control.speed.d0=-0.9e-9")
        self.assertIn(f"{position}: control.arithmetic = \"q15\" cannot represent this drive: speed.K_i = ", small)
        self.assertIn("use a 32-bit format", small)
        # The ratio of such bases does not fit 16 bits, so that the message names the gain.
        self.assertIn("position_gain = ", told(position, "--arithmetic", "q15", "--set", "control.position.gain_rad_s_per_deg=1e6"))
        self.run_program("export", code=2)
        self.run_program("export", "heder", position, code=2)
        self.run_program("export", "header", code=2)
        self.assertEqual(self.run_program("exprt", code=2).stderr, "exprt is not a command of sixstep; did you mean export?\n")
        self.assertIn("cannot be written", self.run_program("export", "header", position, "--out", "no/d.hpp", code=2).stderr)
        self.assertEqual(self.names(), [])


class Gate(ProgramTest):
    def scenario(self, name):
        return str(SOURCE / f"data/scenarios/{name}.toml")

    def refused(self, code, name, *words):
        """The messages of an export that is refused. No header may be written."""
        result = self.run_program("export", "header", self.scenario(name), *words, "--out", "d.hpp", code=code)
        self.assertEqual((result.stdout, self.names()), ("", []))
        *lines, last = result.stderr.splitlines()
        self.assertEqual(last, "no header was written; to write the header anyway, add --despite REASON; the header then states these reasons")
        return [line.removeprefix(self.scenario(name) + ": ") for line in lines]

    def test_a_header_that_passed_says_what_it_passed(self):
        text = self.run_program("export", "header", self.scenario(BOARD)).stdout
        ran = self.run_program("run", self.scenario(BOARD), "--json", "-").stdout
        digest = re.search(r'"digest": "(\w+)"', ran).group(1)
        self.assertIn(f"// Cleared by its run: 0.02 s simulated in double, digest {digest}\n", text)
        self.assertRegex(text, r"\n//   slowest reach of 98 %: <= 0\.001 s required, 0\.00053\d+ s measured\n")
        self.assertIn("//   timing    sampled at a period's start, answered one period later;", text)
        self.assertIn("//   currents  phases, 12 bits over +-20.48 A\n", text)
        self.assertNotIn("NOT CLEARED", text)
        self.assertIn("inline constexpr bool cleared = true; ", text)
        again = self.run_program("export", "header", self.scenario(BOARD)).stdout
        self.assertEqual(text, again, "no date")

    def test_a_header_tells_what_its_run_showed_and_nobody_asked(self):
        """If the settling time T_reg is longer than 9.2 L/R, the proportional gain of the placed loop is negative: 2
        x 4.6/T_reg is smaller than R/L."""
        slow = self.run_program("export", "header", self.scenario(BOARD), "--set", "control.current={settle_s=0.02}", *DESPITE).stdout
        plain = self.run_program("export", "header", self.scenario(BOARD)).stdout
        self.assertIn("gain on the error is negative", slow)
        self.assertNotIn("gain on the error is negative", plain)

    def test_a_header_has_the_window_of_low_side_shunts(self):
        for shunts, mask, modulation in (("ab", 3, 2 * 0.9 - 1), ("abc", 7, 0.4 * 4 / 3**0.5)):
            header = self.run_program("export", "header", self.scenario("gallery/shunts-three"), *DESPITE, "--set", f"sensors.shunts={shunts}").stdout
            self.assertRegex(header, rf"low_side_shunts = {mask}; ")
            duty = re.search(r"low_side_greatest_duty = (\S+);", header).group(1)
            self.assertAlmostEqual(float.fromhex(duty), 1 - 2 * (2e-6 + 0.5e-6) / 50e-6, 12)
            self.assertIn(f"up to a modulation of {modulation:.3g}, where 1 is a phase voltage of U_s/sqrt 3", re.sub(r"\n// +", " ", header))
        self.assertNotIn("low_side", self.run_program("export", "header", self.scenario(BOARD), *DESPITE).stdout)

    def test_the_run_computes_as_the_chip_will(self):
        text = self.run_program("export", "header", self.scenario(BOARD), "--arithmetic", "q15").stdout
        ran = self.run_program("run", self.scenario(BOARD), "--set", "control.arithmetic=q15", "--json", "-").stdout
        self.assertIn(f'in q15, digest {re.search(chr(34) + "digest" + chr(34) + ": .(.{16})", ran).group(1)}', text)

    def test_a_move_that_brakes_stays_within_its_boards_range(self):
        for motor in some(("maxon-200142", "maxon-397172", "maxon-651607"), 1):
            self.run_program("design", motor, "--mode", "position", "--toml", "move.toml", "--force")
            self.assertIn("cleared = true", self.run_program("export", "header", "move.toml").stdout)
            scenario = (self.path / "move.toml").read_text()
            range_A = float(re.search(r"current_range_A = (\S+)", scenario).group(1))
            narrow = f"sensors.current_range_A={range_A / 2}"
            self.assertIn("was exceeded in the run", self.run_program("export", "header", "move.toml", "--set", narrow, code=1).stderr)

    def test_a_requirement_that_fails_is_refused(self):
        told = self.refused(1, BOARD, "--set", "supply.voltage_V=6")
        self.assertEqual(len(told), 1)
        self.assertRegex(told[0], r"^slowest reach of 98 % = 0\.0015\d+ s misses its requirement, <= 0\.001 s; find the cause")

    def test_what_was_never_measured_is_refused_all_at_once_beside_what_fails(self):
        told = self.refused(2, "current-square", "--set", "supply.voltage_V=6", "--set", "pwm.chopping=complementary")
        self.assertEqual([line.split(" ")[0] for line in told],
                         ["sensors.currents", "pwm.delay_periods", "bridge.dead_time_s", "slowest"])

    def test_the_cures_of_an_encoders_position_lead_to_a_header(self):
        """All reasons are printed together, with the command of the design. After these changes the export is not
        refused again."""
        encoder = SOURCE / "data/scenarios/gallery/encoder.toml"
        said = self.run_program("export", "header", str(encoder), "--out", "d.hpp", code=2).stderr
        self.assertIn('sensors.rotor = "encoder" is not supported by the header\'s drive, which reads Hall probes; set rotor = "hall", '
                      "and design gains and [[require]] for Hall edges that are 7.5 deg apart\n", said)
        for cure in ("currents = \"phases\"", "delay_periods = 1", "500e-9", "sixstep design --scenario"):
            self.assertIn(cure, said)
        text = encoder.read_text().replace('rotor = "encoder"\n', 'rotor = "hall"\ncurrents = "phases"\ncurrent_range_A = 40\n')
        text = text.replace('commutation = "sample"', 'commutation = "sample"\ndelay_periods = 1') + "\n[bridge]\ndead_time_s = 500e-9\n"
        (self.path / "hall.toml").write_text(text)
        designed = self.run_program("design", "--scenario", "hall.toml", "--settle", "43e-3", "--quick", "--quiet", "--toml", "new.toml")
        self.assertEqual(designed.stderr, "")
        noted = self.run_program("export", "header", "new.toml", "--out", "d.hpp").stderr
        self.assertTrue(all(line.startswith("note: ") for line in noted.splitlines()), noted)
        self.assertIn("d.hpp", self.names())

    def test_a_fault_is_refused(self):
        told = self.refused(3, "product-broken-hall-line")
        self.assertRegex(told[-1], "the drive tripped by an impossible Hall code, jump or edge: line H2")

    def test_a_scenario_that_asks_for_nothing_is_refused(self):
        text = pathlib.Path(self.scenario(BOARD)).read_text().replace('"current-square.toml"', '"plain.toml"')
        plain = pathlib.Path(self.scenario("current-square")).read_text().split("[[require]]")[0]
        (self.path / "plain.toml").write_text(plain), (self.path / "a.toml").write_text(text)
        told = self.run_program("export", "header", "a.toml", code=2).stderr
        self.assertTrue(told.startswith("a.toml: require is missing: a run without requirements proves nothing; "), told)

    def test_despite_writes_the_reason_and_what_was_overridden_as_comment_alone(self):
        reason = "one bench\n#error two\r*/ \\ \u202e??/\\"
        text = self.run_program("export", "header", self.scenario("current-square"), "--set", "supply.voltage_V=6",
                                "--despite", reason).stdout
        lines = text.splitlines()
        at = lines.index("// NOT CLEARED FOR A BRIDGE. The header was written anyway, for this reason:")
        self.assertEqual(lines[at + 1:at + 3], ["//   one bench\\u000a#error two\\u000d*/ \\ \\u202e", "// This reason overrides these findings:"])
        self.assertEqual([line.split(" ")[3] for line in lines[at + 3:at + 7]],
                         ["sensors.currents", "pwm.delay_periods", "bridge.dead_time_s", "slowest"])
        self.assertIn("inline constexpr bool cleared = false; ", text)
        self.assertRegex(lines[at + 7], r"^// Its run: 0\.02 s simulated in double, digest \w{16}$")
        self.assertNotIn("\u202e", text)
        for line in lines[:lines.index("#pragma once")]:
            self.assertTrue(line.startswith("//") and not line.endswith(("\\", "??/")), line)

    def test_despite_needs_a_reason_and_is_told_where_it_was_not_needed(self):
        told = self.run_program("export", "header", self.scenario(BOARD), "--despite", " \n", code=2).stderr
        self.assertEqual(told, "--despite gives no reason; give the reason for which you write the header anyway; the header quotes this reason\n")
        clear = self.run_program("export", "header", self.scenario(BOARD), *DESPITE)
        self.assertIn("--despite was not needed: the run holds every requirement, and the header states this\n", clear.stderr)
        self.assertIn("Cleared by its run", clear.stdout)


if __name__ == "__main__":
    unittest.main()
