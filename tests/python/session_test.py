# SPDX-License-Identifier: Apache-2.0
"""Sessions and environments: copies, changes and threads. The bits are independent of steps and workers."""
import math
import threading
import time
import unittest

import numpy as np
import sixstep
from package import current


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
        """In the environment the duty acts from the second tick on. The final speed is equal to that of a run with
        the same duty."""
        env = sixstep.Env(self.scenario(), action="duty")
        env.reset()
        for _ in range(400):
            seen, _, _, _, _ = env.step([[0.4]])
        run = sixstep.run(sixstep.Scenario({"motor": "maxon-251601", "duration_s": 0.05, "control": {"mode": "duty"},
                                            "reference": {"value": 0.4}, "record": {"grid_s": 30e-6}}))
        self.assertAlmostEqual(seen[0, 3], float(np.interp(399 * 30e-6, run.time, run.speed)), delta=0.01 * seen[0, 3])

    def test_a_current_action_is_the_setpoint_of_the_drives_own_loop(self):
        """The current reference is 0 at first, and then 2 A. The environment does the same as the drive one control
        tick after its own step to 2 A."""
        period, begin, count = 30e-6, 4, 200
        env = sixstep.Env(self.scenario(), action="current")
        env.reset()
        seen = [env.step([[0.0 if n < begin else 2.0]])[0][0] for n in range(count)]
        run = sixstep.run(sixstep.Scenario({"motor": "maxon-251601", "duration_s": 0.05, "control": {"mode": "current"},
                                            "reference": {"shape": "steps", "times_s": [0, (begin + 0.5) * period], "values": [0, 2]},
                                            "record": {"grid_s": period}}))
        current = np.array(seen)[:, env.observed.index("motor_current_A")]
        self.assertAlmostEqual(current[-1], 2.0, delta=0.05)
        np.testing.assert_allclose(current, run.i_m[1:count + 1], atol=1e-9)

    def test_a_current_action_has_the_scenarios_limit(self):
        limited = self.scenario(control={"mode": "speed", "current": {"limit_A": 1.5}}, load={"locked": True})
        env = sixstep.Env(limited, action="current")
        self.assertEqual(float(env.action_space.high[0, 0]), 1.5)
        env.reset()
        for _ in range(300):
            seen, _, _, _, _ = env.step([[1.5]])
        with self.assertRaisesRegex(ValueError, "-1.5 to 1.5"):
            env.step([[9.0]])
        self.assertAlmostEqual(seen[0, env.observed.index("motor_current_A")], 1.5, delta=0.05)
        with self.assertRaisesRegex(sixstep.ScenarioError, "has no current loop"):
            sixstep.Env(self.scenario(control={"mode": "duty"}, reference={"value": 0.3}), action="current", target="speed_rad_s")

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

    def test_a_fault_terminates_at_its_step_and_a_drive_begins_anew(self):
        """From 5 ms on the Hall code is invalid. A step is ten periods of 30 us, so the 17th step detects the fault."""
        broken = self.scenario(duration_s=20e-3, control={"mode": "speed"}, reference={"value": 100}, load={"locked": True},
                               at=[{"time_s": 5e-3, "sensors": {"hall_lines": "same", "hall_break": {"line": n}}} for n in (1, 2, 3)])
        env = sixstep.Env(broken, 2, action="current", hold=10)
        env.reset()
        steps = 0
        terminated = truncated = np.array([False])
        while not (terminated | truncated).any():
            _, _, terminated, truncated, _ = env.step(np.full((2, 1), 0.3))
            steps += 1
        self.assertEqual(steps, math.floor(5e-3 / (10 * 30e-6)) + 1)
        self.assertEqual((terminated.tolist(), truncated.tolist()), ([True, True], [False, False]))
        env.reset_where(np.array([True, False]))
        _, _, terminated, truncated, _ = env.step(np.full((2, 1), 0.3))
        self.assertEqual((terminated.tolist(), truncated.tolist()), ([False, True], [False, False]))

    def test_wrong_shapes_and_words_are_told(self):
        env = sixstep.Env(self.scenario(), 2)
        env.reset()
        for wrong in (np.zeros((3, 1)), "a", np.zeros((2, 3))):
            with self.assertRaises(ValueError):
                env.step(wrong)
        with self.assertRaisesRegex(ValueError, "duty"):
            sixstep.Env(self.scenario(), action="force")


if __name__ == "__main__":
    unittest.main()
