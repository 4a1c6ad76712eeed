// SPDX-License-Identifier: Apache-2.0
// Text on its way into a page: what makes it harmless there, and how a page's gaps are filled.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace report {

/// For element content and quoted attributes.
std::string escaped(std::string_view text);

/// The same, with "T_reg" set as T and a subscript: a letter, an underscore and what follows up to the next
/// sign.
std::string with_subscripts(std::string_view text);

/// A formula as typed, "w0 sqrt(1 - xi^2)", as printed: ω₀ √(1 − ξ²). Words are left alone.
std::string typeset(std::string_view formula);

/// JSON on its way into <script>: "</script>" and "<!--" must not be seen by the HTML parser.
std::string script_safe(std::string_view json);

std::string base64(std::span<const std::uint8_t> bytes);
/// Little-endian, whatever this machine's order is.
std::string base64(std::span<const float> values);
std::string base64(std::span<const double> values);

/// A table's cell with a number in it.
std::string number_cell(const std::string& html);
/// Its first row; a name that begins with # stands over numbers.
std::string table_head(std::initializer_list<std::string_view> names);

using Gap = std::pair<std::string_view, std::string_view>;

/// Replaces each {{name}} of the page once; what is filled in is never searched again, so no content can
/// break it.
std::string filled(std::string_view page, std::initializer_list<Gap> gaps);

}  // namespace report
