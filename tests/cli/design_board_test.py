#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep design --scenario: the settings of the board's scenario that a design keeps, the settings that it loses,
and the messages about both."""
import json
import pathlib
import re
import tomllib
import unittest

from program import SOURCE, ProgramTest, some


class DesignForABoard(ProgramTest):
    BOARD = """
motor = "maxon-251601"
duration_s = 0.1
supply = {voltage_V = 24, resistance_ohm = 0.05, capacitance_F = 1e-3}
bridge = {dead_time_s = 0.5e-6}
pwm = {chopping = "complementary", delay_periods = 1}
sensors = {currents = "phases", current_range_A = 10, bus = "adc", bus_range_V = 40, rotor = "hall"}
reference = {value = 100}
"""

    def designed_for(self, text, *options, code=0):
        """The text of the design for a board, and the scenario that the design wrote."""
        (self.path / "board.toml").write_text(text)
        told = self.run_program("design", "--scenario", "board.toml", "--quick", "--toml", "d.toml", "--force", *options, code=code).stdout
        return told, tomllib.loads((self.path / "d.toml").read_text())

    def test_a_protected_board_keeps_its_limit_and_its_protection(self):
        board = self.BOARD + """
[control]
drive = "product"
mode = "speed"
current = {settle_s = 1e-3, damping = 0.9, limit_A = 3}
speed = {settle_s = 0.1, damping = 0.9}
[protection]
over_current_A = 4
over_voltage_V = 30
under_voltage_V = 18
over_speed_rad_s = 300
"""
        told, written = self.designed_for(board)
        self.assertRegex(told, "^(good|usable)")
        self.assertEqual((written["control"]["drive"], written["control"]["current"]["limit_A"]), ("product", 3))
        self.assertEqual(written["protection"]["over_current_A"], 4)
        self.assertNotIn("not_usable", written)
        self.assertNotIn("the usual value of small bridges", (self.path / "d.toml").read_text())
        # If the current limit is above the trip level, the text and the file name the same omitted parts.
        told, written = self.designed_for(board.replace("limit_A = 3", "limit_A = 8"), code=1)
        self.assertIn("NOT USABLE: of the board's scenario are left out: ", told)
        self.assertIn("control.drive and [protection]", written["not_usable"])

    def test_what_a_design_leaves_out_of_a_board_is_named(self):
        told, written = self.designed_for(self.BOARD + """
load = {coulomb_Nm = 1e-3}
heat = {motor = true}
[control]
mode = "speed"
slew = 1000
current = {settle_s = 1e-3, damping = 0.6, back_emf_feed_forward = true}
speed = {settle_s = 0.1, damping = 0.95, torque_limit_Nm = 0.15}
""")
        self.assertIn("the design does not use these keys of the board's scenario: control.slew, heat.motor, load.coulomb_Nm\n", told)
        self.assertEqual((written["control"]["current"]["damping"], written["control"]["speed"]["damping"]), (0.6, 0.95))
        self.assertTrue(written["control"]["current"]["back_emf_feed_forward"])

    HELD = BOARD.replace("delay_periods = 1", "delay_periods = 1, period_s = 15e-6") + """
