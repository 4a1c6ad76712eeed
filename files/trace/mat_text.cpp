// SPDX-License-Identifier: Apache-2.0
#include "files/trace/mat_text.hpp"

#include "text/escape/escape.hpp"

namespace files {

std::vector<std::uint16_t> mat_units(const std::string& text) {
  constexpr char32_t replacement = 0xFFFD;
  std::vector<std::uint16_t> units;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = text::next_character(text, at);
    units.push_back(static_cast<std::uint16_t>(c < 0x10000 ? c : replacement));
  }
  return units;
}

std::string mat_header(const char* version, std::uint16_t number) {
  std::string text = std::string("MATLAB ") + version + " MAT-file, sixstep " SIXSTEP_VERSION;
  text.resize(116, ' ');
  text.resize(124, '\0');  // no subsystem data
  put_bytes(text, number, std::uint16_t{'M' << 8 | 'I'});
  return text;
}

}  // namespace files
