# SPDX-License-Identifier: Apache-2.0
"""Images to flash (tools/firmware_image.sh), executed.

The STM32F303's runs instruction by instruction on Unicorn's Cortex-M4, with registers around it that remember what was written and answer
what the set-up waits for; no emulator at hand has that chip's timers and converter. Then each register is held against RM0316, and the
interrupts and the main loop are called as the chip would call them. The timer's pulses are those of a model of its output stage, written from
the manual (tim1.py, transitions.py); image_faults.py has what stops the drive. The converter's instants have been seen on no
emulator. The ATmega2560's image is the one that `sixstep run --on avr` runs, whose timer, converter
and serial line are the board's (avr.py): here it is only built."""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian puts it, whichever python3 comes first
import unicorn
from unicorn import arm_const as arm

import build

FLASH, RAM = 0x08000000, 0x20000000
NOWHERE = FLASH + 0x30000  # where a handler returns to
RCC, GPIOA, GPIOB, GPIOC, TIM1, TIM2, ADC1, USART2, IWDG = (0x40021000, 0x48000000, 0x48000400, 0x48000800, 0x40012C00, 0x40000000,
                                                           0x50000000, 0x40004400, 0x40003000)
EGR, CCMR1, CCMR2, CCER, BDTR = (TIM1 + offset for offset in (0x14, 0x18, 0x1C, 0x20, 0x44))
COMG = 1 << 5



def fields(bits, values):
    """A register of fields of so many bits each, by their places."""
    return sum(value << bits * place for place, value in values.items())


