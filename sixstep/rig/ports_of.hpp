// SPDX-License-Identifier: Apache-2.0
// Access to parts of a chip that only some firmwares have. The functions return null for a firmware without
// this part.
#pragma once
#include <type_traits>

#include "sixstep/rig/registers.hpp"
#include "sixstep/rig/shaft_ports.hpp"

namespace sixstep::rig {

/// Ports of an encoder or a resolver, or null.
template <class Firmware>
auto shaft_ports_of([[maybe_unused]] Firmware& firmware)
    -> std::conditional_t<std::is_const_v<Firmware>, const ShaftPorts*, ShaftPorts*> {
  if constexpr (requires { *firmware.shaft_ports(); })
    return firmware.shaft_ports();
  else if constexpr (requires { firmware.shaft_ports(); })
    return &firmware.shaft_ports();
  else
    return nullptr;
}

/// Inputs of converters and timers, or null.
template <class Firmware>
Registers* registers_of([[maybe_unused]] Firmware& firmware) {
  if constexpr (requires { *firmware.registers(); })
    return firmware.registers();
  else if constexpr (requires { firmware.registers(); })
    return &firmware.registers();
  else
    return nullptr;
}

}  // namespace sixstep::rig
