// SPDX-License-Identifier: Apache-2.0
// What is wanted over time, as a scenario says it. What each key means stands in reference_description.hpp.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sixstep::study {

enum class Shape : std::uint8_t { constant, steps, square, ramp, sine, trapezoid, csv };
enum class Interpolation : std::uint8_t { linear, hold };

/// In the mode's unit: duty 1, current A, speed rad/s, position deg. Times count from where it takes over:
/// the run's start, or the event that sets it.
struct Reference {
  Shape shape = Shape::constant;
  double value = 0.0;             // constant
  std::vector<double> times_s{};  // steps, csv: values[n] stands at times_s[n]
  std::vector<double> values{};
  double high = 0.0, low = 0.0;  // square: high first
  double period_s = 0.01;
  double begin_s = 0.0;                        // ramp, trapezoid: it stands at start until then
  std::optional<double> start{};               // default: where the reference stood; 0 at first
  double end = 0.0;                            // ramp, trapezoid: where it goes to
  std::optional<double> end_s{};               // ramp: when it is there
  std::optional<double> slope{};               // ramp, instead of end_s; trapezoid: largest rate
  std::optional<double> acceleration{};        // trapezoid: largest change of the rate
  double offset = 0.0, amplitude = 0.0;        // sine
  double frequency_Hz = 0.0, phase_deg = 0.0;  // sine
  std::string file{};                          // csv: read into times_s and values by text
  std::optional<std::string> column{};  // csv: heading of the values; without it the table has two columns
  Interpolation interpolation = Interpolation::linear;  // csv
  std::optional<std::string> unit{};                    // checked against the mode where given
};

}  // namespace sixstep::study
