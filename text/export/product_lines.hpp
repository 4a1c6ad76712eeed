// SPDX-License-Identifier: Apache-2.0
// What the product drive has around its loops (protected_drive.hpp), as C++ assignments.
#pragma once
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/export/config_text.hpp"

namespace text {

namespace detail {

/// The last bit of a fixed format, in which gains of counts give their answer (adc.hpp, hall_speed.hpp).
template <class Scalar>
double raw_unit() {
  if constexpr (ConfigText<Scalar>::fixed)
    return static_cast<double>(Scalar::from_raw(1));
  else
    return 1.0;
}

template <class Scalar>
void adc_lines(ConfigText<Scalar>& t, const std::string& member, const sixstep::control::AdcConfig<double>& d,
               const sixstep::control::AdcConfig<Scalar>& k, double base, const std::string& unit) {
  const sixstep::control::AdcConfig<Scalar> unset{};
  t.gain(member + ".per_eighth", k.per_eighth, d.per_eighth, base * raw_unit<Scalar>(), unit,
         "per eighth of a count");
  t.count(member + ".offset_counts", k.offset_counts, unset.offset_counts);
  t.count(member + ".offset_tolerance", k.offset_tolerance, unset.offset_tolerance, "counts");
  t.count(member + ".log2_samples", k.log2_samples, unset.log2_samples);
}

template <class Scalar>
void sensing_lines(ConfigText<Scalar>& t, const sixstep::control::ProtectedConfig<double>& d,
                   const sixstep::control::ProtectedConfig<Scalar>& k) {
  using sixstep::control::CurrentSensing;
  const sixstep::design::Bases& b = t.bases();
  const bool one_shunt = k.sensing == CurrentSensing::one_shunt;
  t.line("sensing", one_shunt ? "CurrentSensing::one_shunt" : "CurrentSensing::phases", "");
  for (std::size_t n = 0; n < 3; ++n)
    adc_lines(t, fmt::format("current_adc[{}]", n), d.current_adc[n], k.current_adc[n], b.current_A, "A");
  adc_lines(t, "bus_adc", d.bus_adc, k.bus_adc, b.voltage_V, "V");
  t.number("shunt.least_duty", literal(k.shunt.least_duty), d.shunt.least_duty,
           static_cast<double>(k.shunt.least_duty), "", "above it a sample shows the current");
  t.count("shunt.commutation_samples", k.shunt.commutation_samples, 0);
  t.signal("shunt.fade", k.shunt.fade, d.shunt.fade, 1.0, "", "of a hidden current, per tick");
}

template <class Scalar>
void hall_lines(ConfigText<Scalar>& t, const sixstep::control::ProtectedConfig<double>& d,
                const sixstep::control::ProtectedConfig<Scalar>& k) {
  const sixstep::design::Bases& b = t.bases();
  t.count("hall.stable_samples", k.hall.stable_samples, 1, "samples in a row");
  double ticks = d.speed.sector_rad_s_ticks;
  if constexpr (ConfigText<Scalar>::fixed)
    ticks = static_cast<double>(k.speed.sector_rad_s_ticks.raw) * raw_unit<Scalar>() * b.speed_rad_s;
  t.number("speed.sector_rad_s_ticks", literal(k.speed.sector_rad_s_ticks), d.speed.sector_rad_s_ticks, ticks,
           "rad/s", "times the ticks of a sector");
  t.count("speed.timeout_ticks", k.speed.timeout_ticks, 0, "of the timer: it stands");
  t.count("speed.edges", k.speed.edges, 1);
  t.count("speed.window_ticks", k.speed.window_ticks, 0, "of the timer: longer, and one edge is taken");
  t.count("speed.grain_ticks", k.speed.grain_ticks, 1, "of the timer: to so many an edge's time is known");
  t.gain("position.per_sector", k.position.per_sector, d.position.per_sector,
         b.position_deg * raw_unit<Scalar>(), "deg");
  t.gain("position.per_fraction", k.position.per_fraction, d.position.per_fraction, b.position_deg, "deg");
  t.signal("advance.fixed", k.advance.fixed, d.advance.fixed, 1.0, "sectors of 60 electrical degrees");
  t.gain("advance.per_speed", k.advance.per_speed, d.advance.per_speed, 1 / b.speed_rad_s,
         "sectors per rad/s");
  t.signal("advance.limit", k.advance.limit, d.advance.limit, 1.0, "sectors");
}

template <class Scalar>
void fault_lines(ConfigText<Scalar>& t, const sixstep::control::FaultConfig<double>& d,
                 const sixstep::control::FaultConfig<Scalar>& k) {
  const sixstep::design::Bases& b = t.bases();
  t.signal("faults.over_current_A", k.over_current_A, d.over_current_A, b.current_A, "A");
  t.signal("faults.over_voltage_V", k.over_voltage_V, d.over_voltage_V, b.voltage_V, "V");
  t.signal("faults.under_voltage_V", k.under_voltage_V, d.under_voltage_V, b.voltage_V, "V");
  t.signal("faults.over_speed_rad_s", k.over_speed_rad_s, d.over_speed_rad_s, b.speed_rad_s, "rad/s");
  t.signal("faults.stall_current_A", k.stall_current_A, d.stall_current_A, b.current_A, "A");
  t.count("faults.stall_ticks", k.stall_ticks, 0, "control periods");
  t.count("faults.voltage_ticks", k.voltage_ticks, 1, "control periods");
}

template <class Scalar>
void activity_lines(ConfigText<Scalar>& t, const sixstep::control::ProtectedConfig<double>& d,
                    const sixstep::control::ProtectedConfig<Scalar>& k) {
  const sixstep::design::Bases& b = t.bases();
  t.signal("align.current_A", k.align.current_A, d.align.current_A, b.current_A, "A");
  t.count("align.ticks", k.align.ticks, 0, "control periods at most");
  t.count("align.settled_ticks", k.align.settled_ticks, 0, "control periods in place");
  t.count("align.sector", k.align.sector, 0);
  t.signal("brake_current_A", k.brake_current_A, d.brake_current_A, b.current_A, "A");
  t.signal("short_below_rad_s", k.short_below_rad_s, d.short_below_rad_s, b.speed_rad_s, "rad/s");
  t.signal("standing_rad_s", k.standing_rad_s, d.standing_rad_s, b.speed_rad_s, "rad/s");
}

}  // namespace detail

/// All but `drive`. `designed` in SI beside `kept` in the target's arithmetic.
template <class Scalar>
std::string product_lines(const sixstep::control::ProtectedConfig<double>& d,
                          const sixstep::control::ProtectedConfig<Scalar>& k,
                          const sixstep::design::Bases& b) {
  ConfigText<Scalar> t(b);
  const sixstep::control::Mode mode = d.drive.mode;
  t.signal("setpoint_limit", k.setpoint_limit, d.setpoint_limit, sixstep::design::setpoint_base(mode, b),
           sixstep::study::reference_unit(mode));
  detail::sensing_lines(t, d, k);
  detail::hall_lines(t, d, k);
  detail::fault_lines(t, d.faults, k.faults);
  detail::activity_lines(t, d, k);
  return t.text();
}

}  // namespace text
