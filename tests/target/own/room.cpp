// SPDX-License-Identifier: Apache-2.0
// Memory of a controller of one's own to the byte, for its size alone. The config stands in flash, as a drive's constants do:
// entries.h has it as what design may write.
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
