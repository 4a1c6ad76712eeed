// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/pulse_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

constexpr double clear = 2.0;     // required ratio of a signal to the level `certain`
constexpr double of_range = 0.9;  // largest current as a fraction of the converter's range; noise and
                                  // rounding then stay within the range
constexpr double most_turned =
    15.0;  // electrical degrees: a quarter of a sector costs 3 % of the ramp's torque
constexpr double tolerance = 0.125;  // fraction of the range: a larger offset means that an amplifier is
                                     // broken
constexpr double least_counts = 64;  // difference between source and sink; below it the chip reports an open
                                     // wire
constexpr double noises = 5.0;

/// Values from which the other values are computed.
struct Basis {
  const MotorModel& motor;
  const PulseSpec& spec;
  double R_tt, L_S, L_D, L_least, L_most, lsb_A, limit_A;
};

Basis basis_of(const MotorModel& motor, const PulseSpec& spec) {
  Basis b{motor,
          spec,
          2 * motor.machine.R_ohm,
          (spec.L_d_H + spec.L_q_H) / 2,
          (spec.L_d_H - spec.L_q_H) / 2,
          0.0,
          0.0,
          0.0,
          0.0};
  b.lsb_A = 2 * spec.current_range_A / static_cast<double>(1 << spec.adc_bits);
  b.limit_A = std::min(spec.most_A, of_range * (spec.current_range_A - std::fabs(spec.offset_A)));
  const bool saturates = spec.saturation_A > 0.0;
  if (saturates) b.limit_A = std::min(b.limit_A, base::root_3 / 2 * spec.saturation_A / 2);
  // The inductance is least with the largest current along the magnet, and greatest with this current against
  // the magnet.
  const double bent = saturates ? 2 / base::root_3 * b.limit_A / (2 * spec.saturation_A) : 0.0;
  b.L_least = std::min(spec.L_d_H * (1 - bent), spec.L_q_H);
  b.L_most = std::max(spec.L_d_H * (1 + bent), spec.L_q_H);
  return b;
}

/// Time from the begin of a pulse to its sample, s.
double time_s(const Basis& b, int ticks) { return (ticks - 0.5 - b.spec.delay_periods) * b.spec.period_s; }

double current_A(const Basis& b, double t_s, double L_H) {
  return b.spec.bus_V / b.R_tt * (1 - base::exp(-b.R_tt * t_s / (2 * L_H)));
}

/// Depth of the saturation, L_d i/(2 I_sat L_S), for a pair's current i along the magnet.
double depth(const Basis& b, double i_A) {
  return b.spec.saturation_A > 0.0 ? 2 / base::root_3 * b.spec.L_d_H * i_A / (2 * b.spec.saturation_A * b.L_S)
                                   : 0.0;
}

/// sigma of pulse_position.hpp, the standard deviation of a reading, in eighths of a count.
double noise_8(const Basis& b, const control::PulsePositionConfig& p) {
  const double of_reading = 8 * b.spec.noise_A / b.lsb_A;
  const double s2 = 2 * (of_reading * of_reading + 64.0 / 12.0);
  return std::sqrt(s2 / p.rounds + 3 * s2 / static_cast<double>(1 << p.current.log2_samples) + 45.0);
}

/// Upper bound of the angle by which the pulses turn the rotor, electrical degrees: the sum of the two parts
/// in the header.
double turned_deg(const Basis& b, const PulseStart& s, double t_s) {
  const double I = s.greatest_A, D = (s.pulses.pulse_ticks + s.pulses.rest_ticks) * b.spec.period_s;
  const double pairs = b.motor.machine.pole_pairs;
  const double P = base::pi / 3 * b.motor.K_t_Nm_A * I * t_s;
  // Impulse p |L_d - L_q| i^2 over a rising and a falling ramp of i, plus 2 m P cos^3 x sin x, which is at
  // most 3 sqrt 3/16 of 2 m P.
  const double P_e =
      pairs * std::fabs(2 * b.L_D) * I * I * 2 / 3 * t_s + 6 * base::root_3 / 16 * depth(b, I) * P;
  const double turned_rad = s.pulses.rounds * D / b.motor.shaft.J_kg_m2 * (2 * P + 12 * P_e);
  return turned_rad * pairs * 180 / base::pi;
}

