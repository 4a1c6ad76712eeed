#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make.py [NAME.py ...]: executes notebooks written as text and writes them as NAME.ipynb with their outputs.

A line "# %%" begins a cell of code, "# %% [markdown]" one of text, whose lines begin with "# ".
"""
import ast
import contextlib
import io
import json
import os
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parents[2] / "data"


def cells_of(text):
    """[(kind, source)] of a notebook's text."""
    cells = []
    for part in re.split(r"^# %%", text, flags=re.M)[1:]:
        head, _, body = part.partition("\n")
        kind = "markdown" if "[markdown]" in head else "code"
        body = body.strip("\n")
        cells.append((kind, "\n".join(line.removeprefix("#").removeprefix(" ") for line in body.splitlines()) if kind == "markdown" else body))
    return cells


def executed(source, names):
    """Outputs of a cell, as a notebook keeps them: what it prints, and the value of its last expression."""
    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, outputs = io.StringIO(), []
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(last, "cell", "eval"), names) if last else None
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(True)})
    if value is not None:
        data = {"text/plain": repr(value).splitlines(True)}
        if page := getattr(value, "_repr_html_", lambda: None)():
            data["text/html"] = page.splitlines(True)
        if hasattr(value, "savefig"):
            picture = io.StringIO()
            value.savefig(picture, format="svg")
            data["image/svg+xml"] = picture.getvalue().splitlines(True)
        outputs.append({"output_type": "execute_result", "execution_count": None, "metadata": {}, "data": data})
    return outputs


def notebook(text):
    """The notebook as a dict. It is executed in an empty folder that is next to a folder data/."""
    os.environ["MPLBACKEND"] = "Agg"
    import matplotlib

    matplotlib.rcParams["svg.hashsalt"] = "sixstep"
    names, cells, home = {}, [], os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(DATA, pathlib.Path(folder) / "data")
        os.chdir(folder)
        try:
            for n, (kind, source) in enumerate(cells_of(text)):
                cell = {"cell_type": kind, "id": f"cell-{n}", "metadata": {}, "source": source.splitlines(True)}
                if kind == "code":
                    cell |= {"execution_count": None, "outputs": executed(source, names)}
                cells.append(cell)
        finally:
            os.chdir(home)
    return {"cells": cells, "metadata": {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}},
            "nbformat": 4, "nbformat_minor": 5}, names


if __name__ == "__main__":
    for file in map(pathlib.Path, sys.argv[1:] or sorted(HERE.glob("[0-9]-*.py"))):
        made, _ = notebook(file.read_text())
        file.with_suffix(".ipynb").write_text(json.dumps(made, indent=1, ensure_ascii=False) + "\n")
        print(file.with_suffix(".ipynb").name)
