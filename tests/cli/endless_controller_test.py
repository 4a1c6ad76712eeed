#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A user's controller that never returns is reported after 2 s. The program ends after 10 s."""
import os
import subprocess
import time
import unittest

from program import PROGRAM, Started
from own_controller_test import ENDS, SCENARIO, WHO, AT_20


class EndlessController(Started):
    def setUp(self):
        super().setUp()
        (self.path / "a.toml").write_text(SCENARIO.format(duration=0.01))

    def begun(self, deed, *words):
        return subprocess.Popen([PROGRAM, *words], cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, "MISBEHAVES": deed, "MISBEHAVES_AT": "20"})

    def test_it_is_reported_and_ended(self):
        plan = ["run", "a.toml", "--vary", "supply.voltage_V=20,22", "--store", "s.sqlite", "--jobs", "1"]
        began = time.monotonic()
        programs = {"run": self.begun("step-loop", "run", "a.toml", "--csv", "o.csv"), "design": self.begun("design-loop", "run", "a.toml"),
                    "plan": self.begun("step-loop", *plan)}
        place = {"run": AT_20, "design": " in its design", "plan": AT_20 + ", of run 0"}
        for name, program in programs.items():
            with self.subTest(name):
                out, told = program.communicate(timeout=60)
                lasted = time.monotonic() - began
                self.assertEqual((program.returncode, out), (3, ""), told)
                first, second = told.splitlines(keepends=True)
                self.assertRegex(first, WHO + "has not answered for 2 s" + place[name] + "; after 10 s the program ends\n$")
                self.assertRegex(second, WHO + "has not answered for 10 s" + place[name] + ENDS)
                self.assertGreater(lasted, 9.5)
        self.assertEqual([name for name in self.names() if not name.startswith("s.sqlite-")], ["a.toml", "s.sqlite", "s.sqlite.stopped"])
        self.assertIn("0\t", (self.path / "s.sqlite.stopped").read_text())
        resumed = subprocess.run([PROGRAM, *plan, "--resume"], cwd=self.path, capture_output=True, text=True, check=False,
                                 env={**os.environ, "MISBEHAVES": "well"})
        self.assertEqual(resumed.returncode, 3)
        self.assertRegex(resumed.stdout, "the controller has not answered for 10 s" + AT_20)


if __name__ == "__main__":
    unittest.main()
