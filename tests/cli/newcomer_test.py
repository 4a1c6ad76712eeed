#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep new, and the steps of a user who has only the file and the messages."""
import json
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest, some

MODES = ("speed", "current", "position", "duty")
# Motors of several kinds: a flat motor, a drone's motor, and two servo motors, one of them for 200 V.
MOTORS = ("maxon-251601", "dji-2212-920kv", "teknic-m2310p", "baldor-bsm90n-175")


class Starter(ProgramTest):
    def digest(self, file, *words):
        return json.loads(self.run_program("run", file, "--json", "-", *words).stdout)["digest"]

    def test_it_passes_as_it_is_in_every_mode_with_motors_of_every_trade(self):
        # First come pairs in which each motor and each mode occurs once, then the other pairs.
        pairs = [(motor, MODES[(n + shift) % len(MODES)]) for shift in range(len(MODES)) for n, motor in enumerate(MOTORS)]
        for motor, mode in some(pairs, len(MOTORS)):
            with self.subTest(f"{motor} {mode}"):
                name = f"{motor}-{mode}"
                self.run_program("new", name, "--motor", motor, "--mode", mode)
                self.assertIn("ok", self.run_program("run", name + ".toml").stdout)
                self.assertRegex((self.path / f"{name}.toml").read_text(), r"(?m)^# .*pause between the turn-off of one switch of a leg and the turn-on of the other switch.*\n(# .*\n)*dead_time_s = 500e-9$")
                self.run_program("export", "header", name + ".toml", "--out", name + ".hpp")
                self.assertIn("// Cleared by its run:", (self.path / f"{name}.hpp").read_text())

    def test_it_holds_over_the_tolerances_with_hall_edges_beside_their_places(self):
        for motor in some(("maxon-251601", "teknic-m2310p"), 1):
            self.run_program("new", f"of-{motor}", "--motor", motor)
            told = json.loads(self.run_program("run", f"of-{motor}.toml", "--runs", "40", "--seed", "3", "--tolerances", "--quiet", "--json", "-").stdout)
            edges = [n for n, name in enumerate(told["columns"]) if "hall_edges_deg" in name]
            self.assertEqual(len(edges), 6)
            drawn = [row[n] for row in told["rows"] for n in edges]
            self.assertTrue(all(abs(x) <= 3 for x in drawn) and max(drawn) > 2.5 and min(drawn) < -2.5)
            self.assertEqual(told["passed"], 40)

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
                         "mine.toml already exists; choose another name, or move the existing file\n")
        self.assertEqual((self.path / "mine.toml").read_text(), "mine")
        self.assertIn("wrote other.toml; the existing sixstep-scenario.schema.json beside it differs and was kept", self.run_program("new", "other").stdout)
        self.assertEqual((self.path / "sixstep-scenario.schema.json").read_text(), "{}")

    def test_without_a_name_it_goes_to_standard_output(self):
        text = self.run_program("new").stdout
        self.run_program("new", "mine")
        self.assertEqual(text.replace("FILE.toml", "mine.toml"), (self.path / "mine.toml").read_text())

    def test_what_stands_behind_a_hash_holds_without_it(self):
        """Each commented-out line shows a default. Without the comment sign the run has the same trajectory, to the
        last bit."""
        for mode in MODES:
            text = self.run_program("new", "--full", "--mode", mode).stdout
            (self.path / "a.toml").write_text(text)
            shown = re.findall(r"(?m)^# (\w+) = (?!nan|\"\"|\[\])", text)
            self.assertGreater(len(shown), 50)
            opened, closed = [], False
            for line in text.splitlines():
                if re.match(r"(# )?\[", line):
                    closed = line.startswith("#")  # a commented-out table, with its keys
                opened.append(line if closed else re.sub(r"^# (\w+ = (?!nan|\"\"|\[\]))", r"\1", line))
            (self.path / "b.toml").write_text("\n".join(opened) + "\n")
            self.assertEqual(self.digest("a.toml"), self.digest("b.toml"), mode)

    def test_a_six_step_drive_shows_what_reduces_the_peak_at_a_commutation(self):
        for mode in ("current", "speed"):
            self.run_program("new", mode, "--mode", mode)
            path = self.path / f"{mode}.toml"
            text = path.read_text()
            for line, instead in (('# pattern = "upper"', 'pattern = "pwm-on"'), ('# commutation = "plain"', 'commutation = "duty-step"')):
                self.assertEqual(1, text.count(line), mode)
                text = text.replace(line, instead)
            path.write_text(text)
            self.assertNotIn("FAILED", self.run_program("run", path.name).stdout)

    def test_full_shows_every_key(self):
        text = self.run_program("new", "--full").stdout
        keys = [line.split()[0] for line in self.run_program("help").stdout.splitlines() if line.startswith("  ")]
        for table in keys[:keys.index("spread") + 1]:
            inner = [line.split()[0].split(".")[-1] for line in self.run_program("help", table).stdout.splitlines() if line.startswith(f"  {table}.")]
            for key in inner:
                if table != "motor_override":
                    self.assertRegex(text, rf"(?m)^(# )?({key} = |\[+\w+(\.\w+)?\.{key}[\].])", f"{table}.{key}")

    def test_no_line_is_wider_than_a_window(self):
        for words in ((), ("--full",)):
            lines = self.run_program("new", *words).stdout.splitlines()
            self.assertLessEqual(max(map(len, lines)), 110)

    def test_a_torque_limit_that_no_sheet_prints_says_where_it_comes_from(self):
        """If no nominal current is printed, the limit is a quarter of the current that the bus drives through the
        held winding. The text says so. If a nominal current is printed, the text does not mention its source."""
        told = self.run_program("new", "a", "--motor", "qs138-70h", "--voltage", "36").stdout
        amperes = float(re.search(r"a quarter of the stall current, (\S+) A", told)[1])
        checked = self.run_program("motor", "check", "qs138-70h").stdout
        phase = float(re.search(r"^ +R_s +(\S+) (m?)ohm", checked, re.M)[1]) * (1e-3 if re.search(r"^ +R_s +\S+ mohm", checked, re.M) else 1)
        self.assertAlmostEqual(amperes / (36 / (2 * phase) / 4), 1, delta=2e-3)
        text = (self.path / "a.toml").read_text()
        self.assertLess(text.index("a quarter of the stall"), text.index("torque_limit_Nm = "))
        self.assertNotIn("nominal current:", self.run_program("new", "b").stdout + (self.path / "b.toml").read_text())

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


