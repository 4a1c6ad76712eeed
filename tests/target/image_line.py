# SPDX-License-Identifier: Apache-2.0
"""The STM32F303's serial line, on its executed image. Each command is obeyed or answered with a message. The rows
have the instants of a clock that never stops."""
import re
import struct

from image_faults import SECOND, ready, running, told
from images import all_off, tick


def setpoint(chip):
    return struct.unpack("<f", chip.core.mem_read(chip.symbols["firmware::setpoint"], 4))[0]


def check_line(folder):
    """Input from a line-buffered terminal: all characters arrive before the main loop reads one."""
    chip, trouble = running(folder), []
    chip.type("300\n70\ns")
    chip.go_on(60_000)
    if not re.search(r"# setpoint 300 rad/s\n.*# setpoint 70 rad/s\n", chip.sent, re.S) or setpoint(chip) != 70:
        trouble.append(f"'300' and '70' at once: {chip.sent!r}, {setpoint(chip)} obeyed")
    for _ in range(30_000):
        if all_off(chip):
            break
        tick(chip)
    if not all_off(chip):
        trouble.append("the stop behind a number is lost")
    # The n-th character is lost; ORE is set together with the character before it.
    for text, lost in (("90\n", 1), ("9\n8\n", 1), ("90\n", 2), ("-90\n", 1)):
        chip = running(folder)
        for n, character in enumerate(text):
            chip.line_status = 8 if n + 1 == lost else 0
            if n != lost:
                chip.type(character)
        chip.line_status = 0
        chip.type("\n")
        chip.go_on(60_000)
        if setpoint(chip) != 100 or "# setpoint dropped" not in chip.sent:
            trouble.append(f"{text!r} without its character {lost}: {setpoint(chip)} obeyed, {chip.sent[-80:]!r}")
    for text, value, echo in (("70.5\n", 70.5, "# setpoint 70.500 rad/s"), ("-1.5\n", -1.5, "# setpoint -1.500 rad/s"),
                              ("70\b5\n", 100, "# not understood"), ("1,5\n", 100, "# setpoint dropped"), ("7r\n", 100, "# setpoint dropped")):
        chip = running(folder)
        chip.type(text)
        chip.go_on(60_000)
        if setpoint(chip) != value or echo not in chip.sent:
            trouble.append(f"{text!r}: {setpoint(chip)} obeyed, {chip.sent!r}")
    chip = running(folder)
    chip.type("9000\n")
    chip.go_on(60_000)
    if "# setpoint 300 rad/s\n" not in chip.sent or setpoint(chip) != 300:
        trouble.append(f"a setpoint above the drive's limit: {setpoint(chip)}, {chip.sent[-60:]!r}")
    return trouble


def feeds(chip, periods=400):
    """Whether a pair is driven after `periods`."""
    for _ in range(periods):
        tick(chip)
    return any(mode == 6 for mode, _, _ in chip.outputs())


def stops(chip):
    """Whether the gates are off in the end. The drive first brakes to standstill."""
    for _ in range(30_000):
        tick(chip)
        if all_off(chip):
            return True
    return False


def check_words(folder):
    """The commands r, s and c are echoed. Each has its effect even if other characters follow at once, before the
    next tick."""
    trouble = []
    chip = running(folder)
    chip.line_status = 2  # a framing error; 4 would be a noise error
    chip.type("s")
    chip.line_status = 0
    chip.go_on(60_000)
    if "# stop\n" not in chip.sent or "# a character was lost" not in chip.sent or not stops(chip):
        trouble.append(f"s with a framing error is not obeyed: {chip.sent!r}")
    chip = running(folder)
    chip.line_status = 4
    chip.type("7")
    chip.line_status = 0
    chip.go_on(60_000)
    if "# a character was lost" not in chip.sent:
        trouble.append(f"a lost character is told with the next one only: {chip.sent!r}")
    chip = running(folder)
    chip.hall(0)
    chip.interrupt(28)
    for _ in range(3):
        tick(chip)
    chip.type("c")  # the cause of the stop persists
    chip.go_on(60_000)
    tick(chip)
    told_now = told(chip)
    chip.hall(0b101)
    for _ in range(3):
        tick(chip)
    chip.sent = ""
    chip.type("cr")
    chip.go_on(60_000)
    if told_now != ["hall"] or not feeds(chip) or "# clear\n# run\n" not in re.sub(r"\d.*\n", "", chip.sent):
        trouble.append(f"c, and then cr within a tick: {told_now}, {chip.sent!r}")
    chip.type("sr")
    chip.go_on(60_000)
    tick(chip)
    if wants_to_run(chip):
        trouble.append("s with an r right behind it: no tick sees the stop")
    tick(chip)
    if not wants_to_run(chip):
        trouble.append("s with an r right behind it: no tick sees the run")
    return trouble


def wants_to_run(chip):
    return chip.core.mem_read(chip.symbols["firmware::wants_to_run"], 1)[0] != 0


def rows(chip):
    return [[float(cell) for cell in line.split(",")] for line in chip.sent.splitlines() if re.match(r"\d", line)]


def check_time(folder):
    """The times of the rows are from a counter that never stops. They are right when the counter passes 2^32, and
    after periods without a control interrupt."""
    chip = ready(folder)
    for _ in range(3):
        tick(chip)
    chip.go_on(100_000)
    told(chip)
    at, t, trouble, passed = None, None, [], 0
    for clocks in (2160, 2160, 3 * 2160, 40 * SECOND, 40 * SECOND, 2160, 7 * 2160 + 300):
        chip.sent = ""
        tick(chip, clocks=clocks)
        chip.go_on(100_000)
        row = rows(chip)[-1]
        passed += clocks
        if at is not None and abs(row[0] - t - clocks / 72) > 1:
            trouble.append(f"a row {clocks / 72} us behind another says {row[0] - t} us")
        if at is not None and row[9] != (clocks + 1080) // 2160 - 1:
            trouble.append(f"{clocks / 2160} periods behind a row the next one says {row[9]} missed")
        at, t = passed, row[0]
    return trouble


def check(folder):
    return check_line(folder) + check_words(folder) + check_time(folder)
