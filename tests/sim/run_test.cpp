// SPDX-License-Identifier: Apache-2.0
// The run loop is compared with the closed solutions of two systems. A bouncing ball has located events, and
// a switched RL circuit has scheduled events.
#include "sixstep/sim/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sim::Instant;
using sim::Stop;

constexpr double eps = 0x1p-52;

/// A ball that falls and bounces with the coefficient of restitution e.
class Ball {
 public:
  using Real = double;
  double y = 1.0, v = 0.0, g = 9.81, restitution = 0.8;
  std::vector<double> bounces_s;
  int acts = 0;

  Instant now() const { return now_; }
  Instant next_known() const { return Instant::never(); }
  bool act() {
    ++acts;
    return true;
  }
  double expand(double h) {
    h_ = h;
    c_ = {y, v * h, -g / 2 * h * h};
    return h;
  }
  template <class Visit>
  void guards(Visit&& visit) const {
    visit(0, c_, 2, 64 * eps);
  }
  void end_at(double) {}
  void advance(double s, const Instant& to) {
    y = series::evaluate(c_, 2, s);
    v -= g * h_ * s;
    now_ = to;
  }
  void apply(int) {
    y = 0;
    v = -restitution * v;
    bounces_s.push_back(now_.seconds());
  }

 private:
  series::Coefficients<double> c_{};
  double h_ = 0;
  Instant now_{};
};

/// A circuit with L di/dt = u - R i. A clock switches u on at n T and off at n T + on.
class Chopped {
 public:
  using Real = double;
  static constexpr double R = 1.03, L = 0.572e-3, U = 24.0;
  static constexpr std::int64_t period = 30'000'000, on_time = 11'000'000;
  double i = 0.0;
  bool on = false;
  int switchings = 0;
  double u_of_zero_step = -1;

  Instant now() const { return now_; }
  Instant next_known() const { return next_; }
  bool act() {
    if (now_ < next_) return true;
    on = !on;
    ++switchings;
    next_.ticks += on ? on_time : period - on_time;
    return true;
  }
  double expand(double h) {
    c_ = {i};
    for (int j = 0; j < series::max_degree; ++j)
      c_[j + 1] = h / (j + 1) * ((j == 0 && on ? U : 0.0) - R * c_[j]) / L;
    return h;
  }
  template <class Visit>
  void guards(Visit&&) const {}
  void end_at(double) {}
  void advance(double s, const Instant& to) {
    i += series::increment(c_, series::max_degree, s);
    now_ = to;
  }
  void apply(int) {}
  double at(double s) const { return series::evaluate(c_, series::max_degree, s); }

 private:
  series::Coefficients<double> c_{};
  Instant now_{}, next_{};
};

/// The closed-form current after a number of periods, in long double.
long double chopped_exact(int periods) {
  const long double tau = static_cast<long double>(Chopped::L) / Chopped::R;
  const long double full = Chopped::U / static_cast<long double>(Chopped::R);
  long double i = 0;
  for (int n = 0; n < periods; ++n) {
    i = full + (i - full) * std::exp(-11e-6L / tau);
    i *= std::exp(-19e-6L / tau);
  }
  return i;
}

TEST(Run, BallBouncesAtTheClosedFormTimes) {
  Ball ball;
  sim::NoObserver none;
  const sim::Run run = sim::run(ball, sim::to_instant(3.5), none);
  EXPECT_EQ(run.stop, Stop::end);
  EXPECT_EQ(ball.now(), sim::to_instant(3.5));
  long double t = std::sqrt(2.0L / 9.81L), v = 9.81L * t;
  ASSERT_EQ(ball.bounces_s.size(), 9u);
  for (std::size_t n = 0; n < ball.bounces_s.size(); ++n) {
    // Each bounce adds two errors: the error of a root, eps of the run's time, and the error of a speed, eps
    // of the speed v. The next interval is 2 v/g (gravity g).
    const double bound = 8.0 * static_cast<double>(n + 1) * eps * 3.5;
    EXPECT_NEAR(ball.bounces_s[n], static_cast<double>(t), bound) << n;
    v *= static_cast<long double>(ball.restitution);
    t += 2 * v / 9.81L;
  }
  EXPECT_EQ(run.segments, static_cast<std::int64_t>(ball.bounces_s.size()) + 1);
}

TEST(Pitfall07_ZeroLengthSteps, EndAsNoProgressNeverAsAHang) {
  Ball ball;
  ball.restitution = 0.5;
  sim::NoObserver none;
  const sim::Run run = sim::run(ball, sim::to_instant(100.0), none);
  EXPECT_EQ(run.stop, Stop::no_progress);
  // The bounces end at t_0 + 2 t_0 (e + e^2 + ...) = t_0 (1 + e)/(1 - e) (first bounce t_0, restitution e).
  // The ball stops when v h (speed v, length h) is noise: 64 eps m over 100 s.
  const double t_0 = std::sqrt(2.0 / 9.81);
  EXPECT_NEAR(ball.now().seconds(), 3.0 * t_0, 64 * 8 * eps * 100.0);
  EXPECT_LT(run.segments, 1000);
}

TEST(Pitfall07_ZeroLengthSteps, AreLegal) {
  Ball ball;  // on the ground and falling: the first event is at the start
  ball.y = 0.0;
  ball.v = -3.0;
  sim::NoObserver none;
  const sim::Run run = sim::run(ball, sim::to_instant(0.1), none);
  EXPECT_EQ(run.stop, Stop::end);
  ASSERT_EQ(ball.bounces_s.size(), 1u);
  EXPECT_EQ(ball.bounces_s[0], 0.0);
  EXPECT_EQ(run.segments, 2);
}

