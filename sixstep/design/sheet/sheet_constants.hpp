// SPDX-License-Identifier: Apache-2.0
// Reads the machine's constants from a sheet. Each constant comes from one printed form and is converted to
// SI units and the model's frame; its origin is stored too.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/shape_factors.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

/// A value in SI units and the model's frame, with its derivation as text: "resistance_ohm, terminal:
/// halved".
struct Constant {
  double value = 0.0;
  std::string from;
};

/// The same constant from another line of the sheet, for comparison with the constant of the model.
struct OtherWay {
  std::string key;
  double K_e_V_s = 0.0;
  double relative_doubt = 0.0;  ///< relative rounding error of the printed value
};

/// The iron's part of the friction. The part by hysteresis is independent of speed; the part by eddy currents
/// grows with it (model.md 7).
struct IronDrag {
  double B_Nm_s = 0.0;
  double coulomb_Nm = 0.0;
};

/// Friction T = B w + T_c of bearings and iron together. One no-load point determines only the sum, K_t I_0 =
/// B w_0 + T_c.
struct Friction {
  double B_Nm_s = 0.0;  ///< value of the model
  double coulomb_Nm = 0.0;
  IronDrag iron;  ///< the iron's part of B and T_c, if the sheet separates it
  std::string from;
  double no_load_speed_rad_s = 0.0;          ///< speed of the no-load point used; 0: no point
  std::optional<double> all_viscous_Nm_s;    ///< one extreme for one point, without dry friction: B = K_t
                                             ///< I_0/w_0
  std::optional<double> all_coulomb_Nm;      ///< the other extreme, without viscous friction: T_c = K_t I_0
  std::optional<double> split_viscous_Nm_s;  ///< B and T_c from two no-load points
  std::optional<double> split_coulomb_Nm;
};

struct SheetConstants {
  ShapeFactors shape;
  std::optional<int> pole_pairs;       ///< pole pairs of a rotary motor
  std::optional<double> pole_pitch_m;  ///< pole pitch of a linear motor
  /// Electrical radians per mechanical radian, or per metre of a linear motor: p, or pi/tau.
  std::optional<double> electrical_per_mechanical() const {
    if (pole_pitch_m) return base::pi / *pole_pitch_m;
    return pole_pairs ? std::optional<double>(*pole_pairs) : std::nullopt;
  }
  std::optional<double> nominal_voltage_V;
  std::optional<Constant> R_ohm;     ///< resistance per phase
  std::optional<Constant> L_H;       ///< inductance per phase, L - M
  std::optional<Constant> K_e_V_s;   ///< peak back-EMF of a phase per mechanical rad/s
  std::optional<Constant> K_t_Nm_A;  ///< between terminals, mean over a sector
  std::optional<Constant> J_kg_m2;
  std::optional<Constant>
      J_of_body_kg_m2;  ///< computed from the rotor's dimensions, also if an inertia is printed
  double K_e_relative_doubt = 0.0;
  std::vector<OtherWay> other_ways;
  Friction friction;
  std::vector<std::string_view> used;  ///< keys that the model uses
  base::Problems problems;             ///< errors in the written values
  base::Problems missing;              ///< values that the model needs and the sheet lacks
};

/// Reads the constants; it has no side effects. Two forms of one printed value are a Problem. Two printed
/// values of one constant are allowed, and the second is stored in other_ways. A missing frame is a Problem
/// that explains each candidate.
SheetConstants sheet_constants(const Sheet& sheet);

/// Relative rounding error: half of the last printed digit, divided by the value. The last digit is the last
/// digit in the file or, if the text is not known, of the shortest decimal.
double relative_doubt(const base::Quantity& q);

/// The sheet with all values of the model in the standard keys (resistance_ohm, inductance_mH,
/// torque_constant_mNm_A, inertia_gcm2, viscous_friction_Nm_s, coulomb_friction_mNm), in whatever forms they
/// are printed. Values that are already in a standard key keep their bits. Callers use it to change single
/// values.
Sheet in_standard_keys(Sheet sheet);

}  // namespace sixstep::design
