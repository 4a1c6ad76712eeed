#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep man: well-formed roff with exactly the verbs and options that the program declares."""
import os
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest


class Manual(ProgramTest):
    def setUp(self):
        super().setUp()
        self.page = self.run_program("man").stdout
        self.plain = re.sub(r"\\f[BIR]", "", self.page).replace("\\-", "-")

    def verbs(self, *path):
        """Every command line to which --help leads."""
        told = self.run_program(*path, "--help").stdout
        inner = re.findall(r"(?m)^  (\w+) ", told.partition("Subcommands:")[2])
        if not inner:
            yield path, told
        for verb in inner:
            yield from self.verbs(*path, verb)

    def section(self, path):
        return re.search(rf"(?ms)^\.SS sixstep {' '.join(path)}\n(.*?)(?=^\.S[SH] )", self.plain).group(1)

    def test_every_verb_and_option_and_no_other(self):
        found = list(self.verbs())
        self.assertGreater(len(found), 10)
        self.assertEqual(re.findall(r"(?m)^\.SS sixstep (.*)$", self.plain), [" ".join(path) for path, _ in found])
        for path, told in found:
            declared = set(re.findall(r"(?m)^  (?:-\w,)?(--[\w-]+)", told)) - {"--help"}
            self.assertEqual(set(re.findall(r"(?m)^(--[\w-]+)", self.section(path))), declared, path)

    def test_every_table_of_a_scenario(self):
        overview = self.run_program("help").stdout.partition("Keys of a motor file")[0]
        for key in re.findall(r"(?m)^  (\w+) ", overview):
            self.assertRegex(self.plain, rf"(?m)^\[*{key}\]*$")

    def test_exit_codes_as_the_help_tells_them(self):
        listed = re.search(r"Exit codes: (.*)", self.run_program("--help").stdout).group(1).split(", ")
        status = self.plain.partition(".SH EXIT STATUS")[2].partition(".SH")[0]
        self.assertEqual([f"{code} {meaning}" for code, meaning in re.findall(r"\.TP\n(\d+)\n(.*)\n", status)], listed)

    def test_the_examples_run(self):
        examples = re.findall(r"(?m)^(sixstep .*)$", self.plain.partition(".SH EXAMPLES")[2])
        self.assertEqual(len(examples), 6)
        for command in examples:
            self.run_program(*command.split()[1:])
        self.assertIn("first.html", self.names())

    def test_the_page_of_the_command_line(self):
        """Every line of docs/reference/command-line.md has the stated effect. The commands run with a home folder of
        their own."""
        text = (SOURCE / "docs/reference/command-line.md").read_text(encoding="utf-8")
        script = "set -eu\n" + "".join(re.findall(r"(?ms)^```sh\n(.*?)^```$", text))
        # Other tests check compare's output; this one checks only that compare accepts these two lines.
        self.assertEqual(len(re.findall("(?m)^sixstep compare ", script)), 2)
        script = re.sub("(?m)^sixstep compare maxon-251601 .*$", "", script).replace("compare teknic-m2310p", "compare maxon-251601")
        (self.path / "bin").mkdir()
        (self.path / "bin/sixstep").symlink_to(PROGRAM)
        environment = dict(os.environ, HOME=str(self.path), PATH=f"{self.path / 'bin'}:{os.environ['PATH']}")
        done = subprocess.run(["bash", "-c", script], cwd=self.path, env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in ("first.toml", "first.html", "push.toml", "all.toml", "sixstep-motor.schema.json", ".bashrc", ".config/fish/completions/sixstep.fish"):
            self.assertTrue((self.path / name).stat().st_size, name)
        self.run_program("run", "--quiet", "first.toml", "push.toml", "all.toml")

    def test_formatters_have_nothing_to_say(self):
        (self.path / "sixstep.1").write_text(self.page)
        # The page has no date: the same program prints the same page on every day.
        linters = {"mandoc": ["-T", "lint", "-W", "style"], "groff": ["-man", "-ww", "-z", "-T", "utf8"]}
        present = [linter for linter in linters if shutil.which(linter)]
        if not present:
            self.skipTest("neither mandoc nor groff is installed")
        for linter in present:
            told = subprocess.run([linter, *linters[linter], "sixstep.1"], cwd=self.path, capture_output=True, text=True, timeout=300)
            self.assertEqual([line for line in (told.stdout + told.stderr).splitlines() if "missing date" not in line], [], linter)


if __name__ == "__main__":
    unittest.main()
