// SPDX-License-Identifier: Apache-2.0
// Random machines, shafts, bridges and supplies run on the general kernel with random duties. The run reaches
// its end and its energy balances. No diode conducts backwards, and no floating leg carries a current. A
// failed test prints its seed. SIXSTEP_DRAWS sets the number of random cases.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "sixstep/plant/general/audit.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * unit(); }
  double decades(double low, double high) { return low * std::pow(high / low, unit()); }
  bool one_in(unsigned n) { return random_() % n == 0; }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_;
};

general::Machine drawn_machine(Draw& d) {
  const double R = d.decades(0.05, 3), L = R * d.decades(0.1e-3, 2e-3), K = d.decades(0.005, 0.05);
  general::Machine m{.R_ohm = {R, R, R},
                     .K_e_V_s = {K, K, K},
                     .L_H = L,
                     .pole_pairs = 1.0 + static_cast<double>(d.below(10))};
  if (d.one_in(2)) m.shape.harmonics = {{1, 1.0}};
  if (!m.shape.harmonics.empty() && d.one_in(2)) m.shape.harmonics.push_back({3, d.between(-0.2, 0.2)});
  if (!m.shape.harmonics.empty() && d.one_in(3)) m.shape.harmonics.push_back({5, d.between(-0.1, 0.1)});
  if (m.shape.harmonics.empty()) m.shape.flat_deg = d.one_in(3) ? 120 : d.between(5, 175);
  if (d.one_in(3)) {
    m.winding = general::Winding::delta;
    m.M_H = L * d.between(-0.3, 0.3);
  } else {
    if (d.one_in(2))
      for (std::size_t k = 0; k < 3; ++k)
        m.R_ohm[k] *= d.between(0.9, 1.1), m.K_e_V_s[k] *= d.between(0.9, 1.1);
    if (d.one_in(3)) m.L_d_H = L * d.between(0.6, 1), m.L_q_H = L * d.between(1, 1.6);
  }
  if (d.one_in(3)) m.cogging = {{m.pole_pairs * 6, K * d.between(0, 0.3), d.between(0, 6)}};
  return m;
}

general::Shaft drawn_shaft(Draw& d) {
  general::Shaft s{.J_kg_m2 = d.decades(2e-6, 1e-3), .B_Nm_s = d.one_in(2) ? 0 : d.decades(1e-7, 1e-4)};
  if (d.one_in(2)) s.coulomb_Nm = d.decades(1e-4, 2e-2);
  if (d.one_in(3)) s.static_Nm = d.decades(1e-4, 4e-2);
  if (d.one_in(3)) s.gear = d.decades(0.5, 10);
  if (d.one_in(2)) s.load_J_kg_m2 = s.J_kg_m2 * s.gear * s.gear * d.decades(0.1, 10);
  if (s.load_J_kg_m2 > 0 && d.one_in(2)) {
    s.stiffness_Nm = d.decades(0.05, 50);
    s.damping_Nm_s = d.one_in(2) ? 0 : d.decades(1e-5, 1e-3);
  }
  if (d.one_in(3)) s.load_B_Nm_s = d.decades(1e-7, 1e-4);
  if (d.one_in(2)) s.load.torque_Nm = d.between(-0.05, 0.05);
  if (d.one_in(3)) s.load.fan_Nm_s2 = d.decades(1e-9, 1e-5);
  if (d.one_in(3)) s.load.gravity_Nm = d.between(-0.05, 0.05);
  s.load.gravity_angle_rad = d.between(-3, 3);
  return s;
}

general::Devices drawn_devices(Draw& d) {
  general::Devices b{.igbt = d.one_in(2)};
  if (d.one_in(2)) b.R_on_ohm = d.decades(1e-3, 0.1);
  if (b.igbt && !d.one_in(3)) b.V_ce_V = d.between(0, 2);
  if (!d.one_in(3)) b.V_f_V = d.between(0, 1.5);
  if (d.one_in(2)) b.r_d_ohm = d.decades(1e-3, 0.1);
  return b;
}

general::Supply drawn_supply(Draw& d, double V) {
  general::Supply s{.V_0_V = V};
  if (d.one_in(3)) return s;
  s.R_b_ohm = d.decades(0.01, 1);
  s.C_F = d.decades(50e-6, 5e-3);
  s.sinks = d.one_in(2);
  if (d.one_in(2)) s.L_b_H = d.decades(0.5e-6, 50e-6);
  if (d.one_in(2)) s.brake_ohm = d.decades(0.5, 10), s.brake_on_V = 1.3 * V, s.brake_off_V = 1.15 * V;
  return s;
}

Board drawn_board(Draw& d) {
  const control::Chopping chopping[] = {control::Chopping::soft, control::Chopping::hard,
                                        control::Chopping::complementary};
  Board b = Board::duty(d.between(-1, 1), chopping[d.below(3)]);
  b.board.modulator.dead_ticks = d.one_in(2) ? 0 : 1e6 * d.between(0.1, 2);
  if (b.drive.chopping == control::Chopping::complementary && b.board.modulator.dead_ticks == 0)
    b.board.modulator.dead_ticks = 0.3e6;
  for (int n = 1; n < 4; ++n) {
    b.setpoint(n * 4'000'000'000 + d.below(1000) * 1'000'000, d.one_in(6) ? 1.0 : d.between(-1, 1));
    if (d.one_in(8))
      b.timeline.push_back(
          {{n * 4'000'000'000 + 1'500'000'000, 0.0}, rig::ActionKind::wire_break, double(d.below(3))});
  }
  return b;
}

struct Watch {
  general::Audit<double> audit;
  void segment(const GeneralRig& r, double to) { audit.segment(r.plant(), to); }
};

void run_drawn(unsigned seed) {
  Draw d(seed);
  GeneralSetup s;
  s.machine = drawn_machine(d);
  s.shaft = drawn_shaft(d);
  s.devices = drawn_devices(d);
  const double V = d.decades(6, 100);
  s.supply = drawn_supply(d, V);
  s.start = {.speed_rad_s = d.one_in(2) ? 0 : d.between(-1, 1) * V / (2 * s.machine.K_e_V_s[0]),
             .angle_rad = d.one_in(3) ? 0 : d.between(-7, 7),
             .bus_V = V};
  auto rig = general_rig(s, drawn_board(d));
  Watch watch;
  ASSERT_EQ(run_to(rig, 0.016, watch), sim::Stop::end) << "seed " << seed << " at " << rig.now().seconds();
  const plant::EnergyBook book = watch.audit.energy();
  EXPECT_LT(std::fabs(book.electrical_residual), 1e-11) << "seed " << seed;
  EXPECT_LT(std::fabs(book.mechanical_residual), 1e-11) << "seed " << seed;
  const double amp = rig.plant().constants().amp_noise;
  EXPECT_LE(watch.audit.laws().reverse_diode_A, 4 * amp) << "seed " << seed;
  EXPECT_LE(watch.audit.laws().current_sum_A, 4 * amp) << "seed " << seed;
  EXPECT_EQ(watch.audit.laws().floating_current_A, 0) << "seed " << seed;
}

TEST(GeneralRandom, DrawnMachinesKeepTheLaws) {
  const char* more = std::getenv("SIXSTEP_DRAWS");
  const unsigned draws = more ? static_cast<unsigned>(std::atoi(more)) : 60;
  for (unsigned seed = 1; seed <= draws; ++seed) run_drawn(seed);
}

}  // namespace SIXSTEP_TEST_FILE
