#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program during its work: an interruption, a full disk, a terminal, and changes of its input files."""
import fcntl
import json
import os
import pty
import re
import resource
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

from program import PROGRAM, SHORT, SOURCE, Started

R3 = str(SOURCE / "data/scenarios/reference/R3.toml")
ALL = {"--csv": "a.csv", "--mat": "a.mat", "--mat73": "h.mat", "--vcd": "a.vcd", "--json": "a.json", "--html": "a.html"}
PARTIAL = ["a.partial.csv", "a.partial.html", "a.partial.json", "a.partial.mat", "a.partial.vcd", "h.partial.mat"]
LONG = ["--set", "duration_s=1e4", "--set", "record.grid_s=1e-3"]


class Session(Started):
    def check_index(self, folder, *unfinished):
        """Checks the index of a folder in which `quick` was finished and passed. The experiments in `unfinished` were
        not finished."""
        page = (self.path / folder / "index.partial.html").read_text()
        self.assertIn(f"1 of {1 + len(unfinished)} experiments are finished, 1 of these pass", page)
        self.assertIn('<p class="word">INCOMPLETE</p>', page)
        self.assertIn('<h2><a href="quick.html">quick</a></h2>', page)
        for line in unfinished:
            self.assertRegex(page, line)
        for name in re.findall('<a href="([^"#][^"]*)"', page):
            self.assertTrue((self.path / folder / name).exists(), name)


class Interruption(Session):
    def interrupted(self, sent, *words):
        with self.started("run", self.write("a.toml", 1000), *words, *LONG) as program:
            outputs = sum(word in ALL for word in words)
            self.wait_until(lambda: len(self.names()) >= 1 + outputs)  # all are open before the run begins
            time.sleep(0.2)
            program.send_signal(sent)
            told = program.communicate(timeout=20)[1]
        return program.returncode, told

    def test_each_format_leaves_what_is_finished(self):
        code, told = self.interrupted(signal.SIGINT, *[word for pair in ALL.items() for word in pair])
        self.assertEqual(code, 130)
        self.assertEqual(self.names(), sorted(PARTIAL + ["a.toml"]))
        summary = json.loads((self.path / "a.partial.json").read_text())
        self.assertFalse(summary["complete"])
        at = summary["simulated_s"]
        self.assertRegex(told, rf"a: interrupted at {at:.6g} s of 10000 s; the finished part is in a\.partial\.csv, a\.partial\.mat, "
                               r"h\.partial\.mat, a\.partial\.vcd, a\.partial\.json, a\.partial\.html\n")
        lines = (self.path / "a.partial.csv").read_text().splitlines()
        self.assertEqual(len(lines[-1].split(",")), len(lines[3].split(",")), "the last row is whole")
        self.assertAlmostEqual(float(lines[-1].split(",")[0]), at, delta=1e-3)  # rows stand 1 ms apart
        end = (self.path / "a.partial.vcd").read_text().splitlines()[-1]
        self.assertAlmostEqual(int(end[1:]), at * 1e12, delta=1)  # whole picoseconds
        self.assertIn("<b>Interrupted</b> at", (self.path / "a.partial.html").read_text())
        for name in ("a.partial.mat", "h.partial.mat"):
            self.assertGreater((self.path / name).stat().st_size, 8 * (len(lines) - 4))

    def test_sigterm_does_the_same_by_its_own_code(self):
        self.assertEqual(self.interrupted(signal.SIGTERM, "--csv", "a.csv")[0], 143)
        self.assertEqual(self.names(), ["a.partial.csv", "a.toml"])

    def test_a_second_ctrl_c_ends_at_once(self):
        # A full standard output blocks the program at its last message. Thus it cannot react to the first signal.
        ours, full = os.pipe()
        os.write(full, bytes(fcntl.fcntl(full, fcntl.F_SETPIPE_SZ, 4096)))
        with self.started("run", self.write("a.toml", 1000), "--csv", "a.csv", stdout=full) as program:
            self.wait_until(lambda: (self.path / "a.csv").exists())
            time.sleep(0.2)
            program.send_signal(signal.SIGINT)
            time.sleep(0.2)
            self.assertIsNone(program.poll())
            program.send_signal(signal.SIGINT)
            self.assertEqual(program.wait(timeout=20), -signal.SIGINT)
        os.close(ours), os.close(full)

    def test_ctrl_c_ends_the_waiting_for_the_other_end_of_a_pipe(self):
        """The program waits for the other end of a pipe: for a scenario, for a reader of its output, or for space in
        the pipe. Once it ignored Ctrl-C in each of these cases."""
        os.mkfifo(self.path / "pipe")
        self.write("a.toml", 1000)
        reader = None
        for words in (["pipe"], ["a.toml", "--csv", "pipe"], ["a.toml", *LONG, "--csv", "pipe"]):
            if "--set" in words:
                reader = os.open(self.path / "pipe", os.O_RDONLY | os.O_NONBLOCK)
            with self.subTest(words), self.started("run", *words) as program:
                time.sleep(0.5)
                self.assertIsNone(program.poll(), "it waits")
                program.send_signal(signal.SIGINT)
                told = program.communicate(timeout=20)[1]
                self.assertEqual(program.returncode, 130)
                self.assertNotIn("cannot be", told)
        os.close(reader)
        self.assertEqual(self.names(), ["a.toml", "pipe"])

    def test_a_scenario_through_a_pipe_is_read_once(self):
        """The report contains the text of the scenario. Once the program waited until the text was written into the
        pipe a second time."""
        os.mkfifo(self.path / "pipe")
        text = SHORT.format(limit=1000)
        with self.started("run", "pipe", "--html", "a.html") as program:
            (self.path / "pipe").write_text(text)
            self.assertEqual(program.wait(timeout=20), 0)
        self.assertIn("max = 1000", (self.path / "a.html").read_text())
        again = subprocess.run(["bash", "-c", f"{PROGRAM} run <(cat) --html b.html"], cwd=self.path, input=text, text=True, capture_output=True, timeout=20)
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertIn("max = 1000", (self.path / "b.html").read_text())

    def test_files_of_finished_runs_stay_whole_and_an_index_lists_them(self):
        (self.path / "quick.toml").write_text(SHORT.format(limit=1000))
        slow = SHORT.format(limit=1000).replace("1e-4", "1e4") + "[record]\ngrid_s = 1e-3\n"
        for name in ("slow", "waiting"):
            (self.path / f"{name}.toml").write_text(slow)
        for sent, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            with self.subTest(sent), self.started("run", "quick.toml", "slow.toml", "waiting.toml", "--jobs", "1", "--out", f"out{code}") as program:
                self.wait_until(lambda: (self.path / f"out{code}/quick.html").exists())
                time.sleep(0.1)
                program.send_signal(sent)
                told = program.communicate(timeout=20)[1]
            self.assertEqual(program.returncode, code)
            self.assertIn("slow: interrupted at", told)
            self.assertEqual(told.splitlines()[-1], f"1 of 3 experiments finished; out{code}/index.partial.html lists them")
            self.assertEqual(self.names(f"out{code}"), ["index.partial.html", "quick.csv", "quick.html", "quick.json",
                                                        "slow.partial.csv", "slow.partial.html", "slow.partial.json"])
            self.check_index(f"out{code}", r"slow.partial.html\">slow</a>: cut short at [\d.]+\s\w?s</li>", "<li>waiting: without a result</li>")


