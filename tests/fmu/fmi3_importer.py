# SPDX-License-Identifier: Apache-2.0
"""An importer of FMI 3.0 for co-simulation with ctypes. It unzips a unit, reads its description, and calls its
functions."""
import ctypes as C
import pathlib
import tempfile
import xml.etree.ElementTree as ET
import zipfile

OK, WARNING, DISCARD, ERROR = range(4)
LOG = C.CFUNCTYPE(None, C.c_void_p, C.c_int, C.c_char_p, C.c_char_p)
UPDATE = C.CFUNCTYPE(None, C.c_void_p, C.c_double, C.c_bool, C.c_bool, C.c_bool, C.c_bool, C.POINTER(C.c_bool), C.POINTER(C.c_double))
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


class Unit:
    """An unzipped unit with its functions."""

    def __init__(self, file):
        self._own = tempfile.TemporaryDirectory(prefix="a unit ")
        self.folder = pathlib.Path(self._own.name)
        with zipfile.ZipFile(file) as archive:
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
    """An instance. `messages` is its log as (status, category, text). `update` is called at events within a step."""

    def __init__(self, unit, token=None, events=False, early=False, update=None, intermediate=()):
        self.unit, self.messages = unit, []
        self._log = LOG(lambda env, status, category, text: self.messages.append((status, category.decode(), text.decode())))
        self._update = UPDATE(update) if update else None
        wanted = (C.c_uint32 * max(1, len(intermediate)))(*(unit.reference(n) for n in intermediate))
        self.c = unit.library.fmi3InstantiateCoSimulation(b"drive", token or unit.token, str(unit.folder / "resources/").encode(), _B(False), _B(False),
                                                          _B(events), _B(early), wanted, _Z(len(intermediate)), None, self._log, self._update)
        self.ends, self.needed, self.early, self.last = _B(), _B(), _B(), _R()

    def call(self, name, *arguments):
        return getattr(self.unit.library, "fmi3" + name)(_V(self.c), *arguments)

    def begin(self, stop=None):
        assert self.call("EnterInitializationMode", _B(False), _R(0), _R(0), _B(stop is not None), _R(stop or 0)) == OK, self.messages
        assert self.call("ExitInitializationMode") == OK
        return self

    def step(self, at, size):
        return self.call("DoStep", _R(at), _R(size), _B(True), C.byref(self.needed), C.byref(self.ends), C.byref(self.early), C.byref(self.last))

    def run(self, step, stop):
        now, n = 0.0, 0
        while now < stop:
            n += 1
            following = min(stop, n * step if not callable(step) else now + step())
            if self.step(now, following - now) != OK:
                break
            now = following
        return self

    def _array(self, name, values=None):
        variable = self.unit.variables[name]
        dimension = variable.find("Dimension")
        count = int(dimension.get("start")) if dimension is not None else 1
        kind = {"Float64": _R, "Int32": C.c_int32, "Boolean": C.c_bool, "String": C.c_char_p}[variable.tag]
        return variable.tag, (kind * count)(*(values or ())), (C.c_uint32 * 1)(self.unit.reference(name))

    def put(self, name, *values):
        kind, array, reference = self._array(name, values)
        return self.call("Set" + kind, reference, _Z(1), array, _Z(len(array)))

    def get(self, name):
        kind, array, reference = self._array(name)
        assert self.call("Get" + kind, reference, _Z(1), array, _Z(len(array))) == OK, self.messages
        return array[0] if len(array) == 1 else list(array)

    def digest(self):
        assert self.call("Terminate") == OK, self.messages
        return self.get("digest").decode()

    def saved(self):
        state, size = _V(), _Z()
        assert self.call("GetFMUState", C.byref(state)) == OK, self.messages
        assert self.call("SerializedFMUStateSize", state, C.byref(size)) == OK
        data = (C.c_uint8 * size.value)()
        assert self.call("SerializeFMUState", state, data, size) == OK and self.call("FreeFMUState", C.byref(state)) == OK
        return data

    def load(self, data):
        state = _V()
        status = self.call("DeserializeFMUState", data, _Z(len(data)), C.byref(state))
        return status if status != OK else self.call("SetFMUState", state)

    def __del__(self):
        if getattr(self, "c", None):
            self.unit.library.fmi3FreeInstance(_V(self.c))
