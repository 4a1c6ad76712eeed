// SPDX-License-Identifier: Apache-2.0
#include "report/held_current.hpp"

#include <algorithm>
#include <cmath>

#include "report/windows.hpp"

namespace report {
namespace {

using sixstep::study::Scenario;
using sixstep::study::Trace;

/// Whether the driven pair is the pair of the rotor's sector, as column i_m assumes.
bool drives_pair_of_rotor(const Scenario& s) {
  using sixstep::rig::WireOrder;
  using sixstep::study::FirmwareKind;
  if (s.control.drive == FirmwareKind::sensorless) return false;
  if (s.control.drive == FirmwareKind::own && answers_legs(s.control.own)) return false;
  return s.bridge.phases == WireOrder::abc && s.sensors.hall_lines == WireOrder::abc &&
         s.sensors.hall_inverted == sixstep::study::HallLines::none;
}

}  // namespace

HeldCurrent held_by(const Scenario& s) {
  if (s.control.drive == sixstep::study::FirmwareKind::field)
    return {"Current across the magnet", "i_q_A", "i_q_ref_A", "i_q", "i_q*"};
  if (!drives_pair_of_rotor(s)) return {"Largest phase current", "", "i_ref_A", "|i|", "|i_ref|", true};
  return {"Motor current", "i_m_A", "i_ref_A", "i_m", "i_ref"};
}

std::optional<std::vector<double>> held_values(const Trace& trace, const HeldCurrent& held) {
  if (!held.of_phases) {
    const auto* column = find_column(trace, held.column);
    return column ? std::optional(*column) : std::nullopt;
  }
  std::vector<double> largest;
  for (const char* name : {"i_a_A", "i_b_A", "i_c_A"}) {
    const auto* phase = find_column(trace, name);
    if (!phase) return std::nullopt;
    largest.resize(phase->size());
    for (std::size_t n = 0; n < phase->size(); ++n) largest[n] = std::max(largest[n], std::abs((*phase)[n]));
  }
  return largest;
}

std::optional<std::vector<double>> asked_values(const Trace& trace, const HeldCurrent& held) {
  const auto* column = find_column(trace, held.reference);
  if (!column) return std::nullopt;
  std::vector<double> asked = *column;
  if (held.of_phases)
    for (double& ampere : asked) ampere = std::abs(ampere);
  return asked;
}

}  // namespace report
