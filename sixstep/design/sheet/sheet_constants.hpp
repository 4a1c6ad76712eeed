// SPDX-License-Identifier: Apache-2.0
// What a sheet says about the machine: each constant of the model, read from one way of printing it, with its
// provenance. Frames and units end here.
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

/// A value in SI and the model's frame, and how it was read: "resistance_ohm, terminal: halved".
struct Constant {
  double value = 0.0;
  std::string from;
};

/// The same constant by another line of the sheet, to be held against the one used.
struct OtherWay {
  std::string key;
  double K_e_V_s = 0.0;
  double relative_doubt = 0.0;  ///< of its print
};

/// What the iron takes of the friction: hysteresis does not depend on speed, eddy currents grow with it (model.md 7).
struct IronDrag {
  double B_Nm_s = 0.0;
  double coulomb_Nm = 0.0;
};

/// Friction: T = B w + T_c, of bearings and iron together. One no-load point fixes only K_t I_0 = B w_0 + T_c.
struct Friction {
  double B_Nm_s = 0.0;  ///< what the model uses
  double coulomb_Nm = 0.0;
  IronDrag iron;  ///< its part in both, where the sheet tells it apart
  std::string from;
  double no_load_speed_rad_s = 0.0;          ///< of the point used; 0: no point
  std::optional<double> all_viscous_Nm_s;    ///< one extreme of one point: B = K_t I_0/w_0
  std::optional<double> all_coulomb_Nm;      ///< the other: T_c = K_t I_0
  std::optional<double> split_viscous_Nm_s;  ///< what two points say
  std::optional<double> split_coulomb_Nm;
};

struct SheetConstants {
  ShapeFactors shape;
  std::optional<int> pole_pairs;       ///< of a turning motor
  std::optional<double> pole_pitch_m;  ///< of a linear one
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
      J_of_body_kg_m2;  ///< by the rotor's measures, given beside a printed one or in its place
  double K_e_relative_doubt = 0.0;
  std::vector<OtherWay> other_ways;
  Friction friction;
  std::vector<std::string_view> used;  ///< keys that the model is made of
  base::Problems problems;             ///< what is wrong with what is written
  base::Problems missing;              ///< what a model needs beyond it
};

/// Pure. Two ways for one print are a Problem; two prints of one constant are kept apart as other_ways.
/// A missing frame is a Problem that says what each candidate would mean.
SheetConstants sheet_constants(const Sheet& sheet);

/// Half of the last printed digit over the value: what rounding leaves open. The digit is the file's where
/// the text is known, else that of the shortest decimal.
double relative_doubt(const base::Quantity& q);

/// The sheet with everything that the model needs written in the standard keys (resistance_ohm,
/// inductance_mH, torque_constant_mNm_A, inertia_gcm2, viscous_friction_Nm_s, coulomb_friction_mNm), whatever
/// way it was printed. What stands in a standard key already keeps its bits. For those that change single
/// values.
Sheet in_standard_keys(Sheet sheet);

}  // namespace sixstep::design
