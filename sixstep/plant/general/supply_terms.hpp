// SPDX-License-Identifier: Apache-2.0
// Terms of the supply (model.md 9): the source's open-circuit voltage, its current, the capacitor with its
// resistance, and the brake resistor. In each order the bus voltage is computed before the winding's terms,
// because a jump of the current causes a jump of the voltage at a capacitor with resistance. The supply's
// terms of the next order are computed after the winding's terms.
#pragma once
#include "sixstep/plant/general/constants.hpp"

namespace sixstep::plant::general {

template <class Real>
class SupplyTerms {
 public:
  SupplyTerms(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y, Series<Real>& z)
      : c_(c), mode_(mode), y_(y), z_(z) {
    for (unsigned k = 0; k < 3; ++k) share_[k] = c.terms(k, mode.legs[k]).bus_share;
  }

  /// Computes terms n of V_0 and U_s from terms n of charge, phase, capacitor voltage and currents.
  void begin_order(int n) {
    if (c_.inv_C == 0) return;
    z_.open[n] = open_voltage(n);
    if (c_.R_C == 0) return;
    // U_s = v_C + R_C (i_src - i_dc - U_s/R_br), with capacitor voltage v_C, source current i_src, bridge
    // current i_dc and brake resistor R_br. With L_b, i_src is a state; otherwise it is (V_0 - U_s)/R_b.
    Real share = mode_.braking ? c_.brake_conductance : Real(0), in = -drawn(n);
    if (!mode_.source_feeds) {
      if (n == 0) in -= c_.sink;
    } else if (c_.inv_L_b > 0) {
      in += z_.source[n];
    } else {
      in += c_.inv_R_b * z_.open[n];
      share += c_.inv_R_b;
    }
    y_.bus[n] = (z_.capacitor[n] + c_.R_C * in) / (1 + c_.R_C * share);
  }

  /// Computes terms n + 1 of the supply's states from terms n; f = h/(n + 1), with the segment's length h.
  void end_order(int n, Real f) {
    if (c_.inv_C == 0) {
      y_.bus[n + 1] = 0;
      return;
    }
    const Real at_limit = n == 0 ? -c_.sink : Real(0);
    if (c_.inv_L_b > 0)
      z_.source[n + 1] =
          mode_.source_feeds ? f * c_.inv_L_b * (z_.open[n] - y_.bus[n] - c_.R_b * z_.source[n]) : Real(0);
    else
      z_.source[n] = mode_.source_feeds ? c_.inv_R_b * (z_.open[n] - y_.bus[n]) : at_limit;
    Real into = z_.source[n] - drawn(n);
    if (mode_.braking) into -= c_.brake_conductance * y_.bus[n];
    z_.capacitor_A[n] = into;
    (c_.R_C > 0 ? z_.capacitor : y_.bus)[n + 1] = f * c_.inv_C * into;
    if (c_.source == Source::battery) {
      z_.charge[n + 1] = -f * c_.inv_capacity * z_.source[n];
      z_.slow[n + 1] = f * c_.inv_C_1 * (z_.source[n] - c_.inv_R_1 * z_.slow[n]);
    } else if (c_.source != Source::steady) {
      z_.phase[n + 1] = n == 0 ? f * c_.mains_rate : Real(0);
      z_.mains_cos[n + 1] = -f * c_.mains_rate * z_.mains_sin[n];
      z_.mains_sin[n + 1] = f * c_.mains_rate * z_.mains_cos[n];
    }
  }

 private:
  Real drawn(int n) const { return share_[0] * y_.i[0][n] + share_[1] * y_.i[1][n] + share_[2] * y_.i[2][n]; }
  Real open_voltage(int n) const {
    const auto constant = [n](Real v) { return n == 0 ? v : Real(0); };
    if (c_.source == Source::steady) return constant(c_.V_0);
    if (c_.source != Source::battery) return c_.mains_peak * z_.mains_cos[n] - constant(c_.mains_drop);
    const ChargePiece<Real>& piece = c_.open_circuit[mode_.charge_piece];
    return constant(piece.now) + piece.rise * z_.charge[n] - z_.slow[n];
  }

  const Constants<Real>& c_;
  const Mode& mode_;
  Expansion<Real>& y_;
  Series<Real>& z_;
  PerLeg<Real> share_{};
};

}  // namespace sixstep::plant::general
