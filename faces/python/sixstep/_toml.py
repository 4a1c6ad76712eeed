# SPDX-License-Identifier: Apache-2.0
"""Writes Python values as TOML."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any


def value_text(value: Any) -> str:
    """One value as TOML, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, os.PathLike):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {value_text(item)}" for key, item in value.items()) + " }" if value else "{}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(item) for item in value) + "]"
    if hasattr(value, "tolist"):  # numpy: an array or one of its scalars
        return value_text(value.tolist())
    if isinstance(value, (int, float)):
        text = repr(value)
        return {"inf": "inf", "-inf": "-inf", "nan": "nan"}.get(text, text)
    raise TypeError(f"a value of type {type(value).__name__} cannot be a value of a scenario; give a number, text, list or dict")


def setting_text(value: Any) -> str:
    """One value as an override; a bare word or a number with its unit is allowed: "hard", "40us"."""
    return value if isinstance(value, str) else value_text(value)


def file_text(tables: Mapping[str, Any]) -> str:
    """A complete file. Numbers may be texts with a unit: {"pwm": {"period_s": "40us"}}."""
    lines = [f"{key} = {value_text(value)}" for key, value in tables.items() if not _is_table(value)]
    for key, value in tables.items():
        if isinstance(value, Mapping):
            lines += ["", f"[{key}]", *_table_lines(key, value)]
        elif _is_table(value):
            for item in value:
                lines += ["", f"[[{key}]]", *_table_lines(key, item)]
    return "\n".join(lines) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, (list, tuple)) and bool(value) and all(isinstance(i, Mapping) for i in value))


def _table_lines(path: str, table: Mapping[str, Any]) -> list[str]:
    lines = [f"{key} = {value_text(value)}" for key, value in table.items() if not isinstance(value, Mapping)]
    for key, value in table.items():
        if isinstance(value, Mapping):
            lines += [f"{key}.{inner}" if not inner.startswith("[") else inner for inner in _table_lines(f"{path}.{key}", value)]
    return lines
