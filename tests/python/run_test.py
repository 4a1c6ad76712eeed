# SPDX-License-Identifier: Apache-2.0
"""Runs in Python have the same bits as the program's runs. Their columns satisfy the laws of the circuit."""
import gc
import os
import pathlib
import pickle
import random
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import sixstep
from package import DATA, current, program_summary

FILES = sorted([*DATA.glob("thesis/*.toml"), *DATA.glob("gallery/*.toml")])


def drawn_values(draw):
    values = {"duration_s": draw.uniform(1e-3, 5e-3), "supply.voltage_V": draw.uniform(18.0, 30.0),
              "pwm.period_s": draw.choice((25e-6, 30e-6, 40e-6, 50e-6)), "motor_override.inertia_gcm2": draw.uniform(50.0, 500.0),
              "sensors.seed": draw.randrange(1, 1000)}
    return {key: value for key, value in values.items() if key == "duration_s" or draw.random() < 0.5}


class Bits(unittest.TestCase):
    def test_program_run_and_session_have_one_digest(self):
        """30 random scenarios: shipped scenarios with random values of keys that every scenario has. The program, a
        run in Python, and a session with random steps have the same digest."""
        seed = int(os.environ.get("SIXSTEP_SEED", "38"))
        draw, compared = random.Random(seed), 0
        for n in range(400):
            if compared == 30:
                return
            file, values = draw.choice(FILES), drawn_values(draw)
            scenario = sixstep.Scenario(file)
            try:
                scenario.update(values)
            except sixstep.ScenarioError:
                continue  # a window or a change is after the end of this short run, or the board does not support it
            with self.subTest(f"SIXSTEP_SEED={seed}: number {n}, {file.stem}, {values}"):
                told = program_summary(file, *(word for key, value in values.items() for word in ("--set", f"{key}={value!r}")))
                self.assertEqual(sixstep.run(scenario).digest, told["digest"])
                session = sixstep.Session(scenario)
                while not session.over:
                    session.advance(session.time + draw.uniform(0.0, 0.4) * values["duration_s"] + 1e-6)
                self.assertEqual(session.close().digest, told["digest"])
                compared += 1
        self.fail(f"of 400 drawn scenarios {compared} can be run")

    def test_threads_share_nothing(self):
        scenario = current()
        expected = sixstep.run(scenario).digest
        found = []
        threads = [threading.Thread(target=lambda: found.append({sixstep.run(scenario).digest for _ in range(5)})) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [{expected}] * 4)


class Columns(unittest.TestCase):
    def test_currents_sum_to_zero_and_the_torque_is_their_product_with_the_emf(self):
        r = sixstep.run(current(record={"columns": ["i_a_A", "i_b_A", "i_c_A", "e_a_V", "e_b_V", "e_c_V", "speed_rad_s", "torque_Nm"]}))
        self.assertLess(np.abs(r.i_a + r.i_b + r.i_c).max(), 1e-12)
        turning = r.speed > 1.0
        power = r.e_a * r.i_a + r.e_b * r.i_b + r.e_c * r.i_c
        np.testing.assert_allclose(power[turning], (r.torque * r.speed)[turning], rtol=1e-9, atol=1e-12)
        self.assertEqual(r.units["torque_Nm"], "N m")

    def test_they_are_views_that_outlive_the_result(self):
        r = sixstep.run(current())
        i = r["i_a_A"]
        self.assertFalse(i.flags.owndata)
        self.assertFalse(i.flags.writeable)
        last = float(i[-1])
        del r
        gc.collect()
        self.assertEqual(float(i[-1]), last)
        with self.assertRaises(ValueError):
            i[0] = 1.0

    def test_a_missing_one_is_named_with_those_there_are(self):
        with self.assertRaisesRegex(KeyError, "voltage is not recorded; the recorded columns are t_s, "):
            sixstep.run(current())["voltage"]
        with self.assertRaises(AttributeError):
            sixstep.run(current()).voltage

    def test_events_have_both_sides_of_each_jump(self):
        r = sixstep.run(current(), events=True)
        t = r.events["t_s"]
        self.assertTrue((np.diff(t) >= 0).all())
        self.assertTrue((np.diff(t) == 0).any())
        i = np.interp(r.time, t, r.events["i_a_A"])
        self.assertLess(np.abs(i - r.i_a).max(), 0.2)  # between events the currents are curves, and the columns are lines

    def test_verdicts_are_those_of_the_figures(self):
        r = sixstep.run(current(require=[{"metric": "max", "signal": "i_a", "max": 100}, {"metric": "max", "signal": "i_a", "max": 0.001}]))
        self.assertEqual([v.ok for v in r.verdicts], [True, False])
        self.assertFalse(r.passed)
        self.assertGreaterEqual(r.verdicts[0].measured, float(r.i_a.max()) - 1e-12)
        balance = r.energy
        self.assertAlmostEqual(balance["supplied_J"], sum(balance[k] for k in ("copper_J", "devices_J", "magnetic_J", "air_gap_J", "iron_J")), delta=1e-9)


class Interruption(unittest.TestCase):
    def test_ctrl_c_ends_a_run_at_once_and_keeps_what_was_finished(self):
        long = current()
        long["duration_s"] = 1e4
        long["record.grid_s"] = 1e-3
        killer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        killer.start()
        with self.assertRaises(sixstep.Interrupted) as told:
            sixstep.run(long)
        self.assertLess(told.exception.result.simulated_s, 1e4)
        self.assertFalse(told.exception.result.complete)
        self.assertGreater(len(told.exception.result.time), 10)

    def test_an_exception_of_the_progress_is_that_of_the_run(self):
        def progress(t_s):
            raise RuntimeError("enough")
        long = current()
        long["duration_s"] = 1e4
        with self.assertRaisesRegex(RuntimeError, "enough"):
            sixstep.run(long, progress=progress)

    def test_other_threads_go_on(self):
        long = current()
        long["duration_s"] = 2.0
        thread = threading.Thread(target=sixstep.run, args=(long,))
        thread.start()
        counted = 0
        while thread.is_alive():
            counted += 1
            time.sleep(0.001)
        self.assertGreater(counted, 10)


