# SPDX-License-Identifier: Apache-2.0
"""Units without a controller. With a controller outside, the bits are the same as with this controller inside. Gates
act at the instant at which they are set.
plant_test.py PROGRAM SOURCE LIBRARY"""
import ctypes as C
import functools
import math
import pathlib
import random
import sys
import unittest

import fmi2_importer as fmi2
import fmi3_importer as fmi3
from fmi2_units import FOLDER, LIBRARY, PROGRAM, SOURCE, ran, sixstep

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "c"))
import c_library as c  # noqa: E402

LIB = c.load(LIBRARY)
CONTROLLERS = PROGRAM.parent / "controllers"
OK, DISCARD, ERROR = 0, 2, 3
PERIOD = 50e-6
TEXT = """motor = "maxon-251601"
duration_s = 6e-3
pwm.period_s = 50e-6
[supply]
voltage_V = 24
[initial]
speed_rad_s = 100
[control]
mode = "current"
[reference]
value = 1.5
"""
FILES = {"plain": TEXT, "held": TEXT.replace("speed_rad_s = 100", "speed_rad_s = 0") + "[load]\nlocked = true\n",
         "sine": TEXT.replace('"current"', '"duty"').replace("value = 1.5", "value = 0.1").replace("pwm.period_s", 'pwm.alignment = "centre"\npwm.period_s')}
for _name, _text in FILES.items():
    (FOLDER / f"{_name}.toml").write_text(_text)
ENCODER = ("--set", "pwm.commutation=sample", "--set", "sensors.rotor=encoder", "--set", "sensors.encoder.lines=500")


@functools.lru_cache(None)
def unit_of(version, name, inputs, *words):
    file, out = FOLDER / f"{name}.toml", FOLDER / f"{name}-{version}-{inputs}-{len(words)}.fmu"
    sixstep("export", "fmu", file, "--fmi", version, "--kind", "plant", "--inputs", inputs, "--out", out, "--force", *words)
    return (fmi2 if version == 2 else fmi3).Unit(out)


class Plant:
    """An instance of either version. An array is three scalars in FMI 2 and one array in FMI 3."""

    def __init__(self, version, name, inputs, *words):
        self.version, self.unit = version, unit_of(version, name, inputs, *words)
        self.is_ = (fmi2 if version == 2 else fmi3).Instance(self.unit)
        self.begin()

    def begin(self):
        self.is_.begin()
        self.now, self.number = 0.0, 0

    def put(self, name, value):
        if self.version == 3:
            return self.is_.put(name, *(value if isinstance(value, (list, tuple)) else (value,)))
        of = self.unit.variables[name][0].tag
        array = ({"Real": C.c_double, "Integer": C.c_int, "Boolean": C.c_int}[of] * 1)(value)
        return self.is_.call("Set" + of, (C.c_uint * 1)(self.unit.reference(name)), 1, array)

    def put_three(self, array, one, values):
        """Writes three values. Returns the status. `one` is the name of a scalar, with {} in the place of a, b, c."""
        return self.put(array, values) if self.version == 3 else max(self.put(one.format(k), v) for k, v in zip("abc", values))

    def get(self, name):
        return self.is_.get(name)

    def get_three(self, array, one):
        return self.get(array) if self.version == 3 else [self.get(one.format(k)) for k in "abc"]

    def currents(self):
        return self.get_three("phase_currents_A", "i_{}_A")

    def gates(self, bits):
        on = [bool(bits >> k & 1) for k in range(6)]
        if self.version == 3:
            return self.put("gates", on)
        names = [f"gate_{leg}_{switch}" for leg in "abc" for switch in ("upper", "lower")]
        return max(self.put(name, value) for name, value in zip(names, on))

    def step(self, to):
        status = self.is_.step(self.now, to - self.now)
        self.now = to
        return status

    def messages(self):
        return self.is_.messages

    def digest(self):
        return self.is_.digest()


