// SPDX-License-Identifier: Apache-2.0
// A random machine is printed in the form of each kind of sheet. Reading this sheet gives the same machine.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/random.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using base::Quantity;

/// The seed of the random machines. The variable SIXSTEP_FUZZ_SEED repeats a failed run.
std::uint64_t seed() {
  const char* text = std::getenv("SIXSTEP_FUZZ_SEED");
  return text ? std::strtoull(text, nullptr, 10) : 20261121;
}

struct Drawn {
  MotorModel model;
  BackEmfShape shape = BackEmfShape::trapezoid;
};

double between(double low, double high, std::uint64_t stream, std::uint64_t n) {
  return low * std::pow(high / low, base::uniform({seed(), stream, n}));
}

Drawn draw(std::uint64_t n) {
  Drawn d;
  MotorModel& m = d.model;
  d.shape = base::uniform({seed(), 0, n}) < 0.5 ? BackEmfShape::sine : BackEmfShape::trapezoid;
  m.machine.R_ohm = between(1e-3, 20.0, 1, n);
  m.machine.L_H = m.machine.R_ohm / between(10.0, 9e5, 2, n);
  m.machine.K_e_V_s = between(1e-3, 1.0, 3, n);
  m.machine.pole_pairs = 1 + static_cast<int>(25.0 * base::uniform({seed(), 4, n}));
  m.machine.flat_deg = 10.0 + 160.0 * base::uniform({seed(), 5, n});
  m.shaft.B_Nm_s = between(1e-7, 1e-4, 7, n);
  m.nominal_voltage_V = between(5.0, 400.0, 8, n);
  m.K_t_Nm_A = m.machine.K_e_V_s * shape_factors(d.shape, m.machine.flat_deg).sector_mean;
  const double swing_rad_s = between(1.0, 9e4, 6, n);  // K_t/sqrt(L J), below the limit of real motors
  m.shaft.J_kg_m2 = std::pow(m.K_t_Nm_A / swing_rad_s, 2) / (2 * m.machine.L_H);
  return d;
}

Quantity print(double value, const char* frame = "") { return {value, frame, ""}; }

Sheet common(const Drawn& d) {
  Sheet s;
  s.name = "drawn";
  s.back_emf = d.shape;
  s.flat_deg = d.model.machine.flat_deg;
  s.nominal_voltage_V = print(d.model.nominal_voltage_V);
  s.viscous_friction_Nm_s = print(d.model.shaft.B_Nm_s);
  return s;
}

Sheet maxon(const Drawn& d) {
  const plant::Machine& m = d.model.machine;
  Sheet s = common(d);
  s.pole_pairs = static_cast<int>(m.pole_pairs);
  s.resistance_ohm = print(2 * m.R_ohm, "terminal");
  s.inductance_mH = print(2e3 * m.L_H, "terminal");
  s.torque_constant_mNm_A = print(1e3 * d.model.K_t_Nm_A);
  s.inertia_gcm2 = print(1e7 * d.model.shaft.J_kg_m2);
  return s;
}

/// The form of drone motors: KV is the peak voltage between terminals. Friction is stated as a no-load
/// current on the ideal line.
Sheet drone(const Drawn& d) {
  const plant::Machine& m = d.model.machine;
  Sheet s = maxon(d);
  s.pole_pairs.reset();
  s.winding = "12N" + std::to_string(2 * static_cast<int>(m.pole_pairs)) + "P";
  s.torque_constant_mNm_A.reset();
  const double line = shape_factors(d.shape, m.flat_deg).line_peak;
  s.speed_constant_rpm_V = print(30 / base::pi / (m.K_e_V_s * line), "line-peak");
  s.viscous_friction_Nm_s.reset();
  // The no-load point satisfies K_t I = B w and K_t w = U - R_tt I (symbols of model.md).
  const double K = d.model.K_t_Nm_A, B = d.model.shaft.B_Nm_s, U = d.model.nominal_voltage_V / 2;
  const double I = U / (2 * m.R_ohm + K * K / B);
  s.no_load_voltage_V = print(U);
  s.no_load_current_mA = print(I * 1e3);
  return s;
}

Sheet servo(const Drawn& d) {
  const plant::Machine& m = d.model.machine;
  Sheet s = maxon(d);
  s.pole_pairs.reset();
  s.poles = 2 * static_cast<int>(m.pole_pairs);
  s.torque_constant_mNm_A.reset();
  s.torque_constant_Nm_A = print(torque_per_rms_A(m.K_e_V_s, shape_factors(d.shape, m.flat_deg)), "rms");
  s.inertia_with_brake_gcm2 = s.inertia_gcm2;
  s.inertia_gcm2.reset();
  s.with_brake = true;
  return s;
}

Sheet back_emf(const Drawn& d) {
  const plant::Machine& m = d.model.machine;
  Sheet s = maxon(d);
  s.torque_constant_mNm_A.reset();
  s.back_emf_constant_V_krpm =
      print(m.K_e_V_s * shape_factors(d.shape, m.flat_deg).line_rms * 1000 * base::pi / 30, "line-rms");
  return s;
}

Sheet firmware(const Drawn& d) {
  const plant::Machine& m = d.model.machine;
  Sheet s = common(d);
  s.pole_pairs = static_cast<int>(m.pole_pairs);
  s.resistance_ohm = print(m.R_ohm, "phase");
  s.d_axis_inductance_mH = s.q_axis_inductance_mH = print(1e3 * m.L_H);
  s.flux_linkage_mWb = print(1e3 * m.K_e_V_s * shape_factors(d.shape, m.flat_deg).fundamental / m.pole_pairs);
  s.inertia_gcm2 = print(1e7 * d.model.shaft.J_kg_m2);
  return s;
}

struct Style {
  const char* name;
  Sheet (*print)(const Drawn&);
};
constexpr Style styles[] = {
    {"maxon", maxon}, {"drone", drone}, {"servo", servo}, {"back-EMF", back_emf}, {"firmware", firmware}};

TEST(SheetRoundTrip, AMachinePrintedInAnyStyleIsReadBack) {
  // The bound is a few roundings in each direction. The no-load current adds the rounding of two differences.
  constexpr double bound = 32 * 0x1p-52;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const Drawn d = draw(n);
    for (const Style& style : styles) {
      SCOPED_TRACE(std::string(style.name) + ", machine " + std::to_string(n) +
                   ", SIXSTEP_FUZZ_SEED=" + std::to_string(seed()));
      const auto read = motor_model(style.print(d));
      ASSERT_TRUE(read) << to_string(read.problems().front());
      const auto same = [&](double a, double b) { EXPECT_NEAR(a / b, 1.0, bound); };
      EXPECT_EQ(read->machine.pole_pairs, d.model.machine.pole_pairs);
      same(read->machine.R_ohm, d.model.machine.R_ohm);
      same(read->machine.L_H, d.model.machine.L_H);
      same(read->machine.K_e_V_s, d.model.machine.K_e_V_s);
      same(read->K_t_Nm_A, d.model.K_t_Nm_A);
      same(read->shaft.J_kg_m2, d.model.shaft.J_kg_m2);
      // B is computed from w_0 = (U - R I_0)/K_t. The difference increases the relative rounding error by the
      // factor U/(U - R I_0).
      const double K = d.model.K_t_Nm_A, R_B = 2 * d.model.machine.R_ohm * d.model.shaft.B_Nm_s;
      EXPECT_NEAR(read->shaft.B_Nm_s / d.model.shaft.B_Nm_s, 1.0, bound * (1 + R_B / (K * K)));
      if (HasFailure()) return;
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
