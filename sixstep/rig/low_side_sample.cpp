// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/low_side_sample.hpp"

#include "sixstep/rig/six_step_modulator.hpp"

namespace sixstep::rig {

LowSideSample low_side_sample(const control::LowSideConfig<double>& config, const BoardCommand& c) {
  control::LegCommand<double> leg[3]{};
  leg[static_cast<unsigned>(c.pair.source)] = control::source_leg(c.chopping, c.chopped, c.duty);
  leg[static_cast<unsigned>(c.pair.sink)] = control::sink_leg(c.chopping, c.chopped, c.duty);
  return {c.enabled, true, control::shown_legs(config, leg), c.pair};
}

LowSideSample low_side_sample(const control::LowSideConfig<double>& config,
                              const control::LegCommands<double>& c) {
  return {c.enabled, false, control::shown_legs(config, c.leg), {}};
}

}  // namespace sixstep::rig
