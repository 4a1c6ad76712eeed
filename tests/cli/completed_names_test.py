#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Completion by Tab of files with hostile names, in each shell with its usual settings. The completed word is the
name of the file, and the shell executes nothing else."""
import os
import pty
import select
import shutil
import time
import unittest

from hostile import FILES, is_visible
from program import PROGRAM, ProgramTest

# A script that passes completions to the program, and records the arguments of every other call.
NOTING = """#!/bin/bash
case $1 in __complete | completion) exec {program} "$@";; esac
printf '%s\\0' "$@" >{folder}/called.part && mv {folder}/called.part {folder}/called
"""
SHELLS = {"bash": (["bash", "--norc", "--noprofile", "-i"], "bind 'set enable-bracketed-paste off'; set +H; source <(sixstep completion bash)"),
          "zsh": (["zsh", "-f", "-i"], "autoload -Uz compinit; compinit -u -D; unsetopt bang_hist; source <(sixstep completion zsh)"),
          "fish": (["fish", "-N", "-i"], "sixstep completion fish | source")}


class CompletedNames(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.path / "bin").mkdir()
        (self.path / "bin/sixstep").write_text(NOTING.format(program=PROGRAM, folder=self.path))
        (self.path / "bin/sixstep").chmod(0o755)
        for number, name in enumerate(FILES):
            (self.path / f"d{number}").mkdir()
            with open(os.path.join(os.fsencode(self.path), f"d{number}".encode(), name + b".toml"), "w"):
                pass

    def shell(self, words):
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.path)
            os.execvpe(words[0], words, dict(os.environ, HOME=str(self.path), PATH=f"{self.path / 'bin'}:{os.environ['PATH']}",
                                             TERM="xterm", LC_ALL="C.UTF-8", INPUTRC="/dev/null"))
        return pid, terminal

    def typed(self, terminal, line):
        """Types a line in the terminal, and returns the arguments with which the shell calls sixstep."""
        called = self.path / "called"
        called.unlink(missing_ok=True)
        os.write(terminal, line.encode())
        deadline, seen = time.monotonic() + 20, b""
        while not called.exists():
            self.assertLess(time.monotonic(), deadline, seen[-500:])
            if select.select([terminal], [], [], 0.01)[0]:
                seen += os.read(terminal, 65536)
        return called.read_bytes().split(b"\0")[:-1]

    def check(self, shell):
        words, setup = SHELLS[shell]
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")
        pid, terminal = self.shell(words)
        self.assertEqual(self.typed(terminal, setup + "; sixstep ready\n"), [b"ready"])
        before = {str(number): os.listdir(self.path / f"d{number}") for number in range(len(FILES))}
        for number, name in enumerate(FILES):
            with self.subTest(shell=shell, name=name):
                # The shell is in the file's own folder, because a name may begin with any character.
                self.typed(terminal, f"cd {self.path}/d{number}; sixstep here\n")
                found = self.typed(terminal, "sixstep run \t\n")
                if name.startswith(b"-"):  # fish completes no word that begins with a dot
                    self.assertIn(found, ([b"run", b"./" + name + b".toml"], [b"run"] if shell == "fish" else []))
                elif is_visible(name):  # the program offers only visible names; the shell may offer other names itself
                    self.assertEqual(found, [b"run", name + b".toml"])
        self.typed(terminal, f"cd {self.path}; sixstep here\n")
        self.assertEqual(self.typed(terminal, "sixstep run d0/\t\n"), [b"run", b"d0/" + FILES[0] + b".toml"])
        self.assertEqual({str(number): os.listdir(self.path / f"d{number}") for number in range(len(FILES))}, before, "nothing else was run")
        self.assertEqual(sorted(set(self.names()) - {f"d{n}" for n in range(len(FILES))} - {"bin", "called", ".config", ".cache", ".local"}), [])
        os.close(terminal)
        os.waitpid(pid, 0)

    def test_bash(self):
        self.check("bash")

    def test_zsh(self):
        self.check("zsh")

    def test_fish(self):
        self.check("fish")


if __name__ == "__main__":
    unittest.main()
