#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/check_batches.py finds each name that hides a name of a header. It reports nothing else."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check_batches.py"


class Batches(unittest.TestCase):
    def told(self, header, source):
        with tempfile.TemporaryDirectory() as folder:
            room = pathlib.Path(folder) / "text"
            room.mkdir()
            (room / "a.hpp").write_text(f"namespace text {{\n{header}\n}}  // namespace text\n")
            (room / "b.cpp").write_text(source)
            for words in (("init", "-q"), ("add", ".")):
                subprocess.run(["git", *words], cwd=folder, check=True)
            return subprocess.run([sys.executable, CHECK, folder], text=True, stdout=subprocess.PIPE).stdout

    def kept(self, line, namespace="text"):
        return f"namespace {namespace} {{\nnamespace {{\n\n{line}\n\n}}  // namespace\n}}  // namespace {namespace}\n"

    def test_a_hidden_name_is_told_with_both_places(self):
        told = self.told("std::string told(int x);", self.kept("std::string told(const char* x) {\n  return x;\n}"))
        self.assertIn("text/b.cpp: told() in its unnamed namespace hides the function of text/a.hpp", told)

    def test_other_names_namespaces_and_places_are_not(self):
        header = "std::string told(int x);"
        for source in (self.kept("std::string says(int x) {\n  return told(x);\n}"), self.kept("int told(int x) {\n  return x;\n}", "report"),
                       "namespace text {\nstd::string told(int x) {\n  return {};\n}\n}  // namespace text\n"):
            self.assertEqual(self.told(header, source), "", source)


if __name__ == "__main__":
    unittest.main()
