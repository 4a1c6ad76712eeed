// SPDX-License-Identifier: Apache-2.0
// Selects which of the pair's two switches the duty chops while the other switch is on. These are the
// patterns of unipolar PWM in six-step operation. A pattern's name describes a switch in the 120 degrees for
// which it carries current: H_PWM-L_ON, H_ON-L_PWM, PWM-ON, ON-PWM, and PWM-ON-PWM (Wei, Hu and Zhang, A
// novel PWM scheme to eliminate the diode freewheeling of the inactive phase in BLDC motor, IEEE PESC 2004).
//
// After a commutation, one leg of the pair was in the previous pair too (the staying leg). The other leg is
// the entering leg. PWM-ON chops the entering leg, ON-PWM the staying leg. PWM-ON-PWM chops the entering leg
// until the middle of the sector, then the staying leg.
//
// The pattern determines the current in the free phase. The free terminal's voltage is the star point's
// voltage plus the free phase's back-EMF. In the off-time of the upper switch the star point is at the lower
// rail, and a back-EMF below zero drives a current through the free leg's lower diode. In the off-time of the
// lower switch the star point is at the upper rail, and a back-EMF above zero drives a current through the
// upper diode.
//
// The back-EMF of the free phase crosses zero in the middle of the sector. Chopping the entering leg causes
// no current before this instant. Chopping the staying leg causes no current after this instant. With
// PWM-ON-PWM the free phase of a driving motor therefore never conducts in an off-time. The last three
// patterns distribute the losses equally over all six switches.
#pragma once
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

enum class PwmPattern : std::uint8_t { upper, lower, pwm_on, on_pwm, pwm_on_pwm };
inline constexpr std::uint8_t pwm_patterns = 5;

template <class Scalar>
struct PwmPatternConfig {
  PwmPattern pattern = PwmPattern::upper;
  Gain<Scalar> half_sector_per_rad_s{};  ///< 6 p T/pi: fraction of 30 electrical degrees per tick and
                                         ///< mechanical rad/s, with pole pairs p and tick period T
  bool operator==(const PwmPatternConfig&) const = default;
};

template <class Scalar>
struct PwmPatternState {
  StayingPhase staying{};
  Accumulator<Scalar> passed{};  ///< distance since the sector's begin, in half sectors, at most 1
};

/// The switch to chop. Call it after every commutation and command. Before the first commutation, the
/// function assumes that the rotor turned in the command's direction.
template <class Scalar>
constexpr ChoppedSwitch chopped_switch(const PwmPatternConfig<Scalar>& config, PwmPatternState<Scalar>& state,
                                       std::uint8_t sector, Pair pair) {
  if (state.staying.sector == no_sector) {
    const bool backward = !(pair == positive_pair(sector));
    staying_leg(state.staying, static_cast<std::uint8_t>((sector + (backward ? 1 : 5)) % 6));
  }
  if (state.staying.sector != sector) state.passed = Accumulator<Scalar>{};
  const bool sink_stays = staying_leg(state.staying, sector) == pair.sink;
  const bool staying_chops = config.pattern == PwmPattern::on_pwm ||
                             (config.pattern == PwmPattern::pwm_on_pwm &&
                              !(state.passed < ScalarTraits<Scalar>::accumulator(one<Scalar>)));
  const bool lower = config.pattern == PwmPattern::lower ||
                     (config.pattern != PwmPattern::upper && sink_stays == staying_chops);
  return lower ? ChoppedSwitch::lower : ChoppedSwitch::upper;
}

/// Call it once per tick, before chopped_switch(). It adds the rotor's motion to state.passed, up to the
/// middle of the sector.
template <class Scalar>
constexpr void move_in_sector(const PwmPatternConfig<Scalar>& config, PwmPatternState<Scalar>& state,
                              std::uint8_t sector, Scalar speed_rad_s) {
  using T = ScalarTraits<Scalar>;
  if (config.pattern != PwmPattern::pwm_on_pwm || state.staying.sector != sector) return;
  if (!(state.passed < T::accumulator(one<Scalar>))) return;
  state.passed = state.passed + T::accumulated(magnitude(speed_rad_s), config.half_sector_per_rad_s);
}

}  // namespace sixstep::control
