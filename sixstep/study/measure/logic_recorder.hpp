// SPDX-License-Identifier: Apache-2.0
// Records the logic signals. It only reads the rig, so the run's results stay the same to the bit.
#pragma once
#include "sixstep/rig/rig.hpp"
#include "sixstep/rig/shaft_raw.hpp"
#include "sixstep/study/measure/logic.hpp"
#include "sixstep/study/measure/modulator_view.hpp"

namespace sixstep::study {

inline void set_lines(LogicRow& row, std::uint8_t pins) {
  for (std::size_t n = 0; n < 3; ++n)
    row[static_cast<std::size_t>(LogicId::encoder_A) + n] = pins >> (2 - n) & 1U;
}

/// Sets the encoder's signals at the segment's beginning.
template <class Rig>
void set_encoder(LogicRow& row, const Rig& rig) {
  auto& code = row[static_cast<std::size_t>(LogicId::absolute_code)];
  code = logic_unknown;
  for (std::size_t n = 0; n < 3; ++n) row[static_cast<std::size_t>(LogicId::encoder_A) + n] = logic_unknown;
  const rig::ShaftPorts* const ports = rig::shaft_ports_of(rig.firmware());
  if (ports == nullptr) return;
  if (ports->given().kind == rig::ShaftSensor::absolute) code = ports->code();
  if (ports->given().kind == rig::ShaftSensor::encoder) set_lines(row, ports->pins());
}

template <class Rig>
LogicRow logic_row(const Rig& rig) {
  LogicRow row{};
  const auto set = [&row](LogicId id, auto v) {
    row[static_cast<std::size_t>(id)] = static_cast<std::uint32_t>(v);
  };
  // The timer's gates. They differ from the plant's gates only where they would short the bus; the recording
  // must show this short circuit.
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
  set_encoder(row, rig);
  const std::int64_t ticks = rig.event_count(rig::EventKind::tick);
  set(LogicId::tick, ticks);
  set(LogicId::periods, ticks);
  const ModulatorView modulator(rig.modulator());
  set(LogicId::enabled, modulator.enabled() ? 1 : 0);
  set(LogicId::pwm, modulator.enabled() && modulator.drives() ? 1 : 0);
  for (int which = 0; which < 2; ++which) {
    const rig::ArmedComparator c = modulator.comparator(which);
    const std::uint32_t output = c.switches_off ? 1 : 0;  // while the comparator waits to switch off, its
                                                          // output is on
    row[static_cast<std::size_t>(LogicId::comparator_1) + static_cast<std::size_t>(which)] =
        c.armed ? output : logic_unknown;
  }
  set(LogicId::shaft_sensor, rig.fault() == rig::Fault::shaft_sensor ? 1 : 0);
  set(LogicId::shoot_through, rig.fault() == rig::Fault::shoot_through ? 1 : 0);
  set(LogicId::impossible_hall, rig.fault() == rig::Fault::impossible_hall ? 1 : 0);
  const unsigned faults = rig.firmware().diagnosis().faults;
  constexpr auto first = static_cast<std::size_t>(LogicId::over_current);
  for (std::size_t bit = 0; first + bit < logic_count; ++bit) row[first + bit] = faults >> bit & 1U;
  return row;
}

/// If several events share one picosecond, only the signals after the last of them are recorded: a logic
/// analyser shows no pulse of length 0.
class LogicRecorder {
 public:
  explicit LogicRecorder(LogicSink sink) : sink_(std::move(sink)) {}

  template <class Rig>
  void segment(const Rig& rig, double s) {
    LogicRow row = logic_row(rig);
    take(rig.now().ticks, row);
    const rig::ShaftPorts* const ports = rig::shaft_ports_of(rig.firmware());
    if (ports == nullptr || ports->given().kind != rig::ShaftSensor::encoder) return;
    const auto motion = rig.shaft_motion(s, rig.now());
    rig::for_each_quarter(motion, *ports, [&](std::int64_t quarter, double at) {
      set_lines(row, ports->pins_in(quarter));
      take(motion.from.plus_seconds(at * motion.y.h).ticks, row);
    });
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
