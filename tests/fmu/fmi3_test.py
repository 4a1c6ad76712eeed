# SPDX-License-Identifier: Apache-2.0
"""sixstep export fmu --fmi 3: what differs from FMI 2.0, which fmi2_test.py holds in all; both share faces/fmu/drive.c.
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
import zipfile

PROGRAM, SOURCE, LIBRARY = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
FILES = sorted((SOURCE / "data/scenarios/gallery").glob("*.toml"))
CURRENT = SOURCE / "data/scenarios/thesis/8b-exact-design.toml"
WORK = tempfile.TemporaryDirectory()
FOLDER = pathlib.Path(WORK.name)
OK, WARNING, DISCARD, ERROR = range(4)
LOG = C.CFUNCTYPE(None, C.c_void_p, C.c_int, C.c_char_p, C.c_char_p)
_V, _R, _Z, _B = C.c_void_p, C.c_double, C.c_size_t, C.c_bool
# The functions of the standard, version 3.0.
NAMES = """GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution FreeInstance
EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetNumberOfVariableDependencies GetVariableDependencies
GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState GetDirectionalDerivative
GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction GetShiftDecimal
GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates
EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives GetEventIndicators
GetContinuousStates GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode
GetOutputDerivatives DoStep ActivateModelPartition""".split() + [
    way + kind for way in ("Get", "Set") for kind in ("Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64",
                                                      "Boolean", "String", "Binary", "Clock")]


@functools.lru_cache(None)
def ran(file, *words):
    done = subprocess.run([PROGRAM, "run", file, "--json", "-", *words], capture_output=True, text=True, timeout=120)
    return json.loads(done.stdout) if done.returncode in (0, 1, 3) else None


class Unit:
    def __init__(self, file, *words):
        out = FOLDER / f"{file.stem}.fmu"
        subprocess.run([PROGRAM, "export", "fmu", file, "--fmi", "3", "--out", out, "--force", *words], check=True, timeout=60)
        # in a new folder, because a library that is loaded must not be overwritten
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="a unit ", dir=FOLDER))
        with zipfile.ZipFile(out) as archive:
            archive.extractall(self.folder)
        self.description = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.name = self.description.find("CoSimulation").get("modelIdentifier")
        self.binary = self.folder / f"binaries/x86_64-linux/{self.name}.so"
        self.variables = {v.get("name"): v for v in self.description.find("ModelVariables")}
        self.token = self.description.get("instantiationToken").encode()
        self.load()

    def load(self):
        self.library = C.CDLL(str(self.binary))
        self.library.fmi3InstantiateCoSimulation.restype = _V
        self.library.fmi3GetVersion.restype = C.c_char_p

    def reference(self, name):
        return int(self.variables[name].get("valueReference"))

    def stop(self):
        return float(self.description.find("DefaultExperiment").get("stopTime"))


class Instance:
    def __init__(self, unit, token=None, events=False):
        self.unit, self.messages = unit, []
        self._log = LOG(lambda env, status, category, text: self.messages.append((status, category.decode(), text.decode())))
        self.c = unit.library.fmi3InstantiateCoSimulation(b"drive", token or unit.token, str(unit.folder / "resources/").encode(), _B(False), _B(False),
                                                          _B(events), _B(False), None, _Z(0), None, self._log, None)
        self.ends = _B()

    def call(self, name, *arguments):
        return getattr(self.unit.library, "fmi3" + name)(_V(self.c), *arguments)

    def begin(self, stop=None):
        assert self.call("EnterInitializationMode", _B(False), _R(0), _R(0), _B(stop is not None), _R(stop or 0)) == OK, self.messages
        assert self.call("ExitInitializationMode") == OK
        return self

    def step(self, at, size):
        needed, early, self.last = _B(), _B(), _R()
        return self.call("DoStep", _R(at), _R(size), _B(True), C.byref(needed), C.byref(self.ends), C.byref(early), C.byref(self.last))

    def run(self, step, stop):
        now, n = 0.0, 0
        while now < stop:
            n += 1
            following = min(stop, n * step if not callable(step) else now + step())
            if self.step(now, following - now) != OK:
                break
            now = following
        return self

    def put(self, name, value):
        return self.call("SetFloat64", (C.c_uint32 * 1)(self.unit.reference(name)), _Z(1), (_R * 1)(value), _Z(1))

    def get(self, name):
        kind = self.unit.variables[name].tag
        values = ({"Float64": _R, "Int32": C.c_int32, "String": C.c_char_p}[kind] * 1)()
        assert self.call("Get" + kind, (C.c_uint32 * 1)(self.unit.reference(name)), _Z(1), values, _Z(1)) == OK, self.messages
        return values[0]

    def digest(self):
        assert self.call("Terminate") == OK, self.messages
        return self.get("digest").decode()

    def __del__(self):
        if getattr(self, "c", None):
            self.unit.library.fmi3FreeInstance(_V(self.c))


class Fmi3(unittest.TestCase):
    def test_steps_of_any_length_have_the_digest_of_the_program(self):
        short, compared, draw = ("--set", "duration_s=3e-3"), 0, random.Random(3)
        for file in FILES[::4]:
            told = ran(file, *short)
            if told is None or compared == 5:
                continue
            unit = Unit(file, *short)
            for step in (1e-3, 37e-6, 10e-6, lambda: draw.uniform(1e-7, 3e-4)):
                with self.subTest(f"{file.stem} {step}"):
                    self.assertEqual(Instance(unit).begin().run(step, 3e-3).digest(), told["digest"])
            compared += 1
        self.assertEqual(compared, 5)

    def test_inputs_states_and_the_end(self):
        unit = Unit(CURRENT)
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
            self.assertEqual(one.step(1e-3, 2 * unit.stop()), DISCARD)
            self.assertTrue(one.ends.value)
            self.assertAlmostEqual(one.last.value, unit.stop(), delta=1e-12)
            self.assertEqual(one.digest(), ran(CURRENT)["digest"])

    def test_refused_calls_say_why(self):
        unit = Unit(CURRENT)
        for wrong in ({"token": b"{0}"}, {"events": True}):
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
        unit = Unit(CURRENT)
        symbols = subprocess.run(["nm", "-D", "--defined-only", unit.binary], capture_output=True, text=True, check=True).stdout.split()[2::3]
        self.assertEqual(sorted(symbols), sorted("fmi3" + name for name in NAMES))

    def test_the_build_description_makes_the_same_unit(self):
        unit = Unit(CURRENT)
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
        for file in [*FILES[::9], CURRENT]:
            root = Unit(file).description
            self.assertEqual((root.tag, root.get("fmiVersion")), ("fmiModelDescription", "3.0"))
            self.assertEqual([child.tag for child in root], ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
                                                             "ModelStructure"])
            variables = list(root.find("ModelVariables"))
            for of in ("name", "valueReference"):
                self.assertEqual(len({v.get(of) for v in variables}), len(variables))
            self.assertEqual([v.get("name") for v in variables if v.get("causality") == "independent"], ["time"])
            units = {u.get("name") for u in root.find("UnitDefinitions")}
            for v in variables:
                self.assertEqual(v.get("start") is not None, v.get("causality") == "input", v.get("name"))
                self.assertTrue(v.tag != "Float64" or v.get("unit") in units)
                self.assertTrue(v.tag == "Float64" or v.get("variability") == "discrete")
            outputs = [v.get("valueReference") for v in variables if v.get("causality") == "output"]
            for part in ("Output", "InitialUnknown"):
                self.assertEqual([u.get("valueReference") for u in root.find("ModelStructure").findall(part)], outputs)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
