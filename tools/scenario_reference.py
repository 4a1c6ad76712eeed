#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scenario_reference.py [--check] [PROGRAM]: writes docs/reference/keys/, the pages of all keys, from `sixstep help`.

With --check it writes nothing, and fails if a page differs from the program's help.
"""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = ROOT / "docs/reference/keys"
OVERRIDE = "motor_override."
LONG = 12  # largest number of words in a table's cell
HEAD = """# Scenario and motor files: all keys

Which keys can a scenario or a motor file have, in which units and ranges? For everybody who writes such a file. In the terminal,
`sixstep help`, `sixstep help pwm` and `sixstep help pwm.period_s` say the same. `tools/scenario_reference.py` writes these pages
from it; a test checks that they are up to date.

## How a file is written

- Files are TOML. The name of a key contains its unit, if it has one. A key that is not listed here is an error.
- The column "default" shows the value of a key that is left out. A key without a default can be left out, unless it is required.
- "also as" names the key for a linear motor, whose files must use that name.

A number may have another unit, in quotes. The unit must fit the key
([list of units](../../start/your-motor.md#which-unit-and-frame-does-each-number-have)):

- key: `duration_s = "20 ms"`, `times_s = [0, "5 ms"]`, `inertia_kg_m2 = "135 gcm2"`, `damping = "90 %"`
- reference, by its control mode: `value = "6710 rpm"`
- limit, by its metric and signal: `max = "150 mA"`

Powers of ten cost no rounding: "0.572 mH" is the same number as 0.000572.

## Which numbers are refused

Every number has a range, which the tables show. A number that may be 0 is 0 or at least 1e-30 in size; in a table of rows a smaller
number counts as 0. Some numbers are allowed alone but make no drive together. They are refused too:

- a time constant below 100 ns of the bus, of the winding with its bridge, or of the friction
- a field above 1000000 electrical rad/s, or a load torque that accelerates it to that within 100 us
- a hysteresis band that is crossed within 100 ns

## How a file extends another

`extends = "base.toml"`, or a list of files, takes over the keys of other scenarios. A name is relative to the file that contains it.

- This file wins over its bases, a later base over an earlier one, `--set` over all.
- A table under a heading is joined with the base's key by key, also with one in braces.
- Lists of tables, such as `[[require]]`, are joined too, those of the bases first. `require = []` drops those of the bases.
- A value in brackets or braces replaces the other as a whole. Empty braces drop a table of a base: `load = {}`, or `speed = {}`
  under `[control]`.

## Which table contains which keys

"""
NOTES = {
    "at": """`[[at]]` changes something at an instant of the run. The controller takes over gains, limits, mode and chopping with its next
sample ([what it keeps](../../howto/steer-a-run-from-cpp.md#which-state-of-the-controller-does-a-change-keep)).
""",
    "reference": """The controller reads a moving reference at each control tick and holds it until the next. Figures of the reference's
steps need a reference that does not move in their window, or their own `level`.

The file of `shape = "csv"` has the time in its first column and the reference in another.

- Commas, semicolons (then decimal commas are allowed), tabs or blanks separate the columns.
- One line of headings may come first; a heading may contain a unit: `t_ms` or `speed [rpm]`.
- Lines that begin with # are comments. So a trace that `sixstep run --csv` wrote can be the reference.
""",
    "require": "[Figures of merit](../figures.md) defines metrics and signals.\n",
    "compare": "[Figures of merit](../figures.md) defines metrics and signals.\n",
    "spread": "[How to run a thousand drives](../../howto/run-many.md#how-to-run-the-drives-of-a-series) shows a series.\n",
}
MOTOR = """# Motor files

Which keys can a motor file have? A scenario names its motor by a path or by a name. The name is looked up beside the scenario, in
`--data` and in the built-in list (`sixstep motor list`). `sixstep motor new` writes a file to fill in;
[your motor](../../start/your-motor.md) explains the numbers. `[motor_override]` in a scenario takes the same keys, none of them
required, and replaces single values: `resistance_ohm = 1.1`.

A value is a number, or a table with its source:
`resistance_ohm = { value = 1.03, frame = "terminal", source = "data sheet, line 10" }`. The table can also have `kind = "sheet"`,
`"measured"` or `"derived"`, and `range = [0.978, 1.03]` where sources differ. A key with several frames requires one.

"also as" lists other names of a key: by the line of a data sheet, in another unit, or for a linear motor. A linear motor takes only
the names in N, m and kg, not those in N m, rad and kg m2. Its references are then in m/s or mm, its columns are `speed_m_s`,
`position_mm`, `force_N`, `load_N`, `speed_ref_m_s` and `position_ref_mm`, and the signal of the torque is `force`.

"""
NEXT = "\nNext: [all tables](README.md), [figures of merit](../figures.md), [your motor](../../start/your-motor.md).\n"


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
        what, kind = self.meaning, self.type.replace("one of the words below", "").replace("|", " or ")
        if self.path.startswith("compare.") and self.words:
            what += ", as in [`[[require]]`](require.md)"
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
        if len(entry.words) > LONG and not entry.path.startswith("compare."):
            text += f"\nWords of `{entry.path.removeprefix(prefix)}`:\n" + entry.word_list("\n- ") + "\n"
    return text


def repeats(entry, top):
    """The table at the top of the file that has the same keys and describes them."""
    inner = [path.removeprefix(entry.path) for path in entry.inner]
    return next((t for t in top if t.is_table and t.path != entry.path and inner == [path.removeprefix(t.path) for path in t.inner]), None)


def capital(text):
    return text[0].upper() + text[1:]


def section(program, entry, top):
    """A table with its own keys, then the tables inside it."""
    brackets = f"[[{entry.path}]]" if entry.type.startswith("list") else f"[{entry.path}]"
    if "." in entry.path and (same := repeats(entry, top)):
        return f"\n## `{brackets}`\n\n{capital(entry.meaning)}. The keys are those of [`[{same.path}]`]({same.path}.md).\n"
    inner = [Entry(program, path) for path in entry.inner]
    tables = [e for e in inner if e.is_table]
    within = [t for t in tables if not any(t.path.startswith(o.path + ".") for o in tables)]
    own = [e for e in inner if not e.is_table and not any(e.path.startswith(t.path + ".") for t in tables)]
    text = f"\n## `{brackets}`\n\n{capital(entry.meaning)}.\n\n" + table(own, entry.path + ".")
    return text + "".join(section(program, t, top) for t in within)


def pages(program):
    """{file name: text}"""
    overview = subprocess.run([program, "help"], capture_output=True, text=True, check=True).stdout.splitlines()
    cuts = [n for n, line in enumerate(overview) if n and not line.startswith(" ")]
    top, sheet = ([line.split()[0] for line in part if line.startswith("  ")]
                  for part in (overview[:cuts[0]], overview[cuts[0]:cuts[1]]))
    top = [Entry(program, path) for path in top]
    sheet = [Entry(program, OVERRIDE + path) for path in sheet]  # "notes" alone would be the scenario's
    for entry in sheet:
        entry.type = entry.type.removeprefix("number, or { value, frame, source }, ")
    tables = [e for e in top if e.is_table and e.path != "motor_override"]
    rows = "".join(f"| [`{e.path}`]({e.path}.md) | {e.meaning} |\n" for e in tables)
    index = HEAD + "| table | holds |\n|---|---|\n" + rows + "| [motor file](motor.md), `motor_override` | the motor's data sheet |\n"
    index += "\n## Keys at the top of the file\n\n" + table([e for e in top if not e.is_table], "")
    made = {"README.md": index + NEXT.replace("[all tables](README.md)", "[tour](../../start/tour.md)"), "motor.md": MOTOR + table(sheet, OVERRIDE) + NEXT}
    for e in tables:
        title = f"# Keys of `{e.path}`\n\nWhich keys does the table `{e.path}` of a scenario have?\n"
        made[f"{e.path}.md"] = title + ("\n" + NOTES[e.path] if e.path in NOTES else "") + section(program, e, top) + NEXT
    return made


def main(words):
    check = "--check" in words
    words = [word for word in words if word != "--check"]
    made = pages(pathlib.Path(words[0] if words else ROOT / "build/release/sixstep").resolve())
    there = {file.name: file.read_text(encoding="utf-8") for file in PAGES.glob("*.md")}
    if check and there != made:
        raise SystemExit("docs/reference/keys differs from `sixstep help`; renew it with tools/scenario_reference.py build/dev/sixstep")
    if check:
        return
    PAGES.mkdir(parents=True, exist_ok=True)
    for name in there.keys() - made.keys():
        (PAGES / name).unlink()
    for name, text in made.items():
        (PAGES / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