# Register, mask, what stands there once the set-up is done, and what RM0316 says of it.
TABLE = [
    ("RCC_CR", RCC + 0x00, 0x010D0000, 0x010D0000, "9.4.1: HSEON, HSEBYP, CSSON, PLLON"),
    ("RCC_CFGR", RCC + 0x04, 0x003DBFF3, 0x001D0402, "9.4.2: SW = PLL, HPRE = 1, PPRE1 = /2, PPRE2 = 1, PLLSRC = HSE, PLLMUL = 9"),
    ("RCC_CFGR2", RCC + 0x2C, 0x0000000F, 0x00000000, "9.4.12: PREDIV = 1"),
    ("FLASH_ACR", 0x40022000, 0x17, 0x12, "4.5.1: two wait states above 48 MHz, prefetch"),
    ("RCC_AHBENR", RCC + 0x14, 0x100E0000, 0x100E0000, "9.4.6: ports A, B, C, ADC12"),
    ("RCC_APB2ENR", RCC + 0x18, 0x801, 0x801, "9.4.7: TIM1, SYSCFG"),
    ("SYSCFG_CFGR2", 0x40010018, 0x1, 0x1, "12.1: LOCKUP_LOCK, a core that gives up is a break"),
    ("RCC_APB1ENR", RCC + 0x1C, 0x20001, 0x20001, "9.4.8: TIM2, USART2"),
    ("GPIOA_MODER", GPIOA, 0xFFFFFFFF, fields(2, {0: 3, 1: 3, 2: 2, 3: 2, 8: 2, 9: 2, 10: 2, 13: 2, 14: 2, 15: 2}),
     "11.4.1: PA0, PA1 analog; PA2, PA3, PA8..10, PA15 alternate; PA13, PA14 stay"),
    ("GPIOA_AFRL", GPIOA + 0x20, 0xFF00, 0x7700, "11.4.9: AF7 is USART2 at PA2, PA3"),
    ("GPIOA_AFRH", GPIOA + 0x24, 0xF0000FFF, 0x10000666, "11.4.10: AF6 is TIM1 at PA8..10, AF1 TIM2_CH1 at PA15"),
    ("GPIOA_PUPDR", GPIOA + 0x0C, fields(2, dict.fromkeys((3, 8, 9, 10, 15), 3)), fields(2, {3: 1, 8: 2, 9: 2, 10: 2, 15: 1}),
     "11.4.4: gates pulled down, H1 and the serial line's input up"),
    ("GPIOB_MODER", GPIOB, fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 3)), fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 2)),
     "11.4.1: PB3, PB10, PB12..15 alternate"),
    ("GPIOB_AFRL", GPIOB + 0x20, 0xF000, 0x1000, "11.4.9: AF1 is TIM2_CH2 at PB3"),
    ("GPIOB_AFRH", GPIOB + 0x24, 0xFFFF0F00, 0x46660100, "11.4.10: AF1 TIM2_CH3 at PB10, AF6 TIM1_BKIN at PB12, TIM1_CH1N, CH2N at PB13, PB14, AF4 CH3N at PB15"),
    ("GPIOB_PUPDR", GPIOB + 0x0C, fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 3)), fields(2, {3: 1, 10: 1, 12: 1, 13: 2, 14: 2, 15: 2}),
     "11.4.4: gates pulled down, the break input, H2 and H3 up"),
    ("GPIOC_MODER", GPIOC, 0xF, 0xF, "11.4.1: PC0, PC1 analog"),
    ("USART2_BRR", USART2 + 0x0C, 0xFFFF, 36, "29.8.4: 36 MHz / 1 000 000"),
    ("USART2_CR1", USART2 + 0x00, 0xFFFFFFFF, 0x2D, "29.8.1: UE, RE, TE, RXNEIE, 8 bits, no parity"),
    ("TIM1_CR1", TIM1 + 0x00, 0xFFFF, 0x81, "20.4.1: counts up, ARR preloaded, runs"),
    ("TIM1_CR2", TIM1 + 0x04, 0xFFFFFF, 0x700001, "20.4.2: CCPC, a COM event by software alone (CCUS = 0), TRGO2 is OC4REF"),
    ("TIM1_PSC", TIM1 + 0x28, 0xFFFF, 0, "20.4.11"),
    ("TIM1_ARR", TIM1 + 0x2C, 0xFFFF, 2159, "20.4.12: 30 us of 72 MHz"),
    ("TIM1_CCMR1", CCMR1, 0x0101FFFF, 0x4848, "20.4.7: OC1M = OC2M = 100 (forced inactive), OCxPE"),
    ("TIM1_CCMR2", CCMR2, 0x0101FFFF, 0x7848, "20.4.8: OC4M = 111 (high from its compare value on), OC4PE"),
    ("TIM1_CCER", CCER, 0xFFFF, 0x111, "20.4.9: of each leg one output, at its forced low level, the other driven inactive (OSSR)"),
    ("TIM1_CCR4", TIM1 + 0x40, 0xFFFF, 2088, "20.4.17: 1 us before the update"),
    ("TIM1_DIER", TIM1 + 0x0C, 0xFFFF, 0x80, "20.4.4: BIE"),
    ("TIM1_BDTR", BDTR, 0x3FFFFFF, 0x9C24, "20.4.18: MOE, BKE, active low, no filter, OSSR, OSSI, DTG = 36: 0.5 us of 72 MHz"),
    ("TIM2_CR2", TIM2 + 0x04, 0xFF, 0x80, "21.4.2: TI1 is the XOR of three inputs"),
    ("TIM2_ARR", TIM2 + 0x2C, 0xFFFFFFFF, 0xFFFFFFFF, "21.4.12: all of its 32 bits"),
    ("TIM2_CCMR1", TIM2 + 0x18, 0xFF, 0xF1, "21.4.7: IC1 at TI1, eight samples alike of a 32nd of the clock: 3.6 us"),
    ("TIM2_CCER", TIM2 + 0x20, 0xF, 0xB, "21.4.9: both edges"),
    ("TIM2_DIER", TIM2 + 0x0C, 0xFFFF, 0x2, "21.4.4: CC1IE"),
    ("TIM2_CR1", TIM2 + 0x00, 0xFF, 0x1, "21.4.1"),
    ("ADC1_CR", ADC1 + 0x08, 0xFFFFFFFF, 0x10000009, "15.5.3: ADVREGEN = 01, ADEN, JADSTART"),
    ("ADC1_IER", ADC1 + 0x04, 0x7FF, 0x40, "15.5.2: JEOSIE"),
    ("ADC1_SMPR1", ADC1 + 0x14, 0x3FFFFFFF, fields(3, {1: 3, 2: 3, 6: 3, 7: 3}), "15.5.5: channels 1, 2, 6, 7 for 7.5 clocks"),
    ("ADC1_JSQR", ADC1 + 0x4C, 0x7FFFFFFF, 3 | 8 << 2 | 1 << 6 | 1 << 8 | 7 << 14 | 6 << 20 | 2 << 26,
     "15.5.12: four, at the rising edge of TIM1_TRGO2, channels 1 7 6 2"),
    ("ADC12_CCR", ADC1 + 0x308, 0x30000, 0x10000, "15.6.2: CKMODE = 01, HCLK itself"),
    ("IWDG_RLR", IWDG + 0x08, 0xFFF, 400, "25.4.3"),
    ("NVIC_ISER0", 0xE000E100, 0xFFFFFFFF, 1 << 18 | 1 << 24 | 1 << 27 | 1 << 28, "14.1: ADC1_2, TIM1_BRK, TIM1_CC and TIM2"),
    ("NVIC_ISER1", 0xE000E104, 0xFFFFFFFF, 1 << 6, "14.1: USART2, 38"),
    ("NVIC_IPR18", 0xE000E412, 0xFF, 0x40, "ADC1_2: the same priority as"),
    ("NVIC_IPR28", 0xE000E41C, 0xFF, 0x40, "TIM2"),
    ("NVIC_IPR24", 0xE000E418, 0xFF, 0x00, "TIM1_BRK before both"),
    ("NVIC_IPR27", 0xE000E41B, 0xFF, 0x00, "TIM1_CC before both"),
    ("NVIC_IPR38", 0xE000E426, 0xFF, 0x80, "USART2 behind both"),
    ("DBGMCU_APB1_FZ", 0xE0042008, 0x1001, 0x1001, "the watchdog and TIM2, the log's clock, stop with the core"),
    ("DBGMCU_APB2_FZ", 0xE004200C, 0x1, 0x1, "so does TIM1"),
]
RESET = {RCC: 0x83, RCC + 0x14: 0x14, GPIOA: 0xA8000000, GPIOA + 0x0C: 0x64000000, GPIOB: 0x280, GPIOB + 0x0C: 0x100}


