// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/parameters.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

using base::Problems;
using base::Quantity;
using base::written;

constexpr double milli = 1e3;  // how many of the printed unit make one
constexpr double gcm2 = 1e7;

/// A printed number over a power of ten, as the double nearest to the decimal quotient: 0.572 mH becomes
/// 0.000572 and 135 g cm^2 1.35e-5, to the bit, as if they had been written so. The digits as an integer over
/// one exact power of ten are rounded once; dividing 0.572 itself would round twice.
double over(double printed, double unit) {
  double scale = 1.0;
  for (int decimals = 0; decimals <= 9; ++decimals, scale *= 10.0) {
    const double digits = std::floor(printed * scale + 0.5);
    if (digits < 0x1p53 && digits / scale == printed) return digits / (scale * unit);
  }
  return printed / unit;
}

double rad_s_from_rpm(double rpm) { return rpm * base::pi / 30.0; }

/// Reads numbers off the sheet and notes whatever is wrong with them.
struct Reader {
  Problems problems;

  void expect(bool holds, std::string_view where, double value, std::string_view limit,
              std::string_view cure) {
    if (!holds)
      problems.push_back({std::string(where), written(value), std::string(limit), std::string(cure)});
  }
  double positive(std::string_view key, double value, std::string_view cure, double unit = 1.0) {
    expect(base::above(0.0).holds(value), key, value, "must be above 0", cure);
    return over(value, unit);
  }
  double not_negative(std::string_view key, double value, std::string_view cure, double unit = 1.0) {
    expect(base::from(0.0).holds(value), key, value, "must not be negative", cure);
    return over(value, unit);
  }
  /// Star equivalent of a winding's value: half of what is measured between two terminals.
  double per_phase(std::string_view key, const Quantity& q, std::string_view cure, double unit = 1.0) {
    const double value = positive(key, q.value, cure, unit);
    if (q.frame != "terminal" && q.frame != "phase")
      problems.push_back({std::string(key), q.frame.empty() ? "without a frame" : "frame \"" + q.frame + "\"",
                          "must say what it is measured between",
                          "write frame = \"terminal\" (between two terminals, as most sheets) or \"phase\""});
    return q.frame == "phase" ? value : value / 2.0;
  }
  void only_frame(std::string_view key, const std::optional<Quantity>& q, std::string_view frame) {
    if (q && !q->frame.empty() && q->frame != frame)
      problems.push_back({std::string(key), "frame \"" + q->frame + "\"", "is meant as " + std::string(frame),
                          "convert the value and write frame = \"" + std::string(frame) + "\""});
  }
};

/// Mean of f_p - f_n over a sector for peak 1 (MODEL 1): torque per ampere of the driven pair over K_e.
/// By symmetry twice the mean of one phase's shape over 60 degrees from the middle of its top.
/// Trapezoid with ramps through zero at 90 degrees, h = 90 - w/2 from top to zero:
///   w >= 120:  2
///   w < 120:   (2/60) (w/2 + integral of (90 - x)/h over w/2..60) = (90 - h/2 - 450/h)/30
/// Sine: (6/pi) sin 60 = 3 sqrt(3)/pi = 1.65399
double sector_mean(BackEmfShape shape, double flat_deg) {
  if (shape == BackEmfShape::sine) return 3.0 * std::sqrt(3.0) / base::pi;
  if (flat_deg >= 120.0) return 2.0;
  const double h = 90.0 - flat_deg / 2.0;
  return (90.0 - h / 2.0 - 450.0 / h) / 30.0;
}

struct Constants {
  double K_e_V_s = 0.0;
  double K_t_Nm_A = 0.0;
};

/// The two constants from whichever is given; both given must agree, for they are one fact.
Constants constants(const Sheet& sheet, Reader& reader) {
  const double mean = sector_mean(sheet.back_emf, sheet.flat_deg);
  const std::optional<Quantity>&torque = sheet.torque_constant_mNm_A, &emf = sheet.back_emf_mV_s;
  reader.only_frame("torque_constant_mNm_A", torque, "terminal");
  reader.only_frame("back_emf_mV_s", emf, "phase");
  if (!torque && !emf) {
    reader.problems.push_back(
        {"torque_constant_mNm_A", "", "is missing",
         "give it (torque per ampere through the driven pair) or back_emf_mV_s (a phase's peak)"});
    return {};
  }
  Constants c;
  if (torque) {
    c.K_t_Nm_A =
        reader.positive("torque_constant_mNm_A", torque->value, "give the torque constant in mNm/A", milli);
    c.K_e_V_s = c.K_t_Nm_A / mean;
  }
  if (emf) {
    const double implied = c.K_e_V_s;
    c.K_e_V_s =
        reader.positive("back_emf_mV_s", emf->value, "give a phase's peak EMF in mV per rad/s", milli);
    if (!torque) c.K_t_Nm_A = c.K_e_V_s * mean;
    const bool agree = !torque || std::abs(c.K_e_V_s - implied) <= 1e-6 * implied;
    reader.expect(agree, "back_emf_mV_s", emf->value,
                  "contradicts torque_constant_mNm_A, which means " + written(implied * milli),
                  "give only one of the two");
  }
  return c;
}

