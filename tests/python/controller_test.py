# SPDX-License-Identifier: Apache-2.0
"""Controllers in Python. They are called once per period with the measured values. The caller receives their
exceptions."""
import math
import os
import re
import tempfile
import unittest

import numpy as np
import sixstep


class Controllers(unittest.TestCase):
    def duty(self, **more):
        return sixstep.Scenario({"motor": "maxon-251601", "duration_s": 5e-3, "control": {"mode": "duty"}, "reference": {"value": 0.4}, **more})

    def test_a_constant_duty_is_that_of_the_library(self):
        """The library's drive with the same duty has the same trajectory."""
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
                """A voltage a quarter of an electrical turn ahead of the magnet gives a forward torque."""
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
        for wrong in (1.5, -1.0001, math.nan):
            with self.assertRaisesRegex(ValueError, re.escape(repr(wrong))):
                sixstep.run(self.duty(), lambda m, setpoint: wrong)

    def test_the_recorded_reference_is_the_setpoint(self):
        speed = sixstep.Scenario(motor="maxon-251601", duration_s=5e-3, control={"mode": "speed"}, reference={"value": 200, "unit": "rad/s"})
        self.assertEqual(sixstep.run(speed, lambda m, setpoint: 0.3).speed_ref[-1], 200)
        current = sixstep.Scenario(motor="maxon-251601", duration_s=5e-3, control={"mode": "current"}, reference={"value": 2, "unit": "A"})
        self.assertEqual(sixstep.run(current, lambda m, setpoint: 0.1).i_ref[-1], 2)

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


if __name__ == "__main__":
    unittest.main()
