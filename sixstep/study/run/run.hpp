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

/// Who listens to a run. Each may be empty. None of them can change the run's result by a bit.
struct Listeners {
  std::function<void(Row)> on_record{};  ///< the scenario's [record]: columns record_columns(scenario)
  std::function<void(Row)> on_event{};   ///< every event, both sides of each jump: columns all_columns()
  LogicSink on_logic{};  ///< gates, Hall lines, timer and the like, as logic_signals() names them
  std::function<bool(double t_s)> keep_going{};  ///< now and then; false ends the run early
  bool keep_books = true;  ///< energy and standing laws: about a third on top of the run itself
};

/// A core in an emulator: one that runs the drive too, and must answer as the host does, or a chip that runs a firmware of its own
/// in the drive's place. Which scenarios they can run: on_core.hpp.
struct OnCore {
  rig::CorePort beside{};
  rig::ChipPort instead{};
  /// What its potentiometer's ends mean to that firmware, in the mode's unit; 0: what the run has use for.
  double setpoint_range = 0.0;
};

/// Runs it. A fault (shoot-through, impossible Hall code, a trip of the product drive) is part of the
/// outcome; Problems mean it could not start.
base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners = {}, const OnCore& core = {});

/// Someone ended the run before its time (Listeners::keep_going); a run that a fault stopped is whole.
bool cut_short(const Scenario& scenario, const Outcome& outcome);

}  // namespace sixstep::study
