// SPDX-License-Identifier: Apache-2.0
// Computes a jerk-limited profile: a position setpoint within limits of speed, acceleration and jerk that
// stops exactly on its target. The target may change at any tick. The profile also computes speed and
// acceleration for feed-forward.
//
// The profile is the mean of a trapezoidal speed over the last M strides. The mean's acceleration has ramps
// (Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, 4.5; Lambrechts et
// al., Trajectory planning and feedforward design, 2005). a[n] is the trapezoid's change of speed in stride
// n:
//
//   v = 1/M sum of the trapezoid's speeds       |v| and |change of v| are within the trapezoid's limits
//   change of acceleration = (a[n] - a[n-M])/M  is at most a/M if a[n] does not change sign within M strides
//
// Before its acceleration changes sign, the trapezoid keeps its speed for M strides. The time does not
// increase, because with limited jerk the acceleration passes through 0 anyway. Each stride uses the fastest
// speed v from which the profile still stops on the target. It first keeps v for c strides: c = M if the
// trapezoid gains speed, c = 0 if it loses speed (profile.hpp, with c strides more). R is the remaining
// distance, and a the acceleration limit:
//
//   c v + v + (v - a) + .. = R,   v = (R + a m (m + 1)/2)/(m + 1 + c),
//   m: largest integer with a m (2 c + m + 1)/2 <= R
//
// The time of a move over a distance d is d/v + v/a + a/j (j: jerk limit) if the move is long enough to reach
// its speed and acceleration limits. No profile is faster. The time of a shorter move is slightly above that
// of the fastest profile. If the target is nearer than the stopping distance, the profile passes it and
// returns.
//
// A stride has one control tick, or as many ticks as necessary for M <= 64. Then 64 stored numbers suffice
// for any jerk. Between two strides the setpoint is the cubic B-spline of the means: position, speed and
// acceleration are continuous. The spline's derivatives are B-splines of the differences; each limit is
// therefore valid at every instant. The spline lags by three strides.
//
// Speeds and distances are integer counts. One stride at full speed is 2^26 counts. Sums are exact and cannot
// drift, and the final position is exactly the target. A new target moves the setpoint at once by at most
// half a count, 2^-27 of a stride at full speed. From rest, a distance of at most M counts needs one stride.
// A distance beyond 2^28 strides at full speed is covered in parts.
//
// The profile is for float and double only: a fixed-point position in degrees cannot represent the increment
// of one tick.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

inline constexpr int jerk_profile_cells = 64;  ///< largest M
inline constexpr std::int32_t jerk_profile_speed = std::int32_t{1}
                                                   << 26;  ///< the speed limit, in counts per stride
inline constexpr std::int64_t jerk_profile_farthest = std::int64_t{1} << 54;  ///< largest distance, in counts

inline constexpr double jerk_profile_longest = 64.0 * 65535;  ///< largest number of ticks in M strides

/// Configuration; jerk_profile() computes it. A part is 1/M of a count. Default: the position never changes.
template <class Scalar>
struct JerkProfileConfig {
  Scalar counts_per_deg{};
  Scalar deg_per_part{};
  Scalar rad_s_per_part{};      ///< rad/s of one part per stride
  Scalar rad_s2_per_part{};     ///< rad/s^2 of one part per stride^2
  Scalar stride_per_tick{};     ///< strides per control tick, 1/ticks
  std::int32_t acceleration{};  ///< a, counts per stride^2
  std::uint16_t ticks = 1;      ///< control ticks in a stride
  std::uint8_t cells = 1;       ///< M, number of strides in the mean
  bool operator==(const JerkProfileConfig&) const = default;
};

template <class Scalar>
struct ProfiledMotion {
  Scalar position_deg{}, speed_rad_s{}, acceleration_rad_s2{};
};