/// A system whose only guard is negative until `left` events have been applied.
struct Stuttering {
  using Real = double;
  int left;
  Instant at{};

  Instant now() const { return at; }
  Instant next_known() const { return Instant::never(); }
  bool act() { return true; }
  double expand(double h) { return h; }
  template <class Visit>
  void guards(Visit&& visit) const {
    visit(0, series::Coefficients<double>{left > 0 ? -1.0 : 1.0}, 1, eps);
  }
  void end_at(double) {}
  void advance(double, const Instant& to) { at = to; }
  void apply(int) { --left; }
};

TEST(Pitfall07_ZeroLengthSteps, AHundredAreLegalOneMoreIsNot) {
  sim::NoObserver none;
  for (const int events : {sim::stalled_limit, sim::stalled_limit + 1}) {
    Stuttering system{events};
    const sim::Run run = sim::run(system, Instant{1000, 0.0}, none);
    EXPECT_EQ(run.stop, events == 100 ? Stop::end : Stop::no_progress);
    EXPECT_EQ(run.segments, 101);
  }
}

TEST(Run, KnownSwitchingsGiveTheClosedForm) {
  Chopped circuit;
  sim::NoObserver none;
  constexpr int periods = 1000;
  const sim::Run run = sim::run(circuit, {periods * Chopped::period, 0.0}, none);
  EXPECT_EQ(run.stop, Stop::end);
  EXPECT_EQ(circuit.switchings, 2 * periods + 1) << "what is due at the end is done";
  EXPECT_EQ(run.segments, 2 * periods);
  // Each segment adds an error of eps/2 of the full current. The errors decay with L/R, which is 19 periods.
  EXPECT_NEAR(circuit.i, static_cast<double>(chopped_exact(periods)), 40 * eps * Chopped::U / Chopped::R);
}

struct Sampling {
  double sum = 0;
  int segments = 0;
  void segment(const Chopped& circuit, double s) {
    for (const double at : {0.0, 0.3, 1.0}) sum += circuit.at(at * s);
    ++segments;
  }
};

TEST(Run, AnObserverDoesNotChangeABit) {
  Chopped watched, alone;
  Sampling sampling;
  sim::NoObserver none;
  const Instant end{777'123'456, 0.0};
  const sim::Run a = sim::run(watched, end, sampling), b = sim::run(alone, end, none);
  EXPECT_EQ(watched.i, alone.i);
  EXPECT_EQ(a.segments, b.segments);
  EXPECT_EQ(sampling.segments, a.segments);
}

/// The end of a slice restarts the expansion. If the slice ends at an instant at which the system restarts in
/// any case, the result has the same bits. Each action that is due at this instant is executed once.
TEST(Run, StoppingAtKnownInstantsIsInvisible) {
  Chopped whole, sliced;
  sim::NoObserver none;
  const Instant end{50 * Chopped::period, 0.0};
  sim::run(whole, end, none);
  for (const std::int64_t ticks : {std::int64_t{0}, Chopped::on_time, 3 * Chopped::period,
                                   20 * Chopped::period + Chopped::on_time, end.ticks})
    EXPECT_EQ(sim::run(sliced, {ticks, 0.0}, none).stop, Stop::end);
  EXPECT_EQ(whole.i, sliced.i);
  EXPECT_EQ(whole.switchings, sliced.switchings);
}

TEST(Run, StoppingElsewhereCostsRoundingOnly) {
  Chopped whole, sliced;
  sim::NoObserver none;
  const Instant end{50 * Chopped::period, 0.0};
  sim::run(whole, end, none);
  for (Instant t{7'654'321, 0.5}; t < end; t = t.plus_ticks(9'876'543.21)) sim::run(sliced, t, none);
  sim::run(sliced, end, none);
  EXPECT_NEAR(whole.i, sliced.i, 200 * eps * Chopped::U / Chopped::R);
  EXPECT_EQ(whole.switchings, sliced.switchings);
  EXPECT_EQ(sliced.now(), end);
}

TEST(Run, AnEndThatHasPassedDoesNothingButWhatIsDue) {
  Ball ball;
  sim::NoObserver none;
  const sim::Run run = sim::run(ball, Instant{}, none);
  EXPECT_EQ(run.stop, Stop::end);
  EXPECT_EQ(run.segments, 0);
  EXPECT_EQ(ball.acts, 1);
}

/// A system whose act() fails, or whose expand() fails.
struct Broken : Ball {
  bool acts_well = true;
  bool act() { return acts_well; }
  double expand(double h) { return acts_well ? -1.0 : Ball::expand(h); }
};

TEST(Run, FaultsAndUnsettledStatesEndTheRun) {
  sim::NoObserver none;
  Broken refuses, unsettled;
  refuses.acts_well = false;
  EXPECT_EQ(sim::run(refuses, sim::to_instant(1.0), none).stop, Stop::fault);
  EXPECT_EQ(sim::run(unsettled, sim::to_instant(1.0), none).stop, Stop::unsettled);
}

/// Two guards reach zero together. The event is the event of the first guard in the order of the visit.
struct TwoGuards : Ball {
  int applied = -1;
  template <class Visit>
  void guards(Visit&& visit) const {
    for (const int id : {5, 3}) visit(id, series::Coefficients<double>{0.25, -1.0}, 1, 1e-15);
  }
  void apply(int id) {
    applied = applied < 0 ? id : applied;
    Ball::apply(id);
  }
};

TEST(Pitfall05_SnapFirst, ATieGoesToTheGuardNamedFirst) {
  TwoGuards two;
  two.v = 100.0;
  sim::NoObserver none;
  sim::run(two, sim::to_instant(1e-3), none);
  EXPECT_EQ(two.applied, 5);
}

}  // namespace SIXSTEP_TEST_FILE
