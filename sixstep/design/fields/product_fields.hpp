// SPDX-License-Identifier: Apache-2.0
// Lists every field of the product drive's configuration (control/protected_drive.hpp) around its drive once,
// in the order of an exported header. Each list binds all members of its struct: the list does not compile if
// a member is missing.
#pragma once
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/design/fields/drive_fields.hpp"

namespace sixstep::design {

/// Base and unit of the quantity that a converter measures.
struct AdcUse {
  Base base = Base::one;
  const char* unit = "";
};

template <class Walk, class Kept>
void fields(Walk&& w, const control::AdcConfig<double>& d, Kept& kept, const AdcUse& use) {
  auto& [per_eighth, offset_counts, offset_tolerance, log2_samples] = kept;
  constexpr control::AdcConfig<double> unset{};
  w.raw_gain({"per_eighth", use.unit, "per eighth of a count"}, d.per_eighth, per_eighth, use.base);
  w.count({"offset_counts", "", "reading without a current"}, d.offset_counts, offset_counts,
          unset.offset_counts);
  w.count({"offset_tolerance", "", "counts"}, d.offset_tolerance, offset_tolerance, unset.offset_tolerance);
  w.count({"log2_samples"}, d.log2_samples, log2_samples, unset.log2_samples);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::OneShuntConfig<double>& d, Kept& kept) {
  auto& [least_duty, commutation_samples, fade] = kept;
  w.signal({"least_duty", "", "smallest duty at which a sample shows the current", true}, d.least_duty,
           least_duty, Base::one);
  w.count({"commutation_samples", "", "samples after a Hall edge that count as the incoming phase's current"},
          d.commutation_samples, commutation_samples, std::uint8_t{0});
  w.signal({"fade", "", "factor per tick on a current that no sample shows"}, d.fade, fade, Base::one);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::HallConfig& d, Kept& kept) {
  auto& [arrangement, stable_samples] = kept;
  constexpr control::HallConfig unset{};
  w.choice({"arrangement"}, d.arrangement, arrangement, unset.arrangement);
  w.count({"stable_samples", "", "consecutive samples with the same Hall code"}, d.stable_samples,
          stable_samples, unset.stable_samples);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::HallSpeedConfig<double>& d, Kept& kept) {
  auto& [sector_rad_s_ticks, timeout_ticks, edges, window_ticks, grain_ticks] = kept;
  constexpr control::HallSpeedConfig<double> unset{};
  w.ticks(
      {"sector_rad_s_ticks", "rad/s", "this value divided by the timer ticks of a sector is the speed", true},
      d.sector_rad_s_ticks, sector_rad_s_ticks, Base::speed);
  w.count({"timeout_ticks", "", "timer ticks without an edge that count as standstill"}, d.timeout_ticks,
          timeout_ticks, unset.timeout_ticks);
  w.count({"edges", "", "Hall edges over which a speed is averaged"}, d.edges, edges, unset.edges);
  w.count({"window_ticks", "", "timer ticks; if the edges take longer, the speed is measured over one edge"},
          d.window_ticks, window_ticks, unset.window_ticks);
  w.count({"grain_ticks", "", "timer ticks, resolution of an edge's time"}, d.grain_ticks, grain_ticks,
          unset.grain_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::HallPositionConfig<double>& d, Kept& kept) {
  auto& [per_sector, per_fraction] = kept;
  w.raw_gain({"per_sector", "deg", "per sector"}, d.per_sector, per_sector, Base::position);
  w.gain({"per_fraction", "deg", "per part of a sector"}, d.per_fraction, per_fraction,
         {Base::position, Base::one});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::AdvanceConfig<double>& d, Kept& kept) {
  auto& [fixed, per_speed, limit] = kept;
  w.signal({"fixed", "sectors of 60 electrical degrees"}, d.fixed, fixed, Base::one);
  w.gain({"per_speed", "sectors per rad/s"}, d.per_speed, per_speed, {Base::one, Base::speed});
  w.signal({"limit", "sectors"}, d.limit, limit, Base::one);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FaultConfig<double>& d, Kept& kept) {
  auto& [over_current_A, over_voltage_V, under_voltage_V, over_speed_rad_s, stall_current_A, stall_ticks,
         voltage_ticks] = kept;
  constexpr control::FaultConfig<double> unset{};
  w.threshold({"over_current_A", "A"}, d.over_current_A, over_current_A, Base::current);
  w.threshold({"over_voltage_V", "V"}, d.over_voltage_V, over_voltage_V, Base::voltage);
  w.threshold({"under_voltage_V", "V"}, d.under_voltage_V, under_voltage_V, Base::voltage);
  w.threshold({"over_speed_rad_s", "rad/s"}, d.over_speed_rad_s, over_speed_rad_s, Base::speed);
  w.threshold({"stall_current_A", "A"}, d.stall_current_A, stall_current_A, Base::current);
  w.count({"stall_ticks", "", "control periods"}, d.stall_ticks, stall_ticks, unset.stall_ticks);
  w.count({"voltage_ticks", "", "control periods"}, d.voltage_ticks, voltage_ticks, unset.voltage_ticks);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::AlignConfig<double>& d, Kept& kept) {
  auto& [current_A, ticks, settled_ticks, sector] = kept;
  constexpr control::AlignConfig<double> unset{};
  w.threshold({"current_A", "A"}, d.current_A, current_A, Base::current);
  w.count({"ticks", "", "longest alignment in control periods"}, d.ticks, ticks, unset.ticks);
  w.count({"settled_ticks", "", "control periods for which the rotor must stay aligned"}, d.settled_ticks,
          settled_ticks, unset.settled_ticks);
  w.count({"sector"}, d.sector, sector, unset.sector);
}

/// Lists all fields except `drive`, which has its own list.
template <class Walk, class Kept>
void fields(Walk&& w, const control::ProtectedConfig<double>& d, Kept& kept) {
  auto& [drive, setpoint_limit, sensing, current_adc, bus_adc, shunt, hall, speed, position, advance, faults,
         align, brake_current_A, short_below_rad_s, standing_rad_s] = kept;
  constexpr AdcUse amperes{Base::current, "A"}, volts{Base::voltage, "V"};
  w.signal({"setpoint_limit"}, d.setpoint_limit, setpoint_limit, Base::setpoint);
  w.choice({.name = "sensing", .always = true}, d.sensing, sensing, control::CurrentSensing::phases);
  w.part("current_adc[0]", d.current_adc[0], current_adc[0], amperes);
  w.part("current_adc[1]", d.current_adc[1], current_adc[1], amperes);
  w.part("current_adc[2]", d.current_adc[2], current_adc[2], amperes);
  w.part("bus_adc", d.bus_adc, bus_adc, volts);
  w.part("shunt", d.shunt, shunt);
  w.part("hall", d.hall, hall);
  w.part("speed", d.speed, speed);
  if (w.when_run(d.drive.mode == control::Mode::position)) w.part("position", d.position, position);
  w.part("advance", d.advance, advance);
  w.part("faults", d.faults, faults);
  w.part("align", d.align, align);
  w.threshold({"brake_current_A", "A"}, d.brake_current_A, brake_current_A, Base::current);
  w.threshold({"short_below_rad_s", "rad/s"}, d.short_below_rad_s, short_below_rad_s, Base::speed);
  w.threshold({"standing_rad_s", "rad/s"}, d.standing_rad_s, standing_rad_s, Base::speed);
}

}  // namespace sixstep::design
