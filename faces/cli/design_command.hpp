// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

struct DesignArguments {
  std::string motor;
  std::string mode = "current", method = "pole-placement", chopping = "soft";
  std::optional<double> settle_s, current_settle_s, damping, bandwidth_rad_s, period_s, voltage_V,
      torque_limit_Nm, load_inertia_kg_m2, step;
  int delay_periods = 0;
  bool quick = false;  ///< without the tolerances
  bool quiet = false;
  unsigned jobs = 0;
  std::string json, toml, header, models, html;  ///< files; json "-": standard output
  double angle_deg = 30.0;                       ///< of the models, electrical
  std::string data_dir;
  std::string command;  ///< the command line as it may be typed again
};

/// `sixstep design MOTOR`: from the sheet to gains that are known to hold.
Exit design_command(const DesignArguments& arguments);

}  // namespace cli