# The values that a new user must know. Everything else is in the messages.
WANTED = {"duration_s": "0.21", "motor": '"maxon-251601"', "metric": '"mean"', "shape": "steps"}


class Follower:
    """Follows a message literally: it searches the place, reads the cure, and edits the file."""

    def __init__(self, test):
        self.test = test

    def follow(self, message):
        place = re.match(r"(\S+?):(\d+):(\d+): (.*)$", message)
        self.test.assertTrue(place, f"no place in: {message}")
        self.file = self.test.path / place[1]
        self.lines = self.file.read_text().split("\n")
        self.row, self.column, said = int(place[2]) - 1, int(place[3]) - 1, place[4]
        self.cure = said.rpartition("; ")[2] if "; see" in said else said[said.index("; ") + 2:]
        for pattern, edit in self.edits():
            if found := re.search(pattern, self.cure):
                edit(*found.groups())
                self.file.write_text("\n".join(self.lines))
                return
        self.test.fail(f"no edit follows from: {message}")

    def edits(self):
        """The patterns of the cures, from the most special to the most general."""
        yield r"^did you mean \"?([\w.-]+)\"?\?$", self.replace_word
        yield r"^write the key as (\w+) and give the value in the key's unit: 1 \S+ = (\S+) ", self.rename_and_scale
        yield r"^write the key as (\w+) and give the value in the key's unit$", self.replace_word
        yield r"^write (?:at least )?(-?[\d.e-]+)(?=[ ,;])", self.replace_value
        yield r"^write (\w+) = \.\.", self.insert_wanted
        yield r"write frame = .* fits (\"\w+\")", lambda frame: self.replace_at("{ ", f"{{ frame = {frame}, ")
        yield r"^set (\w+\.\w+) = (\"\w+\")", self.set_key
        yield r"^write (\[\[\w+\]\])$", self.replace_line
        yield r"^see: sixstep (help \S+)$", self.look_up
        yield r"^it means: ", self.mind_the_sign
        yield r"^close the quote", lambda: self.put(len(self.lines[self.row]), '"')
        yield r"^put words in quotes", lambda: self.replace_word('"' + self.word() + '"')
        yield r"^write a decimal point", lambda: self.replace_at(",", ".")
        yield r"^write KEY = VALUE", lambda: self.put(self.column, "= ")
        yield r"^end the line after the value", lambda: self.replace_line(self.lines[self.row][:self.column])
        yield r"^give each key and table once", lambda: self.lines.pop(self.row)
        yield r"^write true or false, in small letters", lambda: self.replace_word(self.word().lower())
        yield r"^close the header", lambda: self.put(len(self.lines[self.row]), "]")

    def word(self):
        return re.match(r"\"[^\"]*\"|[^\s=#,\[\]]+", self.lines[self.row][self.column:]).group()

    def put(self, column, text):
        line = self.lines[self.row]
        self.lines[self.row] = line[:column] + text + line[column:]

    def replace_at(self, old, new):
        line = self.lines[self.row]
        self.test.assertTrue(line[self.column:].startswith(old), f"{old} does not stand at the place of {line}")
        self.lines[self.row] = line[:self.column] + new + line[self.column + len(old):]

    def replace_word(self, new):
        old = self.word()
        self.replace_at(old, f'"{new}"' if old.startswith('"') and not new.startswith('"') else new)

    replace_value = replace_word

    def replace_line(self, text):
        self.lines[self.row] = text

    def rename_and_scale(self, key, factor):
        self.replace_word(key)
        value = re.search(r"= (\S+)", self.lines[self.row])
        self.lines[self.row] = self.lines[self.row].replace(value[0], f"= {float(value[1]) * float(factor)!r}", 1)

    def insert_wanted(self, key):
        # The message about a missing key names the line where the key's table begins. For a key without a table this is the first
        # line of the file.
        self.lines.insert(self.row + self.lines[self.row].startswith("["), f"{key} = {WANTED[key]}")

    def set_key(self, path, value):
        table, key = path.split(".")
        at = self.lines.index(f"[{table}]")
        at = next(n for n in range(at, len(self.lines)) if re.match(rf"{key} = ", self.lines[n]))
        self.lines[at] = f"{key} = {value}"

    def look_up(self, command):
        told = self.test.run_program(*command.split()).stdout
        word = WANTED[command.rpartition(".")[2]]
        self.test.assertRegex(told, rf"(?m)^    {word} ")
        self.replace_word(word)

    def mind_the_sign(self):
        """The message states only the meaning of the key. The limit is that a size has no sign."""
        self.replace_word(self.word().lstrip("-"))


