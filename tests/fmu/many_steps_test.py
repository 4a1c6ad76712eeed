# SPDX-License-Identifier: Apache-2.0
"""Two instances in one process, each in its own thread, make 10^5 communication steps (--long: 10^6). The memory does
not grow, and each has the same bits as alone.
many_steps_test.py PROGRAM SOURCE LIBRARY [--long]"""
import ctypes as C
import threading
import unittest

import fmi2_importer as fmi2
import fmi3_importer as fmi3
from fmi2_units import CURRENT, FOLDER, LONG, ran, sixstep

STEPS = 10**6 if LONG else 10**5
OTHER = ("--set", "supply.voltage_V=22")
OK = 0


def exported(version, *words, name="drive"):
    out = FOLDER / f"{name}-{version}.fmu"
    sixstep("export", "fmu", CURRENT, "--fmi", version, "--out", out, "--force", *words)
    return (fmi2 if version == 2 else fmi3).Unit(out)


def resident_kB():
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


class Stepped:
    """An instance that makes equal steps to its end. `kB` is the resident memory after a tenth of the steps and at
    the end."""

    def __init__(self, version, unit, set_up=None, **more):
        self.instance = (fmi2 if version == 2 else fmi3).Instance(unit, **more).begin()
        if set_up:
            set_up(self.instance)
        self.version, self.size, self.failed, self.kB = version, unit.stop() / STEPS, None, []
        self.thread = threading.Thread(target=self.run)

    def run(self):
        i, size = self.instance, self.size
        function = getattr(i.unit.library, f"fmi{self.version}DoStep")
        if self.version == 2:
            function.argtypes = [C.c_void_p, C.c_double, C.c_double, C.c_int]
            more = (1,)
        else:
            function.argtypes = [C.c_void_p, C.c_double, C.c_double, C.c_bool, *[C.c_void_p] * 4]
            more = (True, *(C.addressof(place) for place in (i.needed, i.ends, i.early, i.last)))
        for n in range(STEPS):
            if n == STEPS // 10:
                self.kB.append(resident_kB())
            if function(i.c, n * size, size, *more) != OK:
                self.failed = n, i.messages[-1:]
                return
        self.kB.append(resident_kB())


class ManySteps(unittest.TestCase):
    def stepped(self, *all_of):
        for one in all_of:
            one.thread.start()
        for one in all_of:
            one.thread.join()
        for one in all_of:
            self.assertIsNone(one.failed)
            self.assertLess(one.kB[1] - one.kB[0], 1024, "memory grows")
        return [one.instance.digest() for one in all_of]

    def test_two_instances_of_each_version(self):
        for version in (2, 3):
            with self.subTest(version):
                drive, other = exported(version), exported(version, *OTHER, name="other")
                self.assertEqual(self.stepped(Stepped(version, drive), Stepped(version, other)), [ran(CURRENT)["digest"], ran(CURRENT, *OTHER)["digest"]])

    def test_two_versions_side_by_side(self):
        self.assertEqual(set(self.stepped(Stepped(2, exported(2)), Stepped(3, exported(3)))), {ran(CURRENT)["digest"]})

    def test_a_plant_whose_inputs_stay(self):
        def set_up(instance):
            for name, value in (("enabled", True), ("source", 0), ("sink", 1), ("duty", 0.1)):
                self.assertEqual(instance.put(name, value), OK)

        unit = exported(3, "--kind", "plant", "--inputs", "pair", name="plant")
        one, again = self.stepped(Stepped(3, unit, set_up), Stepped(3, unit, set_up))
        alone = fmi3.Instance(unit).begin()
        set_up(alone)
        self.assertEqual({one, again}, {alone.run(1e-3, unit.stop()).digest()})

    def test_gates_that_change_at_each_step_take_few_bytes(self):
        """The changes are stored for a saved state. Each needs 16 bytes, plus the reserve of a growing table."""
        unit = exported(2, "--kind", "plant", name="gates")
        instance, size = fmi2.Instance(unit).begin(), unit.stop() / STEPS
        reference, value, before = (C.c_uint * 1)(unit.reference("gate_b_lower")), (C.c_int * 1)(), None
        for n in range(STEPS):
            value[0] = n % 2
            self.assertEqual(instance.call("SetBoolean", reference, 1, value), OK)
            self.assertEqual(instance.step(n * size, size), OK)
            before = before or (n == STEPS // 10 and resident_kB()) or None
        self.assertLess(1024 * (resident_kB() - before), 64 * STEPS + 2**20)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
