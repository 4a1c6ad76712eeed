// SPDX-License-Identifier: Apache-2.0
#include "io/trace/trace_origin.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sixstep/base/written.hpp"

namespace io {

std::vector<std::string> origin_lines(const TraceOrigin& o) {
  std::vector<std::string> lines = {
      "sixstep " SIXSTEP_VERSION,
      fmt::format("scenario: {}, digest {}", o.scenario, base::written_hex(o.digest)),
      fmt::format("command: {}", o.command)};
  // A name may hold anything; what ends a line would end the comment.
  for (std::string& line : lines)
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  return lines;
}

}  // namespace io
