// SPDX-License-Identifier: Apache-2.0
// Measures the winding's loss in the last fifth of a run, in two halves. A remark uses it to predict the loss
// after the run.
#pragma once
#include <cmath>
#include <optional>

namespace sixstep::study {

struct EndWatch {
  /// The winding's loss so far, and the speed, at an instant of the run.
  struct Mark {
    double t_s = 0.0, copper_J = 0.0, speed_rad_s = 0.0;
  };
  /// Shortest run with such a prediction. Shorter runs usually test a step of the current, not a steady
  /// state.
  static constexpr double least_s = 0.05;

  double duration_s = 0.0;  ///< planned length of the run
  std::optional<Mark> first{}, middle{}, last{};

  /// True if look() uses this time.
  bool wants(double t_s) const { return duration_s >= least_s && t_s >= 0.8 * duration_s; }
  /// Called repeatedly during the run, and at its end.
  void look(double t_s, double copper_J, double speed_rad_s) {
    if (!wants(t_s)) return;
    const Mark now{t_s, copper_J, speed_rad_s};
    if (!first) first = now;
    if (!middle && t_s >= 0.9 * duration_s) middle = now;
    last = now;
  }

  /// The winding's steady loss at the run's end, as the mean since `since_s`, and the speed at the end.
  struct Kept {
    double copper_W = 0.0, speed_rad_s = 0.0, since_s = 0.0;
  };
  /// Empty if the run is too short, or if loss or speed still change: the halves' copper losses differ by
  /// more than a tenth, or speeds by more than a fiftieth and `noise_rad_s`.
  std::optional<Kept> kept(double noise_rad_s) const {
    if (!middle || !last || !(first->t_s < middle->t_s) || !(middle->t_s < last->t_s)) return {};
    const auto loss_W = [](const Mark& a, const Mark& b) {
      return (b.copper_J - a.copper_J) / (b.t_s - a.t_s);
    };
    const double before_W = loss_W(*first, *middle), after_W = loss_W(*middle, *last);
    const double allowed = std::fabs(last->speed_rad_s) / 50 + noise_rad_s;
    if (!(std::fabs(after_W - before_W) <= 0.1 * std::fmax(before_W, after_W)) ||
        !(std::fabs(first->speed_rad_s - last->speed_rad_s) <= allowed) ||
        !(std::fabs(middle->speed_rad_s - last->speed_rad_s) <= allowed))
      return {};
    return Kept{after_W, last->speed_rad_s, middle->t_s};
  }
};

}  // namespace sixstep::study
