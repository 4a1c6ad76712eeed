// SPDX-License-Identifier: Apache-2.0
// Reads numbers of a sheet and collects their problems. All sources of sheet_constants() use this reader.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

/// x with four digits, for messages.
inline std::string rounded(double x, int digits = 4) { return base::rounded(x, digits); }

struct SheetReader {
  const Sheet& sheet;
  SheetConstants& out;

  void problem(std::string_view where, std::string value, std::string limit, std::string cure) {
    out.problems.push_back({std::string(where), std::move(value), std::move(limit), std::move(cure)});
  }
  /// Adds a problem of a quantity; key and value are written as in the file.
  void wrong(std::string_view key, const base::Quantity& q, std::string limit, std::string cure) {
    problem(key_of(key, q), value_of(key, q), std::move(limit), std::move(cure));
  }
  void missing(std::string_view where, std::string_view cure) {
    out.missing.push_back({std::string(where), "", "is missing", std::string(cure)});
  }
  /// Records that the model uses a key. `key` must live as long as the program.
  void use(std::string_view key) { out.used.push_back(key); }

  /// The key as written in the file.
  static std::string key_of(std::string_view key, const base::Quantity& q) {
    return q.key.empty() ? std::string(key) : q.key;
  }
  /// The value in the unit of the file's key: 4.8e-06 for inertia_kgm2, where the standard key would contain
  /// 48.
  std::string value_of(std::string_view key, const base::Quantity& q) const;
  /// The value times 10^ten. Empty if the value is out of its range, which note_implausible() reports.
  static std::optional<double> positive(const base::Quantity& q, int ten = 0) {
    return base::above(0.0).holds(q.value) ? std::optional(base::times_ten_to(q.value, ten)) : std::nullopt;
  }
  static std::optional<double> not_negative(const base::Quantity& q, int ten = 0) {
    return base::from(0.0).holds(q.value) ? std::optional(base::times_ten_to(q.value, ten)) : std::nullopt;
  }
};

/// Reports every number of the sheet that is out of its key's range, or implausible for its unit.
void note_implausible(SheetReader& reader);

/// Meaning of a value in one frame, as text, for the message about a missing frame.
struct FrameMeaning {
  std::string_view frame;
  std::string means;
};

/// Reports a missing or unknown frame, with the meaning of each candidate.
void unknown_frame(SheetReader& reader, std::string_view key, const base::Quantity& q,
                   std::span<const FrameMeaning> candidates, const std::string& hint = "");

/// The factors of back_emf = "table". Empty if the lists are invalid, which is reported.
std::optional<ShapeFactors> read_shape_table(SheetReader& reader);

/// The pole pitch tau of a linear motor, m; read_pole_pairs() is for a rotary motor. Keys of the other kind
/// of motor are reported.
std::optional<double> read_pole_pitch(SheetReader& reader);
std::optional<int> read_pole_pairs(SheetReader& reader);
void read_inertia(SheetReader& reader);
void read_torque_constant(SheetReader& reader);
void read_friction(SheetReader& reader);
void read_details(SheetReader& reader);

}  // namespace sixstep::design
