// SPDX-License-Identifier: Apache-2.0
// What the writers of both MAT versions share.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace files {

/// A struct whose fields are texts, in their order.
using MatFields = std::vector<std::pair<std::string, std::string>>;

/// MATLAB counts 16-bit units, others count characters: where these differ, beyond U+FFFF, no reader is sure of the sizes, and the
/// replacement stands.
std::vector<std::uint16_t> mat_units(const std::string& text);

/// Bytes of a number, in this machine's order, as both versions may have them.
template <class... Number>
void put_bytes(std::string& into, Number... numbers) {
  (into.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
}

inline void pad_to_eight(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

/// The first 128 bytes of a file: words for people, then version and order of bytes.
std::string mat_header(const char* version, std::uint16_t number);

}  // namespace files
