// SPDX-License-Identifier: Apache-2.0
// A measured back-EMF held against what a sheet prints of it: which frame each printed number is in.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::analysis {

/// What the printed number would be, were it in this frame.
struct FrameReading {
  std::string_view frame;   ///< as motor files have it, or in words where they have no such frame
  Interval measured;        ///< in the unit of the print
  double deviation = 0.0;   ///< measured/printed - 1
  bool is_printed = false;  ///< the sheet's file says so
  bool fits = false;
};

struct FrameCheck {
  std::string key;  ///< as the file writes it
  std::string_view unit;
  double printed = 0.0;
  std::vector<FrameReading> readings;

  const FrameReading* as_printed() const;
  bool holds() const { return as_printed() && as_printed()->fits; }
};

/// What motors of one kind differ by, and a sheet from its motors: magnets as they come, and their temperature.
inline constexpr double usual_emf_tolerance = 0.05;

/// One for each line of the sheet that speaks of the back-EMF. A reading fits where its interval, widened by
/// the tolerance and by half of the last printed digit, holds the print. Nothing without pole pairs but the
/// flux linkage.
std::vector<FrameCheck> check_frames(const EmfResult& measured, const design::Sheet& sheet, double tolerance);

}  // namespace sixstep::analysis
