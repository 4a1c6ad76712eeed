# SPDX-License-Identifier: Apache-2.0
"""An upper limit of the clocks that the STM32F303's Cortex-M4 needs at 72 MHz for the instructions that Unicorn
executes. Unicorn itself counts no clocks. There are three parts:

  core   Arm's technical reference manual (100166_0001, 3.3 and 7.2), with the longest time of each instruction: a taken
         branch refills the pipeline in 3, a division takes 12 (integer) or 14 (float), and the next instruction waits for
         a result of the floating-point unit
  flash  RM0316, 4.2.2: above 48 MHz a read of 64 bits from the flash waits two clocks. This sum assumes that each new line
         waits both clocks, as if the prefetch buffer had no effect. A taken branch also waits for an unnecessary line. Each
         read of data from the flash waits, and the next line waits once more
  parts  the bridges to timers, ports and converter: two clocks, or four if the bus has half the clock (APB1)

The true number is between the first part and the sum of all parts. Only a board can show it."""
import re

import images

REFILL, WAIT = 3, 2
# Clocks of the entry of an interrupt with stacking, and of its return, without wait states of the memory (100166_0001, 3.9.1).
ENTRY, RETURN = 12, 10
# Additional clocks of an entry that reserves stack for the floating-point registers. The registers are stored when the
# first of them is used.
LAZY = 17
LONG = {"sdiv": 12, "udiv": 12, "vdiv": 14, "vsqrt": 14, "vmla": 3, "vmls": 3, "vnmla": 3, "vnmls": 3, "vfma": 3, "mla": 2, "mls": 2,
        "ldrd": 3, "strd": 3, "vldr": 2, "vstr": 2, "isb": 4, "dsb": 4, "mrs": 2, "msr": 2, "cpsid": 2, "cpsie": 2, "vmrs": 2, "vmov": 2}
BUSES = ((0x40000000, 0x40010000, 4), (0x40010000, 0x48000000, 2), (0x48000000, 0x60000000, 2), (0xE0000000, 0x100000000, 2))


def registers_of(operands):
    """The number of registers in a list in braces."""
    count = 0
    for part in re.search(r"\{(.*?)\}", operands)[1].split(","):
        ends = [int(n) for n in re.findall(r"[rs](\d+)", part)]
        count += ends[1] - ends[0] + 1 if len(ends) == 2 else 1
    return count


def clocks_of(mnemonic, operands):
    """The clocks of an instruction, without the additional clocks of a taken branch."""
    name = mnemonic.split(".")[0]
    if name.startswith(("push", "pop", "ldm", "stm", "vpush", "vpop", "vldm", "vstm")):
        return 1 + registers_of(operands)
    for stem, clocks in LONG.items():
        if name.startswith(stem):
            return clocks
    if name.startswith(("ldr", "str", "tbb", "tbh", "v")):
        return 2
    return 1


def table(elf):
    """{address: (size, clocks)} of each instruction."""
    found = {}
    for line in images.build.told(["arm-none-eabi-objdump", "-d", elf]).splitlines():
        if of := re.match(r"\s*([0-9a-f]+):\t((?:[0-9a-f]{4} ?)+)\s*\t(\S+)\s*(.*)", line):
            found[int(of[1], 16)] = (2 * len(of[2].split()), clocks_of(of[3], of[4]))
    return found


class Clocks:
    """Counts the clocks of a chip's core since reset()."""

    def __init__(self, chip, elf):
        self.table = table(elf)
        self.reset()
        chip.core.hook_add(images.unicorn.UC_HOOK_CODE, self.instruction)
        chip.core.hook_add(images.unicorn.UC_HOOK_MEM_READ | images.unicorn.UC_HOOK_MEM_WRITE, self.access)

    def reset(self):
        self.instructions = self.core = self.flash = self.parts = 0
        self.next, self.line = None, None

    def instruction(self, _, at, size, __):
        self.instructions += 1
        taken = self.next not in (None, at)
        self.core += self.table[at][1] + (REFILL if taken else 0)
        lines = {at >> 3, at + size - 1 >> 3}
        self.flash += WAIT * (len(lines - {self.line}) + taken)
        self.next, self.line = at + size, at + size - 1 >> 3

    def access(self, _, __, at, size, *___):
        if images.FLASH <= at < images.FLASH + 256 * 1024:
            self.flash += 2 * WAIT
        self.parts += next((clocks for begin, end, clocks in BUSES if begin <= at < end), 0)

    def at_least(self):
        return self.core + ENTRY + RETURN

    def at_most(self):
        """The upper limit, with the read of the interrupt vector, the return of the stacked registers, and the
        stacking of the floating-point registers."""
        return self.core + self.flash + self.parts + ENTRY + RETURN + 2 * LAZY + 2 * WAIT
