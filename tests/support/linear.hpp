// SPDX-License-Identifier: Apache-2.0
// Converts a rotary motor to its linear version. Lists the terms that no text about a linear motor may
// contain.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::testing {

/// The radius r is a power of two, so that v = r w, F = T/r and m = J/r^2 cause no rounding (speed v, force
/// F, mass m).
inline constexpr double unrolled_at_m = 0x1p-6;

/// The linear version of a sheet. At the radius r, rotation at the speed w corresponds to motion at v = r w.
inline design::Sheet unrolled(design::Sheet s, double r = unrolled_at_m) {
  const auto times = [](std::optional<base::Quantity>& q, double factor) {
    if (q) q->value *= factor;
  };
  s.kind = design::MotorKind::linear;
  s.pole_pitch_mm = base::Quantity{1e3 * (base::pi / *s.pole_pairs) * r, "", ""};
  s.pole_pairs.reset();
  times(s.torque_constant_mNm_A, 1 / r);
  times(s.inertia_gcm2, 1 / (r * r));
  times(s.viscous_friction_Nm_s, 1 / (r * r));
  times(s.coulomb_friction_mNm, 1 / r);
  times(s.nominal_torque_mNm, 1 / r);
  times(s.stall_torque_mNm, 1 / r);
  times(s.nominal_speed_rpm, r);
  times(s.no_load_speed_rpm, r);
  return s;
}

/// Terms of a rotary motor in a text. The list must be empty for a text about a linear motor. Units count
/// only as whole words.
inline std::vector<std::string> turning_words(const std::string& text) {
  std::vector<std::string> found;
  for (const char* word :
       {"torque", "Torque", "inertia", "Inertia", "rpm", "rad/s", "shaft", "Shaft", "K_t", "g cm2", "mNm"})
    if (text.find(word) != text.npos) found.emplace_back(word);
  for (const std::string_view unit : {"Nm", "N m", "kg m2", "kg_m2"})
    for (std::size_t at = text.find(unit); at != text.npos; at = text.find(unit, at + 1)) {
      const std::size_t end = at + unit.size();
      const bool within = (at > 0 && base::linear_text::letter(text[at - 1])) ||
                          (end < text.size() && base::linear_text::letter(text[end]));
      if (!within) found.emplace_back(unit);
    }
  return found;
}

}  // namespace sixstep::testing
