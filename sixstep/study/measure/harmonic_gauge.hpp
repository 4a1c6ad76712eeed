// SPDX-License-Identifier: Apache-2.0
// Measures fundamental and distortion of a signal over whole periods by a least-squares fit of 1, cos and
// sin. The residual is everything except mean and fundamental. Over whole periods the three functions are
// orthogonal, and the fit gives the Fourier coefficients. All harmonics count, and no result is a difference
// of large squares (fundamental_fit.hpp): the distortion of a pure sine is of the order of 2^-53, not of its
// square root.
//
// Integrals are Gauss sums over each segment's own polynomial. The phase is computed once per segment, from
// the time or the angle since the window's beginning, so that it does not drift. The nodes are less than a
// radian from this phase, so that a few terms of a series suffice.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/study/measure/fundamental_fit.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class HarmonicGauge {
 public:
  /// Without a frequency the fundamental follows the electrical angle. Its periods are whole turns from the
  /// window's beginning on, and integrals are over the angle. Ripple of the speed then causes no distortion,
  /// and no frequency is required. With a frequency, integrals are over time and whole periods of this
  /// frequency.
  HarmonicGauge(const Window& window, Signal signal, std::optional<double> frequency_Hz);

  void segment(const SegmentView& g, double s);
  /// Empty if the window contains no whole period, or the rotor reversed within the window.
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
  FundamentalFit fit_, whole_;  ///< fit_: all parts so far; whole_: all parts up to the end of the last whole
                                ///< turn
  bool begun_ = false, turned_back_ = false;
  std::int64_t first_sector_ = 0;  ///< at the window's beginning: sectors passed, and angle within the sector
  double first_x_ = 0.0;
  double direction_ = 0.0;
  std::int64_t turns_ = 0;
  double swept_ = 0.0;  ///< electrical rad since the window's beginning, positive in the direction of
                        ///< rotation
  double seconds_ = 0.0;
};

/// A period counts as whole if at most this fraction of it is missing: a window's ends are decimal numbers,
/// whose rounding can shorten a period.
inline constexpr double whole_enough = 1e-9;
double whole_periods(const Window& window, double frequency_Hz);

}  // namespace sixstep::study