# (the mistake, the mode of the first scenario, the text that the user replaces, the new text)
MISTAKES = [
    ("a typo in a key", "speed", r"^settle_s\b", "setle_s"),
    ("a typo in a table", "speed", r"^\[reference\]", "[refrence]"),
    ("a unit that the key does not have", "speed", r"^voltage_V = 24", "voltage_mV = 24000"),
    ("revolutions per minute", "speed", r"^# speed_rad_s = 0", "speed_rpm = 955"),
    ("a key without its unit", "speed", r"^duration_s\b", "duration"),
    ("a motor that is not there", "speed", r"^motor = .*$", 'motor = "maxon-25161"'),
    ("a motor that nobody makes", "speed", r"^motor = .*$", 'motor = "maxon_251601"'),
    ("a loop faster than its samples", "current", r"^settle_s = \S+", "settle_s = 20e-6"),
    ("percent for a duty", "duty", r"^value = 0.5", "value = 50"),
    ("a shape that is nearly right", "speed", r'^shape = "steps"', 'shape = "step"'),
    ("a shape that does not exist", "speed", r'^shape = "steps"', 'shape = "staircase"'),
    ("no duration", "speed", r"^duration_s.*$", ""),
    ("no motor", "speed", r"^motor = .*$", ""),
    ("a requirement of nothing", "speed", r"^metric = .*$", ""),
    ("a mode whose reference has another unit", "speed", r'^mode = "speed"', 'mode = "current"'),
    ("a negative inertia", "speed", r"^# inertia_kg_m2 = 0", "inertia_kg_m2 = -1e-9"),
    ("a quote that is not closed", "speed", r"^motor = .*$", 'motor = "maxon-251601'),
    ("a word without quotes", "speed", r'^mode = "speed"', "mode = speed"),
    ("a decimal comma", "speed", r"^duration_s = 0\.(\d+)", r"duration_s = 0,\1"),
    ("a unit behind the number", "speed", r"^(duration_s = \S+) .*$", r"\1 s"),
    ("no equals sign", "speed", r"^duration_s = ", "duration_s "),
    ("a key given twice", "speed", r"^(damping = .*)$", r"\1\n\1"),
    ("a flag in capitals", "speed", r"^# events = false", "events = False"),
    ("a header that is not closed", "speed", r"^\[reference\]", "[reference"),
    ("a list's item as a table", "current", r"^\[\[require\]\]", "[require]"),
]


