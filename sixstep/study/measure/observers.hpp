// SPDX-License-Identifier: Apache-2.0
// Joins all observers of a run: energy book, digest, figures of merit, recorders of rows and of logic.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sixstep/plant/general/audit.hpp"
#include "sixstep/study/measure/device_watch.hpp"
#include "sixstep/study/measure/digest.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/measure/iron_gauge.hpp"
#include "sixstep/study/measure/logic_recorder.hpp"
#include "sixstep/study/measure/recorder.hpp"
#include "sixstep/study/measure/run_away.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/measure/winding_watch.hpp"

namespace sixstep::study {

/// The energy books of both kernels; only the book of the kernel in use is filled.
struct Audits {
  plant::Audit<double> lean;
  plant::general::Audit<double> general;
  void segment(const plant::Plant<double>& plant, double s) { lean.segment(plant, s); }
  void segment(const plant::general::Plant<double>& plant, double s) { general.segment(plant, s); }
  plant::EnergyBook energy(const plant::Plant<double>&) const { return lean.energy(); }
  plant::EnergyBook energy(const plant::general::Plant<double>&) const { return general.energy(); }
  double copper_J(const plant::Plant<double>&) const { return lean.copper_J(); }
  double copper_J(const plant::general::Plant<double>&) const { return general.copper_J(); }
};

struct Observers {
  std::optional<Audits> audit{};
  std::optional<DeviceWatch> devices{};
  std::optional<IronGauge> iron{};
  Digest digest{};
  RunWatch extremes{};
  WindingWatch winding{};
  Figures figures;
  std::vector<GridRecorder> grids{};
  std::optional<EventRecorder> events{}, report{};
  std::optional<LogicRecorder> logic{};
  std::function<bool(double)> keep_going{};
  std::int64_t segments = 0;
  sim::Instant looked{};  ///< when done() last checked
  bool crowded = false;   ///< true: events are so dense that time hardly advances

  template <class Rig>
  void segment(const Rig& rig, double s) {
    if (audit) audit->segment(rig.plant(), s);
    if (devices) devices->segment(segment_view(rig), s);
    if (iron) iron->segment(rig.plant(), s);
    digest.segment(rig, s);
    extremes.segment(rig);
    figures.segment(rig, s);
    for (GridRecorder& grid : grids) grid.segment(rig, s);
    if (events) events->segment(rig, s);
    if (report) report->segment(rig, s);
    if (logic) logic->segment(rig, s);
    ++segments;
  }
  /// Called repeatedly during the run, and at its end. Compiled for size, once for each kind of rig.
  template <class Rig>
  [[gnu::noinline, gnu::cold]] void look(const Rig& rig) {
    extremes.look(rig);
    if (!audit) return;
    const design::Temperatures* simulated = nullptr;
    design::Temperatures bodies;
    if constexpr (requires { rig.plant().heat(); })
      if (rig.plant().heat().on()) {
        const plant::BodyTemperatures now = rig.plant().bodies_degC(0.0);
        bodies = {now.winding, now.housing};
        simulated = &bodies;
      }
    winding.look(rig.now().seconds(), audit->copper_J(rig.plant()),
                 static_cast<double>(rig.plant().state().w), simulated);
  }
  /// Checks often enough for a quick response to a user, and seldom enough to cost almost nothing.
  template <class Rig>
  bool done(const Rig& rig) {
    if (segments % 256 != 0) return false;
    look(rig);
    const sim::Instant now = rig.now();
    crowded = now.ticks <= looked.ticks;
    looked = now;
    return crowded || has_run_away(rig.plant()) || (keep_going && !keep_going(now.seconds()));
  }
};

}  // namespace sixstep::study
