#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""debian_changelog.py MAINTAINER: prints CHANGELOG.md in the format of Debian's tools.

Each line of a release that begins with "- " becomes a change; MAINTAINER is "name <address>".
"""
import datetime
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
RELEASE = re.compile(r"^## \[(?P<version>[0-9.]+)\] - (?P<date>\d{4}-\d\d-\d\d)\n(?P<text>.*?)(?=^## |^\[|\Z)", re.M | re.S)
DAYS, MONTHS = "Mon Tue Wed Thu Fri Sat Sun".split(), "Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split()


def plain(markdown: str) -> str:
    """The text without the marks of links and code."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "").replace("**", "")


def debian_changelog(markdown: str, maintainer: str) -> str:
    entries = []
    for release in RELEASE.finditer(markdown):
        changes = [" ".join(change.split()) for change in re.findall(r"^- (.*(?:\n  .*)*)", release["text"], re.M)]
        lines = [textwrap.fill(plain(change), 78, initial_indent="  * ", subsequent_indent="    ") for change in changes]
        day = datetime.date.fromisoformat(release["date"])
        when = f"{DAYS[day.weekday()]}, {day.day:02} {MONTHS[day.month - 1]} {day.year} 12:00:00 +0000"
        entries.append(f"sixstep ({release['version']}) unstable; urgency=medium\n\n" + "\n".join(lines) + f"\n\n -- {maintainer}  {when}\n")
    return "\n".join(entries)


if __name__ == "__main__":
    sys.stdout.write(debian_changelog((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), sys.argv[1]))
