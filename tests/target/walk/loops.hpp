// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks of the loops: arithmetic, controllers, setpoints. A walk draws a configuration and then
// executes steps. The state continues from one configuration to the next.
#pragma once
#include "sixstep/control/commutation_step.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/control/derivative.hpp"
#include "sixstep/control/feed_forward.hpp"
#include "sixstep/control/hysteresis.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/pi_positional.hpp"
#include "sixstep/control/profile.hpp"
#include "sixstep/control/pwm_pattern.hpp"
#include "sixstep/control/slew.hpp"
#include "sixstep/control/smooth_chopping.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"
#include "tests/target/walk/sensing.hpp"

namespace target {

template <class Scalar>
struct ArithmeticWalk {
  Gain<Scalar> factor{};
  Divisor<Scalar> divisor{};

  void draw(Random& r) {
    factor = gain<Scalar>(r, -6, 24);
    divisor = Number<Scalar>::divisor(static_cast<std::int16_t>(1 + (r.bits() & 0x3fff)), 14);
  }
  void step(Random& r, Digest& mix) {
    using T = ScalarTraits<Scalar>;
    const Scalar x = signal<Scalar>(r), y = signal<Scalar>(r);
    mix(x + y, x - y, x * y, -x, T::half_difference(x, y), T::product(x, factor), T::quotient(x, divisor));
    if (y != Scalar{} || !__is_same(Scalar, float)) mix(x / y);
    const Accumulator<Scalar> sum = T::accumulated(T::wide(x) - T::wide(y), factor);
    mix(sum, T::signal(sum), T::share(sum, factor), -sum);
    const std::uint32_t whole = r.long_bits();
    mix(clamped(x, magnitude(y)), between(x, -magnitude(y), Scalar{}),
        T::fraction(r.long_bits() >> 2, whole));
    mix(T::counts(static_cast<std::int32_t>(r.long_bits()) / 65536, factor));
    if constexpr (!__is_same(Scalar, float)) {
      saw("a product that saturates", T::product(x, factor) == Number<Scalar>::end(false));
      saw("a sum that saturates", x + y == Number<Scalar>::end(true));
    }
  }
};

template <class Scalar>
struct PiWalk {
  PiConfig<Scalar> config{};
  PiState<Scalar> state{};

  void draw(Random& r) { config = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive<Scalar>(r)}; }
  void step(Random& r, Digest& mix) {
    const Scalar error = signal<Scalar>(r), low = -positive<Scalar>(r), high = positive<Scalar>(r);
    const bool own_limits = r.one_in(2);
    const Scalar u = counted<0>("pi_step", [&] {
      return own_limits ? pi_step(config, state, error) : pi_step(config, state, error, low, high);
    });
    mix(u, state.u, state.e);
    saw("at the upper limit", u == config.limit);
    saw("at the lower limit", u == -config.limit);
    saw("within the limits", u < config.limit && u > -config.limit);
  }
};

template <class Scalar>
struct PiPositionalWalk {
  PiPositionalConfig<Scalar> config{};
  PiPositionalState<Scalar> state{};

  void draw(Random& r) {
    config = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive_gain<Scalar>(r, 0, 4), positive<Scalar>(r),
              gain<Scalar>(r, 3)};
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    const Scalar error = signal<Scalar>(r), more = signal<Scalar>(r);
    const Scalar u =
        counted<0>("pi_positional_step", [&] { return pi_positional_step(config, state, error, more); });
    mix(u, state.integral);
    saw("cut by the limit", u == config.limit || u == -config.limit);
    saw("within the limit", u < config.limit && u > -config.limit);
  }
};

template <class Scalar>
struct DerivativeWalk {
  DerivativeConfig<Scalar> config{};
  DerivativeState<Scalar> state{};

  void draw(Random& r) {
    config = {gain<Scalar>(r, -3), positive_gain<Scalar>(r, 0, 4)};
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    const Scalar x = signal<Scalar>(r);
    const Accumulator<Scalar> y =
        counted<0>("derivative_step", [&] { return derivative_step(config, state, x); });
    mix(y, state.x, state.started, ScalarTraits<Scalar>::signal(y));
    if constexpr (!__is_same(Scalar, float))
      saw("beyond a signal", ScalarTraits<Scalar>::accumulator(ScalarTraits<Scalar>::signal(y)) < y);
  }
};

