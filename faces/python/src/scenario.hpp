// SPDX-License-Identifier: Apache-2.0
// A checked scenario, and its Python controller if there is one.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>

#include "faces/python/src/controller.hpp"
#include "faces/python/src/rooms.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace python {

struct HeldScenario {
  study::Scenario scenario;
  std::shared_ptr<Controller> controller;  ///< null: the controller is in the library or in a shared object
};

void declare_scenario(pybind11::module_& module);

}  // namespace python
