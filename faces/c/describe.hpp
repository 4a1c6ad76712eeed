// SPDX-License-Identifier: Apache-2.0
// What sixstep_describe() tells of a session.
#pragma once
#include <string>

#include "faces/c/session.hpp"

namespace c_face {

/// JSON: version, duration, control period, signals with their place among all, and keys of changes.
std::string described(const Session& session);

}  // namespace c_face
