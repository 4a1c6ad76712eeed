// SPDX-License-Identifier: Apache-2.0
// write_extras double|q31 FILE: writes the lines that the exporter prints for a drive with every extra
// function.
#include <fstream>
#include <string>

#include "tests/export/extras_drive.hpp"
#include "text/export/config_text.hpp"

int main(int count, char** words) {
  if (count != 3) return 2;
  using sixstep::control::Q31;
  std::ofstream out(words[2]);
  if (std::string(words[1]) == "double") {
    out << text::config_lines<double>(sixstep::control::Mode::speed, extras::drive(), extras::drive(), {});
  } else {
    const auto scaled = sixstep::design::scaled<Q31>(extras::drive(), extras::range);
    if (!scaled) return 1;
    out << text::config_lines<Q31>(sixstep::control::Mode::speed, extras::drive(), scaled->config,
                                   scaled->bases);
  }
  return out.flush() ? 0 : 1;
}