[control]
drive = "product"
mode = "MODE"
current = {settle_s = 1e-3, damping = 0.9, limit_A = 4}
speed = {settle_s = 0.1, damping = 0.9}
limits = {LIMITS}
[protection]
over_current_A = 6
over_voltage_V = 30
under_voltage_V = 18
over_speed_rad_s = OVER
"""

    def test_what_the_boards_drive_changes_is_told_as_the_file_runs(self):
        """The product drive first measures the offsets of its current sensors. Thus the current settles later after a
        step."""
        told, _ = self.designed_for(self.HELD.replace("MODE", "current").replace("LIMITS", "").replace("OVER", "300").replace("value = 100", "value = 2"))
        line = re.search(r"the designed file keeps control.drive and \[protection\] of the board's scenario, so that its run shows (.*)", told).group(1)
        run = json.loads(self.run_program("run", "d.toml", "--json", "-", code=None).stdout)
        ran = {c["figure"]: c["measured"] for c in run["compare"]}
        named = [(figure, float(value) * (1e-3 if unit == "ms" else 1)) for figure, value, unit in
                 re.findall(r"(?:^|, )([a-z ]+) (\S+) (ms|s|rad/s|A) instead of \S+ \3(?=,|$)", line)]
        self.assertIn("settling time", [name for name, _ in named])
        for name, value in named:
            self.assertAlmostEqual(value, ran[name], delta=0.005 * abs(ran[name]), msg=name)

    def test_the_test_asks_for_what_the_board_allows(self):
        """The nominal current is 2.33 A. Once the design's test asked for more than the board allows: the design was
        called NOT USABLE, and its file lost all protection."""
        for mode, limits, over, most in (("current", "current_A = 1.5", 300, 1.5), ("current", "torque_Nm = 0.045", 300, 0.045 / 0.0335),
                                         ("speed", "current_A = 1.5", 300, None), ("speed", "torque_Nm = 0.06", 300, None),
                                         ("speed", "speed_rad_s = 120", 300, 120), ("speed", "", 130, 130)):
            with self.subTest(mode=mode, limits=limits, over=over):
                board = self.HELD.replace("MODE", mode).replace("LIMITS", limits).replace("OVER", str(over))
                told, written = self.designed_for(board if mode == "speed" else board.replace("value = 100", "value = 1"))
                self.assertRegex(told, "^(good|usable)")
                self.assertEqual((written["control"]["drive"], written["protection"]["over_speed_rad_s"]), ("product", over))
                self.assertEqual(written["control"].get("limits", {}), tomllib.loads(board)["control"]["limits"])
                asked = written["reference"].get("values") or [written["reference"]["value"]]
                self.assertLessEqual(max(asked), (most or 1e9) * (1 + 1e-9))
                if mode == "speed":
                    self.assertEqual(written["control"]["current"]["limit_A"], 4)

    def test_a_threshold_that_a_motor_of_the_tolerances_passes_is_not_usable(self):
        board = self.HELD.replace("MODE", "speed").replace("LIMITS", "").replace("OVER", "300").replace("limit_A = 4", "limit_A = 9")
        (self.path / "board.toml").write_text(board.replace("over_current_A = 6", "over_current_A = 100").replace("current_range_A = 10", "current_range_A = 120"))
        told = self.run_program("design", "--scenario", "board.toml").stdout
        nominal, worst = map(float, re.findall(r"peak current of the start +(\S+) A +(\S+) A  ", told)[-1])
        between = 0.99 * worst
        self.assertGreater(worst, 1.01 * nominal)
        (self.path / "board.toml").write_text(board.replace("over_current_A = 6", f"over_current_A = {between:.4g}"))
        told = self.run_program("design", "--scenario", "board.toml", code=1).stdout
        self.assertRegex(told, "NOT USABLE: .*the drive trips within the tolerances: the peak current of the start is ")

    def test_crossed_wires_are_named_as_the_cause(self):
        drive = """
[control]
mode = "speed"
current = {settle_s = 1e-3, damping = 0.9}
speed = {settle_s = 0.1, damping = 0.9}
"""
        crossed = self.BOARD.replace('rotor = "hall"', 'rotor = "hall", hall_lines = "213"')
        told, _ = self.designed_for(crossed + drive, code=1)
        self.assertIn('set sensors.hall_lines = "123" and bridge.phases = "abc"', told)

    def test_a_limit_of_the_current_bounds_what_is_warned_of(self):
        """The limit is 3 A. This is 1.29 times the nominal current, and less than the 5.83 A at full torque."""
        told, _ = self.designed_for(self.BOARD + """
[control]
mode = "speed"
current = {settle_s = 1e-3, damping = 0.9, limit_A = 3}
speed = {settle_s = 0.05, damping = 0.9, torque_limit_Nm = 0.5}
""")
        self.assertRegex(told, r"peak current of the start +3 A .* at the limit of the current")
        self.assertNotIn("the speed loop may command", told)

    def test_the_speed_that_a_position_may_ask_for_is_the_boards(self):
        _, written = self.designed_for(self.BOARD.replace("value = 100", "value = 1000") + """