template <class Scalar>
struct SlewWalk {
  SlewConfig<Scalar> config{};
  SlewState<Scalar> state{};
  Scalar target{};

  void draw(Random& r) {
    config = {Number<Scalar>::sum(static_cast<std::int32_t>(r.long_bits() >> 4) >> r.below(14))};
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(16)) target = signal<Scalar>(r);
    const Scalar y = counted<0>("slew_step", [&] { return slew_step(config, state, target); });
    mix(y, state.y);
    saw("on its target", y == target);
    saw("on its way", y < target);
  }
};

template <class Scalar>
struct HysteresisWalk {
  HysteresisConfig<Scalar> config{};
  HysteresisState<Scalar> state{};

  void draw(Random& r) { config = {positive<Scalar>(r, 8000), Watch::none}; }
  void step(Random& r, Digest& mix) {
    const bool was = state.on;
    const Scalar current = positive<Scalar>(r), reference = positive<Scalar>(r);
    mix(counted<0>("hysteresis_step", [&] { return hysteresis_step(config, state, current, reference); }));
    saw("switched on", state.on && !was);
    saw("switched off", !state.on && was);
  }
};

template <class Scalar>
struct FeedForwardWalk {
  FeedForwardConfig<Scalar> config{};
  BusCompensationConfig<Scalar> bus{};

  void draw(Random& r) {
    config = {positive_gain<Scalar>(r, -2)};
    bus = {positive<Scalar>(r) + Number<Scalar>::digit(false)};
  }
  void step(Random& r, Digest& mix) {
    const Scalar measured = signal<Scalar>(r), u = signal<Scalar>(r), speed = signal<Scalar>(r);
    const Scalar duty = counted<0>("compensated_duty", [&] { return compensated_duty(bus, u, measured); });
    mix(counted<1>("back_emf_voltage", [&] { return back_emf_voltage(config, speed); }), duty);
    saw("a bus that has been lost", measured < bus.lowest_bus_V);
    saw("all the bus", duty == one<Scalar>);
  }
};

template <class Scalar>
struct SmoothChoppingWalk {
  SmoothChoppingConfig<Scalar> config{};
  SmoothChoppingState<Scalar> state{};

  void draw(Random& r) {
    config.complementary_below_A = positive<Scalar>(r, 8000);
    config.soft_above_A = config.complementary_below_A + positive<Scalar>(r, 8000);
  }
  void step(Random& r, Digest& mix) {
    const Chopping was = state.chopping;
    const Scalar i_m = signal<Scalar>(r);
    const bool reversed = r.one_in(4);
    mix(static_cast<std::uint8_t>(counted<0>(
        "smooth_chopping_step", [&] { return smooth_chopping_step(config, state, reversed, i_m); })));
    saw("became soft", was != Chopping::soft && state.chopping == Chopping::soft);
    saw("became complementary", was == Chopping::soft && state.chopping != Chopping::soft);
  }
};

/// The rotor turns mostly in one direction. It is driven or braked.
template <class Scalar>
struct PwmPatternWalk {
  PwmPatternConfig<Scalar> config{};
  PwmPatternState<Scalar> state{};
  unsigned sector = 0;

  void draw(Random& r) {
    config = {static_cast<PwmPattern>(r.below(pwm_patterns)), positive_gain<Scalar>(r, 0)};
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(8)) sector = (sector + (r.one_in(4) ? 5 : 1)) % 6;
    const auto now = static_cast<std::uint8_t>(sector);
    const Scalar speed = signal<Scalar>(r);
    const Pair pair = r.one_in(4) ? swapped(positive_pair(now)) : positive_pair(now);
    counted<0>("move_in_sector", [&] { move_in_sector(config, state, now, speed); });
    const ChoppedSwitch chopped =
        counted<1>("chopped_switch", [&] { return chopped_switch(config, state, now, pair); });
    mix(static_cast<std::uint8_t>(chopped), state.passed);
    const bool halves = config.pattern == PwmPattern::pwm_on_pwm;
    saw("chops the lower switch", chopped == ChoppedSwitch::lower);
    saw("the first half of a sector",
        halves && state.passed < ScalarTraits<Scalar>::accumulator(one<Scalar>));
    saw("the second", halves && !(state.passed < ScalarTraits<Scalar>::accumulator(one<Scalar>)));
  }
};

