#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_batches.py [ROOT]: checks unnamed namespaces. No source may have a name in its unnamed namespace that a
header of its room, or of a room below, also declares.

Sources of a room are compiled together (cmake/rooms.cmake), where the unnamed namespaces are one. A name in two of them is a
compiler error. A name that hides a header's name is no error: the other sources of the batch would call the wrong function.
"""
import pathlib
import re
import subprocess
import sys

DECLARED = re.compile(r"^(?:inline |constexpr |static |\[\[nodiscard\]\] )*(?:[\w:]+(?:<[^;={}()]*>)?[ &*]+)+?(\w+)\(", re.M)
KEPT = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.M | re.S)
NAMESPACE = re.compile(r"^namespace ([\w:]+) \{$", re.M)


def functions(text):
    return {name for name in DECLARED.findall(text) if name not in ("if", "for", "while", "return", "switch", "operator")}


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1])
    files = subprocess.run(["git", "ls-files", "sixstep", "batch", "text", "files", "report", "faces/cli", "faces/loop/*.cpp", "faces/loop/*.hpp"],
                           cwd=root, check=True, text=True, stdout=subprocess.PIPE).stdout.split()
    declared = {}
    for name in files:
        if name.endswith(".hpp"):
            text = (root / name).read_text(encoding="utf-8")
            for namespace in set(NAMESPACE.findall(text)):
                for function in functions(text):
                    declared.setdefault((namespace, function), name)
    found = 0
    for name in files:
        if not name.endswith(".cpp"):
            continue
        text = (root / name).read_text(encoding="utf-8")
        for namespace in set(NAMESPACE.findall(text)):
            for part in KEPT.findall(text):
                for function in sorted(functions(part)):
                    if header := declared.get((namespace, function)):
                        print(f"{name}: {function}() in its unnamed namespace hides the function of {header} in a batch; give it a different name")
                        found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
