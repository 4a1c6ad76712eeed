// SPDX-License-Identifier: Apache-2.0
// Holds the arguments of `sixstep design`.
#pragma once
#include <optional>
#include <string>

#include "faces/cli/rooms.hpp"

namespace cli {

struct DesignArguments {
  std::string motor;
  std::string scenario;  ///< the scenario with the board, the motor and the mode
  std::optional<std::string> mode, chopping, rotor, currents;
  std::string method = "pole-placement";
  std::optional<double> settle_s, current_settle_s, damping, bandwidth_rad_s, period_s, voltage_V,
      torque_limit_Nm, load_inertia_kg_m2, lowest_speed_rad_s, capture_Hz, step;
  std::optional<double> force_limit_N, load_mass_kg;  ///< linear motor: replace torque_limit_Nm and
                                                      ///< load_inertia_kg_m2
  std::optional<int> delay_periods, edges;
  bool quick = false;  ///< true: no runs within the tolerances
  bool quiet = false, force = false;
  unsigned jobs = 0;
  std::string json, toml, models, html;  ///< paths of the files; json "-": standard output
  double angle_deg = 30.0;               ///< rotor angle for the exported models, electrical degrees
  std::string optimise, store;           ///< path of a plan, and of the store of its runs
  bool resume = false;
  std::string data_dir;
  std::string command;  ///< the command line as it can be typed again
};

}  // namespace cli
