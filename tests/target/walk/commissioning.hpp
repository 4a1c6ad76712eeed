// SPDX-License-Identifier: Apache-2.0
// Commissioning of a motor in integers, from the offsets of its converters to its flux linkage. Faults are
// possible. The results are converted to SI units.
#pragma once
#include "sixstep/control/commissioning/commissioning_result.hpp"
#include "tests/target/walk/legs.hpp"
#include "tests/target/walk/surveys.hpp"

namespace target {

template <class Scalar>
struct FieldVectorWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    const BinaryAngle angle = r.one_in(8) ? BinaryAngle{r.below(4)} << 30 : r.long_bits();
    const auto v = static_cast<std::int32_t>(r.long_bits() % (longest_vector + 1));
    const LegCommands<Scalar> legs =
        counted<0>("legs_of_vector", [&] { return legs_of_vector<Scalar>(v, angle); });
    mix_legs(mix, legs);
    saw("a leg above three quarters", legs.leg[0].duty > ScalarTraits<Scalar>::fraction(3, 4));
    saw("a leg below a quarter", legs.leg[1].duty < ScalarTraits<Scalar>::fraction(1, 4));
    saw("a whole quarter", (angle & 0x3fffffffu) == 0);
  }
};

template <class Scalar>
struct CommissioningResultWalk {
  CommissioningScale<Scalar> scale{};
  CommissioningState state{};

  void draw(Random& r) {
    scale = {positive_gain<Scalar>(r, 0), positive_gain<Scalar>(r, 0), positive_gain<Scalar>(r, 0),
             gain<Scalar>(r, -2)};
  }
  void step(Random& r, Digest& mix) {
    state.winding.resistance = static_cast<std::int32_t>(r.long_bits() >> (1 + r.below(20)));
    state.winding.tau = static_cast<std::int32_t>(r.long_bits() >> (1 + r.below(20)));
    state.magnet.flux = static_cast<std::int32_t>(r.long_bits() >> (1 + r.below(20)));
    state.probes.offset = signed_bits(r, r.below(8));
    state.probes.lag = signed_bits(r, r.below(8));
    const Commissioned<Scalar> found = counted<0>("commissioned", [&] { return commissioned(scale, state); });
    mix(found.R_ohm, found.L_H, found.flux_linkage_Vs, found.hall_offset_deg, found.hall_lag_deg);
    saw("a resistance", found.R_ohm > Scalar{});
    saw("edges ahead", found.hall_offset_deg > Scalar{});
    saw("edges behind", found.hall_offset_deg < Scalar{});
    if constexpr (!__is_same(Scalar, float))
      saw("beyond the format", found.R_ohm == Number<Scalar>::end(false));
  }
};

/// The walk commissions one motor after another, each to its end. Each motor has the next fault of this list.
enum class Amiss : std::uint8_t { nothing, amplifier, open_wire, no_voltage_between_levels, rotor_locked };

/// In each tick, the current changes by half of its distance to the steady value. The rotor turns with the
/// field.
struct CommissionedMotor {
  Amiss amiss = Amiss::rotor_locked;
  std::int32_t eighths = 0;       ///< current along the field, in eighths of a count
  std::int32_t ohm = 80;          ///< parts of the bus per eighth of a count
  std::int32_t flux = 400;        ///< speed per part of the bus
  std::uint8_t probes_ahead = 0;  ///< probes' lead, in 2^-8 turn

