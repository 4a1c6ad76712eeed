// SPDX-License-Identifier: Apache-2.0
// The speed controllers other than the PI control the sampled mechanical plant. Poles, reaching time, loads
// and limits are compared with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sixstep/control/retune.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

template <class S>
class SpeedLaws : public ::testing::Test {
 public:
  /// The effect of `count` roundings of numbers whose magnitude is at most `largest`.
  static double roundings(double largest, int count) {
    return count * largest * static_cast<double>(std::numeric_limits<S>::epsilon());
  }
};
using Floating = ::testing::Types<double, float>;
TYPED_TEST_SUITE(SpeedLaws, Floating);

// The plant: torque t[n] = c t[n-1] + (1 - c) u[n], speed w[n+1] = a w[n] + b (t[n] - l), with output u and
// load l.
constexpr double a = 0.998, b = 0.5, c = 0.625, p = 0.97, z_o = 0.875;
constexpr double g = b * c / (a - c), B = (b + g) * (1 - c);

template <class S>
ObservedSpeedConfig<S> observed() {
  return {S(a),           S(b),           S(c), S(1 - z_o * z_o / a), S((1 - z_o) * (1 - z_o) / b),
          S((a - p) / B), S((1 - a) / b), S(g)};
}

/// The drive's shaft with a speed controller.
template <class S>
struct Bench {
  ObservedSpeedConfig<S> config = observed<S>();
  ObservedSpeedState<S> state{};
  S w{}, t{}, u{}, load{}, low{-1}, high{1};

  void tick(S setpoint) {
    u = observed_speed_step(config, state, setpoint - w, w, low, high);
    t = S(c) * t + (S(1) - S(c)) * u;
    w = S(a) * w + S(b) * (t - load);
  }
};

TYPED_TEST(SpeedLaws, ObservedSpeedFollowsItsSetpointWithTheOnePoleOfTheRegulator) {
  using S = TypeParam;
  Bench<S> bench;
  const S r = 10;
  const S h_end = r + S(g) * S((1 - a) / b) * r;  // w + g t at the end
  S before = h_end;
  for (int n = 0; n < 200; ++n) {
    bench.tick(r);
    const S after = h_end - bench.w - S(g) * bench.t;
    ASSERT_NEAR(after, p * static_cast<double>(before), this->roundings(20, 10)) << n;
    before = after;
  }
  EXPECT_NEAR(bench.w, 10 * (1 - std::pow(p, 200)), 0.2);
}

/// The response of the speed to a load has the poles p and c, and the pole z_o twice, and decays to zero. The
/// polynomial with these roots, applied to the response, gives 0.
TYPED_TEST(SpeedLaws, ObservedSpeedAnswersALoadWithThePolesThatWerePlaced) {
  using S = TypeParam;
  Bench<S> bench;
  bench.load = S(0.4);
  std::vector<double> course;
  for (int n = 0; n < 1500; ++n) {
    bench.tick(S(0));
    course.push_back(static_cast<double>(bench.w));
  }
  const std::vector<double> roots{p, c, z_o, z_o};
  std::vector<double> poly{1.0};
  for (const double root : roots) {
    poly.push_back(0.0);
    for (std::size_t k = poly.size() - 1; k > 0; --k) poly[k] -= root * poly[k - 1];
  }
  double deepest = 0.0;
  for (std::size_t n = roots.size(); n < course.size(); ++n) {
    double rest = 0.0;
    for (std::size_t k = 0; k < poly.size(); ++k) rest += poly[k] * course[n - k];
    ASSERT_NEAR(rest, 0.0, this->roundings(5, 40)) << n;
    deepest = std::fmin(deepest, course[n]);
  }
  EXPECT_LT(deepest, -1.0);
  EXPECT_NEAR(course.back(), 0.0, this->roundings(5, 100));
  EXPECT_NEAR(bench.state.l, 0.4, this->roundings(5, 100)) << "the load is seen for what it is";
}

TYPED_TEST(SpeedLaws, ObservedSpeedHoldsItsSetpointWhateverTheModelLacks) {
  using S = TypeParam;
  Bench<S> bench;
  bench.config.b = S(0.7);  // the inertia is 40 % larger
  bench.config.a = S(1);
  bench.config.f = S(0);
  bench.load = S(-0.3);
  for (int n = 0; n < 3000; ++n) bench.tick(S(20));
  EXPECT_NEAR(bench.w, 20.0, this->roundings(20, 100));
}

