// SPDX-License-Identifier: Apache-2.0
// Reads numbers off a sheet and notes whatever is wrong with them. Shared by the sources of sheet_constants.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

/// Four digits say what a message needs.
inline std::string rounded(double x, int digits = 4) { return base::rounded(x, digits); }

struct SheetReader {
  const Sheet& sheet;
  SheetConstants& out;

  void problem(std::string_view where, std::string value, std::string limit, std::string cure) {
    out.problems.push_back({std::string(where), std::move(value), std::move(limit), std::move(cure)});
  }
  /// Of a quantity: key and value as the file writes them.
  void wrong(std::string_view key, const base::Quantity& q, std::string limit, std::string cure) {
    problem(key_of(key, q), value_of(key, q), std::move(limit), std::move(cure));
  }
  void missing(std::string_view where, std::string_view cure) {
    out.missing.push_back({std::string(where), "", "is missing", std::string(cure)});
  }
  /// Of a key that lives as long as the program.
  void use(std::string_view key) { out.used.push_back(key); }

  /// The key as the file writes it.
  static std::string key_of(std::string_view key, const base::Quantity& q) {
    return q.key.empty() ? std::string(key) : q.key;
  }
  /// The value in the unit of that key: 4.8e-06 beside inertia_kgm2, of a sheet whose own key would have 48.
  std::string value_of(std::string_view key, const base::Quantity& q) const;
  /// The value times 10^ten; nothing where it is out of its range, which note_implausible() has told.
  static std::optional<double> positive(const base::Quantity& q, int ten = 0) {
    return base::above(0.0).holds(q.value) ? std::optional(base::times_ten_to(q.value, ten)) : std::nullopt;
  }
  static std::optional<double> not_negative(const base::Quantity& q, int ten = 0) {
    return base::from(0.0).holds(q.value) ? std::optional(base::times_ten_to(q.value, ten)) : std::nullopt;
  }
};

/// Every number of the sheet that is out of its key's range, or of what its unit can be.
void note_implausible(SheetReader& reader);

/// What a frame would make of a value, in words: for the message about a missing one.
struct FrameMeaning {
  std::string_view frame;
  std::string means;
};

/// The Problem of a frame that is missing or unknown, with what each candidate would mean.
void unknown_frame(SheetReader& reader, std::string_view key, const base::Quantity& q,
                   std::span<const FrameMeaning> candidates, const std::string& hint = "");

/// The factors of back_emf = "table"; nothing where the lists make none, which is noted.
std::optional<ShapeFactors> read_shape_table(SheetReader& reader);

/// tau of a linear motor, m; of a turning one its pole pairs. What is of the other kind is noted.
std::optional<double> read_pole_pitch(SheetReader& reader);
std::optional<int> read_pole_pairs(SheetReader& reader);
void read_inertia(SheetReader& reader);
void read_torque_constant(SheetReader& reader);
void read_friction(SheetReader& reader);
void read_details(SheetReader& reader);

}  // namespace sixstep::design
