#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program as a user meets it: exit codes, messages, and files that are whole or absent."""
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = os.path.abspath(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1)).resolve()
R1 = str(SOURCE / "data/scenarios/reference/R1.toml")

# The rotor is held at full voltage; only the limit decides whether the requirement holds.
SHORT = """
motor = "maxon-251601"
duration_s = 1e-4
[control]
mode = "duty"
[reference]
value = 1
[load]
locked = true
[[require]]
metric = "final"
signal = "current"
label = "current"
max = {limit}
"""


# Copper that strays by a tenth: half of the drives hold 23.3 A.
SPREAD = """
[[spread]]
key = "motor_override.resistance_ohm"
relative = 0.1
"""


def mat_variables(data):
    """A MAT file of level 5, uncompressed, read by its specification alone: {name: rows of numbers, or text}."""
    def elements(at, end):
        while at < end:
            kind, size = struct.unpack_from("<II", data, at)
            if kind >> 16:  # small element: size and data in eight bytes
                yield kind & 0xffff, data[at + 4:at + 4 + (kind >> 16)], at
                at += 8
            else:
                yield kind, data[at + 8:at + 8 + size], at
                at += 8 + (size + 7) // 8 * 8
    assert data[124:128] == b"\x00\x01IM", data[124:128]
    found = {}
    for kind, body, at in elements(128, len(data)):
        assert kind == 14
        (_, flags, _), (_, dims, _), (_, name, _), (part, values, _) = elements(at + 8, at + 8 + len(body))
        rows, columns = struct.unpack("<ii", dims)
        if flags[0] == 4:
            found[name.decode()] = values.decode("utf-16-le" if part == 4 or part == 17 else "utf-8")
        else:
            assert (flags[0], part) == (6, 9)
            column = struct.unpack(f"<{rows * columns}d", values)
            found[name.decode()] = [[column[c * rows + r] for c in range(columns)] for r in range(rows)]
    return found


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def run_program(self, *words, code=0):
        result = subprocess.run([PROGRAM, *words], cwd=self.path, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, code, result.stderr + result.stdout)
        return result

    def write(self, name, limit):
        (self.path / name).write_text(SHORT.format(limit=limit))
        return name

    def names(self, folder="."):
        return sorted(os.listdir(self.path / folder))

    def test_0_when_all_requirements_hold(self):
        result = self.run_program("run", self.write("a.toml", 1000))
        self.assertIn("ok", result.stdout)
        self.assertNotIn("\x1b", result.stdout)  # no terminal, no colour
        self.assertEqual(self.names(), ["a.toml"])

    def test_1_when_a_requirement_fails(self):
        self.assertIn("FAILED", self.run_program("run", self.write("a.toml", -1), code=1).stdout)

    def test_quiet_says_nothing(self):
        result = self.run_program("run", "--quiet", self.write("a.toml", 1000))
        self.assertEqual(result.stdout + result.stderr, "")

    def test_the_gravest_of_several_counts_and_the_order_is_that_given(self):
        files = [self.write(f"{name}.toml", limit) for name, limit in [("z", 1000), ("a", -1), ("m", 1000)]]
        table = self.run_program("run", *files, "--jobs", "3", code=1).stdout.splitlines()
        self.assertEqual([line for line in table if line in ("z", "a", "m")], ["z", "a", "m"])
        self.assertEqual(table[-2:], ["3 experiments: 1 of 3 requirements FAILED", "  a: current"])

    def test_2_for_bad_input_and_nothing_is_written(self):
        good = self.write("a.toml", 1000)
        (self.path / "bad.toml").write_text('motor = "maxon-251601"\nduration_s = 0\n')
        result = self.run_program("run", good, "bad.toml", "--out", "out", code=2)
        self.assertEqual(result.stderr, "bad.toml:2:14: duration_s = 0 must be above 0 and at most 9000000; it means: simulated time, in s\n")
        self.run_program("run", "absent.toml", code=2)
        self.run_program("run", code=2)
        self.run_program("nonsense", code=2)
        self.assertEqual(self.run_program("rum", code=2).stderr, "rum is no command of sixstep; did you mean run?\n")
        self.assertIn("--jobs", self.run_program("run", good, "--jobs", "-1", code=2).stderr)
        self.run_program("run", good, "--set", "novalue", code=2)
        self.run_program("run", good, "a.toml", "--csv", "x.csv", code=2)
        self.assertEqual(self.names(), ["a.toml", "bad.toml"])

    def test_2_for_an_unwritable_output_before_anything_is_written(self):
        good = self.write("a.toml", 1000)
        result = self.run_program("run", good, "--csv", "a.csv", "--json", "no/folder.json", code=2)
        self.assertIn("no/folder.json: cannot be written: No such file or directory", result.stderr)
        (self.path / "file").write_text("in the way")
        self.run_program("run", good, "--out", "file/out", code=2)
        self.assertEqual(self.names(), ["a.toml", "file"])

    def test_2_when_two_files_would_write_the_same_outputs(self):
        os.mkdir(self.path / "other")
        files = [self.write("a.toml", 1000), self.write("other/a.toml", 1000)]
        self.assertIn("same outputs", self.run_program("run", *files, "--out", "out", code=2).stderr)

    def test_out_holds_everything_of_each_scenario(self):
        self.run_program("run", self.write("a.toml", 1000), self.write("b.toml", 1000), "--out", "deep/out")
        self.assertEqual(self.names("deep/out"),
                         ["a.csv", "a.html", "a.json", "b.csv", "b.html", "b.json", "index.html"])
        self.assertIn('href="a.html"', (self.path / "deep/out/index.html").read_text())

    def test_json_on_standard_output_is_alone_there(self):
        result = self.run_program("run", self.write("a.toml", 1000), "--json", "-")
        summary = json.loads(result.stdout)
        self.assertRegex(summary["digest"], "^[0-9a-f]{16}$")
        self.assertTrue(summary["passed"])
        self.assertEqual(summary["require"][0]["max"], 1000)
        self.assertIn("ok", result.stderr)

    def test_csv_begins_with_its_columns(self):
        self.run_program("run", R1, "--csv", "r1.csv", "--quiet")
        self.assertTrue((self.path / "r1.csv").read_text().startswith("t_s,"))

    def test_set_is_stronger_than_the_file(self):
        good = self.write("a.toml", 1000)
        summary = json.loads(self.run_program("run", good, "--json", "-", "--set", "duration_s=2e-4").stdout)
        self.assertEqual(summary["duration_s"], 2e-4)

    def test_ctrl_c_leaves_what_is_finished_under_a_partial_name(self):
        good = self.write("a.toml", 1000)
        words = [PROGRAM, "run", good, "--csv", "a.csv", "--json", "a.json", "--set", "duration_s=1e4",
                 "--set", "record.grid_s=1"]
        with subprocess.Popen(words, cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
            deadline = time.monotonic() + 20
            while len(self.names()) < 3 and time.monotonic() < deadline:  # both outputs are open before the run begins
                time.sleep(0.01)
            time.sleep(0.2)
            program.send_signal(signal.SIGINT)
            program.communicate(timeout=20)
        self.assertEqual(program.returncode, 130)
        self.assertEqual(self.names(), ["a.partial.csv", "a.toml"])
        self.assertTrue((self.path / "a.partial.csv").read_text().startswith("t_s,"))

    def write_series(self, limit, spread=SPREAD):
        (self.path / "a.toml").write_text(SHORT.format(limit=limit).replace("1e-4", "20e-3") + spread)
        return "a.toml"

    def test_a_series_is_judged_together(self):
        file = self.write_series(24 / 1.03)
        table = self.run_program("run", file, "--runs", "40", "--jobs", "1", code=1).stdout
        self.assertEqual(table, self.run_program("run", file, "--runs", "40", "--jobs", "3", code=1).stdout)
        self.assertNotEqual(table, self.run_program("run", file, "--runs", "40", "--seed", "2", code=1).stdout)
        held, missed = (int(n) for n in re.search(r"40 drives, seed 1: (\d+) hold every requirement, (\d+) do NOT", table).groups())
        self.assertEqual(held + missed, 40)
        self.assertIn(f"{held} of 40", table)
        self.assertIn("all hold", self.run_program("run", self.write_series(1000), "--runs", "5").stdout)
        self.assertEqual(self.names(), ["a.toml"])

    def test_one_drive_of_a_series_is_run_alone_with_its_files(self):
        file = self.write_series(24 / 1.03)
        table = self.run_program("run", file, "--runs", "40", code=1).stdout
        miss = re.search(r"first miss is drive (\d+)", table).group(1)
        self.run_program("run", file, "--seed", "1", "--drive", miss, "--json", "miss.json", code=1)
        alone = json.loads((self.path / "miss.json").read_text())["require"][0]
        self.assertFalse(alone["ok"])
        self.assertNotEqual(alone["measured"], json.loads(
            self.run_program("run", file, "--json", "-").stdout)["require"][0]["measured"])

    def test_2_for_a_series_that_is_none(self):
        self.assertIn("describes no series", self.run_program("run", self.write("a.toml", 1000), "--runs", "3", code=2).stderr)
        self.assertIn("describes no series", self.run_program("run", "a.toml", "--drive", "3", code=2).stderr)
        file = self.write_series(1000)
        self.assertIn("--drive", self.run_program("run", file, "--runs", "3", "--csv", "a.csv", code=2).stderr)
        self.run_program("run", file, "--runs", "3", "--drive", "1", code=2)
        self.write_series(1000, SPREAD.replace("resistance_ohm", "resistance"))
        self.assertTrue(self.run_program("run", file, code=2).stderr.startswith(
            'a.toml:17:7: spread.key = "motor_override.resistance" is no number'))
        self.write_series(1000, SPREAD.replace("0.1", "1.5"))
        self.assertTrue(self.run_program("run", file, code=2).stderr.startswith(
            "a.toml:18:12: spread.relative = 1.5 lets motor_override.resistance_ohm reach -0.515"))
        self.assertEqual(self.names(), ["a.toml"])

    def test_ctrl_c_ends_a_series_and_tells_what_is_done(self):
        words = [PROGRAM, "run", self.write_series(1000), "--runs", "1000000000"]
        with subprocess.Popen(words, cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            time.sleep(0.5)
            program.send_signal(signal.SIGINT)
            told = program.communicate(timeout=20)[0]
        self.assertEqual(program.returncode, 130)
        self.assertRegex(told, r"[1-9]\d* drives, seed 1: all hold")

    def test_help_explains_keys_and_answers_near_misses(self):
        self.assertIn("supply.voltage_V", self.run_program("help", "supply").stdout)
        self.assertIn("default 24", self.run_program("help", "supply.voltage_V").stdout)
        self.assertIn("i_a_A", self.run_program("help", "columns").stdout)
        self.assertIn("terminal|phase", self.run_program("help", "resistance_ohm").stdout)
        self.assertIn("did you mean supply.voltage_V?", self.run_program("help", "suply.voltage_V", code=2).stderr)

    def scenario(self, name):
        return str(SOURCE / f"data/scenarios/{name}.toml")

    def test_export_writes_a_header_or_prints_it(self):
        position = self.scenario("thesis/7.5-position")
        printed = self.run_program("export", "header", position).stdout
        self.assertIn("using Scalar = double;", printed)
        self.assertIn("c.mode = Mode::position;", printed)
        self.assertIn("= 0x1.2p+2;", printed)  # 4.5 V/A
        self.assertIn("2.4 rad/s per deg; given as gain_rad_s_per_deg", printed)
        self.assertRegex(printed, r"// 24 V: duty 1\n")
        self.assertEqual(self.run_program("export", "header", position, "--out", "d.hpp").stdout, "")
        written = (self.path / "d.hpp").read_text()
        self.assertEqual(written.replace(" --out d.hpp", ""), printed)
        self.assertEqual(self.names(), ["d.hpp"])
        own = self.run_program("export", "header", position, "--set", "control.arithmetic=float").stdout
        self.assertIn("using Scalar = float;", own)
        single = self.run_program("export", "header", position, "--single-header", "--namespace", "left::wheel").stdout
        self.assertIn('#include "sixstep_control.hpp"\n\nnamespace left::wheel {', single)

    def test_an_exported_header_can_be_made_again_by_its_own_comment(self):
        (self.path / "my drive.toml").write_text(pathlib.Path(self.scenario("thesis/7.5-position")).read_text())
        first = self.run_program("export", "header", "my drive.toml", "--arithmetic", "q31", "--range", "current_A=60").stdout
        command = re.search(r"^//   sixstep (.*)$", first, re.M).group(1)
        again = subprocess.run(f"{PROGRAM} {command}", shell=True, cwd=self.path, capture_output=True, text=True, check=True)
        self.assertEqual(again.stdout, first)

    def test_export_refuses_properly(self):
        position = self.scenario("thesis/7.5-position")
        def told(*words):
            result = self.run_program("export", "header", *words, "--out", "d.hpp", code=2)
            self.assertEqual(result.stdout, "")
            return result.stderr
        off = told(position, "--set", "control.mode=off")
        self.assertEqual(off, f"{position}: control.mode = off leaves no drive to export; set it to duty, current, speed or position\n")
        self.assertIn("absent.toml", told("absent.toml"))
        self.assertEqual(told(position, "--arithmetic", "q51"),
                         "--arithmetic = q51 must be one of double, float, q15, q14, q31, q30; did you mean q15?\n")
        self.assertEqual(told(position, "--range", "curent_A=3", "--arithmetic", "q15"),
                         "--range curent_A=3 names no quantity of the range; did you mean current_A?\n")
        self.assertIn("--range current_A = 3A must be a number above 0", told(position, "--range", "current_A=3A", "--arithmetic", "q15"))
        self.assertIn("--range current_A", told(position, "--range", "current_A", "--arithmetic", "q15"))
        self.assertIn("add --arithmetic q15", told(position, "--range", "current_A=3"))
        self.assertIn("is no name of a C++ namespace", told(position, "--namespace", "7up"))
        self.assertIn("does not name a key and a value", told(position, "--set", "novalue"))
        small = told(position, "--arithmetic", "q15", "--set", "control.speed.d1=1e-9", "--set", "control.speed.d0=-0.9e-9")
        self.assertIn(f"{position}: control.arithmetic = \"q15\" cannot hold this drive: speed.K_i = ", small)
        self.assertIn("take 32 bits", small)
        # 16 bits cannot hold the ratio of such bases: told with the gain's name.
        self.assertIn("position_gain = ", told(position, "--arithmetic", "q15", "--set", "control.position.gain_rad_s_per_deg=1e6"))
        self.run_program("export", code=2)
        self.run_program("export", "heder", position, code=2)
        self.run_program("export", "header", code=2)
        self.assertEqual(self.run_program("exprt", code=2).stderr, "exprt is no command of sixstep; did you mean export?\n")
        self.assertIn("cannot be written", self.run_program("export", "header", position, "--out", "no/d.hpp", code=2).stderr)
        self.assertEqual(self.names(), [])

    def test_design_prints_verdict_first_then_every_step(self):
        text = self.run_program("design", "maxon-251601").stdout
        self.assertRegex(text.splitlines()[0], r"^usable, 1 warning: the current loop settles in 990 us \(1 ms asked for\)")
        self.assertRegex(text, r"  d1 +4\.09559 +.* thesis 4\.5\n")
        self.assertRegex(text, r"  Re z +0\.869154 +.* thesis 0\.8588\n")
        self.assertIn("phase margin, one period late         59.8 deg", text)
        self.assertIn("held up to 71.6 rad/s, (i/K_t) R", text)
        self.assertEqual(self.names(), [])

    def test_design_writes_a_scenario_that_runs_and_a_header_of_the_same_gains(self):
        for mode, figures in (("current", 3), ("speed", 7), ("position", 4)):
            self.run_program("design", "maxon-251601", "--mode", mode, "--quick", "--quiet", "--toml", "d.toml",
                             "--header", "d.hpp", "--json", "d.json")
            designed = json.loads((self.path / "d.json").read_text())
            self.assertTrue(designed["usable"])
            self.assertNotIn("tolerances", designed)
            ran = json.loads(self.run_program("run", "d.toml", "--json", "-").stdout)
            self.assertEqual(ran["digest"], designed["digest"])
            self.assertEqual([c["measured"] for c in ran["compare"]], [c["simulated"] for c in designed["simulated"]])
            self.assertEqual(len(ran["compare"]), figures)
            for gains, loop in zip(ran["gains"], designed["loops"]):
                self.assertEqual(gains["loop"], loop["name"])
                self.assertEqual(gains["d1"], loop["gain_rad_s_per_deg"] if mode == "position" and gains["loop"] == mode
                                 else loop["gains"]["d1"])
            d1 = float(designed["loops"][0]["gains"]["d1"]).hex()
            mantissa, exponent = d1.split("p")
            self.assertIn(f"{mantissa.rstrip('0')}p{exponent}", (self.path / "d.hpp").read_text())

    def test_design_of_a_motor_file_names_it_as_the_scenario_sees_it(self):
        (self.path / "mine.toml").write_text((SOURCE / "data/motors/maxon-251601.toml").read_text())
        (self.path / "out").mkdir()
        self.run_program("design", "mine.toml", "--quick", "--quiet", "--toml", "out/d.toml")
        self.assertIn('motor = "../mine.toml"', (self.path / "out/d.toml").read_text())
        self.run_program("run", "out/d.toml", "--quiet")

    def test_design_json_has_bode_step_margins_and_worst_corners(self):
        result = self.run_program("design", "maxon-251601", "--mode", "speed", "--json", "-", "--quiet")
        d = json.loads(result.stdout)
        self.assertEqual([loop["name"] for loop in d["loops"]], ["current", "speed"])
        self.assertEqual(d["tolerances"]["motors"], 25)
        for loop in d["loops"]:
            self.assertTrue(loop["margins"]["one_period_late"]["stable"])
            w, gain, crossover = loop["bode"]["w_rad_s"], loop["bode"]["gain"], loop["margins"]["at_once"]["crossover_rad_s"]
            self.assertLess(max(x for x, g in zip(w, gain) if g > 1), crossover)
            self.assertGreater(min(x for x, g in zip(w, gain) if g < 1), crossover)
            self.assertAlmostEqual(loop["step"]["value"][-1], 1, 2)
        steps = {s["symbol"]: s for s in d["loops"][1]["steps"]}
        self.assertAlmostEqual(steps["d1"]["value"], 0.0158299, 7)
        self.assertEqual(steps["d1"]["thesis"], 0.017225)

    def test_design_writes_a_page_that_needs_nothing(self):
        self.run_program("design", "maxon-251601", "--mode", "speed", "--quiet", "--html", "d.html")
        page = (self.path / "d.html").read_text()
        self.assertTrue(page.startswith("<!doctype html>") and page.endswith("</html>\n"))
        self.assertIn("sixstep design maxon-251601 --mode speed --quiet --html d.html", page)
        self.assertNotRegex(page, r'(src|href)="(?!data:)')
        self.assertEqual(self.names(), ["d.html"])

    def test_an_interrupted_design_leaves_nothing_behind(self):
        # A loop so slow that a minute of the drive is simulated for each motor.
        design = subprocess.Popen([PROGRAM, "design", "maxon-251601", "--mode", "speed", "--settle", "5", "--toml", "d.toml"],
                                  cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not self.names():  # the outputs are open: it is on its way
            time.sleep(0.01)
        time.sleep(0.3)
        design.send_signal(signal.SIGINT)
        self.assertEqual(design.wait(timeout=30), 130)
        design.communicate()
        self.assertEqual(self.names(), [])

    def test_design_exports_both_models_to_json_and_mat_alike(self):
        for angle in ("30", "105"):
            for kind in ("json", "mat"):
                self.run_program("design", "maxon-251601", "--quick", "--quiet", "--angle", angle, "--models", f"m.{kind}")
            models, mat = json.loads((self.path / "m.json").read_text()), mat_variables((self.path / "m.mat").read_bytes())
            for name in ("phase", "terminal"):
                for matrix in "AB":
                    self.assertEqual(mat[f"{name}_{matrix}"], models[f"{name}_voltage"][matrix])
                self.assertEqual(mat[f"{name}_states"].split(), models[f"{name}_voltage"]["states"])
                self.assertEqual(mat[f"{name}_inputs"].split(), models[f"{name}_voltage"]["inputs"])
            for name, value in models["parameters"].items():
                self.assertEqual(mat[name], [[value]])
            self.assertEqual(mat["theta_e_deg"], [[float(angle)]])
            # MODEL 1 on the sheet: R/L per phase, K_e f/L, 1/L.
            A, L, K_e = mat["phase_A"], 0.286e-3, 0.01675
            self.assertAlmostEqual(A[0][0], -1.03 / 0.572e-3, 9)
            # Flat tops of 120 degrees, ramps of 60 between: c falls through 0 at 30, b rises through 0 at 90.
            f = {"30": (1, -1, 0), "105": (1, 0.5, -1)}[angle]
            for phase in range(3):
                self.assertAlmostEqual(A[phase][3], -K_e * f[phase] / L, 9)
            self.assertAlmostEqual(mat["phase_B"][1][1], 1 / L, 9)
            self.assertEqual(mat["terminal_A"][3], [0, 0, 1, 0])
        first = (self.path / "m.mat").read_bytes()
        self.run_program("design", "maxon-251601", "--quick", "--quiet", "--angle", "105", "--models", "m.mat")
        self.assertEqual((self.path / "m.mat").read_bytes(), first)
        self.assertIn("must end in .json or .mat",
                      self.run_program("design", "maxon-251601", "--models", "m.csv", code=2).stderr)
        self.assertEqual(self.names(), ["m.json", "m.mat"])

    def test_design_refuses_properly_and_tells_a_bad_design(self):
        def told(*words, code=2):
            result = self.run_program("design", *words, "--toml", "d.toml", code=code)
            self.assertEqual(self.names(), ["d.toml"] if code < 2 else [])
            return result.stdout + result.stderr
        self.assertEqual(told("maxon-251601", "--mode", "spede"),
                         "--mode = spede must be one of current, speed, position; did you mean speed?\n")
        self.assertIn("--settle = -1 must be above 0", told("maxon-251601", "--settle", "-1"))
        self.assertIn("is no input of pole placement", told("maxon-251601", "--bandwidth", "100"))
        self.assertIn('did you mean "maxon-251601"?', told("maxon-25160"))
        self.assertIn("cannot be written", self.run_program("design", "maxon-251601", "--json", "no/d.json", code=2).stderr)
        # A fast loop with a delay, chopped softly: only the simulation knows that it oscillates.
        text = told("maxon-251601", "--settle", "0.5e-3", "--delay", "1", code=1)
        self.assertRegex(text.splitlines()[0], "^NOT USABLE: in the simulation it never settles$")
        self.assertIn("try --chopping complementary", text)

    def test_curve_prints_a_table_and_writes_whole_files(self):
        shown = self.run_program("curve", "maxon-251601", "--csv", "a.csv", "--json", "a.json", "--html", "a.html").stdout
        self.assertIn("No load: 6709.5 rpm (702.613 rad/s) with 0.1531 A through the winding", shown)
        self.assertEqual(self.names(), ["a.csv", "a.html", "a.json"])
        rows = (self.path / "a.csv").read_text().splitlines()
        self.assertEqual(len(rows), 42)
        self.assertTrue(rows[0].startswith("speed_rad_s,torque_Nm,air_gap_torque_Nm,ideal_torque_Nm,"))
        curve = json.loads((self.path / "a.json").read_text())
        last = dict(zip(rows[0].split(","), map(float, rows[-1].split(","))))
        self.assertEqual(last["speed_rad_s"], curve["points"][-1]["speed_rad_s"])
        self.assertTrue("--html a.html" in (self.path / "a.html").read_text(), "the page names the command that made it")
        self.assertEqual(self.run_program("curve", "maxon-251601", "--quiet").stdout, "")
        self.assertEqual(json.loads(self.run_program("curve", "maxon-251601", "--json", "-").stdout), curve)

    def test_curve_is_the_same_on_any_number_of_threads(self):
        words = ["curve", "maxon-251601", "--duty", "0.6", "--chopping", "hard", "--points", "7", "--json", "-"]
        self.assertEqual(self.run_program(*words, "--jobs", "1").stdout, self.run_program(*words, "--jobs", "3").stdout)

    def test_curve_refuses_properly(self):
        def told(*words):
            result = self.run_program("curve", *words, "--csv", "a.csv", code=2)
            self.assertEqual(result.stdout, "")
            return result.stderr
        self.assertTrue(told("maxon-251601", "--duty", "0").startswith("--duty = 0 must be in (0, 1]"))
        self.assertTrue(told("maxon-251601", "--duty", "-0.5").startswith("--duty = -0.5 must be in (0, 1]"))
        self.assertTrue(told("maxon-251601", "--voltage", "-24").startswith("--voltage = -24 must be above 0"))
        self.assertTrue(told("maxon-251601", "--points", "1").startswith("--points = 1 must be at least 2"))
        self.assertIn("did you mean soft?", told("maxon-251601", "--chopping", "sof"))
        self.assertTrue(told("maxon-251601", "--ambient", "1e5").startswith("--ambient = 1e+05"))
        self.assertIn("did you mean", told("maxon-25160"))
        both = told("maxon-251601", "--pwm-period", "0", "--diode-drop", "-1", "--on-resistance", "-1")
        self.assertEqual([line.split(" = ")[0] for line in both.splitlines()],
                         ["--pwm-period", "--on-resistance", "--diode-drop"])
        self.run_program("curve", "maxon-251601", "--duty", "half", code=2)
        self.run_program("curve", code=2)
        self.assertIn("cannot be written", self.run_program("curve", "maxon-251601", "--html", "no/a.html", code=2).stderr)
        sheet = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "no-inertia.toml").write_text(re.sub(r"inertia_gcm2.*", "", sheet))
        self.assertIn("inertia_gcm2", told("no-inertia"))
        (self.path / "rusty.toml").write_text(sheet + "\ncoulomb_friction_mNm = 900\n")
        self.assertIn("gives no torque beyond the motor's own friction", told("rusty"))
        (self.path / "bare.toml").write_text("\n".join(x for x in sheet.splitlines() if not re.match("thermal|max_winding", x)))
        bare = self.run_program("curve", "bare").stdout
        self.assertIn("No thermal limits: thermal_resistance_winding_housing_K_W, ", bare)
        self.assertEqual(self.names(), ["bare.toml", "no-inertia.toml", "rusty.toml"])

    def test_motors_and_version(self):
        self.assertIn("maxon-251601", self.run_program("motor", "list").stdout)
        self.assertIn("data sheet, line 12", self.run_program("motor", "show", "maxon-251601").stdout)
        self.assertIn("did you mean", self.run_program("motor", "show", "maxon-25161", code=2).stderr)
        self.assertTrue(self.run_program("--version").stdout.startswith("sixstep "))

    def test_a_sheet_of_ones_own_from_the_template_to_a_run(self):
        self.assertIn("sixstep motor check mine.toml", self.run_program("motor", "new", "--style", "drone", "mine").stdout)
        self.assertEqual(self.names(), ["mine.toml"])
        self.assertIn("mine.toml is there already", self.run_program("motor", "new", "mine", code=2).stderr)
        text = (self.path / "mine.toml").read_text()
        self.assertEqual(self.run_program("motor", "new", "--style", "drone").stdout, text.replace('"mine"', '"my motor"'))
        for line in self.run_program("motor", "check", "mine.toml", code=2).stderr.splitlines():
            self.assertIn(" must ", line)
        sheet = {"winding": '"12N14P"', "nominal_voltage_V": "14.8", "speed_constant_rpm_V": '{ value = 920, frame = "line-peak" }',
                 "resistance_mohm": '{ value = 117, frame = "terminal" }', "inductance_uH": '{ value = 35, frame = "terminal" }',
                 "inertia_gcm2": "50.6", "idle_current_A": "0.6", "idle_voltage_V": "10"}
        for key, value in sheet.items():
            text, count = re.subn(rf"(?m)^(# )?{key} = .*$", f"{key} = {value}", text)
            self.assertEqual(count, 1, key)
        (self.path / "mine.toml").write_text(text)
        self.assertIn("consistent", self.run_program("motor", "check", "mine.toml").stdout)
        (self.path / "a.toml").write_text(SHORT.format(limit=1000).replace("maxon-251601", "mine"))
        self.run_program("run", "a.toml")

    def test_motor_check_tells_a_contradiction_by_its_exit_code(self):
        shipped = (SOURCE / "data/motors/maxon-251601.toml").read_text()
        (self.path / "a.toml").write_text(shipped)
        self.assertIn("consistent: 4 of 5", self.run_program("motor", "check", "a.toml").stdout)
        (self.path / "a.toml").write_text(shipped.replace("value = 23.3,", "value = 32.3,"))
        result = self.run_program("motor", "check", "a.toml", code=1)
        self.assertRegex(result.stdout, r"BROKEN stall current .*\n")
        self.assertTrue(result.stdout.endswith("INCONSISTENT: 2 of 5 relations hold, 1 broken as the file says, 2 broken\n"), result.stdout)
        checked = json.loads(self.run_program("motor", "check", "--json", "a.toml", code=1).stdout)
        self.assertEqual([r["name"] for r in checked["relations"] if r["verdict"] == "broken"], ["stall current", "stall torque"])
        self.assertIs(checked["consistent"], False)
        (self.path / "a.toml").write_text(shipped.replace('["nominal torque"]', '["stall current"]'))
        self.assertIn("names a relation that holds; remove it", self.run_program("motor", "check", "a.toml", code=2).stderr)

    def test_every_built_in_motor_is_one_line_and_shows_as_json(self):
        lines = self.run_program("motor", "list").stdout.splitlines()[1:]
        self.assertGreaterEqual(len(lines), 30)
        for line in lines:
            shown = json.loads(self.run_program("motor", "show", "--json", line.split()[0]).stdout)
            self.assertEqual(shown["model"]["simulatable"], "not simulatable" not in line, line)
            self.assertEqual(shown["model"]["pole_pairs"] or "-", int(line.split()[1]) if line.split()[1] != "-" else "-")


if __name__ == "__main__":
    unittest.main()
