// SPDX-License-Identifier: Apache-2.0
// Every field of the field-oriented drive's configuration (control/field/) around its drive, once. Each list binds all
// members of its struct: a new member stops the compiler here. A gain on a product of speed and current has a base that
// Ratio does not say: there is no fixed point of it yet, and a walk over this list is one of floating point.
#pragma once
#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/design/fields/drive_fields.hpp"

namespace sixstep::design {

template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldCurrentConfig<double>& c, Kept& kept) {
  auto& [d, q, limit, decouples, d_V_s_A, q_V_s_A, magnet_V_s] = kept;
  const PiUse use{{Base::voltage, Base::current}, "V per A", "V"};
  w.part("d", c.d, d, use);
  w.part("q", c.q, q, use);
  w.choice({.name = "limit", .always = true}, c.limit, limit, control::VoltageLimit::circle);
  w.flag({"decouples"}, c.decouples, decouples);
  w.gain({"d_V_s_A", "V per A and rad/s", "p L_d"}, c.d_V_s_A, d_V_s_A, {Base::voltage, Base::current});
  w.gain({"q_V_s_A", "V per A and rad/s", "p L_q"}, c.q_V_s_A, q_V_s_A, {Base::voltage, Base::current});
  w.gain({"magnet_V_s", "V per rad/s", "p psi"}, c.magnet_V_s, magnet_V_s, {Base::voltage, Base::speed});
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

/// All but the drive, which has fields of its own.
template <class Walk, class Kept>
void fields(Walk&& w, const control::FieldDriveConfig<double>& c, Kept& kept) {
  auto& [drive, current, weakening, per_ampere, advance] = kept;
  w.part("current", c.current, current);
  w.part("weakening", c.weakening, weakening);
  w.part("per_ampere", c.per_ampere, per_ampere);
  w.part("advance", c.advance, advance);
}

}  // namespace sixstep::design
