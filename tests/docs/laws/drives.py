# SPDX-License-Identifier: Apache-2.0
"""Laws of single blocks about motors, drives and boards. Each is computed by hand from the sheet."""
import re
from math import pi

from gallery_sheet import B, I_N, K_T, PAIRS, R
from laws import curve
from laws.scenarios import read
from page import REPOSITORY


def kv(test, spot):
    """920 rpm/V, as the peak of a sine between two terminals, or as the mean of the driven pair."""
    told = [float(x) for x in re.findall(r"K_t +([\d.]+) mNm/A", spot.text)]
    peak = 1e3 / (920 * 3.14159265 / 30)
    curve.same(test, spot, "line-peak", told[0], peak * 3 / 3.14159265, 1e-3)
    curve.same(test, spot, "six-step", told[1], peak, 1e-3)


def taken_over(test, spot):
    """L_d and L_q differ from 22.3 uH by half of 4.1 uH. The other values are those of the file, in smaller units."""
    told = {key: float(x) for key, x in re.findall(r"^(\w+) = \{ value = ([\d.]+)", spot.text, re.M)}
    for key, value in (("d_axis_inductance_uH", 22.3 - 4.1 / 2), ("q_axis_inductance_uH", 22.3 + 4.1 / 2), ("resistance_ohm", 0.0187),
                       ("flux_linkage_mWb", 5.12)):
        curve.same(test, spot, key, told[key], value, 1e-9)


def asked(test, spot):
    """The resistance 0.23 ohm is of a phase, or between two terminals. 920 rpm/V is of the peak between two
    terminals, or of the mean of the driven pair."""
    phase, terminal = (float(x) for x in re.findall(r"R_s = ([\d.]+) ohm", spot.text))
    peak, mean = (float(x) for x in re.findall(r"K_e = ([\d.]+) mV s", spot.text))
    curve.same(test, spot, "phase", phase, 0.23, 1e-9)
    curve.same(test, spot, "terminal", terminal, 0.115, 1e-9)
    curve.same(test, spot, "line-peak", peak, 1e3 / (920 * 3.14159265 / 30) / 3**0.5, 1e-5)
    curve.same(test, spot, "six-step", mean, 1e3 / (920 * 3.14159265 / 30) / 1.6539867, 1e-5)


def answered(test, spot):
    """The number in the sketch of the file, for both possible meanings."""
    for x in re.findall(r"value = ([\d.]+)", spot.text):
        curve.same(test, spot, "resistance", float(x), 0.23, 1e-9)


def frames(test, spot):
    """A torque constant of 0.42 Nm/A with a sine, in three frames. "terminal": unchanged. "peak": two thirds of it
    are K_e of a phase, and the terminal value is 1.654 K_e. "rms": the peak value divided by sqrt 2."""
    terminal, peak, rms = (float(x) for x in re.findall(r"constant of ([\d.]+) mNm/A", spot.text))
    curve.same(test, spot, "terminal", terminal, 420, 1e-3)
    curve.same(test, spot, "peak", peak, 420 * 2 / 3 * 1.65399, 1e-3)
    curve.same(test, spot, "rms", rms, 420 * 2 / 3 * 1.65399 / 2**0.5, 1e-3)


def trade_units(test, spot):
    """Conversion factors from the definitions of pound, ounce and inch."""
    pound, inch, g = 0.45359237, 0.0254, 9.80665
    for words, number in {r"1 oz-in is ([\d.]+) mNm": pound / 16 * g * inch * 1e3, r"1 lb-in ([\d.]+) mNm": pound * g * inch * 1e3,
                          r"1 kg cm ([\d.]+) mNm": g * 10, r"1 oz-in-s2 is ([\d.]+) g cm2": pound / 16 * g * inch * 1e7,
                          r"masses, ([\d.]+) and": pound / 16 * inch**2 * 1e7, r"and ([\d.]+) g cm2": pound * inch**2 * 1e7}.items():
        curve.same(test, spot, words, float(re.search(words, spot.text).group(1)), number, 5e-5 if "masses" not in words and "and" not in words else 3e-4)


