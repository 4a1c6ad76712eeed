// SPDX-License-Identifier: Apache-2.0
// The table of other programs' motor constants. docs/howto/take-over-parameters.md has a public source for
// each frame.
#pragma once
#include <array>
#include <span>
#include <string_view>

#include "text/rooms.hpp"
#include "text/toml/foreign_file.hpp"

namespace text {

struct ForeignKey {
  std::string_view word;  ///< the other program's key
  std::string_view key;   ///< the key of a motor file
  double factor = 1.0;    ///< the other program's value times this factor is the motor file's value
  std::string_view frame{};
  std::string_view question{};  ///< name of the question to the user if the program does not define the frame
  std::string_view other{};     ///< the other possible frame
  std::string_view why{};       ///< the reason why the frame is not certain
};

/// Keys of the inductances along and across the magnets, in henry. Some programs give a mean and a difference.
struct ForeignAxes {
  std::string_view d, q, mean, difference;
};

struct ForeignTool {
  ForeignKind kind;
  std::string_view name;  ///< the program's name in sources: "VESC Tool"
  ForeignAxes axes;
  std::span<const ForeignKey> keys;
};

const ForeignTool& foreign_tool(ForeignKind kind);

}  // namespace text
