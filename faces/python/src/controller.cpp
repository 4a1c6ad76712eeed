// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/controller.hpp"

#include <string>
#include <utility>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/own/own_pair.hpp"

namespace python {

namespace py = pybind11;

namespace {

/// A thread-local variable, because the interface's design function has no argument for the object. A run is
/// designed in the thread that starts it.
thread_local Controller* designed = nullptr;

struct Config {
  Controller* controller;
};

py::dict as_dict(const sixstep_given& g) {
  py::dict out;
  out["mode"] = static_cast<int>(g.mode);
  out["delay_periods"] = static_cast<int>(g.delay_periods);
  out["sampled_in_middle"] = g.sampled_in_middle != 0;
  out["period_s"] = g.period_s;
  out["bus_V"] = g.bus_V;
  out["pole_pairs"] = g.pole_pairs;
  out["R_ohm"] = g.R_ohm;
  out["L_H"] = g.L_H;
  out["K_t_Nm_A"] = g.K_t_Nm_A;
  out["magnet_Vs"] = g.magnet_Vs;
  out["J_kg_m2"] = g.J_kg_m2;
  out["B_Nm_s"] = g.B_Nm_s;
  out["current_d1"] = g.current_d1;
  out["current_d0"] = g.current_d0;
  out["speed_d1"] = g.speed_d1;
  out["speed_d0"] = g.speed_d0;
  out["full_torque_Nm"] = g.full_torque_Nm;
  out["full_current_A"] = g.full_current_A;
  out["current_limit_A"] = g.current_limit_A;
  out["position_gain_rad_s_per_deg"] = g.position_gain_rad_s_per_deg;
  out["speed_limit_rad_s"] = g.speed_limit_rad_s;
  return out;
}

/// Raises an exception for an answer of another type, or for a number out of its range.
[[noreturn]] void throw_wrong(const py::object& out, const char* wanted) {
  PyErr_Format(PyErr_Occurred() ? PyExc_TypeError : PyExc_ValueError,
               "the controller's step() returned %.60R; it must return %s", out.ptr(), wanted);
  throw py::error_already_set();
}

}  // namespace

/// State of a drive: the signed duty of its last step.
struct Controller::State {
  double duty;
};

Controller::Controller(py::object controller, bool legs)
    : step_(py::hasattr(controller, "step") ? py::object(controller.attr("step")) : controller),
      start_(py::hasattr(controller, "start") ? py::object(controller.attr("start"))
                                              : py::object(py::none())),
      measured_(std::make_shared<sixstep_measured>()),
      functions_{.interface = SIXSTEP_OWN_INTERFACE,
                 .answers = legs ? SIXSTEP_ANSWERS_LEGS : SIXSTEP_ANSWERS_PAIR,
                 .name = "python",
                 .sentence = "is written in Python",
                 .config_bytes = sizeof(Config),
                 .state_bytes = sizeof(State),
                 .parameters = 0,
                 .parameter = nullptr,
                 .design = &Controller::design,
                 .start = nullptr,
                 .step = &Controller::step,
                 .hall = legs ? nullptr : &Controller::hall} {
  if (!PyCallable_Check(step_.ptr()))
    throw py::type_error("a controller is a function or has a method step(m, setpoint)");
  seen_ = py::cast(measured_);
}

std::optional<py::error_already_set> Controller::take_error() { return std::exchange(error_, std::nullopt); }

const char* Controller::design(const sixstep_given* given, const sixstep_real*, void* config) {
  Controller* const own = designed;
  if (own == nullptr) return "was made in Python and can be run only from Python";
  static_cast<Config*>(config)->controller = own;
  own->chopping_ = given->chopping;
  own->mode_ = given->mode;
  const py::gil_scoped_acquire gil;
  try {
    if (!own->start_.is_none()) own->start_(as_dict(*given));
    return nullptr;
  } catch (py::error_already_set& error) {
    own->error_.emplace(std::move(error));
    return "raised an exception in start()";
  }
}

void Controller::step(const void* config, void* state, const sixstep_measured* measured,
                      sixstep_real setpoint, sixstep_answer* answer) {
  Controller& own = *static_cast<const Config*>(config)->controller;
  const py::gil_scoped_acquire gil;
  if (own.error_) return;
  try {
    static_cast<State*>(state)->duty = own.answer_to(*measured, setpoint, *answer);
    // Set for the report. The controller itself may use its setpoint in any way.
    if (own.mode_ == SIXSTEP_CURRENT) answer->current_reference_A = setpoint;
    if (own.mode_ == SIXSTEP_SPEED) answer->speed_reference_rad_s = setpoint;
  } catch (py::error_already_set& error) {
    own.error_.emplace(std::move(error));
    answer->fault = 1;
  }
}

/// At a Hall edge, sets the new pair at once, with the duty of the last step.
void Controller::hall(const void*, void* state, uint8_t code, sixstep_answer* answer) {
  if (answer->enabled != 0) control::command_pair(static_cast<State*>(state)->duty, code, *answer);
}

/// Fills in `answer`. Returns the signed duty if the answer is a pair.
double Controller::answer_to(const sixstep_measured& measured, double setpoint, sixstep_answer& answer) {
  *measured_ = measured;
  const py::float_ wanted(setpoint);
  PyObject* const arguments[] = {seen_.ptr(), wanted.ptr()};
  const auto out = py::reinterpret_steal<py::object>(PyObject_Vectorcall(step_.ptr(), arguments, 2, nullptr));
  if (!out) throw py::error_already_set();
  answer.enabled = out.is_none() ? 0 : 1;
  answer.duty = 0.0;
  if (out.is_none()) return 0.0;
  if (functions_.answers == SIXSTEP_ANSWERS_PAIR) {
    const double duty = PyFloat_AsDouble(out.ptr());
    if (PyErr_Occurred() || !(std::fabs(duty) <= 1.0)) throw_wrong(out, "a number from -1 to 1, or None");
    answer.chopping = chopping_;
    control::command_pair(duty, measured.hall, answer);
    return duty;
  }
  const auto items = py::reinterpret_steal<py::object>(
      PySequence_Fast(out.ptr(), "a controller of three legs returns three duties, or None"));
  if (!items) throw py::error_already_set();
  if (PySequence_Fast_GET_SIZE(items.ptr()) != 3) {
    PyErr_SetString(PyExc_ValueError, "a controller of three legs returns three duties, or None");
    throw py::error_already_set();
  }
  for (Py_ssize_t k = 0; k < 3; ++k) {
    const double duty = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(items.ptr(), k));
    if (PyErr_Occurred() || !(duty >= 0.0 && duty <= 1.0))
      throw_wrong(out, "three numbers from 0 to 1, or None");
    answer.leg[k] = {.state = SIXSTEP_LEG_PWM, .switches = SIXSTEP_PWM_COMPLEMENTARY, .duty = duty};
  }
  return 0.0;
}

