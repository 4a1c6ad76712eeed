// SPDX-License-Identifier: Apache-2.0
// Pitfalls of the event-exact plant that no other test in this folder covers. They are the tangential start,
// the order of events that set a state to zero, and guards that are computed from the polynomials of the
// state.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
namespace guard = plant::guard;

/// The lower switch of a is on, and the back-EMF of b lowers the terminal of b below the rail. The diode of b
/// starts with i = di/dt = 0. The speed w is constant, so L_tt di/dt + R_tt i = E' t from this instant on,
/// with the slope E' of the back-EMF. This equation has a closed form.
TEST(Pitfall04_TangentialStart, ADiodeThatStartsTangentiallyGoesOnWithoutChatter) {
  for (const double V_f : {0.0, 0.7}) {
    Drivetrain setup;
    setup.shaft = {.J_kg_m2 = 1e9};
    setup.devices.V_f_V = V_f;
    setup.start = {.speed_rad_s = 400.0, .angle_rad = at_electrical_deg(290.0), .bus_V = 24.0};
    Held<> bench(setup, gates({}, {true, false, false}));
    LawChecker<> laws;
    const double emf_rate = setup.machine.K_e_V_s * 400.0 * 8 * 400.0 / (base::sector_rad / 2);  // V/s
    const double start_s = at_electrical_deg(10.0) / 400.0 + V_f / emf_rate;
    for (const double after_s : {1e-9, 1e-7, 1e-6, 5e-6}) {
      ASSERT_EQ(bench.run_to(start_s + after_s, laws), sim::Stop::end);
      const long double x = after_s / setup.tau();  // t - tau (1 - exp(-x)) = tau x^2/2 (1 - x/3 + x^2/12 ..)
      const long double tau_part =
          setup.tau() * x * x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6))));
      const double exact = static_cast<double>(emf_rate / setup.R_tt() * tau_part);
      // The instant is rounded to a picosecond. The start is exact within the rounding of an angle of 300
      // degrees. The driving voltage is zero within the noise of the guards.
      const double late_s = 0.5e-12 + 32 * eps * at_electrical_deg(300.0) / 400.0;
      const double noise_V = plant::noise_of(bench.plant().constants().volt_scale, 1.0);
      const double bound = (emf_rate * after_s * late_s + noise_V * after_s) / setup.L_tt();
      EXPECT_NEAR(bench.state().i[1], exact, bound) << V_f << " V, " << after_s << " s";
    }
    int starts = 0, stops = 0;
    for (const auto& e : bench.events) {
      starts += e.id == guard::low_rail + 1;
      stops += e.id == guard::current_zero + 1;
    }
    EXPECT_EQ(starts, 1);
    EXPECT_EQ(stops, 0);
    EXPECT_LE(bench.events.size(), 2u) << "the start, and the edge at 300 degrees";
    laws.expect_all();
  }
}

/// A six-step drive that follows the sectors without delay. On either side of the edge, it drives the rotor
/// back towards the edge.
struct TornAtAnEdge : Held<> {
  explicit TornAtAnEdge(const Drivetrain& setup) : Held<>(setup, all_off()) { drive(); }
  void apply(int id) {
    Held<>::apply(id);
    drive();
  }
  void drive() {
    const bool ahead = plant().state().sector >= 0;  // torque of the pair a to b: positive on either side of
                                                     // the edge
    plant().set_gates(ahead ? gates({false, true, false}, {true, false, false}) : a_to_b());
  }
};

/// At rest, the torque is zero on both sides of the edge. From either side, the third derivative of the angle
/// points towards the edge. Without friction, the rotor cannot leave the edge, but the time must advance.
TEST(Pitfall07_NoProgress, ARotorAtRestOnAnEdgeThatIsDrivenBackFromEitherSideGoesOnInTime) {
  for (const double C_F : {0.0, 1e-3}) {
    Drivetrain setup;
    setup.devices.V_f_V = 0.7;
    setup.shaft.B_Nm_s = 0;
    setup.supply = {.V_0_V = 24.0, .R_b_ohm = 0.1, .C_F = C_F};
    TornAtAnEdge bench(setup);
    LawChecker<> laws;
    ASSERT_EQ(sim::run(bench, sim::to_instant(2e-3), laws).stop, sim::Stop::end) << C_F;
    std::size_t passes = 0;
    for (const auto& e : bench.events) passes += e.id == guard::edge_ahead || e.id == guard::edge_behind;
    EXPECT_GE(passes, 4u) << "it was torn";
    EXPECT_LE(passes, 4000u);
    EXPECT_LT(std::fabs(bench.angle()), base::sector_rad / 8) << "and got nowhere";
    laws.expect_all();
  }
}

/// The order in which the guards of a mode are evaluated. If several guards trigger at one instant, the first
/// guard is the event.
struct Order {
  bool snap_after_another = false;
  int standstill_with_rail = 0, current_with_rail = 0;  ///< segments that have both guards
  template <class Rig>
  void segment(const Rig& rig, double) {
    bool other = false, rail = false, current = false, standstill = false;
    rig.guards([&](int id, const auto&, int, double) {
      const bool snap = id <= guard::standstill;
      snap_after_another = snap_after_another || (snap && other);
      other = other || !snap;
      rail = rail || (id >= guard::low_rail && id < guard::floating_star);
      current = current || id < guard::standstill;
      standstill = standstill || id == guard::standstill;
    });
    standstill_with_rail += standstill && rail;
    current_with_rail += current && rail;
  }
};

