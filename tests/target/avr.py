# SPDX-License-Identifier: Apache-2.0
"""`sixstep run --on avr`: chapter 8 of the thesis on an ATmega2560, register by register (faces/loop/avr/). Tested
are the verdicts, the duration of the interrupts, a period that is too short, and that repeated runs have the same
bits. Faulty programs are tested too."""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

import jsonschema

import avr_clock
import avr_disturbed
import avr_faults
import avr_gates
import build

SCHEMA = jsonschema.Draft202012Validator(json.loads((build.REPOSITORY / "docs/summary.schema.json").read_text(encoding="utf-8")))
CHAPTER = build.REPOSITORY / "data" / "scenarios" / "thesis" / "avr"
OWN = build.REPOSITORY / "faces" / "firmware" / "example" / "avr_c"
FREE = build.REPOSITORY / "data" / "scenarios" / "firmware" / "avr.toml"  # a scenario whose rotor turns
TOO_SHORT = CHAPTER / "8b-30us.toml"
LOGGED = CHAPTER / "8d.toml"  # a scenario whose rotor hardly turns; near a commutation the chip samples a leg without current


def run(file, *words, on="avr", **environment):
    return subprocess.run([str(build.PROGRAM), "run", str(file), "--on", on, *words], capture_output=True, text=True, timeout=300,
                          check=False, env={**os.environ, **environment})


def summary(done):
    return json.loads(done.stdout) if done.stdout else {"fault": done.stderr, "passed": False}


def trouble_of_times(name, chip):
    """Checks the duration of the control interrupt and the Hall interrupt against their limits
    (docs/reference/core-costs.md). The limits include the other interrupts: the Hall interrupt and TOP's interrupt
    may come during the control interrupt. The first samples only measure the offset."""
    found = []
    for which, least, most in (("control", 100, 1800), ("hall", 100, 700)):
        t = chip[which]
        if not (t["count"] > 0 and least <= t["least_cycles"] <= t["most_cycles"] <= most):
            found.append(f"{name}: its {which} interrupt {t['count']} times, {t['least_cycles']} to {t['most_cycles']} cycles")
        if sum(t["bins"]) != t["count"]:
            found.append(f"{name}: {sum(t['bins'])} {which} interrupts in bins, {t['count']} in all")
    if chip["faults"]:
        found.append(f"{name}: it stands by {chip['faults']}")
    if not 1200 < chip["control"]["sum_cycles"] / chip["control"]["count"] < 1400:
        found.append(f"{name}: its control interrupt takes {chip['control']['sum_cycles']} cycles in {chip['control']['count']} times")
    if chip["latest_edge_s"] > 1e-6:
        found.append(f"{name}: an edge was shown {chip['latest_edge_s'] * 1e6:.2f} us late")
    return found


def check_chapter():
    trouble, files = [], sorted(CHAPTER.glob("8?.toml"))
    for file in files:
        done, again = (run(file, "--quiet", "--json", "-") for _ in range(2))
        found = summary(done)
        if done.returncode != 0 or not found["passed"] or len(found.get("require", [])) != 2:
            trouble.append(f"{file.stem}: exit {done.returncode}, {found['fault']}")
            continue
        trouble += [f"{file.stem}: {error.message}" for error in SCHEMA.iter_errors(found)]
        if found["digest"] != summary(again)["digest"]:
            trouble.append(f"{file.stem}: another digest each time")
        chip = found["chip"]
        if chip["periods"] > chip["conversions"] + 1:
            trouble.append(f"{file.stem}: {chip['conversions']} conversions in {chip['periods']} periods")
        trouble += trouble_of_times(file.stem, chip)
    print(f"{len(files)} current steps of chapter 8 on an ATmega2560: {'all hold' if not trouble else 'trouble'}")
    return trouble


def check_overrun():
    """30 us are 480 cycles. The control interrupt takes more than three periods, and the next interrupt waits for its
    end."""
    done = run(TOO_SHORT, "--json", "-")
    chip = summary(done).get("chip", {"periods": 0, "conversions": 0})
    if not (chip["conversions"] > 0 and 3 < chip["periods"] / chip["conversions"] < 4):
        return [f"30 us: {chip['conversions']} conversions in {chip['periods']} periods"]
    told = run(TOO_SHORT).stdout
    return [] if "OVERRUN" in told else [f"30 us: no overrun is told\n{told}"]


BAD = {  # the chip's action at its 100th control interrupt, and the message
    "drives both switches of a leg": ("byte(atmega2560::PORTA) = 7; byte(atmega2560::DDRB) = 0xE0; set_on_time(0xFFFF);", "shoot-through"),
    "runs into an instruction that there is not": ('asm volatile(".word 0x0001");', "the core ended"),
    "jumps into erased flash": ('asm volatile("ldi r30,0xFF\\n ldi r31,0xFF\\n ijmp");', "the core ended"),
    "hangs with interrupts off": ('asm volatile("cli"); for (;;) asm volatile("");', "says why: watchdog"),
    "hangs and feeds the watchdog": ('asm volatile("cli"); for (;;) asm volatile("wdr");', "starts no conversion any more"),
}
PLACE = "  const std::uint8_t pins = hall_pins();\n  const bool looks_at_legs"


def badly(what):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for part in ("sixstep/control", "faces/firmware"):
            shutil.copytree(build.REPOSITORY / part, folder / part)
        program = folder / "faces/firmware/example/avr/main.cpp"
        text = program.read_text(encoding="utf-8")
        assert PLACE in text
        program.write_text(text.replace(PLACE, f"  static std::uint8_t calls = 0;\n  if (++calls == 100) {{ {what} }}\n{PLACE}"),
                           encoding="utf-8")
        begin = time.monotonic()
        return run(CHAPTER / "8d.toml", SIXSTEP_SOURCES=name), time.monotonic() - begin


