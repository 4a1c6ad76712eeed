// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

struct CurveArguments {
  std::string motor, data_dir;
  std::optional<double> voltage_V;  ///< without it the sheet's nominal voltage
  std::optional<double> duty, pwm_period_s, on_resistance_ohm, diode_drop_V, ambient_degC;
  std::optional<int> points;
  std::string chopping;
  std::string csv, json, html;
  bool quiet = false;
  unsigned jobs = 0;
  std::string command;  ///< what makes the page again
};

/// `sixstep curve MOTOR`: the torque-speed curve as a table, and as files where asked for.
Exit curve_command(const CurveArguments& arguments);

}  // namespace cli
