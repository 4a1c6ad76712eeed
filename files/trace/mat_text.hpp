// SPDX-License-Identifier: Apache-2.0
// What the writers of both MAT versions share.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "text/escape/escape.hpp"

namespace files {

/// A struct whose fields are texts, in their order.
using MatFields = std::vector<std::pair<std::string, std::string>>;

/// MATLAB counts 16-bit units, others count characters: where these differ, beyond U+FFFF, no reader is sure of the sizes, and the
/// replacement stands.
inline std::vector<std::uint16_t> mat_units(const std::string& text) {
  constexpr char32_t replacement = 0xFFFD;
  std::vector<std::uint16_t> units;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = text::next_character(text, at);
    units.push_back(static_cast<std::uint16_t>(c < 0x10000 ? c : replacement));
  }
  return units;
}

/// Bytes of a number, in this machine's order, as both versions may have them.
template <class... Number>
void put_bytes(std::string& into, Number... numbers) {
  (into.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
}

inline void pad_to_eight(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

/// The first 128 bytes of a file: words for people, then version and order of bytes.
inline std::string mat_header(const char* version, std::uint16_t number) {
  std::string text = std::string("MATLAB ") + version + " MAT-file, sixstep " SIXSTEP_VERSION;
  text.resize(116, ' ');
  text.resize(124, '\0');  // no data of a subsystem
  put_bytes(text, number, std::uint16_t{'M' << 8 | 'I'});
  return text;
}

}  // namespace files
