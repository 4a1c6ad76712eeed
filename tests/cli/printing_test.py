#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The output of the program with several receivers: pipes, full devices, readers that have ended, and closed streams."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from program import BRISK, PROGRAM, SHORT, SOURCE, WIRING, ProgramTest, Started, hall_log

EMF = f"motor emf {SOURCE}/data/recordings/bly172s-emf.csv --pole-pairs 4"
R3 = str(SOURCE / "data/scenarios/reference/R3.toml")


class Pipes(Started):
    def test_a_reader_that_has_seen_enough_ends_it_quietly(self):
        self.write("a.toml", 1000)
        for words, code in (("run a.toml --json -", 0), ("help", 0),
                            (f"run {R3} --quiet --set duration_s=1e4 --csv /dev/stdout", 141)):
            result = subprocess.run(["bash", "-c", f"{PROGRAM} {words} 2>told | head -n 1; echo ${{PIPESTATUS[0]}}"],
                                    cwd=self.path, capture_output=True, text=True, timeout=20)
            self.assertEqual(result.stdout.splitlines()[-1], str(code), words)
            self.assertNotIn("ipe", (self.path / "told").read_text())

    def test_a_pipe_that_does_not_wait_gets_all_of_it(self):
        whole = self.run_program("schema").stdout
        self.assertGreater(len(whole), 1 << 16, "more than a pipe holds")
        ours, theirs = os.pipe()
        os.set_blocking(theirs, False)
        with self.started("schema", stdout=theirs) as program:
            os.close(theirs)
            time.sleep(0.2)
            with open(ours, encoding="utf-8") as pipe:
                self.assertEqual(pipe.read(), whole)
            self.assertEqual((program.wait(timeout=20), program.stderr.read()), (0, ""))

    def test_nothing_but_words_reaches_a_pipe(self):
        with self.started("run", self.write("a.toml", 1000), "--set", "duration_s=1e4") as program:
            time.sleep(0.7)  # a terminal would show a progress bar after this time
            program.send_signal(signal.SIGINT)
            out, told = program.communicate(timeout=20)
        self.assertNotRegex(out + told, r"[\r\x1b]|real time")


class Unheard(ProgramTest):
    """Standard output is not writable. Every verb reports this."""
    VERBS = ["--version", "--help", "run --help", "help", "help pwm", "help pwm.period_s", "man", "schema", "schema motor",
             "completion bash", "completion zsh", "completion fish", "__complete run --", "new", "new --full", "motor list",
             "motor list --json", "motor show maxon-251601", "motor check maxon-251601", "motor new",
             "design maxon-251601 --quick", "design maxon-251601 --quick --json - --quiet", "compare maxon-251601 --period 100e-6 --runs 0", "curve maxon-251601 --points 2",
             "compare maxon-251601 --period 100e-6 --runs 0 --quiet --json -", "curve maxon-251601 --points 2 --json -", WIRING, WIRING + " --json", "motor commission maxon-251601", "motor commission maxon-251601 --json", "motor identify log.csv", "motor identify log.csv --json", EMF, EMF + " --json",
             "export header pi.toml --despite unread", "run a.toml", "run a.toml --json -",
             "run a.toml b.toml --html c.html", "run spread.toml --runs 3"]

    def setUp(self):
        super().setUp()
        self.write("a.toml", 1000), self.write("b.toml", 1000), self.write("failing.toml", -1)
        (self.path / "spread.toml").write_text(SHORT.format(limit=1000) + '[[spread]]\nkey = "motor_override.resistance_ohm"\nrelative = 0.1\n')
        (self.path / "log.csv").write_text(hall_log(turns=6))
        (self.path / "brisk.toml").write_text(BRISK)
        (self.path / "pi.toml").write_text((SOURCE / "data/scenarios/current-square.toml").read_text())

    def answer(self, words, stdout):
        told = subprocess.run([PROGRAM, *words.split()], cwd=self.path, stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=20)
        return told.returncode, told.stderr

    def test_every_verb_is_here(self):
        listed = re.findall(r"^  ([a-z]+) ", self.run_program("--help").stdout.split("Subcommands:")[1], re.M)
        self.assertEqual(sorted({words.split()[0] for words in self.VERBS if words[:1] != "-"} - {"__complete"}), sorted(listed))

    def test_the_exit_codes_are_those_of_the_page(self):
        page = dict(re.findall(r"^\| (\d+) \| (.*) \|$", (SOURCE / "docs/reference/command-line.md").read_text(), re.M))
        told = dict(re.findall(r"(\d+) ([^,\n]+)", self.run_program("--help").stdout.split("Exit codes:")[1]))
        self.assertEqual(list(page), list(told))
        for code, meaning in told.items():
            self.assertTrue(page[code].startswith(meaning), page[code])

    def test_a_full_disk_is_told_and_is_bad_input(self):
        with open("/dev/full", "w") as full:
            for words in self.VERBS:
                with self.subTest(words):
                    code, told = self.answer(words, full)
                    self.assertEqual(code, 2)
                    self.assertTrue(told.endswith("standard output: cannot be written: No space left on device; send the output "
                                                  "to a file with free space, or to a program that reads all lines\n"), told)
            self.assertEqual(self.answer("run failing.toml", full)[0], 2)
            self.assertEqual(self.answer(f"run {SOURCE}/data/scenarios/product-broken-hall-line.toml", full)[0], 3, "a fault is graver")

    def test_a_reader_that_has_gone_is_no_error(self):
        ours, theirs = os.pipe()
        os.close(ours)
        for words in self.VERBS:
            with self.subTest(words):
                code, told = self.answer(words, theirs)
                self.assertEqual(code, 141)
                self.assertNotIn("standard output", told)
        self.assertEqual(self.answer("run failing.toml", theirs), (1, ""), "a verdict stays one")
        os.close(theirs)

    def test_what_is_printed_reaches_no_file_where_standard_output_is_closed(self):
        out = subprocess.run(["bash", "-c", f"{PROGRAM} run a.toml --csv a.csv --json a.json >&-"], cwd=self.path, capture_output=True, text=True)
        self.assertEqual((out.returncode, out.stdout), (2, ""))
        self.assertEqual(out.stderr, "standard output: cannot be written: Bad file descriptor; send the output to a file with free space, or to a program that reads all lines\n")
        self.assertNotIn("experiment", (self.path / "a.csv").read_text() + (self.path / "a.json").read_text())
        self.assertTrue(json.loads((self.path / "a.json").read_text())["complete"])


if __name__ == "__main__":
    unittest.main()
