// SPDX-License-Identifier: Apache-2.0
// Open-circuit voltages of a motor that is turned from outside, as an oscilloscope records them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// The two points that a probe was connected to.
enum class EmfBetween : std::uint8_t {
  lines,  ///< voltages between two terminals: u_ab, u_bc, u_ca
  star    ///< a terminal and the star point, real or from three equal resistors
};

struct EmfChannel {
  std::string name;  ///< name of the channel's column
  std::vector<double> u_V;
};

struct EmfRecord {
  std::vector<double> t_s;  ///< rising times
  std::vector<EmfChannel> channels;
  EmfBetween between = EmfBetween::lines;
};

/// Problems: number of channels, too few rows, times that do not rise, columns of different lengths, no numbers.
base::Problems check(const EmfRecord& record);

inline constexpr std::size_t most_emf_channels = 3;
/// Least number of periods in a recording: with fewer, harmonics and an offset cannot be distinguished.
inline constexpr double least_periods = 1.5;

}  // namespace sixstep::analysis
