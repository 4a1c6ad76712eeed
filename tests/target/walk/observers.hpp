// SPDX-License-Identifier: Apache-2.0
// Walks of the back-EMF observers of sensorless/. Each observer is tested separately on a floating phase. All
// observers are tested together with the selection between them, at the terminals of a turning rotor.
#pragma once
#include "sixstep/control/sensorless/observer.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/terminals.hpp"

namespace target {

inline constexpr std::int32_t q15_one = 32768;

/// The gain n/2^15 times 2^up. n is limited to 2^15 - 1.
template <class Scalar>
constexpr Gain<Scalar> gain_15(std::int32_t n, std::int8_t up = 0) {
  const std::int32_t held = n > q15_one - 1 ? q15_one - 1 : n;
  return Number<Scalar>::gain(static_cast<std::int16_t>(held), static_cast<std::int8_t>(15 - up));
}

/// A random winding in units of 2^-15: a = exp(-R T/L), and b = (1 - a)/R in A/V (resistance R, inductance L,
/// period T).
struct DrawnWinding {
  std::int32_t a = 0, b = 1;

  constexpr explicit DrawnWinding(Random& r) {
    a = 20000 + r.bits() % 12000;
    b = 2000 + r.bits() % 14000;
  }
  /// x/b, in units of 2^-10
  constexpr std::int32_t over_b(std::int32_t x) const { return x * 1024 / b; }
};

/// Random gains l and h that place both poles at p with p^2 < a: (1 - l) a = p^2 and h b = (1 - p)^2.
template <class Scalar>
LuenbergerConfig<Scalar> drawn_luenberger(Random& r, const DrawnWinding& winding) {
  const std::int32_t p = r.bits() % 22000, square = p * p / q15_one;
  const std::int32_t apart = (q15_one - p) / 2;  // the square below fits 32 bits
  return {gain_15<Scalar>(winding.a), gain_15<Scalar>(winding.b),
          gain_15<Scalar>(q15_one - square * 1024 / (winding.a / 32)),
          gain_15<Scalar>(winding.over_b(apart * apart / q15_one * 4), 5)};
}

/// Random gains of the sliding-mode observer. With the slope a/b, the correction z is a e after one period
/// (error e).
template <class Scalar>
SlidingModeConfig<Scalar> drawn_sliding_mode(Random& r, const DrawnWinding& winding) {
  SlidingModeConfig<Scalar> config{};
  config.decay = gain_15<Scalar>(winding.a);
  config.drive = gain_15<Scalar>(winding.b);
  config.slope = gain_15<Scalar>(winding.over_b(winding.a), 5);
  config.limit_V = positive<Scalar>(r);
  config.raise = gain_15<Scalar>(q15_one * 512 / (winding.a / 32), 1);
  config.share = gain_15<Scalar>(2000 + r.bits() % 30000);
  return config;
}

template <class Scalar>
FluxLinkageConfig<Scalar> drawn_flux(Random& r, const DrawnWinding& winding) {
  FluxLinkageConfig<Scalar> config{};
  config.decay = gain_15<Scalar>(winding.a);
  config.stiffness = gain_15<Scalar>(winding.over_b(q15_one - 1), 5);
  config.per_V = gain_15<Scalar>(12000 + r.bits() % 8000, 2);
  config.level = Number<Scalar>::part(0x20000000);
  return config;
}

/// The back-EMF of the floating phase falls. After the old current of the next floating phase has decayed,
/// the back-EMF of that phase begins.
template <class Scalar>
struct FloatingPhase {
  std::int32_t size = 0x10000000, fall = 0x01000000, e = 0;  ///< 2^-31 of the range
  std::uint8_t runs_out = 0;                                 ///< remaining periods with the old current
  bool begins = false, released = false;
  Scalar w_V{}, i_A{};

  void draw(Random& r) {
    size = 0x02000000 + static_cast<std::int32_t>(r.long_bits() >> 3);
    fall = size / (4 + r.below(60));
  }
  void step(Random& r) {
    begins = e <= -size;
    e = begins ? size : e - fall;
    released = runs_out == 1;
    runs_out = begins ? r.below(4) : runs_out > 0 ? static_cast<std::uint8_t>(runs_out - 1) : std::uint8_t{0};
    const auto any = static_cast<std::int32_t>(r.long_bits());
    w_V = r.one_in(24) ? signal<Scalar>(r) : Number<Scalar>::part(e + any / 128);
    i_A = r.one_in(24) ? signal<Scalar>(r) : Number<Scalar>::part(runs_out > 0 ? any / 4 : any / 256);
  }
};

template <class Scalar>
struct LuenbergerWalk {
  LuenbergerConfig<Scalar> config{};
  LuenbergerState<Scalar> state{};
  FloatingPhase<Scalar> phase{};

