// SPDX-License-Identifier: Apache-2.0
// One firmware's run, which may stop and go on: a whole run is one slice of it, a session many. A program of its
// own per firmware, arithmetic and kernel, compiled in the file named after the firmware.
#pragma once
#include <algorithm>
#include <variant>

#include "sixstep/control/fixed.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/measure/observers.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/present.hpp"

namespace sixstep::study::detail {

/// The segment that passed the instant asked for last: what lies within it can still be looked at.
struct LastSegment {
  std::variant<plant::Plant<double>, plant::general::Plant<double>> plant;
  sim::Instant from;
  double part;  ///< of its polynomials' length
  int probe_sector;

  /// Puts what moves where it stood at t.
  void look(FullRow& row, const sim::Instant& t) const {
    std::visit(
        [&](const auto& seen) {
          const double s = fraction(seen.expansion().h, t);
          set_moving(row, seen, probe_sector, s, t.seconds());
          row[static_cast<std::size_t>(ColumnId::load)] = plant::load_torque(seen, s);
          set_load_side(row, seen, s);
        },
        plant);
  }
  double fraction(double h, const sim::Instant& t) const {
    return h > 0 ? std::clamp(sim::seconds_between(from, t) / h, 0.0, part) : 0.0;
  }
};

/// The observer of one slice: everybody who watches the run, the row at the instant asked for, and how far
/// ahead the segments' polynomials looked. It ends the slice behind an event, so that no segment is cut. A whole
/// run is asked for no row, and nothing changes it.
struct Slice {
  Observers& watchers;
  Present& present;
  std::optional<LastSegment>& last;
  sim::Instant until;   ///< the row is taken here, on the polynomial of the segment that passes it
  sim::Instant& reach;  ///< of segments that skipped ticks: nothing that happens sooner may be news to them
  std::int64_t period_ticks;
  bool whole_run = false;  ///< up to its end, whatever `until` is
  bool taken = false;
  bool stopped = false;  ///< by who watches, not by its end

  template <class Rig>
  void segment(const Rig& rig, double s) {
    watchers.segment(rig, s);
    if (whole_run) return;
    const double h = rig.plant().expansion().h;
    const sim::Instant from = rig.now();
    if (rig.next_tick().ticks - from.ticks > period_ticks) {
      // What it wanted, not what came of it: a series that did not converge over all of that is shorter.
      const double wanted = useful_length(rig.plant().constants(), rig.plant().state(), 1e6);
      reach = std::max(reach, sim::Instant{from.plus_seconds(wanted).ticks + 2, 0.0});
    }
    if (taken || sim::seconds_between(from.plus_seconds(h * s), until) > 0.5e-12) return;
    last.emplace(LastSegment{rig.plant(), from, s, rig.probe_sector()});
    take(rig, last->fraction(h, until), until.seconds());
  }
  template <class Rig>
  bool done(const Rig& rig) {
    stopped = watchers.done(rig);
    return stopped || (!whole_run && !(rig.now() < until));
  }
  template <class Rig>
  void take(const Rig& rig, double s, double t_s) {
    present = {t_s, full_row(rig, s, t_s), logic_row(rig), rig.firmware().mode()};
    taken = true;
  }
};

/// `PlantType`: of the lean kernel, or of the general one where the scenario asks for what the lean one lacks. Its functions stand
/// in live_rig_parts.hpp and are compiled in the files that are named after a firmware.
template <class FirmwareType, class PlantType = plant::Plant<double>>
struct LiveRig {
  using Firmware = FirmwareType;
  rig::Rig<double, Firmware, PlantType> rig;
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

}  // namespace sixstep::study::detail
