// SPDX-License-Identifier: Apache-2.0
// Short names for the library's namespaces, for code in python.
#pragma once

namespace sixstep {
namespace base {}
namespace control {}
namespace study {}
}  // namespace sixstep

namespace python {
namespace base = sixstep::base;
namespace control = sixstep::control;
namespace study = sixstep::study;
}  // namespace python
