#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""one_engine_test.py BUILD: no object that is compiled for size has the engine's templates. Otherwise the linker
could use them in place of the fast templates.

If several objects instantiate a template, the linker keeps the first copy. Once three sources of sixstep/analysis
were compiled with -Os, and each run of the command line had an eighth more instructions."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop())
# Code that runs at least once per segment. The set-up of a plant runs once before a run, and may be anywhere.
ENGINE = re.compile(r"sixstep::(sim::run<|rig::Rig<|plant::(general::)?(Plant<\w+>::(?!Plant\()|mode_guards|expand|detail::copper_energy)|series::(first_root|detail::))")


def objects(for_size):
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        name = re.search(r" -o (\S+) ", entry["command"])[1]
        levels = re.findall(r" -O(\S)", entry["command"])
        if name.endswith(".o") and not name.startswith(("tests/", "benchmarks/")) and (levels[-1] == "s") == for_size:
            yield BUILD / name


def engine_of(objects_):
    """{object: its functions of the engine}. Only weak functions count, because only these can replace each other."""
    found = {}
    for path in objects_:
        for line in subprocess.run(["nm", "-C", "--defined-only", path], check=True, text=True, stdout=subprocess.PIPE).stdout.splitlines():
            words = line.split(" ", 2)
            if words[1] == "W" and ENGINE.search(words[2]):
                found.setdefault(path.name, []).append(words[2])
    return found


class OneEngine(unittest.TestCase):
    def test_objects_compiled_for_size_have_none(self):
        self.assertEqual(engine_of(objects(for_size=True)), {})

    def test_the_others_do(self):
        """The objects compiled for speed have these functions. Otherwise the pattern would find nothing."""
        fast = engine_of(objects(for_size=False))
        self.assertIn("rig_lean.cpp.o", fast)
        self.assertTrue(any("sim::run<" in name for name in fast["rig_lean.cpp.o"]))


if __name__ == "__main__":
    unittest.main()
