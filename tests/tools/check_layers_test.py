#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each kind of layer error is put into a small tree. The check must name the file, the line and the cure."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TOOL = REPOSITORY / "tools" / "check_layers.py"
PICTURE = "# x\n\n```layers\nbase ->\ncontrol ->\nplant -> base\nstudy -> plant base\ntext -> study base\ncli -> text\n```\n"


class CheckLayers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("docs/architecture.md", PICTURE)
        self.write("sixstep/plant/motor.hpp", '#include <vector>\n#include "sixstep/base/angle.hpp"\n')

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def run_tool(self):
        done = subprocess.run([sys.executable, TOOL, "--root", self.root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def expect(self, path, text, *said):
        self.write(path, text)
        code, out, _ = self.run_tool()
        self.assertEqual(code, 1, out)
        self.assertEqual(len(out.splitlines()), 1, out)
        for words in said:
            self.assertIn(words, out)

    def test_clean_tree_passes(self):
        self.write("text/toml/toml.cpp", '#include <toml++/toml.h>\n#include "sixstep/study/run/run.hpp"\n')
        self.write("faces/cli/main.cpp", '#include <CLI/CLI.hpp>\n#include "text/toml/toml.hpp"\n#include "faces/cli/x.hpp"\n')
        self.assertEqual(self.run_tool(), (0, "", ""))

    def test_upward_include(self):
        self.expect("sixstep/base/angle.hpp", '#pragma once\n#include "sixstep/plant/motor.hpp"\n',
                    "sixstep/base/angle.hpp:2:", "base may include nothing, not plant", "down a layer")

    def test_layer_that_is_only_reachable_through_another(self):
        self.expect("faces/cli/main.cpp", '#include "sixstep/plant/motor.hpp"\n', "cli may include text, not plant")

    def test_corners_of_a_room(self):
        picture = PICTURE.replace("text ->", "study/ask ->\nstudy/run -> study/ask\ntext ->")
        self.write("docs/architecture.md", picture)
        self.write("sixstep/study/run/run.cpp", '#include "sixstep/study/ask/ask.hpp"\n#include "sixstep/base/angle.hpp"\n')
        self.write("text/toml/toml.cpp", '#include "sixstep/study/run/run.hpp"\n')
        self.assertEqual(self.run_tool(), (0, "", ""))
        self.expect("sixstep/study/ask/ask.cpp", '\n#include "sixstep/study/run/run.hpp"\n',
                    "ask.cpp:2:", "study/ask may include no other corner, not study/run", "corner below")

    def test_what_lies_in_no_corner_is_for_all_of_them(self):
        self.write("docs/architecture.md", PICTURE.replace("text ->", "study/ask ->\ntext ->"))
        self.write("sixstep/study/ask/ask.cpp", '#include "sixstep/study/names.hpp"\n')
        self.assertEqual(self.run_tool(), (0, "", ""))
        self.expect("sixstep/study/names.hpp", '#include "sixstep/study/ask/ask.hpp"\n', "study may include no other corner")

    def test_unknown_corner(self):
        self.write("docs/architecture.md", PICTURE.replace("text ->", "study/ask ->\ntext ->"))
        self.expect("sixstep/study/run/run.cpp", '#include "sixstep/study/ask/ask.hpp"\n', "study/run is no corner", "add a row")

    def test_third_party_in_the_library(self):
        self.expect("sixstep/study/run/run.cpp", "#include <fmt/format.h>\n", "sixstep/study/run/run.cpp:1:", "third-party")

    def test_files_and_clocks_in_the_library(self):
        self.expect("sixstep/study/run/run.cpp", "\n#include <chrono>\n", "run.cpp:2:", "<chrono>")

    def test_control_on_a_bare_chip(self):
        self.expect("sixstep/control/pi.hpp", "#include <cstdint>\n#include <vector>\n", "pi.hpp:2:", "bare chip")

    def test_control_depends_on_nothing(self):
        self.expect("sixstep/control/pi.hpp", '#include "sixstep/base/angle.hpp"\n', "control may include nothing, not base")

    def test_tests_are_no_layer(self):
        self.expect("text/csv.cpp", '#include "tests/helper.hpp"\n', "in no layer")

    def test_relative_include(self):
        self.expect("sixstep/plant/bridge.cpp", '#include "motor.hpp"\n', "path from the repository root")

    def test_library_call_that_differs_between_platforms(self):
        self.expect("sixstep/plant/emf.cpp", "double f(double x) {\n  return std::sin(x);\n}\n", "emf.cpp:2:", "elementary.hpp")

    def test_words_of_a_face(self):
        self.expect("sixstep/study/run/run.cpp", 'const char* a = "lower settle_s";\nconst char* b = "lower --settle";\n',
                    "run.cpp:2:", "--settle", "the face translate")
        self.expect("sixstep/study/run/run.cpp", 'const char* b = "see sixstep help";  // sixstep run\n', "run.cpp:1:", "sixstep help")

    def test_comments_and_strings_are_no_code(self):
        self.write("sixstep/plant/emf.cpp", '// #include <chrono>, std::sin(x)\n/* \n#include "io/a.hpp"\n*/\n'
                                            'const char* t = "// std::cos(1)";  // std::exp(2)\n')
        self.assertEqual(self.run_tool()[0], 0)

    def test_unknown_room(self):
        self.expect("faces/radio/main.cpp", "int main() {}\n", "layer radio is not in the layers block")

    def test_broken_picture(self):
        for picture, said in (("no block", "no complete"), ("```layers\nbase -> plant\n```", "no row above names")):
            self.write("docs/architecture.md", picture)
            code, _, err = self.run_tool()
            self.assertEqual(code, 2)
            self.assertIn(said, err)


if __name__ == "__main__":
    unittest.main()