[control]
mode = "position"
current = {settle_s = 1e-3, damping = 0.9}
speed = {settle_s = 0.1, damping = 0.9}
position = {gain_rad_s_per_deg = 0.1, speed_limit_rad_s = 50}
""", code=None)
        self.assertEqual(written["control"]["position"]["speed_limit_rad_s"], 50)

    def test_another_mode_than_the_scenarios_keeps_each_loops_own_settling_time(self):
        scenarios = SOURCE / "data" / "scenarios"
        for name, mode, settle_s in (("firmware/cortex-m", "current", 1e-3), ("firmware/cortex-m", "speed", 1e-3), ("current-square-board", "speed", 1e-3)):
            self.run_program("design", "--scenario", str(scenarios / f"{name}.toml"), "--mode", mode, "--quick", "--quiet", "--toml", "d.toml", "--force")
            self.assertEqual(tomllib.loads((self.path / "d.toml").read_text())["control"]["current"]["settle_s"], settle_s, (name, mode))

    def test_a_boards_protection_stays_in_the_file_or_stops_its_header(self):
        scenarios = SOURCE / "data" / "scenarios"
        self.run_program("design", "--scenario", str(scenarios / "firmware" / "cortex-m.toml"), "--mode", "speed", "--quick", "--quiet", "--toml", "kept.toml")
        board, kept = (tomllib.loads(path.read_text()) for path in (scenarios / "firmware" / "cortex-m.toml", self.path / "kept.toml"))
        for key in ("off_at_s", "voltage_samples"):  # off_at_s belongs to the board's own test, and voltage_samples has its default value
            board["protection"].pop(key, None)
        self.assertEqual(kept["protection"], board["protection"])
        self.assertEqual(kept["control"]["drive"], "product")
        self.run_program("export", "header", "kept.toml", "--arithmetic", "q15", "--out", "kept.hpp")
        self.assertIn("over_current_A", (self.path / "kept.hpp").read_text())
        self.run_program("design", "--scenario", str(scenarios / "gallery" / "sensorless-start.toml"), "--quick", "--quiet", "--toml", "lost.toml")
        self.assertIn("sensorless", tomllib.loads((self.path / "lost.toml").read_text())["not_usable"])
        self.run_program("export", "header", "lost.toml", "--arithmetic", "float", "--out", "lost.hpp", code=2)

    def test_what_the_designs_own_test_replaces_is_told_by_design_and_header(self):
        """In the designed file, the test of the design replaces the board's reference and requirements. The header's
        limit of the setpoint is the largest reference of the designed file."""
        name = str(SOURCE / "data" / "scenarios" / "firmware" / "cortex-m.toml")
        board = tomllib.loads(pathlib.Path(name).read_text())
        told = self.run_program("design", "--scenario", name, "--quick", "--toml", "d.toml").stdout
        self.assertNotIn("in place of the board's", self.run_program("design", "--scenario", name, "--quick").stdout)
        self.run_program("export", "header", "d.toml", "--out", "d.hpp")
        header, written = (self.path / "d.hpp").read_text(), tomllib.loads((self.path / "d.toml").read_text())
        limit = float(re.search(r"setpoint_limit = \S+ +// (\S+) rad/s", header)[1])
        for text in (told, header, written["notes"]):
            line = re.search("in place of the board's (.*)", text)[1]
            before, now = map(float, re.search(r"reference \(at most (\S+), now (\S+) rad/s\)", line).groups())
            self.assertEqual((before, now), (max(board["reference"]["values"]), limit))
            before, now = map(float, re.search(r"load.torque_Nm \((\S+), now (\S+)\)", line).groups())
            self.assertEqual(before, board["load"]["torque_Nm"])
            self.assertAlmostEqual(now, written["load"]["torque_Nm"], delta=1e-6)
            for requirement in board["require"]:
                self.assertIn(requirement["label"], line)

    def test_what_only_the_boards_drive_looks_at_is_no_obstacle(self):
        for name in some(("hall-glitch", "sensorless-comparators", "hall-glitches"), 1):
            scenario = str(SOURCE / "data" / "scenarios" / "gallery" / f"{name}.toml")
            self.assertNotIn("set control.drive", self.run_any("design", "--scenario", scenario, "--quick").stderr)

    def test_a_loop_that_is_unstable_within_the_tolerances_is_not_usable(self):
        board = str(SOURCE / "data" / "scenarios" / "firmware" / "cortex-m.toml")
        text = self.run_program("design", "--scenario", board, "--mode", "speed", "--current-settle", "0.25e-3", code=1).stdout
        self.assertRegex(text.splitlines()[0], "^NOT USABLE: with one period of delay the current loop has a phase margin of [0-9.]+ degrees, less than 20")
        self.assertIn("- GRAVE: within the tolerances the current loop is unstable: with L -20 %", text)
        self.assertNotIn("-0 deg", text)


if __name__ == "__main__":
    unittest.main()