def check_bad():
    trouble = []
    for name, (what, said) in BAD.items():
        done, took_s = badly(what)
        stops = 1 if "watchdog" in said else 3  # after a stop the drive misses its required means
        if done.returncode != stops or said not in done.stdout + done.stderr or took_s > 30:
            trouble.append(f"a chip that {name}: exit {done.returncode} after {took_s:.1f} s\n{(done.stdout + done.stderr)[-600:]}")
    print(f"{len(BAD) - len(trouble)} of {len(BAD)} chips with a bad program are told as such")
    return trouble


BREAKS = [word for key, value in (("line", "1"), ("level", "high"), ("at_s", "0.03"))
          for word in ("--set", f"sensors.hall_break.{key}={value}")]


def check_stands():
    """A Hall line breaks. The run continues to its end with the gates off, and the text repeats the chip's message."""
    with tempfile.TemporaryDirectory() as name:
        trace, log = (pathlib.Path(name) / file for file in ("trace.csv", "board.csv"))
        done = run(FREE, "--json", "-", "--csv", str(trace), "--uart", str(log), *BREAKS)
        found, text = summary(done), log.read_text(encoding="ascii")
        with trace.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(line for line in file if line[0] != "#"))
    trouble = []
    if done.returncode != 1 or found["fault"] or found["chip"]["faults"] != ["hall"] or found["simulated_s"] != found["duration_s"]:
        trouble.append(f"a Hall line that breaks: exit {done.returncode}, {found['fault']}, {found.get('chip', {}).get('faults')}\n{done.stderr}")
    if text.count("\n# fault: hall\n") != 1 or "says why: hall" not in run(FREE, *BREAKS).stdout:
        trouble.append(f"a Hall line that breaks: its reason is not told\n{text[-300:]}")
    i_m = next(key for key in rows[0] if key.startswith("i_m"))
    if max(abs(float(row[i_m])) for row in rows[-200:]) > 0.05 or max(abs(float(row[i_m])) for row in rows) < 2.5:
        trouble.append("a Hall line that breaks: current flows at the end of the run")
    return trouble


def check_waits():
    """The potentiometer is not at its middle from the start on."""
    done = run(CHAPTER / "8b.toml", "--set", "reference.values=[0.5, 0.5, 1.5]")
    return [] if done.returncode == 1 and "WAITS" in done.stdout else [f"a setpoint from the start on: exit {done.returncode}\n{done.stdout}"]


def check_own():
    """A firmware of another author, in C and with other pins. It also passes the requirements of chapter 8."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copy(OWN / "map.toml", folder)
        build.told(["avr-gcc", "-mmcu=atmega2560", "-std=gnu99", "-O2", "-Wall", "-Wextra", "-Werror", OWN / "main.c", "-o",
                    folder / "main.elf"])
        trouble = []
        for file in sorted(CHAPTER.glob("8?.toml")):
            done = run(file, "--quiet", "--json", "-", on=str(folder / "map.toml"))
            if done.returncode != 0 or not summary(done)["passed"]:
                found = summary(done)
                trouble.append(f"{file.stem} by {OWN.name}: exit {done.returncode}, {found['fault']}, {found.get('require')}")
        # With another controller in the scenario, the host runs this controller.
        other = run(CHAPTER / "8b.toml", "--quiet", "--set", "control.arithmetic=float", "--set", "pwm.alignment=edge",
                    on=str(folder / "map.toml"))
        if other.returncode != 0:
            trouble.append(f"a scenario of another controller: exit {other.returncode}, {other.stderr}")
    print(f"a firmware of one's own: {'all hold' if not trouble else 'trouble'}")
    return trouble


def early(text):
    """The rows before 20 ms. Later the rotor is at a commutation, and the currents of chip and host oscillate with
    different phase."""
    return "".join(line for line in text.splitlines(True) if not line[0].isdigit() or int(line.split(",")[0]) < 20_000)


def check_log():
    """The log on the serial line. Compared with the run on the chip it has the same samples. Compared with the host's
    run it differs by a few counts of the converter."""
    with tempfile.TemporaryDirectory() as name:
        log, begin = (str(pathlib.Path(name) / file) for file in ("board.csv", "begin.csv"))
        run(LOGGED, "--quiet", "--uart", log)
        text = pathlib.Path(log).read_text(encoding="ascii") if os.path.exists(log) else ""
        pathlib.Path(begin).write_text(early(text), encoding="ascii")
        trouble = []
        for more, most_A, log, rows in ((["--on", "avr"], 0.01, log, 25), ([], 0.05, begin, 12)):
            done = subprocess.run([str(build.PROGRAM), "run", LOGGED, *more, "--compare", log], capture_output=True, text=True,
                                  timeout=300, check=False)
            found = re.search(r"i_m_A +(\d+) rows +rms ([0-9.]+) (m?)A", done.stdout)
            if not found or int(found[1]) < rows or float(found[2]) * (1e-3 if found[3] else 1) > most_A:
                trouble.append(f"its log over the run {' '.join(more)}: {done.stdout[-400:]}{done.stderr}\n{text[:300]}")
    print(f"what its serial line sent, over the run: {'as it was' if not trouble else 'trouble'}")
    return trouble


def check():
    trouble = check_chapter() + check_overrun() + check_stands() + check_waits() + check_own() + check_log() + check_bad()
    trouble += avr_gates.check() + avr_disturbed.check() + avr_faults.check() + avr_clock.check()
    print("\n".join(trouble), end="\n" if trouble else "")
    return not trouble
