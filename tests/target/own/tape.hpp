// SPDX-License-Identifier: Apache-2.0
// The inputs of a user's controller in a run, call by call, as bytes, lowest byte first. The recorder writes
// them on the host, and every processor reads them.
//
//   design   0, mode, delay_periods, sampled_in_middle, chopping, the numbers of sixstep_given,
//            number of values 1, the values
//   start    1
//   step     2, hall 1, the numbers of sixstep_measured, setpoint, answers 4
//   hall     3, hall 1, answers 4
//
// The first number of a line is the kind of call; other single numbers are sizes in bytes. The numbers of a
// struct are floats. `answers` is the digest of all answers from the beginning of the tape, including this
// call's.
#pragma once
#include <cstdint>

#include "tests/target/walk/digest.hpp"

namespace target {

enum class Call : std::uint8_t { design, start, step, hall };

// The structs of the C interface have float or double members. `take` is called with each number in order.
template <class Given, class Take>
void numbers_of_given(Given& g, Take take) {
  take(g.period_s), take(g.bus_V), take(g.pole_pairs), take(g.R_ohm), take(g.L_H), take(g.K_t_Nm_A);
  take(g.magnet_Vs), take(g.J_kg_m2), take(g.B_Nm_s), take(g.current_d1), take(g.current_d0);
  take(g.speed_d1), take(g.speed_d0), take(g.full_torque_Nm), take(g.full_current_A), take(g.current_limit_A);
  take(g.position_gain_rad_s_per_deg), take(g.speed_limit_rad_s);
}
template <class Given, class Take>
void bytes_of_given(Given& g, Take take) {
  take(g.mode), take(g.delay_periods), take(g.sampled_in_middle), take(g.chopping);
}
template <class Measured, class Take>
void numbers_of_measured(Measured& m, Take take) {
  take(m.current_A[0]), take(m.current_A[1]), take(m.current_A[2]), take(m.speed_rad_s), take(m.position_deg);
  take(m.bus_V), take(m.magnet_cos), take(m.magnet_sin);
}

/// Every member is part of the digest. If the controller does not set a member, the member keeps its value.
template <class Answer>
void mix_answer(Digest& mix, const Answer& a) {
  mix(a.enabled, a.fault, a.source, a.sink, a.chopping, a.chopped, a.duty, a.overlap);
  for (const auto& leg : a.leg) mix(leg.state, leg.switches, leg.duty);
  mix(a.current_reference_A, a.speed_reference_rad_s);
}

}  // namespace target
