# SPDX-License-Identifier: Apache-2.0
"""Laws of the torque dip and the current peak at commutations, from the mean voltages of the three legs
(docs/explanation/currents.md).

E is the back-EMF of a phase; R and L are the values of a phase. U is the bus voltage, u the mean voltage of the pair,
i the current. While all three phases have current, the voltage of the star point is a third of the sum of the leg
voltages, less a third of the sum of the back-EMFs. The staying phase is positive, and the upper diode of the leaving
phase conducts:
  entering leg chopped:  leaving falls at (u + 2 E)/(3 L),      staying falls at (4 E + 3 R i - u)/(3 L)
  staying leg chopped:   leaving falls at (2 U - u + 2 E)/(3 L), staying falls at (4 E + 3 R i + U - 2 u)/(3 L)"""
import re
from math import pi

from gallery_sheet import K_E, K_T, L, PAIRS, R as R_PAIR, T, U

R = R_PAIR / 2
I = 3.0
ROW = re.compile(r"^  (least torque|mean current|peak of a phase current, as sampled|peak of a phase current, with ripple) +\S+ \S.*?  +([\d.]+) (m?)(?:N m|A) +([-+][\d.]+) %", re.M)


def left_at_a_fixed_duty(emf, bus_part):
    """The current of the staying phase when the leaving phase has no current. bus_part: true if the staying leg is
    chopped."""
    u = 2 * emf + 2 * R * I
    leaving = (2 * U - u + 2 * emf if bus_part else u + 2 * emf) / (3 * R)
    staying = (4 * emf + U - 2 * u if bus_part else 4 * emf - u) / (3 * R)
    return (I + staying) * leaving / (leaving + I) - staying


def ripple(emf, current, period_s):
    d = min((2 * emf + 2 * R * current) / U, 1.0)
    return U * period_s * d * (1 - d) / L


def runs(text):
    """(command, {row: (SI value, printed deviation)}) for each run in the block."""
    for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
        rows = {m[1]: (float(m[2]) * (1e-3 if m[3] else 1.0), float(m[4])) for m in ROW.finditer(part)}
        if rows:
            yield part.splitlines()[0], rows


def judge_run(test, spot, command, rows):
    told = f"{spot}: {command}"
    test.assertEqual(4, len(rows), told)
    speed = float((re.search(r"dynamometer_rad_s=\[([\d.]+)\]", command) or [0, "150"])[1])
    period = float((re.search(r"pwm.period_s=(\S+)", command) or [0, T])[1])
    emf = K_E * speed
    (torque, dip), (mean, missed), (sampled, spike), (peak, rise) = (rows[name] for name in sorted(rows))
    for value, against, deviation in ((torque, K_T * I, dip), (mean, I, missed), (sampled, I, spike), (peak, I, rise)):
        test.assertLess(abs(100 * (value / against - 1) - deviation), 0.06, told)
    # The loop controls the minimum of the ripple to the reference. The torque is below K_t I only at commutations. Its dip is at
    # most the dip at a constant duty and the change within a sample delay and a period.
    floor = left_at_a_fixed_duty(emf, "pattern=upper" in command) - ripple(emf, I, period) / 2
    test.assertLess(K_T * floor, torque, told)
    test.assertLess(torque, K_T * I, told)
    # The peak and the sampled current differ by the ripple at the peak. There the duty is that of the peak current, or is still
    # decreasing to it.
    apart = (peak - sampled) / ripple(emf, sampled, period)
    test.assertTrue(0.7 < apart < 1.1, f"{told}: {apart} ripples apart")
    test.assertTrue(torque / K_T < mean < sampled and I < sampled, told)
    return torque, sampled


def judge(test, spot):
    """Compares each run with its bounds. A measure that the page calls a cure must improve the result."""
    found = {command: judge_run(test, spot, command, rows) for command, rows in runs(spot.text)}
    test.assertTrue(found, str(spot))

    def of(*words, but=()):
        return next((x for command, x in found.items() if all(w in command for w in words) and not any(w in command for w in but)), None)

    plain = (K_T * I * (1 - 0.185), I * 1.128)  # the values that the page's text states for its first run
    if of("pattern=upper"):
        step, short = of("duty-step", but=["period_s"]), of("period_s", but=["duty-step"])
        both, slow = of("period_s", "duty-step"), of("settle_s=2e-3")
        test.assertTrue(of("pattern=upper")[0] < plain[0] < step[0] < short[0] < both[0], str(spot))
        test.assertTrue(both[1] < step[1] < short[1] < plain[1] < slow[1], str(spot))
    if overlap := of("overlap"):
        step, none = of("duty-step"), of("dynamometer", but=["commutation"])
        test.assertTrue(none[0] < step[0] < overlap[0] and overlap[1] < step[1] < none[1], str(spot))


def judge_edge(test, spot):
    """The rows around an edge: the sum of the three currents is 0, i_m is half the difference of the pair's currents,
    and the edges are one sector apart. It also checks the run."""
    judge(test, spot)
    edges = [float(x) for x in re.findall(r"edge before ([\d.]+) ms", spot.text)]
    test.assertLess(abs(edges[1] - edges[0] - 1e3 * pi / 3 / PAIRS / 150), 1e3 * T, str(spot))
    rows = re.findall(r"^([\d.]+) ms: i_a +(\S+), i_b +(\S+), i_c +(\S+), i_m +(\S+) A, duty ([\d.]+)", spot.text, re.M)
    test.assertGreater(len(rows), 4, str(spot))
    for row in rows:
        t, a, b, c, motor, duty = (float(x) for x in row)
        test.assertLess(abs(a + b + c), 0.016, f"{spot}: {row}")
        before = t < edges[0]
        test.assertLess(abs(((c if before else a) - b) / 2 - motor), 0.011, f"{spot}: {row}")
        test.assertTrue(0 < duty < 1, f"{spot}: {row}")