class OwnController:
    """The step function of a compiled controller, connected to the outputs and inputs of a unit."""

    def __init__(self, name):
        class Controller(C.Structure):
            _fields_ = [("interface", C.c_uint32), ("answers", C.c_uint32), ("name", C.c_char_p), ("sentence", C.c_char_p),
                        ("config_bytes", C.c_uint32), ("state_bytes", C.c_uint32), ("parameters", C.c_uint32), ("parameter", C.c_void_p),
                        ("design", C.c_void_p), ("start", C.c_void_p),
                        ("step", C.CFUNCTYPE(None, C.c_void_p, C.c_void_p, C.POINTER(c.Measured), C.c_double, C.POINTER(c.Answer))),
                        ("hall", C.c_void_p)]
        self.file = CONTROLLERS / f"{name}.so"
        own = C.CDLL(str(self.file))
        own.sixstep_own_controller.restype = C.POINTER(Controller)
        self.step, self.legs, self.answer = own.sixstep_own_controller().contents.step, name == "sine_voltage", c.Answer()

    def act(self, plant):
        seen = c.Measured(current_A=(C.c_double * 3)(*plant.get_three("measured_currents_A", "measured_i_{}_A")),
                          **{name: plant.get("measured_" + name) for name in ("speed_rad_s", "position_deg", "bus_V", "magnet_cos", "magnet_sin", "hall")})
        self.step(None, None, C.byref(seen), plant.get("setpoint"), C.byref(self.answer))
        a = self.answer
        statuses = [plant.put("enabled", bool(a.enabled))]
        if self.legs:
            statuses += [plant.put_three("leg_states", "leg_{}_state", [leg.state for leg in a.leg]),
                         plant.put_three("leg_switches", "leg_{}_switches", [leg.switches for leg in a.leg]),
                         plant.put_three("leg_duties", "leg_{}_duty", [leg.duty for leg in a.leg])]
        else:
            statuses += [plant.put(name, getattr(a, name)) for name in ("source", "sink", "chopping", "chopped", "duty", "overlap")]
        assert statuses == [OK] * len(statuses), plant.messages()


