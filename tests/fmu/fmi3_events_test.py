# SPDX-License-Identifier: Apache-2.0
"""Units of FMI 3.0: early return, event mode with clocks, intermediate update. These features change no bit.
fmi3_events_test.py PROGRAM SOURCE LIBRARY"""
import ctypes as C
import functools
import math
import random
import sys
import unittest

import fmi3_importer as fmi
from fmi2_units import CURRENT, FOLDER, PLAIN, SOURCE, ran, sixstep
from fmi3_importer import ERROR, OK

_V, _R, _Z, _B = C.c_void_p, C.c_double, C.c_size_t, C.c_bool
TICK, HALL = "tick_clock", "hall_clock"
FAULTY = SOURCE / "data/scenarios/gallery/pulse-north.toml"
FAST = ("--set", "initial.speed_rad_s=150", "--set", "reference.value=2")


@functools.lru_cache(None)
def unit_of(file, *words):
    out = FOLDER / f"{file.stem}-{abs(hash(words))}.fmu"
    sixstep("export", "fmu", file, "--fmi", "3", "--out", out, "--force", *words)
    return fmi.Unit(out)


class Clocked(fmi.Instance):
    """An instance with event mode. `seen` has (instant, tick, Hall edge) for each event."""

    def __init__(self, unit, early=True, **more):
        super().__init__(unit, events=True, early=early, **more)
        self.seen, self.next, self.returns = [], None, 0

    def clocks(self):
        references, values = (C.c_uint32 * 2)(*(self.unit.reference(n) for n in (TICK, HALL))), (_B * 2)()
        assert self.call("GetClock", references, _Z(2), values) == OK, self.messages
        return tuple(values)

    def handle(self, now):
        """Handles an event, from the begin of event mode to step mode."""
        clocks = self.clocks()
        if any(clocks):
            self.seen.append((now, *clocks))
        flags, at = [_B() for _ in range(5)], _R()
        assert self.call("UpdateDiscreteStates", *map(C.byref, flags), C.byref(at)) == OK, self.messages
        assert not any(f.value for f in flags[:4])
        assert self.clocks() == (False, False), "an update deactivates clocks"
        self.next = at.value if flags[4].value else None
        assert self.call("EnterStepMode") == OK, self.messages

    def walk(self, step, stop):
        """Makes steps with communication points at multiples of `step`. After an early return, the next step begins
        at the returned time."""
        now, n = 0.0, 0
        self.handle(now)
        while now < stop:
            n += 1
            to = min(stop, n * step)
            while now < to:
                assert self.step(now, to - now) == OK, self.messages
                if self.ends.value:
                    return self.last.value
                assert self.early.value == (self.last.value < to)
                now = self.last.value if self.early.value else to
                self.returns += self.early.value
                if self.needed.value:
                    assert self.call("EnterEventMode") == OK, self.messages
                    self.handle(now)
        return now


def edges_of(file, *words):
    """The instants in s at which the Hall code changes in the program's trace."""
    vcd = FOLDER / "run.vcd"
    sixstep("run", file, "--vcd", vcd, "--force", "--quiet", *words, code=None)
    names, code, at, found = {}, {}, 0, []
    for line in vcd.read_text().splitlines():
        parts = line.split()
        if parts[:1] == ["$var"] and parts[4] in ("H1", "H2", "H3"):
            names[parts[3]] = parts[4]
        elif line[:1] == "#":
            at = int(line[1:])
        elif line[1:] in names and line[0] in "01":
            if names[line[1:]] in code and at > 0 and (not found or found[-1] != at):
                found.append(at)
            code[names[line[1:]]] = line[0]
    return [ps * 1e-12 for ps in found]


