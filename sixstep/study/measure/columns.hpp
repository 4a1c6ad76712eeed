// SPDX-License-Identifier: Apache-2.0
// One table lists the trace's columns with unit, frame and meaning.
#pragma once
#include <array>
#include <string_view>
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
  load_speed,  // this column and the next ones: only with the general kernel
  load_angle,
  source_A,
  loop_A,
  capacitor_A,
  battery_charge,
  battery_recovery_V,
  winding_degC,
  housing_degC,
  junction_degC,
  encoder_A,  // this column and the next ones: signals of an encoder or a resolver
  encoder_B,
  encoder_Z,
  absolute_code,
  resolver_cos_V,
  resolver_sin_V,
  i_d,  // this column and the next ones: only with a field-oriented drive
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

/// True if a column has a meaning in a mode (a duty run has no current reference). Otherwise its rows contain
/// NaN.
bool applies(ColumnId id, control::Mode mode);
/// True if a column has a meaning in any mode of the run, with the scenario's motor and supply.
bool applies(ColumnId id, const Scenario& scenario);

/// True if the numbers of a column are labels or levels, such as a Hall code: two of them can only be equal
/// or different.
bool holds_labels(std::string_view column);

/// All columns: t_s i_a_A i_b_A i_c_A u_a_V .. hall.
const std::vector<Column>& all_columns();
/// All columns with a linear motor's names and units: speed_m_s, position_mm, force_N (base/linear.hpp). The
/// scenario's recorded rows have these units; event rows keep the rotary motor's units.
const std::vector<Column>& all_columns(design::MotorKind kind);

/// The index of a signal's column; empty if the trace has none.
std::optional<std::size_t> column_of(Signal signal);

/// The columns of the scenario's record.columns, t_s always first. Problems: unknown names.
base::Result<std::vector<Column>> record_columns(const Scenario& scenario);

/// Indices of the recorded columns in the full row, t first. Problems: unknown names.
base::Result<std::vector<std::size_t>> record_indices(const Scenario& scenario);

}  // namespace sixstep::study
