#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Octave reads the CSV, MAT 5 and MAT 7.3 files of a run, and uses the class of faces/octave/. Octave needs 117
packages: `tools/install.sh long` installs it, and only `ctest --preset long` runs this test."""
import json
import shutil
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest

SQUARE = SOURCE / "data/scenarios/current-square.toml"


class Octave(ProgramTest):
    def setUp(self):
        super().setUp()
        self.assertTrue(shutil.which("octave-cli"), "Octave is not installed: tools/install.sh long")

    def told(self, script, program=PROGRAM):
        """The output of a script that runs in a folder with an apostrophe and a space in its name."""
        here = self.path / "a user's folder"
        here.mkdir(exist_ok=True)
        done = subprocess.run(["octave-cli", "--norc", "--eval", f"addpath('{SOURCE}/faces/octave'); sixstep.program('{program}');\n{script}"], cwd=here,
                              capture_output=True, text=True, timeout=120)
        self.assertTrue(done.stdout, done.stderr)
        return done.stdout

    def ran(self, *words):
        self.run_program("run", str(SQUARE), "--quiet", "--json", "told.json", "--force", *words)
        return json.loads((self.path / "told.json").read_text())

    def test_a_run_has_the_program_s_results_and_signals(self):
        told = self.ran("--set", "supply.voltage_V=22.5", "--mat", "own.mat")
        lines = self.told(f"""r = sixstep.run('{SQUARE}', 'supply.voltage_V', 22.5); own = load('{self.path}/own.mat');
          assert(r.signals.i_a_A, own.i_a_A); assert(r.signals.t_s, own.t_s); assert(r.units.speed_rad_s, 'rad/s'); assert(r.passed);
          assert(isempty(r.fault)); assert(numel(fieldnames(r.units)), numel(fieldnames(r.signals)));
          printf('%s\\n%.17g\\n', r.digest, r.summary.require.measured)""").split()
        self.assertEqual(lines, [told["digest"], f"{told['require'][0]['measured']:.17g}"])

    def test_settings_of_every_type_arrive(self):
        lines = self.told(f"""a = sixstep.run('{SQUARE}', 'load.locked', true, 'supply.voltage_V', '23 V', 'record.columns', "['i_a_A']", 'pwm.period_s', 5e-5);
          b = sixstep.run("{SQUARE}", "load.times_s", [0 0.01], "load.torques_Nm", [0.01 0.02]); printf('%s\\n%s\\n', a.digest, b.digest);
          disp(strjoin(fieldnames(a.signals)', ' '))""").split("\n")
        self.assertEqual(lines[0], self.ran("--set", "load.locked=true", "--set", "supply.voltage_V=23 V", "--set", "pwm.period_s=5e-5")["digest"])
        self.assertEqual(lines[1], self.ran("--set", "load.times_s=[0,0.01]", "--set", "load.torques_Nm=[0.01,0.02]")["digest"])
        self.assertEqual(lines[2], "t_s i_a_A")

    def test_a_grid_has_a_row_for_each_run(self):
        told = self.ran("--vary", "supply.voltage_V=20,24", "--vary", "pwm.period_s=20us:60us:3")
        lines = self.told(f"""v = sixstep.vary('{SQUARE}', 'supply.voltage_V', [20 24], 'pwm.period_s', '20us:60us:3');
          volts = find(strncmp(v.columns, 'supply.voltage_V', 16)); reach = find(strncmp(v.columns, 'slowest', 7));
          printf('%.17g %.17g\\n', v.values(:, [volts reach])'); one = sixstep.vary('{SQUARE}', 'supply.voltage_V', 20);
          printf('%d %d\\n', size(v.rows), size(one.rows)); printf('%s\\n', v.rows{{:, end}})""").splitlines()
        volts, reach = (next(k for k, name in enumerate(told["columns"]) if name.startswith(of)) for of in ("supply", "slowest"))
        self.assertEqual(lines[:6], [f"{row[volts]:.17g} {row[reach]:.17g}" for row in told["rows"]])
        self.assertEqual(lines[6:8], [f"6 {len(told['columns'])}", f"1 {len(told['columns']) - 1}"])
        self.assertEqual(lines[8:], [row[-1] for row in told["rows"]])

    def test_a_design_has_the_program_s_numbers(self):
        self.run_program("design", "maxon-251601", "--mode", "speed", "--settle", "0.02", "--json", "design.json")
        told = json.loads((self.path / "design.json").read_text())
        lines = self.told("d = sixstep.design('maxon-251601', 'mode', 'speed', 'settle', 0.02); printf('%s\\n%s\\n', d.digest, d.verdict)").splitlines()
        self.assertEqual(lines, [told["digest"], told["verdict"]])

    def test_a_plot_draws_each_signal_over_the_time(self):
        """Functions in this folder replace the functions of Octave that need a screen."""
        here = self.path / "a user's folder"
        here.mkdir()
        for name, arguments, text in (("subplot", "varargin", "printf('at %d %d %d\\n', varargin{:})"), ("plot", "x, y", "printf('%d %d %.2f\\n', numel(x), numel(y), x(end))"),
                                      ("ylabel", "text", "disp(text)"), ("xlabel", "text", "disp(text)"), ("grid", "on", "")):
            (here / f"{name}.m").write_text(f"function {name}({arguments})\n{text}\nend\n")
        lines = self.told(f"r = sixstep.run('{SQUARE}'); disp(numel(r.signals.t_s)); sixstep.plot(r, 'speed_rad_s', 'i_a_A')").splitlines()
        drawn = f"{lines[0]} {lines[0]} 19.98"  # ms
        self.assertEqual(lines[1:], ["at 2 1 1", drawn, "speed\\_rad\\_s [rad/s]", "at 2 1 2", drawn, "i\\_a\\_A [A]", "t [ms]"])

    def test_problems_are_errors_in_the_program_s_words(self):
        def of(call, program=PROGRAM):
            return self.told(f"try; {call}; disp('none'); catch e; disp(e.identifier); disp(e.message); end", program)

        for call, word in ((f"sixstep.run('{SQUARE}', 'supply.voltage_V', -1)", "supply.voltage_V"), ("sixstep.run('/nowhere.toml')", "/nowhere.toml"),
                           (f"sixstep.run('{SQUARE}', 'supply.voltage_V')", "pairs"), (f"sixstep.vary('{SQUARE}')", "pairs"),
                           ("sixstep.design('maxon-251601', 'mood', 1)", "--mood"), ("sixstep.design('maxon-251601', 'mode')", "pairs"),
                           (f"sixstep.plot(sixstep.run('{SQUARE}'), 'i_q_A')", "i_a_A")):
            told = of(call)
            self.assertTrue(told.startswith("sixstep:refused\n"), told)
            self.assertIn(word, told)
        self.assertIn("sixstep.program(", of(f"sixstep.run('{SQUARE}')", "/no/such program"))

    def test_nothing_is_left_behind(self):
        self.told(f"setenv('TMPDIR', '{self.path}'); r = sixstep.run('{SQUARE}'); try; sixstep.run('{SQUARE}', 'a.b', 1); catch; end; disp(1)")
        self.assertEqual([p.name for p in self.path.iterdir()], ["a user's folder"])

    def test_it_reads_all_three(self):
        self.run_program("run", str(SOURCE / "data/scenarios/reference/R1.toml"), "--quiet", "--csv", "a.csv", "--mat", "a.mat",
                         "--mat73", "h.mat")
        script = """a = load("a.mat"); h = load("h.mat"); c = dlmread("a.csv", ",", 4, 0);
          assert(a.i_a_A, h.i_a_A); assert(a.t_s, c(:, 1)); assert(a.i_a_A, c(:, 2)); assert(size(a.t_s, 2), 1);
          assert(a.units.i_a_A, "A"); assert(char(h.sixstep.digest(:)'), a.sixstep.digest); disp("read")"""
        told = subprocess.run(["octave-cli", "--norc", "--eval", script], cwd=self.path, capture_output=True, text=True)
        self.assertEqual(told.stdout.strip(), "read", told.stderr)


if __name__ == "__main__":
    unittest.main()
