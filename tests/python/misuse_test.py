# SPDX-License-Identifier: Apache-2.0
"""Wrong uses that once failed silently, hung, or had an unclear message."""
import html
import math
import os
import pathlib
import pickle
import signal
import tempfile
import threading
import time
import unittest

import numpy as np
import sixstep
from package import DATA, SOURCE, current


def interrupted_after(seconds):
    timer = threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    return timer


class EndsThatAreTold(unittest.TestCase):
    def test_an_incomplete_run_has_not_passed(self):
        long = current()
        long["duration_s"] = 1e3
        timer = interrupted_after(0.3)
        with self.assertRaises(sixstep.Interrupted) as told:
            sixstep.run(long)
        timer.join()
        self.assertFalse(told.exception.result.passed)
        self.assertFalse(told.exception.result.complete)
        timer = interrupted_after(0.3)
        with self.assertRaises(sixstep.Interrupted) as told:
            sixstep.run(long, lambda m, setpoint: 0.1)
        timer.join()
        self.assertFalse(told.exception.result.complete)

    def test_ctrl_c_ends_a_sessions_advance_and_an_environments_step(self):
        long = current()
        long["duration_s"] = 1e4
        session = sixstep.Session(long)
        env = sixstep.Env(long, hold=10**8)
        env.reset()
        for use in (lambda: session.advance(1e4), lambda: env.step([[0.01]])):
            timer, begin = interrupted_after(0.3), time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                use()
            timer.join()
            self.assertLess(time.monotonic() - begin, 5.0)

    def test_a_fault_is_named(self):
        r = sixstep.run(sixstep.shipped("product-broken-hall-line"))
        self.assertIn("hall", r.fault.lower())
        self.assertIn(r.fault, str(r))

    def test_a_session_whose_controller_failed_is_closed(self):
        session = sixstep.Session(current(), lambda m, setpoint: 1 / 0)
        with self.assertRaises(ZeroDivisionError):
            session.advance(1e-3)
        with self.assertRaisesRegex(ValueError, "closed"):
            session.advance(2e-3)

    def test_a_wrong_return_names_the_controller(self):
        with self.assertRaisesRegex(TypeError, r"controller's step\(\) returned 'a'"):
            sixstep.run(current(), lambda m, setpoint: "a")


    def test_an_early_close_is_incomplete(self):
        session = sixstep.Session(current())
        session.advance(1e-3)
        self.assertFalse(session.close().complete)

    def test_an_interrupted_session_stands_where_it_stopped(self):
        session = sixstep.Session(current(duration_s=1e3))
        session.advance(1e-3)
        timer = interrupted_after(0.3)
        with self.assertRaises(KeyboardInterrupt):
            session.advance(1e3)
        timer.join()
        at = session.time
        self.assertGreater(at, 1e-3)
        self.assertEqual(session["t_s"], at)
        self.assertAlmostEqual(sixstep.Session.restore(session.save()).time, at, delta=1e-4)

    def test_equal_names_stay_apart(self):
        twice = current(require=[{"metric": "max", "signal": "i_a_A", "to_s": 1e-3, "max": 9}, {"metric": "max", "signal": "i_a_A", "from_s": 1e-3, "max": 9}])
        self.assertEqual(len(sixstep.run(twice).figures), 2)

    def test_a_fault_and_remarks_are_shown_with_the_verdicts(self):
        r = sixstep.run(sixstep.shipped("product-broken-hall-line"))
        self.assertIn(html.escape(r.fault), r._repr_html_())
        self.assertIn("i_a", r)
        self.assertIn("i_a_A", list(r))

    def test_a_refused_point_of_a_sweep_leaves_the_others(self):
        table = sixstep.sweep(current(require=[{"metric": "max", "signal": "i_a_A", "max": 9, "label": "run"}]), {"pwm.period_s": [30e-6, -1]})
        self.assertEqual(len(table), 2)
        self.assertIn("run (2)", table)
        with self.assertRaisesRegex(ValueError, "sampling"):
            sixstep.sweep(current(), {"pwm.period_s": [30e-6, 40e-6]}, points=4)


class Instants(unittest.TestCase):
    def test_what_is_no_instant_or_step_is_refused(self):
        session = sixstep.Session(current())
        for wrong in (math.inf, math.nan):
            with self.assertRaises(ValueError):
                session.advance(wrong)
        for wrong in (0, -1e-3, math.nan):
            with self.assertRaises(ValueError):
                next(session.steps(wrong))

    def test_saved_bytes_are_checked(self):
        for wrong in (b"garbage", b"[1]", b"{}"):
            with self.assertRaisesRegex(ValueError, "save"):
                sixstep.Session.restore(wrong)

    def test_signals_without_a_meaning_are_no_numbers(self):
        session = sixstep.Session(current())
        session.advance(1e-3)
        self.assertTrue(math.isnan(session["position_ref_deg"]))
        self.assertEqual(session["i_ref_A"], 2)


class Sweeps(unittest.TestCase):
    def test_a_key_that_was_set_can_be_varied(self):
        s = sixstep.Scenario(DATA / "current-square.toml")
        s["duration_s"] = 2e-3
        s["supply.voltage_V"] = 30
        table = sixstep.sweep(s, {"supply.voltage_V": [18, 24]})
        self.assertEqual(table["supply.voltage_V"].tolist(), [18, 24])
        self.assertEqual(s["supply.voltage_V"], 30)

    def test_ctrl_c_tells_what_is_finished_and_how_to_go_on(self):
        with tempfile.TemporaryDirectory() as folder:
            store = os.path.join(folder, "x.sqlite")
            s = current(duration_s=2.0, require=[{"metric": "max", "signal": "i_a", "max": 9}])
            interrupted_after(1.5)
            begin = time.monotonic()
            with self.assertRaises(sixstep.Interrupted) as told:
                sixstep.sweep(s, {"supply.voltage_V": [20 + 0.01 * n for n in range(400)]}, store=store)
            self.assertLess(time.monotonic() - begin, 60)
            self.assertIn("x.sqlite", str(told.exception))
            self.assertIn("resume", str(told.exception))


