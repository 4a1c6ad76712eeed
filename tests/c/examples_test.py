# SPDX-License-Identifier: Apache-2.0
"""The examples of faces/c/example/ print the same results as the program. A test is skipped if its language is not
installed.
examples_test.py LIBRARY PROGRAM SOURCE"""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

LIBRARY, PROGRAM, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
EXAMPLES = SOURCE / "faces/c/example"
SCENARIO = SOURCE / "data/scenarios/current-square.toml"
WARNINGS = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wno-sign-conversion", "-Werror"]
FLAGS = [f"-I{SOURCE / 'faces/c'}", f"-I{SOURCE}", f"-L{LIBRARY.parent}", "-lsixstep"]
# The same control() as a controller of a scenario.
INSIDE = """
#define main outside
#include "controller_outside.c"
static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) { return (void)given, (void)values, (void)config, (char*)0; }
static void step(const void* config, void* state, const sixstep_measured* seen, sixstep_real setpoint, sixstep_answer* answer) {
  (void)config, (void)state;
  control(seen, setpoint, answer);
}
const sixstep_controller* sixstep_own_controller(void) {
  static const sixstep_controller own = {
      SIXSTEP_OWN_INTERFACE, SIXSTEP_ANSWERS_PAIR, "P", "is an example", 0, 0, 0, 0, design, 0, step, 0};
  return &own;
}
"""


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = pathlib.Path(folder.name)
        cls.compiled("advance")

    @classmethod
    def call(cls, *words, code=0):
        environment = {**os.environ, "LD_LIBRARY_PATH": str(LIBRARY.parent), "CXXFLAGS": "-O0"}
        done = subprocess.run([str(word) for word in words], cwd=cls.here, env=environment, capture_output=True, text=True, timeout=120)
        assert done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}{done.stderr}"
        return done

    @classmethod
    def compiled(cls, name):
        cls.call(os.environ.get("CC", "cc"), *WARNINGS, EXAMPLES / f"{name}.c", *FLAGS, "-o", name)

    def needs(self, command):
        if not shutil.which(command):
            self.skipTest(f"{command} is not installed")

    def told(self, printed):
        """From the text that an example printed: the lines of numbers, and the outcome as a dictionary."""
        numbers, brace, outcome = printed.partition("{\n")
        return [[float(x) for x in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", line)] for line in numbers.splitlines()], json.loads(brace + outcome)

    def program(self, *words):
        return json.loads(self.call(PROGRAM, "run", SCENARIO, "--json", "-", *words, code=words and 1 or 0).stdout)

    def c_example(self):
        return self.told(self.call("./advance", SCENARIO).stdout)

    def test_c_prints_the_rows_of_the_trace_and_the_outcome_of_the_program(self):
        lines, outcome = self.c_example()
        self.assertEqual(outcome, self.program())
        self.call(PROGRAM, "run", SCENARIO, "--csv", "trace.csv")
        with open(self.here / "trace.csv", encoding="utf-8") as file:
            rows = {round(1e6 * float(row["t_s"])): row for row in csv.DictReader(line for line in file if line[0] != "#")}
        self.assertEqual([line[0] for line in lines], list(range(1, 20)))
        for ms in range(3, 20, 3):  # only these milliseconds are also control ticks, which come every 30 us
            self.assertAlmostEqual(lines[ms - 1][1], float(rows[1000 * ms]["speed_rad_s"]), delta=5.1e-5)
            self.assertAlmostEqual(lines[ms - 1][2], float(rows[1000 * ms]["i_m_A"]), delta=5.1e-5)

    def test_c_names_the_problem_of_a_file(self):
        (self.here / "wrong.toml").write_text(SCENARIO.read_text(encoding="utf-8").replace("duration_s = 0.02", "duration_s = -1"))
        message = self.call("./advance", "wrong.toml", code=2).stderr
        self.assertRegex(message, r"wrong.toml:4:\d+: duration_s: -1 must be above 0")

    def test_the_controller_outside_has_the_bits_of_the_same_one_inside(self):
        self.compiled("controller_outside")
        outcome = json.loads(self.call("./controller_outside", SCENARIO).stdout)
        (self.here / "inside.c").write_text(INSIDE, encoding="utf-8")
        self.call("cc", "-ffp-contract=off", "-shared", "-fPIC", "-fvisibility=hidden", "-ffunction-sections", "-Wl,--gc-sections", f"-I{EXAMPLES}",
                  *FLAGS[:2], "inside.c", "-o", "inside.so")  # without the function outside(), which needs libsixstep
        told = self.program("--set", "control.drive=own", "--set", f"control.own.controller={self.here / 'inside.so'}")
        self.assertEqual(outcome["digest"], told["digest"])

    def test_the_controller_outside_turns_the_motor_as_the_setpoint_says(self):
        """The controller u = k U (r - i), with the gain k, bus voltage U and reference r, drives R i + e, with the
        back-EMF e. The steady current is (k U r - e)/(k U + R): nearly 5 A, and then -5 A."""
        lines, outcome = self.c_example()
        peak = max(line[1] for line in lines)
        self.assertGreater(outcome["energy"]["kinetic_J"] + outcome["energy"]["friction_J"], 0)
        self.compiled("controller_outside")
        mine = json.loads(self.call("./controller_outside", SCENARIO).stdout)
        self.assertIsNone(mine["fault"])
        self.assertGreater(mine["events"]["sector edges"], 0)
        self.assertGreater(peak, 30)
        ratio = mine["energy"]["copper_J"] / outcome["energy"]["copper_J"]  # (i/5 A)^2, with i between 12/13.2 of 5 A and 5 A
        self.assertTrue(0.7 < ratio < 1.05, ratio)

    def test_rust_prints_the_same(self):
        self.needs("rustc")
        self.call("rustc", "--edition", "2021", "-L", LIBRARY.parent, EXAMPLES / "advance.rs", "-o", "rust")
        self.same(self.call("./rust", SCENARIO).stdout, 2)

    def test_octave_prints_the_same(self):
        self.needs("mkoctfile")
        self.call("mkoctfile", EXAMPLES / "sixstep_advance.cc", *FLAGS, "-o", "sixstep_advance.oct")
        self.same(self.call("octave-cli", "--norc", EXAMPLES / "advance.m", SCENARIO).stdout, 3)
        refused = "try, sixstep_advance('nowhere.toml', 1, {'t_s'}), catch e, disp(e.message), end"
        self.assertIn("nowhere.toml", self.call("octave-cli", "--norc", "--eval", refused).stdout)

    def test_julia_prints_the_same(self):
        self.needs("julia")
        lines, outcome = self.told(self.call("julia", EXAMPLES / "advance.jl", SCENARIO).stdout)
        self.assertEqual(outcome, self.c_example()[1])
        for mine, theirs in zip(self.c_example()[0], lines, strict=True):
            self.assertAlmostEqual(mine[1], theirs[1], delta=5.1e-5)

    def test_julias_declarations_are_those_of_the_header(self):
        """Debian 12 has no Julia, so the example cannot run. This test compares the names, the number of arguments
        and the result types with the header."""
        header = re.sub(r"/\*.*?\*/", "", (SOURCE / "faces/c/sixstep.h").read_text(encoding="utf-8"), flags=re.S)
        kinds = {"uint32_t": "UInt32", "sixstep_status": "Cint", "int": "Cint", "double": "Cdouble", "void": "Cvoid", "const char*": "Cstring"}
        calls = re.findall(r"ccall\(\(:(\w+), sixstep\), (\w+), \((.*?),?\)[,)]", (EXAMPLES / "advance.jl").read_text(encoding="utf-8"))
        self.assertGreater(len(calls), 6)
        for name, result, arguments in calls:
            kind, declared = re.search(rf"SIXSTEP_API ([\w *]+?) ?{name}\((.*?)\);", header, re.S).groups()
            self.assertEqual(kinds[kind], result, name)
            self.assertEqual(len([a for a in arguments.split(",") if a.strip()]), 0 if declared == "void" else len(declared.split(",")), name)

    def test_what_calls_cost_is_in_order(self):
        """Reading a value takes less time than a period. A period of one long advance takes less time than an advance
        by one period. The absolute limits are ten times the goals, because the machine may be busy."""
        self.call("cc", "-O2", EXAMPLES / "costs.c", *FLAGS, "-o", "costs")
        us = {name.strip(): float(x) for name, x in re.findall(r"^(.*?) +([\d.]+) us$", self.call("./costs", SCENARIO).stdout, re.M)}
        self.assertLess(us["read a value"], 0.5)
        self.assertLess(us["read a value"], us["a period of one long advance"])
        self.assertLess(us["a period of one long advance"], us["advance by a period"])
        self.assertLess(us["open a file"], 10_000)
        self.assertLess(us["copy"], us["load"])

    def same(self, printed, columns):
        lines, outcome = self.told(printed)
        mine, wanted = self.c_example()
        self.assertEqual(outcome, wanted)
        self.assertEqual([line[:columns] for line in lines[:len(mine)]], [line[:columns] for line in mine])

    def test_each_is_short(self):
        for file in (f for f in EXAMPLES.iterdir() if f.is_file()):  # the folder esc/ is skipped: it is a program of several files
            text = file.read_text(encoding="utf-8")
            self.assertIn("SPDX-License-Identifier: Apache-2.0", text.splitlines()[0], file)
            self.assertLess(len(text.splitlines()), 60, file)


if __name__ == "__main__":
    unittest.main()
