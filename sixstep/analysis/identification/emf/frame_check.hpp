// SPDX-License-Identifier: Apache-2.0
// Compares a measured back-EMF with the sheet's printed values, to find the frame of each printed value.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::analysis {

/// The measured value in one of the possible frames of the printed number.
struct FrameReading {
  std::string_view frame;   ///< name as in motor files; a description for a frame that has no such name
  Interval measured;        ///< in the unit of the printed value
  double deviation = 0.0;   ///< measured/printed - 1
  bool is_printed = false;  ///< true: the sheet's file names this frame
  bool fits = false;
};

struct FrameCheck {
  std::string key;  ///< the key as the file writes it
  std::string_view unit;
  double printed = 0.0;
  std::vector<FrameReading> readings;

  const FrameReading* as_printed() const;
  bool holds() const { return as_printed() && as_printed()->fits; }
};

/// Usual difference in the back-EMF between motors of one type, and between a motor and its sheet, caused by
/// the magnets and their temperature.
inline constexpr double usual_emf_tolerance = 0.05;

/// One check for each line of the sheet about the back-EMF. A reading fits if its interval contains the
/// printed value, after widening by the tolerance and by half of the last printed digit. Without pole pairs,
/// only the flux linkage is checked.
std::vector<FrameCheck> check_frames(const EmfResult& measured, const design::Sheet& sheet, double tolerance);

}  // namespace sixstep::analysis
