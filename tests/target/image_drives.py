# SPDX-License-Identifier: Apache-2.0
"""Complete drives on the STM32F303's image, clock by clock: reversals at speed with each kind of chopping, and
interrupts that interrupt each other. An image whose dead time is one clock too short must fail."""
import itertools

import images
import tim1
from tim1 import broken_laws
from timed_chip import DEAD, PAIRS, PERIOD, SAMPLE, TIM1, TIM2, WAYS, Bridge, TimedChip
from transitions import check_late_ticks, check_scripts, of_edges_at_once, said


class Ride:
    """Calls the image's interrupts as a turning rotor does, with the image's own drive. The test sets the currents;
    they are not simulated."""
    codes = (0b101, 0b001, 0b011, 0b010, 0b110, 0b100)
    fed = ((0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1))  # the positive pair of each code

    def __init__(self, folder, sector_clocks):
        self.chip = TimedChip(folder)
        self.at, self.sector_clocks = 0, sector_clocks
        self.chip.hall(self.codes[0])
        self.chip.start()
        self.next_edge = self.chip.now + sector_clocks

    def conversions(self, amperes):
        counts = [2048] * 3
        source, sink = self.fed[self.at % 6]
        counts[source], counts[sink] = round(2048 + amperes / 33 * 2048), round(2048 - amperes / 33 * 2048)
        for n, count in enumerate((*counts, round(24 / 52.8 * 4096))):
            self.chip.words[images.ADC1 + 0x80 + 4 * n] = count

    def edge(self):
        self.at += 1
        self.chip.hall(self.codes[self.at % 6])
        self.chip.words[TIM2 + 0x34] = self.chip.now - 256 & 0xFFFFFFFF
        if not self.chip.interrupt(28):
            raise images.build.Failed("the Hall interrupt did not return")
        self.next_edge += self.sector_clocks

    def go(self, periods, amperes=0.0):
        chip = self.chip
        for _ in range(periods):
            update = chip.cycle_start() + PERIOD
            self.conversions(amperes)
            if not chip.interrupt(18):
                raise images.build.Failed("the control interrupt did not return")
            while self.next_edge < update - 80:
                chip.pass_to(self.next_edge)
                self.edge()
            chip.end_period()

    def type(self, text):
        self.chip.type(text)
        self.chip.call("listen")


def changes_of_side(edges):
    """The number of times that one switch of a leg turned on after the other switch of the leg."""
    last, changes = [None] * 3, 0
    for _, leg, gate, level in edges:
        if level:
            changes += last[leg] not in (None, gate)
            last[leg] = gate
    return changes


def check_drive(folder, name):
    """The drive starts, runs at 300 rad/s, and then at 70 rad/s. It brakes with the reversed pair. Then it reverses
    and stops, and a Hall line breaks."""
    ride = Ride(folder, round(72e6 * 0.1309 / 300))
    ride.go(300)
    ride.type("r300\r")
    ride.go(700, 0.55)
    begin = len(ride.chip.tim1.edges)
    ride.type("70\r")
    ride.go(300, 0.55)
    reversals = changes_of_side(ride.chip.tim1.edges[begin:])
    ride.type("-300\r")
    ride.go(100, -0.4)
    ride.type("300\r")
    ride.go(100, 0.4)
    ride.type("s")
    ride.go(100, 0.2)
    ride.type("r")
    ride.go(100, 0.2)
    ride.chip.hall(0)
    ride.chip.interrupt(28)
    trouble = [f"{name}: {what} of leg {'abc'[leg]} at {t}" for t, leg, what in broken_laws(ride.chip.tim1.edges, DEAD)][:5]
    if ride.chip.tim1.let_go:
        trouble.append(f"{name}: an output is let go")
    if reversals == 0:
        trouble.append(f"{name}: no leg changed sides at the reversal, so that nothing was tried")
    if any(any(gates) for gates in ride.chip.tim1.gates):
        trouble.append(f"{name}: a gate is on behind the Hall interrupt of an impossible code")
    return trouble


def check_amid(folder):
    """The end of the period interrupts the Hall interrupt or the control tick, after each of their instructions."""
    chip, trouble = TimedChip(folder), []
    chip.hall(0b101)
    chip.start()
    bridge, forward, other = Bridge(chip), (PAIRS[0], WAYS[0], 0.5), (PAIRS[2], WAYS[0], 0.5)
    for handler, behind in itertools.product((28, 18), range(1, 2000, 13)):
        bridge.off()
        for _ in range(2):
            chip.end_period()
        chip.tim1.edges.clear()
        for wanted in (forward, forward):
            bridge.tick(wanted)
            chip.end_period()
        bridge.tick(other)
        chip.pass_to(chip.cycle_start() + SAMPLE)
        if chip.interrupt_amid(chip.handler(handler), behind, 27):
            chip.pass_to(chip.now + 3 * PERIOD)
        trouble += [f"period's end {behind} instructions into interrupt {handler}: {what} of leg {'abc'[leg]}"
                    for _, leg, what in broken_laws(chip.tim1.edges, DEAD)][:2]
        if len(trouble) > 5:
            return trouble
    return trouble