/// At the limit, the observer uses the limited torque, so its load estimate contains only the load. After the
/// limit, the drive behaves as if it had never reached the limit.
TYPED_TEST(SpeedLaws, ObservedSpeedDoesNotWindUp) {
  using S = TypeParam;
  Bench<S> bench;
  bench.load = S(0.25);
  bench.high = S(0.5);
  bench.low = S(-0.5);
  for (int n = 0; n < 2000; ++n) {
    bench.tick(S(1000));  // 0.25 b/(1 - a) = 62.5 is the highest speed
    ASSERT_LE(bench.u, S(0.5));
  }
  EXPECT_EQ(bench.u, S(0.5));
  EXPECT_NEAR(bench.state.l, 0.25, this->roundings(63, 100));
  const S w = bench.w;
  bench.tick(w - S(1));
  EXPECT_LT(bench.u, S(0.5)) << "out of the limit with the first sample";
  S over = 0;
  for (int n = 0; n < 600; ++n) {
    bench.tick(w - S(1));
    over = std::fmax(over, w - S(1) - bench.w);
  }
  EXPECT_LT(over, this->roundings(63, 100)) << "and no further than asked for";
}

/// The reference is the extended state observer with its controller in the form of Miklosovic, Radke and Gao,
/// with the parameters b_0 and T.
TYPED_TEST(SpeedLaws, WithoutFrictionAndLagItIsLinearActiveDisturbanceRejection) {
  using S = TypeParam;
  const double T = 1.0 / 32768, b_0 = b / T, w_c = (1 - p) / T;
  ObservedSpeedConfig<S> config{};
  config.a = 1;
  config.b = S(b);
  config.L_w = S(1 - z_o * z_o);
  config.L_l = S((1 - z_o) * (1 - z_o) / b);
  config.K = S((1 - p) / b);
  ObservedSpeedState<S> state{};
  double z_1 = 0, z_2 = 0;  // predicted values
  std::mt19937 random{20261125};
  std::uniform_real_distribution<double> drawn(-1.0, 1.0);
  double y = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double r = n / 100 % 2 == 0 ? 10 : -5;
    const double missed = y - z_1;
    z_1 += (1 - z_o * z_o) * missed;
    z_2 += (1 - z_o) * (1 - z_o) / T * missed;
    const double u = std::fmin(1.0, std::fmax(-1.0, (w_c * (r - z_1) - z_2) / b_0));
    ASSERT_NEAR(observed_speed_step(config, state, S(r) - S(y), S(y), S(-1), S(1)), u,
                this->roundings(10, 1000))
        << n;
    z_1 += T * z_2 + T * b_0 * u;
    y += b * (u + 0.2 * drawn(random));
    y = static_cast<double>(S(y));
  }
}

TYPED_TEST(SpeedLaws, ObservedSpeedBeginsWhereTheShaftIs) {
  using S = TypeParam;
  Bench<S> bench;
  bench.w = S(40);
  bench.tick(S(40));
  EXPECT_NEAR(bench.u, 0.0, this->roundings(1, 20));
}

// The sliding law has q = 1 - p. On the surface, the speed error has the pole p. Within the layer, the value
// of the surface has the pole z_o.
template <class S>
SlidingSpeedConfig<S> sliding(double reach) {
  return {S(1 - p), S((1 - p) / b), S(reach), S(reach * b / (1 - z_o))};
}

template <class S>
struct SlidingBench {
  SlidingSpeedConfig<S> config{};
  SlidingSpeedState<S> state{};
  S w{}, u{}, load{}, low{-1}, high{1};
  S surface() const { return state.m - w; }
  void tick(S setpoint) {
    u = sliding_speed_step(config, state, setpoint - w, w, low, high);
    w = w + S(b) * (u - load);
  }
};

TYPED_TEST(SpeedLaws, SlidingSpeedFollowsItsSetpointOnTheSurface) {
  using S = TypeParam;
  SlidingBench<S> bench{sliding<S>(0.5)};
  S before = 10;
  for (int n = 0; n < 200; ++n) {
    bench.tick(S(10));
    ASSERT_NEAR(bench.surface(), 0.0, this->roundings(10, 4 * (n + 1)));
    ASSERT_NEAR(S(10) - bench.w, p * static_cast<double>(before), this->roundings(10, 4 * (n + 1)));
    before = S(10) - bench.w;
  }
}

