// SPDX-License-Identifier: Apache-2.0
// Lays recordings over the signals of a run: samples the signals at the recordings' interval, fits what is free
// of the probe, and compares figures.
#pragma once
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/recorded_figures.hpp"
#include "sixstep/study/measure/recorder.hpp"

namespace sixstep::study {

/// Probe and time that lay a recording over a signal.
struct Placing {
  double shift_s = 0.0;
  double scale = 1.0, offset = 0.0;              ///< signal = scale * recorded + offset
  double scale_bound = 0.0, offset_bound = 0.0;  ///< half widths of the 95 % intervals of what was fitted
  double rms = 0.0, greatest = 0.0, at_s = 0.0;  ///< of recording less simulation, in the signal's unit
  double span = 0.0;                             ///< highest less lowest simulated value
  std::size_t rows = 0;
};

/// Fits the free properties by least squares; a free shift is searched over `period_s` from the recording's
/// shift on. The first row has the time `from_s` plus shift. Rows beyond the simulated samples are left out.
Placing placed(const Recording& recording, const Samples& recorded, const Samples& simulated, double from_s,
               double period_s);

/// The recordings of a scenario during one run.
class Laying {
 public:
  explicit Laying(const Scenario& scenario);
  Laying(const Laying&) = delete;
  Laying& operator=(const Laying&) = delete;
  /// Adds what samples the signals. The recorders must not outlive this object.
  void watch(std::vector<GridRecorder>& grids);
  /// Adds the comparisons to the outcome.
  void judge(Outcome& outcome) const;

 private:
  void judge_one(std::size_t n, Outcome& outcome, std::vector<LaidRecording>& pictures) const;

  const Scenario& scenario_;
  struct Watched {
    Samples signal;
    double first_angle = 0.0, last_angle = 0.0;
  };
  std::vector<Watched> watched_;
};

}  // namespace sixstep::study
