// SPDX-License-Identifier: Apache-2.0
// Writes lines of a motor file for values of another program.
#pragma once
#include <string>
#include <string_view>

#include "text/keys/key_catalog.hpp"
#include "text/motor/foreign_keys.hpp"
#include "text/rooms.hpp"

namespace text {

/// Ten digits, so that 2.23e-05 H becomes 22.3 uH and not 22.299999999999997.
std::string ten_digits(double x);

/// The entry of a motor file's key in its own spelling.
KeyEntry foreign_entry(std::string_view key);

/// "resistance_ohm = { value = 0.0187, frame = "phase", source = .. }"; `source` as a string of TOML.
std::string foreign_line(std::string_view key, double x, std::string_view frame, const std::string& source);

/// The line of a value that the file lacks: nan, or 0 for a count, both of which a motor file refuses.
std::string missing_line(std::string_view key, const std::string& file);

/// The answers to the row's question and what each would mean: "answer resistance=phase (R_s = 10.5 ohm) or
/// resistance=terminal (R_s = 5.25 ohm)".
std::string answers_to(const ForeignKey& row, double x);

}  // namespace text
