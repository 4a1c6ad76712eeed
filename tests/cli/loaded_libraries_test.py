#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Some libraries are loaded only when a command needs them. A missing library is named together with its package, and
the other commands run without it."""
import os
import pathlib
import subprocess
import unittest

from program import PROGRAM, SHORT, SOURCE, ProgramTest


class LoadedLibraries(ProgramTest):
    def without(self, library, *words):
        """Runs the program with another library in place of the named library."""
        zlib = next(pathlib.Path("/usr/lib").rglob("libz.so.1"))
        (self.path / "lib").mkdir(exist_ok=True)
        (self.path / "lib" / library).symlink_to(zlib)
        return subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, timeout=120,
                              env={**os.environ, "LD_LIBRARY_PATH": str(self.path / "lib")})

    def test_a_store_needs_sqlite_and_a_run_does_not(self):
        (self.path / "a.toml").write_text(SHORT.format(limit=10) + '[[spread]]\nkey = "motor_override.inductance_mH"\nrelative = 0.2\n')
        told = self.without("libsqlite3.so.0", "run", "a.toml", "--runs", "3", "--store", "s.sqlite")
        self.assertEqual(told.returncode, 2)
        self.assertIn("apt install libsqlite3-0", told.stderr)
        self.assertEqual(self.names(), ["a.toml", "lib"])
        (self.path / "lib/libsqlite3.so.0").unlink()
        self.assertEqual(self.without("libsqlite3.so.0", "run", "a.toml", "--quiet").returncode, 0)

    def test_a_search_needs_nlopt_before_it_writes_or_runs(self):
        plan = str(SOURCE / "data/plans/best-pwm.toml")
        told = self.without("libnlopt.so.0", "design", "--optimise", plan, "--store", "s.sqlite")
        self.assertEqual(told.returncode, 2)
        self.assertIn("apt install libnlopt0", told.stderr)
        self.assertEqual(self.names(), ["lib"])


if __name__ == "__main__":
    unittest.main()
