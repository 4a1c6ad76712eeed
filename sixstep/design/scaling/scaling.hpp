// SPDX-License-Identifier: Apache-2.0
// Computes which A, V, rad/s and degrees the fixed-point number 1.0 represents, and converts the drive's
// configuration to these units. For a given range of inputs, interval arithmetic proves that a value
// saturates only where saturation does not change the result.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/design/fields/field.hpp"

namespace sixstep::design {

/// Range of the inputs: largest magnitudes of measurements and setpoint. A larger input is an error of a
/// sensor or a user, and saturation is then the correct reaction.
struct OperatingRange {
  double current_A = 0.0;     ///< current of each phase: the ADC's range
  double speed_rad_s = 0.0;   ///< mechanical
  double position_deg = 0.0;  ///< mechanical; only in position mode
  double bus_V = 0.0;
  double setpoint = 0.0;  ///< largest setpoint, in the unit of the mode
  double speed_change_rad_s =
      0.0;  ///< change of the measured speed from one sample to the next; 0: any change within speed_rad_s
};

/// Bases: SI values of the number 1.0. Duties and fractions of torque have the base 1.
struct Bases {
  double current_A = 1.0;
  double voltage_V = 1.0;
  double speed_rad_s = 1.0;
  double position_deg = 1.0;
};

/// Base of the setpoint in a mode; 1 for a duty.
constexpr double setpoint_base(control::Mode mode, const Bases& b) {
  return mode == control::Mode::current    ? b.current_A
         : mode == control::Mode::speed    ? b.speed_rad_s
         : mode == control::Mode::position ? b.position_deg
                                           : 1.0;
}

/// Value of a field's base (design/fields) in SI units.
constexpr double value_of(Base base, control::Mode mode, const Bases& b) {
  switch (base) {
    case Base::one:
      return 1.0;
    case Base::current:
      return b.current_A;
    case Base::voltage:
      return b.voltage_V;
    case Base::speed:
      return b.speed_rad_s;
    case Base::position:
      return b.position_deg;
    case Base::setpoint:
      return setpoint_base(mode, b);
  }
  return 1.0;
}

/// Member of Bases that contains a field's base; empty if the field has no base.
constexpr std::string_view member_of(Base base, control::Mode mode) {
  switch (base) {
    case Base::one:
      return {};
    case Base::current:
      return "current_A";
    case Base::voltage:
      return "voltage_V";
    case Base::speed:
      return "speed_rad_s";
    case Base::position:
      return "position_deg";
    case Base::setpoint:
      return mode == control::Mode::current    ? "current_A"
             : mode == control::Mode::speed    ? "speed_rad_s"
             : mode == control::Mode::position ? "position_deg"
                                               : std::string_view();
  }
  return {};
}

/// The words with which a cure names the full scale of a member: "full scale current_A of 33.8".
inline std::string full_scale_words(std::string_view member, const std::string& value) {
  return "full scale " + std::string(member) + " of " + value;
}

/// One line of the proof: a quantity, its largest value, and the largest value that the format represents.
struct Headroom {
  std::string name;
  double largest = 0.0;     ///< SI
  double full_scale = 0.0;  ///< largest value that the format represents, in the unit of `largest`
};

template <class Scalar>
struct Scaled {
  control::DriveConfig<Scalar> config;
  Bases bases;
  std::vector<Headroom> proof;
};

/// The smallest bases with which every signal, and every difference of two signals, fits the format.
Bases bases_for(const control::DriveConfig<double>& drive, const OperatingRange& range, double full_scale);

/// Converts the drive to fixed point. Problems name the quantity that does not fit, or the gain that the
/// format cannot represent to its last bits, with the value and the limit of the range:
///   - a signal, a limit or a difference of signals beyond full scale;
///   - a gain above the mantissa's range, or so small that its mantissa loses bits;
///   - an integral gain for which an error of one digit has no effect (pi.hpp);
///   - an integral increment that could saturate its sum (above 14 of the sum's 16 ranges);
///   - a derivative and the integral after it, together beyond 14 ranges; an integral without a gain of
///     back-calculation.
/// Values that are immediately limited (products before a clamp, the proportional kick) may saturate, because
/// the clamp gives the same result. The template is instantiated for Q15, Q31 and the formats with one and
/// two bits before the point.
template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const control::DriveConfig<double>& drive, const OperatingRange& range,
                                    const Bases& bases);

/// Converts with the bases of bases_for().
template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const control::DriveConfig<double>& drive, const OperatingRange& range);

}  // namespace sixstep::design
