#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program from a user's view: exit codes, messages, and files that are either complete or absent."""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

from program import PROGRAM, SHORT, SOURCE, ProgramTest

R1 = str(SOURCE / "data/scenarios/reference/R1.toml")

# A winding resistance with a tolerance of a tenth. Half of the drives reach 23.3 A.
SPREAD = """
[[spread]]
key = "motor_override.resistance_ohm"
relative = 0.1
"""

class CommandLine(ProgramTest):
    def test_0_when_all_requirements_hold(self):
        result = self.run_program("run", self.write("a.toml", 1000))
        self.assertIn("ok", result.stdout)
        self.assertNotIn("\x1b", result.stdout)  # no colour without a terminal
        self.assertEqual(self.names(), ["a.toml"])

    def test_1_when_a_requirement_fails(self):
        self.assertIn("FAILED", self.run_program("run", self.write("a.toml", -1), code=1).stdout)

    def test_quiet_says_nothing(self):
        result = self.run_program("run", "--quiet", self.write("a.toml", 1000))
        self.assertEqual(result.stdout + result.stderr, "")

    def test_the_gravest_of_several_counts_and_the_order_is_that_given(self):
        files = [self.write(f"{name}.toml", limit) for name, limit in [("z", 1000), ("a", -1), ("m", 1000)]]
        table = self.run_program("run", *files, "--jobs", "3", code=1).stdout.splitlines()
        self.assertEqual([line for line in table if line in ("z", "a", "m")], ["z", "a", "m"])
        self.assertEqual(table[-2:], ["3 experiments: 1 of 3 requirements FAILED", "  a: current"])

    def test_several_files_and_one_page_are_compared_and_equal_runs_do_not_differ(self):
        files = [self.write(f"{name}.toml", 1000) for name in ("a", "b")]
        self.run_program("run", *files, "--html", "both.html")
        page = (self.path / "both.html").read_text()
        self.assertIn("No difference that changes a run.", page)
        data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.S).group(1))
        differences = [curve for chart in data["charts"] if chart["id"].endswith("-difference") for curve in chart["curves"]]
        self.assertTrue(differences)
        for curve in differences:  # exactly zero
            self.assertRegex(curve["data"], r"^A+=*$")
        self.run_program("run", *files, "--html", "both.html", "--csv", "a.csv", code=2)
        self.assertIn("must be at most 5", self.run_program("run", *[files[0]] * 6, "--html", "x.html", code=2).stderr)

    def test_2_for_bad_input_and_nothing_is_written(self):
        good = self.write("a.toml", 1000)
        (self.path / "bad.toml").write_text('motor = "maxon-251601"\nduration_s = 0\n')
        result = self.run_program("run", good, "bad.toml", "--out", "out", code=2)
        self.assertEqual(result.stderr, "bad.toml:2:14: duration_s = 0 must be above 0 and at most 9000000; it means: simulated time, in s\n")
        self.run_program("run", "absent.toml", code=2)
        self.run_program("run", code=2)
        self.run_program("nonsense", code=2)
        self.assertEqual(self.run_program("rum", code=2).stderr, "rum is not a command of sixstep; did you mean run?\n")
        self.assertIn("--jobs", self.run_program("run", good, "--jobs", "-1", code=2).stderr)
        self.run_program("run", good, "--set", "novalue", code=2)
        self.run_program("run", good, "a.toml", "--csv", "x.csv", code=2)
        self.assertEqual(self.names(), ["a.toml", "bad.toml"])

    def test_2_for_an_unwritable_output_before_anything_is_written(self):
        good = self.write("a.toml", 1000)
        result = self.run_program("run", good, "--csv", "a.csv", "--json", "no/folder.json", code=2)
        self.assertIn("no/folder.json: cannot be written: No such file or directory", result.stderr)
        (self.path / "file").write_text("in the way")
        self.run_program("run", good, "--out", "file/out", code=2)
        self.assertEqual(self.names(), ["a.toml", "file"])

    def test_2_when_two_files_would_write_the_same_outputs(self):
        os.mkdir(self.path / "other")
        files = [self.write("a.toml", 1000), self.write("other/a.toml", 1000)]
        self.assertIn("same outputs", self.run_program("run", *files, "--out", "out", code=2).stderr)

    def test_an_output_never_takes_the_place_of_an_input(self):
        """Once `sixstep run a.toml --html a.toml` replaced the scenario by the report."""
        text = (SOURCE / "data/scenarios/current-square.toml").read_text().replace('"maxon-251601"', '"own.toml"')
        sheet = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "a.toml").write_text(text)
        (self.path / "own.toml").write_text(sheet)
        os.symlink("a.toml", self.path / "link.toml")
        for words, name in (("run a.toml --html a.toml", "a.toml"), ("run a.toml --csv ./a.toml", "./a.toml"),
                            ("run link.toml --json a.toml", "a.toml"), ("run a.toml --csv link.toml", "link.toml"),
                            ("run a.toml --vcd own.toml", "own.toml"), ("run a.toml link.toml --html own.toml", "own.toml"),
                            ("export header a.toml --out own.toml", "own.toml"), ("curve own.toml --html own.toml", "own.toml"),
                            ("design own.toml --quick --toml own.toml", "own.toml")):
            with self.subTest(words):
                told = self.run_program(*words.split(), code=2).stderr
                self.assertEqual(told, f"{name}: is an input of this command, which the output would replace; name another file\n")
        self.assertEqual((self.path / "a.toml").read_text(), text)
        self.assertEqual((self.path / "own.toml").read_text(), sheet)
        self.assertEqual(self.names(), ["a.toml", "link.toml", "own.toml"])

    def test_two_outputs_to_one_file_are_refused_in_whatever_spelling(self):
        self.write("a.toml", 1000), self.write("index.toml", 1000)
        for words, told in (("run a.toml --csv ./x --json x", "--json = x is also the file of --csv; give each output its own file\n"),
                            ("curve maxon-251601 --csv x --html ./x", "--html = ./x is also the file of --csv; give each output its own file\n"),
                            ("design maxon-251601 --toml x --json ./x", "--toml = x is also the file of --json; give each output its own file\n"),
                            ("run a.toml index.toml --out out", "index.toml: would write index.html, which lists all reports; "
                                                                "rename this file, or run the file without --out\n")):
            self.assertEqual(self.run_program(*words.split(), code=2).stderr, told)
        self.assertEqual(self.names(), ["a.toml", "index.toml"])
        self.run_program("run", "a.toml", "--csv", "/dev/null", "--vcd", "/dev/null", "--quiet")  # /dev/null accepts all of them

    def test_out_holds_everything_of_each_scenario(self):
        self.run_program("run", self.write("a.toml", 1000), self.write("b.toml", 1000), "--out", "deep/out")
        self.assertEqual(self.names("deep/out"),
                         ["a.csv", "a.html", "a.json", "b.csv", "b.html", "b.json", "index.html"])
        self.assertIn('href="a.html"', (self.path / "deep/out/index.html").read_text())

    def test_json_on_standard_output_is_alone_there(self):
        result = self.run_program("run", self.write("a.toml", 1000), "--json", "-")
        summary = json.loads(result.stdout)
        self.assertRegex(summary["digest"], "^[0-9a-f]{16}$")
        self.assertTrue(summary["passed"])
        self.assertEqual(summary["require"][0]["max"], 1000)
        self.assertIn("ok", result.stderr)

    def test_set_is_stronger_than_the_file(self):
        good = self.write("a.toml", 1000)
        summary = json.loads(self.run_program("run", good, "--json", "-", "--set", "duration_s=2e-4").stdout)
        self.assertEqual(summary["duration_s"], 2e-4)

    def write_series(self, limit, spread=SPREAD):
        (self.path / "a.toml").write_text(SHORT.format(limit=limit).replace("1e-4", "20e-3") + spread)
        return "a.toml"

    def test_a_series_is_judged_together(self):
        file = self.write_series(24 / 1.03)
        table = self.run_program("run", file, "--runs", "40", "--jobs", "1", code=1).stdout
        self.assertEqual(table, self.run_program("run", file, "--runs", "40", "--jobs", "3", code=1).stdout)
        self.assertNotEqual(table, self.run_program("run", file, "--runs", "40", "--seed", "2", code=1).stdout)
        held, missed = (int(n) for n in re.search(r"40 drives, seed 1: (\d+) hold every requirement, (\d+) do NOT", table).groups())
        self.assertEqual(held + missed, 40)
        self.assertIn(f"{held} of 40", table)
        self.assertIn("all hold", self.run_program("run", self.write_series(1000), "--runs", "5").stdout)
        self.assertEqual(self.names(), ["a.toml"])

    def test_one_drive_of_a_series_is_run_alone_with_its_files(self):
        file = self.write_series(24 / 1.03)
        table = self.run_program("run", file, "--runs", "40", code=1).stdout
        miss, beyond = re.search(r"worst is drive (\d+), (\S+ \S+) beyond its limit \(--seed 1 --drive \1\)", table).groups()
        self.run_program("run", file, "--runs", "40", "--csv", "all.csv", code=1)
        rows = list(csv.DictReader(line for line in (self.path / "all.csv").read_text().splitlines() if not line.startswith("#")))
        figure = next(name for name in rows[0] if name.startswith("required") or "current" in name)
        self.assertEqual(max(rows, key=lambda row: float(row[figure]))["run"], miss, "no drive is farther beyond the limit")
        self.assertIn("each drive: motor_override.resistance_ohm +-10 %", table)
        self.run_program("run", file, "--seed", "1", "--drive", miss, "--json", "miss.json", code=1)
        alone = json.loads((self.path / "miss.json").read_text())["require"][0]
        self.assertFalse(alone["ok"])
        self.assertNotEqual(alone["measured"], json.loads(
            self.run_program("run", file, "--json", "-").stdout)["require"][0]["measured"])

    def test_2_for_a_series_that_is_none(self):
        told = self.run_program("run", self.write("a.toml", 1000), "--tolerances", code=2).stderr
        self.assertTrue(told.startswith("--tolerances needs several drives"), told)
        self.assertNotIn("--vary", told)
        self.assertIn("has no [[spread]]", self.run_program("run", self.write("a.toml", 1000), "--runs", "3", code=2).stderr)
        self.assertIn("has no [[spread]]", self.run_program("run", "a.toml", "--drive", "3", code=2).stderr)
        file = self.write_series(1000)
        self.assertIn("--only", self.run_program("run", file, "--runs", "3", "--vcd", "a.vcd", code=2).stderr)
        self.run_program("run", file, "--runs", "3", "--drive", "1", code=2)
        self.write_series(1000, SPREAD.replace("resistance_ohm", "resistance"))
        self.assertTrue(self.run_program("run", file, code=2).stderr.startswith(
            'a.toml:17:7: spread.key = "motor_override.resistance" is not a number'))
        self.write_series(1000, SPREAD.replace("0.1", "1.5"))
        self.assertTrue(self.run_program("run", file, code=2).stderr.startswith(
            "a.toml:18:12: spread.relative = 1.5 lets motor_override.resistance_ohm reach -0.515"))
        self.assertEqual(self.names(), ["a.toml"])

    def test_ctrl_c_ends_a_series_and_tells_what_is_done(self):
        words = [PROGRAM, "run", self.write_series(1000), "--runs", "1000000000"]
        with subprocess.Popen(words, cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            time.sleep(0.5)
            program.send_signal(signal.SIGINT)
            told = program.communicate(timeout=20)[0]
        self.assertEqual(program.returncode, 130)
        self.assertRegex(told, r"interrupted after [1-9]\d* of 1000000000 drives, seed 1: of these all hold every requirement")

    def test_what_the_command_line_lacks_or_has_too_much_of(self):
        self.write("a.toml", 1000)
        for words, told in (
                ("run", "sixstep run needs FILE: scenario or plan files; sixstep run --help lists all"),
                ("motor", "sixstep motor needs a command: list, show, check, new, wiring, commission, identify, emf, fit; sixstep motor --help lists all"),
                ("motor lst", "lst is not a command of sixstep motor; did you mean list?"),
                ("run a.toml --htlm x", "--htlm is not an argument of sixstep run; did you mean --html?"),
                ("run a.toml --duraton 3", "--duraton is not an argument of sixstep run; did you mean --set duration_s=..?"),
                ("run a.toml --supply-voltage=3", "--supply-voltage=3 is not an argument of sixstep run; did you mean --set supply.voltage_V=..?"),
                ("run a.toml --csv", "--csv needs a value behind the option; it means: write the recorded trace"),
                ("run a.toml --html x --html y", "--html is given more than once; keep one"),
                ("run a.toml --runs 5 --watch", "--watch cannot be combined with --runs; leave out one of the two options"),
                ("run a.toml --jobs 0", "--jobs = 0 must be a whole number in 1 to 1024; sixstep run --help lists all"),
                ("run a.toml --seed -1", f"--seed = -1 must be a whole number in 0 to {2**63 - 1}; sixstep run --help lists all"),
                ("curve maxon-251601 --points 1e9", "--points = 1e9 must be a whole number; it means: number of speeds from standstill to no load. Default: 41"),
                ("curve maxon-251601 --voltage 24V", "--voltage = 24V must be a number without a unit; it means: bus voltage, V. "
                                                     "Default: the sheet's nominal voltage"),
                ("--verson", "--verson is not an argument of sixstep; did you mean --version?"),
                ("run -", "-: is not a file; to read from a pipe, name /dev/stdin"),
                ("run /dev/zero", "/dev/zero: cannot be read: it is larger than 128 MiB; name a smaller file")):
            with self.subTest(words):
                self.assertEqual(self.run_program(*words.split(), code=2).stderr, told + "\n")
        alone = self.run_program(code=2)
        self.assertEqual(alone.stdout, "")
        self.assertIn("To begin with: sixstep new first\n", alone.stderr)
        self.assertEqual(self.run_program("motor", "show", "a.toml", code=2).stderr,
                         "a.toml:1:1: is a scenario, not a motor file; name the scenario's motor, maxon-251601\n")

    def test_help_explains_keys_and_answers_near_misses(self):
        self.assertIn("supply.voltage_V", self.run_program("help", "supply").stdout)
        self.assertIn("default 24", self.run_program("help", "supply.voltage_V").stdout)
        self.assertIn("i_a_A", self.run_program("help", "columns").stdout)
        self.assertIn("terminal|phase", self.run_program("help", "resistance_ohm").stdout)
        ripple = self.run_program("help", "Ripple").stdout
        self.assertIn('require.metric = "ripple_rms"', ripple)
        for line in ripple.splitlines()[1:]:
            self.assertIn("ripple", line.lower())
        self.assertIn("pwm.period_s ", self.run_program("help", "frequency").stdout)
        self.assertEqual("", self.run_program("help", "flux capacitor", code=2).stdout)
        self.assertIn("did you mean supply.voltage_V?", self.run_program("help", "suply.voltage_V", code=2).stderr)
        self.assertEqual(self.run_program("help", "run").stdout, self.run_program("run", "--help").stdout)
        both = self.run_program("help", "motor").stdout
        self.assertIn(self.run_program("motor", "--help").stdout, both)
        self.assertLess(both.index("Usage: sixstep motor"), both.index("The key motor of a scenario"), "the command comes first")
        for words in (["motor", "new"], ["motor", "check"], ["export", "fmu"]):
            self.assertEqual(self.run_program("help", *words).stdout, self.run_program(*words, "--help").stdout)
        self.assertIn("is not a command of sixstep motor", self.run_program("help", "motor", "mew", code=2).stderr)
        self.assertIn("searched beside the scenario", both)


if __name__ == "__main__":
    unittest.main()