class Clocks(unittest.TestCase):
    def test_they_tick_at_control_ticks_and_at_hall_edges(self):
        unit = unit_of(PLAIN, *FAST)
        stop, period = unit.stop(), float(unit.description.find("DefaultExperiment").get("stepSize"))
        edges = edges_of(PLAIN, *FAST)
        self.assertGreater(len(edges), 5)
        for step in (1e-3, 37e-6, stop):
            instance = Clocked(unit).begin()
            instance.walk(step, stop)
            ticks = [t for t, tick, _ in instance.seen if tick]
            self.assertEqual(len(ticks), round(stop / period) + (ticks[-1] >= stop))
            for k, t in enumerate(ticks):
                self.assertAlmostEqual(t, k * period, delta=1e-16 * (1 + k))
            found = [t for t, _, hall in instance.seen if hall]
            self.assertEqual(len(found), len(edges))
            for t, edge in zip(found, edges):
                self.assertAlmostEqual(t, edge, delta=1.01e-12)
            self.assertEqual(instance.digest(), ran(PLAIN, *FAST)["digest"])

    def test_the_code_changes_at_its_clock_and_nowhere_else(self):
        instance = Clocked(unit_of(PLAIN, *FAST))
        self.assertEqual(instance.put("use_tick_clock", False), OK)
        instance.begin()
        now, code, edges = 0.0, instance.get("hall"), 0
        instance.handle(now)
        self.assertIsNone(instance.next)
        while now < 0.01 - 1e-9:
            self.assertEqual(instance.step(now, min(0.01 - now, 3.3e-4)), OK)
            now = instance.last.value
            self.assertEqual(instance.get("hall") != code, instance.needed.value)
            if instance.needed.value:
                code, edges = instance.get("hall"), edges + 1
                sector = instance.get("angle_rad") * 8 / (math.pi / 3)
                self.assertAlmostEqual(sector, round(sector), delta=1e-8)
                self.assertEqual(instance.call("EnterEventMode"), OK)
                instance.handle(now)
        self.assertEqual(edges, len(edges_of(PLAIN, *FAST)))
        self.assertEqual({(tick, hall) for _, tick, hall in instance.seen}, {(False, True)})

    def test_without_early_return_the_next_event_time_leads_to_the_ticks(self):
        instance = Clocked(unit_of(PLAIN), early=False).begin()
        now = 0.0
        instance.handle(now)
        for _ in range(50):
            self.assertEqual(instance.step(now, instance.next - now), OK)
            self.assertEqual((instance.needed.value, instance.early.value), (True, False))
            now = instance.next
            self.assertEqual(instance.call("EnterEventMode"), OK)
            instance.handle(now)
        self.assertEqual([(round(t / 50e-6), tick) for t, tick, _ in instance.seen], [(k, True) for k in range(51)])

    def test_a_middle_sample_ticks_in_the_middle(self):
        words = ("--set", "pwm.sample=middle", "--set", "pwm.alignment=centre", "--set", "duration_s=1e-3")
        instance = Clocked(unit_of(PLAIN, *words)).begin()
        instance.walk(1e-3, 1e-3)
        for k, t in enumerate(t for t, tick, _ in instance.seen if tick):
            self.assertAlmostEqual(t, (k + 0.5) * 50e-6, delta=1e-15)

    def test_a_saved_event_mode_goes_on_alike(self):
        unit, draw = unit_of(PLAIN, *FAST), random.Random(4)
        instance, now = Clocked(unit).begin(), 0.0
        instance.handle(now)
        while now < 2e-3:
            self.assertEqual(instance.step(now, draw.uniform(1e-5, 4e-4)), OK)
            now = instance.last.value
            if instance.needed.value:
                instance.call("EnterEventMode")
                other = Clocked(unit)
                self.assertEqual(other.load(instance.saved()), OK, other.messages)
                self.assertEqual(other.clocks(), instance.clocks())
                instance.handle(now)
        other.handle(now)
        for one in (other, instance):
            self.assertEqual(one.step(now, unit.stop() - now), OK)
        self.assertEqual(other.last.value, instance.last.value)


class EarlyReturn(unittest.TestCase):
    def test_no_step_goes_beyond_the_stop_time(self):
        unit = unit_of(PLAIN, *FAST)
        for stop in (1e-3, unit.stop() + 1e-3):
            instance = fmi.Instance(unit).begin(stop=stop)
            self.assertEqual(instance.step(0, stop + 1e-3), ERROR)
            self.assertIn("stop time", instance.messages[-1][2])
            self.assertEqual((instance.step(0, stop * (1 + 1e-12)), instance.ends.value), (OK, False))
            self.assertEqual(instance.step(stop, 1e-4), ERROR)

    def test_a_fault_returns_early_if_it_may(self):
        told = ran(FAULTY, "--set", "duration_s=5e-3")
        self.assertTrue(told["fault"])
        unit = unit_of(FAULTY, "--set", "duration_s=5e-3")
        for early in (False, True):
            instance = fmi.Instance(unit, early=early).begin()
            self.assertEqual(instance.step(0, unit.stop()), OK)
            self.assertEqual((instance.ends.value, instance.early.value, instance.needed.value), (True, early, False))
            self.assertAlmostEqual(instance.last.value, told["simulated_s"], delta=1e-12)
            self.assertIn("fault", instance.messages[-1][2])
            self.assertEqual(instance.step(instance.last.value, 1e-3), ERROR, "the run is over")
            self.assertEqual(instance.digest(), told["digest"])


