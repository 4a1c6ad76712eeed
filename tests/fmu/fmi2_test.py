# SPDX-License-Identifier: Apache-2.0
"""Units of FMI 2.0, called by this repository's importer. The bits are equal to those of the program, and no call
crashes.
fmi2_test.py PROGRAM SOURCE LIBRARY [--long]"""
import concurrent.futures
import ctypes as C
import math
import pathlib
import random
import re
import subprocess
import sys
import unittest

import fmi2_importer as fmi
from fmi2_units import CURRENT, FILES, FOLDER, LONG, PLAIN, SOURCE, exported, ran, sixstep


class Bits(unittest.TestCase):
    def test_steps_of_any_length_have_the_digest_of_the_program(self):
        short, compared, draw = ("--set", "duration_s=3e-3"), 0, random.Random(39)
        for file in FILES[::3]:
            told = ran(file, *short)
            if told is None or compared == 12:
                continue
            unit = exported(file, *short)
            for step in (1e-3, 37e-6, 10e-6, lambda: draw.uniform(1e-7, 3e-4)):
                with self.subTest(f"{file.stem} {step}"):
                    instance = fmi.Instance(unit).begin()
                    instance.run(step, 3e-3)
                    self.assertEqual(instance.digest(), told["digest"])
            compared += 1
        self.assertEqual(compared, 12)

    def test_outputs_are_the_rows_of_the_run(self):
        unit = exported(CURRENT)
        csv = FOLDER / "rows.csv"
        sixstep("run", CURRENT, "--csv", csv, "--set", "record.grid_s=1e-4", "--quiet")
        lines = [line for line in csv.read_text().splitlines() if not line.startswith("#")]
        heads = lines[0].split(",")
        instance, now, compared = fmi.Instance(unit).begin(), 0.0, 0
        for line in lines[2:60]:
            row = dict(zip(heads, line.split(",")))
            if float(row["t_s"]) <= now:
                continue
            self.assertEqual(instance.step(now, float(row["t_s"]) - now), fmi.OK)
            now = float(row["t_s"])
            for name in ("i_a_A", "speed_rad_s", "bus_V", "angle_rad"):
                self.assertAlmostEqual(instance.get(name), float(row[name]), delta=1e-9 * (1 + abs(float(row[name]))))
            compared += 1
        self.assertGreater(compared, 20)

    def test_a_linear_motor_has_its_own_names_and_units(self):
        file, csv = SOURCE / "data/scenarios/gallery/linear-motor.toml", FOLDER / "linear.csv"
        unit = exported(file)
        self.assertEqual((unit.variables["load_force"][0].get("unit"), unit.variables["speed_m_s"][0].get("unit")), ("N", "m/s"))
        sixstep("run", file, "--csv", csv, "--quiet", code=None)
        lines = [line for line in csv.read_text().splitlines() if not line.startswith("#")]
        row = dict(zip(lines[0].split(","), lines[len(lines) // 2].split(",")))
        instance = fmi.Instance(unit).begin()
        self.assertEqual(instance.step(0, float(row["t_s"])), fmi.OK)
        for name in ("speed_m_s", "position_mm", "force_N"):
            self.assertAlmostEqual(instance.get(name), float(row[name]), delta=1e-9 * (1 + abs(float(row[name]))))
        instance.run(1e-3, unit.stop(), float(row["t_s"]))
        self.assertEqual(instance.digest(), ran(file)["digest"])
        pushed = fmi.Instance(unit).begin()
        self.assertEqual((pushed.put("load_force", 1.5), pushed.step(0, 1e-3)), (fmi.OK, fmi.OK))
        self.assertAlmostEqual(pushed.get("load_N"), 1.5, delta=1e-12)

    def test_a_changed_input_is_an_at_of_the_scenario(self):
        """The inputs change at communication points of 1 ms. The steps between them have any length. The result is
        equal to a scenario with the same changes in [[at]]."""
        unit, digests, logged = exported(CURRENT), set(), None
        for step in (1e-3, 1e-4, 37e-6):
            instance = fmi.Instance(unit, logging=True).begin()
            now = 0.0
            for n, (name, value) in enumerate((("supply_voltage", 20.0), ("load_torque", 0.01), ("supply_voltage", 22.5)), 2):
                now = instance.run(step, n * 1e-3, now)
                self.assertEqual(instance.put(name, value), fmi.OK)
                self.assertEqual(instance.get(name), value)
            instance.run(step, unit.stop(), now)
            digests.add(instance.digest())
            logged = [m[2] for m in instance.messages if m[1] == "logEvents"]
        self.assertEqual(len(digests), 1)
        at = "".join(f"\n[[at]]\ntime_s = {m[0]}\n{m[1]}\n" for m in (re.search(r"at (\S+) s of the run: (.*)", text).groups() for text in logged))
        self.assertEqual(at.count("[[at]]"), 3)
        (FOLDER / "changed.toml").write_text(CURRENT.read_text() + at)
        self.assertEqual({ran(FOLDER / "changed.toml")["digest"]}, digests)

    def test_an_input_that_is_set_to_its_own_value_changes_nothing(self):
        unit = exported(CURRENT)
        start = {name: float(v[0].get("start")) for name, v in unit.variables.items() if v.get("causality") == "input"}
        self.assertEqual(sorted(start), ["load_torque", "reference", "supply_voltage"])
        instance, now = fmi.Instance(unit).begin(), 0.0
        while now < unit.stop():
            for name, value in start.items():
                self.assertEqual(instance.put(name, value), fmi.OK)
            now = instance.run(1e-4, min(unit.stop(), now + 1e-4), now)
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])

    def test_a_unit_ends_early_at_a_tick_and_later_if_it_is_asked_to(self):
        unit = exported(PLAIN)
        short = fmi.Instance(unit).begin()
        short.run(1e-4, 4.02e-3)
        period = float(unit.description.find("DefaultExperiment").get("stepSize"))
        self.assertEqual(short.digest(), ran(PLAIN, "--set", f"duration_s={math.ceil(4.02e-3 / period) * period!r}")["digest"])
        longer = fmi.Instance(unit).begin(stop=unit.stop() + 2e-3)
        longer.run(1e-3, unit.stop() + 2e-3)
        self.assertEqual(longer.digest(), ran(PLAIN, "--set", f"duration_s={unit.stop() + 2e-3!r}")["digest"])
        shifted = fmi.Instance(unit).begin(start=5.0)
        shifted.run(1e-3, 5.0 + unit.stop(), 5.0)
        self.assertEqual(shifted.digest(), ran(PLAIN)["digest"])

    def test_past_its_end_a_step_is_discarded(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin()
        self.assertEqual(instance.step(0, 2 * unit.stop()), fmi.DISCARD)
        self.assertEqual(instance.messages[-1][:2], (fmi.DISCARD, "logStatusDiscard"))
        last, over, status = C.c_double(), C.c_int(), C.c_int()
        self.assertEqual(instance.call("GetRealStatus", fmi.LAST_TIME, C.byref(last)), fmi.OK)
        self.assertEqual(instance.call("GetBooleanStatus", fmi.TERMINATED, C.byref(over)), fmi.OK)
        self.assertEqual(instance.call("GetStatus", fmi.DO_STEP, C.byref(status)), fmi.OK)
        self.assertAlmostEqual(last.value, unit.stop(), delta=1e-12)
        self.assertEqual((over.value, status.value), (1, fmi.DISCARD))
        self.assertEqual(instance.step(last.value, 1e-4), fmi.ERROR)
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])

    def test_hundred_thousand_steps_have_the_digest_of_the_program(self):
        steps = 10**6 if LONG else 10**5
        unit = exported(CURRENT)
        instance, size = fmi.Instance(unit).begin(), unit.stop() / steps
        step, c = unit.library.fmi2DoStep, instance.c
        for n in range(steps):
            assert step(c, n * size, size, 1) == fmi.OK, instance.messages
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])


