# SPDX-License-Identifier: Apache-2.0
"""Builds the ATmega2560's image of the example's drive, unchanged, with a changed drive, or with a fault put into its
program."""
import pathlib
import shutil

import build

EXAMPLE = pathlib.Path("faces/firmware/example/avr")


def planted(text, old, new, name):
    assert text.count(old) == 1, f"{name} has {text.count(old)} times {old!r}"
    return text.replace(old, new)


def built(folder, changes=()):
    """Builds image.elf in a folder of its own. `changes` are changes of the example's files: (name, old, new)."""
    folder = pathlib.Path(folder)
    for part in ("sixstep/control", "faces/firmware", "tools"):
        shutil.copytree(build.REPOSITORY / part, folder / part)
    for name, old, new in changes:
        file = folder / EXAMPLE / name
        file.write_text(planted(file.read_text(encoding="utf-8"), old, new, name), encoding="utf-8")
    build.told([folder / "tools/firmware_image.sh", "atmega2560", folder / EXAMPLE / "drive_config.hpp", folder / "out"], cwd=folder)
    return folder / "out/image.elf"
