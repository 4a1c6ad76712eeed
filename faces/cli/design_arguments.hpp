// SPDX-License-Identifier: Apache-2.0
// What `sixstep design` is told.
#pragma once
#include <optional>
#include <string>

#include "faces/cli/rooms.hpp"

namespace cli {

struct DesignArguments {
  std::string motor;
  std::string scenario;  ///< whose board, motor and task are designed for
  std::optional<std::string> mode, chopping, rotor, currents;
  std::string method = "pole-placement";
  std::optional<double> settle_s, current_settle_s, damping, bandwidth_rad_s, period_s, voltage_V,
      torque_limit_Nm, load_inertia_kg_m2, lowest_speed_rad_s, capture_Hz, step;
  std::optional<double> force_limit_N, load_mass_kg;  ///< of a linear motor, for torque limit and inertia
  std::optional<int> delay_periods, edges;
  bool quick = false;  ///< without the tolerances
  bool quiet = false, force = false;
  unsigned jobs = 0;
  std::string json, toml, models, html;  ///< files; json "-": standard output
  double angle_deg = 30.0;               ///< of the models, electrical
  std::string optimise, store;           ///< a plan and where its runs are kept
  bool resume = false;
  std::string data_dir;
  std::string command;  ///< the command line as it may be typed again
};

}  // namespace cli
