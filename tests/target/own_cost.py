#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/own_cost.sh SOURCE [SCENARIO]: measures the cost of a user's controller on the cores
(docs/howto/write-a-controller.md)."""
import argparse
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import build  # noqa: E402
import cores  # noqa: E402
import own  # noqa: E402
from build import Failed  # noqa: E402

MOTOR = "maxon-251601"


def arguments(words):
    parser = argparse.ArgumentParser(prog="tools/own_cost.sh", allow_abbrev=False, description=__doc__.partition(": ")[2],
                                     epilog="Every compiler receives the arguments after --, for example: -- -I lib -DFOO")
    parser.add_argument("source", type=pathlib.Path, metavar="SOURCE", help="the source of the controller, one file in C or C++")
    parser.add_argument("scenario", nargs="?", metavar="SCENARIO", help="the run in which the controller is measured; default: the course of `sixstep compare MOTOR`")
    parser.add_argument("--motor", help=f"the motor of the course; default: {MOTOR}")
    parser.add_argument("--core", action="append", choices=[core.name for core in cores.CHIPS],
                        help="a core; may be repeated; default: all cores")
    parser.add_argument("--json", metavar="FILE", help="writes the costs for `sixstep compare --own-cost FILE`")
    parser.add_argument("--program", default=cores.REPOSITORY / "build" / "release" / "sixstep", type=pathlib.Path, help=argparse.SUPPRESS)
    at = words.index("--") if "--" in words else len(words)
    args = parser.parse_args(words[:at])
    if args.scenario and args.motor:
        parser.error("--motor selects the motor of the comparison's course; omit SCENARIO or --motor")
    args.motor = args.motor or MOTOR
    args.flags = words[at + 1:]
    return args


def chosen(args):
    picked = [core for core in cores.CHIPS if not args.core or core.name in args.core]
    for core in picked:
        missing = core.missing()
        if missing and missing != str(cores.OUT / "avr_board"):
            raise Failed(f"{core.name}: {missing} is missing (tools/install.sh target)")
    return picked


def table(rows):
    head = ["core", "step", "worst", "Hall", "worst", "flash", "RAM"]
    lines = [head]
    for row in rows:
        entries = [str(row[entry][count]) if entry in row else "-" for entry in ("tick", "hall") for count in ("mean", "worst")]
        lines.append([row["core"], *entries, str(row["flash_bytes"]), str(row["ram_bytes"])])
    wide = [max(len(line[k]) for line in lines) for k in range(len(head))]
    return "\n".join("  ".join([line[0].ljust(wide[0]), *(w.rjust(n) for w, n in zip(line[1:], wide[1:]))]) for line in lines)


def cost(args):
    """The content of the JSON, and the remarks."""
    with tempfile.TemporaryDirectory() as folder:
        controller = own.Controller(args.source, pathlib.Path(folder), args.flags)
        picked = chosen(args)
        cores.OUT.mkdir(parents=True, exist_ok=True)
        if args.scenario:
            own.record_scenario(controller, args.program, args.scenario)
        else:
            own.record_course(controller, args.program, args.motor)
        name, rows, remarks = own.measure(controller, picked)
        run = args.scenario or f"sixstep compare {args.motor}"
        return {"controller": name, "source": args.source.name, "run": run, "arithmetic": "float", "cores": rows}, remarks


def told(found):
    row = found["cores"][0]
    halls = f" and {row['hall']['calls']} Hall interrupts" if "hall" in row else ""
    cycles = "; of the ATmega2560 cycles" if any(row["unit"] == "cycles" for row in found["cores"]) else ""
    return (f"{found['controller']} in float, {row['tick']['calls']} steps{halls} of {found['run']}:\n"
            f"instructions, mean and at worst{cycles}; bytes\n\n{table(found['cores'])}\n\n"
            "every answer on every core: this machine's, bit by bit")


def main(words):
    args = arguments(words)
    try:
        found, remarks = cost(args)
    except Failed as failed:
        print(failed, file=sys.stderr)
        return 2
    print(told(found))
    if remarks:
        print(f"\n{found['controller']} {remarks}", file=sys.stderr)
    try:
        if args.json:
            pathlib.Path(args.json).write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    except OSError as wrong:
        print(f"--json {args.json}: {wrong.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
