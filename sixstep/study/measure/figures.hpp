// SPDX-License-Identifier: Apache-2.0
// Takes all figures of merit of a run, segment by segment, and then judges the requirements.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/commutation_gauge.hpp"
#include "sixstep/study/measure/energy_gauge.hpp"
#include "sixstep/study/measure/gauge.hpp"
#include "sixstep/study/measure/harmonic_gauge.hpp"
#include "sixstep/study/measure/hysteresis_gauge.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/switching_gauge.hpp"
#include "sixstep/study/scenario/measure_choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::study {

/// One gauge per step or level of the reference, in the order of their windows; the worst value counts.
using Gauges = std::vector<Gauge>;

/// The types that measure a figure. Each reads segments and returns the figure's value at the end of the run.
struct BandExcess {
  HysteresisGauge gauge;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const { return gauge.figures().excess_A; }
};
struct BandDeficit {
  HysteresisGauge gauge;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const { return gauge.figures().deficit_A; }
};
struct Energy {
  EnergyGauge gauge;
  Signal signal;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const;
};
struct Efficiency {
  EnergyGauge gauge;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const;
};
struct Distortion {
  HarmonicGauge gauge;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const;
};
struct CommutationError {
  CommutationGauge gauge;
  bool rms = false;
  void segment(const SegmentView& g, double s) { gauge.segment(g, s); }
  double value() const { return rms ? gauge.rms_deg() : gauge.worst_deg(); }
};
using Taken = std::variant<Gauges, BandExcess, BandDeficit, SwitchingGauge, SwitchingLossGauge, Energy,
                           Efficiency, Distortion, CommutationError>;

class Figures {
 public:
  Figures(const Scenario& scenario, const std::vector<Level>& levels);

  /// Does nothing in a run without figures.
  template <class Rig>
  void segment(const Rig& rig, double s) {
    if (!figures_.empty()) watch(segment_view(rig), s);
  }

  void judge(const Scenario& scenario, Outcome& outcome) const;

 private:
  struct Figure {
    Measure measure;
    Taken taken_by;
    std::size_t behind = 0;  ///< number of gauges whose window has passed
  };
  void watch(const SegmentView& g, double s);

  std::vector<Figure> figures_;  ///< figures of requirements and comparisons, and the whole signals of
                                 ///< sampled figures
};

/// Name of a measure without a label: "settling time of motor current".
std::string figure_name(const Measure& measure);
/// The name of a measure in the words of the scenario's motor: "final force".
std::string figure_name(const Scenario& scenario, const Measure& measure);

/// The value from which a figure's size counts: the ambient temperature for a temperature on the Celsius
/// scale, whose zero is arbitrary; else 0.
double figure_zero(const Scenario& scenario, const Measure& measure);

/// Unit of a figure in results, with its factor. For a linear motor its unit replaces the unit of
/// measure_choices.hpp.
inline base::LinearUnit unit_in(const Scenario& scenario, std::string_view unit) {
  return scenario.sheet.kind == design::MotorKind::linear ? base::in_linear(unit)
                                                          : base::LinearUnit{unit, unit, 1.0};
}

}  // namespace sixstep::study