class Newcomer(ProgramTest):
    written = {}  # {mode: the scenario that sixstep new writes}

    def start(self, mode):
        if mode not in self.written:
            self.written[mode] = self.run_program("new", "--mode", mode).stdout
        (self.path / "first.toml").write_text(self.written[mode].replace("FILE.toml", "first.toml"))
        self.follower = Follower(self)

    def change(self, old, new, file="first.toml"):
        text = (self.path / file).read_text()
        changed, count = re.subn("(?m)" + old, new, text, count=1)
        self.assertEqual(count, 1, old)
        (self.path / file).write_text(changed)

    def go_on(self, most=2):
        """Runs the scenario and follows the messages, at most `most` times. Then the scenario must pass."""
        for _ in range(most):
            result = self.run_program("run", "first.toml", code=2)
            told = result.stderr.splitlines()
            self.assertTrue(told)
            # The edits go from the last place to the first, because an edit moves the places after it.
            for message in reversed(told):
                self.follower.follow(message)
            if self.passes():
                return
        self.run_program("run", "first.toml")

    def passes(self):
        return subprocess.run([PROGRAM, "run", "first.toml"], cwd=self.path, capture_output=True, timeout=300).returncode == 0

    def test_each_message_leads_to_the_edit_that_mends_it(self):
        self.assertGreaterEqual(len(MISTAKES), 10)
        for what, mode, old, new in MISTAKES:
            with self.subTest(what):
                for name in self.names():
                    (self.path / name).unlink()
                self.start(mode)
                self.change(old, new)
                self.go_on()

    def test_many_at_once_are_told_at_once(self):
        self.start("speed")
        for old, new in ((r"^settle_s\b", "setle_s"), (r"^voltage_V = 24", "voltage_mV = 24000"), (r"^motor = .*$", 'motor = "maxon-25161"'),
                         (r'^shape = "steps"', 'shape = "step"'), (r"^# inertia_kg_m2 = 0", "inertia_kg_m2 = -1e-9"), (r'^chopping = "soft"', 'chopping = "sofft"')):
            self.change(old, new)
        self.assertEqual(len(self.run_program("run", "first.toml", code=2).stderr.splitlines()), 6)
        self.go_on()

    def test_a_sheet_that_does_not_say_between_which_points(self):
        sheet = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "own.toml").write_text(sheet)
        self.run_program("new", "first", "--motor", "own.toml")
        self.follower = Follower(self)
        (self.path / "own.toml").write_text(re.sub(r'(resistance_ohm .*?)frame = "terminal", ', r"\1", sheet, count=1))
        self.go_on()

    def test_words_of_the_command_line(self):
        self.start("speed")
        for words, better in ((["run", "frist.toml"], ["run", "first.toml"]), (["run", "first"], ["run", "first.toml"]),
                              (["first.toml"], ["run", "first.toml"]), (["rum", "first.toml"], ["run", "first.toml"]),
                              (["run", "first.toml", "--jsn", "-"], ["run", "first.toml", "--json", "-"])):
            told = self.run_program(*words, code=2).stderr
            meant = re.search(r"did you mean (?:sixstep )?(.*)\?\n$", told).group(1)
            wrong = re.match(r"([\w.-]+)", told).group(1)
            followed = " ".join(words).replace(wrong, meant, 1).split()
            self.assertEqual(followed, better)
            self.run_program(*followed)


if __name__ == "__main__":
    unittest.main()
