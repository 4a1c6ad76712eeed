#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep motor identify and sixstep motor emf: the program can read the files that they write. For a file that is no
recording, each prints one line and returns exit code 2."""
import json
import math
import re
import tomllib
import unittest

from program import SOURCE, Started

RECORDINGS = SOURCE / "data/recordings"
CODES = [0b100, 0b110, 0b010, 0b011, 0b001, 0b101]  # docs/reference/notation.md, forward
OWN_DEG = [3, -1, 2, -4, 1, -1]  # the delay of each edge in degrees
TURN_S = 0.05


def sector(deg, edges=(0,) * 6):
    """The sector that the Hall probes report. `edges` is the displacement of each edge in degrees."""
    turn, within = divmod(deg, 360)
    passed = sum(within >= 60 * n + edge for n, edge in enumerate(edges))
    return int(6 * turn + passed - 1)


def log(turns=12, rows=180, volts=True, edges=OWN_DEG, swapped=False, separator=",", comma=False):
    """The log of a steady turn, as text. One turn has 180.3 rows, so that the rows and the edges are not synchronous.
    u_ab is 30 degrees ahead of e_a."""
    lines = [["time [s]", "hall1", "hall2", "hall3"] + (["u_ab [V]", "u_bc [V]", "u_ca [V]"] if volts else [])]
    for row in range(int(turns * rows)):
        deg = 360 * row / (rows + 0.3)
        code = CODES[sector(deg, edges) % 6]
        bits = [code >> 2 & 1, code >> 1 & 1, code & 1]
        if swapped:
            bits[1], bits[2] = bits[2], bits[1]
        u = [1.5 * math.cos(math.radians(deg - 30 - 120 * k)) + 0.004 * math.sin(7919 * row + k) for k in range(3)]
        lines.append([f"{row * TURN_S / rows:.7g}", *map(str, bits)] + ([f"{x:.4f}" for x in u] if volts else []))
    text = "".join(separator.join(line) + "\n" for line in lines)
    return text.replace(".", ",") if comma else text


class Bench(Started):
    def setUp(self):
        super().setUp()
        (self.path / "log.csv").write_text(log())
        (self.path / "scope.csv").write_bytes((RECORDINGS / "bly172s-emf.csv").read_bytes())

    def told(self, *words, code=0):
        return json.loads(self.run_program("motor", *words, "--json", code=code).stdout)

    def refused(self, *words):
        result = self.run_program("motor", *words, code=2)
        self.assertEqual((result.stdout, result.stderr.count("\n")), ("", 1), result.stderr)
        return result.stderr

    def test_edges_and_wires_as_text_json_and_toml(self):
        told = self.told("identify", "log.csv")
        self.assertEqual(told["place"]["wires"][0], {"spacing_deg": 120, "hall_lines": "123", "hall_inverted": "none"})
        mean = sum(OWN_DEG) / 6
        for edge, own in zip(told["edges"], OWN_DEG):
            self.assertLess(abs(edge["own_deg"]["value"] - (own - mean)), 1)  # the rows are two degrees apart
        self.assertEqual(told["place"]["turned"], "forward")
        text = self.run_program("motor", "identify", "log.csv").stdout
        self.assertIn("each at its own pin", text)
        self.assertEqual([row.split()[:4] for row in text.split("Code ")[1].splitlines()[1:7]],
                         [["001", "4", "c", "a"], ["010", "2", "b", "c"], ["011", "3", "b", "a"], ["100", "0", "a", "b"],
                          ["101", "5", "c", "b"], ["110", "1", "a", "c"]])  # docs/reference/notation.md
        (self.path / "log.csv").write_text(log(swapped=True))
        self.assertEqual(self.told("identify", "log.csv")["place"]["wires"][0]["hall_lines"], "132")
        self.assertIn("move the wire at H2 to H3, the wire at H3 to H2", self.run_program("motor", "identify", "log.csv").stdout)

    def test_probes_that_sit_far_off_are_not_called_60_degrees_apart(self):
        for off in (20, 35, 40, 50):
            (self.path / "log.csv").write_text(log(edges=[off] * 6))
            self.assertEqual(self.told("identify", "log.csv")["place"]["wires"][0]["spacing_deg"], 120)
            text = self.run_program("motor", "identify", "log.csv").stdout
            self.assertIn('hall_spacing = "120"', text)
            self.assertNotIn("to mend", text)
            straight = re.search(r"or, (\S+) deg off: probes 120 degrees apart, each at its own pin, none inverted", text)
            self.assertEqual(bool(straight), off > 30, text)
            if straight:
                self.assertLess(abs(float(straight[1]) - off), 1.5)  # the rows lie two degrees apart

    def test_what_it_writes_runs(self):
        self.run_program("motor", "identify", "log.csv", "--write", "sensors.toml")
        scenario = 'motor = "maxon-251601"\nduration_s = 0.001\n[control]\nmode = "duty"\n[reference]\nvalue = 0.1\n'
        (self.path / "a.toml").write_text(scenario + (self.path / "sensors.toml").read_text())
        self.run_program("run", "a.toml", "--quiet")
        self.run_program("motor", "emf", str(RECORDINGS / "trampa6340-emf.csv"), "--between", "lines", "--pole-pairs", "7",
                         "--write", "lines.toml", "--shape", "shape.csv", "--html", "e.html")
        head = 'name = "mine"\nresistance_ohm = { value = 0.05, frame = "terminal" }\ninductance_uH = { value = 30, frame = "terminal" }\n'
        head += "inertia_gcm2 = 500\nnominal_voltage_V = 24\n"
        (self.path / "mine.toml").write_text(head + (self.path / "lines.toml").read_text())
        self.run_program("motor", "check", "mine.toml")
        self.assertEqual(self.names(), ["a.toml", "e.html", "lines.toml", "log.csv", "mine.toml", "scope.csv", "sensors.toml", "shape.csv"])

    def test_codes_alone_write_nothing_whose_sign_they_do_not_know(self):
        (self.path / "log.csv").write_text(log(volts=False))
        text = self.run_program("motor", "identify", "log.csv", "--write", "a.toml").stdout
        written = tomllib.loads((self.path / "a.toml").read_text())
        self.assertEqual(written, {"sensors": {}})
        for told in (text, (self.path / "a.toml").read_text()):
            self.assertIn("# without hall_edges_deg: Hall codes show neither the first edge nor", told)
        (self.path / "log.csv").write_text(log())
        self.run_program("motor", "identify", "log.csv", "--write", "b.toml")
        self.assertEqual(len(tomllib.loads((self.path / "b.toml").read_text())["sensors"]["hall_edges_deg"]), 6)

    def test_files_are_the_same_each_time(self):
        for words, names in ((("identify", "log.csv", "--write", "a.toml", "--html", "a.html"), ("a.toml", "a.html")),
                             (("emf", "scope.csv", "--pole-pairs", "4", "--write", "b.toml", "--html", "b.html", "--shape", "b.csv"),
                              ("b.toml", "b.html", "b.csv"))):
            self.assertEqual(self.run_program("motor", *words, "--quiet").stdout, "")
            first = [(self.path / name).read_bytes() for name in names]
            self.run_program("motor", *words, "--quiet")
            self.assertEqual(first, [(self.path / name).read_bytes() for name in names])

    def test_a_sheet_that_fits_and_one_that_does_not(self):
        own = ("emf", "scope.csv", "--pole-pairs", "4")
        sheet = 'name = "s"\npole_pairs = 4\nback_emf = "sine"\nback_emf_constant_V_krpm = {{ value = {}, frame = "line-peak" }}\n'
        measured = self.told(*own)["constants_V_s_per_electrical_rad"]["line_fundamental"]["value"] * 4 * 1000 * math.pi / 30
        for volts, code in ((measured, 0), (1.04 * measured, 0), (1.12 * measured, 1), (3.35, 1)):
            (self.path / "s.toml").write_text(sheet.format(volts))
            told = self.told("emf", "scope.csv", "--motor", "s.toml", code=code)
            self.assertEqual(told["pole_pairs"], 4)
            self.assertEqual(told["sheet"]["checks"][0]["holds"], code == 0)
        self.assertEqual(self.told("emf", "scope.csv", "--motor", "s.toml", "--pole-pairs", "4", code=1)["pole_pairs"], 4)
        line = self.refused("emf", "scope.csv", "--motor", "s.toml", "--pole-pairs", "3", "--write", "w.toml")
        self.assertIn("--pole-pairs = 3 contradicts the 4 pole pairs of s", line)
        self.assertFalse((self.path / "w.toml").exists())
        self.run_program("motor", "emf", "scope.csv", "--motor", "s.toml", "--tolerance", "50")

    def test_tables_of_every_make(self):
        for text in (log(separator=";"), log(separator="\t"), log(separator=";", comma=True), log().replace("\n", "\r\n"), "\ufeff" + log()):
            (self.path / "log.csv").write_text(text)
            self.assertEqual(self.told("identify", "log.csv")["place"]["wires"][0]["hall_lines"], "123")
        renamed = log().replace("hall1,hall2,hall3", "D0,D1,D2").replace("u_ab [V],u_bc [V],u_ca [V]", "CH1,CH2,CH3")
        (self.path / "log.csv").write_text(renamed)
        named = ("--hall", "D0,D1,D2", "--voltages", "CH1,CH2,CH3", "--between", "lines")
        self.assertEqual(self.told("identify", "log.csv", *named)["place"]["wires"][0]["hall_lines"], "123")
        rows = "".join(line.split(",", 1)[1] for line in renamed.splitlines(True))
        (self.path / "log.csv").write_text(rows)
        self.assertAlmostEqual(self.told("identify", "log.csv", *named, "--interval", "1e-4")["seconds"], 1e-4 * (12 * 180 - 1))

    def test_an_interval_does_not_overrule_a_column_of_time(self):
        of_file = self.told("emf", "scope.csv")
        self.assertEqual(self.told("emf", "scope.csv", "--interval", "2e-5"), of_file)
        self.assertIn("scope.csv: contradicts the given interval of 4e-05 s: time rises by 2e-05 s from row to row",
                      self.refused("emf", "scope.csv", "--interval", "4e-5"))
        self.assertIn("contradicts the given interval", self.refused("identify", "log.csv", "--interval", "1e-4"))

    def test_hostile_logs_get_one_line_with_place_and_cure(self):
        whole = log()
        standing = log().splitlines()[0] + "\n" + "".join(f"{n},1,0,0,0,0,0\n" for n in range(500))
        dead = "\n".join(",".join([*cells[:3], "0", *cells[4:]]) if n else ",".join(cells)
                         for n, cells in enumerate(line.split(",") for line in whole.splitlines()))
        for text, told in (("", "is empty; export the recording again"),
                           ("".join(whole.splitlines(True)[:400]), "; turn the shaft by at least 3 electrical turns"),
                           (standing, "hall1, hall2, hall3 never change: the rotor was at rest"),
                           (dead, "hall3 = 0 in every row, while another line changes"),
                           (whole.replace("hall", "pin"), "has no columns of Hall lines: it has time, pin1"),
                           (whole.replace(",", "|"), "contains no row of numbers"),
                           ("\x1f\x8b\x08\x00\x00" + whole, "is not a text file; export the recording as CSV, or unpack a .gz with gzip -d"),
                           (whole.replace("0.01,", "nan,", 1), ': time "nan" is not a number; remove such rows'),
                           (whole + "1e300,1,0,0,0,0,0\n", "time 1e+300 in row 2161 is too large for any instrument; correct the unit"),
                           (whole + "0,1,0,0,0,0,0\n", "time 0 in row 2161 does not rise; give the rows in the order"),
                           (whole + "1,1,0,0,1e200,0,0\n", "u_ab 1e+200 in row 2161 is too large for any instrument"),
                           (whole + "1,1,0\n", ':2162: hall3 "" is not a number'),
                           (whole.rsplit(",", 200)[0], 'is not a number')):
            (self.path / "log.csv").write_text(text)
            with self.subTest(told):
                line = self.refused("identify", "log.csv", "--write", "a.toml", "--html", "a.html")
                self.assertTrue(line.startswith("log.csv:"), line)
                self.assertIn(told, line)
                self.assertIn("; ", line)
        self.assertEqual(self.names(), ["log.csv", "scope.csv"])

    def test_hostile_recordings_get_one_line_with_place_and_cure(self):
        whole = (self.path / "scope.csv").read_text()
        head, rows = whole.split("u_ab [V]\n")
        head += "u_ab [V]\n"
        for text, told in (("", "is empty"),
                           (head, "contains no row of numbers"),
                           (head + "".join(rows.splitlines(True)[:900]), "period"),
                           (head + "".join(f"{n * 1e-5:g},0.25\n" for n in range(900)), "u_ab = 0.25 V in every row: the motor was at rest"),
                           (whole.replace("u_ab [V]", "CH1 [V]"), "--between is missing, and the headings do not tell between which points the voltages were measured; give lines"),
                           (whole.replace("time [s]", "sample"), "has no column of time: it has sample, u_ab; write the heading time [s], or give"),
                           (whole + "1,inf\n", 'u_ab "inf" is not a number')):
            (self.path / "scope.csv").write_text(text)
            with self.subTest(told):
                line = self.refused("emf", "scope.csv", "--html", "a.html", "--write", "a.toml", "--shape", "a.csv")
                self.assertTrue(line.startswith(("scope.csv:", "--between")), line)
                self.assertIn(told, line)
        self.assertEqual(self.names(), ["log.csv", "scope.csv"])

    def test_what_is_not_used_is_told_beside_the_answer(self):
        head, rows = (self.path / "scope.csv").read_text().split("u_ab [V]\n")
        (self.path / "scope.csv").write_text(head + "u_ab [V],Temp [degC],Comment\n" + rows.replace("\n", ",21.5,\n"))
        made = self.run_program("motor", "emf", "scope.csv", "--json")
        self.assertAlmostEqual(json.loads(made.stdout)["channels"][0]["fundamental_V"]["value"], 2.011, delta=0.001)
        self.assertEqual(made.stderr, "scope.csv: not used: Temp (in degC)\n")
        self.assertEqual(self.run_program("motor", "emf", "scope.csv", "--quiet").stderr, "")

    def test_a_preamble_that_contradicts_the_rows_is_refused(self):
        (self.path / "scope.csv").write_text("# Sample interval: 20 ms\n" + (self.path / "scope.csv").read_text())
        line = self.refused("emf", "scope.csv")
        self.assertIn('scope.csv: contradicts itself: time rises by 2e-05 s from row to row, but "Sample interval: 20 ms" says 0.02 s', line)
        self.run_program("motor", "emf", "scope.csv", "--interval", "2e-5", "--quiet")

    def test_options_that_cannot_be(self):
        for words, told in ((("identify", "nowhere.csv"), "nowhere.csv"),
                            (("identify", "."), "."),
                            (("identify",), "sixstep motor identify needs LOG"),
                            (("emf",), "sixstep motor emf needs SCOPE"),
                            (("identify", "log.csv", "--pole-pairs", "0"), "--pole-pairs = 0 must"),
                            (("identify", "log.csv", "--pole-pairs", "40"), "--pole-pairs = 40 has 240 edges in a turn"),
                            (("identify", "log.csv", "--interval", "0"), "--interval = 0 must be above 0"),
                            (("identify", "log.csv", "--interval", "nan"), "--interval = nan must be above 0"),
                            (("identify", "log.csv", "--between", "wires"), "--between = wires must be lines or star"),
                            (("identify", "log.csv", "--hall", "a,b,c"), 'log.csv: has no column "a"; it has time, hall1'),
                            (("identify", "log.csv", "--html", "log.csv"), "log.csv"),
                            (("identify", "log.csv", "--html", "a", "--write", "a"), "--html = a is also the file of --write"),
                            (("emf", "scope.csv", "--speed", "-1"), "--speed = -1 must lie in 0.01 to 600000"),
                            (("emf", "scope.csv", "--tolerance", "100"), "--tolerance = 100 must"),
                            (("emf", "scope.csv", "--speed", "450"), "--speed = 450 rpm with 33."),
                            (("emf", "scope.csv", "--motor", "nobody"), "nobody is neither"),
                            (("emf", "scope.csv", "--shape", "no/a.csv"), "no/a.csv")):
            with self.subTest(words):
                line = self.refused(*words)
                self.assertTrue(line.startswith(told), line)
        self.assertEqual(self.names(), ["log.csv", "scope.csv"])


if __name__ == "__main__":
    unittest.main()