  void draw(Random& r) {
    phase.draw(r);
    config = drawn_luenberger<Scalar>(r, DrawnWinding(r));
  }
  void step(Random& r, Digest& mix) {
    phase.step(r);
    if (phase.begins) counted<2>("luenberger_begin", [&] { luenberger_begin(state); });
    if (phase.released) counted<1>("luenberger_set", [&] { luenberger_set(state, phase.w_V, phase.i_A); });
    const bool known = !r.one_in(12);
    const Scalar e = known ? counted<0>("luenberger_step",
                                        [&] { return luenberger_step(config, state, phase.w_V, phase.i_A); })
                           : luenberger_hold(state, phase.i_A);
    mix(e, state.i_A, state.e_V);
    saw("above zero", e > Scalar{});
    saw("below zero", e < Scalar{});
    saw("the next leg", phase.begins);
    saw("a leg that has come free", phase.released);
    saw("a period that is not known", !known);
    if constexpr (!__is_same(Scalar, float))
      saw("at an end of the format", magnitude(e) == Number<Scalar>::end(false));
  }
};

template <class Scalar>
struct SlidingModeWalk {
  SlidingModeConfig<Scalar> config{};
  SlidingModeState<Scalar> state{};
  FloatingPhase<Scalar> phase{};

  void draw(Random& r) {
    phase.draw(r);
    config = drawn_sliding_mode<Scalar>(r, DrawnWinding(r));
  }
  void step(Random& r, Digest& mix) {
    phase.step(r);
    if (phase.begins) counted<2>("sliding_mode_begin", [&] { sliding_mode_begin(state); });
    if (phase.released)
      counted<1>("sliding_mode_set", [&] { sliding_mode_set(config, state, phase.w_V, phase.i_A); });
    const bool known = !r.one_in(12);
    const Scalar e = known
                         ? counted<0>("sliding_mode_step",
                                      [&] { return sliding_mode_step(config, state, phase.w_V, phase.i_A); })
                         : sliding_mode_hold(state, phase.i_A);
    mix(e, state.i_A, state.error_A, state.z_V, state.e_V);
    saw("within the layer", magnitude(state.z_V) < config.limit_V);
    saw("at the upper limit", state.z_V == config.limit_V);
    saw("at the lower limit", state.z_V == -config.limit_V);
    saw("above zero", e > Scalar{});
    saw("below zero", e < Scalar{});
    saw("a period that is not known", !known);
  }
};

template <class Scalar>
struct FluxLinkageWalk {
  FluxLinkageConfig<Scalar> config{};
  FluxLinkageState<Scalar> state{};
  FloatingPhase<Scalar> phase{};

  void draw(Random& r) {
    phase.draw(r);
    config = drawn_flux<Scalar>(r, DrawnWinding(r));
  }
  void step(Random& r, Digest& mix) {
    phase.step(r);
    if (phase.begins) flux_linkage_begin(state);
    const bool known = !r.one_in(12);
    const Scalar g =
        known ? counted<0>("flux_linkage_step",
                           [&] { return flux_linkage_step(config, state, phase.w_V, phase.i_A); })
              : counted<1>("flux_linkage_hold", [&] { return flux_linkage_hold(state, phase.i_A); });
    Scalar part{};
    const bool comes = counted<2>("flux_level_comes", [&] { return flux_level_comes(config, state, part); });
    mix(g, comes, part, state.g_V, state.psi, state.top, state.per_tick, state.steeper, state.falling);
    saw("grows", state.falling == 0);
    saw("falls", state.falling > 0);
    saw("comes within the next period", comes && part > Scalar{});
    saw("has been reached", comes && part == Scalar{});
    saw("does not come", !comes);
    saw("goes on along a line", !known && state.falling > 1);
  }
};

/// The selection among crossings and the three observers. It is drawn anew every 64 steps.
template <class Scalar>
struct ObserverWalk {
  ObserverConfig<Scalar> config{};
  ObserverState<Scalar> state{};
  BridgeCommand<Scalar> command{};
  TerminalRotor rotor{};
  std::uint32_t now = 0;
  std::uint8_t sector = no_sector;