def beyond_the_bus(test, spot):
    """Above a certain speed the back-EMF E = w p psi exceeds the voltage circle V = U/sqrt 3. Then the current is at
    least (E - V)/Z, with the impedance Z. The measured current is only a little larger."""
    pairs, psi, inductance, resistance, bus, w = 7, 5.12e-3, 22.3e-6, 18.7e-3, 60, 1000
    V, E, Z = bus / 3**0.5, w * pairs * psi, ((w * pairs * inductance)**2 + resistance**2)**0.5
    least = (E - V) / Z
    rows = {name: [float(x) for x in re.findall(r"([\d.]+) A", found)] for name, found in spot.rows()}
    curve.same(test, spot, "least", rows["least that flows"][0], least, 5e-3)
    for name, found in rows.items():
        asked = [abs(float(x)) for x in re.findall(r"(-?\d+) A", name.split("asked for")[0])] or [0.0]
        flows = (E - 0.95 * V) / Z if "95 %" in name else least
        for reference, current in zip(asked * len(found), found):
            test.assertTrue(reference <= current <= reference + 1.25 * flows, f"{spot}: {name}: {current} A")


def bring_up(test, spot):
    """The expected readings of the steps, from the sheet. A Hall line has p times the frequency of the shaft. The
    current overcomes load and friction, and the log shows the lower end of the ripple."""
    hall_order(test, spot)
    text = spot.text.replace("Hall 1 at ", "")
    steps = re.findall(r"([\d.]+) rad/s, ([\d.]+) A, [\d.]+(?: at 0.02 N m of load)?[;,] ([\d.]+) Hz", text)
    test.assertEqual(3, len(steps), str(spot))
    for speed, current, hertz in steps:
        w = float(speed)
        test.assertLess(abs(float(hertz) - PAIRS * w / 2 / pi), 0.6, f"{spot}: {speed} rad/s")
        curve.same(test, spot, f"current at {speed} rad/s", float(current), (0.02 + B * w) / K_T, 0.05)
    limit = float(re.search(r"limit of ([\d.]+) A", text).group(1))
    curve.same(test, spot, "2.5 times the nominal current", limit, 2.5 * I_N, 2e-3)
    logged = [float(re.search(words, text).group(1)) for words in (r"of the log reads ([\d.]+) A", r"of the log ([\d.]+) A\)", r"Hz \(([\d.]+) A\)")]
    means = re.findall(r"[\d.]+ rad/s, ([\d.]+) A, (0\.\d+)", text)
    for valley, (mean, duty) in zip(logged, means, strict=True):
        half_A = 24 * float(duty) * (1 - float(duty)) * 30e-6 / (4 * 0.286e-3)
        test.assertLess(abs(valley - (float(mean) - half_A)), 0.012, f"{spot}: the valley of the ripple at a mean of {mean} A")


def crossed_loop(test, spot):
    """With the wiring "backward" each mean speed has the sign opposite to the setpoint. With "late" the mean speed is
    the same for every setpoint. With "hums" the load turns the motor backward. With "early" the drive trips."""
    asked = (100, 300, 70)
    cells = {c[1]: c for c in (re.split(r" {2,}", line.strip()) for line in spot.text.splitlines()) if c[0].isdigit()}
    speeds = {wires: [float(re.match(r"-?[\d.]+", c[n]).group(0)) for n in (2, 4, 6)] for wires, c in cells.items()}
    test.assertEqual({"123", "213", "321", "132"}, set(speeds), str(spot))
    test.assertEqual({"213": "FAULT"}, {w: c[-1] for w, c in cells.items() if c[-1] != "FAIL"}, str(spot))
    for setpoint, backward, late, humming in zip(asked, speeds["132"], speeds["321"], speeds["123"]):
        test.assertLess(abs(backward + setpoint), 0.01 * setpoint, str(spot))
        test.assertLess(abs(late - speeds["321"][0]), 1, str(spot))
        test.assertLess(humming, 0, str(spot))
    for cell, setpoint in zip((cells["132"][n] for n in (2, 4, 6)), asked):
        test.assertTrue(cell.endswith("!"), f"{spot}: {cell} misses {setpoint}")


def bring_up_avr(test, spot):
    """The PWM frequency and dead time that the steps show on the scope agree with the scenario."""
    hall_order(test, spot)
    scenario = read(REPOSITORY / "data/scenarios/firmware/avr.toml")
    told = float(re.search(r"([\d.]+) kHz pulses", spot.text).group(1))
    curve.same(test, spot, "PWM", told, 1e-3 / float(scenario["pwm"]["period_s"]), 1e-6)
    told = re.search(r"lower one's fall to the upper one's rise ([\d.]+) us", spot.text)
    dead_us, cycle_us = 1e6 * float(scenario["bridge"]["dead_time_s"]), 1 / 16
    test.assertTrue(told and dead_us <= float(told.group(1)) <= dead_us + 2 * cycle_us + 0.05, f"{spot}: pause at the gates")
    told = re.search(r"are ([\d.]+) A, ([\d.]+) A and ([\d.]+) A. A converted sample above ([\d.]+) A stops .*? is ([\d.]+) A at 140 rad/s", spot.text)
    *held, limit, beyond = map(float, told.groups())
    counts = re.search(r"over_current_counts = (\d+)", (REPOSITORY / "faces/firmware/example/avr/board.hpp").read_text(encoding="utf-8"))
    full = 2 * float(scenario["sensors"]["current_range_A"])
    curve.same(test, spot, "over-current", limit, full * int(counts.group(1)) / 2 ** int(scenario["sensors"]["adc_bits"]), 2e-3)
    test.assertTrue(max(held) < limit < beyond < full / 2, f"{spot}: peaks of a reversal")