template <class Scalar>
struct JerkProfileState {
  ProfiledMotion<Scalar> now{};
  Scalar target_deg{};      ///< the target that the strides use
  std::int64_t way{};       ///< remaining distance of the trapezoid, counts
  std::int64_t rest{};      ///< remaining distance of the mean, parts
  std::int64_t mean[3]{};   ///< last speeds of the mean, parts per stride, newest first
  std::int32_t velocity{};  ///< the trapezoid's speed, counts per stride
  std::int32_t begun{};     ///< speed before the begin, counts per stride; used in place of cells that are
                            ///< not filled yet
  std::int32_t cell[jerk_profile_cells]{};
  /// Polynomial of this stride: remaining distance in parts, speed, acceleration, change of acceleration.
  Scalar spline[4]{};
  std::uint16_t tick{};           ///< tick within the stride
  std::uint8_t next{}, filled{};  ///< index of the next cell, and number of filled cells
  std::uint8_t waits{};           ///< strides until the acceleration may change its sign
  std::int8_t sign{};             ///< sign of the last acceleration
};

/// Limits of a profile.
struct JerkProfileLimits {
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double smoothing_s = 0.0;  ///< a/j: time in which the acceleration rises to its limit; rounded up to whole
                             ///< strides
};

/// Computes a configuration in double, at compile time or on a host. If a limit is not above 0, the result is
/// the default configuration.
template <class Scalar = double>
constexpr JerkProfileConfig<Scalar> jerk_profile(const JerkProfileLimits& limits, double period_s) {
  constexpr double degrees = 57.295779513082320877;
  if (!(limits.speed_rad_s > 0) || !(limits.acceleration_rad_s2 > 0) || !(period_s > 0)) return {};
  // The factor is below 1, because otherwise an error in the last digits of a whole number of periods could
  // add a period.
  const double wanted = between(limits.smoothing_s / period_s * (1 - 1e-12), 0.0, jerk_profile_longest);
  const auto whole = static_cast<std::int32_t>(wanted);
  const std::int32_t smooth = static_cast<double>(whole) < wanted ? whole + 1 : whole < 1 ? 1 : whole;
  const std::int32_t ticks = (smooth + jerk_profile_cells - 1) / jerk_profile_cells;
  const std::int32_t cells = (smooth + ticks - 1) / ticks;
  const auto strides = static_cast<double>(cells), stride_s = static_cast<double>(ticks) * period_s;
  const auto most = static_cast<double>(jerk_profile_speed);
  const double rad = limits.speed_rad_s * stride_s / most;  // angle of a count
  const double steepest = limits.acceleration_rad_s2 * stride_s * stride_s / rad;
  return {.counts_per_deg = static_cast<Scalar>(1 / (rad * degrees)),
          .deg_per_part = static_cast<Scalar>(rad * degrees / strides),
          .rad_s_per_part = static_cast<Scalar>(rad / stride_s / strides),
          .rad_s2_per_part = static_cast<Scalar>(rad / stride_s / stride_s / strides),
          .stride_per_tick = static_cast<Scalar>(1.0 / static_cast<double>(ticks)),
          .acceleration = static_cast<std::int32_t>(between(steepest, 1.0, most)),
          .ticks = static_cast<std::uint16_t>(ticks),
          .cells = static_cast<std::uint8_t>(cells)};
}

