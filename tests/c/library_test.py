# SPDX-License-Identifier: Apache-2.0
"""libsixstep computes the same bits as the program. A controller outside of the library has the same bits as inside,
and no call crashes.
library_test.py LIBRARY PROGRAM SOURCE CONTROLLERS SIZES"""
import ctypes as C
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import unittest

LIBRARY, PROGRAM, SOURCE, CONTROLLERS, SIZES = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(5))
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import c_library as c  # noqa: E402

LIB = c.load(LIBRARY)
FILES = sorted([*(SOURCE / "data/scenarios/thesis").glob("*.toml"), *(SOURCE / "data/scenarios/gallery").glob("*.toml")])
CURRENT = SOURCE / "data/scenarios/thesis/8b-exact-design.toml"
PLAIN = """motor = "maxon-251601"
duration_s = 6e-3
[supply]
voltage_V = 24
[initial]
speed_rad_s = 100
[control]
mode = "current"
[reference]
value = 1.5
"""
HELD = PLAIN.replace("speed_rad_s = 100", "speed_rad_s = 0") + "[load]\nlocked = true\n"
SINE = PLAIN.replace('"current"', '"duty"').replace("value = 1.5", "value = 0.1") + '[pwm]\nalignment = "centre"\n'


def program(file, *words):
    """The program's own result of a file or of a text, or None if the program refuses it."""
    if not isinstance(file, pathlib.Path):
        with tempfile.TemporaryDirectory() as folder:
            written = pathlib.Path(folder) / "text.toml"
            written.write_text(file)
            return program(written, *words)
    done = subprocess.run([PROGRAM, "run", file, "--json", "-", *words], capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode in (0, 1, 3) else None


def opened(*arguments, **named):
    session = c.Session.open(LIB, *arguments, **named)
    assert session.status == c.OK, session.problems()
    return session


def digest(session):
    session.advance(1)
    assert session.finish() == c.OK, session.problems()
    return f"{session.digest():016x}"


class Bits(unittest.TestCase):
    def test_steps_of_any_length_have_the_digest_of_the_program(self):
        """Runs 30 of the shipped scenarios with steps of 1 ms, 37 us, 10 us and random length."""
        draw = random.Random(39)
        short = [file for file in FILES if opened(file).duration() <= 0.06]
        self.assertGreater(len(short), 30)
        for file in short[:: len(short) // 30][:30]:
            with self.subTest(file.stem):
                told = program(file)
                for step in (1e-3, 37e-6, 10e-6, None):
                    session = opened(file)
                    at = 0.0
                    while True:
                        at += step or draw.uniform(1e-7, 3e-4)
                        if session.advance(at) != c.OK:
                            break
                        session.value_of("i_a_A")
                    self.assertEqual(digest(session), told["digest"])
                self.assertEqual(json.loads(session.outcome())["require"], told["require"])

    def test_threads_share_nothing(self):
        expected = digest(opened(CURRENT))
        found = []
        threads = [threading.Thread(target=lambda: found.extend(digest(opened(CURRENT)) for _ in range(4))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected] * 16)
        self.assertEqual(expected, program(CURRENT)["digest"])

    def test_a_change_is_that_of_the_scenario(self):
        session = opened(CURRENT)
        session.advance(5e-3)
        at = C.c_double()
        self.assertEqual(session.change(b"supply.voltage_V = 20", C.byref(at)), c.OK)
        self.assertTrue(5e-3 <= at.value <= 5e-3 + 60e-6)
        text = session.scenario().decode()
        mine = digest(session)
        cut = session.scenario().decode()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "changed.toml"
            file.write_text(cut)
            self.assertEqual(program(file)["digest"], mine)
        self.assertIn("voltage_V = 20", text)

    def test_hall_edges_of_a_drive_are_events_and_reads_go_on_behind_them(self):
        """One session stops exactly at a Hall edge and continues. Another session does not stop there. Both read the
        same values."""
        session, code, edges = opened(text=PLAIN), None, 0
        while session.advance_to_hall_edge(5.9e-3) == c.OK and session.time() < 5.9e-3:
            self.assertNotEqual(session.value_of("hall"), code)
            code, at, edges = session.value_of("hall"), session.time(), edges + 1
            sector = session.value_of("angle_rad") * 8 / (math.pi / 3)
            self.assertAlmostEqual(sector, round(sector), delta=1e-9)
            there, fresh = opened(text=PLAIN), opened(text=PLAIN)
            for later in (0.0, 1e-6, 2e-6, 5e-6, 40e-6, 90e-6):
                there.advance(at + later), fresh.advance(at + later) if later else None
                self.assertTrue(not later or there.value_of("hall") == fresh.value_of("hall"), (at, later))
                for name in ("i_a_A", "speed_rad_s", "u_c_V"):
                    self.assertTrue(not later or abs(there.value_of(name) - fresh.value_of(name)) < 1e-9, (at, later, name))
        self.assertGreater(edges, 2)
        self.assertEqual(digest(session), program(PLAIN)["digest"])

    def test_ticks_are_told_ahead(self):
        session = opened(text=PLAIN)
        self.assertEqual(session.tick_after(-1.0), 0.0)
        for n in range(1, 20):
            tick = session.tick_after(session.time())
            self.assertEqual(session.advance_to_tick(), c.OK)
            self.assertEqual(session.time(), tick)
        self.assertTrue(math.isnan(session.tick_after(math.nan)) and math.isnan(session.tick_after(math.inf)))
        self.assertTrue(math.isnan(LIB.sixstep_tick_after(None, 0.0)))

    def test_a_copy_and_a_saved_session_go_on_alike(self):
        session = opened(CURRENT)
        session.advance(4e-3)
        session.change(b"supply.voltage_V = 22", None)
        session.advance(7.7e-3)
        copy, loaded = session.copied(), c.Session.loaded(LIB, session.saved())
        self.assertEqual(loaded.status, c.OK, loaded.problems())
        self.assertEqual(loaded.time(), session.time())
        session.advance(1)
        for other in (copy, loaded):
            self.assertEqual(other.value_of("i_a_A"), loaded.value_of("i_a_A"))
            other.advance(1)
            self.assertEqual(digest(other), f"{self.whole(session):016x}")

    def whole(self, session):
        if not session.digest():
            self.assertEqual(session.finish(), c.OK)
        return session.digest()


class OwnController(unittest.TestCase):
    """The same compiled controller runs inside the simulation, and is called by this program between advances."""

    def controlled(self, name, chip, text):
        own = C.CDLL(str(CONTROLLERS / f"{name}.so"))

        class Controller(C.Structure):
            _fields_ = [("interface", C.c_uint32), ("answers", C.c_uint32), ("name", C.c_char_p), ("sentence", C.c_char_p),
                        ("config_bytes", C.c_uint32), ("state_bytes", C.c_uint32), ("parameters", C.c_uint32), ("parameter", C.c_void_p),
                        ("design", C.c_void_p), ("start", C.c_void_p),
                        ("step", C.CFUNCTYPE(None, C.c_void_p, C.c_void_p, C.POINTER(c.Measured), C.c_double, C.POINTER(c.Answer))),
                        ("hall", C.c_void_p)]
        own.sixstep_own_controller.restype = C.POINTER(Controller)
        step = own.sixstep_own_controller().contents.step
        session = opened(text=text, chip=chip)
        measured, setpoint, answer, saved = c.Measured(), C.c_double(), c.Answer(), None
        for tick in range(10**6):
            self.assertEqual(session.measure(C.byref(measured), C.byref(setpoint)), c.OK, session.problems())
            step(None, None, C.byref(measured), setpoint, C.byref(answer))
            self.assertEqual(session.command(C.byref(answer)), c.OK)
            if tick == 40:
                saved = session.saved()
            if session.advance_to_tick() != c.OK:
                break
        self.assertGreater(tick, 100)
        loaded = c.Session.loaded(LIB, saved)  # the session was saved at tick 40, after its command was set
        self.assertEqual(loaded.status, c.OK)
        self.assertAlmostEqual(loaded.time(), 40 * session.period(), delta=1e-15)
        return session, program(text, "--set", "control.drive=own", "--set", f"control.own.controller={CONTROLLERS / name}.so")

    def test_a_tick_that_was_passed_for_reading_is_the_next_one(self):
        session = opened(text=PLAIN, chip=c.PAIR)
        for _ in range(4):
            session.advance_to_tick()
        tick = session.time()
        session.advance(tick - session.period() / 3)
        self.assertEqual((session.advance_to_tick(), session.time()), (c.OK, tick))
        self.assertEqual(session.measure(C.byref(c.Measured()), None), c.OK)

    def test_an_answer_that_no_timer_executes_is_the_problem(self):
        session, answer = opened(text=PLAIN, chip=c.PAIR), c.Answer(enabled=1, source=0, sink=1, duty=math.nan)
        session.command(C.byref(answer))
        self.assertEqual(session.advance(1e-3), c.OVER)
        self.assertIn("duty", " ".join(session.problems()[0]))

    def test_of_a_pair_has_the_same_bits_inside_and_outside(self):
        session, told = self.controlled("pair_of_the_code", c.PAIR, PLAIN)
        self.assertIsNone(told["fault"])
        self.assertEqual(digest(session), told["digest"])
        self.assertGreater(abs(session.value_of("i_a_A")) + abs(session.value_of("i_b_A")), 0.05)

    def test_of_three_legs_has_the_same_bits_inside_and_outside(self):
        session, told = self.controlled("sine_voltage", c.LEGS, SINE)
        self.assertEqual(digest(session), told["digest"])


class Gates(unittest.TestCase):
    PAIRS = [(0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1)]  # source and sink of each sector

    def chopped(self, read_step, duty=0.4, period=50e-6, end=5e-3):
        """Drives the pair of the sector and chops its upper switch."""
        session = opened(text=PLAIN.replace("speed_rad_s = 100", "speed_rad_s = 0"), chip=c.GATES)
        for n in range(round(end / period)):
            source, sink = self.PAIRS[int(session.value_of("sector"))]
            for gates, to in ((1 << 2 * source | 2 << 2 * sink, duty), (2 << 2 * sink, 1.0)):
                self.assertEqual(session.set_gates(gates), c.OK)
                while read_step and session.time() + read_step < (n + to) * period:
                    session.advance(session.time() + read_step)
                self.assertEqual(session.advance((n + to) * period), c.OK)
        return session

    def test_reads_change_no_bit(self):
        wanted = self.chopped(0)
        read = self.chopped(1.7e-6)
        self.assertEqual(read.value_of("i_a_A"), wanted.value_of("i_a_A"))
        self.assertEqual(digest(read), digest(wanted))

    def test_current_rises_as_the_pair_of_a_held_rotor_does(self):
        """The current in the pair is U/R_ab (1 - exp(-t R_ab/L_ab)), with the resistance R_ab and inductance L_ab
        between the terminals. The third phase has no current, and the bus has the current of the pair."""
        session = opened(text=HELD, chip=c.GATES)
        session.set_gates(0b001001)  # upper switch of leg a, lower switch of leg b
        R, L, U = 1.03, 0.572e-3, 24  # terminal values of data/motors/maxon-251601.toml
        for t in (20e-6, 130e-6, 1e-3):
            session.advance(t)
            expected = U / R * (1 - math.exp(-t * R / L))
            self.assertAlmostEqual(session.value_of("i_a_A"), expected, delta=2e-9 * expected)
            self.assertAlmostEqual(session.value_of("i_b_A"), -expected, delta=2e-9 * expected)
            self.assertAlmostEqual(session.value_of("bus_A"), expected, delta=2e-9 * expected)
            self.assertAlmostEqual(session.value_of("i_c_A"), 0, delta=1e-12)
        session.set_gates(0)  # both diodes conduct: each terminal moves to the other rail, and beyond it by the diode's voltage
        self.assertLessEqual(session.value_of("u_ab_V"), -U)

    def test_hall_edges_are_found_to_the_picosecond(self):
        session = opened(text=PLAIN, chip=c.GATES)
        pole_pairs, found = 8, []
        while session.advance_to_hall_edge(5e-3) == c.OK and session.time() < 5e-3:
            found.append(session.time())
            angle = session.value_of("angle_rad") * pole_pairs / (math.pi / 3)
            self.assertAlmostEqual(angle, round(angle), delta=1e-8)  # at 100 rad/s a picosecond is 8e-10 of a sector
        self.assertGreater(len(found), 2)

    def test_an_edge_that_does_not_come_ends_at_an_instant_of_any_fraction(self):
        session = opened(CURRENT, chip=c.GATES, settings=["load.locked=true"])
        for n in range(1, 60):
            for search in (session.advance_to_hall_edge, lambda to_s: session.advance_to_crossing(0, 1e3, to_s)):
                self.assertEqual(search(n * 1e-4 / 7), c.OK)
                self.assertAlmostEqual(session.time(), n * 1e-4 / 7, delta=1e-12)

    def test_crossings_are_found_to_the_picosecond(self):
        """One picosecond before the crossing, a copy of the session is still on the old side of the level. The same
        is true at every tenth of the time before."""
        draw, found, jumps = random.Random(5), 0, 0
        session = opened(CURRENT, chip=c.GATES, settings=["load.locked=false", "initial.speed_rad_s=100"])
        while session.time() < 4e-3:
            source, sink = self.PAIRS[int(session.value_of("sector"))]
            for gates, length in ((1 << 2 * source | 2 << 2 * sink, 20e-6), (2 << 2 * sink, 30e-6), (0, 40e-6)):
                session.set_gates(gates)
                leg = draw.choice((source, sink, 3 - source - sink))
                level = draw.choice((0.0, self.above(session, leg) + draw.uniform(-0.1, 0.1), draw.uniform(-8, 8)))
                before, begin, end, side = session.copied(), session.time(), session.time() + length, self.above(session, leg) > level
                self.assertEqual(session.advance_to_crossing(leg, level, end), c.OK)
                at = session.time()
                if at < end - 1e-12:
                    found += 1
                    self.assertNotEqual(self.above(session, leg) > level, side)
                    jumps += abs(self.above(session, leg) - level) > 1e-3
                    for part in (0.1 * k for k in range(1, 10)):
                        before.advance(begin + part * (at - begin))
                        self.assertEqual(self.above(before, leg) > level, side)
                    before.advance(at - 1e-12)
                    self.assertEqual(self.above(before, leg) > level, side)
                session.advance(end)
        self.assertGreater(found, 20)
        self.assertGreater(jumps, 3)  # a diode turned on or off during the advance
        for arguments in ((3, 0.0, 1.0), (-1, 0.0, 1.0), (0, math.nan, 1.0), (0, 0.0, math.nan)):
            self.assertEqual(session.advance_to_crossing(*arguments), c.REFUSED)

    def above(self, session, leg):
        """The voltage of a terminal, relative to the mean of the three terminal voltages."""
        u = [session.value_of(name) for name in ("u_a_V", "u_b_V", "u_c_V")]
        return u[leg] - sum(u) / 3

    def test_a_change_keeps_the_instant_and_its_values(self):
        session = opened(text=PLAIN.replace("= 100", "= 300"), chip=c.GATES)
        session.set_gates(0b001001)
        self.assertEqual(session.advance_to_hall_edge(5e-3), c.OK)
        before = session.time(), session.value_of("i_a_A"), session.value_of("hall")
        self.assertEqual(session.change(b"load.torque_Nm = 0.01", None), c.OK)
        self.assertEqual((session.time(), session.value_of("hall")), (before[0], before[2]))
        self.assertAlmostEqual(session.value_of("i_a_A"), before[1], delta=1e-9)
        self.assertEqual(session.copied().time(), before[0])
        self.assertEqual(session.advance_to_hall_edge(5e-3), c.OK)  # the next edge is 60 electrical degrees later, with 8 pole pairs
        self.assertAlmostEqual(session.time() - before[0], math.pi / 24 / 300, delta=0.2 * math.pi / 24 / 300)

    def test_lags_that_counts_do_not_have_are_refused(self):
        for key in ("current_bandwidth_Hz=1000", "current_delay_s=2e-6", "bus_bandwidth_Hz=1000"):
            sensors = ["sensors.currents=phases", "sensors.current_range_A=16", "sensors.bus_range_V=32", f"sensors.{key}"]
            session = opened(text=HELD, settings=sensors)
            self.assertEqual(session.convert(C.byref(c.Counts())), c.REFUSED, key)
            self.assertEqual(session.problems()[0][0], "sensors." + key.split("=")[0])

    def test_both_switches_of_a_leg_end_the_run(self):
        session = opened(CURRENT, chip=c.GATES)
        session.advance(1e-3)
        self.assertEqual(session.set_gates(0b000011), c.OK)
        self.assertEqual(session.advance(1.1e-3), c.OVER)
        self.assertIn("shoot-through", " ".join(session.problems()[0]))
        session.finish()
        self.assertIn("shoot-through", json.loads(session.outcome())["fault"])

    def test_an_early_end_is_within_two_periods(self):
        session = opened(text=HELD, chip=c.GATES)
        session.advance(3.31e-3)
        self.assertEqual(session.finish(), c.OK)
        end = json.loads(session.outcome())["simulated_s"]
        self.assertTrue(3.31e-3 <= end <= 3.31e-3 + 2 * session.period(), end)  # a segment may pass the next tick

    def test_counts_are_those_of_the_converters(self):
        settings = ["sensors.currents=phases", "sensors.current_range_A=16", "sensors.bus_range_V=32", "sensors.current_noise_A=0.02"]
        session = opened(text=HELD, chip=c.GATES, settings=settings)
        session.set_gates(0b001001)
        session.advance(300e-6)
        counts = c.Counts()
        self.assertEqual(session.convert(C.byref(counts)), c.OK)
        lsb = 2 * 16 / 4096
        self.assertLessEqual(abs(counts.current[0] - 2048 - session.value_of("i_a_A") / lsb), 15)
        self.assertLessEqual(abs(counts.current[1] - 2048 - session.value_of("i_b_A") / lsb), 15)  # five times the noise
        self.assertEqual(counts.hall, int(session.value_of("hall")))
        loaded, next_here, next_there = c.Session.loaded(LIB, session.saved()), c.Counts(), c.Counts()
        session.convert(C.byref(next_here)), loaded.convert(C.byref(next_there))
        self.assertEqual(bytes(next_here), bytes(next_there))  # the same noise
        self.assertLessEqual(abs(counts.bus - session.value_of("bus_V") / (32 / 4096)), 0.51)


class Misuse(unittest.TestCase):
    def test_each_refusal_names_place_limit_and_cure(self):
        session = c.Session.open(LIB, text='motor = "maxon-251601"\npwm.period_s = -1\nduration_s = 1e-3\ncontrol.mode = "duty"\n')
        self.assertEqual(session.status, c.REFUSED)
        place, value, limit, cure = session.problems()[0]
        self.assertIn("pwm.period_s", place)
        self.assertIn(":2:", place)
        self.assertEqual(value, "-1")
        self.assertTrue(limit and cure)
        self.assertEqual(session.advance(1), c.MISUSE)
        for status in (c.Session.open(LIB, "/nowhere.toml").status, c.Session.open(LIB, SOURCE).status):
            self.assertEqual(status, c.REFUSED)

    def test_changes_that_are_not_valid_change_nothing(self):
        session, other = opened(CURRENT), opened(CURRENT)
        session.advance(3e-3)
        for text in (b"supply.voltage_V = -4", b"supply.volts = 4", b"]", b"", b"\xff", b"pwm.period_s = 1e-6"):
            self.assertEqual(session.change(text, None), c.REFUSED, text)
            self.assertTrue(session.problems()[0][2], text)
        self.assertEqual(digest(other), (session.advance(1), digest(session))[1])

    def test_a_change_that_is_refused_late_leaves_gates_as_they_are(self):
        """bridge.phases needs the general kernel. The session can refuse the change only after it has compiled it."""
        def run(asked):
            session = opened(text=HELD, chip=c.GATES)
            session.set_gates(0b001001)
            session.advance(1.23e-3)
            if asked:
                self.assertEqual(session.change(b'bridge.phases = "bca"', None), c.REFUSED)
            session.advance(2e-3)
            return digest(session)
        self.assertEqual(run(True), run(False))

    def test_places_of_a_change_are_counted_from_its_first_line(self):
        session = opened(CURRENT)
        self.assertEqual(session.change(b"supply.voltage_V = 20\nsupply.volts = 4", None), c.REFUSED)
        self.assertRegex(session.problems()[0][0], r"^toml:2:")
        refused = c.Session.open(LIB, CURRENT, settings=["nonsense=1"])
        self.assertRegex(refused.problems()[0][0], "^options.settings: nonsense")

    def test_null_and_numbers_that_are_none(self):
        session = opened(CURRENT)
        for call in (lambda: LIB.sixstep_advance(None, 1.0), lambda: LIB.sixstep_finish(None), lambda: LIB.sixstep_copy(None, None),
                     lambda: LIB.sixstep_open_file(None, None, C.byref(C.c_void_p())), lambda: LIB.sixstep_open_text(b"", None, None),
                     lambda: session.set_gates(1), lambda: session.measure(C.byref(c.Measured()), None), lambda: session.convert(None),
                     lambda: session.command(None), lambda: LIB.sixstep_values(session.handle, None, 3)):
            self.assertEqual(call(), c.MISUSE)
        self.assertEqual(session.advance(math.nan), c.REFUSED)
        self.assertEqual(session.advance(-1.0), c.OK)
        self.assertEqual(session.time(), 0.0)
        self.assertTrue(math.isnan(session.value(-1)) and math.isnan(session.value(10**6)) and math.isnan(LIB.sixstep_time(None)))
        self.assertEqual(session.advance(math.inf), c.OVER)
        self.assertAlmostEqual(session.time(), session.duration(), delta=1e-12)
        self.assertEqual(session.finish(), c.OK)
        self.assertEqual(session.finish(), c.MISUSE)
        self.assertEqual(session.advance(1), c.MISUSE)
        LIB.sixstep_free(None)

    def test_damaged_bytes_are_refused(self):
        session = opened(CURRENT)
        session.advance(1e-3)
        saved, draw = session.saved(), random.Random(7)
        for n in range(200):
            broken = bytearray(saved[: draw.randrange(len(saved))] if n % 2 else saved)
            for _ in range(draw.randrange(1, 5)):
                if broken:
                    broken[draw.randrange(len(broken))] = draw.randrange(256)
            other = c.Session.loaded(LIB, bytes(broken))
            self.assertEqual(other.status, c.OK if bytes(broken) == saved else c.REFUSED)
            if bytes(broken) != saved:
                self.assertTrue(other.problems()[0][2])


class Interface(unittest.TestCase):
    HEADER = (SOURCE / "faces/c/sixstep.h").read_text()

    def test_symbols_are_those_of_the_header(self):
        declared = set(re.findall(r"SIXSTEP_API [^;(]*?(sixstep_\w+)\(", self.HEADER))
        shown = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], capture_output=True, text=True, check=True).stdout
        symbols = {line.split()[2].split("@")[0] for line in shown.splitlines() if line.split()[1] != "A"}
        self.assertEqual(symbols, declared)
        self.assertEqual(set(c.DECLARED), declared)

    def test_structs_are_laid_out_as_declared(self):
        printed = dict(line.split() for line in subprocess.run([SIZES], capture_output=True, text=True, check=True).stdout.splitlines())
        of = {"sixstep_options": c.Options, "sixstep_problem": c.Problem, "sixstep_signal": c.Signal, "sixstep_measured": c.Measured,
              "sixstep_answer": c.Answer, "sixstep_counts": c.Counts}
        for name, size in printed.items():
            kind, _, member = name.partition(".")
            self.assertEqual(int(size), getattr(of[kind], member).offset if member else C.sizeof(of[kind]), name)

    def test_it_describes_signals_and_changes(self):
        session = opened(CURRENT)
        told = json.loads(session.describe())
        self.assertEqual(len(told["signals"]), LIB.sixstep_signal_count())
        for signal in told["signals"]:
            of = c.Signal()
            self.assertEqual(LIB.sixstep_signal_at(signal["index"], C.byref(of)), c.OK)
            self.assertEqual((of.name.decode(), of.unit.decode()), (signal["name"], signal["unit"]))
            self.assertEqual(LIB.sixstep_signal_index(of.name), signal["index"])
            self.assertEqual(signal["applies"], not math.isnan(session.value(signal["index"])), signal["name"])
        linear = opened(SOURCE / "data/scenarios/gallery/linear-motor.toml")
        by_name = {signal["name"]: signal.get("linear") for signal in json.loads(linear.describe())["signals"]}
        self.assertEqual(by_name["angle_rad"], {"name": "position_mm", "unit": "mm", "factor": 1000.0})
        self.assertIsNone(by_name["i_a_A"])
        keys = {change["key"]: change for change in told["changes"]}
        self.assertEqual(keys["supply.voltage_V"]["unit"], "V")
        for key in ("load.torque_Nm", "bridge.dead_time_s", "reference.value"):
            self.assertIn(key, keys)


if __name__ == "__main__":
    unittest.main()
