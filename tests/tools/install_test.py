#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""install_test.py BUILD: the files that cmake --install copies from this build work at any place, without the
checkout.

The program must not contain a path of the sources, so all calls are made in another folder."""
import gzip
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else ROOT / "build/dev"
EXECUTABLE = {"bin/sixstep", "libexec/sixstep/sixstep-avr-board", "share/sixstep/tools/firmware_image.sh",
              "share/sixstep/docs/slurm/plan.sh"}
FILES = """bin/sixstep
share/man/man1/sixstep.1.gz
share/bash-completion/completions/sixstep
share/fish/vendor_completions.d/sixstep.fish
share/zsh/site-functions/_sixstep
share/doc/sixstep/copyright
share/doc/sixstep/changelog.gz
share/sixstep/README.md
share/sixstep/octave/sixstep.m
share/sixstep/sixstep_control.hpp""".splitlines()
FOLDERS = ["data/controllers", "data/measured", "data/motors", "data/plans", "data/recordings", "data/scenarios", "docs", "faces/firmware",
           "faces/loop/core", "sixstep/control"]
DRIVES = ["LEAN", "PRODUCT", "SENSORLESS", "FIELD", "SENSORLESS_FIELD"]
# At the first Tab zsh reads the file and calls its function.
ZSH = """
compadd() {
  while (( $# )); do case $1 in (-S|-d) shift 2;; (-a) print -l -- ${(P)2}; shift 2;; (*) shift;; esac; done
}
fpath=($FOLDER $fpath)
autoload -U _sixstep
words=(sixstep ru) CURRENT=2
_sixstep
_sixstep
"""


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = pathlib.Path(folder.name).resolve() / "a prefix"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", cls.prefix], check=True, capture_output=True)
        # The moved program finds its files relative to itself.
        cls.prefix = cls.prefix.rename(cls.prefix.with_name("another prefix"))
        cls.share = cls.prefix / "share/sixstep"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        self.environment = {"PATH": f"{self.prefix / 'bin'}:/usr/bin:/bin", "HOME": str(self.here), "LC_ALL": "C.UTF-8",
                            "TMPDIR": str(self.here)}

    def call(self, *words, code=0, **environment):
        done = subprocess.run([str(word) for word in words], cwd=self.here, capture_output=True, text=True, timeout=120, check=False,
                              env=self.environment | environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def is_inside(self, path):
        return path.resolve().is_relative_to(self.prefix)

    def test_files_are_where_they_are_looked_for(self):
        for name in FILES:
            self.assertTrue((self.prefix / name).is_file(), name)
        examples = ["faces/c/example"] if (self.prefix / "lib/libsixstep.so").exists() else []
        for name in FOLDERS + examples:  # the files of git in these folders
            listed = subprocess.run(["git", "ls-files", name], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split("\n")
            for file in filter(None, listed):
                if pathlib.Path(file).name not in ("CMakeLists.txt", ".clang-tidy"):
                    self.assertTrue((self.share / file).is_file(), file)
        self.assertTrue((self.prefix / "include/sixstep/control/own/own_controller.h").is_file())
        self.assertTrue((self.prefix / "share/doc/sixstep/docs/reference/command-line.md").is_file())

    def test_modes_and_links(self):
        for path in self.prefix.rglob("*"):
            name = path.relative_to(self.prefix).as_posix()
            if path.is_symlink():
                self.assertFalse(os.path.isabs(os.readlink(path)), name)
                self.assertTrue(path.exists() and self.is_inside(path), name)
            elif path.is_file():
                self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o755 if name in EXECUTABLE else 0o644, name)

    def test_no_path_of_the_sources_is_in_it(self):
        program = (self.prefix / "bin/sixstep").read_bytes()
        for folder in (ROOT, BUILD):
            self.assertNotIn(str(folder).encode(), program)

    def test_manual_page_and_completion_are_the_programs(self):
        self.assertEqual(gzip.decompress((self.prefix / "share/man/man1/sixstep.1.gz").read_bytes()).decode(),
                         self.call("sixstep", "man").stdout)
        for shell, file in zip(("bash", "fish", "zsh"), FILES[2:5]):
            self.assertEqual((self.prefix / file).read_text(encoding="utf-8"), self.call("sixstep", "completion", shell).stdout)

    def test_zsh_answers_at_the_first_tab(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed")
        answers = self.call("zsh", "-f", "-c", ZSH, FOLDER=str(self.prefix / "share/zsh/site-functions")).stdout
        self.assertEqual(answers.split(), ["run", "run"])

    def test_a_scenario_to_start_from(self):
        self.assertIn("maxon-251601", self.call("sixstep", "motor", "list").stdout)
        self.call("sixstep", "new", "mine", "--mode", "current")
        self.assertIn("hold", self.call("sixstep", "run", "mine.toml", "--html", "mine.html").stdout)
        self.assertTrue((self.here / "mine.html").is_file())

    def test_examples(self):
        scenarios = self.share / "data/scenarios"
        thesis = sorted((scenarios / "thesis").glob("*.toml"))
        self.assertIn("all 58 requirements hold", self.call("sixstep", "run", *thesis).stdout)
        self.call("sixstep", "run", scenarios / "current-square-board.toml")
        self.call("sixstep", "motor", "check", self.share / "data/motors/maxon-251601.toml")
        # The plan names its scenario relative to itself.
        self.call("sixstep", "run", self.share / "data/plans/which-pwm.toml", "--only", "1")

    def test_controllers_of_ones_own(self):
        own = self.share / "data/controllers"
        self.call("cc", "-O1", "-ffp-contract=off", "-shared", "-fPIC", f"-I{self.prefix / 'include'}", own / "pi_in_integers.c",
                  "-o", "pi_in_integers.so")
        (self.here / "own.toml").write_text('motor = "maxon-251601"\nduration_s = 0.01\n[control]\nmode = "current"\ndrive = "own"\n'
                                            '[control.own]\ncontroller = "pi_in_integers.so"\n[reference]\nvalue = 1\n')
        self.call("sixstep", "run", "own.toml")
        self.call("c++", "-std=c++20", "-fsyntax-only", f"-I{self.prefix / 'include'}", own / "six_step_again.cpp")

    def test_a_program_with_the_library(self):
        """A program uses the library through pkg-config and through CMake, in C and in C++. The library is installed
        at another place than it was configured for."""
        if not (self.prefix / "lib/libsixstep.so").exists():
            self.skipTest("built without libsixstep")
        example = self.share / "faces/c/example/advance.c"
        scenario = self.share / "data/scenarios/current-square.toml"
        flags = self.call("pkg-config", "--cflags", "--libs", "sixstep", PKG_CONFIG_PATH=str(self.prefix / "share/pkgconfig")).stdout.strip()
        self.call("sh", "-c", f"cc -std=c99 '{example}' {flags} -o by_pkg_config")
        self.call("sh", "-c", f"c++ -x c++ -fsyntax-only '{self.prefix / 'include/sixstep.h'}' {flags}")
        by_pkg_config = self.call("./by_pkg_config", scenario, LD_LIBRARY_PATH=str(self.prefix / "lib")).stdout
        (self.here / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.16)\nproject(mine C)\nfind_package(sixstep 0.1 REQUIRED)\n"
                                                  f'add_executable(mine "{example}")\ntarget_link_libraries(mine PRIVATE sixstep::sixstep)\n')
        self.call("cmake", "-B", "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.call("cmake", "--build", "build")
        by_cmake = self.call("build/mine", scenario).stdout
        self.assertEqual(by_cmake, by_pkg_config)
        self.assertTrue(by_cmake.endswith(self.call("sixstep", "run", scenario, "--json", "-").stdout))

    def test_exported_headers(self):
        for words, folder in (((), self.prefix / "include"), (("--single-header",), self.share)):
            self.call("sixstep", "export", "header", self.share / "data/scenarios/current-square-board.toml", "--arithmetic", "q15",
                      "--out", "drive_config.hpp", "--force", *words)
            (self.here / "main.cpp").write_text('#include "drive_config.hpp"\nint main() { return 0; }\n')
            self.call("c++", "-std=c++20", "-fsyntax-only", f"-I{folder}", "main.cpp")

    def test_programs_of_cores_are_whole(self):
        (self.here / "drive_config.hpp").write_text("")
        inside = (f"-I{self.share / 'faces/firmware/bare'}", f"-I{self.share}", f"-I{self.here}")
        programs = [(self.share / "faces/loop/core/main.cpp", f"-DSIXSTEP_{drive}_DRIVE") for drive in DRIVES]
        programs += [(self.share / f"faces/firmware/example/{board}/main.cpp", "-DSIXSTEP_DESPITE") for board in ("avr", "cortex_m")]
        for program, drive in programs:
            needed = self.call("c++", "-std=c++20", "-MM", *inside, drive, program).stdout.replace("\\ ", "?").split()
            for file in needed[1:]:
                file = pathlib.Path(file.replace("?", " ").rstrip("\\"))
                self.assertTrue(not file.name or file.is_relative_to(self.here) or self.is_inside(file), file)

    def test_a_core_is_compiled_for_from_what_was_installed(self):
        """Replacement compilers only record their arguments."""
        (self.here / "bin").mkdir()
        for name in ("arm-none-eabi-g++", "qemu-system-arm", "clang++-19", "avr-gcc"):
            program = self.here / "bin" / name
            program.write_text('#!/bin/sh\nprintf "%s\\n" "$@" >>"$NOTED"\nexit 1\n')
            program.chmod(0o755)
        environment = {"PATH": f"{self.here / 'bin'}:{self.environment['PATH']}", "NOTED": str(self.here / "noted")}
        cores = {"cortex-m4": ("thesis/7.4-speed-exact-design.toml", "faces/loop/core/main.cpp")}
        if (self.prefix / "libexec/sixstep/sixstep-avr-board").exists():
            cores["avr"] = ("thesis/avr/8b.toml", "faces/firmware/example/avr/main.cpp")
        for core, (scenario, program) in cores.items():
            with self.subTest(core=core):
                told = self.call("sixstep", "run", self.share / "data/scenarios" / scenario, "--on", core, code=2, **environment).stderr
                self.assertIn("could not compile the drive", told)
                self.assertIn(f"{self.share / program}\n", (self.here / "noted").read_text(encoding="utf-8"))

    def test_an_image_to_flash_lands_where_it_is_asked_for(self):
        tool = self.share / "tools/firmware_image.sh"
        if not shutil.which("arm-none-eabi-g++", path=self.environment["PATH"]):
            self.assertIn("packages.txt", self.call(tool, "stm32f303", code=1).stderr)
            return
        self.call(tool, "stm32f303")
        self.assertTrue((self.here / "firmware/stm32f303/image.hex").is_file())


if __name__ == "__main__":
    unittest.main()
