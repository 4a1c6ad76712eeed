#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Hostile titles, labels, keys and file names in every verb and every file. No name acts as a command or as markup,
and every link leads to its file."""
import html.parser
import json
import os
import re
import subprocess
import tempfile
import tomllib
import unittest
import urllib.parse

from hostile import FILES, TEXTS, is_visible
from program import BRISK, PROGRAM, SHORT, SOURCE, ProgramTest, hall_log

if os.path.isdir("/dev/shm"):  # a file system in memory, because the test writes hundreds of files, each synchronised to its disk
    tempfile.tempdir = "/dev/shm"
UTF8 = [text.decode() for text in TEXTS if text == text.decode(errors="ignore").encode()]
quoted = lambda text: json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")  # a TOML string
REQUIRE = '[[require]]\nmetric = "final"\nsignal = "current"\nlabel = {}\nmax = {}\n'


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.tags, self.attributes, self.links, self.text = [], set(), [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes |= {name for name, _ in attributes}
        self.links += [value for name, value in attributes if name == "href"]

    def handle_data(self, data):
        self.text += data


class Hostile(ProgramTest):
    def run_bytes(self, *words, codes=(0,)):
        result = subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, timeout=60)
        self.assertIn(result.returncode, codes, result.stderr)
        return result

    def check_shown(self, shown):
        """Checks that every line is visible text."""
        for line in shown.split(b"\n"):
            self.assertTrue(is_visible(line), line)

    def scenario(self, texts, name="a.toml"):
        """Writes a scenario that has the given texts in every place where a scenario accepts a text."""
        title, *labels = [quoted(text) for text in texts]
        rows = "".join(REQUIRE.format(label, limit) for label in labels for limit in (1000, -1))
        compare = f'[[compare]]\nmetric = "final"\nsignal = "current"\nvalue = 1\nlabel = {title}\nsource = {labels[0]}\n'
        (self.path / name).write_text(f"title = {title}\nnotes = {title}\n" + SHORT.format(limit=1000) + rows + compare)
        return name

    def test_labels_on_a_terminal_fake_no_line_and_move_no_cursor(self):
        plain = self.run_bytes("run", self.scenario([f"text {n}" for n in range(len(UTF8))]), codes=[1])
        hostile = self.run_bytes("run", self.scenario(UTF8), codes=[1])
        self.check_shown(hostile.stdout + hostile.stderr)
        self.assertEqual(hostile.stdout.count(b"\n"), plain.stdout.count(b"\n"))
        for words in (["--json", "-"], ["--csv", "/dev/stdout"], ["--vcd", "/dev/stdout"], ["--html", "/dev/stdout"]):
            self.check_shown(self.run_bytes("run", "a.toml", *words, codes=[1]).stdout.replace(b"\t", b"").replace(b"\r\n", b""))
        told = json.loads(self.run_bytes("run", "a.toml", "--json", "-", codes=[1]).stdout)
        self.assertEqual(told["title"], UTF8[0])
        self.assertEqual([row["figure"] for row in told["require"]][1::2], UTF8[1:])

    def test_a_page_holds_names_as_text(self):
        def page(texts):
            self.run_bytes("run", self.scenario(texts), "--html", "a.html", codes=[1])
            return Page((self.path / "a.html").read_text())
        plain, hostile = page([f"text {n}" for n in range(len(UTF8))]), page(UTF8)
        self.assertEqual(hostile.tags, plain.tags)
        self.assertEqual(hostile.attributes, plain.attributes)
        self.assertEqual(hostile.links, plain.links)
        for text in UTF8:
            if is_visible(text.encode()):
                self.assertIn(" ".join(text.split()), " ".join(hostile.text.split()))

    def test_an_index_links_every_report_whatever_its_name(self):
        for name in FILES:
            with open(os.path.join(os.fsencode(self.path), name + b".toml"), "w") as file:
                file.write(SHORT.format(limit=1000))
        names = [b"./" + name + b".toml" for name in FILES]
        shown = self.run_bytes("run", *names, "--out", "out")
        self.check_shown(shown.stdout + shown.stderr)
        self.assertEqual(len(shown.stdout.splitlines()), 2 * len(FILES) + 2, "a heading, a name, a verdict, a sum")
        page = Page((self.path / "out/index.html").read_text())
        self.assertEqual(page.tags.count("script"), 0)
        links = [link for link in page.links if link != "data:," and not link.startswith("#")]
        self.assertEqual(len(links), len(FILES))
        for link, name in zip(links, FILES):
            parts = urllib.parse.urlsplit(link)
            self.assertEqual((parts.scheme, parts.netloc, parts.query, parts.fragment), ("", "", "", ""), link)
            self.assertEqual(urllib.parse.unquote_to_bytes(parts.path), name + b".html")
            self.assertTrue(os.path.exists(os.path.join(os.fsencode(self.path), b"out", name + b".html")))

    def test_a_file_says_by_which_command_it_was_made_and_bash_makes_it_again(self):
        os.makedirs(self.path / "bin")
        os.symlink(PROGRAM, self.path / "bin/sixstep")
        for name in FILES:
            with open(os.path.join(os.fsencode(self.path), b"a.toml"), "w") as file:
                file.write(SHORT.format(limit=1000))
            out = b"./" + name + b".csv"
            self.run_bytes("run", "a.toml", "--quiet", "--csv", out)
            with open(os.path.join(os.fsencode(self.path), out), "rb") as file:
                lines = file.read()
            command = lines.split(b"\n")[2].removeprefix(b"# command: ")
            os.unlink(os.path.join(os.fsencode(self.path), out))
            environment = dict(os.environ, PATH=f"{self.path / 'bin'}:{os.environ['PATH']}")
            subprocess.run([b"bash", b"-c", command], cwd=self.path, env=environment, check=True, timeout=60)
            with open(os.path.join(os.fsencode(self.path), out), "rb") as file:
                self.assertEqual(file.read(), lines, command)
            os.unlink(os.path.join(os.fsencode(self.path), out))
            self.assertEqual(self.names(), ["a.toml", "bin"], "and does nothing else")

    def test_complaints_show_what_they_name(self):
        for name in FILES:
            for words in (["run", b"./" + name], ["help", b"x" + name], [b"x" + name], ["motor", "show", b"x" + name],
                          ["run", "absent.toml", b"--set=" + name], ["run", "absent.toml", b"--x" + name], ["new", "--mode", b"x" + name]):
                shown = self.run_bytes(*words, codes=[2])
                self.check_shown(shown.stdout + shown.stderr)
                self.assertEqual(shown.stderr.count(b"\n"), 1, shown.stderr)
        for text in UTF8:
            key = quoted(text)
            (self.path / "a.toml").write_text(SHORT.format(limit=1000) + f"[{key}]\n{key} = {key}\n")
            shown = self.run_bytes("run", "a.toml", codes=[2])
            self.check_shown(shown.stderr)
            self.assertEqual(shown.stderr.count(b"\n"), 1, shown.stderr)

    def test_a_motors_sheet_is_shown_harmless_everywhere(self):
        for text in UTF8:
            value = quoted(text)
            (self.path / "own.toml").write_text(re.sub(r'(?m)^(name|maker) = .*|(?<=source = )"[^"]*"',
                                                       lambda m: f"{m[1]} = {value}" if m[1] else value, BRISK))
            for words in (["motor", "show", "own"], ["motor", "check", "own"], ["motor", "show", "own", "--json"]):
                shown = self.run_bytes(*words)
                self.check_shown(shown.stdout + shown.stderr)
            plain = self.run_bytes("motor", "show", "maxon-251601").stdout.count(b"\n")
            self.assertEqual(self.run_bytes("motor", "show", "own").stdout.count(b"\n"), plain)
        for words in (["motor", "commission", "own"], ["motor", "commission", "own", "--html", "/dev/stdout", "--quiet"], ["motor", "wiring", "own", "--current", "15"],
                      ["motor", "wiring", "own", "--current", "15", "--svg", "/dev/stdout", "--quiet"], ["curve", "own", "--points", "2"], ["curve", "own", "--points", "2", "--json", "-"], ["curve", "own", "--points", "2", "--csv", "/dev/stdout"],
                      ["design", "own", "--quick"], ["design", "own", "--quick", "--toml", "/dev/stdout", "--quiet"]):
            shown = self.run_bytes(*words)
            self.check_shown(shown.stdout + shown.stderr)

    def test_a_recording_of_any_name_and_headings_is_shown_harmless(self):
        scope = (SOURCE / "data/recordings/bly172s-emf.csv").read_bytes().partition(b"time [s],u_ab [V]\n")[2]
        scope = b"".join(scope.splitlines(True)[::10])
        for name in FILES:
            path = b"./" + name + b".csv"
            with open(os.path.join(os.fsencode(self.path), path), "wb") as file:
                file.write(hall_log(turns=6).encode())
            for words in (["identify", path, "--html", "/dev/stdout"], ["identify", path, "--json", "--write", "/dev/stdout"]):
                self.check_shown(self.run_bytes("motor", *words).stdout)
            shown = self.run_bytes("motor", "identify", path, b"--hall=" + name, codes=[2])
            self.check_shown(shown.stderr)
            self.assertEqual(shown.stderr.count(b"\n"), 1, shown.stderr)
            shown = self.run_bytes("motor", "emf", path, codes=[2])
            self.check_shown(shown.stderr)
            os.unlink(os.path.join(os.fsencode(self.path), path))
        for text in TEXTS:
            heading = text.replace(b"\n", b" ").replace(b"\r", b" ").replace(b",", b" ").replace(b";", b" ").replace(b"\t", b" ")
            with open(self.path / "a.csv", "wb") as file:
                file.write(b"time [s],x" + heading + b" [V]\n" + scope)
            for words in (["--html", "/dev/stdout"], ["--json", "--write", "/dev/stdout"]):
                self.check_shown(self.run_bytes("motor", "emf", "a.csv", "--between", "lines", "--pole-pairs", "4", *words).stdout)
            for words in (["emf", "a.csv"], ["identify", "a.csv"]):
                shown = self.run_bytes("motor", *words, codes=[2])
                self.check_shown(shown.stderr)
                self.assertEqual(shown.stderr.count(b"\n"), 1, shown.stderr)

    def test_an_exported_header_compiles_without_a_word(self):
        base = (SOURCE / "data/scenarios/current-square.toml").read_text()
        comments = b""
        for text in UTF8:
            (self.path / "a.toml").write_text(re.sub("(?m)^title = .*", lambda m: f"title = {quoted(text)}", base))
            header = self.run_bytes("export", "header", "a.toml", b"--despite=" + text.encode(), b"--set=notes=" + quoted(text).encode()).stdout
            self.check_shown(header)
            comments += header.split(b"#pragma")[0]
        lines = comments.splitlines()
        self.assertGreater(len(lines), 5 * len(UTF8))
        self.assertEqual([line for line in lines if not line.startswith(b"//")], [])
        # Every comment must end with its line. The line after it must be code.
        result = subprocess.run(["g++", "-std=c++20", "-trigraphs", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-E", "-"],
                                input=b"".join(line + b"\nx\n" for line in lines), capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(result.stdout.count(b"\nx"), len(lines))

    def test_a_new_file_of_any_name_is_a_good_one(self):
        for name in FILES:
            path = b"./" + name + b".toml"
            shown = self.run_bytes("motor", "new", path)
            self.check_shown(shown.stdout)
            with open(os.path.join(os.fsencode(self.path), path), "rb") as file:
                self.assertEqual(tomllib.loads(file.read().decode())["name"].encode().replace("\ufffd".encode(), b""),
                                 name.decode(errors="ignore").encode())
            os.unlink(os.path.join(os.fsencode(self.path), path))
            shown = self.run_bytes("new", path, "--mode", "duty")
            self.check_shown(shown.stdout)
            self.assertEqual(shown.stdout.count(b"\n"), 2)
            self.run_bytes("run", path, "--quiet")


if __name__ == "__main__":
    unittest.main()
