// SPDX-License-Identifier: Apache-2.0
// One firmware's run that stops and goes on: what a session does with the rig at hand. A program of its own
// per firmware and arithmetic, compiled in the file named after the firmware.
#pragma once
#include <algorithm>
#include <variant>

#include "sixstep/control/fixed.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/session/session.hpp"

namespace sixstep::study::detail {

/// The segment that passed the instant asked for last: what lies within it can still be looked at.
struct LastSegment {
  plant::Plant<double> plant;
  sim::Instant from;
  double part;  ///< of its polynomials' length

  double fraction(const sim::Instant& t) const {
    const double h = plant.expansion().h;
    return h > 0 ? std::clamp(sim::seconds_between(from, t) / h, 0.0, part) : 0.0;
  }
};

/// The observer of one slice: everybody who watches the run, the row at the instant asked for, and how far
/// ahead the segments' polynomials looked. It ends the slice behind an event, so that no segment is cut.
struct Slice {
  Observers& watchers;
  Present& present;
  std::optional<LastSegment>& last;
  sim::Instant until;   ///< the row is taken here, on the polynomial of the segment that passes it
  sim::Instant& reach;  ///< of segments that skipped ticks: nothing that happens sooner may be news to them
  std::int64_t period_ticks;
  bool taken = false;
  bool stopped = false;  ///< by who watches, not by its end

  template <class Rig>
  void segment(const Rig& rig, double s) {
    watchers.segment(rig, s);
    const double h = rig.plant().expansion().h;
    const sim::Instant from = rig.now();
    if (rig.next_tick().ticks - from.ticks > period_ticks) {
      // What it wanted, not what came of it: a series that did not converge over all of that is shorter.
      const double wanted = plant::useful_length(rig.plant().constants(), rig.plant().state(), 1e6);
      reach = std::max(reach, sim::Instant{from.plus_seconds(wanted).ticks + 2, 0.0});
    }
    if (taken || sim::seconds_between(from.plus_seconds(h * s), until) > 0.5e-12) return;
    last.emplace(LastSegment{rig.plant(), from, s});
    take(rig, last->fraction(until), until.seconds());
  }
  template <class Rig>
  bool done(const Rig& rig) {
    stopped = watchers.done(rig);
    return stopped || !(rig.now() < until);
  }
  template <class Rig>
  void take(const Rig& rig, double s, double t_s) {
    present = {t_s, full_row(rig, s, t_s), logic_row(rig), rig.firmware().mode()};
    taken = true;
  }
};

template <class FirmwareType>
struct LiveRig {
  using Firmware = FirmwareType;
  rig::Rig<double, Firmware> rig;
  rig::Bases bases;  ///< the scaling of the whole run

  /// At the start of the run.
  static base::Result<LiveRig> made(const Scenario& scenario, const Compiled& compiled,
                                    rig::Timeline timeline);

  /// Up to the first event at or behind slice.until, or to the end of the run.
  sim::Stop advance(const sim::Instant& end, Slice& slice);
  /// The present instant, seen by a copy that acts and goes nowhere.
  void look(Slice& slice) const;
  /// The scenario that this run is now one of: its past is this one's.
  base::Problems take(const Scenario& scenario, const Compiled& compiled, rig::Timeline timeline);
  base::Problems end(sim::Stop stop, Observers& watchers, Outcome& out) const;
  FullScale full_scale() const { return full_scale_of<typename Firmware::Number>(bases); }
};

template <class Scalar>
using SensedRig = LiveRig<rig::SensedDrive<Scalar>>;
template <class Scalar>
using ProductRig = LiveRig<rig::ProductDrive<Scalar>>;

/// The lean firmware is the sensed one whose sensors are ideal: the same bits, and Hall lines may break.
using AnyRig = std::variant<SensedRig<double>, SensedRig<float>, SensedRig<control::Q15>,
                            SensedRig<control::Q14>, SensedRig<control::Q31>, SensedRig<control::Q30>,
                            ProductRig<double>, ProductRig<float>, ProductRig<control::Q15>,
                            ProductRig<control::Q14>, ProductRig<control::Q31>, ProductRig<control::Q30>>;

extern template struct LiveRig<rig::SensedDrive<double>>;
extern template struct LiveRig<rig::SensedDrive<float>>;
extern template struct LiveRig<rig::SensedDrive<control::Q15>>;
extern template struct LiveRig<rig::SensedDrive<control::Q14>>;
extern template struct LiveRig<rig::SensedDrive<control::Q31>>;
extern template struct LiveRig<rig::SensedDrive<control::Q30>>;
extern template struct LiveRig<rig::ProductDrive<double>>;
extern template struct LiveRig<rig::ProductDrive<float>>;
extern template struct LiveRig<rig::ProductDrive<control::Q15>>;
extern template struct LiveRig<rig::ProductDrive<control::Q14>>;
extern template struct LiveRig<rig::ProductDrive<control::Q31>>;
extern template struct LiveRig<rig::ProductDrive<control::Q30>>;

}  // namespace sixstep::study::detail