class Instances(unittest.TestCase):
    def test_two_at_once_are_independent(self):
        unit = exported(CURRENT)
        one, other = fmi.Instance(unit).begin(), fmi.Instance(unit).begin()
        other.put("supply_voltage", 20.0)
        at = [0.0, 0.0]
        while min(at) < unit.stop():
            at[0] = one.run(1e-4, min(unit.stop(), at[0] + 1e-4), at[0])
            at[1] = other.run(7e-5, min(unit.stop(), at[1] + 7e-5), at[1])
        self.assertEqual(one.digest(), ran(CURRENT)["digest"])
        self.assertNotEqual(other.digest(), ran(CURRENT)["digest"])

    def test_threads_share_nothing(self):
        unit = exported(CURRENT)

        def whole(_):
            instance = fmi.Instance(unit).begin()
            instance.run(1e-4, unit.stop())
            return instance.digest()

        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertEqual(set(pool.map(whole, range(8))), {ran(CURRENT)["digest"]})

    def test_reset_begins_again(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin()
        instance.put("load_torque", 0.05)
        instance.run(1e-3, 5e-3)
        for _ in range(2):
            self.assertEqual(instance.call("Reset"), fmi.OK)
            instance.begin().run(1e-3, unit.stop())
            self.assertEqual(instance.digest(), ran(CURRENT)["digest"])


class State(unittest.TestCase):
    def test_a_state_is_gone_back_to(self):
        unit = exported(CURRENT)
        instance, state = fmi.Instance(unit).begin(), C.c_void_p()
        now = instance.run(1e-4, 4.35e-3)
        self.assertEqual(instance.call("GetFMUstate", C.byref(state)), fmi.OK)
        seen = []
        for _ in range(3):
            instance.put("load_torque", 0.02)
            instance.run(1e-4, 8e-3, now)
            seen.append((instance.get("i_a_A"), instance.get("speed_rad_s")))
            self.assertEqual(instance.call("SetFMUstate", state), fmi.OK)
        self.assertEqual(len(set(seen)), 1)
        instance.run(1e-4, unit.stop(), now)
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])
        self.assertEqual(instance.call("SetFMUstate", state), fmi.OK, "also after the end")
        self.assertEqual(instance.get("digest"), b"")

    def test_a_state_goes_to_another_process_and_folder(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin()
        now = instance.run(1e-4, 3e-3)
        instance.put("supply_voltage", 21.0)
        now = instance.run(1e-4, 4e-3, now)
        (FOLDER / "state").write_bytes(instance.saved())
        program = ("import sys; sys.path.insert(0, sys.argv[1]); import fmi2_importer as fmi\n"
                   "unit = fmi.Unit(sys.argv[2]); i = fmi.Instance(unit); assert i.load(open(sys.argv[3], 'rb').read()) == fmi.OK, i.messages\n"
                   "assert i.get('supply_voltage') == 21.0; i.run(7e-5, unit.stop(), 4e-3); print(i.digest())")
        there = subprocess.run([sys.executable, "-c", program, pathlib.Path(__file__).parent, FOLDER / f"{CURRENT.stem}.fmu", FOLDER / "state"],
                               capture_output=True, text=True, timeout=60)
        instance.run(1e-4, unit.stop(), now)
        self.assertEqual(there.stdout.strip(), instance.digest(), there.stderr)

    def test_every_phase_is_saved(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit)
        saved = [instance.saved()]
        for call in (("EnterInitializationMode",), ("ExitInitializationMode",), ("DoStep", 0.0, unit.stop(), 1), ("Terminate",)):
            self.assertEqual(instance.call(*call), fmi.OK, instance.messages)
            saved.append(instance.saved())
        for n, data in enumerate(saved):
            other = fmi.Instance(unit)
            self.assertEqual(other.load(data), fmi.OK, (n, other.messages))
            for call in (("EnterInitializationMode",), ("ExitInitializationMode",), ("DoStep", 0.0, unit.stop(), 1), ("Terminate",))[n:]:
                self.assertEqual(other.call(*call), fmi.OK, other.messages)
            self.assertEqual(other.get("digest").decode(), ran(CURRENT)["digest"])

    def test_damaged_bytes_and_states_of_others_are_refused(self):
        unit, draw = exported(CURRENT), random.Random(5)
        instance = fmi.Instance(unit).begin()
        instance.run(1e-4, 1e-3)
        data = instance.saved()
        for n in range(100):
            broken = bytearray(data[: draw.randrange(len(data))] if n % 3 == 0 else data)
            for _ in range(draw.randrange(1, 4)):
                if broken:
                    broken[draw.randrange(len(broken))] = draw.randrange(256)
            other = fmi.Instance(unit)
            if other.load(bytes(broken)) == fmi.OK:
                other.call("DoStep", 1e-3, 1e-4, 1)
        other, state = fmi.Instance(unit).begin(), C.c_void_p()
        self.assertEqual(other.call("GetFMUstate", C.byref(state)), fmi.OK)
        self.assertEqual(instance.call("SetFMUstate", state), fmi.ERROR)
        self.assertEqual(instance.call("SetFMUstate", None), fmi.ERROR)
        self.assertEqual(other.call("FreeFMUstate", C.byref(state)), fmi.OK)
        other_unit = exported(PLAIN)
        self.assertEqual(fmi.Instance(other_unit).load(data), fmi.ERROR)


class Misuse(unittest.TestCase):
    def test_an_instance_needs_its_own_description_and_resources(self):
        unit = exported(CURRENT)
        for wrong in ({"guid": "{0}"}, {"resources": "file:///nowhere"}, {"kind": 0}, {"name": b""}, {"name": None}):
            instance = fmi.Instance(unit, **wrong)
            self.assertIsNone(instance.c, wrong)
            self.assertEqual(instance.messages[0][:2], (fmi.ERROR, "logStatusError"), wrong)
        self.assertTrue(fmi.Instance(unit, resources=str(unit.folder / "resources")).c, "a plain path")
        self.assertIsNone(unit.library.fmi2Instantiate(None, 1, None, None, None, 0, 0))
        c = unit.library.fmi2Instantiate(b"without a logger", 1, unit.guid.encode(), unit.resources.encode(), None, 0, 0)
        self.assertEqual(unit.library.fmi2DoStep(c, 0, 1, 1), fmi.ERROR)
        unit.library.fmi2FreeInstance(c)
        unit.library.fmi2FreeInstance(None)

    def test_values_that_are_none_are_refused_with_a_message(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin()
        real = (C.c_double * 1)()
        for call in (lambda: instance.put("i_a_A", 1.0), lambda: instance.put("reference", math.nan), lambda: instance.put("reference", math.inf),
                     lambda: instance.call("GetReal", (C.c_uint * 1)(99999), 1, real), lambda: instance.call("GetReal", None, 1, real),
                     lambda: instance.call("GetReal", (C.c_uint * 1)(1), 1, None), lambda: instance.call("SetReal", None, 2, None),
                     lambda: instance.call("GetReal", (C.c_uint * 1)(unit.reference("hall")), 1, real),
                     lambda: instance.call("GetString", (C.c_uint * 1)(3), 1, (C.c_char_p * 1)()),
                     lambda: instance.step(0, 0), lambda: instance.step(0, -1), lambda: instance.step(0, math.nan), lambda: instance.step(1, 1e-4),
                     lambda: instance.call("SetDebugLogging", 1, 1, (C.c_char_p * 1)(b"nothing")), lambda: instance.call("CancelStep"),
                     lambda: instance.call("GetFMUstate", None), lambda: instance.call("GetRealStatus", 2, None)):
            before = len(instance.messages)
            self.assertEqual(call(), fmi.ERROR)
            self.assertGreater(len(instance.messages), before)
        self.assertEqual(instance.call("GetReal", None, 0, None), fmi.OK)
        instance.run(1e-3, unit.stop())
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"], "refused calls change nothing")

    def test_an_input_that_the_library_refuses_names_its_limit_and_the_unit_goes_on(self):
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin()
        self.assertEqual(instance.put("supply_voltage", -3.0), fmi.OK)
        self.assertEqual(instance.step(0, 1e-3), fmi.ERROR)
        self.assertIn("supply.voltage_V = -3 must be above 0", instance.messages[-1][2])
        self.assertEqual(instance.put("supply_voltage", 24.0), fmi.OK)
        self.assertEqual(instance.step(0, 1e-3), fmi.OK)

    def test_calls_in_any_order_crash_nothing(self):
        unit, seed = exported(PLAIN, "--set", "duration_s=1e-3", name="tiny"), random.randrange(10**9)
        print(f"seed {seed}", file=sys.stderr)
        draw, statuses = random.Random(seed), {}
        refs = [*(unit.reference(n) for n in unit.variables), 7777, 0xFFFFFFFF]
        for _ in range(40):
            instance, now = fmi.Instance(unit, logging=True), 0.0
            states = [C.c_void_p() for _ in range(3)]
            for _ in range(60):
                name = draw.choice([n for n in fmi.DECLARED if n not in ("Instantiate", "FreeInstance", "GetTypesPlatform", "GetVersion")])
                count = draw.randrange(3)
                chosen, values = (C.c_uint * 2)(*(draw.choice(refs) for _ in range(2))), {"Real": (C.c_double * 2)(draw.choice([0, 1, 24, math.nan]), 1),
                    "Integer": (C.c_int * 2)(), "Boolean": (C.c_int * 2)(), "String": (C.c_char_p * 2)(b"", b"x")}
                state = draw.choice(states)
                arguments = {"SetupExperiment": lambda: (0, 0.0, draw.choice([0.0, math.nan, 1.0]), draw.randrange(2), draw.choice([2e-3, -1.0])),
                             "SetDebugLogging": lambda: (1, 0, None), "GetFMUstate": lambda: (C.byref(state),), "SetFMUstate": lambda: (state,),
                             "FreeFMUstate": lambda: (C.byref(state),), "SerializedFMUstateSize": lambda: (state, C.byref(C.c_size_t())),
                             "SerializeFMUstate": lambda: (state, C.create_string_buffer(8), 8),
                             "DeSerializeFMUstate": lambda: (b"nothing", 7, C.byref(state)),
                             "GetDirectionalDerivative": lambda: (chosen, 1, chosen, 1, values["Real"], values["Real"]),
                             "SetRealInputDerivatives": lambda: (chosen, 1, values["Integer"], values["Real"]),
                             "GetRealOutputDerivatives": lambda: (chosen, 1, values["Integer"], values["Real"]),
                             "DoStep": lambda: (now, draw.choice([1e-4, 5e-5, 2e-3, 0.0]), 1), "GetStatus": lambda: (draw.randrange(5), C.byref(C.c_int())),
                             "GetRealStatus": lambda: (draw.randrange(5), C.byref(C.c_double())), "GetIntegerStatus": lambda: (draw.randrange(5), C.byref(C.c_int())),
                             "GetBooleanStatus": lambda: (draw.randrange(5), C.byref(C.c_int())), "GetStringStatus": lambda: (draw.randrange(5), C.byref(C.c_char_p()))}
                given = arguments[name]() if name in arguments else () if fmi.DECLARED[name][1] == [C.c_void_p] else (chosen, count, values[name[3:]])
                before = len(instance.messages)
                status = instance.call(name, *given)
                self.assertIn(status, (fmi.OK, fmi.WARNING, fmi.DISCARD, fmi.ERROR))
                if status in (fmi.DISCARD, fmi.ERROR):
                    self.assertGreater(len(instance.messages), before, f"{name} of seed {seed} says nothing")
                if name == "DoStep" and status == fmi.OK:
                    now += given[1]
                if name == "Reset" and status == fmi.OK:
                    now = 0.0
                statuses[status] = statuses.get(status, 0) + 1
                self.assertEqual(getattr(unit.library, "fmi2" + name)(None, *given), fmi.ERROR)
        self.assertGreater(statuses[fmi.OK], 200)
        self.assertGreater(statuses[fmi.ERROR], 200)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