def lifted(test, spot):
    """Winding and housing with the worse ends of the ranges, heated for 40 s. The current overcomes weight and
    friction. It increases, because the magnets lose 0.12 %/K."""
    to_housing, to_air, tau_w, tau_h, w = 5.3, 4.25, 11.7, 212, 200
    winding, housing, dt = 25.0, 25.0, 1e-3
    for _ in range(40000):
        current = (0.123 + B * w) / (K_T * (1 - 0.0012 * (housing - 25)))
        loss, flow = R * current**2 * (1 + 0.00393 * (winding - 25)), (winding - housing) / to_housing
        winding += dt * (loss - flow) * to_housing / tau_w
        housing += dt * (flow - (housing - 25) / to_air + B * w * w) * to_air / tau_h
    told, allowed = map(float, re.search(r"reached (\d+) degC, and the motor's sheet allows (\d+)", spot.text).groups())
    curve.same(test, spot, "rise of the winding", told - 25, winding - 25, 0.05)
    test.assertEqual(125, allowed, str(spot))


def laid_over(test, spot):
    for rows, differing in re.findall(r"(\d+) rows +(\d+) differ", spot.text):
        test.assertLessEqual(int(differing), int(rows), str(spot))
    for rms, most, span in re.findall(r"rms ([\d.]+) \S* *at most -?([\d.]+).*?of ([\d.]+)", spot.text):
        del rms
        test.assertLessEqual(float(most), 1e4 * float(span), str(spot))


def throttle(test, spot):
    """The slew rate is half as large if complementary chopping brakes. For the 251601 it follows from the sheet."""
    for ten, half in re.findall(r"duty from 10 to 100 % in +(\d+) ms, complementary in +(\d+) ms", spot.text):
        test.assertLess(abs(int(half) / int(ten) - 2), 0.03, str(spot))
    told = int(re.search(r"maxon-251601 .*? in +(\d+) ms", spot.text).group(1))
    test.assertLess(abs(told - 0.9e3 / (2.33 * 0.0335**2 / (135e-7 * 24))), 0.02 * told, str(spot))


def starts(test, spot):
    rows = re.findall(r"(\d+) of (\d+) hold, (\d+) at the first try, up to speed within ([\d.]+) s", spot.text)
    test.assertEqual(12, len(rows))
    for held, asked, first, within in rows:
        test.assertTrue(int(first) <= int(held) == int(asked) and float(within) < 2, str(spot))


def braking(test, spot):
    told = float(re.search(r"held up to ([\d.]+) rad/s", spot.text).group(1))
    curve.same(test, spot, "i R_tt/K_t", told, I_N / K_T * R, 2e-3)


def exported(test, spot):
    """A gain in 16 bits differs from the designed gain by less than one unit of its last digit."""
    held, gain = re.search(r"// ([\d.]+) V/A, held as ([\d.]+)", spot.text).groups()
    test.assertLess(abs(float(held) - float(gain)), 2.0**-13, str(spot))


def devices(test, spot):
    """Each device is heated by its losses: 40 degC at the sink and 40 K/W, as in the page's scenario."""
    for name, body in re.findall(r'"device": "(T\d)",\n(.*?)\}', spot.text, re.S):
        losses = sum(float(x) for x in re.findall(r'_W": ([\d.]+)', body))
        degC = float(re.search(r'junction_degC": ([\d.]+)', body).group(1))
        test.assertLess(abs(40 + 40 * losses - degC), 0.05, f"{spot}: {name}")
    for x in re.findall(r'_W": ([\d.]+)', spot.text):
        test.assertLess(float(x), 24 * 4, str(spot))


def hall_order(test, spot):
    """In positive direction the Hall codes have the order of the sectors in notation.md."""
    order = re.search(r"\| (\d(?: \d){5}) and again", spot.text).group(1).split()
    page = (REPOSITORY / "docs/howto/find-a-wiring-fault.md").read_text(encoding="utf-8")
    codes = re.findall(r"^  \d +\d+\.\. ?\d+ deg +\d +\d +\d +(\d) ", page, re.M)
    test.assertEqual(codes, order, str(spot))
