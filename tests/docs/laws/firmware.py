# SPDX-License-Identifier: Apache-2.0
"""The law for the table that the firmware example prints."""
from math import pi

POLE_PAIRS, BUS_V, R_PAIR_OHM, NO_LOAD_RAD_S = 7, 12, 2 * 0.1153, 12 / 11.15e-3  # data of the DJI 2212 920 KV


def course(test, spot):
    """Six commutations are one electrical turn, with a speed between the speeds of two rows. No current is above U/R.
    No speed is above the no-load speed of its throttle, except while the speed falls."""
    rows, before = [line.split() for line in spot.text.splitlines()[1:] if line != "..."], None
    test.assertGreater(len(rows), 10, str(spot))
    for ms, throttle, speed, current, state, commutations, missed, desyncs in rows:
        now = (int(ms), float(speed), state, int(commutations))
        test.assertLess(float(current), BUS_V / R_PAIR_OHM, f"{spot}: {ms}")
        test.assertLessEqual(int(missed), int(commutations), f"{spot}: {ms}")
        test.assertEqual(int(missed), 4 * int(desyncs), f"{spot}: {ms}")
        if state == "run":
            test.assertLess(float(speed), NO_LOAD_RAD_S * float(throttle) / 100, f"{spot}: {ms}")
        if before:
            low, high, most = (speed * 6 * POLE_PAIRS / (2 * pi) * (now[0] - before[0]) * 1e-3
                               for speed in (*sorted((before[1], now[1])), NO_LOAD_RAD_S))
            count = now[3] - before[3]
            if state == before[2] == "run":
                test.assertTrue(low - 1 < count < high + 1, f"{spot}: {ms}")
            test.assertTrue(0 <= count < most, f"{spot}: {ms}")
        before = now
