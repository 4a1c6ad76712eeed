// SPDX-License-Identifier: Apache-2.0
// Computes a signal with all its power at chosen frequencies, and a system's response at these frequencies.
// The response has no leakage, because only whole periods are evaluated.
//
//   r[n] = A/peak sum_k cos(2 pi l_k n/N + phi_k),    phi_k = -pi k (k - 1)/K
//
// A: amplitude, N: samples in a period, l_k, phi_k: number and phase of line k, K: number of lines, peak:
// maximum of the sum. Schroeder's phases reduce this maximum (M. R. Schroeder, IEEE Trans. Inf. Theory 16,
// 1970). Lines l_k are odd: responses to the square of the input then lie between the lines (R. Pintelon, J.
// Schoukens, System Identification, 2012, 2.4 and 4.3).
#pragma once
#include <cstddef>
#include <vector>

#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::analysis {

struct Multisine {
  std::size_t samples = 0;         ///< N, samples in a period
  std::vector<std::size_t> lines;  ///< l_k: cycles in a period, rising, odd, below N/2
  double amplitude = 0.0;          ///< the largest |r|
};

/// At most `count` odd lines up to `last`, evenly spaced in their logarithm where odd numbers are dense enough.
std::vector<std::size_t> odd_lines(std::size_t last, std::size_t count);

/// One period of the signal.
std::vector<double> samples_of(const Multisine& signal);

struct LineAnswer {
  design::Complex gain;    ///< output over input at each line, mean over the periods
  double coherence = 0.0;  ///< 1: all periods are equal; noise without a response gives about 1/periods
  double scatter = 0.0;    ///< standard deviation of the mean |gain|, divided by |gain|
};

struct Answer {
  std::vector<LineAnswer> lines;
  double beside = 0.0;  ///< fraction of the output's rms, without its mean, at frequencies that are not a
                        ///< line
};

/// The response to `signal`. `output` begins after the transient; only whole periods of it are evaluated.
Answer answer_to(const Multisine& signal, const std::vector<double>& output);

}  // namespace sixstep::analysis