Designing::Designing(Controller* controller) : before_(std::exchange(designed, controller)) {}
Designing::~Designing() { designed = before_; }

void declare_controller(py::module_& module) {
  py::class_<sixstep_measured, std::shared_ptr<sixstep_measured>>(
      module, "Measured",
      "One sample of the scenario's sensors; the same object in each step, with new values.")
      .def_property_readonly(
          "i_a_A", [](const sixstep_measured& m) { return m.current_A[0]; },
          "current of phase a into the motor, A")
      .def_property_readonly(
          "i_b_A", [](const sixstep_measured& m) { return m.current_A[1]; },
          "current of phase b into the motor, A")
      .def_property_readonly(
          "i_c_A", [](const sixstep_measured& m) { return m.current_A[2]; },
          "current of phase c into the motor, A")
      .def_readonly("speed_rad_s", &sixstep_measured::speed_rad_s,
                    "mechanical speed, rad/s; of a linear motor m/s")
      .def_readonly("position_deg", &sixstep_measured::position_deg,
                    "mechanical position, counted over turns, degrees")
      .def_readonly("bus_V", &sixstep_measured::bus_V, "bus voltage, V")
      .def_readonly("magnet_cos", &sixstep_measured::magnet_cos,
                    "cosine of the magnet's electrical angle from phase a's axis")
      .def_readonly("magnet_sin", &sixstep_measured::magnet_sin,
                    "sine of the magnet's electrical angle from phase a's axis")
      .def_readonly("hall", &sixstep_measured::hall, "Hall code: H1 H2 H3 as bits 2, 1, 0")
      .def_property_readonly(
          "motor_current_A", &control::pair_current,
          "current of the pair that makes positive torque, A: half the difference of its two phases");
  py::class_<Controller, std::shared_ptr<Controller>>(module, "Controller")
      .def(py::init<py::object, bool>(), py::arg("controller"), py::arg("legs") = false);
}

}  // namespace python
