#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run --on: the input that it refuses, with a cure in each message. `./test --target` runs drives on cores
(tests/target/loop.py, avr.py)."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from program import PROGRAM, SOURCE, ProgramTest

SPEED = str(SOURCE / "data/scenarios/thesis/7.4-speed-exact-design.toml")
AVR = str(SOURCE / "data/scenarios/thesis/avr/8b.toml")
MAP = str(SOURCE / "faces/firmware/example/avr_c/map.toml")
RETUNED = """title = "Gains change on the way"
motor = "maxon-251601"
duration_s = 0.01
[control]
mode = "current"
[reference]
shape = "constant"
value = 1
unit = "A"
[[at]]
time_s = 0.005
control.current.settle_s = 2e-3
"""


class OnCore(ProgramTest):
    def test_refuses_with_a_way_out_and_writes_nothing(self):
        gallery = SOURCE / "data/scenarios/gallery"
        (self.path / "retuned.toml").write_text(RETUNED)
        controller = pathlib.Path(PROGRAM).parent / "controllers/pi_in_integers.so"
        own = RETUNED.partition("[[at]]")[0].replace('mode = "current"', 'mode = "current"\ndrive = "own"')
        (self.path / "own.toml").write_text(f'{own}\n[control.own]\ncontroller = "{controller}"\n')
        (self.path / "drifts.toml").write_text(pathlib.Path(AVR).read_text() + "\n[[at]]\ntime_s = 0.01\nsensors.current_offset_A = 0.1\n")
        for words, said in (((SPEED, "--on", "cortex-m5"), "did you mean cortex-m0?"),
                            ((SPEED, "--on", "z80"), "must be one of cortex-m0, cortex-m4, riscv, avr"),
                            ((SPEED, "--on", "cortex-m4", "--bode"), "--bode"),
                            ((SPEED, "--on", "cortex-m4", "--runs", "4"), "--runs"),
                            ((SPEED, "--on", "cortex-m4", "--vary", "supply.voltage_V=20:28:3"), "--only N"),
                            ((str(SOURCE / "data/plans/which-pwm.toml"), "--on", "cortex-m4"), "--only N"),
                            (("own.toml", "--on", "cortex-m4"), "the library's drives run"),
                            ((SPEED, "--on", "cortex-m4", "--set", "control.mode=off"), "runs no controller that a core could execute"),
                            ((SPEED, "--on", "avr"), "set pwm.alignment = \"centre\""),
                            ((AVR, "--on", "avr", "--set", "control.arithmetic=float"), "set control.arithmetic = \"q15\""),
                            ((AVR, "--on", "avr", "--set", "pwm.period_s=10.01e-6"), "a multiple of 125 ns"),
                            ((AVR, "--on", "avr", "--set", "bridge.dead_time_s=0"), "bridge.dead_time_s"),
                            ((AVR, "--on", "avr", "--set", "bridge.dead_time_s=6e-6"), "at most 5e-6"),
                            ((AVR, "--on", "avr", "--set", "sensors.adc_bits=12"), "set sensors.adc_bits = 10"),
                            ((AVR, "--on", "none.toml"), "none.toml"),
                            ((AVR, "--on", MAP), "build the firmware first"),
                            ((AVR, "--on", "retuned.toml"), "chip"),
                            (("drifts.toml", "--on", "avr"), "give the transducer's offset and gain from the start"),
                            (("retuned.toml", "--on", "riscv"), "fixed in the core's program"),
                            ((SPEED, "--uart", "u.csv"), "this run has no chip"),
                            ((SPEED, "--on", "cortex-m4", "--uart", "u.csv"), "add --on avr")):
            with self.subTest(words=words[1:]):
                made = self.run_program("run", *words, code=2)
                self.assertIn(said, made.stderr)
                self.assertEqual(made.stdout, "")
        self.assertEqual(self.names(), ["drifts.toml", "own.toml", "retuned.toml"])

    def test_says_what_is_missing_and_leaves_no_file(self):
        for environment, said in (({"PATH": "/nowhere"}, "arm-none-eabi-g++ is not installed on this machine; install it"),
                                  ({"SIXSTEP_SOURCES": "/nowhere"}, "set SIXSTEP_SOURCES to the folder"),
                                  ({"TMPDIR": "/proc"}, "set TMPDIR to a folder in which you may write")):
            with self.subTest(said=said), tempfile.TemporaryDirectory() as folder:
                made = subprocess.run([PROGRAM, "run", SPEED, "--on", "cortex-m4", "--html", "x.html"], cwd=self.path, text=True, check=False,
                                      capture_output=True, timeout=300, env={**os.environ, "TMPDIR": folder, **environment})
                self.assertEqual(made.returncode, 2, made.stderr)
                self.assertIn(said, made.stderr)
                self.assertEqual(os.listdir(folder), [])
                self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
