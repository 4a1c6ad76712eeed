// SPDX-License-Identifier: Apache-2.0
// A scenario's drive as a C++ header for firmware: the bits that the simulation computes with, as constants.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "io/rooms.hpp"
#include "sixstep/base/describe.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/design/scaling.hpp"
#include "sixstep/study/scenario.hpp"

namespace io {

enum class HeaderArithmetic : std::uint8_t { float64, float32, q15, q14, q31, q30 };

inline constexpr base::Choice<HeaderArithmetic> header_arithmetic_choices[] = {
    {"double", HeaderArithmetic::float64, "64-bit floating point"},
    {"float", HeaderArithmetic::float32, "32-bit floating point"},
    {"q15", HeaderArithmetic::q15,
     "16-bit fixed point, -1 to 1 - 2^-15: the largest duty is one digit below 1"},
    {"q14", HeaderArithmetic::q14,
     "16-bit fixed point, -2 to 2 - 2^-14: has the duty 1, and half the resolution"},
    {"q31", HeaderArithmetic::q31, "32-bit fixed point, -1 to 1 - 2^-31"},
    {"q30", HeaderArithmetic::q30, "32-bit fixed point, -2 to 2 - 2^-30: has the duty 1"},
};

struct ConfigHeader {
  const study::Scenario& scenario;
  std::optional<HeaderArithmetic> arithmetic;  ///< else the scenario's
  /// Fixed point: over what the drive is proved. Members that are 0 are study::operating_range's.
  design::OperatingRange range;
  std::string name_space;      ///< what the header declares is in it; a C++ name
  bool single_header = false;  ///< includes sixstep_control.hpp, not sixstep/control/
  std::string command;         ///< what makes this header again
};

/// The header's text. Problems: a scenario without a drive (mode off), and what does not fit the fixed-point
/// format, as design::scaled names it.
base::Result<std::string> config_header(const ConfigHeader& wanted);

}  // namespace io
