// SPDX-License-Identifier: Apache-2.0
// A slice of a run: its observers and its end. A whole run is one slice, a session many.
#pragma once
#include <algorithm>
#include <functional>
#include <optional>
#include <variant>

#include "sixstep/plant/general/plant.hpp"
#include "sixstep/plant/plant.hpp"
#include "sixstep/study/measure/observers.hpp"
#include "sixstep/study/measure/present.hpp"

namespace sixstep::study::detail {

/// The segment that contains the last requested instant, kept so that instants within it can still be sampled.
struct LastSegment {
  std::variant<plant::Plant<double>, plant::general::Plant<double>> plant;
  sim::Instant from;
  double part;  ///< fraction of the polynomials' length that was simulated
  int probe_sector;
  /// Sets the columns of an encoder or a resolver. Empty: the firmware has none.
  std::function<void(FullRow& row, const LastSegment& at, double s, double t_s)> shaft{};

  /// `rig`: its state before the segment.
  template <class Rig>
  static LastSegment of(const Rig& rig, double s) {
    LastSegment segment{rig.plant(), rig.now(), s, rig.probe_sector()};
    const rig::ShaftPorts* const ports = rig::shaft_ports_of(rig.firmware());
    if (ports == nullptr || ports->given().kind == rig::ShaftSensor::none) return segment;
    segment.shaft = [ports = *ports, pole_pairs = rig.shaft_motion(s, rig.now()).pole_pairs](
                        FullRow& row, const LastSegment& at, double part, double t_s) {
      using Plant = std::decay_t<decltype(rig.plant())>;
      const auto& plant = std::get<Plant>(at.plant);
      rig::ShaftMotion<double> motion{plant.expansion(), plant.state().sector, pole_pairs, part};
      if constexpr (requires { plant.series(); })
        if (ports.given().on_load)
          motion.load = {&plant.series().load_w, plant.constants().elastic ? &plant.series().twist : nullptr,
                         plant.constants().inv_gear};
      set_shaft_sensor(row, ports, motion, part, t_s);
    };
    return segment;
  }

  /// Sets the moving quantities of `row` to their values at t.
  void look(FullRow& row, const sim::Instant& t) const {
    std::visit(
        [&](const auto& seen) {
          const double s = fraction(seen.expansion().h, t);
          set_moving(row, seen, probe_sector, s, t.seconds());
          row[static_cast<std::size_t>(ColumnId::load)] = plant::load_torque(seen, s);
          set_load_side(row, seen, s);
        },
        plant);
    if (shaft) shaft(row, *this, fraction(t), t.seconds());
  }
  double fraction(const sim::Instant& t) const {
    return fraction(
        std::visit([](const auto& seen) { return static_cast<double>(seen.expansion().h); }, plant), t);
  }
  double fraction(double h, const sim::Instant& t) const {
    return h > 0 ? std::clamp(sim::seconds_between(from, t) / h, 0.0, part) : 0.0;
  }
};

/// The observer of one slice. It forwards to all observers of the run, takes the row at the requested
/// instant, and records how far the segments extend. The slice ends after an event, so that no segment is
/// cut. In a whole run the observer takes no row and does not affect the run.
struct Slice {
  Observers& watchers;
  Present& present;
  std::optional<LastSegment>& last;
  sim::Instant until;   ///< instant of the row, within this segment
  sim::Instant& reach;  ///< end of segments that skipped ticks: no change may occur before this instant
  std::int64_t period_ticks;
  bool whole_run = false;  ///< true: continues to the end of the run, whatever `until` is
  bool unread = false;     ///< true: no row is taken
  bool taken = false;
  bool stopped = false;                ///< true: an observer stopped the slice before its end
  std::optional<std::uint8_t> pins{};  ///< the slice ends when the Hall pins show another code

  template <class Rig>
  void segment(const Rig& rig, double s) {
    watchers.segment(rig, s);
    if (whole_run) return;
    const double h = rig.plant().expansion().h;
    const sim::Instant from = rig.now();
    // A chip with its own clock has no ticks to skip.
    constexpr bool ticks = !requires { rig.firmware().next_stop(); };
    if (ticks && rig.next_tick().ticks - from.ticks > period_ticks) {
      // Uses the requested length, because a series that does not converge over this length is shortened.
      const double wanted = useful_length(rig.plant().constants(), rig.plant().state(), 1e6);
      reach = std::max(reach, sim::Instant{from.plus_seconds(wanted).ticks + 2, 0.0});
    }
    // An event up to half a picosecond before `until` is followed by another segment, which contains the row.
    if (unread || sim::seconds_between(from.plus_seconds(h * s), until) > 0.5e-12) return;
    last.emplace(LastSegment::of(rig, s));
    take(rig, last->fraction(h, until), until.seconds());
  }
  template <class Rig>
  bool done(const Rig& rig) {
    stopped = watchers.done(rig);
    if (pins && pins_at(rig) != *pins) return true;
    return stopped || (!whole_run && !(rig.now() < until));
  }
  /// Code of the Hall pins at the present instant, after all actions that are due.
  template <class Rig>
  static std::uint8_t pins_at(const Rig& rig) {
    if (!rig.pins_due()) return rig.pins();
    Rig twin = rig;
    twin.act();
    return twin.pins();
  }
  template <class Rig>
  void take(const Rig& rig, double s, double t_s) {
    present = {t_s, full_row(rig, s, t_s), logic_row(rig), rig.firmware().mode()};
    taken = true;
  }
};

}  // namespace sixstep::study::detail
