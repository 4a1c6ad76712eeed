#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cli_digests.py PROGRAM ROOT TABLE [FILE..]: prints the same lines as tests/digest/read_scenarios.cpp, with digests
of the command line. It runs the files of the table and the given files.
To renew the table: cli_digests.py PROGRAM . TABLE [FILE..] >new"""
import json
import pathlib
import subprocess
import sys

program, root, table, *files = sys.argv[1:]
head = [line for line in pathlib.Path(table).read_text().splitlines() if line.startswith("#")]
named = [line.split()[0] for line in pathlib.Path(table).read_text().splitlines() if line and line not in head]
print("\n".join(head))
for file in dict.fromkeys([*named, *files]):
    run = subprocess.run([program, "run", file, "--json", "-", "--quiet"], cwd=root, stdout=subprocess.PIPE, text=True)
    if run.returncode not in (0, 1, 3):
        sys.exit(f"{file}: exit code {run.returncode}")
    summary = json.loads(run.stdout)
    print(f"{file:<56} {summary['digest']} {summary['segments']:8}")
