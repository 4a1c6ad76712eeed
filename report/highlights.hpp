// SPDX-License-Identifier: Apache-2.0
// Finds the main facts in the rows of a run: its largest step, the current during the step, and the time
// during which the bus or a limit delayed the run. Between two rows the trace is a straight line, as in a
// chart.
#pragma once
#include <optional>
#include <string>

#include "report/held_current.hpp"
#include "report/thinning.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// The greatest change of the setpoint. The first setpoint is compared with the value at the start. In a
/// sensorless start, the speed reference is 0 until the speed loop starts, although the shaft already turns.
/// For a six-step drive, this change of the reference is not a step. For a field-oriented drive, it is a step
/// from the speed at which the loop starts.
struct Step {
  std::string of;  ///< "speed", "current", "position"; "start" if nothing is controlled
  std::string unit;
  double at_s = 0.0;
  double from = 0.0, to = 0.0;
  double index = 0.0;   ///< position: angle of an encoder's index if the drive counts from it, else 0
  double next_s = 0.0;  ///< time of the next change, or the run's end
  HeldCurrent held{};   ///< the current that is shown with the step
  Interval window;      ///< interval of the close-up. Its length is 1.5 times the time until the signal
                        ///< differs from its goal by at most 10 % of the step
  bool done = false;    ///< true: before next_s the signal was within 10 % of the step of its goal
};
std::optional<Step> largest_step(const sixstep::study::Trace& trace,
                                 const sixstep::study::Scenario& scenario);

/// Time of the last change of the setpoint; empty if there is none.
std::optional<double> last_setpoint_s(const sixstep::study::Trace& trace,
                                      const sixstep::study::Scenario& scenario);

/// The current during a step; empty if an envelope replaces the step's rows.
struct StepCurrent {
  double peak_A = 0.0,
         peak_after_s = 0.0;            ///< peak: for a step of the current, the farthest value in the step's
                                        ///< direction
  std::optional<double> asked_A{};      ///< the reference at the peak, if there is a current loop
  double rms_A = 0.0;                   ///< rms over the window
  std::optional<double> then_mean_A{};  ///< mean from the window's end to the next change
  double then_low_A = 0.0, then_high_A = 0.0;  ///< extremes from the window's end to the next change
};
std::optional<StepCurrent> step_current(const sixstep::study::Trace& trace, const Step& step);

/// Time in s during which the bus or a limit delayed the response.
struct Held {
  double seen_s = 0.0;  ///< length of the evaluated time: the run, without rows that an envelope replaces
  double bus_s = 0.0;   ///< time with the voltage at its limit: the driven pair fully on, or the voltage
                        ///< vector on its circle
  double largest_duty = 0.0;      ///< for three legs, the length of the vector relative to the circle
  std::optional<double> limit_A;  ///< limit of the current reference; only in a cascade
  double limit_s = 0.0;           ///< time with the reference at the limit
};
/// The delays of a run. Empty if comparators switch the bridge, because the duty is then only the state of a
/// switch.
std::optional<Held> held_back(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