/// The rotor turns mostly in one direction, and the current of its leaving phase decays.
template <class Scalar>
struct CommutationStepWalk {
  CommutationStepConfig<Scalar> config{};
  CommutationStepState<Scalar> state{};
  unsigned sector = 0;

  void draw(Random& r) {
    config = {positive_gain<Scalar>(r, 0),  positive_gain<Scalar>(r, -1),
              positive_gain<Scalar>(r, -2), r.one_in(2) ? Scalar{} : positive<Scalar>(r, 8000),
              positive_gain<Scalar>(r, 0),  positive_gain<Scalar>(r, -4),
              positive_gain<Scalar>(r, -4), signal<Scalar>(r)};
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    const bool moves = r.one_in(8);
    if (moves) sector = (sector + (r.one_in(4) ? 5 : 1)) % 6;
    const auto now = static_cast<std::uint8_t>(sector);
    if (moves && r.one_in(2)) counted<0>("enter_sector", [&] { enter_sector(config, state, now); });
    const bool before = state.hands_over;
    const Measurement<Scalar> m = drawn_measurement<Scalar>(r);
    const bool reversed = r.one_in(4);
    counted<1>("watch_leaving", [&] { watch_leaving(config, state, m, now, reversed); });
    const Scalar volts = corrected_voltage(config, state, m.i_a_A);
    state.part =
        between(volts, Scalar{}, Scalar{} < config.overlap_bus_V ? one<Scalar> : half_of_one<Scalar>());
    const Pair pair = reversed ? swapped(positive_pair(now)) : positive_pair(now);
    const ChoppedSwitch chopped = r.one_in(2) ? ChoppedSwitch::lower : ChoppedSwitch::upper;
    const Scalar duty = counted<2>("holding_duty", [&] { return holding_duty(state, pair, chopped); });
    const Scalar overlap = holding_overlap(state, pair);
    mix(state.hands_over, state.driven_A, volts, duty, overlap);
    saw("overlaps", overlap != Scalar{});
    saw("hands over", state.hands_over);
    saw("has handed over", before && !state.hands_over);
  }
};

template <class Scalar>
struct DeadbeatWalk {
  DeadbeatConfig<Scalar> config{};
  DeadbeatState<Scalar> state{};

  void draw(Random& r) {
    const auto held = [&] {
      return HeldWinding<Scalar>{positive_gain<Scalar>(r, 0), positive_gain<Scalar>(r, 0)};
    };
    config.wait = held();
    config.rest = held();
    config.decay = positive_gain<Scalar>(r, 0);
    config.V_per_A = positive_gain<Scalar>(r, -3);
    config.correction_V_per_A = positive_gain<Scalar>(r, -2);
    config.K_t_V_s = positive_gain<Scalar>(r, 0);
    config.limit = positive<Scalar>(r);
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    const Scalar reference = signal<Scalar>(r), current = signal<Scalar>(r), speed = signal<Scalar>(r);
    const Scalar u =
        counted<0>("deadbeat_step", [&] { return deadbeat_step(config, state, reference, current, speed); });
    mix(u, state.predicted, state.missed);
    saw("at its limit", u == config.limit || u == -config.limit);
    saw("within it", u < config.limit && u > -config.limit);
  }
};

template <class Scalar>
struct ProfileWalk {
  ProfileConfig<Scalar> config{};
  ProfileState<Scalar> state{};
  Scalar target{};

  void draw(Random& r) {
    config = {positive<Scalar>(r, 4000), positive<Scalar>(r, 300)};
    if (r.one_in(4)) state = {};
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(64)) target = signal<Scalar>(r);
    const Scalar position = counted<0>("profile_step", [&] { return profile_step(config, state, target); });
    mix(position, state.velocity);
    saw("cruises", state.velocity == config.speed && config.speed > Scalar{});
    saw("stands on its target", state.position == target && state.velocity == Scalar{});
    saw("goes back", state.velocity < Scalar{});
  }
};

}  // namespace target
