// SPDX-License-Identifier: Apache-2.0
// Escapes text for a page and fills in a page's placeholders.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace report {

/// Escapes text for element content and quoted attributes.
std::string escaped(std::string_view text);

/// escaped(), with subscripts: "T_reg" is printed as T with the subscript reg. A symbol has at most three
/// letters before its only underscore.
std::string with_subscripts(std::string_view text);

/// A formula as printed: "w0 sqrt(1 - xi^2)" becomes ω₀ √(1 − ξ²). Words are unchanged.
std::string typeset(std::string_view formula);

/// JSON for <script>: without "</script>" and "<!--", which would end or change the script for the HTML
/// parser.
std::string script_safe(std::string_view json);

std::string base64(std::span<const std::uint8_t> bytes);
/// The values' bytes as base64, little-endian on every machine.
std::string base64(std::span<const float> values);
std::string base64(std::span<const double> values);

/// A table cell with a number.
std::string number_cell(const std::string& html);
/// The first row of a table. A name that begins with # is the heading of a column of numbers.
std::string table_head(std::initializer_list<std::string_view> names);

using Gap = std::pair<std::string_view, std::string_view>;

/// Replaces each {{name}} of the page once. The inserted text is not searched again, so that no content can
/// change the page's structure.
std::string filled(std::string_view page, std::initializer_list<Gap> gaps);

}  // namespace report
