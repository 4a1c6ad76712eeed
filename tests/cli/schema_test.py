#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep schema: an editor with this schema accepts and refuses the same values as the program, for each key alone."""
import json
import os
import sys
import tomllib
import unittest

try:
    import jsonschema
except ImportError:  # Debian's package is installed for Debian's Python, which may not be the first Python on the path
    if sys.executable == "/usr/bin/python3":
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

from program import SOURCE, ProgramTest

BASE = """
motor = "maxon-251601"
duration_s = 1e-4
[motor_override]
resistance_ohm = 1.1
[control]
mode = "duty"
[sensors.hall_break]
line = 2
[reference]
shape = "steps"
times_s = [0]
values = [0.5]
[[require]]
metric = "final"
max = 1000
"""

# Each entry is one edit of BASE that must be refused, by the schema and by the program, at the same key.
MUTANTS = [
    ("motor = \"maxon-251601\"", "", "motor"),
    ("duration_s = 1e-4", "duration_s = 0", "duration_s"),
    ("duration_s = 1e-4", "duration_s = true", "duration_s"),
    ("duration_s = 1e-4", "duration = 1e-4", "duration"),
    ("\"duty\"", "\"dutty\"", "mode"),
    ("\"duty\"", "1", "mode"),
    ("times_s = [0]", "times_s = [-1]", "times_s"),
    ("times_s = [0]", "times_s = 0", "times_s"),
    ("[reference]", "[reference]\nsteepness = 1", "steepness"),
    ("[reference]", "[[reference]]", "reference"),
    ("[[require]]", "[require]", "require"),
    ("metric = \"final\"", "", "metric"),
    ("metric = \"final\"", "metric = \"final\"\nfraction = 1.5", "fraction"),
    ("line = 2", "line = 4", "line"),
    ("line = 2", "line = 2.5", "line"),
    ("resistance_ohm = 1.1", "resistance_ohm = 0", "resistance_ohm"),
    ("resistance_ohm = 1.1", "resistance_ohm = { value = 1.1, frame = \"star\" }", "resistance_ohm"),
    ("resistance_ohm = 1.1", "resistance_ohm = { source = \"sheet\" }", "resistance_ohm"),
    ("resistance_ohm = 1.1", "line_10_terminal_resistance_ohm = { value = 1.1, frame = \"phase\" }", "line_10_terminal_resistance_ohm"),
    ("resistance_ohm = 1.1", "resistance_mohm = -1", "resistance_mohm"),
    ("[reference]", "[record]\ncolumns = [\"i_x_A\"]\n[reference]", "columns"),
]


class Schema(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.schemas = {}

    def validator(self, kind):
        if kind not in self.schemas:
            schema = json.loads(self.run_program("schema", kind).stdout)
            jsonschema.Draft202012Validator.check_schema(schema)
            self.schemas[kind] = jsonschema.Draft202012Validator(schema)
        return self.schemas[kind]

    def test_every_shipped_file_is_valid(self):
        for kind, folder, least in (("scenario", "scenarios", 30), ("motor", "motors", 30), ("plan", "plans", 1)):
            files = sorted((SOURCE / "data" / folder).glob("**/*.toml"))
            self.assertGreaterEqual(len(files), least)
            for file in files:
                for error in self.validator(kind).iter_errors(tomllib.loads(file.read_text())):
                    self.fail(f"{file}: {error.json_path} {error.message}")

    def test_what_the_schema_refuses_the_program_refuses(self):
        validator = self.validator("scenario")
        self.assertEqual(list(validator.iter_errors(tomllib.loads(BASE))), [])
        (self.path / "a.toml").write_text(BASE)
        self.run_program("run", "--quiet", "a.toml")
        for old, new, key in MUTANTS:
            with self.subTest(new):
                self.assertEqual(BASE.count(old), 1)
                text = BASE.replace(old, new)
                errors = " ".join(f"{e.json_path} {e.message}" for e in validator.iter_errors(tomllib.loads(text)))
                self.assertIn(key, errors)
                (self.path / "a.toml").write_text(text)
                self.assertIn(key, self.run_program("run", "a.toml", code=2).stderr)

    def test_a_motor_names_its_frames(self):
        validator = self.validator("motor")
        motor = tomllib.loads((SOURCE / "data/motors/maxon-251601.toml").read_text())
        del motor["resistance_ohm"]["frame"]
        self.assertIn("frame", " ".join(error.message for error in validator.iter_errors(motor)))
        del motor["name"]
        self.assertEqual(len(list(validator.iter_errors(motor))), 2)

    def test_editors_find_meanings_defaults_and_words(self):
        schema = self.validator("scenario").schema["properties"]
        self.assertIn("maxon-251601", schema["motor"]["anyOf"][0]["enum"])
        supply = schema["supply"]["properties"]["voltage_V"]
        self.assertEqual((supply["default"], supply["description"]), (24, "voltage of the source, in V"))
        modes = {choice["const"]: choice["description"] for choice in schema["control"]["properties"]["mode"]["oneOf"]}
        self.assertEqual(modes["speed"], "the reference is the speed in rad/s")

    def test_help_and_schema_have_the_same_keys(self):
        told = {line.split()[0] for line in self.run_program("help").stdout.splitlines() if line.startswith("  ")}
        in_schema = set().union(*(self.validator(kind).schema["properties"] for kind in ("scenario", "motor", "plan")))
        self.assertEqual(told - in_schema, set())
        self.assertEqual(in_schema - told - self.spellings(), set())

    def spellings(self):
        """Keys that set the same value as another key. The help of that key names them."""
        found = set()
        for line in self.run_program("help", "motor_override").stdout.splitlines():
            if line.startswith("  motor_override."):
                help_text = self.run_program("help", line.split()[0]).stdout.splitlines()
                found |= {also.removeprefix("  or as ") for also in help_text if also.startswith("  or as ")}
        return found

    def test_an_unknown_kind(self):
        self.assertEqual(self.run_program("schema", "motr", code=2).stderr,
                         "KIND = motr must be one of scenario, motor, plan; did you mean motor?\n")


if __name__ == "__main__":
    unittest.main()
