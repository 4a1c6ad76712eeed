// SPDX-License-Identifier: Apache-2.0
// Numbers as text, for messages.
#pragma once
#include <charconv>
#include <string>

namespace sixstep::base {

/// The shortest decimal that reads back as the same double, whatever the locale.
inline std::string written(double x) {
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, x);
  return {text, end.ptr};
}

}  // namespace sixstep::base
