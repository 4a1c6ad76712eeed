// SPDX-License-Identifier: Apache-2.0
// Measures the motor current with one shunt in the DC link. The shunt carries the sum of the currents of the
// legs that are connected to the positive rail (model.md 3). In the on-time this is the source phase's
// current, in the off-time no current or the returned current. A sample is therefore used only if it was
// taken in the on-time, after the amplifier settled.
//
// During a commutation one phase continues to conduct its current i_k. The second phase's current rises, and
// the third phase's current decays through a diode:
//   sink changes    the old sink's current returns to the upper rail. The shunt shows i_k minus the returned
//                   current, which equals the rising current.
//   source changes  the old source conducts through a lower diode. The shunt shows the new source's current,
//                   which is the rising current.
// In both cases the shunt shows the rising current i_in, and i_m = (i_k + i_in)/2. This block uses the last
// value of i_k, because i_k changes little. It uses this estimate until i_in has reached i_k, or for a
// configured number of samples.
//
// If the on-time is too short, no sample is used. The last value then decays by a configured factor per tick.
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: every sample is rejected, and the current is 0.
template <class Scalar>
struct OneShuntConfig {
  Scalar least_duty = one<Scalar>;       ///< (delay of the sample + settling)/T_s; a sample is used only
                                         ///< above this duty
  std::uint8_t commutation_samples = 0;  ///< largest number of samples of a commutation that are corrected
  Scalar fade{};  ///< factor on the last value per tick without a sample: exp(-T_s R/L); with 1 the value
                  ///< stays constant
  bool operator==(const OneShuntConfig&) const = default;
};

template <class Scalar>
struct OneShuntState {
  Scalar driven_A{};             ///< estimate of the current, positive in the direction of the command
  Scalar kept_A{};               ///< i_k, current of the phase that conducts before, during and after the
                                 ///< commutation
  std::uint8_t commutating = 0;  ///< number of remaining samples of the commutation
  std::uint8_t hidden = 255;     ///< ticks since the last sample that was used, at most 255
  bool reversed = false;
};

/// Call it before the next sample if a Hall edge has changed the pair, but the sign of the command has not
/// changed.
template <class Scalar>
constexpr void one_shunt_commutation(const OneShuntConfig<Scalar>& config, OneShuntState<Scalar>& state) {
  state.kept_A = state.driven_A;
  state.commutating = config.commutation_samples;
}

/// Processes one sample. `duty` and `reversed` are magnitude and sign of the command at the sample. Returns
/// i_m, A, positive for positive torque.
template <class Scalar>
constexpr Scalar one_shunt_step(const OneShuntConfig<Scalar>& config, OneShuntState<Scalar>& state,
                                bool reversed, Scalar duty, Scalar sample_A) {
  using T = ScalarTraits<Scalar>;
  if (reversed != state.reversed) {  // source and sink are exchanged
    state.driven_A = -state.driven_A;
    state.commutating = 0;
  }
  state.reversed = reversed;
  if (duty > config.least_duty) {
    state.hidden = 0;
    if (state.commutating > 0 && sample_A < state.kept_A) {
      --state.commutating;
      state.driven_A = T::half_difference(state.kept_A, -sample_A);
    } else {
      state.commutating = 0;
      state.driven_A = sample_A;
    }
  } else {
    state.driven_A = state.driven_A * config.fade;
    if (state.hidden < 255) ++state.hidden;
  }
  return reversed ? -state.driven_A : state.driven_A;
}

/// Sets the phase currents of a Measurement: the pair carries i_m, the third phase carries no current.
template <class Scalar>
constexpr void set_phase_currents(Measurement<Scalar>& measured, Pair positive, Scalar motor_current_A) {
  const auto of = [&](Leg leg) {
    return leg == positive.source ? motor_current_A : leg == positive.sink ? -motor_current_A : Scalar{};
  };
  measured.i_a_A = of(Leg::a);
  measured.i_b_A = of(Leg::b);
  measured.i_c_A = of(Leg::c);
}

}  // namespace sixstep::control
