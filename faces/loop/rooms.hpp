// SPDX-License-Identifier: Apache-2.0
// Short names for the library's namespaces, for code in loop.
#pragma once

namespace sixstep {
namespace base {}
namespace rig {}
namespace study {}
}  // namespace sixstep

namespace loop {
namespace base = sixstep::base;
namespace rig = sixstep::rig;
namespace study = sixstep::study;
}  // namespace loop
