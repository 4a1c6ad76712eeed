# SPDX-License-Identifier: Apache-2.0
"""Checks the AVR compiler before its other results are used. The chip computes fixed-point arithmetic, a controller
and a complete drive with random configurations, for 10 000 random inputs. The digests must be those of the table.
clang 14 to 16 generate wrong code. If one of them is installed, it must fail, because a check that cannot fail proves
nothing. clang 14 compiles the arithmetic and every block alone correctly, but not the drive. If everything is
inlined, it crashes."""
import dataclasses
import shutil

import build
import cores
import walk
from build import Failed

AVR = cores.BY_NAME["ATmega2560"]
BLOCKS = ("arithmetic", "pi", "drive+retune")
KNOWN_WRONG = ("clang++-14", "clang++-15", "clang++-16")
LIMIT_S = 60  # s; a program with wrong code may never end


def wrong(core, limit_s=LIMIT_S):
    """The error of the compiler's arithmetic in words; empty if there is none."""
    table = {key: digest for key, digest in walk.expected().items() if key[0] in BLOCKS and key[1:] == ("q15", walk.SHORT)}
    try:
        file = build.build(core, "proof", [cores.HERE / "walk" / "main.cpp"], "q15", (*core.for_walk, "-DTARGET_PROOF_ALONE"))
        text = build.run(core, file, limit_s=limit_s)
    except Failed as failed:
        return str(failed).splitlines()[-1]
    found = walk.digests(text)
    if not table:
        return f"{walk.TABLE.name} has no digests to hold it against"
    return ", ".join(f"{block} {found.get((block, s, n), 'not printed')} where {digest} is right" for (block, s, n), digest in table.items()
                     if found.get((block, s, n)) != digest)


def check():
    """True if the compiler in use is right, and every compiler that is known to be wrong fails."""
    trouble = wrong(AVR)
    print(f"{AVR.compile[0]} for the AVR: " + (f"WRONG, nothing that it compiles is to be believed: {trouble}" if trouble else "its arithmetic is right"), flush=True)
    well = not trouble
    for compiler in filter(shutil.which, KNOWN_WRONG):
        other = dataclasses.replace(AVR, name=f"proof-{compiler}", compile=(compiler, *AVR.compile[1:]), for_walk=())
        trouble = wrong(other)
        print(f"{compiler} for the AVR: " + (f"is wrong, as it is known to be: {trouble}" if trouble else "passes, though it is known to be wrong: the proof is too weak"), flush=True)
        well = well and bool(trouble)
    return well
