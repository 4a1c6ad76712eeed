// SPDX-License-Identifier: Apache-2.0
// Drives with external commands: an environment's action acts as a controller, through the interface for
// users' controllers.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sixstep/control/own/own_controller.h"

namespace python {

/// The quantity that an environment's action commands:
/// - duty: of the driven pair of the Hall code, -1..1;
/// - legs: three duties, 0..1;
/// - current: setpoint of the library's current loop, A.
enum class Action : std::uint8_t { duty, legs, current };

std::optional<Action> action_of(std::string_view word);
constexpr std::size_t columns_of(Action action) { return action == Action::legs ? 3 : 1; }

/// The command of one drive for its next tick, and the board's measurements at its last tick.
struct Exchange {
  std::array<double, 3> action{};
  sixstep_measured seen{};
  double setpoint = 0.0;  ///< value of the scenario's reference
  double current_A =
      0.0;  ///< bound of the current setpoint, A: the scenario's limit, else the current at full torque
};

const sixstep_controller& controller_of(Action action);

/// While this object exists, a session that this thread opens with such a controller reads its commands from
/// this exchange.
class Opening {
 public:
  explicit Opening(Exchange& exchange);
  ~Opening();
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;
};

}  // namespace python
