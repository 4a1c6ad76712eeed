// SPDX-License-Identifier: Apache-2.0
// Contains the functions that the writers of both MAT versions use.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace files {

/// A struct whose fields are texts, in their order.
using MatFields = std::vector<std::pair<std::string, std::string>>;

/// Text as units of 16 bits. MATLAB counts units, other readers count characters. A character beyond U+FFFF
/// has two units; it is replaced by the replacement character, so that both counts are equal.
std::vector<std::uint16_t> mat_units(const std::string& text);

/// Appends the bytes of numbers in this machine's byte order, which both versions allow.
template <class... Number>
void put_bytes(std::string& into, Number... numbers) {
  (into.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
}

inline void pad_to_eight(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

/// The first 128 bytes of a file: a readable text, then version and byte order.
std::string mat_header(const char* version, std::uint16_t number);

}  // namespace files
