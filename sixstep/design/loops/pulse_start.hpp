// SPDX-License-Identifier: Apache-2.0
// Designs the six pulses that find the angle of a rotor at rest (control/commissioning/pulse_position.hpp),
// from sheet and board. i = 2/sqrt 3 of the pair's current is the amplitude of the space vector. For a pair
// at an angle x from the magnet's north the inductance is (symbols of model.md 7)
//
//   L(x) = L_S + L_D cos 2x - (L_d i/(2 I_sat)) cos^3 x
//
//   time       t = (n - 1/2) T, for n periods T: a pulse begins with a period and ends with its sample, in
//              the middle of a period. The periods by which an output is delayed are subtracted from n.
//   current    I = U/R (1 - exp(-R t/2 L_S)), with the bus U and R between two terminals. The largest current
//              has the least L(x) for an allowed current I_most,
//              L_least = min(L_d (1 - (2/sqrt 3) I_most/(2 I_sat)), L_q).
//   north      signal (3/4) m k of I by saturation, m = (2/sqrt 3) L_d I/(2 I_sat L_S). The resistance
//              reduces the effect of an inductance by the factor k = x/(e^x - 1), with x = R t/2 L_S.
//   axis       signal (|L_D|/L_S) k of I by saliency
//   over noise the two signals times sqrt 3 I_0/sigma; sigma is defined in pulse_position.hpp
//   length     the shortest pulse whose signals are twice the level `certain`. If there is no such pulse, or
//              the sheet has no I_sat, the longest allowed pulse: the pulses are tried, and if they do not
//              find north, the rotor is aligned.
//   allowed    three conditions: the current is at most the start's current, 9/10 of the converter's range,
//              and I_sat/2 along the magnet; the length is at most 2 L_S/R; and the pulses turn the rotor by
//              at most a quarter of a sector.
//
// Turning. Opposite pairs follow each other after a time D. The impulse of the first pulse, P = (pi/3) K_t I
// t, is cancelled by the impulse of the second pulse, and the rotor has moved by P D/J. Three pairs together
// cause at most twice this angle. One part of the impulse, P_e, does not change its sign with the current: it
// comes from saliency and from the difference of the two currents, and cancels only after three pairs. It
// turns the rotor by at most 12 P_e D/J. Friction is neglected.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/commissioning/pulse_position.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Supply, motor and converter of the pulses; SI.
struct PulseSpec {
  double bus_V = 0.0;     ///< voltage of the supply
  double period_s = 0.0;  ///< time from sample to sample
  int delay_periods = 0;  ///< periods by which an output is delayed beyond the start of the next period
  double L_d_H = 0.0, L_q_H = 0.0;
  double saturation_A = 0.0;     ///< I_sat of a phase; 0: not in the sheet
  double most_A = 0.0;           ///< current of a pair that the start uses anyway
  int adc_bits = 12;             ///< bits of the phase currents' converters
  double current_range_A = 0.0;  ///< range in each direction
  double offset_A = 0.0, noise_A = 0.0;
  double late_s = 0.0;  ///< age of the measurement of a rising current, from the amplifier's lag and delay
};

/// Configuration of the pulses on the chip, and figures of the design.
struct PulseStart {
  control::PulsePositionConfig pulses;
  double current_A = 0.0, greatest_A = 0.0;  ///< current of the pair at the sample: with L_S, and with
                                             ///< L_least
  double north = 0.0, axis = 0.0;            ///< signals relative to their noise
  double off_deg = 0.0;                      ///< error of the angle at five times the noise, electrical
                                             ///< degrees
  double turned_deg = 0.0;                   ///< largest angle by which the pulses turn the rotor, electrical
                                             ///< degrees
  double lasts_s = 0.0;
  std::vector<DerivationStep> steps;
};

/// `motor` includes the load's inertia on its shaft. Problems name the key: a pulse of one period is too
/// strong, or the converter is too coarse or too fine for any pulse.
base::Result<PulseStart> pulse_start(const MotorModel& motor, const PulseSpec& spec);

}  // namespace sixstep::design
