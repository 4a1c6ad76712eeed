// SPDX-License-Identifier: Apache-2.0
// Converts a session to bytes: scenario, commands and instant, from which the run is simulated again. They do
// not contain memory contents, so that any machine with the same version of the library can read them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "faces/c/session.hpp"

namespace c_face {

/// Returns CBOR (RFC 8949) and a checksum. `session` must be open.
std::vector<std::uint8_t> saved(const Session& session);

/// Opens `session` and simulates it up to the saved instant.
sixstep_status loaded(std::span<const std::uint8_t> bytes, Session& session);

}  // namespace c_face
