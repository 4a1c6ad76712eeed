// SPDX-License-Identifier: Apache-2.0
// sixstep._core: the library's functions for the Python package. Users call the package's Python functions.
#include <pybind11/pybind11.h>

#include "faces/python/src/controller.hpp"
#include "faces/python/src/environment.hpp"
#include "faces/python/src/outcome.hpp"
#include "faces/python/src/problems.hpp"
#include "faces/python/src/run.hpp"
#include "faces/python/src/scenario.hpp"
#include "faces/python/src/session.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("version") = SIXSTEP_VERSION;
  python::declare_problems(module);
  python::declare_controller(module);
  python::declare_scenario(module);
  python::declare_outcome(module);
  python::declare_run(module);
  python::declare_session(module);
  python::declare_environment(module);
}