/// Outside the layer, the value of the surface falls from s_0 by b (R - l) per sample (reach R, load l).
TYPED_TEST(SpeedLaws, SlidingSpeedReachesItsLayerInTheTimeOfItsLaw) {
  using S = TypeParam;
  for (const double load : {0.0, 0.25, -0.25}) {
    SlidingBench<S> bench{sliding<S>(0.5)};
    bench.load = S(load);
    bench.tick(S(0));
    const S w_0 = bench.w;
    const double s_0 = 10.0 + 1.0 / 16;
    bench.state.m = w_0 + S(s_0);
    const double layer = 0.5 * b / (1 - z_o), per_sample = b * (0.5 - load);
    const int due = static_cast<int>(std::ceil((s_0 - layer) / per_sample));
    // The setpoint is equal to the speed, so the term of the error is 0.
    int n = 0;
    for (; bench.surface() > S(layer) && n < 1000; ++n) {
      const S s = bench.surface();
      bench.tick(bench.w);
      ASSERT_NEAR(s - bench.surface(), per_sample, this->roundings(20, 4));
    }
    EXPECT_EQ(n, due) << load;
  }
}

/// Within the layer, the value s of the surface follows s[n+1] = z_o s[n] + b l. At rest, the switching part
/// of the torque is equal to the load l.
TYPED_TEST(SpeedLaws, SlidingSpeedBearsALoadWithoutAnErrorThatStays) {
  using S = TypeParam;
  SlidingBench<S> bench{sliding<S>(0.5)};
  bench.load = S(0.4);
  for (int n = 0; n < 40; ++n) {
    const S s = bench.state.started ? bench.surface() : S(0), error = -bench.w;
    bench.tick(S(0));
    // The output u also contains q e/b (speed error e), which cancels in the surface.
    ASSERT_NEAR(bench.surface(), z_o * static_cast<double>(s) + b * 0.4, this->roundings(4, 20))
        << n << " " << error;
  }
  for (int n = 0; n < 1500; ++n) bench.tick(S(0));
  EXPECT_NEAR(bench.w, 0.0, this->roundings(4, 200));
  EXPECT_NEAR(bench.state.held, 0.4, this->roundings(1, 200));
  EXPECT_NEAR(bench.surface(), 0.4 * b / (1 - z_o), this->roundings(4, 200));
}

/// The drive starts far from its setpoint, at full torque. The law reduces the torque when the error e must
/// fall by only q e per sample. The reduction begins earlier, by up to q/(1 - z_o) of this error, because the
/// layer around the surface has a width. Then the speed follows the surface.
TYPED_TEST(SpeedLaws, SlidingSpeedDoesNotWindUp) {
  using S = TypeParam;
  SlidingBench<S> bench{sliding<S>(1.0)};
  const double load = 0.25, turn = b * (1 - load) / (1 - p);
  bench.load = S(load);
  int n = 0;
  for (; bench.u == S(1) || n == 0; ++n) bench.tick(S(200));
  EXPECT_LE(n, (200 - turn) / (b * (1 - load)) + 2);
  EXPECT_GE(n, (200 - turn * (1 + (1 - p) / (1 - z_o))) / (b * (1 - load)));
  S most = 0;
  for (n = 0; n < 2000; ++n) {
    bench.tick(S(200));
    most = std::fmax(most, bench.w);
  }
  EXPECT_LT(most, 200 + b) << "no further than a sample";
  EXPECT_NEAR(bench.w, 200.0, this->roundings(200, 200));
  // The load exceeds the reach of the law. The speed falls, and no integral accumulates.
  bench.config.reach = S(0.5);
  bench.config.layer = S(0.5 * b / (1 - z_o));
  bench.load = S(0.75);
  for (n = 0; n < 3000; ++n) bench.tick(S(200));
  EXPECT_NEAR(200 - static_cast<double>(bench.w), 0.25 * b / (1 - p), 0.01);
  EXPECT_LT(bench.surface(), bench.config.layer + S(0.25 * b / (1 - p)) + S(b));
}

TYPED_TEST(SpeedLaws, WithoutAConfigurationThereIsNoOutput) {
  using S = TypeParam;
  ObservedSpeedState<S> o{};
  SlidingSpeedState<S> s{};
  for (const double error : {1.0, -100.0}) {
    EXPECT_EQ(observed_speed_step(ObservedSpeedConfig<S>{}, o, S(error), S(5), S(-1), S(1)), S(0));
    EXPECT_EQ(sliding_speed_step(SlidingSpeedConfig<S>{}, s, S(error), S(5), S(-1), S(1)), S(0));
  }
}

template <class S>
DriveConfig<S> speed_drive(SpeedLaw law) {
  DriveConfig<S> d;
  d.mode = Mode::speed;
  d.current = {S(0.1), S(-0.05), S(24)};
  d.nominal_bus_V = S(24);
  d.speed = {S(0.05), S(-0.04), S(1)};
  d.current_at_full_torque_A = S(10);
  d.current_limit_A = S(10);
  d.extras.on = law != SpeedLaw::pi;
  d.extras.speed_law = law;
  d.extras.speed = {S(0.05), S(0.01), S(0.2), S(1), S(0)};
  d.extras.laws = {observed<S>(), sliding<S>(1.0)};
  return d;
}

