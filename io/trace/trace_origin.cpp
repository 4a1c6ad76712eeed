// SPDX-License-Identifier: Apache-2.0
#include "io/trace/trace_origin.hpp"

#include <fmt/format.h>

#include "io/escape/escape.hpp"
#include "sixstep/base/written.hpp"

namespace io {

std::vector<std::string> origin_lines(const TraceOrigin& o) {
  std::vector<std::string> lines = {
      "sixstep " SIXSTEP_VERSION,
      fmt::format("scenario: {}, digest {}", o.scenario, base::written_hex(o.digest)),
      fmt::format("command: {}", o.command)};
  for (std::string& line : lines) line = visible(line);
  return lines;
}

}  // namespace io
