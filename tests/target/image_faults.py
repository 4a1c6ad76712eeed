# SPDX-License-Identifier: Apache-2.0
"""The causes that stop the STM32F303's drive, on its executed image. The gates are off, the serial line states the
cause, and the drive does not restart by itself."""
import re
import struct

import build
import images
from images import ADC1, AT_REST, BDTR, IWDG, RCC, TIM1, TIM2, USART2, Chip, all_off, tick

MOE = 1 << 15
SECOND = 72_000_000


def ready(folder, chip=None):
    chip = chip or Chip(folder)
    chip.hall(0b101)
    chip.reset()
    return chip


def running(folder):
    """A drive in operation with a setpoint of 100 rad/s."""
    chip = ready(folder)
    for _ in range(10):
        tick(chip)
    chip.type("r100\r")
    chip.go_on(20_000)
    for _ in range(300):
        tick(chip)
    if all_off(chip):
        raise build.Failed("the drive does not start")
    chip.sent = ""
    return chip


def told(chip, instructions=60_000):
    chip.sent = ""
    chip.go_on(instructions)
    return re.findall(r"^# fault: (.*)$", chip.sent, re.M)


def stands(chip, reason, name):
    """Checks a stopped drive. All gates are off. The cause is sent once, and again after a second. The command r does
    not start the drive; c and then r start it."""
    trouble = []
    if not all_off(chip) and chip.words[BDTR] & MOE:
        trouble.append(f"{name}: gates are on: {chip.outputs()}")
    if (said := told(chip)) != [reason]:
        trouble.append(f"{name}: it says {said}, where {reason} is why")
    if said := told(chip):
        trouble.append(f"{name}: it says {said} at once again")
    tick(chip, clocks=SECOND + 1)
    if (said := told(chip)) != [reason]:
        trouble.append(f"{name}: a second later it says {said}")
    for _ in range(5):
        tick(chip)
    chip.type("r")
    chip.go_on(20_000)
    for _ in range(400):
        tick(chip)
    if not all_off(chip):
        trouble.append(f"{name}: r starts it without c")
    for text in ("s", "c", "r"):
        chip.type(text)
        chip.go_on(20_000)
        for _ in range(400):
            tick(chip)
    if all_off(chip) or not chip.words[BDTR] & MOE:
        trouble.append(f"{name}: c and r do not start it again")
    return trouble


def check_sensors(folder):
    trouble = []
    for counts, reason in (((0, 2048, 2048), "current-sensor"), ((2048, 4095, 2048), "current-sensor"), ((0, 0, 0), "current-sensor"),
                           ((4095, 4095, 4095), "current-sensor"), ((2048 + 250, 2048, 2048), "current-sensor"),
                           ((2048 + 1200, 2048 - 1200, 2048), "over-current"), ((4095, 0, 2048), "over-current")):
        chip = running(folder)
        for _ in range(3):
            tick(chip, (*counts, AT_REST[3]))
        trouble += stands(chip, reason, f"currents of {counts} counts")
    chip = running(folder)
    for n in range(300):  # one wrong reading every few periods
        tick(chip, (2048 + (400 if n % 3 == 0 else 0), 2048, 2048, AT_REST[3]))
    if all_off(chip):
        trouble.append("a single disturbed reading stops the drive")
    chip = running(folder)
    for _ in range(5):
        tick(chip, (2048, 2048, 2048, round(31 / 52.8 * 4096)))
    return trouble + stands(chip, "over-voltage", "a bus of 31 V")


def check_break(folder):
    chip = running(folder)
    chip.words[BDTR] &= ~MOE  # the timer itself does this at a break
    chip.interrupt(24)
    trouble = []
    if chip.words[TIM1 + 0x0C] & 1 << 7:
        trouble.append("break: its interrupt comes for ever while the level stands")
    tick(chip)
    if chip.words[BDTR] & MOE:
        trouble.append("break: gates may work again before c")
    return trouble + stands(chip, "comparator", "break")


class NoClock(Chip):
    """A chip whose external clock never starts."""

    def write(self, core, offset, size, value, begin):
        super().write(core, offset, size, value, begin)
        if begin + offset == RCC:
            self.words[RCC] = value & ~(1 << 17)


