// SPDX-License-Identifier: Apache-2.0
// The theory of the 36 ways to connect a motor is checked by independent tables and by numerical integration
// of the shapes. If phases and probes are renamed together, no result may change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "sixstep/analysis/wiring/cures.hpp"
#include "sixstep/base/angle.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::WiringDoes;
using analysis::WiringTheory;
using plant::general::Machine;
using rig::WireOrder;
using rig::Wiring;

constexpr double pi = 3.14159265358979323846;
const std::string words[] = {"abc", "bca", "cab", "acb", "cba", "bac"};
constexpr int probes[6][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
constexpr int pairs[6][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}};

/// The phase at each leg, and the probe at each pin. One letter names a phase or a probe.
struct Words {
  std::string phases, probes;
};
Words words_of(const Wiring& w) {
  return {words[static_cast<int>(w.phases)], words[static_cast<int>(w.probes)]};
}

/// The phases that the board drives in a sector of the rotor: {source, sink}.
std::array<int, 2> driven(const Words& w, int sector) {
  for (int seen = 0; seen < 6; ++seen) {
    bool same = true;
    for (std::size_t pin = 0; pin < 3; ++pin)
      same &= probes[seen][pin] == probes[sector][w.probes[pin] - 'a'];
    if (same)
      return {w.phases[static_cast<std::size_t>(pairs[seen][0])] - 'a',
              w.phases[static_cast<std::size_t>(pairs[seen][1])] - 'a'};
  }
  ADD_FAILURE() << "no sector";
  return {};
}

double trapezoid(double deg, double flat) {
  const double from_top = std::fabs(std::remainder(deg - 60, 360.0));
  return std::fmax(-1.0, std::fmin(1.0, (90 - from_top) / (90 - flat / 2)));
}
double of_sines(double deg, const std::vector<plant::general::Harmonic>& all) {
  double sum = 0;
  for (const auto& h : all) sum += h.size * std::cos(h.order * (deg - 60) * pi / 180);
  return sum;
}

/// A motor, and the torque per ampere of a pair of its phases. The torque is computed according to model.md
/// 7.
struct Motor {
  const char* name;
  Machine machine;
  std::function<double(double deg, int phase)> emf;
  double per_A(double deg, int source, int sink, double current) const {
    double sum = emf(deg, source) - emf(deg, sink);
    const double L_D = (machine.L_d_H - machine.L_q_H) / 2;
    for (const auto& [k, sign_k] : {std::pair{source, 1}, {sink, -1}})
      for (const auto& [j, sign_j] : {std::pair{source, 1}, {sink, -1}})
        sum -= 2 * machine.pole_pairs / 3 * L_D * current * sign_k * sign_j *
               std::sin((2 * (deg - 150) - 120 * (k + j)) * pi / 180);
    return sum;
  }
};

Machine star(double K) { return {.R_ohm = {1, 1, 1}, .K_e_V_s = {K, K, K}, .L_H = 1e-3, .pole_pairs = 4}; }

std::vector<Motor> motors() {
  constexpr double K = 0.02;
  std::vector<Motor> all;
  const auto add = [&](const char* name, const Machine& m, std::function<double(double)> f) {
    all.push_back({name, m, [m, f](double deg, int k) {
                     const auto phase = [&](int n) {
                       return m.K_e_V_s[static_cast<std::size_t>(n % 3)] * f(deg - 120 * (n % 3));
                     };
                     if (m.winding == plant::general::Winding::star) return phase(k);
                     const auto branch = [&](int n) { return m.K_e_V_s[0] * f(deg + 30 - 120 * (n % 3)); };
                     return (branch(k) - branch(k + 2)) / 3;  // e_a = (e_ab - e_ca)/3
                   }});
  };
  add("trapezoid", star(K), [](double deg) { return trapezoid(deg, 120); });
  Machine narrow = star(K), strays = star(K), sine = star(K), harmonics = star(K), delta = star(K),
          salient = star(K);
  narrow.shape.flat_deg = 95;
  add("narrow trapezoid", narrow, [](double deg) { return trapezoid(deg, 95); });
  strays.K_e_V_s = {1.05 * K, 0.97 * K, 0.98 * K};
  add("phases that stray", strays, [](double deg) { return trapezoid(deg, 120); });
  sine.shape.harmonics = {{1, 1.0}};
  add("sine", sine, [](double deg) { return of_sines(deg, {{1, 1.0}}); });
  harmonics.shape.harmonics = {{1, 1.0}, {3, 0.2}, {5, -0.1}, {7, 0.05}};
  add("harmonics", harmonics, [h = harmonics.shape.harmonics](double deg) { return of_sines(deg, h); });
  delta.winding = plant::general::Winding::delta;
  add("delta", delta, [](double deg) { return trapezoid(deg, 120); });
  salient.shape.harmonics = {{1, 1.0}};
  salient.L_d_H = 0.8e-3;
  salient.L_q_H = 1.2e-3;
  add("salient", salient, [](double deg) { return of_sines(deg, {{1, 1.0}}); });
  return all;
}

