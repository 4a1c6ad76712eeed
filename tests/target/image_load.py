# SPDX-License-Identifier: Apache-2.0
"""The smallest and largest part of a period that the STM32F303's control tick and Hall interrupt take
(core_clocks.py). If a tick answers after the end of its period, the complete answer acts one period later. No leg
changes without the dead time, and the column of the log shows the late answer."""
import itertools
import pathlib
import re
import shutil

import images
from core_clocks import Clocks
from image_drives import Ride
from image_line import ready, rows, tick
from simulated_legs import differing
from tim1 import broken_laws
from timed_chip import DEAD, PAIRS, PERIOD, SAMPLE, WAYS, Bridge, TimedChip

TICK, HALL, END = 18, 28, 27
BOARD = images.build.REPOSITORY / images.EXAMPLES["stm32f303"] / "board.hpp"
# Counts from the start of the period of the tick.
LATE = (SAMPLE + 1, PERIOD - 40, PERIOD - 1, PERIOD, PERIOD + 100, PERIOD + 1100, PERIOD + SAMPLE - 400)


def measured(folder):
    """For each interrupt: the largest number of instructions, the smallest and the largest number of clocks. The run
    is a start, a constant speed and a braking."""
    ride, most = Ride(folder, round(72e6 * 0.1309 / 300)), {}
    clocks, interrupt = Clocks(ride.chip, folder / "image.elf"), ride.chip.interrupt

    def counted(position):
        clocks.reset()
        ended = interrupt(position)
        now = (clocks.instructions, clocks.at_least(), clocks.at_most())
        most[position] = tuple(map(max, most.get(position, now), now))
        return ended
    ride.chip.interrupt = counted
    ride.go(250)
    ride.type("r300\r")
    ride.go(400, 0.55)
    ride.type("70\r")
    ride.go(150, 0.55)
    return most


def check_load(folder):
    """The board's shortest period is the time of both interrupts: one clock per instruction, and the entry and
    return."""
    most = measured(folder)
    if len(most) < 4:
        return [f"{len(most)} interrupts came"]
    tick, hall = most[TICK], most[HALL]
    print(f"of a period's {PERIOD} clocks a control tick takes {tick[0]} instructions, at most {tick[2]} clocks with the flash's waiting, a Hall "
          f"interrupt {hall[0]}, at most {hall[2]}")
    needed = tick[0] + hall[0] + 2 * (12 + 10)
    least = int(re.search(r"least_period_counts = (\d+);", BOARD.read_text(encoding="utf-8"))[1])
    return [] if needed <= least <= 1.06 * needed else [f"its board takes periods of {least} clocks, where {needed} are needed"]


def ridden(chip, script):
    """Two periods with the first command. Then each pair in `script` is a command, and the counts after the begin of
    the period at which its tick answers. Returns the edges."""
    bridge = Bridge(chip)
    bridge.off()
    chip.end_period()
    chip.end_period()
    chip.tim1.edges.clear()
    begin, now = chip.cycle_start(), chip.cycle_start()
    for wanted, at in script:
        chip.pass_to(now)
        chip.tim1.write(0x10, ~(1 << 4))  # the tick does this at its begin
        chip.pass_to(now + at)
        bridge.tick(wanted)
        if chip.armed() and chip.tim1.match_4:
            chip.interrupt(END)
        now += PERIOD * (1 + at // PERIOD)
        if chip.now < now - PERIOD + SAMPLE:
            chip.pass_to(now - PERIOD + SAMPLE)
        if chip.armed() and chip.tim1.match_4:
            chip.interrupt(END)
        chip.pass_to(max(now, chip.now))
    return [(t - begin, leg, gate, on) for t, leg, gate, on in chip.tim1.edges]


def changes():
    for (first, way), second, other, duty in itertools.product(itertools.product(PAIRS, WAYS), PAIRS, WAYS[:2], (0.0, 0.5)):
        if (first, way) != (second, other):
            yield (first, way, 0.8), (second, other, duty)


def late_trouble(folder, step=1):
    """Compares each late answer with the same answer in time, one period later."""
    trouble, ran = [], 0
    for timer_waits in (False, True):
        chip = TimedChip(folder, timer_waits)
        chip.hall(0b101)
        chip.start()
        for number, ((a, b), late) in enumerate(itertools.product(list(changes())[::step], LATE)):
            edges = ridden(chip, [(a, 0), (a, 0), (b, late), (b, 0), (b, 0)])
            name = f"{a} -> {b} answered {late} counts behind the period's begin"
            trouble += [f"{name}: {what} of leg {'abc'[leg]} at {t}" for t, leg, what in broken_laws(edges, DEAD)]
            in_time = ridden(chip, [(a, 0), (a, 0), (a, 0), (b, 0), (b, 0), (b, 0)])
            worst = differing(edges, in_time, 0, 5 if late >= PERIOD else 4) if not timer_waits else 0
            if worst > 2 * DEAD + 90:
                trouble.append(f"{name}: a gate differs for {worst} clocks of a period from what it does where {b} comes in time, a period later")
            ran += 1
            if len(trouble) > 5:
                return ran, trouble
    return ran, trouble


def check_told(folder):
    """The tick answers after the fourth match, when the counter has started again. The row counts this late answer."""
    chip = ready(folder)
    for _ in range(3):
        tick(chip)
    chip.type("r100\r")
    chip.go_on(100_000)
    said = []
    for late in (False, True, False):
        for _ in range(200):
            tick(chip)
        chip.go_on(100_000)
        chip.sent, chip.late = "", late
        tick(chip)
        chip.late = False
        chip.go_on(100_000)
        said.append(rows(chip)[-1][9])
    return [] if said == [0, 1, 0] else [f"an answer in time, one behind its period's end, and one in time: the log says {said} missed"]


def planted(folder, name, file, old, new):
    """Builds an image of the sources with a fault."""
    place = pathlib.Path(folder) / name
    for part in ("sixstep/control", "faces/firmware", "tools"):
        shutil.copytree(images.build.REPOSITORY / part, place / part)
    changed = place / images.EXAMPLES["stm32f303"] / file
    text = changed.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{file} has {text.count(old)} times {old!r}"
    changed.write_text(text.replace(old, new), encoding="utf-8")
    images.build.told([place / "tools/firmware_image.sh", "stm32f303", changed.parent / "drive_config.hpp", place / "out"], cwd=place)
    return place / "out"


def check_planted(folder):
    name, old, new = "at once", "const bool in_time = !period_is_over();", "const bool in_time = true;"
    return [] if late_trouble(planted(folder, name, "bridge_timer.hpp", old, new), 101)[1] else ["an answer that comes late and counts at once: not seen"]


def check(folder, whole=False):
    """Checks the image in folder/arm."""
    ran, trouble = late_trouble(folder / "arm", 1 if whole else 9)
    trouble += check_load(folder / "arm") + check_told(folder / "arm") + check_planted(folder)
    print(f"{ran} answers of its control tick behind their period's end: "
          f"{'each counts a period later, and is told' if not trouble else 'trouble'}")
    return trouble
