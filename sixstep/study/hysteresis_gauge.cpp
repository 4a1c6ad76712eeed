// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/hysteresis_gauge.hpp"

#include "sixstep/series/extremes.hpp"

namespace sixstep::study {

void HysteresisGauge::part(Watched& watched, const Series& c, int degree, int sector, double key,
                           double lower, double upper) {
  if (key != watched.key) watched.excused_above = watched.excused_below = true;
  if (sector != watched.sector) watched.excused_below = true;
  watched.key = key;
  watched.sector = sector;
  const series::Extremes<double> e = series::extremes(c, degree);
  if (!watched.excused_above) figures_.excess_A = std::max(figures_.excess_A, e.high - upper);
  if (!watched.excused_below) figures_.deficit_A = std::max(figures_.deficit_A, lower - e.low);
  const double last = series::evaluate(c, degree, 1.0);
  if (last <= upper) watched.excused_above = false;
  if (last >= lower && last <= upper) watched.excused_below = false;
}

}  // namespace sixstep::study