def check_clear(folder):
    """The end of the period comes after any instruction of the main loop during the command c. An event that was
    handled is not handled again."""
    chip = TimedChip(folder)
    chip.hall(0b101)
    chip.start()
    bridge, forward, other = Bridge(chip), (PAIRS[0], WAYS[0], 0.5), (PAIRS[2], WAYS[0], 0.5)
    for behind in range(1, 1000):
        bridge.off()
        for _ in range(2):
            chip.end_period()
        for wanted in (forward, forward):
            bridge.tick(wanted)
            chip.end_period()
        bridge.tick(other)
        chip.type("c")
        chip.pass_to(chip.cycle_start() + SAMPLE)
        if not chip.interrupt_amid(chip.entry("listen"), behind, 27):
            return [] if behind > 50 else [f"the main loop obeys c in {behind} instructions: nothing was tried"]
        if chip.armed():
            return [f"the period's end {behind} instructions into the main loop's c: its interrupt is asked for again"]
    return ["the main loop does not come to an end behind c"]


def check_latency(folder):
    """From the match of the fourth compare unit to the update are 72 clocks. The core needs 12 of them to enter the
    interrupt. The interrupt must read the counter before the update."""
    chip, begun, counted = TimedChip(folder), [0], []
    chip.hall(0b101)
    chip.start()
    bridge = Bridge(chip)
    for wanted in ((PAIRS[0], WAYS[0], 0.5), (PAIRS[0], WAYS[0], 0.5), (PAIRS[2], WAYS[0], 0.5)):
        bridge.tick(wanted)
        if wanted[0] == PAIRS[0]:
            chip.end_period()
    chip.pass_to(chip.cycle_start() + SAMPLE)

    def one_more(*_):
        begun[0] += 1

    def looked(_, access, at, *rest):
        if at == TIM1 + 0x24 and not counted:
            counted.append(begun[0])
    chip.core.hook_add(images.unicorn.UC_HOOK_CODE, one_more)
    chip.core.hook_add(images.unicorn.UC_HOOK_MEM_READ, looked)
    if not chip.interrupt(27) or not counted or counted[0] > 40:
        return [f"the period's interrupt looks at the counter behind {counted} instructions, too late for the update"]
    return []


def changed_image(folder, name, *changes):
    header = (images.build.REPOSITORY / images.EXAMPLES["stm32f303"] / "drive_config.hpp").read_text()
    for old, new in changes:
        if header.count(old) != 1:
            raise images.build.Failed(f"the example's header has {old!r} {header.count(old)} times")
        header = header.replace(old, new)
    (folder / name).mkdir(exist_ok=True)
    (folder / f"{name}.hpp").write_text(header)
    images.build.told([images.build.REPOSITORY / "tools/firmware_image.sh", "stm32f303", folder / f"{name}.hpp", folder / name])
    return folder / name


def check_drives(folder):
    """Complete drives with each kind of chopping. An image whose dead time is one clock too short must fail."""
    chopping = "c.chopping = Chopping::soft;"
    trouble = tim1.check_itself() + check_latency(folder / "arm") + check_amid(folder / "arm") + check_clear(folder / "arm") + check_drive(folder / "arm", "soft")
    for way in ("hard", "complementary"):
        trouble += check_drive(changed_image(folder, way, (chopping, f"c.chopping = Chopping::{way};")), way)
    long = TimedChip(changed_image(folder, "long", ("dead_time_ps = 500000;", "dead_time_ps = 2000000;")))
    long.hall(0b101)
    long.start()  # the dead time of this image is longer than the time from the last compare instant of a period to its end
    trouble += check_scripts(long, of_edges_at_once((0.95,), PAIRS[:1]), compares=False, dead=144)[1] + check_late_ticks(long, 144)
    short = changed_image(folder, "short", ("dead_time_ps = 500000;", "dead_time_ps = 486000;"))
    for way in WAYS:
        forward, back = ((0, 1), way, 0.3), ((1, 0), way, 0.3)
        chip = TimedChip(short)
        chip.hall(0b101)
        chip.start()
        amid_pulse = [(forward, []), (forward, []), (forward, [(300, back[0])]), (back, [])]
        if not check_scripts(chip, [("", amid_pulse)], compares=False)[1]:
            trouble.append(f"a dead time of 35 clocks instead of 36 is not seen in {said(forward)} -> {said(back)}")
    return trouble
