# SPDX-License-Identifier: Apache-2.0
"""Executes the images to flash (tools/firmware_image.sh).

The image of the STM32F303 runs instruction by instruction on Unicorn's Cortex-M4. The registers around the core store
what the program writes, and give the answers for which the set-up waits. No available emulator has the timers and the
converter of this chip. The test compares each register with RM0316, and calls the interrupts and the main loop as the
chip does. The timer's pulses are those of a model of its output stage, written from the manual (tim1.py,
transitions.py). image_faults.py tests the causes that stop the drive. No emulator tests the converter's instants.
`sixstep run --on avr` runs the ATmega2560's image, with the board's timer, converter and serial line (avr.py). This
module only builds it."""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

sys.path.append("/usr/lib/python3/dist-packages")  # Debian's folder of modules, for every python3
import unicorn
from unicorn import arm_const as arm

import build
from image_registers import (ADC1, BDTR, CCER, CCMR1, CCMR2, EGR, GPIOA, GPIOB, IWDG, RCC, TABLE, TIM1, TIM2, USART2)

FLASH, RAM = 0x08000000, 0x20000000
NOWHERE = FLASH + 0x30000  # the return address of a handler
COMG = 1 << 5
RESET = {RCC: 0x83, RCC + 0x14: 0x14, GPIOA: 0xA8000000, GPIOA + 0x0C: 0x64000000, GPIOB: 0x280, GPIOB + 0x0C: 0x100}


class Chip:
    """Unicorn's core, with registers that store their values."""

    def __init__(self, folder):
        self.core = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS)
        self.core.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
        self.words, self.written, self.sent, self.typed, self.line_status = dict(RESET), [], "", [], 0
        self.passing, self.late = False, False
        self.core.mem_map(FLASH, 256 * 1024)
        self.core.mem_map(RAM, 64 * 1024)
        self.core.mem_write(FLASH, (folder / "image.bin").read_bytes())
        for begin, size in ((0x40000000, 0x40000), (0x48000000, 0x2000), (0x50000000, 0x1000), (0xE0000000, 0x100000)):
            self.core.mmio_map(begin, size, self.read, begin, self.write, begin)
        self.symbols = {}
        for line in build.told(["arm-none-eabi-nm", "-C", folder / "image.elf"]).splitlines():
            if found := re.fullmatch(r"([0-9a-f]{8}) \w (.+)", line):
                self.symbols[found[2]] = int(found[1], 16)
        self.stack, self.begin = struct.unpack("<II", self.core.mem_read(FLASH, 8))

    def read(self, _, offset, size, begin):
        at = begin + offset
        if self.passing and at in (TIM1 + 0x24, TIM2 + 0x24):
            self.words[at] = self.words.get(at, 0) + 1
        if at == TIM1 + 0x10 and self.late:
            return 1 << 4  # the counter has passed its fourth match and the end of the period
        if at == USART2 + 0x1C:
            return 0x80 | (0x20 if self.typed else 0) | self.line_status
        if at == USART2 + 0x24:
            return ord(self.typed.pop(0))
        return self.words.get(at, 0) & (1 << 8 * size) - 1

    def write(self, _, offset, size, value, begin):
        at = begin + offset
        self.written.append((at, value))
        if at == USART2 + 0x28:
            self.sent += chr(value)
        elif at == ADC1:
            self.words[at] = self.words.get(at, 0) & ~value
        elif at == RCC:
            self.words[at] = value | (value & 1 << 16) << 1 | (value & 1 << 24) << 1
        elif at == RCC + 0x04:
            self.words[at] = value & ~0xC | (value & 3) << 2
        elif at == ADC1 + 0x08:
            self.words[at] = value & ~(1 << 31)
            if value & 1:
                self.words[ADC1] = self.words.get(ADC1, 0) | 1
        else:
            self.words[at] = value

    def run(self, at, instructions):
        self.core.emu_start(at | 1, NOWHERE, count=instructions)

    def reset(self):
        self.core.reg_write(arm.UC_ARM_REG_SP, self.stack)
        self.run(self.begin, 2_000_000)

    def go_on(self, instructions):
        self.run(self.core.reg_read(arm.UC_ARM_REG_PC), instructions)

    def interrupt(self, position):
        """Calls an interrupt as the core does, but without its stacking. The interrupted code continues afterwards.
        `written` lists the registers that the interrupt wrote."""
        before = self.core.context_save()
        handler = struct.unpack("<I", self.core.mem_read(FLASH + 4 * (16 + position), 4))[0]
        self.written = []
        self.core.reg_write(arm.UC_ARM_REG_LR, NOWHERE | 1)
        self.run(handler & ~1, 100_000)
        ended = self.core.reg_read(arm.UC_ARM_REG_PC) & ~1 == NOWHERE
        self.core.context_restore(before)
        return ended

    def type(self, text):
        """Sends characters as a line-buffered terminal does: all of them arrive before the main loop reads one."""
        for character in text:
            self.typed.append(character)
            self.interrupt(38)

    def hall(self, code):
        self.words[GPIOA + 0x10] = (code >> 2 & 1) << 15
        self.words[GPIOB + 0x10] = (code >> 1 & 1) << 3 | (code & 1) << 10

    def outputs(self):
        """For each leg: the output mode, and whether the upper and lower outputs are enabled."""
        modes = self.words[CCMR1] | self.words[CCMR2] << 16
        return [(modes >> (8 * leg + 4) & 7, self.words[CCER] >> 4 * leg & 1, self.words[CCER] >> (4 * leg + 2) & 1) for leg in range(3)]


