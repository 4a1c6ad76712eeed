#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""own_controller_test.py PROGRAM: the files and commands of docs/howto/write-a-controller.md work unchanged. The
program reports the faults that the page lists."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from page import REPOSITORY, Page

PROGRAM = os.path.abspath(sys.argv.pop(1))
HOWTO = Page("docs/howto/write-a-controller.md")
PAGE = HOWTO.text
AROUND = 'motor = "maxon-251601"\nduration_s = 0.01\n[reference]\nvalue = 3\n[load]\nlocked = true\n'
CONTROL = """
[control]
drive = "own"
mode = "current"
own = { controller = "pi_in_integers.so", number = [{ name = "bandwidth", value = 0.08 }] }
"""
FINAL = '[[compare]]\nmetric = "mean"\nsignal = "current"\nfrom_s = 5e-3\nvalue = 3\nsource = "the setpoint"\n'
GIVES_UP = """
#include "sixstep/control/own/own_controller.h"
static const char* design(const sixstep_given* given, const double* values, void* config) { return 0; }
static void step(const void* config, void* state, const sixstep_measured* seen, double setpoint, sixstep_answer* answer) {
  answer->enabled = 1, answer->sink = 1, answer->duty = seen->bus_V / 0.0;
}
const sixstep_controller* sixstep_own_controller(void) {
  static const sixstep_controller own = {SIXSTEP_OWN_INTERFACE, SIXSTEP_ANSWERS_PAIR, "divides by 0", "", 0, 0, 0, 0, design, 0, step, 0};
  return &own;
}
"""


def commands():
    return [line[2:] for block in re.findall(r"```console\n(.*?)```", PAGE, re.S) for line in block.splitlines() if line.startswith("$ ")]


class OwnControllerPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        for part in ("sixstep", "data"):  # the commands need these files, as in a checkout
            (cls.path / part).symlink_to(REPOSITORY / part)
        for block in HOWTO.blocks:
            if block.word == "write":
                (cls.path / block.detail).write_text(block.text, encoding="utf-8")
        cls.compiled = [c for c in commands() if c.split()[0] in ("cc", "c++")]
        for command in cls.compiled:
            subprocess.run(command, shell=True, check=True, cwd=cls.path)
        (cls.path / "own.toml").write_text(AROUND + FINAL + CONTROL, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_program(self, *words, code=0):
        made = subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(made.returncode, code, made.stderr + made.stdout)
        return made

    def mean(self, *words):
        return json.loads(self.run_program("run", "own.toml", *words, "--json", "-").stdout)["compare"][0]["measured"]

    def test_everything_is_compiled(self):
        self.assertEqual(len(self.compiled), 3)
        self.assertEqual([c.split()[0] for c in commands()], ["cc", "./run", "cc", "c++", "./run", "tools/own_cost.sh", "./run"])

    def test_every_field_and_constant_of_the_interface_is_on_the_page(self):
        header = (REPOSITORY / "sixstep/control/own/own_controller.h").read_text(encoding="utf-8")
        code = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
        code = re.sub(r"\(\*(\w+)\)\(.*?\);", r" \1;", code, flags=re.S)  # removes members that are pointers to functions
        structs = re.findall(r"typedef struct \{(.*?)\} sixstep_", code, re.S)
        names = {name for struct in structs for name in re.findall(r"(\w+)(?:\[3\])?\s*[,;]", struct)}
        names |= set(re.findall(r"\b(SIXSTEP_\w+) =", code))
        self.assertGreater(len(names), 60)
        for name in names:
            self.assertRegex(HOWTO.prose, rf"`(?:leg\[k\]\.)?{name}(?:\[\w\])?[.`]", name)

    def test_what_was_counted_stands_in_the_comparison(self):
        words = [c for c in commands() if "--own-cost" in c][0].split()[1:]
        worst, flash = re.search(r"^Cortex-M4F +\d+ +(\d+) +\d+ +\d+ +(\d+) +\d+$", PAGE, re.M).groups()
        row = {"core": "Cortex-M4F", "tick": {"worst": int(worst)}, "flash_bytes": int(flash)}
        counted = {"controller": "PI in integers", "cores": [{"core": "Cortex-M0"}, row]}
        (self.path / "cost.json").write_text(json.dumps(counted), encoding="utf-8")
        told = json.loads(self.run_program(*words, "--runs", "0", "--json", "-").stdout)
        cost = next(c["cost"] for c in told["controllers"] if c["name"] == "PI in integers")
        self.assertEqual((cost["core"], cost["tick_instructions"], cost["flash_bytes"]), ("Cortex-M4F", worst, flash))
        for text, said in (("{", "does not contain the instruction counts of a user's controller"), (json.dumps({**counted, "cores": []}), "does not contain the instruction count on the Cortex-M4F"),
                           (json.dumps({**counted, "cores": [{**row, "flash_bytes": -1}]}), "does not contain the instruction count on the Cortex-M4F"),
                           (json.dumps({**counted, "controller": "another"}), '"another" is not a controller of --own')):
            (self.path / "cost.json").write_text(text, encoding="utf-8")
            self.assertIn(said, self.run_program(*words, code=2).stderr)

    def test_the_scenario_runs_and_its_number_counts(self):
        self.assertLess(abs(self.mean() - 3), 0.25)
        self.assertNotEqual(self.mean(), self.mean("--set", "control.own.number[0].value=0.05"))
        self.run_program("run", "own.toml", "--quiet", "--html", "own.html")
        page = (self.path / "own.html").read_text(encoding="utf-8")
        self.assertIn("PI in integers", page)
        self.assertIn("chopping as the controller commands", page)

    def test_a_report_names_no_current_reference_that_nobody_gave(self):
        """The controller mine.c limits no current and returns no current reference."""
        self.run_program("run", "mine.toml", "--quiet", "--html", "mine.html")
        page = (self.path / "mine.html").read_text(encoding="utf-8")
        self.assertNotIn("reference at", page.split('class="glance"')[1].split('<section id')[0])

    def test_a_number_is_varied_and_a_new_controller_is_told(self):
        vary = re.search(r'--vary "([^"]*)"`', PAGE).group(1)
        self.run_program("run", "mine.toml", "--vary", vary, "--store", "own.db", "--csv", "own.csv")
        rows = [line for line in (self.path / "own.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(rows), 6, rows)
        shutil.copy(self.path / "mine.so", self.path / "kept.so")
        with open(self.path / "mine.so", "ab") as file:
            file.write(b"\0")  # another file, as after a new compilation
        try:
            told = self.run_program("run", "mine.toml", "--vary", vary, "--store", "own.db", "--resume", code=2)
            self.assertIn("own.db", told.stderr)
        finally:
            shutil.move(self.path / "kept.so", self.path / "mine.so")

    def test_the_command_that_a_message_prints_compiles(self):
        for source, kind in (("again.c", "mine.c"), ("again.cpp", "data/controllers/six_step_again.cpp")):
            shutil.copy(self.path / kind, self.path / source)
            told = self.run_program("run", "mine.toml", "--set", f"control.own.controller={source}", "--set", "control.own.number=[]", code=2).stderr
            command = re.search(r"name the compiled file: (.*), where FOLDER", told).group(1).replace("FOLDER", ".")
            (self.path / "again.so").unlink(missing_ok=True)
            subprocess.run(command, shell=True, check=True, cwd=self.path)
            self.run_program("run", "mine.toml", "--set", "control.own.controller=again.so", "--set", "control.own.number=[]", "--quiet")

    def test_stands_in_the_comparison(self):
        words = next(c for c in commands() if c.startswith("./run compare")).split()[1:]
        told = json.loads(self.run_program(*words, "--own", "six_step_again.so", "--runs", "1", "--json", "-").stdout)
        rows = {c["name"]: c for c in told["controllers"]}
        self.assertEqual(rows["six-step, again"]["nominal"], rows["six-step, soft"]["nominal"])
        self.assertTrue(rows["PI in integers"]["nominal"])
        self.assertEqual(rows["PI in integers"]["runs"], 1)

    def test_what_goes_wrong_is_told(self):
        wrong = {"own": "own.toml", "said": [
            (("--set", "control.own.controller=nowhere.so"), 2, "nowhere.so"),
            (("--set", "control.own.controller=own.toml"), 2, "is not a compiled library"),
            (("--set", "control.own.controller=short.c"), 2, "is not a compiled library"),
            (("--set", "control.own.controller=mine.so"), 2, "is not the name of a number of the controller"),
            (("--set", "control.own.number[0].name=width"), 2, "bandwidth, limit_A"),
            (("--set", "control.mode=position"), 2, "PI in integers controls a current or a speed"),
            (("--set", "control.limits.current_A=3"), 2, "--set control.limits.current_A: control.limits applies to the built-in loops"),
            (("--set", "control.arithmetic=q15"), 2, "has its own number types")]}
        (self.path / "short.c").write_text("int a;\n", encoding="utf-8")
        for words, code, said in wrong["said"]:
            with self.subTest(words=words):
                self.assertIn(said, self.run_program("run", "own.toml", *words, code=code).stderr)
        (self.path / "wrong.c").write_text(GIVES_UP, encoding="utf-8")
        subprocess.run("cc -w -shared -fPIC -I. wrong.c -o wrong.so", shell=True, check=True, cwd=self.path)
        made = self.run_program("run", "own.toml", "--set", "control.own={controller='wrong.so'}", code=3)
        self.assertIn("wrong.so: the controller answered duty = infinite in step 1, which must lie in 0 to 1", made.stderr + made.stdout)
        self.assertIn("own", self.run_program("export", "header", "own.toml", code=2).stderr)
        self.assertIn("is the name of another controller", self.run_program(
            "compare", "maxon-251601", "--own", "six_step_again.so", "--own", "six_step_again.so", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