constexpr double current = 3.0;

/// Numerical integration with the midpoint rule, step h = pi/18000. At a corner, its error is h^2/8 times the
/// change of slope. Six corners with a change of (180/pi)/30 K per line give an error of 2e-8 K in total. For
/// a cosine f, the error (h^2/24) f'' is smaller.
struct BruteForce {
  std::array<double, 6> sector{};
  double mean = 0, square = 0, first = 0, second = 0;
  static constexpr int steps = 6000;
  BruteForce(const Motor& m, const Words& w) {
    for (int s = 0; s < 6; ++s) {
      const auto [source, sink] = driven(w, s);
      for (int n = 0; n < steps; ++n) {
        const double g = m.per_A(60 * (s + (n + 0.5) / steps), source, sink, current);
        sector[static_cast<std::size_t>(s)] += g / steps;
        mean += g / steps / 6;
        square += g * g / steps / 6;
        (n < steps / 2 ? first : second) += g / steps / 3;
      }
    }
  }
};

WiringDoes expected(const BruteForce& b, const BruteForce& straight) {
  const auto [least, most] = std::minmax_element(b.sector.begin(), b.sector.end());
  if (*least <= 0 && *most >= 0) return WiringDoes::hums;
  const bool forward = *least > 0, well = std::fabs(b.mean) > 0.75 * straight.mean;
  if (well) return forward ? WiringDoes::forward : WiringDoes::backward;
  // If the pair is early, the torque increases during the sector.
  const bool comes = forward ? b.second > b.first : std::fabs(b.first) > std::fabs(b.second);
  if (forward) return comes ? WiringDoes::forward_early : WiringDoes::forward_late;
  return comes ? WiringDoes::backward_early : WiringDoes::backward_late;
}

template <class Check>
void for_all(Check&& check) {
  for (const Motor& m : motors()) {
    const analysis::PairTorque torque(m.machine, current);
    for (const Wiring& w : analysis::all_wirings()) {
      SCOPED_TRACE(::testing::Message()
                   << m.name << ", phases " << words_of(w).phases << ", probes " << words_of(w).probes);
      check(m, torque, w);
    }
  }
}

TEST(WiringTheory, IsTheTorqueIntegratedByBruteForce) {
  for_all([](const Motor& m, const analysis::PairTorque& torque, const Wiring& w) {
    const WiringTheory t = analysis::wiring_theory(torque, w);
    const BruteForce b(m, words_of(w)), straight(m, {"abc", "abc"});
    const double K = m.machine.K_e_V_s[0], bound = 1e-7 * K;
    for (std::size_t s = 0; s < 6; ++s) EXPECT_NEAR(t.torque_Nm_A[s], b.sector[s], bound) << s;
    EXPECT_NEAR(t.mean_Nm_A, b.mean, bound);
    EXPECT_NEAR(t.part, b.mean / straight.mean, 1e-6);
    EXPECT_NEAR(t.idle_current_part * t.idle_current_part, 1 - b.mean * b.mean / b.square, 1e-6);
    EXPECT_NEAR(t.idle_speed_part, (b.mean / b.square) / (straight.mean / straight.square), 1e-6);
    EXPECT_EQ(t.does, expected(b, straight));
  });
}

/// For each shape, three wirings run well forward, and three run well backward. Six wirings run roughly in
/// each direction, and eighteen hum.
TEST(WiringTheory, CountsTheWays) {
  for (const Motor& m : motors()) {
    // At a large current, a salient rotor turns almost as well with a pair that is one sector ahead, except
    // at the end of each sector.
    for (const double amperes : {current, 5 * current}) {
      std::array<int, analysis::kinds_of_wiring> count{};
      const analysis::PairTorque torque(m.machine, amperes);
      for (const Wiring& w : analysis::all_wirings())
        ++count[static_cast<std::size_t>(analysis::wiring_theory(torque, w).does)];
      EXPECT_EQ(count, (std::array<int, analysis::kinds_of_wiring>{3, 3, 3, 3, 3, 3, 18}))
          << m.name << amperes;
    }
  }
}

TEST(WiringTheory, OfAlikePhasesHasHalfTheTorqueASectorOff) {
  for_all([](const Motor& m, const analysis::PairTorque& torque, const Wiring& w) {
    if (std::string(m.name) == "phases that stray" || std::string(m.name) == "salient") return;
    const double parts[] = {1, 0.5, -0.5, -1, -0.5, 0.5};
    const std::optional<int> ahead = analysis::sectors_ahead(w);
    const WiringTheory t = analysis::wiring_theory(torque, w);
    EXPECT_NEAR(t.part, ahead ? parts[*ahead] : 0, 1e-12);
    for (const analysis::Driven& d : t.driven) EXPECT_TRUE(!ahead || d.ahead == *ahead);
    EXPECT_EQ(ahead.has_value(), analysis::keeps_the_turn(w.phases) == analysis::keeps_the_turn(w.probes));
  });
}

