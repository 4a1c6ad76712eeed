#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random motors of the kinds that exist. The scenario that sixstep new writes runs quickly and passes, in every mode.
The design calls its drive usable, or gives an advice that makes it usable. SIXSTEP_DRAWN_MOTORS is the number of
motors, SIXSTEP_SEED the seed."""
import json
import math
import os
import random
import re
import resource
import unittest

from program import ProgramTest, some

MODES = ("speed", "current", "position", "duty")
COUNT, SEED = int(os.environ.get("SIXSTEP_DRAWN_MOTORS", "4")), int(os.environ.get("SIXSTEP_SEED", "1"))
QUICK = 4  # number of random motors in the usual tests, one per mode; with more motors each also gets a design
LONGEST_S = 20.0  # limit of the CPU time on all cores, without optimisation; the error that this detects took minutes

# For each kind, the ranges of pole pairs, bus in V, no-load speed in rad/s, L/R in s, mechanical time constant R J/K_t^2 in s,
# stall current in A, and the ratio of nominal and stall current.
KINDS = {
    "slotless":   ((1, 2), (12, 48), (700, 6000), (5e-5, 2.5e-4), (2e-3, 1.5e-2), (5, 100), (0.04, 0.15)),
    "flat":       ((4, 12), (12, 48), (250, 1000), (2e-4, 1e-3), (5e-3, 5e-2), (5, 60), (0.05, 0.2)),
    "slotted":    ((2, 5), (24, 60), (250, 900), (4e-4, 2e-3), (2e-3, 2e-2), (10, 100), (0.08, 0.25)),
    "drone":      ((6, 14), (8, 50), (500, 3000), (1.5e-4, 6e-4), (4e-3, 3e-2), (80, 600), (0.04, 0.15)),
    "hub":        ((10, 30), (24, 60), (20, 60), (1e-3, 4e-3), (1e-2, 1.5e-1), (50, 300), (0.05, 0.15)),
    "industrial": ((3, 5), (48, 320), (250, 700), (2e-3, 8e-3), (1e-3, 1e-2), (20, 150), (0.1, 0.25)),
}


def between(draw, ends):
    return math.exp(draw.uniform(math.log(ends[0]), math.log(ends[1])))


def drawn_sheet(draw, name):
    kind = draw.choice(list(KINDS))
    pole_pairs, bus, speed, electrical, mechanical, stall, part = KINDS[kind]
    U, w, I = between(draw, bus), between(draw, speed), between(draw, stall)
    R, K = U / I, U / w
    nominal = between(draw, part) * I
    no_load = between(draw, (0.01, 0.1)) * nominal
    lines = [f'name = "{name}, {kind}"', f"pole_pairs = {draw.randint(*pole_pairs)}",
             f'back_emf = "{draw.choice(("sine", "trapezoid"))}"', f"nominal_voltage_V = {U:.3g}",
             f'resistance_ohm = {{ value = {R:.3g}, frame = "terminal" }}',
             f'inductance_mH = {{ value = {1e3 * R * between(draw, electrical):.3g}, frame = "terminal" }}',
             f"torque_constant_mNm_A = {1e3 * K:.3g}",
             f"inertia_gcm2 = {1e7 * between(draw, mechanical) * K * K / R:.3g}",
             f"no_load_current_mA = {1e3 * no_load:.3g}",
             f"no_load_speed_rpm = {(U - R * no_load) / K * 30 / math.pi:.3g}"]
    if draw.random() < 0.85:
        lines.append(f'nominal_current_A = {{ value = {nominal:.3g}, frame = "terminal" }}')
    return "\n".join(lines) + "\n"


def computing_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


# Motors for which `sixstep new` once wrote no scenario, or needed minutes: small time constants, one pole pair, a slow wheel, a
# drone's reactance.
FOUND = {
    "small": """pole_pairs = 2
back_emf = "sine"
nominal_voltage_V = 24
resistance_ohm = { value = 1.6, frame = "terminal" }
inductance_uH = { value = 224, frame = "terminal" }
torque_constant_mNm_A = 40.2
inertia_gcm2 = 29
no_load_speed_rpm = 5600
no_load_current_mA = 148
coulomb_friction_mNm = 1.0
nominal_current_A = { value = 1.6, frame = "terminal" }
""",
    "slotless": """pole_pairs = 1
back_emf = "sine"
nominal_voltage_V = 24
resistance_ohm = { value = 0.386, frame = "terminal" }
inductance_uH = { value = 28, frame = "terminal" }
torque_constant_mNm_A = 7.16
inertia_gcm2 = 3.0
no_load_speed_rpm = 31900
no_load_current_mA = 270
nominal_current_A = { value = 4.6, frame = "terminal" }
""",
    "wheel": """pole_pairs = 23
back_emf = "sine"
nominal_voltage_V = 36
resistance_ohm = { value = 0.19, frame = "terminal" }
inductance_mH = { value = 0.42, frame = "terminal" }
speed_constant_rpm_V = { value = 8.9, frame = "six-step" }
inertia_kgm2 = 0.05
no_load_current_mA = 800
nominal_current_A = { value = 12, frame = "terminal" }
""",
    "drone": """winding = "12N14P"