namespace detail {

/// Converts an integer to Scalar in two halves. Cores with a single-precision unit convert 32 bits in one
/// instruction; 64 bits would need a library function.
template <class Scalar>
constexpr Scalar scalar_of(std::int64_t n) {
  constexpr Scalar half = Scalar(4294967296.0);
  const bool below = n < 0;
  const auto size = static_cast<std::uint64_t>(below ? -n : n);
  const Scalar x = static_cast<Scalar>(static_cast<std::uint32_t>(size >> 32)) * half +
                   static_cast<Scalar>(static_cast<std::uint32_t>(size));
  return below ? -x : x;
}

/// Rounds to the nearest count, limited to +-jerk_profile_farthest.
template <class Scalar>
constexpr std::int64_t counts_of(Scalar x) {
  constexpr Scalar half = Scalar(4294967296.0), most = half * Scalar(4194304.0);
  const bool below = x < Scalar{};
  const Scalar size = (below ? -x : x) + Scalar(0.5);
  if (!(size < most)) return below ? -jerk_profile_farthest : jerk_profile_farthest;
  const auto high = static_cast<std::uint32_t>(size / half);
  const auto low = static_cast<std::uint32_t>(size - static_cast<Scalar>(high) * half);
  const auto n = static_cast<std::int64_t>((static_cast<std::uint64_t>(high) << 32) | low);
  return below ? -n : n;
}

/// n/d rounded down, for n >= 0 and a quotient below 2^27. Computed bit by bit, because small cores need a
/// library function for a 64-bit division.
constexpr std::int32_t quotient_27(std::int64_t n, std::int64_t d) {
  std::int32_t q = 0;
  for (std::int8_t bit = 26; bit >= 0; --bit) {
    if ((d << bit) > n) continue;
    n -= d << bit;
    q |= std::int32_t{1} << bit;
  }
  return q;
}

/// The fastest v for which c strides at v and the braking afterwards need at most the distance R.
constexpr std::int32_t fastest_within(std::int64_t R, std::int64_t a, std::int64_t c) {
  const auto way = [a, c](std::int64_t m) { return m * a * (2 * c + m + 1) / 2; };
  std::int64_t low = 0, high = jerk_profile_speed / static_cast<std::int32_t>(a) + 1;
  if (way(high) <= R) return jerk_profile_speed;
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (way(middle) <= R ? low : high) = middle;
  }
  const std::int32_t v = quotient_27(R + low * a * (low + 1) / 2, low + 1 + c);
  return v < jerk_profile_speed ? v : jerk_profile_speed;
}

/// The trapezoid's next speed towards a target at distance R. `gains`, `loses`: true if the speed may
/// increase or decrease now; the acceleration must not change its sign within M strides.
constexpr std::int32_t next_speed(std::int64_t R, std::int32_t last, std::int32_t a, std::int32_t cells,
                                  bool gains, bool loses) {
  const std::int32_t gained = fastest_within(R, a, cells);
  if (gained > last && gains) return gained < last + a ? gained : last + a;
  const std::int32_t kept = fastest_within(R, a, 0);
  if (kept < last && loses) return kept > last - a ? kept : last - a;
  return last;
}

template <class Scalar>
constexpr void trapezoid_stride(const JerkProfileConfig<Scalar>& config, JerkProfileState<Scalar>& state) {
  const bool back = state.way < 0;
  // A distance up to `least` is covered in one stride. The acceleration is then negligible, and the speed
  // R/(M + 1) would round to 0 counts.
  const std::int64_t least = config.cells < config.acceleration ? config.cells : config.acceleration;
  if (state.velocity == 0 && state.waits == 0 && state.way <= least && state.way >= -least) {
    state.velocity = static_cast<std::int32_t>(state.way);
    state.way = 0;
    return;
  }
  const std::int32_t last = back ? -state.velocity : state.velocity, sign = back ? -state.sign : state.sign;
  const std::int32_t v = next_speed(back ? -state.way : state.way, last, config.acceleration, config.cells,
                                    state.waits == 0 || sign > 0, state.waits == 0 || sign < 0);
  if (v != last) {
    state.sign = (v > last) != back ? std::int8_t{1} : std::int8_t{-1};
    state.waits = config.cells;
  } else if (state.waits > 0) {
    --state.waits;
  }
  state.velocity = back ? -v : v;
  state.way -= state.velocity;
}

template <class Scalar>
constexpr void mean_stride(const JerkProfileConfig<Scalar>& config, JerkProfileState<Scalar>& state) {
  std::int32_t& cell = state.cell[state.next];
  const std::int32_t leaves = state.filled < config.cells ? state.begun : cell;
  if (state.filled < config.cells) ++state.filled;
  cell = state.velocity;
  if (++state.next >= config.cells) state.next = 0;
  state.mean[2] = state.mean[1];
  state.mean[1] = state.mean[0];
  state.mean[0] += state.velocity - leaves;
  state.rest -= state.mean[0];
}

