#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A run's CSV, MAT 5 and MAT 7.3 as Octave reads them. Octave is 117 packages: `tools/install.sh long` brings it, and
`ctest --preset long` asks it."""
import shutil
import subprocess
import unittest

from program import SOURCE, ProgramTest


class Octave(ProgramTest):
    def test_it_reads_all_three(self):
        self.assertTrue(shutil.which("octave-cli"), "Octave is not installed: tools/install.sh long")
        self.run_program("run", str(SOURCE / "data/scenarios/reference/R1.toml"), "--quiet", "--csv", "a.csv", "--mat", "a.mat",
                         "--mat73", "h.mat")
        script = """a = load("a.mat"); h = load("h.mat"); c = dlmread("a.csv", ",", 4, 0);
          assert(a.i_a_A, h.i_a_A); assert(a.t_s, c(:, 1)); assert(a.i_a_A, c(:, 2)); assert(size(a.t_s, 2), 1);
          assert(a.units.i_a_A, "A"); assert(char(h.sixstep.digest(:)'), a.sixstep.digest); disp("read")"""
        told = subprocess.run(["octave-cli", "--norc", "--eval", script], cwd=self.path, capture_output=True, text=True)
        self.assertEqual(told.stdout.strip(), "read", told.stderr)


if __name__ == "__main__":
    unittest.main()
