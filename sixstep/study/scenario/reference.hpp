// SPDX-License-Identifier: Apache-2.0
// The reference over time in a scenario. reference_description.hpp describes each key.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sixstep::study {

enum class Shape : std::uint8_t { constant, steps, square, ramp, sine, trapezoid, csv };
enum class Interpolation : std::uint8_t { linear, hold };

/// Values in the mode's unit: duty 1, current A, speed rad/s, position deg. Times in s count from the
/// beginning of the reference: the start of the run, or the [[at]] event that gives the reference.
struct Reference {
  Shape shape = Shape::constant;
  double value = 0.0;             // shape constant
  std::vector<double> times_s{};  // shapes steps and csv: values[n] applies at times_s[n]
  std::vector<double> values{};
  double high = 0.0, low = 0.0;  // square: the first half period is high
  double period_s = 0.01;
  double begin_s = 0.0;                  // ramp, trapezoid: the value is `start` until begin_s
  std::optional<double> start{};         // default: the preceding reference's value; 0 at the run's start
  double end = 0.0;                      // ramp, trapezoid: final value
  std::optional<double> end_s{};         // ramp: time at which it reaches `end`
  std::optional<double> slope{};         // ramp, instead of end_s; trapezoid: largest rate
  std::optional<double> acceleration{};  // trapezoid: largest change of the rate
  double offset = 0.0, amplitude = 0.0;  // shape sine
  double frequency_Hz = 0.0, phase_deg = 0.0;  // shape sine
  std::string file{};                          // csv: text/scenario/reference_file.cpp reads it into times_s
                                               // and values
  std::optional<std::string> column{};  // csv: heading of the values; without it the table has two columns
  Interpolation interpolation = Interpolation::linear;  // shape csv
  std::optional<std::string> unit{};                    // if given, it must be the mode's unit
};

}  // namespace sixstep::study
