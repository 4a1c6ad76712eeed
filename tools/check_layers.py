#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the code obeys the layers in docs/architecture.md.

Reads the ```layers block there and checks every #include under the rooms:
  - a layer includes only itself and the layers after its arrow; if the block names corners of a room
    (study/run), the same holds for each corner within its room;
  - third-party headers appear only outside the library, and nothing includes tests/ or benchmarks/;
  - control/ includes nothing that a bare chip lacks, the library includes no files, clocks or threads;
  - rooms that can influence a trajectory call no elementary function of the C library;
  - no text of the library names a command or an option, because the library has several faces.
Prints file:line, the breach and its cure; exits with 1 after a breach, with 2 if the block itself is wrong.
"""
import argparse
import pathlib
import re
import sys

SOURCE = {".hpp", ".cpp", ".h", ".cc", ".inl"}
ROOTS = ("sixstep", "batch", "text", "files", "report", "faces")
DETERMINISTIC = {"base", "series", "control", "plant", "sim", "rig", "design"}

# Headers of C++20 that need no operating system (the freestanding headers, and three others).
FREESTANDING = set("array bit cfloat climits compare concepts cstddef cstdint initializer_list limits stdint.h type_traits "
                   "utility version".split())
# Headers of the standard library that the library may use: no files, clocks, threads, platform-dependent random numbers,
# or containers whose order differs between platforms.
LIBRARY = FREESTANDING | set("algorithm bitset cassert charconv cmath cstdlib cstring deque functional iterator list "
                             "map memory memory_resource numbers numeric optional ranges set span string string_view "
                             "tuple variant vector".split())
ELEMENTARY = re.compile(r"(?<![\w:])(?:std)?::\s*(a?sinh?|a?cosh?|a?tanh?|atan2|exp2?|expm1|log(?:10|1p|2)?|pow|cbrt|hypot|fma|lerp|"
                        r"[lt]gamma|erfc?)[fl]?\s*[(;]")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
FACE = re.compile(r"(?<![\w-])--[a-z][a-z-]+|\bsixstep (?:compare|completion|curve|design|export|help|man|motor|new|run|schema)\b")
STRING = re.compile(r'"(?:\\.|[^"\\])*"')
CPP_HEADER = re.compile(r"^[a-z_0-9]+$")  # <vector>: no dot, no slash


class Broken(Exception):
    """The block itself is wrong."""


def read_layers(document: pathlib.Path) -> dict[str, set[str]]:
    """{layer: layers it may include}, in the order of the block; each row names only rows above it."""
    if not document.is_file():
        raise Broken(f"{document}: missing; it holds the layers block")
    layers: dict[str, set[str]] = {}
    inside = False
    for number, line in enumerate(document.read_text().splitlines(), 1):
        if line.strip() == "```layers":
            inside = True
        elif inside and line.strip() == "```":
            return layers
        elif inside and line.strip():
            name, arrow, behind = line.partition("->")
            name, allowed = name.strip(), set(behind.split())
            if not arrow or name in layers:
                raise Broken(f"{document}:{number}: write each layer once, as NAME -> NAMES")
            unknown = allowed - layers.keys()
            if unknown:
                raise Broken(f"{document}:{number}: {name} includes {', '.join(sorted(unknown))}, which no row above names")
            layers[name] = allowed
    raise Broken(f"{document}: no complete ```layers block")


def layer_of(path: str) -> str | None:
    """The layer of a path from the repository root; None outside the layered rooms."""
    parts = path.split("/")
    if parts[0] in ("sixstep", "faces"):
        return parts[1] if len(parts) > 2 else None
    return parts[0] if parts[0] in ROOTS else None


def corner_of(path: str) -> str:
    """ROOM/FOLDER of a path below its room's folder; the room itself for a file directly in the room."""
    room, parts = layer_of(path), path.split("/")
    below = parts[parts.index(room) + 1:-1]
    return "/".join([room, *below[:1]])


