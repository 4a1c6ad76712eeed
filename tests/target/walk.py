# SPDX-License-Identifier: Apache-2.0
"""Every core computes the same bits. The digests of the walk are compared with tests/target/digests.txt. The module
also checks which cases the inputs reach."""
import re

import build
import cores
from build import Failed

TABLE = cores.HERE / "digests.txt"
SHORT, LONG = 10_000, 1_000_000
LEAST_SIGHTS = 5  # the smallest number of steps in 10 000 that must reach a case
HEAD = """# SPDX-License-Identifier: Apache-2.0
# block, scalar, digest of its first 10 000 steps and of 1 000 000; written by tools/check_target.sh --renew
"""


# Each part is a separate program. Otherwise the blocks would not fit, and the count of a block would depend on its neighbours. A
# block is in the part with the most specific name.
PARTS = {"": (), "rotor": ("-DTARGET_OF_ROTOR",), "observers": ("-DTARGET_OF_OBSERVERS",),
         "commissioning": ("-DTARGET_OF_COMMISSIONING",), "pulses": ("-DTARGET_OF_PULSES",), "field": ("-DTARGET_OF_FIELD",)}
BLOCKS = {"": "", "sensing/": "rotor", "sensorless/": "rotor", "commissioning/": "commissioning",
          "commissioning/pulse": "pulses", "field/": "field", "jerk_profile": "field",
          **{f"sensorless/{observer}": "observers" for observer in ("luenberger", "sliding_mode", "flux_linkage", "observer")}}


def programs(core):
    return (*core.scalars, "whole")


def part_of(block):
    return BLOCKS[max(filter(block.startswith, BLOCKS), key=len)]


def digests(text):
    found = re.findall(r"^(\S+) (\S+) (\d+) ([0-9a-f]{8})$", text, re.M)
    return {(block, scalar, int(n)): digest for block, scalar, n, digest in found}


def printed(core, scalar, part, steps=SHORT, defines=()):
    """{(block, scalar, steps): digest} of one program, and its text. Its other lines begin with #."""
    defines = (*PARTS[part], *defines)
    name = "-".join(["walk", scalar, *(define.removeprefix("-D") for define in defines)])
    file = build.build(core, name, [cores.HERE / "walk" / "main.cpp"], scalar, (*core.flags_of_walk(part), *defines))
    text = build.run(core, file, *([str(steps)] if core.is_host else []))
    return digests(text), text


def expected():
    table = {}
    for line in TABLE.read_text().splitlines() if TABLE.exists() else []:
        if line and not line.startswith("#"):
            block, scalar, short, long = line.split()
            table |= {(block, scalar, SHORT): short, (block, scalar, LONG): long}
    return table


def renew():
    core = cores.HOSTS[0]
    rows = []
    for part in PARTS:
        for scalar in programs(core):
            found, _ = printed(core, scalar, part, LONG)
            rows += [f"{block} {s} {digest} {found[block, s, LONG]}" for (block, s, n), digest in found.items() if n == SHORT]
    TABLE.write_text(HEAD + "\n".join(rows) + "\n")


def check_sights():
    """Lines with errors: cases that the inputs of the walk should reach and do not."""
    core, trouble = cores.HOSTS[0], []
    for scalar, part in [(scalar, part) for part in PARTS for scalar in ("q15", "float", "whole")]:
        _, text = printed(core, scalar, part, defines=("-DTARGET_SIGHTS",))
        for times, what in re.findall(r"^# (\d+) (.*)$", text, re.M):
            if int(times) < LEAST_SIGHTS:
                trouble.append(f"{scalar} {what}: reached in {times} of {SHORT} steps, too seldom")
    return trouble


def steps_of(core, whole):
    """The number of steps. On an emulated host LONG would take minutes, so it makes as few steps as the chips, except
    if `whole` is set."""
    return LONG if core.is_host and (whole or not core.run) else SHORT


def difference(core, scalar, part, table, steps):
    """The lines with errors of one program, and the number of equal digests."""
    found, _ = printed(core, scalar, part, steps)
    wanted = {key: digest for key, digest in table.items()
              if key[1] == scalar and part_of(key[0]) == part and key[2] <= steps}
    trouble = [f"{core.name}: {block} {s}, {n} steps: {wanted.get((block, s, n), 'not in the table')} expected, "
               f"{found.get((block, s, n), 'not printed')} found"
               for block, s, n in sorted(wanted.keys() | found.keys()) if wanted.get((block, s, n)) != found.get((block, s, n))]
    return trouble, len(found) - len(trouble)


def check(of=None, parts=tuple(PARTS), whole=False):
    """Checks all cores and programs, or the named ones, and prints a line for each core. Returns true if there is no
    error. `whole`: also the emulated hosts make all steps."""
    table, well = expected(), True
    chosen = [c for c in (*cores.HOSTS, *cores.CHIPS) if of is None or c.name in of]
    cases = [(core, scalar, part) for core in chosen for scalar in programs(core) for part in parts]
    answers = dict(zip(cases, build.side_by_side(lambda case: difference(*case, table, steps_of(case[0], whole)), cases)))
    for core in chosen:
        trouble, same = [], 0
        for scalar, part in [case[1:] for case in cases if case[0] is core]:
            answer = answers[core, scalar, part]
            if isinstance(answer, Failed):
                trouble.append(f"{core.name}, {scalar}: {answer}")
            else:
                trouble += answer[0]
                same += answer[1]
        steps = f"{steps_of(core, whole):,}".replace(",", " ")
        print(f"{core.name:<16} {same} digests of {steps} steps are the table's" + (f", {len(trouble)} are not" if trouble else ""), flush=True)
        for line in trouble:
            print(f"  {line}")
        well = well and not trouble
    return well
