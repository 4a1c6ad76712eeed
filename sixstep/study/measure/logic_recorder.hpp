// SPDX-License-Identifier: Apache-2.0
// This observer tells the logic signals. It reads the rig and cannot change the run by a bit.
#pragma once
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/measure/logic.hpp"

namespace sixstep::study {

template <class Rig>
LogicRow logic_row(const Rig& rig) {
  LogicRow row{};
  const auto set = [&row](LogicId id, auto v) {
    row[static_cast<std::size_t>(id)] = static_cast<std::uint32_t>(v);
  };
  // The timer's, which the plant has unless they would short the bus: that is to be seen too.
  const plant::Gates gates = rig.modulator().gates();
  for (std::size_t k = 0; k < 3; ++k) {
    row[2 * k] = gates.high[k] ? 1 : 0;
    row[2 * k + 1] = gates.low[k] ? 1 : 0;
  }
  const unsigned pins = rig.pins();
  set(LogicId::H1, pins >> 2U & 1U);
  set(LogicId::H2, pins >> 1U & 1U);
  set(LogicId::H3, pins & 1U);
  set(LogicId::sector, rig.plant().sector());
  const std::int64_t ticks = rig.event_count(rig::EventKind::tick);
  set(LogicId::tick, ticks);
  set(LogicId::periods, ticks);
  const auto& command = rig.modulator().command();
  set(LogicId::enabled, command.enabled ? 1 : 0);
  set(LogicId::pwm, command.enabled && rig.modulator().source_on() ? 1 : 0);
  for (int which = 0; which < 2; ++which) {
    const rig::ArmedComparator c = rig.modulator().comparator(which);
    const std::uint32_t output = c.switches_off ? 1 : 0;  // one that waits to switch off is on
    row[static_cast<std::size_t>(LogicId::comparator_1) + static_cast<std::size_t>(which)] =
        c.armed ? output : logic_unknown;
  }
  set(LogicId::shoot_through, rig.fault() == rig::Fault::shoot_through ? 1 : 0);
  set(LogicId::impossible_hall, rig.fault() == rig::Fault::impossible_hall ? 1 : 0);
  const unsigned faults = rig.firmware().diagnosis().faults;
  constexpr auto first = static_cast<std::size_t>(LogicId::over_current);
  for (std::size_t bit = 0; first + bit < logic_count; ++bit) row[first + bit] = faults >> bit & 1U;
  return row;
}

/// Of several things at one picosecond the last counts: an analyser sees no pulse without length.
class LogicRecorder {
 public:
  explicit LogicRecorder(LogicSink sink) : sink_(std::move(sink)) {}

  template <class Rig>
  void segment(const Rig& rig, double) {
    take(rig.now().ticks, logic_row(rig));
  }
  template <class Rig>
  void end(const Rig& rig) {
    take(rig.now().ticks, logic_row(rig));
    sink_(ps_, row_);
  }

 private:
  void take(std::int64_t ps, const LogicRow& row) {
    if (ps != ps_ && !(told_ && row_ == last_)) {
      sink_(ps_, row_);
      last_ = row_;
      told_ = true;
    }
    ps_ = ps;
    row_ = row;
  }

  LogicSink sink_;
  std::int64_t ps_ = 0;
  LogicRow row_{}, last_{};
  bool told_ = false;
};

}  // namespace sixstep::study
