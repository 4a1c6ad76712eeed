#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scenario_reference.py [--check] [PROGRAM]: writes docs/scenario.md, the page of all keys, from `sixstep help`.

With --check nothing is written; it fails where the page is not what the program says.
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "scenario.md"
OVERRIDE = "motor_override."
LONG = 12  # more words than this do not go into a table's cell
HEAD = """# Scenario and motor files

Written by `tools/scenario_reference.py` from `sixstep help`; a test checks that it is up to date. In the terminal
`sixstep help`, `sixstep help pwm` or `sixstep help pwm.period_s` say the same.

Files are TOML. Every key carries its unit. A key that is not listed here is an error. What stands under "default" holds
where the key is left out; without a default it may be left out, unless it is required.
[Figures of merit](figures.md) defines what `[[require]]` and `[[compare]]` can ask for.

A number may bring a unit of its own, in quotes: `duration_s = "20 ms"`, `times_s = [0, "5 ms"]`, `inertia_kg_m2 =
"135 gcm2"`, `damping = "90 %"`, and for a reference whatever suits the control mode, `value = "6710 rpm"`; a limit takes
what its metric and signal ask for, `max = "150 mA"`. The unit must be of the key's kind; [what units there are](motors.md#what-a-number-means). Powers of ten cost no rounding: "0.572 mH" is the same number as 0.000572.

Every number is held to what its unit can be on a bench, as the tables below say; one that may be 0 is 0 or at least 1e-30 in
size. Numbers that each may be and that together are no drive are refused too: a bus, a winding with its bridge or a friction with
a time constant below 100 ns, a field above 1000000 electrical rad/s or a load torque that brings it there within 100 us, a
hysteresis band that is crossed within 100 ns. In a table of rows what is smaller than 1e-30 counts as 0.

`extends = "base.toml"`, or a list of files, takes what stands in other scenarios, each name relative to the file that names
it. What is nearer wins: this file over its bases, a later base over an earlier one, `--set` over all. Tables under headings are
joined key by key. Lists of tables, as `[[require]]`, are joined too, the bases' first, unless this file's is empty: `require = []`.
Whatever stands in brackets or braces is one value and replaces the other. Empty braces drop a table that a base has, as if
nobody had written it: `load = {}`, or `speed = {}` under `[control]`.

`[[at]]` changes something at an instant of the run: the reference, the source's voltage, the load, a Hall line, the request to
the product drive, the dead time; gains, limits, mode and chopping, which the controller takes up with its next sample
([what it keeps then](session.md#what-the-chip-does-at-a-change)). A reference that moves is looked at by each control tick, and
held until the next. Figures that are taken of the reference's steps need one that stands still in their window, or their own
`level`.

Where the motor is linear, keys in N, m and kg stand in the place of those in N m, rad and kg m2: each is named with the one that it
stands for, "also as", and is the only word there. References are then in m/s or mm, columns are `speed_m_s`, `position_mm`,
`force_N`, `load_N`, `speed_ref_m_s`, `position_ref_mm`, and the signal of the torque is `force`.

The file of `shape = "csv"` has the time first and the reference in another column, parted by commas, semicolons (then with
decimal commas, if you like), tabs or blanks. One line of headings may come first; a heading may bring a unit, `t_ms` or
`speed [rpm]`. Lines that begin with # are remarks, so that a trace written by `sixstep run --csv` can be followed.
"""
MOTOR = """
# Motor files

A scenario names its motor by a path or by a name that is looked up beside the scenario, in `--data` and in the built-in
list (`sixstep motor list`). `[motor_override]` takes the same keys, none of them required, and replaces single values:
`resistance_ohm = 1.1`. A value is a number or says where it comes from:
`resistance_ohm = { value = 1.03, frame = "terminal", source = "data sheet, line 10" }`, where it helps with
`kind = "sheet"`, `"measured"` or `"derived"`, and with `range = [0.978, 1.03]` where sources differ. Where a key has several
frames, one must be written. [Motors](motors.md) explains the numbers, and `sixstep motor new` writes a file to fill in.

"""


