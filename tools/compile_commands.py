#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compile_commands.py BUILD OUT: writes the build's compile_commands.json into the folder OUT. It has one entry for each
source, also for sources that are compiled in batches (cmake/rooms.cmake). clang-tidy, clangd and other tools read single sources."""
import json
import pathlib
import re
import sys

build, out = map(pathlib.Path, sys.argv[1:])
entries = []
for entry in json.loads((build / "compile_commands.json").read_text()):
    batch = pathlib.Path(entry["file"])
    within = re.findall(r'^#include "(.*\.cpp)"', batch.read_text(), re.M) if batch.parent.name == "Unity" else [str(batch)]
    entries += [{**entry, "file": source, "command": entry["command"].replace(str(batch), source)} for source in within]
out.mkdir(parents=True, exist_ok=True)
(out / "compile_commands.json").write_text(json.dumps(entries, indent=1))
