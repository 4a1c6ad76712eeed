// SPDX-License-Identifier: Apache-2.0
// Reads the rotor's moment of inertia, as printed or from its dimensions, J = pi/2 rho l (r^4 - r_i^4) for a
// cylinder or a ring.
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

/// The printed inertia, with or without the brake; empty if it is missing or wrong.
std::optional<Constant> printed_inertia(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const std::optional<Quantity>&rotor = s.inertia_gcm2, &braked = s.inertia_with_brake_gcm2;
  std::optional<double> J, J_b;
  if (rotor) J = SheetReader::positive(*rotor, -7);
  if (braked) J_b = SheetReader::positive(*braked, -7);
  if (J && J_b && *J_b < *J)
    reader.wrong("inertia_with_brake_gcm2", *braked,
                 "is less than the rotor's inertia, " + SheetReader::key_of("inertia_gcm2", *rotor) + " = " +
                     reader.value_of("inertia_gcm2", *rotor),
                 "swap the two values: a brake adds inertia");
  if (s.with_brake ? !J_b : !J) return {};
  const std::string_view key = s.with_brake ? "inertia_with_brake_gcm2" : "inertia_gcm2";
  const Quantity& printed = s.with_brake ? *braked : *rotor;
  reader.use(key);
  return Constant{base::times_ten_to(printed.value, -7), SheetReader::key_of(key, printed)};
}

/// True if dimensions are given and describe a body. Errors in them are reported.
bool has_body(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const auto needs = [&](const char* key, const char* other) {
    reader.problem(key, "", std::string("needs ") + other + " beside it",
                   "give all values of J = pi/2 rho l (r^4 - r_i^4), or only inertia_gcm2");
    return false;
  };
  if (!s.rotor_radius_mm && !s.rotor_length_mm) {
    const char* key = s.rotor_inner_radius_mm ? "rotor_inner_radius_mm"
                      : s.rotor_density_kg_m3 ? "rotor_density_kg_m3"
                                              : nullptr;
    return key ? needs(key, "rotor_radius_mm and rotor_length_mm") : false;
  }
  if (!s.rotor_radius_mm) return needs("rotor_length_mm", "rotor_radius_mm");
  if (!s.rotor_length_mm) return needs("rotor_radius_mm", "rotor_length_mm");
  if (s.rotor == RotorPlace::outer && !s.rotor_inner_radius_mm)
    return needs("rotor_radius_mm", "rotor_inner_radius_mm (because rotor = \"outer\")");
  if (s.rotor_inner_radius_mm && !(s.rotor_inner_radius_mm->value < s.rotor_radius_mm->value)) {
    reader.wrong("rotor_inner_radius_mm", *s.rotor_inner_radius_mm,
                 "must be below " + SheetReader::key_of("rotor_radius_mm", *s.rotor_radius_mm) + " = " +
                     reader.value_of("rotor_radius_mm", *s.rotor_radius_mm),
                 "swap the two");
    return false;
  }
  return true;
}

std::optional<double> metres(const std::optional<Quantity>& q) {
  return q ? SheetReader::positive(*q, -3) : std::nullopt;
}

void read_body(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (!has_body(reader)) return;
  const std::optional<double> r = metres(s.rotor_radius_mm), l = metres(s.rotor_length_mm);
  const std::optional<double> rho =
      s.rotor_density_kg_m3 ? SheetReader::positive(*s.rotor_density_kg_m3) : std::optional(steel_kg_m3);
  const double r_i = metres(s.rotor_inner_radius_mm).value_or(0.0);
  if (!r || !l || !rho) return;
  const double fourth = *r * *r * *r * *r - r_i * r_i * r_i * r_i;
  const char* from = r_i > 0.0 ? "rotor_radius_mm, J = pi/2 rho l (r^4 - r_i^4) of the ring"
                               : "rotor_radius_mm, J = pi/2 rho l r^4 of the cylinder";
  reader.out.J_of_body_kg_m2 = Constant{base::pi / 2.0 * *rho * *l * fourth, from};
}

}  // namespace

void read_inertia(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const std::size_t told = reader.out.problems.size();
  reader.out.J_kg_m2 = printed_inertia(reader);
  read_body(reader);
  const bool printed = s.with_brake ? s.inertia_with_brake_gcm2.has_value() : s.inertia_gcm2.has_value();
  if (printed || reader.out.problems.size() > told) return;  // errors of the inertia are reported already
  if (reader.out.J_of_body_kg_m2 && !s.with_brake) {
    reader.out.J_kg_m2 = reader.out.J_of_body_kg_m2;
    return reader.use("rotor_radius_mm");
  }
  const bool brake_only = !s.with_brake && s.inertia_with_brake_gcm2;
  reader.missing(s.with_brake ? "inertia_with_brake_gcm2" : "inertia_gcm2",
                 brake_only ? "write with_brake = true: the sheet gives the inertia with brake only"
                            : "give the rotor's moment of inertia");
}

}  // namespace sixstep::design