class Bits(unittest.TestCase):
    def controlled(self, version, name, inputs, controller, save_at=None, part=1.0):
        """Makes steps of the PWM period times `part`. The controller acts at the ticks."""
        plant, own = Plant(version, name, inputs), OwnController(controller)
        for n in range(120):
            if n == save_at:
                saved, now = plant.is_.saved(), plant.now
                plant = Plant(version, name, inputs)
                self.assertEqual(plant.is_.load(saved), OK, plant.messages())
                plant.now = now
            own.act(plant)
            if part != 1.0:
                self.assertEqual(plant.step((n + part) * PERIOD), OK, plant.messages())
            self.assertEqual(plant.step((n + 1) * PERIOD), OK, plant.messages())
        return plant.digest()

    def test_a_controller_outside_has_the_bits_of_the_same_one_inside(self):
        for name, inputs, controller in (("plain", "pair", "pair_of_the_code"), ("sine", "legs", "sine_voltage")):
            told = ran(FOLDER / f"{name}.toml", "--set", "control.drive=own", "--set", f"control.own.controller={OwnController(controller).file}")
            self.assertIsNone(told["fault"])
            for version in (2, 3):
                with self.subTest(f"{inputs} {version}"):
                    self.assertEqual(self.controlled(version, name, inputs, controller), told["digest"])
            self.assertEqual(self.controlled(2, name, inputs, controller, save_at=50), told["digest"])
            self.assertEqual(self.controlled(3, name, inputs, controller, save_at=50, part=0.37), told["digest"])

    def test_a_controller_sampled_in_the_middle_begins_with_half_a_period(self):
        told = ran(FOLDER / "sine.toml", *Measured.MIDDLE, "--set", "control.drive=own", "--set", f"control.own.controller={OwnController('sine_voltage').file}")
        plant, own = Plant(3, "sine", "legs", *Measured.MIDDLE), OwnController("sine_voltage")
        for n in range(120):
            self.assertEqual(plant.step((n + 0.5) * PERIOD), OK, plant.messages())
            own.act(plant)
        self.assertEqual(plant.step(6e-3), OK, plant.messages())
        self.assertEqual(plant.digest(), told["digest"])

    def test_sums_of_step_sizes_reach_the_ticks(self):
        """An importer adds up the step sizes. The communication points differ from k T by rounding, with the period
        T. The controller still acts at each tick."""
        plant, own, now, ticks = Plant(2, "plain", "pair"), OwnController("pair_of_the_code"), 0.0, 0
        size = PERIOD / 3
        for n in range(360):
            before = plant.get("measured_i_a_A")
            if n % 3 == 0:
                own.act(plant)
            self.assertEqual(plant.is_.step(now, size), OK)
            now += size
            ticks += plant.get("measured_i_a_A") != before
            self.assertTrue(n % 3 == 2 or plant.get("measured_i_a_A") == before, "between two ticks nothing is measured")
        self.assertGreater(ticks, 80)
        told = ran(FOLDER / "plain.toml", "--set", "control.drive=own", "--set", f"control.own.controller={own.file}")
        self.assertEqual(plant.digest(), told["digest"])

    def chopped(self, set_gates, advance, sector):
        """Drives the pair of the sector, with the upper switch on for 0.4 of the period."""
        pairs = [(0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1)]
        for n in range(100):
            source, sink = pairs[int(sector())]
            for bits, to in ((1 << 2 * source | 2 << 2 * sink, 0.4), (2 << 2 * sink, 1.0)):
                self.assertEqual(set_gates(bits), OK)
                self.assertEqual(advance((n + to) * PERIOD), OK)

    def test_gates_have_the_bits_of_the_library_whatever_the_steps(self):
        session = c.Session.open(LIB, FOLDER / "plain.toml", chip=c.GATES)
        self.chopped(session.set_gates, session.advance, lambda: session.value_of("sector"))
        session.finish()
        for version, parts in ((2, 1), (3, 1), (2, 7)):
            plant = Plant(version, "plain", "gates")

            def advance(to):
                begin = plant.now
                return max(plant.step(begin + (to - begin) * k / parts if k < parts else to) for k in range(1, parts + 1))

            self.chopped(plant.gates, advance, lambda: plant.get("sector"))
            self.assertEqual(plant.digest(), f"{session.digest():016x}")

    def test_a_saved_plant_goes_on_alike(self):
        plant, seen = Plant(3, "plain", "gates"), []
        plant.gates(0b001001)
        plant.step(0.9e-3)
        plant.gates(0b001000)
        saved, now = plant.is_.saved(), plant.now
        for again in (plant, Plant(3, "plain", "gates"), plant):
            self.assertEqual(again.is_.load(saved), OK)
            again.now = now
            for n in range(1, 40):
                again.step(now + n * 17e-6)
            seen.append((again.currents(), again.get("speed_rad_s"), again.get("hall")))
        self.assertEqual(seen, [seen[0]] * 3)


