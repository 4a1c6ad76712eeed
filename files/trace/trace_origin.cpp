// SPDX-License-Identifier: Apache-2.0
#include "files/trace/trace_origin.hpp"

#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"

namespace files {

std::vector<std::string> origin_lines(const TraceOrigin& o) {
  std::vector<std::string> lines = {
      "sixstep " SIXSTEP_VERSION,
      fmt::format("scenario: {}, digest {}", o.scenario, base::written_hex(o.digest)),
      fmt::format("command: {}", o.command)};
  for (std::string& line : lines) line = text::visible(line);
  return lines;
}

}  // namespace files