  void draw(Random& r) {
    amiss = static_cast<Amiss>((static_cast<std::uint8_t>(amiss) + 1) % 5);
    ohm = 60 + r.below(60);
    flux = 300 + r.below(200);
    probes_ahead = r.below(8);
    eighths = 0;
  }
  void tick(const CommissioningState& state) {
    const bool on = state.phase != CommissioningPhase::zeroing && state.phase < CommissioningPhase::done;
    const std::int32_t speed = state.speed < 0 ? -state.speed : state.speed;
    const std::int32_t emf = amiss == Amiss::rotor_locked ? 0 : speed / flux;
    std::int32_t target = on && amiss != Amiss::open_wire ? (state.v - emf) / ohm : 0;
    const bool same =
        amiss == Amiss::no_voltage_between_levels && state.phase >= CommissioningPhase::stepping;
    if (same) target = 2000;
    eighths += (target - eighths) / 2;
  }
  CommissioningInput input(Random& r, const CommissioningState& state) const {
    CommissioningInput in{};
    for (std::uint8_t k = 0; k < 3; ++k) {
      const BinaryAngle behind = state.angle - sector_angle(static_cast<std::uint8_t>(2 * k)) + quarter_turn;
      const std::int32_t all = std::int32_t{8} * zero_counts + wave(behind, eighths) + r.below(8);
      in.current_counts[k] = static_cast<std::uint16_t>(all / 8);
    }
    if (amiss == Amiss::amplifier) in.current_counts[1] = 3000;
    in.bus_counts = static_cast<std::uint16_t>(3000 + r.below(8));
    const BinaryAngle electrical = state.angle + electrical_ahead + (BinaryAngle{probes_ahead} << 24);
    in.pins = hall_of_sector(sector_of_angle(electrical));
    return in;
  }
};

template <class Scalar>
struct CommissioningWalk {
  CommissioningConfig config{};
  CommissioningState state{};
  CommissionedMotor motor{};
  std::uint32_t now = 0;
  std::uint8_t pins = 0;
  bool begun = false;

  void begin(Random& r) {
    motor.draw(r);
    config = {};
    config.current.offset_counts = zero_counts;
    config.current.offset_tolerance = 20;
    config.current.log2_samples = 2;
    config.test_counts = 300;
    config.rise = 8192;
    config.settle_ticks = 4;
    config.steps = {std::uint16_t{8}, std::uint16_t{1}, std::uint8_t{1}};
    config.hall.turns = 1;
    config.slow_speed = 0x06000000u + r.bits();  // 43 ticks per turn
    config.fastest_speed = 0x06000000u + r.bits();
    config.acceleration = 0x00800000u;
    config.flux_turns = 1;
    config.tries = 2;
    config.timer_ticks = tick_ticks;
    state = {};
    begun = true;
  }
  void draw(Random& r) {
    if (!begun) begin(r);
  }
  void step(Random& r, Digest& mix) {
    now += tick_ticks;
    CommissioningInput in = motor.input(r, state);
    in.at = now;
    if (in.pins != pins) {
      const std::uint32_t captured = now - r.bits() % tick_ticks;
      counted<1>("commissioning_hall", [&] { commissioning_hall(config, state, in.pins, captured); });
      pins = in.pins;
    }
    mix_legs(mix,
             counted<0>("commissioning_step", [&] { return commissioning_step<Scalar>(config, state, in); }));
    motor.tick(state);
    mix(static_cast<std::uint8_t>(state.phase), static_cast<std::uint8_t>(state.fault), state.v, state.angle,
        state.speed, state.tries, state.held);
    tell(r, mix);
  }
  void tell(Random& r, Digest& mix) {
    const CommissioningPhase phase = state.phase;
    saw("rises", phase == CommissioningPhase::rising);
    saw("steps", phase == CommissioningPhase::stepping);
    saw("turns back", phase == CommissioningPhase::turning && state.direction < 0);
    saw("spins", phase == CommissioningPhase::spinning);
    saw("measures", phase == CommissioningPhase::measuring);
    if (phase < CommissioningPhase::done) return;
    mix(state.winding.resistance, state.winding.tau, state.winding.lost, state.magnet.emf, state.magnet.flux,
        static_cast<std::uint8_t>(state.probes.verdict), state.probes.offset, state.probes.lag);
    saw("done", phase == CommissioningPhase::done);
    saw("Hall lines that are good", state.probes.verdict == HallSurvey::good);
    saw("fails: an offset", state.fault == CommissioningFault::offset);
    saw("fails: no current", state.fault == CommissioningFault::current);
    saw("fails: no winding", state.fault == CommissioningFault::winding);
    saw("fails: not turned", state.fault == CommissioningFault::not_turned);
    begin(r);
  }
};

}  // namespace target
