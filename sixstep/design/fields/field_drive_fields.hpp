// SPDX-License-Identifier: Apache-2.0
// Lists every field of the field-oriented drive's configuration (control/field/) around its drive once. Each
// list binds all members of its struct: the list does not compile if a member is missing. A Ratio cannot
// express the base of a gain on a product of speed and current; this list is therefore for floating point
// only.
#pragma once
#include <string>

#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/design/fields/drive_fields.hpp"

namespace sixstep::design {

template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldCurrentConfig<double>& c, Kept& kept) {
  auto& [d, q, limit, decouples, d_V_s_A, q_V_s_A, magnet_V_s, R_ohm] = kept;
  const PiUse use{{Base::voltage, Base::current}, "V per A", "V"};
  w.part("d", c.d, d, use);
  w.part("q", c.q, q, use);
  w.choice({.name = "limit", .always = true}, c.limit, limit, control::VoltageLimit::circle);
  w.flag({"decouples"}, c.decouples, decouples);
  w.gain({"d_V_s_A", "V per A and rad/s", "p L_d"}, c.d_V_s_A, d_V_s_A, {Base::voltage, Base::current});
  w.gain({"q_V_s_A", "V per A and rad/s", "p L_q"}, c.q_V_s_A, q_V_s_A, {Base::voltage, Base::current});
  w.gain({"magnet_V_s", "V per rad/s", "p psi"}, c.magnet_V_s, magnet_V_s, {Base::voltage, Base::speed});
  w.gain({"R_ohm", "V per A", "of a phase"}, c.R_ohm, R_ohm, {Base::voltage, Base::current});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldWeakeningConfig<double>& c, Kept& kept) {
  auto& [K_A_per_V, part, most_A] = kept;
  w.gain({"K_A_per_V", "A per V", "per sample"}, c.K_A_per_V, K_A_per_V, {Base::current, Base::voltage});
  w.gain({"part", "", "of the circle"}, c.part, part, {Base::one, Base::one});
  w.signal({"most_A", "A"}, c.most_A, most_A, Base::current);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::TorquePerAmpereConfig<double>& c, Kept& kept) {
  auto& [k_per_A] = kept;
  w.gain({"k_per_A", "1/A"}, c.k_per_A, k_per_A, {Base::one, Base::current});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldAdvanceConfig<double>& c, Kept& kept) {
  auto& [rad_s] = kept;
  w.gain({"rad_s", "rad per rad/s"}, c.rad_s, rad_s, {Base::one, Base::speed});
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::Dq<double>& c, Kept& kept) {
  auto& [d, q] = kept;
  w.signal({"d"}, c.d, d, Base::one);
  w.signal({"q"}, c.q, q, Base::one);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::HarmonicCurrentConfig<double>& c, Kept& kept) {
  auto& [on, lead_rad_s, half_turn_s, slope_V_A, R_ohm, least, shape] = kept;
  w.flag({"on"}, c.on, on);
  w.gain({"lead_rad_s", "rad per rad/s"}, c.lead_rad_s, lead_rad_s, {Base::one, Base::speed});
  w.gain({"half_turn_s", "rad per rad/s", "in half a period"}, c.half_turn_s, half_turn_s,
         {Base::one, Base::speed});
  w.gain({"slope_V_A", "V per A", "L/T"}, c.slope_V_A, slope_V_A, {Base::voltage, Base::current});
  w.gain({"R_ohm", "ohm"}, c.R_ohm, R_ohm, {Base::voltage, Base::current});
  w.signal({"least", "", "of the shape's length"}, c.least, least, Base::one);
  for (std::size_t n = 0; n < control::shape_points; ++n)
    w.part(("shape[" + std::to_string(n) + "]").c_str(), c.shape[n], shape[n]);
}

template <class Walk, class Kept>
void fields(Walk&& w, const control::FiniteSetConfig<double>& c, Kept& kept) {
  auto& [on, foretells, d_decay, q_decay, d_A_per_V, q_A_per_V, half_turn_s, salient_V_s_A, switching_A,
         most_A] = kept;
  w.flag({"on"}, c.on, on);
  w.flag({"foretells"}, c.foretells, foretells);
  w.gain({"d_decay", "", "exp(-R T/L_d)"}, c.d_decay, d_decay, {Base::one, Base::one});
  w.gain({"q_decay", "", "exp(-R T/L_q)"}, c.q_decay, q_decay, {Base::one, Base::one});
  w.gain({"d_A_per_V", "A per V", "in a period"}, c.d_A_per_V, d_A_per_V, {Base::current, Base::voltage});
  w.gain({"q_A_per_V", "A per V", "in a period"}, c.q_A_per_V, q_A_per_V, {Base::current, Base::voltage});
  w.gain({"half_turn_s", "rad per rad/s", "in half a period"}, c.half_turn_s, half_turn_s,
         {Base::one, Base::speed});
  w.gain({"salient_V_s_A", "V per A and rad/s", "p (L_d - L_q)"}, c.salient_V_s_A, salient_V_s_A,
         {Base::voltage, Base::current});
  w.signal({"switching_A", "A"}, c.switching_A, switching_A, Base::current);
  w.signal({"most_A", "A"}, c.most_A, most_A, Base::current);
}

/// Lists all fields except `drive`, which has its own list.
template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldDriveConfig<double>& c, Kept& kept) {
  auto& [drive, current, weakening, per_ampere, advance, harmonic, finite_set] = kept;
  w.part("current", c.current, current);
  w.part("weakening", c.weakening, weakening);
  w.part("per_ampere", c.per_ampere, per_ampere);
  w.part("advance", c.advance, advance);
  w.part("harmonic", c.harmonic, harmonic);
  w.part("finite_set", c.finite_set, finite_set);
}

}  // namespace sixstep::design
