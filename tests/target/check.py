#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py [--renew | --all] proof | sights | bits | costs | blocks | sizes: one part of tools/check_target.sh."""
import functools
import sys

import blocks
import build
import cores
import cost
import proof
import sizes
import walk
from build import Failed


def sights():
    trouble = walk.check_sights()
    print("the walk's inputs reach what they are meant to" if not trouble else "\n".join(trouble))
    return not trouble


PARTS = {"proof": (proof.check, None), "sights": (sights, None), "bits": (walk.check, walk.renew),
         "costs": (cost.check, cost.renew), "blocks": (blocks.check, blocks.renew), "sizes": (sizes.check, sizes.renew)}


def prepare(part):
    """Tools of our own, and the headers of the drives."""
    build.export_headers()
    build.build_board()
    if part in ("costs", "blocks"):
        cost.build_plugin()


def main():
    renews, part = "--renew" in sys.argv, sys.argv[-1]
    missing = [f"{core.name}: {core.missing()} is missing (tools/install.sh target)" for core in (*cores.HOSTS, *cores.CHIPS)
               if core.missing() and core.missing() != str(cores.OUT / "avr_board")]
    if missing or part not in PARTS:
        print("\n".join(missing) or __doc__)
        return 2
    check, renew = PARTS[part]
    try:
        prepare(part)
        if renews and renew:
            renew()
            print(f"the table of {part} is new: commit it with the change that moved it")
            return 0
        if part == "bits":
            check = functools.partial(check, whole=True) if "--all" in sys.argv else functools.partial(check, of=cores.USUAL)
        if part == "costs" and "--all" not in sys.argv:
            check = functools.partial(check, cost.USUAL)
        return 0 if check() else 1
    except Failed as failed:
        print(failed)
        return 1


if __name__ == "__main__":
    sys.exit(main())