back_emf = "sine"
nominal_voltage_V = 24
speed_constant_rpm_V = { value = 1900, frame = "line-peak" }
resistance_mohm = { value = 32, frame = "terminal" }
inductance_uH = { value = 12, frame = "terminal" }
inertia_gcm2 = 45
no_load_voltage_V = 10
no_load_current_mA = 2000
nominal_current_A = { value = 30, frame = "terminal" }
""",
}


class MotorTest(ProgramTest):
    def new_runs(self, motor, mode):
        before = computing_s()
        self.run_program("new", f"{motor}-{mode}", "--motor", f"{motor}.toml", "--mode", mode)
        self.assertLess(computing_s() - before, LONGEST_S)
        self.run_program("run", f"{motor}-{mode}.toml", "--quiet")

    def design_leads_on(self, motor, mode):
        first = self.run_any("design", f"{motor}.toml", "--mode", mode)
        if first.returncode == 0:
            self.assertEqual(first.stderr, "")
            self.assertRegex(first.stdout, "^(good|usable)")
            return
        if first.returncode == 2:  # a position for which no gain was found
            advised = re.findall(r"has no gain without overshoot.*; use (.*)$", first.stderr)
        else:
            self.assertRegex(first.stdout, "^NOT USABLE: ")
            advised = re.findall(r"(?m)^    usable with (.*)$", first.stdout)
        if not advised and (choke := re.search(r" a choke of (\S+) mH in each motor lead", first.stdout + first.stderr)):
            return self.chokes_help(motor, mode, float(choke.group(1)))
        self.assertEqual(len(advised), 1, first.stdout + first.stderr)
        words = advised[0].replace(" and ", " ").split()
        self.assertRegex(self.run_program("design", f"{motor}.toml", "--mode", mode, *words).stdout, "^(good|usable)")

    def chokes_help(self, motor, mode, choke_mH):
        """A choke in each of two driven phases is in series with the winding. With these chokes the ripple is not a
        reason for the verdict."""
        sheet = (self.path / f"{motor}.toml").read_text()
        changed = re.sub(r"(inductance_mH = { value = )(\S+?),", lambda found: f"{found[1]}{float(found[2]) + 2 * choke_mH:.6g},", sheet)
        self.assertNotEqual(changed, sheet)
        (self.path / f"{motor}-choke.toml").write_text(changed)
        self.assertNotIn("GRAVE: the PWM ripple", self.run_any("design", f"{motor}-choke.toml", "--mode", mode, "--quick").stdout)


class FoundMotors(MotorTest):
    def setUp(self):
        super().setUp()
        for name, sheet in FOUND.items():
            (self.path / f"{name}.toml").write_text(f'name = "{name}"\n' + sheet)

    def test_each_has_a_scenario_in_every_mode(self):
        pairs = [(name, MODES[(n + shift) % len(MODES)]) for shift in range(len(MODES)) for n, name in enumerate(FOUND)]
        for name, mode in some(pairs, len(FOUND)):
            with self.subTest(f"{name} {mode}"):
                self.new_runs(name, mode)

    def test_advice_was_tried_and_names_options(self):
        for name, mode in some((("small", "speed"), ("slotless", "speed"), ("wheel", "speed")), 2):
            with self.subTest(name):
                self.design_leads_on(name, mode)
        told = self.run_any("design", "small.toml", "--mode", "speed").stdout
        self.assertNotIn(".hpp", told)
        self.assertNotIn("settle_s", told)

    def test_few_pole_pairs_are_placed_by_an_encoder(self):
        self.run_program("new", "a", "--motor", "slotless.toml", "--mode", "position")
        self.assertRegex((self.path / "a.toml").read_text(), r'(?m)^rotor = "encoder"')

    def test_samples_that_stand_beside_the_mean_are_told(self):
        """With a period T = 30 us, U = 24 V and L = 224 uH, the samples show 1 A. The mean current is larger by half
        of the ripple U T (1 - d) d/L, with the duty d."""
        self.run_any("design", "small.toml", "--quiet", "--toml", "x.toml")
        told = self.run_program("run", "x.toml").stdout
        ripple = 24 * 30e-6 / 224e-6 * (1.6 / 24) * (1 - 1.6 / 24)
        samples, mean = map(float, re.search(r"note: mean of the last ten samples is (\S+) A at the controller's samples, but (\S+) A", told).groups())
        self.assertAlmostEqual(samples, 1.0, delta=0.02)
        self.assertAlmostEqual(mean - samples, ripple / 2, delta=0.1 * ripple / 2)
        self.assertIn('pwm.sample = "middle"', told)
        self.assertEqual(len(json.loads(self.run_program("run", "x.toml", "--json", "-").stdout)["notes"]), 1)
        self.run_program("new", "mine", "--motor", "small.toml", "--mode", "current")
        self.assertNotIn("note:", self.run_program("run", "mine.toml").stdout)
        self.assertIn("mean of the last ten periods", (self.path / "mine.toml").read_text())


class DrawnMotors(MotorTest):
    def test_each_has_a_first_scenario_and_a_design(self):
        print(f"SIXSTEP_SEED={SEED} SIXSTEP_DRAWN_MOTORS={COUNT}")
        draw = random.Random(SEED)
        for n in range(COUNT):
            sheet = drawn_sheet(draw, f"m{n}")
            (self.path / f"m{n}.toml").write_text(sheet)
            mode = MODES[n % len(MODES)]
            with self.subTest(f"seed {SEED}, motor {n}, {mode}\n{sheet}"):
                self.judge(f"m{n}", mode, designs=COUNT > QUICK or mode == "speed")
            if n % 100 == 99:
                print(f"{n + 1} motors", flush=True)

    def judge(self, name, mode, designs):
        """A failure is also printed at once. A thousand motors take hours, and a user who stops the test keeps the
        failures that were found."""
        try:
            self.new_runs(name, mode)
            if designs and mode != "duty":
                self.design_leads_on(name, mode)
        except AssertionError as told:
            print(f"{name} {mode}: {str(told)[:300]}", flush=True)
            raise


if __name__ == "__main__":
    unittest.main()
