// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/arithmetic.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/fields/estimator_fields.hpp"
#include "sixstep/design/fields/product_fields.hpp"
#include "sixstep/design/fields/sensorless_fields.hpp"
#include "sixstep/design/loops/limit_bounds.hpp"
#include "sixstep/design/scaling/fixed_formats.hpp"
#include "sixstep/design/scaling/observer_scaling.hpp"
#include "sixstep/design/scaling/scaling_proof.hpp"
#include "sixstep/design/scaling/sensorless_scaling.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/timeline.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

/// The bases of the drive's numbers. A base is the physical value that the number 1.0 represents. A full
/// scale of the scenario is the physical value of the format's largest number; the base follows from it.
template <class Scalar>
design::Bases bases_of(const Scenario& s, const Compiled& c, const design::OperatingRange& range) {
  const double greatest = static_cast<double>(Scalar::max());
  design::Bases bases = c.sensorless ? design::bases_for(c.sensorless->drive, range, greatest)
                                     : design::bases_for(c.drive, range, greatest);
  constexpr double below_the_end = 1 + 1e-3;  // a threshold equal to full scale would never be exceeded
  if (c.product)
    bases.speed_rad_s =
        std::max(bases.speed_rad_s, c.product->faults.over_speed_rad_s * below_the_end / greatest);
  const FullScale& chosen = s.control.full_scale;
  const auto take = [](double& base, const std::optional<double>& full_scale) {
    if (full_scale) base = *full_scale / design::detail::scale_per_base<Scalar>;
  };
  take(bases.current_A, chosen.current_A);
  take(bases.voltage_V, chosen.voltage_V);
  take(bases.speed_rad_s, chosen.speed_rad_s);
  take(bases.position_deg, chosen.position_deg);
  return bases;
}

/// A cure with the scenario's keys in place of the members of design::Bases.
std::string with_keys(std::string cure) {
  constexpr std::string_view words = "full scale ", key = "control.full_scale.";
  if (const std::size_t at = cure.find(words); at != std::string::npos) {
    const std::size_t begin = at >= 2 && cure.compare(at - 2, 2, "a ") == 0 ? at - 2 : at;
    return cure.replace(begin, at + words.size() - begin, key);
  }
  return cure.find("base") == std::string::npos ? cure : cure + " (bases: control.full_scale)";
}

/// Renames problems: the proof names the drive's quantities, but a user's file has the scenario's keys.
base::Problems under_the_key(const Scenario& s, const base::Problems& problems) {
  const std::string word(base::word(arithmetic_choices, s.control.arithmetic));
  base::Problems out;
  for (const base::Problem& p : problems)
    out.push_back({"control.arithmetic", "\"" + word + "\"",
                   "cannot represent this drive: " + p.where + " = " + p.value + " " + p.limit,
                   with_keys(p.cure)});
  return out;
}

std::string shortest(double x, base::Towards towards) {
  return base::written(base::shortened(x, 4, towards));
}

/// Checks the speed from captured edges (hall_speed.hpp): the factor (pi/3)/p f_timer k must fit into the
/// format's wide integer. p: pole pairs, f_timer: capture_Hz, k: sectors over which the speed is averaged.
template <class Scalar>
base::Problems unheld_speed(const Scenario& s, const Compiled& c, const design::Bases& b) {
  if (s.sensors.rotor != RotorSensing::hall) return {};
  using Wide = typename Scalar::WideInt;
  const double ratio = base::pi / 3 / c.believed.motor.machine.pole_pairs * s.sensors.capture_Hz;
  // With an angle between the edges the speed is measured over six sectors, whatever speed_edges is.
  const int sectors = s.sensors.hall_angle == rig::HallAngleFrom::sectors ? c.board.sensors.edges : 6;
  const double digits = ratio * sectors / b.speed_rad_s / static_cast<double>(Scalar::from_raw(1));
  const double most = static_cast<double>(control::detail::greatest<Wide>);
  if (digits <= most) return {};
  return {{"sensors.capture_Hz", base::written(s.sensors.capture_Hz),
           "times speed_edges is " + base::rounded(digits / most, 4) + " times the range of the format's sum",
           "use a timer of " + shortest(s.sensors.capture_Hz * most / digits, base::Towards::down) +
               " Hz or less, control.full_scale.speed_rad_s of " +
               shortest(design::detail::scale_per_base<Scalar> * b.speed_rad_s * digits / most,
                        base::Towards::up) +
               " or more, fewer edges, or a 32-bit format"}};
}