/// With flat tops, a pair that is one sector off has the torque g per ampere with mean(g^2) = 4/3 K^2, where
/// K is the mean of g. Without load, the motor runs 1.5 times as fast as with straight wires and draws half
/// of the stalled current.
TEST(WiringTheory, KnowsWhatATrapezoidDrawsWithoutLoad) {
  const Motor m = motors()[0];
  const analysis::PairTorque torque(m.machine, current);
  const WiringTheory early = analysis::wiring_theory(torque, {WireOrder::acb, WireOrder::acb});
  EXPECT_EQ(early.does, WiringDoes::forward_early);
  EXPECT_NEAR(early.idle_speed_part, 1.5, 1e-12);
  EXPECT_NEAR(early.idle_current_part, 0.5, 1e-12);
  EXPECT_NEAR(early.least_part, 0, 1e-12);
  const WiringTheory well = analysis::wiring_theory(torque, {});
  EXPECT_NEAR(well.idle_current_part, 0, 1e-7);  // square root of a rounding error
  EXPECT_NEAR(well.least_part, 1, 1e-12);
}

TEST(WiringTheory, HumsAboutAnglesToWhichItIsDrivenFromBothSides) {
  for_all([](const Motor& m, const analysis::PairTorque& torque, const Wiring& w) {
    const WiringTheory t = analysis::wiring_theory(torque, w);
    ASSERT_EQ(t.rests_deg.size(), t.does == WiringDoes::hums ? 2u : 0u);
    for (const double rest : t.rests_deg)
      for (const double off : {-20.0, -1.0, 1.0, 20.0}) {
        const double deg = rest + off - 360 * std::floor((rest + off) / 360);
        const auto [source, sink] = driven(words_of(w), static_cast<int>(deg / 60));
        EXPECT_LT(m.per_A(deg, source, sink, current) * off, 0) << rest << " " << off;
      }
  });
}

/// If phases and probes are renamed together, the motor is the same.
TEST(WiringTheory, DoesNotSeeNamesThatMoveOnTogether) {
  const auto on = [](WireOrder order) {
    std::string word = words[static_cast<int>(order)];
    for (char& end : word) end = static_cast<char>('a' + (end - 'a' + 1) % 3);
    return static_cast<WireOrder>(std::find(std::begin(words), std::end(words), word) - std::begin(words));
  };
  for_all([&](const Motor& m, const analysis::PairTorque& torque, const Wiring& w) {
    if (std::string(m.name) == "phases that stray") return;
    const WiringTheory a = analysis::wiring_theory(torque, w),
                       b = analysis::wiring_theory(torque, {on(w.phases), on(w.probes)});
    EXPECT_EQ(a.does, b.does);
    EXPECT_NEAR(a.mean_Nm_A, b.mean_Nm_A, 1e-16);
    EXPECT_NEAR(a.least_part, b.least_part, 1e-12);
    for (std::size_t s = 0; s < 6; ++s) EXPECT_NEAR(a.torque_Nm_A[s], b.torque_Nm_A[(s + 2) % 6], 1e-16);
    for (const double rest : a.rests_deg) {
      double nearest = 360;
      for (const double other : b.rests_deg)
        nearest = std::min(nearest, std::fabs(std::remainder(other - rest - 120, 360.0)));
      EXPECT_NEAR(nearest, 0, 1e-9);
    }
  });
}

/// Phases a and b exchange their names, probes 2 and 3 exchange their names, and the angle is reversed. The
/// result is the mirrored motor, which turns in the opposite direction.
TEST(WiringTheory, RunsTheMirroredMotorTheOtherWay) {
  const auto renamed = [](WireOrder order, char x, char y) {
    std::string word = words[static_cast<int>(order)];
    for (char& end : word) end = end == x ? y : end == y ? x : end;
    return static_cast<WireOrder>(std::find(std::begin(words), std::end(words), word) - std::begin(words));
  };
  const WiringDoes mirrored[] = {WiringDoes::backward, WiringDoes::backward_early, WiringDoes::backward_late,
                                 WiringDoes::forward,  WiringDoes::forward_early,  WiringDoes::forward_late,
                                 WiringDoes::hums};
  for_all([&](const Motor& m, const analysis::PairTorque& torque, const Wiring& w) {
    if (std::string(m.name) == "phases that stray") return;
    const WiringTheory a = analysis::wiring_theory(torque, w);
    const WiringTheory b =
        analysis::wiring_theory(torque, {renamed(w.phases, 'a', 'b'), renamed(w.probes, 'b', 'c')});
    EXPECT_EQ(b.does, mirrored[static_cast<std::size_t>(a.does)]);
    EXPECT_NEAR(b.mean_Nm_A, -a.mean_Nm_A, 1e-16);
  });
}

