// SPDX-License-Identifier: Apache-2.0
// What the rows of a run say at first reading: its largest step, the current during it, how long the bus or a
// limit held it back. Between two rows the trace is the straight line a chart draws.
#pragma once
#include <optional>
#include <string>

#include "report/held_current.hpp"
#include "report/thinning.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// The greatest change of what the controller is asked for. The first setpoint counts from the start's value. Of a drive that starts
/// without seeing its rotor, a speed's reference comes and goes with the loop, while the shaft turns: of a six-step drive that is no
/// step, of a field-oriented one a step from the speed that it takes over.
struct Step {
  std::string of;  ///< "speed", "current", "position"; "start" where nothing is controlled
  std::string unit;
  double at_s = 0.0;
  double from = 0.0, to = 0.0;
  double next_s = 0.0;  ///< the next change, or the run's end
  HeldCurrent held{};   ///< what is looked at beside it
  Interval window;      ///< worth a close-up: half as long again as the goal's neighbourhood takes
  bool done = false;    ///< the goal's neighbourhood (10 % of the step) was reached before next_s
};
std::optional<Step> largest_step(const sixstep::study::Trace& trace,
                                 const sixstep::study::Scenario& scenario);

/// When what is asked for changed for the last time; empty where nothing is asked for.
std::optional<double> last_setpoint_s(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario);

/// The held current during a step; empty where an envelope stands for it.
struct StepCurrent {
  double peak_A = 0.0, peak_after_s = 0.0;
  std::optional<double> asked_A{};  ///< the reference at the peak, where there is a current loop
  double rms_A = 0.0;               ///< over the window
  std::optional<double> then_mean_A{}, then_span_A{};  ///< from the window's end to the next change
};
std::optional<StepCurrent> step_current(const sixstep::study::Trace& trace, const Step& step);

/// How long what held the run back, s.
struct Held {
  double seen_s =
      0.0;  ///< of the run's last part, where an envelope stands for the rows before; else all of it
  double bus_s = 0.0;  ///< the driven pair fully on, or the vector on its circle: no more voltage to be had
  double largest_duty = 0.0;      ///< of three legs the vector's part of the circle
  std::optional<double> limit_A;  ///< of the current reference, in cascades
  double limit_s = 0.0;           ///< the reference at it
};
/// Empty where the bridge is switched by comparators: their duty is the state of a switch.
std::optional<Held> held_back(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                              const sixstep::study::Outcome& outcome);

}  // namespace report
