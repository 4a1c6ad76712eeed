// SPDX-License-Identifier: Apache-2.0
// Writes the text that sixstep_describe() returns.
#pragma once
#include <string>

#include "faces/c/session.hpp"

namespace c_face {

/// Returns JSON: version, duration, control period, the session's signals with their indices, and the keys
/// that can be changed.
std::string described(const Session& session);

}  // namespace c_face
