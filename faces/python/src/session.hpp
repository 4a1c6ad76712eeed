// SPDX-License-Identifier: Apache-2.0
// A run that Python advances, reads and changes.
#pragma once
#include <pybind11/pybind11.h>

namespace python {

void declare_session(pybind11::module_& module);

}  // namespace python