/// The wires at the three terminals after the moves. One letter names a wire.
std::string moved(const std::string& word, const analysis::Moves& moves) {
  std::string out(3, ' ');
  for (std::size_t n = 0; n < 3; ++n) out[moves[n]] = word[n];
  return out;
}

TEST(Cures, AreTheFewestWiresByBruteForce) {
  const Motor m = motors()[0];
  const BruteForce straight(m, {"abc", "abc"});
  std::map<std::string, WiringDoes> does;
  for (const std::string& phases : words)
    for (const std::string& pins : words)
      does[phases + pins] = expected(BruteForce(m, {phases, pins}), straight);
  int wires[5] = {};
  for (const Wiring& w : analysis::all_wirings()) {
    const Words now = words_of(w);
    int fewest = 9;
    std::size_t ways = 0;
    for (const std::string& phases : words)
      for (const std::string& pins : words) {
        if (does[phases + pins] != WiringDoes::forward) continue;
        int changed = 0;
        for (std::size_t n = 0; n < 3; ++n)
          changed += (phases[n] != now.phases[n]) + (pins[n] != now.probes[n]);
        ways = changed < fewest ? 1 : ways + (changed == fewest ? 1 : 0);
        fewest = std::min(fewest, changed);
      }
    const std::vector<analysis::Cure> cures = analysis::shortest_cures(w);
    EXPECT_EQ(cures.size(), ways) << now.phases << " " << now.probes;
    for (const analysis::Cure& cure : cures) {
      EXPECT_EQ(cure.wires(), fewest);
      const Words then{moved(now.phases, cure.legs), moved(now.probes, cure.pins)};
      EXPECT_EQ(does[then.phases + then.probes], WiringDoes::forward);
      EXPECT_EQ(words_of(analysis::cured(w, cure)).phases, then.phases);
      EXPECT_EQ(words_of(analysis::cured(w, cure)).probes, then.probes);
    }
    ++wires[fewest];
  }
  EXPECT_EQ(wires[0], 3);
  EXPECT_EQ(wires[2], 18) << "what hums wants two wires swapped";
  EXPECT_EQ(wires[3], 6);
  EXPECT_EQ(wires[4], 9) << "with two Hall lines swapped as well as two phases: both";
}

TEST(Cures, OfThePhaseWiresAloneReachNoMoreThanARunBackwardWhereTwoHallLinesAreSwapped) {
  const analysis::PairTorque torque(motors()[0].machine, current);
  for (const Wiring& w : analysis::all_wirings()) {
    int count[analysis::kinds_of_wiring] = {};
    for (const Wiring& other : analysis::all_wirings())
      if (other.probes == w.probes) ++count[static_cast<int>(analysis::wiring_theory(torque, other).does)];
    const bool keeps = analysis::keeps_the_turn(w.probes);
    EXPECT_EQ(count[static_cast<int>(WiringDoes::forward)], keeps ? 1 : 0);
    EXPECT_EQ(count[static_cast<int>(WiringDoes::backward)], keeps ? 0 : 1);
    // Wirings that run roughly change their direction of rotation.
    EXPECT_EQ(count[static_cast<int>(WiringDoes::backward_early)], keeps ? 1 : 0);
    EXPECT_EQ(count[static_cast<int>(WiringDoes::forward_late)], keeps ? 0 : 1);
    EXPECT_EQ(count[static_cast<int>(WiringDoes::hums)], 3);
  }
}

TEST(Cures, StepByStepLeadFromEveryWiringForward) {
  const analysis::PairTorque torque(motors()[0].machine, current);
  const auto does = [&](const Wiring& w) { return analysis::wiring_theory(torque, w).does; };
  for (Wiring w : analysis::all_wirings()) {
    int steps = 0;
    for (; does(w) != WiringDoes::forward && steps < 5; ++steps) {
      const WiringDoes before = does(w);
      // Any swap of two phases makes a humming motor turn.
      if (before == WiringDoes::hums) {
        for (const analysis::Moves& swap : {analysis::Moves{1, 0, 2}, {0, 2, 1}, {2, 1, 0}})
          EXPECT_NE(does(analysis::cured(w, {.legs = swap})), WiringDoes::hums);
      }
      w = analysis::cured(w, analysis::next_step(before));
    }
    EXPECT_LE(steps, 4);
    EXPECT_EQ(does(w), WiringDoes::forward);
    EXPECT_EQ(analysis::next_step(does(w)).wires(), 0);
  }
}

}  // namespace SIXSTEP_TEST_FILE
