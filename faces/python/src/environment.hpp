// SPDX-License-Identifier: Apache-2.0
// Many drives of one scenario. Each drive receives an external command once per control period.
#pragma once
#include <pybind11/pybind11.h>

namespace python {

void declare_environment(pybind11::module_& module);

}  // namespace python
