// SPDX-License-Identifier: Apache-2.0
// Reads the constants of the machine from a sheet: each from one printed form, with its provenance, converted to SI
// and the model's frame.
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

/// A value in SI and the model's frame, with its derivation: "resistance_ohm, terminal: halved".
struct Constant {
  double value = 0.0;
  std::string from;
};

/// The same constant from another line of the sheet, for comparison with the one used.
struct OtherWay {
  std::string key;
  double K_e_V_s = 0.0;
  double relative_doubt = 0.0;  ///< relative error of the printed value
};

/// The iron's part of the friction: hysteresis does not depend on speed, eddy currents grow with it (model.md 7).
struct IronDrag {
  double B_Nm_s = 0.0;
  double coulomb_Nm = 0.0;
};

/// Friction: T = B w + T_c, of bearings and iron together. One no-load point fixes only K_t I_0 = B w_0 + T_c.
struct Friction {
  double B_Nm_s = 0.0;  ///< value of the model
  double coulomb_Nm = 0.0;
  IronDrag iron;  ///< the iron's part of both, if the sheet separates it
  std::string from;
  double no_load_speed_rad_s = 0.0;          ///< speed of the no-load point used; 0: none
  std::optional<double> all_viscous_Nm_s;    ///< one extreme for a single point: B = K_t I_0/w_0
  std::optional<double> all_coulomb_Nm;      ///< the other extreme: T_c = K_t I_0
  std::optional<double> split_viscous_Nm_s;  ///< from two points
  std::optional<double> split_coulomb_Nm;
};

struct SheetConstants {
  ShapeFactors shape;
  std::optional<int> pole_pairs;       ///< pole pairs of a rotary motor
  std::optional<double> pole_pitch_m;  ///< pole pitch of a linear motor
  /// Electrical radians per mechanical one, or per metre: p, pi/tau.
  std::optional<double> electrical_per_mechanical() const {
    if (pole_pitch_m) return base::pi / *pole_pitch_m;
    return pole_pairs ? std::optional<double>(*pole_pairs) : std::nullopt;
  }
  std::optional<double> nominal_voltage_V;
  std::optional<Constant> R_ohm;     ///< per phase
  std::optional<Constant> L_H;       ///< per phase, L - M
  std::optional<Constant> K_e_V_s;   ///< peak phase EMF per mechanical rad/s
  std::optional<Constant> K_t_Nm_A;  ///< terminal, sector mean
  std::optional<Constant> J_kg_m2;
  std::optional<Constant>
      J_of_body_kg_m2;  ///< from the rotor's dimensions, in addition to a printed value or instead of it
  double K_e_relative_doubt = 0.0;
  std::vector<OtherWay> other_ways;
  Friction friction;
  std::vector<std::string_view> used;  ///< keys that the model uses
  base::Problems problems;             ///< errors in the written values
  base::Problems missing;              ///< values that a model also needs
};

/// It has no side effects. Two forms of one printed value are a Problem; two printed values of one constant are
/// kept as other_ways. A missing frame is a Problem that gives the meaning of each candidate.
SheetConstants sheet_constants(const Sheet& sheet);

/// Relative rounding error: half of the last printed digit over the value. The digit is the file's if the text is
/// known, else that of the shortest decimal.
double relative_doubt(const base::Quantity& q);

/// The sheet with all values that the model needs in the standard keys (resistance_ohm, inductance_mH,
/// torque_constant_mNm_A, inertia_gcm2, viscous_friction_Nm_s, coulomb_friction_mNm), for any printed form.
/// Values already in a standard key keep their bits. For callers that change single values.
Sheet in_standard_keys(Sheet sheet);

}  // namespace sixstep::design