class Environments(unittest.TestCase):
    def test_the_reward_of_a_current_has_its_sign(self):
        locked = current(load={"locked": True}, control={"mode": "current"}, reference={"value": -2, "unit": "A"})
        rewards = {}
        for action in (-0.09, 0.09):
            env = sixstep.Env(locked, hold=10)
            env.reset()
            for _ in range(12):
                seen, reward, _, _, _ = env.step([[action]])
            rewards[action] = reward[0]
            pair = env.value(seen, "motor_current_A")[0]
            self.assertEqual(pair < 0, action < 0)
            self.assertAlmostEqual(abs(pair), np.abs(seen[0, :3]).max(), delta=0.02)
        self.assertGreater(rewards[-0.09], -0.3)
        self.assertLess(rewards[0.09], -3)
        with self.assertRaisesRegex(ValueError, "give reward"):
            sixstep.Env(sixstep.Scenario(motor="maxon-251601", duration_s=1e-3, control={"mode": "duty"}, reference={"value": 0.1}))

    def test_actions_out_of_bounds_are_refused_and_the_end_truncates(self):
        env = sixstep.Env(current(), 2, hold=20)
        with self.assertRaisesRegex(ValueError, "reset"):
            env.step(np.zeros((2, 1)))
        env.reset()
        for wrong in (math.nan, 1.01):
            with self.assertRaisesRegex(ValueError, "-1 to 1"):
                env.step([[wrong], [0.0]])
        truncated = np.array([False])
        while not truncated.any():
            _, _, terminated, truncated, _ = env.step([[0.0], [0.0]])
        self.assertEqual((terminated.tolist(), truncated.tolist()), ([False, False], [True, True]))

    def test_the_series_of_drives_begins_anew_with_its_seed(self):
        spread = current(spread=[{"key": "motor_override.resistance_ohm", "relative": 0.2}])
        env = sixstep.Env(spread, 2, spread=True, hold=50)
        env.reset(seed=1)
        first = env.step([[0.5], [0.5]])[0]
        env.reset_where(np.array([True, False]))
        env.reset(seed=1)
        np.testing.assert_array_equal(env.step([[0.5], [0.5]])[0], first)
        for wrong in (np.array([1]), [True], "x", [5, 5]):
            with self.assertRaisesRegex(ValueError, "one True or False for each"):
                env.reset_where(wrong)
        with self.assertRaisesRegex(ValueError, "spread"):
            sixstep.Env(current(), 2, spread=True)
        with self.assertRaisesRegex(ValueError, "one number for each"):
            wrong_reward = sixstep.Env(current(), 2, reward=lambda seen, action: 1.0)
            wrong_reward.reset()
            wrong_reward.step(np.zeros((2, 1)))

    def test_after_a_fork_it_says_so(self):
        env = sixstep.Env(current(), 8, workers=2)
        env.reset()
        env.step(np.zeros((8, 1)))
        child = os.fork()
        if child == 0:
            try:
                env.step(np.zeros((8, 1)))
            except ValueError:
                del env
                os._exit(0)
            os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.folder = pathlib.Path(folder.name) / "a b"
        self.folder.mkdir()
        (self.folder / "mm.toml").write_text((SOURCE / "data/motors/maxon-251601.toml").read_text())
        self.file = self.folder / "x.toml"
        self.file.write_text(current().to_toml().replace('"maxon-251601"', '"mm.toml"')
                             + '[[require]]\nmetric = "max"\nsignal = "i_a"\nmax = 100\nlabel = "peak"\n')

    def test_a_scenario_is_what_was_read(self):
        scenario = sixstep.Scenario(self.file)
        before = sixstep.run(scenario).figures["peak"]
        self.file.write_text(self.file.read_text().replace("value = 2", "value = 1"))
        self.assertAlmostEqual(sixstep.sweep(scenario, {"pwm.period_s": [30e-6]})["peak"][0], before, delta=1e-9)

    def test_relative_names_hold_from_any_folder(self):
        os.chdir(self.folder)
        told = [sixstep.Scenario("x.toml"), sixstep.Scenario(motor="mm.toml", duration_s=1e-3, control={"mode": "current"}, reference={"value": 1, "unit": "A"})]
        os.chdir("/")
        for scenario in told:
            sixstep.run(scenario.copy(pwm__period_s="40us"))
            sixstep.Session.restore(sixstep.Session(scenario).save())
            self.assertIn("usable", str(sixstep.design(scenario, quick=True)))
            pickle.loads(pickle.dumps(scenario))

    def test_a_path_or_dict_stands_for_its_scenario(self):
        self.assertEqual(sixstep.run(str(self.file)).digest, sixstep.run(sixstep.Scenario(self.file)).digest)
        self.assertTrue(sixstep.run({"motor": "maxon-251601", "duration_s": 1e-3}).complete)
        self.assertEqual(len(sixstep.sweep(self.file, {"supply.voltage_V": (12, 24, 48)})), 3)
        with self.assertRaises(TypeError):
            sixstep.sweep(self.file, {"supply.voltage_V": 12})
        with self.assertRaises(ValueError):
            sixstep.sweep(self.file, {})

    def test_attributes_are_no_keys(self):
        with self.assertRaisesRegex(AttributeError, "set by key"):
            current().supply = 5


if __name__ == "__main__":
    unittest.main()
