// SPDX-License-Identifier: Apache-2.0
// Names that cause harm if they are not escaped. Every test of code that shows or writes a name uses them.
// The tests of the program read the same file.
#pragma once
#include <fstream>
#include <string>
#include <vector>

namespace sixstep::testing {

/// One name per line. \xHH is a byte;
/// , \r, \t and \\ have their usual meaning.
inline std::vector<std::string> hostile_names() {
  std::ifstream file(SIXSTEP_SOURCE_DIR "/tests/support/hostile_names.txt", std::ios::binary);
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::string name;
    for (std::size_t n = 0; n < line.size(); ++n) {
      if (line[n] != '\\') {
        name += line[n];
        continue;
      }
      switch (line.at(++n)) {
        case 'x':
          name += static_cast<char>(std::stoi(line.substr(n + 1, 2), nullptr, 16));
          n += 2;
          break;
        case 'n':
          name += '\n';
          break;
        case 'r':
          name += '\r';
          break;
        case 't':
          name += '\t';
          break;
        default:
          name += line[n];
      }
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace sixstep::testing
