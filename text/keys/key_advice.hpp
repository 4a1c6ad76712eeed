// SPDX-License-Identifier: Apache-2.0
// Finds the key that the writer of an unknown key probably meant.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/describe.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/base/range_text.hpp"
#include "text/rooms.hpp"

namespace text {

using base::limit_of;

/// Least number of insertions, deletions, replacements and swaps of neighbours that turn one word into the
/// other.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest known word, if at most a third of the letters differ; else empty.
std::string nearest(std::string_view word, std::span<const std::string> known);

/// Like nearest(), but among words that may end in a unit: "u_ab" means "u_ab_V", and "energy_mJ" means
/// "energy_J".
std::string nearest_word(std::string_view word, std::span<const std::string> known);

/// A key without its unit suffix: "no_load_speed" for "no_load_speed_rad_s".
std::string_view without_unit(std::string_view key);

/// The unit suffix alone: "_rad_s" of "no_load_speed_rad_s".
std::string_view unit_suffix(std::string_view key);

/// Returns a text such as ": 1 mV = 0.001 V" for two suffixes that are different units of one kind; else
/// empty. If a unit is an rms unit, the text says that the frame states rms.
std::string conversion_text(std::string_view from_suffix, std::string_view to_suffix);

/// Limit and cure for an unknown key; `where` and `value` stay empty. The cure depends on the key:
/// - it differs from a known key only in its unit: the right unit;
/// - it is a word of a motor's sheet: the key with that meaning;
/// - it is unlike all known keys: `advice`, or without `advice` the list of known keys.
base::Problem unknown_key(std::string_view key, std::span<const std::string> known,
                          std::string_view advice = {});

/// The words as alternatives, each in quotes: "a", "b" or "c".
std::string quoted_alternatives(const std::vector<std::string>& words);

/// Shortest text that reads back as the same number.
std::string shortest(double x);

}  // namespace text
