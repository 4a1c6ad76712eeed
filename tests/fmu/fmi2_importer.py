# SPDX-License-Identifier: Apache-2.0
"""An importer of FMI 2.0 for co-simulation with ctypes. It unzips a unit, reads its description, and calls its
functions."""
import ctypes as C
import pathlib
import tempfile
import urllib.parse
import xml.etree.ElementTree as ET
import zipfile

OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)
DO_STEP, PENDING_STATUS, LAST_TIME, TERMINATED = range(4)
_R, _U, _V, _P, _S = C.c_double, C.c_uint, C.c_void_p, C.POINTER, C.c_char_p
LOGGER = C.CFUNCTYPE(None, _V, _S, C.c_int, _S, _S)


class Callbacks(C.Structure):
    _fields_ = [("logger", LOGGER), ("allocate", _V), ("free", _V), ("finished", _V), ("environment", _V)]


_REFS = _P(_U)
_GET, _SET = lambda t: [_V, _REFS, C.c_size_t, _P(t)], lambda t: [_V, _REFS, C.c_size_t, _P(t)]
# name: (result, arguments), as the standard declares them.
DECLARED = {
    "GetTypesPlatform": (_S, []), "GetVersion": (_S, []), "SetDebugLogging": (C.c_int, [_V, C.c_int, C.c_size_t, _P(_S)]),
    "Instantiate": (_V, [_S, C.c_int, _S, _S, _P(Callbacks), C.c_int, C.c_int]), "FreeInstance": (None, [_V]),
    "SetupExperiment": (C.c_int, [_V, C.c_int, _R, _R, C.c_int, _R]),
    **{name: (C.c_int, [_V]) for name in ("EnterInitializationMode", "ExitInitializationMode", "Terminate", "Reset", "CancelStep")},
    "GetReal": (C.c_int, _GET(_R)), "GetInteger": (C.c_int, _GET(C.c_int)), "GetBoolean": (C.c_int, _GET(C.c_int)), "GetString": (C.c_int, _GET(_S)),
    "SetReal": (C.c_int, _SET(_R)), "SetInteger": (C.c_int, _SET(C.c_int)), "SetBoolean": (C.c_int, _SET(C.c_int)), "SetString": (C.c_int, _SET(_S)),
    "GetFMUstate": (C.c_int, [_V, _P(_V)]), "SetFMUstate": (C.c_int, [_V, _V]), "FreeFMUstate": (C.c_int, [_V, _P(_V)]),
    "SerializedFMUstateSize": (C.c_int, [_V, _V, _P(C.c_size_t)]), "SerializeFMUstate": (C.c_int, [_V, _V, _S, C.c_size_t]),
    "DeSerializeFMUstate": (C.c_int, [_V, _S, C.c_size_t, _P(_V)]),
    "GetDirectionalDerivative": (C.c_int, [_V, _REFS, C.c_size_t, _REFS, C.c_size_t, _P(_R), _P(_R)]),
    "SetRealInputDerivatives": (C.c_int, [_V, _REFS, C.c_size_t, _P(C.c_int), _P(_R)]),
    "GetRealOutputDerivatives": (C.c_int, [_V, _REFS, C.c_size_t, _P(C.c_int), _P(_R)]),
    "DoStep": (C.c_int, [_V, _R, _R, C.c_int]), "GetStatus": (C.c_int, [_V, C.c_int, _P(C.c_int)]),
    "GetRealStatus": (C.c_int, [_V, C.c_int, _P(_R)]), "GetIntegerStatus": (C.c_int, [_V, C.c_int, _P(C.c_int)]),
    "GetBooleanStatus": (C.c_int, [_V, C.c_int, _P(C.c_int)]), "GetStringStatus": (C.c_int, [_V, C.c_int, _P(_S)]),
}