double off_deg(const Basis& b, const PulseStart& s) {
  const double m = depth(b, s.current_A), saliency = std::fabs(b.L_D) / b.L_S;
  // In addition to the noise there is a second error. If the axis is measured, it is the part of saturation
  // in the second harmonic. Otherwise it is the effect of 1/I on cos^3 x, a tenth of the depth of saturation.
  const bool axis_seen = s.axis >= s.pulses.certain && 1000 * saliency > s.pulses.amplifiers;
  const double off_rad = axis_seen     ? (noises / s.axis + 3.0 / 32.0 * m * m / saliency) / 2
                         : s.north > 0 ? noises / s.north + m / 10
                                       : base::pi;
  return std::min(180.0, off_rad * 180 / base::pi);
}

PulseStart of_length(const Basis& b, int ticks) {
  PulseStart s;
  const double t_s = time_s(b, ticks), x = b.R_tt * t_s / (2 * b.L_S);
  s.pulses.current.offset_counts = static_cast<std::uint16_t>(1 << (b.spec.adc_bits - 1));
  s.pulses.current.offset_tolerance =
      static_cast<std::uint16_t>(tolerance * static_cast<double>(1 << (b.spec.adc_bits - 1)));
  s.pulses.pulse_ticks = static_cast<std::uint16_t>(ticks);
  s.pulses.rest_ticks = static_cast<std::uint16_t>(ticks + 1);  // long enough: the current falls faster than
                                                                // it rose
  s.current_A = current_A(b, t_s, b.L_S);
  s.greatest_A = current_A(b, t_s, b.L_least);
  const double k = x / (base::exp(x) - 1);
  const double read_A = std::max(0.0, s.current_A * (1 - b.spec.late_s / t_s));
  const double of_noise = base::root_3 * k * (2 * read_A / b.lsb_A * 8) / noise_8(b, s.pulses);
  s.north = 0.75 * depth(b, s.current_A) * of_noise;
  s.axis = std::fabs(b.L_D) / b.L_S * of_noise;
  s.off_deg = off_deg(b, s);
  s.turned_deg = turned_deg(b, s, t_s);
  const int apart = ticks + s.pulses.rest_ticks;
  s.lasts_s = ((1 << s.pulses.current.log2_samples) + 6.0 * s.pulses.rounds * apart) * b.spec.period_s;
  return s;
}

double least_read_counts(const Basis& b, int ticks) {
  const double t_s = time_s(b, ticks);
  return 2 * current_A(b, t_s, b.L_most) * (1 - b.spec.late_s / t_s) / b.lsb_A;
}

bool allowed(const Basis& b, const PulseStart& s, int ticks) {
  return s.greatest_A <= b.limit_A && s.turned_deg <= most_turned && b.R_tt * time_s(b, ticks) <= 2 * b.L_S;
}

bool enough(const Basis& b, const PulseStart& s, int ticks) {
  const double wanted = clear * s.pulses.certain;
  return s.north >= wanted && (b.L_D == 0.0 || s.axis >= wanted) &&
         least_read_counts(b, ticks) >= clear * least_counts;
}

