#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Completion in the three shells. Each shell has its own script and splits the line into words in its own way."""
import os
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest

# What a shell's function does after Tab: it prints the candidates, one per line.
BASH = """
set -u
source <("$PROGRAM" completion bash)
COMP_LINE=$LINE COMP_POINT=${#LINE} COMPREPLY=()
COMP_WORDBREAKS=$' \\t\\n"\\'><=;|&(:'
compopt() { echo "compopt $*" >&2; }
_sixstep
printf '%s\\n' "${COMPREPLY[@]}"
"""
ZSH = """
compdef() { [[ $* == '_sixstep sixstep' ]] }
compadd() {
  while (( $# )); do case $1 in (-S|-d) shift 2;; (-a) print -l -- ${(P)2}; shift 2;; (*) shift;; esac; done
}
source <("$PROGRAM" completion zsh)
words=(${(z)LINE}); [[ $LINE == *' ' ]] && words+=("")
CURRENT=$#words
_sixstep
"""
FISH = """
"$PROGRAM" completion fish | source
complete -C "$LINE"
"""


class Completion(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "bin").mkdir()
        (self.path / "bin/sixstep").symlink_to(PROGRAM)
        (self.path / "hill.toml").write_text("")
        (self.path / "house.csv").write_text("")
        (self.path / "high").mkdir()
        (self.path / "high/low.toml").write_text("")

    def ask(self, shell, line):
        words = {"bash": ["bash", "--norc", "-c", BASH], "zsh": ["zsh", "-f", "-c", ZSH], "fish": ["fish", "-N", "-c", FISH]}[shell]
        if not shutil.which(words[0]):
            self.skipTest(f"{shell} is not installed")
        environment = dict(os.environ, PATH=f"{self.path / 'bin'}:{os.environ['PATH']}", LINE=line, PROGRAM=PROGRAM, HOME=str(self.path))
        result = subprocess.run(words, cwd=self.path, env=environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.noted = result.stderr
        return [word.split("\t")[0] for word in result.stdout.splitlines() if word]

    def everywhere(self, line, expected, bash=None):
        for shell in ("bash", "zsh", "fish"):
            with self.subTest(shell=shell, line=line):
                self.assertEqual(sorted(self.ask(shell, line)), sorted(bash if bash and shell == "bash" else expected))

    def test_verbs(self):
        self.everywhere("sixstep ru", ["run"])
        self.everywhere("sixstep motor s", ["show"])

    def test_options(self):
        self.everywhere("sixstep run --js", ["--json"])
        self.everywhere("sixstep run --quiet --q", [])  # --quiet is already in the line

    def test_scenario_files_and_folders(self):
        self.everywhere("sixstep run hi", ["high/", "hill.toml"])
        self.everywhere("sixstep run hill.toml high/", ["high/low.toml"])

    def test_keys_and_their_words(self):
        self.everywhere("sixstep run hill.toml --set pwm.per", ["pwm.period_s="])
        self.everywhere("sixstep run hill.toml --set pwm.chopping=h", ["pwm.chopping=hard"], bash=["hard"])
        self.everywhere("sixstep help pwm.tim", ["pwm.timer_Hz"])

    def test_motors_and_words_of_options(self):
        self.everywhere("sixstep curve maxon-25", ["maxon-251601"])
        self.everywhere("sixstep run hill.toml --on c", ["cortex-m0", "cortex-m4"])
        self.everywhere("sixstep run hill.toml --on hi", ["high/", "hill.toml"])
        self.everywhere("sixstep new --mode ", ["current", "duty", "position", "speed"])
        self.everywhere("sixstep design maxon-251601 --mode ", ["current", "position", "speed"])

    def test_bash_adds_no_space_where_more_is_to_come(self):
        self.ask("bash", "sixstep run --set pwm.per")
        self.assertEqual(self.noted, "compopt -o nospace\n")
        self.ask("bash", "sixstep ru")
        self.assertEqual(self.noted, "")

    def test_every_word_that_is_offered_is_taken(self):
        """A verb accepts every word that the completion offers for its option. Thus the lists of words are up to
        date."""
        def offered(*words):
            return [line.split("\t")[0] for line in self.run_program("__complete", *words, "").stdout.splitlines()]
        for words, end in ((("new", "--mode"), ["--voltage", "0"]), (("design", "--method"), ["x"]), (("design", "--chopping"), ["x"]),
                           (("design", "--mode"), ["x"]), (("export", "header", "--arithmetic"), ["x"])):
            self.assertGreater(len(offered(*words)), 1)
            for word in offered(*words):
                told = self.run_program(*words, word, *end, code=2).stderr
                self.assertNotIn(words[-1], told)
        for style in offered("motor", "new", "--style"):
            self.run_program("motor", "new", "--style", style)
        for kind in offered("schema"):
            self.run_program("schema", kind)
        for shell in offered("completion"):
            self.run_program("completion", shell)
        for verb in offered():
            self.run_program(verb, "--help")

    def test_an_unknown_shell(self):
        self.assertIn("SHELL = tcsh must be one of bash, zsh, fish", self.run_program("completion", "tcsh", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