def check_corner(path: str, target: str, layers: dict[str, set[str]]) -> str | None:
    """Within a room that has corners: the breach and its cure, or None. Every corner may include a file that is in no corner."""
    room, here, there = layer_of(path), corner_of(path), corner_of(target)
    if there in (here, room) or not any(name.startswith(room + "/") for name in layers):
        return None
    for corner in (here, there):
        if corner not in layers:
            return f"{corner} is no corner that the layers block names; add a row"
    if here == room or there not in layers[here]:
        allowed = "" if here == room else " ".join(sorted(layers[here]))
        return f"{here} may include {allowed or 'no other corner'}, not {there}; move what is needed to a corner below"
    return None


def without_comments(text: str) -> str:
    """The text with blanks in place of comments and string contents; line breaks remain."""
    def blank(match: re.Match) -> str:
        found = match.group(0)
        return found if found[0] == '"' and "\n" not in found else re.sub(r"[^\n]", " ", found)
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def check_include(layer: str, quoted: bool, target: str, layers: dict[str, set[str]], in_library: bool) -> str | None:
    """The breach and its cure, or None."""
    if quoted:
        other = layer_of(target)
        if other is None:
            return f'includes "{target}", which is in no layer; write the path from the repository root, or <...> for a library'
        if other not in layers:
            return f'includes "{target}" of {other}, which the layers block does not name; add a row to it'
        if other != layer and other not in layers[layer]:
            allowed = " ".join(sorted(layers[layer])) or "nothing"
            return f"{layer} may include {allowed}, not {other}; move what is needed down a layer or pass it in as data"
        return None
    if layer == "control" and target not in FREESTANDING:
        return f"control/ runs on a bare chip and <{target}> needs more; use {' '.join(sorted(FREESTANDING))}"
    if not in_library:
        return None
    if not CPP_HEADER.match(target) and target not in FREESTANDING:
        return f"<{target}> is not the C++ standard library's; third-party code belongs to batch, text, files, report or faces"
    if target not in LIBRARY:
        return f"<{target}> has files, clocks or threads, or differs between platforms; do that in batch, files or faces"
    return None


def check_file(root: pathlib.Path, file: pathlib.Path, layers: dict[str, set[str]]) -> list[str]:
    path = file.relative_to(root).as_posix()
    layer = layer_of(path)
    if layer is None:
        return [f"{path}:1: lies in no layer; put it into one of the rooms"]
    if layer not in layers:
        return [f"{path}:1: layer {layer} is not in the layers block; add a row to docs/architecture.md"]
    in_library = path.startswith("sixstep/")
    breaches = []
    for number, line in enumerate(without_comments(file.read_text()).splitlines(), 1):
        include = INCLUDE.match(line)
        if include:
            quoted, target = include.group(1) == '"', include.group(2)
            breach = check_include(layer, quoted, target, layers, in_library)
            if not breach and quoted and layer_of(target) == layer:
                breach = check_corner(path, target, layers)
            if breach:
                breaches.append(f"{path}:{number}: {breach}")
        for text in STRING.findall(line) if in_library and not include else ():
            word = FACE.search(text)
            if word:
                breaches.append(f"{path}:{number}: says {word.group(0)}, which only one face has; say it in the library's "
                                "words and let the face translate (faces/cli/spec_words.hpp)")
        call = ELEMENTARY.search(STRING.sub('""', line)) if in_library and layer in DETERMINISTIC else None
        if call:
            breaches.append(f"{path}:{number}: calls the C library's {call.group(1)}, whose last digit differs between "
                            "platforms; use sixstep/base/elementary.hpp")
    return breaches


def check(root: pathlib.Path) -> tuple[list[str], int]:
    """All breaches under root, and the number of checked files."""
    layers = read_layers(root / "docs" / "architecture.md")
    files = sorted(f for top in ROOTS if (root / top).is_dir() for f in (root / top).rglob("*")
                   if f.suffix in SOURCE and "node_modules" not in f.parts and f.is_file())
    breaches = [breach for file in files for breach in check_file(root, file, layers)]
    return breaches, len(files)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    try:
        breaches, count = check(parser.parse_args().root.resolve())
    except Broken as broken:
        print(broken, file=sys.stderr)
        return 2
    for breach in breaches:
        print(breach)
    if breaches:
        print(f"{len(breaches)} breach{'es' if len(breaches) > 1 else ''} of the layers in docs/architecture.md", file=sys.stderr)
        return 1
    return 0 if count else 2


if __name__ == "__main__":
    sys.exit(main())
