// SPDX-License-Identifier: Apache-2.0
// A reference from a table of numbers: time in seconds in the first column, the reference in another. A back-EMF's shape
// likewise: the electrical angle in degrees, then the value.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct ReferenceRows {
  std::vector<double> times_s, values;
};

/// `text` is the file's, `name` what messages call it; it is read as every recording is (text/recording/). The first column is the time.
/// `column` is the heading of the values; without it the table has two columns. A heading may say a unit, "time [ms]" or "speed_rpm": it must be one
/// of time, and of the kind of `unit`, which the values are wanted in. Times rise from 0 on.
base::Result<ReferenceRows> reference_rows(const std::string& name, const std::string& text,
                                           const std::optional<std::string>& column, const std::string& unit);

struct ShapeRows {
  std::vector<double> angles_deg, values;
};

/// Two columns and no more, read as those of a reference: what is wrong with a line is told with its number, what is wrong with the
/// shape by design::sheet_constants().
base::Result<ShapeRows> shape_rows(const std::string& name, const std::string& text);

}  // namespace text