class Chip:
    """Unicorn's core, and registers that remember."""

    def __init__(self, folder):
        self.core = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS)
        self.core.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
        self.words, self.written, self.sent, self.typed, self.line_status = dict(RESET), [], "", [], 0
        self.passing = False
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
        """As the core does it, without its stacking: what was going on goes on behind it. The registers that were written to."""
        before = self.core.context_save()
        handler = struct.unpack("<I", self.core.mem_read(FLASH + 4 * (16 + position), 4))[0]
        self.written = []
        self.core.reg_write(arm.UC_ARM_REG_LR, NOWHERE | 1)
        self.run(handler & ~1, 100_000)
        ended = self.core.reg_read(arm.UC_ARM_REG_PC) & ~1 == NOWHERE
        self.core.context_restore(before)
        return ended

    def type(self, text):
        """As a line-buffered terminal does: all of it, before the main loop looks."""
        for character in text:
            self.typed.append(character)
            self.interrupt(38)

    def hall(self, code):
        self.words[GPIOA + 0x10] = (code >> 2 & 1) << 15
        self.words[GPIOB + 0x10] = (code >> 1 & 1) << 3 | (code & 1) << 10

    def outputs(self):
        """Leg by leg: the reference's mode, and whether upper and lower output run."""
        modes = self.words[CCMR1] | self.words[CCMR2] << 16
        return [(modes >> (8 * leg + 4) & 7, self.words[CCER] >> 4 * leg & 1, self.words[CCER] >> (4 * leg + 2) & 1) for leg in range(3)]


def built(board, folder):
    build.told([build.REPOSITORY / "tools/firmware_image.sh", board, build.REPOSITORY / EXAMPLES[board] / "drive_config.hpp", folder])
    return [f"{board}: no image.{kind}" for kind in ("elf", "hex", "bin") if not (folder / f"image.{kind}").stat().st_size]


EXAMPLES = {"stm32f303": "faces/firmware/example/cortex_m", "atmega2560": "faces/firmware/example/avr"}
HEADINGS = "t [us],speed [rad/s],speed_ref [rad/s],i_m [mA],duty,bus [V],hall,activity,faults,missed"


def check_set_up(chip):
    chip.reset()
    trouble = [f"{name} at {at:#010x}: {chip.words.get(at, 0) & mask:#010x}, where {value & mask:#010x} belongs ({section})"
               for name, at, mask, value, section in TABLE if (chip.words.get(at, 0) ^ value) & mask]
    if chip.sent.splitlines() != ["# sixstep on an STM32F303", HEADINGS]:
        trouble.append(f"it said {chip.sent!r}")
    return trouble


AT_REST = (2048, 2048, 2048, round(24 / 52.8 * 4096))


def tick(chip, counts=AT_REST, clocks=2160):
    """A period: the control interrupt, and at its end that of the fourth compare unit, where it is asked for."""
    for n, count in enumerate(counts):
        chip.words[ADC1 + 0x80 + 4 * n] = count
    chip.words[TIM2 + 0x24] = chip.words.get(TIM2 + 0x24, 0) + clocks & 0xFFFFFFFF
    chip.words[ADC1] = 0x41
    ended = chip.interrupt(18)
    return ended and end_of_period(chip)


def end_of_period(chip):
    if not chip.words.get(TIM1 + 0x0C, 0) & 1 << 4:
        return True
    chip.passing = True  # the counter it waits for goes on
    ended = chip.interrupt(27)
    chip.passing = False
    return ended


def all_off(chip):
    return all(mode == 4 and (upper, lower) in ((1, 0), (0, 1)) for mode, upper, lower in chip.outputs())


def check_running(chip):
    """Offsets first, all gates off; then r: the bootstraps' charge, a setpoint, and the pair that the Hall code wants; the next one by
    the Hall interrupt."""
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
        for _ in range(40):  # of 30 us in a sector: 109 rad/s
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
    """The watchdog is fed by the main loop, as long as control interrupts come; an interrupt that nobody serves turns the gates off."""
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
    import image_faults  # they are made of this file
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
        wrong = image_faults.check(folder / "arm")
        print(f"what stops its drive, with the reason that it tells: {'all as it should be' if not wrong else 'trouble'}")
        changes, broken = transitions.check(folder / "arm", whole)
        broken += transitions.check_drives(folder)
        print(f"{changes} changes of its legs, clock by clock: {'never both switches of a leg' if not broken else 'trouble'}")
    trouble += wrong + broken
    print("\n".join(trouble), end="\n" if trouble else "")
    return not trouble


def check_all():
    return check(True)
