// SPDX-License-Identifier: Apache-2.0
// Short names for the library's namespaces, for code in c_face.
#pragma once

namespace sixstep {
namespace base {}
namespace rig {}
namespace sim {}
namespace study {}
}  // namespace sixstep

namespace c_face {
namespace base = sixstep::base;
namespace rig = sixstep::rig;
namespace sim = sixstep::sim;
namespace study = sixstep::study;
}  // namespace c_face
