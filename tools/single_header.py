#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes sixstep_control.hpp: all of sixstep/control/ in one header, for projects that want a single file.

    tools/single_header.py [--out FILE]

The file contains each part completely, in the order of the includes, without licence line, guard and includes. The standard headers
are at the beginning, each once. tests/tools/single_header_test.py checks that the result and its parts preprocess to the same tokens.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = "sixstep/control"
LICENCE = "// SPDX-License-Identifier: Apache-2.0"
OWN = re.compile(r'^#include "(sixstep/control/[a-z0-9_/]+\.hpp)"\n', re.M)
STANDARD = re.compile(r"^#include (<[a-z0-9_]+>)\n", re.M)


def ordered(root: pathlib.Path) -> list[str]:
    """All parts, each after the parts that it includes; otherwise ordered by name."""
    order: list[str] = []

    def visit(path: str) -> None:
        if path in order:
            return
        for other in OWN.findall((root / path).read_text()):
            visit(other)
        order.append(path)

    for part in sorted((root / FOLDER).rglob("*.hpp")):
        if part.parent.name == "own":  # the interface of users' controllers, which firmware does not include
            continue
        visit(part.relative_to(root).as_posix())
    return order


def body(text: str) -> str:
    """A part without its licence line, guard and includes."""
    text = text.replace(LICENCE + "\n", "", 1).replace("#pragma once\n", "", 1)
    return STANDARD.sub("", OWN.sub("", text)).strip("\n")


def single_header(root: pathlib.Path) -> str:
    parts = ordered(root)
    texts = {part: (root / part).read_text() for part in parts}
    standard = sorted({name for text in texts.values() for name in STANDARD.findall(text)})
    head = [LICENCE, "// sixstep control library in one file, made by tools/single_header.py from sixstep/control/. C++20, freestanding.",
            "// Change the parts, not this file.",
            "// avr-gcc 5 and 7 (Debian 12, the Arduino IDE) have no C++20. For the AVR: clang 19 or later.", "#pragma once"]
    head += [f"#include {name}" for name in standard]
    return "\n".join(head) + "\n" + "".join(f"\n// ---- {part}\n{body(texts[part])}\n" for part in parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, help="file to write. Default: standard output")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="repository root")
    args = parser.parse_args()
    text = single_header(args.root)
    if args.out:
        args.out.write_text(text)
    else:
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
