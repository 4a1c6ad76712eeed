#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The files of a run, read by the programs of their users: numpy, scipy, h5py, a reader of value change dumps, and a
validator of JSON Schema. octave_test.py does the same with Octave."""
import collections
import json
import pathlib
import re
import shlex
import subprocess
import unittest

import h5py
import jsonschema
import numpy
import scipy.io

from program import PROGRAM, SOURCE, ProgramTest

PS = 1e12


def scenario(name):
    return str(SOURCE / f"data/scenarios/{name}.toml")


def read_csv(path):
    """Reads a CSV file as docs/reference/results.md describes it: three lines of comment, the names, the numbers."""
    return numpy.genfromtxt(path, delimiter=",", names=True, skip_header=3)


class Dump:
    """A value change dump. Each signal has its (ps, value) pairs in order. A value is an int, or None for x."""

    def __init__(self, path):
        self.changes, self.kinds, self.end = collections.defaultdict(list), {}, 0
        names, scopes = {}, []
        head, body = pathlib.Path(path).read_text().split("$enddefinitions $end\n")
        for words in map(str.split, head.splitlines()):
            if words[0] == "$timescale":
                self.timescale = " ".join(words[1:-1])
            elif words[0] == "$scope":
                scopes.append(words[2])
            elif words[0] == "$upscope":
                scopes.pop()
            elif words[0] == "$var":
                names[words[3]] = ".".join([*scopes, words[4]])
                self.kinds[names[words[3]]] = words[1]
        assert not scopes, "every scope is closed"
        now = None
        for line in body.splitlines():
            if line.startswith("#"):
                then, now = now, int(line[1:])
                assert then is None or now > then, f"time goes back at {line}"
            elif line.startswith("b"):
                bits, code = line[1:].split()
                self.changes[names[code]].append((now, None if bits == "x" else int(bits, 2)))
            elif not line.startswith("$"):
                self.changes[names[line[1:]]].append((now, {"0": 0, "1": 1, "x": None}[line[0]]))
        self.end = now

    def times(self, name):
        return numpy.array([ps for ps, _ in self.changes[name]])

    def at(self, name, ps):
        """The values of a signal at the given instants, which must rise."""
        values = numpy.array([-1 if v is None else v for _, v in self.changes[name]])
        return values[numpy.searchsorted(self.times(name), ps, side="right") - 1]


class Tables(ProgramTest):
    def written(self, *words, code=0):
        self.run_program("run", *words, "--quiet", "--json", "s.json", code=code)
        return json.loads((self.path / "s.json").read_text())

    def test_csv_mat_5_and_mat_7_3_hold_the_same_numbers(self):
        title = "title=\"Müller \U0001f980\""
        s = self.written(scenario("thesis/7.3.2-motor-soft"), "--csv", "a.csv", "--mat", "a.mat", "--mat73", "h.mat",
                         "--set", "record.events=true", "--set", title)
        text = read_csv(self.path / "a.csv")
        five = scipy.io.loadmat(self.path / "a.mat", simplify_cells=True)
        names = text.dtype.names
        self.assertGreater(len(text), 2 * 2048, "more than two blocks of rows")
        self.assertEqual(names[:2], ("t_s", "i_a_A"))
        with h5py.File(self.path / "h.mat") as seven:
            chars = lambda group, key: seven[group][key][()].tobytes().decode("utf-16-le").strip("\0")
            for name in names:
                numpy.testing.assert_array_equal(five[name], text[name], err_msg=name)
                numpy.testing.assert_array_equal(seven[name][()].ravel(), text[name], err_msg=name)
                self.assertEqual(chars("units", name), five["units"][name])
            self.assertEqual(chars("sixstep", "title"), "Müller \ufffd")
            self.assertEqual(chars("sixstep", "digest"), s["digest"])
        self.assertEqual(five["units"]["speed_rad_s"], "rad/s")
        self.assertEqual(five["units"]["hall"], "1")
        self.assertEqual(five["meanings"]["i_a_A"], "current of phase a; phase, into the motor")
        self.assertEqual(five["sixstep"]["title"], "Müller \ufffd")  # MAT 5 does not define the sizes of characters beyond U+FFFF
        self.assertEqual(five["sixstep"]["digest"], s["digest"])
        self.assertIn("--mat a.mat", five["sixstep"]["command"])
        self.assertEqual(self.names(), ["a.csv", "a.mat", "h.mat", "s.json"])

    def test_a_trace_says_where_it_comes_from(self):
        def block(*words):
            self.run_program("run", *words, "--csv", "a.csv", "--quiet")
            return (self.path / "a.csv").read_text().splitlines()[:4]
        lines = block(self.write("a.toml", 1000))
        version = self.run_program("--version").stdout.strip()
        self.assertEqual(lines[0], f"# {version}")
        self.assertRegex(lines[1], "^# scenario: a.toml, digest [0-9a-f]{16}$")
        self.assertEqual(lines[2], "# command: sixstep run a.toml --csv a.csv --quiet")
        self.assertTrue(lines[3].startswith("t_s,"))
        digest = lambda lines: lines[1][-16:]
        self.assertEqual(digest(block(self.write("b.toml", 1000))), digest(lines), "contents count, not names")
        self.assertNotEqual(digest(block(self.write("a.toml", 1001))), digest(lines))
        self.assertNotEqual(digest(block("b.toml", "--set", "supply.voltage_V=12")), digest(lines))
        # A motor's file counts as part of the scenario.
        motor = self.run_program("motor", "new").stdout
        shipped = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        self.assertTrue(motor)
        (self.path / "own.toml").write_text(shipped)
        text = (self.path / "b.toml").read_text().replace('"maxon-251601"', '"own.toml"')
        (self.path / "b.toml").write_text(text)
        before = digest(block("b.toml"))
        (self.path / "own.toml").write_text("# looked at again\n" + shipped)
        self.assertNotEqual(digest(block("b.toml")), before)
        # A line end in a text would end the comment.
        self.assertEqual(block("b.toml", "--set", 'title="two\\nlines"', "--set", "notes='a\nb'")[3], lines[3])

    def test_a_pipe_takes_csv_and_both_mat_versions(self):
        self.write("a.toml", 1000)
        for option in ("--csv", "--mat", "--mat73"):
            words = [PROGRAM, "run", "a.toml", "--quiet", option]
            self.run_program(*words[1:], "/dev/null")
            piped = subprocess.run(f"{shlex.join([*words, '/dev/stdout'])} | cat", shell=True, cwd=self.path, capture_output=True, check=True).stdout
            self.run_program(*words[1:], "a.out", "--force")
            # The command is in the first part of a CSV file, or before the last part of a MAT file.
            told = lambda data: data[4096:] if option == "--csv" else data[-4096:]
            self.assertEqual(told(piped), told((self.path / "a.out").read_bytes()))
            if option == "--mat73":
                (self.path / "piped.h5").write_bytes(piped)
                with h5py.File(self.path / "piped.h5") as trace:
                    self.assertGreater(trace["t_s"].shape[1], 2)

    def test_mat_7_3_has_fields_in_their_order_behind_matlabs_own_block(self):
        self.run_program("run", self.write("a.toml", 1000), "--mat73", "h.mat", "--mat", "a.mat", "--quiet")
        five = scipy.io.loadmat(self.path / "a.mat", simplify_cells=True)
        with h5py.File(self.path / "h.mat") as seven:
            for name in ("sixstep", "units", "meanings"):
                fields = ["".join(letter.decode() for letter in field) for field in seven[name].attrs["MATLAB_fields"]]
                self.assertEqual(fields, list(five[name]))
            self.assertEqual(seven["t_s"].attrs["MATLAB_class"], b"double")
            self.assertEqual(seven.userblock_size, 512)

    def test_two_outputs_are_no_pair(self):
        self.write("a.toml", 1000)
        self.assertIn("is also the file of --csv", self.run_program("run", "a.toml", "--csv", "x.mat", "--mat", "x.mat", code=2).stderr)


class Waveforms(ProgramTest):
    def dumped(self, name, *words, code=0):
        self.run_program("run", scenario(name), "--vcd", "w.vcd", "--json", "s.json", "--quiet", *words, code=code)
        return Dump(self.path / "w.vcd"), json.loads((self.path / "s.json").read_text())

    def test_what_the_run_counted_is_in_the_dump(self):
        dump, s = self.dumped("thesis/7.3.2-motor-soft")
        self.assertEqual(dump.timescale, "1 ps")
        self.assertEqual(dump.end, round(s["simulated_s"] * PS))
        ticks = dump.times("board.timer.tick")
        self.assertEqual(len(ticks), s["events"]["control ticks"])
        numpy.testing.assert_array_equal(ticks, 30_000_000 * numpy.arange(len(ticks)))  # 30 us, to the picosecond
        self.assertEqual(dump.changes["board.timer.periods"][-1][1], len(ticks))
        self.assertEqual(len(dump.times("board.hall.sector")) - 1, s["events"]["sector edges"])
        armed = [v for _, v in dump.changes["board.comparators.comparator_1"] if v is not None]
        self.assertEqual(sum(a != b for a, b in zip(armed, armed[1:])), s["events"]["comparator switches"])
        self.assertEqual(dump.changes["board.comparators.comparator_2"], [(0, None)])  # no comparator is connected to the sink leg
        self.assertTrue(all(dump.changes[f"board.faults.{n}"] == [(0, 0)] for n in ("shoot_through", "over_current")))

    def test_gates_hall_lines_and_sector_are_those_of_the_recorded_events(self):
        dump, _ = self.dumped("reference/R3", "--csv", "a.csv", "--set", "record.events=true", "--set",
                              'record.columns=["gate_T1","gate_T2","gate_T3","gate_T4","gate_T5","gate_T6","hall","sector"]')
        rows = read_csv(self.path / "a.csv")
        # The signals are constant between two rows. Only rows that are more than 2 ps apart are used, because a time in seconds
        # is rounded.
        long = numpy.nonzero(numpy.diff(rows["t_s"]) > 2 / PS)[0] + 1
        middle = (rows["t_s"][long - 1] + rows["t_s"][long]) / 2 * PS
        for name in ("T1", "T2", "T3", "T4", "T5", "T6"):
            numpy.testing.assert_array_equal(dump.at(f"board.gates.{name}", middle), rows[f"gate_{name}"][long], name)
        hall = sum(dump.at(f"board.hall.H{n}", middle) << 3 - n for n in (1, 2, 3))
        numpy.testing.assert_array_equal(hall, rows["hall"][long])
        numpy.testing.assert_array_equal(dump.at("board.hall.sector", middle), rows["sector"][long])
        self.assertGreater(len(long), 500)

    def test_a_trip_rises_where_the_drive_latched_it(self):
        dump, s = self.dumped("product-broken-hall-line", code=3)
        self.assertEqual(dump.changes["board.faults.hall"], [(0, 0), (round(s["trip"]["at_s"] * PS), 1)])
        self.assertEqual(dump.at("board.timer.enabled", numpy.array([dump.end])), [0])
        self.assertTrue(all(dump.at(f"board.gates.T{n}", numpy.array([dump.end])) == [0] for n in range(1, 7)))


    def test_a_fault_that_ends_the_run_stands_at_its_end(self):
        turning = 'motor = "maxon-251601"\nduration_s = 0.2\ncontrol.mode = "duty"\nreference.value = 1\n'
        (self.path / "a.toml").write_text(turning + "sensors.hall_break = {at_s = 0.05, line = 2}\n")
        self.run_program("run", "a.toml", "--vcd", "w.vcd", "--quiet", code=3)
        dump = Dump(self.path / "w.vcd")
        self.assertEqual(dump.changes["board.faults.impossible_hall"], [(0, 0), (dump.end, 1)])
        lines = [dump.at(f"board.hall.H{n}", numpy.array([dump.end]))[0] for n in (1, 2, 3)]
        self.assertIn(lines, ([0, 0, 0], [1, 1, 1]))


class Page(ProgramTest):
    """The statements of docs/reference/results.md are true."""
    PAGE = (SOURCE / "docs/reference/results.md").read_text()

    def test_its_lines_of_python_read_the_files(self):
        self.run_program("run", scenario("reference/R1"), "--quiet", "--csv", "my.csv", "--mat", "my.mat", "--mat73", "my73.mat")
        lines = [line for block in re.findall(r"```python\n(.*?)```", self.PAGE, re.S) for line in block.splitlines()]
        self.assertEqual(len(lines), 3)
        currents = []
        for line in lines:
            names = {"numpy": numpy, "scipy": scipy, "h5py": h5py}
            exec(line.replace('"my.', f'"{self.path}/my.').replace('"my73', f'"{self.path}/my73'), names)
            currents.append(numpy.ravel(names["trace"]["i_a_A"][()]))
        self.assertGreater(len(currents[0]), 10)
        numpy.testing.assert_array_equal(currents[0], currents[1])
        numpy.testing.assert_array_equal(currents[0], currents[2])

    def test_its_csv_is_the_one_that_is_written(self):
        self.write("my.toml", 1000)
        self.run_program("run", "my.toml", "--csv", "my.csv")
        block = re.search(r"```\n(# sixstep.*?)```", self.PAGE, re.S).group(1).splitlines()
        digest = lambda line: re.sub("[0-9a-f]{16}", "-", line)
        lines = (self.path / "my.csv").read_text().splitlines()
        self.assertEqual([digest(line) for line in block[:3]], [digest(line) for line in lines[:3]])
        self.assertTrue(lines[3].startswith(block[3].removesuffix("...")))

    def test_its_options_and_signals_are_those_of_the_program(self):
        options = set(re.findall(r"^\| `(--\w+) F`", self.PAGE, re.M))
        told = self.run_program("run", "--help").stdout
        self.assertEqual(options, set(re.findall(r"^  (--\w+) TEXT .*\bwrite", told, re.M)))
        self.run_program("run", self.write("a.toml", 1000), "--vcd", "w.vcd", "--quiet")
        for name in Dump(self.path / "w.vcd").kinds:
            _, group, signal = name.split(".")
            self.assertIn(f"`{group}`", self.PAGE)


class Report(ProgramTest):
    def test_one_second_of_switching_stays_small_enough_to_send_and_whole(self):
        self.run_program("run", scenario("reference/R3"), "--set", "duration_s=1", "--quiet", "--html", "a.html")
        page = (self.path / "a.html").read_text()
        self.assertLess(len(page), 5_000_000)
        self.assertIn('"rows":[{"rows":', page, "every row is in it")


class Summary(ProgramTest):
    SCHEMA = json.loads((SOURCE / "docs/summary.schema.json").read_text())

    def test_every_kind_of_run_keeps_to_the_schema(self):
        jsonschema.Draft202012Validator.check_schema(self.SCHEMA)
        check = jsonschema.Draft202012Validator(self.SCHEMA)
        kinds = {"thesis/7.5-position": 0, "thesis/8a-exact-design": 0, "product-broken-hall-line": 3, "reference/R1": 0}
        for name, code in kinds.items():
            summary = json.loads(self.run_program("run", scenario(name), "--json", "-", code=code).stdout)
            check.validate(summary)
            self.assertTrue(summary["complete"])
        self.assertEqual([e.message for e in check.iter_errors({**summary, "more": 1})],
                         ["Additional properties are not allowed ('more' was unexpected)"])
        self.assertTrue(list(check.iter_errors({**summary, "passed": "yes"})))


if __name__ == "__main__":
    unittest.main()
