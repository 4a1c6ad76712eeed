// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/columns.hpp"

#include <algorithm>

#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = {
      {"t_s", "s", "", "time"},
      {"i_a_A", "A", "phase, into the motor", "current of phase a"},
      {"i_b_A", "A", "phase, into the motor", "current of phase b"},
      {"i_c_A", "A", "phase, into the motor", "current of phase c"},
      {"u_a_V", "V", "pole, against the negative rail", "voltage of terminal a"},
      {"u_b_V", "V", "pole, against the negative rail", "voltage of terminal b"},
      {"u_c_V", "V", "pole, against the negative rail", "voltage of terminal c"},
      {"u_ab_V", "V", "terminal", "line voltage a to b"},
      {"u_bc_V", "V", "terminal", "line voltage b to c"},
      {"u_ca_V", "V", "terminal", "line voltage c to a"},
      {"e_a_V", "V", "phase", "back-EMF of phase a"},
      {"e_b_V", "V", "phase", "back-EMF of phase b"},
      {"e_c_V", "V", "phase", "back-EMF of phase c"},
      {"speed_rad_s", "rad/s", "mechanical", "speed"},
      {"angle_rad", "rad", "mechanical", "angle, counted over turns"},
      {"torque_Nm", "N m", "air gap", "electromagnetic torque"},
      {"bus_V", "V", "", "bus voltage"},
      {"bus_A", "A", "into the bridge", "bus current"},
      {"duty", "1", "", "signed duty in effect; with armed comparators the state of the upper switch"},
      {"i_m_A", "A", "motor", "motor current (i_p - i_n)/2 of the positive pair"},
      {"i_ref_A", "A", "motor", "current reference at the last sample"},
      {"speed_ref_rad_s", "rad/s", "mechanical", "speed reference at the last sample"},
      {"position_ref_deg", "deg", "mechanical", "position setpoint"},
      {"load_Nm", "N m", "shaft", "load torque"},
      {"gate_T1", "1", "", "upper gate of a"},
      {"gate_T2", "1", "", "lower gate of a"},
      {"gate_T3", "1", "", "upper gate of b"},
      {"gate_T4", "1", "", "lower gate of b"},
      {"gate_T5", "1", "", "upper gate of c"},
      {"gate_T6", "1", "", "lower gate of c"},
      {"hall", "1", "", "Hall code, H1 H2 H3 as bits 2, 1, 0"},
      {"sector", "1", "electrical", "sector 0 to 5"},
  };
  return columns;
}

bool applies(ColumnId id, control::Mode mode) {
  using control::Mode;
  if (id == ColumnId::i_ref) return mode == Mode::current || mode == Mode::speed || mode == Mode::position;
  if (id == ColumnId::speed_ref) return mode == Mode::speed || mode == Mode::position;
  if (id == ColumnId::position_ref) return mode == Mode::position;
  return true;
}

bool applies(ColumnId id, const Scenario& s) {
  using control::Mode;
  for (const Mode mode : {Mode::off, Mode::duty, Mode::current, Mode::speed, Mode::position})
    if (comes_into(s, mode) && applies(id, mode)) return true;
  return false;
}

base::Result<std::vector<std::size_t>> record_indices(const Scenario& scenario) {
  std::vector<std::size_t> indices = {0};
  const std::vector<Column>& columns = all_columns();
  if (scenario.record.columns.empty()) {
    for (std::size_t c = 1; c < column_count; ++c)
      if (applies(static_cast<ColumnId>(c), scenario)) indices.push_back(c);
    return indices;
  }
  base::Problems problems;
  for (const std::string& name : scenario.record.columns) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
    if (found == columns.end())
      problems.push_back({"record.columns", "\"" + name + "\"", "is no column of the trace",
                          "`sixstep help columns` lists them"});
    else if (found != columns.begin())
      indices.push_back(static_cast<std::size_t>(found - columns.begin()));
  }
  if (!problems.empty()) return problems;
  return indices;
}

base::Result<std::vector<Column>> record_columns(const Scenario& scenario) {
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();
  std::vector<Column> chosen;
  for (const std::size_t c : *indices) chosen.push_back(all_columns()[c]);
  return chosen;
}

}  // namespace sixstep::study
