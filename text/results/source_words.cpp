// SPDX-License-Identifier: Apache-2.0
#include "text/results/source_words.hpp"

#include <fmt/format.h>

namespace text {

std::string source_words(const study::Supply& s, std::string (*given)(double, std::string_view)) {
  switch (s.source) {
    case study::SourceKind::battery:
      return fmt::format("battery of {}, {} full", given(s.battery_capacity_Ah, "Ah"),
                         given(100 * s.battery_charge, "%"));
    case study::SourceKind::single_phase:
    case study::SourceKind::three_phase:
      return fmt::format("rectified mains{}, {} at {}",
                         s.source == study::SourceKind::three_phase ? " of three phases" : "",
                         given(s.mains_rms_V, "V"), given(s.mains_Hz, "Hz"));
    case study::SourceKind::steady:
      break;
  }
  return given(s.voltage_V, "V");
}

}  // namespace text
