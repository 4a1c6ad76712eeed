# SPDX-License-Identifier: Apache-2.0
"""A user's own controllers: in Python, or compiled from C or C++ by one call."""
from __future__ import annotations

import hashlib
import os
import pathlib
import subprocess
from typing import Any

from . import _core
from ._errors import ProgramError

Measured = _core.Measured


def as_controller(controller: Any) -> Any:
    """The object that the library calls once per control period. With `controller.legs = True` it controls three legs."""
    return controller if isinstance(controller, _core.Controller) else _core.Controller(controller, bool(getattr(controller, "legs", False)))


def include_dir() -> str:
    """The folder for `-I` with the headers of a controller: sixstep/control/own/own_controller.h.

    >>> import os, sixstep
    >>> os.path.exists(os.path.join(sixstep.include_dir(), "sixstep/control/own/own_controller.h"))
    True
    """
    return str(pathlib.Path(__file__).parent / "include")


def compiled(source: str | os.PathLike[str], *, cache: str | os.PathLike[str] | None = None) -> str:
    """Compiles a controller in C or C++ (docs/howto/write-a-controller.md) and returns the path of the shared object,
    for `scenario["control.own.controller"]`. An unchanged source is compiled once.

    `source` is a file's path, or the text of a C++ source.

    >>> import pathlib, sixstep
    >>> path = sixstep.compiled('#include "sixstep/control/own/own_controller.h"\\n')
    >>> pathlib.Path(path).suffix, path == sixstep.compiled('#include "sixstep/control/own/own_controller.h"\\n')
    ('.so', True)
    """
    text, name = _source(source)
    folder = pathlib.Path(cache if cache is not None else os.environ.get("XDG_CACHE_HOME", "~/.cache")).expanduser() / "sixstep"
    compiler = [os.environ.get("CC", "cc") if name.endswith(".c") else os.environ.get("CXX", "c++")]
    command = [*compiler, *([] if name.endswith(".c") else ["-std=c++20"]), "-O2", "-ffp-contract=off", "-shared", "-fPIC",
               f"-I{include_dir()}"]
    digest = hashlib.sha256("\0".join([text, name, _core.version, *command]).encode()).hexdigest()[:16]
    made = folder / f"{pathlib.Path(name).stem}-{digest}.so"
    if made.exists():
        return str(made)
    folder.mkdir(parents=True, exist_ok=True)
    where = folder / f"{pathlib.Path(name).stem}-{digest}{pathlib.Path(name).suffix}" if isinstance(source, str) and "\n" in source else pathlib.Path(source)
    if where.parent == folder:
        where.write_text(text)
    partial = made.with_suffix(f".{os.getpid()}.partial")
    told = subprocess.run([*command, str(where), "-o", str(partial)], capture_output=True, text=True, check=False)
    if told.returncode != 0:
        raise ProgramError(told.stderr)
    os.replace(partial, made)
    return str(made)


def _source(source: str | os.PathLike[str]) -> tuple[str, str]:
    if isinstance(source, str) and "\n" in source:
        return source, "controller.cpp"
    path = pathlib.Path(source)
    return path.read_text(), path.name
