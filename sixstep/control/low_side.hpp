// SPDX-License-Identifier: Apache-2.0
// Measures phase currents by shunts below the lower switches of one, two or three legs. A shunt carries its
// leg's current only while the leg is connected to the negative rail, by its lower switch or the diode beside
// it. A sample counts only if this connection has lasted long enough for the amplifier to settle:
//
//   in the rest of the period   the leg's pulse ended early enough: duty <= greatest_duty. Shown by a leg that
//                               turns its lower switch on, and by a leg without a switch on, whose current the
//                               lower diode carries
//   in the pulse                the pulse of the lower switch began early enough: duty >= least_duty
//   no pulse                    lower switch on: always; upper switch on, or leg off: never
//
// A current that freewheels through upper switch and upper diode flows through no shunt.
//
// Of three legs, two that are shown give the third, because the sum of the currents is 0. Of a driven pair one
// leg is enough. If fewer are shown, the last values are kept.
#pragma once
#include <cstdint>

#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// With the default no leg has a shunt.
template <class Scalar>
struct LowSideConfig {
  std::uint8_t shunts = 0;          ///< legs with a shunt: bit 0 is leg a, bit 1 leg b, bit 2 leg c
  Scalar greatest_duty{};           ///< of a pulse outside of which the sample lies
  Scalar least_duty = one<Scalar>;  ///< of a pulse of the lower switch in which the sample lies
  bool operator==(const LowSideConfig&) const = default;
};

template <class Scalar>
struct LowSideState {
  Scalar leg_A[3]{};          ///< three legs: the last currents
  Scalar driven_A{};          ///< pair: the last current, positive in the direction of the command
  std::uint32_t samples = 0;  ///< samples with the bridge on
  std::uint32_t blind = 0;    ///< those in which too few legs were shown
  bool reversed = false;
};

/// True if a sample shows the current of a leg with this command.
template <class Scalar>
constexpr bool shows_current(const LowSideConfig<Scalar>& config, const LegCommand<Scalar>& leg) {
  const LegSides sides = sides_of(leg);
  if (leg.state != LegState::pwm) return sides.rest == LegSide::low;
  const bool rest =
      sides.rest == LegSide::low || (sides.rest == LegSide::none && sides.pulse == LegSide::high);
  return (rest && leg.duty <= config.greatest_duty) ||
         (sides.pulse == LegSide::low && leg.duty >= config.least_duty);
}

/// The legs with a shunt whose current a sample shows, as bits. `command` is the one in effect at the sample.
template <class Scalar>
constexpr std::uint8_t shown_legs(const LowSideConfig<Scalar>& config, const LegCommand<Scalar> (&leg)[3]) {
  unsigned shown = 0;
  for (unsigned k = 0; k < 3; ++k) shown |= (shows_current(config, leg[k]) ? 1U : 0U) << k;
  return static_cast<std::uint8_t>(shown & config.shunts);
}

/// Currents of three legs from the samples of those that are shown; they stay in state.leg_A.
template <class Scalar>
constexpr void low_side_legs(LowSideState<Scalar>& state, std::uint8_t shown, const Scalar (&sample_A)[3]) {
  ++state.samples;
  unsigned count = 0, hidden = 0;
  for (unsigned k = 0; k < 3; ++k) (shown >> k & 1U) != 0 ? ++count : hidden = k;
  if (count < 2) {
    ++state.blind;
    return;
  }
  for (unsigned k = 0; k < 3; ++k) state.leg_A[k] = sample_A[k];
  if (count == 2) state.leg_A[hidden] = -(sample_A[(hidden + 1) % 3] + sample_A[(hidden + 2) % 3]);
}

/// Current of a driven pair, A, positive for positive torque: half the difference of both legs, or that of the
/// leg that is shown. `pair`: its upper switch is in leg source, also if the command is reversed.
template <class Scalar>
constexpr Scalar low_side_pair(LowSideState<Scalar>& state, std::uint8_t shown, Pair pair, bool reversed,
                               const Scalar (&sample_A)[3]) {
  if (reversed != state.reversed) state.driven_A = -state.driven_A;
  state.reversed = reversed;
  ++state.samples;
  const auto source = static_cast<unsigned>(pair.source), sink = static_cast<unsigned>(pair.sink);
  const bool in = (shown >> source & 1U) != 0, out = (shown >> sink & 1U) != 0;
  if (in && out)
    state.driven_A = ScalarTraits<Scalar>::half_difference(sample_A[source], sample_A[sink]);
  else if (in || out)
    state.driven_A = in ? sample_A[source] : -sample_A[sink];
  else
    ++state.blind;
  return reversed ? -state.driven_A : state.driven_A;
}

}  // namespace sixstep::control
