// SPDX-License-Identifier: Apache-2.0
// Checks a data sheet against itself. Most sheets print each fact twice. The check therefore finds misprints,
// a line value used as a phase value, and exaggerated ratings.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

enum class RelationVerdict {
  holds,
  known,  ///< violated, and listed in known_deviation of the sheet's file
  broken,
  doubted,  ///< outside its tolerance, but on the side where makers may define the value differently: no
            ///< contradiction
};

/// Two sides that are physically equal, up to the rounding of the printed values and a given margin.
struct Relation {
  std::string name;  ///< name in known_deviation: "stall current"
  std::string left_words, right_words;
  double left = 0.0;
  double right = 0.0;
  std::string unit;
  double deviation = 0.0;  ///< left/right - 1
  double lowest = 0.0;     ///< least tolerated deviation
  double highest = 0.0;    ///< greatest tolerated deviation
  RelationVerdict verdict = RelationVerdict::holds;
  std::string remark;  ///< reason for a tolerance larger than rounding, or probable cause of the deviation
};

/// One line of the sheet and its use.
struct LineUse {
  std::string key;     ///< key as the file writes it
  double value = 0.0;  ///< value in the unit of the standard key
  std::string unit;
  double in_file = 0.0;  ///< value in the unit of `key`
  double doubt = 0.0;    ///< relative rounding error of the printed value
  bool used = false;     ///< true: the model uses it
  std::string why;
};

struct SheetCheck {
  SheetConstants constants;
  std::vector<Relation> relations;
  std::vector<LineUse> lines;
  std::optional<double> electrical_time_constant_s;  ///< L/R
  std::optional<double> mechanical_time_constant_s;  ///< R J/K_t^2
  std::optional<double> stall_current_A;             ///< U/R
  base::Problems doubts;                             ///< probable errors of a unit that no relation shows
  bool consistent = true;                            ///< true: every violated relation is in known_deviation
};

/// Uses only the sheet. Problems: errors in the written values, Problems of sheet_constants(), and a
/// known_deviation that names no relation, or a relation that is fulfilled.
base::Result<SheetCheck> check_sheet(const Sheet& sheet);

/// "the motor's sheet contradicts itself: stall current and no-load speed disagree with its other values;
/// correct ..", with the relations of the check; empty if the sheet is consistent.
std::string contradiction_words(const SheetCheck& check);

/// Slowest usual time constants, s. In data/motors the slowest winding has L/R = 11 ms and the slowest rotor
/// R J/K_t^2 = 1.2 s. A thousand times a usual value is a wrong unit. Values between these limits, such as
/// a megawatt generator or a rotor with a flywheel, are reported and used.
inline constexpr double slowest_usual_winding_s = 0.2, slowest_usual_rotor_s = 100.0;

/// Least margin of a no-load speed. The ideal line neglects the commutation, which may need a larger margin
/// (commutation_part()).
inline constexpr double no_load_margin = 0.02;

/// Current at a Hall edge, relative to the current's mean. In simulated motors it is 1.2 to 1.4 without load,
/// for trapezoid and sine and for 0.3 to 6 ms of L/R, and 1 to 1.2 with load.
inline constexpr double edge_current = 1.4;

/// Loss of speed by commutations at this mean current, relative to the remaining speed. In each sector, of
/// duration pi/(3 p w), the entering phase takes over the edge's current i. This reduces the volt seconds of
/// the bus by L_s i: the result is 3 p L_s i/(pi K_t), at any speed. 0 if L or the pole pairs are unknown.
double commutation_part(const SheetConstants& constants, double current_A);

/// Allowed difference between measured or derived friction lines and a printed no-load current: the lines and
/// the current may belong to different motors of the type, or to different temperatures. For the 251601 the
/// sources have 7.3e-6 to 10.6e-6 N m s, 45 % apart. If one sheet prints both, they agree within rounding:
/// for the four windings of Faulhaber's 3564 B within 0.25 %.
inline constexpr double friction_margin = 0.5;

/// Largest drop of the nominal speed below the no-load speed, relative to R/K_t^2 M_N at 25 degC. Makers
/// print the nominal speed of a warm motor, and commutation reduces the speed. In data/motors maxon's drops
/// are 1.4 to 2.3 times the drop at 25 degC. A larger drop is a limit of the drive, or a misprint.
inline constexpr double most_nominal_drop = 2.5;

/// Resistance of a winding at 150 degC, relative to 25 degC. Together with commutation it may explain a drop
/// larger than most_nominal_drop.
inline constexpr double warm_winding = 1.5;

/// Largest fraction of the voltage across the winding's resistance at no load, if neither I_0 nor the whole
/// friction is printed. With a fraction x the best efficiency is at most (1 - sqrt x)/(1 + sqrt x), a third
/// for x = 1/4. No motor with a higher loss is sold. With this limit an error by sqrt 2 in a constant is
/// found.
inline constexpr double most_unknown_drop = 0.25;

/// Allowed excess of a no-load speed over the mechanical speed limit, relative to the limit. Makers wind the
/// same rotor for voltages at which it may not run without load.
inline constexpr double max_speed_margin = 1.0;

/// Allowed deviation of a rotor's inertia from the cylinder or ring with its dimensions, because of shaft,
/// magnets, hub and bores. A diameter written as a radius causes a factor of 16.
inline constexpr double body_margin = 0.3;

}  // namespace sixstep::design
