// SPDX-License-Identifier: Apache-2.0
// The functions with which the caller acts as the controller: measurement, command, gates, counts.
#include <string>
#include <utility>

#include "faces/c/session.hpp"

namespace c_face {

namespace {

/// Returns a problem for each lag of the board's amplifiers and dividers. sixstep_convert() cannot apply a
/// lag; only sixstep_measure() can.
base::Problems lagging(const study::Scenario& s) {
  base::Problems out;
  const auto refuse = [&](bool lags, const char* key) {
    if (lags)
      out.push_back({key, "",
                     "has no effect on sixstep_convert(), which returns the counts of the present instant",
                     "remove this key, or read measurements with sixstep_measure()"});
  };
  refuse(s.sensors.current_bandwidth_Hz.has_value(), "sensors.current_bandwidth_Hz");
  refuse(s.sensors.current_delay_s > 0.0, "sensors.current_delay_s");
  refuse(s.sensors.bus_bandwidth_Hz.has_value(), "sensors.bus_bandwidth_Hz");
  return out;
}

}  // namespace

sixstep_status Session::measure(sixstep_measured& measured, double* setpoint) {
  if (const sixstep_status status = usable("sixstep_measure"); status != SIXSTEP_OK) return status;
  if (source_.chip != SIXSTEP_CHIP_PAIR && source_.chip != SIXSTEP_CHIP_LEGS)
    return misuse("sixstep_measure", "needs a session whose controller is the caller",
                  "open the session with SIXSTEP_CHIP_PAIR or SIXSTEP_CHIP_LEGS");
  if (!run_->at_tick())
    return misuse("sixstep_measure", "needs a control tick",
                  "call sixstep_advance_to_tick() before this function");
  const Exchanging here(exchange_);
  run_->call_controller();
  measured = exchange_.measured;
  if (setpoint != nullptr) *setpoint = exchange_.setpoint;
  return SIXSTEP_OK;
}

sixstep_status Session::command(const sixstep_answer& answer) {
  if (const sixstep_status status = usable("sixstep_command"); status != SIXSTEP_OK) return status;
  if (source_.chip != SIXSTEP_CHIP_PAIR && source_.chip != SIXSTEP_CHIP_LEGS)
    return misuse("sixstep_command", "needs a session whose controller is the caller",
                  "open the session with SIXSTEP_CHIP_PAIR or SIXSTEP_CHIP_LEGS");
  exchange_.answer = answer;
  commands_.add(now_ps(), answer);
  return SIXSTEP_OK;
}

sixstep_status Session::set_gates(std::uint32_t gates) {
  if (const sixstep_status status = usable("sixstep_set_gates"); status != SIXSTEP_OK) return status;
  if (!ahead_)
    return misuse("sixstep_set_gates", "needs a session whose gates the caller sets",
                  "open the session with SIXSTEP_CHIP_GATES");
  if (gates > 0x3f)
    return refused({{"gates", std::to_string(gates), "must be 0 to 63: one bit per switch",
                     "clear all bits above bit 5"}});
  if (ahead_->over()) return SIXSTEP_OVER;
  const double at_s = time_s();
  const Exchanging here(exchange_);
  exchange_.stop_ps = now_ps();
  if (at_s > 0 && !run_->skip(static_cast<double>(exchange_.stop_ps) / sim::ticks_per_second))
    return SIXSTEP_OVER;
  exchange_.gates = gates;
  commands_.add(exchange_.stop_ps, gates);
  return reached(look_ahead(commands_.in_order.back().at_ps));
}

sixstep_status Session::convert(sixstep_counts& counts) {
  if (const sixstep_status status = usable("sixstep_convert"); status != SIXSTEP_OK) return status;
  if (base::Problems lags = lagging(run_->scenario()); !lags.empty()) return refused(std::move(lags));
  const study::FullRow& row = seen().present().signals;
  const auto at = [&](study::ColumnId id) { return row[static_cast<std::size_t>(id)]; };
  const rig::SensorsConfig& sensors = run_->board().sensors;
  using enum study::ColumnId;
  const double current[] = {at(i_a), at(i_b), at(i_c)}, terminal[] = {at(u_a), at(u_b), at(u_c)};
  ++conversions_;
  counts = {};
  for (std::size_t k = 0; k < 3; ++k) {
    if (sensors.currents == rig::CurrentMeasurement::phases)
      counts.current[k] = registers_.current_counts(k, current[k], conversions_);
    if (sensors.bus.range > 0) counts.terminal[k] = registers_.terminal_counts(k, terminal[k], conversions_);
  }
  if (sensors.bus.range > 0) counts.bus = registers_.bus_counts({.bus_V = at(bus_V), .number = conversions_});
  counts.timer = static_cast<std::uint16_t>(registers_.counter(sim::to_instant(time_s())));
  counts.hall = static_cast<std::uint8_t>(at(hall));
  return SIXSTEP_OK;
}

}  // namespace c_face
