// SPDX-License-Identifier: Apache-2.0
// Figures by integrals over a window, and the value at its end. Each figure reads, like all parts of
// gauge.hpp, either the signal over [t0, t0 + length] as a polynomial of s in [0, 1], or the controller's
// samples.
#pragma once
#include <cmath>

#include "sixstep/series/quadrature.hpp"
#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

class FinalValue {
 public:
  void part(const Series& c, int degree, double, double) { last_ = series::evaluate(c, degree, 1.0); }
  void sample(double, double value) { last_ = value; }
  double value(double) const { return last_; }

 private:
  double last_ = 0.0;
};

class Mean {
 public:
  void part(const Series& c, int degree, double, double length) {
    integral_ += length * series::whole_integral(c, degree);
    seconds_ += length;
  }
  void sample(double, double value) {
    integral_ += value;
    seconds_ += 1.0;
  }
  double value(double) const { return integral_ / seconds_; }

 private:
  double integral_ = 0.0, seconds_ = 0.0;
};

/// The level minus the signal's mean.
class SteadyError {
 public:
  explicit SteadyError(double level) : level_(level) {}
  void part(const Series& c, int degree, double t0, double length) { mean_.part(c, degree, t0, length); }
  void sample(double t, double value) { mean_.sample(t, value); }
  double value(double from_s) const { return level_ - mean_.value(from_s); }

 private:
  Mean mean_;
  double level_;
};

class Rms {
 public:
  void part(const Series& c, int degree, double, double length) {
    integral_ += length * series::product_integral(c, c, degree, 1.0);
    seconds_ += length;
  }
  void sample(double, double value) {
    integral_ += value * value;
    seconds_ += 1.0;
  }
  double value(double) const { return std::sqrt(integral_ / seconds_); }

 private:
  double integral_ = 0.0, seconds_ = 0.0;
};

/// Rms about the mean. The mean is known only at the end; until then each interval has its own mean, and
/// intervals are merged.
class RippleRms {
 public:
  void part(const Series& c, int degree, double, double length) {
    const double mean = series::whole_integral(c, degree);
    Series about = c;
    about[0] -= mean;
    merge(mean, length * series::product_integral(about, about, degree, 1.0), length);
  }
  void sample(double, double value) { merge(value, 0.0, 1.0); }
  double value(double) const { return std::sqrt(squares_ / seconds_); }

 private:
  /// Merges two intervals into one (Chan, Golub, LeVeque 1983) without a difference of large squares, so that
  /// a ripple of a millionth of its mean keeps its digits.
  void merge(double mean, double squares, double length) {
    const double all = seconds_ + length;
    if (!(all > 0.0)) return;
    const double apart = mean - mean_;
    mean_ += apart * (length / all);
    squares_ += squares + apart * apart * (seconds_ * (length / all));
    seconds_ = all;
  }

  double mean_ = 0.0, squares_ = 0.0, seconds_ = 0.0;  ///< squares: integral of the square about the mean
};

}  // namespace sixstep::study
