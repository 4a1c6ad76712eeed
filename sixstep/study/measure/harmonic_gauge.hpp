// SPDX-License-Identifier: Apache-2.0
// Fundamental and distortion of a signal over whole periods: a least-squares fit of 1, cos and sin, whose
// residual is all that is neither mean nor fundamental. Whole periods make the three orthogonal, and the fit
// the Fourier coefficients. No harmonic is left out, and none is a difference of large squares
// (fundamental_fit.hpp): a pure sine shows a distortion of rounding's size and not of its root.
//
// Integrals are Gauss sums over each segment's own polynomial. The phase is worked out once per segment, from
// the time or the angle since the window's begin, so that it does not drift; from there to the nodes it is less
// than a radian, and a few terms of a series do.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/study/measure/fundamental_fit.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class HarmonicGauge {
 public:
  /// Without a frequency the fundamental follows the electrical angle, and periods are its whole turns from
  /// the window's begin on: a frequency that ripples is no distortion, and none need be known. Integrals are
  /// then over the angle. With a frequency they are over time and whole periods of it.
  HarmonicGauge(const Window& window, Signal signal, std::optional<double> frequency_Hz);

  void segment(const SegmentView& g, double s);
  /// Empty where the window holds no whole period, or the rotor turned back within it.
  std::optional<double> thd() const;

 private:
  void turn(const SegmentView& g, const Piece& y, double from, double to);
  void turn_part(const SegmentView& g, const Piece& y, double from, double to);
  void time_part(const SegmentView& g, const Piece& y, double from, double to);
  double swept(const SegmentView& g, double s) const;
  Phase phase_at(const SegmentView& g, double s) const;

  Window window_;
  Signal signal_;
  std::optional<double> frequency_Hz_;
  FundamentalFit fit_, whole_;  ///< all so far; up to the last whole turn
  bool begun_ = false, turned_back_ = false;
  std::int64_t first_sector_ = 0;  ///< where the window begins: sectors passed and angle within
  double first_x_ = 0.0;
  double direction_ = 0.0;
  std::int64_t turns_ = 0;
  double swept_ = 0.0;  ///< electrical rad since the window's begin, positive in the direction of travel
  double seconds_ = 0.0;
};

/// Periods that fit into a window: one that lacks less than a billionth of itself counts, for a window's ends
/// are decimal numbers.
inline constexpr double whole_enough = 1e-9;
double whole_periods(const Window& window, double frequency_Hz);

}  // namespace sixstep::study
