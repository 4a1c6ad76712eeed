# SPDX-License-Identifier: Apache-2.0
"""The costs of the controllers in data/controllers/ by tools/own_cost.sh. One controller is measured on all cores, as
docs/howto/write-a-controller.md shows it, the others on one core. They are compared with own/costs.txt: counts within
5 %, sizes exactly."""
import pathlib
import re
import tempfile

import build
import cores
import cost
import own
import own_cost
from build import Failed

TABLE = own.HERE / "costs.txt"
PAGE = cores.REPOSITORY / "docs/howto/write-a-controller.md"
CONTROLLERS = cores.REPOSITORY / "data" / "controllers"
CORE = "Cortex-M4F"
CASES = {"six_step_again.cpp": "speed", "sine_voltage.c": "duty"}  # the controllers with their scenarios
HEAD = """# SPDX-License-Identifier: Apache-2.0
# core, controller, scalar, entry, calls, and the count per call: mean, 99.9 % quantile, worst; of size: bytes of flash and RAM.
# Written by tools/check_target.sh --renew own
"""


def measured(source):
    """{(core, controller, scalar, entry): numbers}"""
    with tempfile.TemporaryDirectory() as folder:
        controller = own.Controller(CONTROLLERS / source, pathlib.Path(folder))
        own.record_scenario(controller, build.PROGRAM, own.HERE / f"{CASES[source]}.toml")
        _, rows, remarks = own.measure(controller, [cores.BY_NAME[CORE]])
    if remarks:
        raise Failed(remarks)
    found = {}
    for row in rows:
        key = row["core"], source, "float"
        found |= {(*key, entry): tuple(row[entry].values()) for entry in ("tick", "hall") if entry in row}
        found[*key, "size"] = row["flash_bytes"], row["ram_bytes"]
    return found


def take():
    rows, trouble = {}, []
    for source in CASES:
        try:
            rows |= measured(source)
        except Failed as failed:
            trouble.append(f"{source}: {failed}")
    return rows, trouble


def page():
    """(the present text of the page, the text with the present output of its command)"""
    text = PAGE.read_text(encoding="utf-8")
    words = re.search(r"^\$ tools/own_cost.sh (.*?) --json", text, re.M)[1].split()
    found, _ = own_cost.cost(own_cost.arguments([*words, "--program", str(build.PROGRAM)]))
    return text, re.sub(r"(?<=^```text\n).*?(?=^```)", lambda _: own_cost.told(found) + "\n", text, count=1, flags=re.M | re.S)


def renew():
    cost.write(TABLE, HEAD, *take())
    PAGE.write_text(page()[1], encoding="utf-8")


def is_size(key):
    return key[3] == "size"


def check():
    rows, trouble = take()
    table = cost.expected(TABLE)
    trouble += [f"{key[1]} on {key[0]}: flash and RAM {rows.get(key)}, the table has {table.get(key)}"
                for key in table | rows if is_size(key) and table.get(key) != rows.get(key)]
    counts = [{key: row for key, row in some.items() if not is_size(key)} for some in (table, rows)]
    stands, printed = page()
    if stands != printed:
        trouble.append(f"{PAGE.name}: does not show what its command prints: tools/check_target.sh --renew own writes it")
    return cost.compare("costs of controllers of one's own", *counts, trouble)
