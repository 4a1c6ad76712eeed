# SPDX-License-Identifier: Apache-2.0
"""The list of processors, with the compiler and the emulator of each. Only this module has these data."""
import dataclasses
import os
import pathlib
import shutil

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
HERE = REPOSITORY / "tests" / "target"
BARE_METAL = REPOSITORY / "faces" / "firmware" / "bare"
OUT = REPOSITORY / "build" / "target"
TABLES = REPOSITORY / "data" / "cores"  # the counts, which the program, the pages and the checks read there

# The flags of every core. Only -ffp-contract=off changes bits; the others check the code's rules.
COMMON = ["-std=c++20", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
          "-Wno-sign-conversion", "-Werror", "-ffp-contract=off", "-O2", f"-I{REPOSITORY}"]
# <cstdint> is the shim of faces/firmware/bare: no chip's C++ library is needed. Nothing throws, so that unwind tables
# are not needed.
BARE = ["-ffreestanding", "-nostdinc++", "-fno-unwind-tables", "-fno-asynchronous-unwind-tables", f"-I{REPOSITORY}/faces/firmware/bare"]
# A flashed drive has a constexpr configuration: the compiler folds it into inlined code. g++ does so at -O3.
INLINED = ("-O3",)
SEMIHOSTING = ["-nographic", "-monitor", "none", "-serial", "none", "-chardev", "stdio,id=told", "-semihosting-config",
               "enable=on,target=native,chardev=told"]


@dataclasses.dataclass(frozen=True)
class Core:
    name: str
    compile: tuple              # compiler with its flags, without the common ones
    run: tuple                  # the words before the program
    platform: tuple             # files below platform/, or where they are
    link: tuple = ()            # linker with its flags where it is not the compiler
    libraries: tuple = ()
    for_walk: tuple = ()        # more flags, for the walk of all blocks
    for_part: dict = dataclasses.field(default_factory=dict, hash=False)  # flags instead of for_walk, for a part of the walk
    for_entries: tuple = ()     # more flags, for the entries of one drive as flashed
    scalars: tuple = ("q15", "q14", "q31", "q30", "float")
    unit: str = ""              # unit of the counts
    costs: tuple = ()           # scalars whose cost is measured
    nm: str = "nm"
    size: str = "size"

    @property
    def is_host(self):
        return "host.cpp" in self.platform

    def flags_of_walk(self, part):
        return self.for_part.get(part, self.for_walk)

    def flags(self):
        return [*self.compile, *COMMON, *([] if self.is_host else BARE)]

    def missing(self):
        """A program that this machine lacks, or None."""
        return next((p for p in (self.compile[0], *self.link[:1], *self.run[:1]) if not shutil.which(p) and not os.path.exists(p)), None)


def host(name, *compile_, run=(), static=True):
    return Core(name, compile_, tuple(run), ("host.cpp",), libraries=("-static",) if static else ())


def bare_platform(kind):
    return ("bare.cpp", *(BARE_METAL / file for file in ("start.cpp", "memory.cpp", f"{kind}.S")))


def cortex(name, cpu, board, *more, costs):
    return Core(name, ("arm-none-eabi-g++", f"-mcpu={cpu}", "-mthumb", "-Wno-psabi", *more),
                ("qemu-system-arm", "-M", board, *SEMIHOSTING), bare_platform("cortex_m"),
                libraries=("-nostdlib", "-T", str(BARE_METAL / "cortex_m.ld"), "-lgcc"), for_entries=INLINED,
                unit="instructions", costs=costs,
                nm="arm-none-eabi-nm", size="arm-none-eabi-size")


HOSTS = (
    host("x86-64 g++", "g++", static=False),
    host("x86-64 clang++", "clang++-19", static=False),
    host("armhf g++", "arm-linux-gnueabihf-g++", "-Wno-psabi", run=["qemu-arm-static"]),
    host("aarch64 g++", "aarch64-linux-gnu-g++", run=["qemu-aarch64-static"]),
    host("s390x g++", "s390x-linux-gnu-g++", run=["qemu-s390x-static"]),
)
CHIPS = (
    cortex("Cortex-M0", "cortex-m0", "microbit", costs=("q15",)),
    cortex("Cortex-M3", "cortex-m3", "mps2-an385", costs=("q15", "q31")),
    cortex("Cortex-M4F", "cortex-m4", "mps2-an386", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard", costs=("float", "q15", "q31")),
    Core("RV32IMC", ("riscv64-unknown-elf-g++", "-march=rv32imc", "-mabi=ilp32"),
         ("qemu-system-riscv32", "-M", "virt", "-bios", "none", *SEMIHOSTING), bare_platform("riscv"),
         libraries=("-nostdlib", "-T", str(BARE_METAL / "riscv.ld"), "-Wl,--no-warn-rwx-segments", "-lgcc"), for_entries=INLINED,
         unit="instructions", costs=("q15",), nm="riscv64-unknown-elf-nm", size="riscv64-unknown-elf-size"),
    # clang 14 to 16 miscompile for the AVR: proof.py. Only inlined code uses a constexpr configuration: at 5000 the product
    # drive is five times as large and more than twice as slow as at 100000, but all blocks together would not fit at 100000.
    # Without full inlining clang 19 miscompiles 32-bit formats too (it passes their structs wrongly, programs crash): there is
    # no walk of q31 and q30. A fully inlined drive, as the entries are, has the host's bits.
    Core("ATmega2560", ("clang++-19", "--target=avr", "-mmcu=atmega2560", "-DSIXSTEP_ANY_COMPILER"),
         (str(OUT / "avr_board"),), ("avr.cpp",), link=("avr-gcc", "-mmcu=atmega2560"),
         for_walk=("-mllvm", "-inline-threshold=5000"),
         # At 5000 commissioning's phases become one function that is too long for clang 19's branches; pulse_start is a
         # part of its own.
         # Without full inlining clang 19 passes the extras of float drives' loops wrongly: wrong bits, or a crash.
         for_part={part: ("-mllvm", "-inline-threshold=20000") for part in ("", "rotor", "pulses")} |
                  {"commissioning": ("-mllvm", "-inline-threshold=2000")},
         for_entries=("-mllvm", "-inline-threshold=100000"),
         scalars=("q15", "q14", "float"), unit="cycles", costs=("q15", "q31", "float"),
         nm="avr-nm", size="avr-size"),
)

# The usual checks compare the bits of the two chips with an image to flash, and of one host for a quick message where all differ. The long
# checks add the emulated hosts, another compiler, the M0, the M3 and RV32.
USUAL = tuple(core.name for core in (*HOSTS[:1], *CHIPS) if core.name in (HOSTS[0].name, "Cortex-M4F", "ATmega2560"))
BY_NAME = {core.name: core for core in (*HOSTS, *CHIPS)}
