// SPDX-License-Identifier: Apache-2.0
// The frequency response of a drive's outermost loop, measured on the switching simulation: the scenario runs as it is written,
// and where it ends its reference goes on with a multisine on top of where it stands. What the controller sees at its samples,
// over what it was told, is the closed loop; beside it the linear loop that the gains were designed on.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/bode/measured_loop.hpp"
#include "sixstep/design/loops/loop_figures.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct BodeOrder {
  std::optional<double>
      amplitude;  ///< of the multisine, in the mode's unit; else a twentieth of where the reference stands
  std::size_t lines = 32;
  std::size_t periods = 6;                       ///< that are looked at, behind one that is not
  std::function<bool(double t_s)> keep_going{};  ///< false ends it early: a Problem "was interrupted"
};

struct BodeStudy {
  study::Scenario scenario;  ///< as it was run, the multisine included
  study::Scenario at_end;    ///< as if the chip had been from the start what the events made of it
  control::Mode mode = control::Mode::current;
  double stands_at = 0.0, amplitude = 0.0;  ///< in the mode's unit
  double begin_s = 0.0, period_s = 0.0;     ///< when the multisine began; of the control
  double pole_pairs = 1.0;
  Multisine signal;
  std::vector<LoopPoint> points;
  double beside =
      0.0;  ///< of the answer's rms, the part at no line: ripple, commutation, whatever is not linear
  double without_current = 0.0;  ///< of the samples looked at, the part at which no phase carried current
  ReadMargins measured;
  std::optional<design::Transfer> designed;  ///< empty where the loop is none of linear blocks alone
  std::string not_linear;                    ///< why
  std::optional<design::SpeedLag> lag;  ///< of a speed that a sensor tells, at the speed that it has there
  std::optional<design::LoopFigures> figures;  ///< of `designed`, lag included

  /// Of the designed L at each point, unwrapped over all of them: what is measured has the turn that lies nearest.
  std::vector<double> designed_phase_rad;

  /// The designed L at a frequency.
  std::optional<design::Complex> designed_at(double w_rad_s) const;
};

/// Problems: the scenario's own, a mode without a loop, a reference that does not stand at the end, a setpoint that is slewed, a
/// run that a fault ends, a drive that is still on its way.
base::Result<BodeStudy> study_bode(const study::Scenario& scenario, const BodeOrder& order = {});

}  // namespace sixstep::analysis