class Unit:
    """An unzipped unit with its functions."""

    def __init__(self, file, folder=None):
        self._own = None if folder else tempfile.TemporaryDirectory(prefix="a unit ")
        self.folder = pathlib.Path(folder or self._own.name)
        with zipfile.ZipFile(file) as archive:
            archive.extractall(self.folder)
        self.description = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.name = self.description.find("CoSimulation").get("modelIdentifier")
        self.guid = self.description.get("guid")
        self.library = C.CDLL(str(self.folder / f"binaries/linux64/{self.name}.so"))
        for name, (result, arguments) in DECLARED.items():
            function = getattr(self.library, "fmi2" + name)
            function.restype, function.argtypes = result, arguments
        self.variables = {v.get("name"): v for v in self.description.find("ModelVariables")}
        self.resources = "file://" + urllib.parse.quote(str(self.folder / "resources"))

    def reference(self, name):
        return int(self.variables[name].get("valueReference"))

    def stop(self):
        return float(self.description.find("DefaultExperiment").get("stopTime"))


class Instance:
    """An instance. `messages` is its log as (status, category, text)."""

    def __init__(self, unit, *, guid=None, resources=None, kind=1, name=b"drive", logging=False):
        self.unit, self.messages = unit, []
        self._logger = LOGGER(lambda env, of, status, category, text: self.messages.append((status, category.decode(), text.decode())))
        self._callbacks = Callbacks(self._logger, None, None, None, None)
        self.c = unit.library.fmi2Instantiate(name, kind, (guid or unit.guid).encode(), (resources or unit.resources).encode(),
                                              C.byref(self._callbacks), 0, logging)

    def call(self, name, *arguments):
        return getattr(self.unit.library, "fmi2" + name)(self.c, *arguments)

    def begin(self, start=0.0, stop=None):
        for status in (self.call("SetupExperiment", 0, 0.0, start, stop is not None, stop or 0.0), self.call("EnterInitializationMode"),
                       self.call("ExitInitializationMode")):
            assert status == OK, self.messages
        return self

    def get(self, *names):
        refs = (_U * len(names))(*(self.unit.reference(n) for n in names))
        kind = self.unit.variables[names[0]][0].tag
        values = ({"Real": _R, "Integer": C.c_int, "String": _S}[kind] * len(names))()
        status = self.call("Get" + kind, refs, len(names), values)
        assert status == OK, self.messages
        return values[0] if len(names) == 1 else list(values)

    def put(self, name, value):
        return self.call("SetReal", (_U * 1)(self.unit.reference(name)), 1, (_R * 1)(value))

    def step(self, at, size):
        return self.call("DoStep", at, size, 1)

    def run(self, step, stop, start=0.0):
        """Makes steps until exactly `stop`. `step` is the step size, or a function that returns it. Returns the end
        of the last step."""
        now, n = start, 0
        while now < stop:
            n += 1
            following = min(stop, start + n * step if not callable(step) else now + step())
            if self.step(now, following - now) != OK:
                break
            now = following
        return now

    def digest(self):
        status = self.call("Terminate")
        assert status == OK, self.messages
        return self.get("digest").decode()

    def saved(self):
        state, size = _V(), C.c_size_t()
        assert self.call("GetFMUstate", C.byref(state)) == OK, self.messages
        assert self.call("SerializedFMUstateSize", state, C.byref(size)) == OK
        room = C.create_string_buffer(size.value)
        assert self.call("SerializeFMUstate", state, room, size.value) == OK
        assert self.call("FreeFMUstate", C.byref(state)) == OK and not state.value
        return room.raw

    def load(self, data):
        state = _V()
        status = self.call("DeSerializeFMUstate", data, len(data), C.byref(state))
        if status == OK:
            status = self.call("SetFMUstate", state)
            self.call("FreeFMUstate", C.byref(state))
        return status

    def __del__(self):
        if getattr(self, "c", None):
            self.unit.library.fmi2FreeInstance(self.c)
            self.c = None