class Measured(unittest.TestCase):
    MIDDLE = ("--set", "pwm.sample=middle", "--set", "pwm.alignment=centre")
    NOISE = ("--set", "sensors.current_noise_A=0.05")

    def seen(self, plant):
        return (*plant.get_three("measured_currents_A", "measured_i_{}_A"),
                *(plant.get(name if name == "setpoint" else "measured_" + name) for name in ("speed_rad_s", "position_deg", "bus_V", "hall", "setpoint")))

    def driven(self, version, inputs, words):
        plant = Plant(version, "plain", inputs, *words)
        given = (("source", 0), ("sink", 1), ("duty", 0.3)) if inputs == "pair" else ()
        self.assertEqual([plant.put(*one) for one in (*given, ("enabled", True))], [OK] * (len(given) + 1))
        if inputs == "legs":
            plant.put_three("leg_states", "leg_{}_state", [3, 1, 0])
            plant.put_three("leg_duties", "leg_{}_duty", [0.3, 0.0, 0.0])
        return plant

    def test_they_hold_the_last_control_tick_whatever_the_steps(self):
        """Steps of any size show the values of the last tick. The reference is the same unit, stepped from tick to
        tick."""
        for version, inputs, words, first in ((2, "pair", self.MIDDLE, 0.5), (3, "legs", self.MIDDLE, 0.5), (3, "pair", self.NOISE, 0.0)):
            ticked, at_ticks = self.driven(version, inputs, words), []
            at_ticks.append(self.seen(ticked))  # first = 0.5: no sample exists yet
            for k in range(100):
                if k + first > 0:
                    self.assertEqual(ticked.step((k + first) * PERIOD), OK, ticked.messages())
                    at_ticks.append(self.seen(ticked))
            self.assertEqual(len(set(at_ticks)), len(at_ticks), "each tick differs")
            self.assertEqual(ticked.step(6e-3), OK)
            digest = ticked.digest()
            for size in (30e-6, 47e-6, 13e-6, 333e-6):
                with self.subTest(f"{inputs} {version} {size}"):
                    plant, n = self.driven(version, inputs, words), 0
                    while (n + 1) * size < 99.4 * PERIOD:
                        n += 1
                        self.assertEqual(plant.step(n * size), OK, plant.messages())
                        ticks = math.floor(n * size / PERIOD + 1e-6 + (0.5 if first else 1))
                        self.assertEqual(self.seen(plant), at_ticks[ticks if first else ticks - 1], n)
                    self.assertEqual(plant.step(6e-3), OK)
                    self.assertEqual(plant.digest(), digest)

    def test_ticks_between_hall_edges_are_measured_too(self):
        """In event mode with only the Hall clock, a step ends at a Hall edge. It shows the values of the tick before."""
        ticked = self.driven(3, "pair", ())
        at_ticks = [self.seen(ticked)] + [(ticked.step(k * PERIOD), self.seen(ticked))[1] for k in range(1, 120)]
        edged = fmi3.Instance(unit_of(3, "plain", "pair"), events=True, early=True)
        self.assertEqual(edged.put("use_tick_clock", False), OK)
        edged.begin()
        for name, value in (("source", 0), ("sink", 1), ("duty", 0.3), ("enabled", True)):
            self.assertEqual(edged.put(name, value), OK)
        self.assertEqual(edged.call("EnterStepMode"), OK)
        now, edges = 0.0, 0
        plant = Plant.__new__(Plant)
        plant.version, plant.is_ = 3, edged
        while now < 5.4e-3:
            self.assertEqual(edged.step(now, 0.73e-3), OK, edged.messages)
            now = edged.last.value
            edges += edged.needed.value
            self.assertEqual(self.seen(plant), at_ticks[math.floor(now / PERIOD + 1e-6)], now)
            if edged.needed.value:
                self.assertEqual((edged.call("EnterEventMode"), edged.call("EnterStepMode")), (OK, OK))
        self.assertGreater(edges, 1)


