# SPDX-License-Identifier: Apache-2.0
"""`sixstep run --on`: drives on emulated cores. Each answer has the same bits as the host's, and the run has the same
digest. The module also prints the calls per second, and tests that a killed program leaves no process and no file."""
import functools
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time

import avr
import build
from build import Failed

CORES = ("cortex-m0", "cortex-m4", "riscv")
SCALARS = ("q15", "float")
CHAPTERS = build.REPOSITORY / "data" / "scenarios" / "thesis"
USUAL = (*(CHAPTERS / f"{name}-exact-design.toml" for name in ("7.3.1-turning", "7.4-speed", "7.5-position")), build.scenario("product"),
         build.REPOSITORY / "data/scenarios/gallery/gear.toml")  # gear.toml needs the general kernel
# The angle is from an encoder, an ideal sensor (field weakening and finite set), flux or pulses. With flux or pulses the drive
# has no rotor sensor.
FIELD = (build.scenario("field"), *(build.REPOSITORY / f"data/scenarios/gallery/{name}.toml"
                                   for name in ("field-weakened", "finite-set", "field-observer", "field-injection")))

# These drives start with pulses, use comparators at the terminals, have Hall probes with a line that breaks, or use an observer.
SENSORLESS = [(build.REPOSITORY / f"data/scenarios/gallery/sensorless-{name}.toml", scalar, core) for name, scalar, core in
              (("pulses", "float", "cortex-m4"), ("comparators", "q15", "cortex-m0"), ("fallback", "q31", "riscv"), ("luenberger", "q15", "riscv"))]


def command(file, scalar, core=None):
    return [str(build.PROGRAM), "run", str(file), "--set", f"control.arithmetic={scalar}", "--quiet", "--json", "-",
            *(["--on", core] if core else [])]


def summary(file, scalar, core=None):
    """The summary of a run, and its exit code. Other tests check the requirements of the drive and its faults."""
    done = subprocess.run(command(file, scalar, core), capture_output=True, text=True, timeout=600, check=False)
    if not done.stdout:
        raise Failed(f"{file.stem} in {scalar} on {core or 'the host'}: exit {done.returncode}\n{done.stderr[-600:]}")
    return json.loads(done.stdout) | {"exit": done.returncode}


@functools.cache
def of_host(file, scalar):
    return summary(file, scalar)


def beside_the_host(case):
    """The error of a run on a core in words or None, and the number of its calls."""
    file, scalar, core = case
    alone, beside = of_host(file, scalar), summary(file, scalar, core)
    where = f"{file.stem} in {scalar} on {core}"
    for what in ("digest", "exit", "fault"):
        if beside[what] != alone[what]:
            return f"{where}: {what} {beside[what]}, the host's is {alone[what]}", 0
    calls = beside["core"]["calls"]
    wanted = alone["events"].get("control ticks", 0)
    return (None if calls >= wanted > 0 else f"{where}: {calls} calls for {wanted} control ticks"), calls


def check_bits(files):
    cases = [(file, scalar, core) for file in files for scalar in SCALARS for core in CORES]
    cases += [(file, "float", core) for file in FIELD for core in CORES]  # these drives have only floating-point numbers
    cases += SENSORLESS
    answers = build.side_by_side(beside_the_host, cases)
    trouble = [str(a) if isinstance(a, Failed) else a[0] for a in answers if isinstance(a, Failed) or a[0]]
    calls = sum(a[1] for a in answers if not isinstance(a, Failed))
    print(f"{len(cases) - len(trouble)} of {len(cases)} runs on cores give the host's digest, {calls} calls each to the bit")
    return trouble


def left_behind(folder):
    """The remaining files, and the processes with the folder in their arguments: compilers, emulators and the process
    that cleans up."""
    left = [file.name for file in pathlib.Path(folder).iterdir()]
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = os.fsdecode((process / "cmdline").read_bytes()).split("\0")
        except OSError:  # the process has just ended
            continue
        if any(folder in word for word in words):
            left.append(f"{process.name} {words[0]}")
    return left


