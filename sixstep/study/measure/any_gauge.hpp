// SPDX-License-Identifier: Apache-2.0
// Chooses the gauge of each metric; this is the only list of gauges.
#pragma once
#include <limits>
#include <variant>

#include "sixstep/study/measure/extreme_gauges.hpp"
#include "sixstep/study/measure/mean_gauges.hpp"
#include "sixstep/study/measure/step_gauges.hpp"

namespace sixstep::study {

/// Used for metrics that are not computed from one signal's curve.
struct NoGauge {
  void part(const Series&, int, double, double) {}
  void sample(double, double) {}
  double value(double) const { return std::numeric_limits<double>::quiet_NaN(); }
};

using AnyGauge = std::variant<NoGauge, FinalValue, Mean, SteadyError, Rms, RippleRms, ExtremeGauge<Maximum>,
                              ExtremeGauge<Minimum>, ExtremeGauge<PeakToPeak>, ExtremeGauge<LargestError>,
                              ExtremeGauge<Overshoot>, ReachTime, RiseTime, SettlingTime>;

inline AnyGauge gauge_for(const Measure& m, const Step& step) {
  switch (m.metric) {
    case MetricKind::final_value:
      return FinalValue();
    case MetricKind::mean:
      return Mean();
    case MetricKind::steady_error:
      return SteadyError(step.level);
    case MetricKind::rms:
      return Rms();
    case MetricKind::ripple_rms:
      return RippleRms();
    case MetricKind::maximum:
      return ExtremeGauge(Maximum{});
    case MetricKind::minimum:
      return ExtremeGauge(Minimum{});
    case MetricKind::peak_to_peak:
      return ExtremeGauge(PeakToPeak{});
    case MetricKind::largest_error:
      return ExtremeGauge(LargestError{step.level});
    case MetricKind::overshoot:
      return ExtremeGauge(Overshoot{step});
    case MetricKind::reach_time:
      return ReachTime(step, m.fraction);
    case MetricKind::rise_time:
      return RiseTime(step);
    case MetricKind::settling_time:
      return SettlingTime(step, m.band);
    case MetricKind::thd:
    case MetricKind::energy:
    case MetricKind::efficiency:
    case MetricKind::band_excess:
    case MetricKind::band_deficit:
    case MetricKind::switching_frequency:
    case MetricKind::switching_loss:
    case MetricKind::commutation_error:
    case MetricKind::commutation_error_rms:
      break;
  }
  return NoGauge();
}

}  // namespace sixstep::study
