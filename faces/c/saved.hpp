// SPDX-License-Identifier: Apache-2.0
// Converts a session to bytes: scenario, commands and instant. A session is loaded by simulating the run
// again. The bytes contain no state of the run, so another machine with the same byte order and the same
// version of the library can load them.
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
