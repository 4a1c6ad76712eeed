// SPDX-License-Identifier: Apache-2.0
// Describes the origin of a trace in the first lines of every trace file.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/rooms.hpp"

namespace files {

struct TraceOrigin {
  std::string scenario;      ///< name of the scenario's file
  std::uint64_t digest = 0;  ///< digest of all files read and of the settings of the command line
  std::string title, motor;
  std::string command;  ///< command that writes the trace again
  std::string text;     ///< text of the scenario's file as it was read
};

/// Three lines: program and version, scenario with digest, command. No line contains a line break.
std::vector<std::string> origin_lines(const TraceOrigin& origin);

}  // namespace files