def built(board, folder):
    build.told([build.REPOSITORY / "tools/firmware_image.sh", board, build.REPOSITORY / EXAMPLES[board] / "drive_config.hpp", folder])
    return [f"{board}: no image.{kind}" for kind in ("elf", "hex", "bin") if not (folder / f"image.{kind}").stat().st_size]


EXAMPLES = {"stm32f303": "faces/firmware/example/cortex_m", "atmega2560": "faces/firmware/example/avr"}
HEADINGS = "t [us],speed [rad/s],speed_ref [rad/s],i_m [mA],duty,bus [V],hall,activity,faults,missed"


def lost_break_wire(chip):
    """An open pin has the level of its pull resistor (11.4.4). At PB12 this must be the active level of the break
    input, BKP (20.4.18). Otherwise a lost wire would disable the comparator's protection."""
    pull, active_high = chip.words[GPIOB + 0x0C] >> 24 & 3, chip.words[BDTR] >> 13 & 1
    return [] if pull == (1 if active_high else 2) else ["with a lost wire at the break input the gates may work"]


def check_set_up(chip):
    chip.reset()
    trouble = [f"{name} at {at:#010x}: {chip.words.get(at, 0) & mask:#010x}, where {value & mask:#010x} belongs ({section})"
               for name, at, mask, value, section in TABLE if (chip.words.get(at, 0) ^ value) & mask]
    if chip.sent.splitlines() != ["# sixstep on an STM32F303", HEADINGS]:
        trouble.append(f"it said {chip.sent!r}")
    return trouble + lost_break_wire(chip)


AT_REST = (2048, 2048, 2048, round(24 / 52.8 * 4096))


def tick(chip, counts=AT_REST, clocks=2160):
    """A period: the control interrupt, and at its end the interrupt of the fourth compare unit, if it is enabled."""
    for n, count in enumerate(counts):
        chip.words[ADC1 + 0x80 + 4 * n] = count
    chip.words[TIM2 + 0x24] = chip.words.get(TIM2 + 0x24, 0) + clocks & 0xFFFFFFFF
    chip.words[ADC1] = 0x41
    ended = chip.interrupt(18)
    return ended and end_of_period(chip)


def end_of_period(chip):
    if not chip.words.get(TIM1 + 0x0C, 0) & 1 << 4:
        return True
    chip.words[TIM1 + 0x10] = chip.words.get(TIM1 + 0x10, 0) | 1 << 4
    chip.passing = True  # the set-up waits for this counter, so it must count
    ended = chip.interrupt(27)
    chip.passing = False
    return ended


def all_off(chip):
    return all(mode == 4 and (upper, lower) in ((1, 0), (0, 1)) for mode, upper, lower in chip.outputs())