TEST(Pitfall05_SnapFirst, EventsThatSnapAStateAreAskedBeforeAllOthers) {
  Board b = Board::duty(0.5);
  b.shaft.coulomb_Nm = 0.01;
  auto rig = b.rig();
  Order order;
  ASSERT_EQ(run_to(rig, 50e-3, order), sim::Stop::end);
  Drivetrain fast;
  fast.start.speed_rad_s =
      720.0;  // slightly above the no-load speed: the diodes' current ends while the next leg is close to its
              // rail
  Held<> coasting(fast, all_off());
  ASSERT_EQ(coasting.run_to(20e-3, order), sim::Stop::end);
  EXPECT_GT(order.standstill_with_rail, 0);
  EXPECT_GT(order.current_with_rail, 0);
  EXPECT_FALSE(order.snap_after_another);
}

TEST(Pitfall05_SnapFirst, ASpeedWithinNoiseIsRestWhereFrictionHolds) {
  Drivetrain setup;
  setup.shaft.coulomb_Nm = 0.01;
  const double noise = plant::noise_of(setup.plant().constants().speed_scale, 1.0);
  for (const double share : {0.0, 1e-3, 0.9, -0.9}) {
    setup.start.speed_rad_s = share * noise;
    Held<> bench(setup, all_off());
    ASSERT_EQ(bench.run_to(1e-3), sim::Stop::end);
    EXPECT_EQ(bench.state().w, 0.0) << share;
    EXPECT_EQ(bench.plant().mode().motion, plant::Motion::stuck) << share;
    EXPECT_TRUE(bench.events.empty()) << share;
  }
}

/// The quantity that a guard watches. It is computed from the state that the expansion gives at the fraction
/// s of the segment.
double watched(const plant::Plant<double>& p, int id, double s) {
  const plant::Snapshot<double> now = p.at(s);
  const double V_f = p.constants().devices.V_f_V;
  const auto& piece = p.constants().emf[p.sector()].piece[p.mode().piece];
  const double x = series::evaluate(p.expansion().x, p.expansion().degree, s);
  if (id < guard::standstill) return plant::along_diode(p.mode().legs[id], now.i[id]);
  if (id == guard::standstill) return p.mode().motion == plant::Motion::forward ? now.speed : -now.speed;
  if (id == guard::edge_ahead) return piece.to - x;
  if (id == guard::edge_behind) return x - piece.from;
  if (id < guard::high_rail) return now.pole[id - guard::low_rail] + V_f;
  if (id < guard::floating_star) return now.bus + V_f - now.pole[id - guard::high_rail];
  if (id == guard::breakaway_forward) return p.constants().breakaway - (now.torque - p.constants().load);
  if (id == guard::breakaway_backward) return p.constants().breakaway + (now.torque - p.constants().load);
  const int j = (id - guard::floating_star) / 3, k = (id - guard::floating_star) % 3;
  return now.bus + 2 * V_f - now.emf[j] + now.emf[k];
}

struct SamePolynomials {
  std::array<int, guard::source> seen{};
  double worst = 0.0;  // as a multiple of the guard's noise
  template <class System>
  void segment(const System& system, double) {
    const plant::Plant<double>& p = system.plant();
    p.guards([&](int id, const auto& c, int degree, double noise) {
      ++seen[static_cast<std::size_t>(id)];
      for (const double s : {0.0, 0.37, 1.0})
        worst = std::fmax(worst, std::fabs(series::evaluate(c, degree, s) - watched(p, id, s)) / noise);
    });
  }
};

TEST(Pitfall06_GuardsShareThePolynomials, EachGuardIsTheQuantityItWatches) {
  Board chopping = Board::duty(0.5), rubbing = Board::duty(0.5, control::Chopping::hard);
  chopping.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  rubbing.shaft.coulomb_Nm = 0.05;
  rubbing.load(5'000'000'000, 0.5);
  SamePolynomials same;
  for (const Board& b : {chopping, rubbing}) {
    auto rig = b.rig();
    ASSERT_EQ(run_to(rig, 60e-3, same), sim::Stop::end);
  }
  Drivetrain spinning;
  for (const double speed :
       {500.0, 715.0}) {  // at 715 rad/s a free star's EMF almost reaches the bus voltage: no bound excludes
                          // an event
    spinning.start.speed_rad_s = speed;
    for (const plant::Gates& g :
         {gates({true, false, false}, {}), gates({false, true, false}, {}), all_off()}) {
      Held<> bench(spinning, g);
      ASSERT_EQ(bench.run_to(5e-3, same), sim::Stop::end);
    }
  }
  // The noise is 64 eps of the natural scale. Both quantities are sums of a few dozen products of this scale.
  EXPECT_LT(same.worst, 1.0);
  for (const int id : {0, 1, 2, guard::standstill, guard::edge_ahead, 6, 7, 8, 9, 10, 11,
                       guard::floating_star + 1, guard::breakaway_forward, guard::breakaway_backward})
    EXPECT_GT(same.seen[static_cast<std::size_t>(id)], 0) << id;
}

}  // namespace SIXSTEP_TEST_FILE
