#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run --compare LOG: the trace of a run, converted to the units of a board and with a wrong clock, agrees
with the run."""
import csv
import math
import re
import unittest

from program import SOURCE, ProgramTest

SCENARIO = str(SOURCE / "data/scenarios/firmware/avr.toml")


class LogTest(ProgramTest):
    def found(self, text):
        return {m[1]: (int(m[2]), float(m[3]) * {"m": 1e-3, "u": 1e-6, "n": 1e-9, "": 1}[m[4]])
                for m in re.finditer(r"^ +(\w+) +(\d+) rows +rms ([0-9.e-]+) ?([munp]?)", text, re.M)}


class BoardLog(LogTest):
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

    def test_a_log_lies_on_its_run(self):
        self.write_log()
        made = self.run_program("run", SCENARIO, "--compare", "log.csv", "--shift", "0", code=0)
        found = self.found(made.stdout)
        self.assertEqual(set(found), {"i_m_A", "speed_rad_s"}, made.stdout)
        self.assertRegex(made.stdout, r"\n +hall +123 rows +0 differ\n")
        self.assertEqual(found["i_m_A"][0], 123)
        self.assertLess(found["i_m_A"][1], 0.6e-3)  # the log shows the current in whole mA
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
        for word in ("A board's log over its simulation", "recorded on a board", "Log of the board minus the simulation", "log.csv"):
            self.assertIn(word, page)

    def test_refuses_with_a_way_out(self):
        self.write_log()
        (self.path / "bad.csv").write_text("t [us],i_m [V]\n1,2\n2,3\n")
        for words, said in (((SCENARIO, "--compare", "none.csv"), "none.csv"),
                            ((SCENARIO, "--compare", "bad.csv"), "but A is expected"),
                            ((SCENARIO, SCENARIO, "--compare", "log.csv"), "name one scenario"),
                            ((SCENARIO, "--compare", "log.csv", "--csv", "x.csv"), "--html FILE as the only output"),
                            ((SCENARIO, "--compare", "log.csv", "--out", "d"), "--html FILE as the only output"),
                            ((SCENARIO, "--shift", "1"), "--compare"),
                            ((SCENARIO, "--compare", "log.csv", "--vary", "supply.voltage_V=20:28:3"), "--only N")):
            with self.subTest(words=words[1:]):
                made = self.run_program("run", *words, code=2)
                self.assertIn(said, made.stderr)


RUN = """
motor = "hoverboard-hub"
duration_s = 0.3
[supply]
voltage_V = 36
[control]
mode = "duty"
[reference]
value = 0.4
[record]
grid_s = 0.003
columns = ["t_s", "speed_rad_s", "i_m_A", "bus_V", "duty", "u_a_V", "u_ab_V"]
"""
PAIRS = 15
RPM = 30 / 3.141592653589793


class LogsOfOthers(LogTest):
    """The same run, as the logs of several drive makers record it."""

    def setUp(self):
        super().setUp()
        self.record(RUN)

    def record(self, scenario):
        (self.path / "run.toml").write_text(scenario)
        self.run_program("run", "run.toml", "--csv", "trace.csv", "--quiet", "--force")
        with open(self.path / "trace.csv", encoding="utf-8") as file:
            self.rows = [{key: float(value) for key, value in row.items()}
                         for row in csv.DictReader(line for line in file if not line.startswith("#"))][:-1]

    def log(self, head, row):
        (self.path / "log.csv").write_text(head + "".join(row(n, r) for n, r in enumerate(self.rows)), encoding="latin-1")

    def compared(self, *words, code=0):
        made = self.run_program("run", "run.toml", "--compare", "log.csv", *words, code=code)
        return self.found(made.stdout), made.stdout + made.stderr

    def expect_right(self, *words, columns=("speed_rad_s", "i_m_A")):
        found, text = self.compared(*words)
        self.assertEqual(set(found), set(columns), text)
        for name in columns:
            self.assertEqual(found[name][0], len(self.rows), text)
        self.assertLess(found["speed_rad_s"][1], 0.01)  # the resolutions of 0.1 rpm and of the eRPM are smaller
        # Half of the resolution of 0.01 A, and the error of the interpolation between the rows.
        self.assertLess(found["i_m_A"][1], 0.006)
        self.assertNotIn("moved by", text)
        return text

    def test_a_log_of_the_very_same_run_stays_where_it_is(self):
        self.log("t [ms],speed [rpm],i_m [mA]\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f},{1e3 * r['i_m_A']:.2f}\n")
        found, text = self.compared()
        self.assertLess(found["i_m_A"][1], 0.3e-3, text)
        self.assertNotIn("moved by", text)
        self.assertEqual(found["i_m_A"][0], len(self.rows))

    def test_turns_per_second_and_a_micro_sign_of_another_encoding(self):
        self.log("t [\xb5s],speed [turn/s],i_m [mA]\n", lambda n, r: f"{1e6 * r['t_s']:.0f},{r['speed_rad_s'] * RPM / 60:.5f},{1e3 * r['i_m_A']:.2f}\n")
        self.expect_right()

    def test_electrical_speed_by_the_motors_pole_pairs(self):
        self.log("t [ms],speed [erpm],i_m [mA]\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM * PAIRS:.1f},{1e3 * r['i_m_A']:.2f}\n")
        self.expect_right()

    def test_vesc(self):
        head = "ms_today;input_voltage;temp_mos_max;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;tacho_meter;\n"
        self.log(head, lambda n, r: f"{36000000 + 1e3 * r['t_s']:.0f};36.00;31.2;{r['i_m_A']:.2f};0;0.01;0;{r['speed_rad_s'] * RPM * PAIRS:.1f};0.400;{n};\n")
        text = self.expect_right(columns=("speed_rad_s", "i_m_A", "bus_V", "duty"))
        self.assertIn("log.csv is a VESC Tool log: time = ms_today/1000, speed = erpm*2*pi/60/15, bus_V = input_voltage, i_m = current_motor, "
                      "duty = duty_cycle\n", text)
        self.assertIn("current_in (a mean over PWM periods; the simulation has the current of each pulse)", text)
        text = self.expect_right("--columns", "time=ms_today/1000,speed=erpm*2*pi/60/15,i_m=current_motor")
        self.assertIn("the log's clock starts at 36000 s; times are counted from the log's first row", text)
        self.assertIn("not used: input_voltage, temp_mos_max, current_in, d_axis_current, q_axis_current, duty_cycle, tacho_meter (not named)", text)

    def test_vesc_in_reverse(self):
        """Its motor current in blocks is positive while the motor drives, torque times speed above 0."""
        self.record(RUN.replace("value = 0.4", "value = -0.4"))
        head = "ms_today;input_voltage;current_motor;erpm;duty_cycle;\n"
        self.log(head, lambda n, r: f"{1e3 * r['t_s']:.0f};36.00;{math.copysign(1, r['i_m_A'] * r['speed_rad_s']) * abs(r['i_m_A']):.2f};{r['speed_rad_s'] * RPM * PAIRS:.1f};-0.400;\n")
        text = self.expect_right(columns=("speed_rad_s", "i_m_A", "bus_V", "duty"))
        self.assertIn("rows with erpm below 0, i_m = -current_motor", text)

    def test_a_move_at_the_end_of_its_range_is_told(self):
        """A clock that is 1.2 ms late, where 20 PWM periods are 0.6 ms."""
        self.log("t [ms],speed [rpm],i_m [mA]\n",
                 lambda n, r: f"{1e3 * r['t_s'] - 1.2:.1f},{r['speed_rad_s'] * RPM:.1f},{1e3 * r['i_m_A']:.2f}\n")
        told = "was tried, and the best one is the largest: the clocks may differ by more; give --shift"
        self.assertIn(told, self.compared()[1])
        found, text = self.compared("--shift", "0.0012")
        self.assertNotIn(told, text)
        self.assertLess(found["i_m_A"][1], 0.3e-3, text)

    def test_ardupilot(self):
        self.log("TimeUS,Instance,RPM,RawRPM,Volt,Curr,Temp\n",
                 lambda n, r: f"{12000000 + 1e6 * r['t_s']:.0f},0,{r['speed_rad_s'] * RPM:.1f},0,36,{r['i_m_A']:.2f},31\n")
        self.expect_right("--columns", "time=TimeUS/1e6,speed=RPM*pi/30,i_m=Curr")

    def test_blackbox(self):
        self.log("loopIteration, time (us), rcCommand[0], eRPM[0], amperageLatest (A)\n",
                 lambda n, r: f"{8 * n}, {5000000 + 1e6 * r['t_s']:.0f}, 0, {r['speed_rad_s'] * RPM * PAIRS / 100:.3f}, {r['i_m_A']:.2f}\n")
        self.expect_right("--columns", "time=time,speed=eRPM[0]*100*2*pi/60/15,i_m=amperageLatest")

    def test_simplefoc_has_neither_head_nor_time(self):
        self.log("MOT: Monitor enabled!\nMOT: Init\nMOT: Ready.\n",
                 lambda n, r: f"5.0000\t14.4000\t0.0000\t{1e3 * r['i_m_A']:.4f}\t0.0000\t{r['speed_rad_s']:.4f}\t0.1\n")
        self.assertIn("is a SimpleFOC monitor log, which has no time; give the interval of the rows", self.compared(code=2)[1])
        self.assertIn("speed_rad_s", self.compared("--interval", "0.003")[0], "by the order of its bits")
        self.expect_right("--interval", "0.003", "--columns", "speed=column 6,i_m=column 4/1000")

    def test_what_the_board_said_between_the_rows_is_told(self):
        self.log("t [ms],speed [rpm],i_m [mA],missed\n", lambda n, r: "# fault: over-current\n" * (n == 20) +
                 f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f},{1e3 * r['i_m_A']:.2f},{int(n == 3)}\n")
        text = self.expect_right()
        self.assertIn('line 22 says "fault: over-current"', text)
        self.assertIn("1 row says that the board missed up to 1 control periods", text)
        self.assertNotIn("not used", text)

    def test_a_broken_formula_is_no_other_one(self):
        self.log("t [ms],erpm,i_m [mA]\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM * PAIRS:.1f},{1e3 * r['i_m_A']:.2f}\n")
        for formula, place in (("speed=erpm*", 11), ("speed=*erpm", 7), ("speed=erpm**2", 11), ("speed=erpm*2*pi/60/8*", 21)):
            self.assertIn(f"--columns = {formula} lacks a constant or a column beside the * at character {place}",
                          self.compared("--columns", formula, code=2)[1])

    def test_an_interval_beside_a_time_must_agree(self):
        self.log("t [ms],speed [rpm],i_m [mA]\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f},{1e3 * r['i_m_A']:.2f}\n")
        self.expect_right("--interval", "0.003")
        named = ("--columns", "time=t/1000,speed=speed,i_m=i_m")
        self.expect_right("--interval", "0.003", *named)
        for words in ((), named):
            self.assertIn("contradicts the given interval of 0.006 s", self.compared("--interval", "0.006", *words, code=2)[1])

    def test_a_scopes_record_of_terminals(self):
        self.log("Time (s),CH1 (V),CH2 (V)\n", lambda n, r: f"{r['t_s']:.6f},{r['u_a_V']:.3f},{r['u_ab_V']:.3f}\n")
        found, text = self.compared("--shift", "0", "--columns", "u_a=CH1,u_ab=CH2")
        self.assertEqual(set(found), {"u_a_V", "u_ab_V"}, text)
        self.assertLess(found["u_a_V"][1], 1e-3, text)
        self.assertLess(found["u_ab_V"][1], 1e-3, text)

    def test_columns_that_are_not_compared_are_named(self):
        self.log("t [ms],speed_rpm,rpm,current,note\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f},1,2,x\n")
        found, text = self.compared()
        self.assertEqual(set(found), {"speed_rad_s"}, text)
        self.assertIn("not used: rpm, current (the simulation has no such column), note (holds no numbers)", text)

    def test_what_cannot_be_compared_exits_2(self):
        good = [f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f}\n" for r in self.rows]
        for head, rows, words, said in (
                ("t [ms],speed [counts]\n", good, (), 'has the heading speed in "counts", which is not a unit; rad/s is expected; units that fit: rad/s, '),
                ("t [ms],speed [Hz]\n", good, (), 'has the heading speed in Hz, but rad/s is expected; name another column; write rev/s for turns of the shaft'),
                ("t [foo],speed [rpm]\n", good, (), 'has the heading t in "foo", which is not a unit; s is expected'),
                ("t [s],speed [rpm]\n", good, (), "has 1 of 100 rows in the simulated time, 0 to 0.3 s; the log covers 0 to 297 s, and 5 are needed"),
                ("t [ms],speed [rpm]\n", good[:4], (), "has 4 of 4 rows"),
                ("t [ms],speed [rpm]\n", [*good[:5], "15.0,OL\n", *good[6:]], (), 'log.csv:7: speed "OL" is not a number'),
                ("t [ms],speed [rpm],speed [rpm]\n", [row[:-1] + ",1\n" for row in good], (), "has two columns of speed_rad_s"),
                ("t [ms],speed [rpm]\n", good, ("--columns", "sped=speed"), "--columns = sped is not a column of the simulation; did you mean speed"),
                ("t [ms],speed [rpm]\n", good, ("--columns", "speed"), "--columns = speed must be NAME=COLUMN"),
                ("t [ms],speed [rpm]\n", good, ("--columns", "speed=sped"), 'has no column "sped"; did you mean "speed"?'),
                ("t [ms],speed [rpm]\n", good, ("--columns", "speed=speed,speed=t"), "--columns = speed is named twice"),
                ("t [ms],speed [rpm]\n", good, ("--interval", "0"), "--interval = 0 must be above 0")):
            with self.subTest(said):
                (self.path / "log.csv").write_text(head + "".join(rows))
                text = self.compared(*words, code=2)[1]
                self.assertIn(said, text)
                self.assertNotIn("rms", text)

    def test_missed_periods_are_told(self):
        self.log("t [ms],speed [rpm],missed\n", lambda n, r: f"{1e3 * r['t_s']:.1f},{r['speed_rad_s'] * RPM:.1f},{2 if n == 7 else 0}\n")
        self.assertIn("1 row says that the board missed up to 2 control periods", self.compared()[1])


if __name__ == "__main__":
    unittest.main()
