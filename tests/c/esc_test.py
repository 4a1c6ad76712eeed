# SPDX-License-Identifier: Apache-2.0
"""Tests the example faces/c/example/esc. The same firmware runs on a simulated motor and, unchanged, compiles for a
chip.
esc_test.py LIBRARY SOURCE"""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

LIBRARY, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
EXAMPLE = SOURCE / "faces/c/example/esc"
STRICT = ["-std=c99", "-Wall", "-Wextra", "-Werror"]
UPPER, LOWER = (1, 4, 16), (2, 8, 32)
PERIOD_s, DEAD_ps, HOLD_ps = 50e-6, 500_000, 2_000_000
CLAMPED_s, RELEASED_s = 0.50, 0.51  # s; main.c clamps and releases the rotor at these instants
# DJI 2212 920 KV and the scenario of main.c
POLE_PAIRS, K_E, R_PAIR, L_s, BUS_V = 7, 6.741e-3, 2 * (0.1153 + 5e-3), 17.6e-6, 12.0
K_T = 3 * math.sqrt(3) / math.pi * K_E  # torque constant of a pair with a sine back-EMF, as the mean over a sector


def load_Nm(speed):
    return 1.2e-7 * speed**2 + 1e-3


def duty_at(speed):
    """The duty at which the speed is constant. The voltage has three parts: the back-EMF, R times the current, and
    the mean voltage 3/pi L omega I that the commutations consume."""
    current = load_Nm(speed) / K_T
    return (K_T * speed + (R_PAIR + 3 / math.pi * POLE_PAIRS * speed * L_s) * current) / BUS_V


class Program:
    """The example, built from its sources. A test may replace the firmware or edit it."""

    def __init__(self, folder, firmware=None, edit=None):
        if edit:
            text = (EXAMPLE / "esc.c").read_text()
            assert text.count(edit[0]) == 1, edit
            firmware = folder / "edited.c"
            firmware.write_text(text.replace(*edit))
        self.folder = folder
        self.program = folder / (firmware or EXAMPLE / "esc.c").stem
        subprocess.run(["cc", "-O1", *STRICT, "-I", SOURCE, "-I", SOURCE / "faces/c", "-I", EXAMPLE, EXAMPLE / "main.c",
                        EXAMPLE / "hal_sixstep.c", firmware or EXAMPLE / "esc.c", LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}", "-lm",
                        "-o", self.program], check=True)

    def run(self, step_s, *supply):
        log = self.folder / "log"
        done = subprocess.run([self.program, str(step_s), log, *supply], capture_output=True, text=True, timeout=60, check=True)
        return Course(done.stdout, log.read_text())


class Course:
    """The rows of the table, by their time in ms, and the events of the log as (ps, word, number)."""

    def __init__(self, text, log):
        self.text = text
        *lines, digest = text.splitlines()[1:]
        self.digest = digest.split()[1]
        self.rows = {}
        for line in lines:
            ms, throttle, speed, current, state, *counts = line.split()
            commutations, missed, desyncs = map(int, counts)
            self.rows[int(ms)] = (float(speed), float(current), state, commutations, missed, desyncs)
        self.events = [(int(at), word, int(number)) for at, word, number in map(str.split, log.splitlines())]

    def of(self, *words):
        return [event for event in self.events if event[1] in words]


