#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gallery.py PROGRAM [--check]: writes the pages in docs/gallery and their pictures from the scenarios in data/scenarios.

Titles and notes come from the files, and results from the program. Pictures are drawn from the program's traces at every event.
docs/gallery/gallery.toml groups the scenarios and defines the pictures. --check writes nothing. It fails if a page or a
picture is not up to date.
"""
import csv
import io
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import tomllib

from svg_panels import drawing

ROOT = pathlib.Path(__file__).resolve().parents[1]
GALLERY, SCENARIOS = ROOT / "docs/gallery", ROOT / "data/scenarios"
UNITS = {"ms": 1e3, "us": 1e6, "s": 1.0}


def run(program, words):
    return subprocess.run([program, "run", *words], cwd=ROOT, text=True, check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=60)


def trace(program, name, columns, extra):
    """The columns of a run at every event: {column: [values]}."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "trace.csv"
        words = ", ".join(f'"{column}"' for column in columns)
        settings = [w for s in [f"record.columns=[{words}]", "record.events=true", *extra] for w in ("--set", s)]
        done = run(program, [f"data/scenarios/{name}.toml", "--quiet", "--csv", file, *settings])
        assert file.is_file(), done.stdout
        lines = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
    return {column: [float(row[column]) for row in rows] for column in ["t_s", *columns]}


def picture(program, section):
    unit, names = section["time"], [scenario["file"] for scenario in section["scenario"]]
    scale, span = UNITS[unit], section["span"]
    def of(curve):
        return names[curve.get("of", 0)], *curve.get("set", [])
    asked = sorted({(of(curve), curve["column"]) for p in section["panel"] for curve in p["curve"]})
    traces = {key: trace(program, key[0], [c for k, c in asked if k == key], [*section.get("set", []), *key[1:]])
              for key in sorted({k for k, _ in asked})}
    panels = []
    for p in section["panel"]:
        curves = []
        for curve in p["curve"]:
            columns = traces[of(curve)]
            points = [(t * scale, value * p.get("factor", 1)) for t, value in zip(columns["t_s"], columns[curve["column"]])
                      if span[0] <= t * scale <= span[1]]
            curves.append((curve["label"], points, curve.get("dashed", False)))
        panels.append({"title": p["title"], "curves": curves})
    return drawing(section["alt"], panels, span, f"time in {unit}")


def section_text(program, section):
    out = [f"## {section['title']}", ""]
    if "text" in section:
        out += [section["text"].strip(), ""]
    if "panel" in section:
        out += [f"![{section['alt']}](pictures/{section['picture']}.svg)", ""]
    for scenario in section["scenario"]:
        file = f"data/scenarios/{scenario['file']}.toml"
        words = tomllib.loads((ROOT / file).read_text(encoding="utf-8"))
        command = " ".join(["./run run", file, *scenario.get("options", [])])
        done = run(program, [file, *scenario.get("options", [])])
        assert done.returncode == scenario.get("exit", 0), done.stdout
        out += [f"**[{words['title']}](../../{file})**", "", *textwrap.wrap(words["notes"], 118, break_on_hyphens=False), "",
                "```console", f"$ {command}", done.stdout.rstrip("\n"), "```", ""]
    return out


def anchor(title):
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def page_text(program, page, following):
    """A page of the gallery: its question, links to its sections, the sections."""
    links = [f"- [{section['title']}](#{anchor(section['title'])})" for section in page["section"]]
    text = [f"# {page['title']}", "", page["question"], "", *links, ""]
    for section in page["section"]:
        text += section_text(program, section)
    after = f"[{following['title']}]({following['name']}.md), " if following else ""
    return "\n".join([*text, f"Next: {after}[all pages of the gallery](README.md).", ""])


def index(plan):
    text = [plan["head"].strip(), ""]
    for page in plan["page"]:
        text += [f"## {page['title']}", "", f"[{page['question']}]({page['name']}.md)", ""]
        text += [f"- [{section['title']}]({page['name']}.md#{anchor(section['title'])})" for section in page["section"]] + [""]
    return "\n".join([*text, "Next: [tour](../start/tour.md), [questions](../faq.md), [manual](../README.md).", ""])


def pages(program):
    """All files of the gallery: {path: text}."""
    plan = tomllib.loads((GALLERY / "gallery.toml").read_text(encoding="utf-8"))
    files = {GALLERY / "README.md": index(plan)}
    for page, following in zip(plan["page"], [*plan["page"][1:], None]):
        files[GALLERY / f"{page['name']}.md"] = page_text(program, page, following)
        for section in page["section"]:
            if "panel" in section:
                files[GALLERY / "pictures" / f"{section['picture']}.svg"] = picture(program, section)
    shown = {scenario["file"] for page in plan["page"] for section in page["section"] for scenario in section["scenario"]}
    for file in sorted((SCENARIOS / "gallery").glob("*.toml")):
        assert f"gallery/{file.stem}" in shown, f"docs/gallery/gallery.toml does not show {file.stem}"
    return files


def main(words):
    check = "--check" in words
    program = pathlib.Path(next((w for w in words if w != "--check"), ROOT / "build/release/sixstep")).resolve()
    made, stale = pages(program), []
    extra = {*GALLERY.glob("*.md"), *(GALLERY / "pictures").glob("*.svg")} - set(made)
    for path, text in made.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path)
            if not check:
                path.parent.mkdir(exist_ok=True)
                path.write_text(text, encoding="utf-8")
    if not check:
        for path in extra:
            path.unlink()
    elif stale or extra:
        names = ", ".join(str(path.relative_to(ROOT)) for path in [*stale, *sorted(extra)])
        raise SystemExit(f"not up to date: {names}; write them with tools/gallery.py PROGRAM")


if __name__ == "__main__":
    main(sys.argv[1:])
