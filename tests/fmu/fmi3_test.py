# SPDX-License-Identifier: Apache-2.0
"""sixstep export fmu --fmi 3: the differences from FMI 2.0. fmi2_test.py tests all common features, because both
versions use faces/fmu/drive.c.
fmi3_test.py PROGRAM SOURCE LIBRARY"""
import ctypes as C
import functools
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

from fmi3_importer import ERROR, NAMES, OK, WARNING, Instance, Unit

PROGRAM, SOURCE, LIBRARY = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
FILES = sorted((SOURCE / "data/scenarios/gallery").glob("*.toml"))
CURRENT = SOURCE / "data/scenarios/thesis/8b-exact-design.toml"
WORK = tempfile.TemporaryDirectory()
FOLDER = pathlib.Path(WORK.name)
_V, _R, _Z, _B = C.c_void_p, C.c_double, C.c_size_t, C.c_bool


@functools.lru_cache(None)
def ran(file, *words):
    done = subprocess.run([PROGRAM, "run", file, "--json", "-", *words], capture_output=True, text=True, timeout=120)
    return json.loads(done.stdout) if done.returncode in (0, 1, 3) else None


def exported(file, *words):
    out = FOLDER / f"{file.stem}.fmu"
    subprocess.run([PROGRAM, "export", "fmu", file, "--fmi", "3", "--out", out, "--force", *words], check=True, timeout=60)
    return Unit(out)