class Firmware(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.program = Program(cls.folder)
        cls.course = cls.program.run(0.04)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_six_commutations_are_an_electrical_turn(self):
        rows = self.course.rows
        for begin, end in ((440, 480), (840, 880), (880, 920)):
            mean = (rows[begin][0] + rows[end][0]) / 2
            expected = 6 * POLE_PAIRS * mean / (2 * math.pi) * (end - begin) * 1e-3
            self.assertAlmostEqual(rows[end][3] - rows[begin][3], expected, delta=1 + 0.004 * expected)

    def test_steady_speed_is_that_of_the_motor_s_sheet(self):
        """While the upper switch is chopped, the dead time shortens the on-time by at most its own length. It does
        not shorten the on-time if the ripple reverses the current."""
        for ms, duty, lost in ((360, 0.40, DEAD_ps * 1e-12 / PERIOD_s), (920, 1.00, 0)):
            speed = self.course.rows[ms][0]
            self.assertTrue(0.985 * (duty - lost) < duty_at(speed) < 1.015 * duty, (speed, duty_at(speed)))

    def test_dead_time_passes_between_the_switches_of_a_leg(self):
        gates, off_at, turned_on = 0, {}, 0
        for at, _, new in self.course.of("gates"):
            for upper, lower in zip(UPPER, LOWER):
                self.assertNotEqual(new & (upper | lower), upper | lower)
                for one, other in ((upper, lower), (lower, upper)):
                    if gates & one and not new & one:
                        off_at[one] = at
                    if new & one and not gates & one:
                        self.assertGreaterEqual(at - off_at.get(other, -DEAD_ps), DEAD_ps)
                        turned_on += 1
            gates = new
        self.assertGreater(turned_on, 10000)

    def test_crossings_are_found_to_the_picosecond(self):
        """The comparator's output changes at 20 mV of back-EMF. While one pair of the star is driven, the comparator
        measures the back-EMF of the free phase."""
        changed, exact = 0, 0
        for at, word, number in self.course.events:
            if word == "gates":
                changed = at
            elif word == "taken":
                self.assertGreaterEqual(at, changed + HOLD_ps)
                # From 0.44 s on: full duty, so that no diode of the free phase conducts.
                if at > changed + HOLD_ps and 0.44e12 < at < CLAMPED_s * 1e12:
                    self.assertAlmostEqual(abs(number), 20e6, delta=100)  # nV; the back-EMF changes by 35 nV per picosecond
                    exact += 1
        self.assertGreater(exact, 300)

    def test_crossings_within_the_blanking_time_are_not_taken(self):
        end, masked = 0, 0
        for at, word, number in self.course.of("blank", "taken", "masked"):
            if word == "blank":
                end = number
            else:
                self.assertEqual(word, "taken" if at >= end else "masked")
                masked += word == "masked"
        self.assertGreater(masked, 1000)  # after a commutation the current of the leaving phase raises its terminal beyond a supply rail

    def test_without_blanking_the_firmware_loses_step(self):
        bare = Program(self.folder, edit=("is.interval / 8 : is.interval / 4", "0 : 0")).run(0.04)
        self.assertGreater(bare.rows[480][5], 0)
        self.assertEqual(self.course.rows[480][4:], (0, 0))

    def test_a_clamped_rotor_is_seen_and_started_again(self):
        rows = self.course.rows
        sector_s = 2 * math.pi / (6 * POLE_PAIRS * rows[480][0])
        off = next(at for at, _, gates in self.course.of("gates") if at >= CLAMPED_s * 1e12 and gates == 0) * 1e-12
        # At most one sector passes before the first missed crossing. Then the drive waits 1.5 sectors for each of four missed
        # crossings.
        self.assertLess(off - CLAMPED_s, (1 + 4 * 1.5) * sector_s + PERIOD_s)
        self.assertEqual(rows[520][2], "wait")
        self.assertEqual([rows[ms][5] for ms in (480, 520, 920)], [0, 1, 1])
        self.assertEqual(rows[760][2], "run")  # 20 ms of waiting, 150 ms of alignment, 80 ms of ramp
        self.assertAlmostEqual(rows[920][0] / rows[480][0], 1, delta=0.01)

    def test_throttle_off_turns_the_bridge_off(self):
        self.assertEqual([self.course.rows[ms][2] for ms in (960, 1000)], ["off", "off"])
        self.assertEqual(self.course.rows[1000][1], 0)

    def test_a_failing_supply_turns_the_bridge_off_for_good(self):
        failed = self.program.run(0.04, "8")
        off = [at for at, _, gates in failed.of("gates") if gates == 0 and at >= 0.44e12][0]
        self.assertLess(off, 0.44e12 + 3e12 * PERIOD_s)  # the throttle changes at a control tick, and the gates follow one sample later
        self.assertEqual({failed.rows[ms][2] for ms in range(480, 940, 40)}, {"fault"})
        self.assertEqual(failed.of("gates")[-1][0], off)

    def test_reading_steps_change_no_bit(self):
        for step in (0.04, 37e-6):
            again = self.program.run(step)
            self.assertEqual(again.text, self.course.text)
            self.assertEqual(again.events, self.course.events)

    def test_hall_edges_are_captured(self):
        rows = Program(self.folder, SOURCE / "tests/c/hall_esc.c").run(0.04).rows
        speed = (rows[880][0] + rows[920][0]) / 2
        self.assertAlmostEqual(rows[920][3] - rows[880][3], 6 * POLE_PAIRS * speed / (2 * math.pi) * 0.04, delta=2)
        # The ripple reverses the current, so the dead time does not shorten the on-time.
        self.assertAlmostEqual(duty_at(speed), 0.25, delta=0.015 * 0.25)


class Chip(unittest.TestCase):
    @unittest.skipUnless(shutil.which("arm-none-eabi-gcc"), "no compiler for a Cortex-M here")
    def test_the_firmware_compiles_unchanged_for_a_chip(self):
        with tempfile.TemporaryDirectory() as folder:
            for core in ("cortex-m0", "cortex-m4"):
                part = pathlib.Path(folder) / f"{core}.o"
                subprocess.run(["arm-none-eabi-gcc", f"-mcpu={core}", "-mthumb", "-ffreestanding", "-Os", *STRICT, "-c",
                                EXAMPLE / "esc.c", "-o", part], check=True)
                shown = subprocess.run(["arm-none-eabi-nm", "-u", part], capture_output=True, text=True, check=True).stdout
                own = ("hal_", "__aeabi_", "__gnu_")  # functions of the hardware layer, and the compiler's division and tables
                self.assertFalse([name for name in shown.split() if name != "U" and not name.startswith(own)], shown)

    def test_it_includes_nothing_but_the_layer(self):
        includes = [line.split()[1] for line in (EXAMPLE / "esc.c").read_text().splitlines() if line.startswith("#include")]
        self.assertEqual(includes, ['"hal.h"'])


if __name__ == "__main__":
    unittest.main()
