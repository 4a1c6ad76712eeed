#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""motors_md_test.py PROGRAM [--renew]: what docs/motors.md shows is what the program says; --renew writes it anew."""
import pathlib
import re
import subprocess
import sys
import tempfile

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "motors.md"


def answered(text, program):
    """The page with the program's answers to its commands."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in re.findall(r"<!-- file: (\S+) -->\n```toml\n(.*?)```", text, re.S):
            (pathlib.Path(folder) / name).write_text(content, encoding="utf-8")

        def run(match):
            words = match[1].split()
            assert words[0] == "sixstep", words
            done = subprocess.run([program, *words[1:]], cwd=folder, capture_output=True, text=True, check=False)
            assert done.returncode in (0, 1, 2), done
            return f"```console\n$ {match[1]}\n{done.stdout}{done.stderr}```"

        return re.sub(r"```console\n\$ ([^\n]*)\n.*?```", run, text, flags=re.S)


def main(words):
    program = pathlib.Path(words[0]).resolve()
    text = PAGE.read_text(encoding="utf-8")
    assert text.count("```console") >= 4, "the page shows no commands"
    now = answered(text, program)
    if "--renew" in words:
        PAGE.write_text(now, encoding="utf-8")
    elif now != text:
        raise SystemExit("docs/motors.md is not what the program says; tests/docs/motors_md_test.py PROGRAM --renew renews it")


if __name__ == "__main__":
    main(sys.argv[1:])
