#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Existing files: a file that the program did not write is replaced only with --force. The program checks this before
the work begins."""
import os
import signal
import stat
import time
import unittest

from program import BRISK, SHORT, SOURCE, WIRING, Started, hall_log

LETTER = "Dear reader,\nthis is nobody's trace.\n"
EMF = f"motor emf {SOURCE}/data/recordings/bly172s-emf.csv --pole-pairs 4"
# The outputs of each verb; {} is the name of the file. slow.toml runs for minutes. Thus the time shows whether the refusal comes
# before the run.
OUTPUTS = {"run --csv": "run slow.toml --csv {}", "run --mat": "run slow.toml --mat {}", "run --mat73": "run slow.toml --mat73 {}",
           "run --vcd": "run slow.toml --vcd {}", "run --json": "run slow.toml --json {}", "run --html": "run slow.toml --html {}",
           "run --html of two": "run slow.toml slow.toml --html {}",
           "design --json": "design maxon-251601 --json {}", "design --toml": "design maxon-251601 --toml {}",
           "design --html": "design maxon-251601 --html {}",
           "design --models as JSON": "design maxon-251601 --models {}.json", "design --models as MAT": "design maxon-251601 --models {}.mat",
           "curve --csv": "curve maxon-251601 --csv {}", "curve --json": "curve maxon-251601 --json {}", "curve --html": "curve maxon-251601 --html {}",
           "motor wiring --svg": WIRING + " --svg {}", "motor wiring --html": WIRING + " --html {}", "motor wiring --toml": WIRING + " --toml {}",
           "motor commission --html": "motor commission maxon-251601 --html {}", "motor commission --write": "motor commission maxon-251601 --write {}",
           "motor identify --html": "motor identify log.csv --html {}", "motor identify --write": "motor identify log.csv --write {}",
           "motor emf --html": EMF + " --html {}", "motor emf --write": EMF + " --write {}", "motor emf --shape": EMF + " --shape {}",
           "export header": "export header slow.toml --out {}", "export fmu": "export fmu slow.toml --out {}"}
QUICK = {"run": ["--set", "duration_s=1e-4", "--quiet"], "export": ["--set", "duration_s=1e-4"], "design": ["--quick", "--quiet"], "curve": ["--points", "2", "--quiet"],
         "motor": ["--quiet"]}


class Overwriting(Started):
    def setUp(self):
        super().setUp()
        (self.path / "slow.toml").write_text(SHORT.format(limit=1000).replace("1e-4", "1e6"))
        (self.path / "log.csv").write_text(hall_log(turns=6))
        (self.path / "brisk.toml").write_text(BRISK)

    def test_a_file_of_somebody_else_stays_and_is_told_before_the_work(self):
        for what, command in OUTPUTS.items():
            words = command.format("letter").split()
            name = words[-1]
            (self.path / name).write_text(LETTER)
            with self.subTest(what):
                told = self.run_program(*words, code=2).stderr
                self.assertEqual(told, f"{name}: was not written by sixstep, or was changed after sixstep wrote it; name another file, or add --force to replace it\n")
                self.assertEqual((self.path / name).read_text(), LETTER)
        self.assertEqual(self.names(), ["brisk.toml", "letter", "letter.json", "letter.mat", "log.csv", "slow.toml"])

    def test_with_force_it_is_replaced_and_our_own_need_none(self):
        for what, command in OUTPUTS.items():
            words = command.format("out").split()
            words += QUICK[words[0]] + (["--despite", "nobody flashes it"] if words[1] == "header" else [])
            name = command.format("out").split()[-1]
            (self.path / name).write_text(LETTER)
            with self.subTest(what):
                self.run_program(*words, "--force")
                self.assertNotIn(LETTER.encode(), (self.path / name).read_bytes())
                self.run_program(*words)  # sixstep recognises its own files, so it replaces them
            (self.path / name).unlink()

    def test_a_scenario_of_a_design_that_was_gone_on_with_stays(self):
        words = ["design", "maxon-251601", "--quick", "--quiet", "--toml", "a.toml"]
        self.run_program(*words)
        self.run_program(*words)
        with open(self.path / "a.toml", "a", encoding="utf-8") as file:
            file.write("# 0.5 Nm did not do\n")
        self.assertIn("a.toml: was not written by sixstep, or was changed after sixstep wrote it", self.run_program(*words, code=2).stderr)

    def test_a_folder_of_somebody_elses_pages_stays(self):
        os.mkdir(self.path / "site")
        for name in ("index.html", "slow.csv", "slow.html", "slow.json"):
            (self.path / "site" / name).write_text(LETTER)
            told = self.run_program("run", "slow.toml", "--out", "site", code=2).stderr
            self.assertTrue(told.startswith(f"site/{name}: was not written by sixstep"), told)
            self.run_program("run", "slow.toml", "--out", "site", "--force", "--quiet", "--set", "duration_s=1e-4")
            self.run_program("run", "slow.toml", "--out", "site", "--quiet", "--set", "duration_s=1e-4")

    def test_a_partial_file_is_ours_too(self):
        for _ in range(2):  # the second run replaces the first one's files
            with self.started("run", "slow.toml", "--csv", "a.csv") as program:
                self.wait_until(lambda: any(name.endswith(".tmp") for name in self.names()))
                time.sleep(0.2)
                program.send_signal(signal.SIGINT)
                self.assertEqual(program.wait(timeout=20), 130)
            self.assertEqual(self.names(), ["a.partial.csv", "brisk.toml", "log.csv", "slow.toml"])

    def test_what_a_killed_run_left_is_in_nobodys_way(self):
        with self.started("run", "slow.toml", "--csv", "a.csv", "--html", "a.html") as program:
            self.wait_until(lambda: sum(name.endswith(".tmp") for name in self.names()) == 2)
            program.kill()
        left = self.names()
        self.run_program("run", "slow.toml", "--csv", "a.csv", "--html", "a.html", "--quiet", "--set", "duration_s=1e-4")
        self.assertEqual(self.names(), sorted(left + ["a.csv", "a.html"]))

    def test_permissions_stay(self):
        for name, mode in (("a.csv", 0o600), ("a.html", 0o640), ("a.mat", 0o600)):
            (self.path / name).touch()
            (self.path / name).chmod(mode)
        for _ in range(2):
            self.run_program("run", "slow.toml", "--csv", "a.csv", "--html", "a.html", "--mat73", "a.mat", "--quiet", "--set", "duration_s=1e-4")
            for name, mode in (("a.csv", 0o600), ("a.html", 0o640), ("a.mat", 0o600)):
                self.assertEqual(stat.S_IMODE((self.path / name).stat().st_mode), mode)

    def test_devices_take_what_they_get(self):
        for path in ("/dev/null", "/dev/stdout"):
            shown = self.run_program("run", "slow.toml", "--csv", path, "--quiet", "--set", "duration_s=1e-4").stdout
            self.assertEqual("t_s," in shown, path == "/dev/stdout")

    def test_a_name_without_room_is_told_before_the_run(self):
        for size in (248, 255, 256):
            name = "n" * (size - 4) + ".csv"
            told = self.run_program("run", "slow.toml", "--csv", name, code=2).stderr
            self.assertEqual(told, f"{name}: cannot be written: File name too long; choose a shorter name: an interrupted run adds .partial to it\n")
        self.run_program("run", "slow.toml", "--csv", "n" * 243 + ".csv", "--quiet", "--set", "duration_s=1e-4")


if __name__ == "__main__":
    unittest.main()