rig::Bases units_of(Mode mode, const design::Bases& b) {
  return {b.current_A, b.voltage_V, b.speed_rad_s, b.position_deg, design::setpoint_base(mode, b)};
}

/// Largest change of the measured speed from one sample to the next, rad/s, if all torques act in the same
/// direction. 0: no bound is known, because without an ideal sensor the measured speed can jump at an edge.
double fastest_change_of_speed(const Scenario& s, const Compiled& c, const design::OperatingRange& range) {
  if (s.sensors.rotor != RotorSensing::ideal || c.sensorless) return 0.0;
  double load = std::fabs(s.load.torque_Nm);
  for (const double torque : s.load.torques_Nm) load = std::max(load, std::fabs(torque));
  for (const At& at : s.at) load = std::max(load, std::fabs(at.load.torque_Nm.value_or(0.0)));
  const double friction = plant::friction_Nm(c.believed.shaft, range.speed_rad_s);
  const double own = design::torque_per_A(c.believed.motor.machine) * range.current_A;
  return (own + load + friction) / c.believed.shaft.J_kg_m2 * s.pwm.period_s;
}

template <class Scalar>
control::ProtectedConfig<Scalar> product_in_float(const control::ProtectedConfig<double>& c) {
  control::ProtectedConfig<Scalar> out;
  out.drive = in_arithmetic<Scalar>(c.drive);
  design::fields(design::AsFloat{}, c, out);
  return out;
}

template <class Scalar>
control::SensorlessDriveConfig<Scalar> sensorless_in_float(const control::SensorlessDriveConfig<double>& c) {
  control::SensorlessDriveConfig<Scalar> out;
  out.drive = in_arithmetic<Scalar>(c.drive);
  out.observer = design::observer_in<Scalar>(c.observer, {});
  design::fields(design::AsFloat{}, c, out);
  return out;
}

}  // namespace

template <class Scalar>
control::DriveConfig<Scalar> in_arithmetic(const control::DriveConfig<double>& c) {
  control::DriveConfig<Scalar> out;
  design::fields(design::AsFloat{}, c, out);
  return out;
}
template control::DriveConfig<float> in_arithmetic(const control::DriveConfig<double>&);
template control::DriveConfig<double> in_arithmetic(const control::DriveConfig<double>&);

design::OperatingRange operating_range(const Scenario& s, const Compiled& c) {
  const double U = std::max(highest_supply_V(s), c.start.bus_V), K_t = c.believed.motor.K_t_Nm_A;
  const double asked = largest_reference(s);
  design::OperatingRange range;
  range.bus_V = std::max(U, s.control.regeneration.limit_V.value_or(0.0));
  range.setpoint = asked;
  range.speed_rad_s = std::max(U / K_t, std::fabs(c.start.speed_rad_s));
  range.position_deg = std::max(asked, std::fabs(c.start.angle_rad) * 180.0 / base::pi);
  const double drivable = (U + K_t * range.speed_rad_s) / (2 * c.believed.motor.machine.R_ohm);
  const Mode mode = s.control.mode;
  const bool has_reference = mode == Mode::current || mode == Mode::speed || mode == Mode::position;
  const double reference = mode == Mode::current ? asked : c.drive.current_limit_A;
  range.current_A = has_reference && reference > 0 ? std::min(2 * reference, drivable) : drivable;
  if (c.sensorless)
    range.current_A =
        std::min(std::max(range.current_A, 2 * c.sensorless->drive.sensorless.start.current_A), drivable);
  range.speed_change_rad_s = fastest_change_of_speed(s, c, range);
  if (!c.product) return range;
  range.current_A = c.board.sensors.current.range;
  range.bus_V = c.board.sensors.bus.range;
  range.speed_rad_s = std::max(range.speed_rad_s, c.product->faults.over_speed_rad_s);
  return range;
}

