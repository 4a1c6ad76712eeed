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
TABLES = REPOSITORY / "data" / "cores"  # the folder of the counts, which the program, the pages and the checks read

# The flags of every core. Only -ffp-contract=off changes bits. The other flags check the rules for the code.
COMMON = ["-std=c++20", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
          "-Wno-sign-conversion", "-Werror", "-ffp-contract=off", "-O2", f"-I{REPOSITORY}"]
# <cstdint> is the file in faces/firmware/bare, so that no C++ library for chips is needed. No function throws, so unwind tables
# are not needed.
BARE = ["-ffreestanding", "-nostdinc++", "-fno-unwind-tables", "-fno-asynchronous-unwind-tables", f"-I{REPOSITORY}/faces/firmware/bare"]
# The configuration of a flashed drive is constexpr, and the compiler evaluates it in inlined code. g++ does so with -O3.
INLINED = ("-O3",)
SEMIHOSTING = ["-nographic", "-monitor", "none", "-serial", "none", "-chardev", "stdio,id=told", "-semihosting-config",
               "enable=on,target=native,chardev=told"]


@dataclasses.dataclass(frozen=True)
class Core:
    name: str
    compile: tuple              # the compiler with its flags, without the common flags
    run: tuple                  # the arguments before the program
    platform: tuple             # files in the folder platform/, or their paths
    link: tuple = ()            # the linker with its flags, if it is not the compiler
    libraries: tuple = ()
    for_walk: tuple = ()        # additional flags for the walk of all blocks
    for_part: dict = dataclasses.field(default_factory=dict, hash=False)  # flags for a part of the walk, in place of for_walk
    for_entries: tuple = ()     # additional flags for the entries of one drive, as it is flashed
    scalars: tuple = ("q15", "q14", "q31", "q30", "float")
    unit: str = ""              # unit of the counts
    costs: tuple = ()           # the scalars with a measured cost
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
    # clang 14 to 16 generate wrong code for the AVR (proof.py). A constexpr configuration has an effect only in inlined code.
    # With a threshold of 5000 the product drive is five times as large and more than twice as slow as with 100000, but with
    # 100000 all blocks together do not fit. Without full inlining clang 19 also generates wrong code for 32-bit formats: it
    # passes their structs wrongly, and programs crash. Therefore q31 and q30 have no walk. The entries are fully inlined, and
    # have the host's bits.
    Core("ATmega2560", ("clang++-19", "--target=avr", "-mmcu=atmega2560", "-DSIXSTEP_ANY_COMPILER"),
         (str(OUT / "avr_board"),), ("avr.cpp",), link=("avr-gcc", "-mmcu=atmega2560"),
         for_walk=("-mllvm", "-inline-threshold=5000"),
         # With 5000 the phases of the commissioning become one function that is too long for the branches of clang 19.
         # pulse_start is a separate part. Without full inlining clang 19 passes the optional features of float loops wrongly, and
         # the bits are wrong or the program crashes.
         for_part={part: ("-mllvm", "-inline-threshold=20000") for part in ("", "rotor", "pulses")} |
                  {"commissioning": ("-mllvm", "-inline-threshold=2000")},
         for_entries=("-mllvm", "-inline-threshold=100000"),
         scalars=("q15", "q14", "float"), unit="cycles", costs=("q15", "q31", "float"),
         nm="avr-nm", size="avr-size"),
)

# The usual checks compare the bits of both chips with an image to flash. They also run one host, which gives a quick message if
# all bits differ. The long checks add the emulated hosts, another compiler, the M0, the M3 and RV32.
USUAL = tuple(core.name for core in (*HOSTS[:1], *CHIPS) if core.name in (HOSTS[0].name, "Cortex-M4F", "ATmega2560"))
BY_NAME = {core.name: core for core in (*HOSTS, *CHIPS)}