class Entry:
    def __init__(self, program, path):
        told = subprocess.run([program, "help", path], capture_output=True, text=True, check=True).stdout
        below = told.rpartition(f"The key {path} of a scenario:\n")[2]  # a command may have that name too
        lines = below.splitlines()
        self.path, self.meaning, self.type = lines[0], lines[1].strip(), lines[2].strip()
        self.inner = [line.split()[0] for line in lines[3:] if line.startswith(f"  {path}.")]
        self.required = "  required" in lines
        self.default = next((line.removeprefix("  default ") for line in lines if line.startswith("  default ")), "")
        self.also = [line.removeprefix("  or as ") for line in lines if line.startswith("  or as ")]
        self.words = [line.split(None, 1) for line in lines[3:] if line.startswith("    ")]
        self.is_table = self.type == "table" or self.type.startswith("list of tables")

    def word_list(self, separator):
        return "".join(f"{separator}`{word}` {meaning}" for word, meaning in self.words)

    def cells(self, prefix):
        what, kind = self.meaning, self.type.replace("one word of those below", "").replace("|", " or ")
        if self.path.startswith("compare.") and self.words:
            what += ", as in `[[require]]`"
        elif len(self.words) > LONG:
            what += "; listed below"
        elif self.words:
            what, kind = what + ":" + self.word_list("<br>"), ""
        what += "; also as " * bool(self.also) + ", ".join(f"`{spelling}`" for spelling in self.also)
        default = "**required**" if self.required else f"`{self.default}`" if self.default else ""
        cells = [f"`{self.path.removeprefix(prefix)}`", what, kind, default]
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def table(entries, prefix):
    rows = ["| key | meaning | value | default |", "|---|---|---|---|"]
    text = "\n".join(rows + [entry.cells(prefix) for entry in entries]) + "\n"
    for entry in entries:
        if len(entry.words) > LONG:
            text += f"\nWords of `{entry.path.removeprefix(prefix)}`:\n" + entry.word_list("\n- ") + "\n"
    return text


def repeats(entry, top):
    """The table at the top of the file that has the same keys: they are told there."""
    inner = [path.removeprefix(entry.path) for path in entry.inner]
    return next((t for t in top if t.is_table and t.path != entry.path and inner == [path.removeprefix(t.path) for path in t.inner]), None)


def section(program, entry, top):
    """A table with its own keys, then the tables inside it."""
    brackets = f"[[{entry.path}]]" if entry.type.startswith("list") else f"[{entry.path}]"
    if "." in entry.path and (same := repeats(entry, top)):
        return f"\n## `{brackets}`\n\n{entry.meaning[0].upper()}{entry.meaning[1:]}. The keys are those of `[{same.path}]`.\n"
    inner = [Entry(program, path) for path in entry.inner]
    tables = [e for e in inner if e.is_table]
    within = [t for t in tables if not any(t.path.startswith(o.path + ".") for o in tables)]
    own = [e for e in inner if not e.is_table and not any(e.path.startswith(t.path + ".") for t in tables)]
    text = f"\n## `{brackets}`\n\n{entry.meaning[0].upper()}{entry.meaning[1:]}.\n\n" + table(own, entry.path + ".")
    return text + "".join(section(program, t, top) for t in within)


def page(program):
    overview = subprocess.run([program, "help"], capture_output=True, text=True, check=True).stdout.splitlines()
    cuts = [n for n, line in enumerate(overview) if n and not line.startswith(" ")]
    top, sheet = ([line.split()[0] for line in part if line.startswith("  ")]
                  for part in (overview[:cuts[0]], overview[cuts[0]:cuts[1]]))
    top = [Entry(program, path) for path in top]
    sheet = [Entry(program, OVERRIDE + path) for path in sheet]  # "notes" alone would be the scenario's
    for entry in sheet:
        entry.type = entry.type.removeprefix("number, or { value, frame, source }, ")
    tables = [e for e in top if e.is_table and e.path != "motor_override"]
    text = HEAD + "\n## At the top of the file\n\n" + table([e for e in top if not e.is_table], "")
    return text + "".join(section(program, e, top) for e in tables) + MOTOR + table(sheet, OVERRIDE)


def main(words):
    check = "--check" in words
    words = [word for word in words if word != "--check"]
    text = page(pathlib.Path(words[0] if words else ROOT / "build/release/sixstep").resolve())
    if not check:
        PAGE.write_text(text, encoding="utf-8")
    elif PAGE.read_text(encoding="utf-8") != text:
        raise SystemExit("docs/scenario.md is not what `sixstep help` says; tools/scenario_reference.py build/dev/sixstep renews it")


if __name__ == "__main__":
    main(sys.argv[1:])