class FullDisk(Session):
    def test_a_file_that_can_grow_no_more_leaves_its_whole_rows(self):
        """A limit on the file size replaces a full disk: the same call fails at the same place."""
        limit = 1_000_000
        words = ["run", R3, "--quiet", "--set", "duration_s=10", "--set", "record.grid_s=1e-5"]
        for option, name in list(ALL.items())[:4]:
            with self.subTest(option):
                shrink = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
                with self.started(*words, option, name, preexec_fn=shrink) as program:
                    told = program.communicate(timeout=20)[1]
                self.assertEqual(program.returncode, 2)
                partial = name.replace(".", ".partial.")
                self.assertTrue(told.startswith(
                    f"{name}: cannot be written: File too large; the finished part is in {partial}; free disk space and run again\n"), told)
                self.assertRegex(told, r"R3: stopped at [\d.]+ s of 10 s\n$")
                self.assertEqual(self.names(), [partial])
                written = self.path / partial
                self.assertGreater(written.stat().st_size, limit / 2)
                if option in ("--csv", "--vcd"):
                    self.assertTrue(written.read_text().endswith("\n"))
                written.unlink()

    def test_an_index_lists_what_was_finished_before_the_disk_was_full(self):
        (self.path / "quick.toml").write_text(SHORT.format(limit=1000))
        (self.path / "slow.toml").write_text(SHORT.format(limit=1000).replace("1e-4", "10") + "[record]\ngrid_s = 1e-5\n")
        shrink = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4_000_000, 4_000_000))
        with self.started("run", "quick.toml", "slow.toml", "--quiet", "--out", "out", preexec_fn=shrink) as program:
            told = program.communicate(timeout=20)[1]
        self.assertEqual(program.returncode, 2)
        self.assertEqual(told.splitlines()[-1], "1 of 2 experiments finished; out/index.partial.html lists them")
        self.check_index("out", "slow.partial.html\">slow</a>: cut short at ")

    def test_what_is_told_of_a_device_that_is_full(self):
        told = self.run_program("run", self.write("a.toml", 1000), "--quiet", "--csv", "/dev/full", code=2).stderr
        self.assertIn("/dev/full: cannot be written: No space left on device", told)