class Scenarios(unittest.TestCase):
    def test_problems_have_place_limit_and_cure(self):
        with self.assertRaises(sixstep.ScenarioError) as told:
            current(pwm={"period_s": -1, "perod_s": 1})
        self.assertEqual(len(told.exception.problems), 2)
        self.assertTrue(all(p.limit and p.cure and "pwm" in p.where for p in told.exception.problems))
        self.assertIsInstance(pickle.loads(pickle.dumps(told.exception)), sixstep.ScenarioError)

    def test_a_refused_change_changes_nothing(self):
        s = current()
        before = s.to_toml()
        with self.assertRaises(sixstep.ScenarioError):
            s["pwm.period_s"] = "5 kg"
        self.assertEqual(s.to_toml(), before)
        s["pwm.period_s"] = "40us"
        self.assertEqual(s["pwm.period_s"], 40e-6)
        del s["pwm.period_s"]
        self.assertEqual(s.to_toml(), before)

    def test_ways_to_write_one_are_the_same(self):
        text = 'motor = "maxon-251601"\nduration_s = 5e-3\n[control]\nmode = "current"\n[reference]\nvalue = 2\nunit = "A"\n'
        keywords = sixstep.Scenario(motor="maxon-251601", duration_s="5ms", control={"mode": "current"}, reference={"value": 2, "unit": "A"})
        self.assertEqual(sixstep.Scenario(text), current())
        self.assertEqual(sixstep.run(keywords).digest, sixstep.run(current()).digest)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.toml"
            file.write_text(text)
            self.assertEqual(sixstep.run(sixstep.Scenario(file)).digest, sixstep.run(current()).digest)
            self.assertEqual(sixstep.Scenario(file), sixstep.Scenario(file, title="a"))
            self.assertEqual(sixstep.Scenario(file, pwm={"period_s": "40us"})["pwm.period_s"], 40e-6)

    def test_copies_and_pickles_are_independent(self):
        s = current()
        for other in (s.copy(), pickle.loads(pickle.dumps(s))):
            self.assertEqual(other, s)
            other["supply.voltage_V"] = 12
            self.assertNotEqual(other, s)
        self.assertEqual(s.copy(supply__voltage_V=12)["supply.voltage_V"], 12)

    def test_wrong_types_are_told(self):
        for wrong in (3, object(), [1]):
            with self.assertRaises(TypeError):
                sixstep.Scenario(wrong)
        with self.assertRaises(TypeError):
            current()["supply.voltage_V"] = object()
        with self.assertRaises(FileNotFoundError):
            sixstep.Scenario("no-such-file.toml")
        with self.assertRaisesRegex(KeyError, "no.such is not a key"):
            current()["no.such"]

    def test_every_key_is_described(self):
        for key in sixstep.keys():
            self.assertTrue(sixstep.describe(key).meaning, key)


class Process(unittest.TestCase):
    def test_memory_is_flat(self):
        scenario = current()
        scenario["duration_s"] = 2e-4
        count = int(os.environ.get("SIXSTEP_RUNS", "2000"))
        for _ in range(200):
            sixstep.run(scenario)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(count):
            sixstep.run(scenario)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 2048)  # KiB: this allows less than a kilobyte per run

    def test_a_fork_runs_on(self):
        expected = sixstep.run(current()).digest
        child = os.fork()
        if child == 0:
            os._exit(0 if sixstep.run(current()).digest == expected else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_the_module_is_the_command_line(self):
        made = subprocess.run([sys.executable, "-m", "sixstep", "--version"], capture_output=True, text=True, check=True)
        self.assertEqual(made.stdout, f"sixstep {sixstep.__version__}\n")


class Studies(unittest.TestCase):
    def test_they_have_the_programs_figures(self):
        self.assertTrue(sixstep.check("maxon-251601").ok)
        design = sixstep.design("maxon-251601", quick=True)
        self.assertTrue(design.ok)
        self.assertIn("d1", str(design))
        with self.assertRaises(sixstep.ScenarioError) as told:
            sixstep.design("no-such-motor")
        self.assertIn("no-such-motor", str(told.exception))
        self.assertGreater(len(sixstep.curve("maxon-251601", points=5).points), 4)

    def test_a_sweep_has_the_figures_of_its_runs(self):
        s = current(require=[{"metric": "max", "signal": "i_a", "max": 100, "label": "peak"}])
        made = sixstep.sweep(s, {"supply.voltage_V": [18.0, 24.0], "control.current.settle_s": (1e-3, 2e-3)})
        self.assertEqual(len(made), 4)
        for n in range(4):
            alone = sixstep.run(s.copy(supply__voltage_V=float(made["supply.voltage_V"][n]),
                                       control__current__settle_s=float(made["control.current.settle_s"][n])))
            self.assertEqual(made["digest"][n], alone.digest)
            name = next(c for c in made.columns if "peak" in c)
            self.assertAlmostEqual(made[name][n], alone.figures[name], delta=1e-9)
            self.assertEqual(made.units[name], "A")



if __name__ == "__main__":
    unittest.main()
