// SPDX-License-Identifier: Apache-2.0
// Back-EMF observers are compared with closed forms: placed poles, the lag for a ramp, the threshold of the
// flux linkage. The phase is simulated by the exact solution of L di/dt = w - R i - g (current i, voltage w,
// back-EMF g). The simulation does not use the design's formulas.
#include "sixstep/control/sensorless/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "tests/control/scalars.hpp"
#include "tests/control/sensorless/terminals.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using namespace sixstep::testing;

static_assert(std::is_trivially_copyable_v<ObserverState<double>>);
static_assert(std::is_trivially_copyable_v<ObserverState<Q15>>);

constexpr double R = 0.5, L = 0.3e-3, T = 30e-6, p = 0.3, k = 24.0, share = 0.5;
const double a = std::exp(-R * T / L), b = (1 - a) / R;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// The bases are 20 A and 30 V.
constexpr double ampere = 20.0, volt = 30.0;

template <class Scalar>
constexpr double base_of(double unit) {
  return is_fixed<Scalar> ? unit : 1.0;
}
template <class Scalar>
Gain<Scalar> gain(double x) {
  return static_cast<Gain<Scalar>>(x);
}
template <class Scalar>
LuenbergerConfig<Scalar> luenberger() {
  const double A_per_V = base_of<Scalar>(volt) / base_of<Scalar>(ampere);
  return {gain<Scalar>(a), gain<Scalar>(b * A_per_V), gain<Scalar>(1 - p * p / a),
          gain<Scalar>((1 - p) * (1 - p) / b / A_per_V)};
}
template <class Scalar>
SlidingModeConfig<Scalar> sliding() {
  const double A_per_V = base_of<Scalar>(volt) / base_of<Scalar>(ampere);
  return {gain<Scalar>(a),
          gain<Scalar>(b * A_per_V),
          gain<Scalar>(a / b / A_per_V),
          Scalar(k / base_of<Scalar>(volt)),
          gain<Scalar>(1 / a),
          gain<Scalar>(share)};
}

/// The current at the next sample.
double next_current(double i, double w, double g) { return a * i + b * (w - g); }

TEST(Luenberger, ItsErrorFollowsTheTwoPolesThatWerePlaced) {
  LuenbergerState<double> state;
  const double g = 5.0;
  double i = 0.7;
  std::vector<double> error;
  for (int n = 0; n < 30; ++n) {
    const double w = n % 3 == 0 ? 9.0 : -4.0;  // an arbitrary voltage
    i = next_current(i, w, g);
    error.push_back(luenberger_step(luenberger<double>(), state, w, i) - g);
  }
  for (std::size_t n = 2; n < error.size(); ++n)
    EXPECT_NEAR(error[n], 2 * p * error[n - 1] - p * p * error[n - 2], 64 * eps * k) << n;
  EXPECT_LT(std::fabs(error.back()), 1e-12);
}

/// Lag, in periods, of an observer for a leg without current. The back-EMF is a ramp, whose mean over a
/// period is equal to its value in the middle of the period.
template <class Step>
double lag_of_a_ramp(Step&& step) {
  const double per_period = 0.1;
  double last = 0;
  const int count = 200;
  for (int n = 1; n <= count; ++n) last = step(per_period * (n - 0.5), 0.0);
  return count - last / per_period;
}

TEST(Luenberger, IsLateByATimeThatItsPolesTell) {
  LuenbergerState<double> state;
  const double lag =
      lag_of_a_ramp([&](double w, double i) { return luenberger_step(luenberger<double>(), state, w, i); });
  EXPECT_NEAR(lag, 2 * p / (1 - p) + 0.5, 1e-9);
}

TEST(SlidingMode, IsInItsLayerAfterOnePeriodAndItsLowPassFollows) {
  SlidingModeState<double> state;
  const double g = 5.0;
  double i = 0.0;
  for (int n = 1; n < 40; ++n) {
    const double w = n % 4 == 0 ? 9.0 : -4.0;
    i = next_current(i, w, g);
    const double e = sliding_mode_step(sliding<double>(), state, w, i);
    EXPECT_NEAR(state.z_V, a * g, 64 * eps * k) << "the equivalent control, period " << n;
    EXPECT_NEAR(g - e, g * std::pow(1 - share, n), 64 * eps * k) << n;
  }
}

