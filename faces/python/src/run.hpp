// SPDX-License-Identifier: Apache-2.0
// One run of a scenario, without the GIL.
#pragma once
#include <pybind11/pybind11.h>

namespace python {

void declare_run(pybind11::module_& module);

}  // namespace python
