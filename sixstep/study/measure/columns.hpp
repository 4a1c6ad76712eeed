// SPDX-License-Identifier: Apache-2.0
// One table names the trace's columns with unit, frame and meaning.
#pragma once
#include <array>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

enum class ColumnId : std::uint8_t {
  t,
  i_a,
  i_b,
  i_c,
  u_a,
  u_b,
  u_c,
  u_ab,
  u_bc,
  u_ca,
  e_a,
  e_b,
  e_c,
  speed,
  angle,
  torque,
  bus_V,
  bus_A,
  duty,
  i_m,
  i_ref,
  speed_ref,
  position_ref,
  load,
  gate_T1,
  gate_T2,
  gate_T3,
  gate_T4,
  gate_T5,
  gate_T6,
  hall,
  sector,
  load_speed,  // from here on: what only the general kernel has
  load_angle,
  source_A,
  loop_A,
  capacitor_A,
  battery_charge,
  battery_recovery_V,
  winding_degC,
  housing_degC,
  junction_degC,
  encoder_A,  // from here on: what an encoder or a resolver gives
  encoder_B,
  encoder_Z,
  absolute_code,
  resolver_cos_V,
  resolver_sin_V,
  i_d,  // from here on: what a field-oriented drive holds
  i_q,
  i_d_ref,
  i_q_ref,
  v_d,
  v_q,
  angle_error,
  count
};
inline constexpr std::size_t column_count = static_cast<std::size_t>(ColumnId::count);
using FullRow = std::array<double, column_count>;

/// Whether a column means anything in a mode (a duty run has no current reference): rows hold NaN in others.
bool applies(ColumnId id, control::Mode mode);
/// In a mode that comes into the run, and to the machine and supply at hand.
bool applies(ColumnId id, const Scenario& scenario);

/// Every column there is: t_s i_a_A i_b_A i_c_A u_a_V .. hall.
const std::vector<Column>& all_columns();
/// The same by their names where the motor is linear: speed_m_s, position_mm, force_N (base/linear.hpp). Rows that a scenario
/// records are in these units; those of events stay as the turning motor's.
const std::vector<Column>& all_columns(design::MotorKind kind);

/// Those the scenario's record.columns asks for, t_s always first; Problems name unknown ones.
base::Result<std::vector<Column>> record_columns(const Scenario& scenario);

/// Indices into the full row of what the scenario records, t first; Problems name unknown columns.
base::Result<std::vector<std::size_t>> record_indices(const Scenario& scenario);

}  // namespace sixstep::study