TEST(SlidingMode, IsLateByATimeThatItsLowPassTells) {
  SlidingModeState<double> state;
  const double lag =
      lag_of_a_ramp([&](double w, double i) { return sliding_mode_step(sliding<double>(), state, w, i); });
  EXPECT_NEAR(lag, (1 - share) / share + 0.5, 1e-9);
}

TEST(SlidingMode, OutsideTheLayerItIsDrivenInByTheWholeGain) {
  SlidingModeState<double> state;
  state.error_A = 40 * b * k;
  const double g = 5.0;
  double i = 0.0, before = state.error_A;
  int periods = 0;
  for (; periods < 100 && std::fabs(state.error_A - b * g) > 1e-9; ++periods) {
    i = next_current(i, 0.0, g);
    sliding_mode_step(sliding<double>(), state, 0.0, i);
    EXPECT_LE(std::fabs(state.z_V), k);
    EXPECT_LT(state.error_A, before) << "it only shrinks: k is above the back-EMF";
    before = state.error_A;
  }
  // Each period reduces the error by at least b (k - g), with the observer's gain k and the back-EMF g. The
  // decay of the winding reduces the error further.
  EXPECT_LE(periods, 40 * k / (k - g) + 2);
}

/// The observers in each scalar type. The inputs are a current and a voltage in SI units, rounded to the
/// scalar.
template <class Scalar>
class Observers : public ::testing::Test {};
using ObserverScalars = ::testing::Types<float, Q15, Q14, Q31, Q30>;
TYPED_TEST_SUITE(Observers, ObserverScalars);

TYPED_TEST(Observers, FollowTheOnesOfDoubleWithinTheirRounding) {
  using S = TypeParam;
  const double V = base_of<S>(volt), A = base_of<S>(ampere), d = digit<S>();
  LuenbergerState<double> luenberger_double;
  LuenbergerState<S> luenberger_state;
  SlidingModeState<double> sliding_double;
  SlidingModeState<S> sliding_state;
  double i = 0;
  // Per period, half a digit is rounded in the current i, the voltage w, the estimated current i^ and two
  // products; in float, a few digits. The gain converts these roundings to V. With double poles at p, their
  // sum stays below 1/(1 - p)^2; with the low-pass filter, below 1.
  const double per_A = a / b * A;
  const double bound = 8 * d * (per_A + V) / ((1 - p) * (1 - p));
  for (int n = 0; n < 400; ++n) {
    const double g = 10 * std::sin(0.02 * n), w = g + 4 * std::sin(0.05 * n);
    i = next_current(i, w, g);
    const S i_S(static_cast<S>(i / A)), w_S(static_cast<S>(w / V));
    const double l = luenberger_step(luenberger<double>(), luenberger_double, w, i),
                 s = sliding_mode_step(sliding<double>(), sliding_double, w, i);
    EXPECT_NEAR(static_cast<double>(luenberger_step(luenberger<S>(), luenberger_state, w_S, i_S)) * V, l,
                bound)
        << n;
    EXPECT_NEAR(static_cast<double>(sliding_mode_step(sliding<S>(), sliding_state, w_S, i_S)) * V, s, bound)
        << n;
  }
}

/// Flux linkage in units of four thresholds, for a trapezoid with the peak E and `ticks` periods T per
/// sector. The threshold psi_c = E T ticks/6 V s is the area under 2/3 E theta/30 degrees over half a sector.
template <class Scalar>
FluxLinkageConfig<Scalar> flux(double level_V_ticks) {
  const double A_per_V = base_of<Scalar>(volt) / base_of<Scalar>(ampere);
  return {gain<Scalar>(a), gain<Scalar>(1 / b / A_per_V),
          gain<Scalar>(0.25 / level_V_ticks * base_of<Scalar>(volt)), Scalar(0.25)};
}

