# SPDX-License-Identifier: Apache-2.0
"""The STM32F303's image with time. It connects Unicorn's core to the model of a timer's output stage (tim1.py), and
calls the image's functions by name.

Time passes only when the program reads a counter again, one clock per read. Thus the core is infinitely fast, and
only waiting for a counter takes time. These are the shortest times that the program guarantees, so a dead time that
is one clock too short is detected."""
import struct

import images
from tim1 import Tim1

TIM1, TIM2 = images.TIM1, images.TIM2
SCRATCH = images.RAM + 0x9800
SOFT, HARD, COMPLEMENTARY = range(3)
BY_UPPER, BY_LOWER = range(2)
PERIOD, SAMPLE, DEAD = 2160, 2160 - 72, 36
PAIRS = [(s, k) for s in range(3) for k in range(3) if s != k]
WAYS = [(SOFT, BY_UPPER), (SOFT, BY_LOWER), (HARD, BY_UPPER), (COMPLEMENTARY, BY_UPPER), (COMPLEMENTARY, BY_LOWER)]
OFF = None


class TimedChip(images.Chip):
    """A chip with time and with a timer that generates pulses."""

    def __init__(self, folder, late=False):
        self.tim1 = Tim1(late)
        self.now, self.looked = 0, False
        super().__init__(folder)

    def pass_to(self, t):
        self.now = max(self.now, t)
        self.tim1.advance(self.now)

    def read(self, core, offset, size, begin):
        at = begin + offset
        if at in (TIM1 + 0x24, TIM2 + 0x24):
            self.pass_to(self.now + self.looked)
            self.looked = True
            return self.tim1.counter() if at == TIM1 + 0x24 else self.now & 0xFFFFFFFF
        if at == TIM1 + 0x10:
            return (1 << 4 if self.tim1.match_4 else 0) | self.words.get(at, 0) & ~(1 << 4)
        return super().read(core, offset, size, begin)

    def write(self, core, offset, size, value, begin):
        at = begin + offset
        super().write(core, offset, size, value, begin)
        self.looked = False
        if TIM1 <= at < TIM1 + 0x60:
            self.tim1.advance(self.now)
            self.tim1.write(at - TIM1, value)

    def start(self):
        """Runs the set-up only. The main loop after it would report missing conversions."""
        self.core.reg_write(images.arm.UC_ARM_REG_SP, self.stack)
        at = self.begin
        for _ in range(10_000):
            self.run(at & ~1, 1000)
            at = self.core.reg_read(images.arm.UC_ARM_REG_PC)
            if self.words.get(0xE000E100, 0) & 1 << 27:
                return
        raise images.build.Failed("the set-up enables no interrupt")

    def entry(self, name):
        return next(a for symbol, a in self.symbols.items() if symbol.startswith(f"firmware::{name}("))

    def handler(self, position):
        return struct.unpack("<I", self.core.mem_read(images.FLASH + 4 * (16 + position), 4))[0]

    def interrupt_amid(self, begin, behind, other):
        """Runs a function or an interrupt. After `behind` instructions another interrupt comes, as soon as it is
        enabled. Returns False if the function ended before."""
        before = self.core.context_save()
        self.core.reg_write(images.arm.UC_ARM_REG_LR, images.NOWHERE | 1)
        self.run(begin & ~1, behind)
        while self.core.reg_read(images.arm.UC_ARM_REG_PRIMASK) & 1:
            self.run(self.core.reg_read(images.arm.UC_ARM_REG_PC), 1)
        at = self.core.reg_read(images.arm.UC_ARM_REG_PC)
        amid = at & ~1 != images.NOWHERE
        if amid and self.armed():
            self.tim1.match_4 = True
            self.interrupt(other)
        if amid:
            self.run(at, 100_000)
        self.core.context_restore(before)
        return amid

    def call(self, name, *arguments):
        """Runs a function of the image to its end."""
        at = self.entry(name)
        before = self.core.context_save()
        for register, value in zip((images.arm.UC_ARM_REG_R0, images.arm.UC_ARM_REG_R1, images.arm.UC_ARM_REG_R2), arguments):
            self.core.reg_write(register, value)
        self.core.reg_write(images.arm.UC_ARM_REG_LR, images.NOWHERE | 1)
        self.run(at & ~1, 100_000)
        ended = self.core.reg_read(images.arm.UC_ARM_REG_PC) & ~1 == images.NOWHERE
        self.core.context_restore(before)
        if not ended:
            raise images.build.Failed(f"firmware::{name} did not return")

    def cycle_start(self):
        return self.now - self.tim1.counter()

    def armed(self):
        return bool(self.words.get(TIM1 + 0x0C, 0) & 1 << 4)

    def end_period(self):
        """Advances to the update, with the interrupt of the fourth compare unit before it."""
        update = self.cycle_start() + PERIOD
        if self.tim1.counter() < SAMPLE:
            self.pass_to(update - PERIOD + SAMPLE)
        if self.armed() and not self.interrupt(27):
            raise images.build.Failed("the period's interrupt did not return")
        self.tim1.write(0x10, ~(1 << 4))
        self.pass_to(update)


def command(wanted):
    """The bytes of a BridgeCommand<float>, for (pair, way, duty) or OFF."""
    if wanted is OFF:
        return struct.pack("<BBBxfBBBxfffB3x", 0, 0, 1, 0.0, 0, 0, 0, 0.0, 0.0, 0.0, 0)
    (source, sink), (chopping, chopped), duty = wanted
    return struct.pack("<BBBxfBBBxfffB3x", 1, source, sink, duty, chopping, chopped, 0, 0.0, 0.0, 0.0, 0)


class Bridge:
    """The image's functions by name, and the reaction of the simulation's timer to the same calls."""

    def __init__(self, chip):
        self.chip, self.wanted = chip, OFF
        self.reversed = self.reversed_in_effect = False

    def tick(self, wanted, reversed_=False):
        self.chip.core.mem_write(SCRATCH, command(wanted))
        self.chip.call("at_next_period", SCRATCH, reversed_, 0)

    def hall(self, wanted, reversed_=False):
        self.chip.core.mem_write(SCRATCH, command(wanted))
        self.chip.call("at_once", SCRATCH, reversed_)

    def off(self):
        self.chip.call("gates_off")
