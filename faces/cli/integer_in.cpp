// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/integer_in.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>

namespace cli {

CLI::Validator integer_in(std::int64_t least, std::int64_t most) {
  CLI::Validator range = CLI::Range(least, most);  // only for the text that --help shows
  range.operation([least, most](std::string& word) {
    std::int64_t value = 0;
    const char* end = word.data() + word.size();
    const std::from_chars_result read = std::from_chars(word.data(), end, value);
    const bool inside = read.ec == std::errc() && read.ptr == end && least <= value && value <= most;
    return inside ? std::string() : fmt::format("must be a whole number in {} to {}", least, most);
  });
  return range;
}

}  // namespace cli
