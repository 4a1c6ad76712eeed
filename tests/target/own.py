# SPDX-License-Identifier: Apache-2.0
"""The cost of a user's controller on the cores. Its source is compiled in float. The program runs with this
controller, and every call is recorded (own/recorder.cpp). Each core receives the same calls and must give the same
bits. Its instructions or cycles are counted."""
import json
import os
import re
import subprocess

import build
import cores
import cost
from build import Failed

HERE = cores.HERE / "own"
IN_FLOAT = ("-DSIXSTEP_REAL=float", "-ffp-contract=off")
CPP = (".cpp", ".cc", ".cxx")
# These flags belong to the core, or determine the flashed code. -fbuiltin: even a chip without an operating system has sqrtf.
ENTRIES = ("-ffunction-sections", "-fdata-sections", "-fbuiltin", "-Wdouble-promotion")
DOUBLE = re.compile(r"^__aeabi_(c?d\w+|\w+2d)$|df\d?$|^__(extendsfdf2|truncdfsf2)$|df[sd]i$")


class Controller:
    """A controller: its source, its compiler flags and a folder for its files."""

    def __init__(self, source, folder, flags=()):
        self.source, self.folder, self.flags = source.resolve(), folder, tuple(flags)
        if not source.is_file():
            raise Failed(f"{source} is no file: name the source of a controller, in C or C++ ({', '.join(CPP)})")
        self.is_cpp = source.suffix in CPP

    def compile(self, compiler, file, out, *flags):
        """Compiles `file` in the controller's language. Returns the compiler's warnings."""
        if not self.is_cpp:
            compiler = compiler.replace("clang++", "clang").replace("g++", "gcc")
        language = ("-x", "c++", "-std=c++20") if self.is_cpp else ("-x", "c")
        command = [compiler, *flags, *IN_FLOAT, f"-I{cores.REPOSITORY}", f"-I{self.source.parent}", *self.flags,
                   f'-DOWN_SOURCE="{self.source}"', *language, "-c", file, "-o", out]
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failed(done.stderr.strip())
        return done.stderr


def recorder(controller):
    """Builds the shared object that replaces the controller in a run and records its calls."""
    own, out = controller.folder / "in_float.o", controller.folder / "recorder.so"
    controller.compile("g++", controller.source, own, "-O2", "-fPIC", "-Dsixstep_own_controller=own_controller_in_float")
    if "own_controller_in_float" not in build.told(["nm", own]):
        raise Failed(f"{controller.source} has no function sixstep_own_controller: sixstep/control/own/own_controller.h says what it answers")
    build.told(["g++", "-std=c++20", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC",
                f"-I{cores.REPOSITORY}", HERE / "recorder.cpp", own, "-lm", "-o", out])
    return out


def record(controller, program, words):
    """Runs the program and so writes the tape. The run may miss a requirement."""
    if not os.access(program, os.X_OK):
        raise Failed(f"{program} is not built: ./run --version builds it")
    command = [str(w) for w in (program, *words)]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env=os.environ | {"SIXSTEP_OWN_TAPE": str(controller.folder / "own.tape")})
    if done.returncode not in (0, 1):
        raise Failed((done.stderr or done.stdout).strip())


def record_scenario(controller, program, scenario):
    record(controller, program, ["run", scenario, "--quiet", "--set", "control.drive=own", "--set",
                                 f'control.own.controller="{recorder(controller)}"'])


def record_course(controller, program, motor):
    """Records the course of the comparison or its slow run. A tape has only one run."""
    course = controller.folder / "course.json"
    record(controller, program, ["compare", motor, "--own", recorder(controller), "--runs", "0", "--jobs", "1", "--quiet", "--json", course])
    told = json.loads(course.read_text(encoding="utf-8"))
    name = told["controllers"][-1]["name"]
    refused = [note for note in told["notes"] if note.startswith((f"{name} is left out", f"{name} stopped"))]
    if refused:
        raise Failed(f"{refused[0]}; or name a scenario that this controller can run")


def compiled(core, controller):
    """Compiles the controller for a core. Returns the folder, the object and the compiler's warnings."""
    folder = controller.folder / build.file_name(core.name)
    folder.mkdir()
    entries = folder / "entries.o"
    bare = cores.BARE if controller.is_cpp else [flag for flag in cores.BARE if flag != "-nostdinc++"]
    # The compiler for the AVR's firmware compiles C, but not C++20.
    command = core.link if core.link and not controller.is_cpp else (*core.compile, *core.for_entries)
    said = controller.compile(command[0], HERE / "entries.c", entries, "-O2", *command[1:], *bare, *ENTRIES)
    return folder, entries, said


def object_of(core, folder, source, *defines):
    out = folder / f"{source.stem}.o"
    build.told([*core.flags(), *IN_FLOAT, *defines, "-c", source, "-o", out])
    return out


def libraries(core, folder):
    """The option for libm, if the toolchain has it."""
    linker = (core.link or core.compile)[0]
    has = build.told([linker, *(core.link or core.compile)[1:], "-print-file-name=libm.a"], cwd=folder).strip()
    return ["-lm"] if os.path.isabs(has) else []


