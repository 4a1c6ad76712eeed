#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files of other drive programs: their parameters become a motor file, and their logs agree with a field-oriented
run."""
import csv
import math
import re
import unittest

from program import ProgramTest

PAIRS, R, L, PSI = 7, 0.0468, 2.2e-5, 0.00448
KV = 30 / math.pi / (math.sqrt(3) * PAIRS * PSI)
MOTEUS = f"motor.poles {2 * PAIRS}\nmotor.resistance_ohm {R}\nmotor.inductance_d_H {L}\nmotor.inductance_q_H {L}\nmotor.Kv {KV!r}\n"
SKETCH = f"BLDCMotor motor = BLDCMotor({PAIRS}, {R}, {KV!r}, {L});\n"
RUN = """
motor = "mine"
duration_s = 0.03
[supply]
voltage_V = 24
[pwm]
alignment = "centre"
[control]
drive = "field-oriented"
mode = "current"
[control.current]
limit_A = 20
[reference]
value = 8
[load]
torque_Nm = 0.05
"""


class Parameters(ProgramTest):
    def test_a_file_becomes_a_motor_that_runs_nowhere_until_it_is_whole(self):
        (self.path / "a.cfg").write_text(MOTEUS)
        self.assertIn("sixstep motor check mine.toml", self.run_program("motor", "new", "mine", "--from", "a.cfg").stdout)
        self.assertIn("inertia_kgm2", self.run_program("motor", "check", "mine.toml", code=2).stderr)
        text = (self.path / "mine.toml").read_text()
        (self.path / "mine.toml").write_text(text.replace("value = nan", "value = 9e-5"))
        shown = self.run_program("motor", "show", "mine.toml").stdout
        found = float(re.search(r"K_e +([0-9.]+) mV s", shown)[1])
        self.assertAlmostEqual(found, 1e3 * PAIRS * PSI, delta=0.01)
        self.assertIn("already exists", self.run_program("motor", "new", "mine", "--from", "a.cfg", code=2).stderr)

    def test_a_question_is_answered_by_an_option(self):
        (self.path / "a.ino").write_text(SKETCH)
        told = self.run_program("motor", "new", "mine", "--from", "a.ino", code=2).stderr
        self.assertIn("; --answer resistance=phase (R_s = 0.0468 ohm) or resistance=terminal (R_s = 0.0234 ohm)", told)
        self.assertIn("; --answer kv=line-peak (K_e = 31.36 mV s) or kv=six-step", told)
        self.assertEqual(self.names(), ["a.ino"])
        self.run_program("motor", "new", "mine", "--from", "a.ino", "--answer", "resistance=phase,kv=line-peak")
        self.assertEqual(self.names(), ["a.ino", "mine.toml"])

    def test_hostile_files_leave_no_file(self):
        (self.path / "cut.cfg").write_bytes(b"<MCConfiguration>\n<foc_motor_r>0.01")
        (self.path / "binary").write_bytes(bytes(range(256)) * 64)
        (self.path / "empty").write_bytes(b"")
        (self.path / "nan.cfg").write_text(MOTEUS.replace(repr(R), "nan"))
        for name, said in (("cut.cfg", "ends before its last element"), ("binary", "is not a known parameter file"),
                           ("empty", "is not a known parameter file"), ("nan.cfg", "nan.cfg:2: motor.resistance_ohm = nan must be a number"),
                           ("none", "none"), ("/dev/zero", "/dev/zero"), (".", ".")):
            with self.subTest(name=name):
                made = self.run_program("motor", "new", "mine", "--from", name, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
                self.assertNotIn("mine.toml", self.names())
        self.assertIn("--style", self.run_program("motor", "new", "mine", "--from", "nan.cfg", "--style", "drone", code=2).stderr)
        self.assertIn("answers a question about the file of --from", self.run_program("motor", "new", "mine", "--answer", "kv=six-step", code=2).stderr)
        self.assertIn("sixstep motor new NAME --from nan.cfg", self.run_program("motor", "check", "nan.cfg", code=2).stderr)


class LogsOfAFieldOrientedRun(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "a.cfg").write_text(MOTEUS)
        self.run_program("motor", "new", "mine", "--from", "a.cfg")
        motor = (self.path / "mine.toml").read_text()
        (self.path / "mine.toml").write_text(motor.replace("value = nan", "value = 9e-5") + "nominal_voltage_V = 24\n")
        (self.path / "run.toml").write_text(RUN)
        columns = '"t_s", "speed_rad_s", "torque_Nm", "bus_V", "i_d_A", "i_q_A", "v_d_V", "v_q_V"'
        self.run_program("run", "run.toml", "--set", "record.grid_s=0.0005", "--set", f"record.columns=[{columns}]", "--csv", "trace.csv", "--quiet")
        with open(self.path / "trace.csv", encoding="utf-8") as file:
            self.rows = [{key: float(value) for key, value in row.items()}
                         for row in csv.DictReader(line for line in file if not line.startswith("#"))][:-1]

    def expect_on_the_run(self, head, line, names, *words):
        (self.path / "log.csv").write_text(head + "".join(line(r) for r in self.rows))
        made = self.run_program("run", "run.toml", "--compare", "log.csv", *words)
        self.assertIn("log.csv is a", made.stderr)
        found = {m[1]: m for m in re.finditer(r"^ +(\w+) +(\d+) rows +rms ([0-9.e-]+) ?([mun]?)", made.stdout, re.M)}
        self.assertEqual(set(found), set(names), made.stdout)
        for name, m in found.items():
            rms = float(m[3]) * {"m": 1e-3, "u": 1e-6, "n": 1e-9, "": 1}[m[4]]
            span = max(r[name] for r in self.rows) - min(r[name] for r in self.rows)
            self.assertLess(rms, 1e-4 * max(span, 1), name)
            self.assertEqual(int(m[2]), len(self.rows), made.stdout)

    def test_currents_of_the_axes_are_amplitudes(self):
        """The torque is 3/2 p psi i_q only if i_q is the amplitude of a phase current. VESC, ODrive, moteus and
        SimpleFOC use this definition. Here p is the number of pole pairs and psi the flux linkage."""
        late = self.rows[len(self.rows) // 2:]
        i_q, torque = (sum(r[name] for r in late) / len(late) for name in ("i_q_A", "torque_Nm"))
        self.assertAlmostEqual(torque / (1.5 * PAIRS * PSI * i_q), 1.0, delta=0.02)

    def test_they_lie_on_the_run(self):
        turn, axes = 2 * math.pi, ("i_d_A", "i_q_A")
        self.expect_on_the_run(
            "ms_today;input_voltage;current_motor;current_in;d_axis_current;q_axis_current;erpm;duty_cycle;d_axis_voltage;q_axis_voltage;\n",
            lambda r: f"{1e3 * r['t_s']:.4f};{r['bus_V']};9;9;{r['i_d_A']};{r['i_q_A']};{r['speed_rad_s'] * PAIRS * 30 / math.pi!r};0.5;{r['v_d_V']};{r['v_q_V']};\n",
            ("speed_rad_s", "bus_V", "v_d_V", "v_q_V", *axes), "--shift", "0")
        self.expect_on_the_run("time [s],vel_estimate,Iq_measured,Id_measured,vbus_voltage\n",
                               lambda r: f"{r['t_s']:.7f},{r['speed_rad_s'] / turn!r},{r['i_q_A']},{r['i_d_A']},{r['bus_V']}\n",
                               ("speed_rad_s", "bus_V", *axes), "--shift", "0")
        self.expect_on_the_run("time,MODE,POSITION,VELOCITY,TORQUE,Q_CURRENT,D_CURRENT,VOLTAGE,TEMPERATURE,FAULT\n",
                               lambda r: f"{r['t_s']:.7f},10,0,{r['speed_rad_s'] / turn!r},{r['torque_Nm']},{r['i_q_A']},{r['i_d_A']},{r['bus_V']},30,0\n",
                               ("speed_rad_s", "bus_V", "torque_Nm", *axes), "--shift", "0")
        self.expect_on_the_run("MOT: Ready.\n",
                               lambda r: f"8\t{r['v_q_V']}\t{r['v_d_V']}\t{1e3 * r['i_q_A']!r}\t{1e3 * r['i_d_A']!r}\t{r['speed_rad_s']}\t0\n",
                               ("speed_rad_s", "v_d_V", "v_q_V", *axes), "--shift", "0", "--interval", "0.0005")

    def test_a_log_of_four_escs_asks_for_one(self):
        head = "TimeUS,Instance,RPM,RawRPM,Volt,Curr\n"
        def line(r):
            return "".join(f"{1e6 * r['t_s'] + n:.0f},{n},{r['speed_rad_s'] * 30 / math.pi * (1 if n == 2 else 3)!r},0,{r['bus_V']},1\n" for n in range(4))
        (self.path / "log.csv").write_text(head + "".join(map(line, self.rows)))
        told = self.run_program("run", "run.toml", "--compare", "log.csv", code=2)
        self.assertIn("--esc is missing: log.csv has rows of 4 ESCs; choose one: 0, 1, 2, 3", told.stderr)
        made = self.run_program("run", "run.toml", "--compare", "log.csv", "--esc", "2", "--shift", "0").stdout
        self.assertLess(float(re.search(r"speed_rad_s +\d+ rows +rms ([0-9.]+) rad/s", made)[1]), 0.01)  # 2 us at 3600 rad/s2
        other = self.run_program("run", "run.toml", "--compare", "log.csv", "--esc", "1", "--shift", "0").stdout
        self.assertGreater(float(re.search(r"speed_rad_s +\d+ rows +rms ([0-9.]+) rad/s", other)[1]), 50)


if __name__ == "__main__":
    unittest.main()