base::Problem too_strong(const Basis& b, const PulseStart& s) {
  const PulseSpec& spec = b.spec;
  const std::string makes = "makes pulses of " + base::rounded(s.greatest_A, 3) + " A";
  if (s.greatest_A <= b.limit_A)
    return {"period_s", base::rounded(spec.period_s, 4),
            "makes the pulses too long: the pulses turn the rotor by " + base::rounded(s.turned_deg, 3) +
                " electrical degrees, or last longer than 2 L/R",
            "shorten period_s, or set starts_by = alignment"};
  if (b.limit_A == spec.most_A)
    return {"overload", "", "allows " + base::rounded(b.limit_A, 3) + " A, and one control period " + makes,
            "raise overload, shorten period_s, or set starts_by = alignment"};
  if (spec.saturation_A > 0.0 && b.limit_A == base::root_3 / 2 * spec.saturation_A / 2)
    return {"period_s", base::rounded(spec.period_s, 4),
            makes + ", and the model of saturation holds up to " + base::rounded(b.limit_A, 3) + " A",
            "shorten period_s, or set starts_by = alignment"};
  return {"current_range_A", base::rounded(spec.current_range_A, 4),
          "is exceeded: one control period " + makes,
          "raise current_range_A, shorten period_s, or set starts_by = alignment"};
}

base::Problems problems_of(const MotorModel& motor, const PulseSpec& spec) {
  base::Problems problems;
  const auto above_0 = [&](const char* where, double x, const char* cure) {
    if (!(x > 0.0)) problems.push_back({where, base::rounded(x, 4), "must be above 0", cure});
  };
  above_0("bus_V", spec.bus_V, "give the voltage of the bus");
  above_0("period_s", spec.period_s, "give the control period");
  above_0("current_range_A", spec.current_range_A, "give the current at the converter's full scale");
  if (spec.adc_bits < 6 || spec.adc_bits > 16)
    problems.push_back(
        {"adc_bits", std::to_string(spec.adc_bits), "must be 6 to 16", "set adc_bits to 6 to 16"});
  if (!(motor.shaft.J_kg_m2 > 0.0) || !(motor.machine.R_ohm > 0.0) || !(spec.L_d_H > 0.0) ||
      !(spec.L_q_H > 0.0))
    problems.push_back({"motor", "", "must have resistance, inductance and inertia",
                        "give resistance_ohm, inductance_mH and inertia_gcm2 in the motor file"});
  return problems;
}

std::vector<DerivationStep> steps_of(const Basis& b, const PulseStart& s) {
  return {{"t_pulse", "(n - 1/2) T", time_s(b, s.pulses.pulse_ticks), "s"},
          {"I_pulse", "U/R (1 - exp(-R t/2 L_S))", s.current_A, "A"},
          {"I_max", "U/R (1 - exp(-R t/2 L_least))", s.greatest_A, "A"},
          {"north", "(3/4) m k sqrt 3 I_0/sigma, 6 is certain", s.north, ""},
          {"axis", "(|L_D|/L_S) k sqrt 3 I_0/sigma", s.axis, ""},
          {"off", "(5/axis + 3 m^2/32 L_S/|L_D|)/2, or 5/north + m/10", s.off_deg, "deg"},
          {"turned", "8 D p (2 P + 12 P_e)/J, at most", s.turned_deg, "deg"},
          {"pulses", "64 + 48 (2 n + 1) periods", s.lasts_s, "s"}};
}

}  // namespace

base::Result<PulseStart> pulse_start(const MotorModel& motor, const PulseSpec& spec) {
  if (base::Problems problems = problems_of(motor, spec); !problems.empty()) return problems;
  const Basis b = basis_of(motor, spec);
  const int shortest = 1 + spec.delay_periods, longest = std::numeric_limits<std::int16_t>::max();
  PulseStart out = of_length(b, shortest);
  if (!allowed(b, out, shortest)) return too_strong(b, out);
  int ticks = shortest;
  while (!enough(b, out, ticks) && ticks < longest) {
    PulseStart longer = of_length(b, ticks + 1);
    if (!allowed(b, longer, ticks + 1)) break;
    out = std::move(longer);
    ++ticks;
  }
  if (least_read_counts(b, ticks) < least_counts)
    return base::Problem{"current_range_A", base::rounded(spec.current_range_A, 4),
                         "is too wide to measure pulses of " + base::rounded(out.current_A, 3) + " A",
                         "lower current_range_A, raise adc_bits, or set starts_by = alignment"};
  out.steps = steps_of(b, out);
  return out;
}

}  // namespace sixstep::design