class Laws(unittest.TestCase):
    def test_current_of_a_held_pair_rises_by_resistance_and_inductance(self):
        R, L, U = 1.03, 0.572e-3, 24  # terminal values of data/motors/maxon-251601.toml
        for version in (2, 3):
            plant = Plant(version, "held", "gates")
            plant.gates(0b001001)  # upper switch of leg a, lower switch of leg b
            for t in (20e-6, 130e-6, 1e-3):
                self.assertEqual(plant.step(t), OK)
                expected = U / R * (1 - math.exp(-t * R / L))
                for got, wanted in zip(plant.currents(), (expected, -expected, 0)):
                    self.assertAlmostEqual(got, wanted, delta=2e-9 * expected)
            a, b, _ = plant.get_three("terminal_voltages_V", "u_{}_V")
            self.assertAlmostEqual(a - b, U, delta=1e-9)

    def test_gates_act_at_their_communication_point(self):
        """The gates are set at 137.5 us. The current of the pair rises from this instant on, and not from the next
        control tick on."""
        plant, begin, t = Plant(2, "held", "gates"), 137.5e-6, 61e-6
        plant.step(begin)
        plant.gates(0b001001)
        plant.step(begin + t)
        expected = 24 / 1.03 * (1 - math.exp(-t * 1.03 / 0.572e-3))
        self.assertAlmostEqual(plant.currents()[0], expected, delta=2e-9 * expected)

    def test_hall_code_follows_the_angle(self):
        """Each sector of 60 electrical degrees has one Hall code, and all codes differ."""
        plant, pole_pairs, codes, draw = Plant(3, "plain", "gates"), 8, {}, random.Random(2)
        while plant.now < 5.9e-3:
            plant.step(plant.now + draw.uniform(1e-6, 2e-5))
            codes.setdefault(math.floor(plant.get("angle_rad") * pole_pairs / (math.pi / 3)) % 6, set()).add(plant.get("hall"))
        self.assertGreater(len(codes), 3)
        self.assertEqual({len(of) for of in codes.values()}, {1})
        self.assertEqual(len(set.union(*codes.values())), len(codes))

    def test_an_encoder_counts_quarters_of_a_line(self):
        for inputs in ("gates", "pair"):
            plant = Plant(2, "plain", inputs, *ENCODER)
            plant.step(2.36e-3)
            self.assertEqual(plant.get("encoder_count"), math.floor(plant.get("angle_rad") * 2000 / (2 * math.pi)))
            self.assertGreater(plant.get("encoder_count"), 50)
        for n in range(1, 60):  # reads several times within a segment, and at ticks
            plant.step(2.36e-3 + n * 10e-6)
            quarter = plant.get("encoder_count") % 4
            self.assertEqual((plant.get("encoder_A"), plant.get("encoder_B")), (int(quarter < 2), int(quarter in (1, 2))))

    def test_counts_are_those_of_the_converters(self):
        words = [w for s in ("currents=phases", "current_range_A=16", "bus_range_V=32") for w in ("--set", "sensors." + s)]
        for version in (2, 3):
            plant = Plant(version, "held", "gates", *words)
            plant.gates(0b001001)
            plant.step(300e-6)
            for counts, current in zip(plant.get_three("current_counts", "current_counts_{}"), plant.currents()):
                self.assertLessEqual(abs(counts - 2048 - current / (2 * 16 / 4096)), 0.51)
            self.assertLessEqual(abs(plant.get("bus_counts") - 24 / (32 / 4096)), 0.51)
            for counts, volts in zip(plant.get_three("terminal_counts", "terminal_counts_{}"), plant.get_three("terminal_voltages_V", "u_{}_V")):
                self.assertLessEqual(abs(counts - volts / (32 / 4096)), 0.51)

    def test_load_and_supply_are_inputs_too(self):
        plant = Plant(3, "plain", "gates")
        self.assertEqual((plant.put("supply_voltage", 20.0), plant.put("load_torque", 0.02), plant.step(1e-3)), (OK, OK, OK))
        self.assertAlmostEqual(plant.get("bus_V"), 20, delta=1e-9)
        self.assertAlmostEqual(plant.get("load_Nm"), 0.02, delta=1e-12)
        self.assertNotIn("reference", plant.unit.variables)
        self.assertFalse({"duty", "i_ref_A", "speed_ref_rad_s"} & set(plant.unit.variables), "what no controller computes")


