# SPDX-License-Identifier: Apache-2.0
"""Reads the tables of many runs from CSV, store, JSON and page. Each row is a dictionary with the names of the
columns as keys. It also has a second implementation of the checksum of a stored row."""
import base64
import contextlib
import csv
import json
import math
import sqlite3
import struct

ALL = 2**64 - 1
BEFORE, BEHIND = ["run", "end", "passed"], ["problem", "digest"]


PREFIXES = {"": 1, "n": 1e-9, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}


def shown(text, unit):
    """The number that a cell of a printed table shows, in the given unit; None for "-"."""
    text = text.removesuffix(" *").removesuffix(" !")
    if text == "-":
        return None
    if text == "never":
        return math.inf
    if text.endswith(" %"):
        return float(text[:-2]) / 100
    number, _, of = text.partition(" ")
    return float(number) * (PREFIXES[of.removesuffix(unit)] if unit else 1)


def value(text):
    """A cell of a CSV file as a number, or as text; None if it is empty."""
    try:
        return math.inf if text == "never" else float(text)
    except ValueError:
        return text or None


def lines_of_csv(path):
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("# ")))


def of_csv(path):
    return [{name: cell if name in BEHIND else value(cell) for name, cell in row.items()} for row in lines_of_csv(path)]


def of_store(path, view="runs"):
    with contextlib.closing(sqlite3.connect(path)) as db:
        rows = db.execute(f"SELECT * FROM {view}")
        names = [column[0] for column in rows.description]
        return [dict(zip(names, row, strict=True)) for row in rows]


def with_unit(name, unit):
    return f"{name} [{unit}]" if unit else name


def names_of_json(table):
    return ([with_unit(c["key"], c["unit"]) for c in table["keys"]] +
            [with_unit("drive: " + c["key"], c["unit"]) for c in table["strayed"]] +
            [with_unit(c["figure"], c["unit"]) for c in table["figures"]])


def of_json(path):
    table = json.loads(path.read_text())
    names = table["columns"]
    told = {"never": math.inf, "-never": -math.inf}
    return [{name: told.get(cell, cell) if isinstance(cell, str) else cell for name, cell in zip(names, row, strict=True)}
            for row in table["rows"]]


def of_page(path):
    """The columns of the page's data, by name, with one value per run in single precision."""
    data = json.loads(path.read_text().split('id="data">', 1)[1].split("</script>", 1)[0])
    columns = {}
    for column in data["plans"][0]["columns"]:
        name = ("drive: " if column["kind"] == "strayed" else "") + column["name"]
        bytes_ = base64.b64decode(column["data"])
        numbers = struct.unpack(f"<{len(bytes_) // 4}f", bytes_)
        columns[name] = [column["words"][int(x)] if "words" in column else x for x in numbers]
    return columns


def figures_alone(path):
    """The figures of one run by name and unit, read from the JSON of this run."""
    alone = json.loads(path.read_text())
    told = {"never": math.inf, "-never": -math.inf}
    return alone["digest"], {with_unit(f["figure"], f["unit"]): told.get(f["measured"], f["measured"])
                             for f in alone["require"] + alone["compare"]}


def hash_word(value, bits):
    value = (value ^ bits) * 0x9E3779B97F4A7C15 & ALL
    return (value << 32 | value >> 32) & ALL


def hashed(*words):
    value = 0xCBF29CE484222325
    for word in words:
        value = hash_word(value, word)
    return value


def text_digest(text, before=0):
    data = text.encode()
    return hashed(before, len(data), *(int.from_bytes(data[n:n + 8], "little") for n in range(0, len(data), 8)))


def checksum(cells, plan, inputs):
    """The checksum of a stored row, as in files/store/stored_row.hpp. It covers the plan, the inputs, and the kind
    and bits of each value."""
    words = [text_digest(inputs, text_digest(plan))]
    for cell in cells:
        if cell is None:
            words += [0]
        elif isinstance(cell, int):
            words += [1, cell & ALL]
        elif isinstance(cell, float):
            words += [2, struct.unpack("<Q", struct.pack("<d", cell))[0]]
        else:
            words += [3, text_digest(cell)]
    whole = hashed(*words)
    return whole - 2**64 if whole >= 2**63 else whole


def sealed(path, change):
    """Changes the store with SQL. Then it corrects the checksum of each row, as if the changed values had been
    written."""
    with contextlib.closing(sqlite3.connect(path)) as db:
        db.execute(change)
        about = dict(db.execute("SELECT word, value FROM about"))
        for row in db.execute("SELECT * FROM run").fetchall():
            db.execute("UPDATE run SET checksum = ? WHERE run = ?", (checksum(row[:-1], about["plan"], about["inputs"]), row[0]))
        db.commit()
