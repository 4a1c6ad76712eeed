#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sixstep run with many runs: the varied keys, the stored values, and that a kill destroys no finished run."""
import base64
import contextlib
import csv
import json
import os
import random
import re
import shlex
import signal
import sqlite3
import struct
import subprocess
import time
import unittest
import unittest.mock
import xml.etree.ElementTree

import cells
from program import PROGRAM, SHORT, SOURCE, ProgramTest

KILLS = int(os.environ.get("SIXSTEP_KILLS", "10"))
SPREAD = '[[spread]]\nkey = "motor_override.resistance_ohm"\nrelative = 0.1\n'
PLAN = """
title = "Held at two voltages"
scenario = "a.toml"
notes = "The current is the voltage over the resistance."
[[vary]]
key = "supply.voltage_V"
values = [12, 24]
[[vary]]
key = "motor_override.resistance_ohm"
from = 1.0
to = 2.0
points = 3
"""


class Plan(ProgramTest):
    def held(self, more=""):
        """A scenario with a held rotor that lasts thirty time constants. The final current is U/R."""
        (self.path / "a.toml").write_text(SHORT.format(limit=20).replace("1e-4", "20e-3") + more)
        return "a.toml"

    def rows(self, store, what="*"):
        with contextlib.closing(sqlite3.connect(self.path / store)) as db:
            return db.execute(f"SELECT {what} FROM runs ORDER BY run").fetchall()

    def test_a_grid_is_every_value_with_every_other(self):
        file = self.held()
        table = self.run_program("run", file, "--vary", "supply.voltage_V=12,24", "--vary",
                                 "motor_override.resistance_ohm=1:2:3", "--json", "a.json", code=1).stdout
        self.assertRegex(table, r"6 runs: 5 hold every requirement, 1 do NOT")
        plan = json.loads((self.path / "a.json").read_text())
        self.assertEqual([row[3:5] for row in plan["rows"]], [[u, r] for u in (12, 24) for r in (1, 1.5, 2)])
        for row in plan["rows"]:
            self.assertAlmostEqual(row[5], row[3] / row[4], places=9)
            self.assertEqual(row[2], row[3] / row[4] <= 20)
        self.assertEqual(self.names(), ["a.json", "a.toml"])

    def test_a_plan_file_says_the_same(self):
        self.held()
        (self.path / "p.toml").write_text(PLAN)
        by_file = self.run_program("run", "p.toml", "--csv", "p.csv", code=1).stdout
        by_words = self.run_program("run", "a.toml", "--vary", "supply.voltage_V=12,24", "--vary",
                                    "motor_override.resistance_ohm=1:2:3", "--csv", "a.csv", code=1).stdout
        self.assertEqual(by_file.splitlines()[1:], by_words.splitlines()[1:])
        table = list(csv.reader(line for line in (self.path / "p.csv").read_text().splitlines() if line[0] != "#"))
        self.assertEqual(table[0][:6], ["run", "end", "passed", "supply.voltage_V [V]", "motor_override.resistance_ohm [ohm]",
                                        "current [A]"])
        self.assertEqual(len(table), 7)
        self.assertEqual((self.path / "p.csv").read_text().splitlines()[3:], (self.path / "a.csv").read_text().splitlines()[3:])

    def test_one_run_of_a_plan_is_a_run_as_any_other(self):
        self.held()
        (self.path / "p.toml").write_text(PLAN)
        self.run_program("run", "p.toml", "--json", "p.json", code=1)
        plan = json.loads((self.path / "p.json").read_text())
        self.run_program("run", "p.toml", "--only", "3", "--json", "one.json", "--csv", "one.csv", code=1)
        one = json.loads((self.path / "one.json").read_text())
        self.assertEqual(one["digest"], plan["rows"][3][-1])
        self.assertEqual(one["require"][0]["measured"], plan["rows"][3][5])
        self.assertIn("numbers 0 to 5", self.run_program("run", "p.toml", "--only", "6", code=2).stderr)

    def test_a_run_of_a_plan_has_the_remarks_of_the_run_alone(self):
        """The table and a resumed store have all remarks of the single runs. If a remark has different numbers in
        several runs, it is one line, which names the runs."""
        (self.path / "b.toml").write_text(SHORT.format(limit=1e3).replace("1e-4", "2e-3").replace("locked = true", "dynamometer_times_s = [0]\ndynamometer_rad_s = [2000]"))
        vary = ["run", "b.toml", "--vary", "pwm.period_s=5us,20us,40us", "--set", "heat.step_s=1"]
        alone = [json.loads(self.run_program(*vary, "--only", str(n), "--json", "-", code=None).stdout)["remarks"] for n in range(3)]
        short = [[r for r in remarks if "a commutation step lasts" in r] for remarks in alone]
        self.assertEqual([len(r) for r in short], [0, 1, 1])
        for store in ([], ["--store", "s.sqlite"], ["--store", "s.sqlite", "--resume"]):
            page = f"{len(store)}.json"
            table = self.run_program(*vary, *store, "--json", page, code=None).stdout
            told = json.loads((self.path / page).read_text())["remarks"]
            for n in range(3):
                self.assertEqual(sum(n in r["runs"] for r in told), len(alone[n]))
            for remark in told:
                self.assertIn(remark["text"], alone[remark["runs"][0]])
            self.assertIn(f"  remark, runs 1, 2 (with the numbers of run 1): {short[1][0]}\n", table)
            self.assertIn("  remark, all runs: keys without effect: ", table)

    def test_a_drive_of_ideal_sensors_is_given_no_seed(self):
        self.held(SPREAD)
        self.run_program("run", "a.toml", "--runs", "3", "--json", "s.json", code=None)
        self.assertEqual(json.loads((self.path / "s.json").read_text())["remarks"], [])

    def test_a_controller_is_designed_for_each_value_or_stays_as_it_was(self):
        """By default the controller is designed for each varied value. For a key with a tolerance the gains stay as
        for the written value: the run has the same bits as a run with these gains."""
        (self.path / "b.toml").write_text('motor = "maxon-251601"\nduration_s = 4e-3\n[control]\nmode = "current"\n'
                                          "[control.current]\nsettle_s = 1e-3\ndamping = 0.9\n[reference]\nvalue = 5\n[load]\nlocked = true\n")
        (self.path / "g.toml").write_text((self.path / "b.toml").read_text().replace("settle_s = 1e-3\ndamping = 0.9\n", ""))

        def digest(*words):
            summary = json.loads(self.run_program("run", *words, "--json", "-").stdout)
            return summary["digest"], summary["gains"]
        _, (gains,) = digest("b.toml")
        resistance = ["--set", "motor_override.resistance_ohm=2.0"]
        fixed = ["--set", f"control.current.d1={gains['d1']!r}", "--set", f"control.current.d0={gains['d0']!r}"]
        for strays, truth in (("false", digest("b.toml", *resistance)), ("true", digest("g.toml", *resistance, *fixed))):
            (self.path / "p.toml").write_text('scenario = "b.toml"\n[[vary]]\nkey = "motor_override.resistance_ohm"\n'
                                              f"values = [1.5, 2.0]\nstrays = {strays}\n")
            self.run_program("run", "p.toml", "--json", "p.json")
            self.assertEqual(json.loads((self.path / "p.json").read_text())["rows"][1][-1], truth[0], strays)

    def test_a_store_goes_on_where_it_stopped_and_grows(self):
        file = self.held(SPREAD)
        run = ["run", file, "--runs", "30", "--store", "s.sqlite"]
        self.run_program(*run, code=1)
        self.assertIn("already contains runs", self.run_program(*run, code=2).stderr)
        self.run_program("run", file, "--runs", "30", "--store", "s.sqlite", "--resume", code=1)
        self.assertEqual(len(self.rows("s.sqlite")), 30)
        more = self.run_program("run", file, "--runs", "50", "--store", "s.sqlite", "--resume", code=1).stdout
        self.assertEqual(more, self.run_program("run", file, "--runs", "50", code=1).stdout)
        few = self.run_program("run", file, "--runs", "10", "--store", "s.sqlite", "--resume", code=1).stdout
        self.assertEqual(few, self.run_program("run", file, "--runs", "10", code=1).stdout)
        self.assertIn("another plan", self.run_program("run", file, "--runs", "50", "--seed", "2", "--store", "s.sqlite", "--resume",
                                                       code=2).stderr)
        self.held(SPREAD.replace("0.1", "0.2"))
        self.assertIn("changed since", self.run_program("run", file, "--runs", "50", "--store", "s.sqlite", "--resume", code=2).stderr)
        self.assertIn("--store", self.run_program("run", file, "--runs", "50", "--resume", code=2).stderr)
        self.run_program("run", file, "--runs", "5", "--store", "s.sqlite", "--force", code=1)
        self.assertEqual(len(self.rows("s.sqlite")), 5)

    def test_another_program_is_noticed_by_its_bits(self):
        file = self.held(SPREAD)
        self.run_program("run", file, "--runs", "5", "--store", "s.sqlite", code=1)
        cells.sealed(self.path / "s.sqlite", "UPDATE run SET digest = '0123456789abcdef' WHERE run = 0")
        self.assertIn("another version of sixstep",
                      self.run_program("run", file, "--runs", "9", "--store", "s.sqlite", "--resume", code=2).stderr)

    def test_kills_take_nothing_that_was_finished(self):
        """The program is killed at random instants and resumed. The table has the same bits as the table without an
        interruption."""
        seed = random.randrange(2**32)
        draw = random.Random(seed)
        file = self.held(SPREAD)
        words = ["run", file, "--runs", "4000"]
        self.run_program(*words, "--csv", "whole.csv", code=1)
        before, kills = 0, 0
        while kills < KILLS:
            with subprocess.Popen([PROGRAM, *words, "--store", "s.sqlite", "--resume", "--quiet"], cwd=self.path) as program:
                time.sleep(draw.uniform(0.01, 0.15))
                program.send_signal(signal.SIGKILL)
            if program.returncode != -signal.SIGKILL:
                (self.path / "s.sqlite").unlink()  # the plan was complete, so start again
                before = 0
                continue
            kills += 1
            if not (self.path / "s.sqlite").exists():
                continue
            try:
                now = len(self.rows("s.sqlite", "run"))
            except sqlite3.OperationalError as missing:  # the program was killed before it created the tables
                self.assertIn("no such table", str(missing))
                now = 0
            self.assertGreaterEqual(now, before, f"seed {seed}")
            before = now
        self.run_program(*words, "--store", "s.sqlite", "--resume", "--csv", "killed.csv", code=1)
        whole, killed = ((self.path / name).read_text().splitlines()[3:] for name in ("whole.csv", "killed.csv"))
        self.assertEqual(whole, killed, f"seed {seed}")
        self.assertEqual(len(whole), 4001)

    def test_several_processes_need_a_build_with_mpi(self):
        """Without MPI each process would make all the runs. One process prints this message. A plan on one rank, and
        other verbs on any number of ranks, run as usual."""
        file = self.held()
        for names in ("OMPI_COMM_WORLD_SIZE OMPI_COMM_WORLD_RANK", "PMI_SIZE PMI_RANK", "SLURM_STEP_NUM_TASKS PMIX_RANK"):
            size, rank = names.split()
            told = []
            for n in ("0", "1"):
                with unittest.mock.patch.dict(os.environ, {size: "2", rank: n}):
                    told.append(self.run_program("run", file, "--runs", "3", code=2).stderr)
                    self.run_program("motor", "list")
            self.assertIn("started 2 processes, but this build has no MPI", told[0])
            self.assertEqual(told[1], "")
            with unittest.mock.patch.dict(os.environ, {size: "1", rank: "0"}):
                self.run_program("run", file, code=1)

    def test_indices_say_which_key_a_figure_hangs_on(self):
        """I = U/R. The variance of ln I is the sum of the variances of ln U and ln R. Over small ranges I is nearly
        linear in both keys, so the indices are equal to these parts."""
        file = self.held()
        words = ["run", file, "--vary", "supply.voltage_V=23:25", "--vary", "motor_override.resistance_ohm=1.02:1.04", "--vary",
                 "load.torque_Nm=0:0.1", "--sampling", "saltelli", "--points", "200", "--set", "require=[]", "--set",
                 'compare=[{metric="final",signal="current",value=20,source="U/R"}]']
        self.run_program(*words, "--json", "s.json")
        plan = json.loads((self.path / "s.json").read_text())
        self.assertEqual(plan["runs"], 1000)
        voltage, resistance, torque = plan["indices"][0]
        share = (2 / 24) ** 2 / ((2 / 24) ** 2 + (0.02 / 1.03) ** 2)
        for index, truth in ((voltage, share), (resistance, 1 - share), (torque, 0)):
            for kind in ("first", "total"):
                self.assertLessEqual(index[kind]["low"] - 0.01, truth)
                self.assertGreaterEqual(index[kind]["high"] + 0.01, truth)
        self.assertLess(torque["total"]["value"], 1e-9)

    def test_it_tells_what_a_plan_would_take(self):
        told = self.run_program("run", self.held(SPREAD), "--vary", "supply.voltage_V=12:24:7", "--runs", "100", "--dry-run",
                                "--store", "s.sqlite").stdout
        self.assertIn("7 points of 100 drives each: 700 runs", told)
        sobol = self.run_program("run", self.held(SPREAD), "--vary", "supply.voltage_V=12:24", "--vary", "load.torque_Nm=0:0.1", "--sampling",
                                 "saltelli", "--points", "50", "--dry-run").stdout
        self.assertIn("200 points, 50 x (keys + 2): 200 runs", sobol)
        self.assertRegex(told, r"a run on one core \(16 tried\), about .* on \d+ cores")
        self.assertEqual(self.names(), ["a.toml"])

    def test_it_tells_by_how_many_threads(self):
        told = self.run_program("run", self.held(SPREAD), "--runs", "100", "--dry-run", "--jobs", "3").stdout
        self.assertRegex(told, r"about .* on 3 cores")

    def test_what_a_plan_alone_can_do_is_never_passed_over(self):
        varied = ["--vary", "supply.voltage_V=12:24:7"]
        for words, told in ((["--dry-run"], "--vary is missing"), (["--store", "s.sqlite"], "--vary is missing"),
                            (["--points", "5"], "--vary is missing"), (["--sampling", "sobol"], "--vary is missing"),
                            (["--resume"], "--resume continues the runs of a store"),
                            (["--tolerances"], "--tolerances needs several drives"),
                            ([*varied, "--tolerances"], "--tolerances needs several drives"),
                            ([*varied, "--watch"], "--watch repeats one scenario"),
                            ([*varied, "--vary", "supply.voltage_V=5,6"], "is varied already"),
                            ([*varied, "--set", "supply.voltage_V=6"], "--set supply.voltage_V has no effect, because the plan varies this key"),
                            ([*varied, "--points", "4", "--sampling", "grid"], "--points = 4 applies only to drawn points")):
            self.assertIn(told, self.run_program("run", self.held(), *words, code=2).stderr)
        self.assertEqual(self.names(), ["a.toml"])

    def test_keys_of_lists_have_their_units(self):
        at = "[[at]]\ntime_s = 1e-5\nload.torque_Nm = 0\n"
        table = self.run_program("run", self.held(at), "--vary", "at[0].load.torque_Nm=1 mNm:2 mNm:2", code=1).stdout
        self.assertIn("2 mN m", table)

    def test_tolerances_need_no_spread(self):
        table = self.run_program("run", self.held(), "--tolerances", "--runs", "50", "--store", "s.sqlite", code=1).stdout
        self.assertIn("50 drives, seed 1", table)
        r = [row[0] for row in self.rows("s.sqlite", '"drive: motor_override.resistance_ohm [ohm]"')]
        self.assertTrue(all(0.9 * 1.03 <= x <= 1.1 * 1.03 for x in r))
        self.assertGreater(max(r) - min(r), 0.1)

    def test_the_best_point_is_the_laws_and_its_limit_is_named(self):
        """The smallest current U/R that is at least 10 A is 10 A. The search can be resumed from a store, and the
        scenario that it writes has the same figure."""
        (self.path / "a.toml").write_text(SHORT.format(limit=1000).replace("1e-4", "20e-3").replace("max = 1000", "min = 10"))
        (self.path / "p.toml").write_text('scenario = "a.toml"\nminimise = "current"\nevaluations = 80\n'
                                          '[[vary]]\nkey = "supply.voltage_V"\nfrom = 6\nto = 24\n'
                                          '[[vary]]\nkey = "motor_override.resistance_ohm"\nfrom = 1\nto = 4\nspacing = "log"\n')
        words = ["design", "--optimise", "p.toml", "--json", "p.json", "--toml", "best.toml", "--store", "p.sqlite"]
        told = self.run_program(*words).stdout
        self.assertIn("limited by current", told)
        best = json.loads((self.path / "p.json").read_text())
        (voltage, resistance), (current,) = best["point"], best["figures"]
        self.assertAlmostEqual(current["worst"], voltage["value"] / resistance["value"], places=9)
        self.assertTrue(10 <= current["worst"] <= 10.01)
        self.assertEqual(best["limits"], [{"figure": "current", "end": "lower"}])
        few = (self.path / "p.toml").read_text().replace("evaluations = 80", "evaluations = 6")
        (self.path / "few.toml").write_text(few.replace("from = 6\nto = 24", "from = 20\nto = 24"))
        told_of_few = self.run_program("design", "--optimise", "few.toml", "--json", "few.json").stdout
        self.assertIn("not converged after 6 points", told_of_few)
        self.assertNotIn("nothing limits it", told_of_few)
        self.assertFalse(json.loads((self.path / "few.json").read_text())["converged"])
        alone = json.loads(self.run_program("run", "best.toml", "--json", "-").stdout)
        self.assertEqual(alone["require"][0]["measured"], current["worst"])
        rows = self.rows("p.sqlite")
        self.assertEqual(told, self.run_program(*words, "--resume").stdout)
        self.assertEqual(self.rows("p.sqlite"), rows)
        for wrong, why in (('minimise = "currant"', "did you mean current?"), ('sampling = "sobol"\npoints = 9', "does not name the figure to minimise")):
            (self.path / "q.toml").write_text((self.path / "p.toml").read_text().replace('minimise = "current"', wrong))
            self.assertIn(why, self.run_program("design", "--optimise", "q.toml", code=2).stderr)

    def test_verdicts_for_build_servers(self):
        """The counts of JUnit: one case per requirement, and one case for the run itself. Runs and plans have the
        same form."""
        held = self.held()
        missed = self.write("b & <c>.toml", 1)
        (self.path / "p.toml").write_text(PLAN)
        self.run_program("run", held, missed, "--junit", "runs.xml", code=1)
        self.run_program("run", "p.toml", "--junit", "plan.xml", code=1)
        runs, plan = (xml.etree.ElementTree.parse(self.path / name).getroot() for name in ("runs.xml", "plan.xml"))
        self.assertEqual([runs.get(key) for key in ("tests", "failures", "errors")], ["4", "2", "0"])
        self.assertEqual([suite.get("name") for suite in runs], ["a", "b & <c>"])
        for suite in runs:
            self.assertEqual([case.get("name") for case in suite], ["runs to its end", "current"])
            self.assertIn("required at most", suite[1][0].get("message"))
        self.assertEqual([plan.get(key) for key in ("tests", "failures", "errors")], ["2", "1", "0"])
        self.assertEqual(plan[0][1][0].get("message"), "holds in 5 of 6, required at most 20 A")
        self.run_program("run", "a.toml", "--vary", "bridge.dead_time_s=0,1", "--junit", "bad.xml", code=2)
        bad = xml.etree.ElementTree.parse(self.path / "bad.xml").getroot()
        self.assertEqual(bad.get("errors"), "1")
        self.assertIn("1 could not run, first run 1", bad[0][0][0].get("message"))
        self.run_program("run", held, "--junit", "runs.xml", code=1)  # replaces a file that sixstep has written
        (self.path / "other.xml").write_text("<?xml version='1.0'?><mine/>")
        self.run_program("run", held, "--junit", "other.xml", code=2)

    def test_mistakes_are_told_where_they_stand(self):
        self.held()
        for vary, told in (("supply.voltge_V=1:2:3", "did you mean supply.voltage_V?"),
                           ("supply.voltage_V", "KEY=FROM:TO:POINTS"),
                           ("supply.voltage_V=1:2:x", "is not a number of points"),
                           ("supply.voltage_V=1:2:3:cubic", "write log or linear"),
                           ("supply.voltage_V=1:2", "give at least 2 points"),
                           ("supply.voltage_V=-1:2:3:log", "must be above 0, like both ends of a logarithmic range"),
                           ("supply.voltage_V=1m:2m:3", "m"),
                           ("pwm.chopping=soft,hrad", "hrad"),
                           ("require[0].max=1,2", "must be the same in all runs"),
                           ("title=a,b", "must be the same in all runs")):
            code = 2
            result = self.run_program("run", "a.toml", "--vary", vary, code=code)
            self.assertIn(told, result.stderr + result.stdout, vary)
        plan = PLAN.replace("to = 2.0\n", "").replace("values", "value")
        (self.path / "p.toml").write_text(plan)
        told = self.run_program("run", "p.toml", code=2).stderr
        self.assertIn("p.toml:7:1: vary.value", told)
        self.assertIn("is one end of a range", told)
        (self.path / "p.toml").write_text(PLAN.replace("a.toml", "b.toml"))
        self.assertIn("b.toml", self.run_program("run", "p.toml", code=2).stderr)

    def test_a_corner_that_cannot_run_is_a_row(self):
        self.held()
        result = self.run_program("run", "a.toml", "--vary", "bridge.dead_time_s=0,1us", "--vary", "pwm.period_s=30us,1us", code=2)
        self.assertIn("could not run", result.stdout)

    def page(self, name):
        """The text of a page, and the data of its plots."""
        text = (self.path / name).read_text()
        data = json.loads(text.split('id="data">', 1)[1].split("</script>", 1)[0])
        return text, data["plans"]

    def test_a_window_behind_the_end_is_told_once_by_the_key_that_was_written(self):
        told = self.run_program("run", self.held(), "--set", "require[0].from_s=1.1", "--vary", "supply.voltage_V=12,24", code=2).stderr
        self.assertEqual(told.count("\n"), 1, told)
        self.assertIn("from_s = 1.1 is not before the end of the run (duration_s = 0.02)", told)

    def test_crossed_wires_in_a_speed_loop(self):
        """With the wiring "backward" each speed has the other sign. With "late" the speed is the same for every
        setpoint. With "early" the drive trips, and the output names the figures that are measured after the trip."""
        file = str(SOURCE / "data/scenarios/firmware/cortex-m.toml")
        sinks = ["--set", "supply.sinks=true"]  # backward braking would raise the bus until its monitor trips
        wires = ["--set", "bridge.phases=bac", "--vary", "sensors.hall_lines=213,321,132", *sinks]
        told = self.run_program("run", file, *wires, "--json", "a.json", code=3).stdout
        early, late, backward = (line.split()[-1] for line in told.splitlines() if re.match(r" +\d  ", line))
        self.assertEqual((early, late, backward), ("FAULT", "FAIL", "FAIL"))
        self.assertIn("1 stopped by a fault, first run 0: t = 0.14", told)
        _, late, backward = ([row[column] for column in (4, 6, 8)] for row in json.loads((self.path / "a.json").read_text())["rows"])
        for asked, back, held in zip((100, 300, 70), backward, late):
            self.assertLess(abs(back + asked), 0.01 * asked)
            self.assertLess(abs(held - late[0]), 1)
        alone = self.run_program("run", file, *wires[:2], *sinks, "--set", "sensors.hall_lines=213", code=3).stdout
        after = re.search("note: figures measured after the trip, with the drive off: (.*)", alone).group(1)
        self.assertEqual(after, ", ".join(f"{what} at {speed} rad/s" for speed in (100, 300, 70) for what in ("mean speed", "swing")))

    def test_a_page_has_every_run_and_says_how_to_look_at_one(self):
        self.held()
        (self.path / "p.toml").write_text(PLAN)
        self.run_program("run", "p.toml", "--html", "p.html", code=1)
        text, (plan,) = self.page("p.html")
        self.assertIn("of 6 runs hold every requirement", text)
        self.assertIn("The current is the voltage over the resistance.", text)
        self.assertEqual([c["name"] for c in plan["columns"]], ["supply.voltage_V", "motor_override.resistance_ohm", "current"])
        self.assertEqual(struct.unpack("<6f", base64.b64decode(plan["columns"][1]["data"])), (1, 1.5, 2) * 2)
        self.assertEqual(list(base64.b64decode(plan["states"])), [0, 0, 0, 1, 0, 0])
        self.run_program("run", "p.toml", "--html", "q.html", "--jobs", "2", code=1)
        made = [t.split("<footer>")[0] for t in (text, (self.path / "q.html").read_text())]
        self.assertEqual(*made)
        # The page's command makes the run that the page names.
        command = re.search(r"<pre class=\"text\">sixstep (run p.toml --only 3 --html run-3.html)</pre>", text).group(1)
        self.run_program(*command.split(), "--json", "3.json", code=1)
        self.assertAlmostEqual(json.loads((self.path / "3.json").read_text())["require"][0]["measured"], 24.0, places=9)
        self.assertIn("run-3.html", self.names())

    def test_the_command_for_one_run_has_what_the_plan_was_made_of(self):
        self.held(SPREAD)
        (self.path / "a.toml").write_text((self.path / "a.toml").read_text().replace("max = 20", "max = 200"))
        words = ["run", "a.toml", "--vary", "supply.voltage_V=12:24", "--points", "4", "--sampling", "latin-hypercube", "--seed", "7",
                 "--runs", "2", "--set", 'title="two words"']
        self.run_program(*words, "--html", "p.html", "--json", "p.json")
        plan = json.loads((self.path / "p.json").read_text())
        _, (page,) = self.page("p.html")
        self.run_program(*shlex.split(page["repeats"])[1:], "5", "--json", "one.json")
        self.assertEqual(json.loads((self.path / "one.json").read_text())["digest"], plan["rows"][5][-1])
        self.run_program("run", "a.toml", "--runs", "4", "--html", "s.html", "--json", "s.json")
        _, (page,) = self.page("s.html")
        self.run_program(*shlex.split(page["repeats"])[1:], "3", "--json", "one.json")
        self.assertEqual(json.loads((self.path / "one.json").read_text())["digest"], json.loads((self.path / "s.json").read_text())["rows"][3][-1])

    def test_a_folder_has_the_page_rows_store_and_reports_of_the_worst(self):
        self.held()
        (self.path / "p.toml").write_text(PLAN)
        (self.path / "p.toml").write_text(PLAN.replace("from = 1.0", "from = 1.1"))  # all values differ
        self.run_program("run", "p.toml", "--out", "out", code=1)
        self.assertEqual(self.names("out"), ["p.csv", "p.html", "p.json", "p.run-3.html", "p.run-4.html", "p.run-5.html", "p.sqlite"])
        text, (plan,) = self.page("out/p.html")
        self.assertEqual(plan["reports"], {f"{n}": f"p.run-{n}.html" for n in (3, 4, 5)})
        self.assertIn('<a href="p.run-3.html">', text)
        report = (self.path / "out/p.run-3.html").read_text()
        self.assertIn("sixstep run p.toml --only 3 --html out/p.run-3.html", report)
        self.assertIn("FAIL", report)
        self.assertEqual(len(self.rows("out/p.sqlite")), 6)
        self.assertIn("already contains runs", self.run_program("run", "p.toml", "--out", "out", code=2).stderr)
        self.run_program("run", "p.toml", "--out", "out", "--resume", code=1)
        self.run_program("run", "p.toml", "--out", "other", "--store", "s.sqlite", code=1)
        self.assertNotIn("p.sqlite", self.names("other"))

    def test_two_plans_share_a_page(self):
        """For each plan, the page has the same content as a page with this plan alone. Only the command that repeats
        a run differs."""
        self.held()
        (self.path / "b.toml").write_text((self.path / "a.toml").read_text().replace("maxon-251601", "teknic-m2310p"))
        vary = ["--vary", "supply.voltage_V=12,24"]
        told = self.run_program("run", "a.toml", "b.toml", *vary, "--html", "both.html", code=1).stdout
        self.assertRegex(told, r"(?s)^a\n.*2 runs.*\nb\n.*2 runs")
        _, plans = self.page("both.html")
        self.assertEqual([p["name"] for p in plans], ["a", "b"])
        for p in plans:
            self.run_program("run", p["name"] + ".toml", *vary, "--html", "one.html", code=1)
            self.assertEqual(self.page("one.html")[1][0] | {"repeats": ""}, p | {"repeats": ""})
        for more, why in ((["a.toml"], "must be at most 2"), (["--store", "s.sqlite"], "one plan")):
            self.assertIn(why, self.run_program("run", "a.toml", "b.toml", *more, *vary, "--html", "x.html", code=2).stderr)
        self.assertNotIn("x.html", self.names())

    def test_a_trace_is_of_one_run(self):
        self.held()
        self.assertIn("--only N --vcd", self.run_program("run", "a.toml", "--vary", "supply.voltage_V=12,24", "--vcd", "a.vcd", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