/// After a change from any law to any other law, the torque at zero error is unchanged.
TYPED_TEST(SpeedLaws, AnotherLawBeginsWithTheTorqueOfTheOneBefore) {
  using S = TypeParam;
  const SpeedLaw all[] = {SpeedLaw::pi, SpeedLaw::positional, SpeedLaw::observed, SpeedLaw::sliding};
  for (const SpeedLaw from : all)
    for (const SpeedLaw to : all) {
      DriveConfig<S> config = speed_drive<S>(from);
      DriveState<S> state;
      Telemetry<S> telemetry;
      Measurement<S> m{};
      m.hall = 0b101;
      m.speed_rad_s = S(50);
      // The shaft slows down until the law's torque is equal to the load of 0.5.
      for (int n = 0; n < 40000; ++n) {
        step(config, state, m, {S(50)}, telemetry);
        const S t = telemetry.current_reference_A / S(10);
        m.speed_rad_s = m.speed_rad_s + S(0.05) * (t - S(0.5));
      }
      ASSERT_NEAR(telemetry.current_reference_A, 5.0, this->roundings(50, 2000));
      retune(config, state, speed_drive<S>(to));
      step(config, state, m, {S(50)}, telemetry);
      EXPECT_NEAR(telemetry.current_reference_A, 5.0, this->roundings(50, 2000))
          << static_cast<int>(from) << " to " << static_cast<int>(to);
    }
}

/// The output is K (b r - y) + I (gain K, setpoint weight b, setpoint r, speed y, integral I). With b = 0, a
/// step of the setpoint acts only through the integral, which changes by K_i (r - y) per sample.
TYPED_TEST(SpeedLaws, ASetpointWeightTakesTheKickOffASetpoint) {
  using S = TypeParam;
  for (const double weight : {0.0, 0.5, 1.0}) {
    DriveConfig<S> config = speed_drive<S>(SpeedLaw::positional);
    config.extras.speed_weight_off = S((1 - weight) * 0.05);
    DriveState<S> state;
    Telemetry<S> telemetry;
    Measurement<S> m{};
    m.hall = 0b101;
    step(config, state, m, {S(4)}, telemetry);
    EXPECT_NEAR(telemetry.current_reference_A, 10 * weight * 0.05 * 4, this->roundings(4, 4));
    step(config, state, m, {S(4)}, telemetry);
    EXPECT_NEAR(telemetry.current_reference_A, 10 * (weight * 0.05 + 0.01) * 4, this->roundings(4, 4));
  }
}

/// With an I-P controller, an integrator as plant has a pole pair and no zero: T = b K_i/(z^2 - (2 - b K) z +
/// 1 - b K + b K_i). With real poles, the I-P controller does not overshoot, while the PI with the same poles
/// does.
TYPED_TEST(SpeedLaws, AnIPControllerDoesNotOvershootWhereThePiDoes) {
  using S = TypeParam;
  const double pole = 0.95, K = (2 - 2 * pole) / b, K_i = (1 - pole) * (1 - pole) / b;
  for (const double weight : {0.0, 1.0}) {
    DriveConfig<S> config = speed_drive<S>(SpeedLaw::positional);
    config.extras.speed = {S(K), S(K_i), S(0.1), S(1), S(0)};
    config.extras.speed_weight_off = S((1 - weight) * K);
    DriveState<S> state;
    Telemetry<S> telemetry;
    Measurement<S> m{};
    m.hall = 0b101;
    double most = 0;
    for (int n = 0; n < 400; ++n) {
      step(config, state, m, {S(2)}, telemetry);
      m.speed_rad_s = m.speed_rad_s + S(b) * telemetry.current_reference_A / S(10);
      most = std::fmax(most, static_cast<double>(m.speed_rad_s));
      // The closed form is the step response of a double pole without a zero.
      if (weight == 0.0) {
        ASSERT_NEAR(m.speed_rad_s, 2 * (1 - (1 + n * (1 - pole)) * std::pow(pole, n)),
                    this->roundings(2, 2000))
            << n;
      }
    }
    EXPECT_NEAR(m.speed_rad_s, 2.0, 1e-4);
    if (weight == 0.0) {
      EXPECT_LT(most, 2 + this->roundings(2, 2000));
    } else {
      EXPECT_GT(most, 2 * 1.1);
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