/// The B-spline's segment for this stride, as a polynomial of the elapsed fraction of the stride.
template <class Scalar>
constexpr void spline_stride(JerkProfileState<Scalar>& state) {
  const std::int64_t *S = state.mean, six_times = 6 * (state.rest + S[0]) + 5 * S[1] + S[2];
  state.spline[0] = scalar_of<Scalar>(six_times) / Scalar(6);
  state.spline[1] = scalar_of<Scalar>(S[1] + S[2]) * Scalar(0.5);
  state.spline[2] = scalar_of<Scalar>(S[1] - S[2]);
  state.spline[3] = scalar_of<Scalar>(S[0] - 2 * S[1] + S[2]);
}

/// Adds the change of the target to the remaining distances, once for each new target.
template <class Scalar>
constexpr void take_target(const JerkProfileConfig<Scalar>& config, JerkProfileState<Scalar>& state,
                           Scalar target_deg) {
  if (target_deg == state.target_deg) return;
  std::int64_t on = counts_of((target_deg - state.target_deg) * config.counts_per_deg);
  const std::int64_t most = jerk_profile_farthest - state.way, least = -jerk_profile_farthest - state.way;
  if (on >= most || on <= least) {
    on = on >= most ? most : least;
    state.target_deg = state.target_deg + scalar_of<Scalar>(on) / config.counts_per_deg;
  } else {
    state.target_deg = target_deg;
  }
  state.way += on;
  state.rest += on * config.cells;
}

}  // namespace detail

/// Starts the profile at a position, degrees, and a speed, rad/s, without acceleration.
template <class Scalar>
constexpr void begin_profile(const JerkProfileConfig<Scalar>& config, JerkProfileState<Scalar>& state,
                             Scalar position_deg, Scalar speed_rad_s) {
  state = {};
  state.now = {position_deg, speed_rad_s, Scalar{}};
  state.target_deg = position_deg;
  if (config.acceleration == 0) return;
  const std::int64_t M = config.cells;
  const Scalar unit = config.rad_s_per_part * static_cast<Scalar>(M);
  const std::int64_t most = jerk_profile_speed;
  const std::int64_t v = between(detail::counts_of(speed_rad_s / unit), -most, most);
  state.velocity = state.begun = static_cast<std::int32_t>(v);
  for (std::int64_t& mean : state.mean) mean = M * v;
  state.way =
      -v * (M + 1) / 2;  // the mean lags the trapezoid by (M - 1)/2 strides, the spline lags the mean by one
                         // stride
  state.rest = M * state.way + v * (M * (M - 1) / 2);
}

/// One control tick.
template <class Scalar>
constexpr const ProfiledMotion<Scalar>& jerk_profile_step(const JerkProfileConfig<Scalar>& config,
                                                          JerkProfileState<Scalar>& state,
                                                          Scalar target_deg) {
  if (config.acceleration == 0) return state.now;
  if (state.tick == 0) {
    detail::take_target(config, state, target_deg);
    detail::trapezoid_stride(config, state);
    detail::mean_stride(config, state);
    detail::spline_stride(state);
  }
  if (++state.tick >= config.ticks) state.tick = 0;
  const Scalar s = state.tick == 0 ? Scalar(1) : static_cast<Scalar>(state.tick) * config.stride_per_tick;
  const Scalar *c = state.spline, half = Scalar(0.5) * s, third = s / Scalar(3);
  const Scalar gone = s * (c[1] + half * (c[2] + third * c[3]));
  state.now.position_deg = state.target_deg - config.deg_per_part * (c[0] - gone);
  state.now.speed_rad_s = config.rad_s_per_part * (c[1] + s * (c[2] + half * c[3]));
  state.now.acceleration_rad_s2 = config.rad_s2_per_part * (c[2] + s * c[3]);
  return state.now;
}

}  // namespace sixstep::control