template <class S>
void expect_level_at_thirty_degrees(double ticks, double growth) {
  // The angle after the crossing, in sectors, is x(t) = t/ticks (1 + growth t/ticks). The back-EMF is e =
  // (4/3) E x w/w_0 (speed w, initial speed w_0). At any speed, the flux falls by the integral over the
  // angle, E ticks (2/3) x^2.
  const double E = 6.0, level = E * ticks / 6.0;
  const FluxLinkageConfig<S> config = flux<S>(level);
  FluxLinkageState<S> state;
  const auto x_of = [&](double t) { return t / ticks * (1 + growth * t / ticks); };
  const auto psi = [&](double t) { return -E * ticks * (2.0 / 3.0) * x_of(t) * x_of(t); };
  double t = -0.45 * ticks + 0.37;
  for (int n = 0; n < 1000; ++n, t += 1) {
    const double g = psi(t + 1) - psi(t);  // mean over the period, V
    flux_linkage_step(config, state, S(static_cast<S>(g / base_of<S>(volt))), S{});
    S part{};
    if (!flux_level_comes(config, state, part)) continue;
    const double at = t + 1 + static_cast<double>(part), error_deg = 60 * (x_of(at) - 0.5);
    // The peak of psi is between two samples. Its error is at most 1/8 of the slope of e, while psi falls by
    // (ticks/2)^2/2 of this slope. Two further errors are the interpolation within the last period and the
    // rounding by half a digit per period.
    const double missed = 1.0 / (ticks * ticks) + 0.5 / (ticks * ticks);
    const double rounded = is_fixed<S> ? ticks * digit<S>() / 0.25 : 1e-5;
    EXPECT_LT(std::fabs(error_deg), 30 * (missed + rounded) + 0.02) << ticks << " periods, growth " << growth;
    return;
  }
  ADD_FAILURE() << "the level never came";
}

TYPED_TEST(Observers, FluxLinkageCommutatesThirtyDegreesBehindTheCrossingAtAnySpeed) {
  for (const double ticks : {6.1, 12.0, 40.3, 120.0})
    for (const double growth : {-0.1, 0.0, 0.2}) expect_level_at_thirty_degrees<TypeParam>(ticks, growth);
}

TEST(FluxLinkage, AnUnknownPeriodGoesOnAlongTheLine) {
  const FluxLinkageConfig<double> config = flux<double>(20);
  FluxLinkageState<double> seen, missed;
  for (int n = 0; n < 30; ++n) {
    const double g = 0.5 * (9.5 - n);  // crosses zero between the periods 9 and 10
    flux_linkage_step(config, seen, g, 0.0);
    if (n < 16)
      flux_linkage_step(config, missed, g, 0.0);
    else
      flux_linkage_hold(missed, 0.0);
  }
  EXPECT_NEAR(missed.top - missed.psi, seen.top - seen.psi, 1e-9);
}

/// Terminals of a sector as in terminals.hpp. A voltage of 24 V is 3200 counts.
constexpr FloatingVoltageConfig<double> voltages{24.0 / bus_counts / 3, 60, true};

TEST(FloatingVoltage, IsTheBackEmfWithoutCurrentAndTheRailWithOne) {
  BridgeCommand<double> command{.enabled = true, .pair = positive_pair(0), .duty = 0.5};
  const double E = 4.0, counts = E * bus_counts / 24;
  for (const double deg : {5.0, 20.0, 30.0, 47.0}) {
    const TerminalSample s = driven_sample(0, deg, counts, 0);
    const FloatingVoltage<double> v = floating_voltage(voltages, s, 2, true, command, 24.0);
    EXPECT_TRUE(v.known);
    EXPECT_FALSE(v.held);
    // The expected value is 2/3 of the trapezoid, which crosses zero downwards at 30 degrees. Terminals are
    // in counts.
    EXPECT_NEAR(v.w_V, 2.0 / 3.0 * E * (30 - deg) / 30, 2 * 24.0 / bus_counts) << deg;
  }
  TerminalSample s = driven_sample(0, 20.0, counts, 0);
  s.u[2] = 0;
  const FloatingVoltage<double> low = floating_voltage(voltages, s, 2, true, command, 24.0);
  EXPECT_TRUE(low.known && low.held);
  EXPECT_DOUBLE_EQ(low.w_V, -0.5 * 24.0 / 3);
  command.chopping = Chopping::hard;
  EXPECT_DOUBLE_EQ(floating_voltage(voltages, s, 2, true, command, 24.0).w_V, -24.0 / 3);
  s.u[2] = bus_counts;
  EXPECT_FALSE(floating_voltage(voltages, s, 2, true, command, 24.0).known) << "it has the back-EMF's sign";
  EXPECT_TRUE(floating_voltage(voltages, s, 2, false, command, 24.0).known);
  command.enabled = false;
  EXPECT_FALSE(floating_voltage(voltages, s, 2, true, command, 24.0).held) << "nothing flows";
}

