// SPDX-License-Identifier: Apache-2.0
// A user's controller with memory of its exact sizes, to measure only its size. The configuration is in
// flash, like the constants of a drive. entries.h declares it writable for the design.
#include <cstdint>

#include "sixstep/control/own/own_controller.h"

constexpr unsigned words(unsigned bytes) { return bytes == 0 ? 1 : (bytes + 7) / 8; }

extern "C" {
extern const std::uint64_t own_config[words(OWN_CONFIG_BYTES)];
const std::uint64_t own_config[words(OWN_CONFIG_BYTES)] = {1};
std::uint64_t own_state[words(OWN_STATE_BYTES)];
sixstep_measured own_measured;
sixstep_real own_setpoint;
sixstep_answer own_answer;
}
