// SPDX-License-Identifier: Apache-2.0
#include "files/trace/mat5.hpp"

#include <algorithm>

namespace files {
namespace {

// Data types of table 1-1, such as miMATRIX. An element is a tag with type and length, then the bytes, padded
// to a multiple of eight.
enum : std::uint32_t {
  mi_int8 = 1,
  mi_int32 = 5,
  mi_uint32 = 6,
  mi_double = 9,
  mi_matrix = 14,
  mi_utf16 = 17
};
enum : std::uint32_t { class_struct = 2, class_char = 4, class_double = 6 };
/// Bytes of a field name with its final zero: MATLAB's usual length, and the length for longer names.
constexpr std::size_t usual_field = 32, long_field = 64;

std::uint32_t n32(std::size_t n) { return static_cast<std::uint32_t>(n); }

std::string element(std::uint32_t type, std::string_view bytes) {
  std::string out;
  put_bytes(out, type, n32(bytes.size()));
  out += bytes;
  pad_to_eight(out);
  return out;
}

/// The beginning of an array: flags, size and name.
std::string array_head(std::uint32_t kind, const std::string& name, std::size_t rows, std::size_t columns) {
  std::string flags, size;
  put_bytes(flags, kind, n32(0));
  put_bytes(size, n32(rows), n32(columns));
  return element(mi_uint32, flags) + element(mi_int32, size) + element(mi_int8, name);
}

}  // namespace

std::string mat5_begin() { return mat_header("5.0", 0x0100); }

std::string mat5_column_head(const std::string& name, std::size_t rows) {
  const std::string head = array_head(class_double, name, rows, 1);
  constexpr std::size_t tag = 8;
  std::string out;
  put_bytes(out, +mi_matrix, n32(head.size() + tag + rows * sizeof(double)));
  out += head;
  put_bytes(out, +mi_double, n32(rows * sizeof(double)));
  return out;
}

std::string mat5_numbers(const std::string& name, std::span<const double> values, std::size_t rows,
                         std::size_t columns) {
  const std::string_view bytes{reinterpret_cast<const char*>(values.data()), values.size_bytes()};
  return element(mi_matrix, array_head(class_double, name, rows, columns) + element(mi_double, bytes));
}

std::string mat5_text(const std::string& name, const std::string& words) {
  const std::vector<std::uint16_t> units = mat_units(words);
  const std::string_view bytes{reinterpret_cast<const char*>(units.data()), units.size() * 2};
  return element(mi_matrix, array_head(class_char, name, units.empty() ? 0 : 1, units.size()) +
                                element(mi_utf16, bytes));
}

std::string mat5_texts(const std::string& name, const MatFields& fields) {
  const bool any_long = std::any_of(fields.begin(), fields.end(),
                                    [](const auto& field) { return field.first.size() >= usual_field; });
  const std::size_t length = any_long ? long_field : usual_field;
  std::string names, all = array_head(class_struct, name, 1, 1);
  for (const auto& field : fields) {
    const std::size_t begin = names.size();
    names += field.first.substr(0, length - 1);
    names.resize(begin + length, '\0');
  }
  constexpr std::uint32_t four_bytes_in_the_tag = 4U << 16U;
  put_bytes(all, four_bytes_in_the_tag | mi_int32, n32(length));
  all += element(mi_int8, names);
  for (const auto& field : fields) all += mat5_text("", field.second);
  return element(mi_matrix, all);
}

}  // namespace files
