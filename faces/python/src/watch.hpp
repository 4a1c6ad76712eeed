// SPDX-License-Identifier: Apache-2.0
// Checks for signals, and reports progress, while a run does not hold the GIL.
#pragma once
#include <pybind11/pybind11.h>

#include <chrono>
#include <utility>

namespace python {

class Watch {
 public:
  /// `progress`: None, or a function of the simulated time in s.
  explicit Watch(pybind11::object progress) : progress_(std::move(progress)) {}

  /// Returns false if the run must end; stopped_by() then returns the reason. Acquires the GIL at most once
  /// per `interval`.
  bool keep_going(double t_s) {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < interval) return true;
    looked_ = now;
    const pybind11::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (!progress_.is_none()) progress_(t_s);
      return true;
    } catch (pybind11::error_already_set& error) {
      stopped_by_ = error.value();
      return false;
    }
  }

  bool stopped_by_nothing() const { return stopped_by_.is_none(); }
  /// Raises the exception that stopped the run. Needs the GIL.
  [[noreturn]] void raise() const {
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(stopped_by_.ptr())), stopped_by_.ptr());
    throw pybind11::error_already_set();
  }
  /// The exception that stopped the run; None if nothing stopped it.
  pybind11::object stopped_by() const { return stopped_by_; }

 private:
  static constexpr auto interval = std::chrono::milliseconds(50);
  pybind11::object progress_, stopped_by_ = pybind11::none();
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

}  // namespace python
