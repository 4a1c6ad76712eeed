# SPDX-License-Identifier: Apache-2.0
"""Runs in Python have the bits of the program's runs, and their columns keep the laws of the circuit."""
import gc
import math
import os
import pathlib
import pickle
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


class Bits(unittest.TestCase):
    def test_program_run_and_session_have_one_digest(self):
        """30 of the scenarios that ship: the program, a run in Python, and a session in unequal steps."""
        for n, file in enumerate(FILES[:: max(1, len(FILES) // 30)][:30]):
            with self.subTest(file.stem):
                words = ["--set", "duration_s=4e-3"] if n % 2 else ["--set", "duration_s=2e-3"]
                duration = 4e-3 if n % 2 else 2e-3
                scenario = sixstep.Scenario(file)
                try:
                    scenario["duration_s"] = duration
                except sixstep.ScenarioError:
                    continue  # a window or a change lies beyond so short a run
                told = program_summary(file, *words)
                self.assertEqual(sixstep.run(scenario).digest, told["digest"])
                session = sixstep.Session(scenario)
                for k in range(1, 8):
                    session.advance(duration * (k / 7) ** 2)
                while not session.over:
                    session.advance(session.time + duration)
                self.assertEqual(session.close().digest, told["digest"])

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
        with self.assertRaisesRegex(KeyError, "voltage is not recorded; recorded are t_s, "):
            sixstep.run(current())["voltage"]
        with self.assertRaises(AttributeError):
            sixstep.run(current()).voltage

    def test_events_have_both_sides_of_each_jump(self):
        r = sixstep.run(current(), events=True)
        t = r.events["t_s"]
        self.assertTrue((np.diff(t) >= 0).all())
        self.assertTrue((np.diff(t) == 0).any())
        i = np.interp(r.time, t, r.events["i_a_A"])
        self.assertLess(np.abs(i - r.i_a).max(), 0.2)  # between events currents are curves, here drawn as lines

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
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 2048)  # KiB: a kilobyte a run would be all of it

    def test_a_fork_runs_on(self):
        expected = sixstep.run(current()).digest
        child = os.fork()
        if child == 0:
            os._exit(0 if sixstep.run(current()).digest == expected else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_the_module_is_the_command_line(self):
        made = subprocess.run([sys.executable, "-m", "sixstep", "--version"], capture_output=True, text=True, check=True)
        self.assertEqual(made.stdout, f"sixstep {sixstep.__version__}\n")


class Controllers(unittest.TestCase):
    def duty(self, **more):
        return sixstep.Scenario({"motor": "maxon-251601", "duration_s": 5e-3, "control": {"mode": "duty"}, "reference": {"value": 0.4}, **more})

    def test_a_constant_duty_is_that_of_the_library(self):
        """The drive of the library with the same duty: the same trajectory, but for the ways that reports go."""
        library = sixstep.run(self.duty())
        own = sixstep.run(self.duty(), lambda m, setpoint: setpoint)
        np.testing.assert_array_equal(own.speed, library.speed)
        np.testing.assert_array_equal(own.i_a, library.i_a)

    def test_it_is_called_once_a_period_with_what_is_measured(self):
        class Counts:
            def __init__(self):
                self.calls, self.sums, self.given = 0, [], None

            def start(self, given):
                self.given = given

            def step(self, m, setpoint):
                self.calls += 1
                self.sums.append(abs(m.i_a_A + m.i_b_A + m.i_c_A))
                return -setpoint

        counts = Counts()
        r = sixstep.run(self.duty(), counts)
        self.assertEqual(counts.calls, r.summary["events"]["control ticks"])
        self.assertLess(max(counts.sums), 1e-12)
        self.assertGreater(counts.given["K_t_Nm_A"], 0)
        self.assertLess(float(r.speed[-1]), 0)

    def test_three_legs(self):
        class Field:
            legs = True

            def step(self, m, setpoint):
                """Voltage a quarter turn ahead of the magnet: forward torque."""
                angle = math.atan2(m.magnet_sin, m.magnet_cos) + math.pi / 2
                return [0.5 + 0.3 * math.cos(angle - k * 2 * math.pi / 3) for k in range(3)]

        r = sixstep.run(self.duty(), Field())
        self.assertGreater(float(r.speed[-1]), 10)

    def test_its_exception_is_the_callers(self):
        def fails(m, setpoint):
            if m.speed_rad_s > 5:
                raise ZeroDivisionError("at speed")
            return 0.5
        with self.assertRaisesRegex(ZeroDivisionError, "at speed"):
            sixstep.run(self.duty(), fails)
        for wrong in ("a", [1, 2], object()):
            with self.assertRaises((TypeError, ValueError)):
                sixstep.run(self.duty(), lambda m, setpoint: wrong)
        with self.assertRaises(TypeError):
            sixstep.run(self.duty(), 3)

    def test_a_duty_that_no_timer_makes_stops_the_run(self):
        r = sixstep.run(self.duty(), lambda m, setpoint: 1.5)
        self.assertFalse(r.passed)
        self.assertIn("duty", str(r.summary["fault"]))

    def test_a_class_may_start_and_not_step(self):
        class NoStep:
            def start(self, given):
                raise LookupError("no data")

            def __call__(self, m, setpoint):
                return 0
        with self.assertRaisesRegex(LookupError, "no data"):
            sixstep.run(self.duty(), NoStep())

    def test_a_source_in_c_is_compiled_once(self):
        source = """// own controller
#include "sixstep/control/own/own_controller.hpp"
struct Half {
  struct Config { double part; };
  struct State { int none; };
  static const char* design(const sixstep_given&, const sixstep_real*, Config& c) { c.part = 0.5; return nullptr; }
  static void step(const Config& c, State&, const sixstep_measured& m, sixstep_real, sixstep_answer& a) {
    a.enabled = m.hall != 0;
    a.source = SIXSTEP_LEG_A;
    a.sink = SIXSTEP_LEG_B;
    a.duty = c.part * 0.1;
  }
};
SIXSTEP_OWN_CONTROLLER(Half, SIXSTEP_ANSWERS_PAIR, "half", "halves it")
"""
        with tempfile.TemporaryDirectory() as cache:
            made = sixstep.compiled(source, cache=cache)
            stamp = os.stat(made).st_mtime_ns
            self.assertEqual(sixstep.compiled(source, cache=cache), made)
            self.assertEqual(os.stat(made).st_mtime_ns, stamp)
            s = self.duty()
            s.update({"control.drive": "own", "control.own.controller": made})
            self.assertTrue(sixstep.run(s).complete)
            with self.assertRaises(sixstep.ProgramError):
                sixstep.compiled("int wrong(\n", cache=cache)


class Sessions(unittest.TestCase):
    def test_copies_go_their_own_ways_and_saved_ones_come_back(self):
        session = sixstep.Session(current())
        session.advance(1e-3)
        session.change({"reference": {"value": 3}})
        session.advance(2e-3)
        other, saved = session.copy(), session.save()
        other.change({"supply": {"voltage_V": 12}})
        for s in (session, other):
            while s.advance(s.time + 1e-3):
                pass
        restored = sixstep.Session.restore(saved)
        self.assertEqual(restored.time, 2e-3)
        while restored.advance(restored.time + 1e-3):
            pass
        mine, theirs = session.close(), other.close()
        self.assertEqual(restored.close().digest, mine.digest)
        self.assertNotEqual(theirs.digest, mine.digest)
        self.assertEqual(len(theirs.time), len(mine.time))

    def test_what_was_changed_is_in_its_scenario(self):
        session = sixstep.Session(current())
        session.advance(1e-3)
        session.change("reference.value = 3")
        text = session.scenario_text
        while session.advance(session.time + 1e-3):
            pass
        self.assertEqual(sixstep.run(sixstep.Scenario(text)).digest, session.close().digest)

    def test_a_wrong_change_changes_nothing(self):
        session = sixstep.Session(current())
        session.advance(1e-3)
        with self.assertRaises(sixstep.ScenarioError):
            session.change({"supply": {"voltage_V": -3}})
        while session.advance(session.time + 1e-3):
            pass
        self.assertEqual(session.close().digest, sixstep.run(current()).digest)

    def test_a_closed_one_says_so(self):
        session = sixstep.Session(current())
        session.close()
        for use in (lambda: session.advance(1.0), session.close, session.copy, lambda: session["i_a_A"]):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()

    def test_two_threads_do_not_use_one_at_once(self):
        scenario = current()
        scenario["duration_s"] = 5.0
        session = sixstep.Session(scenario)
        thread = threading.Thread(target=session.advance, args=(5.0,))
        thread.start()
        time.sleep(0.05)
        if thread.is_alive():
            with self.assertRaisesRegex(ValueError, "another thread"):
                session.advance(5.0)
        thread.join()

    def test_signals_are_those_of_the_columns(self):
        session = sixstep.Session(current())
        for now in session.steps(1e-3):
            self.assertAlmostEqual(now["i_a_A"] + now["i_b_A"] + now["i_c_A"], 0, delta=1e-12)
            self.assertEqual(set(now.look()), {c.name for c in now.signals()})


class Environments(unittest.TestCase):
    def scenario(self, **more):
        return sixstep.Scenario({"motor": "maxon-251601", "duration_s": 0.05, "control": {"mode": "speed"},
                                 "reference": {"value": 100, "unit": "rad/s"}, **more})

    def rolled(self, workers, drives=16, steps=200):
        env = sixstep.Env(self.scenario(spread=[{"key": "motor_override.resistance_ohm", "relative": 0.1}]), drives, spread=True, workers=workers)
        rng = np.random.default_rng(1)
        seen, _ = env.reset(seed=3)
        all_seen = [seen]
        for _ in range(steps):
            seen, reward, _, _, _ = env.step(rng.uniform(-1, 1, (drives, 1)))
            all_seen.append(seen)
        return np.array(all_seen)

    def test_workers_change_no_bit(self):
        one = self.rolled(1)
        for workers in (2, 3, 7):
            np.testing.assert_array_equal(self.rolled(workers), one)
        self.assertGreater(np.ptp(one[-1, :, 3]), 0)

    def test_a_constant_action_is_a_constant_duty(self):
        """The speed of the environment's drive is that of a run with the same duty from its second tick on."""
        env = sixstep.Env(self.scenario(), action="duty")
        env.reset()
        for _ in range(400):
            seen, _, _, _, _ = env.step([[0.4]])
        run = sixstep.run(sixstep.Scenario({"motor": "maxon-251601", "duration_s": 0.05, "control": {"mode": "duty"},
                                            "reference": {"value": 0.4}, "record": {"grid_s": 30e-6}}))
        self.assertAlmostEqual(seen[0, 3], float(np.interp(399 * 30e-6, run.time, run.speed)), delta=0.01 * seen[0, 3])

    def test_the_end_of_a_run_is_told_and_a_drive_begins_anew(self):
        env = sixstep.Env(self.scenario(duration_s=3e-3), 2, hold=20)
        env.reset()
        over = np.array([False, False])
        while not over.any():
            _, _, terminated, over, _ = env.step(np.zeros((2, 1)))
        self.assertTrue(over.all())
        env.reset_where(over)
        _, _, _, over, _ = env.step(np.zeros((2, 1)))
        self.assertFalse(over.any())

    def test_wrong_shapes_and_words_are_told(self):
        env = sixstep.Env(self.scenario(), 2)
        env.reset()
        for wrong in (np.zeros((3, 1)), "a", np.zeros((2, 3))):
            with self.assertRaises(ValueError):
                env.step(wrong)
        with self.assertRaisesRegex(ValueError, "duty"):
            sixstep.Env(self.scenario(), action="force")


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