def at_8_MHz(chip):
    """The baud rate of the serial line at a clock of 8 MHz (RM0316, 29.5.4, with OVER8)."""
    divider = chip.words[USART2 + 0x0C]
    over_8 = bool(chip.words[USART2] & 1 << 15)
    scale = 1 << (chip.words[RCC + 0x04] >> 8 & 7) - 3 if chip.words[RCC + 0x04] >> 8 & 4 else 1
    divided = (divider & ~0xF | (divider & 7) << 1) / 2 if over_8 else divider
    return 8e6 / scale / divided


def check_clock(folder):
    trouble = []
    chip = running(folder)
    chip.interrupt(-14)  # the interrupt of the clock security system
    if chip.words[BDTR] & MOE or (RCC + 0x08, 1 << 23) not in chip.written:
        trouble.append("clock lost: the gates may work, or the interrupt is not acknowledged")
    if at_8_MHz(chip) != 1_000_000:
        trouble.append(f"clock lost: the line has {at_8_MHz(chip)} baud")
    if (said := told(chip)) != ["clock"]:
        trouble.append(f"clock lost: it says {said}")
    chip.written = []
    chip.go_on(20_000)
    if (IWDG, 0xAAAA) not in chip.written:
        trouble.append("clock lost: the watchdog resets it for ever")
    chip.type("r")
    chip.go_on(20_000)
    if chip.words[BDTR] & MOE:
        trouble.append("clock lost: r lets the gates work")
    chip.written = []
    chip.type("c")
    chip.go_on(20_000)
    if (0xE000ED0C, 0x05FA0004) not in chip.written:
        trouble.append("clock lost: c does not reset the chip")
    chip = ready(folder, NoClock(folder))
    if "# fault: clock\n" not in chip.sent or at_8_MHz(chip) != 1_000_000:
        trouble.append(f"no clock at the start: it says {chip.sent!r} at {at_8_MHz(chip)} baud")
    if chip.words.get(BDTR, 0) & MOE:
        trouble.append("no clock at the start: gates may work")
    return trouble


def check_converter(folder):
    chip = running(folder)
    chip.words[TIM2 + 0x24] += 72_100
    trouble = [] if told(chip) == ["converter"] else [f"no conversion for a millisecond: it says {chip.sent!r}"]
    if chip.words[BDTR] & MOE:
        trouble.append("no conversion for a millisecond: the gates may work")
    chip.written = []
    chip.go_on(20_000)
    if (IWDG, 0xAAAA) not in chip.written:
        trouble.append("no conversion: the watchdog hides the reason")
    return trouble


def reset_with(folder, memory, cause):
    chip = Chip(folder)
    chip.core.mem_write(images.RAM, bytes(memory))
    chip.words[RCC + 0x24] = cause
    return ready(folder, chip)


def check_resets(folder):
    """A reset by the watchdog keeps the cause of the stop. After power-up no cause is set, even if the memory has
    random content."""
    trouble = []
    chip = running(folder)
    chip.hall(0)
    chip.interrupt(28)
    tick(chip)
    told(chip)
    hall = chip.core.mem_read(images.RAM, 40 * 1024)
    chip = running(folder)
    quiet = chip.core.mem_read(images.RAM, 40 * 1024)
    chip.interrupt(5)  # this interrupt has no handler
    program = chip.core.mem_read(images.RAM, 40 * 1024)
    for name, memory, cause, reason in (("hall", hall, 1 << 29, "hall"), ("nobody's interrupt", program, 1 << 29, "program"),
                                        ("no reason", quiet, 1 << 29, "watchdog")):
        chip = reset_with(folder, memory, cause)
        if f"# fault: {reason}\n" not in chip.sent:
            trouble.append(f"behind the watchdog's reset with {name}: {chip.sent!r}")
        chip.sent = ""
        tick(chip)
        chip.type("r100\r")
        chip.go_on(20_000)
        for _ in range(400):
            tick(chip)
        if not all_off(chip):
            trouble.append(f"behind the watchdog's reset with {name}: it starts without c")
    for memory, cause in ((b"\x55" * 40960, 0), (hall, 1 << 26), (quiet, 1 << 27)):
        chip = reset_with(folder, memory, cause)
        if "# fault" in chip.sent:
            trouble.append(f"power-up: {chip.sent!r}")
        for _ in range(300):
            tick(chip)
        if not all_off(chip):
            trouble.append("power-up: it starts by itself")
    return trouble


