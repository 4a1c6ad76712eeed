// SPDX-License-Identifier: Apache-2.0
// A data sheet held against itself: most sheets print each fact twice, so that a slip of the pen, a line
// value taken for a phase value or a doctored rating shows.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

enum class RelationVerdict {
  holds,
  known,  ///< broken, and the sheet's file says so in known_deviation
  broken,
};

/// Two sides that physics makes equal, up to the rounding of what is printed and a stated margin.
struct Relation {
  std::string name;  ///< what known_deviation calls it: "stall current"
  std::string left_words, right_words;
  double left = 0.0;
  double right = 0.0;
  std::string unit;
  double deviation = 0.0;  ///< left/right - 1
  double lowest = 0.0;     ///< deviation that is tolerated, from ..
  double highest = 0.0;    ///< .. to
  RelationVerdict verdict = RelationVerdict::holds;
  std::string remark;  ///< why the tolerance is more than rounding, or what the deviation looks like
};

/// One line of the sheet and what becomes of it.
struct LineUse {
  std::string key;     ///< as the file writes it
  double value = 0.0;  ///< in the unit of the standard key
  std::string unit;
  bool used = false;  ///< the model is made of it
  std::string why;
};

struct SheetCheck {
  SheetConstants constants;
  std::vector<Relation> relations;
  std::vector<LineUse> lines;
  std::optional<double> electrical_time_constant_s;  ///< L/R
  std::optional<double> mechanical_time_constant_s;  ///< R J/K_t^2
  std::optional<double> stall_current_A;             ///< U/R
  base::Problems doubts;                             ///< slips of a unit that no relation shows
  bool consistent = true;                            ///< no relation is broken beyond what the file admits
};

/// Nothing but what the sheet says. Problems are those of what is written, of sheet_constants, and a
/// known_deviation that names no relation or one that holds.
base::Result<SheetCheck> check_sheet(const Sheet& sheet);

/// Of the motors in data/motors the slowest winding has L/R = 11 ms and the slowest rotor R J/K_t^2 = 1.2 s. A thousand times a usual one
/// is a slip of a unit; what lies between, a generator of megawatts or a rotor with its flywheel, is told and stays what it is.
inline constexpr double slowest_usual_winding_s = 0.2, slowest_usual_rotor_s = 100.0;

/// What commutation takes off the ideal no-load line, which the relation leaves out: the 251601 simulated to
/// its steady state turns at 702.6 rad/s, 1.3 % below (U - R I)/K_t.
inline constexpr double no_load_margin = 0.02;

/// How far friction lines that are measured or derived may lie off a printed no-load current, or the other way round: they are of
/// another motor, or of one as warm as it was. Of the 251601 the sources have 7.3e-6 to 10.6e-6 N m s, 45 % apart. What one sheet
/// prints of both agrees within rounding: the four windings of Faulhaber's 3564 B to 0.25 %.
inline constexpr double friction_margin = 0.5;

/// The part of the voltage that a motor may lose over its winding at no load where neither I_0 nor all friction is printed. With x
/// of it the best efficiency is at most (1 - sqrt x)/(1 + sqrt x), a third for x = 1/4: a motor that loses more is none that is sold
/// for turning, and a factor sqrt 2 in a constant shows.
inline constexpr double most_unknown_drop = 0.25;

/// By how much a no-load speed may lie above the largest speed of the mechanics: makers wind the same rotor for more volts than it may
/// turn at without load.
inline constexpr double max_speed_margin = 1.0;

/// What a rotor is beside the cylinder or ring of its measures: shaft, magnets, hub, bores. A radius taken for a diameter is a
/// factor of 16.
inline constexpr double body_margin = 0.3;

}  // namespace sixstep::design