class Fmi3(unittest.TestCase):
    def test_steps_of_any_length_have_the_digest_of_the_program(self):
        short, compared, draw = ("--set", "duration_s=3e-3"), 0, random.Random(3)
        for file in FILES[::4]:
            told = ran(file, *short)
            if told is None or compared == 5:
                continue
            unit = exported(file, *short)
            for step in (1e-3, 37e-6, 10e-6, lambda: draw.uniform(1e-7, 3e-4)):
                with self.subTest(f"{file.stem} {step}"):
                    self.assertEqual(Instance(unit).begin().run(step, 3e-3).digest(), told["digest"])
            compared += 1
        self.assertEqual(compared, 5)

    def test_inputs_states_and_the_end(self):
        unit = exported(CURRENT)
        instance = Instance(unit).begin()
        self.assertEqual(unit.library.fmi3GetVersion(), b"3.0")
        self.assertEqual(instance.step(0, 1e-3), OK)
        state, size = _V(), _Z()
        self.assertEqual(instance.call("GetFMUState", C.byref(state)), OK)
        self.assertEqual(instance.put("supply_voltage", 20.0), OK)
        self.assertEqual(instance.step(1e-3, 1e-3), OK)
        self.assertAlmostEqual(instance.get("bus_V"), 20.0, delta=1e-9)
        self.assertIn(instance.get("hall"), range(1, 7))
        self.assertEqual(instance.call("SerializedFMUStateSize", state, C.byref(size)), OK)
        data = (C.c_uint8 * size.value)()
        self.assertEqual(instance.call("SerializeFMUState", state, data, size), OK)
        other, again = Instance(unit), _V()
        self.assertEqual(other.call("DeserializeFMUState", data, size, C.byref(again)), OK, other.messages)
        for one, saved in ((instance, state), (other, again)):
            self.assertEqual(one.call("SetFMUState", saved), OK)
            self.assertEqual(one.step(1e-3, 2 * unit.stop()), OK)
            self.assertEqual((one.ends.value, one.early.value), (True, False), "no early return was allowed")
            self.assertEqual(one.messages[-1][:2], (WARNING, "logStatusDiscard"))
            self.assertAlmostEqual(one.last.value, unit.stop(), delta=1e-12)
            self.assertEqual(one.digest(), ran(CURRENT)["digest"])

    def test_refused_calls_say_why(self):
        unit = exported(CURRENT)
        for wrong in ({"token": b"{0}"}, {"intermediate": ("hall",)}):
            instance = Instance(unit, **wrong)
            self.assertIsNone(instance.c)
            self.assertEqual(instance.messages[0][:2], (ERROR, "logStatusError"))
        instance = Instance(unit)
        for name in ("ExitInitializationMode", "EnterEventMode", "EnterStepMode", "Terminate", "EnterConfigurationMode", "EnterContinuousTimeMode"):
            before = len(instance.messages)
            self.assertEqual(instance.call(name), ERROR)
            self.assertGreater(len(instance.messages), before)
            self.assertEqual(getattr(unit.library, "fmi3" + name)(None), ERROR)
        instance.begin()
        one, value = (C.c_uint32 * 1)(1), (_R * 2)()
        self.assertEqual(instance.call("GetFloat64", one, _Z(1), value, _Z(2)), ERROR)
        self.assertEqual(instance.call("GetFloat32", one, _Z(1), value, _Z(1)), ERROR)
        self.assertEqual(instance.run(1e-3, unit.stop()).digest(), ran(CURRENT)["digest"])

    def test_every_function_of_the_standard_is_there_and_no_other_symbol(self):
        unit = exported(CURRENT)
        symbols = subprocess.run(["nm", "-D", "--defined-only", unit.binary], capture_output=True, text=True, check=True).stdout.split()[2::3]
        self.assertEqual(sorted(symbols), sorted("fmi3" + name for name in NAMES))

    def test_the_build_description_makes_the_same_unit(self):
        unit = exported(CURRENT)
        build = ET.parse(unit.folder / "sources/buildDescription.xml").getroot()
        self.assertEqual((build.tag, build.get("fmiVersion")), ("fmiBuildDescription", "3.0"))
        configuration = build.find("BuildConfiguration")
        self.assertEqual(configuration.get("modelIdentifier"), unit.name)
        files = [unit.folder / "sources" / f.get("name") for f in configuration.iter("SourceFile")]
        includes = [unit.folder / "sources" / i.get("name") for i in configuration.iter("IncludeDirectory")]
        unit.binary = FOLDER / "compiled.so"
        subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared", *(f"-I{i}" for i in includes), *files, "-o", unit.binary,
                        LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}", "-lm"], check=True)
        unit.load()
        self.assertEqual(Instance(unit).begin().run(1e-4, unit.stop()).digest(), ran(CURRENT)["digest"])

    def test_the_description_holds_the_rules_of_the_standard(self):
        plants = [(CURRENT, "--kind", "plant", "--inputs", inputs) for inputs in ("gates", "pair", "legs")]
        for words in [*((file,) for file in FILES[::9]), (CURRENT,), *plants]:
            root = exported(*words).description
            self.assertEqual((root.tag, root.get("fmiVersion")), ("fmiModelDescription", "3.0"))
            self.assertEqual([child.tag for child in root], ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
                                                             "ModelStructure"])
            variables = list(root.find("ModelVariables"))
            for of in ("name", "valueReference"):
                self.assertEqual(len({v.get(of) for v in variables}), len(variables))
            self.assertEqual([v.get("name") for v in variables if v.get("causality") == "independent"], ["time"])
            units = {u.get("name") for u in root.find("UnitDefinitions")}
            for v in variables:
                self.assertEqual(v.get("start") is not None, v.get("causality") in ("input", "parameter"), v.get("name"))
                self.assertTrue(v.tag != "Float64" or v.get("unit") in units)
                self.assertTrue(v.tag == "Float64" or v.get("variability") == ("fixed" if v.get("causality") == "parameter" else "discrete"))
            outputs = [v.get("valueReference") for v in variables if v.get("causality") == "output"]
            clocks = {v.get("valueReference") for v in variables if v.tag == "Clock"}
            for part, expected in (("Output", outputs), ("InitialUnknown", [r for r in outputs if r not in clocks])):
                self.assertEqual([u.get("valueReference") for u in root.find("ModelStructure").findall(part)], expected)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
