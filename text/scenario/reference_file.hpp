// SPDX-License-Identifier: Apache-2.0
// Reads a reference from a table of numbers: time in seconds in the first column, the reference in another
// column. A back-EMF's shape is read in the same way: the electrical angle in degrees, then the value.
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

/// Reads the rows. `text` is the file's content, `name` its name in messages. The file is read like every
/// recording (text/recording/). The first column is the time, rising from 0 on. `column` is the heading of
/// the values. If it is empty, the table must have two columns. A heading may contain a unit, "time [ms]" or
/// "speed_rpm". The unit of the first column is a unit of time. The values are converted to `unit`; their own
/// unit must be of the same kind.
base::Result<ReferenceRows> reference_rows(const std::string& name, const std::string& text,
                                           const std::optional<std::string>& column, const std::string& unit);

struct ShapeRows {
  std::vector<double> angles_deg, values;
};

/// Reads exactly two columns, like a reference. A mistake in a line is reported with the line's number;
/// design::sheet_constants() checks the shape.
base::Result<ShapeRows> shape_rows(const std::string& name, const std::string& text);

}  // namespace text
