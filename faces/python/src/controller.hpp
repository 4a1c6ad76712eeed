// SPDX-License-Identifier: Apache-2.0
// A controller written in Python, in place of a user's controller in C (control/own/own_controller.h). It
// receives the same measurement and returns the same output, once per control period.
//
// The Python object has two methods:
// - step(m, setpoint) returns the output. A number is the duty of the driven pair, -1..1; three numbers are
//   the duties of the legs, 0..1; None turns the bridge off.
// - start(given) is optional. It is called before each run with the data that a controller in C receives for
//   its design.
//
// An exception stops the run, and is raised again in the caller of the run.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>

#include "faces/python/src/rooms.hpp"
#include "sixstep/control/own/own_controller.h"

namespace python {

class Controller {
 public:
  /// `legs`: true: the output commands three legs; false: it commands the driven pair.
  Controller(pybind11::object controller, bool legs);

  const sixstep_controller* functions() const { return &functions_; }

  /// Returns the exception that stopped the run, and clears it. Needs the GIL.
  std::optional<pybind11::error_already_set> take_error();

 private:
  struct State;
  static const char* design(const sixstep_given* given, const sixstep_real* values, void* config);
  static void step(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint,
                   sixstep_answer* answer);
  static void hall(const void* config, void* state, uint8_t code, sixstep_answer* answer);
  double answer_to(const sixstep_measured& measured, double setpoint, sixstep_answer& answer);

  pybind11::object step_;
  pybind11::object start_;  ///< None: the controller has no start()
  pybind11::object seen_;   ///< the object `m` for step(), the same in each call; refers to measured_
  std::shared_ptr<sixstep_measured> measured_;
  uint8_t chopping_ = SIXSTEP_SOFT;
  uint8_t mode_ = 0;  ///< mode of the scenario, coded as in sixstep_given
  std::optional<pybind11::error_already_set> error_;
  sixstep_controller functions_;
};

/// While this object exists, runs that this thread starts use this controller.
class Designing {
 public:
  explicit Designing(Controller* controller);
  ~Designing();
  Designing(const Designing&) = delete;
  Designing& operator=(const Designing&) = delete;

 private:
  Controller* before_;
};

void declare_controller(pybind11::module_& module);

}  // namespace python