class Intermediate(unittest.TestCase):
    def updated(self, early=False, ask=None):
        """Runs to the end in one step. Returns the events, with the values that the callback read."""
        unit, seen, statuses = unit_of(PLAIN, *FAST), [], set()

        def update(_, t, set_requested, get_allowed, finished, can_return, asked, at):
            seen.append((t, holder[0].get("speed_rad_s"), holder[0].get("i_a_A")))
            statuses.update({holder[0].call("EnterEventMode"), holder[0].put("supply_voltage", 20.0), holder[0].step(t, 1e-4)})
            self.assertEqual((set_requested, get_allowed, finished, can_return), (False, True, True, early))
            if ask and len(seen) == 3:
                asked[0], at[0] = True, ask(t)

        holder = [fmi.Instance(unit, early=early, update=update, intermediate=("speed_rad_s", "i_a_A"))]
        holder[0].begin()
        self.assertEqual(holder[0].step(0, unit.stop()), OK)
        self.assertEqual(statuses, {ERROR}, "within a step only values are read")
        return holder[0], seen

    def test_the_callback_sees_each_event_and_changes_nothing(self):
        instance, seen = self.updated()
        self.assertEqual((instance.needed.value, instance.early.value), (False, False))
        edges, ticks = edges_of(PLAIN, *FAST), [k * 50e-6 for k in range(1, 200)]
        self.assertEqual(len(seen), len(edges) + len(ticks))
        for t, expected in zip((t for t, *_ in seen), sorted(edges + ticks)):
            self.assertAlmostEqual(t, expected, delta=1.01e-12)
        reader = fmi.Instance(unit_of(PLAIN, *FAST)).begin()
        now = 0.0
        for t, speed, current in seen[:60]:
            reader.step(now, t - now)
            now = t
            # The time of an event has a fraction of a picosecond, the time of a communication point has none.
            self.assertAlmostEqual(reader.get("speed_rad_s"), speed, delta=1e-8)
            self.assertAlmostEqual(reader.get("i_a_A"), current, delta=1e-6)
        self.assertEqual(instance.digest(), ran(PLAIN, *FAST)["digest"])

    def test_it_can_ask_to_return_early(self):
        for ask in (lambda t: t, lambda t: t + 13e-6, lambda t: math.nan):
            instance, seen = self.updated(early=True, ask=ask)
            self.assertTrue(instance.early.value)
            wanted = ask(seen[2][0])
            self.assertAlmostEqual(instance.last.value, seen[2][0] if math.isnan(wanted) else wanted, delta=1e-12)
            self.assertEqual(instance.step(instance.last.value, 0.01 - instance.last.value), OK)
            self.assertEqual(instance.digest(), ran(PLAIN, *FAST)["digest"])
        instance, _ = self.updated(early=False, ask=lambda t: t)
        self.assertFalse(instance.early.value, "it was not allowed")


