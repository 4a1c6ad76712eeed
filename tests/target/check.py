#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check.py [--renew | --all] proof | sights | bits | costs | blocks | sizes | own | loop | avr | images: one part of tools/check_target.sh."""
import functools
import sys

import avr
import blocks
import build
import cores
import cost
import images
import loop
import own_costs
import proof
import sizes
import walk
from build import Failed


def sights():
    trouble = walk.check_sights()
    print("the walk's inputs reach what they are meant to" if not trouble else "\n".join(trouble))
    return not trouble


def renew_bits():
    """A digest covers the same inputs as the table of reached cases. This table is checked again only if the digests
    are renewed."""
    if not sights():
        raise Failed("the walk's table is not written: let its inputs reach that")
    walk.renew()


# For each part: the usual check, the long check, and the function that writes the table.
PARTS = {"proof": (proof.check, proof.check, None), "sights": (sights, sights, None),
         "bits": (functools.partial(walk.check, of=cores.USUAL), functools.partial(walk.check, whole=True), renew_bits),
         "costs": (functools.partial(cost.check, cost.USUAL), cost.check, cost.renew),
         "blocks": (blocks.check, blocks.check, blocks.renew), "sizes": (sizes.check, sizes.check, sizes.renew),
         "own": (own_costs.check, own_costs.check, own_costs.renew), "loop": (loop.check, loop.check_all, None),
         "avr": (avr.check, avr.check, None), "images": (images.check, images.check_all, None)}


def prepare(part):
    """Builds the shared tools and writes the headers of the drives. The commands for a user's controller and for a
    core in the loop build their own files."""
    if part in ("own", "loop", "avr", "images"):
        return
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
    usual, everything, renew = PARTS[part]
    try:
        prepare(part)
        if renews and renew:
            renew()
            print(f"the table of {part} is new: commit it with the change that moved it")
            return 0
        return 0 if (everything if "--all" in sys.argv else usual)() else 1
    except Failed as failed:
        print(failed)
        return 1


if __name__ == "__main__":
    sys.exit(main())
