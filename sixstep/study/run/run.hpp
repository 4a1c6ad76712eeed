// SPDX-License-Identifier: Apache-2.0
// run() compiles a scenario to a timeline and a rig, runs it and takes the figures of merit.
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
  std::function<void(Row)> on_record{};  ///< rows of [record], with the columns of record_columns(scenario)
  std::function<void(Row)> on_event{};   ///< every event, both sides of each jump; columns all_columns()
  LogicSink on_logic{};                  ///< gates, Hall lines, timer and others: logic_signals()
  std::function<bool(double t_s)> keep_going{};  ///< called now and then; false ends the run early
  bool keep_books = true;  ///< energy books and standing laws: about a third of run time more
};

/// A core in an emulator. Either it computes the drive in parallel with the host, and each answer must equal
/// the host's; or it is a chip that runs its own firmware instead of the drive. on_core.hpp checks which
/// scenarios they can run.
struct OnCore {
  rig::CorePort beside{};
  rig::ChipPort instead{};
  /// Setpoint at the ends of the potentiometer, in the mode's unit; 0: the run's own range.
  double setpoint_range = 0.0;
};

/// Runs the scenario. A fault (shoot-through, impossible Hall code, a trip of the product drive) is part of the
/// outcome; Problems: the run could not start.
base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners = {}, const OnCore& core = {});

/// Whether Listeners::keep_going ended the run early. A run that a fault stopped is not cut short.
bool cut_short(const Scenario& scenario, const Outcome& outcome);

}  // namespace sixstep::study
