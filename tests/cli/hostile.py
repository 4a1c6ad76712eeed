# SPDX-License-Identifier: Apache-2.0
"""The hostile names in tests/support/hostile_names.hpp, as bytes. Without escaping, such a name acts as a command or
as markup."""
import re

from program import SOURCE

BYTES = {b"n": b"\n", b"r": b"\r", b"t": b"\t", b"\\": b"\\"}
LINES = (SOURCE / "tests/support/hostile_names.txt").read_bytes().splitlines()
TEXTS = [re.sub(rb"\\(x(..)|.)", lambda m: bytes.fromhex(m[2].decode()) if m[2] else BYTES[m[1]], line, flags=re.S) for line in LINES]
FILES = [name for name in TEXTS if b"/" not in name]


def is_visible(name):
    """Whether the bytes of a name are text without control characters, line ends, reordering marks and characters of
    no width."""
    try:
        return not re.search("[\x00-\x1f\x7f-\x9f\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\ufeff]", name.decode())
    except UnicodeDecodeError:
        return False
