// SPDX-License-Identifier: Apache-2.0
// Measures the frequency response of a drive's outermost loop in the switching simulation. The scenario runs
// as written. From its end on, a multisine is added to the reference's final value. The response of the
// closed loop is the controlled quantity at the controller's samples, divided by the multisine. For
// comparison, the linear loop that the design of the gains uses is computed.
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
  /// Amplitude of the multisine, in the mode's unit; empty: a twentieth of the reference's final value.
  std::optional<double> amplitude;
  std::size_t lines = 32;
  std::size_t periods = 6;                       ///< evaluated periods; the transient's period precedes them
  std::function<bool(double t_s)> keep_going{};  ///< returns false: the run ends early with a Problem
};

struct BodeStudy {
  study::Scenario scenario;  ///< the scenario as it was run, including the multisine
  study::Scenario at_end;    ///< the scenario with the settings that the events have set until the end
  control::Mode mode = control::Mode::current;
  double stands_at = 0.0,
         amplitude = 0.0;                ///< final value of the reference, and amplitude of the multisine, in
                                         ///< the mode's unit
  double begin_s = 0.0, period_s = 0.0;  ///< start of the multisine; control period
  double pole_pairs = 1.0;
  Multisine signal;
  std::vector<LoopPoint> points;
  /// Fraction of the response's rms at frequencies that are not a line: ripple, commutation, other nonlinear
  /// effects.
  double beside = 0.0;
  /// Fraction of the evaluated samples at which no phase carries current.
  double without_current = 0.0;
  ReadMargins measured;
  std::optional<design::Transfer> designed;    ///< empty: the loop is not linear
  std::string not_linear;                      ///< why `designed` is empty
  std::optional<design::SpeedLag> lag;         ///< delay of the measured speed by the sensor, at the
                                               ///< reference's final value
  std::optional<design::LoopFigures> figures;  ///< figures of `designed`, lag included

  /// Phase of the designed L at each point, unwrapped over all points. Each measured phase is shifted by
  /// whole turns to be nearest to the designed phase.
  std::vector<double> designed_phase_rad;

  /// The designed L at a frequency, including the sensor's lag; empty if `designed` is empty.
  std::optional<design::Complex> designed_at(double w_rad_s) const;
};

/// Returns the Problems of the scenario, and a Problem for
/// - a mode without a loop,
/// - a reference that is not constant at the end,
/// - a setpoint with a slew limit,
/// - a run that ends early,
/// - a drive that has not settled.
base::Result<BodeStudy> study_bode(const study::Scenario& scenario, const BodeOrder& order = {});

}  // namespace sixstep::analysis