class Terminal(Session):
    def read(self, terminal):
        try:
            return os.read(terminal, 1 << 16) if select.select([terminal], [], [], 0.05)[0] else b""
        except OSError:  # its other end is closed
            return b""

    def screen(self, *words, columns=100, seconds=20, until="left", **environment):
        """The output on a terminal. Ctrl-C is sent as soon as `until` is printed, or after `seconds`."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 25, columns, 0, 0))
        seen = b""
        with self.started(*words, stdout=subprocess.DEVNULL, stderr=theirs, text=False,
                          env={**os.environ, "TERM": "xterm", **environment}) as program:
            os.close(theirs)
            end = time.monotonic() + seconds
            while until not in seen.decode() and time.monotonic() < end and program.poll() is None:
                seen += self.read(ours)
            program.send_signal(signal.SIGINT)
            program.wait(timeout=20)
            while more := self.read(ours):
                seen += more
        os.close(ours)
        return seen.decode()

    def bar(self, runs, total):
        return rf"\r\[[#-]+\] +\d+ %  [\d:]+ left  {runs}[\d.e+-]+ of {total} s simulated  [\d.e+-]+ x real time\x1b\[K"

    def test_one_long_run_shows_how_far_it_is(self):
        a = self.write("a.toml", 1000)
        seen = self.screen("run", a, *LONG, "--csv", "a.csv")
        self.assertRegex(seen, self.bar("", r"1e\+04"))
        self.assertRegex(seen, r"\r\x1b\[K[^\r]*a: interrupted at", "the bar is gone before a word is said")
        for line in self.screen("run", a, *LONG, columns=40, until="left").split("\r"):
            self.assertLess(len(line.replace("\x1b[K", "")), 100 if "interrupted" in line else 40)
        self.assertEqual(self.screen("run", a, *LONG, "--quiet", seconds=0.8).count("\r\x1b"), 0)
        self.assertNotIn("real time", self.screen("run", a, *LONG, seconds=0.8, TERM="dumb"))

    def test_many_files_share_one_line(self):
        for name in ("a", "b", "c"):
            (self.path / f"{name}.toml").write_text(SHORT.format(limit=1000).replace("1e-4", "1e4") + "[record]\ngrid_s = 1e-3\n")
        self.assertRegex(self.screen("run", "a.toml", "b.toml", "c.toml", "--jobs", "1"),
                         self.bar("0 of 3 runs  ", r"3e\+04"))

    def test_a_series_counts_its_drives(self):
        spread = '[[spread]]\nkey = "motor_override.resistance_ohm"\nrelative = 0.1\n'
        (self.path / "a.toml").write_text(SHORT.format(limit=1000).replace("1e-4", "20e-3") + spread)
        self.assertRegex(self.screen("run", "a.toml", "--runs", "1000000000"), r"[\d:]+ left  \d+ of 1000000000 drives")

    def test_a_curve_counts_its_points_and_a_design_its_motors(self):
        many = ["curve", "maxon-251601", "--points", "200000"]
        self.assertRegex(self.screen(*many), r"[\d:]+ left  \d+ of 2000\d\d points")
        ended = "curve maxon-251601: interrupted; nothing was written"
        self.assertEqual(self.screen(*many, "--quiet", seconds=0.8), ended + "\r\n")
        with self.started(*many) as program:
            time.sleep(0.7)
            program.send_signal(signal.SIGINT)
            self.assertEqual(program.communicate(timeout=20), ("", ended + "\n"), "nothing of the bar reaches a pipe")
        slow = ["design", "maxon-251601", "--mode", "speed", "--settle", "1", "--jobs", "1"]
        self.assertRegex(self.screen(*slow, until="motors"), r"\d+ of \d+ motors")


class Watching(Session):
    def test_each_save_shows_the_verdict_again_until_ctrl_c(self):
        shipped = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "own.toml").write_text(shipped)
        text = SHORT.replace('"maxon-251601"', '"own.toml"')
        scenario = self.path / "a.toml"
        scenario.write_text(text.format(limit=1000))
        out = (self.path / "out.txt").open("w+")
        said = lambda: (self.path / "out.txt").read_text()
        with self.started("run", "a.toml", "--watch", stdout=out, stderr=subprocess.STDOUT) as program:
            pauses = lambda: said().count("-- runs again when a file is saved; Ctrl-C ends\n")
            self.wait_until(lambda: pauses() == 1)
            self.assertIn("1 experiment: the requirement holds", said())
            scenario.write_text(text.format(limit=-1))  # saved in place
            self.wait_until(lambda: pauses() == 2)
            self.assertIn("FAILED", said().split("-- runs")[1])
            scenario.write_text("motor = ")  # a typing error
            self.wait_until(lambda: pauses() == 3)
            self.assertIn("a.toml:1:", said().split("-- runs")[2])
            (self.path / "new").write_text(text.format(limit=1000))  # vim and many other editors save in this way
            os.replace(self.path / "new", scenario)
            self.wait_until(lambda: pauses() == 4)
            (self.path / "own.toml").write_text(shipped + "\n# changed\n")  # the motor's file counts too
            self.wait_until(lambda: pauses() == 5)
            time.sleep(0.5)
            self.assertEqual(pauses(), 5, "nothing saved, nothing run")
            program.send_signal(signal.SIGINT)
            self.assertEqual(program.wait(timeout=20), 0, "that of the last verdict")
        out.close()


if __name__ == "__main__":
    unittest.main()