class Misuse(unittest.TestCase):
    def test_calls_out_of_their_mode_are_refused_and_change_nothing(self):
        unit = unit_of(CURRENT)
        plain = fmi.Instance(unit).begin()
        for name in ("EnterEventMode", "EnterStepMode"):
            self.assertEqual(plain.call(name), ERROR)
        instance = Clocked(unit)
        clock, value, flags, at = (C.c_uint32 * 1)(unit.reference(TICK)), (_B * 1)(), [_B() for _ in range(5)], _R()
        self.assertEqual(instance.call("GetClock", clock, _Z(1), value), ERROR)
        instance.begin()
        self.assertEqual(instance.step(0, 1e-3), ERROR, "event mode comes before the first step")
        for call in (lambda: instance.call("GetClock", (C.c_uint32 * 1)(3), _Z(1), value), lambda: instance.call("GetClock", None, _Z(1), value),
                     lambda: instance.call("SetClock", clock, _Z(1), value), lambda: instance.call("EnterEventMode"),
                     lambda: instance.call("UpdateDiscreteStates", None, *map(C.byref, flags[1:]), C.byref(at)),
                     lambda: instance.put("use_hall_clock", False), lambda: instance.call("EvaluateDiscreteStates"),
                     lambda: instance.call("GetIntervalDecimal", clock, _Z(1), (_R * 1)(), (C.c_int * 1)())):
            before = len(instance.messages)
            self.assertEqual(call(), ERROR)
            self.assertGreater(len(instance.messages), before)
        instance.walk(1e-3, unit.stop())
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])
        self.assertEqual(instance.call("Reset"), OK)
        instance.begin().walk(1e-3, unit.stop())
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])

    def test_calls_in_any_order_crash_nothing(self):
        """Drives and plants in any mode. Each call returns a status, and each refusal has a message."""
        seed = random.randrange(10**9)
        print(f"seed {seed}", file=sys.stderr)
        draw, statuses = random.Random(seed), {}
        short = ("--set", "duration_s=1e-3")
        units = [unit_of(PLAIN, *short)] + [unit_of(PLAIN, *short, "--kind", "plant", "--inputs", k) for k in ("gates", "pair", "legs")]
        types = {"Float64": _R, "Int32": C.c_int32, "Boolean": _B, "UInt8": C.c_uint8, "String": C.c_char_p}
        plain = "ExitInitializationMode EnterEventMode EnterStepMode Terminate Reset EnterConfigurationMode EvaluateDiscreteStates".split()
        for n in range(60):
            unit = units[n % 4]
            instance = fmi.Instance(unit, events=draw.random() < 0.6, early=draw.random() < 0.6, update=(lambda *_: None) if draw.random() < 0.5 else None)
            states, now = [_V() for _ in range(3)], 0.0
            references = [*(unit.reference(v) for v in unit.variables), 7777, 0xFFFFFFFF]
            for _ in range(60):
                kind, count, state = draw.choice(list(types)), draw.randrange(3), draw.choice(states)
                chosen = (C.c_uint32 * 2)(*(draw.choice(references) for _ in range(2)))
                numbers = [draw.choice([0, 1, 0.3, math.nan, math.inf, -2] if kind == "Float64" else [b"x"] if kind == "String" else [0, 1, 2, 7]) for _ in range(8)]
                values, room = (types[kind] * 8)(*numbers), draw.choice([count, count, 3, 6, 8])
                flags, time = [_B() for _ in range(5)], _R()
                name, given = draw.choice([
                    *((p, ()) for p in plain), *[("DoStep", (_R(now), _R(draw.choice([1e-4, 5e-5, 3e-3, 0.0, math.nan])), _B(True), *map(C.byref, (*flags[:3], time))))] * 4,
                    ("EnterInitializationMode", (_B(False), _R(0), _R(draw.choice([0.0, math.nan])), _B(draw.random() < 0.5), _R(draw.choice([2e-3, -1.0])))),
                    ("Get" + kind, (chosen, _Z(count), values, _Z(room))), ("Set" + kind, (chosen, _Z(count), values, _Z(room))),
                    ("GetClock", (chosen, _Z(count), (_B * 2)())), ("UpdateDiscreteStates", (*map(C.byref, flags), C.byref(time))),
                    ("GetFMUState", (C.byref(state),)), ("SetFMUState", (state,)), ("FreeFMUState", (C.byref(state),)),
                    ("DeserializeFMUState", (b"nothing", _Z(7), C.byref(state)))])
                before = len(instance.messages)
                status = instance.call(name, *given)
                statuses[status] = statuses.get(status, 0) + 1
                self.assertIn(status, (OK, fmi.WARNING, fmi.DISCARD, ERROR))
                self.assertTrue(status == OK or len(instance.messages) > before, f"{name} of seed {seed} says nothing")
                if name == "DoStep" and status == OK:
                    now = time.value
                now = 0.0 if name == "Reset" and status == OK else now
                self.assertEqual(getattr(unit.library, "fmi3" + name)(None, *given), ERROR)
        self.assertGreater(min(statuses[OK], statuses[ERROR]), 300)

    def test_the_description_says_what_the_unit_can(self):
        unit = unit_of(CURRENT)
        flags = unit.description.find("CoSimulation").attrib
        for flag in ("hasEventMode", "providesIntermediateUpdate", "canReturnEarlyAfterIntermediateUpdate", "mightReturnEarlyFromDoStep"):
            self.assertEqual(flags[flag], "true")
        for name in (TICK, HALL):
            v = unit.variables[name]
            self.assertEqual((v.tag, v.get("causality"), v.get("variability"), v.get("intervalVariability")), ("Clock", "output", "discrete", "triggered"))
        marked = {name for name, v in unit.variables.items() if v.get("intermediateUpdate") == "true"}
        self.assertEqual({unit.variables[name].get("variability") for name in marked}, {"continuous"})
        self.assertIn("speed_rad_s", marked)
        for wrong in (("hall",), ("time",), ("supply_voltage",), (TICK,)):
            self.assertIsNone(fmi.Instance(unit, intermediate=wrong).c, wrong)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