  void draw(Random& r) {
    const DrawnWinding winding(r);
    const auto third = static_cast<std::int16_t>(3000 + r.bits() % 256);  // a bus of 3200 counts is 0.43 V
    config.follow = r.one_in(12) ? Follow::crossings : static_cast<Follow>(1 + r.below(3));
    config.voltage = {per_count<Scalar>(third), std::uint16_t{40}, r.one_in(3)};
    config.luenberger = drawn_luenberger<Scalar>(r, winding);
    config.sliding_mode = drawn_sliding_mode<Scalar>(r, winding);
    config.flux = drawn_flux<Scalar>(r, winding);
    const std::int32_t back = 67108864 / third;  // 2^26 divided by the gain: the counts per volt
    config.counts_per_V =
        Number<Scalar>::gain(static_cast<std::int16_t>(back), std::int8_t{fraction_digits<Scalar>});
    config.lag_ticks = r.below(200);
    rotor.speed = drawn_pace(r);
    command.enabled = !r.one_in(8);
    command.chopping = static_cast<Chopping>(r.below(3));
    command.duty = positive<Scalar>(r);
  }
  Measurement<Scalar> measured(Random& r) {
    const auto calm = [&r] { return Number<Scalar>::part(static_cast<std::int32_t>(r.long_bits()) / 256); };
    Measurement<Scalar> m{};
    m.i_a_A = r.one_in(24) ? signal<Scalar>(r) : calm();
    m.i_b_A = r.one_in(24) ? signal<Scalar>(r) : calm();
    m.i_c_A = r.one_in(24) ? signal<Scalar>(r) : calm();
    m.bus_V = ScalarTraits<Scalar>::counts(std::int32_t{3} * bus_counts, config.voltage.third_per_count);
    return m;
  }
  void turn(Random& r) {
    now += tick_ticks;
    rotor.angle += static_cast<std::uint32_t>(rotor.speed);
    if (r.one_in(1024)) sector = no_sector;  // the drive has lost the rotor
    if (rotor.sector() == sector || r.one_in(3)) return;
    sector = rotor.driven = rotor.sector();
    rotor.demagnetises = r.below(5);
    command.pair = rotor.speed < 0 ? swapped(positive_pair(sector)) : positive_pair(sector);
  }
  Observed observe(const TerminalSample& sample, const Measurement<Scalar>& m) {
    const auto step = [&] { return observer_step(config, state, sample, command, m, sector); };
    switch (config.follow) {
      case Follow::luenberger:
        return counted<0>("observer_step(luenberger)", step);
      case Follow::sliding_mode:
        return counted<1>("observer_step(sliding_mode)", step);
      case Follow::flux:
        return counted<2>("observer_step(flux)", step);
      default:
        return step();
    }
  }
  void step(Random& r, Digest& mix) {
    turn(r);
    const std::int32_t noise = drawn_noise(r, 20);
    const TerminalSample sample = r.one_in(48) ? wild_sample(r, now) : rotor.sample(now, true, noise);
    const bool ran_out = state.runs_out, crossed = state.crossed;
    const Observed o = observe(sample, measured(r));
    mix(o.follows, o.blind, o.y, o.lag_ticks, o.by_level, o.due, o.due_ticks);
    mix(state.before.w_V, state.before.held, state.before.known, state.sector, state.runs_out, state.crossed,
        state.luenberger.e_V, state.sliding_mode.e_V, state.flux.psi);
    saw("follows the terminal", !o.follows && sector < 6);
    saw("blind", o.blind);
    saw("a leg that has come free", ran_out && !state.runs_out);
    saw("a crossing", state.crossed && !crossed && !state.runs_out);
    saw("the level comes", o.by_level && o.due && o.due_ticks > 1);
    saw("the level does not come", o.by_level && !o.due);
    saw("held at a rail by the old current", state.before.held && state.before.known);
    saw("held at a rail that tells nothing", o.follows && !state.before.known);
  }
};

/// Crossings in integers. They are found from the estimate of an observer instead of the terminal's voltage.
struct ObservedCrossingWalk {
  ZeroCrossingConfig config{};
  ZeroCrossingState state{};
  TerminalRotor rotor{};
  std::uint32_t now = 0;
  std::uint8_t sector = no_sector, blind = 0;

  void draw(Random& r) {
    config = {NeutralSeen::on_time, static_cast<std::uint16_t>(20 + r.below(40)), r.below(100), r.below(60),
              r.below(8) * tick_ticks / 4};
    rotor.speed = drawn_pace(r);
  }
  void step(Random& r, Digest& mix) {
    now += tick_ticks;
    rotor.angle += static_cast<std::uint32_t>(rotor.speed);
    if (rotor.sector() != sector && !r.one_in(3)) {
      sector = rotor.sector();
      rotor.driven = r.one_in(32) ? r.below(6) : sector;
      blind = r.below(6);
      zero_crossing_begin(state, rotor.driven, 0, now);
    }
    const TerminalSample sample =
        r.one_in(24) ? wild_sample(r, now) : rotor.sample(now, true, drawn_noise(r, 20));
    Observed observed{};
    observed.follows = true;
    observed.blind = blind > 0;
    if (blind > 0) --blind;
    observed.lag_ticks = r.below(200);
    const std::uint8_t leg = floating_leg(rotor.driven);
    const std::int32_t y = 2 * rotor.emf_of(leg) + drawn_noise(r, 30);
    observed.y = rotor.driven % 2 == 0 ? y : -y;
    const bool on = !r.one_in(16);
    const CrossingReading reading = counted<0>("observed_crossing_step", [&] {
      return observed_crossing_step(config, state, sample, observed, on);
    });
    mix(static_cast<std::uint8_t>(reading.crossing), reading.at, reading.visible, reading.free, reading.y,
        state.hidden, state.armed, state.unlike);
    saw("seen", reading.crossing == Crossing::seen);
    saw("passed before", reading.crossing == Crossing::passed_before);
    saw("blind", !reading.free);
    saw("a contradiction", state.unlike > 0);
  }
};

}  // namespace target
