#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep design: its text, its files, and the input that it refuses."""
import json
import re
import signal
import struct
import subprocess
import time
import tomllib
import unittest

from program import PROGRAM, SOURCE, ProgramTest

def mat_variables(data):
    """Reads an uncompressed MAT file of level 5, written only from the specification. Returns {name: rows of numbers,
    or text}."""
    def elements(at, end):
        while at < end:
            kind, size = struct.unpack_from("<II", data, at)
            if kind >> 16:  # a small element has its size and its data in the same eight bytes
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


class Design(ProgramTest):
    def test_an_interval_rises_and_an_expected_rounding_is_nothing(self):
        """The lower end of the interval is printed first. For a slow speed loop the gain of the linear loop is the
        lower end. Each number has its own explanation."""
        for settle in ((), ("--settle", "0.15", "--rotor", "ideal"), ("--settle", "0.3")):
            told = self.run_program("design", "maxon-251601", "--mode", "position", "--quick", *settle, code=None).stdout
            found = re.search(r"found by (\d+) simulation(s?); the search began between (\S+) \((.*?)\) and (\S+) \((.*?)\)", told)
            self.assertTrue(found, told)
            self.assertLessEqual(float(found.group(3)), float(found.group(5)))
            self.assertEqual(found.group(1) == "1", found.group(2) == "")
            self.assertEqual({found.group(4), found.group(6)}, {"full torque stops the drive from top speed", "no limit acts"})
        told = self.run_program("design", "maxon-251601", "--mode", "current", "--method", "cancellation", "--quick", code=None).stdout
        self.assertRegex(told, r"overshoot +0 A +0 A +designed")
        self.assertNotRegex(told, r"e\+\d+ %|e-1\d")

    def test_a_table_names_the_band_of_each_settling_time(self):
        told = self.run_program("design", "maxon-251601", "--mode", "speed", "--quick").stdout
        self.assertRegex(told, r"step: settling +900 us to 2 % +[\d.]+ ms to 10 %\n")
        told = self.run_program("design", "maxon-251601", "--mode", "speed", "--quick", "--rotor", "ideal").stdout
        self.assertRegex(told, r"step: settling to 2 % +900 us +[\d.]+ ms\n")

    def test_a_warnings_period_is_the_longest_that_removes_it(self):
        """The ripple and the phase margin have different limits of the period. At the period that a warning names,
        the warning disappears. At a period 5 % longer the warning is printed."""
        def cures(period_s):
            told = self.run_program("design", "maxon-251601", "--quick", "--chopping", "complementary", "--period", f"{period_s!r}").stdout
            found = {word: re.search(rf"  - .*{word}.*\n(?:    with (?!--period).*\n)*(?:    with --period (\S+) the design gives no such warning)?", told) for word in ("has a phase margin", "PWM ripple")}
            return {word: m and float(m[1] or "nan") for word, m in found.items()}
        both = cures(69.6e-6)
        self.assertGreater(both["has a phase margin"], 1.2 * both["PWM ripple"])
        for word, period_s in both.items():
            self.assertIsNone(cures(period_s)[word])
            self.assertIsNotNone(cures(1.05 * period_s)[word])

    def test_an_expected_settling_time_says_that_it_has_the_wait_for_the_sample(self):
        for way, wait_s, source in (("phases", 0, "designed, at the samples, 2 %"), ("dc-link", 15e-6, "designed, and T_s/2 to the first sample, 2 %")):
            text = self.run_program("design", "maxon-251601", "--quick", "--currents", way).stdout
            designed = float(re.search(r"step: settling to 2 % +(\S+) us", text).group(1))
            expected, said = re.search(r"settling time +(\S+) us +\S+ \S+ +\S+ % +(.*)", text).groups()
            self.assertAlmostEqual(float(expected) - designed, 1e6 * wait_s, delta=0.51)
            self.assertEqual(said, source)

    def test_a_ripple_is_judged_over_an_electrical_turn(self):
        """At 2 rad/s and with eight pole pairs a sector lasts 65 ms. The printed ripple is equal to the ripple of a
        longer run."""
        told = self.run_program("design", "maxon-251601", "--mode", "speed", "--quick", "--lowest-speed", "2", "--rotor", "encoder",
                                "--toml", "q.toml", code=None).stdout
        printed = float(re.search(r"speed ripple +\S+ rad/s +(\S+) rad/s", told).group(1))
        last = tomllib.loads((self.path / "q.toml").read_text())["duration_s"]
        self.run_program("run", "q.toml", "--set", f"duration_s={last + 1}", "--csv", "o.csv", "--quiet", code=None)
        rows = [line.split(",") for line in (self.path / "o.csv").read_text().splitlines() if not line.startswith("#")]
        speed, t = rows[0].index("speed_rad_s"), 0
        seen = [float(row[speed]) for row in rows[1:] if float(row[t]) > last]
        self.assertAlmostEqual(printed, max(seen) - min(seen), delta=0.2 * printed)

    def test_what_fails_at_a_corner_is_within_the_tolerances(self):
        told = self.run_program("design", "maxon-251601", "--step", "20", code=1).stdout
        self.assertRegex(told, r"^NOT USABLE: within the tolerances it never settles: with R ")
        self.assertNotIn("out of tolerance", told)

    def test_a_sample_in_the_middle_makes_the_loop_half_a_period_later(self):
        """A delay of 30 us reduces the phase at the crossover frequency f by 360 f 30 us. A sample in the middle of
        the period, in place of its start, has half of this effect."""
        margins = {}
        for way in ("phases", "dc-link"):
            told = self.run_program("design", "maxon-251601", "--quick", "--currents", way).stdout
            for when, angle in re.findall(r"phase margin, (.*?) {2,}([\d.]+) deg", told):
                margins[when] = float(angle)
            crossover = float(re.search(r"crossover +([\d.]+) kHz", told).group(1)) * 1e3
        self.assertIn("a command acts 1.5 periods late, sampled in the middle of a period", told)
        half = 360 * crossover * 15e-6
        for sooner, later in (("no computation delay", "command half a period late"), ("command half a period late", "one period late"),
                              ("one period late", "1.5 periods late")):
            self.assertAlmostEqual(margins[sooner] - margins[later], half, delta=0.3)

    def test_a_new_current_scenario_foretells_its_own_run(self):
        """The scenario samples in the middle of a period, and the command acts one period later: 1.5 periods. The
        expected overshoot includes this delay."""
        for motor in ("maxon-251601", "dji-2212-920kv"):
            self.run_program("new", f"{motor}-held", "--mode", "current", "--motor", motor)
            rows = self.run_program("run", f"{motor}-held.toml").stdout
            expected, measured, percent = re.search(r"overshoot +([\d.]+ m?A) +([\d.]+ m?A) +([-+]?[\d.]+) %", rows).groups()
            self.assertLess(abs(float(percent)), 3, f"{motor}: {expected}, {measured}")
            settling = re.search(r"settling time +([\d.]+) us +([\d.]+) us", rows)
            self.assertLessEqual(abs(float(settling.group(1)) - float(settling.group(2))), 30.1, motor)

    def test_a_mean_above_the_samples_is_bounded_by_the_ripple_at_its_duty(self):
        """A phase has R = 0.4 ohm and L = 0.65 mH. At 1 A and U = 24 V the duty d is 2 R I/U, and the ripple is U d
        (1 - d) T/(2 L), with the period T."""
        told = self.run_program("new", "held", "--mode", "current", "--motor", "anaheim-bly172s").stdout
        self.assertIn("note: The current is sampled at the start of each period", told)
        text = (self.path / "held.toml").read_text()
        amperes, period = (float(re.search(rf"(?m)^{key} = (\S+)", text).group(1)) for key in ("value", "period_s"))
        duty = 2 * 0.4 * amperes / 24
        ripple = 24 * duty * (1 - duty) * period / (2 * 0.65e-3)
        self.assertAlmostEqual(float(re.search(r"(?m)^max = (\S+)", text).group(1)), 1.02 * amperes + ripple / 2, delta=1e-3 * amperes)

    def test_a_usable_verdict_says_a_little_phase_margin(self):
        for settle, little in (("1 ms", False), ("0.5 ms", True)):
            told = self.run_program("design", "maxon-251601", "--settle", settle, "--chopping", "complementary", "--quick").stdout
            margin = float(re.search(r"phase margin, one period late +([\d.]+) deg", told).group(1))
            self.assertEqual(margin < 45, little)
            words = re.search(r"^usable, with little phase margin \(([\d.]+) deg\), ", told)
            self.assertEqual(float(words.group(1)) if words else None, margin if little else None)

    def test_design_prints_verdict_first_then_every_step(self):
        text = self.run_program("design", "maxon-251601").stdout
        self.assertRegex(text.splitlines()[0], r"^usable, 2 warnings: the current loop settles within 2 % in 930 us, 1\.02 ms at worst \(designed: 900 us\), .*; with Hall probes, over 10 motors within the tolerances$")
        self.assertRegex(text, r"  d1 +4\.09559 +.* thesis 4\.5\n")
        self.assertRegex(text, r"  Re z +0\.869154 +.* thesis 0\.8588\n")
        self.assertIn("phase margin, one period late         59.8 deg", text)
        self.assertIn("held up to 71.6 rad/s = i R_tt/K_t", text)
        self.assertEqual(self.names(), [])

    def test_design_writes_a_scenario_that_runs_and_is_exported_with_the_same_gains(self):
        for mode, figures in (("current", 3), ("speed", 8), ("position", 5)):
            self.run_program("design", "maxon-251601", "--mode", mode, "--quick", "--quiet", "--toml", "d.toml",
                             "--json", "d.json")
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
            # The board has no dead time. The design's test uses a value that is usual for gate drivers.
            self.assertRegex((self.path / "d.toml").read_text(), r"(?m)^# bridge\.dead_time_s: the design used 0\.5 us, the usual value of small bridges")
            self.run_program("export", "header", "d.toml", "--out", "d.hpp")
            d1 = float(designed["loops"][0]["gains"]["d1"]).hex()
            mantissa, exponent = d1.split("p")
            self.assertIn(f"{mantissa.rstrip('0')}p{exponent}", (self.path / "d.hpp").read_text())
            (self.path / "d.hpp").unlink()

    def test_a_field_oriented_drive_is_looked_at_with_its_own_loops(self):
        field = str(SOURCE / "data/scenarios/gallery/field-weakened.toml")
        told = self.run_program("design", "--scenario", field).stdout
        for words in ("Current loop, zero on the winding's pole", "Speed loop", "torque per i_q", "U_s/sqrt 3", "weakening, per sample"):
            self.assertIn(words, told)
        d = json.loads(self.run_program("design", "--scenario", field, "--json", "-", "--quiet").stdout)
        self.assertEqual([loop["name"] for loop in d["loops"]], ["current", "speed"])
        self.assertEqual(d["drive"], "field-oriented")
        self.assertTrue(d["usable"])
        self.assertTrue(all(loop["margins"]["one_period_late"]["stable"] for loop in d["loops"]))
        self.run_program("design", "--scenario", field, "--json", "f.json", "--quiet")
        self.assertEqual(json.loads((self.path / "f.json").read_text()), d)

    def test_six_step_options_are_refused_of_a_field_oriented_drive(self):
        field = str(SOURCE / "data/scenarios/gallery/field-weakened.toml")
        said = self.run_program("design", "--scenario", field, "--settle", "0.1", "--html", "f.html", code=2).stderr
        self.assertIn("--settle", said)
        self.assertIn("--html", said)
        self.assertFalse((self.path / "f.html").exists())

    def test_controllers_that_it_would_pass_over_are_refused(self):
        (self.path / "s.toml").write_text('motor = "maxon-251601"\nduration_s = 0.1\n[control]\nmode = "speed"\n'
                                          '[control.speed]\nlaw = "sliding-mode"\n[control.current]\ntype = "deadbeat"\n'
                                          "[reference]\nvalue = 100\n")
        said = self.run_program("design", "--scenario", "s.toml", code=2).stderr
        for key in ("control.current.type", "control.speed.law"):
            self.assertIn(f"{key} = ", said)
        self.assertIn('set this key to "pi"', said)

    def test_design_of_a_motor_file_names_it_as_the_scenario_sees_it(self):
        (self.path / "mine.toml").write_text((SOURCE / "data/motors/maxon-251601.toml").read_text())
        (self.path / "out").mkdir()
        self.run_program("design", "mine.toml", "--quick", "--quiet", "--toml", "out/d.toml")
        self.assertIn('motor = "../mine.toml"', (self.path / "out/d.toml").read_text())
        self.run_program("run", "out/d.toml", "--quiet")

    def test_design_json_has_bode_step_margins_and_worst_corners(self):
        result = self.run_program("design", "maxon-251601", "--mode", "speed", "--rotor", "ideal", "--delay", "0",
                                  "--torque-limit", "0.78", "--json", "-", "--quiet")
        d = json.loads(result.stdout)
        self.assertEqual([loop["name"] for loop in d["loops"]], ["current", "speed"])
        self.assertEqual(d["tolerances"]["motors"], 26)
        for loop in d["loops"]:
            self.assertTrue(loop["margins"]["one_period_late"]["stable"])
            w, gain, crossover = loop["bode"]["w_rad_s"], loop["bode"]["gain"], loop["margins"]["at_once"]["crossover_rad_s"]
            self.assertLess(max(x for x, g in zip(w, gain) if g > 1), crossover)
            self.assertGreater(min(x for x, g in zip(w, gain) if g < 1), crossover)
            self.assertAlmostEqual(loop["step"]["value"][-1], 1, 2)
        steps = {s["symbol"]: s for s in d["loops"][1]["steps"]}
        self.assertAlmostEqual(steps["d1"]["value"], 0.0158299, 7)
        self.assertEqual(steps["d1"]["thesis"], 0.017225)

    def test_a_linear_motor_has_options_of_its_own(self):
        result = self.run_program("design", "example-linear", "--mode", "speed", "--quick", "--force-limit", "15", "--load-mass", "0.1",
                                  "--json", "-", "--quiet", "--toml", "d.toml", "--models", "m.json")
        d = json.loads(result.stdout)
        self.assertAlmostEqual(d["limits"]["force_limit_N"], 15)
        self.assertAlmostEqual(d["model"]["mass_kg"], 0.13375)
        self.assertIn("v_m_s", json.loads((self.path / "m.json").read_text())["phase_voltage"]["states"])
        self.assertIn("force_limit_N = 15", (self.path / "d.toml").read_text())
        ran = json.loads(self.run_program("run", "d.toml", "--json", "-", "--quiet").stdout)
        self.assertEqual(ran["gains"][1]["d1"], d["loops"][1]["gains"]["d1"])
        told = self.run_program("design", "example-linear", "--torque-limit", "1", code=2).stderr
        self.assertEqual(told, "--torque-limit = 1 applies to rotary motors only, and this motor is linear; write --force-limit\n")
        told = self.run_program("design", "maxon-251601", "--load-mass", "1", code=2).stderr
        self.assertEqual(told, "--load-mass = 1 applies to linear motors only, and this motor is rotary; write --load-inertia\n")

    def test_an_option_that_enters_nothing_is_refused_by_name(self):
        """For each option of the help and each kind of design: the option either changes the numbers, or is refused
        with its name."""
        values = {"--settle": "2e-3", "--damping": "0.8", "--current-settle": "2e-3", "--method": "cancellation", "--bandwidth": "500", "--period": "25e-6",
                  "--voltage": "20", "--torque-limit": "0.3", "--force-limit": "3", "--rotor": "encoder", "--edges": "3", "--capture": "2e6", "--lowest-speed": "55", "--currents": "dc-link",
                  "--load-inertia": "1e-6", "--load-mass": "0.1", "--delay": "0", "--chopping": "complementary", "--step": "1.5", "--mode": "speed", "--angle": "10",
                  "--html": "o.html", "--models": "o.json", "--quick": None}
        helped = set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", self.run_program("design", "--help").stdout, re.M))
        only_how = {"--help", "--scenario", "--json", "--toml", "--optimise", "--store", "--resume", "--force", "--quiet", "--jobs", "--data"}
        self.assertEqual(helped - only_how, set(values), "an option that no test has seen")
        field, plan = str(SOURCE / "data/scenarios/gallery/machine-sine-field.toml"), str(SOURCE / "data/plans/best-pwm.toml")
        for words in (["--scenario", field], ["--optimise", plan]):
            for option, value in values.items():
                with self.subTest(words=words, option=option):
                    told = self.run_program("design", *words, option, *([value] if value else []), code=2).stderr
                    self.assertIn(option, told)
        self.assertIn("MOTOR applies to a single design", self.run_program("design", "maxon-251601", "--optimise", plan, code=2).stderr)
        changes = ["--settle", "--damping", "--method", "--period", "--voltage", "--rotor", "--currents", "--delay", "--chopping", "--step"]
        idle = ["--current-settle", "--torque-limit", "--edges", "--capture", "--lowest-speed", "--load-inertia", "--load-mass", "--force-limit", "--bandwidth", "--angle"]
        quick = ["design", "maxon-251601", "--quick", "--quiet", "--json", "-"]
        plain = self.run_program(*quick).stdout
        for option in changes:
            with self.subTest(option=option):
                result = subprocess.run([PROGRAM, *quick, option, values[option]], cwd=self.path, capture_output=True, text=True, check=False)
                self.assertIn(result.returncode, (0, 1), result.stderr)
                self.assertNotEqual(result.stdout, plain)
        for option in idle:
            with self.subTest(option=option):
                self.assertRegex(self.run_program(*quick, option, values[option], code=2).stderr, f"(^|design ){option} ")
        self.assertEqual(self.run_program(*quick, "--torque-limit", "0.3", code=2).stderr,
                         "--torque-limit applies only to a speed loop, which --mode current does not have; add --mode speed or --mode position, or leave this option out\n")

    def test_design_writes_a_page_that_needs_nothing(self):
        self.run_program("design", "maxon-251601", "--mode", "speed", "--quiet", "--html", "d.html")
        page = (self.path / "d.html").read_text()
        self.assertTrue(page.startswith("<!doctype html>") and page.endswith("</html>\n"))
        self.assertIn("sixstep design maxon-251601 --mode speed --quiet --html d.html", page)
        self.assertNotRegex(page, r'(src|href)="(?!data:)')
        self.assertEqual(self.names(), ["d.html"])

    def test_an_interrupted_design_leaves_nothing_behind(self):
        # A very slow loop: the design simulates a minute for each motor.
        design = subprocess.Popen([PROGRAM, "design", "maxon-251601", "--mode", "speed", "--settle", "5", "--toml", "d.toml"],
                                  cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not self.names():  # as soon as the outputs are open, the run has begun
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
            # The expected values follow model.md 1 for the sheet: R/L per phase, K_e f/L, 1/L.
            A, L, K_e = mat["phase_A"], 0.286e-3, 0.01675
            self.assertAlmostEqual(A[0][0], -1.03 / 0.572e-3, 9)
            # The shape has flat tops of 120 degrees and ramps of 60 between: c falls through 0 at 30, b rises through 0 at 90.
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
        self.assertIn("is not used by pole placement", told("maxon-251601", "--bandwidth", "100"))
        self.assertIn('did you mean "maxon-251601"?', told("maxon-25160"))
        self.assertIn("--voltage is missing, and the sheet prints no nominal voltage", told("mjbots-mj5208"))
        self.assertIn("cannot be written", self.run_program("design", "maxon-251601", "--json", "no/d.json", code=2).stderr)
        # A fast loop with a delay and soft chopping: only the simulation shows its oscillation.
        text = told("maxon-251601", "--settle", "0.5e-3", "--delay", "1", code=1)
        self.assertRegex(text.splitlines()[0], "^NOT USABLE: in the simulation, with soft chopping, it never settles$")
        self.assertIn("usable with --chopping complementary", text)

    def test_no_header_is_exported_of_a_design_that_is_not_usable(self):
        bad = ("design", "maxon-251601", "--mode", "speed", "--edges", "1", "--capture", "5e4", "--quick", "--quiet", "--toml", "d.toml")
        self.run_program(*bad, code=1)
        export = ("export", "header", "d.toml", "--arithmetic", "float", "--out", "d.hpp")
        self.assertIn("not_usable was set by the design", self.run_program(*export, code=2).stderr)
        self.assertIn("NOT USABLE", self.run_program("run", "d.toml").stdout)
        self.assertEqual(self.names(), ["d.toml"])
        # A second design on the same board with the advised value: the warning is gone.
        self.run_program("design", "--scenario", "d.toml", "--mode", "speed", "--capture", "1e6", "--quick", "--quiet", "--toml", "e.toml")
        self.assertNotIn("not_usable", (self.path / "e.toml").read_text())


if __name__ == "__main__":
    unittest.main()
