# SPDX-License-Identifier: Apache-2.0
"""The content of a unit of FMI 2.0: a description by the rules of the standard, a binary without dependencies,
sources, motor and rows.
fmi2_content_test.py PROGRAM SOURCE LIBRARY"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import fmi2_importer as fmi
from fmi2_units import CURRENT, FILES, FOLDER, LIBRARY, SOURCE, SPEED, exported, ran


class Description(unittest.TestCase):
    """Checks the rules of the standard on the units of many scenarios."""

    def test_every_unit_holds_the_rules_of_the_standard(self):
        for file in [*FILES[::6], SPEED]:
            with self.subTest(file.stem):
                self.check(exported(file))
        for inputs in ("gates", "pair", "legs"):
            with self.subTest(inputs):
                self.check(exported(SPEED, "--kind", "plant", "--inputs", inputs, name=inputs))

    def check(self, unit):
        root = unit.description
        self.assertEqual((root.tag, root.get("fmiVersion")), ("fmiModelDescription", "2.0"))
        self.assertTrue(root.get("modelName") and root.get("guid"))
        self.assertEqual([child.tag for child in root], ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment",
                                                         "ModelVariables", "ModelStructure"], "in the order of the schema")
        self.assertRegex(unit.name, r"^[A-Za-z_]\w*$")
        variables = list(root.find("ModelVariables"))
        names = [v.get("name") for v in variables]
        keys = [(v[0].tag, v.get("valueReference")) for v in variables]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(len(set(keys)), len(keys))
        units = {u.get("name"): [d.get("name") for d in u.findall("DisplayUnit")] for u in root.find("UnitDefinitions")}
        self.assertEqual(len(units), len(root.find("UnitDefinitions")))
        for v in variables:
            self.variable(v, units)
        self.structure(root, variables)
        experiment = root.find("DefaultExperiment")
        self.assertLess(float(experiment.get("startTime")), float(experiment.get("stopTime")))
        self.assertEqual([v.get("name") for v in variables if v.get("causality") == "independent"], ["time"])

    def variable(self, v, units):
        of = v[0]
        causality, variability, initial, start = v.get("causality"), v.get("variability"), v.get("initial"), of.get("start")
        self.assertIn((causality, variability), {(c, k) for c in ("input", "output", "independent") for k in ("discrete", "continuous")})
        self.assertTrue(v.get("description"))
        if variability == "continuous":
            self.assertEqual(of.tag, "Real", "only a Real is continuous")
        if causality == "input":
            self.assertIsNone(initial, "an input has no initial")
            self.assertIsNotNone(start, "an input has a start")
            if of.tag == "Real":
                self.assertEqual(repr(float(start)), repr(float(f"{float(start):.17g}")))
        else:
            self.assertIsNone(start, "calculated and independent variables have none")
            self.assertEqual(initial, "calculated" if causality == "output" else None)
        if of.get("unit"):
            self.assertIn(of.get("unit"), units)
            if of.get("displayUnit"):
                self.assertIn(of.get("displayUnit"), units[of.get("unit")])
        elif of.tag == "Real":
            self.fail(v.get("name") + " has no unit")

    def structure(self, root, variables):
        outputs = [n for n, v in enumerate(variables, 1) if v.get("causality") == "output"]
        structure = root.find("ModelStructure")
        for part in ("Outputs", "InitialUnknowns"):
            self.assertEqual([int(u.get("index")) for u in structure.find(part)], outputs, "complete and in order")
            for unknown in structure.find(part):
                self.assertEqual(unknown.get("dependencies"), "")

    def test_units_are_those_of_the_si(self):
        """A speed of 1 rad/s is 9.549 rpm, and an angle of 1 deg is pi/180 rad."""
        unit = exported(SPEED)
        units = {u.get("name"): u for u in unit.description.find("UnitDefinitions")}
        self.assertAlmostEqual(float(units["rad/s"].find("DisplayUnit").get("factor")), 60 / (2 * math.pi), delta=1e-14)
        self.assertAlmostEqual(float(units["deg"].find("BaseUnit").get("factor")), math.pi / 180, delta=1e-17)
        self.assertEqual(dict(units["V"].find("BaseUnit").attrib), {"kg": "1", "m": "2", "s": "-3", "A": "-1"})
        self.assertEqual(unit.variables["reference"][0].get("unit"), "deg")


class Content(unittest.TestCase):
    def test_the_binary_needs_nothing_but_the_c_library(self):
        unit = exported(CURRENT)
        binary = unit.folder / f"binaries/linux64/{unit.name}.so"
        needed = re.findall(r"NEEDED.*\[(.*)\]", subprocess.run(["readelf", "-d", binary], capture_output=True, text=True, check=True).stdout)
        self.assertLessEqual({name.split(".")[0] for name in needed}, {"libc", "libm", "ld-linux-x86-64"})
        symbols = subprocess.run(["nm", "-D", "--defined-only", binary], capture_output=True, text=True, check=True).stdout.split()[2::3]
        self.assertEqual(sorted(symbols), sorted("fmi2" + name for name in fmi.DECLARED))

    def test_the_sources_are_a_unit_too(self):
        unit = fmi.Unit(FOLDER / f"{exported(CURRENT) and CURRENT.stem}.fmu")
        files = [unit.folder / "sources" / f.get("name") for f in unit.description.iter("File")]
        binary = unit.folder / f"binaries/linux64/{unit.name}.so"
        binary.unlink()
        subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-fPIC", "-shared", "-I", unit.folder / "sources", *files, "-o", binary,
                        LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}", "-lm"], check=True)
        out = FOLDER / "compiled.fmu"
        subprocess.run([sys.executable, "-m", "zipfile", "-c", out, *unit.folder.iterdir()], check=True)
        instance = fmi.Instance(fmi.Unit(out)).begin()
        instance.run(1e-4, unit.stop())
        self.assertEqual(instance.digest(), ran(CURRENT)["digest"])

    def test_a_program_in_c_drives_it(self):
        unit, importer = exported(CURRENT), FOLDER / "importer"
        subprocess.run(["gcc", "-std=gnu99", "-Wall", "-Wextra", "-Werror", f"-I{SOURCE}", pathlib.Path(__file__).parent / "importer.c", "-o", importer, "-ldl"],
                       check=True)
        told = subprocess.run([importer, unit.folder / f"binaries/linux64/{unit.name}.so", unit.resources, unit.guid, repr(unit.stop())],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((told.stdout.strip(), told.returncode), (ran(CURRENT)["digest"], 0), told.stderr)

    def test_a_unit_takes_its_motor_and_its_rows_along(self):
        """The folder of the motor and rows is deleted before the unit runs."""
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            (here / "mine.toml").write_text((SOURCE / "data/motors/maxon-251601.toml").read_text())
            (here / "rows.csv").write_text("0,1\n0.001,2\n0.002,-1\n")
            text = re.sub(r'(?m)^motor *=.*$', 'motor = "mine.toml"', CURRENT.read_text(), count=1)
            self.assertIn("mine.toml", text)
            (here / "drive.toml").write_text(text)
            words = ("--set", "reference={shape='csv', file='rows.csv'}", "--set", "motor_override.resistance_ohm=0.5", "--set", "require=[]",
                     "--set", "compare=[]")
            told, unit = ran(here / "drive.toml", *words), exported(here / "drive.toml", *words)
        instance = fmi.Instance(unit).begin()
        instance.run(1e-4, unit.stop())
        self.assertEqual(instance.digest(), told["digest"])

    def test_a_saved_state_with_any_bit_changed_is_refused(self):
        """One bit is changed in each byte of the unit's own numbers, and in every hundredth byte of the session's
        state."""
        unit = exported(CURRENT)
        instance, other = fmi.Instance(unit).begin(), fmi.Instance(unit)
        instance.run(1e-4, 5e-4)
        whole = instance.saved()
        for n in [*range(2500), *range(2500, len(whole), 100), len(whole) - 1]:
            if n < len(whole):
                bytes_ = bytearray(whole)
                bytes_[n] ^= 1 << n % 8
                self.assertEqual(other.load(bytes(bytes_)), fmi.ERROR, n)
                self.assertIn("saved", other.messages[-1][2])
        for bytes_ in (whole[:-1], whole + b"\0", b""):
            self.assertEqual(other.load(bytes_), fmi.ERROR)
        self.assertEqual(other.load(whole), fmi.OK, other.messages)
        self.assertEqual((other.run(1e-4, unit.stop(), 5e-4), other.digest()), (unit.stop(), ran(CURRENT)["digest"]))

    def test_no_step_goes_beyond_the_stop_time(self):
        """The stop time of the set-up is a limit, even if it is before the scenario's end. A step may pass it by a
        rounding error."""
        unit = exported(CURRENT)
        instance = fmi.Instance(unit).begin(stop=1e-3)
        self.assertEqual(instance.step(0, 2e-3), fmi.ERROR)
        self.assertRegex(instance.messages[-1][2], r"0\.002 s.*stop time.*0\.001 s")
        now = 0.0
        for _ in range(30):  # the sum of the steps differs from the stop time by rounding
            self.assertEqual(instance.step(now, 1e-3 / 30), fmi.OK, instance.messages)
            now += 1e-3 / 30
        self.assertEqual(instance.step(now, 1e-6), fmi.ERROR)
        near = fmi.Instance(unit).begin(stop=1e-3)
        self.assertEqual(near.step(0, 1e-3 * (1 + 1e-12)), fmi.OK)
        shifted = fmi.Instance(unit).begin(start=5.0, stop=5.001)
        self.assertEqual((shifted.step(5.0, 2e-3), shifted.step(5.0, 5.001 - 5.0)), (fmi.ERROR, fmi.OK))
        longer = fmi.Instance(unit).begin(stop=unit.stop() + 1e-3)
        self.assertEqual((longer.step(0, unit.stop() + 2e-3), longer.step(0, unit.stop() + 1e-3)), (fmi.ERROR, fmi.OK))

    def test_the_same_scenario_makes_the_same_bytes_and_another_one_another_guid(self):
        one, again = exported(CURRENT), exported(CURRENT, name="again")
        self.assertEqual((FOLDER / f"{CURRENT.stem}.fmu").read_bytes(), (FOLDER / "again.fmu").read_bytes())
        self.assertNotEqual(one.guid, exported(CURRENT, "--set", "supply.voltage_V=23", name="warm").guid)
        self.assertEqual(one.guid, again.guid)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
