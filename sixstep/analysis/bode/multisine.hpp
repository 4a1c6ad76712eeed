// SPDX-License-Identifier: Apache-2.0
// A signal with all its power at chosen frequencies, and what a system makes of it: exact, since every period is whole.
//
//   r[n] = A/peak sum_k cos(2 pi l_k n/N + phi_k),    phi_k = -pi k (k - 1)/K
//
// Schroeder's phases keep the peak low (M. R. Schroeder, IEEE Trans. Inf. Theory 16, 1970). Lines l_k are odd, so that
// what a system answers with the square of its input falls beside all of them (R. Pintelon, J. Schoukens, System
// Identification, 2012, 2.4 and 4.3).
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::analysis {

struct Multisine {
  std::size_t samples = 0;         ///< N of a period
  std::vector<std::size_t> lines;  ///< cycles in a period, rising, odd, below N/2
  double amplitude = 0.0;          ///< the largest |r|
};

/// Odd lines up to `last`, evenly spaced in their logarithm where they are that dense; at most `count`.
std::vector<std::size_t> odd_lines(std::size_t last, std::size_t count);

/// One period.
std::vector<double> samples_of(const Multisine& signal);

struct LineAnswer {
  design::Complex gain;    ///< output over input, mean of the periods
  double coherence = 0.0;  ///< 1: every period alike; of noise alone about one over the periods
  double scatter = 0.0;    ///< standard deviation of |gain| over |gain|, of the mean
};

struct Answer {
  std::vector<LineAnswer> lines;
  double beside = 0.0;  ///< of the output's rms without its mean, the part that stands at no line
};

/// What came out while `signal` went in, over whole periods from a transient's end on; what is left of the last one is not looked at.
Answer answer_to(const Multisine& signal, const std::vector<double>& output);

}  // namespace sixstep::analysis
