// SPDX-License-Identifier: Apache-2.0
// A run that can stop and continue. It can be advanced, sampled at the present instant, continued with a
// changed scenario, and copied. The kernel and the kind of drive are chosen once, when the run is made; after
// that each slice costs one virtual call.
#pragma once
#include <memory>

#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/live/slice.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::study::detail {

class AnyRun {
 public:
  AnyRun() = default;
  AnyRun& operator=(const AnyRun&) = delete;
  virtual ~AnyRun() = default;

  virtual std::unique_ptr<AnyRun> clone() const = 0;
  virtual sim::Instant now() const = 0;
  virtual sim::Instant next_tick() const = 0;
  /// Advances up to the first event at or after slice.until, or to the end of the run.
  virtual sim::Stop advance(const sim::Instant& end, Slice& slice) = 0;
  /// Samples the present instant. Actions due at this instant are executed in a copy, so that *this stays
  /// unchanged.
  virtual void look(Slice& slice) const = 0;
  /// Continues the run with `scenario`, which must equal the run's scenario up to the present instant.
  virtual base::Problems take(const Scenario& scenario, const Compiled& compiled, rig::Timeline timeline) = 0;
  /// Writes the results of the run up to the present instant to `out`.
  virtual base::Problems end(sim::Stop stop, Observers& watchers, Outcome& out) const = 0;
  /// Full scale of the controller's arithmetic, for the whole run.
  virtual FullScale full_scale() const = 0;

 protected:
  AnyRun(const AnyRun&) = default;
};

/// Creates the scenario's run at t = 0. Problems: the drive's numbers do not fit into the arithmetic.
base::Result<std::unique_ptr<AnyRun>> made_by(const Scenario& scenario, const Compiled& compiled,
                                              rig::Timeline timeline);

}  // namespace sixstep::study::detail
