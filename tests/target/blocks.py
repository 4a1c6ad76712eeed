# SPDX-License-Identifier: Apache-2.0
"""The cost of each block on each core with random inputs. It is counted call by call over 10 000 steps of the walk,
and compared with data/cores/blocks.txt. A message names each block that has become more expensive. cost.py counts the
cost of complete drives, with constant configurations and inlined calls."""
import re

import build
import cores
import cost
import walk
from build import Failed

TABLE = cores.TABLES / "blocks.txt"
SLOTS = ("slot0", "slot1", "slot2")
HEAD = """# SPDX-License-Identifier: Apache-2.0
# core, block, scalar, function, calls, and the count per call: mean, 99.9 % quantile, worst; written by
# tools/check_target.sh --renew blocks. ATmega2560: cycles; the others: instructions. Called as functions with configurations
# in memory; without the cost of the call itself.
"""


def cases():
    return [(core, scalar, part) for core in cores.CHIPS for part in walk.PARTS for scalar in (*core.costs, "whole")
            if scalar in (*core.scalars, "whole")]


def counted(core, scalar, part):
    """The output of the program, with a line `cost SLOT CALLS MEAN WITHIN WORST` for each function and the line
    `next` after each block."""
    sources = [cores.HERE / "walk" / "main.cpp", cores.HERE / "platform" / "marks.S"]
    file = build.build(core, "-".join(filter(None, ["blocks", scalar, part])), sources, scalar,
                       (*core.flags_of_walk(part), "-DTARGET_COUNTED", *walk.PARTS[part]))
    at = cost.addresses(core, file)
    begins = [at[f"count_begins_{n}"] for n in range(3)]
    if core.unit == "cycles":
        return build.run(core, file, at["count_next"], at["count_ends"], *begins)
    told = file.with_suffix(".counts")
    marks = ",".join(f"{slot}={begin}-{at['count_ends']}" for slot, begin in zip(SLOTS, begins))
    text = build.told([*core.run, "-plugin", f"{cost.PLUGIN},told={told},{marks},next={at['count_next']}", "-kernel", file])
    return text + told.read_text()


def measured(case):
    """{(core, block, scalar, function): (calls, mean, within, worst)}"""
    core, scalar, part = case
    text = counted(core, scalar, part)
    counts = [dict(re.findall(r"^cost slot(\d) (.*)$", part, re.M)) for part in text.split("next\n")]
    names = re.findall(r"^counted (\S+) (\d) (\S+)$", text, re.M)
    order = re.findall(rf"^(\S+) {scalar} \d+ [0-9a-f]{{8}}$", text, re.M)
    rows = {}
    for block, slot, function in names:
        rows[core.name, block, scalar, function] = tuple(map(int, counts[order.index(block)][slot].split()))
    call = rows.pop((core.name, "nothing", scalar, "nothing"))
    return {key: (row[0], *(n - call[3] for n in row[1:])) for key, row in rows.items()}


def take(of=None):
    rows, trouble = {}, []
    chosen = cases() if of is None else of
    for case, answer in zip(chosen, build.side_by_side(measured, chosen)):
        if isinstance(answer, Failed):
            trouble.append(f"{case[0].name}, blocks in {case[1]} {case[2]}: {answer}")
        else:
            rows |= answer
    return rows, trouble


def renew():
    cost.write(TABLE, HEAD, *take())


def check():
    return cost.compare("costs of blocks", cost.expected(TABLE), *take())
