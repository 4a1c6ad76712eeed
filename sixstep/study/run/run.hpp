// SPDX-License-Identifier: Apache-2.0
// run() compiles a scenario to a timeline and a rig, runs it and computes the figures of merit.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/rig/chip_port.hpp"
#include "sixstep/rig/lockstep_core.hpp"
#include "sixstep/study/measure/logic.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// One recorded instant, in the order of the columns.
using Row = std::span<const double>;

/// Callbacks of a run. Each may be empty. None of them changes the run's result by a bit.
struct Listeners {
  std::function<void(Row)> on_record{};  ///< rows of [record]; columns of record_columns(scenario)
  std::function<void(Row)> on_event{};   ///< a row immediately before and a row immediately after each event;
                                         ///< columns of all_columns()
  LogicSink on_logic{};                  ///< gates, Hall lines, timer and others, as in logic_signals()
  std::function<bool(double t_s)> keep_going{};  ///< called from time to time; false ends the run early
  bool keep_books = true;  ///< computes energies and checks the plant's laws (audit.hpp); adds about a third
                           ///< to the run time
};

/// A core in an emulator, in one of two roles. on_core.hpp checks which scenarios it can run.
/// - The core computes the drive in parallel with the host, and each output must equal the host's output.
/// - The core is a chip that runs its own firmware instead of the drive.
struct OnCore {
  rig::CorePort beside{};
  rig::ChipPort instead{};
  /// Setpoint at the ends of the potentiometer, in the mode's unit; 0: a little more than the run's largest
  /// setpoint.
  double setpoint_range = 0.0;
};

/// Runs the scenario. A fault (shoot-through, impossible Hall code, a trip of the product drive) is part of
/// the outcome; Problems: the run could not start.
base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners = {}, const OnCore& core = {});

/// True if Listeners::keep_going ended the run early. A run that a fault stopped is not cut short.
bool cut_short(const Scenario& scenario, const Outcome& outcome);

}  // namespace sixstep::study