def check_board_alone(folder):
    """The drive has stopped because of a fault of the board. The fault has ended. The line still states it as the
    cause."""
    chip = running(folder)
    chip.words[BDTR] &= ~MOE
    chip.interrupt(24)
    tick(chip)
    told(chip)
    chip.core.mem_write(chip.symbols["firmware::board_fault"], bytes(1))
    said = told(chip)
    return [] if said == ["board"] else [f"a drive that stands says {said}"]


class Glitches(Chip):
    """One read of the Hall pins gives another code."""
    at = -1
    looks = 0

    def read(self, core, offset, size, begin):
        value = super().read(core, offset, size, begin)
        if begin + offset == images.GPIOA + 0x10:
            self.looks += 1
            return value ^ (1 << 15 if self.looks == self.at else 0)
        return value


def check_hall(folder):
    trouble = []
    for at in range(1, 5):
        chip = Glitches(folder)
        ready(folder, chip)
        tick(chip)
        chip.looks, chip.at = 0, at
        tick(chip)
        if told(chip):
            trouble.append(f"a glitch in reading {at} of the Hall pins stops the drive")
    return trouble + check_time_between_looks(ready(folder))


def check_time_between_looks(chip):
    """A quarter of a microsecond is 18 clocks. Every instruction takes at least one clock."""
    passed, looks = [0], []
    chip.core.hook_add(images.unicorn.UC_HOOK_CODE, lambda *_: passed.__setitem__(0, passed[0] + 1))
    chip.core.hook_add(images.unicorn.UC_HOOK_MEM_READ, lambda _, access, at, *rest: looks.append(passed[0]) if at == images.GPIOA + 0x10 else None)
    chip.interrupt(28)
    apart = [later - earlier for earlier, later in zip(looks, looks[1:])]
    return [] if len(looks) == 3 and min(apart) > 18 else [f"{len(looks)} looks at the Hall pins lie {apart} instructions apart"]


def check_most(folder):
    """Even at the largest voltage of the loops, the on-time leaves the gap for charging the bootstraps."""
    chip = running(folder)
    chip.type("300\r")
    chip.go_on(20_000)
    most = 0
    for _ in range(2000):
        tick(chip)
        most = max(most, chip.words[TIM1 + 0x34])
    return [] if most == 2160 - 108 else [f"the longest on-time has {most} counts of 2160: a gap of 108 is wanted"]


def check_constructors(folder):
    """A global object of a user is constructed before main()."""
    example = build.REPOSITORY / images.EXAMPLES["stm32f303"]
    source = folder / "own.cpp"
    source.write_text("struct Own { int seen; Own() : seen(12345) { asm volatile(\"\"); } };\nOwn own;\n"
                      "int unset_at_first = [] { volatile int x = 54321; return x; }();\n")
    build.told(["arm-none-eabi-g++", f"@{example}/compile.flags", f"-I{build.REPOSITORY}", f"-I{build.REPOSITORY}/faces/firmware/bare", f"-I{folder}",
                *(example / name for name in ("main.cpp", "start.cpp", "start.S")), source, build.REPOSITORY / "faces/firmware/bare/memory.cpp",
                "-nostdlib", "-T", example / "stm32f303.ld", "-o", folder / "image.elf", "-lgcc"])
    build.told(["arm-none-eabi-objcopy", "-O", "binary", folder / "image.elf", folder / "image.bin"])
    chip = ready(folder)
    value = struct.unpack("<i", chip.core.mem_read(chip.symbols["unset_at_first"], 4))[0]
    trouble = [] if value == 54321 else [f"a constructor did not run: {value}"]
    if not chip.symbols["stack_top"] <= chip.symbols["data_begin"] or chip.symbols["stack_top"] - images.RAM != 8192:
        trouble.append("the stack does not lie at the memory's low end, where growing too far is a fault")
    return trouble


CHECKS = (check_sensors, check_break, check_clock, check_converter, check_resets, check_board_alone, check_hall, check_most)


def check(folder):
    trouble = []
    for part in CHECKS:
        trouble += part(folder)
    own = folder.parent / "own"
    own.mkdir(exist_ok=True)
    (own / "drive_config.hpp").write_bytes((folder / "drive_config.hpp").read_bytes())
    return trouble + check_constructors(own)