/// The no-load point pays for all friction: K_t I_0 = T_c + B w_0.
double default_viscous(const MotorModel& m, Reader& reader) {
  if (m.no_load_speed_rad_s <= 0.0) return 0.0;
  const double loss_Nm = m.K_t_Nm_A * m.no_load_current_A;
  if (loss_Nm == 0.0) return 0.0;
  reader.expect(!(m.shaft.coulomb_Nm > loss_Nm), "coulomb_friction_mNm", m.shaft.coulomb_Nm * milli,
                "exceeds the loss at no load, K_t I_0 = " + written(loss_Nm * milli) + " mNm",
                "lower it, or give viscous_friction_Nm_s");
  return (loss_Nm - m.shaft.coulomb_Nm) / m.no_load_speed_rad_s;
}

void read_printed_points(const Sheet& sheet, MotorModel& m, Reader& reader) {
  if (sheet.no_load_speed_rpm)
    m.no_load_speed_rad_s = rad_s_from_rpm(
        reader.positive("no_load_speed_rpm", sheet.no_load_speed_rpm->value, "leave it out if unknown"));
  if (sheet.no_load_current_mA)
    m.no_load_current_A = reader.not_negative("no_load_current_mA", sheet.no_load_current_mA->value,
                                              "leave it out if unknown", milli);
  m.stall_torque_Nm = m.K_t_Nm_A * m.nominal_voltage_V / (2.0 * m.machine.R_ohm);
  if (sheet.stall_torque_mNm)
    m.stall_torque_Nm =
        reader.positive("stall_torque_mNm", sheet.stall_torque_mNm->value, "leave it out if unknown", milli);
}

void read_shaft(const Sheet& sheet, MotorModel& m, Reader& reader) {
  m.shaft.J_kg_m2 =
      reader.positive("inertia_gcm2", sheet.inertia_gcm2.value, "give the rotor's inertia in g cm^2", gcm2);
  if (sheet.coulomb_friction_mNm)
    m.shaft.coulomb_Nm = reader.not_negative("coulomb_friction_mNm", sheet.coulomb_friction_mNm->value,
                                             "give its magnitude", milli);
  m.shaft.B_Nm_s = sheet.viscous_friction_Nm_s
                       ? reader.not_negative("viscous_friction_Nm_s", sheet.viscous_friction_Nm_s->value,
                                             "give its magnitude in Nm per rad/s")
                       : default_viscous(m, reader);
}

}  // namespace

base::Result<MotorModel> motor_model(const Sheet& sheet) {
  Reader reader;
  MotorModel m;
  reader.expect(sheet.pole_pairs >= 1, "pole_pairs", sheet.pole_pairs, "must be at least 1",
                "give the number of pole pairs (half the number of magnets' poles)");
  reader.expect(base::strictly_between(0.0, 180.0).holds(sheet.flat_deg), "flat_deg", sheet.flat_deg,
                "must lie between 0 and 180", "give the flat top's width in electrical degrees, usually 120");
  m.machine.pole_pairs = sheet.pole_pairs;
  m.machine.back_emf =
      sheet.back_emf == BackEmfShape::sine ? plant::BackEmf::sine : plant::BackEmf::trapezoid;
  m.machine.flat_deg = sheet.flat_deg;
  m.nominal_voltage_V = reader.positive("nominal_voltage_V", sheet.nominal_voltage_V.value,
                                        "give the sheet's voltage in volts");
  m.machine.R_ohm =
      reader.per_phase("resistance_ohm", sheet.resistance_ohm, "give the winding's resistance in ohms");
  m.machine.L_H =
      reader.per_phase("inductance_mH", sheet.inductance_mH, "give the winding's inductance in mH", milli);
  const Constants c = constants(sheet, reader);
  m.machine.K_e_V_s = c.K_e_V_s;
  m.K_t_Nm_A = c.K_t_Nm_A;
  read_printed_points(sheet, m, reader);
  read_shaft(sheet, m, reader);
  if (!reader.problems.empty()) return reader.problems;
  return m;
}

}  // namespace sixstep::design