def counted(core, controller, folder, entries):
    """The output of the program, with a line `cost ENTRY CALLS MEAN WITHIN WORST` for each entry."""
    marked = core.unit == "instructions"
    platform = [cores.HERE / "platform" / p for p in core.platform]
    sources = [HERE / "main.cpp", *platform, *([cores.HERE / "cost" / "calls.S"] if marked else [])]
    objects = [object_of(core, folder, s, *(["-DTARGET_CALLS_ARE_MARKED"] if marked else [])) for s in sources]
    file = folder / "own.elf"
    build.told([*(core.link or core.compile), entries, *objects, "-o", file, *libraries(core, folder), *core.libraries])
    at = cost.addresses(core, file)
    tape = controller.folder / "own.tape"
    if not marked:
        return build.run(core, file, tape, at["refill_request"], at["entry_tick"], at["entry_hall"])
    told = folder / "own.counts"
    plugin = f"{cost.PLUGIN},told={told},tick={at['entry_tick']}-{at['after_tick']},hall={at['entry_hall']}-{at['after_hall']}"
    return build.told([*core.run, "-plugin", plugin, "-kernel", file], cwd=controller.folder) + told.read_text()


def size(core, folder, entries, bytes_of):
    """(flash, RAM, whether the compiler's functions for double are included), as in sizes.py: without start code, and
    with the config in flash."""
    defines = [f"-DOWN_CONFIG_BYTES={bytes_of[0]}", f"-DOWN_STATE_BYTES={bytes_of[1]}"]
    room = object_of(core, folder, HERE / "room.cpp", *defines)
    memory = [] if core.link else [object_of(core, folder, cores.BARE_METAL / "memory.cpp")]
    file = folder / "size.elf"
    build.told([*(core.link or core.compile), "-nostartfiles", *([] if core.link else ["-nostdlib"]), "-Wl,--gc-sections",
                "-Wl,-e,entry_tick", "-Wl,-u,entry_hall", entries, room, *memory, *libraries(core, folder), "-lgcc", "-o", file])
    text, data, bss = map(int, build.told([core.size, file]).splitlines()[1].split()[:3])
    return text + data, data + bss, any(map(DOUBLE.search, cost.addresses(core, file)))


def said_of_double(said):
    """The text after a remark: the place where the compiler found a double."""
    said = "\n".join(line for line in said.splitlines() if not line.startswith("In file included"))
    return f": a literal such as 0.5 is a double; write (sixstep_real)0.5\n{said}" if "[-Wdouble-promotion]" in said else ""


def answered(core, text, said):
    """(name, sizes of config and state in bytes). Raises Failed if an answer differs from the host's."""
    if wrong := re.search(r"^(differs|room|design) (.*)$", text, re.M):
        words = {"differs": "its answer to call {} of the run differs from the answer in float on this machine",
                 "room": "config or state is larger than the reserved {} bytes",
                 "design": "its design fails on this core, and not on this machine: {}"}
        raise Failed(f"{core.name}: {words[wrong[1]].format(wrong[2])}{said_of_double(said)}")
    own = re.search(r"^own (\d+) (\d+) (.*)$", text, re.M)
    passes = 2 if core.unit == "cycles" else 1  # the controller runs twice: called as functions, and called by interrupts
    if not own or len(re.findall(r"^answers [1-9]\d*$", text, re.M)) != passes:
        raise Failed(f"{core.name}: the program of the controller ended early")
    return own[3], (int(own[1]), int(own[2]))


def measured(core, controller):
    """The row of a core, as in the JSON."""
    folder, entries, said = compiled(core, controller)
    text = counted(core, controller, folder, entries)
    name, bytes_of = answered(core, text, said)
    flash, ram, double = size(core, folder, entries, bytes_of)
    row = {"core": core.name, "unit": core.unit, "flash_bytes": flash, "ram_bytes": ram}
    for entry, *numbers in re.findall(r"^cost (tick|hall) (\d+) (\d+) (\d+) (\d+)$", text, re.M):
        row[entry] = dict(zip(("calls", "mean", "within", "worst"), map(int, numbers)))
    return name, row, double, said


def measure(controller, chosen):
    """(name, rows, remarks) for the chosen cores."""
    if not cost.PLUGIN.exists() or cost.PLUGIN.stat().st_mtime < (cores.HERE / "cost" / "count_instructions.cpp").stat().st_mtime:
        cost.build_plugin()
    if any(not core.unit == "instructions" for core in chosen) and not (cores.OUT / "avr_board").exists():
        build.build_board()
    answers = build.side_by_side(lambda core: measured(core, controller), chosen)
    for answer in answers:
        if isinstance(answer, Failed):
            raise answer
    in_double = [row["core"] for _, row, double, _ in answers if double]
    remarks = f"computes in double on {', '.join(in_double)}{said_of_double(answers[0][3])}" if in_double else ""
    return answers[0][0], [row for _, row, _, _ in answers], remarks
