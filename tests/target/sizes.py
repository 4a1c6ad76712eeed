# SPDX-License-Identifier: Apache-2.0
"""Flash and RAM of both entries of a drive, and their undefined functions. They are compared with
data/cores/sizes.txt, and with the table in docs/reference/blocks.md, section "Which functions the linker needs"."""
import fnmatch
import re

import build
import cores
import cost
from build import Failed

TABLE = cores.TABLES / "sizes.txt"
PAGE = cores.REPOSITORY / "docs" / "reference" / "blocks.md"
HEAD = """# SPDX-License-Identifier: Apache-2.0
# core, drive, scalar, bytes of flash, bytes of RAM without the stack: both entries with state, telemetry and answer, and what
# they need of the compiler's library; no start code. Written by tools/check_target.sh --renew
"""
# Cores that have another name on the page. An M3 needs the same functions as an M4.
ON_THE_PAGE = {"Cortex-M3": "Cortex-M4", "Cortex-M4F": "Cortex-M4"}


def listed():
    """[(patterns of names, cores that may need them)] of the page. None: all cores."""
    section = PAGE.read_text(encoding="utf-8").partition("## Which functions the linker needs")[2].partition("\n## ")[0]
    rows = [line.split("|")[1:4] for line in section.splitlines() if re.match(r"\| .*`", line)]
    return [(re.findall(r"`([^`]+)`", names), None if where.strip() == "all" else where) for _, names, where in rows]


def not_listed(core, names):
    page = ON_THE_PAGE.get(core.name, core.name)
    allowed = [pattern for patterns, where in listed() if where is None or page in where for pattern in patterns]
    return sorted(n for n in names if not any(fnmatch.fnmatchcase(n, p) for p in allowed))


def undefined(core, file):
    return {line.split()[-1] for line in build.told([core.nm, "-u", file]).splitlines() if line.strip()}


def compiled(core, name, source, scalar, defines):
    folder = cores.OUT / build.file_name(core.name)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}.o"
    build.told([*core.flags(), *defines, f"-DTARGET_SCALAR_{scalar}", f"-I{cores.OUT}/headers/{scalar}", "-c", source, "-o", file])
    return file


def measured(case):
    """(flash, RAM), and the undefined functions of the entries."""
    core, drive, scalar = case
    entries = compiled(core, f"entries-{drive}-{scalar}", cores.HERE / "cost" / "entries.cpp", scalar,
                       (*cost.defines(core, drive), "-DTARGET_NO_INTERRUPTS"))
    memory = [] if core.link else [compiled(core, f"memory-{drive}-{scalar}", cores.BARE_METAL / "memory.cpp", scalar, ())]
    linker = [*(core.link or core.compile)]
    file = entries.with_suffix(".elf")
    # avr-libc has the memory functions. Its start code and vectors are not linked.
    build.told([*linker, "-nostartfiles", *([] if core.link else ["-nostdlib"]), "-Wl,--gc-sections", "-Wl,-e,entry_tick",
                "-Wl,-u,entry_hall", entries, *memory, "-lgcc", "-o", file])
    text, data, bss = map(int, build.told([core.size, file]).splitlines()[1].split()[:3])
    return (text + data, data + bss), undefined(core, entries)


def take():
    rows, trouble, chosen = {}, [], cost.cases()
    for case, answer in zip(chosen, build.side_by_side(measured, chosen)):
        core, drive, scalar = case
        if isinstance(answer, Failed):
            trouble.append(f"{core.name}, {drive} in {scalar}: {answer}")
            continue
        rows[core.name, drive, scalar] = answer[0]
        trouble += [f"{core.name}, {drive} in {scalar}: asks the linker for {name}, which docs/reference/blocks.md does not list"
                    for name in not_listed(core, answer[1])]
    return rows, trouble


def expected():
    lines = TABLE.read_text().splitlines() if TABLE.exists() else []
    return {tuple(w[:3]): tuple(map(int, w[3:])) for w in map(str.split, lines) if w and w[0] != "#"}


def renew():
    rows, trouble = take()
    if trouble:
        raise Failed("\n".join(trouble))
    TABLE.write_text(HEAD + "".join(" ".join([*key, *map(str, row)]) + "\n" for key, row in rows.items()))


def check():
    rows, trouble = take()
    table = expected()
    for key in table | rows:
        if table.get(key) != rows.get(key):
            trouble.append(f"{key[0]}, {key[1]} in {key[2]}: flash and RAM {rows.get(key)}, the table has {table.get(key)}")
    print(f"{len(rows)} sizes: " + (f"{len(trouble)} are not as written" if trouble else "those of the table; the linker is asked for what docs/reference/blocks.md lists"), flush=True)
    for line in trouble:
        print(f"  {line}")
    return not trouble