TEST(Observer, TheDefaultFollowsTheTerminalsOwnCrossings) {
  ObserverState<double> state;
  const Observed o =
      observer_step(ObserverConfig<double>{}, state, driven_sample(0, 10, 500, 0), {}, {}, std::uint8_t{0});
  EXPECT_FALSE(o.follows);
}

/// While the old current decays, no crossing is reported. A crossing during this time is reported after the
/// decay.
TEST(Observer, IsBlindUntilTheOldCurrentHasRunOut) {
  for (const Follow which : {Follow::luenberger, Follow::sliding_mode, Follow::flux}) {
    ObserverConfig<double> config;
    config.follow = which;
    config.voltage = voltages;
    config.voltage.through_freewheel = false;
    config.luenberger = luenberger<double>();
    config.sliding_mode = sliding<double>();
    config.flux = flux<double>(20);
    config.counts_per_V = 3 * bus_counts / 24.0;
    const ZeroCrossingConfig crossing{.rail_counts = 60, .threshold = 12, .below = 12};
    ObserverState<double> state;
    ZeroCrossingState looked;
    zero_crossing_begin(looked, 0, 0, 0);
    const BridgeCommand<double> command{.enabled = true, .pair = positive_pair(0), .duty = 1.0};
    for (std::uint32_t n = 0; n < 12; ++n) {
      const double deg = 4.0 * n, held_to = 40.0;
      TerminalSample s = driven_sample(0, deg, 600, n);
      if (deg < held_to) s.u[2] = 0;
      const Observed o = observer_step(config, state, s, command,
                                       {.i_c_A = deg < held_to ? 3.0 : 0.0, .bus_V = 24.0}, std::uint8_t{0});
      const CrossingReading reading = observed_crossing_step(crossing, looked, s, o, true);
      EXPECT_EQ(o.blind, deg < held_to) << int(which) << " " << n;
      EXPECT_EQ(reading.crossing, deg == held_to ? Crossing::passed_before : Crossing::none)
          << int(which) << " " << n;
    }
    EXPECT_TRUE(looked.hidden);
  }
}

/// The rotor passes all six sectors in both directions. In each sector, y falls from 2 E to -2 E (back-EMF
/// E), in the counts of the crossing finder.
TEST(Observer, GoesOverFromLegToLeg) {
  for (const Follow which : {Follow::luenberger, Follow::sliding_mode, Follow::flux})
    for (const int way : {1, -1}) {
      ObserverConfig<double> config;
      config.follow = which;
      config.voltage = voltages;
      config.luenberger = luenberger<double>();
      config.sliding_mode = sliding<double>();
      config.flux = flux<double>(20);
      config.counts_per_V = 3 * bus_counts / 24.0;
      ObserverState<double> state;
      BridgeCommand<double> command{.enabled = true, .duty = 1.0};
      const double E = 600, ticks = 20,
                   lag = which == Follow::flux         ? 0.5
                         : which == Follow::luenberger ? 2 * p / (1 - p) + 0.5
                                                       : (1 - share) / share + 0.5;
      for (int n = 0; n < 240; ++n) {
        const double deg = way * 60.0 * (n + 0.25) / ticks;
        const int turned = static_cast<int>(std::floor(deg / 60));
        const auto sector = static_cast<std::uint8_t>((turned % 6 + 6) % 6);
        command.pair = way > 0 ? positive_pair(sector) : swapped(positive_pair(sector));
        const TerminalSample s = driven_sample(sector, deg, way * E, static_cast<std::uint32_t>(n));
        const Observed o = observer_step(config, state, s, command, {.bus_V = 24.0}, sector);
        // The response to the previous sector has decayed, so the observer's y is equal to the true y,
        // delayed by the lag.
        const double since = std::fmod(n + 0.25, ticks);
        if (n < ticks || since < 8) continue;
        const double y = 2 * E * (1 - 2 * (since - lag) / ticks);
        EXPECT_NEAR(o.y, y, 4 + 2 * E * 10 * std::pow(0.5, since)) << int(which) << " tick " << n;
      }
    }
}

}  // namespace SIXSTEP_TEST_FILE