def check_running(chip):
    """First the offsets are measured, with all gates off. After r the bootstraps are charged, and the drive has a
    setpoint and the pair of the Hall code. The Hall interrupt selects the next pair."""
    trouble = []
    chip.hall(0b101)
    for _ in range(2000):
        if not tick(chip):
            return ["its control interrupt did not return"]
    if not all_off(chip):
        trouble.append("gates run before anyone said r")
    chip.type("r100\r")
    chip.go_on(20_000)
    if "# setpoint 100 rad/s\n" not in chip.sent:
        trouble.append(f"the setpoint is not echoed: {chip.sent[-200:]!r}")
    charged = 0
    for _ in range(400):
        tick(chip)
        pulses = chip.outputs() == [(6, 0, 1)] * 3
        charged += pulses
        if pulses and chip.words[TIM1 + 0x34] != 144:
            trouble.append(f"the bootstraps are charged by pulses of {chip.words[TIM1 + 0x34]} counts, not 2 us")
    if charged < 100:
        trouble.append(f"the lower gates pulse in {charged} periods before the first command, not in 100")
    seen = []
    for code in (0b101, 0b001, 0b011, 0b010, 0b110, 0b100):
        chip.hall(code)
        chip.words[TIM2 + 0x34] = chip.words[TIM2 + 0x24]
        if not chip.interrupt(28):
            return trouble + ["its Hall interrupt did not return"]
        order = [at for at, _ in chip.written if at in (EGR, CCMR1, CCMR2, CCER)]
        if seen and (order != [CCMR1, CCMR2, CCER, EGR] or (EGR, COMG) not in chip.written):
            trouble.append(f"at code {code:03b} the three channels do not change at one commutation event: {chip.written}")
        legs = chip.outputs()
        seen.append(tuple(legs))
        if sorted(mode for mode, _, _ in legs) != [4, 4, 6]:
            trouble.append(f"at code {code:03b} the legs are {legs}: one pulsed and two low are wanted")
        for _ in range(40):  # 40 periods of 30 us in a sector: 109 rad/s
            tick(chip)
    if len(set(seen)) != 6:
        trouble.append(f"six Hall codes have {len(set(seen))} pairs")
    chip.type("s")
    chip.go_on(20_000)
    for _ in range(20_000):
        tick(chip)
        if all_off(chip):
            return trouble
    return trouble + ["its gates still run 0.6 s behind s, at a rotor that stands"]


def check_log(chip):
    chip.sent = ""
    for _ in range(5):
        tick(chip)
        chip.go_on(200_000)
    rows = [line.split(",") for line in chip.sent.splitlines() if line]
    fine = rows and all(len(row) == 10 and all(re.fullmatch(r"-?\d+(\.\d{3})?", cell) for cell in row) for row in rows)
    if not fine or not 23.9 < float(rows[-1][5]) < 24.1:
        return [f"its log says {chip.sent!r}"]
    return []


def check_end(chip):
    """The main loop restarts the watchdog only while control interrupts come. An interrupt without a handler turns
    the gates off."""
    trouble = []
    chip.go_on(200_000)
    chip.written = []
    chip.go_on(200_000)
    if (IWDG, 0xAAAA) in chip.written:
        trouble.append("the watchdog is fed though no control interrupt comes")
    tick(chip)
    chip.written = []
    chip.go_on(200_000)
    if chip.written.count((IWDG, 0xAAAA)) != 1:
        trouble.append("the watchdog is not fed once for a control interrupt")
    chip.interrupt(5)
    if chip.words[BDTR] & 1 << 15:
        trouble.append("a fault leaves the gates on")
    return trouble


def check(whole=False):
    import image_drives  # image_drives imports this module
    import image_faults
    import image_line
    import image_load
    import transitions
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        trouble = built("atmega2560", folder / "avr") + built("stm32f303", folder / "arm")
        chip = Chip(folder / "arm")
        trouble += check_set_up(chip)
        if not trouble:
            trouble += check_running(chip) + check_log(chip) + check_end(chip)
        print(f"the STM32F303's image, executed: {len(TABLE)} registers as RM0316 wants them, interrupts and log: "
              f"{'all as they should be' if not trouble else 'trouble'}")
        wrong = image_faults.check(folder / "arm") + image_line.check(folder / "arm")
        print(f"what stops its drive, with the reason that it tells, and its serial line: {'all as it should be' if not wrong else 'trouble'}")
        changes, broken = transitions.check(folder / "arm", whole)
        broken += image_drives.check_drives(folder)
        print(f"{changes} changes of its legs, clock by clock: {'never both switches of a leg' if not broken else 'trouble'}")
        broken += image_load.check(folder, whole)
    trouble += wrong + broken
    print("\n".join(trouble), end="\n" if trouble else "")
    return not trouble


def check_all():
    return check(True)