def check_kills(times, seed):
    """The program is killed at any instant: while it compiles, starts or runs. No process and no file remains."""
    drawn, file = random.Random(seed), build.scenario("product")
    with tempfile.TemporaryDirectory() as folder:
        for kill in range(times):
            core = drawn.choice((*CORES, "avr"))
            on = avr.CHAPTER / "8c.toml" if core == "avr" else file
            program = subprocess.Popen(command(on, "q15", core), env={**os.environ, "TMPDIR": folder},
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            after_s = drawn.uniform(0.0, 4.0)
            time.sleep(after_s)
            program.send_signal(drawn.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGINT)))
            program.wait(timeout=60)
            until = time.monotonic() + 30
            while left_behind(folder) and time.monotonic() < until:
                time.sleep(0.05)
            if left := left_behind(folder):
                return [f"kill {kill} (seed {seed}) after {after_s:.3f} s on {core} left {', '.join(left)}"]
    print(f"{times} kills at random instants left no process and no file (seed {seed})")
    return []


BAD = {  # the core program's action in its hundredth call, and the message
    "hangs": ("for (;;) {}", "did not answer in time"),
    "writes where no memory is": ("*reinterpret_cast<volatile unsigned*>(0x90000000) = 1;", "the core ended"),
    "jumps into nowhere": ("reinterpret_cast<void (*)()>(0x90000001)();", "the core ended"),
    "ends": ("exit_with(0);", "the core ended"),
    "answers otherwise": ("reinterpret_cast<unsigned char&>(answer) ^= 1;", "the core's answer differs from the host's"),
}
CALL = "answer = rig::answer_of(made(call));"


def bad_sources(folder, what):
    """Copies the sources of a core's program and adds a fault."""
    for part in ("sixstep/control", "faces/firmware/bare", "faces/loop/core"):
        shutil.copytree(build.REPOSITORY / part, folder / part)
    (folder / "sixstep/rig").mkdir()
    for name in ("core_call.hpp", "sensorless_call.hpp"):
        shutil.copy(build.REPOSITORY / "sixstep/rig" / name, folder / "sixstep/rig")
    program = folder / "faces/loop/core/main.cpp"
    text = program.read_text(encoding="utf-8")
    assert CALL in text
    program.write_text(text.replace(CALL, f"{CALL} static int calls = 0; if (++calls == 100) {{ {what} }}"), encoding="utf-8")


def badly(case):
    """The error in the way a faulty program ends."""
    file, scalar, core, (name, (what, said)) = case
    with tempfile.TemporaryDirectory() as folder:
        bad_sources(pathlib.Path(folder), what)
        begin = time.monotonic()
        done = subprocess.run(command(file, scalar, core), capture_output=True, text=True, timeout=120, check=False,
                              env={**os.environ, "SIXSTEP_SOURCES": folder})
        took_s = time.monotonic() - begin
    fault = json.loads(done.stdout or "{}").get("fault") or done.stderr
    if done.returncode == 3 and said in fault and took_s < 30:
        return None
    return f"a program for {file.stem} that {name} on {core}: exit {done.returncode} after {took_s:.1f} s, {fault[-300:]}"


def check_bad(on):
    cases = [(USUAL[0], "q15", core, bad) for core in on for bad in BAD.items()]
    otherwise = ("answers otherwise", BAD["answers otherwise"])
    cases += [(file, "float", "cortex-m4", otherwise) for file in (build.scenario("product"), FIELD[0], FIELD[-1], SENSORLESS[0][0])]
    trouble = [str(answer) for answer in build.side_by_side(badly, cases) if answer]
    print(f"{len(cases) - len(trouble)} of {len(cases)} bad programs are told as such")
    return trouble


def tell_pace():
    """Prints the calls per second. There is no limit, because the machine may be busy."""
    for core in CORES:
        begin = time.monotonic()
        calls = summary(build.scenario("product"), "q15", core)["core"]["calls"]
        print(f"{core}: {calls / (time.monotonic() - begin):.0f} calls a second, compiling and starting included")


def check(files=USUAL, bad_on=("cortex-m4",), kills=10, seed=1):
    trouble = check_bits(files) + check_bad(bad_on) + check_kills(kills, seed)
    print("\n".join(trouble), end="\n" if trouble else "")
    return not trouble


def check_all():
    tell_pace()
    return check([*sorted(CHAPTERS.glob("7.[345]*.toml")), build.scenario("product")], CORES, kills=100, seed=random.randrange(10**6))