design::OperatingRange least_range(const Scenario& s, const Compiled& c) {
  design::OperatingRange least = operating_range(s, c);
  if (c.product) return least;
  const double asked = least.setpoint;
  const Mode mode = s.control.mode;
  least.current_A = mode == Mode::current ? asked : c.drive.current_limit_A;
  if (c.sensorless)
    least.current_A = std::max(least.current_A, c.sensorless->drive.sensorless.start.current_A);
  least.speed_rad_s = std::max(mode == Mode::speed ? asked : 0.0, std::fabs(c.start.speed_rad_s));
  return least;
}

template <class Scalar>
base::Result<DriveIn<Scalar>> drive_in(const Scenario& s, const Compiled& c) {
  if constexpr (std::is_arithmetic_v<Scalar>) {
    return DriveIn<Scalar>{in_arithmetic<Scalar>(c.drive), {}};
  } else {
    const design::OperatingRange range = operating_range(s, c);
    const auto scaled = design::scaled<Scalar>(c.drive, range, bases_of<Scalar>(s, c, range));
    if (!scaled) return under_the_key(s, scaled.problems());
    const design::Bases& b = scaled->bases;
    if (base::Problems problems = unheld_speed<Scalar>(s, c, b); !problems.empty()) return problems;
    return DriveIn<Scalar>{scaled->config, units_of(s.control.mode, b)};
  }
}

template <class Scalar>
base::Result<ProductIn<Scalar>> product_in(const Scenario& s, const Compiled& c) {
  if constexpr (std::is_arithmetic_v<Scalar>) {
    return ProductIn<Scalar>{product_in_float<Scalar>(*c.product), {}};
  } else {
    const design::OperatingRange range = operating_range(s, c);
    const auto scaled =
        design::scaled_product<Scalar>(*c.product, range, bases_of<Scalar>(s, c, range), s.sensors.adc_bits);
    if (!scaled) return under_the_key(s, scaled.problems());
    return ProductIn<Scalar>{scaled->config, units_of(s.control.mode, scaled->bases)};
  }
}

template <class Scalar>
base::Result<SensorlessIn<Scalar>> sensorless_in(const Scenario& s, const Compiled& c) {
  if constexpr (std::is_arithmetic_v<Scalar>) {
    return SensorlessIn<Scalar>{{sensorless_in_float<Scalar>(c.sensorless->drive), c.sensorless->pulses}, {}};
  } else {
    const design::OperatingRange range = operating_range(s, c);
    const auto scaled =
        design::scaled_sensorless<Scalar>(c.sensorless->drive, range, bases_of<Scalar>(s, c, range));
    if (!scaled) return under_the_key(s, scaled.problems());
    if (base::Problems problems = unheld_speed<Scalar>(s, c, scaled->bases); !problems.empty())
      return problems;
    return SensorlessIn<Scalar>{{scaled->config, c.sensorless->pulses},
                                units_of(s.control.mode, scaled->bases)};
  }
}

template <class Scalar>
base::Result<FieldIn<Scalar>> field_in(const Compiled& c) {
  FieldIn<Scalar> out;
  out.config.field.drive = in_arithmetic<Scalar>(c.field->drive);
  design::fields(design::AsFloat{}, *c.field, out.config.field);
  design::fields(design::AsFloat{}, c.estimator, out.config.estimator);
  return out;
}

template base::Result<FieldIn<double>> field_in(const Compiled&);
template base::Result<FieldIn<float>> field_in(const Compiled&);
// NOLINTBEGIN(bugprone-macro-parentheses): a type in parentheses is no type
#define SIXSTEP_DRIVES_IN(Scalar)                                                              \
  template base::Result<SensorlessIn<Scalar>> sensorless_in(const Scenario&, const Compiled&); \
  template base::Result<ProductIn<Scalar>> product_in(const Scenario&, const Compiled&);       \
  template base::Result<DriveIn<Scalar>> drive_in(const Scenario&, const Compiled&);
// NOLINTEND(bugprone-macro-parentheses)
#define SIXSTEP_DRIVES_IN_FIXED(Format) SIXSTEP_DRIVES_IN(control::Format)
SIXSTEP_DRIVES_IN(double)
SIXSTEP_DRIVES_IN(float)
SIXSTEP_FIXED_FORMATS(SIXSTEP_DRIVES_IN_FIXED)
#undef SIXSTEP_DRIVES_IN_FIXED
#undef SIXSTEP_DRIVES_IN

}  // namespace sixstep::study
