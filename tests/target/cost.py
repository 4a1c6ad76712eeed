# SPDX-License-Identifier: Apache-2.0
"""The cost of a control tick and of a Hall interrupt. It is counted call by call over recorded runs, and compared
with data/cores/drives.txt."""
import re

import build
import cores
from build import Failed

TABLE = cores.TABLES / "drives.txt"
RECORDER = cores.REPOSITORY / "build" / "dev" / "tests" / "target" / "target_record"
RECORDS = cores.OUT / "records"
PLUGIN = cores.OUT / "count_instructions.so"
CASES = ("duty", "current", "hysteresis", "speed", "position", "product", "field")
SOURCES = [cores.HERE / "cost" / "main.cpp", cores.HERE / "cost" / "entries.cpp"]
USUAL = ("hysteresis", "position", "product", "field")  # the position drive contains the speed loop, the current loop and the duty drive
MORE = 1.05  # a cost that is higher than in the table by more than this factor is reported
HEAD = """# SPDX-License-Identifier: Apache-2.0
# core, drive, scalar, entry, calls, and the count per call: mean, 99.9 % quantile, worst; written by
# tools/check_target.sh --renew. ATmega2560: cycles; the others: instructions. tick_interrupt and hall_interrupt are the same
# entries with what an interrupt adds: saved registers and reti, the vector's jump, and the five cycles of its response.
"""


def build_plugin():
    build.told(["g++", "-std=c++20", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", f"-I{cores.REPOSITORY}",
                cores.HERE / "cost" / "count_instructions.cpp", "-o", PLUGIN])


def cases():
    return [(core, drive, scalar) for core in cores.CHIPS for scalar in core.costs for drive in CASES if build.has_header(drive, scalar)]


def record(chosen):
    """Writes build/target/records/SCALAR/DRIVE.bin. Returns the drive's answers in its run: {(drive, scalar): line}."""
    def one(pair):
        drive, scalar = pair
        (RECORDS / scalar).mkdir(parents=True, exist_ok=True)
        return build.told([RECORDER, build.scenario(drive), scalar, RECORDS / scalar / f"{drive}.bin"]).splitlines()[1]
    pairs = sorted({(drive, scalar) for _, drive, scalar in chosen})
    answers = dict(zip(pairs, build.side_by_side(one, pairs)))
    for answer in answers.values():
        if isinstance(answer, Failed):
            raise answer
    return answers


def defines(core, drive):
    marked = core.unit == "instructions"
    return (*core.for_entries, f"-DTARGET_DRIVE={drive}", f"-DTARGET_PRODUCT={int(drive == 'product')}",
            f"-DTARGET_FIELD={int(drive == 'field')}", *(["-DTARGET_CALLS_ARE_MARKED"] if marked else []))


def addresses(core, file):
    lines = build.told([core.nm, file]).splitlines()
    return {words[2]: words[0] for words in map(str.split, lines) if len(words) == 3}


def counted(core, drive, scalar):
    """The output of the program, with a line `cost ENTRY CALLS MEAN WITHIN WORST` for each entry."""
    records = RECORDS / scalar / f"{drive}.bin"
    marked = core.unit == "instructions"
    sources = [*SOURCES, *([cores.HERE / "cost" / "calls.S"] if marked else [])]
    file = build.build(core, f"cost-{drive}-{scalar}", sources, scalar, defines(core, drive))
    at = addresses(core, file)
    if not marked:
        return build.run(core, file, records, at["refill_request"], at["entry_tick"], at["entry_hall"])
    told = file.with_suffix(".counts")
    plugin = f"{PLUGIN},told={told},tick={at['entry_tick']}-{at['after_tick']},hall={at['entry_hall']}-{at['after_hall']}"
    text = build.told([*core.run, "-plugin", plugin, "-kernel", file], cwd=records.parent)
    return text + told.read_text()


def measured(case, answers):
    """{(core, drive, scalar, entry): (calls, mean, within, worst)}. Raises Failed if the chip's answers differ from
    the answers of the run."""
    core, drive, scalar = case
    text = counted(*case)
    told = set(re.findall(r"^answers .*$", text, re.M))
    if told != {answers[drive, scalar]}:
        raise Failed(f"{core.name}, {drive} in {scalar}: the chip's {told or 'nothing'}, its run's {answers[drive, scalar]}")
    rows = re.findall(r"^cost (\S+) (\d+) (\d+) (\d+) (\d+)$", text, re.M)
    return {(core.name, drive, scalar, row[0]): tuple(map(int, row[1:])) for row in rows}


def expected(table=TABLE):
    lines = table.read_text().splitlines() if table.exists() else []
    rows = [line.split() for line in lines if line and not line.startswith("#")]
    return {tuple(row[:4]): tuple(map(int, row[4:])) for row in rows}


def judge(key, was, now):
    """The error of a row in words, or None."""
    words = f"{key[0]}, {key[1]} in {key[2]}, {key[3]}"
    if was is None or now is None:
        return f"{words}: {'not in the table' if was is None else 'not measured'}"
    if was[0] != now[0]:
        return f"{words}: {now[0]} calls, the table has {was[0]}"
    for what, before, after in zip(("mean", "99.9 %", "worst"), was[1:], now[1:]):
        if after > before * MORE or after < before / MORE:
            change = f"{(after / before - 1) * 100:+.1f} %"
            return f"{words}: {what} {before} -> {after} ({change})" + ("" if after > before else ", cheaper: renew the table")
    return None


def take(drives=CASES):
    """Measures all drives. Returns all rows, and the lines with errors."""
    chosen = [case for case in cases() if case[1] in drives]
    answers, rows, trouble = record(chosen), {}, []
    for answer in build.side_by_side(lambda case: measured(case, answers), chosen):
        if isinstance(answer, Failed):
            trouble.append(str(answer))
        else:
            rows |= answer
    return rows, trouble


def write(table, head, rows, trouble):
    if trouble:
        raise Failed("\n".join(trouble))
    table.write_text(head + "".join(" ".join([*key, *map(str, row)]) + "\n" for key, row in rows.items()))


def compare(what, table, rows, trouble):
    trouble = [*trouble, *(t for key in (table | rows) if (t := judge(key, table.get(key), rows.get(key))))]
    print(f"{len(rows)} {what}: " + (f"{len(trouble)} are not the table's" if trouble else "within 5 % of the table's"), flush=True)
    for line in trouble:
        print(f"  {line}")
    return not trouble


def renew():
    write(TABLE, HEAD, *take())


def check(drives=CASES):
    table = {key: row for key, row in expected().items() if key[1] in drives}
    return compare("costs over recorded runs", table, *take(drives))