class Misuse(unittest.TestCase):
    def test_both_switches_of_a_leg_end_the_run_with_a_reason(self):
        for version in (2, 3):
            plant = Plant(version, "plain", "gates")
            plant.step(1e-3)
            plant.gates(0b000011)
            self.assertEqual(plant.step(1.1e-3), DISCARD if version == 2 else OK)
            self.assertTrue(version == 2 or (plant.is_.ends.value and plant.is_.last.value < 1.1e-3))
            self.assertIn("shoot-through", plant.messages()[-1][2])
            self.assertEqual(plant.is_.call("Reset"), OK)
            plant.begin()
            self.assertEqual(plant.step(1e-3), OK)

    def test_values_that_no_bridge_takes_are_refused_by_name(self):
        plant = Plant(2, "plain", "pair")
        for name, value, word in (("duty", 1.2, "duty"), ("duty", math.nan, "finite"), ("overlap", -1.5, "overlap"), ("source", 3, "leg"),
                                  ("sink", -1, "leg"), ("chopping", 7, "chopping"), ("chopped", 2, "chopped")):
            self.assertEqual(plant.put(name, value), ERROR, name)
            self.assertIn(word, plant.messages()[-1][2])
        legs = Plant(3, "sine", "legs")
        for name, values in (("leg_states", (0, 4, 0)), ("leg_switches", (0, 0, -1)), ("leg_duties", (0.1, 0.2, math.inf))):
            self.assertEqual(legs.put(name, values), ERROR, name)
        self.assertEqual((plant.step(1e-4), legs.step(1e-4)), (OK, OK))

    def test_a_pair_of_equal_legs_is_refused_and_a_valid_one_goes_on(self):
        """With the start values, `enabled` alone drives a pair: source a, sink b. Two equal legs are no pair; the
        order in which the caller sets them is irrelevant."""
        for version in (2, 3):
            self.assertEqual([self.start_of(version, name) for name in ("source", "sink", "duty", "enabled")], ["0", "1", "0", "false"])
            plant = Plant(version, "held", "pair")
            self.assertEqual([plant.get(name) for name in ("source", "sink")], [0, 1])
            self.assertEqual((plant.put("enabled", True), plant.step(1e-4)), (OK, OK), plant.messages())
            self.assertEqual((plant.put("sink", 0), plant.put("duty", 0.5), plant.is_.step(plant.now, 30e-6)), (OK, OK, ERROR))
            self.assertIn("source and sink", plant.messages()[-1][2])
            self.assertNotIn("controller", plant.messages()[-1][2])
            self.assertEqual((plant.put("source", 2), plant.step(1e-3), plant.step(2e-3)), (OK, OK, OK), plant.messages())
            self.assertLess(plant.currents()[0], -0.1, "c to a")
            self.assertEqual((plant.put("sink", 2), plant.put("enabled", False), plant.step(3e-3)), (OK, OK, OK), "a bridge that is off needs no pair")

    def start_of(self, version, name):
        variable = unit_of(version, "held", "pair").variables[name]
        return (variable[0] if version == 2 else variable).get("start")

    def test_numbers_of_messages_are_short(self):
        plant = Plant(2, "plain", "gates")
        plant.step(1e-5 + 2e-5)
        plant.gates(0b000011)
        self.assertEqual(plant.step(1e-5 + 2e-5 + 3e-5), DISCARD)
        self.assertRegex(plant.messages()[-1][2], r"at 3e-05 s, before 6e-05 s: both switches")

    def test_references_and_sizes_must_fit(self):
        plant = Plant(3, "plain", "gates")
        reference, six = (C.c_uint32 * 1)(1100), (C.c_bool * 6)()
        for count, kind in ((5, "Boolean"), (7, "Boolean"), (6, "Int32"), (6, "Float64")):
            array = ((C.c_double if kind == "Float64" else C.c_int32 if kind == "Int32" else C.c_bool) * 8)()
            for way in ("Get", "Set"):
                self.assertEqual(plant.is_.call(way + kind, reference, C.c_size_t(1), array, C.c_size_t(count)), ERROR)
        self.assertEqual(plant.is_.call("SetBoolean", (C.c_uint32 * 1)(1101), C.c_size_t(1), six, C.c_size_t(1)), ERROR, "an element is no variable")
        self.assertEqual(plant.is_.call("SetFloat64", (C.c_uint32 * 1)(1), C.c_size_t(1), (C.c_double * 3)(), C.c_size_t(3)), ERROR, "an output")
        self.assertEqual(plant.is_.call("SetBoolean", None, C.c_size_t(1), None, C.c_size_t(6)), ERROR)

    def test_options_that_do_not_fit_are_refused(self):
        for words, place in ((("--kind", "motor"), "--kind"), (("--kind", "plant", "--inputs", "torque"), "--inputs"), (("--inputs", "gates"), "--inputs")):
            done = sixstep("export", "fmu", FOLDER / "plain.toml", "--out", FOLDER / "none.fmu", *words, code=None)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(place, done.stderr)
            self.assertFalse((FOLDER / "none.fmu").exists())


if __name__ == "__main__":
    unittest.main(warnings="ignore")
