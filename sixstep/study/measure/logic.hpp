// SPDX-License-Identifier: Apache-2.0
// The signals that a logic analyser on the board would show: gates, Hall lines, timer, comparators, faults, at
// the rig's own integer picoseconds.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sixstep::study {

enum class LogicKind : std::uint8_t {
  level,  ///< a number of `bits` bits, or logic_unknown
  event   ///< occurs where its count increases
};

struct LogicSignal {
  std::string group, name;
  int bits = 1;
  LogicKind kind = LogicKind::level;
  std::string meaning;
};

enum class LogicId : std::uint8_t {
  T1,
  T2,
  T3,
  T4,
  T5,
  T6,
  H1,
  H2,
  H3,
  sector,
  encoder_A,
  encoder_B,
  encoder_Z,
  absolute_code,
  tick,
  periods,
  pwm,
  enabled,
  comparator_1,
  comparator_2,
  shoot_through,
  impossible_hall,
  shaft_sensor,
  over_current,  ///< this signal and the next ones: in the order of control::Fault's bits
  over_voltage,
  under_voltage,
  over_speed,
  hall,
  stall,
  calibration,
  align,
  count
};
inline constexpr std::size_t logic_count = static_cast<std::size_t>(LogicId::count);
using LogicRow = std::array<std::uint32_t, logic_count>;

/// Level of a comparator that is not armed, and of an encoder that is absent.
inline constexpr std::uint32_t logic_unknown = 0xffff'ffffu;

/// In the order of LogicId.
const std::vector<LogicSignal>& logic_signals();

/// Takes an instant in ps and all signals from that instant on. Instants rise, and each row differs from the
/// row before. The last row marks the end of the run and may be equal to the row before.
using LogicSink = std::function<void(std::int64_t ps, std::span<const std::uint32_t>)>;

}  // namespace sixstep::study
