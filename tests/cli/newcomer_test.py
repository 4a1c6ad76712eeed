#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep new, and the road of somebody who has only its file and the messages."""
import json
import re
import unittest

from program import SOURCE, ProgramTest

MODES = ("speed", "current", "position", "duty")
# Of several trades: a flat motor, a drone, two servos of which one runs at 200 V.
MOTORS = ("maxon-251601", "dji-2212-920kv", "teknic-m2310p", "baldor-bsm90n-175")


class Starter(ProgramTest):
    def digest(self, file, *words):
        return json.loads(self.run_program("run", file, "--json", "-", *words).stdout)["digest"]

    def test_it_passes_as_it_is_in_every_mode_with_motors_of_every_trade(self):
        for motor in MOTORS:
            for mode in MODES:
                with self.subTest(f"{motor} {mode}"):
                    name = f"{motor}-{mode}"
                    self.run_program("new", name, "--motor", motor, "--mode", mode)
                    self.assertIn("ok", self.run_program("run", name + ".toml").stdout)

    def test_the_message_leads_on(self):
        told = self.run_program("new", "mine").stdout
        self.assertEqual(self.names(), ["mine.toml", "sixstep-scenario.schema.json"])
        command = re.search(r"next: sixstep (.*)\n", told).group(1)
        self.run_program(*command.split())
        self.assertIn("mine.html", self.names())

    def test_the_editor_finds_the_schema(self):
        self.run_program("new", "mine")
        line = (self.path / "mine.toml").read_text().splitlines()[0]
        named = re.fullmatch(r"#:schema (\S+)", line).group(1)
        self.assertEqual((self.path / named).read_text(), self.run_program("schema").stdout)

    def test_it_never_overwrites(self):
        (self.path / "mine.toml").write_text("mine")
        (self.path / "sixstep-scenario.schema.json").write_text("{}")
        self.assertEqual(self.run_program("new", "mine.toml", code=2).stderr,
                         "mine.toml is there already; choose another name, or move it away\n")
        self.assertEqual((self.path / "mine.toml").read_text(), "mine")
        self.run_program("new", "other")
        self.assertEqual((self.path / "sixstep-scenario.schema.json").read_text(), "{}")

    def test_without_a_name_it_goes_to_standard_output(self):
        text = self.run_program("new").stdout
        self.run_program("new", "mine")
        self.assertEqual(text.replace("FILE.toml", "mine.toml"), (self.path / "mine.toml").read_text())

    def test_what_stands_behind_a_hash_holds_without_it(self):
        """Each line that shows a default may be opened: the trajectory keeps its bits."""
        for mode in MODES:
            text = self.run_program("new", "--full", "--mode", mode).stdout
            (self.path / "a.toml").write_text(text)
            shown = re.findall(r"(?m)^# (\w+) = (?!nan|\"\"|\[\])", text)
            self.assertGreater(len(shown), 50)
            # [[spread]] stands behind a # itself, and its keys with it.
            head, spread, tail = text.partition("# [[spread]]\n")
            opened = re.sub(r"(?m)^# (\w+ = (?!nan|\"\"|\[\]))", r"\1", head) + spread + tail
            (self.path / "b.toml").write_text(opened)
            self.assertEqual(self.digest("a.toml"), self.digest("b.toml"), mode)

    def test_full_shows_every_key(self):
        text = self.run_program("new", "--full").stdout
        keys = [line.split()[0] for line in self.run_program("help").stdout.splitlines() if line.startswith("  ")]
        for table in keys[:keys.index("spread") + 1]:
            inner = [line.split()[0].split(".")[-1] for line in self.run_program("help", table).stdout.splitlines() if line.startswith(f"  {table}.")]
            for key in inner:
                if table != "motor_override":
                    self.assertRegex(text, rf"(?m)^(# )?({key} = |\[\w+\.{key}\]|\[\w+\.\w+\.{key}\])", f"{table}.{key}")

    def test_no_line_is_wider_than_a_window(self):
        for words in ((), ("--full",)):
            lines = self.run_program("new", *words).stdout.splitlines()
            self.assertLessEqual(max(map(len, lines)), 110)

    def test_a_motor_of_ones_own_is_named_as_the_scenario_sees_it(self):
        for folder in ("motors", "drives"):
            (self.path / folder).mkdir()
        (self.path / "motors/own.toml").write_text((SOURCE / "data/motors/maxon-251601.toml").read_text())
        self.run_program("new", "drives/a", "--motor", "motors/own.toml")
        self.assertIn('\nmotor = "../motors/own.toml"\n', (self.path / "drives/a.toml").read_text())
        self.run_program("run", "--quiet", "drives/a.toml")

    def test_wrong_words(self):
        self.assertEqual(self.run_program("new", "--mode", "sped", code=2).stderr,
                         "--mode = sped must be one of speed, current, position, duty; did you mean speed?\n")
        self.assertIn("did you mean \"maxon-251601\"?", self.run_program("new", "--motor", "maxon-25160", code=2).stderr)
        for mode in MODES:
            self.assertIn("give the bus voltage in", self.run_program("new", "--motor", "mjbots-mj5208", "--mode", mode, code=2).stderr)
        self.run_program("new", "--motor", "mjbots-mj5208", "--voltage", "24", "a")
        self.run_program("run", "--quiet", "a.toml")


if __name__ == "__main__":
    unittest.main()
