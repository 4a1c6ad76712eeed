# SPDX-License-Identifier: Apache-2.0
"""Calls libsixstep through ctypes. The table DECLARED repeats the declarations of sixstep.h in Python, as every
language with foreign functions needs them."""
import ctypes as C

OK, OVER, REFUSED, MISUSE, NO_MEMORY = range(5)
SCENARIO, PAIR, LEGS, GATES = range(4)
SOFT, HARD, COMPLEMENTARY = range(3)


class Options(C.Structure):
    _fields_ = [("bytes", C.c_size_t), ("settings", C.POINTER(C.c_char_p)), ("folder", C.c_char_p), ("data", C.c_char_p), ("chip", C.c_int)]


class Problem(C.Structure):
    _fields_ = [("place", C.c_char_p), ("value", C.c_char_p), ("limit", C.c_char_p), ("cure", C.c_char_p)]


class Signal(C.Structure):
    _fields_ = [("name", C.c_char_p), ("unit", C.c_char_p), ("frame", C.c_char_p), ("meaning", C.c_char_p)]


class Measured(C.Structure):
    _fields_ = [("current_A", C.c_double * 3), ("speed_rad_s", C.c_double), ("position_deg", C.c_double), ("bus_V", C.c_double),
                ("magnet_cos", C.c_double), ("magnet_sin", C.c_double), ("hall", C.c_uint8)]


class Leg(C.Structure):
    _fields_ = [("state", C.c_uint8), ("switches", C.c_uint8), ("duty", C.c_double)]


class Answer(C.Structure):
    _fields_ = [("enabled", C.c_uint8), ("fault", C.c_uint8), ("source", C.c_uint8), ("sink", C.c_uint8), ("chopping", C.c_uint8),
                ("chopped", C.c_uint8), ("duty", C.c_double), ("overlap", C.c_double), ("leg", Leg * 3),
                ("current_reference_A", C.c_double), ("speed_reference_rad_s", C.c_double)]


class Counts(C.Structure):
    _fields_ = [("current", C.c_uint16 * 3), ("terminal", C.c_uint16 * 3), ("bus", C.c_uint16), ("timer", C.c_uint16), ("hall", C.c_uint8)]


_H, _S = C.c_void_p, C.c_int
_D, _P = C.c_double, C.POINTER
# name: (result, arguments), as sixstep.h declares them.
DECLARED = {
    "sixstep_abi": (C.c_uint32, []), "sixstep_version": (C.c_char_p, []),
    "sixstep_problem_count": (C.c_size_t, [_H]), "sixstep_problem_at": (_S, [_H, C.c_size_t, _P(Problem)]),
    "sixstep_open_file": (_S, [C.c_char_p, _P(Options), _P(_H)]), "sixstep_open_text": (_S, [C.c_char_p, _P(Options), _P(_H)]),
    "sixstep_free": (None, [_H]), "sixstep_advance": (_S, [_H, _D]), "sixstep_advance_to_tick": (_S, [_H]),
    "sixstep_advance_to_hall_edge": (_S, [_H, _D]), "sixstep_advance_to_crossing": (_S, [_H, C.c_int, _D, _D]),
    "sixstep_time": (_D, [_H]), "sixstep_tick_after": (_D, [_H, _D]), "sixstep_period": (_D, [_H]), "sixstep_duration": (_D, [_H]),
    "sixstep_signal_count": (C.c_int, []), "sixstep_signal_at": (_S, [C.c_int, _P(Signal)]), "sixstep_signal_index": (C.c_int, [C.c_char_p]),
    "sixstep_value": (_D, [_H, C.c_int]), "sixstep_values": (_S, [_H, _P(_D), C.c_size_t]), "sixstep_describe": (C.c_char_p, [_H]),
    "sixstep_change": (_S, [_H, C.c_char_p, _P(_D)]), "sixstep_copy": (_S, [_H, _P(_H)]), "sixstep_save": (C.c_size_t, [_H, C.c_void_p, C.c_size_t]),
    "sixstep_load": (_S, [C.c_char_p, C.c_size_t, _P(_H)]), "sixstep_scenario": (C.c_char_p, [_H]), "sixstep_finish": (_S, [_H]),
    "sixstep_outcome": (C.c_char_p, [_H]), "sixstep_digest": (C.c_uint64, [_H]), "sixstep_measure": (_S, [_H, _P(Measured), _P(_D)]),
    "sixstep_command": (_S, [_H, _P(Answer)]), "sixstep_set_gates": (_S, [_H, C.c_uint32]), "sixstep_convert": (_S, [_H, _P(Counts)]),
}


def load(path):
    """Loads the library and declares every function."""
    library = C.CDLL(str(path))
    for name, (result, arguments) in DECLARED.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


class Session:
    """A session that is freed together with this object. `status` is the status of the call that opened the session."""

    def __init__(self, library, handle, status):
        self.library, self.handle, self.status = library, handle, status

    @classmethod
    def open(cls, library, path=None, *, text=None, chip=SCENARIO, settings=(), folder=None):
        handle = _H()
        names = (C.c_char_p * (len(settings) + 1))(*[s.encode() for s in settings], None)
        options = Options(C.sizeof(Options), names, folder and str(folder).encode(), None, chip)
        if text is not None:
            status = library.sixstep_open_text(text.encode(), C.byref(options), C.byref(handle))
        else:
            status = library.sixstep_open_file(str(path).encode(), C.byref(options), C.byref(handle))
        return cls(library, handle, status)

    def __getattr__(self, name):
        function = getattr(self.library, "sixstep_" + name)
        return lambda *arguments: function(self.handle, *arguments)

    def value_of(self, name):
        return self.value(self.library.sixstep_signal_index(name.encode()))

    def copied(self):
        handle = _H()
        status = self.library.sixstep_copy(self.handle, C.byref(handle))
        return Session(self.library, handle, status)

    def saved(self):
        room = C.create_string_buffer(self.save(None, 0))
        size = self.save(room, len(room))
        assert size == len(room)
        return room.raw

    @classmethod
    def loaded(cls, library, saved):
        handle = _H()
        status = library.sixstep_load(saved, len(saved), C.byref(handle))
        return cls(library, handle, status)

    def problems(self):
        out = []
        for k in range(self.problem_count()):
            problem = Problem()
            assert self.problem_at(k, C.byref(problem)) == OK
            out.append(tuple(getattr(problem, f).decode(errors="replace") for f, _ in Problem._fields_))
        return out

    def __del__(self):
        if self.handle:
            self.library.sixstep_free(self.handle)
            self.handle = None
