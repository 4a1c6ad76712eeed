// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/arithmetic.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/study/choices.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

double largest_reference(const Scenario& s) {
  double largest = 0.0;
  for (const Level& level : reference_levels(s.reference, s.duration_s))
    largest = std::max(largest, std::fabs(level.value));
  return largest;
}

double unit_of_setpoint(Mode mode, const design::Bases& b) {
  return mode == Mode::current    ? b.current_A
         : mode == Mode::speed    ? b.speed_rad_s
         : mode == Mode::position ? b.position_deg
                                  : 1.0;
}

/// A full scale that a file names, as the base of a format: what 1.0 means.
template <class Scalar>
design::Bases chosen_bases(const FullScale& chosen, design::Bases bases) {
  constexpr int before_the_point =
      control::detail::Widths<typename Scalar::Storage>::bits - 1 - Scalar::fraction_bits;
  const auto take = [&](double& base, const std::optional<double>& full_scale) {
    if (full_scale) base = std::ldexp(*full_scale, -before_the_point);
  };
  take(bases.current_A, chosen.current_A);
  take(bases.voltage_V, chosen.voltage_V);
  take(bases.speed_rad_s, chosen.speed_rad_s);
  take(bases.position_deg, chosen.position_deg);
  return bases;
}

/// The proof speaks of the drive's quantities; a reader knows the scenario's keys.
base::Problems under_the_key(const Scenario& s, const base::Problems& problems) {
  const std::string word(base::word(arithmetic_choices, s.control.arithmetic));
  base::Problems out;
  for (const base::Problem& p : problems)
    out.push_back({"control.arithmetic", "\"" + word + "\"",
                   "cannot hold this drive: " + p.where + " = " + p.value + " " + p.limit,
                   p.cure + " (bases: control.full_scale)"});
  return out;
}

/// Speed from captured edges (hall_speed.hpp): (pi/3)/p f_timer k is a wide number of the format's digits.
template <class Scalar>
base::Problems unheld_speed(const Scenario& s, const Compiled& c, const design::Bases& b) {
  if (s.sensors.rotor != RotorSensing::hall) return {};
  using Wide = typename Scalar::WideInt;
  const double ratio = base::pi / 3 / c.motor.machine.pole_pairs * s.sensors.capture_Hz;
  const double digits =
      ratio * s.sensors.speed_edges / b.speed_rad_s / static_cast<double>(Scalar::from_raw(1));
  const double most = static_cast<double>(control::detail::greatest<Wide>);
  if (digits <= most) return {};
  return {{"sensors.capture_Hz", base::written(s.sensors.capture_Hz),
           "times speed_edges is " + base::written(digits / most) + " times what the format's sum holds",
           "take a slower timer, fewer edges, or a 32-bit format"}};
}

}  // namespace

design::OperatingRange operating_range(const Scenario& s, const Compiled& c) {
  const double U = std::max(s.supply.voltage_V, c.start.bus_V), K_t = c.motor.K_t_Nm_A;
  const double asked = largest_reference(s);
  design::OperatingRange range;
  range.bus_V = std::max(U, s.control.regeneration.limit_V.value_or(0.0));
  range.setpoint = asked;
  range.speed_rad_s = std::max(U / K_t, std::fabs(c.start.speed_rad_s));
  range.position_deg = std::max(asked, std::fabs(c.start.angle_rad) * 180.0 / base::pi);
  const double drivable = (U + K_t * range.speed_rad_s) / (2 * c.motor.machine.R_ohm);
  const Mode mode = s.control.mode;
  const bool has_reference = mode == Mode::current || mode == Mode::speed || mode == Mode::position;
  const double reference = mode == Mode::current ? asked : c.drive.current_limit_A;
  range.current_A = has_reference && reference > 0 ? std::min(2 * reference, drivable) : drivable;
  return range;
}

template <class Scalar>
base::Result<DriveIn<Scalar>> drive_in(const Scenario& s, const Compiled& c) {
  if constexpr (std::is_arithmetic_v<Scalar>) {
    return DriveIn<Scalar>{in_arithmetic<Scalar>(c.drive), {}};
  } else {
    const design::OperatingRange range = operating_range(s, c);
    const design::Bases needed = design::bases_for(c.drive, range, static_cast<double>(Scalar::max()));
    const auto scaled =
        design::scaled<Scalar>(c.drive, range, chosen_bases<Scalar>(s.control.full_scale, needed));
    if (!scaled) return under_the_key(s, scaled.problems());
    const design::Bases& b = scaled->bases;
    if (base::Problems problems = unheld_speed<Scalar>(s, c, b); !problems.empty()) return problems;
    return DriveIn<Scalar>{
        scaled->config,
        {b.current_A, b.voltage_V, b.speed_rad_s, b.position_deg, unit_of_setpoint(s.control.mode, b)}};
  }
}

template base::Result<DriveIn<double>> drive_in(const Scenario&, const Compiled&);
template base::Result<DriveIn<float>> drive_in(const Scenario&, const Compiled&);
template base::Result<DriveIn<control::Q15>> drive_in(const Scenario&, const Compiled&);
template base::Result<DriveIn<control::Q31>> drive_in(const Scenario&, const Compiled&);
template base::Result<DriveIn<control::Q14>> drive_in(const Scenario&, const Compiled&);
template base::Result<DriveIn<control::Q30>> drive_in(const Scenario&, const Compiled&);

}  // namespace sixstep::study
