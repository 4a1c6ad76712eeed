// SPDX-License-Identifier: Apache-2.0
// Reads the parameter files of other programs as words with their texts. Each syntax is nearly flat, so that
// a reader of a few lines suffices. A library for XML or JSON would enlarge the program by a tenth of a
// megabyte.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct ForeignWord {
  std::string name;      ///< the other program's key, without the part that it belongs to: "phase_resistance"
  std::string part;      ///< axis of an ODrive, variable of a sketch or of a script; else empty
  std::string value;     ///< text of the value
  std::size_t line = 1;  ///< line in the file
};
using ForeignWords = std::vector<ForeignWord>;

/// The elements `<key>value</key>` without elements inside. Problem: the file ends before its root does.
base::Result<ForeignWords> words_of_xml(std::string_view text);

/// The numbers of a JSON object of objects. The key "axis0.motor.config.pole_pairs" has the part "axis0",
/// whether the objects are nested or the key contains the points. Problem: the file ends too early or is no
/// JSON.
base::Result<ForeignWords> words_of_json(std::string_view text);

/// Lines "key value", also "conf set key value".
ForeignWords words_of_lines(std::string_view text);

/// Assignments "struct.field = value;" of MATLAB; comments begin with %.
ForeignWords words_of_matlab(std::string_view text);

/// The arguments of each BLDCMotor of a sketch, named pp, R, KV, Lq, Ld as its constructor names them.
/// Problem: a bracket that does not close.
base::Result<ForeignWords> words_of_sketch(std::string_view text);

/// The value of a text of numbers, pi and sqrt(number) that are multiplied or divided. A number may end in
/// C's suffix f. Empty for any other formula.
std::optional<double> foreign_number(std::string_view text);

}  // namespace text
