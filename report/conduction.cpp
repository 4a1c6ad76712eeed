// SPDX-License-Identifier: Apache-2.0
#include "report/conduction.hpp"

#include <array>

#include "report/windows.hpp"
#include "sixstep/plant/general/leg_connections.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

namespace plant = sixstep::plant;

using Values = std::vector<double>;

struct Columns {
  const Values* current;
  const Values* upper;
  const Values* lower;
  bool complete() const { return current && upper && lower; }
};

/// The leg's connection from row n to the next row. The current may be zero at an end of this interval, so
/// the sum of both ends gives its sign.
plant::Connection leg_after(const Columns& c, std::size_t n, bool igbt) {
  const bool upper = (*c.upper)[n] > 0.5, lower = (*c.lower)[n] > 0.5;
  const double current = (*c.current)[n] + (*c.current)[n + 1];
  if (!igbt) return plant::connection_of(upper, lower, current);
  const plant::general::LegConnections ways = plant::general::ways_of({.igbt = true}, upper, lower);
  return current > 0 ? ways.positive : current < 0 ? ways.negative : plant::Connection::floating;
}

}  // namespace

Conduction conduction(const sixstep::study::Trace& trace, bool igbt,
                      const std::array<std::uint8_t, 3>& phase_at) {
  const auto* time = find_column(trace, "t_s");
  constexpr const char* currents[] = {"i_a_A", "i_b_A", "i_c_A"};
  const auto [a, b, c] = phase_at;
  const std::array<Columns, 3> legs{{
      {find_column(trace, currents[a]), find_column(trace, "gate_T1"), find_column(trace, "gate_T2")},
      {find_column(trace, currents[b]), find_column(trace, "gate_T3"), find_column(trace, "gate_T4")},
      {find_column(trace, currents[c]), find_column(trace, "gate_T5"), find_column(trace, "gate_T6")},
  }};
  Conduction out;
  if (!time || time->size() < 2 || !legs[0].complete() || !legs[1].complete() || !legs[2].complete())
    return out;
  out.end_s = time->back();
  for (std::size_t n = 0; n + 1 < time->size(); ++n) {
    if (!((*time)[n] < (*time)[n + 1])) continue;
    unsigned code = 0;
    for (std::size_t k = 3; k-- > 0;) code = 5 * code + static_cast<unsigned>(leg_after(legs[k], n, igbt));
    if (!out.code.empty() && out.code.back() == code) continue;
    out.time_s.push_back((*time)[n]);
    out.code.push_back(static_cast<std::uint8_t>(code));
  }
  return out;
}

}  // namespace report
