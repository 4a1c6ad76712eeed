// SPDX-License-Identifier: Apache-2.0
// A run that can stop and go on: advance it, look at its present, change its future, copy it. Which kernel and which kind of drive
// it has is decided once, where it is made; one virtual call a slice.
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
  /// Up to the first event at or behind slice.until, or to the end of the run.
  virtual sim::Stop advance(const sim::Instant& end, Slice& slice) = 0;
  /// The present instant; *this stays as it is: a copy does what is due.
  virtual void look(Slice& slice) const = 0;
  /// From now on the future of this scenario, whose past is this run's.
  virtual base::Problems take(const Scenario& scenario, const Compiled& compiled, rig::Timeline timeline) = 0;
  /// What the run leaves behind where it stands.
  virtual base::Problems end(sim::Stop stop, Observers& watchers, Outcome& out) const = 0;
  /// Of the controller's number, for the whole run.
  virtual FullScale full_scale() const = 0;

 protected:
  AnyRun(const AnyRun&) = default;
};

/// The scenario's run at its start. Problems: the arithmetic cannot hold the drive.
base::Result<std::unique_ptr<AnyRun>> made_by(const Scenario& scenario, const Compiled& compiled,
                                              rig::Timeline timeline);

}  // namespace sixstep::study::detail
