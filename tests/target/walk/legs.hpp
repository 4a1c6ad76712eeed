// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks of the controller's outputs: commutation, gates, three legs, voltage vectors.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/frames.hpp"
#include "sixstep/control/gates.hpp"
#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

template <class Scalar>
void mix_legs(Digest& mix, const LegCommands<Scalar>& legs) {
  mix(legs.enabled, legs.fault);
  for (std::uint8_t k = 0; k < 3; ++k) {
    const LegCommand<Scalar>& leg = legs.leg[k];
    mix(static_cast<std::uint8_t>(leg.state), static_cast<std::uint8_t>(leg.switches), leg.duty,
        gates(leg, static_cast<Leg>(k), true), gates(leg, static_cast<Leg>(k), false));
  }
}

template <class Scalar>
void mix_command(Digest& mix, const BridgeCommand<Scalar>& command) {
  mix(command.enabled, static_cast<std::uint8_t>(command.pair.source),
      static_cast<std::uint8_t>(command.pair.sink), command.duty, static_cast<std::uint8_t>(command.chopping),
      static_cast<std::uint8_t>(command.watch), command.on_below_A, command.off_above_A, command.fault);
}

template <class Scalar>
struct CommutationWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    Measurement<Scalar> m{};
    m.i_a_A = signal<Scalar>(r);
    m.i_b_A = signal<Scalar>(r);
    m.i_c_A = signal<Scalar>(r);
    const std::uint8_t code = r.below(8);
    std::uint8_t sector = no_sector;
    const Pair positive = counted<0>("sector_of_hall+positive_pair", [&] {
      sector = sector_of_hall(code);
      return positive_pair(sector);
    });
    BridgeCommand<Scalar> command{};
    command.enabled = sector != no_sector;
    command.pair = r.one_in(2) ? positive : swapped(positive);
    command.duty = positive_duty(r);
    command.chopping = static_cast<Chopping>(r.below(3));
    mix(counted<1>("motor_current", [&] { return motor_current(m, positive); }),
        counted<2>("gates", [&] { return gates(command, true); }), gates(command, false));
    mix_legs(mix, as_legs(command));
    saw("off", gates(command, true) == 0);
    saw("an off-time without gates", command.enabled && gates(command, false) == 0);
  }
  static Scalar positive_duty(Random& r) { return r.one_in(8) ? one<Scalar> : positive<Scalar>(r); }
};

template <class Scalar>
struct FramesWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    const Abc<Scalar> x{signal<Scalar>(r), signal<Scalar>(r), signal<Scalar>(r)};
    const Direction<Scalar> axis{signal<Scalar>(r), signal<Scalar>(r)};
    AlphaBeta<Scalar> v{};
    const Dq<Scalar> w = counted<0>("clarke+park", [&] {
      v = clarke(x);
      return park(v, axis);
    });
    AlphaBeta<Scalar> back{};
    const Abc<Scalar> phases = counted<1>("inverse_park+inverse_clarke", [&] {
      back = inverse_park(w, axis);
      return inverse_clarke(back);
    });
    mix(v.alpha, v.beta, w.d, w.q, back.alpha, back.beta, phases.a, phases.b, phases.c);
    saw("a vector that saturates",
        v.beta == Number<Scalar>::end(false) || v.beta > Number<Scalar>::end(false));
  }
};

template <class Scalar>
struct ThreePhasePwmWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    const Abc<Scalar> v{signal<Scalar>(r), signal<Scalar>(r), signal<Scalar>(r)};
    const Scalar bus = r.one_in(8) ? signal<Scalar>(r) : positive<Scalar>(r);
    mix_legs(mix, counted<0>("sine_triangle", [&] { return sine_triangle(v, bus); }));
    const LegCommands<Scalar> legs = counted<1>("space_vector", [&] { return space_vector(v, bus); });
    mix_legs(mix, legs);
    saw("a full duty", legs.leg[0].duty == one<Scalar>);
    saw("no duty", legs.leg[0].duty == Scalar{});
    saw("no bus", !(bus > Scalar{}));
  }
};

}  // namespace target
