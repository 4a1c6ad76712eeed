// SPDX-License-Identifier: Apache-2.0
// Converts a controller's command to the board's command, and selects the modulator for the command's type: a
// driven pair with one duty, or three legs. The two modulators have only the timer in common. A firmware that
// sets the gates directly uses GateModulator.
#pragma once
#include "sixstep/rig/bases.hpp"
#include "sixstep/rig/gate_modulator.hpp"
#include "sixstep/rig/six_step_modulator.hpp"
#include "sixstep/rig/three_leg_modulator.hpp"

namespace sixstep::rig {

template <class Command>
struct ModulatorFor;
template <class Scalar>
struct ModulatorFor<control::BridgeCommand<Scalar>> {
  using type = SixStepModulator;
};
template <class Scalar>
struct ModulatorFor<control::LegCommands<Scalar>> {
  using type = ThreeLegModulator;
};
template <>
struct ModulatorFor<ChipGates> {
  using type = GateModulator;
};

template <class Scalar>
BoardCommand widened(const control::BridgeCommand<Scalar>& c, const Bases& bases) {
  return {.enabled = c.enabled,
          .pair = c.pair,
          .duty = to_si(c.duty, 1.0),
          .chopping = c.chopping,
          .chopped = c.chopped,
          .watch = c.watch,
          .overlap = to_si(c.overlap, 1.0),
          .on_below_A = to_si(c.on_below_A, bases.current_A),
          .off_above_A = to_si(c.off_above_A, bases.current_A)};
}

template <class Scalar>
control::LegCommands<double> widened(const control::LegCommands<Scalar>& c, const Bases&) {
  control::LegCommands<double> legs{.enabled = c.enabled, .fault = c.fault};
  for (unsigned k = 0; k < 3; ++k)
    legs.leg[k] = {c.leg[k].state, c.leg[k].switches, to_si(c.leg[k].duty, 1.0)};
  return legs;
}

}  // namespace sixstep::rig
